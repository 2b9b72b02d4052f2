"""Closures of the continuity condition: which D = v_x(r = 0) a cross-section gets (2.2.55–57).

With D the exponent of each row follows, γ = 2u/(D − u); it is admissible (γ > 0) where u lies strictly
between 0 and D.
"""

import math

from cases.arrays import Floats
from solver.schemes.godunov.layout import AVERAGE, AVERAGE_AXIS_RATIO, MAXIMUM, PARABOLIC, REST_VELOCITY
from solver.schemes.vectorisation import exact_kernel

GOLDEN = 0.3819660112501051  # (3 − √5)/2
PRECISION = 1e-12  # of D, relative to its bracket
MOST_ITERATIONS = 100


@exact_kernel
def average(u: Floats) -> float:
    """D = (γ_avg + 2)/γ_avg · mean_φ(u), γ_avg = 2, m/s (2.2.56); four partial sums run side by side."""
    quarter = u.size // 4
    a = b = c = d = 0.0
    for j in range(quarter):
        a += u[j]
        b += u[quarter + j]
        c += u[2 * quarter + j]
        d += u[3 * quarter + j]
    for j in range(4 * quarter, u.size):
        a += u[j]
    return AVERAGE_AXIS_RATIO * ((a + b) + (c + d)) / u.size


@exact_kernel
def maximum(u: Floats, gamma: Floats) -> float:
    """D = max_φ (γ+2)/γ u, m/s (2.2.57); in backward flow the largest magnitude."""
    largest = 0.0
    for j in range(u.size):
        axis = (1.0 + 2.0 / gamma[j]) * u[j]
        if abs(axis) > abs(largest):
            largest = axis
    return largest


@exact_kernel
def profile_distance(D: float, u: Floats, gamma: Floats) -> float:
    """Σ_j ‖v^c_j − v_j‖ in L²(0, 1), m/s: corrected profiles D(1 − y^g), g = 2u/(D − u), from the present.

    By ∫₀¹ (1 − y^a)(1 − y^b) dy = 1 − 1/(a+1) − 1/(b+1) + 1/(a+b+1).
    """
    total = 0.0
    for j in range(u.size):
        a, b = 2.0 * u[j] / (D - u[j]), gamma[j]
        axis = (1.0 + 2.0 / b) * u[j]
        own = 1.0 - 2.0 / (a + 1.0) + 1.0 / (2.0 * a + 1.0)
        present = 1.0 - 2.0 / (b + 1.0) + 1.0 / (2.0 * b + 1.0)
        mixed = 1.0 - 1.0 / (a + 1.0) - 1.0 / (b + 1.0) + 1.0 / (a + b + 1.0)
        total += math.sqrt(max(0.0, D * D * own - 2.0 * D * axis * mixed + axis * axis * present))
    return total


@exact_kernel
def least_squares(u: Floats, gamma: Floats) -> float:
    """D that minimises :func:`profile_distance`, m/s.

    Each row's distance falls up to its own axis velocity (γ+2)/γ u and rises beyond it, so the minimiser
    lies between the least and the largest of them (and beyond every |u|). The sum has a kink at each:
    the best of them brackets the minimum with its neighbours, then golden sections.
    """
    low, high, fastest = math.inf, 0.0, 0.0
    for j in range(u.size):
        axis = (1.0 + 2.0 / gamma[j]) * abs(u[j])
        low, high, fastest = min(low, axis), max(high, axis), max(fastest, abs(u[j]))
    sign = math.copysign(1.0, u[0])
    low = max(low, fastest * (1.0 + 1e-9))
    if not high > low:
        return sign * low
    best, least = low, profile_distance(sign * low, u, gamma)
    for j in range(u.size):
        axis = max((1.0 + 2.0 / gamma[j]) * abs(u[j]), low)
        distance = profile_distance(sign * axis, u, gamma)
        if distance < least:
            best, least = axis, distance
    begin, end = low, high
    for j in range(u.size):
        axis = (1.0 + 2.0 / gamma[j]) * abs(u[j])
        if begin < axis < best:
            begin = axis
        if best < axis < end:
            end = axis
    refined = golden_section(begin, end, sign, u, gamma)
    if profile_distance(sign * refined, u, gamma) < least:
        best = refined
    return sign * best


@exact_kernel
def golden_section(begin: float, end: float, sign: float, u: Floats, gamma: Floats) -> float:
    """Minimiser of :func:`profile_distance` at ``sign`` times a place between ``begin`` and ``end``."""
    width = PRECISION * end
    left, right = begin + GOLDEN * (end - begin), end - GOLDEN * (end - begin)
    at_left, at_right = profile_distance(sign * left, u, gamma), profile_distance(sign * right, u, gamma)
    for _ in range(MOST_ITERATIONS):
        if end - begin <= width:
            break
        if at_left < at_right:
            end, right, at_right = right, left, at_left
            left = begin + GOLDEN * (end - begin)
            at_left = profile_distance(sign * left, u, gamma)
        else:
            begin, left, at_left = left, right, at_right
            right = end - GOLDEN * (end - begin)
            at_right = profile_distance(sign * right, u, gamma)
    return 0.5 * (begin + end)


@exact_kernel
def close_section_profiles(u: Floats, gamma: Floats, closure: int) -> int:
    """Make one cross-section continuous on the axis: overwrite γ by 2u/(D − u).

    A section at rest keeps the parabola.

    Returns
    -------
    int
        0, or the first row (counted from 1) without an admissible exponent.
    """
    if closure == AVERAGE:
        D = average(u)
    elif closure == MAXIMUM:
        D = maximum(u, gamma)
    else:
        D = least_squares(u, gamma)
    refused = 0
    for j in range(u.size):
        refused += not u[j] * (D - u[j]) > 0.0
    if refused == 0:
        for j in range(u.size):
            gamma[j] = 2.0 * u[j] / (D - u[j])
        return 0
    at_rest = True
    for j in range(u.size):
        at_rest = at_rest and abs(u[j]) < REST_VELOCITY
    if at_rest:
        gamma[:] = PARABOLIC
        return 0
    for j in range(u.size):
        if not u[j] * (D - u[j]) > 0.0:
            return j + 1
    return 0
