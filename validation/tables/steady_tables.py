"""Tables 3.1 to 3.4: steady states with calcification, and the orders regressed over 3.1 and 3.2."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.stats import linregress

from solver.marching.godunov import march_to_steady, thesis_criteria
from solver.marching.godunov_setup import Setup, State, load, reference_state, repeated
from validation.tables.artery import (
    DIASTOLE,
    FINE_STEP,
    LENGTH,
    LONGEST,
    PRINTED,
    QUARTER_CM,
    RADIUS,
    STEADY_OUTLET,
    artery,
    calcifying,
    flow_range,
    healthy_steady_state,
    plaque,
    quoted,
    ring,
    thesis_table,
)
from validation.tables.experiment import Check, Entry, Experiment, Result, Results, number, within

SIZES = tuple(range(30, 241, 30))
ROWS = tuple(range(12, 97, 12))
RAMP = 8e-3  # s
WALL_RAMP = 80e-3  # s


def _five_cells(n_x: int) -> float:
    return 5 * LENGTH / n_x


def _rest_area(setup: Setup, area_in: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Steady area with a pressure inlet, which has Q = 0 and constant pressure (2.2.63), m²."""
    beta = setup.wall.stiffness
    stretch = beta[0] / beta
    return np.asarray((np.sqrt(area_in) * stretch + RADIUS * (1 - stretch)) ** 2)


def _errors(setup: Setup, state: State) -> Result:
    """ε₂ and ε_∞ over the cells and the inlet, relative to the exact steady area (3.2.2–3)."""
    exact = _rest_area(setup, float(state.area[0, 0]))[:-1]
    error = state.area[:-1] - exact
    return {
        "eps_2": float(np.linalg.norm(error) / np.linalg.norm(exact)),
        "eps_inf": float(np.max(np.abs(error)) / np.max(exact)),
        "eps_Q": flow_range(state),
    }


def pressure_inlet(n_x: int, transition: float, pressure: float) -> Result:
    """Steady state of a pressure inlet (Pa) and a non-reflecting outlet, axisymmetric calcification."""
    setup = artery(
        n_x,
        1,
        6.25e-6 * 60 / n_x,
        ring(transition),
        inlet_kind="pressure",
        inlet=load(0.0, RAMP, 0.0, pressure),
        outlet_kind="non_reflecting",
    )
    steady = march_to_steady(
        setup, reference_state(setup), thesis_criteria("rest"), not_before=RAMP, longest=60.0
    )
    return _errors(setup, steady.state) | {"steps": steady.steps, "courant": steady.courant}


def velocity_inlet(n_x: int, transition: float) -> Result:
    """ε_Q of the steady state of a velocity inlet and a resistance outlet, axisymmetric calcification."""
    setup = artery(
        n_x,
        1,
        6.25e-6 * 60 / n_x,
        ring(transition),
        inlet=load(0.0, RAMP, 0.0, DIASTOLE),
        offset=load(0.0, RAMP, 0.0, STEADY_OUTLET[1]),
    )
    steady = march_to_steady(
        setup, reference_state(setup), thesis_criteria("flow"), not_before=RAMP, longest=LONGEST
    )
    return {"eps_Q": flow_range(steady.state), "steps": steady.steps, "courant": steady.courant}


def local_calcification(n_phi: int, transition: float) -> Result:
    """ε_Q of the steady state with local calcification, whose wall grows from the healthy steady state."""
    growing = artery(120, n_phi, FINE_STEP, plaque(transition), **calcifying(n_phi, WALL_RAMP), **PRINTED)
    steady = march_to_steady(
        growing,
        repeated(healthy_steady_state(STEADY_OUTLET), n_phi),
        thesis_criteria("ends"),
        not_before=WALL_RAMP,
        longest=LONGEST,
    )
    return {"eps_Q": flow_range(steady.state), "steps": steady.steps, "courant": steady.courant}


def _rows(
    table: str, key: str, columns: dict[str, tuple[str, str, str, float]], results: Results
) -> list[Check]:
    """Rows of a table with one line per ``key``.

    ``columns`` maps a column of the thesis's table to the prefix of its entries, the name of the number
    in them, the unit and the tolerance.
    """
    rows = []
    for _, line in thesis_table(table).iterrows():
        size = int(line[key])
        for column, (prefix, name, unit, tolerance) in columns.items():
            entry = f"{prefix} {key}={size}"
            if entry in results:
                ours = number(results[entry], name)
                rows.append(within(f"{key} = {size}", column, unit, ours, float(line[column]), tolerance))
    return rows


def _entries(
    prefix: str, key: str, sizes: Sequence[int], compute: Callable[[int], Result], quick: int
) -> list[Entry]:
    return [Entry(f"{prefix} {key}={size}", partial(compute, size), size <= quick) for size in sizes]


def _table_3_2(n_x: int) -> Result:
    return pressure_inlet(n_x, _five_cells(n_x), 1e4)


def _table_3_3_five(n_x: int) -> Result:
    return velocity_inlet(n_x, _five_cells(n_x))


def _table_3_4_three(n_phi: int) -> Result:
    return local_calcification(n_phi, 3 * 2 * np.pi / n_phi)


ENTRIES_3_1 = _entries(
    "table 3.1", "n_x", SIZES, partial(pressure_inlet, transition=QUARTER_CM, pressure=1e3), quick=120
)
ENTRIES_3_2 = _entries("table 3.2", "n_x", SIZES, _table_3_2, quick=90)

ERRORS_3_1 = {
    "eps_2": ("table 3.1", "eps_2", "", 0.025),
    "eps_inf": ("table 3.1", "eps_inf", "", 0.01),
    "eps_Q": ("table 3.1", "eps_Q", "cm^3/s", 0.01),
}
ERRORS_3_2 = {
    "eps_2": ("table 3.2", "eps_2", "", 0.025),
    "eps_inf": ("table 3.2", "eps_inf", "", 0.005),
    "eps_Q": ("table 3.2", "eps_Q", "cm^3/s", 0.005),
}
ERRORS_3_3 = {
    "eps_Q_xi_quarter_cm": ("table 3.3 quarter cm", "eps_Q", "cm^3/s", 0.01),
    "eps_Q_xi_5dx": ("table 3.3 five cells", "eps_Q", "cm^3/s", 0.01),
}
ERRORS_3_4 = {
    "eps_Q_xi_half_pi": ("table 3.4 half pi", "eps_Q", "cm^3/s", 0.005),
    "eps_Q_xi_3dphi": ("table 3.4 three cells", "eps_Q", "cm^3/s", 0.005),
}
REGRESSIONS = (
    ("order_eps_2", "table 3.1", "eps_2"),
    ("order_eps_inf", "table 3.1", "eps_inf"),
    ("order_eps_Q", "table 3.1", "eps_Q"),
    ("order_eps_2_five_cells", "table 3.2", "eps_2"),
)


def order_rows(results: Results) -> list[Check]:
    """Slopes of log ε over log Δx, once all sizes of a table are there."""
    rows = []
    for quantity, table, error in REGRESSIONS:
        names = [f"{table} n_x={n_x}" for n_x in SIZES]
        if all(name in results for name in names):
            errors = [number(results[name], error) for name in names]
            order = float(linregress(np.log(LENGTH / np.array(SIZES)), np.log(errors)).slope)
            rows.append(within(table, quantity, "", order, quoted(quantity, "axisymmetric"), 0.03))
    return rows


EXPERIMENTS = (
    Experiment(
        "3.1",
        "Axisymmetric calcification, 1 kPa at the inlet, transition 0.25 cm",
        ENTRIES_3_1,
        partial(_rows, "3_1", "n_x", ERRORS_3_1),
    ),
    Experiment(
        "3.2",
        "Axisymmetric calcification, 10 kPa at the inlet, transition 5 cells",
        ENTRIES_3_2,
        partial(_rows, "3_2", "n_x", ERRORS_3_2),
    ),
    Experiment(
        "3.3",
        "Axisymmetric calcification, velocity at the inlet",
        _entries(
            "table 3.3 quarter cm", "n_x", SIZES, partial(velocity_inlet, transition=QUARTER_CM), quick=240
        )
        + _entries("table 3.3 five cells", "n_x", SIZES, _table_3_3_five, quick=240),
        partial(_rows, "3_3", "n_x", ERRORS_3_3),
    ),
    Experiment(
        "3.4",
        "Local calcification, velocity at the inlet",
        _entries(
            "table 3.4 half pi", "n_phi", ROWS, partial(local_calcification, transition=np.pi / 2), quick=24
        )
        + _entries("table 3.4 three cells", "n_phi", ROWS, _table_3_4_three, quick=24),
        partial(_rows, "3_4", "n_phi", ERRORS_3_4),
    ),
    Experiment(
        "orders",
        "Orders of convergence regressed over tables 3.1 and 3.2",
        [Entry(e.name, e.compute, quick=False) for e in ENTRIES_3_1 + ENTRIES_3_2],
        order_rows,
    ),
)
