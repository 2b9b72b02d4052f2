"""A reference that states a few cells only: what cannot be drawn is said."""

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from reports.blocks import Bullets, Figure, Subsection, Table
from reports.result.load import Comparison, load
from reports.sections import artery, verdict
from reports.sections.content import report
from reports.sections.parts.stated import left_out


def comparison(reference):
    shape = ("variant", "time", "x", "phi")
    fields = xr.Dataset(
        {"reference_radius": (shape, reference), "rom_radius": (shape, np.ones((1, 2, 3, 4)))}
    )
    return SimpleNamespace(fields=fields, times=(("systole", 0.1),), states=(0,))


@pytest.mark.parametrize("missing", [1, 24])
def test_an_artery_without_all_radii_is_not_drawn(missing):
    radius = np.ones(24)
    radius[:missing] = np.nan
    sparse = comparison(radius.reshape(1, 2, 3, 4))
    assert artery.section(sparse) is None


def test_a_whole_artery_has_a_shape():
    assert artery.has_shape(comparison(np.ones((1, 2, 3, 4))))


@pytest.fixture
def tables(tmp_path: Path) -> Comparison:
    """A comparison whose reference states section flows at the shown cells and instants, and no more."""
    setup = synthetic.Setup(variants=("none", "axisymmetric"), i=(1, 6), j=(1, 4))
    arrays = synthetic.fields(setup)
    rows = synthetic.metrics(setup, arrays)
    dataset = synthetic.dataset(setup, arrays)
    stated = dataset["reference_section_flow_rate"].copy()
    for name in [str(name) for name in dataset.data_vars if str(name).startswith("reference_")]:
        dataset[name] = dataset[name].astype(float) * np.nan
    states = synthetic.states(setup, arrays)
    dataset["reference_section_flow_rate"][:, states, [0, 5]] = stated[:, states, [0, 5]]
    dataset.attrs |= {"sparse_reference": 1, "baselines": json.dumps({"axisymmetric": "none"})}
    dataset.to_netcdf(tmp_path / "comparison.nc", engine="netcdf4")
    for row in rows:
        if row["quantity"] != "section_flow_rate" or row["statistic"] == "ratio":
            row.update(reference=None, error=None, status="MISSING" if row["status"] else "")
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    (tmp_path / "provenance.json").write_text(json.dumps(synthetic.provenance(setup)))
    return load(tmp_path)


def test_only_what_is_stated_is_drawn_and_no_section_is_empty(tables: Comparison) -> None:
    content = report(tables)
    assert "artery" not in json.loads(content.page_data())
    assert {figure.key for figure in content.figures()} == {
        "overview-figure",
        "sketch",
        "cycle-1-1",
        "cycle-2-1",
    }
    for figure in content.figures():
        assert "<svg" in figure.drawing()
        assert "nan" not in figure.caption
        if figure.key.startswith("cycle"):
            assert "flow rate through the section over the cycle" in figure.caption
            assert "pressure" not in figure.caption
    keys = {section.key for section in content.sections}
    assert not keys & {"profiles", "agreement", "exponents", "maps", "artery", "budget"}
    assert keys >= {"answer", "overview", "assumptions", "provenance", "verdict", "change", "cycle"}
    assert all(section.blocks for section in content.sections)


def test_the_answer_says_what_tables_can_judge(tables: Comparison) -> None:
    (section,) = (section for section in report(tables).sections if section.key == "answer")
    assert isinstance(section.blocks[0], Bullets)
    for said, title in zip(section.blocks[0].items, ("No", "Ring of"), strict=True):
        missed = (
            "misses flow rate through the section, RMS error 4.50\u00a0%, limit 2\u00a0%. It could not be"
        )
        assert said.startswith(f"{title} calcification: no. The 2D model {missed} judged by lumen radius and")
    assert not any(isinstance(block, Figure) for block in section.blocks), "no map of a few cells"


def test_tables_leave_out_lines_without_a_reference(tables: Comparison) -> None:
    found = {
        block.key: block
        for section in report(tables).sections
        for part in section.blocks
        for block in (part.blocks if isinstance(part, Subsection) else (part,))
        if isinstance(block, Table)
    }
    assert {row[1] for row in found["pooled"].rows} == {"flow rate through the section"}
    assert "sector-flow" not in found
    assert "change-radius" not in found
    assert len(found["section-flow"].rows) == 6


def test_the_reader_is_told_that_the_reference_is_sparse(tables: Comparison) -> None:
    assert any("some cells and instants only" in said for said in verdict.unknowns(tables))


def test_one_variant_without_a_field_is_named(tables: Comparison) -> None:
    assert left_out(tables, ["none"], "profiles").startswith("Of axisymmetric the reference states no")
    assert left_out(tables, tables.variants, "profiles") == ""
