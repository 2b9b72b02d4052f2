"""Velocity profiles on the faces: u, the closure's D, α and the viscous source S (numba kernels).

With s = u/D the closure γ = 2u/(D − u) gives α = 2/(1+s), ½γ+1 = 1/(1−s) and 1 + 2/γ = 1/s, all from one
division by s(1−s)(1+s).

The kernels index whole arrays, ``values[f, j]``: making a view of each row costs more than the work on it.
"""

from cases.arrays import Floats
from solver.schemes.layout import NO_ADMISSIBLE_PROFILE, OK, PRESSURE_INLET, REST_VELOCITY
from solver.schemes.vectorisation import kernel, summing_kernel

POISEUILLE = 2.0  # γ of a section at rest: the limit of slow equal rows


@kernel
def wrap(values: Floats, f: int, mirrored: bool) -> None:
    """Fill the two ghosts of a face's rows: periodic, or the mirror images of the first and the last row."""
    last = values.shape[1] - 1
    values[f, 0] = values[f, 1] if mirrored else values[f, last - 1]
    values[f, last] = values[f, last - 1] if mirrored else values[f, 1]


@summing_kernel
def _velocities(f: int, flow: Floats, area: Floats, inverse_area: Floats, velocity: Floats) -> float:
    """1/A and u = Q/A of one face; D = 2 mean_φ(u), summed in an order that vectorises."""
    total = 0.0
    n_phi = flow.shape[1]
    for j in range(n_phi):
        inverse_area[f, j] = 1.0 / area[f, j + 1]
        velocity[f, j] = flow[f, j] * inverse_area[f, j]
        total += velocity[f, j]
    return float(2.0 * total / n_phi)


@kernel
def _exponents(
    f: int, axis_velocity: float, velocity: Floats, inverse_share: Floats, alpha: Floats, friction: Floats
) -> bool:
    """D/u, α and ½γ+1 of one face; whether 0 < u/D < 1 in every row, so that γ is positive."""
    admissible = 0
    scale = 1.0 / axis_velocity
    n_phi = velocity.shape[1]
    for j in range(n_phi):
        s = velocity[f, j] * scale
        rest = (1.0 - s) * (1.0 + s)
        inverse = 1.0 / (s * rest)
        inverse_share[f, j + 1] = rest * inverse
        inverse_rest = s * inverse
        alpha[f, j] = (2.0 - 2.0 * s) * inverse_rest
        friction[f, j] = (1.0 + s) * inverse_rest
        admissible += (s > 0.0) & (s < 1.0)
    return bool(admissible == n_phi)


@kernel
def _at_rest(velocity: Floats, f: int) -> bool:
    """Whether every row of a face is slower than the rest velocity."""
    count = 0
    for j in range(velocity.shape[1]):
        count += abs(velocity[f, j]) < REST_VELOCITY
    return bool(count == velocity.shape[1])


@kernel
def _inadmissible_row(f: int, velocity: Floats, axis_velocity: float) -> int:
    """First row with u/D outside ]0, 1[."""
    for j in range(velocity.shape[1]):
        if not 0.0 < velocity[f, j] / axis_velocity < 1.0:
            return j
    return 0


@kernel
def _closure_source(
    f: int,
    area: Floats,
    inverse_area: Floats,
    inverse_share: Floats,
    scale: float,
    dphi: float,
    source: Floats,
) -> None:
    """Δt S of one face, h as in model.md with 1/γ differenced; ``source`` holds ½γ+1 before.

    h is 2(μ/ρ)(1 + 2/γ)/A times ½∂²A/A − ½(½γ+1)(∂A/A)² − ∂²(1/γ), derivatives by φ; 1/γ is half of D/u − 1.
    """
    second = 1.0 / (dphi * dphi)
    for j in range(source.shape[1]):
        a, share, friction = inverse_area[f, j], inverse_share[f, j + 1], source[f, j]
        difference = (area[f, j + 2] - area[f, j]) * a
        bend = (area[f, j + 2] + area[f, j] - 2.0 * area[f, j + 1]) * a
        share_bend = inverse_share[f, j + 2] + inverse_share[f, j] - 2.0 * share
        bracket = bend - share_bend - 0.25 * friction * difference * difference
        source[f, j] = scale * a * (second * share * bracket - 4.0 * friction)


@kernel
def _fixed_source(f: int, area: Floats, exponent: float, scale: float, alpha: Floats, source: Floats) -> None:
    """α and Δt S of one face for a given γ, friction only."""
    for j in range(source.shape[1]):
        alpha[f, j] = (exponent + 2.0) / (exponent + 1.0)
        source[f, j] = -2.0 * (exponent + 2.0) * scale / area[f, j + 1]


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
    flow : ndarray (n_x + 1, n_phi)
        Q, m³/s.
    area : ndarray (n_x + 1, n_phi + 2)
        A with filled periodic ghosts, m².
    scale : float
        Δt μ/ρ, m².
    dphi : float
        rad.
    mirrored : bool
        Whether the rows are one half of the ring.
    inverse_area, velocity : ndarray (n_x + 1, n_phi)
        Scratch: 1/A and u.
    inverse_share : ndarray (n_x + 1, n_phi + 2)
        Scratch: D/u.
    axis_velocity : ndarray (n_x + 1,)
        Scratch: D, or 0 where a face is at rest.
    alpha, source : ndarray (n_x + 1, n_phi)
        Results: α and Δt S.

    Returns
    -------
    status, f, j : int
        OK, or NO_ADMISSIBLE_PROFILE and the first face and row where γ would not be positive.
    """
    for f in range(flow.shape[0]):
        d = _velocities(f, flow, area, inverse_area, velocity)
        axis_velocity[f] = d
        if abs(d) > REST_VELOCITY and _exponents(f, d, velocity, inverse_share, alpha, source):
            wrap(inverse_share, f, mirrored)
        elif _at_rest(velocity, f):
            axis_velocity[f] = 0.0
        else:
            return NO_ADMISSIBLE_PROFILE, f, _inadmissible_row(f, velocity, d)
    for f in range(flow.shape[0]):
        if axis_velocity[f] == 0.0:
            _fixed_source(f, area, POISEUILLE, scale, alpha, source)
        else:
            _closure_source(f, area, inverse_area, inverse_share, scale, dphi, source)
    return OK, 0, 0
