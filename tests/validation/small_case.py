"""The ready case on a coarse grid, in a folder of its own, for tests to edit."""

from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

ROOT = Path(__file__).parents[2]
READY = ROOT / "cases/calcification.yaml"
RUNS = ROOT / "reference_data/febio"
GENEROUS = ("radius", "rms_error", "50 %")  # bands for any model, and for none
IMPOSSIBLE = ("radius", "rms_error", "0.000001 %")


def small_case(*variants: str, n_x: int = 12, n_phi: int = 8) -> dict[str, Any]:
    """Content of the ready case: its first model, some variants, a coarse grid, and absolute paths."""
    case = YAML().load(READY)
    case["solver"] |= {"n_x": n_x, "n_phi": n_phi, "time_step": "4 ms", "cycles": 1}
    del case["compare"]["matched_inflow"], case["uncertainty"], case["models"]
    case["compare"]["cells"] = {"i": [1, 6, 12], "j": [1, 4]}
    case["inlet"]["waveform"] = str(ROOT / case["inlet"]["waveform"])
    case["variants"] = {name: case["variants"][name] for name in variants or ("none", "local")}
    for variant in case["variants"].values():
        reference = variant["reference"]
        del reference["levels"]
        for key in ("plot_file", "log"):
            reference[key] = str(ROOT / reference[key])
        for record in reference["data_records"]:
            record["file"] = str(ROOT / record["file"])
    return case


def bands(case: dict[str, Any], *declared: tuple[str, str, str]) -> dict[str, Any]:
    """The case with other bands: quantity, statistic, limit of each."""
    names = ("quantity", "statistic", "limit", "reason")
    case["compare"]["bands"] = [dict(zip(names, (*band, "stated"), strict=True)) for band in declared]
    return case


def written(case: dict[str, Any], folder: Path, name: str = "small.yaml") -> Path:
    path = folder / name
    with path.open("w", encoding="utf-8") as stream:
        YAML().dump(case, stream)
    return path
