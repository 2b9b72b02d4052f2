"""What captions and sentences of the PDF say in numbers, held against the fields of all models."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from cases.fields import FIELDS
from reports.result.load import load
from reports.sections.content import report

Finished = tuple[Path, list[dict[str, Any]]]
MODELS = ("row", "coupled")
LABELS = {field.label: field for field in FIELDS.values() if field.dims}
PLACE = r"x = (?P<x>[\d.]+) mm, φ = (?P<phi>\d+)°"


@pytest.fixture(scope="module")
def text(two_models: Finished, pdf_text: Callable[[Path], str]) -> str:
    """Text of the PDF, as a reader finds it."""
    return pdf_text(two_models[0] / "report.pdf").replace("\u00a0", " ")


@pytest.fixture(scope="module")
def captions(two_models: Finished, text: str) -> list[str]:
    """Captions of the PDF's figures."""
    found = re.findall(r"Figure \d+\. (.*?) Data: attached file", text)
    assert len(found) == len(list(report(load(two_models[0])).figures()))
    return found


@pytest.fixture(scope="module")
def data(two_models: Finished) -> Iterator[xr.Dataset]:
    """All models' fields."""
    with xr.open_dataset(two_models[0] / "comparison.nc", decode_times=False) as opened:
        yield opened.load()


@pytest.fixture(scope="module")
def first(data: xr.Dataset) -> xr.Dataset:
    """All models' fields at the first named instant."""
    return data.sel(time=data.attrs["compare_times_s"][0], method="nearest")


def _number(words: str) -> float:
    return float(words.replace("−", "-"))


def _caption(captions: list[str], opening: str) -> str:
    (found,) = (caption for caption in captions if caption.startswith(opening))
    return found


def _at(data: xr.Dataset, x: str, phi: str) -> tuple[int, int]:
    """Cell whose centre words name."""
    i = int(np.abs(1e3 * data["x"].values - float(x)).argmin())
    j = int(np.abs(np.degrees(data["phi"].values) - float(phi)).argmin())
    assert 1e3 * float(data["x"][i]) == pytest.approx(float(x), abs=0.051)
    assert np.degrees(float(data["phi"][j])) == pytest.approx(float(phi), abs=0.51)
    return i, j


def test_the_overview_names_the_largest_errors_at_its_place(captions: list[str], data: xr.Dataset) -> None:
    caption = _caption(captions, "Pressure P, lumen radius R and flow rate q")
    place = re.search(rf"over the cycle at {PLACE}, calcified in ([\w, ]+?);", caption)
    assert place
    i, j = _at(data, place["x"], place["phi"])
    inside = data["calcified"].isel(x=i, phi=j).values > 0
    assert place[3] == " and ".join(np.array(synthetic.VARIANTS)[inside])
    for name in ("pressure", "radius", "section_flow_rate"):
        said = re.search(rf"{FIELDS[name].label} ([\d.]+) % \((\w+), (\w+)\)", caption)
        assert said
        errors = {}
        for model in MODELS:
            each = np.abs(data[f"{model}_{name}"] / data[f"reference_{name}"] - 1).isel(x=i)
            each = each.isel(phi=j) if "phi" in each.dims else each
            errors |= {
                (variant, model): float(each.sel(variant=variant).max()) for variant in synthetic.VARIANTS
            }
        assert float(said[1]) == pytest.approx(100 * max(errors.values()), abs=0.051)
        assert errors[said[2], said[3]] == pytest.approx(max(errors.values()))


def test_what_calcification_moves_is_off_by_what_the_metrics_say(text: str, two_models: Finished) -> None:
    for variant in ("axisymmetric", "local"):
        opening = f"{synthetic.TITLES[variant]}: how far its change in 2D is from its change in 3D"
        said = text.partition(opening)[2].partition("Figure ")[0].partition("calcification: ")[0]
        for model in MODELS:
            words = said.partition(f"the {model} model ")[2].partition(";")[0]
            for name in ("pressure", "radius", "section_flow_rate"):
                (row,) = (
                    row
                    for row in two_models[1]
                    if (row["variant"], row["model"], row["quantity"], row["statistic"])
                    == (variant, model, name, "change_rms")
                )
                assert f"{FIELDS[name].label} {100 * row['error']:.0f} %" in words


def test_the_profiles_claim_is_the_farthest_of_all_probes(captions: list[str], first: xr.Dataset) -> None:
    caption = _caption(captions, "Axial velocity from the axis")
    probes = first.isel(x=[0, 2, 5], phi=[0, 3])
    for model in MODELS:
        said = re.search(rf"{model} ([+−][\d.]+) cm/s \((\w+), {PLACE}, r/R = ([\d.]+)\)", caption)
        assert said
        difference = 100 * (first[f"{model}_axial_velocity"] - first["reference_axial_velocity"])
        i, j = _at(first, said["x"], said["phi"])
        there = difference.sel(variant=said[2]).isel(x=i, phi=j).sel(y=float(said[5]), method="nearest")
        assert _number(said[1]) == pytest.approx(float(there), rel=6e-3)
        largest = np.abs(100 * (probes[f"{model}_axial_velocity"] - probes["reference_axial_velocity"])).max()
        assert abs(_number(said[1])) == pytest.approx(float(largest), rel=6e-3)


@pytest.mark.parametrize("model", MODELS)
def test_agreement_claims_bias_and_scatter_of_all_cells_and_states(
    captions: list[str], data: xr.Dataset, model: str
) -> None:
    caption = _caption(captions, f"Agreement of {model} with 3D")
    for name in ("radius", "section_flow_rate"):
        words = caption.partition(f"{FIELDS[name].label} none ")[2].partition(";")[0]
        found = re.findall(r"([+−]?[\d.]+) ± ([\d.]+) %", words)
        assert len(found) == len(synthetic.VARIANTS)
        for variant, (bias, spread) in zip(synthetic.VARIANTS, found, strict=True):
            two, three = (data[f"{m}_{name}"].sel(variant=variant).values for m in (model, "reference"))
            apart = 100 * (two - three) / three
            assert _number(bias) == pytest.approx(apart.mean(), abs=0.051)
            assert float(spread) == pytest.approx(1.96 * apart.std(), abs=0.051)


def test_the_exponents_claims_are_the_spans_of_the_models(captions: list[str], first: xr.Dataset) -> None:
    caption = _caption(captions, "Exponent γ of the profile closest to 3D")
    for model, words in (("reference", "3D"), *((name, name) for name in MODELS)):
        said = re.search(rf"([\d.]+) … ([\d.]+) in {words}", caption)
        assert said
        values = first[f"{model}_profile_exponent"]
        assert [float(n) for n in said.groups()] == pytest.approx(
            [float(values.min()), float(values.max())], abs=5.1e-3
        )


def test_the_stills_claim_is_the_narrowest_place(captions: list[str], first: xr.Dataset) -> None:
    caption = _caption(captions, "The deformed lumen")
    for variant in synthetic.VARIANTS:
        words = caption.partition(f"{variant}: ")[2].partition(";")[0]
        for model, side in (("reference", "3D"), *((name, name) for name in MODELS)):
            said = re.search(rf"{side} ([\d.]+) mm \({PLACE}\)", words)
            assert said
            radius = 1e3 * first[f"{model}_radius"].sel(variant=variant).values
            assert float(said[1]) == pytest.approx(radius.min(), abs=5.1e-4)
            assert radius[_at(first, said["x"], said["phi"])] == pytest.approx(radius.min())


def test_the_budgets_claims_are_those_of_the_metrics(captions: list[str], two_models: Finished) -> None:
    for quantity in ("section_flow_rate", "radius"):
        caption = _caption(captions, f"Error of the {FIELDS[quantity].label} and what it is owed to.")
        told: dict[str, str] = {}
        for interval, names in re.findall(r"[Mm]odel error between ([^:]+): ([\w ,]+)", caption):
            told |= dict.fromkeys(re.split(r", | and ", names), interval)
        assert set(told) == {f"{variant} {model}" for variant in synthetic.VARIANTS for model in MODELS}
        for row in two_models[1]:
            if (row["quantity"], row["statistic"], row["status"]) == (quantity, "rms_error", ""):
                low, high = 45 * row["error"], 55 * row["error"]
                assert told[f"{row['variant']} {row['model']}"] == f"{low:.2f} % and {high:.2f} %"


def test_dominance_says_the_largest_ratio_before_the_outlet(text: str, data: xr.Dataset) -> None:
    said = re.search(rf"\|v ?r ?\|/v ?x = ([\d.]+), is in variant (\w+) at {PLACE}", text)
    assert said
    ratios = data["reference_axial_dominance_radial"].isel(x=slice(None, -1))
    assert float(said[1]) == pytest.approx(float(ratios.max()), abs=5.1e-4)
    i, j = _at(data, said["x"], said["phi"])
    assert float(ratios.sel(variant=said[2])[i, j]) == pytest.approx(float(ratios.max()))


def test_the_bands_are_in_the_appendix_with_whose_error_it_is(text: str, two_models: Finished) -> None:
    appendix = text.partition("A Bands and checks")[2]
    for row in two_models[1]:
        if row["status"] == "FAIL":
            signed = "" if row["statistic"] == "rms_error" else "+"
            assert f"{100 * row['error']:{signed}.2f} %, limit {100 * row['band']:g} %" in appendix
    assert "What this comparison does not tell" in appendix
    assert "whether 3D had become periodic by then is not measured" in appendix
