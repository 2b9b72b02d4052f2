"""FEBio plot files onto cells: manufactured tubes, written as FEBio writes them."""

import re
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from small_case import bands, small_case, written
from tube_plot import VARIABLES, write_tube
from tubes import Tube

from cases.reading.case_file import load_case_file
from febio_io.errors import FebioError
from validation.errors import UnusableReferenceError
from validation.mapping.mesh import Block
from validation.reference.febio.series import KIND

TUBE = Tube(sectors=12, rings=4, stacks=10, layers=2)
TIMES = np.linspace(0.0, 2.392 / 3, 6)


@pytest.fixture
def read(tmp_path):
    """Write a tube, and map it as a case states."""

    def mapped(tube=TUBE, *, reference=None, geometry=None, calcification=None, times=TIMES, **options):
        path = write_tube(tmp_path / "tube.xplt", tube, times, **options)
        content = bands(small_case("none"))
        content["geometry"] |= geometry or {}
        content["calcification"] = calcification or content["calcification"]
        del content["variants"]["none"]["reference"]
        content["reference"] = {"kind": "febio", "axis": "z", "plot_file": str(path)} | (reference or {})
        case = load_case_file(written(content, tmp_path)).variants["none"]
        return KIND.read(case, tube.cells(12, 8))

    return mapped


def check(found, tube=TUBE):
    cells = tube.cells(12, 8)
    x, phi = cells.x[:, None], cells.phi[None, :]
    fields = found.fields.isel(time=2)
    for name, exact, share in (
        ("radius", tube.wall(x, phi), 5e-3),
        ("mean_velocity", tube.mean_velocity(x, phi), 0.05),
        ("profile_exponent", tube.gamma(x, phi), 0.08),
        ("pressure", tube.pressure(x), 1e-5),
    ):
        assert np.max(np.abs(fields[name].to_numpy() / exact - 1)) < share, name


@pytest.mark.parametrize("nodal_pressure", [False, True])
@pytest.mark.parametrize(
    ("axis", "phi_zero", "origin"),
    [("z", "x", (0, 0, 0)), ("x", "-z", (0.01, 0.02, -0.03)), ("y", "z", (-0.1, 0.0, 0.0))],
)
def test_a_tube_anywhere(read, axis, phi_zero, origin, nodal_pressure):
    stated = {"axis": axis, "phi_zero": phi_zero, "origin": [f"{part} m" for part in origin]}
    found = read(axis=axis, phi_zero=phi_zero, origin=origin, nodal_pressure=nodal_pressure, reference=stated)
    check(found)
    assert found.notes == ()
    assert found.description["states_compared"] == len(TIMES)


@pytest.mark.parametrize(
    ("axis", "phi_zero"),
    [((1.0, 2.0, -2.0), (2.0, 1.0, 2.0)), ((0.1, 0.0, 3.0), "x"), ((0.0, 0.0, -2.0), (1.0, 1.0, 0.0))],
)
def test_a_tube_along_a_tilted_axis(read, axis, phi_zero):
    origin = (0.01, -0.02, 0.03)
    stated = {
        "axis": list(axis),
        "phi_zero": phi_zero if isinstance(phi_zero, str) else list(phi_zero),
        "origin": [f"{part} m" for part in origin],
    }
    check(read(axis=axis, phi_zero=phi_zero, origin=origin, reference=stated))


def test_units_of_the_file(read):
    units = {"length_unit": "mm", "time_unit": "ms", "pressure_unit": "kPa"}
    origin = {"origin": ["1 mm", "-2 mm", "0 m"]}
    size = {"length": 1e-3, "time": 1e-3, "pressure": 1e3, "origin": (1e-3, -2e-3, 0.0)}
    found, plain = read(reference=units | origin, **size), read(reference=origin, origin=size["origin"])
    for name in ("radius", "pressure", "section_flow_rate", "mean_velocity"):
        assert_allclose(found.fields[name], plain.fields[name], rtol=1e-5)
    assert_allclose(found.fields["time"], plain.fields["time"], atol=1e-7)
    assert_allclose(found.checks["plane_flow_rate"], plain.checks["plane_flow_rate"], rtol=1e-5)


@dataclass(frozen=True)
class Layered(Tube):
    """A tube whose wall has two layers in domains of their own."""

    @cached_property
    def vessel_wall(self):
        (wall,) = super().vessel_wall
        inner = np.arange(len(wall.nodes)) % (self.layers * self.sectors) < self.sectors
        return [Block(wall.kind, wall.nodes[inner]), Block(wall.kind, wall.nodes[~inner])]


@pytest.mark.parametrize("stated", [{}, {"wall": ["Media", "Adventitia"]}, {"wall": ["Media"]}])
def test_a_wall_of_several_layers(read, stated):
    tube = Layered(sectors=12, rings=4, stacks=10, layers=2)
    found = read(tube, names=("Blood", "Media", "Adventitia"), reference=stated)
    assert_allclose(found.fields["radius"], read().fields["radius"], rtol=1e-12)
    left = "domains neither lumen nor wall are left out: Adventitia"
    assert any(left in note for note in found.notes) == (stated == {"wall": ["Media"]})


@dataclass(frozen=True)
class Symmetric(Tube):
    """A tube that is its own image in the plane φ = 0 and π; perhaps only the half with φ < π."""

    half: bool = False

    def wall(self, x, phi):
        return super().wall(x, np.abs((phi + np.pi) % (2 * np.pi) - np.pi) + 0.4)

    def gamma(self, x, phi):
        return super().gamma(x, np.abs((phi + np.pi) % (2 * np.pi) - np.pi))

    def azimuthal(self, x, phi, eta):
        return 0.03 * eta * np.sin(phi)

    def _kept(self, blocks):
        if not self.half:
            return blocks
        middle = [self.coordinates[block.nodes].mean(axis=1)[:, 2] for block in blocks]
        return [Block(b.kind, b.nodes[z > 0]) for b, z in zip(blocks, middle, strict=True)]

    @cached_property
    def lumen(self):
        return self._kept(super().lumen)

    @cached_property
    def vessel_wall(self):
        return self._kept(super().vessel_wall)


@pytest.mark.parametrize("tetrahedra", [False, True])
@pytest.mark.parametrize("nodal_pressure", [False, True])
def test_a_half_model_is_mirrored(read, tetrahedra, nodal_pressure):
    sizes = {"sectors": 12, "rings": 4, "stacks": 10, "layers": 2, "tetrahedra": tetrahedra}
    whole = read(Symmetric(**sizes), nodal_pressure=nodal_pressure)
    half = read(Symmetric(**sizes, half=True), nodal_pressure=nodal_pressure, reference={"symmetry": "y"})
    assert any("image in the plane of symmetry" in note for note in half.notes)
    # tetrahedra of the image are cut along the other diagonals
    share = 3e-2 if tetrahedra else 1e-6
    for name in ("radius", "pressure", "section_flow_rate", "mean_velocity"):
        assert_allclose(half.fields[name], whole.fields[name], rtol=share)
    turned = half.fields["azimuthal_velocity"].to_numpy()
    assert_allclose(turned[:, :, ::-1], -turned, atol=1e-9 + 1e-6 * np.abs(turned).max())
    assert np.abs(half.fields["mass_defect"] - whole.fields["mass_defect"]).max() < share


def test_a_whole_model_has_no_symmetry_to_state(read):
    with pytest.raises(UnusableReferenceError, match="lies on both sides of the plane"):
        read(reference={"symmetry": "y"})


@dataclass(frozen=True)
class Calcified(Tube):
    """A tube whose wall is calcified between a third and two thirds of its length, perhaps in a sector."""

    sector: tuple[int, int] = (0, 12)

    @cached_property
    def vessel_wall(self):
        (wall,) = super().vessel_wall
        x = self.coordinates[wall.nodes].mean(axis=1)[:, 0] / self.length
        sector = np.arange(len(wall.nodes)) % self.sectors
        inside = (x > 1 / 3) & (x < 2 / 3) & (sector >= self.sector[0]) & (sector < self.sector[1])
        return [Block(wall.kind, wall.nodes[~inside]), Block(wall.kind, wall.nodes[inside])]


RING = {"pattern": "axisymmetric", "youngs_modulus": "10 MPa", "x": ["5 mm", "10 mm"], "transition": "sharp"}
PLAQUE = RING | {"pattern": "local", "phi": ["150 deg", "210 deg"]}
NONE = {"pattern": "none"}
SEVERAL = {"pattern": "several", "patches": [PLAQUE, RING | {"x": ["1 mm", "2 mm"]}]}


@pytest.mark.parametrize(
    ("sector", "calcification", "said"),
    [
        ((0, 12), RING, None),
        ((5, 7), PLAQUE, None),
        ((5, 7), PLAQUE | {"phi": ["147 deg", "213 deg"], "x": ["4.8 mm", "10.2 mm"]}, None),
        (
            (5, 7),
            PLAQUE | {"phi": ["120 deg", "210 deg"]},
            r"φ 120° to 210°; the reference at .*, φ 150° to",
        ),
        ((5, 7), PLAQUE | {"x": ["4 mm", "10 mm"]}, r"x 4 to 10 mm.*; the reference at x 5 to 10 mm"),
        ((5, 7), RING, r"all around; the reference at .* φ 150° to 210°"),
        ((0, 12), PLAQUE, r"φ 150° to 210°; the reference at x 5 to 10 mm, all around"),
        ((11, 12), PLAQUE, r"the reference at x 5 to 10 mm, φ 330° to 0°"),
        ((5, 7), SEVERAL | {"patches": [PLAQUE]}, None),
        ((5, 7), SEVERAL, r"calcified at x 1 to 2 mm, all around; the reference is not"),
        (
            (3, 7),
            SEVERAL | {"patches": [PLAQUE, RING | {"x": ["8 mm", "10 mm"]}]},
            r"8 of 32 calcified elements of the reference lie in no patch",
        ),
        ((0, 12), NONE, "the reference is calcified at x 5 to 10 mm, all around; the case is not"),
    ],
)
def test_a_patch_that_is_not_the_references_is_said(read, sector, calcification, said):
    tube = Calcified(sectors=12, rings=4, stacks=12, layers=2, sector=sector)
    found = read(
        tube,
        names=("Blood", "Healthy", "Plaque"),
        reference={"calcified": ["Plaque"]},
        calcification=calcification,
    )
    if said is None:
        assert found.warnings == ()
    else:
        (warning,) = found.warnings
        assert re.search(said, warning), warning


def test_a_reference_without_a_calcified_domain(read):
    found = read(reference={"calcified": ["Plaque"]}, calcification=RING)
    assert found.warnings == (
        "the case is calcified at x 5 to 10 mm, all around; the reference has no calcified domain",
    )
    assert read(reference={"calcified": ["Plaque"]}).warnings == ()


def test_a_tube_of_tetrahedra(read):
    check(read(Tube(sectors=12, rings=4, stacks=10, layers=2, tetrahedra=True)))


def test_a_turned_phi_zero_turns_the_rows(read):
    straight = read().fields["radius"].to_numpy()
    turned = read(reference={"phi_zero": "y"}).fields["radius"].to_numpy()
    assert_allclose(turned, np.roll(straight, -2, axis=2), rtol=1e-6)
    assert np.ptp(straight, axis=2).max() > 1e-4


def test_flow_through_planes_and_inlet_is_reported(read):
    found = read()
    q = found.fields["section_flow_rate"].to_numpy()[0]
    planes = found.checks["plane_flow_rate"].to_numpy()
    assert_allclose(planes, np.broadcast_to(q[[0, 5, 11]], planes.shape), rtol=0.03)
    assert_allclose(found.checks["inlet_area"], TUBE.area(0.0) * np.sinc(1 / 6), rtol=1e-5)


def test_domains_may_be_named(read):
    found = read(names=("A", "B"), reference={"lumen": ["A"], "wall": ["B", "C"]})
    check(found)
    assert found.notes == ("tube.xplt has no domain 'C' (named in reference.wall)",)


@pytest.mark.parametrize(
    ("reference", "said"),
    [
        ({"lumen": ["Blod"]}, r"no domain for reference\.lumen: Blod; the file has: Blood, Blood, Wall"),
        ({"wall": ["Blood"]}, r"named both lumen and wall: Blood"),
        ({"axis": "x"}, r"the lumen (has no plane inlet|runs from)"),
        ({"origin": ["0 m", "0 m", "5 mm"]}, r"starts at reference\.origin and is 0\.015 m long"),
        ({"origin": ["5 mm", "0 m", "0 m"]}, r"the unloaded lumen.s radius is 0\.00531"),
    ],
)
def test_a_reference_that_does_not_fit(read, reference, said):
    with pytest.raises(UnusableReferenceError, match=said):
        read(reference=reference)


def test_another_length(read):
    with pytest.raises(UnusableReferenceError, match=r"over 0\.015 m; .* 0\.016 m long \(geometry\.length\)"):
        read(geometry={"length": "16 mm"})


@pytest.mark.parametrize("missing", VARIABLES)
def test_a_missing_plot_variable_is_named(read, missing):
    with pytest.raises(
        UnusableReferenceError, match=f"tube.xplt: plot variable .*{missing}.* is missing"
    ) as e:
        read(variables=[name for name in VARIABLES if name != missing])
    assert all(name in str(e.value) for name in VARIABLES)


def test_a_mesh_with_a_coordinate_that_is_no_number(read):
    tube = Tube(sectors=12, rings=4, stacks=10, layers=2)
    tube.coordinates[7, 1] = np.nan
    with pytest.raises(UnusableReferenceError, match=r"tube\.xplt: coordinates of the mesh: not finite"):
        read(tube)


def test_too_few_states(read):
    with pytest.raises(UnusableReferenceError, match="states in the last cycle: 2"):
        read(times=[0.1, 0.2])


def test_no_states(read):
    with pytest.raises(FebioError, match="the file has no states"):
        read(times=[])


def test_progress_is_reported(tmp_path):
    path = write_tube(tmp_path / "tube.xplt", TUBE, TIMES)
    content = bands(small_case("none"))
    content["variants"]["none"]["reference"] = {"plot_file": str(path)}
    content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
    case = load_case_file(written(content, tmp_path)).variants["none"]
    seen = SimpleNamespace(calls=[])
    KIND.read(case, TUBE.cells(12, 8), lambda done, total: seen.calls.append((done, total)))
    assert seen.calls == [(n, len(TIMES)) for n in range(1, len(TIMES) + 1)]
