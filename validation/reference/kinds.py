"""The reader of a reference's kind, loaded when it is asked for."""

from importlib import import_module

from cases.sections.case import Case
from cases.sections.references.kinds import KINDS
from validation.errors import ValidationError
from validation.reference.kind import ReferenceKind


def kind_of(variant: str, case: Case) -> ReferenceKind:
    """Kind of a variant's reference.

    Raises
    ------
    ValidationError
        If the case states none.
    """
    if case.reference is None:
        raise ValidationError(f"variant {variant!r} states no reference")
    kind: ReferenceKind = import_module(KINDS[case.reference.kind].reader).KIND
    return kind
