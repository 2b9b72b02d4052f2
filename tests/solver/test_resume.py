"""An interrupted run goes on to the very bytes of one that was not."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import solver.command as command
import solver.runs.resumable as running
from solver.runs.files import pieces_folder

ROOT = Path(__file__).parents[2]
BOUNDARIES = {
    "resistance": "outlet: {kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}",
    "windkessel": "outlet: {kind: windkessel, proximal_resistance: 1e8 Pa s/m^3, "
    "distal_resistance: 5e9 Pa s/m^3, compliance: 1e-10 m^3/Pa}",
    "non_reflecting": "outlet: {kind: non_reflecting}",
}


class Interrupting:
    """Stands for the progress bar; raises KeyboardInterrupt after some states."""

    def __init__(self, after):
        self.left = after

    def __call__(self, _):
        return self

    def __enter__(self):
        return self.told

    def __exit__(self, *_):
        return None

    def told(self, *_):
        self.left -= 1
        if self.left == 0:
            raise KeyboardInterrupt


@pytest.fixture
def run(monkeypatch, capsys):
    def with_arguments(*arguments, after=None):
        monkeypatch.setattr(sys, "argv", ["solver", *map(str, arguments)])
        with monkeypatch.context() as patched:
            patched.setattr(running, "PIECE", 4)
            if after is not None:
                patched.setattr("cases.shell.terminal.progress_bar", Interrupting(after))
            status = command.main()
        errors = capsys.readouterr().err.splitlines(keepends=True)
        return status, "".join(line for line in errors if "is not periodic yet" not in line)

    return with_arguments


def changed(case_file, old, new):
    text = case_file.read_text()
    assert old in text
    case_file.write_text(text.replace(old, new))


def assert_same_bytes(one, other):
    with xr.open_dataset(one) as a, xr.open_dataset(other) as b:
        assert set(a.variables) == set(b.variables)
        for name in a.variables:
            assert a[name].dtype == b[name].dtype
            assert a[name].to_numpy().tobytes() == b[name].to_numpy().tobytes(), name
            assert a[name].attrs == b[name].attrs
        assert {k: v for k, v in a.attrs.items() if k != "case_yaml"} == {
            k: v for k, v in b.attrs.items() if k != "case_yaml"
        }


@pytest.fixture(scope="module")
def wholes(tmp_path_factory):
    """Folder of runs that were not interrupted, for all the instants at which others were."""
    return tmp_path_factory.mktemp("wholes")


ADAPTIVE = pytest.param(" error_tolerance: 1e-4,", marks=pytest.mark.slow)


@pytest.mark.parametrize("control", ["", ADAPTIVE])
@pytest.mark.parametrize("outlet", list(BOUNDARIES))
@pytest.mark.parametrize("after", [3, 11, 20])
def test_interrupted_and_resumed(run, case_file, wholes, outlet, control, after):
    changed(case_file, BOUNDARIES["resistance"], BOUNDARIES[outlet])
    changed(case_file, "closure: average,", f"closure: average,{control}")
    variant = "patch"
    if outlet == "non_reflecting":  # no flow is steady in front of it, and rows that start from rest part
        variant = "healthy"
        changed(case_file, "closure: average,", "closure: average, start: rest,")
    whole, parts = wholes / f"{outlet}, {bool(control)}.nc", case_file.with_name("parts.nc")
    if not whole.exists():
        assert run(case_file, "--variant", variant, "--output", whole) == (0, "")
    status, _ = run(case_file, "--variant", variant, "--output", parts, after=after)
    assert status == 130
    assert not parts.exists()
    kept = sorted(path.name for path in pieces_folder(parts).glob("*.npz"))
    assert len(kept) == (after - 1) // 4
    assert run(case_file, "--variant", variant, "--output", parts, "--resume") == (0, "")
    assert_same_bytes(whole, parts)
    assert not pieces_folder(parts).exists()


@pytest.mark.slow
@pytest.mark.parametrize(("after", "outlet"), [(3, "resistance"), (11, "windkessel")])
def test_the_explicit_scheme_is_resumed_too(run, case_file, after, outlet):
    changed(case_file, BOUNDARIES["resistance"], BOUNDARIES[outlet])
    changed(case_file, "scheme: semi_implicit", "scheme: godunov")
    changed(case_file, "time_step: 2 ms, cycles: 2", "time_step: 23 us, cycles: 1")
    changed(case_file, "transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}")
    changed(case_file, "youngs_modulus: 10 MPa", "youngs_modulus: 0.7 MPa")
    whole, parts = case_file.with_name("whole.nc"), case_file.with_name("parts.nc")
    assert run(case_file, "--variant", "patch", "--output", whole) == (0, "")
    assert run(case_file, "--variant", "patch", "--output", parts, after=after)[0] == 130
    assert run(case_file, "--variant", "patch", "--output", parts, "--resume") == (0, "")
    assert_same_bytes(whole, parts)
    with xr.open_dataset(whole) as result:
        assert result.attrs["steps"] == round(0.2 / 23e-6)
        assert 0.1 < float(result["courant_number"].max()) < 1.0
        assert float(np.abs(result["mass_defect"]).max()) < 0.05


def test_interrupted_again_and_again(run, case_file):
    whole, parts = case_file.with_name("whole.nc"), case_file.with_name("parts.nc")
    run(case_file, "--variant", "patch", "--output", whole)
    assert run(case_file, "--variant", "patch", "--output", parts, after=6)[0] == 130
    for _ in range(3):
        assert run(case_file, "--variant", "patch", "--output", parts, "--resume", after=6)[0] == 130
    assert run(case_file, "--variant", "patch", "--output", parts, "--resume")[0] == 0
    assert_same_bytes(whole, parts)


def test_memory_holds_one_piece(run, case_file, monkeypatch):
    """What is collected at once is a piece, and what is held a few, whatever the number of states."""
    changed(case_file, "cycles: 2", "cycles: 9")
    sizes = []
    history_of = running.history_of

    def counted(stops):
        sizes.append(len(stops))
        return history_of(stops)

    leave = running._leave
    held = []

    def left(pieces):
        held.append(len(pieces))
        leave(pieces)

    monkeypatch.setattr(running, "history_of", counted)
    monkeypatch.setattr(running, "_leave", left)
    monkeypatch.setattr(running, "LARGEST", 2.5 * 4 * 12 * 8 * 8)  # bytes of two pieces and a half
    run(case_file, "--variant", "healthy", "--output", case_file.with_name("run.nc"))
    assert sum(sizes) == 91
    assert max(sizes) == 4
    assert held == [3] * 7
    with xr.open_dataset(case_file.with_name("run.nc")) as result:
        np.testing.assert_allclose(result["time"], np.arange(91) * 0.02, atol=1e-12)


def test_a_short_run_leaves_no_pieces(run, case_file, monkeypatch):
    written = []
    write = running._write
    monkeypatch.setattr(
        running, "_write", lambda path, piece: (written.append(path.name), write(path, piece))
    )
    whole, parts = case_file.with_name("whole.nc"), case_file.with_name("parts.nc")
    assert run(case_file, "--variant", "patch", "--output", whole) == (0, "")
    assert written == []
    monkeypatch.setattr(running, "SECONDS", 0.0)
    assert run(case_file, "--variant", "patch", "--output", parts) == (0, "")
    assert written == [f"{last:08d}.npz" for last in (3, 7, 11, 15, 19, 20)]
    assert whole.read_bytes() == parts.read_bytes()


def test_an_interrupt_of_the_result_keeps_every_piece(run, case_file, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    whole, parts = case_file.with_name("whole.nc"), case_file.with_name("parts.nc")
    with monkeypatch.context() as patched:
        patched.setattr(running, "append_netcdf", interrupt)
        assert run(case_file, "--variant", "patch", "--output", parts)[0] == 130
    assert not parts.exists()
    assert len(list(pieces_folder(parts).glob("*.npz"))) == 6
    assert run(case_file, "--variant", "patch", "--output", whole) == (0, "")
    assert run(case_file, "--variant", "patch", "--output", parts, "--resume") == (0, "")
    assert whole.read_bytes() == parts.read_bytes()


def test_an_interrupt_of_tidying_up_leaves_nothing_to_go_on_from(run, case_file, monkeypatch):
    def interrupt(folder, **_):
        (folder / "00000003.npz").unlink()
        raise KeyboardInterrupt

    whole, parts = case_file.with_name("whole.nc"), interrupted(run, case_file)
    assert run(case_file, "--variant", "patch", "--output", whole) == (0, "")
    with monkeypatch.context() as patched:
        patched.setattr(running.shutil, "rmtree", interrupt)
        assert run(case_file, "--variant", "patch", "--output", parts)[0] == 130
    status, errors = run(case_file, "--variant", "patch", "--output", parts, "--resume")
    assert (status, "no interrupted run to resume" in errors, parts.exists()) == (2, True, False)
    assert run(case_file, "--variant", "patch", "--output", parts) == (0, "")
    assert whole.read_bytes() == parts.read_bytes()


def test_a_piece_that_is_gone_is_missed(run, case_file, monkeypatch):
    """The result has all states of a run or is not written."""
    output = case_file.with_name("run.nc")
    left = running._leave
    monkeypatch.setattr(running, "SECONDS", 0.0)

    def gone(held):
        left(held)
        monkeypatch.setattr(running, "SECONDS", 1e9)
        (pieces_folder(output) / "00000003.npz").unlink()

    monkeypatch.setattr(running, "_leave", gone)
    missing = pieces_folder(output) / "00000003.npz"
    expected = (2, f"{missing}: cannot be read: No such file or directory\n")
    assert run(case_file, "--variant", "patch", "--output", output) == expected
    assert not output.exists()


def test_a_full_disk_is_told(run, case_file, monkeypatch):
    def full(*_):
        raise RuntimeError("NetCDF: HDF error")

    output = case_file.with_name("run.nc")
    monkeypatch.setattr(running, "append_netcdf", full)
    expected = (2, f"{output}: cannot be written: NetCDF: HDF error\n")
    assert run(case_file, "--variant", "patch", "--output", output) == expected
    assert not output.exists()


def interrupted(run, case_file):
    output = case_file.with_name("run.nc")
    assert run(case_file, "--variant", "patch", "--output", output, after=10)[0] == 130
    return output


def refused(run, case_file, output, variant="patch"):
    before = {path.name: path.read_bytes() for path in pieces_folder(output).iterdir()}
    status, errors = run(case_file, "--variant", variant, "--output", output, "--resume")
    assert status == 2
    assert errors == (
        f"{pieces_folder(output)}: belongs to another case, variant, model or version; run without --resume\n"
    )
    assert {path.name: path.read_bytes() for path in pieces_folder(output).iterdir()} == before


def test_another_variant_is_refused(run, case_file):
    refused(run, case_file, interrupted(run, case_file), "healthy")


def test_another_case_is_refused(run, case_file):
    output = interrupted(run, case_file)
    changed(case_file, "0.003 Pa s", "0.0035 Pa s")
    refused(run, case_file, output)


def test_another_waveform_is_refused(run, case_file):
    output = interrupted(run, case_file)
    changed(case_file.with_name("inlet.csv"), "0.05,20", "0.05,21")
    refused(run, case_file, output)


def test_nothing_to_resume(run, case_file):
    output = case_file.with_name("run.nc")
    status, errors = run(case_file, "--variant", "patch", "--output", output, "--resume")
    assert status == 2
    assert errors == f"{pieces_folder(output)}: no interrupted run to resume; run without --resume\n"
    assert not pieces_folder(output).exists()


def test_a_new_run_does_not_take_up_old_pieces(run, case_file):
    output = interrupted(run, case_file)
    changed(case_file, "0.003 Pa s", "0.0035 Pa s")
    assert run(case_file, "--variant", "patch", "--output", output)[0] == 0
    whole = case_file.with_name("whole.nc")
    run(case_file, "--variant", "patch", "--output", whole)
    assert_same_bytes(whole, output)


AT_ONCE = """
from cases.shell.command import run
import solver.runs.resumable as running
running.SECONDS = 0.0  # leave every piece at once
raise SystemExit(run("solver.command"))
"""


@pytest.mark.slow
def test_a_killed_run_goes_on(case_file, monkeypatch):
    """SIGKILL leaves no time to tidy up; a half-written piece is not taken up."""
    changed(case_file, "cycles: 2", "cycles: 20")
    outputs = [case_file.with_name(name) for name in ("whole.nc", "killed.nc")]

    def arguments(output):
        return [sys.executable, "-c", AT_ONCE, str(case_file), "--variant", "patch", "--output", str(output)]

    killed = subprocess.Popen(arguments(outputs[1]), cwd=ROOT, stderr=subprocess.DEVNULL)  # noqa: S603
    while len(list(pieces_folder(outputs[1]).glob("*.npz"))) < 2 and killed.poll() is None:
        time.sleep(0.002)
    killed.kill()
    assert killed.wait() == -signal.SIGKILL
    assert not outputs[1].exists()
    (pieces_folder(outputs[1]) / "00000199.part").write_bytes(b"half a piece")
    monkeypatch.chdir(ROOT)
    assert command.main(arguments(outputs[0])[3:]) == 0
    assert command.main([*arguments(outputs[1])[3:], "--resume"]) == 0
    assert_same_bytes(*outputs)
    assert not pieces_folder(outputs[1]).exists()
