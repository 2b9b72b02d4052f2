"""Section of a sweep's page: Sobol indices with their intervals."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.results.sweep import KeptOutput, SobolIndex
from reports.blocks import Block, Figure, Paragraph, Section, Subsection, Table, numbers, prose
from reports.sweep.folder import Sweep
from reports.sweep.index_bars import Bars, index_bars
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import ABSENT, fixed

_PANELS = 6  # outputs of one figure
_KINDS = ("S1", "S1_conf", "ST", "ST_conf")


def _column(rows: list[SobolIndex], name: str) -> Floats:
    return np.array([np.nan if (value := getattr(row, name)) is None else value for row in rows])


def _rows_of(sweep: Sweep, variant: str, output: KeptOutput) -> list[SobolIndex]:
    """Return an output's rows in the order of the parameters; empty where an index is missing throughout."""
    found = {
        row.parameter: row
        for row in sweep.study.sensitivity or ()
        if (row.variant, row.output) == (variant, output.name)
    }
    rows = [found[p.name] for p in sweep.study.parameters if p.name in found]
    return rows if any(row.ST is not None for row in rows) else []


def _told(sweep: Sweep, output: KeptOutput, rows: list[SobolIndex]) -> str:
    """Name the parameter with the largest total index, and the share that no parameter has alone."""
    labels = {p.name: p.label for p in sweep.study.parameters}
    best = max(rows, key=lambda row: row.ST if row.ST is not None else -np.inf)
    alone = sum(row.S1 for row in rows if row.S1 is not None)
    return (
        f"{output.label}: most by {labels[best.parameter]} (ST {fixed(best.ST, 2)} ± "
        f"{fixed(best.ST_conf, 2)}), all first-order indices together {fixed(alone, 2)}"
    )


def _figures(sweep: Sweep, variant: str, key: str) -> tuple[Block, ...]:
    shown = [(o, rows) for o in sweep.study.outputs if (rows := _rows_of(sweep, variant, o))]
    labels = [p.label for p in sweep.study.parameters]
    blocks: list[Block] = []
    for first in range(0, len(shown), _PANELS):
        part = shown[first : first + _PANELS]
        told = "; ".join(_told(sweep, output, rows) for output, rows in part)
        blocks.append(
            Figure(
                key=f"{key}-{first + 1}",
                caption=f"Variant {variant}: Sobol indices with 95 % intervals. S1 is the share of an "
                "output's variance that a parameter explains alone, ST that with all its interactions. "
                "What to see: an ST well above S1 is interaction, an ST near zero a parameter that may be "
                f"fixed. {told}.",
                alt=f"Bars of Sobol indices of variant {variant}. {told}.",
                drawing=partial(
                    index_bars,
                    labels,
                    [Bars(o.label, *(_column(rows, name) for name in _KINDS)) for o, rows in part],
                ),
                csv=comma_separated(
                    ("output", "parameter", *_KINDS),
                    (
                        (row.output, row.parameter, *(getattr(row, name) for name in _KINDS))
                        for _, rows in part
                        for row in rows
                    ),
                    6,
                ),
            )
        )
    if shown:
        blocks.append(_table(sweep, f"{key}-table", shown))
    return tuple(blocks)


def _table(sweep: Sweep, key: str, shown: list[tuple[KeptOutput, list[SobolIndex]]]) -> Table:
    labels = {p.name: p.label for p in sweep.study.parameters}

    def pair(value: float | None, half: float | None) -> tuple[str, str]:
        return (fixed(value, 3), ABSENT if half is None else f"± {fixed(half, 3)}")

    return Table(
        key,
        "Sobol indices, each with half the width of its 95 % interval.",
        (*prose("output", "parameter"), *numbers("S1", "interval", "ST", "interval")),
        tuple(
            (output.label, labels[row.parameter], *pair(row.S1, row.S1_conf), *pair(row.ST, row.ST_conf))
            for output, rows in shown
            for row in rows
        ),
        rule_by=0,
    )


def indices_section(sweep: Sweep) -> Section:
    """Build the section."""
    title = "Sensitivity"
    if sweep.study.sensitivity is None:
        told = (
            "The design gives no Sobol indices (saltelli does)."
            if sweep.study.design.kind != "saltelli"
            else "Sobol indices are computed when the sweep is finished."
        )
        return Section("indices", title, (Paragraph(told),))
    parts = []
    for k, variant in enumerate(sweep.variants, start=1):
        none = (Paragraph(f"Too few whole groups of samples of variant {variant} for any index."),)
        parts.append(
            Subsection(f"indices-{k}", f"Variant {variant}", _figures(sweep, variant, f"indices-{k}") or none)
        )
    return Section("indices", title, tuple(parts))
