"""The kinds of reference that a case may state.

A kind is its section of the case file here, and the module that reads it, which holds a ``KIND`` and is
imported when it is needed. What is added to :data:`KINDS` before :mod:`cases.sections.case` is imported is
known to every command.
"""

from dataclasses import dataclass

from cases.sections.references.base import ReferenceSection
from cases.sections.references.febio import FebioReference
from cases.sections.references.series import SeriesReference
from cases.sections.references.tables import TablesReference
from cases.sections.references.vtk import VtkReference
from cases.sections.references.xdmf import XdmfReference


@dataclass(frozen=True)
class RegisteredKind:
    """Section of a kind of reference, and the module with the ``KIND`` that reads what the section states."""

    section: type[ReferenceSection]
    reader: str


KINDS = {
    "febio": RegisteredKind(FebioReference, "validation.reference.febio.series"),
    "series": RegisteredKind(SeriesReference, "validation.reference.series"),
    "tables": RegisteredKind(TablesReference, "validation.reference.tables"),
    "vtk": RegisteredKind(VtkReference, "validation.reference.grid.vtk"),
    "xdmf": RegisteredKind(XdmfReference, "validation.reference.grid.xdmf"),
}
