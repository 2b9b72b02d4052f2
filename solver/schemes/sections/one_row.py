"""The passes of one row alone: along x in vector instructions (numba kernels).

Each gives the digits of its namesake in :mod:`solver.schemes.sections.rows`, whose loops go around: products
and sums stand in the order that LLVM chose there.
"""

from cases.arrays import Floats
from solver.schemes.layout import BEYOND_WALL_TABLE, OK
from solver.schemes.vectorisation import exact_kernel, kernel


@kernel
def wall_areas(
    table: Floats,
    sums: Floats,
    start: float,
    step: float,
    pressure: Floats,
    area: Floats,
    totals: Floats,
    slopes: Floats,
) -> tuple[int, int]:
    """Find A, by the table's values and by their sums, and ΣdA/dP; status and section."""
    values, both, found, last = table.flat, sums.flat, area.flat, table.shape[1] - 2
    for i in range(totals.size):
        position = (pressure[i] - start) / step
        if not 0.0 <= position <= last + 1.0:
            return BEYOND_WALL_TABLE, i
        k = min(int(position), last)
        t = position - k
        m = 2 * (i * table.shape[1] + k)
        square, rest = t * t, t - 1.0
        h01 = square * (3.0 - 2.0 * t)
        value = values[m] + h01 * (values[m + 2] - values[m])
        value += rest * t * (rest * step) * values[m + 1]
        found[i] = value + square * (rest * step) * values[m + 3]
        a0, d0, a1, d1 = both[m], both[m + 1] * step, both[m + 2], both[m + 3] * step
        curve, twist = 3.0 * (a1 - a0) - 2.0 * d0 - d1, d0 + d1 - 2.0 * (a1 - a0)
        totals[i] = a0 + t * (d0 + t * (curve + t * twist))
        slopes[i] = (d0 + t * (2.0 * curve + 3.0 * t * twist)) / step
    return OK, 0


@kernel
def areas_between(old: Floats, new: Floats, theta: float, mean_area: Floats, face_area: Floats) -> None:
    """θ-weighted A in cells, and between them into the inside of rows with ghosts."""
    before, after, mean = old.flat, new.flat, mean_area.flat
    for i in range(mean_area.size):
        mean[i] = before[i] + theta * (after[i] - before[i])
    for i in range(1, mean_area.size):
        face_area[i, 1] = 0.5 * (mean[i - 1] + mean[i])


@kernel
def weighted(old: Floats, new: Floats, theta: float, mean: Floats, totals: Floats) -> None:
    """θ-weighted mean, twice."""
    before, after, result = old.flat, new.flat, mean.flat
    for f in range(totals.size):
        value = before[f] + theta * (after[f] - before[f])
        result[f] = value
        totals[f] = value


@kernel
def fixed_profiles(
    face_area: Floats,
    alpha: Floats,
    damping: Floats,
    mean_damping: Floats,
    area_total: Floats,
    exponent: float,
    scale: float,
) -> None:
    """α, Δt S and A of all faces for a given γ."""
    coefficient, source = alpha.flat, damping.flat
    for f in range(area_total.size):
        area_total[f] = face_area[f, 1]
    both, friction = (exponent + 2.0) / (exponent + 1.0), -2.0 * (exponent + 2.0) * scale
    for f in range(area_total.size):
        coefficient[f] = both
        value = friction * (1.0 / area_total[f])
        source[f] = value
        mean_damping[f] = value


@kernel
def momentum_fluxes(
    flow: Floats, mean_area: Floats, alpha: Floats, theta: float, flux: Floats, slopes: Floats
) -> None:
    """αQ²/A at cell centres, and θ times its derivative by either face's Q."""
    through, area, coefficient, result = flow.flat, mean_area.flat, alpha.flat, flux.flat
    for i in range(slopes.size):
        q = through[i] + through[i + 1]
        momentum = 0.125 * (coefficient[i] + coefficient[i + 1]) * q / area[i]
        result[i] = momentum * q
        slopes[i] = 2.0 * theta * momentum


@kernel
def momentum_balance(
    old: Floats,
    new: Floats,
    flow: Floats,
    damping: Floats,
    flux: Floats,
    face_area: Floats,
    drive: Floats,
    advection: float,
    residual: Floats,
    total: Floats,
) -> None:
    """Momentum balance of all inner faces, twice."""
    before, after, mean, source = old.flat, new.flat, flow.flat, damping.flat
    carried, result = flux.flat, residual.flat
    for f in range(1, total.size - 1):
        rest = before[f] + source[f] * mean[f] - after[f] - advection * (carried[f] - carried[f - 1])
        rest -= drive[f] * face_area[f, 1]
        result[f] = rest
        total[f] = rest


@exact_kernel
def rounded(one: float, other: float) -> float:
    """Product that is rounded before it is added to anything."""
    return one * other


@kernel
def solve_rows(residual: Floats, face_area: Floats, pull: Floats, matrix: Floats, outlet_known: bool) -> None:
    """δQ from the momentum balance, δQ at the inlet and the pressure's change, in place."""
    lower, pivot, upper, known = matrix[0], matrix[1], matrix[2], residual.flat
    last = residual.size - 1 if outlet_known else residual.size
    before, divisor = known[0], 1.0
    for f in range(1, last):
        factor = lower[f] / divisor
        divisor = pivot[f]
        if f > 1:
            divisor -= factor * upper[f - 1]
        pivot[f] = divisor
        before = known[f] - (pull[f] * face_area[f, 1] + rounded(factor, before))
        known[f] = before
    after = known[last] if outlet_known else 0.0
    for f in range(last - 1, 0, -1):
        above = upper[f] if f < residual.size - 1 else 0.0
        after = (known[f] - above * after) / pivot[f]
        known[f] = after


@kernel
def take_change(change: Floats, flow: Floats, totals: Floats) -> tuple[float, float]:
    """Add δQ to the iterate; sums of squares of the change and of the new flow, and the latter."""
    step, result = change.flat, flow.flat
    squares, size = 0.0, 0.0
    for f in range(totals.size):
        new = result[f] + step[f]
        result[f] = new
        totals[f] = new
        squares += step[f] * step[f]
        size += new * new
    return squares, size
