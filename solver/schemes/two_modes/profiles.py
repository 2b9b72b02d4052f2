"""What a row's u and its section's D give: momentum flux, friction and exchange around (numba kernels)."""

import numpy as np

from cases.arrays import Floats
from solver.schemes.two_modes.layout import Modes
from solver.schemes.vectorisation import inlined_kernel, summing_kernel

SIXTH = 1.0 / 6.0  # times, since a division takes as long as all else of a row
SQUARES = 2.0  # exponent of a base whose powers need no logarithm


@inlined_kernel
def momentum_of(modes: Modes, u: float, d: float) -> float:
    """Return 2∫v²y dy, m²/s²."""
    return modes.uu * u * u + modes.ud * u * d + modes.dd * d * d


@inlined_kernel
def momentum_slopes(modes: Modes, u: float, d: float) -> tuple[float, float]:
    """Its derivatives by u, and by the velocity of a whole section, with which D changes too."""
    by_row = 2.0 * modes.uu * u + modes.ud * d
    follows = 1.0 if modes.momentum else 1.0 / modes.share
    return by_row, by_row + follows * (2.0 * modes.dd * d + modes.ud * u)


@summing_kernel
def fluxes(
    modes: Modes,
    flow: Floats,
    mean_area: Floats,
    axis: Floats,
    theta: float,
    flux: Floats,
    section_slope: Floats,
    row_slope: Floats,
) -> None:
    """A 2∫v²y dy at cell centres, and θ times the mean over φ of its derivatives by either face's Q.

    ``axis`` is D on faces (n_x + 1,), unused where D is the section's mean, here that of the cell. The
    derivatives are those of a whole section and of its rows.
    """
    n = flow.shape[1]
    for i in range(flux.shape[0]):
        d = 0.5 * (axis[i] + axis[i + 1])
        if not modes.momentum:
            d = 0.0
            for j in range(n):
                d += 0.5 * (flow[i, j] + flow[i + 1, j]) / (mean_area[i, j] * n * modes.share)
        of_section, of_row = 0.0, 0.0
        for j in range(n):
            u = 0.5 * (flow[i, j] + flow[i + 1, j]) / mean_area[i, j]
            flux[i, j] = mean_area[i, j] * momentum_of(modes, u, d)
            by_row, by_section = momentum_slopes(modes, u, d)
            of_row += by_row
            of_section += by_section
        row_slope[i] = 0.5 * theta * of_row / n
        section_slope[i] = 0.5 * theta * of_section / n


@summing_kernel
def viscous_terms(
    modes: Modes,
    velocity: Floats,
    face_area: Floats,
    axis: Floats,
    scale: float,
    dphi: float,
    around: Floats,
    damping: Floats,
    excess: Floats,
) -> None:
    """Δt times friction and exchange around: damping × Q + excess, on faces.

    Friction is −2ν(nD + 4B), exchange 2ν∫(1/r)∂²_φv dr at given r, of which D(1 − yⁿ) has −(D/n)Rⁿ∂²_φ(R⁻ⁿ)
    and B y²(1 − y⁴) has (A/2)∂²_φ(B/A) − (A³/6)∂²_φ(B/A³).

    Parameters
    ----------
    velocity, face_area : ndarray (n_x + 1, n_phi + 2)
        u and A with filled ghosts.
    axis : ndarray (n_x + 1,)
        D.
    scale : float
        Δt μ/ρ, m².
    around : ndarray (4, n_phi + 2)
        Scratch.
    damping, excess : ndarray (n_x + 1, n_phi)
        Results, – and m³/s.
    """
    n, power = damping.shape[1], 0.5 * modes.exponent
    second, friction = 1.0 / (dphi * dphi), -32.0 * scale
    base, first, third, of_one = around[0], around[1], around[2], around[3]
    for f in range(damping.shape[0]):
        d = axis[f]
        for j in range(n + 2):
            inverse = 1.0 / face_area[f, j]
            b = 4.0 * (velocity[f, j] - modes.share * d)
            base[j] = inverse
            first[j] = b * inverse
            third[j] = b * inverse * inverse * inverse
            of_one[j] = face_area[f, j]
        for j in range(n):
            damping[f, j] = friction * base[j + 1]
        if modes.exponent != SQUARES:
            for j in range(n + 2):
                base[j] = base[j] ** power
                of_one[j] = 1.0 / base[j]
        for j in range(n):
            a = face_area[f, j + 1]
            of_base = (base[j + 2] - 2.0 * base[j + 1] + base[j]) * of_one[j + 1]
            of_first = first[j + 2] - 2.0 * first[j + 1] + first[j]
            of_third = third[j + 2] - 2.0 * third[j + 1] + third[j]
            bend = 0.5 * a * of_first - SIXTH * a * a * a * of_third - d / modes.exponent * of_base
            excess[f, j] = 2.0 * scale * (second * bend - modes.wall_axis * d)


@summing_kernel
def exchange_share(damping: Floats, dphi: float, f: int) -> float:
    """Δt times half of the fastest rate at which exchange evens a section's rows out, –.

    (16/3)ν/Δφ² times the mean of 1/A, of which friction ``damping`` from :func:`viscous_terms` has −32ν.
    """
    total, n = 0.0, damping.shape[1]
    for j in range(n):
        total += damping[f, j]
    return float(-total / (6.0 * dphi * dphi * n))


@summing_kernel
def section_means(velocity: Floats, share: float, axis: Floats) -> None:
    """D of the mean closure on all faces: the mean of u over a; ``velocity`` (faces, n_phi + 2)."""
    n = velocity.shape[1] - 2
    for f in range(axis.size):
        total = 0.0
        for j in range(n):
            total += velocity[f, j + 1]
        axis[f] = total / (n * share)


@summing_kernel
def weighted_axis(theta: float, old: Floats, new: Floats, mean: Floats) -> None:
    """θ-weighted D."""
    for f in range(mean.size):
        mean[f] = (1.0 - theta) * old[f] + theta * new[f]


@inlined_kernel
def outgoing_wave(modes: Modes, u: float, d: float, wave: float) -> float:
    """Speed λ₊ of the wave that leaves at the outlet, m/s; ``wave`` is the square of that at rest."""
    slope = 2.0 * modes.uu * u + modes.ud * d
    return float(0.5 * slope + np.sqrt(0.25 * slope * slope + modes.dd * d * d - modes.uu * u * u + wave))
