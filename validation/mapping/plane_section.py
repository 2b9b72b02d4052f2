"""Flow rate through a plane across the artery, by VTK: a check of the ray quadrature that shares no code."""

import numpy as np
import pyvista as pv

from cases.arrays import Floats
from validation.mapping.elements import HEXAHEDRON, NODES, PYRAMID, TETRAHEDRON, WEDGE
from validation.mapping.interpolation import Topology

_VTK_TYPE = {HEXAHEDRON: 12, WEDGE: 13, TETRAHEDRON: 10, PYRAMID: 14}


def lumen_grid(mesh: Topology) -> pv.UnstructuredGrid:
    """Lumen elements as a VTK grid without coordinates yet (all zero)."""
    counts = np.array([NODES[int(kind)] for kind in mesh.kinds])
    cells = [np.append(count, nodes[:count]) for count, nodes in zip(counts, mesh.nodes, strict=True)]
    types = np.array([_VTK_TYPE[int(kind)] for kind in mesh.kinds], dtype=np.uint8)
    return pv.UnstructuredGrid(np.concatenate(cells), types, np.zeros((int(mesh.nodes.max()) + 1, 3)))


def plane_flow_rate(grid: pv.UnstructuredGrid, points: Floats, velocity: Floats, x: float) -> float:
    """Flow rate through the plane at x in the deformed lumen, m³/s.

    Parameters
    ----------
    grid : pyvista.UnstructuredGrid
        From :func:`lumen_grid`; its coordinates are overwritten.
    points, velocity : ndarray (n_nodes, 3)
        Deformed nodes, m, and nodal velocity, m/s, in the artery's frame.
    x : float
        m.
    """
    grid.points = points[: grid.n_points]
    grid.point_data["v_x"] = velocity[: grid.n_points, 0]
    cut = grid.slice(normal="x", origin=(x, 0.0, 0.0), generate_triangles=True)
    return float(cut.integrate_data()["v_x"][0])
