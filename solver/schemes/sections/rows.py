"""What every row of a section does under one pressure: numba kernels, a pass over the whole artery each.

Face f lies left of cell f; a row of φ is contiguous. Each pass takes plain arrays, so that its inner loops
vectorise.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.layout import BEYOND_WALL_TABLE, NO_ADMISSIBLE_PROFILE, OK, REST_VELOCITY
from solver.schemes.sections import one_row
from solver.schemes.vectorisation import kernel, summing_kernel


@summing_kernel
def wall_row(table: Floats, start: float, step: float, pressure: float, area: Floats) -> int:
    """Find A of one section's cells at its pressure in a table (knots, 2, n_phi); OK or BEYOND_WALL_TABLE."""
    last = table.shape[0] - 2
    position = (pressure - start) / step
    if not 0.0 <= position <= last + 1.0:
        return BEYOND_WALL_TABLE
    k = min(int(position), last)
    t = position - k
    h11 = t * t * (t - 1.0) * step
    h10 = t * (t - 1.0) * (t - 1.0) * step
    h01 = t * t * (3.0 - 2.0 * t)
    h00 = 1.0 - h01
    for j in range(area.size):
        value = h00 * table[k, 0, j] + h01 * table[k + 1, 0, j]
        area[j] = value + h10 * table[k, 1, j] + h11 * table[k + 1, 1, j]
    return OK


@kernel
def wall_sum(sums: Floats, start: float, step: float, pressure: float) -> tuple[float, float]:
    """ΣA and ΣdA/dP of one section at a pressure inside its table (knots, 2)."""
    position = (pressure - start) / step
    k = min(int(position), sums.shape[0] - 2)
    t = position - k
    a0, d0, a1, d1 = sums[k, 0], sums[k, 1] * step, sums[k + 1, 0], sums[k + 1, 1] * step
    curve, twist = 3.0 * (a1 - a0) - 2.0 * d0 - d1, d0 + d1 - 2.0 * (a1 - a0)
    area = a0 + t * (d0 + t * (curve + t * twist))
    return area, (d0 + t * (2.0 * curve + 3.0 * t * twist)) / step


@summing_kernel
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
    """Find A of all cells, and ΣA and ΣdA/dP of all sections; status and section."""
    if area.shape[1] == 1:
        return one_row.wall_areas(table, sums, start, step, pressure, area, totals, slopes)
    for i in range(area.shape[0]):
        status = wall_row(table[i], start, step, pressure[i], area[i])
        if status != OK:
            return status, i
        totals[i], slopes[i] = wall_sum(sums[i], start, step, pressure[i])
    return OK, 0


@summing_kernel
def weighted(old: Floats, new: Floats, theta: float, mean: Floats, totals: Floats) -> None:
    """θ-weighted mean of two 2-D arrays, and its sums over φ."""
    if old.shape[1] == 1:
        one_row.weighted(old, new, theta, mean, totals)
        return
    for i in range(old.shape[0]):
        total = 0.0
        for j in range(old.shape[1]):
            value = (1.0 - theta) * old[i, j] + theta * new[i, j]
            mean[i, j] = value
            total += value
        totals[i] = total


@summing_kernel
def section_sums(values: Floats, totals: Floats) -> None:
    """Sum a 2-D array over φ."""
    for i in range(values.shape[0]):
        total = 0.0
        for j in range(values.shape[1]):
            total += values[i, j]
        totals[i] = total


@summing_kernel
def scaled_rows(values: Floats, factors: Floats, scaled: Floats) -> None:
    """Rows of a 2-D array times one factor each."""
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            scaled[i, j] = factors[i] * values[i, j]


@summing_kernel
def areas_between(old: Floats, new: Floats, theta: float, mean_area: Floats, face_area: Floats) -> None:
    """θ-weighted A in cells, and between them into the inside of rows with ghosts."""
    n = old.shape[1]
    if n == 1:
        one_row.areas_between(old, new, theta, mean_area, face_area)
        return
    for i in range(old.shape[0]):
        for j in range(n):
            mean_area[i, j] = (1.0 - theta) * old[i, j] + theta * new[i, j]
        if i > 0:
            for j in range(n):
                face_area[i, j + 1] = 0.5 * (mean_area[i - 1, j] + mean_area[i, j])


@summing_kernel
def _closure(
    area: Floats,
    velocity: Floats,
    inverse_area: Floats,
    bend: Floats,
    slope: Floats,
    alpha: Floats,
    damping: Floats,
    d: float,
    scale: float,
    dphi: float,
) -> bool:
    """α and Δt S of one face by the continuity closure; whether all its rows have an exponent.

    With g = 1/γ = (D−u)/(2u): α = 2D/(D+u), γ/2 + 1 = D/(D−u), (γ+2)/γ = D/u, and the last two terms of h
    are −∂²_φg. ``bend`` holds g, ``slope`` γ/2 + 1; rows with ghosts are those of n_phi + 2.
    """
    n = alpha.size
    admissible = 0
    for j in range(n):
        u = velocity[j + 1]
        square = (d - u) * (d + u)
        inverse = 1.0 / (u * square)
        admissible += (u * d > 0.0) & (square > 0.0)
        both = d * u * inverse
        bend[j + 1] = 0.5 * d * square * inverse - 0.5
        alpha[j] = 2.0 * both * (d - u)
        slope[j] = both * (d + u)
    bend[0], bend[n + 1] = bend[n], bend[1]
    first, second = 0.5 / dphi, 1.0 / (dphi * dphi)
    for j in range(n):
        inverse = inverse_area[j]
        a_slope = (area[j + 2] - area[j]) * first * inverse
        a_bend = (area[j + 2] - 2.0 * area[j + 1] + area[j]) * second * inverse
        g_bend = (bend[j + 2] - 2.0 * bend[j + 1] + bend[j]) * second
        bracket = 0.5 * a_bend - 0.5 * slope[j] * a_slope * a_slope - g_bend
        damping[j] = scale * inverse * ((2.0 + 4.0 * bend[j + 1]) * bracket - 4.0 * slope[j])
    return admissible == n


@summing_kernel
def _fixed(inverse_area: Floats, alpha: Floats, damping: Floats, exponent: float, scale: float) -> None:
    """α and Δt S of one face for a given γ."""
    for j in range(alpha.size):
        alpha[j] = (exponent + 2.0) / (exponent + 1.0)
        damping[j] = -2.0 * (exponent + 2.0) * scale * inverse_area[j]


@kernel
def _at_rest(velocity: Floats) -> bool:
    count = 0
    for j in range(velocity.size):
        count += abs(velocity[j]) < REST_VELOCITY
    return count == velocity.size


@kernel
def _inadmissible_row(velocity: Floats, d: float) -> int:
    for j in range(velocity.size - 2):
        if not 0.0 < velocity[j + 1] / d < 1.0:
            return j
    return 0


@summing_kernel
def profiles(
    flow: Floats,
    face_area: Floats,
    velocity: Floats,
    alpha: Floats,
    damping: Floats,
    mean_damping: Floats,
    area_total: Floats,
    scratch: Floats,
    exponent: float,
    scale: float,
    dphi: float,
) -> tuple[int, int, int]:
    """u, α and Δt S of all faces from θ-weighted Q and A; status, face and row.

    ``exponent`` is a fixed γ or 0; ``scale`` is Δt μ/ρ.
    """
    n = flow.shape[1]
    if n == 1 and exponent > 0.0:
        one_row.fixed_profiles(face_area, alpha, damping, mean_damping, area_total, exponent, scale)
        return OK, 0, 0
    inverse, bend, slope = scratch[0], scratch[1], scratch[2]
    for f in range(flow.shape[0]):
        total, areas = 0.0, 0.0
        for j in range(n):
            inverse[j] = 1.0 / face_area[f, j + 1]
            u = flow[f, j] * inverse[j]
            velocity[f, j + 1] = u
            total += u
            areas += face_area[f, j + 1]
        area_total[f] = areas
        velocity[f, 0], velocity[f, n + 1] = velocity[f, n], velocity[f, 1]
        face_area[f, 0], face_area[f, n + 1] = face_area[f, n], face_area[f, 1]
        d = 2.0 * total / n
        if exponent > 0.0:
            _fixed(inverse, alpha[f], damping[f], exponent, scale)
        elif (
            not _closure(
                face_area[f], velocity[f], inverse, bend, slope, alpha[f], damping[f], d, scale, dphi
            )
            or abs(d) <= REST_VELOCITY
        ):
            if not _at_rest(velocity[f]):
                return NO_ADMISSIBLE_PROFILE, f, _inadmissible_row(velocity[f], d)
            _fixed(inverse, alpha[f], damping[f], 2.0, scale)
        total = 0.0
        for j in range(n):
            total += damping[f, j]
        mean_damping[f] = total / n
    return OK, 0, 0


@summing_kernel
def momentum_fluxes(
    flow: Floats, mean_area: Floats, alpha: Floats, theta: float, flux: Floats, slopes: Floats
) -> None:
    """αQ²/A at cell centres, and θ times the mean over φ of its derivative by either face's Q."""
    n = flow.shape[1]
    if n == 1:
        one_row.momentum_fluxes(flow, mean_area, alpha, theta, flux, slopes)
        return
    for i in range(flux.shape[0]):
        total = 0.0
        for j in range(n):
            q = flow[i, j] + flow[i + 1, j]
            momentum = 0.125 * (alpha[i, j] + alpha[i + 1, j]) * q / mean_area[i, j]
            flux[i, j] = momentum * q
            total += momentum
        slopes[i] = 2.0 * theta * total / n


@summing_kernel
def cross_flows(
    old_area: Floats,
    area: Floats,
    flow: Floats,
    rate: float,
    dx: float,
    dphi: float,
    source: Floats,
    cross: Floats,
) -> None:
    """W on the φ-faces of cells from the rows' mass balance, zero on average; ``rate`` is 1/Δt.

    Four sections go through the running sum at once: it waits for each addition, they do not for each other.
    ``source`` is scratch (4, n_phi at least).
    """
    n_x, n = area.shape
    if n == 1:  # a row alone exchanges nothing: W stays 0
        return
    storage, outflow = dphi * rate, dphi / dx
    balance, level = np.zeros(4), np.zeros(4)
    for first in range(0, n_x, 4):
        for k in range(4):
            i = min(first + k, n_x - 1)
            total = 0.0
            for j in range(n):
                change = storage * (area[i, j] - old_area[i, j]) + outflow * (flow[i + 1, j] - flow[i, j])
                source[k, j] = change
                total += change
            balance[k] = total / n
        b0, b1, b2, b3 = balance
        w0, w1, w2, w3 = 0.0, 0.0, 0.0, 0.0
        m0, m1, m2, m3 = 0.0, 0.0, 0.0, 0.0
        for j in range(n):
            next0, next1 = w0 + (b0 - source[0, j]), w1 + (b1 - source[1, j])
            next2, next3 = w2 + (b2 - source[2, j]), w3 + (b3 - source[3, j])
            source[0, j], source[1, j], source[2, j], source[3, j] = w0, w1, w2, w3
            m0, m1, m2, m3 = m0 + w0, m1 + w1, m2 + w2, m3 + w3
            w0, w1, w2, w3 = next0, next1, next2, next3
        level[0], level[1], level[2], level[3] = m0, m1, m2, m3
        for k in range(min(4, n_x - first)):
            mean = level[k] / n
            for j in range(n):
                cross[first + k, j] = source[k, j] - mean
            cross[first + k, n] = cross[first + k, 0]


@summing_kernel
def momentum_balance(
    old: Floats,
    new: Floats,
    flow: Floats,
    damping: Floats,
    flux: Floats,
    cross: Floats,
    velocity: Floats,
    face_area: Floats,
    drive: Floats,
    advection: float,
    exchange: float,
    carried: Floats,
    residual: Floats,
    total: Floats,
) -> None:
    """Momentum balance of all inner faces and its sum over φ.

    ``drive`` holds Δt/(ρΔx) times the difference of the θ-weighted pressure on each face; ``advection`` is
    Δt/Δx, ``exchange`` Δt/Δφ.
    """
    n = flow.shape[1]
    if n == 1:
        one_row.momentum_balance(old, new, flow, damping, flux, face_area, drive, advection, residual, total)
        return
    for f in range(1, flow.shape[0] - 1):
        for j in range(n):
            between = 0.25 * exchange * (cross[f - 1, j] + cross[f, j])
            carried[j] = between * (velocity[f, j] + velocity[f, j + 1])
        carried[n] = carried[0]
        push, sum_of_row = drive[f], 0.0
        for j in range(n):
            rest = old[f, j] - new[f, j] + damping[f, j] * flow[f, j] - push * face_area[f, j + 1]
            rest -= advection * (flux[f, j] - flux[f - 1, j]) + (carried[j + 1] - carried[j])
            residual[f, j] = rest
            sum_of_row += rest
        total[f] = sum_of_row


@summing_kernel
def solve_rows(residual: Floats, face_area: Floats, pull: Floats, matrix: Floats, outlet_known: bool) -> None:
    """δQ of all rows from their momentum balance, δQ at the inlet and the pressure's change, in place.

    ``pull`` is θΔt/(ρΔx) times the change of the pressure's difference on each face; ``matrix`` (3, faces) is
    the same for all rows. With ``outlet_known`` the last face holds δQ already.
    """
    if residual.shape[1] == 1:
        one_row.solve_rows(residual, face_area, pull, matrix, outlet_known)
        return
    faces, n = residual.shape
    lower, pivot, upper = matrix[0], matrix[1], matrix[2]
    last = faces - 1 if outlet_known else faces
    for f in range(1, last):
        factor = lower[f] if f == 1 else lower[f] / pivot[f - 1]
        if f > 1:
            pivot[f] -= factor * upper[f - 1]
        push = pull[f]
        for j in range(n):
            residual[f, j] -= push * face_area[f, j + 1] + factor * residual[f - 1, j]
    first = last - 1
    if not outlet_known:
        inverse = 1.0 / pivot[first]
        for j in range(n):
            residual[first, j] *= inverse
        first -= 1
    for f in range(first, 0, -1):
        inverse, above = 1.0 / pivot[f], upper[f]
        for j in range(n):
            residual[f, j] = (residual[f, j] - above * residual[f + 1, j]) * inverse


@summing_kernel
def take_change(change: Floats, flow: Floats, totals: Floats) -> tuple[float, float]:
    """Add δQ to the iterate; sums of squares of the change and of the new flow, and its sums over φ."""
    if flow.shape[1] == 1:
        return one_row.take_change(change, flow, totals)
    squares, size = 0.0, 0.0
    for f in range(flow.shape[0]):
        total = 0.0
        for j in range(flow.shape[1]):
            new = flow[f, j] + change[f, j]
            flow[f, j] = new
            squares += change[f, j] * change[f, j]
            size += new * new
            total += new
        totals[f] = total
    return squares, size


@summing_kernel
def copied(source: Floats, target: Floats) -> None:
    """Copy a 2-D array."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j] = source[i, j]
