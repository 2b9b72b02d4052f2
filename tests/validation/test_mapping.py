"""3D onto cells, on tubes whose wall, velocity, flow and pressure are known."""

import numpy as np
import pytest
import pyvista as pv
from numpy.testing import assert_allclose
from tubes import TURN, Tube

from validation.errors import UnusableReferenceError
from validation.mapping.derived import derived_fields
from validation.mapping.elements import HEXAHEDRON, WEDGE
from validation.mapping.mesh import Block, lumen_mesh
from validation.mapping.pressure import element_centres, recovery_operator
from validation.mapping.rays import rays
from validation.mapping.state import Mapper
from validation.mapping.surface import area_across_axis, flow_along_axis, flux
from validation.mapping.wall_radius import interface_radius
from validation.metrics.curved_section import curved_flow_rate
from validation.reference.mesh.checks import lumen_grid, plane_flow_rate
from validation.reference.mesh.model import frame

COARSE = Tube(sectors=12, rings=4, stacks=10, layers=2)
KINDS = [
    pytest.param(False, id="hexahedra"),
    pytest.param(True, id="tetrahedra"),
]


def enclosed_volume(points, faces):
    """Volume inside a closed surface whose normals point outwards, ⅓∮ x · n dS, m³."""
    return flux(points, faces, points) / 3.0


def mapped(tube, cells):
    return Mapper(tube.mesh, cells).map_state(
        tube.coordinates + tube.displacement, tube.velocity, tube.nodal_pressure
    )


def fields(tube, cells):
    return derived_fields([mapped(tube, cells)], cells, np.zeros(1)).isel(time=0)


def grid(cells):
    return cells.x[:, None], cells.phi[None, :]


def worst(found, exact):
    return float(np.max(np.abs(np.asarray(found) / exact - 1)))


def plane_flows(tube, x):
    points = tube.coordinates + tube.displacement
    vtk = lumen_grid(tube.mesh.lumen)
    return np.array([plane_flow_rate(vtk, points, tube.velocity, float(station)) for station in x])


@pytest.fixture(scope="module")
def reference_size():
    tube = Tube()
    cells = tube.cells(20, 48)
    return tube, cells, fields(tube, cells)


class TestMeshOfTheReferencesSize:
    def test_the_mesh_is_as_large_as_the_real_ones(self, reference_size):
        tube, _, _ = reference_size
        elements = sum(len(block.nodes) for block in (*tube.lumen, *tube.vessel_wall))
        assert (len(tube.coordinates), elements) == (8215, 7920)

    def test_wall_radius(self, reference_size):
        tube, cells, found = reference_size
        assert worst(found["radius"], tube.wall(*grid(cells))) < 1e-3

    def test_exponent(self, reference_size):
        tube, cells, found = reference_size
        assert worst(found["profile_exponent"], tube.gamma(*grid(cells))) < 0.02

    @pytest.mark.parametrize("tetrahedra", KINDS)
    @pytest.mark.parametrize("exponent", [0.6, 4.0, 9.0, 20.0])
    def test_exponent_whatever_the_profile(self, tetrahedra, exponent):
        tube = Tube(tetrahedra=tetrahedra, exponent=exponent, exponent_change=0.1 * exponent)
        cells = tube.cells(10, 24)
        assert worst(fields(tube, cells)["profile_exponent"], tube.gamma(*grid(cells))) < 0.02

    def test_mean_velocity(self, reference_size):
        tube, cells, found = reference_size
        assert worst(found["mean_velocity"], tube.mean_velocity(*grid(cells))) < 0.01

    def test_section_flow_equals_that_through_planes(self, reference_size):
        tube, cells, found = reference_size
        assert worst(found["section_flow_rate"], plane_flows(tube, cells.x)) < 2e-3

    def test_section_flow_differs_from_the_formula_by_no_more_than_the_mesh(self, reference_size):
        # 24 sides enclose 1.1 % less than the circle; 8 linear rings lose 0.6 % of a parabola
        tube, cells, found = reference_size
        exact = np.array([tube.flow_rate(x) for x in cells.x])
        assert worst(found["section_flow_rate"], exact) < 0.02

    def test_section_flow_with_a_round_edge_is_the_formulas(self, reference_size):
        tube, cells, found = reference_size
        exact = np.array([tube.flow_rate(x) for x in cells.x])
        assert worst(curved_flow_rate(found), exact) < 0.006

    def test_flow_rates_along_the_tube_vary_as_the_formula(self, reference_size):
        tube, cells, found = reference_size
        exact = np.array([tube.flow_rate(x) for x in cells.x])
        deficit = found["section_flow_rate"].to_numpy() / exact
        assert np.ptp(deficit) < 2e-3

    def test_inflow_and_inlet_area_are_those_of_the_polygon(self, reference_size):
        tube, cells, _ = reference_size
        state = mapped(tube, cells)
        polygon = np.sin(TURN / 24) / (TURN / 24) * tube.area(0.0)
        assert_allclose(state.inlet_area, polygon, rtol=1e-12)
        assert_allclose(state.inflow, plane_flows(tube, [1e-9])[0], rtol=2e-3)

    def test_velocity_components(self, reference_size):
        tube, cells, found = reference_size
        x, phi, y = cells.x[:, None, None], cells.phi[None, :, None], cells.y
        for name, exact in (
            ("axial_velocity", tube.axial(x, phi, y)),
            ("radial_velocity", tube.radial(x, phi, y)),
            ("azimuthal_velocity", tube.azimuthal(x, phi, y)),
        ):
            assert np.max(np.abs(found[name].to_numpy() - exact)) < 0.03 * np.max(np.abs(exact)), name

    def test_pressure_linear_along_the_tube_is_exact(self, reference_size):
        tube, cells, found = reference_size
        exact = np.broadcast_to(tube.pressure(cells.x)[:, None], (20, 48))
        assert_allclose(found["pressure"], exact, rtol=1e-12)
        assert_allclose(found["section_pressure"], exact[:, 0], rtol=1e-12)

    def test_sector_flows_add_up(self, reference_size):
        _, _, found = reference_size
        assert_allclose(found["sector_flow_rate"].sum("phi"), found["section_flow_rate"], rtol=1e-14)


def errors(tube):
    """Worst relative errors with two rays a sector and one a stack, at the same places of an element."""
    cells = tube.cells(tube.stacks, 2 * tube.sectors)
    found = fields(tube, cells)
    exact = np.array([tube.flow_rate(x) for x in cells.x])
    return {
        "radius": worst(found["radius"], tube.wall(*grid(cells))),
        "profile_exponent": worst(found["profile_exponent"], tube.gamma(*grid(cells))),
        "mean_velocity": worst(found["mean_velocity"], tube.mean_velocity(*grid(cells))),
        "section_flow_rate": worst(found["section_flow_rate"], exact),
        "curved_flow_rate": worst(curved_flow_rate(found), exact),
        "planes": worst(found["section_flow_rate"], plane_flows(tube, cells.x)),
    }


@pytest.mark.parametrize("tetrahedra", KINDS)
def test_second_order_under_refinement(tetrahedra):
    base = Tube(sectors=12, rings=6, stacks=8, layers=1, tetrahedra=tetrahedra)
    coarse, fine = errors(base), errors(base.finer(2))
    # Simpson's rule through the nodes is nearer to the profile than the plane's piecewise linear cut is
    assert max(coarse.pop("planes"), fine.pop("planes")) < 5e-4
    order = {name: np.log2(coarse[name] / fine[name]) for name in coarse}
    assert min(order.values()) > 1.7, order


@pytest.mark.parametrize("tetrahedra", KINDS)
def test_fields_linear_in_the_coordinates_are_exact(tetrahedra):
    tube = Tube(sectors=12, rings=4, stacks=10, layers=2, tetrahedra=tetrahedra)
    cells = tube.cells(7, 9)
    points = tube.coordinates + tube.displacement
    slopes = np.array([[1.0, -2.0, 0.5], [0.3, 0.7, -1.1], [2.0, 0.1, 0.4]])
    start = np.array([0.02, 0.01, -0.03])
    slope = np.array([-4e4, 3e4, -1e4])
    state = Mapper(tube.mesh, cells).map_state(points, points @ slopes.T + start, 1e4 + points @ slope)
    at = cells.points(state.chord)
    assert_allclose(state.velocity, cells.cylindrical(at @ slopes.T + start), rtol=0, atol=1e-12)
    expected = cells.mean(1e4 + at @ slope)
    assert_allclose(state.pressure, expected, rtol=1e-12)


@pytest.mark.parametrize("tetrahedra", KINDS)
def test_rays_along_lines_of_nodes_give_nodal_values(tetrahedra):
    tube = Tube(sectors=12, rings=4, stacks=10, layers=2, tetrahedra=tetrahedra)
    x = np.linspace(0.0, tube.length, tube.stacks + 1)[1:-1]
    phi = np.arange(tube.sectors) * TURN / tube.sectors
    cells = rays(x, phi, points=2 * tube.rings + 1)
    state = mapped(tube, cells)
    at = x[:, None, None], phi[None, :, None], cells.y[::2]
    assert_allclose(state.radius, tube.wall(*grid(cells)), rtol=1e-12)
    assert_allclose(state.chord, state.radius, rtol=1e-12)
    assert_allclose(state.velocity[:, :, ::2, 0], tube.axial(*at), rtol=0, atol=1e-12)
    azimuthal = np.broadcast_to(tube.azimuthal(*at), state.velocity[:, :, ::2, 2].shape)
    assert_allclose(state.velocity[:, :, ::2, 2], azimuthal, rtol=0, atol=1e-12)


def test_tetrahedra_and_hexahedra_agree():
    cells = Tube().cells(12, 24)
    hexahedra, tetrahedra = (fields(Tube(tetrahedra=split), cells) for split in (False, True))
    for name, share in (
        ("radius", 1e-3),
        ("mean_velocity", 5e-3),
        ("section_flow_rate", 5e-3),
        ("profile_exponent", 2e-2),
        ("pressure", 1e-10),
    ):
        assert worst(hexahedra[name], tetrahedra[name].to_numpy()) < share, name


@pytest.mark.parametrize("n_phi", [8, 16, 24, 48])
def test_flow_by_rays_is_within_a_percent_of_that_through_planes(n_phi):
    tube = Tube(stacks=10)
    cells = tube.cells(5, n_phi)
    assert worst(fields(tube, cells)["section_flow_rate"], plane_flows(tube, cells.x)) < 0.01


def test_flow_by_rays_through_corners_is_within_a_percent_of_that_through_planes():
    tube = Tube(stacks=10)
    cells = tube.cells(5, 12)
    assert worst(fields(tube, cells)["section_flow_rate"], plane_flows(tube, cells.x)) < 0.01


def test_planes_through_nodes_cut_each_element_once():
    tube = Tube(sectors=12, rings=4, stacks=10, layers=2)
    at_nodes = np.linspace(0, tube.length, 11)[1:-1]
    assert worst(plane_flows(tube, at_nodes), plane_flows(tube, at_nodes + 1e-9)) < 1e-5


def placed(tube, place):
    """Coordinates, displacement and velocity in a frame of the file."""
    turn = place.rotation
    return tube.coordinates @ turn + place.origin, tube.displacement @ turn, tube.velocity @ turn


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize("turned", [1, 2])
def test_any_frame_gives_the_same_answers(axis, sign, turned):
    phi_zero = sign + "xyz"[("xyz".index(axis) + turned) % 3]
    place = frame(axis, phi_zero, (0.7, -0.2, 0.05))
    assert_allclose(np.linalg.det(place.rotation), 1.0, rtol=1e-15)
    cells = COARSE.cells(6, 10)
    coordinates, displacement, velocity = placed(COARSE, place)
    mesh = lumen_mesh(place.points(coordinates), COARSE.lumen, COARSE.vessel_wall)
    state = Mapper(mesh, cells).map_state(
        place.points(coordinates + displacement), place.directions(velocity), COARSE.nodal_pressure
    )
    for found, expected in zip(state, mapped(COARSE, cells), strict=True):
        assert_allclose(found, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("tube", [COARSE, Tube(sectors=6, rings=2, stacks=3, layers=1)])
def test_pressure_from_element_averages_is_exact_where_linear(tube):
    slope = np.array([-4e4, 2e4, 1e4])
    mesh = tube.mesh
    averages = 13e3 + element_centres(mesh.lumen, tube.coordinates) @ slope
    nodal = recovery_operator(mesh.lumen, tube.coordinates) @ averages
    wet = np.unique(mesh.lumen.nodes[mesh.lumen.nodes >= 0])
    assert_allclose(nodal[wet], (13e3 + tube.coordinates @ slope)[wet], rtol=1e-10)
    dry = np.setdiff1d(np.arange(len(tube.coordinates)), wet)
    assert dry.size
    assert not nodal[dry].any()


def test_pressure_of_a_mesh_one_element_long_is_its_mean():
    tube = Tube(sectors=6, rings=2, stacks=1, layers=1)
    mesh = tube.mesh
    operator = recovery_operator(mesh.lumen, tube.coordinates)
    wet = np.unique(mesh.lumen.nodes[mesh.lumen.nodes >= 0])
    assert_allclose((operator @ np.full(len(mesh.lumen.kinds), 12e3))[wet], 12e3, rtol=1e-12)


class TestBoundary:
    def test_each_part_has_its_faces(self):
        mesh = COARSE.mesh
        lids = COARSE.sectors * COARSE.rings
        counts = (len(mesh.interface), len(mesh.inlet), len(mesh.outlet))
        assert counts == (COARSE.sectors * COARSE.stacks, lids, lids)
        radii = np.hypot(*COARSE.coordinates[mesh.interface_nodes, 1:].T)
        assert_allclose(radii, COARSE.radius, rtol=1e-12)
        assert_allclose(mesh.length, COARSE.length, rtol=1e-15)

    def test_volume_of_a_prism(self):
        tube = Tube(sectors=12, rings=4, stacks=10, layers=2)
        area = 0.5 * 12 * np.sin(TURN / 12) * tube.radius**2
        assert_allclose(enclosed_volume(tube.coordinates, closed(tube)), area * tube.length, rtol=1e-12)
        assert_allclose(area_across_axis(tube.coordinates, tube.mesh.inlet), area, rtol=1e-12)

    def test_volume_of_a_deformed_lumen_is_the_sum_of_its_elements(self):
        points = COARSE.coordinates + COARSE.displacement
        vtk = lumen_grid(COARSE.mesh.lumen)
        vtk.points = points[: vtk.n_points]
        volumes = vtk.compute_cell_sizes(length=False, area=False)["Volume"]
        assert isinstance(vtk, pv.UnstructuredGrid)
        assert_allclose(enclosed_volume(points, closed(COARSE)), volumes.sum(), rtol=1e-3)

    def test_flow_runs_along_the_axis_whichever_way_faces_turn(self):
        points, velocity = COARSE.coordinates + COARSE.displacement, COARSE.velocity
        forward = flow_along_axis(points, COARSE.mesh.inlet, velocity)
        assert forward > 0
        assert_allclose(flow_along_axis(points, COARSE.mesh.inlet[:, ::-1], velocity), forward, rtol=1e-14)

    def test_what_flows_in_flows_out_where_volume_is_kept(self):
        # x → −2x, y → y, z → z stretches without change of volume, about any point
        points = COARSE.coordinates + COARSE.displacement
        velocity = points * np.array([-2.0, 1.0, 1.0]) + np.array([0.3, 0.01, -0.02])
        state = Mapper(COARSE.mesh, COARSE.cells(3, 4)).map_state(points, velocity, COARSE.nodal_pressure)
        assert abs(state.inflow - state.outflow - state.wall_flow) < 1e-13 * abs(state.inflow)
        assert state.wall_flow > 0.01 * state.inflow

    def test_moving_wall_carries_the_change_of_volume(self):
        rate = 1e-3 * COARSE.displacement / COARSE.bulge
        points = COARSE.coordinates + COARSE.displacement
        faces, step = closed(COARSE), 1e-3
        change = [enclosed_volume(points + side * step * rate, faces) for side in (1, -1)]
        assert_allclose(flux(points, faces, rate), (change[0] - change[1]) / (2 * step), rtol=1e-6)


def closed(tube):
    return np.concatenate([tube.mesh.inlet, tube.mesh.outlet, tube.mesh.interface])


class TestUnusable:
    def test_ray_beyond_the_tube(self):
        cells = rays(np.array([5e-3, 16e-3]), np.array([0.1]))
        with pytest.raises(UnusableReferenceError, match=r"x = 0\.016 m, φ = 0\.1 rad meets no lumen–wall"):
            mapped(COARSE, cells)

    def test_hole_in_the_lumen(self):
        core, rest = (block.nodes for block in COARSE.lumen)
        mesh = lumen_mesh(
            COARSE.coordinates,
            [Block(WEDGE, core[: 3 * COARSE.sectors]), Block(HEXAHEDRON, rest)],
            COARSE.vessel_wall,
        )
        with pytest.raises(UnusableReferenceError, match=r"no lumen element holds .* r/R = 0$"):
            Mapper(mesh, COARSE.cells(2, 4)).map_state(
                COARSE.coordinates + COARSE.displacement, COARSE.velocity, COARSE.nodal_pressure
            )

    def test_no_shared_face(self):
        count = len(COARSE.coordinates)
        apart = [Block(block.kind, block.nodes + count) for block in COARSE.vessel_wall]
        with pytest.raises(UnusableReferenceError, match="share no face"):
            lumen_mesh(np.tile(COARSE.coordinates, (2, 1)), COARSE.lumen, apart)

    @pytest.mark.parametrize(("end", "name"), [(0, "inlet"), (-1, "outlet")])
    def test_slanted_end(self, end, name):
        bent = COARSE.coordinates.copy()
        at_end = bent[:, 0] == bent[end, 0]
        bent[at_end, 0] += 0.1 * bent[at_end, 1]
        with pytest.raises(UnusableReferenceError, match=f"no plane {name}"):
            lumen_mesh(bent, COARSE.lumen, COARSE.vessel_wall)


def fan(last):
    """Six triangles around a node at x = 5 mm, φ = 1, which stands last or first in each."""
    angles = np.arange(6) * TURN / 6
    x = np.append(5e-3 + 1e-3 * np.cos(angles), 5e-3)
    phi = np.append(1.0 + 0.3 * np.sin(angles), 1.0)
    points = np.column_stack([x, 2.5e-3 * np.cos(phi), 2.5e-3 * np.sin(phi)])
    pairs = [(k, (k + 1) % 6) for k in range(6)]
    faces = [(a, b, 6, 6) if last else (6, a, b, b) for a, b in pairs]
    return points, np.array(faces)


@pytest.mark.parametrize("chord", [False, True])
@pytest.mark.parametrize("last", [False, True])
def test_ray_through_a_node_of_triangles(chord, last):
    points, faces = fan(last)
    guess = np.zeros((1, 1), dtype=np.int64)
    radius = interface_radius(points, faces, np.array([5e-3]), np.array([1.0]), chord, guess)
    assert_allclose(radius, 2.5e-3, rtol=1e-12)
