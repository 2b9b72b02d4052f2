"""Sweeps on real processes: a worker or the client is killed, the user interrupts, a scheduler is given."""

import logging
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import deadly_samples
import pytest
from distributed import LocalCluster
from pandas.testing import assert_frame_equal
from small_case import ROOT
from small_sweep import records, small_study, study_file, swept

from validation.sweep.chunk import Plan
from validation.sweep.cluster import SETTINGS, connected
from validation.sweep.command import main
from validation.sweep.folder import PAGE_FILES
from validation.sweep.samples import Sample
from validation.sweep.stream import computed

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc").is_dir(), reason="finds processes in /proc"),
]

SAMPLES = 36
PARAMETERS = {"calcification.youngs_modulus": {"start": "1 MPa", "stop": "20 MPa", "count": SAMPLES}}
SOLVER = {"n_x": 24, "n_phi": 16, "time_step": "2 ms"}
PATIENCE = 150.0  # s: what waits for a worker that died may wait for several timeouts of 10 s


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    folder = tmp_path_factory.mktemp("expected")
    return swept(small_study(folder, parameters=PARAMETERS, overrides={"solver": SOLVER}), folder / "out")


@pytest.fixture
def study(tmp_path):
    return study_file(tmp_path, parameters=PARAMETERS, overrides={"solver": SOLVER})


@pytest.fixture
def undrawn(monkeypatch):
    """Pages of another test."""

    def write(folder):
        for name in PAGE_FILES:
            (folder / name).write_text("a page", encoding="utf-8")

    monkeypatch.setattr("reports.sweep.write_sweep_page", write)


def started(study: Path, *options: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "validation.sweep", str(study), *options]
    place = ["--output", str(study.parent / "out"), "--workers", "2"]
    return subprocess.Popen(  # noqa: S603
        [*command, *place],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def wait_for(condition, process=None):
    begin = time.monotonic()
    while not condition():
        assert time.monotonic() - begin < PATIENCE
        assert process is None or process.poll() is None, process.communicate()
        time.sleep(0.01)


def parts(study: Path) -> list[Path]:
    return list((study.parent / "out/samples").glob("part-*.parquet"))


def children(pid: int) -> list[int]:
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(word) for task in tasks for word in task.read_text().split()]


def workers(process: subprocess.Popen[str]) -> list[int]:
    """Processes that compute: forks of the one that has imported what they need."""
    return [fork for child in children(process.pid) for fork in children(child)]


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def same(study: Path, expected) -> None:
    assert_frame_equal(records(study.parent / "out"), expected, check_exact=True)


def test_a_worker_that_is_killed_loses_and_doubles_nothing(study, expected):
    process = started(study)
    wait_for(lambda: parts(study), process)
    os.kill(workers(process)[0], signal.SIGKILL)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == (0, "")
    assert f"trial: {SAMPLES} samples; page: " in out
    same(study, expected)


@pytest.mark.long  # the interrupt below leaves the same parts, from which the same command goes on
def test_a_client_that_is_killed_goes_on_where_it_was(study, expected, undrawn):
    process = started(study)
    wait_for(lambda: len(parts(study)) >= 2, process)
    running = workers(process)
    process.kill()
    process.communicate(timeout=PATIENCE)
    kept = {part: part.stat().st_mtime_ns for part in parts(study)}
    assert 0 < len(kept) < SAMPLES // 2
    wait_for(lambda: not any(alive(pid) for pid in running))
    assert main([str(study), "--output", str(study.parent / "out"), "--scheduler", "threads"]) == 0
    same(study, expected)
    assert all(part.stat().st_mtime_ns == time for part, time in kept.items())


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.long)])
def test_an_interrupt_keeps_what_is_done_and_leaves_no_process(study, expected, undrawn, number):
    process = started(study)
    wait_for(lambda: len(parts(study)) >= 2, process)
    running = workers(process)
    if number == signal.SIGINT:
        os.killpg(process.pid, number)  # as a terminal does: workers get it too
    else:
        process.send_signal(number)
    out, err = process.communicate(timeout=PATIENCE)
    folder = study.parent / "out"
    assert (process.returncode, out) == (130, "")
    assert err == f"interrupted; what is done is kept in {folder}, and the same command goes on\n"
    assert '"state": "interrupted"' in (folder / "study.json").read_text(encoding="utf-8")
    wait_for(lambda: not any(alive(pid) for pid in running))
    kept = {part: part.stat().st_mtime_ns for part in parts(study)}
    assert 0 < len(kept) < SAMPLES // 2
    assert main([str(study), "--output", str(folder), "--scheduler", "threads"]) == 0
    same(study, expected)
    assert all(part.stat().st_mtime_ns == time for part, time in kept.items())


def test_a_scheduler_that_is_there_already(study, expected, undrawn):
    with LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None) as cluster:
        place = ["--output", str(study.parent / "out"), "--scheduler", cluster.scheduler_address]
        assert main([str(study), *place]) == 0
    same(study, expected)


def test_an_address_where_no_scheduler_is(study, capsys, monkeypatch):
    monkeypatch.setattr("validation.sweep.cluster.CONNECT_WITHIN", "0.2s")
    assert main([str(study), "--output", str(study.parent / "out"), "--scheduler", "tcp://127.0.0.1:9"]) == 2
    assert "--scheduler tcp://127.0.0.1:9: no scheduler answers" in capsys.readouterr().err


def chunks() -> list[tuple[int, list[Sample]]]:
    return [
        (0, [Sample(n, "local", (), None) for n in (0, 1)]),
        (1, [Sample(n, "local", (), None) for n in (2, 3)]),
    ]


@pytest.mark.parametrize(
    ("run", "scheduler", "words"),
    [
        (deadly_samples.dies_with_the_third, "processes", "the workers that ran it died"),
        (deadly_samples.raises_with_the_third, "threads", "ZeroDivisionError: float division by zero"),
    ],
)
def test_a_sample_that_kills_its_worker_is_the_only_one_lost(run, scheduler, words, monkeypatch):
    monkeypatch.setitem(SETTINGS, "distributed.scheduler.allowed-failures", 0)
    with connected(scheduler, 1, print) as client:
        found = dict(computed(client, chunks(), Plan((), (), {}), run))
        levels = client.run(lambda: logging.getLogger("tornado.application").getEffectiveLevel())
    states = [(one["sample"], one["status"]) for number in (0, 1) for one in found[number]]
    assert states == [(0, "ok"), (1, "ok"), (2, "failed"), (3, "ok")]
    assert words in found[1][0]["error"]
    silenced = set(levels.values()) == {logging.CRITICAL}  # also in a worker that took another's place
    assert silenced == (scheduler == "processes")
