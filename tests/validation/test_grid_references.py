"""References of VTK and XDMF: tubes of formulas in cells of every type, and what may be wrong with files."""

import copy
from xml.etree import ElementTree

import h5py
import numpy as np
import pytest
import pyvista as pv
from small_case import bands, small_case, written
from tube_grids import WRITERS, cells_of, grid_of, write_ensight, write_openfoam, write_pvd, write_xdmf
from tubes import Tube

from cases.reading.case_file import load_case_file
from validation.reference.kinds import kind_of
from validation.reference.mesh.read import RIGID

TIMES = np.linspace(0.0, 2.392 / 3, 5)
COARSE = Tube(sectors=12, rings=4, stacks=10, layers=2)
ARRAYS = {"velocity": "Velocity", "pressure": "Pressure", "displacement": "Displacement"}
PARTS = {
    "lumen": {"array": "Domain_ID", "values": [1]},
    "wall": {"array": "Domain_ID", "values": [2]},
}
STATED = {"axis": "x", "phi_zero": "y"} | ARRAYS | PARTS


def case_with(reference, without=()):
    content = bands(small_case("none"))
    del content["variants"]["none"]["reference"]
    content["reference"] = {key: value for key, value in reference.items() if key not in without}
    return content


def read(folder, reference, tube=COARSE, without=()):
    path = written(case_with(reference, without), folder)
    case = load_case_file(path).variants["none"]
    return kind_of("none", case).read(case, tube.cells(12, 8), None, None)


def errors(found, tube):
    cells = tube.cells(12, 8)
    fields = found.fields.isel(time=2)
    flow = np.array([tube.flow_rate(x) for x in cells.x])
    wall = tube.wall(cells.x[:, None], cells.phi[None, :])
    return (
        np.max(np.abs(fields["radius"].to_numpy() / wall - 1)),
        np.max(np.abs(fields["section_flow_rate"].to_numpy() / flow - 1)),
    )


@pytest.mark.slow
@pytest.mark.parametrize("files", WRITERS)
@pytest.mark.parametrize("cells", ["hexahedra", "wedges", "tetrahedra", "quadratic"])
def test_a_tube_in_files(tmp_path, files, cells):
    tube = Tube(sectors=16, rings=6, stacks=12, layers=1, tetrahedra=cells in ("tetrahedra", "quadratic"))
    written_tube, parts = cells_of(tube, cells)
    stated = STATED | WRITERS[files](tmp_path, written_tube, parts, TIMES)
    found = read(tmp_path, stated, tube)
    radius, flow = errors(found, tube)
    assert radius < (1e-3 if cells == "quadratic" else 3e-3)
    assert flow < (0.015 if cells == "quadratic" else 0.045)  # 16 sides enclose 2.6 % less
    assert found.description["states_compared"] == 5
    assert found.warnings == ()


@pytest.mark.long
@pytest.mark.parametrize("files", WRITERS)
@pytest.mark.parametrize("cells", ["hexahedra", "wedges", "tetrahedra", "quadratic"])
def test_a_fine_tube_in_files(tmp_path, files, cells):
    coarser = cells == "quadratic"
    tube = Tube(
        sectors=24 if coarser else 48,
        rings=8 if coarser else 16,
        stacks=20 if coarser else 40,
        layers=1,
        tetrahedra=cells in ("tetrahedra", "quadratic"),
    )
    written_tube, parts = cells_of(tube, cells)
    found = read(tmp_path, STATED | WRITERS[files](tmp_path, written_tube, parts, TIMES[:3]), tube)
    radius, flow = errors(found, tube)
    assert radius < 1e-3
    assert flow < 0.01


@pytest.mark.parametrize("write", [write_pvd, write_xdmf])
def test_deformed_points(tmp_path, write):
    tube, parts = cells_of(COARSE, "hexahedra")
    stated = STATED | {"positions": "deformed"} | write(tmp_path, tube, parts, TIMES, deformed=True)
    plain = STATED | write(tmp_path, tube, parts, TIMES, deformed=True)
    radius, _ = errors(read(tmp_path, stated), COARSE)
    assert radius < 5e-3
    with pytest.raises(Exception, match="the unloaded lumen's radius is"):
        read(tmp_path, plain)


def test_ensight(tmp_path):
    tube = Tube(sectors=16, rings=6, stacks=12, layers=1)
    found = read(tmp_path, STATED | write_ensight(tmp_path, *cells_of(tube, "hexahedra"), TIMES), tube)
    radius, flow = errors(found, tube)
    assert radius < 3e-3
    assert flow < 0.045


def test_openfoam(tmp_path):
    """CFD alone with values of cells: their means carry the flow, and nothing slips at the wall."""
    tube = Tube(sectors=24, rings=8, stacks=20)
    found = read(tmp_path, {"axis": "x", "phi_zero": "y"} | write_openfoam(tmp_path, tube, TIMES), tube)
    radius, flow = errors(found, tube)
    assert radius < 2e-3
    assert flow < 0.02  # 24 sides enclose 1.1 % less
    pressure = found.fields["section_pressure"].isel(time=0)
    np.testing.assert_allclose(pressure, tube.pressure(pressure["x"]), rtol=2e-4)
    assert RIGID in found.notes
    assert found.warnings == ()


def test_rigid_walls(tmp_path):
    """CFD alone: no wall, no displacement; the lumen's surface is the wall, wherever the mesh has it."""
    tube, parts = cells_of(COARSE, "hexahedra")
    lumen = [part for part in parts if part[2] == 1]
    stated = STATED | write_pvd(tmp_path, tube, lumen, TIMES, deformed=True)
    found = read(tmp_path, stated, without=("displacement", "lumen", "wall"))
    radius, _ = errors(found, COARSE)
    assert radius < 5e-3
    assert RIGID in found.notes


def doubled(folder, apart=0.0):
    """Lumen and wall in files of their own, each with nodes at the interface."""
    tube, parts = cells_of(COARSE, "hexahedra")
    for k in range(len(TIMES)):
        whole = grid_of(tube, parts)
        for name, domain in (("fluid", 1), ("solid", 2)):
            part = whole.extract_cells(whole.cell_data["Domain_ID"] == domain)
            part = pv.UnstructuredGrid(part)
            if name == "solid":
                part.point_data["Displacement"] = part.point_data["Displacement"] + apart
                del part.point_data["Velocity"], part.point_data["Pressure"]
            part.save(folder / f"{name}_{k:03d}.vtu")
    files = [str(folder / f"{name}_{{:03d}}.vtu") for name in ("fluid", "solid")]
    parts = {"lumen": {"file": files[0]}, "wall": {"file": files[1]}}
    rule = {"result_files": files, "time_step": f"{TIMES[1]} s"}
    return {"kind": "vtk", "axis": "x", "phi_zero": "y"} | ARRAYS | parts | rule


def test_doubled_nodes_in_two_files(tmp_path):
    found = read(tmp_path, doubled(tmp_path))
    assert errors(found, COARSE)[0] < 5e-3
    assert found.description["nodes"] == len(COARSE.coordinates)


def rotated_in_the_middle(folder):
    grid = pv.read(folder / "tube_2.vtu")
    grid.extract_cells(np.arange(grid.n_cells - 1)).save(folder / "tube_2.vtu")


def moved_points(folder):
    grid = pv.read(folder / "tube_2.vtu")
    grid.points = grid.points + grid.point_data["Displacement"]
    grid.save(folder / "tube_2.vtu")


def without_velocity(folder):
    grid = pv.read(folder / "tube_2.vtu")
    del grid.point_data["Velocity"]
    grid.save(folder / "tube_2.vtu")


def bare_nodes(folder):
    grid = pv.read(folder / "tube_2.vtu")
    grid.point_data["Velocity"][:7] = np.nan
    grid.save(folder / "tube_2.vtu")


def back_in_time(folder):
    path = folder / "tube.pvd"
    text = path.read_text()
    path.write_text(text.replace(f'timestep="{TIMES[2]}"', f'timestep="{TIMES[1]}"'))


def scaled(folder, name, factor):
    for k in range(len(TIMES)):
        grid = pv.read(folder / f"tube_{k}.vtu")
        grid.point_data[name] *= factor
        grid.save(folder / f"tube_{k}.vtu")


def scaled_pressure(folder):
    scaled(folder, "Pressure", 10.0)


def fast_blood(folder):
    scaled(folder, "Velocity", 100.0)


def blood_backwards(folder):
    scaled(folder, "Velocity", -1.0)


def blood_paths(folder):
    """A displacement that is the path of the blood, as svMultiPhysics' FS_Displacement."""
    for k in range(len(TIMES)):
        grid = pv.read(folder / f"tube_{k}.vtu")
        grid.point_data["Displacement"] += 0.1 * k * grid.point_data["Velocity"]
        grid.save(folder / f"tube_{k}.vtu")


def surface_cells(folder):
    tube, parts = cells_of(COARSE, "hexahedra")
    write_pvd(folder, tube, [*parts, (5, parts[0][1][:1, :3], 1)], TIMES)


def cut_file(folder):
    content = (folder / "tube_2.vtu").read_bytes()
    (folder / "tube_2.vtu").write_bytes(content[: len(content) // 2])


def unchanged(folder):
    return None


WRONG = [
    (
        unchanged,
        {"velocity": "U"},
        "reference.velocity: no array 'U'; there are: of points: Displace",
    ),
    (
        unchanged,
        {"pressure": "Velocity"},
        "reference.pressure: array 'Velocity' has 3 components; allow",
    ),
    (
        unchanged,
        {"lumen": {"array": "Mesh", "values": [1]}},
        "lumen.array: no array 'Mesh' of cells",
    ),
    (unchanged, {"lumen": {"array": "Domain_ID", "values": [4]}}, "no cell has Domain_ID 4; there are: 1, 2"),
    (unchanged, {"lumen": {"array": "Domain_ID", "values": [2]}}, "cells are in both"),
    (unchanged, {"lumen": {"block": "blood"}}, "reference.lumen.block: no block 'blood'; there are: none"),
    (unchanged, {"calcified": {"array": "Domain_ID", "values": [1]}}, "cells are not in reference.wall"),
    (unchanged, {"length_unit": "mm"}, "reference.length_unit cannot be right; m would fit"),
    (
        unchanged,
        {"time_unit": "ms"},
        "are at 0 to 0.000797 s of the cycle (reference.time_offset, time_unit)",
    ),
    (unchanged, {"pressure_unit": "kPa"}, "reference.pressure_unit cannot be right; Pa would fit"),
    (
        unchanged,
        {"time_step": "1 ms"},
        "the files state their times; allowed: no time_step",
    ),
    (unchanged, {"axis": "-"}, "reference.axis"),
    (unchanged, {"lumen": {"array": "Domain_ID"}}, "allowed: {array: …, values: […]}, {file: …} or {block"),
    (
        unchanged,
        {"first": 7, "last": 9},
        "9; allowed: a number that leaves files; there are numbers from 0",
    ),
    (
        unchanged,
        {"pressure_unit": "kPa", "pressure_density": "1060 kg/m^3"},
        "1060 kg/m^3; allowed: no pressure_unit beside a kinematic pressure",
    ),
    (fast_blood, {}, "reference.length_unit over reference.time_unit, cannot be right"),
    (blood_backwards, {}, "blood flows against the inflow of the case"),
    (rotated_in_the_middle, {}, "tube_2.vtu: another mesh than in the first file"),
    (moved_points, {}, "so that they are deformed ones; allowed: reference.positions deformed"),
    (
        without_velocity,
        {},
        "tube_2.vtu: reference.velocity: no array 'Velocity' of nodes",
    ),
    (bare_nodes, {}, "nodes of the lumen have no velocity (Velocity)"),
    (back_in_time, {}, "allowed: times that increase"),
    (scaled_pressure, {}, "reference.pressure_unit cannot be right; dyn/cm^2 would fit"),
    (blood_paths, {}, "the wall does not move with the lumen; positions must be those of the mesh"),
    (surface_cells, {}, "reference.lumen: cells of type 1 triangle beside"),
    (cut_file, {}, "tube_2.vtu: VTK cannot read it"),
]


@pytest.mark.parametrize(("damage", "stated", "message"), WRONG, ids=lambda x: getattr(x, "__name__", None))
def test_what_is_wrong_is_told(tmp_path, refused, damage, stated, message):
    tube, parts = cells_of(COARSE, "hexahedra")
    folder = tmp_path / "files"
    folder.mkdir()
    reference = STATED | write_pvd(folder, tube, parts, TIMES)
    damage(folder)
    assert message in refused(case_with(reference | stated))


def other_times(folder):
    path = folder / "rest.xdmf"
    path.write_text(path.read_text().replace(f'Value="{TIMES[2]}"', f'Value="{TIMES[2] + 0.01}"'))


def another_mesh(folder):
    with h5py.File(folder / "rest.h5", "r+") as file:
        points = next(data for data in file.values() if data.dtype == float and data.ndim == 2)
        points[0] += 1e-4


def no_heavy_data(folder):
    (folder / "rest.h5").unlink()


def two_series(folder):
    path = folder / "rest.xdmf"
    tree = ElementTree.parse(path)  # noqa: S314 - written above
    domain = tree.getroot().find("Domain")
    domain.append(copy.deepcopy(next(grid for grid in domain if grid.get("CollectionType") == "Temporal")))
    tree.write(path)


WRONG_XDMF = [
    (other_times, "rest.xdmf: other times than velocity.xdmf"),
    (another_mesh, "rest.xdmf: another mesh than velocity.xdmf; allowed: one mesh in all files"),
    (no_heavy_data, "rest.xdmf: meshio cannot read it"),
    (two_series, "rest.xdmf: 2 series in one file (TimeSeries_meshio, TimeSeries_meshio); allowed: a file"),
]


@pytest.mark.parametrize(("damage", "message"), WRONG_XDMF, ids=lambda x: getattr(x, "__name__", None))
def test_what_is_wrong_with_xdmf_is_told(tmp_path, refused, damage, message):
    tube, parts = cells_of(COARSE, "hexahedra")
    folder = tmp_path / "files"
    folder.mkdir()
    reference = STATED | write_xdmf(folder, tube, parts, TIMES)
    damage(folder)
    assert message in refused(case_with(reference))


def test_a_wall_apart_is_told(tmp_path, refused):
    folder = tmp_path / "files"
    folder.mkdir()
    line = refused(case_with(doubled(folder, apart=1e-4)))
    assert "coincide in the unloaded mesh are up to 0.000173 m apart: the wall does not move" in line


def test_files_without_times_are_told(tmp_path, refused):
    tube, parts = cells_of(COARSE, "hexahedra")
    folder = tmp_path / "files"
    folder.mkdir()
    write_pvd(folder, tube, parts, TIMES)
    pattern = {"kind": "vtk", "result_files": str(folder / "tube_{:d}.vtu")}
    line = refused(case_with(STATED | pattern))
    assert "no time in the file (no field data TimeValue); allowed: reference.time_step" in line


@pytest.mark.parametrize("files", ["tube_{:d}.vtu", "tube_{x}.vtu", "tube.vtu"])
def test_files_that_are_not_there(tmp_path, refused, files):
    line = refused(case_with(STATED | {"kind": "vtk", "result_files": files}))
    assert "reference.result_files" in line
    assert "no file of this pattern" in line or "one field" in line or "no such file" in line
