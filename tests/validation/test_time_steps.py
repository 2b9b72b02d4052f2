"""The time step of a sweep and of a calibration: the longest that keeps a tolerance, and how it is told."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from pandas.testing import assert_frame_equal
from small_case import small_case, written
from small_sweep import small_study, study_file, swept

from cases.errors import CaseFileError
from cases.reading.calibration_file import load_calibration
from cases.results.sweep import ChosenTimeStep
from reports.sweep import write_sweep_page
from validation.calibrate import command as calibrate
from validation.runs.time_step import SAFETY, at_step, chosen, takes_equal_steps
from validation.sweep.chunk import Plan, run_chunk
from validation.sweep.command import main
from validation.sweep.samples import samples_of_study
from validation.sweep.standards import Standard
from validation.sweep.study import load_study
from validation.sweep.time_steps import words

MODULUS = "calcification.youngs_modulus"
TIMES = np.linspace(0.0, 1.0, 101)  # s, a state every 10 ms
FINE = {"solver": {"time_step": "1 ms"}}


def second_order(factor):
    """A number whose error is factor × Δt², Δt in s."""
    return lambda step: np.array([[1.0 + factor * (0.01 / np.ceil(0.01 / step * (1 - 1e-9))) ** 2]])


def ones(values):
    return np.ones(values.shape[1])


def test_steps_divide_the_time_between_states_and_are_at_most_eight_times_the_cases_own():
    def longest(own, interval):
        return chosen(own, np.arange(5) * interval, 0.0, lambda _: np.ones((1, 1)), ones, 1e-3).time_step

    assert longest(1e-3, 0.00797) == pytest.approx(0.00797)
    assert longest(1e-3, 0.02) == pytest.approx(0.02 / 3)  # 8 ms does not divide it
    assert longest(4e-3, 2e-3) == 4e-3


def test_times_before_the_last_cycle_do_not_count():
    times = np.concatenate([np.linspace(0.0, 0.9, 10), np.linspace(1.0, 2.0, 401)])
    assert chosen(1e-3, times, 1.0, lambda _: np.ones((1, 1)), ones, 1e-3).time_step == pytest.approx(2.5e-3)


@pytest.mark.parametrize(
    ("limit", "pieces"),  # of the 10 ms between two states
    [(1e-3, 2), (5e-4, 3), (2.6e-4, 4), (7e-5, 8), (4.1e-5, 10), (1e-5, 10)],
)
def test_the_longest_step_that_keeps_the_tolerance_is_chosen(limit, pieces):
    expected = 0.01 / pieces
    factor = 40.0 / SAFETY  # errors with a factor of safety 1e-3, 4.4e-4, 2.5e-4, …
    found = chosen(1e-3, TIMES, 0.0, second_order(factor), ones, 1.001 * limit)
    assert found.time_step == pytest.approx(expected)
    assert found.error == pytest.approx(SAFETY * factor * expected**2, rel=1e-6)


def test_no_step_is_run_twice():
    steps = []

    def numbers(step):
        steps.append(step)
        return second_order(1e6)(step)

    chosen(1.25e-3, TIMES, 0.0, numbers, ones, 1e-6)
    assert sorted(steps, reverse=True) == pytest.approx([0.01, 0.005, 0.0025, 0.00125, 0.000625])


def test_a_step_at_which_a_run_fails_is_not_chosen():
    def numbers(step):
        values = np.ones((3, 2))
        values[1] = np.nan if step > 3e-3 else 1.0
        return values

    assert chosen(1e-3, TIMES, 0.0, numbers, ones, 1e-3).time_step == pytest.approx(0.0025)
    always = chosen(1e-3, TIMES, 0.0, lambda _: np.full((3, 2), np.nan), ones, 1e-3)
    assert (always.time_step, always.error) == (1e-3, np.inf)


def test_an_explicit_or_adaptive_step_is_not_chosen(tmp_path):
    case = small_study(tmp_path).cases["local"]
    adaptive = case.model_copy(update={"solver": case.solver.model_copy(update={"error_tolerance": 1e-5})})
    assert takes_equal_steps(case)
    assert not takes_equal_steps(adaptive)
    godunov = {"solver": {"scheme": "godunov", "time_step": "10 us"}}
    explicit = small_study(tmp_path, "none", overrides=godunov, parameters={"inlet.scale": [1.0]})
    assert not takes_equal_steps(explicit.cases["none"])


def test_the_tolerance_is_on_unless_it_is_switched_off(tmp_path):
    def tolerance(**keys):
        return small_study(tmp_path, **keys).error_tolerance

    assert tolerance(error_tolerance=None) == 1e-3  # the key is left out
    assert tolerance(error_tolerance="none") is None
    assert tolerance(error_tolerance="0.5 %") == 5e-3
    path = study_file(tmp_path, error_tolerance=None)
    path.write_text(path.read_text(encoding="utf-8") + "error_tolerance:\n", encoding="utf-8")
    assert load_study(path).error_tolerance == 1e-3


@pytest.mark.parametrize("value", [0, -1e-3, 0.2, "1 mm", "off", True, [1e-3]])
def test_a_wrong_tolerance_is_one_message(tmp_path, capsys, value):
    path = study_file(tmp_path, error_tolerance=value)
    assert main([str(path), "--output", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "error_tolerance: " in told
    assert 'allowed: a ratio from 1e-6 to 0.1, e.g. "0.1 %", or none' in told
    assert not (tmp_path / "out").exists()


def calibration_file(folder, **keys):
    written(small_case("none"), folder)
    stated = {
        "name": "found",
        "case": "small.yaml",
        "parameters": {"outlet.offset": {"low": "1 kPa", "high": "20 kPa"}},
        "targets": [{"quantity": "systolic_pressure", "value": "16 kPa"}],
    }
    path = folder / "calibration.yaml"
    path.write_text(json.dumps(stated | keys), encoding="utf-8")
    return path


def test_a_calibration_has_the_same_key(tmp_path, capsys):
    assert load_calibration(calibration_file(tmp_path)).error_tolerance == 1e-3
    assert load_calibration(calibration_file(tmp_path, error_tolerance="none")).error_tolerance is None
    wrong = calibration_file(tmp_path, error_tolerance="1 s")
    with pytest.raises(CaseFileError, match="error_tolerance: 1 s"):
        load_calibration(wrong)
    assert calibrate.main([str(wrong), "--output", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_tolerance_that_is_missed_is_a_warning():
    choice = ChosenTimeStep(
        time_step_s=1e-3, case_time_step_s=1e-3, error=2e-3, output="radius_change", samples=4
    )
    assert words(choice, 1e-3) == (
        "warning: not even the case's own time step, 1 ms, keeps the tolerance (error 2.0e-03 of "
        "radius_change, by halving on 4 samples; error_tolerance: 0.001)"
    )
    assert words(choice.model_copy(update={"error": None}), 1e-3).startswith("warning: ")
    assert words(choice.model_copy(update={"time_step_s": 4e-3}), 3e-3).startswith("time step 4 ms (error ")


# ---------------------------------------------------------------------------------------- whole sweeps
KEEPING = {"parameters": {MODULUS: ["1 MPa", "5 MPa", "10 MPa"]}, "overrides": FINE, "error_tolerance": 1e-2}


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    folder = tmp_path_factory.mktemp("kept")
    study = small_study(folder, **KEEPING)
    return study, swept(study, folder / "out"), folder / "out"


def account(folder):
    return json.loads((folder / "study.json").read_text(encoding="utf-8"))


@pytest.mark.slow
def test_a_sweep_tells_its_step_and_keeps_the_tolerance(kept, tmp_path):
    study, found, folder = kept
    step = account(folder)["time_steps"]["local"]
    assert step["case_time_step_s"] == 1e-3
    assert 1e-3 < step["time_step_s"] <= 8e-3
    assert 0 < step["error"] <= 1e-2
    own = swept(small_study(tmp_path, **KEEPING | {"error_tolerance": "none"}), tmp_path / "own")
    assert account(tmp_path / "own")["time_steps"] == {}
    for output in study.outputs:
        if output.name.startswith(("systolic", "diastolic", "mean", "pulse", "radius", "flow")):
            np.testing.assert_allclose(found[output.name], own[output.name], rtol=1e-2)
    assert (found["pulse_pressure_inlet"] != own["pulse_pressure_inlet"]).all()
    write_sweep_page(folder)
    page = (folder / "index.html").read_text(encoding="utf-8")
    assert "the case states 1.00 ms): largest error" in page


@pytest.mark.slow
def test_the_samples_are_those_of_a_case_with_that_step(kept, tmp_path):
    _, found, folder = kept
    step = account(folder)["time_steps"]["local"]["time_step_s"]
    solver = {"solver": {"time_step": f"{step!r} s"}}
    same = swept(
        small_study(tmp_path, **KEEPING | {"error_tolerance": "none", "overrides": solver}), tmp_path / "out"
    )
    assert_frame_equal(found, same, check_exact=True)


@pytest.mark.slow
def test_twice_the_step_would_not_keep_it(kept, tmp_path):
    """Unless no longer one is tried: the estimate is that of an independent pair of runs."""
    study, _, folder = kept
    step = account(folder)["time_steps"]["local"]["time_step_s"]
    own = study.cases["local"].solver.time_step
    longer = 2.0 * step
    assert longer > 8.0 * own or _error(study, longer) > 1e-2


def _error(study, step):
    outputs = tuple(output for output in study.outputs if output.name == "pulse_pressure_inlet")
    plan = Plan((MODULUS,), outputs, {"local": Standard("none", "local")})
    middle = samples_of_study(study)[1]
    one, other = (
        run_chunk([replace(middle, case=at_step(middle.case, each))], plan)[0]["pulse_pressure_inlet"]
        for each in (step, step / 2)
    )
    return SAFETY * 4 / 3 * abs(one - other) / abs(other)


@pytest.mark.slow
def test_a_sweep_that_goes_on_takes_the_step_that_it_took(kept, tmp_path, monkeypatch):
    study, expected, folder = kept
    shutil.copytree(folder, tmp_path / "out")
    (tmp_path / "out/samples/part-000000.parquet").unlink()
    (tmp_path / "out/study.json").write_text(
        json.dumps(account(folder) | {"state": "interrupted"}), encoding="utf-8"
    )
    monkeypatch.setattr("validation.sweep.missing.chosen_steps", None)  # whoever calls it fails
    assert_frame_equal(swept(study, tmp_path / "out"), expected, check_exact=True)
    assert account(tmp_path / "out")["time_steps"] == account(folder)["time_steps"]


@pytest.mark.slow
def test_another_tolerance_is_another_sweep(kept, tmp_path, capsys):
    folder = kept[2]
    path = study_file(tmp_path, **KEEPING | {"error_tolerance": 2e-2})
    assert main([str(path), "--output", str(folder), "--scheduler", "threads"]) == 2
    assert "holds a sweep of another study" in capsys.readouterr().err


@pytest.mark.slow
def test_time_steps_that_are_varied_are_not_chosen(tmp_path):
    study = small_study(tmp_path, parameters={"solver.time_step": ["4 ms", "2 ms"]}, error_tolerance=1e-2)
    found = swept(study, tmp_path / "out")
    assert account(tmp_path / "out")["time_steps"] == {}
    assert found["pulse_pressure_inlet"].nunique() == 2


@pytest.mark.slow
def test_what_fails_with_the_step_is_run_with_the_cases_own(tmp_path):
    limits = {"solver": {"time_step": "1 ms", "limits": {"courant_number": 40}}}
    study = small_study(tmp_path, parameters={MODULUS: ["10 MPa"]}, overrides=limits)
    samples = samples_of_study(study).block([0])
    plan = Plan((MODULUS,), study.outputs, {"local": Standard("none", "local")}, {"local": 10e-3})
    (found,) = run_chunk(samples, plan)
    (own,) = run_chunk(samples, replace(plan, steps={}))
    strict = run_chunk([replace(samples[0], case=at_step(samples[0].case, 10e-3))], replace(plan, steps={}))
    assert strict[0]["status"] == "failed"
    assert found | {"seconds": 0.0} == own | {"seconds": 0.0}
    assert found["status"] == "ok"


@pytest.mark.slow
def test_a_step_at_which_a_sample_fails_is_not_that_of_a_sweep(tmp_path):
    """Runs stop above a Courant number: 10 and 5 ms are too long, though all errors are below 10 %."""
    limits = {"solver": {"time_step": "1.25 ms", "limits": {"courant_number": 45}}}
    keys = {"parameters": {MODULUS: ["10 MPa"]}, "overrides": limits}
    study = small_study(tmp_path, error_tolerance=0.1, **keys)
    (sample,) = samples_of_study(study).block([0])
    plan = Plan((MODULUS,), study.outputs, {"local": Standard("none", "local")})

    def status(step):
        return run_chunk([replace(sample, case=at_step(sample.case, step))], plan)[0]["status"]

    period = study.cases["local"].inlet.period
    longest = next(k for k in range(1, 9) if status(period / 100 / k) == "ok")
    assert longest > 1
    swept(study, tmp_path / "out")
    step = account(tmp_path / "out")["time_steps"]["local"]
    assert status(step["time_step_s"]) == "ok"
    assert step["error"] < 0.1


@pytest.mark.slow
def test_a_calibration_tells_its_step(tmp_path, capsys):
    path = calibration_file(tmp_path)
    text = path.read_text(encoding="utf-8")
    (tmp_path / "small.yaml").write_text(
        (tmp_path / "small.yaml").read_text(encoding="utf-8").replace("time_step: 4 ms", "time_step: 0.5 ms"),
        encoding="utf-8",
    )
    assert calibrate.main([str(path), "--output", str(tmp_path / "out")]) == 0
    record = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    step = record["time_step"]
    assert record["error_tolerance"] == 1e-3
    assert 0.5e-3 < step["time_step_s"] <= 4e-3
    assert step["error"] <= 1e-3
    assert "time step " in capsys.readouterr().out
    path.write_text(json.dumps(json.loads(text) | {"error_tolerance": "none"}), encoding="utf-8")
    assert calibrate.main([str(path), "--output", str(tmp_path / "off")]) == 0
    off = json.loads((tmp_path / "off/calibration.json").read_text(encoding="utf-8"))
    assert off["time_step"] is None
    assert off["parameters"][0]["value"] == pytest.approx(record["parameters"][0]["value"], rel=2e-2)
    assert off["parameters"][0]["value"] != record["parameters"][0]["value"]
