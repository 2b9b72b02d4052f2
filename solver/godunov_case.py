"""A checked case run with the Godunov scheme."""

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from cases.schema import Case
from cases.solver_settings import GodunovSolver
from solver.boundary import NonReflectingOutlet, ResistanceOutlet
from solver.errors import ModelError
from solver.from_case import model_of
from solver.godunov import Progress, march
from solver.godunov_setup import Setup, State, held, load, reference_state
from solver.model import Model
from solver.model import State as SteadyState
from solver.profiles import AVERAGE_EXPONENT, continuity_exponent
from solver.result import CellHistory, cell_dataset, cell_flow
from solver.schemes.layout import REST_VELOCITY
from solver.smooth_wall import smooth_wall
from solver.steady import steady_state
from solver.stepper import offsets
from solver.wall_from_case import healthy_and_calcified, patch_of

THREADS = 2
RAMP = 0.08  # s over which the wall stiffens before a run from the steady state

Floats = NDArray[np.float64]


def setup_of(case: Case, model: Model) -> Setup:
    """Return the set-up of the Godunov scheme for a case.

    Raises
    ------
    ModelError
        For a wall law but thin and thick, a sharp calcification, a flow inlet, or an outlet that this
        scheme lacks.
    """
    settings, outlet = case.solver, model.outlet
    if not isinstance(settings, GodunovSolver):
        raise ModelError(f"scheme {settings.scheme!r}; this run needs godunov")
    if model.inlet.kind == "flow":
        raise ModelError("scheme godunov needs an inlet of kind velocity or pressure")
    if not isinstance(outlet, ResistanceOutlet | NonReflectingOutlet):
        raise ModelError("scheme godunov needs an outlet of kind resistance or non_reflecting")
    resistance = outlet.resistance if isinstance(outlet, ResistanceOutlet) else 0.0
    return Setup(
        grid=model.grid,
        time_step=settings.time_step,
        radius=model.radius,
        density=model.density,
        viscosity=model.viscosity,
        reference_pressure=model.reference_pressure,
        wall=smooth_wall(model.grid, patch_of(case), *healthy_and_calcified(case)),
        inlet_kind=model.inlet.kind,
        inlet=model.inlet.signal,
        outlet_kind=outlet.flow if isinstance(outlet, ResistanceOutlet) else "non_reflecting",
        resistance=resistance,
        offset=lambda times: offsets(model, times),
        limiter=settings.limiter,
        closure=settings.closure,
        viscous_exchange=settings.coefficients,
        exponent_gradient=settings.coefficients,
    )


def initial_columns(case: Case, model: Model, setup: Setup) -> State:
    """Return the state to start from: rest, or the steady state of t = 0.

    The latter is that of the healthy wall, whose stiffness then grows over 80 ms to the calcified one, as in
    the thesis (3.3.2): where β varies this scheme does not keep another scheme's steady state.
    """
    if case.solver.start == "rest":
        return reference_state(setup)
    healthy, _ = healthy_and_calcified(case)
    before = replace(model, stiffness=np.full_like(model.stiffness, healthy))
    start = _columns(before, steady_state(before, float(model.inlet.signal(0.0))))
    if patch_of(case) is None:
        return start
    ramp = replace(
        setup,
        inlet=held(float(model.inlet.signal(0.0))),
        offset=held(float(offsets(model, [0.0])[0])),
        wall_before=smooth_wall(model.grid, None, healthy, healthy),
        wall_load=load(0.0, RAMP, 0.0, 1.0),
    )
    return replace(march(ramp, start, [RAMP], THREADS).states[-1], time=0.0)


def _columns(model: Model, steady: SteadyState) -> State:
    """State on inlet, cells and outlet from one of the semi-implicit scheme."""
    load_out = np.asarray(steady.outlet_pressure) - model.reference_pressure
    outlet = (model.radius + load_out * model.radius**2 / model.stiffness[-1]) ** 2
    area = np.vstack([1.5 * steady.area[0] - 0.5 * steady.area[1], steady.area, outlet])
    flow = np.vstack([steady.flow[0], cell_flow(steady.flow), steady.flow[-1]])
    exponent = continuity_exponent(flow / area, REST_VELOCITY)
    return State(0.0, area, flow, np.where(np.isfinite(exponent), exponent, AVERAGE_EXPONENT))


def run_godunov(case: Case, times: ArrayLike, progress: Progress | None = None) -> xr.Dataset:
    """Run a case; see :func:`solver.result.cell_dataset`; at the steps nearest to ``times`` (s).

    Raises
    ------
    SolverError
        As :func:`setup_of`, the march to the steady start, and the scheme.
    """
    model = model_of(case)
    setup = setup_of(case, model)
    wanted = np.asarray(times, dtype=float)
    run = march(setup, initial_columns(case, model, setup), wanted, THREADS, progress)
    area = np.array([state.area[1:-1] for state in run.states])
    cells = CellHistory(
        times=wanted,
        area=area,
        flow=np.array([state.flow[1:-1] for state in run.states]),
        pressure=model.pressure(area),
        exponent=np.array([state.exponent[1:-1] for state in run.states]),
        mass_defect=_mass_defect(model, run.states),
    )
    return cell_dataset(model, cells).assign_attrs(
        scheme="godunov", time_step_s=setup.time_step, steps=run.steps, courant_number=run.courant
    )


def _mass_defect(model: Model, states: list[State]) -> Floats:
    """Inflow − outflow − dV/dt over the inflow, dV/dt by central differences between the states."""
    times = np.array([state.time for state in states])
    volume = np.array([0.5 * model.grid.dphi * model.grid.dx * state.area[1:-1].sum() for state in states])
    inflow = np.array([0.5 * model.grid.dphi * state.flow[0].sum() for state in states])
    outflow = np.array([0.5 * model.grid.dphi * state.flow[-1].sum() for state in states])
    if times.size < 3:
        return np.zeros(times.size)
    change = np.gradient(volume, times)
    size = np.maximum(np.abs(inflow), REST_VELOCITY * np.pi * model.radius**2)
    return np.asarray((inflow - outflow - change) / size)
