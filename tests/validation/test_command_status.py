"""`python -m validation.compare`: exit status and verdict."""

import pandas as pd
import pytest
from small_case import GENEROUS, IMPOSSIBLE, written

from validation.compare import command as compare


@pytest.mark.parametrize(
    ("band", "options", "status"),
    [(IMPOSSIBLE, ["--check"], 1), (GENEROUS, ["--check"], 0), (IMPOSSIBLE, [], 0)],
)
def test_exit_status_follows_the_bands_if_asked(tmp_path, quick, capsys, band, options, status, made):
    path = written(made(band), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), *options]) == status
    verdict = "1 FAIL" if band == IMPOSSIBLE else "1 OK"
    assert capsys.readouterr().out.startswith(f"calcification: bands: {verdict}; report: ")


def test_a_missing_quantity_breaks_its_band(tmp_path, quick, monkeypatch, made):
    monkeypatch.setattr("validation.metrics.bands.judged_value", lambda models, band: None)
    path = written(made(GENEROUS), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), "--check"]) == 1
    assert pd.read_csv(tmp_path / "result/metrics.csv")["status"].dropna().tolist() == ["MISSING"]


def test_a_case_without_bands_is_complete(tmp_path, quick, capsys, made):
    path = written(made(), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), "--check"]) == 0
    assert "bands: none declared" in capsys.readouterr().out
