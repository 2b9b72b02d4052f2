"""The page of a sweep, held against its samples."""

import json
import re
from collections.abc import Callable
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import synthetic_sweep as synthetic

from cases.results.sweep import KeptOutput, OutputBand, VariedParameter
from reports.blocks import Table
from reports.command import main
from reports.errors import ReportError
from reports.sweep import write_sweep_page
from reports.sweep.amounts import amount, axis_label, ends
from reports.sweep.build import page_data, sweep_report
from reports.sweep.folder import load_sweep
from reports.sweep.held import Held, all_held, sentence, splits
from reports.sweep.scatter import means
from reports.sweep.verdict import headline

PARAMETER = VariedParameter(name="p", label="stiffness", unit="MPa", display_factor=1e-6, kind="list")
OTHER = VariedParameter(name="o", label="angle", unit="deg", display_factor=1.0, kind="list")
OUTPUT = KeptOutput(name="e", label="error", unit="%", display_factor=100.0)


def _table(sweep: Any, key: str) -> Table:
    return next(b for b in sweep_report(sweep).blocks() if isinstance(b, Table) and b.key == key)


def _plain(text: str) -> str:
    return text.replace("\u00a0", " ")


def _held(stiffness: list[float], angle: list[float], errors: list[float]) -> Held:
    samples = pd.DataFrame({"sample": range(len(errors)), "p": stiffness, "o": angle, "e": errors})
    band = OutputBand(limit=0.02, reason="r")
    return Held("local", OUTPUT, band, np.abs(samples["e"].to_numpy()) <= band.limit, samples)


def test_one_parameter_that_decides_is_named_with_the_border() -> None:
    found = _held([1e6, 2e6, 3e6, 4e6], [1, 2, 1, 2], [0.0, 0.01, 0.03, -0.04])
    assert _plain(sentence(found, [OTHER, PARAMETER])) == (
        "local: the band on the error (≤ 2.00 %) holds in 2 of 4 samples: in all with stiffness ≤ 2.00 MPa "
        "and in none with ≥ 3.00 MPa."
    )


def test_a_band_that_holds_at_high_values_is_said_the_other_way_around() -> None:
    found = _held([1e6, 2e6, 3e6, 4e6], [1, 2, 1, 2], [0.04, 0.03, 0.01, 0.0])
    assert "in all with stiffness ≥ 3.00 MPa and in none with ≤ 2.00 MPa" in _plain(
        sentence(found, [PARAMETER, OTHER])
    )


def test_a_parameter_that_decides_in_part_says_for_how_many() -> None:
    found = _held([1e6, 2e6, 3e6, 3e6, 4e6], [5, 5, 1, 2, 5], [0.0, 0.0, 0.01, 0.03, 0.05])
    said = _plain(sentence(found, [PARAMETER]))
    assert "in all 2 with stiffness ≤ 2.00 MPa and in none of the 1 with stiffness = 4.00 MPa" in said
    assert said.endswith("elsewhere it depends on the others.")


def test_no_parameter_that_decides_is_said() -> None:
    errors = [0.03 if k in (0, 19) else 0.01 * (k % 2) + 0.015 for k in range(20)]
    stiffness = [1e6 * (1 + k // 2) for k in range(20)]
    assert "no single parameter decides" in sentence(_held(stiffness, [1] * 20, errors), [PARAMETER])


@pytest.mark.parametrize(("errors", "word"), [([0.0, 0.01], "every one"), ([0.03, 0.04], "none")])
def test_all_or_none(errors: list[float], word: str) -> None:
    assert f"holds in {word} of 2 samples; nearest to the limit is" in sentence(
        _held([1e6, 2e6], [1, 1], errors), [PARAMETER]
    )


def test_every_border_is_true_of_the_samples(tmp_path: Path) -> None:
    synthetic.write(tmp_path / "s", synthetic.Setup(kind="latin_hypercube"))
    sweep = load_sweep(tmp_path / "s")
    checked = 0
    for found in all_held(sweep):
        for split in splits(found, sweep.study.parameters):
            values = found.samples[split.parameter.name].to_numpy()
            sign = 1 if split.below else -1
            held = sign * values <= sign * split.holds[1] if split.holds[0] else np.zeros(len(values), bool)
            failed = sign * values >= sign * split.fails[1] if split.fails[0] else np.zeros(len(values), bool)
            assert (held.sum(), failed.sum()) == (split.holds[0], split.fails[0])
            assert found.ok[held].all()
            assert not found.ok[failed].any()
            checked += 1
    assert checked == 2 * 3 * 2


def test_the_table_of_bands_counts_the_samples(tmp_path: Path) -> None:
    table = synthetic.write(tmp_path / "s")
    rows = {row[2]: row for row in _table(load_sweep(tmp_path / "s"), "bands").rows}
    done = table[table["status"] == "ok"]
    for name, label in (("radius_rms_error", "RMS"), ("radius_max_error", "largest")):
        sizes = done[name].abs()
        row = rows[f"{label} error of the lumen radius"]
        assert row[4] == f"{(sizes <= synthetic.LIMIT).sum()} of {len(done)}"
        assert float(row[5].split("\u00a0")[0]) == pytest.approx(100 * sizes.median(), rel=5e-3)
        assert float(row[6].split("\u00a0")[0]) == pytest.approx(100 * sizes.max(), rel=5e-3)
        assert int(row[7]) == table["sample"][sizes.idxmax()]
        assert row[1] == "FAIL"


def test_the_headline_counts_samples_within_all_bands(
    tmp_path: Path, pdf_text: Callable[[Path], str], undrawn: None
) -> None:
    table = synthetic.write(tmp_path / "s")
    _, pdf = write_sweep_page(tmp_path / "s")
    done = table[table["status"] == "ok"]
    within = (done[["radius_rms_error", "radius_max_error"]].abs() <= synthetic.LIMIT).all(axis=1)
    text = _plain(pdf_text(pdf))
    assert f"{within.sum()} of {len(done)} judged samples ({100 * within.mean():.2f} %)" in text
    assert "2 samples of 64 (3.12 %) failed" in text or "2 samples of 64 (3.13 %) failed" in text
    assert "not against 3D" in text


def test_failed_samples_are_listed_with_their_errors(tmp_path: Path) -> None:
    synthetic.write(tmp_path / "s")
    rows = _table(load_sweep(tmp_path / "s"), "failed").rows
    assert [row[0] for row in rows] == ["5", "11"]
    assert all(row[-1] == "the flow became supercritical at i = 61" for row in rows)


def test_samples_of_any_order_of_parts_are_put_in_their_own(tmp_path: Path) -> None:
    synthetic.write(tmp_path / "s")
    assert load_sweep(tmp_path / "s").samples["sample"].tolist() == list(range(64))


@pytest.fixture(scope="module")
def with_indices(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of a sweep with Sobol indices and its page."""
    folder = tmp_path_factory.mktemp("with indices") / "s"
    synthetic.write(folder, synthetic.Setup(kind="saltelli", indices=True))
    write_sweep_page(folder)
    return folder


@pytest.mark.slow
def test_indices_are_those_of_the_study(with_indices: Path, pdf_text: Callable[[Path], str]) -> None:
    sweep = load_sweep(with_indices)
    rows = _table(sweep, "indices-1-table").rows
    assert [_plain(text) for text in rows[0][1:]] == [
        "Young's modulus of the calcification",
        "0.600",
        "± 0.050",
        "0.700",
        "± 0.060",
    ]
    assert "largest error of the lumen radius" not in {row[0] for row in rows}  # it has no index
    text = _plain(pdf_text(with_indices / "index.pdf"))
    assert "most by Young's modulus of the calcification (ST 0.70 ± 0.06)" in text.replace("’", "'")


def test_a_running_sweep_without_bands_or_indices_has_a_page(tmp_path: Path) -> None:
    setup = synthetic.Setup(
        kind="sobol", state="running", against=None, failures=(), variants={"a": "", "b": ""}
    )
    synthetic.write(tmp_path / "s", setup)
    html = unescape(write_sweep_page(tmp_path / "s")[0].read_text(encoding="utf-8"))
    assert "The sweep is running" in html
    assert "no band judges them" in html
    assert "compared with nothing" in html
    assert "The design gives no Sobol indices" in html


@pytest.mark.slow
def test_the_page_is_the_same_for_the_same_folder(with_indices: Path) -> None:
    first = [(with_indices / name).read_bytes() for name in ("index.html", "index.pdf")]
    assert first == [path.read_bytes() for path in write_sweep_page(with_indices)]
    assert {path.name for path in with_indices.iterdir()} == {
        "index.html",
        "index.pdf",
        "samples",
        "study.json",
        "study.yaml",
    }


def test_the_pages_numbers_are_the_samples_in_display_units(tmp_path: Path) -> None:
    table = synthetic.write(tmp_path / "s")
    page = page_data(load_sweep(tmp_path / "s"))
    done = table[table["status"] == "ok"]
    assert page["sample"] == done["sample"].tolist()
    np.testing.assert_allclose(
        page["parameters"][0]["values"], 1e-6 * done["calcification.youngs_modulus"], rtol=1e-5
    )
    assert page["outputs"][1]["limits"] == [pytest.approx(2.0)]
    assert page["outputs"][0]["limits"] == [None]


def _run(monkeypatch: pytest.MonkeyPatch, *directories: Path) -> int:
    monkeypatch.setattr("sys.argv", ["reports", *map(str, directories)])
    return main()


def test_the_command_recognises_a_sweep(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], undrawn: None
) -> None:
    synthetic.write(tmp_path / "s")
    assert _run(monkeypatch, tmp_path / "s") == 0
    assert capsys.readouterr().out == f"{tmp_path / 's' / 'index.html'}\n{tmp_path / 's' / 'index.pdf'}\n"


def test_a_gallery_leads_to_sweeps_the_worst_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, undrawn: None
) -> None:
    synthetic.write(tmp_path / "fine", synthetic.Setup(against=None, title="fine"))
    synthetic.write(tmp_path / "bad", synthetic.Setup(title="bad"))
    assert _run(monkeypatch, tmp_path / "fine", tmp_path / "bad") == 0
    page = (tmp_path / "gallery.html").read_text(encoding="utf-8")
    assert re.findall(r'<h2 id="case-\d"><a href="([^"]+)">', page) == ["bad/index.html", "fine/index.html"]
    for link in re.findall(r'href="([^"]+)"', page):
        assert (tmp_path / link).exists()


def _edit(change: Callable[[dict[str, Any]], None]) -> Callable[[Path], None]:
    def edit(directory: Path) -> None:
        path = directory / "study.json"
        content = json.loads(path.read_text())
        change(content)
        path.write_text(json.dumps(content))

    return edit


def _without_samples(directory: Path) -> None:
    for path in (directory / "samples").iterdir():
        path.unlink()


def _torn(directory: Path) -> None:
    path = directory / "samples" / "part-000001.parquet"
    path.write_bytes(path.read_bytes()[:100])


def _doubled(directory: Path) -> None:
    part = directory / "samples" / "part-000001.parquet"
    (directory / "samples" / "part-000002.parquet").write_bytes(part.read_bytes())


def _text_column(directory: Path) -> None:
    for path in (directory / "samples").iterdir():
        pd.read_parquet(path).assign(radius_rms_error="much").to_parquet(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_without_samples, "samples: no sample is recorded yet"),
        (_torn, "cannot be read as Parquet"),
        (_doubled, "sample 0 is recorded twice"),
        (_text_column, "radius_rms_error is of type .*; numbers are expected"),
        (_edit(lambda s: s.pop("title")), r"study\.json: without title"),
        (_edit(lambda s: s.update(state="gone")), r"study\.json: state: .*found 'gone'"),
        (_edit(lambda s: s.update(variants={"ring": ""})), "variant 'local'; ring are allowed"),
        (
            _edit(lambda s: s["outputs"].append({**s["outputs"][0], "name": "wall_shear"})),
            "without column wall_shear",
        ),
    ],
)
def test_a_folder_that_does_not_fit_is_refused(
    tmp_path: Path, change: Callable[[Path], None], message: str
) -> None:
    synthetic.write(tmp_path / "s")
    change(tmp_path / "s")
    with pytest.raises(ReportError, match=message):
        write_sweep_page(tmp_path / "s")
    assert not (tmp_path / "s" / "index.html").exists()


def test_means_are_of_equal_values_or_of_neighbours() -> None:
    x, y = np.array([2.0, 1.0, 2.0, 1.0]), np.array([5.0, 1.0, 7.0, 3.0])
    assert [part.tolist() for part in means(x, y)] == [[1.0, 2.0], [2.0, 6.0]]
    many = np.linspace(0.0, 1.0, 90)
    at, of = means(many, 2 * many)
    assert len(at) <= 12
    np.testing.assert_allclose(of, 2 * at)
    assert means(x, np.full(4, np.nan))[0].size == 0


def test_amounts_have_their_unit_and_powers_of_ten() -> None:
    resistance = VariedParameter(name="r", label="R", unit="Pa s/m^3", display_factor=1.0, kind="list")
    assert _plain(amount(resistance, 1.2e9)) == "1.20 · 10⁹ Pa s/m³"
    assert _plain(amount(PARAMETER, 2.5e6)) == "2.50 MPa"
    assert amount(PARAMETER, None) == "—"
    assert _plain(amount(OTHER, -3e-7)) == "−3.00 · 10⁻⁷ deg"
    assert axis_label(resistance) == "R (Pa s/m³)"


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (12043.9, 12043.9, "12.0 kPa (does not vary)"),
        (12043.939, 12043.9435, "12.0 kPa (varies by less than 0.01 %)"),
        (12043.0, 12089.0, "12.04 kPa … 12.09 kPa"),
        (100.0, 12000.0, "0.100 kPa … 12.0 kPa"),
        (0.0, 0.0, "0 kPa (does not vary)"),
    ],
)
def test_a_range_has_the_digits_that_it_needs(low: float, high: float, text: str) -> None:
    output = KeptOutput(name="pressure", label="pressure", unit="kPa", display_factor=1e-3)
    assert _plain(ends(output, low, high)) == text


def test_errors_lead_where_no_band_judges_them(tmp_path: Path) -> None:
    synthetic.write(tmp_path, synthetic.Setup())
    study = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))
    for output in study["outputs"]:
        output["band"] = None
    (tmp_path / "study.json").write_text(json.dumps(study), encoding="utf-8")
    sweep = load_sweep(tmp_path)
    said = _plain(headline(sweep, ()))
    assert "no band judges them. Median and largest error: RMS error of the lumen radius" in said
    data = page_data(sweep)
    assert data["outputs"][data["start"]]["label"] == "RMS error of the lumen radius"
    assert _table(sweep, "outputs").rows[0][0] == "RMS error of the lumen radius"
