"""Manufactured solutions of (2.2.33–2.2.35): analytic A, Q and u, and the force that makes them solutions.

Each satisfies the mass balance (2.2.33) as it stands and, with γ = 2u/(D − u), the continuity condition
(2.2.35). In the momentum balance (2.2.34) a force per unit of ½dφ dx remains,

    f = ∂_t Q + ∂_x(αQ²/A) + (A/ρ) ∂_x P − (h − 2(γ+2)(μ/ρ)/A) Q.

At both ends P does not depend on φ, so that it may be prescribed there, and at x = 0 neither does u.
Derivatives are complex steps, exact to round-off.
"""

from dataclasses import dataclass

import numpy as np

LENGTH, RADIUS, DENSITY = 15e-3, 2.5e-3, 1060.0
HEALTHY = 400.0  # β, Pa m
REST = RADIUS**2
K = 2 * np.pi / LENGTH
WAVE_SPEED = np.sqrt(HEALTHY / (2 * DENSITY * RADIUS))
AROUND = 2 * np.pi * (np.arange(64) + 0.5) / 64  # where D is averaged: exact to round-off
TINY = 1e-30


@dataclass(frozen=True)
class StandingWave:
    """A wave as fast as the pulse wave: A = A₀[1.2 + ε sin(kx) cos(ωt) (1 + b cos φ)], ω = kc.

    ``velocity`` is Q₀/(1.2A₀) at t = 0, m/s; β = β_H [1 + rise e^{−(x−L/2)²/w²} (1 + b cos φ)].
    """

    asymmetry: float
    rise: float
    viscosity: float
    amplitude: float = 0.02
    velocity: float = 0.4

    def area(self, t, x, phi):
        wave = self.amplitude * np.sin(K * x) * np.cos(K * WAVE_SPEED * t)
        return REST * (1.2 + wave * (1 + self.asymmetry * np.cos(phi)))

    def flow(self, t, x, phi):
        mean = 1.2 * self.velocity * (1 + 0.3 * np.sin(K * WAVE_SPEED * t))
        wave = self.amplitude * WAVE_SPEED * np.sin(K * WAVE_SPEED * t) * (1 - np.cos(K * x))
        return REST * (mean + wave * (1 + self.asymmetry * np.cos(phi)))

    def stiffness(self, x, phi):
        bump = np.exp(-(((x - 0.5 * LENGTH) / (0.12 * LENGTH)) ** 2))
        return HEALTHY * (1 + self.rise * bump * (1 + self.asymmetry * np.cos(phi)))


@dataclass(frozen=True)
class HeartBeat:
    """A flow as slow as the heart's: P = P(t) everywhere, R = R₀ + Pc.

    The wall's compliance is c = c_H [1 − s sin²(πx/L) (1 + b cos φ)]; Q follows from what the wall takes up.
    """

    asymmetry: float
    share: float
    viscosity: float = 0.003

    def load(self, t):
        return 1.2e4 * (1 + 0.2 * np.sin(2 * np.pi * t / 0.2))

    def velocity(self, t):
        return 0.1 * (1 + 0.5 * np.sin(2 * np.pi * t / 0.2 + 1))

    def compliance(self, x, phi):
        return REST / HEALTHY * (1 - self.share * np.sin(np.pi * x / LENGTH) ** 2 * self._around(phi))

    def stiffness(self, x, phi):
        return REST / self.compliance(x, phi)

    def area(self, t, x, phi):
        return (RADIUS + self.load(t) * self.compliance(x, phi)) ** 2

    def flow(self, t, x, phi):
        """vA at the inlet, less ∫₀ˣ ∂_tA dx with ∂_tA = 2(R₀c + Pc²) dP/dt."""
        rate = 1.2e4 * 0.2 * 2 * np.pi / 0.2 * np.cos(2 * np.pi * t / 0.2)
        healthy, s = REST / HEALTHY, self.share * self._around(phi)
        sine = 0.5 * x - np.sin(K * x) / (2 * K)  # ∫ sin²(πx/L)
        square = 0.375 * x - np.sin(K * x) / (2 * K) + np.sin(2 * K * x) / (16 * K)  # ∫ sin⁴(πx/L)
        once = healthy * (x - s * sine)
        twice = healthy**2 * (x - 2 * s * sine + s**2 * square)
        inflow = self.velocity(t) * self.area(t, 0.0, 0.0)
        return inflow - 2 * rate * (RADIUS * once + self.load(t) * twice)

    def _around(self, phi):
        return 1 + self.asymmetry * np.cos(phi)


def velocity(solution, t, x, phi):
    return solution.flow(t, x, phi) / solution.area(t, x, phi)


def axis_velocity(solution, t, x):
    """D = 2 mean_φ(u)."""
    return sum(2 * velocity(solution, t, x, phi) / AROUND.size for phi in AROUND)


def exponent(solution, t, x, phi):
    u = velocity(solution, t, x, phi)
    return 2 * u / (axis_velocity(solution, t, x) - u)


def pressure(solution, t, x, phi):
    return solution.stiffness(x, phi) * (np.sqrt(solution.area(t, x, phi)) - RADIUS) / REST


def stiffness_slope(solution, x, phi):
    return solution.stiffness(x + 1j * TINY, phi).imag / TINY


def momentum_flux(solution, t, x, phi):
    """αQ²/A with α = (γ+2)/(γ+1) = 2D/(D + u)."""
    u, d = velocity(solution, t, x, phi), axis_velocity(solution, t, x)
    return 2 * d / (d + u) * u * solution.flow(t, x, phi)


def curvature(function, phi, step=1e-3):
    """∂²_φ by differences of fourth order of the complex step's ∂_φ."""

    def slope(at):
        return function(at + 1j * TINY).imag / TINY

    near, far = (slope(phi + d) - slope(phi - d) for d in (step, 2 * step))
    return (8 * near - far) / (12 * step)


def damping(solution, t, x, phi):
    """h − 2(γ+2)(μ/ρ)/A; −(2/γ³)(∂_φγ)² + ∂²_φγ/γ² is −∂²_φ(1/γ), and 1/γ = D/(2u) − ½."""
    d, nu = axis_velocity(solution, t, x), solution.viscosity / DENSITY
    area, u = solution.area(t, x, phi), velocity(solution, t, x, phi)
    gamma = 2 * u / (d - u)
    slope = solution.area(t, x, phi + 1j * TINY).imag / TINY
    bend = curvature(lambda at: solution.area(t, x, at), phi)
    inverse_bend = curvature(lambda at: 0.5 * d / velocity(solution, t, x, at), phi)
    bracket = -(gamma + 2) / 4 * (slope / area) ** 2 + 0.5 * bend / area - inverse_bend
    return 2 * nu * (gamma + 2) / (gamma * area) * bracket - 2 * (gamma + 2) * nu / area


def force(solution, t, x, phi):
    """Return f."""
    unsteady = solution.flow(t + 1j * TINY, x, phi).imag / TINY
    advection = momentum_flux(solution, t, x + 1j * TINY, phi).imag / TINY
    drive = solution.area(t, x, phi) / DENSITY * pressure(solution, t, x + 1j * TINY, phi).imag / TINY
    return unsteady + advection + drive - damping(solution, t, x, phi) * solution.flow(t, x, phi)
