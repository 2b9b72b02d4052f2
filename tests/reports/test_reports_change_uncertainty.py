"""How uncertain a change is follows from what the 3D mesh leaves open of both variants."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic

from reports.blocks import Paragraph, Table
from reports.result.load import load
from reports.sections import moved

Rows = list[dict[str, Any]]


def _value(rows: Rows, variant: str, quantity: str, statistic: str, side: str) -> float:
    found = next(
        row[side]
        for row in rows
        if (row["variant"], row["quantity"], row["statistic"]) == (variant, quantity, statistic)
        and row["model"] in ("row", "rom")
    )
    return float(found)


def test_a_change_of_the_cycle_may_be_off_by_the_mesh_of_both_variants(tmp_path: Path) -> None:
    rows = synthetic.write(tmp_path, synthetic.Setup(n_x=6, n_y=7, i=(1, 3), j=(1, 4), budget=True))
    mesh = {"none": 0.002, "axisymmetric": 0.003, "local": 0.004}
    like = next(row for row in rows if row["statistic"] == "budget_mesh")
    rows += [
        like | {"variant": name, "quantity": "least_radius", "statistic": statistic, "error": share}
        for name, share in mesh.items()
        for statistic in ("budget_error", "budget_mesh")
    ]
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    comparison = load(tmp_path)
    (table,) = (block for block in moved.section(comparison).blocks if isinstance(block, Table))
    (line,) = (row for row in table.rows if row[0] == "least lumen radius")
    for name, cell in zip(comparison.changed, line[2::2], strict=True):
        both = [mesh[at] * _value(rows, at, "least_radius", "cycle", "reference") for at in ("none", name)]
        assert float(cell.partition("±\u00a0")[2]) == pytest.approx(1e6 * sum(both), abs=0.51)
    assert "±: the most that the 3D mesh leaves open" in table.caption


def test_shares_of_a_field_say_what_the_mesh_leaves_open(two_models: tuple[Path, Rows]) -> None:
    comparison, rows = load(two_models[0]), two_models[1]
    for name, block in zip(comparison.changed, moved.section(comparison).blocks, strict=False):
        assert isinstance(block, Paragraph)
        size = [
            _value(rows, at, "radius", "budget_mesh", "error")
            * np.sqrt(np.mean(comparison.array("reference_radius", at) ** 2))
            for at in ("none", name)
        ]
        share = 100 * sum(size) / _value(rows, name, "radius", "change_rms", "reference")
        assert f"lumen radius ±\u00a0{share:.0f}\u00a0%" in block.text.partition("leaves open")[2]


def test_without_a_coarser_mesh_nothing_is_said(finished: tuple[Path, Rows]) -> None:
    blocks = moved.section(load(finished[0])).blocks
    (table,) = (block for block in blocks if isinstance(block, Table))
    assert not any("±" in text for row in (*table.rows, (table.caption,)) for text in row)
    assert "leaves open" not in " ".join(block.text for block in blocks if isinstance(block, Paragraph))
