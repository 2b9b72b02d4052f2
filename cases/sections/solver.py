"""The numerical solution: scheme, grid, time step."""

from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import Tag, ValidationInfo, field_validator, model_validator

from cases.sections.base import Section
from cases.values.kinds import (
    CourantLimit,
    DefectLimit,
    Exponent,
    TimeStep,
    Tolerance,
    one_of,
    refused,
    whole_number,
)

FEWEST_ROWS = 4
MOST_SECTIONS, MOST_ROWS, MOST_CELLS = 10_000, 2_000, 2_000_000
MOST_CYCLES = 1_000
MOST_STEPS = MappingProxyType({"semi_implicit": 10_000_000, "godunov": 100_000_000})
MOST_STATES = 100_000
RESOLVED_PER_CYCLE = 50  # saved states with which powers are integrated over time

Closure = Literal["average", "maximum", "least_squares", "mean", "axis_momentum"]
CLOSURES_OF = MappingProxyType({"power": ("average",), "two_mode": ("mean", "axis_momentum")})
GODUNOV_CLOSURES = ("average", "maximum", "least_squares")
Profile = Literal["power", "two_mode"]
Start = Literal["steady", "rest", "periodic"]
PressureOf = Literal["row", "section"]
Limiter = Literal["van_leer", "superbee", "minmod", "upwind", "lax_wendroff"]
Coefficients = Literal["corrected", "printed"]

Sections = whole_number(f"a whole number from 3 to {MOST_SECTIONS}", lambda n: 3 <= n <= MOST_SECTIONS)
Rows = whole_number(
    f"1, or a whole number from {FEWEST_ROWS} to {MOST_ROWS}",
    lambda n: n == 1 or FEWEST_ROWS <= n <= MOST_ROWS,
)
Cycles = whole_number(f"a whole number from 1 to {MOST_CYCLES}", lambda n: 1 <= n <= MOST_CYCLES)


class Limits(Section):
    """Largest values of a run's diagnostics; one above its limit stops the run. None: no limit.

    Attributes
    ----------
    courant_number, advective_courant_number : float or None
        Largest wave speed or mean velocity × Δt/Δx, in [0.001, 1e6].
    mass_defect, continuity_residual, energy_defect : float or None
        See the table of fields; ratios in [1e-15, 1].
    """

    courant_number: CourantLimit | None = None
    advective_courant_number: CourantLimit | None = None
    mass_defect: DefectLimit | None = None
    continuity_residual: DefectLimit | None = None
    energy_defect: DefectLimit | None = None


class SolverSettings(Section):
    """What both schemes need.

    Attributes
    ----------
    scheme : str
        The numerical scheme.
    n_x, n_phi : int
        Number of sections along x and of rows along φ; at most `MOST_CELLS` cells in all.
    time_step : float
        Δt in s, at most the inlet's period.
    cycles : int
        Number of cycles; results are taken from the last one.
    closure : str
        How the velocity profile closes the equations; each scheme and profile has its own.
    start : str
        ``steady``: from the steady state of the boundary values at t = 0; ``rest``: from blood at rest;
        ``periodic``: from the state that cycles repeat. Where none is stated, a `Case` sets rest if a
        boundary has a ramp, or the outlet is non-reflecting.
    output_interval : float or None
        Time between saved states in s, at least the time step.
    limits : Limits or None
        What stops the run.
    """

    scheme: str
    n_x: Annotated[int, Sections]
    n_phi: Annotated[int, Rows]
    time_step: TimeStep
    cycles: Annotated[int, Cycles]
    closure: Annotated[Closure, one_of(Closure)]
    start: Annotated[Start, one_of(Start)] = "steady"
    output_interval: TimeStep | None = None
    limits: Limits | None = None

    @field_validator("n_phi")
    @classmethod
    def _n_phi(cls, n_phi: int, info: ValidationInfo) -> int:
        n_x = info.data.get("n_x")
        if n_x is not None and n_x * n_phi > MOST_CELLS:
            raise refused(n_phi, f"at most {MOST_CELLS // n_x} with n_x {n_x} ({MOST_CELLS} cells)")
        return n_phi

    @field_validator("output_interval")
    @classmethod
    def _output_interval(cls, interval: float | None, info: ValidationInfo) -> float | None:
        time_step = info.data.get("time_step")
        if interval is not None and time_step is not None and interval < time_step:
            raise refused(f"{interval:g} s", f"at least the time step ({time_step:g} s)")
        return interval


class SemiImplicitSolver(SolverSettings):
    """The staggered, pressure-implicit scheme.

    Attributes
    ----------
    error_tolerance : float or None
        Relative error of a step that an adaptive time step keeps, in [1e-9, 0.1]; None: a fixed time step.
    profile_exponent : float or None
        Fixed exponent γ of the velocity profile, for one row only, in [0.01, 1000]; None: γ follows from the
        closure.
    pressure : str
        What has a pressure of its own: each ``row`` of a section (the thesis's model), or the ``section``,
        whose rows then exchange blood.
    profile : str
        Family of velocity profiles: ``power``, the thesis's u (γ+2)/γ (1 − y^γ), or ``two_mode``,
        D (1 − yⁿ) + B y²(1 − y⁴), which can flow back.
    base_exponent : float
        n of two modes, in [0.01, 1000]; 2 with closure axis_momentum.
    """

    scheme: Annotated[Literal["semi_implicit"], one_of(Literal["semi_implicit"])]
    error_tolerance: Tolerance | None = None
    profile_exponent: Exponent | None = None
    pressure: Annotated[PressureOf, one_of(PressureOf)] = "row"
    profile: Annotated[Profile, one_of(Profile)] = "power"
    base_exponent: Exponent = 2.0

    def _closures(self) -> str:
        if self.closure in GODUNOV_CLOSURES and self.profile == "power":
            return "average; with scheme godunov also maximum, least_squares"
        return "; ".join(f"{', '.join(names)} with profile {name}" for name, names in CLOSURES_OF.items())

    @model_validator(mode="after")
    def _of_profile(self) -> Self:
        if self.closure not in CLOSURES_OF[self.profile]:
            raise refused(self.closure, self._closures(), key=("closure",))
        if self.profile == "power":
            if self.base_exponent != 2.0:
                raise refused(f"{self.base_exponent:g}", "2 with profile power", key=("base_exponent",))
            return self
        if self.closure == "axis_momentum" and self.base_exponent != 2.0:
            raise refused(f"{self.base_exponent:g}", "2 with closure axis_momentum", key=("base_exponent",))
        if self.profile_exponent is not None:
            raise refused(
                f"{self.profile_exponent:g}",
                "no profile_exponent with profile two_mode",
                key=("profile_exponent",),
            )
        return self

    @field_validator("profile_exponent")
    @classmethod
    def _profile_exponent(cls, exponent: float | None, info: ValidationInfo) -> float | None:
        n_phi = info.data.get("n_phi")
        if exponent is not None and n_phi is not None and n_phi != 1:
            raise refused(f"{exponent:g}", f"no profile_exponent with n_phi {n_phi}, only with n_phi 1")
        return exponent


class GodunovSolver(SolverSettings):
    """The split explicit scheme.

    Attributes
    ----------
    limiter : str
        What limits the second-order correction; ``upwind`` leaves it out, ``lax_wendroff`` leaves it whole.
    coefficients : str
        ``corrected``, or as ``printed`` in the thesis.
    """

    scheme: Annotated[Literal["godunov"], one_of(Literal["godunov"])]
    limiter: Annotated[Limiter, one_of(Limiter)] = "van_leer"
    coefficients: Annotated[Coefficients, one_of(Coefficients)] = "corrected"

    @field_validator("closure")
    @classmethod
    def _closure(cls, closure: Closure) -> Closure:
        if closure not in GODUNOV_CLOSURES:
            raise refused(closure, f"{', '.join(GODUNOV_CLOSURES)} with scheme godunov")
        return closure

    @field_validator("start")
    @classmethod
    def _start(cls, start: Start) -> Start:
        if start == "periodic":
            raise refused(start, "steady or rest with scheme godunov")
        return start


Solver = Annotated[SemiImplicitSolver, Tag("semi_implicit")] | Annotated[GodunovSolver, Tag("godunov")]
