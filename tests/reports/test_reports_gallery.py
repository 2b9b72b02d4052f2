import dataclasses
import re
from html import unescape
from pathlib import Path

import pytest
import synthetic_comparison as synthetic

from reports.command import main
from reports.html.gallery import entry, gallery_place, render_gallery
from reports.result.load import load
from reports.sections.content import report


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


def test_the_worst_comes_first(tmp_path: Path, small: synthetic.Setup) -> None:
    cases = {
        "holds": [_band(0.5)],
        "not known": [_band(0.02, "phase_lag")],
        "fails & far": [_band(1e-5)],
        "fails": [_band(1e-3)],
    }
    entries = []
    for name, bands in cases.items():
        synthetic.write(tmp_path / name, dataclasses.replace(small, bands=bands, title=name))
        comparison = load(tmp_path / name)
        content = report(comparison)
        entries.append(entry(tmp_path / name, comparison, content, {"artery-still": "<svg/>"}))
    page = render_gallery(entries, gallery_place([tmp_path / name for name in cases]))
    links = re.findall(r'<h2 id="case-\d"><a href="([^"]+)">([^<]+)</a>', page)
    assert [unescape(title) for _, title in links] == ["fails & far", "fails", "not known", "holds"]
    assert links[0][0] == "fails%20%26%20far/report.html"
    said = [re.sub(r"\s+", " ", text) for text in re.findall(r"Patch of calcification: (.*?)[;,.]", page)]
    assert said == ["no", "no", "no", "yes"]
    assert "could not be judged by lag of the reduced model" in page
    assert "<script" not in page


def test_several_directories_get_a_page_that_leads_to_their_reports(
    tmp_path: Path,
    small: synthetic.Setup,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    undrawn: None,
) -> None:
    for name in ("a", "b"):
        synthetic.write(tmp_path / "all" / name, dataclasses.replace(small, title=name))
    assert _run(monkeypatch, tmp_path / "all" / "a", tmp_path / "all" / "b") == 0
    place = tmp_path / "all" / "gallery.html"
    assert capsys.readouterr().out == f"{place}\n"
    for link in re.findall(r'href="([^"]+)"', place.read_text(encoding="utf-8")):
        assert (place.parent / link).exists()


def test_the_page_is_not_written_if_one_case_is_wrong(
    tmp_path: Path,
    small: synthetic.Setup,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    undrawn: None,
) -> None:
    synthetic.write(tmp_path / "good", small)
    assert _run(monkeypatch, tmp_path / "good", tmp_path / "bad") == 2
    assert "bad: not a directory" in capsys.readouterr().err
    assert not (tmp_path / "gallery.html").exists()
