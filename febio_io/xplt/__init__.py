"""FEBio plot files (.xplt)."""

from febio_io.xplt.dictionary import Variable
from febio_io.xplt.elements import ELEMENT_TYPES, ElementType
from febio_io.xplt.mesh import Domain, Edge, ElementSet, Mesh, NodeSet, Part, Surface
from febio_io.xplt.objects import ModelObject, ObjectState
from febio_io.xplt.reader import Plot, open_plot

__all__ = [
    "ELEMENT_TYPES",
    "Domain",
    "Edge",
    "ElementSet",
    "ElementType",
    "Mesh",
    "ModelObject",
    "NodeSet",
    "ObjectState",
    "Part",
    "Plot",
    "Surface",
    "Variable",
    "open_plot",
]
