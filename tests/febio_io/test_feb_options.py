"""Models of other cases than the ready ones: frames, meshes, walls, outlets, and what cannot be a model."""

from pathlib import Path

import numpy as np
import pytest
import pyvista as pv
from feb_contents import Parsed
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from ruamel.yaml import YAML

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file
from febio_io.feb.calcified import calcified_elements
from febio_io.feb.command import main
from febio_io.feb.cross_section import cross_section
from febio_io.feb.model import FebioModelError, Frame, MeshSize, Patch, Vessel
from febio_io.feb.structure import read_structure
from febio_io.feb.tube_mesh import tube_mesh

ROOT = Path(__file__).parents[2]
VESSEL = Vessel(15e-3, 2.5e-3, 0.5e-3)
SMALL = MeshSize(8, 3, 2, 12)
O_GRID = MeshSize(16, 3, 2, 12, core="o_grid")


@pytest.fixture
def write(tmp_path):
    """Write the model of a changed case: sections to merge, and options."""

    def written(*options, variant="none", **sections):
        case = YAML().load(ROOT / "cases/calcification.yaml")
        case["inlet"]["waveform"] = str(ROOT / case["inlet"]["waveform"])
        own = case["variants"][variant]
        del case["models"]
        case["compare"]["times"] = ["end diastole"]
        own["reference"] = {"plot_file": "missing.xplt", "generate": sections.pop("generate", {})}
        case["variants"] = {variant: own}
        for name, changes in sections.items():
            target = own if name in own else case
            if changes.pop("replace", False):
                target[name] = changes
            else:
                target[name] |= changes
        path = tmp_path / "case.yaml"
        with path.open("w") as stream:
            YAML().dump(case, stream)
        return main([str(path), "--output", str(tmp_path / "model.feb"), *options])

    return written


def volumes(mesh):
    cells = np.hstack(
        [np.insert(part - 1, 0, part.shape[1], axis=1).ravel() for part in (mesh.core, mesh.lumen, mesh.wall)]
    )
    core = {6: pv.CellType.WEDGE, 8: pv.CellType.HEXAHEDRON}[mesh.core.shape[1]]
    kinds = np.repeat(
        [core, pv.CellType.HEXAHEDRON, pv.CellType.HEXAHEDRON],
        [len(mesh.core), len(mesh.lumen), len(mesh.wall)],
    )
    return pv.UnstructuredGrid(cells, kinds, mesh.nodes).compute_cell_sizes(length=False, area=False)[
        "Volume"
    ]


@pytest.mark.parametrize("size", [SMALL, O_GRID])
@pytest.mark.parametrize("axis", "xyz")
@pytest.mark.parametrize("phi_zero", ["x", "y", "z", "-x", "-y", "-z"])
def test_elements_are_right_handed_along_any_axis(size, axis, phi_zero):
    if phi_zero[-1] == axis:
        return
    frame = Frame(axis, phi_zero, (1e-3, -2e-3, 3e-3))
    mesh = tube_mesh(VESSEL, size, frame)
    found = volumes(mesh)
    assert found.min() > 0
    polygon = 0.5 * size.n_theta * np.sin(2 * np.pi / size.n_theta)
    assert found.sum() == pytest.approx(polygon * 3e-3**2 * 15e-3)
    for name, sign in (("Inlet", -1), ("Outlet", 1)):
        for facets in mesh.surfaces[name]:
            a, b, c = (mesh.nodes[facets.nodes[:, k] - 1] for k in range(3))
            assert (sign * np.cross(b - a, c - a)[:, "xyz".index(axis)] > 0).all()
    (interface,) = mesh.surfaces["Interface"]
    a, b, c = (mesh.nodes[interface.nodes[:, k] - 1] - np.array(frame.origin) for k in range(3))
    assert ((np.cross(b - a, c - a) * a).sum(axis=1) > 0).all()


@pytest.mark.parametrize("size", [SMALL, O_GRID, MeshSize(24, 8, 3, 2, core="o_grid", bias=3.0)])
def test_every_node_belongs_to_an_element_and_no_two_coincide(size):
    mesh = tube_mesh(VESSEL, size, Frame())
    assert len(mesh.core) + len(mesh.lumen) + len(mesh.wall) == size.n_elements
    assert len(mesh.core) == size.core_elements * size.n_z
    assert_allclose(mesh.nodes[mesh.axis - 1, :2], 0)
    assert_allclose(np.hypot(*mesh.nodes[mesh.interface - 1, :2].T), 2.5e-3)
    assert set(mesh.blood) == set(np.concatenate([mesh.core.ravel(), mesh.lumen.ravel()]))
    assert set(mesh.inlet) == set(mesh.blood[mesh.blood <= len(mesh.nodes) // (size.n_z + 1)]) - set(
        mesh.interface
    )
    used = np.unique(np.concatenate([part.ravel() for part in (mesh.core, mesh.lumen, mesh.wall)]))
    assert used.tolist() == list(range(1, len(mesh.nodes) + 1))
    assert len(np.unique(np.round(mesh.nodes, 9), axis=0)) == len(mesh.nodes)


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 30), st.floats(0.05, 20))
def test_the_bias_grades_the_lumen_alone(n_r, bias):
    section = cross_section(VESSEL, MeshSize(8, n_r, 4, 2, bias))
    found = section.points[section.rings[:, 0] - 1, 0]
    widths = np.diff(found, prepend=0)
    assert_allclose(widths[0] / widths[n_r - 1], bias, rtol=1e-9)
    assert found[n_r - 1] == VESSEL.radius
    assert_allclose(widths[n_r:], VESSEL.thickness / 4)


@settings(max_examples=80, deadline=None)
@given(
    st.integers(2, 12).map(lambda k: 4 * k),
    st.integers(2, 40),
    st.floats(0, 360),
    st.floats(60, 350),
    st.floats(0, 7e-3),
)
def test_the_told_extent_is_that_of_the_elements(n_theta, n_z, first, width, begin):
    size = MeshSize(n_theta, 2, 2, n_z)
    phi = tuple(np.radians([first % 360, (first + width) % 360]))
    patch = Patch(1e7, (begin, begin + 7.9e-3), phi)
    found = calcified_elements(VESSEL, size, patch)
    mesh = tube_mesh(VESSEL, size, Frame())
    corners = mesh.nodes[mesh.wall[found.elements] - 1]
    x = corners[..., 2].min(), corners[..., 2].max()
    assert abs(x[0] - patch.x[0]) <= 0.5 * 15e-3 / n_z + 1e-12
    aligned = max(abs(x[0] - patch.x[0]), abs(x[1] - patch.x[1])) < 1e-9 * 15e-3
    told = f"x from {1e3 * x[0]:.6g} to {1e3 * x[1]:.6g} mm"
    assert aligned or told in found.warning
    centre = np.arctan2(*corners.mean(axis=1)[:, 1::-1].T) % (2 * np.pi)
    assert ((centre - phi[0]) % (2 * np.pi) <= np.radians(width) + 1e-6).all()


def test_a_patch_across_phi_zero_and_one_all_round():
    size = MeshSize(8, 2, 1, 3)
    across = calcified_elements(VESSEL, size, Patch(1e7, (5e-3, 10e-3), tuple(np.radians([315, 45]))))
    assert np.flatnonzero(across.elements).tolist() == [8, 15]
    assert across.warning is None
    around = calcified_elements(VESSEL, size, Patch(1e7, (5e-3, 10e-3), (0.0, 2 * np.pi)))
    assert np.flatnonzero(around.elements).tolist() == list(range(8, 16))
    assert around.warning is None


def test_a_calcification_that_the_mesh_does_not_follow_is_told(write, capsys):
    assert write("--mesh", "20,4,1,14", variant="local") == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert (
        "local: calcification: the mesh has no element edges at its own; it becomes x from 5.35714 to" in line
    )
    assert "instead of 5 to 10 mm and φ from 126 to 234 deg instead of 135 to 225 deg" in line


def test_a_calcification_between_the_centres_is_refused(write, capsys):
    assert write("--mesh", "8,2,1,2", variant="local", calcification={"x": ["7 mm", "8 mm"]}) == 2
    assert "it holds no centre of an element; the mesh needs more elements along" in capsys.readouterr().err


def test_a_model_in_another_frame(write, tmp_path):
    reference = {"axis": "x", "phi_zero": "-z", "origin": ["1 mm", "0 mm", "0 mm"]}
    assert write("--mesh", "8,2,1,4", "--data-records", reference=reference) == 0
    model = Parsed(tmp_path / "model.feb")
    points = np.array(list(model.places.values())) * 1e-12
    assert_allclose([points[:, 0].min(), points[:, 0].max()], [1e-3, 16e-3])
    for kind, nodes, (_, _, parameters) in model.conditions():
        if kind == "zero displacement":
            fixed = {name[0] for name, value in parameters if value[1] == 1.0}
            for axis in fixed - {"x"}:  # what is fixed across the axis is zero there
                assert {node["xyz".index(axis)] for node in nodes} == {0}
    assert "fvx" in model.output()[2][1][1][0][1]
    assert read_structure(tmp_path / "model.feb").n_steps > 0


@pytest.mark.parametrize(
    ("law", "material"),
    [
        ("thin", "isotropic elastic"),
        ("saint_venant_kirchhoff", "isotropic elastic"),
        ("neo_hookean", "neo-Hookean"),
    ],
)
def test_wall_laws(write, tmp_path, law, material):
    assert write("--mesh", "8,2,1,3", wall={"law": law}, variant="axisymmetric") == 0
    found = Parsed(tmp_path / "model.feb").materials()
    assert {found[name][0] for name in ("Healthy", "Calcified")} == {(("type", material),)}


@pytest.mark.parametrize(
    ("outlet", "kind", "expected"),
    [
        (
            {"kind": "windkessel", "proximal_resistance": "1e8 Pa s/m^3", "distal_resistance": "2e9 Pa s/m^3"}
            | {"compliance": "1e-10 m^3/Pa", "venous_pressure": "100 Pa"},
            "fluid RCR",
            {"R": 1e8, "Rd": 2e9, "capacitance": 1e-10, "pressure_offset": 1, "initial_pressure": 0},
        ),
        ({"kind": "pressure", "value": "12 kPa"}, "fluid pressure", {"pressure": 1}),
    ],
)
def test_other_outlets(write, tmp_path, outlet, kind, expected):
    assert write("--mesh", "8,2,1,3", outlet=outlet | {"replace": True}) == 0
    read_structure(tmp_path / "model.feb")
    model = Parsed(tmp_path / "model.feb")
    (found,) = [item for item in model.conditions() if item[0] == kind]
    assert {name: value[1] for name, value in found[2][2]} == expected
    if kind == "fluid pressure":
        assert_allclose(model.curves()["3"][[0, -1], 1], [0, 12e3])
    else:  # the charge has leaked for 8 time constants
        assert_allclose(model.curves()["3"][[0, -1], 1], [0, 100], atol=6)


def test_a_case_whose_run_is_not_there_needs_no_generate(write, tmp_path, capsys):
    assert write("--mesh", "8,2,1,3", generate=None) == 0
    case = tmp_path / "case.yaml"
    case.write_text(case.read_text().replace("generate:", "log: missing.log"), encoding="utf-8")
    (tmp_path / "model.feb").unlink()
    assert main([str(case), "--output", str(tmp_path / "model.feb"), "--mesh", "8,2,1,3"]) == 0
    assert read_structure(tmp_path / "model.feb").n_steps > 0
    with pytest.raises(CaseFileError, match=r"missing\.xplt: no such file"):
        load_case_file(case)


@pytest.mark.parametrize(
    ("inlet", "last"),
    [
        ({"value": "8 cm/s", "period": "0.5 s"}, 0.08),
        (
            {"fourier": {"period": "0.5 s", "mean": "8 cm/s", "cosines": ["1 cm/s"], "sines": ["2 cm/s"]}},
            0.09,
        ),
    ],
)
def test_other_inlets(write, tmp_path, inlet, last):
    assert (
        write("--mesh", "8,2,1,3", "--cycles", "1", inlet={"kind": "velocity", "replace": True} | inlet) == 0
    )
    curve = Parsed(tmp_path / "model.feb").curves()["1"]
    assert curve[0, 1] == 0
    assert curve[-1, 1] == pytest.approx(last)
    assert np.abs(curve[:, 1]).max() < 0.12


def test_a_spline_is_as_smooth_in_febio(write, tmp_path):
    (tmp_path / "few.csv").write_text("t_s,mean_velocity_cm_s\n0,8\n0.2,8.5\n0.4,8\n0.6,7.5\n0.8,8\n")
    inlet = {"kind": "velocity", "replace": True, "waveform": str(tmp_path / "few.csv")}
    curves = {}
    for way in ("monotone", "spline"):
        assert write("--mesh", "8,2,1,3", "--cycles", "1", inlet=inlet | {"interpolation": way}) == 0
        curves[way] = Parsed(tmp_path / "model.feb").curves()["1"]
        (tmp_path / "model.feb").unlink()
    cycle = curves["spline"][:, 0] > 0.2
    times, values = curves["spline"][cycle].T
    wave = 0.08 + 0.005 * np.sin(2 * np.pi * (times - curves["spline"][-1, 0]) / 0.8)
    assert np.abs(values - wave).max() < 2e-4
    assert np.abs(curves["monotone"][cycle, 1] - values).max() > 1e-4


def test_time_steps_end_where_the_cycles_do(write, tmp_path):
    assert write("--mesh", "8,2,1,3", "--time-step", "1 ms", "--cycles", "3", "--states-per-cycle", "20") == 0
    found = read_structure(tmp_path / "model.feb")
    assert found.end == pytest.approx(0.199333 + 3 * 0.79733, abs=1e-3)
    assert found.end >= 0.199333 + 3 * 0.79733
    control = Parsed(tmp_path / "model.feb").control()
    assert (control["/step_size"], control["/plot_stride"]) == (1e-3, 39)
    assert control["/time_stepper/dtmin"] == pytest.approx(1e-3 / 64)


def test_an_o_grid(write, tmp_path):
    assert write("--mesh", "16,3,2,5", "--core", "o_grid", "--data-records", variant="local") == 0
    found = read_structure(tmp_path / "model.feb")
    assert found.elements["LumenCore"] == 16 * 5
    assert found.elements["Lumen"] == 16 * 3 * 5
    assert Parsed(tmp_path / "model.feb").output()[2][1][2] == "33:48"
    assert write("--mesh", "12,3,2,5", generate={"core": "o_grid"}) == 2


def test_the_case_may_state_how_it_is_made(write, tmp_path):
    stated = {"mesh": [12, 2, 1, 3], "cycles": 1, "time_step": "2 ms", "data_records": True, "bias": 2}
    assert write(generate=stated) == 0
    model = Parsed(tmp_path / "model.feb")
    assert len(model.places) == 4 * (1 + 12 * 3)
    assert model.output()[2][0][1][2] == ("file", "model_axis_nodes.txt")
    assert write("--mesh", "8,2,1,3", generate=stated) == 0
    assert len(Parsed(tmp_path / "model.feb").places) == 4 * (1 + 8 * 3)


@pytest.mark.parametrize(
    ("sections", "said"),
    [
        (
            {"inlet": {"kind": "pressure", "value": "1 kPa", "replace": True}},
            "inlet.kind: pressure; allowed in a FEBio model: velocity",
        ),
        ({"outlet": {"kind": "non_reflecting", "replace": True}}, "outlet.kind: non_reflecting; allowed"),
        ({"outlet": {"flow": "row"}}, "outlet.flow: row; allowed in a FEBio model: section"),
        ({"wall": {"reference_pressure": "10 kPa"}}, "wall.reference_pressure: 10000 Pa; allowed"),
    ],
)
def test_cases_that_cannot_be_models(write, tmp_path, capsys, sections, said):
    assert write(**sections) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert not list(tmp_path.glob("*.feb"))


def test_a_smooth_calcification_is_refused(write, capsys):
    assert write(variant="axisymmetric", calcification={"transition": {"x": "1 mm"}}) == 2
    assert (
        "calcification.transition: a smooth one; allowed in a FEBio model: sharp" in capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--mesh", "24,8,3"), "--mesh 24,8,3: allowed: four whole numbers"),
        (("--mesh", "24,8,3,x"), "four whole numbers"),
        (("--mesh", "10,8,3,30"), "mesh: 10 elements around; allowed: a multiple of 4 from 8 on"),
        (("--mesh", "8,1,3,30"), "mesh: 1 elements from the axis to the wall; allowed: 2 or more"),
        (("--mesh", "8,2,0,30"), "mesh: 0 elements through the wall"),
        (("--mesh", "99996,9999,1,30"), "elements; allowed: up to 50000000"),
        (("--bias", "0"), "mesh: a bias of 0; allowed: 0.05 to 20"),
        (("--bias", "nan"), "mesh: a bias of nan"),
        (("--cycles", "0"), "--cycles 0: allowed: 1 to 100"),
        (("--states-per-cycle", "5000"), "--states-per-cycle 5000: allowed: 1 to 1000"),
        (("--time-step", "1"), "--time-step 1: "),
        (("--time-step", "1 mm"), "--time-step 1 mm: "),
        (("--time-step", "-1 ms"), "--time-step -1 ms: allowed"),
        (
            ("--time-step", "0.1 s"),
            "time step: 0.1 s; allowed in a FEBio model: up to 0.0199332 s, for 40 states",
        ),
        (("--output", "case.yaml"), "--output case.yaml: allowed: a name that ends in .feb"),
        (("--variant", "local"), "it has no 'local'; --variant allows: none"),
    ],
)
def test_options_that_are_wrong(write, tmp_path, capsys, options, said):
    assert write(*[f"{options[0]}={options[1]}"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert not list(tmp_path.glob("*.feb"))


def test_a_model_has_one_patch(write, capsys):
    ring = {
        "pattern": "axisymmetric",
        "youngs_modulus": "3 MPa",
        "x": ["1 mm", "2 mm"],
        "transition": "sharp",
    }
    two = {"pattern": "several", "patches": [ring, ring | {"x": ["3 mm", "4 mm"]}], "replace": True}
    assert write(variant="axisymmetric", calcification=two) == 2
    assert "calcification.patches: 2 patches; allowed in a FEBio model: one patch" in capsys.readouterr().err


def test_a_variant_must_be_chosen_where_there_are_several(tmp_path, capsys):
    assert main([str(ROOT / "cases/calcification.yaml"), "--output", str(tmp_path / "m.feb")]) == 2
    assert "none is chosen; --variant allows: none, axisymmetric, local" in capsys.readouterr().err


def test_where_a_model_is_written(write, tmp_path, capsys):
    path = tmp_path / "new" / "folder" / "model.feb"
    assert write(f"--output={path}", "--mesh=8,2,1,3") == 0
    assert [file.name for file in path.parent.iterdir()] == ["model.feb"]
    assert write(f"--output={path / 'b.feb'}", "--mesh=8,2,1,3") == 2
    assert f"{path / 'b.feb'}: cannot be written: " in capsys.readouterr().err


def test_sizes_are_checked_wherever_they_come_from():
    for counts in ((7, 2, 1, 1), (4, 2, 1, 1), (8, 1, 1, 1), (8, 2, 0, 1), (8, 2, 1, 0)):
        with pytest.raises(FebioModelError, match="mesh: "):
            MeshSize(*counts)


def test_an_interrupt_leaves_the_older_model(write, tmp_path, monkeypatch, capsys):
    (tmp_path / "model.feb").write_text("older")

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("febio_io.feb.sections.output", interrupt)
    assert write("--mesh", "8,2,1,3") == 130
    assert capsys.readouterr().err == "interrupted; no model was written\n"
    assert {file.name for file in tmp_path.iterdir()} == {"case.yaml", "model.feb"}
    assert (tmp_path / "model.feb").read_text() == "older"
