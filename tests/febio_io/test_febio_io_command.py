"""``python -m febio_io``."""

import json
import subprocess
import sys

import pytest
from xplt_samples import MESH, sample_file
from xplt_writer import Writer

from febio_io.__main__ import main


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


def test_the_module_runs_as_a_command(write):
    command = [sys.executable, "-m", "febio_io", str(write(b"no"))]
    result = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
    assert result.returncode == 2
    assert "not an FEBio plot file" in result.stderr
