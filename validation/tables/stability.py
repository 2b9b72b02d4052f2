"""Sections 3.1.2 and 3.2.3: largest Courant number over the time step, figures 3.3 and 3.16.

Near the limit the inlet's oscillations reach the outlet undamped and the Courant number there jumps from
one time step to the next, so the limit is the time step beyond which none is stable.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from reports.figures.plots import Plot, stacked_plots
from solver.errors import RunFailure
from solver.marching.godunov import march, march_to_steady, thesis_criteria
from solver.marching.godunov_setup import held, load, reference_state
from validation.tables.artery import DIASTOLE, QUARTER_CM, STEADY_OUTLET, artery, quoted, ring
from validation.tables.experiment import Check, Entry, Experiment, Number, Result, Results, numbers

RAMP = 8e-3  # s
GIVE_UP = 0.5  # s
STEP_TOLERANCE = 0.2  # µs
STABLE_COURANT = {"none": 1.0, "axisymmetric": np.inf}  # beyond it the thesis calls a run unstable
FIRST_STEPS = {"none": range(10, 40), "axisymmetric": range(1, 10)}  # µs; each entry covers one
QUICK = {"none": 23, "axisymmetric": 7}
LIMITS = {"none": "largest_stable_time_step", "axisymmetric": "largest_convergent_time_step"}
FIGURES = {"none": "3.3", "axisymmetric": "3.16"}


def pressure_step(time_step: float) -> Number:
    """Largest Courant number in 8 ms without calcification, 10 kPa at the inlet; None if it blows up."""
    setup = artery(
        60, 1, time_step, None, inlet_kind="pressure", inlet=held(1e4), outlet_kind="non_reflecting"
    )
    try:
        return march(setup, reference_state(setup), [RAMP]).courant
    except RunFailure:
        return None


def loaded_velocity(time_step: float) -> Number:
    """Largest Courant number until steady, axisymmetric calcification; None if it does not converge."""
    setup = artery(
        60,
        1,
        time_step,
        ring(QUARTER_CM),
        inlet=load(0.0, RAMP, 0.0, DIASTOLE),
        offset=load(0.0, RAMP, 0.0, STEADY_OUTLET[1]),
    )
    criteria = thesis_criteria("flow", 1e-3)
    try:
        return march_to_steady(
            setup, reference_state(setup), criteria, not_before=RAMP, longest=GIVE_UP
        ).courant
    except RunFailure:
        return None


RUNS: dict[str, Callable[[float], Number]] = {"none": pressure_step, "axisymmetric": loaded_velocity}


def scan(model: str, first: int) -> Result:
    """Ten time steps from ``first`` µs, 0.1 µs apart."""
    steps = [round(first + 0.1 * k, 1) for k in range(10)]
    courant = [RUNS[model](step * 1e-6) for step in steps]
    return {"time_step_us": list[Number](steps), "courant": courant}


def _name(model: str, first: int) -> str:
    return f"stability {model} {first} us"


def _curve(model: str, results: Results) -> list[tuple[float, Number]]:
    """Time steps (µs) and Courant numbers at hand, in order."""
    points: list[tuple[float, Number]] = []
    for first in FIRST_STEPS[model]:
        result = results.get(_name(model, first))
        if result is not None:
            steps = [step for step in numbers(result, "time_step_us") if step is not None]
            points.extend(zip(steps, numbers(result, "courant"), strict=True))
    return points


def _is_stable(model: str, courant: Number) -> bool:
    return courant is not None and courant <= STABLE_COURANT[model]


def _limit_rows(results: Results) -> list[Check]:
    rows = []
    for model in RUNS:
        points = _curve(model, results)
        unstable = [step for step, courant in points if not _is_stable(model, courant)]
        stable = [step for step, courant in points if _is_stable(model, courant)]
        if stable and unstable:
            thesis = quoted(LIMITS[model], model)
            allowed = STEP_TOLERANCE * (1 + 1e-9)
            rows.append(
                Check(model, LIMITS[model], "us", max(stable), thesis, thesis - allowed, thesis + allowed)
            )
    return rows


def _draw(results: Results, folder: Path) -> list[Path]:
    paths = []
    for model, figure in FIGURES.items():
        points = [(step, courant) for step, courant in _curve(model, results) if courant is not None]
        steps, courants = np.array(points).reshape(-1, 2).T
        plot = Plot(
            f"Calcification: {model}",
            "Δt, µs",
            "largest Courant number",
            [("", steps, courants)],
            points=True,
            guides=(1.0, quoted(LIMITS[model], model)),
        )
        paths.append(stacked_plots([plot], (6, 4), folder / f"figure_{figure.replace('.', '_')}.png"))
    return paths


EXPERIMENT = Experiment(
    "stability",
    "Largest stable time steps, n_x = 60 (figures 3.3 and 3.16)",
    [
        Entry(_name(model, first), partial(scan, model, first), first == QUICK[model])
        for model, steps in FIRST_STEPS.items()
        for first in steps
    ],
    _limit_rows,
    _draw,
)
