"""Several comparisons beside each other: the same figure of every case and model in one line."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from cases.reading.models import labelled
from cases.results.metric_row import MetricRow
from cases.shell.whole import write_text, writing
from validation.errors import ValidationError
from validation.metrics.rows import to_frame

POOLED = ("rms_error", "bias", "bias_low", "bias_high", "scatter", "rms_difference", "change_rms", "cycle")
LINE = ["variant", "quantity", "statistic", "inflow", "unit"]
FIGURES = ["rom", "reference", "error", "band", "status"]
STEM = "side_by_side"


def side_by_side(cases: Mapping[str, Sequence[MetricRow]]) -> pd.DataFrame:
    """Pooled figures and bands of several cases, a line per variant, quantity and statistic.

    Parameters
    ----------
    cases : mapping of str to sequence of Row
        All rows of each case, by its name.

    Returns
    -------
    pandas.DataFrame
        Columns ``variant``, ``quantity``, ``statistic``, ``inflow``, ``unit``, then ``<case>: <figure>``, of
        a case with several models ``<case>, model <model>: <figure>``; empty where one has no such figure.
        A band's line comes instead of that of its statistic without a band.
    """
    tables = []
    for name, rows in cases.items():
        models = dict.fromkeys(row.model for row in rows)
        for model in models:
            of_model = [row for row in rows if row.model == model]
            chosen = [row for row in of_model if row.status or (row.statistic in POOLED and row.i is None)]
            table = to_frame(chosen).drop_duplicates(LINE[:4]).set_index(LINE)  # bands stand first
            tables.append(table[FIGURES].add_prefix(f"{labelled(name, model, models)}: "))
    return pd.concat(tables, axis=1, sort=False).reset_index()


def write_side_by_side(folder: Path, cases: Mapping[str, Sequence[MetricRow]]) -> list[Path]:
    """Write ``side_by_side.csv`` and ``.json`` (a list of lines) to a folder; returns their paths.

    Raises
    ------
    ValidationError
        If they cannot be written.
    """
    table = side_by_side(cases)
    contents = {
        "csv": table.to_csv(index=False),
        "json": table.to_json(orient="records", indent=1, force_ascii=False, double_precision=15) + "\n",
    }
    paths = [folder / f"{STEM}.{suffix}" for suffix in contents]
    with writing(folder, ValidationError):
        for path, text in zip(paths, contents.values(), strict=True):
            write_text(path, text)
    return paths
