"""The table of element types against VTK's own cells."""

import numpy as np
import pytest
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkTriQuadraticHexahedron

from febio_io.xplt import ELEMENT_TYPES


@pytest.mark.parametrize("element", ELEMENT_TYPES.values(), ids=lambda element: element.name)
def test_vtk_cells_have_as_many_points_as_are_given(element):
    cell = vtkGenericCell()
    cell.SetCellType(element.vtk_type)
    assert cell.GetNumberOfPoints() == len(element.vtk_order)
    assert set(element.vtk_order) <= set(range(element.nodes))


def test_codes_are_complete_and_names_differ():
    assert list(ELEMENT_TYPES) == list(range(20))
    assert len({element.name for element in ELEMENT_TYPES.values()}) == 20


def test_hex27_face_nodes_are_put_where_vtk_has_them():
    # FEBio's nodes 20 to 26 lie at -s, +r, +s, -r, -t, +t and the centre, with r, s, t from -1 to 1.
    febio = np.array([[0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, 0, -1], [0, 0, 1], [0, 0, 0]])
    hexahedron = vtkTriQuadraticHexahedron()
    vtk = 2 * np.array(hexahedron.GetParametricCoords()).reshape(27, 3) - 1
    order = np.array(ELEMENT_TYPES[9].vtk_order[20:]) - 20
    np.testing.assert_array_equal(febio[order], vtk[20:])
