"""What each part of the coupled model buys: a section of the report where `ablation.json` is there."""

from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter

from reports.blocks import Column, Paragraph, Section, Table
from reports.numbers import ABSENT, fixed, percent
from reports.strict_json import read_json


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
    "sector_share_rms": ("RMS", "sector flow over section flow"),
    "sector_share_max": ("largest", "sector flow over section flow"),
    "thesis_sector_max": ("largest", "sectors of the thesis's 3D"),
}


def ablation_section(directory: Path) -> Section | None:
    """Build the section from ``ablation.json`` of a result's directory; None where there is none.

    Raises
    ------
    ReportError
        If the file is damaged.
    """
    path = directory / "ablation.json"
    if not path.is_file():
        return None
    table = Table(
        "ablation",
        "Errors of each model between the row-local one and the coupled one against the same 3D runs, over "
        "all cells and states, and CPU time of the reduced model. Nothing is fitted.",
        (
            Column("variant"),
            Column("model", "prose"),
            *(Column(title, "number", group) for title, group in _COLUMNS.values()),
            Column("CPU s", "number"),
        ),
        tuple(_texts(row) for row in read_json(path, _ROWS)),
        rule_by=0,
    )
    words = (
        "Each line changes one thing: the wall's thickness, a wall that is a ring (membrane) instead of a "
        "spring for each row, one pressure for each section instead of each row."
    )
    return Section("ablation", "What each part of the model buys", (Paragraph(words), table))


def _texts(row: _Row) -> tuple[str, ...]:
    model = f"{row.model} (failed: {row.failure})" if row.failure else row.model
    errors = (percent(getattr(row, name)) for name in _COLUMNS)
    return row.variant, model, *errors, ABSENT if row.failure else fixed(row.run_s, 2)
