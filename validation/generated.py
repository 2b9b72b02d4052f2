"""References that are yet to be computed: which commands make them."""

import shlex
from collections.abc import Mapping
from pathlib import Path

from cases.case_file import CaseFile
from cases.schema import FebioReference
from validation.errors import ValidationError
from validation.provenance import shown_path


def check_computed(file: CaseFile) -> None:
    """Check that the files of every reference exist, before anything is computed.

    Raises
    ------
    ValidationError
        If files of a reference with ``generate`` are missing; the message says which commands make them.
    """
    stated = {
        name: case.reference
        for name, case in file.variants.items()
        if isinstance(case.reference, FebioReference)
    }
    missing = {name: reference for name, reference in stated.items() if not reference.plot_file.is_file()}
    if missing:
        raise ValidationError(_instructions(file.path, missing))
    for name, reference in stated.items():
        for path in reference.files:
            if not path.is_file():
                raise ValidationError(f"variant {name!r}: {shown_path(path)}: no such file (reference)")


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
