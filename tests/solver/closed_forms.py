"""Closed forms of the model's equations, which its kernels are held against."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from cases.arrays import Floats
from solver.errors import ModelError
from solver.marching.row_fields import offsets
from solver.model.boundary import ResistanceOutlet
from solver.model.parameters import Model
from solver.model.profiles import AVERAGE_EXPONENT, axis_ratio


def momentum_correction(exponent: ArrayLike) -> Floats:
    """Momentum-correction coefficient α(γ) = 2∫₀¹ y s² dy = (γ+2)/(γ+1)."""
    gamma = np.asarray(exponent, dtype=float)
    return 1.0 + 1.0 / (gamma + 1.0)


def axis_velocity(mean_velocity: Floats) -> Floats:
    """Velocity on the axis by the *average* closure, D = (γ_avg+2)/γ_avg · mean_φ(u).

    Parameters
    ----------
    mean_velocity : ndarray (..., n_phi)
        Mean velocity u of each row, m/s.

    Returns
    -------
    ndarray (..., 1)
        D, m/s.
    """
    average = np.mean(mean_velocity, axis=-1, keepdims=True)
    return np.asarray(axis_ratio(AVERAGE_EXPONENT) * average)


def continuity_exponent(mean_velocity: Floats, rest: float) -> Floats:
    """Exponent that makes the velocity continuous on the axis, γ = 2u/(D − u) (2.2.35).

    Parameters
    ----------
    mean_velocity : ndarray (..., n_phi)
        Mean velocity u of each row, m/s.
    rest : float
        A section whose rows are all slower than this, m/s, is at rest and has γ = 2.

    Returns
    -------
    ndarray (..., n_phi)
        γ; NaN where none is admissible.
    """
    u = np.asarray(mean_velocity, dtype=float)
    axis = np.broadcast_to(axis_velocity(u), u.shape)
    at_rest = np.max(np.abs(u), axis=-1, keepdims=True) < rest
    admissible = (u * axis > 0) & (np.abs(u) < np.abs(axis))
    exponent = np.full(u.shape, np.nan)
    np.divide(2 * u, axis - u, out=exponent, where=admissible)
    return np.where(at_rest, AVERAGE_EXPONENT, exponent)


def rest_area(stiffness: Floats, inlet_pressure: float, radius: float, reference_pressure: float) -> Floats:
    """Steady A(x, φ) of a pressure inlet and a non-reflecting outlet: Q = 0, P constant (2.2.63), m².

    Parameters
    ----------
    stiffness : ndarray (n_x, n_phi)
        β, Pa m; may jump.
    inlet_pressure : float
        Pa.
    radius, reference_pressure : float
        R₀, m, and P₀, Pa.
    """
    return np.asarray((radius + (inlet_pressure - reference_pressure) * radius**2 / stiffness) ** 2)


def momentum_balance(
    area: Floats | float, flow: float, inlet_area: float, stiffness: float, radius: float, density: float
) -> Floats:
    """Left side of (2.2.68) for γ = 2: β/(5ρA₀)(A^{5/2} − A_in^{5/2}) − (4/3)Q² ln(A/A_in), m⁶/s²·m⁻¹ × m."""
    elastic = stiffness / (5 * density * radius**2) * (np.power(area, 2.5) - inlet_area**2.5)
    return np.asarray(elastic - 4 / 3 * flow**2 * np.log(np.asarray(area) / inlet_area))


def uniform_flow(model: Model, velocity: float) -> float:
    """Steady Q = uR² of a velocity inlet and a per-row resistance outlet, uniform β, γ = 2 (2.2.69), m³/s.

    The physiological root: the one next to A₀ v.

    Raises
    ------
    ModelError
        For another outlet, a nonlinear wall or a wall that varies.
    """
    outlet = model.outlet
    if not (isinstance(outlet, ResistanceOutlet) and outlet.flow == "row") or model.wall_table is not None:
        raise ModelError("the closed form needs a per-row resistance outlet and a linear wall")
    beta = float(model.stiffness.flat[0])
    if not np.allclose(model.stiffness, beta, rtol=1e-12):
        raise ModelError("the closed form needs a uniform wall")
    offset = float(offsets(model, [0.0])[0])

    def defect(flow: float) -> float:
        load = offset + outlet.resistance * flow - model.reference_pressure
        outlet_area = (model.radius + load * model.radius**2 / beta) ** 2
        balance = momentum_balance(outlet_area, flow, flow / velocity, beta, model.radius, model.density)
        return float(balance + 8 * model.viscosity / model.density * flow * model.grid.length)

    guess = velocity * model.radius**2
    return float(brentq(defect, 0.2 * guess, 5 * guess, xtol=1e-30, rtol=1e-14))


def uniform_area(model: Model, velocity: float, x: Floats) -> Floats:
    """Steady A(x) that belongs to :func:`uniform_flow`, (2.2.68), m²."""
    flow = uniform_flow(model, velocity)
    inlet, beta = flow / velocity, float(model.stiffness.flat[0])

    def area_at(position: float) -> float:
        friction = 8 * model.viscosity / model.density * flow * position
        return float(
            brentq(
                lambda area: float(
                    momentum_balance(area, flow, inlet, beta, model.radius, model.density) + friction
                ),
                0.5 * inlet,
                2 * inlet,
                xtol=1e-30,
                rtol=1e-14,
            )
        )

    return np.array([area_at(float(position)) for position in np.atleast_1d(x)])
