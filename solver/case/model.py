"""From a checked case to the model that the solver runs; its wall is in :mod:`solver.case.wall`."""

import numpy as np

import cases.sections.outlet as stated
from cases.arrays import Flags, Floats
from cases.sections.case import Case
from cases.sections.inlet import FlowInlet, PressureInlet, ReferenceInlet, VelocityInlet
from cases.sections.solver import RESOLVED_PER_CYCLE, SemiImplicitSolver, Solver
from cases.values.waveform_file import Waveform as Samples
from solver.case.stiffness import patch_of
from solver.case.wall import walls_of
from solver.errors import ModelError
from solver.geometry.calcification import scaled_distance
from solver.geometry.grid import Grid
from solver.model.boundary import (
    Inlet,
    NonReflectingOutlet,
    Outlet,
    PressureOutlet,
    ResistanceOutlet,
    WindkesselOutlet,
)
from solver.model.diagnostics import Limits, Monitor
from solver.model.parameters import Model
from solver.model.profiles import TwoModes
from solver.model.waveform import FourierSeries, Ramped, Scaled, Signal, Waveform, constant

OUTPUTS_PER_CYCLE = 100  # where the case states no output_interval


def grid_of(case: Case) -> Grid:
    """Grid on (x, φ) of a case."""
    return Grid(case.geometry.length, case.solver.n_x, case.solver.n_phi)


def calcified_cells(case: Case) -> Flags:
    """Whether each cell's centre lies in a calcified rectangle, (n_x, n_phi)."""
    grid = grid_of(case)
    inside = np.zeros((grid.n_x, grid.n_phi), dtype=bool)
    for part in case.calcification.parts:
        inside |= scaled_distance(grid, patch_of(part)) == 0
    return inside


def _signal(waveform: Samples | None, value: float | None, period: float, spline: bool = False) -> Signal:
    if waveform is not None:
        return Waveform(waveform.times, waveform.values, spline)
    if value is None:  # the schema states one of the sources
        raise ValueError("a boundary states no source")
    return constant(value, period)


def inlet_signal(case: Case) -> Signal:
    """Return what is prescribed at the inlet over time, SI, without its ramp.

    Raises
    ------
    ModelError
        Where nothing is prescribed, for the inflow is that of the 3D reference.
    """
    inlet = case.inlet
    if isinstance(inlet, ReferenceInlet):
        raise ModelError(
            "inlet.kind: reference: the inflow is read from the 3D reference, which only a comparison does "
            "(python -m validation.compare)"
        )
    signal = _inlet_source(inlet)
    return signal if inlet.scale == 1.0 else Scaled(signal, inlet.scale)


def _inlet_source(inlet: VelocityInlet | FlowInlet | PressureInlet) -> Signal:
    if inlet.fourier is not None:
        series = inlet.fourier
        return FourierSeries(series.period, series.mean, tuple(series.cosines), tuple(series.sines))
    return _signal(inlet.waveform, inlet.value, inlet.period, inlet.interpolation == "spline")


def inlet_of(case: Case) -> Inlet:
    """Inlet of a case."""
    signal, ramp = inlet_signal(case), case.inlet.ramp
    return Inlet(case.inlet.kind, signal if ramp is None else Ramped(signal, ramp))


def outlet_of(case: Case) -> Outlet:
    """Outlet of a case."""
    outlet = case.outlet
    if isinstance(outlet, stated.ResistanceOutlet):
        offset: float | Signal = outlet.offset
        if outlet.ramp is not None:
            offset = Ramped(constant(outlet.offset, case.inlet.period), outlet.ramp)
        return ResistanceOutlet(outlet.resistance, offset, outlet.flow)
    if isinstance(outlet, stated.WindkesselOutlet):
        return WindkesselOutlet(
            outlet.proximal_resistance, outlet.distal_resistance, outlet.compliance, outlet.venous_pressure
        )
    if isinstance(outlet, stated.PressureOutlet):
        return PressureOutlet(_signal(outlet.waveform, outlet.value, case.inlet.period))
    return NonReflectingOutlet()


def model_of(case: Case) -> Model:
    """Model of a case, in SI.

    Raises
    ------
    ModelError
        For parameters outside what the equations allow.
    """
    grid = grid_of(case)
    walls = walls_of(case, grid)
    settings = case.solver
    exponent = settings.profile_exponent if isinstance(settings, SemiImplicitSolver) else None
    return Model(
        grid=grid,
        radius=case.geometry.radius,
        density=case.blood.density,
        viscosity=case.blood.viscosity,
        reference_pressure=walls.reference_pressure,
        stiffness=walls.stiffness,
        inlet=inlet_of(case),
        outlet=outlet_of(case),
        wall_table=walls.of_rows,
        fixed_exponent=exponent,
        section_wall=walls.of_sections,
        two_modes=two_modes_of(settings),
    )


def two_modes_of(settings: Solver) -> TwoModes | None:
    """Velocity profiles of two modes of a case; None for those of one exponent."""
    if not isinstance(settings, SemiImplicitSolver) or settings.closure not in ("mean", "axis_momentum"):
        return None
    return TwoModes(settings.closure, settings.base_exponent)


def error_tolerance(case: Case) -> float | None:
    """Relative error of a step that the case asks for; None for a fixed time step."""
    return case.solver.error_tolerance if isinstance(case.solver, SemiImplicitSolver) else None


def monitor_of(case: Case, model: Model, history: Floats | None = None) -> Monitor:
    """Monitor with the limits of a case; ``history`` is that of the run that is continued."""
    stated = case.solver.limits
    limits = Limits() if stated is None else Limits(**stated.model_dump())
    return Monitor(model, limits, case.inlet.period / RESOLVED_PER_CYCLE, history)


def default_output_times(case: Case) -> Floats:
    """Return the times of the saved states of a plain run, from 0 to the end of the last cycle, s."""
    duration = case.inlet.period * case.solver.cycles
    interval = case.solver.output_interval or case.inlet.period / OUTPUTS_PER_CYCLE
    whole = np.arange(0.0, duration * (1 - 1e-9), interval)
    return np.append(whole, duration)
