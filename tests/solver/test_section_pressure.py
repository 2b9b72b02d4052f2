"""One pressure a section: the 1D limit, mass, steady states, stability, cross flow, resuming."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from test_every_boundary import INLETS, LOAD, OUTLETS, check, wave
from thesis_artery import DIASTOLE, HEALTHY, PATTERNS, RADIUS, artery, patched, section_flow, thesis_waveform

import solver.marching.row_stepper
from solver.errors import BeyondWallTable, ModelError
from solver.geometry.grid import Grid
from solver.marching.row_stepper import Stepper
from solver.marching.section_stepper import SectionStepper
from solver.marching.semi_implicit import implicitness, simulate
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, PressureOutlet, ResistanceOutlet
from solver.model.cross_flow import azimuthal_flux
from solver.model.parameters import uniform_state
from solver.model.waveform import FourierSeries, constant
from solver.wall.membrane_tables import MembraneWall, section_wall
from solver.wall.sections import linear_section_wall

PERIOD = thesis_waveform().period


def with_sections(model):
    """The model with one pressure a section, its rows still springs."""
    wall = linear_section_wall(model.stiffness, model.radius, model.reference_pressure)
    return replace(model, section_wall=wall)


def with_membrane(model, folder):
    stiffness = model.stiffness
    wall = MembraneWall(
        grid=model.grid,
        radius=RADIUS,
        reference_pressure=0.0,
        stiffness=lambda _: stiffness,
        shear=stiffness / 4,
        supports="quarters",
        highest_load=0.4 * stiffness.min() / RADIUS,
    )
    return replace(model, section_wall=section_wall(wall, folder))


@pytest.fixture(scope="module")
def coupled(tmp_path_factory):
    """The coupled model of a local calcification, E_calcified/E_healthy = 100."""

    def of(n_x, n_phi, ratio=100.0, **changes):
        grid = Grid(15e-3, n_x, n_phi)
        stiffness = patched(grid, PATTERNS["local, sharp"], ratio * HEALTHY)
        model = artery(n_x, n_phi, stiffness=stiffness, inlet=thesis_waveform(), **changes)
        return with_membrane(model, folder)

    folder = tmp_path_factory.mktemp("walls")
    return of


@pytest.mark.parametrize("outlet", list(OUTLETS))
@pytest.mark.parametrize("inlet", list(INLETS))
def test_one_row_is_the_1d_model_to_round_off(inlet, outlet, monkeypatch):
    model = artery(24, 1, patch=PATTERNS["axisymmetric, sharp"], inlet=INLETS[inlet], outlet=OUTLETS[outlet])
    monkeypatch.setattr(solver.marching.row_stepper, "TOLERANCE", 1e-13)
    start = uniform_state(model, LOAD, DIASTOLE)
    rows, sections = Stepper(model, start), SectionStepper(with_sections(model), start, tolerance=1e-13)
    for n in range(20):
        for stepper in (rows, sections):
            stepper.advance_through(5e-3 * n, 1e-3, 5, implicitness(1e-3))
        one, other = rows.state(), sections.state()
        assert np.max(np.abs(one.flow - other.flow)) < 1e-10 * np.max(np.abs(one.flow))
        assert np.max(np.abs(one.area - other.area)) < 1e-11 * np.max(one.area)
        assert np.max(np.abs(one.pressure - other.pressure)) < 1e-10 * np.max(one.pressure)


def keeps_mass(inlet, outlet, count, start=None):
    """The balance of every section and step; rows exchange blood."""
    model = with_sections(artery(16, 8, patch=PATTERNS["local, sharp"], inlet=inlet, outlet=OUTLETS[outlet]))
    theta, time_step = implicitness(1e-3), 1e-3
    begin = uniform_state(model, LOAD, DIASTOLE) if start is None else steady_state(model, start)
    stepper = SectionStepper(model, begin)
    first = old = stepper.state()
    for n in range(count):
        reported = stepper.advance_through(n * time_step, time_step, 1, theta)
        new = stepper.state()
        passed = time_step * ((1 - theta) * old.flow + theta * new.flow).sum(axis=1)
        sections = model.grid.dx * (new.area - old.area).sum(axis=1) + np.diff(passed)
        assert np.max(np.abs(sections)) < 1e-10 * np.max(np.abs(passed))
        assert abs(reported) < 1e-10
        assert np.max(np.ptp(new.pressure, axis=1)) == 0.0
        old = new
    assert np.max(np.abs(new.area - first.area)) > 1e-4 * np.max(first.area)


@pytest.mark.parametrize("outlet", list(OUTLETS))
@pytest.mark.parametrize("inlet", ["velocity", "flow"])
def test_every_outlet_keeps_mass(inlet, outlet):
    keeps_mass(INLETS[inlet], outlet, 100)


@pytest.mark.parametrize("outlet", ["section resistance", "row resistance", "windkessel", "moving offset"])
def test_a_pressure_inlet_keeps_mass(outlet):
    """A load that keeps the blood flowing forwards."""
    keeps_mass(Inlet("pressure", wave(LOAD, 0.01)), outlet, 20, LOAD)


def test_mass_by_rows_needs_the_row_model():
    """The check that rows keep their own mass fails here: rows exchange blood."""
    model = with_sections(artery(16, 8, patch=PATTERNS["local, sharp"]))
    with pytest.raises(AssertionError):
        check(model, 1e-3, 1)


def test_without_asymmetry_rows_are_the_row_model():
    model = artery(16, 4, patch=PATTERNS["axisymmetric, sharp"], inlet=thesis_waveform())
    times = [0.0, 0.05, 0.1]
    one, other = simulate(model, times, 1e-3), simulate(with_sections(model), times, 1e-3)
    assert np.allclose(one.flow, other.flow, rtol=1e-5, atol=0)
    assert np.allclose(one.pressure, other.pressure, rtol=1e-5, atol=0)


@pytest.mark.parametrize("outlet", [name for name in OUTLETS if name != "non-reflecting"])
def test_a_steady_flow_is_the_same_through_every_section(coupled, outlet):
    model = coupled(20, 12, outlet=OUTLETS[outlet])
    state = steady_state(model, DIASTOLE)
    section = state.flow.sum(axis=1)
    assert np.ptp(section) < 1e-10 * section[0]
    assert np.ptp(state.flow[10]) > 0.01 * np.mean(state.flow)  # rows do differ
    again = SectionStepper(model, state)
    again.advance(np.full(20, DIASTOLE), 1e-3, 0.52, solver.marching.row_stepper.offsets(model, np.zeros(20)))
    assert np.max(np.abs(again.state().flow - state.flow)) < 1e-6 * np.max(state.flow)


def test_rest_stays_at_rest_over_a_jump_in_stiffness(coupled):
    inlet, outlet = Inlet("pressure", constant(12e3, 1.0)), PressureOutlet(constant(12e3, 1.0))
    model = replace(coupled(20, 12), inlet=inlet, outlet=outlet)
    run = simulate(model, [0.0, 0.1], 1e-3, uniform_state(model, 12e3, 0.0))
    assert np.max(np.abs(run.flow)) < 1e-18
    assert np.allclose(run.pressure, 12e3, rtol=1e-12)


def test_steps_of_1_ms_are_stable_over_ten_cycles(coupled):
    """E_calcified/E_healthy = 100 on the full grid: the last cycles repeat each other."""
    model = coupled(120, 48)
    run = simulate(model, PERIOD * np.arange(11), 1e-3)
    assert np.max(np.abs(np.diff(run.flow[-2:], axis=0))) < 1e-6 * np.max(run.flow)
    assert np.max(np.abs(run.mass_defect)) < 1e-9
    assert np.all(run.flow > 0)


def test_large_steps_agree_with_small_ones(coupled):
    model = coupled(40, 16)
    times = np.linspace(0.0, PERIOD, 9)
    coarse, fine = (simulate(model, times, dt) for dt in (1e-3, 0.25e-3))
    assert np.max(np.abs(coarse.flow / fine.flow - 1)) < 2e-3
    assert np.max(np.abs(section_flow(coarse) / section_flow(fine) - 1)) < 2e-4


@pytest.mark.parametrize("n_phi", [4, 8])
@pytest.mark.parametrize("time_step", [2e-4, 1e-3, 5e-3])
def test_energy_of_a_wave_never_grows(time_step, n_phi):
    """An inviscid wave between a closed end and an open one: ½ρΣQ²/A + ∫(P − P_out)dS only falls."""
    base = artery(
        40,
        n_phi,
        patch=PATTERNS["local, sharp"],
        viscosity=0.0,
        inlet=Inlet("velocity", constant(0.0, 1.0)),
        outlet=PressureOutlet(constant(LOAD, 1.0)),
    )
    model = with_sections(base)
    grid, amplitude = model.grid, 1e-3
    pressure = LOAD + amplitude * np.cos(0.5 * np.pi * grid.x / grid.length) ** 2
    start = uniform_state(model, LOAD, 0.0)
    start.area = model.area(pressure[:, None])
    start.pressure = np.repeat(pressure[:, None], n_phi, axis=1)
    slope = model.section_wall.area_and_slope(np.full(40, LOAD))[1].sum(axis=1)
    at_faces = np.ones(41)
    at_faces[[0, -1]] = 0.5

    def energy(state):
        area = model.area(LOAD)
        mean = np.vstack([area[:1], 0.5 * (area[1:] + area[:-1]), area[-1:]])
        kinetic = 0.5 * model.density * (at_faces @ (state.flow**2 / mean).sum(axis=1))
        potential = 0.5 * float(slope @ (state.pressure[:, 0] - LOAD) ** 2)
        return kinetic + potential

    stepper, theta = SectionStepper(model, start, tolerance=1e-12), implicitness(time_step)
    levels = [energy(stepper.state())]
    for n in range(60):
        stepper.advance_through(n * time_step, time_step, 1, theta)
        levels.append(energy(stepper.state()))
    assert np.all(np.diff(levels) <= 1e-7 * levels[0])
    assert levels[-1] < (0.9 if time_step > 5e-4 else 0.99) * levels[0]


def test_cross_flow_balances_rows_and_does_not_swirl(coupled):
    model = coupled(30, 16, ratio=16.0)
    grid, wall = model.grid, model.section_wall
    run = simulate(model, [0.0, 0.06, 0.0601], 1e-4)
    pressure = run.pressure[1, :, 0]
    flux = azimuthal_flux(wall, grid.dx, grid.dphi, pressure, run.flow[1])
    assert np.max(np.abs(flux.mean(axis=1))) < 1e-3 * np.max(np.abs(flux))
    assert np.allclose(flux, -flux[:, ::-1], atol=1e-3 * np.max(np.abs(flux)))  # mirror at φ = π
    stored = (run.area[2] - run.area[1]) / 1e-4
    along = np.diff(0.5 * (run.flow[1] + run.flow[2]), axis=0) / grid.dx
    around = (np.roll(flux, -1, axis=1) - np.roll(flux, 1, axis=1)) / (2 * grid.dphi)
    smooth = 0.25 * (np.roll(stored + along, 1, 1) + 2 * (stored + along) + np.roll(stored + along, -1, 1))
    assert np.max(np.abs(around + smooth)) < 0.02 * np.max(np.abs(around))


def test_patches_turn_with_the_artery(coupled):
    """Rows are numbered from anywhere."""
    model = artery(20, 12, patch=PATTERNS["local, sharp"], inlet=thesis_waveform())
    turned = replace(model, stiffness=np.roll(model.stiffness, 5, axis=1))
    one, other = (simulate(with_sections(m), [0.0, 0.1], 1e-3) for m in (model, turned))
    assert np.allclose(np.roll(one.flow, 5, axis=2), other.flow, rtol=1e-9)


def test_a_run_from_any_state_goes_on_with_the_same_bits(coupled):
    model = coupled(20, 8)
    times = np.linspace(0.0, 0.2, 5)
    whole = simulate(model, times, 1e-3)
    first = SectionStepper(model, steady_state(model, float(model.inlet.signal(0.0))))
    for begin, end in pairwise(times[:3]):
        first.advance_through(begin, (end - begin) / 50, 50, implicitness((end - begin) / 50))
    state = first.state()
    state.time = times[2]
    rest = simulate(model, times[2:], 1e-3, state)
    assert np.array_equal(rest.flow, whole.flow[2:])
    assert np.array_equal(rest.area, whole.area[2:])


def test_beyond_the_table_a_run_stops_with_the_place(coupled):
    """The load rises slowly to twice what the tables cover."""
    outlet = ResistanceOutlet(1.358e9, FourierSeries(40.0, 9330.0, (0.0,), (100e3,)))
    model = replace(coupled(20, 8, outlet=outlet), inlet=Inlet("velocity", constant(DIASTOLE, 1.0)))
    with pytest.raises(BeyondWallTable, match=r"t = [34]\..* s, i = "):
        simulate(model, [0.0, 10.0], 5e-3)


def test_a_model_without_sections_is_refused():
    model = artery(16, 4)
    with pytest.raises(ModelError, match="one pressure a section"):
        SectionStepper(model, uniform_state(model, LOAD, DIASTOLE))
    with pytest.raises(ModelError, match="sections' wall has cells"):
        replace(with_sections(model), grid=Grid(15e-3, 20, 4), stiffness=np.full((20, 4), HEALTHY))
