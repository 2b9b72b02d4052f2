"""References that a case does not state, or that are yet to be computed: what to do about them."""

import shlex
from collections.abc import Mapping
from pathlib import Path

from cases.reading.case_file import ONLY_VARIANT, CaseFile
from cases.sections.case import Case
from cases.sections.references.kinds import KINDS
from cases.values.wording import choices
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
        "(plot_file, and generate where the 3D run is yet to be made) or "
        f"kind {choices(kind for kind in KINDS if kind != 'febio')} (docs/case_file.md); "
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
        If files of a reference are missing; the message says which commands make them, if any do.
    """
    references = {name: case.reference for name, case in cases.items() if case.reference is not None}
    absent = {
        name: reference
        for name, reference in references.items()
        if not all(path.is_file() for path in reference.files)
    }
    if not absent:
        return
    from validation.reference.kinds import kind_of

    lines = [
        line
        for name, reference in absent.items()
        for line in kind_of(name, cases[name]).how_to_make(reference, path, name)
    ]
    if lines:
        raise ValidationError("\n".join(lines))
    for name, reference in absent.items():
        for needed in reference.files:
            if not needed.is_file():
                raise ValidationError(f"variant {name!r}: {shown_path(needed)}: no such file (reference)")
