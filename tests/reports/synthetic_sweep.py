"""A sweep's folder made of formulas: a stiffness and an angle, an error that follows both, some failures."""

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

LIMIT = 0.02


@dataclass
class Setup:
    """Size and kind of a synthetic sweep."""

    kind: str = "grid"
    state: str = "finished"
    variants: dict[str, str] = field(default_factory=lambda: {"local": "Local calcification"})
    count: int = 64
    failures: tuple[int, ...] = (5, 11)
    against: str | None = "coupled"
    indices: bool = False
    title: str = "Where the model holds"


def parameters(setup: Setup) -> list[dict[str, Any]]:
    """What study.json says of the parameters."""
    both = [
        {
            "name": "calcification.youngs_modulus",
            "label": "Young's modulus of the calcification",
            "unit": "MPa",
            "unit_si": "Pa",
            "display_factor": 1e-6,
            "kind": "range" if setup.kind == "grid" else "loguniform",
            "low": 1e6,
            "high": 32e6,
            "values": np.geomspace(1e6, 32e6, 8).tolist() if setup.kind == "grid" else None,
            "base": 10e6,
        },
        {
            "name": "calcification.phi.extent",
            "label": "angular extent of the calcification",
            "unit": "deg",
            "unit_si": "rad",
            "display_factor": 180 / np.pi,
            "kind": "list" if setup.kind == "grid" else "uniform",
            "low": 0.5,
            "high": 4.0,
            "values": np.linspace(0.5, 4.0, 8).tolist() if setup.kind == "grid" else None,
            "base": 1.57,
        },
    ]
    third = {
        "name": "outlet.resistance",
        "label": "resistance of the outlet",
        "unit": "Pa s/m^3",
        "unit_si": "Pa s m-3",
        "display_factor": 1.0,
        "kind": "normal",
        "mean": 5.8e9,
        "standard_deviation": 5e8,
        "low": None,
        "high": None,
        "values": None,
        "base": 5.8e9,
    }
    return both if setup.kind == "grid" else [*both, third]


def outputs(setup: Setup) -> list[dict[str, Any]]:
    """What study.json says of the outputs."""
    band = {"limit": LIMIT, "reason": "what 3D is known to", "variants": None} if setup.against else None
    percent = {"unit": "%", "unit_si": "1", "display_factor": 100.0}
    return [
        {
            "name": "systolic_pressure_inlet",
            "label": "systolic pressure at the inlet",
            "unit": "kPa",
            "unit_si": "Pa",
            "display_factor": 1e-3,
            "band": None,
        },
        {"name": "radius_rms_error", "label": "RMS error of the lumen radius", "band": band, **percent},
        {"name": "radius_max_error", "label": "largest error of the lumen radius", "band": band, **percent},
    ]


def samples(setup: Setup) -> pd.DataFrame:
    """All samples, those that failed without values."""
    random = np.random.default_rng(1)
    if setup.kind == "grid":
        stiffness, angle = (
            grid.ravel() for grid in np.meshgrid(*(p["values"] for p in parameters(setup)), indexing="ij")
        )
    else:
        stiffness = 10 ** random.uniform(6, np.log10(32e6), setup.count)
        angle = random.uniform(0.5, 4.0, setup.count)
    one = pd.DataFrame(
        {
            "calcification.youngs_modulus": stiffness,
            "calcification.phi.extent": angle,
            "systolic_pressure_inlet": 16e3 + 40 * np.log(stiffness / 1e6) + 5 * angle,
            "radius_rms_error": 0.006 * np.log(stiffness / 1e6) + 0.001 * angle,
            "radius_max_error": (angle - 2.0) * 0.02,
        }
    )
    if setup.kind != "grid":
        one["outlet.resistance"] = random.normal(5.8e9, 5e8, len(one))
    made = pd.concat([one.assign(variant=name) for name in setup.variants], ignore_index=True)
    failed = made.index.isin(setup.failures)
    for output in outputs(setup):
        made.loc[failed, output["name"]] = np.nan
    return made.assign(
        sample=np.arange(len(made)),
        status=np.where(failed, "failed", "ok"),
        error=pd.Series(np.where(failed, "the flow became supercritical at i = 61", None), dtype="string"),
        seconds=0.2,
    )


def _indices(setup: Setup) -> list[dict[str, Any]]:
    return [
        {
            "variant": variant,
            "output": output["name"],
            "parameter": parameter["name"],
            "S1": None if output["name"] == "radius_max_error" else 0.6 - 0.25 * k,
            "S1_conf": None if output["name"] == "radius_max_error" else 0.05,
            "ST": None if output["name"] == "radius_max_error" else 0.7 - 0.3 * k,
            "ST_conf": None if output["name"] == "radius_max_error" else 0.06,
            "groups": 8,
        }
        for variant in setup.variants
        for output in outputs(setup)
        for k, parameter in enumerate(parameters(setup))
    ]


def study(setup: Setup, table: pd.DataFrame) -> dict[str, Any]:
    """What study.json holds."""
    return {
        "name": "synthetic",
        "title": setup.title,
        "base_case": "cases/calcification.yaml",
        "variants": setup.variants,
        "created": "2026-03-04T05:06:07+00:00",
        "git_commit": "0123456789abcdef0123456789abcdef01234567",
        "versions": {"numpy": "2.4.6", "scipy": "1.17.1"},
        "design": {"kind": setup.kind, "samples": len(table), "count": None, "seed": 0, "chunk": 8},
        "against": setup.against,
        "parameters": parameters(setup),
        "outputs": outputs(setup),
        "state": setup.state,
        "counts": {
            "done": len(table),
            "failed": int((table["status"] == "failed").sum()),
            "total": len(table),
        },
        "sensitivity": _indices(setup) if setup.indices else None,
    }


def write(directory: Path, setup: Setup | None = None) -> pd.DataFrame:
    """Write a sweep's folder, its samples in two parts, the later ones first; return the samples."""
    setup = setup or Setup()
    table = samples(setup)
    (directory / "samples").mkdir(parents=True)
    half = len(table) // 2
    for number, part in enumerate((table.iloc[half:], table.iloc[:half])):
        part.to_parquet(directory / "samples" / f"part-{number:06d}.parquet", engine="pyarrow", index=False)
    (directory / "study.json").write_text(json.dumps(study(setup, table)), encoding="utf-8")
    (directory / "study.yaml").write_text("name: synthetic\n", encoding="utf-8")
    return table
