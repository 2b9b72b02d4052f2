"""Comparisons of every shape have a report: each section says something and each figure can be drawn."""

import dataclasses
import re
from pathlib import Path
from typing import Any

import pytest
import synthetic_comparison as synthetic

from reports.blocks import Figure, Paragraph, Report, Section, Subsection, Table
from reports.result.load import load
from reports.sections.content import report

pytestmark = pytest.mark.slow

BASE = synthetic.Setup(
    n_x=6, n_phi=4, n_time=7, n_y=5, i=(1, 3), j=(1, 3), variants=("none", "local"), time_names=("systole",)
)


_MADE: dict[str, Report] = {}  # several tests look at the same report


def _report(folder: Path, models: tuple[str, ...] = ("rom",), **changes: Any) -> Report:
    shape = f"{models} {changes}"
    if shape not in _MADE:
        synthetic.write(folder, dataclasses.replace(BASE, **changes), models)
        _MADE[shape] = report(load(folder))
    return _MADE[shape]


def _section(content: Report, key: str) -> Section:
    return next(section for section in content.sections if section.key == key)


def _drawn_and_said(content: Report) -> None:
    for section in content.sections:
        assert section.blocks
        assert all(part.blocks for part in section.blocks if isinstance(part, Subsection))
    for figure in content.figures():
        assert figure.drawing().startswith("<?xml")
        assert not re.search(r"\bnan\b|\binf\b|  |−0\.0+ |\b1 sectors", figure.caption + figure.alt)
        assert figure.csv.count("\n") > 1
    content.page_data()


@pytest.mark.parametrize(
    ("models", "changes"),
    [
        (("row", "coupled"), {"n_phi": 1, "j": (1,)}),
        (("row", "coupled"), {"variants": ("local",), "baseline": ""}),
        (("a", "b", "c"), {}),
        (("solver",), {"bands": []}),
        (("row", "coupled"), {"time_names": ()}),
    ],
    ids=["one row of cells", "one variant", "three models", "no limit", "no instant"],
)
def test_a_report_of_any_shape_is_whole(
    tmp_path: Path, models: tuple[str, ...], changes: dict[str, Any]
) -> None:
    _drawn_and_said(_report(tmp_path, models, **changes))


def test_one_row_of_cells_has_nothing_around_the_artery(tmp_path: Path) -> None:
    content = _report(tmp_path, ("row", "coupled"), n_phi=1, j=(1,))
    keys = {figure.key for figure in content.figures()}
    assert not keys & {"trust-map", "sections-figure", "dominance-figure"}
    (moved,) = (block for block in _section(content, "moved").blocks if isinstance(block, Figure))
    assert "lumen radius along the artery; 3D as points" in moved.caption
    assert "around" not in moved.caption + moved.alt


def test_without_limits_nothing_is_graded(tmp_path: Path) -> None:
    content = _report(tmp_path, ("row", "coupled"), bands=[])
    answer = _section(content, "answer")
    first = answer.blocks[0]
    assert isinstance(first, Paragraph)
    assert first.text.startswith("The case declares no limit, so nothing is judged")
    assert [type(block) for block in answer.blocks[1:]] == [Table]
    table = answer.blocks[1]
    assert isinstance(table, Table)
    assert all(row[0].endswith(", not judged") for row in table.rows)
    assert set(table.shades.values()) == {"unjudged"}


def test_without_a_baseline_nothing_moves(tmp_path: Path) -> None:
    content = _report(tmp_path, variants=("local",), baseline="")
    assert "moved" not in [section.key for section in content.sections]


def test_a_model_alone_is_called_2d_and_several_by_their_names(tmp_path: Path) -> None:
    for models, said in ((("solver",), {"2D"}), (("row", "coupled"), {"row", "coupled"})):
        content = _report(tmp_path / str(len(models)), models)
        table = next(b for b in _section(content, "answer").blocks if isinstance(b, Table))
        assert {column.title for column in table.columns[1:]} == said
        assert ("They are row (wall law thick)" in content.subtitle) == (len(models) > 1)
        verdict = _section(content, "verdict").blocks
        titles = [part.title for part in verdict if isinstance(part, Subsection)]
        assert titles == ([f"2D model {model}" for model in models] if len(models) > 1 else [])


def test_a_bias_of_nearly_nothing_has_no_sign(tmp_path: Path) -> None:
    synthetic.write(tmp_path, BASE)
    arrays = synthetic.fields(BASE)
    arrays["rom_radius"] = arrays["reference_radius"] * (1 - 1e-5)
    synthetic.dataset(BASE, arrays).to_netcdf(tmp_path / "comparison.nc")
    content = report(load(tmp_path))
    for key, said in (("agreement", "none 0.0 ± 0.0 %"), ("maps", "lumen radius 0.0 % (2D")):
        figure = next(block for block in _section(content, key).blocks if isinstance(block, Figure))
        assert said in figure.caption.replace("\u00a0", " ")
