"""Running FEBio, with a program that stands in for it."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from xplt_samples import sample_file

from febio_io.run import process
from febio_io.run.command import main
from febio_io.run.endings import explain_ending
from febio_io.run.process import FebioRunError, LogTail, find_febio
from febio_io.xplt import open_plot

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
STAND_IN = Path(__file__).parent / "febio_stand_in.py"
MODEL = """<?xml version="1.0"?>
<febio_spec version="4.0"><Module type="fluid-FSI"/>
<Control><time_steps>4</time_steps><step_size>0.1</step_size></Control>
<Material><material id="1" name="M" type="neo-Hookean"><density>1</density><E>1</E><v>0</v></material>
</Material>
<Mesh><Nodes><node id="1">0,0,0</node><node id="2">1,0,0</node><node id="3">0,1,0</node>
<node id="4">0,0,1</node></Nodes><Elements type="tet4" name="P"><elem id="1">1,2,3,4</elem></Elements></Mesh>
<MeshDomains><SolidDomain name="P" mat="M"/></MeshDomains></febio_spec>
"""


@pytest.fixture
def model(tmp_path):
    """A folder with a model, a program, and how that is to behave."""
    folder = tmp_path / "a run"
    folder.mkdir()
    (folder / "model.feb").write_text(MODEL)
    (folder / "real.xplt").write_bytes(sample_file(states=3))
    program = folder / "febio4"
    program.write_text(f"#!{sys.executable}\n" + STAND_IN.read_text())
    program.chmod(0o755)
    return folder / "model.feb"


@pytest.fixture
def run(model, capsys):
    def ended(behaviour, *options):
        (model.parent / "behaviour").write_text(behaviour)
        status = main([str(model), "--febio", str(model.parent / "febio4"), *options])
        said = capsys.readouterr()
        return status, said.out, said.err

    return ended


@pytest.fixture(autouse=True)
def handlers():
    before = signal.getsignal(signal.SIGTERM)
    yield
    signal.signal(signal.SIGTERM, before)


def test_a_run_that_ends_normally(run, model):
    status, out, err = run("normal", "--threads", "3")
    assert (status, err) == (0, "")
    assert out.startswith("normal termination: 4 time steps, 8 iterations, 0 retries, ")
    assert out.rstrip().endswith(f"wrote {model.with_suffix('.xplt')}, {model.with_suffix('.log')}")
    assert (model.parent / "threads").read_text() == "3"
    with open_plot(model.with_suffix(".xplt")) as plot:
        assert plot.n_states == 3


@pytest.mark.parametrize(
    ("behaviour", "said"),
    [
        (
            "error",
            r"model.log: FEBio ended with an error: Negative jacobian was detected. \(line \d+\); .*means",
        ),
        ("killed", r"model.log: FEBio was ended by signal 9 after 2 time steps, unfinished"),
        ("silent", r"FEBio ended with status 3 and wrote no log: on the screen"),
        ("no plot", r"model.log: FEBio ended normally, but model.xplt is missing"),
    ],
)
def test_a_run_that_fails(run, behaviour, said):
    status, out, err = run(behaviour)
    assert (status, out) == (1, "")
    assert len(err.splitlines()) == 1
    assert re.search(said, err)


def test_a_plot_file_that_is_cut_off_is_told(run, model):
    content = (model.parent / "real.xplt").read_bytes()
    (model.parent / "real.xplt").write_bytes(content[:-5])
    status, _, err = run("normal")
    assert status == 1
    assert "model.xplt is cut off after state 2" in err


def test_results_of_an_earlier_run_are_kept_unless_they_may_go(run, model):
    model.with_suffix(".log").write_text("earlier")
    status, _, err = run("normal")
    assert (status, "--force runs the model again" in err) == (2, True)
    assert model.with_suffix(".log").read_text() == "earlier"
    assert run("normal", "--force")[0] == 0


def test_a_model_with_problems_is_run_all_the_same(run, model):
    model.write_text(MODEL.replace("1,2,3,4<", "1,2,3,5<"))
    status, _, err = run("normal")
    assert status == 0
    assert err.startswith(f"warning: {model}: ")
    assert "node 5, which does not exist" in err


@pytest.mark.parametrize("text", [MODEL[:200], "<febio_config version='3.0'/>"])
def test_what_is_no_model_is_not_run(run, model, text):
    model.write_text(text)
    status, _, err = run("normal")
    assert (status, "not a FEBio model" in err) == (2, True)
    assert not (model.parent / "pid").exists()


def test_a_model_may_name_its_results(run, model):
    output = '<Output><plotfile type="febio" file="p.xplt"/><logfile file="l.log"/></Output></febio_spec>'
    model.write_text(MODEL.replace("</febio_spec>", output))
    (model.parent / "names").write_text("l.log p.xplt")
    status, out, err = run("normal")
    assert (status, err) == (0, "")
    assert out.rstrip().endswith(f"wrote {model.parent / 'p.xplt'}, {model.parent / 'l.log'}")
    assert run("normal")[0] == 2  # they are results of an earlier run now
    assert run("normal", "--force")[0] == 0


def test_a_model_may_want_no_plot_file(run, model):
    model.write_text(MODEL.replace("<time_steps>", "<plot_level>PLOT_NEVER</plot_level><time_steps>"))
    assert run("no plot")[0] == 0


def test_a_configuration_is_passed_on(run, model, monkeypatch):
    monkeypatch.chdir(model.parent)
    Path("own.xml").write_text("<febio_config/>")
    for option in ("--config", "-cnf"):
        assert run("normal", option, "own.xml", "--force")[0] == 0
        assert Path("arguments").read_text().splitlines()[2:] == ["-cnf", str(model.parent / "own.xml")]
    status, _, err = run("normal", "--config", "absent.xml", "--force")
    assert (status, err) == (2, "febio_io.run: --config absent.xml: there is no such file\n")


@pytest.mark.parametrize(
    ("said", "meaning"),
    [
        ("The selected linear solver does not support the requested matrix format.", "'skyline' is for symm"),
        (
            "\tDefault linear solver ..... : pardiso\nsolver does not support the requested matrix format",
            "MKL",
        ),
        ("Negative jacobian was detected at element 7 at gauss point 2", "an element was turned inside out"),
        ("Negative jacobian detected during mesh initialization.", "inside out from the start"),
        ("Max. nr of retries reached.", "<max_retries> and <dtmin>"),
        ("FATAL ERROR: 3 zero(s) found on diagonal.", "without resistance"),
        ("NAN detected in residual vector at index 3.", "values ran away"),
        ("A memory allocation failure has occured.", "does not fit into memory"),
        ("Error: PARDISO licence file not found", "wants a licence"),
        ("FATAL ERROR: An error occurred reading the configuration file.", "could not be read"),
    ],
)
def test_common_endings_are_explained(said, meaning):
    before = "Negative jacobian was detected\n------- converged at time : 1\n"
    found = explain_ending(before + f" * {said} *\n")
    assert meaning in found
    assert said.splitlines()[-1][:40] in found
    assert explain_ending(f"{said}\n------- converged at time : 1\n") == ""


@pytest.mark.parametrize("threads", ["0", "5000"])
def test_a_wrong_number_of_threads(run, threads):
    status, _, err = run("normal", "--threads", threads)
    assert (status, err) == (2, f"febio_io.run: --threads {threads}: allowed: 1 to 1024\n")


def test_without_febio_it_is_said_what_to_install(model, capsys, monkeypatch):
    monkeypatch.setenv("PATH", str(model.parent / "empty"))
    monkeypatch.delenv("FEBIO", raising=False)
    assert main([str(model)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    for part in ("not installed", "febio4 on PATH", "https://febio.org/downloads", "--febio PATH", "FEBIO"):
        assert part in line


def test_which_program_is_run(model, monkeypatch):
    program = model.parent / "febio4"
    monkeypatch.setenv("PATH", str(model.parent))
    monkeypatch.delenv("FEBIO", raising=False)
    assert find_febio(None) == program
    monkeypatch.setenv("PATH", "")
    monkeypatch.setenv("FEBIO", str(program))
    assert find_febio(None) == program
    with pytest.raises(FebioRunError, match=r"absent, stated by --febio, is no program that can be run"):
        find_febio(str(model.parent / "absent"))
    monkeypatch.setenv("FEBIO", str(model.parent))
    with pytest.raises(FebioRunError, match=r"stated by the environment variable FEBIO, is a folder"):
        find_febio(None)


def test_a_program_that_cannot_be_started(model, capsys):
    program = model.parent / "broken"
    program.write_text("#!/no/such/interpreter\n")
    program.chmod(0o755)
    assert main([str(model), "--febio", str(program)]) == 2
    assert "broken: cannot be run: No such file" in capsys.readouterr().err


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize("request_", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_leaves_no_process(model, request_):
    (model.parent / "behaviour").write_text("hang")
    command = [sys.executable, "-m", "febio_io.run", str(model), "--febio", str(model.parent / "febio4")]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, stdout=-1, stderr=-1, text=True, env=environment) as running:  # noqa: S603
        while not model.with_suffix(".xplt").is_file():
            time.sleep(0.05)
        pid = int((model.parent / "pid").read_text())
        assert alive(pid)
        running.send_signal(request_)
        out, err = running.communicate(timeout=60)
    assert (running.returncode, out) == (130, "")
    assert err.startswith("interrupted; FEBio has been ended; what it wrote is left as it is: ")
    assert len(err.splitlines()) == 1
    assert not alive(pid)


def test_a_program_that_does_not_listen_is_killed(run, model, monkeypatch):
    monkeypatch.setattr(process, "GRACE", 0.2)
    seen = []

    def stop(tail):
        seen.append(tail.steps)
        if tail.steps == 2:
            raise KeyboardInterrupt

    (model.parent / "behaviour").write_text("stubborn")
    with pytest.raises(KeyboardInterrupt):
        process.run_febio(model.parent / "febio4", model, None, stop)
    assert seen == sorted(seen)
    assert not alive(int((model.parent / "pid").read_text()))


def test_progress_follows_the_growing_log(tmp_path):
    tail = LogTail(tmp_path / "run.log")
    tail.read_on()
    assert (tail.steps, tail.time) == (0, 0.0)
    with (tmp_path / "run.log").open("w") as log:
        for text, steps, seconds, retries in (
            ("------- converged at time : 0.1\n------- conv", 1, 0.1, 0),
            ("erged at time : 0.2", 1, 0.1, 0),
            ("5\r\n------- failed to converge at time : 0.3\n", 2, 0.25, 1),
        ):
            log.write(text)
            log.flush()
            tail.read_on()
            assert (tail.steps, tail.time, tail.retries) == (steps, seconds, retries)
