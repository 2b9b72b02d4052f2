"""The report's section on what each part of the model buys."""

import json
from types import SimpleNamespace

import pytest

from reports.errors import ReportError
from reports.sections.ablation import section

ROW = {
    "variant": "local",
    "model": "membrane wall, section pressure",
    "radius_rms": 0.0063,
    "radius_max": -0.0178,
    "pressure_rms": 0.0049,
    "section_flow_rms": 0.016,
    "sector_share_rms": 0.0092,
    "sector_share_max": -0.035,
    "thesis_sector_max": None,
    "run_s": 0.5,
    "failure": "",
}


def written(folder, *rows):
    (folder / "ablation.json").write_text(json.dumps(rows))
    return section(SimpleNamespace(directory=folder))


def test_without_rows_there_is_no_section(tmp_path):
    assert section(SimpleNamespace(directory=tmp_path)) is None


def test_a_row_a_model(tmp_path):
    found = written(tmp_path, ROW, {**ROW, "model": "other", "failure": "the membrane buckles"})
    table = found.blocks[-1]
    first, second = table.rows
    assert first[:4] == ("local", "membrane wall, section pressure", "0.63\u00a0%", "−1.78\u00a0%")
    assert first[-2:] == ("−3.50\u00a0%", "0.50")
    assert "thesis's sectors" not in {column.group for column in table.columns}  # none was scored
    assert second[1] == "other (failed: the membrane buckles)"
    assert len(first) == len(second) == len(table.columns)


def test_the_whole_step_is_said_with_its_numbers(tmp_path):
    thin = {**ROW, "model": "thin wall, row pressure", "radius_rms": 0.0229, "sector_share_rms": 0.0316}
    (said,) = written(tmp_path, thin, ROW).blocks[1].items
    assert said.replace("\u00a0", " ") == (
        "local: with membrane wall, section pressure instead of thin wall, row pressure the RMS error of the "
        "lumen radius is 0.63 % instead of 2.29 % and of a sector's share of the flow is 0.92 % instead of "
        "3.16 %."
    )


def test_a_single_model_buys_nothing(tmp_path):
    assert len(written(tmp_path, ROW).blocks) == 2


@pytest.mark.parametrize("change", [{"radius_rms": "small"}, {"model": 3}])
def test_a_damaged_row_is_refused(tmp_path, change):
    with pytest.raises(ReportError, match=r"ablation\.json: row 1"):
        written(tmp_path, {**ROW, **change})
