"""What a comparison found, as its command tells it."""

from dataclasses import dataclass
from pathlib import Path

from cases.reading.case_file import CaseFile
from cases.results.metric_row import MetricRow, Status
from validation.errors import ValidationError
from validation.runs.output import check_target

VERDICTS: tuple[Status, ...] = ("OK", "FAIL", "MISSING")


@dataclass(frozen=True)
class Outcome:
    """All rows of a comparison, and what a user should see besides.

    ``since`` is when an earlier run found them, ISO 8601; empty where this one did.
    """

    rows: list[MetricRow]
    warnings: list[str]
    since: str = ""

    @property
    def bands(self) -> list[MetricRow]:
        """Rows that judge a declared band."""
        return [row for row in self.rows if row.status]


def targets(files: list[CaseFile], output: Path | None) -> list[Path]:
    """Choose the result directory of each case.

    Raises
    ------
    ValidationError
        If two cases have one name, or a target must not be replaced.
    """
    names = [file.name for file in files]
    if len(set(names)) < len(names):
        raise ValidationError(f"case names must differ, found: {', '.join(names)}")
    if output is not None and len(files) == 1:
        found = [output]
    else:
        found = [(output or Path("results")) / name for name in names]
    for target in found:
        check_target(target)
    return found


def summary(file: CaseFile, target: Path, outcome: Outcome) -> str:
    """One line for people."""
    counts = {status: sum(row.status == status for row in outcome.bands) for status in VERDICTS}
    verdict = ", ".join(f"{count} {status}" for status, count in counts.items() if count) or "none declared"
    kept = f"nothing has changed since {outcome.since}: " if outcome.since else ""
    return f"{file.name}: {kept}bands: {verdict}; report: {target / 'report.html'}, {target / 'report.pdf'}"
