"""An exact solution: a right-going simple wave in a uniform wall, without friction and with a flat profile.

With α = 1, H has the Riemann invariants u ± 4c, c² = β√A/(2ρA₀). Where u − 4c is one constant, A and u
stay constant along x = x₀ + (u + c)t.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from cases.arrays import Floats
from solver.marching.godunov import march
from solver.marching.godunov_setup import State, held
from validation.tables.artery import DENSITY, HEALTHY, LENGTH, RADIUS, artery

PLUG = 1e9  # γ of a flat profile: α = 1 to nine digits
PEAK, CENTRE, WIDTH = 1e3, 4.5e-3, 0.9e-3  # Pa, m, m: a Gaussian pulse
END = 0.6e-3  # s, before the wave breaks
COARSEST_STEP = 17.5e-6  # s, with n_x = 60
BISECTIONS = 60


def _initial_radius(x: Floats) -> Floats:
    return np.asarray(RADIUS + PEAK * np.exp(-(((x - CENTRE) / WIDTH) ** 2)) * RADIUS**2 / HEALTHY)


def _speed(radius: Floats | float) -> Floats:
    """Return c, m/s."""
    return np.sqrt(HEALTHY * np.asarray(radius) / (2 * DENSITY * RADIUS**2))


def initial_area(x: Floats) -> Floats:
    """Return A at t = 0, m²."""
    return _initial_radius(x) ** 2


def initial_flow(x: Floats) -> Floats:
    """Return Q at t = 0, m³/s: u = 4(c − c₀)."""
    return np.asarray(initial_area(x) * 4 * (_speed(_initial_radius(x)) - _speed(RADIUS)))


def exact_area(x: Floats, time: float) -> Floats:
    """Return A at ``time`` (s), m², by bisection for the foot of each characteristic."""

    def foot_defect(foot: Floats) -> Floats:
        c = _speed(_initial_radius(foot))
        return np.asarray(foot + (5 * c - 4 * _speed(RADIUS)) * time - x)

    fastest = 5 * float(_speed(_initial_radius(np.array([CENTRE])))[0]) - 4 * float(_speed(RADIUS))
    low, high = x - fastest * time, x - float(_speed(RADIUS)) * time
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        ahead = foot_defect(middle) < 0
        low, high = np.where(ahead, middle, low), np.where(ahead, high, middle)
    return initial_area(0.5 * (low + high))


def cell_means(function: Callable[[Floats], Floats], n_x: int) -> Floats:
    """Return means over the cells by Gauss quadrature, (n_x,)."""
    points, weights = np.polynomial.legendre.leggauss(4)
    dx = LENGTH / n_x
    centres = (np.arange(n_x) + 0.5) * dx
    values: Any = sum(w * function(centres + 0.5 * dx * p) for p, w in zip(points, weights, strict=True))
    return np.asarray(values / 2)


def area_error(n_x: int, limiter: str) -> float:
    """Mean |A − exact|/A₀ over the cells at the end, Courant number near 0.75 on every grid."""
    steps = round(END / (COARSEST_STEP * 60 / n_x))
    setup = artery(
        n_x,
        1,
        END / steps,
        None,
        viscosity=0.0,
        inlet_kind="pressure",
        inlet=held(0.0),
        outlet_kind="non_reflecting",
        limiter=limiter,
        fixed_exponent=PLUG,
    )
    ends = np.array([0.0, LENGTH])

    def column(function: Callable[[Floats], Floats]) -> Floats:
        at_ends = function(ends)
        return np.concatenate((at_ends[:1], cell_means(function, n_x), at_ends[1:]))[:, None]

    exponent = np.full((n_x + 2, 1), PLUG)
    initial = State(0.0, column(initial_area), column(initial_flow), exponent)
    final = march(setup, initial, [END]).states[0]
    exact = cell_means(lambda x: exact_area(x, END), n_x)
    return float(np.mean(np.abs(final.area[1:-1, 0] - exact))) / RADIUS**2
