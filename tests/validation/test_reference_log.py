"""The log beside a plot file: what the run cost, how it ended, and logs of other runs."""

import pytest
from small_case import RUNS
from tube_plot import write_tube
from tubes import Tube

from febio_io.errors import FebioFileError
from febio_io.xplt import open_plot
from validation.errors import UnusableReferenceError
from validation.reference.febio.log import account_of_log

TUBE = Tube(sectors=6, rings=2, stacks=3, layers=1)
RULE = "=" * 75
TIMES = (0.0, 0.25, 0.5)


def log_text(
    *, nodes=None, version="4.11.0", times=TIMES[1:], plot="tube.xplt", end="N O R M A L", took=12.5
):
    lines = [RULE, f"  version {version}", RULE, " FILES USED", RULE, f"\tPlot file  : {plot}", ""]
    lines += [" MESH INFO", RULE, f"\tNumber of nodes ................................ : {nodes}", ""]
    for number, time in enumerate(times, start=1):
        lines += [f"===== beginning time step {number} : {time:g} =====", " 1", " 2"]
        lines += ["convergence summary", "    number of iterations   : 2"]
        lines += [f"------- converged at time : {time:g}", ""]
    lines += [f"\tTotal elapsed time .............. : 0:00:12 ({took} sec)"] if took else []
    lines += [f" {end}   T E R M I N A T I O N", ""] if end else []
    return "\n".join(lines) + "\n"


@pytest.fixture
def account(tmp_path):
    """Write a tube's plot file and a log, and give what the log tells."""

    def read(**changed):
        path = tmp_path / "run.log"
        with open_plot(write_tube(tmp_path / "tube.xplt", TUBE, TIMES)) as plot:
            path.write_text(log_text(**{"nodes": len(plot.mesh.node_ids)} | changed))
            return account_of_log(path, plot)

    return read


def test_the_cost_of_the_run(account, tmp_path):
    found = account()
    assert found.warnings == ()
    assert found.cost == {
        "log": str(tmp_path / "run.log"),
        "febio_version": "4.11.0",
        "ended": "normally",
        "wall_time_s": 12.5,
        "simulated_s": 0.5,
        "time_steps": 2,
        "retries": 0,
        "iterations": 4,
        "equations": None,
    }


@pytest.mark.parametrize(("end", "said"), [("E R R O R", "with an error"), ("", "killed, crashed or still")])
def test_a_run_that_did_not_end_well_casts_doubt(account, end, said):
    found = account(end=end, took=None)
    assert found.cost["wall_time_s"] is None
    assert [said in warning for warning in found.warnings] == [True]


def test_the_log_of_a_run_with_another_plot_file_casts_doubt(account):
    (warning,) = account(plot="C:\\runs\\other.xplt").warnings
    assert "other.xplt, while reference.plot_file is tube.xplt" in warning
    assert account(plot="C:\\runs\\tube.xplt").warnings == ()


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"nodes": 17}, r"its mesh has 17 nodes, that of the plot file \d+ \(reference\.log\)"),
        ({"times": (0.25,)}, r"no step of it converged at 0\.5 s, the time of state 3"),
        ({"times": ()}, r"no step of it converged at 0\.25 s, the time of state 2"),
    ],
)
def test_the_log_of_another_run_is_refused(account, changed, said):
    with pytest.raises(UnusableReferenceError, match=said):
        account(**changed)


def test_the_log_of_another_version_is_refused(tmp_path):
    path = tmp_path / "run.log"
    path.write_text(log_text(version="3.4.0"))
    with (
        open_plot(RUNS / "tiny_raw.xplt") as plot,
        pytest.raises(
            UnusableReferenceError, match=r"it is of FEBio 3\.4\.0, the plot file of FEBio 4\.11\.0"
        ),
    ):
        account_of_log(path, plot)


def test_what_is_no_log_is_refused(tmp_path):
    (tmp_path / "run.log").write_text("hello\n")
    with open_plot(RUNS / "tiny_raw.xplt") as plot, pytest.raises(FebioFileError, match="not an FEBio log"):
        account_of_log(tmp_path / "run.log", plot)


@pytest.mark.parametrize(
    ("name", "seconds"), [("none", 949.057), ("axisymmetric", 1149.64), ("local", 881.072)]
)
def test_the_ready_runs(name, seconds):
    with open_plot(RUNS / f"{name}.xplt") as plot:
        found = account_of_log(RUNS / f"{name}.log", plot)
    assert found.warnings == ()
    assert (found.cost["wall_time_s"], found.cost["time_steps"], found.cost["ended"]) == (
        seconds,
        450,
        "normally",
    )
    moduli = {(item["material"], item["name"]): item["value"] for item in found.materials}
    healthy = {("Healthy", "E"): 6e5, ("Healthy", "v"): 0.48, ("Healthy", "density"): 1000.0}
    stiff = {("Calcified", "E"): 1e7, ("Calcified", "v"): 0.48, ("Calcified", "density"): 1000.0}
    blood = {("Blood", "density"): 1060.0, ("Blood", "mu"): 0.0035}
    assert moduli == blood | healthy | ({} if name == "none" else stiff)
