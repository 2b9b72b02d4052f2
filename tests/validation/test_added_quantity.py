"""Quantities added from outside: an entry in the table of fields and a function, nothing else."""

import json

import numpy as np
import pytest
import xarray as xr
from comparisons import CELLS, TIMES, two_models
from pydantic import ValidationError
from small_case import written

from cases.fields import CELL, FIELDS, Compared, Field
from cases.sections.compare import Band
from reports.blocks import Subsection, Table
from reports.result.load import load
from reports.sections import change, verdict
from validation.compare import command as compare
from validation.metrics import rows as metrics
from validation.metrics.bands import judged_value
from validation.metrics.quantities import CYCLE_QUANTITIES, DERIVED_QUANTITIES

NAME, WORDS = "mean_inlet_pressure", "mean pressure at the inlet over the cycle"


def mean_inlet_pressure(model):
    pressure, times = model["section_pressure"].isel(x=0).to_numpy(), model["time"].to_numpy()
    return float(np.trapezoid(pressure, times) / (times[-1] - times[0]))


@pytest.fixture
def added(monkeypatch):
    """A number of the cycle; gone after the test."""
    compared = Compared(reads=("section_pressure",), statistics=("bias", "max_difference"))
    monkeypatch.setitem(FIELDS, NAME, Field(NAME, "P_in", WORDS, "Pa", "kPa", 1e-3, (), compared))
    monkeypatch.setitem(CYCLE_QUANTITIES, NAME, mean_inlet_pressure)


def band(quantity, statistic="bias", limit="2 %"):
    return Band.model_validate(
        {"quantity": quantity, "statistic": statistic, "limit": limit, "reason": "stated"}
    )


def tables(section):
    blocks = [
        b for block in section.blocks for b in (block.blocks if isinstance(block, Subsection) else [block])
    ]
    return {block.key: block for block in blocks if isinstance(block, Table)}


def test_a_comparison_tells_judges_and_names_it(added, made, quick, tmp_path):
    case = made((NAME, "bias", "10000 %"), (NAME, "max_difference", "0.001 Pa"))
    result = tmp_path / "result"
    assert compare.main([str(written(case, tmp_path)), "--output", str(result)]) == 0
    rows = json.loads((result / "metrics.json").read_text(encoding="utf-8"))
    of_it = {row["statistic"]: row for row in rows if row["quantity"] == NAME}
    with xr.open_dataset(result / "comparison.nc") as data:
        for model in ("rom", "reference"):
            own = data.sel(variant="none").rename({f"{model}_section_pressure": "section_pressure"})
            assert of_it["cycle"][model] == pytest.approx(mean_inlet_pressure(own), rel=1e-12)
    assert of_it["cycle"]["unit"] == "Pa"
    assert (of_it["bias"]["status"], of_it["max_difference"]["status"]) == ("OK", "FAIL")
    comparison = load(result)
    judged = tables(verdict.section(comparison))["bands"].rows
    assert [(row[1], row[2]) for row in judged] == [("FAIL", WORDS), ("OK", WORDS)]
    told = tables(change.section(comparison))["cycle-quantities"].rows
    assert [(row[1], row[2]) for row in told if row[0] == WORDS] == [("none", "kPa")]


def test_a_band_may_limit_what_it_declares_only(added):
    assert band(NAME).limit == 0.02
    with pytest.raises(ValidationError, match="allowed: bias, max_difference"):
        band(NAME, "scatter")


def test_it_is_unknown_elsewhere():
    with pytest.raises(ValidationError, match=f"{NAME}; did you mean pulse_pressure"):
        band(NAME)


def test_a_quantity_of_cells_has_its_rows_and_bands(monkeypatch):
    compared = Compared(reads=("radius", "pressure"), statistics=("rms_error", "bias"))
    field = Field("hoop_load", "PR", "pressure times radius", "Pa m", "N/m", 1.0, CELL, compared)
    monkeypatch.setitem(FIELDS, field.name, field)
    monkeypatch.setitem(
        DERIVED_QUANTITIES, field.name, lambda model: (model["pressure"] * model["radius"]).to_numpy()
    )
    models = two_models()
    ours, theirs = ((m["pressure"] * m["radius"]).to_numpy() for m in (models.rom, models.reference))
    pooled = {row.statistic: row for row in metrics.pooled_rows(models) if row.quantity == field.name}
    assert list(pooled) == ["rms_error", "bias"]
    assert pooled["bias"].error == pytest.approx(np.mean(ours / theirs - 1), rel=1e-12)
    assert judged_value(models, band(field.name)) == pooled["bias"].error
    values = [row for row in metrics.value_rows(models, CELLS, TIMES) if row.quantity == field.name]
    assert len(values) == CELLS[0].size * CELLS[1].size * TIMES.size
    assert {row.unit for row in values} == {"Pa m"}
