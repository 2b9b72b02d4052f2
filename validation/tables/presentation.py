"""Rows on the terminal, as CSV and as JSON."""

import csv
import io
import json
import platform
from pathlib import Path

import numba
import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from cases.shell.whole import write_text
from validation.runs.sources import code_digest
from validation.tables.experiment import Check, Experiment

COLUMNS = ("case", "quantity", "unit", "ours", "thesis", "relative_difference", "low", "high", "met")


def _difference(row: Check) -> str:
    return "" if row.difference is None else f"{100 * row.difference:+.3f} %"


def _allowed(row: Check) -> str:
    if np.isinf(row.high):
        return f"≥ {row.low:.4g}"
    if row.thesis is None and row.low == 0:
        return f"≤ {row.high:.4g}"
    if row.thesis is not None and np.isclose(row.high + row.low, 2 * row.thesis):
        return f"± {100 * (row.high / row.thesis - 1):.2g} %"
    return f"{row.low:.4g} to {row.high:.4g}"


def print_rows(console: Console, experiment: Experiment, rows: list[Check]) -> None:
    """Show one experiment."""
    table = Table(title=f"{experiment.name}  {experiment.title}", title_justify="left", box=SIMPLE_HEAD)
    for heading in ("case", "quantity"):
        table.add_column(heading, overflow="fold")
    for heading in ("ours", "thesis", "difference", "allowed"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for row in rows:
        thesis = "" if row.thesis is None else f"{row.thesis:.5g}"
        quantity = f"{row.quantity}, {row.unit}" if row.unit else row.quantity
        verdict = "met" if row.met else "[bold red]missed[/]"
        table.add_row(row.case, quantity, f"{row.ours:.5g}", thesis, _difference(row), _allowed(row), verdict)
    console.print(table)


def _values(row: Check) -> dict[str, str | float | bool | None]:
    return {
        "case": row.case,
        "quantity": row.quantity,
        "unit": row.unit,
        "ours": row.ours,
        "thesis": row.thesis,
        "relative_difference": row.difference,
        "low": row.low,
        "high": row.high if np.isfinite(row.high) else None,
        "met": row.met,
    }


def write_csv(path: Path, rows: list[Check]) -> None:
    """Write one experiment's rows."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(_values(row) for row in rows)
    write_text(path, text.getvalue())


def write_json(path: Path, rows: dict[str, list[Check]], cpu: dict[str, float]) -> None:
    """Write all rows, what computed them, and the CPU seconds of each entry."""
    content = {
        "sources": code_digest("tables"),
        "python": platform.python_version(),
        "numba": numba.__version__,
        "numpy": np.__version__,
        "machine": platform.machine(),
        "cpu_s": cpu,
        "experiments": {name: [_values(row) for row in lines] for name, lines in rows.items()},
    }
    write_text(path, json.dumps(content, indent=1, ensure_ascii=False) + "\n")
