"""Whether a 3D result is that of the case: length, radius, direction of flow, calcification, planes."""

import numpy as np
import pyvista as pv
import xarray as xr

from cases.arrays import Floats
from cases.sections.case import Case
from validation.errors import UnusableReferenceError
from validation.mapping.elements import HEXAHEDRON, NODES, PYRAMID, TETRAHEDRON, WEDGE
from validation.mapping.interpolation import Topology
from validation.mapping.mesh import LumenMesh
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment
from validation.reference.direction import inflow_sign
from validation.reference.mesh.model import MeshModel
from validation.reference.mesh.units import check_velocity_units

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


RADIUS_TOLERANCE = 1e-2  # and the mean radius of its unloaded interface by this share
LENGTH_TOLERANCE = 1e-3  # the mesh's length may differ from the case's by this share


def check_times(times: Floats) -> None:
    """Refuse states whose times do not increase."""
    for place in np.flatnonzero(np.diff(times) <= 0)[:1]:
        raise UnusableReferenceError(
            f"states {place + 1} and {place + 2} have times {times[place]:.9g} and "
            f"{times[place + 1]:.9g} s; allowed: times that increase"
        )


def check_length(mesh: LumenMesh, case: Case) -> None:
    """Refuse a lumen of another length than the case's, or one that starts elsewhere."""
    first = float(mesh.coordinates[mesh.inlet, 0].min())
    tolerance = LENGTH_TOLERANCE * case.geometry.length
    if abs(mesh.length - case.geometry.length) > tolerance or abs(first) > tolerance:
        raise UnusableReferenceError(
            f"the lumen runs from x = {first:.6g} m over {mesh.length:.6g} m; the case's artery "
            f"starts at reference.origin and is {case.geometry.length:.6g} m long (geometry.length)"
        )


def check_radius(mesh: LumenMesh, case: Case) -> None:
    """Refuse an unloaded interface of another mean radius than the case's."""
    across = mesh.coordinates[mesh.interface_nodes, 1:]
    radius = float(np.mean(np.hypot(across[:, 0], across[:, 1])))
    if abs(radius - case.geometry.radius) > RADIUS_TOLERANCE * case.geometry.radius:
        raise UnusableReferenceError(
            f"the unloaded lumen's radius is {radius:.6g} m on average about reference.origin; "
            f"the case's is {case.geometry.radius:.6g} m (geometry.radius)"
        )


def check_inflow(inflow: Floats, area: Floats, alignment: Alignment, case: Case) -> None:
    """Refuse a reference whose blood flows against the prescribed inflow, or is of other units.

    Parameters
    ----------
    inflow, area : ndarray (n_states,)
        Flow rate through the inlet and its area at the instants of ``alignment``, m³/s and m².
    alignment : Alignment
    case : Case
    """
    mean = float(np.mean(inflow))
    if inflow_sign(case, alignment) * mean < 0:
        raise UnusableReferenceError(
            f"blood flows against the inflow of the case ({mean:.3g} m³/s on average at "
            "reference.origin): reference.axis and origin must follow the flow"
        )
    check_velocity_units(inflow, area, alignment, case)


def plane_checks(model: MeshModel, alignment: Alignment, case: Case, rays: Rays) -> xr.Dataset:
    """Flow rates through planes at a few states, by surface integral."""
    sections = np.array(case.compare.cells.i) - 1
    few = np.unique(np.linspace(0, len(alignment.states) - 1, 5).astype(int))
    grid = lumen_grid(model.mesh.lumen)
    planes = np.empty((few.size, sections.size))
    for row, number in enumerate(alignment.states[few].tolist()):
        points, velocity, _ = model.read(number)
        planes[row] = [plane_flow_rate(grid, points, velocity, float(x)) for x in rays.x[sections]]
    return xr.Dataset(
        {"plane_flow_rate": (("check_time", "check_x"), planes)},
        coords={
            "time": alignment.cycle_times,
            "check_time": alignment.cycle_times[few],
            "check_x": rays.x[sections],
        },
    )
