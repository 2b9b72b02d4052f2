"""The kinds of reference that a case may state."""

from validation.reference import tables as tables_reference
from validation.reference.febio import read as febio_reference
from validation.reference.kind import ReferenceKind

REFERENCE_KINDS: dict[str, ReferenceKind] = {
    "febio": ReferenceKind(febio_reference.align_febio, febio_reference.read_febio),
    "tables": ReferenceKind(tables_reference.align_tables, tables_reference.read_tables),
}
