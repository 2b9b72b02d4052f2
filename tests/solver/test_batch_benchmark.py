"""The script that measures batches runs; what it measures is not judged here."""

import importlib.util
import json
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

SCRIPT = Path(__file__).parents[2] / "benchmarks/batch.py"
GRID = "n_x: 120, n_phi: 48"


@pytest.fixture
def script(tmp_path, monkeypatch):
    """The script as a module, with its case on few cells."""
    spec = importlib.util.spec_from_file_location("batch_benchmark", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    text = module.CASE.read_text(encoding="utf-8")
    assert GRID in text
    coarse = tmp_path / "coarse.yaml"
    coarse.write_text(text.replace(GRID, "n_x: 24, n_phi: 16"), encoding="utf-8")
    monkeypatch.setattr(module, "CASE", coarse)
    return module


def test_batches_are_measured(script, tmp_path, monkeypatch, capsys):
    output = tmp_path / "batch.json"
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), "--cases", "1", "--output", str(output)])
    assert script.main() == 0
    rows = json.loads(output.read_text())["batches"]
    assert [row["kind"] for row in rows] == [
        *("anywhere", "anywhere", "symmetric", "symmetric", "rings", "rings", "anywhere", "anywhere")
    ]
    assert all((row["cases"], row["failed"]) == (1, 0) for row in rows)
    *own, last = rows
    assert all(row["time_step_s"] == 1e-3 for row in own)
    assert last["time_step_s"] > 1e-3
    assert 0 < last["largest_deviation"] < 1e-3
    assert "of the command" in capsys.readouterr().out
