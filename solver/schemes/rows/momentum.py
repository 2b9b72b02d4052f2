"""Momentum on the faces between two cells (numba kernels)."""

from cases.arrays import Floats
from solver.schemes.vectorisation import kernel


@kernel
def momentum_flux(flow: Floats, area: Floats, alpha: Floats, flux: Floats) -> None:
    """αQ²/A at cell centres (n_x, n_phi) from Q and α of the two faces (n_x + 1, n_phi)."""
    for i in range(flux.shape[0]):
        for j in range(flux.shape[1]):
            both = flow[i, j] + flow[i + 1, j]
            flux[i, j] = 0.125 * (alpha[i, j] + alpha[i + 1, j]) * both * both / area[i, j]


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
    for f in range(1, area.shape[0]):
        for j in range(area.shape[1]):
            drive = 0.5 * pull * (area[f - 1, j] + area[f, j])
            inverse = 1.0 / (1.0 - theta * damping[f, j])
            rest = flow[f, j] * (1.0 + (1.0 - theta) * damping[f, j])
            rest -= carry * (flux[f, j] - flux[f - 1, j])
            explicit_flow[f, j] = (rest - drive * (pressure[f, j] - pressure[f - 1, j])) * inverse
            conductance[f, j] = theta * drive * inverse
