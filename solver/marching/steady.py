"""Steady states by marching with large implicit steps."""

import numpy as np

from solver.errors import NotSteady, RunFailure
from solver.marching.row_fields import offsets
from solver.marching.section_stepper import stepper_of
from solver.model.boundary import NonReflectingOutlet, ResistanceOutlet
from solver.model.parameters import Model, State, uniform_state
from solver.schemes.layout import REST_VELOCITY

FIRST_STEP, SHORTEST_STEP, LONGEST_STEP, GROWTH = 1e-2, 1e-5, 1.0, 2.0  # s, s, s, –
MOST_STEPS = 20_000


def _guess(model: Model, inlet_value: float) -> State:
    """Uniform state near the steady one."""
    offset = float(offsets(model, [0.0])[0])
    kind = model.inlet.kind
    section = np.pi * model.radius**2
    velocity = inlet_value if kind == "velocity" else inlet_value / section if kind == "flow" else 0.0
    if isinstance(model.outlet, ResistanceOutlet):
        return uniform_state(model, offset + model.outlet.resistance * velocity * section, velocity)
    if kind == "pressure":
        return uniform_state(model, inlet_value, velocity)
    if isinstance(model.outlet, NonReflectingOutlet):
        return uniform_state(model, model.reference_pressure, velocity)
    venous = getattr(model.outlet, "venous_pressure", offset)
    drop = getattr(model.outlet, "proximal_resistance", 0.0) + getattr(model.outlet, "distal_resistance", 0.0)
    return uniform_state(model, venous + drop * velocity * section, velocity)


def steady_state(model: Model, inlet_value: float, start: State | None = None) -> State:
    """March to the state that a constant inlet value leads to.

    Fully implicit steps that grow from 10 ms, until nothing changes any more; a step that fails is halved,
    and none is longer after it. The outlet's prescribed pressure is that of time 0.

    Parameters
    ----------
    model : Model
    inlet_value : float
        v (m/s), q (m³/s) or P (Pa), by the inlet's kind.
    start : State, optional
        Where to march from; default: a uniform state.

    Raises
    ------
    ModelError
        If the wall law has no state near the steady one.
    RunFailure
        NotSteady when 20,000 steps do not suffice, or what a step of 10 µs raises; the message says that
        this happened on the way to the steady state.
    """
    stepper = stepper_of(model, start.copy() if start else _guess(model, inlet_value))
    value, offset = np.array([inlet_value]), offsets(model, [0.0])
    time_step, longest = FIRST_STEP, LONGEST_STEP
    state = stepper.state()
    for _ in range(MOST_STEPS):
        try:
            stepper.advance(value, time_step, 1.0, offset)
        except RunFailure as failure:
            if time_step < 2 * SHORTEST_STEP:
                detail = (
                    f"on the march to the steady state, whose time this is, in steps of {time_step:.2g} s too"
                )
                raise type(failure)(failure.time, failure.i, failure.j, detail) from failure
            stepper.restore(state)
            time_step = longest = 0.5 * time_step
            continue
        before, state = state, stepper.state()
        if _settled(model, before, state, time_step):
            state.time = 0.0
            return state
        time_step = min(GROWTH * time_step, longest)
    raise NotSteady(stepper.time, 0, 0, f"{MOST_STEPS} steps of the march to it do not suffice")


def _settled(model: Model, before: State, after: State, time_step: float) -> bool:
    """Whether a step changed nothing beyond round-off; Δt/Δx ΔQ adds that of Q to the area."""
    rest = REST_VELOCITY * 1e-3 * model.radius**2
    fastest = float(np.max(np.abs(after.flow)))
    if not np.max(np.abs(after.flow - before.flow)) <= 1e-12 * fastest + rest:
        return False
    round_off = 8 * np.finfo(float).eps * time_step / model.grid.dx * fastest
    old, new = (model.pressure(s.area) if s.pressure is None else s.pressure for s in (before, after))
    load_change = np.max(np.abs(new - old))  # in a stiff wall the area hardly shows it
    axis_change, axis = 0.0, 0.0
    if before.axis_velocity is not None and after.axis_velocity is not None:
        axis_change = float(np.max(np.abs(after.axis_velocity - before.axis_velocity)))
        axis = float(np.max(np.abs(after.axis_velocity)))
    return bool(
        axis_change <= 1e-12 * axis + 1e-3 * REST_VELOCITY
        and np.max(np.abs(after.area - before.area)) < 1e-13 * float(np.max(after.area)) + round_off
        and load_change <= 1e-11 * np.max(np.abs(new)) + 1e-9
    )
