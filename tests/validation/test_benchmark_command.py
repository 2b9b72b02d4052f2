"""``python -m validation.benchmark`` gives a well-formed table; how fast is no matter here."""

import json

import pytest

from validation.benchmark import command as benchmark
from validation.benchmark import precision

pytestmark = pytest.mark.slow


@pytest.fixture
def tiny(tmp_path, monkeypatch):
    """The benchmark's case, on few cells and for a short cycle."""
    text = benchmark.CASE.read_text(encoding="utf-8")
    for old, new in (
        ("n_x: 120, n_phi: 48, time_step: 1 ms, cycles: 3", "n_x: 12, n_phi: 4, time_step: 1 ms, cycles: 1"),
        ("waveform: reference_data/waveforms/thesis_inlet.csv", "value: 8 cm/s, period: 20 ms"),
        ("time_step: 3.125 us", "time_step: 20 us"),
        ("youngs_modulus: 10 MPa", "youngs_modulus: 0.7 MPa"),
    ):
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "tiny.yaml"
    path.write_text(text, encoding="utf-8")
    monkeypatch.setattr(benchmark, "CASE", path)
    return path


@pytest.mark.parametrize(("quick", "repeat"), [pytest.param(False, 2, marks=pytest.mark.long), (True, 1)])
def test_every_row_is_measured_shown_and_kept(tiny, monkeypatch, capsys, quick, repeat):
    monkeypatch.setattr(benchmark, "QUICK_STEPS", 100)
    output = tiny.with_name("speed.json")
    arguments = ["--repeat", str(repeat), "--output", str(output), *(["--quick"] if quick else [])]
    assert benchmark.main(arguments) == 0
    shown = capsys.readouterr().out
    kept = json.loads(output.read_text(encoding="utf-8"))
    rows = {row["name"]: row for row in kept["rows"]}
    assert list(rows) == [
        "semi_implicit, none",
        "semi_implicit, axisymmetric",
        "semi_implicit, local",
        "godunov, local",
        "python -m solver, local",
    ]
    for name, row in rows.items():
        assert name in shown
        assert row["cells"] == 48
        assert row["median_s"] > 0
    for name in ("none", "axisymmetric", "local"):
        row = rows[f"semi_implicit, {name}"]
        assert (row["cores"], row["steps"], len(row["wall_s"])) == (1, 20, repeat)
        assert row["updates_per_s"] == pytest.approx(48 * 20 / row["median_s"])
        assert row["sweep_updates_per_s"] == pytest.approx(48 * row["sweeps"] / row["median_s"])
    explicit = rows["godunov, local"]
    assert (explicit["steps"], explicit["extrapolated"]) == (1000, quick)
    assert explicit["sweep_updates_per_s"] is None
    assert ("extrapolated" in shown) == quick
    assert kept["machine"]["cores"] >= 1
    assert {"created", "git_commit", "python", "versions"} <= set(kept)


@pytest.fixture
def coarse(tmp_path, monkeypatch):
    """The benchmark's case, on few cells."""
    text = benchmark.CASE.read_text(encoding="utf-8")
    path = tmp_path / "coarse.yaml"
    path.write_text(
        text.replace("n_x: 120, n_phi: 48", "n_x: 24, n_phi: 8")
        .replace("time_step: 3.125 us", "time_step: 12.5 us")
        .replace("reference_data/", f"{benchmark.ROOT}/reference_data/"),
        encoding="utf-8",
    )
    monkeypatch.setattr(benchmark, "CASE", path)
    return path


def test_work_and_precision_are_measured_drawn_and_kept(coarse, monkeypatch, capsys):
    monkeypatch.setattr(precision, "PIECES", (1, 2))
    monkeypatch.setattr(precision, "FINE_PIECES", 8)
    monkeypatch.setattr(precision, "GRIDS", (0.5, 1.0))
    monkeypatch.setattr(precision, "EXPLICIT_GRIDS", (0.5,))
    monkeypatch.setattr(precision, "STATES", 200)
    monkeypatch.setattr(precision, "TOLERANCES", (1e-2, 1e-6))
    monkeypatch.setattr(precision, "LOCAL_TOLERANCES", (1e-3, 1e-5))
    output = coarse.with_name("precision.json")
    assert benchmark.main(["--precision", "--repeat", "1", "--output", str(output)]) == 0
    kept = json.loads(output.read_text(encoding="utf-8"))
    points = kept["points"]
    assert [point for point in points if point["error"] is None] == []
    assert all(point["cpu_s"] > 0 for point in points)
    assert {(point["series"], point["model"]) for point in points} == {
        (series, model)
        for series in ("time steps", "grids", "local error", "error_tolerance")
        for model in ("row", "coupled")
    }
    assert {point["scheme"] for point in points} == {"semi_implicit", "godunov"}
    for model in ("row", "coupled"):
        for series in ("time steps", "local error"):
            line = [p["error"] for p in points if (p["series"], p["model"]) == (series, model)]
            assert line[1] < line[0]
        loose, strict = (p for p in points if (p["series"], p["model"]) == ("error_tolerance", model))
        assert loose["error"] < 1e-2
        assert loose["time_step"] > strict["time_step"] == 1e-3  # the case's own
    assert "<svg" in output.with_suffix(".svg").read_text(encoding="utf-8")
    assert "results: " in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments",
    [["--repeat", "0"], ["--output", "absent/speed.json"], ["--precision", "--quick"]],
)
def test_wrong_arguments_exit_2(arguments, capsys):
    with pytest.raises(SystemExit) as stop:
        benchmark.main(arguments)
    assert stop.value.code == 2
    assert arguments[1] in capsys.readouterr().err


def test_a_run_that_fails_is_one_line_and_writes_nothing(tiny, capsys):
    tiny.write_text(tiny.read_text().replace("value: 8 cm/s", "value: -80 m/s"), encoding="utf-8")
    output = tiny.with_name("speed.json")
    assert benchmark.main(["--repeat", "1", "--output", str(output)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not output.exists()
