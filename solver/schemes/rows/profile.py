"""Velocity profiles on the faces: u, the closure's D, α and the viscous source S (numba kernels).

With s = u/D the closure γ = 2u/(D − u) gives α = 2/(1+s), ½γ+1 = 1/(1−s) and 1 + 2/γ = 1/s, all from one
division by s(1−s)(1+s).

What needs no neighbour runs through all faces at once, and the rest indexes whole arrays, ``values[f, j]``: a
loop over the rows of one face, and a view of them, cost as much as the work on them.
"""

from cases.arrays import Floats
from solver.schemes.layout import NO_ADMISSIBLE_PROFILE, OK, PRESSURE_INLET, REST_VELOCITY
from solver.schemes.vectorisation import kernel, summing_kernel

POISEUILLE = 2.0  # γ of a section at rest: the limit of slow equal rows


@kernel
def _velocities(flow: Floats, area: Floats, inverse_area: Floats, velocity: Floats) -> None:
    """1/A and u = Q/A of all faces."""
    Q, A, inverse, u = flow.flat, area.flat, inverse_area.flat, velocity.flat
    for k in range(flow.size):
        reciprocal = 1.0 / A[k]
        inverse[k] = reciprocal
        u[k] = Q[k] * reciprocal


@summing_kernel
def _axis_velocity(f: int, velocity: Floats) -> float:
    """D = 2 mean_φ(u) of one face, summed in an order that vectorises."""
    total = 0.0
    n_phi = velocity.shape[1]
    for j in range(n_phi):
        total += velocity[f, j]
    return float(2.0 * total / n_phi)


@kernel
def _shares(f: int, axis_velocity: float, velocity: Floats, share: Floats) -> None:
    """u/D of one face."""
    scale = 1.0 / axis_velocity
    for j in range(velocity.shape[1]):
        share[f, j] = velocity[f, j] * scale


@kernel
def _exponents(share: Floats, alpha: Floats, friction: Floats) -> bool:
    """α and ½γ+1 of all faces, and D/u for u/D; whether 0 < u/D < 1 everywhere, so that γ is positive."""
    admissible, U, a, half = 0, share.flat, alpha.flat, friction.flat
    for k in range(share.size):
        s = U[k]
        rest = (1.0 - s) * (1.0 + s)
        inverse = 1.0 / (s * rest)
        U[k] = rest * inverse
        inverse_rest = s * inverse
        a[k] = (2.0 - 2.0 * s) * inverse_rest
        half[k] = (1.0 + s) * inverse_rest
        admissible += bool((s > 0.0) & (s < 1.0))
    return bool(admissible == share.size)


@kernel
def _at_rest(velocity: Floats, f: int) -> bool:
    """Whether every row of a face is slower than the rest velocity."""
    count = 0
    for j in range(velocity.shape[1]):
        count += abs(velocity[f, j]) < REST_VELOCITY
    return bool(count == velocity.shape[1])


@kernel
def _inadmissible_row(f: int, velocity: Floats, axis_velocity: float) -> int:
    """First row with u/D, rounded as in :func:`_shares`, outside ]0, 1[, or -1."""
    scale = 1.0 / axis_velocity
    for j in range(velocity.shape[1]):
        if not 0.0 < velocity[f, j] * scale < 1.0:
            return j
    return -1


@kernel
def _face_without_profile(velocity: Floats, axis_velocity: Floats) -> tuple[int, int]:
    """First face and row where γ would not be positive, or -1; D becomes 0 where a face is at rest."""
    for f in range(velocity.shape[0]):
        row = _inadmissible_row(f, velocity, axis_velocity[f])
        if row < 0 and abs(axis_velocity[f]) > REST_VELOCITY:
            continue
        if not _at_rest(velocity, f):
            return f, max(row, 0)
        axis_velocity[f] = 0.0
    return -1, 0


@kernel
def _row_source(
    f: int,
    before: int,
    j: int,
    after: int,
    area: Floats,
    inverse_area: Floats,
    inverse_share: Floats,
    scale: float,
    second: float,
    source: Floats,
) -> None:
    """Δt S of one row, h as in model.md with 1/γ differenced; ``source`` holds ½γ+1 before.

    h is 2(μ/ρ)(1 + 2/γ)/A times ½∂²A/A − ½(½γ+1)(∂A/A)² − ∂²(1/γ), derivatives by φ; 1/γ is half of D/u − 1.
    """
    a, share, friction = inverse_area[f, j], inverse_share[f, j], source[f, j]
    difference = (area[f, after] - area[f, before]) * a
    bend = (area[f, after] + area[f, before] - 2.0 * area[f, j]) * a
    share_bend = inverse_share[f, after] + inverse_share[f, before] - 2.0 * share
    bracket = bend - share_bend - 0.25 * friction * difference * difference
    source[f, j] = scale * a * (second * share * bracket - 4.0 * friction)


@kernel
def _sources(
    area: Floats,
    inverse_area: Floats,
    inverse_share: Floats,
    scale: float,
    dphi: float,
    mirrored: bool,
    source: Floats,
) -> None:
    """Δt S of all faces: periodic, or beyond the first and the last row their mirror images."""
    second, last = 1.0 / (dphi * dphi), source.shape[1] - 1
    before, after = (0, last) if mirrored else (last, 0)
    for f in range(source.shape[0]):
        for j in range(1, last):
            _row_source(f, j - 1, j, j + 1, area, inverse_area, inverse_share, scale, second, source)
        _row_source(f, before, 0, 1, area, inverse_area, inverse_share, scale, second, source)
        _row_source(f, last - 1, last, after, area, inverse_area, inverse_share, scale, second, source)


@kernel
def _fixed_source(f: int, area: Floats, exponent: float, scale: float, alpha: Floats, source: Floats) -> None:
    """α and Δt S of one face for a given γ, friction only."""
    for j in range(source.shape[1]):
        alpha[f, j] = (exponent + 2.0) / (exponent + 1.0)
        source[f, j] = -2.0 * (exponent + 2.0) * scale / area[f, j]


@kernel
def fixed_sources(
    mean_area: Floats,
    end_area: Floats,
    inlet_kind: int,
    exponent: float,
    scale: float,
    alpha: Floats,
    source: Floats,
) -> None:
    """α and Δt S of all faces for a given γ: the 1D model.

    Areas as those of :func:`solver.schemes.rows.ends.face_areas`, the others as :func:`closure_sources`.
    """
    (n_x, n), A, S, a = mean_area.shape, mean_area.flat, source.flat, alpha.flat
    friction = -2.0 * (exponent + 2.0) * scale
    for k in range(alpha.size):
        a[k] = (exponent + 2.0) / (exponent + 1.0)
    for k in range(n, mean_area.size):
        S[k] = friction / (0.5 * (A[k - n] + A[k]))
    for j in range(n):
        inlet = 1.5 * mean_area[0, j] - 0.5 * mean_area[1, j]
        if inlet_kind == PRESSURE_INLET:
            inlet = end_area[0, j]
        source[0, j] = friction / inlet
        source[n_x, j] = friction / end_area[1, j]


@kernel
def closure_sources(
    flow: Floats,
    area: Floats,
    scale: float,
    dphi: float,
    mirrored: bool,
    inverse_area: Floats,
    velocity: Floats,
    inverse_share: Floats,
    axis_velocity: Floats,
    alpha: Floats,
    source: Floats,
) -> tuple[int, int, int]:
    """α and Δt S of all faces by the continuity closure.

    Parameters
    ----------
    flow, area : ndarray (n_x + 1, n_phi)
        Q, m³/s, and A, m².
    scale : float
        Δt μ/ρ, m².
    dphi : float
        rad.
    mirrored : bool
        Whether the rows are one half of the ring.
    inverse_area, velocity, inverse_share : ndarray (n_x + 1, n_phi)
        Scratch: 1/A, u, and u/D, then D/u.
    axis_velocity : ndarray (n_x + 1,)
        Scratch: D, or 0 where a face is at rest.
    alpha, source : ndarray (n_x + 1, n_phi)
        Results: α and Δt S.

    Returns
    -------
    status, f, j : int
        OK, or NO_ADMISSIBLE_PROFILE and the first face and row where γ would not be positive.
    """
    _velocities(flow, area, inverse_area, velocity)
    slow = 0
    for f in range(flow.shape[0]):
        d = _axis_velocity(f, velocity)
        axis_velocity[f] = d
        slow += abs(d) <= REST_VELOCITY
        _shares(f, d, velocity, inverse_share)
    everywhere = _exponents(inverse_share, alpha, source) and slow == 0
    if not everywhere:
        f, row = _face_without_profile(velocity, axis_velocity)
        if f >= 0:
            return NO_ADMISSIBLE_PROFILE, f, row
    _sources(area, inverse_area, inverse_share, scale, dphi, mirrored, source)
    if not everywhere:
        for f in range(flow.shape[0]):
            if axis_velocity[f] == 0.0:
                _fixed_source(f, area, POISEUILLE, scale, alpha, source)
    return OK, 0, 0
