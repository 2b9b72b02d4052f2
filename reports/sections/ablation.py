"""Section on what each part of the coupled model buys, where `ablation.json` is there."""

from collections.abc import Iterable, Sequence

from pydantic import TypeAdapter

from cases.results.ablation import MEASURES, AblationRow
from reports.blocks import Bullets, Column, Paragraph, Table
from reports.result.load import Comparison
from reports.result.strict_json import read_json
from reports.sections.declaration import Blocks, declared, result_file
from reports.wording.numbers import ABSENT, fixed, percent, unsigned

_ROWS = TypeAdapter(list[AblationRow])
_SAID = {"radius_rms": "the lumen radius", "sector_share_rms": "a sector's share of the flow"}
_FILE = "ablation.json"
_TINY = 5e-5  # an error that two decimals of a percentage show as zero


@declared("ablation", "What each part of the model buys", result_file(_FILE))
def section(comparison: Comparison) -> Blocks:
    """Errors of each model between the row-local and the coupled one; a damaged file is a ReportError."""
    rows = read_json(comparison.directory / _FILE, _ROWS)
    columns = {
        name: measure
        for name, measure in MEASURES.items()
        if any(getattr(row, name) is not None for row in rows)
    }
    table = Table(
        "ablation",
        "Errors of each model between the row-local one and the coupled one against the same 3D runs, over "
        "all cells and states, and CPU time of the reduced model. A sector's share is its flow over that of "
        "its section. Nothing is fitted.",
        (
            Column("variant"),
            Column("model", "prose"),
            *(Column(each.statistic, "number", each.of) for each in columns.values()),
            Column("CPU s", "number"),
        ),
        tuple(_texts(row, columns) for row in rows),
        rule_by=0,
    )
    words = (
        "Each line changes one thing: the wall's thickness, a wall that is a ring (membrane) instead of a "
        "spring for each row, one pressure for each section instead of each row."
    )
    said = tuple(
        sentence for name in dict.fromkeys(row.variant for row in rows) if (sentence := _said(rows, name))
    )
    found = (Bullets(said),) if said else ()
    return Paragraph(words), *found, table


def _said(rows: Sequence[AblationRow], variant: str) -> str:
    """Say how far the last model's RMS errors are from the first one's; "" where nothing can be said."""
    ran = [row for row in rows if row.variant == variant and not row.failure]
    if len(ran) < 2:
        return ""
    first, last = ran[0], ran[-1]
    parts = [
        f"{words} is {_size(after)} instead of {_size(before)}"
        for name, words in _SAID.items()
        if (before := getattr(first, name)) is not None
        and (after := getattr(last, name)) is not None
        and max(before, after) >= _TINY
    ]
    if not parts:
        return ""
    return f"{variant}: with {last.model} instead of {first.model} the RMS error of {' and of '.join(parts)}."


def _size(error: float) -> str:
    return unsigned(percent(error))


def _texts(row: AblationRow, columns: Iterable[str]) -> tuple[str, ...]:
    model = f"{row.model} (failed: {row.failure})" if row.failure else row.model
    errors = (
        unsigned(text) if name.endswith("_rms") else text
        for name in columns
        for text in (percent(getattr(row, name)),)
    )
    return row.variant, model, *errors, ABSENT if row.failure else fixed(row.run_s, 2)
