"""What crosses between rows: the azimuthal flux W, and estimates of v_φ and v_r from it.

W = 2∫₀^R v_φ dr follows from the state: ∂_φW = −∂_tA − ∂_xQ in each row, with ∂_tA = (dA/dP) ∂_tP and
∂_tP from the section's own balance, and with zero mean (no swirl). The reduced model does not say how v_φ
varies along a ray: it is given the shape of v_x, 1 − y^γ. Then mass alone gives v_r.
"""

import numpy as np

from cases.arrays import Floats
from solver.wall.sections import SectionWall


def azimuthal_flux(wall: SectionWall, dx: float, dphi: float, pressure: Floats, flow: Floats) -> Floats:
    """W at cell centres, m²/s.

    Parameters
    ----------
    wall : SectionWall
    dx, dphi : float
        m, rad.
    pressure : ndarray (..., n_x)
        Section pressures, Pa.
    flow : ndarray (..., n_x + 1, n_phi)
        Q on faces, m³/s.

    Returns
    -------
    ndarray (..., n_x, n_phi)
    """
    slope = wall.area_and_slope(pressure)[1]
    divergence = np.diff(flow, axis=-2) / dx
    share = slope / slope.sum(axis=-1, keepdims=True)
    rise = share * divergence.sum(axis=-1, keepdims=True) - divergence  # ∂_φW
    after = np.cumsum(rise, axis=-1) * dphi
    before = np.roll(after, 1, axis=-1)
    before[..., 0] = 0.0
    centre = 0.5 * (before + after)
    return np.asarray(centre - after.mean(axis=-1, keepdims=True))


def azimuthal_velocity(radius: Floats, exponent: Floats, flux: Floats, y: Floats) -> Floats:
    """v_φ = W/(2R) (γ+1)/γ (1 − y^γ), m/s, (..., n_y).

    Parameters
    ----------
    radius, exponent, flux : ndarray (...)
        R, m, γ and W, m²/s.
    y : ndarray (n_y,)
        r/R.
    """
    gamma = exponent[..., None]
    return np.asarray((0.5 * flux / radius)[..., None] * (gamma + 1) / gamma * (1 - y**gamma))


def radial_velocity(
    radius: Floats,
    velocity: Floats,
    exponent: Floats,
    flux: Floats | None,
    spacing: tuple[float, float],
    y: Floats,
) -> Floats:
    """v_r from mass: −(1/r) [∂_x∫₀^r v_x r dr + ∂_φ∫₀^r v_φ dr], m/s.

    Where r = R this is −(∂_xQ + ∂_φW)/(2R) = ∂_tR. Derivatives of γ are left out.

    Parameters
    ----------
    radius, velocity, exponent : ndarray (..., n_x, n_phi)
        R, m, u, m/s, and γ.
    flux : ndarray (..., n_x, n_phi) or None
        W, m²/s; None where rows keep their own mass.
    spacing : tuple of float
        Δx, m, and Δφ, rad.
    y : ndarray (n_y,)
        r/R.

    Returns
    -------
    ndarray (..., n_x, n_phi, n_y)
    """
    dx, dphi = spacing
    gamma, size = exponent[..., None], radius[..., None]
    flow = velocity * radius**2
    flow_along = np.gradient(flow, dx, axis=-2)[..., None]
    taper = np.gradient(radius, dx, axis=-2)[..., None] / size
    power = y**gamma
    inside = (0.5 + 1 / gamma - power / gamma) * y  # ∫₀^y s y dy / y, s = (1 + 2/γ)(1 − y^γ)
    across = flow_along * inside - flow[..., None] * (1 + 2 / gamma) * (1 - power) * y * taper
    if flux is not None:
        around = (gamma + 1) / gamma * (1 - power / (gamma + 1))
        slant = _around(radius, dphi)[..., None] / size
        form = (gamma + 1) / gamma * (1 - power)
        across = across + 0.5 * (_around(flux, dphi)[..., None] * around - flux[..., None] * form * slant)
    return np.asarray(-across / size)


def _around(values: Floats, dphi: float) -> Floats:
    """Central, periodic ∂_φ."""
    return np.asarray((np.roll(values, -1, axis=-1) - np.roll(values, 1, axis=-1)) / (2 * dphi))
