"""FEBio's log files."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from log_samples import (
    BANNER,
    ERROR,
    NORMAL,
    begin,
    box,
    converged,
    failed,
    iteration,
    record,
    sample_log,
)
from numpy.testing import assert_array_equal

from febio_io.command import main
from febio_io.errors import FebioError, FebioFileError, FebioFormatError, FebioKeyError
from febio_io.text.log import read_log


@pytest.fixture
def log_of(write):
    return lambda text: read_log(write(text.encode(), "run.log"))


def test_head_of_the_log(log_of):
    log = log_of(sample_log())
    assert log.version == "4.8.0"
    assert log.files == {"Input file": "run.feb", "Plot file": "run.xplt", "Log file": "run.log"}
    assert [(item.section, item.item, item.name, item.value) for item in log.inputs] == [
        ("MATERIAL DATA", "1 - Blood (type: fluid-FSI) / fluid: (type: fluid)", "density", "1060"),
        ("MATERIAL DATA", "2 - Wall (type: neo-Hookean)", "E", "600000"),
    ]


def test_time_steps_tell_attempts_and_analysis_steps_apart(log_of):
    log = log_of(sample_log())
    steps = [(s.analysis_step, s.number, s.attempt, s.time, s.outcome) for s in log.time_steps]
    assert steps == [
        (1, 1, 1, 0.1, "failed"),
        (1, 1, 2, 0.05, "converged"),
        (2, 1, 1, 0.15, "converged"),
    ]
    assert [step.n_iterations for step in log.time_steps] == [1, 2, 2]
    assert [step.n_augmentations for step in log.time_steps] == [0, 0, 1]
    assert (log.n_converged, log.n_retries, log.n_iterations) == (2, 1, 5)
    assert (log.n_equations, log.n_nonzeros) == (1872, 186332)
    table = log.steps_table()
    assert table["outcome"].tolist() == ["failed", "converged", "converged"]
    assert table["n_reformations"].tolist()[1:] == [1, 1]


def test_iterations_have_their_norms(log_of):
    last = log_of(sample_log()).time_steps[1].iterations[-1]
    assert (last.number, last.time, last.stiffness_updates, last.right_hand_sides) == (2, 0.05, 1, 3)
    assert (last.reformations, last.line_search_step) == (1, 0.5)
    assert list(last.norms) == ["residual", "energy"]
    assert (last.norms["residual"].current, last.norms["residual"].required) == (1e-4, 1e-3)
    assert math.isnan(last.norms["energy"].current)


def test_boxes_are_messages_of_a_kind(log_of):
    long = "Negative jacobian was detected at element 7 at gauss point 1,"
    text = BANNER + box("Hello") + box(long, "jacobian = -0.1", title="ERROR") + ERROR
    log = log_of(text)
    assert [(message.kind, message.text) for message in log.messages] == [
        ("info", "Hello"),
        ("error", f"{long} jacobian = -0.1"),
    ]
    assert text.splitlines()[log.errors[0].line - 1].strip().startswith("***")
    assert log.warnings == ()


def test_a_box_that_is_cut_off_swallows_nothing(log_of):
    cut = "\n".join(box("Half", title="WARNING").splitlines()[:3]) + "\n"
    log = log_of(BANNER + cut + begin(1, 0.1) + converged(0.1))
    assert [message.text for message in log.warnings] == ["Half"]
    assert log.n_converged == 1


@pytest.mark.parametrize(("end", "termination"), [(NORMAL, "normal"), (ERROR, "error"), ("", "none")])
def test_how_the_run_ended(log_of, end, termination):
    assert log_of(BANNER + begin(1, 0.1) + end).termination == termination


def test_an_unfinished_step(log_of):
    log = log_of(BANNER + begin(1, 0.1) + iteration(1, 0.1) + " 2\n")
    (step,) = log.time_steps
    assert (step.outcome, step.n_iterations, len(step.iterations)) == ("unfinished", 2, 1)


def test_steps_that_are_not_told_apart_by_an_end(log_of):
    text = BANNER + begin(1, 0.1) + converged(0.1) + begin(1, 0.2) + failed(0.2) + begin(1, 0.15)
    steps = [(s.analysis_step, s.attempt) for s in log_of(text).time_steps]
    assert steps == [(1, 1), (2, 1), (2, 2)]


def test_totals_and_timings(log_of):
    log = log_of(sample_log())
    assert [total["Number of time steps completed"] for total in log.totals] == [2, 2]
    assert log.timings == {"Solve time": 2.5, "Total elapsed time": 3.01782}
    assert log.elapsed == 3.01782
    assert log.peak_memory is None
    assert log_of(BANNER + "\n Peak memory  : 512.5 MB\n").peak_memory == 512.5


def test_old_versions_are_spaced_out(log_of):
    old = BANNER.replace("  version 4.8.0.0a1b2c3", "  --- v e r s i o n - 1 . 7 . 1 . 4800 ---")
    assert log_of(old).version == "1.7.1.4800"


def test_data_records_in_the_log(log_of):
    log = log_of(sample_log())
    assert [(item.number, item.name, item.file) for item in log.records] == [
        (1, "x;y", None),
        (2, "stress", "stress.txt"),
    ]
    data = log.data_record(1).to_xarray()
    assert_array_equal(data["x"], [[0, 1], [0.5, 1.5]])
    assert_array_equal(data["time"], [0, 0.05])
    with pytest.raises(FebioKeyError, match=r"record 2 are in stress\.txt"):
        log.data_record(2)
    with pytest.raises(FebioKeyError, match="no data record 3; the log has 1, 2"):
        log.data_record(3)


def test_a_line_that_febio_cut_is_refused_by_its_number(log_of):
    text = BANNER + record(1, 0, 0, "x;y", "1 0 0", "2 1")
    log = log_of(text)
    line = text.splitlines().index("2 1") + 1
    with pytest.raises(FebioFormatError, match=f"line {line}: 1 values where 2 are expected"):
        log.data_record(1)


@pytest.mark.parametrize("missing", range(1, 9))
def test_a_record_cut_off_by_a_kill_ends_with_its_last_whole_block(log_of, missing):
    blocks = [record(1, step, step, "x;y", "1 0 0", "2 1 0") for step in range(3)]
    values = log_of(BANNER + "".join(blocks).rstrip("\n")[:-missing]).data_record(1)
    assert values.times.tolist() == [0, 1]


def test_norms_that_windows_writes_are_kept(shared_data):
    log = read_log(shared_data / "inputs_that_fail" / "log_norm_nan_windows.log")
    (iteration_,) = log.time_steps[0].iterations
    assert list(iteration_.norms) == ["residual", "energy"]
    assert math.isnan(iteration_.norms["residual"].current)
    assert iteration_.norms["residual"].initial == 1.0


@pytest.mark.parametrize("word", ["Time in solver", "Time in linear solver"])
def test_times_of_old_versions(log_of, word):
    text = begin(1, 1) + f"\t{word}: 0:01:30\n\n Elapsed time : 1:02:03\n\n{NORMAL}"
    log = log_of(text)
    assert (log.elapsed, log.timings["time in linear solver"]) == (3723.0, 90.0)
    timed = log_of(f"{text}\tTotal elapsed time .............. : 1:02:03 (3723.5 sec)\n")
    assert timed.timings == {"Total elapsed time": 3723.5}


def test_the_small_log_of_an_old_version(shared_data):
    assert read_log(shared_data / "inputs_that_fail" / "log_old_elapsed.log").elapsed == 120.0


ALONE = BANNER.partition(" FILES USED")[0]


@pytest.mark.parametrize("text", [ALONE, f"Notes\n{ALONE}version 9.9\n", "it lists\n  FILES USED by FEBio\n"])
def test_a_banner_alone_is_no_log(log_of, text):
    with pytest.raises(FebioFileError, match="not an FEBio log"):
        log_of(text)


def test_release_notes_are_no_log(shared_data, capsys):
    assert main([str(shared_data / "inputs_that_fail" / "not_a_log_release_notes.txt")]) == 2
    assert "not an FEBio plot file, log, data record or model" in capsys.readouterr().err


def test_other_files_are_refused(write, tmp_path):
    with pytest.raises(FebioFileError, match="not an FEBio log"):
        read_log(write(b"Dear diary\n", "diary.log"))
    with pytest.raises(FebioFileError, match="cannot be opened"):
        read_log(tmp_path / "none.log")


@pytest.mark.parametrize("name", ["none", "axisymmetric", "local", "tiny_raw", "tiny_zlib"])
def test_real_logs_agree_with_their_own_totals(shared_data, name):
    log = read_log(shared_data / "febio" / f"{name}.log")
    (totals,) = log.totals
    assert (log.version, log.termination, log.errors) == ("4.11.0", "normal", ())
    assert log.n_converged == len(log.time_steps) == totals["Number of time steps completed"]
    assert log.n_iterations == totals["Total number of equilibrium iterations"]
    reformations = sum(step.n_reformations for step in log.time_steps)
    assert reformations == totals["Total number of stiffness reformations"]
    assert all(len(step.iterations) == step.n_iterations for step in log.time_steps)
    assert [item.file for item in log.records] == [f"{name}_axis_nodes.txt", f"{name}_mid_elements.txt"]
    assert all(np.isfinite(value) for value in log.timings.values())
    materials = {item.item.split(" / ")[0] for item in log.inputs if item.section == "MATERIAL DATA"}
    assert {"1 - Blood (type: fluid-FSI)", "2 - Healthy (type: isotropic elastic)"} <= materials


PIECES = sample_log().splitlines(keepends=True)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.one_of(st.sampled_from(PIECES), st.text(max_size=30)), max_size=40), st.integers(0, 30))
def test_shuffled_logs_raise_only_errors_of_the_family(write, pieces, cut):
    path = write((BANNER + "".join(pieces))[: -cut or None].encode("utf-8", "surrogatepass"), "run.log")
    log = read_log(path)
    log.steps_table()
    for item in log.records:
        try:
            log.data_record(item.number).to_xarray()
        except FebioError as error:
            assert str(path) in str(error)  # noqa: PT017


@pytest.mark.parametrize(
    "line", ["." * 30_000, "x" + " " * 30_000 + "x", "\t x" + " " * 30_000 + "x", " " * 30_000]
)
@pytest.mark.parametrize("before", ["", "===== beginning time step 1 : 0.1 =====\n"])
def test_long_lines_take_no_more_than_linear_time(write, before, line):
    # Quadratic time would be minutes for these, beyond any limit on a test.
    log = read_log(write(f" FILES USED\n{before}{(line + chr(10)) * 20}".encode(), "run.log"))
    assert log.inputs == ()
