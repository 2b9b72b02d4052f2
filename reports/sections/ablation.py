"""Section on what each part of the coupled model buys, where `ablation.json` is there."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from pydantic import TypeAdapter

from reports.blocks import Bullets, Column, Paragraph, Table
from reports.result.load import Comparison
from reports.result.strict_json import read_json
from reports.sections.declaration import Blocks, declared, result_file
from reports.wording.numbers import ABSENT, fixed, percent, unsigned


@dataclass(frozen=True)
class _Row:
    """One model in one variant: relative errors against 3D, CPU seconds, what stopped it."""

    variant: str
    model: str
    radius_rms: float | None
    radius_max: float | None
    pressure_rms: float | None
    section_flow_rms: float | None
    sector_share_rms: float | None
    sector_share_max: float | None
    thesis_sector_max: float | None
    run_s: float
    failure: str


_ROWS = TypeAdapter(list[_Row])
_COLUMNS = {
    "radius_rms": ("RMS", "lumen radius"),
    "radius_max": ("largest", "lumen radius"),
    "pressure_rms": ("RMS", "pressure"),
    "section_flow_rms": ("RMS", "section flow"),
    "sector_share_rms": ("RMS", "share of a sector"),
    "sector_share_max": ("largest", "share of a sector"),
    "thesis_sector_max": ("largest", "thesis's sectors"),
}
_SAID = {"radius_rms": "the lumen radius", "sector_share_rms": "a sector's share of the flow"}
_FILE = "ablation.json"
_TINY = 5e-5  # an error that two decimals of a percentage show as zero


@declared("ablation", "What each part of the model buys", result_file(_FILE))
def section(comparison: Comparison) -> Blocks:
    """Errors of each model between the row-local and the coupled one; a damaged file is a ReportError."""
    rows = read_json(comparison.directory / _FILE, _ROWS)
    columns = {
        name: words for name, words in _COLUMNS.items() if any(getattr(row, name) is not None for row in rows)
    }
    table = Table(
        "ablation",
        "Errors of each model between the row-local one and the coupled one against the same 3D runs, over "
        "all cells and states, and CPU time of the reduced model. A sector's share is its flow over that of "
        "its section. Nothing is fitted.",
        (
            Column("variant"),
            Column("model", "prose"),
            *(Column(title, "number", group) for title, group in columns.values()),
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


def _said(rows: Sequence[_Row], variant: str) -> str:
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


def _texts(row: _Row, columns: Iterable[str]) -> tuple[str, ...]:
    model = f"{row.model} (failed: {row.failure})" if row.failure else row.model
    errors = (
        unsigned(text) if name.endswith("_rms") else text
        for name in columns
        for text in (percent(getattr(row, name)),)
    )
    return row.variant, model, *errors, ABSENT if row.failure else fixed(row.run_s, 2)
