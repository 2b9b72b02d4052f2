"""The script that measures batches runs; what it measures is not judged here."""

import json
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "benchmarks/batch.py"


def test_batches_are_measured(tmp_path):
    output = tmp_path / "batch.json"
    command = [sys.executable, str(SCRIPT), "--cases", "1", "--output", str(output)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
    assert result.returncode == 0, result.stderr
    rows = json.loads(output.read_text())["batches"]
    assert [(row["threads"], row["cases"], row["failed"]) for row in rows] == [(1, 1, 0), (2, 1, 0)]
    assert "of the command" in result.stdout
