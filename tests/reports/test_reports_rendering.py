import dataclasses
import json
import re
from collections.abc import Callable
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pypdf
import pytest
import synthetic_comparison as synthetic

from reports import pages
from reports.build import write_reports
from reports.command import main

pytestmark = pytest.mark.slow

Rows = list[dict[str, Any]]
HOSTILE = '<script>alert("1")</script> # *bold* _low_ $x^2$ @key <label> \\ {{ 7*7 }} #panic() `raw` [a](b)'


class _Links(HTMLParser):
    """Every address that a page refers to, every id, and every tag."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.ids: list[str] = []
        self.tags: list[str] = []
        self.alts: list[str | None] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "data", "action", "srcset"):
                self.addresses.append(value or "")
            if name == "id":
                self.ids.append(value or "")
            if tag == "img" and name == "alt":
                self.alts.append(value)


def _page(path: Path) -> tuple[str, str]:
    """HTML source, and its visible text with single spaces."""
    source = path.read_text(encoding="utf-8")
    body = re.sub(r"<(style|script)\b.*?</\1>|src=\"[^\"]*\"", "", source, flags=re.DOTALL)
    return source, re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", body)))


def test_both_renderings_say_the_metrics(
    two_models: tuple[Path, Rows], pdf_text: Callable[[Path], str]
) -> None:
    directory, rows = two_models
    texts = [_page(directory / "report.html")[1], pdf_text(directory / "report.pdf")]
    flows = [
        f"{1e6 * row[model]:.3f}"
        for row in rows
        if (row["quantity"], row["statistic"]) == ("section_flow_rate", "value")
        for model in ("reference", "rom")
    ]
    errors = [
        f"{100 * row['error']:.2f} %".replace("-", "−")
        for row in rows
        if row["statistic"] in ("bias", "rms_error", "max_error")
    ]
    inputs = [file["sha256"] for file in synthetic.provenance(synthetic.Setup())["inputs"]]
    for text in texts:
        absent = [number for number in flows + errors + inputs if number not in text]
        assert absent == []
        for word in ("FAIL", "OK", "Velocity profiles", "Provenance", "φ", "γ", "cm³/s"):
            assert word in text


def test_warnings_stand_between_the_answer_and_any_figure(
    tmp_path: Path, small: synthetic.Setup, pdf_text: Callable[[Path], str], undrawn: None
) -> None:
    warnings = ("The 2D model had not become periodic.", "The lumen is open at φ = 12°.")
    synthetic.write(tmp_path, dataclasses.replace(small, warnings=warnings))
    html, pdf = write_reports(tmp_path)
    for text in (_page(html)[1], pdf_text(pdf)):
        places = [text.index(f"Warning: {warning}") for warning in warnings]
        assert text.index("Patch of calcification: no.") < places[0] < places[1]
        assert places[1] < min(text.index("Figure 1. "), text.index("Table 1. "))


def test_the_page_needs_nothing_but_itself(finished: tuple[Path, Rows]) -> None:
    source, _ = _page(finished[0] / "report.html")
    scripts = re.findall(r"<script[^>]*>", source)
    assert scripts == ['<script type="application/json" id="page-data">', "<script>"]
    source = re.sub(r"<script>.*?</script>", "", source, flags=re.DOTALL)  # the page's policy binds them
    links = _Links()
    links.feed(source)
    assert [address for address in links.addresses if not address.startswith(("#", "data:"))] == []
    assert "link" not in links.tags
    assert not re.search(r"url\((?!%23)|@import", source)  # a picture refers to its own parts
    assert len(links.ids) == len(set(links.ids))
    anchors = {address[1:] for address in links.addresses if address.startswith("#")}
    assert anchors <= set(links.ids)
    assert len(links.alts) == links.tags.count("img") > 0
    assert all(links.alts)


def test_every_figure_carries_its_data(finished: tuple[Path, Rows]) -> None:
    source, _ = _page(finished[0] / "report.html")
    figures = source.count("<figure ")
    assert len(re.findall(r'<a download="[\w-]+\.csv', source)) == figures > 10


def test_texts_are_never_markup(
    tmp_path: Path, small: synthetic.Setup, pdf_text: Callable[[Path], str], undrawn: None
) -> None:
    setup = dataclasses.replace(small, title=HOSTILE, notes=(HOSTILE,), time_names=(HOSTILE,))
    synthetic.write(tmp_path, setup)
    html, pdf = write_reports(tmp_path)
    source, text = _page(html)
    assert "<script>alert" not in source
    assert text.count(HOSTILE) >= 3
    assert HOSTILE.replace(" ", "") in pdf_text(pdf).replace(" ", "")
    assert pypdf.PdfReader(pdf).metadata.title == HOSTILE  # type: ignore[union-attr]


def test_letters_that_the_pdf_lacks_are_written_as_their_code(
    tmp_path: Path, small: synthetic.Setup, pdf_text: Callable[[Path], str], undrawn: None
) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, title="Artère 漢 🙂 β ≤ ½", notes=("bell \a",)))
    html, pdf = write_reports(tmp_path)
    assert "Artère 漢 🙂 β ≤ ½" in _page(html)[1]
    said = pdf_text(pdf)
    assert "Artère [U+6F22] [U+1F642] β ≤ ½" in said
    assert "bell [U+0007]" in said


def test_hostile_names_of_variants_are_shown_as_they_are(tmp_path: Path, small: synthetic.Setup) -> None:
    name = '"><b>$x_1$</b> ../../etc #x'
    bands = [{**small.bands[0], "variants": [name]}]
    synthetic.write(tmp_path, dataclasses.replace(small, variants=(name,), bands=bands))
    html, _ = write_reports(tmp_path)
    source, text = _page(html)
    assert "<b>$x_1$" not in source
    assert name in text
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "comparison.nc",
        "metrics.json",
        "provenance.json",
        "report.html",
        "report.pdf",
    ]


def test_only_the_stamp_differs(tmp_path: Path, small: synthetic.Setup, undrawn: None) -> None:
    synthetic.write(tmp_path, small)
    first = [path.read_bytes() for path in write_reports(tmp_path)]
    path = tmp_path / "provenance.json"
    path.write_text(path.read_text().replace("05:06:07", "08:09:10"))
    html, pdf = (path.read_bytes() for path in write_reports(tmp_path))
    assert html == first[0].replace(b"05:06:07", b"08:09:10")  # dated in words only
    assert pdf != first[1]


def test_a_failure_leaves_earlier_reports_as_they_were(
    tmp_path: Path, small: synthetic.Setup, monkeypatch: pytest.MonkeyPatch, undrawn: None
) -> None:
    synthetic.write(tmp_path, small)
    for name in ("report.html", "report.pdf"):
        (tmp_path / name).write_text("earlier")

    def broken(*_: object) -> bytes:
        raise KeyboardInterrupt

    monkeypatch.setattr(pages, "render_pdf", broken)
    with pytest.raises(KeyboardInterrupt):
        write_reports(tmp_path)
    assert [(tmp_path / name).read_text() for name in ("report.html", "report.pdf")] == ["earlier"] * 2


def test_a_full_disk_leaves_no_partial_file(
    tmp_path: Path, small: synthetic.Setup, monkeypatch: pytest.MonkeyPatch, undrawn: None
) -> None:
    synthetic.write(tmp_path, small)
    before = sorted(tmp_path.iterdir())

    def full(self: Path, target: Path) -> Path:
        raise OSError(28, "No space left on device", str(target))

    monkeypatch.setattr(Path, "replace", full)
    monkeypatch.setattr("sys.argv", ["reports", str(tmp_path)])
    assert main() == 2
    assert sorted(tmp_path.iterdir()) == before


def test_a_time_stamp_that_is_none_is_refused(
    tmp_path: Path,
    small: synthetic.Setup,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    undrawn: None,
) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    provenance = json.loads(path.read_text())
    path.write_text(json.dumps({**provenance, "created": "yesterday"}))
    monkeypatch.setattr("sys.argv", ["reports", str(tmp_path)])
    assert main() == 2
    assert "created is 'yesterday'" in capsys.readouterr().err


def test_symbols_are_set_as_mathematics(
    two_models: tuple[Path, Rows], pdf_text: Callable[[Path], str]
) -> None:
    directory, _ = two_models
    source, said = _page(directory / "report.html")
    assert "|<i>v</i><sub>r</sub>|/<i>v</i><sub>x</sub>" in source
    assert "(r/R)<sup>γ</sup>" in source
    for text in (said, pdf_text(directory / "report.pdf")):
        assert not re.search(r"\b[vq]_[rxφ]\b|\^γ", text)
