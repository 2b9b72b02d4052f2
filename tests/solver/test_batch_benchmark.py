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
    assert [row["kind"] for row in rows] == [
        *("anywhere", "anywhere", "symmetric", "symmetric", "rings", "rings", "anywhere")
    ]
    assert all((row["cases"], row["failed"]) == (1, 0) for row in rows)
    assert "of the command" in result.stdout
