"""``python -m febio_io``."""

import json
import os
import subprocess
import sys

import pytest
from log_samples import sample_log
from xplt_samples import MESH, sample_file
from xplt_writer import Writer

from febio_io.command import main
from febio_io.errors import FebioFileError
from febio_io.text.data_records import read_data_record
from febio_io.text.log import read_log
from febio_io.xplt import open_plot

LOG = sample_log().encode()
RECORD = b"*Step  = 0\n*Time  = 0\n*Data  = x;J\n1 0 1\n*Step  = 1\n*Time  = 0.5\n*Data  = x;J\n1 2 1.5\n"


def test_text_names_what_is_there(write, capsys):
    assert main([str(write(sample_file(zlib=True)))]) == 0
    text = capsys.readouterr().out
    for part in (
        "version 0x35",
        "compression  zlib",
        "3, time 0 to 0.2; 3 with status 0",
        "12 nodes, 5 elements",
        "domain 1 Block: 2 hex8, material Rubber",
        "domain 2 (no name): 1 quad4, material Cloth",
        "surface 1 Mixed: 2 faces",
        "edge 1 Rim: 2 lines",
        "node sets: Bottom (4)",
        "displacement [L]",
        "pressure [P]  regions 1, 3",
    ):
        assert part in text


def test_times_that_are_no_numbers(write, capsys):
    states = [Writer().state(time) for time in (float("nan"), 1)]
    path = str(write(Writer().file(Writer().root(), Writer().mesh(MESH), *states)))
    assert main([path]) == 0
    assert "2, time not a number to 1;" in capsys.readouterr().out
    assert main([path, "--json"]) == 0
    summary = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert summary["states"]["times"] == [None, 1]


def test_json_is_for_programs(write, capsys):
    assert main([str(write(sample_file()[:-1])), "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["states"]["count"] == 2
    assert summary["warnings"] == ["case.xplt is cut off after state 2: 2 complete states are used"]
    assert summary["meshes"][0]["domains"][0]["element_type"] == "hex8"
    assert [variable["regions"] for variable in summary["variables"]] == [[0], [1, 3]]


def test_a_file_without_states_or_variables(write, capsys):
    assert main([str(write(Writer().file(Writer().root(), Writer().mesh(MESH))))]) == 0
    assert "states       none" in capsys.readouterr().out


@pytest.mark.parametrize("content", [b"<?xml?>", sample_file()[:100]])
def test_errors_are_one_line_and_status_two(write, capsys, content):
    assert main([str(write(content))]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.startswith("febio_io: ")
    assert output.err.count("\n") == 1


def test_logs_and_records_are_told_by_what_is_in_them(write, capsys):
    assert main([str(write(LOG, "anything"))]) == 0
    text = capsys.readouterr().out
    for part in (
        "FEBio log, version 4.8.0",
        "ended        normally",
        "2 converged, 1 retries, 5 iterations, 2 analysis steps",
        "equations    1872, nonzeros 186332",
        "total elapsed time   3.01782 s",
        "warning: Max nr of iterations reached.",
        "data record 1 'x;y': 2 blocks, in this file",
        "data record 2 'stress': 1 blocks, in stress.txt",
    ):
        assert part in text
    assert main([str(write(RECORD, "data.txt"))]) == 0
    text = capsys.readouterr().out
    assert "FEBio data record 'x;J'" in text
    assert "blocks       2, time 0 to 0.5" in text
    assert "columns      x [L], J" in text


def test_json_of_logs_and_records(write, capsys):
    log = sample_log().replace("time step 1 : 0.15 =", "time step 1 : nan =")
    assert main([str(write(log.encode(), "run.log")), "--json"]) == 0
    summary = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert (summary["kind"], summary["termination"], summary["last_time"]) == ("log", "normal", None)
    assert main([str(write(RECORD, "data.txt")), "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["columns"] == [{"name": "x", "unit": "L"}, {"name": "J", "unit": None}]
    assert (summary["blocks"], summary["rows"], summary["regular"]) == (2, 2, True)


@pytest.mark.parametrize(
    ("content", "name", "options", "files"),
    [
        (sample_file(), "a.xplt", [], ["a.pvd", "a_0000.vtu", "a_0001.vtu", "a_0002.vtu"]),
        (sample_file(), "a.xplt", ["--format", "vtkhdf"], ["a.vtkhdf"]),
        (sample_file(), "a.xplt", ["--format", "csv", "--variables", "pressure"], ["a_pressure.csv"]),
        (sample_file(), "a.xplt", ["--states=-1"], ["a.pvd", "a_0002.vtu"]),
        (RECORD, "a.txt", ["--variables", "J", "--states", "1"], ["a.csv"]),
        (RECORD, "a.txt", ["--format", "nc"], ["a.nc"]),
        (LOG, "a.log", ["--format", "nc"], ["a_iterations.nc", "a_record1.nc", "a_steps.nc"]),
    ],
)
def test_export(write, tmp_path, capsys, content, name, options, files):
    folder = tmp_path / "out"
    assert main([str(write(content, name)), "--export", str(folder), *options]) == 0
    assert sorted(path.name for path in folder.iterdir()) == files
    assert all(line.startswith(f"wrote {folder}") for line in capsys.readouterr().out.splitlines())


@pytest.mark.parametrize(
    ("content", "options", "message"),
    [
        (sample_file(), ["--export", "out", "--states", "9"], "state 9 is not there"),
        (sample_file(), ["--export", "out", "--variables", "presure"], "no variable 'presure'"),
        (sample_file(), ["--format", "csv"], "--format, --variables and --states need --export"),
        (LOG, ["--export", "out", "--format", "vtu"], "a log has no mesh"),
        (LOG, ["--export", "out", "--states", "1"], "do not apply to a log"),
        (RECORD, ["--export", "out", "--variables", "y"], "no column 'y'"),
        (RECORD + b"1 x\n", [], "line 9: 'x' is no number"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    write, tmp_path, monkeypatch, capsys, content, options, message
):
    monkeypatch.chdir(tmp_path)
    assert main([str(write(content)), *options]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.startswith("febio_io: ")
    assert output.err.count("\n") == 1
    assert message in output.err
    assert not (tmp_path / "out").exists()


def test_the_module_runs_as_a_command(write):
    command = [sys.executable, "-m", "febio_io", str(write(b"no"))]
    result = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
    assert result.returncode == 2
    assert "not an FEBio plot file, log, data record or model" in result.stderr


@pytest.mark.parametrize("read", [open_plot, read_log, read_data_record])
def test_what_is_no_file_is_refused_unread(tmp_path, read, capsys):
    os.mkfifo(tmp_path / "pipe")
    for path, said in ((tmp_path / "pipe", "a device or a pipe"), (tmp_path, "Is a directory")):
        with pytest.raises(FebioFileError, match=f"cannot be opened: .*{said}"):
            read(path)
        assert main([str(path)]) == 2
        assert said in capsys.readouterr().err
    with pytest.raises(FebioFileError, match="null"):
        read("a\0b")
