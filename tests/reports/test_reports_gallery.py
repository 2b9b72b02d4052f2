import dataclasses
import re
from html import unescape
from pathlib import Path

import pytest
import synthetic_comparison as synthetic

from reports.__main__ import main


def _band(limit: float, quantity: str = "radius") -> dict[str, object]:
    return {
        "quantity": quantity,
        "statistic": "rms_error" if quantity == "radius" else "cycle",
        "limit": limit,
        "reason": "r",
        "variants": ["local"],
    }


def _run(monkeypatch: pytest.MonkeyPatch, *directories: Path) -> int:
    monkeypatch.setattr("sys.argv", ["reports", *map(str, directories)])
    return main()


def test_the_worst_comes_first_and_leads_to_its_report(
    tmp_path: Path,
    small: synthetic.Setup,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    cases = {
        "holds": [_band(0.5)],
        "not known": [_band(0.02, "phase_lag")],
        "fails & far": [_band(1e-5)],
        "fails": [_band(1e-3)],
    }
    for name, bands in cases.items():
        synthetic.write(tmp_path / "all" / name, dataclasses.replace(small, bands=bands, title=name))
    assert _run(monkeypatch, *(tmp_path / "all" / name for name in cases)) == 0
    place = tmp_path / "all" / "gallery.html"
    assert capsys.readouterr().out == f"{place}\n"
    page = place.read_text(encoding="utf-8")
    links = re.findall(r'<h2 id="case-\d"><a href="([^"]+)">([^<]+)</a>', page)
    assert [unescape(title) for _, title in links] == ["fails & far", "fails", "not known", "holds"]
    assert links[0][0] == "fails%20%26%20far/report.html"
    for name in cases:
        assert (tmp_path / "all" / name / "report.html").exists()
    assert "1 band could not be judged" in page
    assert "within every judged limit" in page
    assert "<script" not in page


def test_the_page_is_not_written_if_one_case_is_wrong(
    tmp_path: Path,
    small: synthetic.Setup,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    synthetic.write(tmp_path / "good", small)
    assert _run(monkeypatch, tmp_path / "good", tmp_path / "bad") == 2
    assert "bad: not a directory" in capsys.readouterr().err
    assert not (tmp_path / "gallery.html").exists()


def test_the_same_directory_twice_is_one_report(
    tmp_path: Path, small: synthetic.Setup, monkeypatch: pytest.MonkeyPatch
) -> None:
    synthetic.write(tmp_path / "one", small)
    assert _run(monkeypatch, tmp_path / "one", tmp_path / "one") == 0
    assert not (tmp_path / "gallery.html").exists()
