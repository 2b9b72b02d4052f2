"""What the Godunov scheme runs: parameters, signals over time and states, SI."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.model.waveform import load_curve
from solver.schemes.godunov import layout
from solver.wall.smooth_patch import SmoothWall

Signal = Callable[[Floats], Floats]

LIMITERS = {
    "upwind": layout.UPWIND,
    "lax_wendroff": layout.LAX_WENDROFF,
    "van_leer": layout.VAN_LEER,
    "superbee": layout.SUPERBEE,
    "minmod": layout.MINMOD,
    "monotonized_central": layout.MONOTONIZED_CENTRAL,
}
CLOSURES = {"average": layout.AVERAGE, "maximum": layout.MAXIMUM, "least_squares": layout.LEAST_SQUARES}
INLETS = {
    "velocity": layout.VELOCITY_INLET,
    "pressure": layout.PRESSURE_INLET,
    "flow": layout.FLOW_INLET,
}
OUTLETS = {
    "row": layout.ROW_RESISTANCE,
    "section": layout.SECTION_RESISTANCE,
    "non_reflecting": layout.NON_REFLECTING,
    "windkessel": layout.WINDKESSEL,
}
COEFFICIENTS = ("corrected", "printed")


def held(value: float) -> Signal:
    """Signal that keeps one value."""
    return lambda times: np.full(times.shape, value)


def load(begin: float, end: float, first: float, last: float) -> Signal:
    """Load curve (2.3.1): ``first`` until ``begin`` (s), ``last`` from ``end`` on, a cosine between."""
    return lambda times: load_curve(times, begin, end, first, last)


@dataclass(frozen=True)
class Setup:
    """Everything that determines a run, SI.

    Attributes
    ----------
    grid : Grid
        Cells on (x, φ).
    time_step : float
        Δt, s.
    radius, density, viscosity, reference_pressure : float
        R₀, m; ρ, kg/m³; μ, Pa s; P₀, Pa.
    wall : SmoothWall
        The wall, or the one that ``wall_load`` ends on.
    inlet_kind : str
        "velocity", "pressure" or "flow".
    inlet : Signal
        Mean velocity (m/s), pressure (Pa) or the section's flow rate (m³/s) at the inlet over times (s).
    outlet_kind : str
        "row" (P = P_res + R_res Q of each row), "section" (one pressure, the section's ½∮Q dφ; with no
        resistance a pressure outlet), "non_reflecting" or "windkessel".
    resistance : float
        R_res, or the Windkessel's R₁, Pa s/m³.
    offset : Signal
        P_res, Pa.
    distal_resistance, capacitance, venous_pressure : float
        The Windkessel's R₂, Pa s/m³, C, m³/Pa, and P_v, Pa.
    wall_before : SmoothWall or None
        Wall at ``wall_load`` 0, for a wall that changes: β = before + load·(wall − before).
    wall_load : Signal
        Share of ``wall`` over time.
    limiter, closure : str
        A name of :data:`LIMITERS` and one of :data:`CLOSURES`.
    fixed_exponent : float
        γ of the 1D model (n_phi = 1).
    viscous_exchange, exponent_gradient : str
        Coefficients of h and of ∂_xγ: "corrected", or as "printed" in the thesis.
    """

    grid: Grid
    time_step: float
    radius: float
    density: float
    viscosity: float
    wall: SmoothWall
    inlet_kind: str
    inlet: Signal
    outlet_kind: str
    resistance: float = 0.0
    offset: Signal = field(default_factory=lambda: held(0.0))
    distal_resistance: float = 1.0
    capacitance: float = 1.0
    venous_pressure: float = 0.0
    reference_pressure: float = 0.0
    wall_before: SmoothWall | None = None
    wall_load: Signal = field(default_factory=lambda: held(1.0))
    limiter: str = "van_leer"
    closure: str = "average"
    fixed_exponent: float = layout.PARABOLIC
    viscous_exchange: str = "corrected"
    exponent_gradient: str = "corrected"

    def __post_init__(self) -> None:
        for name, allowed in (
            ("inlet_kind", INLETS),
            ("outlet_kind", OUTLETS),
            ("limiter", LIMITERS),
            ("closure", CLOSURES),
            ("viscous_exchange", COEFFICIENTS),
            ("exponent_gradient", COEFFICIENTS),
        ):
            if getattr(self, name) not in allowed:
                raise ModelError(f"{name} = {getattr(self, name)!r}; allowed: {', '.join(allowed)}")
        for name in ("time_step", "radius", "density", "fixed_exponent", "distal_resistance", "capacitance"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ModelError(f"{name} = {getattr(self, name)}; allowed: positive")
        shape = (self.grid.n_x + 2, self.grid.n_phi)
        for wall in (self.wall, self.wall_before or self.wall):
            if wall.stiffness.shape != shape or wall.slope.shape != shape:
                raise ModelError(f"the wall has shape {wall.stiffness.shape}; the grid needs {shape}")

    @property
    def parameters(self) -> layout.Parameters:
        """Scalars for the kernels."""
        return layout.Parameters(
            columns=self.grid.n_x + 2,
            n_phi=self.grid.n_phi,
            ghosts=int(self.grid.n_phi > 1),
            dt=self.time_step,
            dx=self.grid.dx,
            dphi=self.grid.dphi,
            radius=self.radius,
            density=self.density,
            kinematic_viscosity=self.viscosity / self.density,
            reference_pressure=self.reference_pressure,
            resistance=self.resistance,
            distal_resistance=self.distal_resistance,
            capacitance=self.capacitance,
            venous_pressure=self.venous_pressure,
            inlet=INLETS[self.inlet_kind],
            outlet=OUTLETS[self.outlet_kind],
            limiter=LIMITERS[self.limiter],
            closure=CLOSURES[self.closure] if self.grid.n_phi > 1 else layout.FIXED,
            printed_exchange=self.viscous_exchange == "printed",
            printed_gradient=self.exponent_gradient == "printed",
            has_inlet=True,
            has_outlet=True,
        )


@dataclass(frozen=True)
class State:
    """Unknowns at one time on the columns inlet, cells 1 … n_x, outlet.

    Attributes
    ----------
    time : float
        s.
    area, flow, exponent : ndarray (n_x + 2, n_phi)
        A = R², m²; Q = uR², m³/s; γ.
    reservoir : float
        P_c of a Windkessel, Pa.
    """

    time: float
    area: Floats
    flow: Floats
    exponent: Floats
    reservoir: float = 0.0


def reference_state(setup: Setup) -> State:
    """Return A = A₀ and Q = 0 at t = 0."""
    shape = (setup.grid.n_x + 2, setup.grid.n_phi)
    exponent = setup.fixed_exponent if setup.grid.n_phi == 1 else layout.PARABOLIC
    return State(0.0, np.full(shape, setup.radius**2), np.zeros(shape), np.full(shape, exponent))


def repeated(state: State, n_phi: int) -> State:
    """Return the state of one row on ``n_phi`` equal rows, at t = 0."""
    rows = np.ones(n_phi)
    return State(0.0, state.area * rows, state.flow * rows, state.exponent * rows)
