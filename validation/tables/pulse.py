"""Section 3.1.1, figures 3.1 and 3.2: upwind, Lax–Wendroff and high-resolution methods on a block pulse.

Rows of an axisymmetric run are equal; one stands for the thesis's 24. The orders are measured on a
smooth wave with an exact solution, as a block pulse has none to speak of; the block pulse shows diffusion
(its error) and dispersion (its total variation over that of the exact block, which neither grows nor
shrinks while the block is inside).
"""

from functools import partial
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from reports.figures.plots import Plot, stacked_plots
from solver.marching.godunov import march
from solver.marching.godunov_setup import reference_state
from validation.tables.artery import HEALTHY, LENGTH, RADIUS, artery
from validation.tables.experiment import Check, Entry, Experiment, Result, Results, number, numbers
from validation.tables.simple_wave import area_error

PRESSURE, DURATION = 1e4, 0.3e-3  # Pa, s
TIMES = {"3.1": 0.46e-3, "3.2": 1.3e-3}  # s
REFINEMENTS = tuple(range(7))
QUICK = 3  # refinements
METHODS = {"upwind": "upwind", "lax_wendroff": "Lax–Wendroff", "van_leer": "high-resolution"}
ORDER_SIZES = (480, 960)
ORDERS = {"upwind": (0.9, 1.1), "lax_wendroff": (1.9, 2.1), "van_leer": (1.8, 2.2)}
OSCILLATING, MONOTONE = 1.4, 1.02  # least and largest total variation over the exact one


def block(times: Floats) -> Floats:
    """Inlet pressure, Pa (3.1.1)."""
    return np.where(times < DURATION * (1 - 1e-12), PRESSURE, 0.0)


def block_pulse(refinement: int, method: str) -> Result:
    """R (mm) over x at both times, and its total variation over that of the exact block."""
    n_x = 60 * 2**refinement
    setup = artery(
        n_x,
        1,
        17.5e-6 / 2**refinement,
        None,
        inlet_kind="pressure",
        inlet=block,
        outlet_kind="non_reflecting",
        limiter=method,
    )
    run = march(setup, reference_state(setup), list(TIMES.values()))
    height = PRESSURE * RADIUS**2 / HEALTHY
    result: Result = {"courant": run.courant}
    for figure, state in zip(TIMES, run.states, strict=True):
        radius = np.sqrt(state.area[1:-1, 0])
        result[f"radius_mm {figure}"] = [float(value) * 1e3 for value in radius]
        result[f"variation {figure}"] = float(np.sum(np.abs(np.diff(radius)))) / (2 * height)
    return result


def smooth_order(method: str) -> Result:
    """Order between two grids on the smooth wave."""
    coarse, fine = (area_error(n_x, method) for n_x in ORDER_SIZES)
    return {"order": float(np.log2(coarse / fine)), "error": fine}


def _pulse_name(refinement: int, method: str) -> str:
    return f"block pulse {method} n_x={60 * 2**refinement}"


def _order_name(method: str) -> str:
    return f"smooth wave {method}"


def _coarse_errors(results: Results, figure: str) -> dict[str, float]:
    """Mean error of R (mm) at n_x = 60 against the finest high-resolution run at hand."""
    names = [_pulse_name(r, "van_leer") for r in REFINEMENTS if _pulse_name(r, "van_leer") in results]
    finest = np.array(numbers(results[names[-1]], f"radius_mm {figure}"), dtype=float)
    errors = {}
    for method in METHODS:
        coarse = np.array(numbers(results[_pulse_name(0, method)], f"radius_mm {figure}"), dtype=float)
        errors[method] = float(np.mean(np.abs(coarse - finest.reshape(coarse.size, -1).mean(axis=1))))
    return errors


def _rows(results: Results) -> list[Check]:
    rows = []
    for method, (low, high) in ORDERS.items():
        name = _order_name(method)
        if name in results:
            rows.append(
                Check(
                    METHODS[method], "order, smooth wave", "", number(results[name], "order"), None, low, high
                )
            )
    for figure in TIMES:
        for method, label in METHODS.items():
            low, high = (OSCILLATING, np.inf) if method == "lax_wendroff" else (0.0, MONOTONE)
            for refinement in REFINEMENTS[2:]:
                name = _pulse_name(refinement, method)
                if name in results:
                    variation = number(results[name], f"variation {figure}")
                    case = f"{label}, n_x = {60 * 2**refinement}, {TIMES[figure] * 1e3:g} ms"
                    rows.append(Check(case, "total variation over exact", "", variation, None, low, high))
        if all(_pulse_name(0, method) in results for method in METHODS):
            errors = _coarse_errors(results, figure)
            ratio = errors["upwind"] / errors["van_leer"]
            case = f"n_x = 60, {TIMES[figure] * 1e3:g} ms"
            rows.append(Check(case, "error of upwind over high-resolution", "", ratio, None, 1.2, np.inf))
    return rows


def _lines(results: Results, method: str, figure: str) -> list[tuple[str, Floats, Floats]]:
    """R (mm) over x (mm) of each grid at hand."""
    radii = [
        np.array(numbers(results[entry], f"radius_mm {figure}"), dtype=float)
        for refinement in REFINEMENTS
        if (entry := _pulse_name(refinement, method)) in results
    ]
    return [
        (f"n_x = {radius.size}", (np.arange(radius.size) + 0.5) * LENGTH / radius.size * 1e3, radius)
        for radius in radii
    ]


def _draw(results: Results, folder: Path) -> list[Path]:
    return [
        stacked_plots(
            [
                Plot(f"{label}, t = {time * 1e3:g} ms", "x, mm", "R, mm", _lines(results, method, name))
                for method, label in METHODS.items()
            ],
            (7, 8),
            folder / f"figure_{name.replace('.', '_')}.png",
        )
        for name, time in TIMES.items()
    ]


EXPERIMENT = Experiment(
    "pulse",
    "Block pulse by three methods (figures 3.1 and 3.2)",
    [Entry(_order_name(method), partial(smooth_order, method), quick=True) for method in METHODS]
    + [
        Entry(_pulse_name(refinement, method), partial(block_pulse, refinement, method), refinement <= QUICK)
        for refinement in REFINEMENTS
        for method in METHODS
    ],
    _rows,
    _draw,
)
