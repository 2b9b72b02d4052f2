"""A checked case run with the Godunov scheme."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.solver import GodunovSolver
from solver.case.model import monitor_of
from solver.case.stiffness import healthy_and_calcified, patch_of
from solver.errors import ModelError
from solver.marching.columns import columns_of
from solver.marching.godunov import Stepper, chunks, march, target_steps
from solver.marching.godunov_setup import Setup, State, held, load, reference_state
from solver.marching.row_fields import offsets
from solver.marching.steady import steady_state
from solver.marching.walk import Kept, Stop, kept_of, state_of
from solver.model.boundary import NonReflectingOutlet, Outlet, ResistanceOutlet, WindkesselOutlet
from solver.model.diagnostics import Columns
from solver.model.parameters import Model
from solver.model.parameters import State as SteadyState
from solver.model.profiles import AVERAGE_EXPONENT
from solver.schemes.layout import REST_VELOCITY
from solver.wall.smooth_patch import smooth_wall

THREADS = 2
RAMP = 0.08  # s over which the wall stiffens before a run from the steady state


def setup_of(case: Case, model: Model) -> Setup:
    """Return the set-up of the Godunov scheme for a case.

    Raises
    ------
    ModelError
        For a wall but a linear one of one material, or a sharp or divided calcification.
    """
    settings = case.solver
    if not isinstance(settings, GodunovSolver):
        raise ModelError(f"scheme {settings.scheme!r}; this run needs godunov")
    parts = case.calcification.parts
    patch = patch_of(parts[0]) if parts else None
    return Setup(
        grid=model.grid,
        time_step=settings.time_step,
        radius=model.radius,
        density=model.density,
        viscosity=model.viscosity,
        reference_pressure=model.reference_pressure,
        wall=smooth_wall(model.grid, patch, *healthy_and_calcified(case)),
        inlet_kind=model.inlet.kind,
        inlet=model.inlet.signal,
        offset=lambda times: offsets(model, times),
        **_outlet(model.outlet),
        limiter=settings.limiter,
        closure=settings.closure,
        viscous_exchange=settings.coefficients,
        exponent_gradient=settings.coefficients,
    )


def _outlet(outlet: Outlet) -> dict[str, Any]:
    """Fields of the set-up for an outlet; one of prescribed pressure has no resistance."""
    if isinstance(outlet, ResistanceOutlet):
        return {"outlet_kind": outlet.flow, "resistance": outlet.resistance}
    if isinstance(outlet, WindkesselOutlet):
        return {
            "outlet_kind": "windkessel",
            "resistance": outlet.proximal_resistance,
            "distal_resistance": outlet.distal_resistance,
            "capacitance": outlet.compliance,
            "venous_pressure": outlet.venous_pressure,
        }
    return {"outlet_kind": "non_reflecting" if isinstance(outlet, NonReflectingOutlet) else "section"}


def initial_columns(case: Case, model: Model, setup: Setup) -> State:
    """Return the state to start from: rest, or the steady state of t = 0.

    The latter is that of the healthy wall, whose stiffness then grows over 80 ms to the calcified one, as in
    the thesis (3.3.2): where β varies this scheme does not keep another scheme's steady state.
    """
    if case.solver.start == "rest":
        return replace(reference_state(setup), reservoir=model.reference_pressure)
    healthy, _ = healthy_and_calcified(case)
    before = replace(model, stiffness=np.full_like(model.stiffness, healthy))
    start = _columns(before, steady_state(before, float(model.inlet.signal(0.0))))
    if not case.calcification.parts:
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
    area, flow, exponent = columns_of(model, steady)[:3]
    gamma = np.where(np.isfinite(exponent), exponent, AVERAGE_EXPONENT)
    return State(0.0, area, flow, gamma, 0.0 if steady.reservoir is None else steady.reservoir)


def walk_godunov(case: Case, model: Model, times: Floats, kept: Kept | None = None) -> Iterator[Stop]:
    """Run a case through the steps nearest to ``times`` (s), from its start or where ``kept`` was left."""
    setup = setup_of(case, model)
    state = initial_columns(case, model, setup) if kept is None else state_of(State, kept)
    begin = 0 if kept is None else int(kept["steps"])
    monitor = monitor_of(case, model, None if kept is None else kept["history"])
    dt = setup.time_step
    with Stepper(setup, state, THREADS, begin) as stepper:
        for time, target in zip(times, target_steps(setup, 0.0, times), strict=True):
            stepper.begin_interval()
            for _ in chunks(stepper, int(target)):
                pass
            old, state = state, stepper.state
            columns = Columns(state.area, state.flow, state.exponent, _pressure(setup, state))
            defect = _mass_defect(model, old, state, stepper.passed, dt)
            diagnostics = monitor.look(state.time, columns, dt, defect)
            left = kept_of(state) | {"history": monitor.history, "steps": np.asarray(stepper.steps)}
            yield Stop(float(time), columns, diagnostics, stepper.steps - begin, 0, dt, left)


def _mass_defect(model: Model, old: State, new: State, passed: Floats, time_step: float) -> float:
    """Inflow − outflow − change of volume over the inflow; ``passed`` (m³) becomes the trapezoidal rule's."""
    section = 0.5 * model.grid.dphi
    ends = section * (old.flow[[0, -1]] - new.flow[[0, -1]]).sum(axis=1)
    inflow, outflow = passed + 0.5 * time_step * ends
    change = section * model.grid.dx * float(np.sum(new.area[1:-1] - old.area[1:-1]))
    rest = REST_VELOCITY * np.pi * model.radius**2 * time_step
    return float((inflow - outflow - change) / max(abs(inflow), abs(outflow), rest))


def _pressure(setup: Setup, state: State) -> Floats:
    strain = (np.sqrt(state.area) - setup.radius) / setup.radius**2
    return np.asarray(setup.reference_pressure + setup.wall.stiffness * strain)
