"""Momentum on the faces between two cells (numba kernels)."""

from cases.arrays import Floats
from solver.schemes.vectorisation import kernel


@kernel
def momentum_flux(flow: Floats, area: Floats, alpha: Floats, flux: Floats) -> None:
    """αQ²/A at cell centres (n_x, n_phi) from Q and α of the two faces (n_x + 1, n_phi)."""
    n, q, a = flux.shape[1], flow.flat, alpha.flat
    section, result = area.flat, flux.flat
    for k in range(flux.size):
        both = q[k] + q[k + n]
        result[k] = 0.125 * (a[k] + a[k + n]) * both * both / section[k]


@kernel
def predict(
    theta: float,
    carry: float,
    pull: float,
    flow: Floats,
    area: Floats,
    pressure: Floats,
    flux: Floats,
    damping: Floats,
    explicit_flow: Floats,
    conductance: Floats,
) -> None:
    """Flow G that inner faces would have at the iterate's pressure, and their conductance κ.

    Parameters
    ----------
    theta, carry, pull : float
        θ, Δt/Δx (s/m) and Δt/(ρΔx) (m² s/kg).
    flow : ndarray (n_x + 1, n_phi)
        Q of the old state, m³/s.
    area, pressure, flux : ndarray (n_x, n_phi)
        Means of A (m²) and P (Pa), and αQ²/A (m⁴/s²).
    damping : ndarray (n_x + 1, n_phi)
        Δt S.
    explicit_flow, conductance : ndarray (n_x + 1, n_phi)
        Results: G (m³/s) and κ (m³/(s Pa)).
    """
    n = area.shape[1]
    A, P, F = area.flat, pressure.flat, flux.flat
    Q, S, G, kappa = flow.flat, damping.flat, explicit_flow.flat, conductance.flat
    for k in range(n, area.size):
        drive = 0.5 * pull * (A[k - n] + A[k])
        inverse = 1.0 / (1.0 - theta * S[k])
        rest = Q[k] * (1.0 + (1.0 - theta) * S[k])
        rest -= carry * (F[k] - F[k - n])
        G[k] = (rest - drive * (P[k] - P[k - n])) * inverse
        kappa[k] = theta * drive * inverse
