"""The numbers behind a figure, as CSV text."""

import csv
import io
from collections.abc import Iterable, Sequence


def comma_separated(header: Sequence[str], rows: Iterable[Sequence[object]], digits: int = 9) -> str:
    """CSV with so many significant digits; an absent value is an empty field."""
    with io.StringIO(newline="") as text:
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([_cell(value, digits) for value in row] for row in rows)
        return text.getvalue()


def _cell(value: object, digits: int) -> object:
    return format(value, f".{digits}g") if isinstance(value, float) else value
