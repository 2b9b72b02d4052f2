"""Manufactured tubes in files of VTK and XDMF, in cells of several types."""

import contextlib

import meshio
import numpy as np
import pyvista as pv
from tubes import TURN, Tube

from validation.mapping.elements import HEXAHEDRON, TETRAHEDRON, WEDGE

VTK_TYPE = {HEXAHEDRON: 12, WEDGE: 13, TETRAHEDRON: 10}
MESHIO_TYPE = {12: "hexahedron", 13: "wedge", 10: "tetra", 24: "tetra10"}
EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def cells_of(tube: Tube, cells: str) -> tuple[Tube, list[tuple[int, np.ndarray, int]]]:
    """The tube, and (VTK type, nodes, domain: 1 lumen, 2 wall) of its cells."""
    parts = [(block, 1) for block in tube.lumen] + [(block, 2) for block in tube.vessel_wall]
    found = [(VTK_TYPE[block.kind], block.nodes, domain) for block, domain in parts]
    if cells == "wedges":
        return tube, [part for each in found for part in _halved(*each)]
    return _with_middles(tube, found) if cells == "quadratic" else (tube, found)


def _halved(kind, nodes, domain):
    if kind != 12:
        return [(kind, nodes, domain)]
    return [(13, nodes[:, three], domain) for three in ([0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7])]


def _with_middles(tube, linear):
    """Tetrahedra of ten nodes; those at half of the edges lie on the tube's own stations."""
    x, phi, r = tube._stations
    edges = np.sort(np.concatenate([nodes[:, edge] for _, nodes, _ in linear for edge in EDGES]), axis=1)
    known, inverse = np.unique(edges, axis=0, return_inverse=True)
    a, b = known.T
    turn = (phi[b] - phi[a] + np.pi) % TURN - np.pi
    middle = np.where(r[a] == 0, phi[b], np.where(r[b] == 0, phi[a], phi[a] + 0.5 * turn))
    stations = ((x[a] + x[b]) / 2, middle % TURN, (r[a] + r[b]) / 2)
    whole = Tube(**{name: getattr(tube, name) for name in tube.__dataclass_fields__})
    whole.__dict__["_stations"] = tuple(np.append(*pair) for pair in zip((x, phi, r), stations, strict=True))
    numbers = len(x) + inverse
    found, at = [], 0
    for _, nodes, domain in linear:
        count = len(nodes)
        extra = [numbers[at + k * count : at + (k + 1) * count] for k in range(6)]
        found.append((24, np.column_stack([nodes, *extra]), domain))
        at += 6 * count
    return whole, found


def state_of(tube, deformed, factor):
    points = tube.coordinates + (tube.displacement if deformed else 0.0)
    arrays = {"Displacement": tube.displacement, "Velocity": factor * tube.velocity}
    return points, arrays | {"Pressure": tube.nodal_pressure}


def grid_of(tube, cells, deformed=False, factor=1.0):
    """One state as VTK's grid."""
    points, arrays = state_of(tube, deformed, factor)
    flat = [np.insert(nodes, 0, nodes.shape[1], axis=1).ravel() for _, nodes, _ in cells]
    types = [np.full(len(nodes), kind, np.uint8) for kind, nodes, _ in cells]
    grid = pv.UnstructuredGrid(np.concatenate(flat), np.concatenate(types), points)
    for name, values in arrays.items():
        grid.point_data[name] = values
    grid.cell_data["Domain_ID"] = np.concatenate([np.full(len(nodes), d) for _, nodes, d in cells])
    return grid


def write_pvd(folder, tube, cells, times, **options):
    entries = []
    for k, time in enumerate(times):
        grid_of(tube, cells, **options).save(folder / f"tube_{k}.vtu")
        entries.append(f'<DataSet timestep="{time}" part="0" file="tube_{k}.vtu"/>')
    text = f'<VTKFile type="Collection"><Collection>{"".join(entries)}</Collection></VTKFile>'
    (folder / "tube.pvd").write_text(text)
    return {"kind": "vtk", "result_files": str(folder / "tube.pvd")}


def write_legacy(folder, tube, cells, times, **options):
    """Files by number, whose digits grow; the time is in the rule."""
    for k in range(len(times)):
        grid_of(tube, cells, **options).save(folder / f"tube_{k + 8}.vtk")
    step = times[1] - times[0]
    return {
        "kind": "vtk",
        "result_files": str(folder / "tube_{:d}.vtk"),
        "time_step": f"{step} s",
        "time_offset": f"{8 * step} s",
    }


def write_xdmf(folder, tube, cells, times, deformed=False, factor=1.0):
    """Fields in two files, as FEniCS writes them; cells of one type in one block, as meshio reads quadratic."""
    points, arrays = state_of(tube, deformed, factor)
    alike = {kind: [part for part in cells if part[0] == kind] for kind, _, _ in cells}
    blocks = [(MESHIO_TYPE[kind], np.vstack([part[1] for part in same])) for kind, same in alike.items()]
    domain = [np.concatenate([np.full(len(part[1]), part[2]) for part in same]) for same in alike.values()]
    first = {"Velocity": arrays["Velocity"]}
    rest = {name: values for name, values in arrays.items() if name != "Velocity"}
    with contextlib.chdir(folder):  # meshio writes the HDF5 file into the working folder
        for name, point_data in (("velocity", first), ("rest", rest)):
            with meshio.xdmf.TimeSeriesWriter(f"{name}.xdmf") as writer:
                writer.write_points_cells(points, blocks)
                for time in times:
                    writer.write_data(time, point_data=point_data, cell_data={"Domain_ID": domain})
    return {"kind": "xdmf", "result_files": [str(folder / f"{name}.xdmf") for name in ("velocity", "rest")]}


WRITERS = {"pvd": write_pvd, "legacy": write_legacy, "xdmf": write_xdmf}
