"""JSON files read into typed records; what does not fit is refused with its place."""

from pathlib import Path
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from reports.errors import ReportError

T = TypeVar("T")

_MOST_SHOWN = 60  # letters of a refused value


def read_json(path: Path, schema: TypeAdapter[T]) -> T:
    """Read a JSON file whose content fits `schema`; no text is taken for a number, no number for a text.

    Raises
    ------
    ReportError
        If it cannot be read, is no JSON, or does not fit; the message names the first place that does not,
        the rows of a list counted from 1.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror or error}") from error
    try:
        return schema.validate_json(content, strict=True)
    except ValidationError as error:
        raise ReportError(f"{path}: {_first_problem(error)}") from error


def _first_problem(error: ValidationError) -> str:
    problem = error.errors(include_url=False, include_context=False)[0]
    *outer, name = problem["loc"] or ("",)
    if problem["type"] == "json_invalid":
        return f"cannot be read as JSON: {problem['msg']}"
    if problem["type"] == "missing":
        return f"{_place(outer)}without {name}"
    shown = repr(problem["input"])
    if len(shown) > _MOST_SHOWN:
        shown = f"{shown[:_MOST_SHOWN]}…"
    return f"{_place(problem['loc'])}{problem['msg']}, found {shown}"


def _place(steps: tuple[int | str, ...] | list[int | str]) -> str:
    """E.g. "row 3, unit: "; "" for the whole file."""
    words = [f"row {step + 1}" if isinstance(step, int) else step for step in steps]
    return f"{', '.join(words)}: " if words else ""
