"""The reader of a reference's kind, loaded when it is asked for."""

from importlib import import_module

from cases.sections.case import Case
from cases.sections.references.kinds import KINDS
from validation.errors import ValidationError
from validation.reference.kind import ReferenceKind


def kind_of(variant: str, case: Case) -> ReferenceKind:
    """Kind of a variant's reference; the module that reads it loads when something is first read.

    Raises
    ------
    ValidationError
        If the case states none.
    """
    if case.reference is None:
        raise ValidationError(f"variant {variant!r} states no reference")
    reader = KINDS[case.reference.kind].reader

    def kind() -> ReferenceKind:
        found: ReferenceKind = import_module(reader).KIND
        return found

    return ReferenceKind(
        align=lambda case: kind().align(case),
        read=lambda case, rays, progress, alignment: kind().read(case, rays, progress, alignment),
        how_to_make=lambda stated, path, variant: kind().how_to_make(stated, path, variant),
    )
