"""Manufactured tubes in files of VTK and XDMF, in cells of several types."""

import contextlib

import meshio
import numpy as np
import pyvista as pv
from tubes import TURN, Tube

from validation.mapping.elements import FACES, HEXAHEDRON, TETRAHEDRON, WEDGE

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


def by_type(cells):
    """VTK type, nodes and domains of all cells of a type together."""
    for kind in dict.fromkeys(kind for kind, _, _ in cells):
        same = [part for part in cells if part[0] == kind]
        domains = np.concatenate([np.full(len(nodes), domain) for _, nodes, domain in same])
        yield kind, np.vstack([nodes for _, nodes, _ in same]), domains


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
    """Fields in two files, as FEniCS writes them; a block for each type of cells.

    Of several types meshio reads no quadratic cells.
    """
    points, arrays = state_of(tube, deformed, factor)
    blocks = [(MESHIO_TYPE[kind], nodes) for kind, nodes, _ in by_type(cells)]
    domain = [domains for _, _, domains in by_type(cells)]
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


def write_ensight(folder, tube, cells, times, **options):
    """EnSight Gold as text; all cells in one part."""
    kinds = {12: "hexa8", 13: "penta6", 10: "tetra4"}

    def text(name, *parts):
        (folder / name).write_text("\n".join(["of tests", *parts]) + "\n")

    for k in range(len(times)):
        points, arrays = state_of(tube, **{"deformed": False, "factor": 1.0} | options)
        places = ["coordinates", f"{len(points):10d}", *(f"{x:12.5e}" for x in points.T.ravel())]
        elements, domains = [], []
        for kind, nodes, of_cells in by_type(cells):
            rows = ["".join(f"{node:10d}" for node in row) for row in (nodes + 1).tolist()]
            elements += [kinds[kind], f"{len(nodes):10d}", *rows]
            domains += [kinds[kind], *(f"{domain:12.5e}" for domain in of_cells)]
        ids = ["of tests", "node id assign", "element id assign"]
        text(f"tube.{k}.geo", *ids, "part", f"{1:10d}", "all", *places, *elements)
        text(f"tube.{k}.Domain_ID", "part", f"{1:10d}", *domains)
        for name, values in arrays.items():
            numbers = [f"{value:12.5e}" for value in values.T.ravel()]
            text(f"tube.{k}.{name}", "part", f"{1:10d}", "coordinates", *numbers)
    (folder / "tube.case").write_text(
        "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: 1 tube.*.geo\nVARIABLE\n"
        "vector per node: 1 Displacement tube.*.Displacement\nvector per node: 1 Velocity tube.*.Velocity\n"
        "scalar per node: 1 Pressure tube.*.Pressure\nscalar per element: 1 Domain_ID tube.*.Domain_ID\n"
        f"TIME\ntime set: 1\nnumber of steps: {len(times)}\nfilename start number: 0\n"
        f"filename increment: 1\ntime values: {' '.join(map(str, times))}\n"
    )
    return {"kind": "vtk", "result_files": str(folder / "tube.case")}


def write_openfoam(folder, tube, times):
    """CFD alone, as OpenFOAM writes it: the lumen with its wall where it is, values of cells."""
    cells = [(block.kind, nodes) for block in tube.lumen for nodes in block.nodes.tolist()]
    owners, neighbours = {}, {}
    for number, (kind, nodes) in enumerate(cells):
        for face in FACES[kind]:
            around = tuple(nodes[n] for n in face)
            seen = owners.setdefault(tuple(sorted(around)), (number, around))
            if seen[0] != number:
                neighbours[tuple(sorted(around))] = number
    inner = [face for face in owners if face in neighbours]
    outer = [face for face in owners if face not in neighbours]

    def text(name, kind, values, head=""):
        path = folder / name
        tail = ";\nboundaryField{wall{type zeroGradient;}}\n" if head else ""
        path.parent.mkdir(parents=True, exist_ok=True)
        about = f"FoamFile{{version 2.0; format ascii; class {kind}; object {path.name};}}\n{head}"
        path.write_text(f"{about}{len(values)}\n(\n" + "\n".join(values) + "\n)\n" + tail)

    def vectors(rows):
        return [f"({x:.9g} {y:.9g} {z:.9g})" for x, y, z in rows]

    mesh = "constant/polyMesh"
    faces = [owners[face][1] for face in inner + outer]
    text(f"{mesh}/points", "vectorField", vectors(tube.coordinates + tube.displacement))
    text(f"{mesh}/faces", "faceList", [f"{len(face)}({' '.join(map(str, face))})" for face in faces])
    text(f"{mesh}/owner", "labelList", [str(owners[face][0]) for face in inner + outer])
    text(f"{mesh}/neighbour", "labelList", [str(neighbours[face]) for face in inner])
    wall = f"wall{{type wall; nFaces {len(outer)}; startFace {len(inner)};}}"
    text(f"{mesh}/boundary", "polyBoundaryMesh", [wall])
    velocity = np.array([tube.velocity[nodes].mean(axis=0) for _, nodes in cells])
    pressure = np.array([tube.nodal_pressure[nodes].mean() for _, nodes in cells]) / 1060.0
    for time in times:
        head = "dimensions [0 1 -1 0 0 0 0]; internalField nonuniform List<vector> "
        text(f"{time:.6g}/U", "volVectorField", vectors(velocity), head)
        head = "dimensions [0 2 -2 0 0 0 0]; internalField nonuniform List<scalar> "
        text(f"{time:.6g}/p", "volScalarField", [f"{value:.9g}" for value in pressure], head)
    (folder / "tube.foam").touch()
    arrays = {"velocity": "U", "pressure": "p", "pressure_density": "1060 kg/m^3"}
    lumen = {"lumen": {"block": "internalMesh"}}
    return {"kind": "vtk", "result_files": str(folder / "tube.foam")} | arrays | lumen
