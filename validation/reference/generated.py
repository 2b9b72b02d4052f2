"""References that a case does not state, or that are yet to be computed: what to do about them."""

import shlex
from collections.abc import Mapping
from pathlib import Path

from cases.reading.case_file import ONLY_VARIANT, CaseFile
from cases.sections.case import Case, FebioReference
from validation.errors import ValidationError
from validation.runs.provenance import shown_path


def check_stated(file: CaseFile) -> None:
    """Check that every variant states what it is compared with.

    Raises
    ------
    ValidationError
        If one does not; the message says which keys it could state, and how the 2D model runs without.
    """
    missing = [name for name, case in file.variants.items() if case.reference is None]
    if missing:
        raise ValidationError(_without_reference(file, missing))


def _without_reference(file: CaseFile, missing: list[str]) -> str:
    whose = f" of variant {', '.join(map(repr, missing))}" if missing != [ONLY_VARIANT] else ""
    alone = ["python", "-m", "solver", str(file.path), "--variant", missing[0], "--output", "run.nc"]
    return (
        f"{file.path}: reference{whose}: missing, there is nothing to compare with; allowed: kind febio "
        "(plot_file, and generate where the 3D run is yet to be made) or kind tables (docs/case_file.md); "
        f"the 2D model alone: {shlex.join(alone)}"
    )


def check_computed(path: Path, cases: Mapping[str, Case]) -> None:
    """Check that the files of every reference exist, before anything is computed.

    Parameters
    ----------
    path : pathlib.Path
        The case file.
    cases : mapping of str to Case
        Those of its variants that are run.

    Raises
    ------
    ValidationError
        If files of a reference with ``generate`` are missing; the message says which commands make them.
    """
    stated = {
        name: case.reference for name, case in cases.items() if isinstance(case.reference, FebioReference)
    }
    missing = {name: reference for name, reference in stated.items() if not reference.plot_file.is_file()}
    if missing:
        raise ValidationError(_instructions(path, missing))
    for name, reference in stated.items():
        for needed in reference.files:
            if not needed.is_file():
                raise ValidationError(f"variant {name!r}: {shown_path(needed)}: no such file (reference)")


def _instructions(case: Path, missing: Mapping[str, FebioReference]) -> str:
    lines = []
    for name, reference in missing.items():
        plot, model = reference.plot_file, reference.plot_file.with_suffix(".feb")
        make = ["python", "-m", "febio_io.feb", str(case), "--variant", name, "--output", shown_path(model)]
        lines += [
            f"variant {name!r}: reference.plot_file: {shown_path(plot)}: not there yet; to make it:",
            f"  {shlex.join(make)}",
            f"  {shlex.join(['python', '-m', 'febio_io.run', shown_path(model)])}",
        ]
    return "\n".join(lines)
