"""The one table of FEBio's element types."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ElementType:
    """One element type.

    Attributes
    ----------
    code : int
        Number in the plot file.
    name : str
        FEBio's name, in lower case.
    nodes : int
        Nodes of an element.
    vtk_type : int
        VTK cell type. Where VTK has no such cell, that with the same corners and fewer nodes.
    vtk_order : tuple of int
        FEBio's local nodes in VTK's order; shorter than `nodes` where the VTK cell leaves nodes out.
    """

    code: int
    name: str
    nodes: int
    vtk_type: int
    vtk_order: tuple[int, ...]


def _row(
    code: int, name: str, nodes: int, vtk_type: int, vtk_order: tuple[int, ...] | None = None
) -> ElementType:
    return ElementType(code, name, nodes, vtk_type, vtk_order or tuple(range(nodes)))


# VTK's face nodes are -r, +r, -s, +s, -t, +t; FEBio's are -s, +r, +s, -r, -t, +t.
HEX27_TO_VTK = (*range(20), 23, 21, 20, 22, 24, 25, 26)

ELEMENT_TYPES = {
    element.code: element
    for element in (
        _row(0, "hex8", 8, 12),
        _row(1, "penta6", 6, 13),
        _row(2, "tet4", 4, 10),
        _row(3, "quad4", 4, 9),
        _row(4, "tri3", 3, 5),
        _row(5, "line2", 2, 3),
        _row(6, "hex20", 20, 25),
        _row(7, "tet10", 10, 24),
        _row(8, "tet15", 15, 24, tuple(range(10))),
        _row(9, "hex27", 27, 29, HEX27_TO_VTK),
        _row(10, "tri6", 6, 22),
        _row(11, "quad8", 8, 23),
        _row(12, "quad9", 9, 28),
        _row(13, "penta15", 15, 26),
        _row(14, "tet20", 20, 10, tuple(range(4))),
        _row(15, "tri10", 10, 5, tuple(range(3))),
        _row(16, "pyra5", 5, 14),
        _row(17, "tet5", 5, 10, tuple(range(4))),
        _row(18, "pyra13", 13, 27),
        _row(19, "line3", 3, 21),
    )
}
