"""What the tests of the commands share."""

import os
from pathlib import Path

import numpy as np
import pytest
from small_case import bands, small_case, written
from tube_plot import write_tube
from tubes import SHORT

from validation.compare import command as compare

os.environ["ARTERIAL_ROM_CACHE"] = ""  # tests that replace parts of the code must not find results of others


@pytest.fixture(scope="session")
def runs_read(tmp_path_factory):
    """Name and value of the variable by which tests that replace no part of the code read each run once."""
    own = tmp_path_factory.getbasetemp()
    shared = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    return "ARTERIAL_ROM_CACHE", str(shared / "runs_read")


@pytest.fixture
def known_runs(monkeypatch, runs_read):
    """FEBio's runs as another test has read them."""
    monkeypatch.setenv(*runs_read)


@pytest.fixture
def quick(monkeypatch):
    """Without drawing reports."""
    monkeypatch.setattr("validation.compare.case.write_reports", lambda directory: None)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A case against a small tube, which a second suffices for."""
    plot = write_tube(tmp_path_factory.mktemp("tube") / "tube.xplt", SHORT, np.linspace(0.0, 0.79, 5))

    def case(*declared):
        content = bands(small_case("none"), *declared)
        content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
        content["variants"]["none"]["reference"] = {"plot_file": str(plot)}
        return content

    return case


@pytest.fixture
def refused(tmp_path, capsys, quick):
    """Run a case that must be refused; give its one line."""

    def line(case, *options):
        result = tmp_path / "out" / "result"
        result.parent.mkdir()
        path = case if isinstance(case, Path) else written(case, tmp_path)
        assert compare.main([str(path), "--output", str(result), *options]) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert "Traceback" not in captured.err
        assert list(result.parent.iterdir()) == []
        lines = captured.err.splitlines()
        assert len(lines) == 1, captured.err
        return lines[0].replace(f"{tmp_path}/", "")

    return line
