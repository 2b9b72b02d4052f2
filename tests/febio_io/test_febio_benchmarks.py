"""The measuring scripts run; what they measure is not judged here."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def run(script, *options):
    command = [sys.executable, str(BENCHMARKS / script), *map(str, options)]
    return subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603


def test_a_little_fuzzing_finds_nothing(tmp_path):
    result = run("febio_fuzz.py", "--runs", 100, "--seconds", 60, "--keep", tmp_path)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "100 inputs" in result.stdout
    assert list(tmp_path.iterdir()) == []


def test_writing_models_is_measured():
    result = run("febio_model.py", "--elements", 8000)
    assert result.returncode == 0, result.stderr
    assert len(result.stdout.splitlines()) == 3


def test_reading_is_measured():
    result = run("febio_read.py", "--states", 10, "--megabytes", 1)
    assert result.returncode == 0, result.stderr
    assert len(result.stdout.splitlines()) == 8
