"""The schema of a case: every section, its keys and what they may hold. Values are in SI units."""

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, ValidationInfo, field_validator, model_validator
from pydantic_core.core_schema import ValidatorFunctionWrapHandler

from cases.calcification import (
    AxialTransition,
    AxisymmetricCalcification,
    Calcification,
    LocalCalcification,
    NoCalcification,
    PatchTransition,
    pattern_of,
)
from cases.comparison import Band, Cells, Compare
from cases.reference import FebioReference
from cases.section import Section
from cases.values import (
    ArteryLength,
    Density,
    Modulus,
    Period,
    Pressure,
    Radius,
    Resistance,
    Thickness,
    TimeStep,
    Velocity,
    Viscosity,
    WaveformFile,
    Words,
    number,
    one_of,
    refused,
    whole_number,
)

__all__ = [
    "AxialTransition",
    "AxisymmetricCalcification",
    "Band",
    "Blood",
    "Calcification",
    "Case",
    "Cells",
    "Compare",
    "FebioReference",
    "Geometry",
    "LocalCalcification",
    "NoCalcification",
    "PatchTransition",
    "ResistanceOutlet",
    "Solver",
    "VelocityInlet",
    "Wall",
]

DEFAULT_PERIOD = 1.0
FEWEST_ROWS = 4

PoissonRatio = number("a number from 0 on, less than 0.5", lambda value: 0 <= value < 0.5)
Sections = whole_number("a whole number from 3 on", lambda value: value >= 3)
Rows = whole_number("1, or a whole number from 4 on", lambda value: value == 1 or value >= FEWEST_ROWS)
Cycles = whole_number("a whole number from 1 on", lambda value: value >= 1)


class Geometry(Section):
    """The unloaded artery, a straight circular cylinder.

    Attributes
    ----------
    length, radius, wall_thickness : float
        Length L, lumen radius R₀ and wall thickness h in m.
    """

    length: ArteryLength
    radius: Radius
    wall_thickness: Thickness


class Blood(Section):
    """Blood, a Newtonian fluid.

    Attributes
    ----------
    density : float
        ρ in kg/m³.
    viscosity : float
        Dynamic viscosity μ in Pa s.
    """

    density: Density
    viscosity: Viscosity


class Wall(Section):
    """The healthy wall.

    Attributes
    ----------
    law : str
        ``thin`` or ``thick``: the stiffness of a thin-walled or of a thick-walled tube.
    youngs_modulus : float
        E in Pa.
    poisson_ratio : float
        ν in [0, 0.5).
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    """

    law: Annotated[Literal["thin", "thick"], one_of(Literal["thin", "thick"])]
    youngs_modulus: Modulus
    poisson_ratio: Annotated[float, PoissonRatio]
    reference_pressure: Pressure = 0.0


def _default_period(inlet: dict[str, Any]) -> float:
    waveform = inlet.get("waveform")
    return DEFAULT_PERIOD if waveform is None else float(waveform.period)


class VelocityInlet(Section):
    """A prescribed mean velocity.

    Attributes
    ----------
    waveform : Waveform or None
        Mean velocity over one cycle.
    value : float or None
        Constant mean velocity in m/s. Exactly one of `waveform` and `value` is stated.
    period : float
        Duration of a cycle in s: the waveform's, or the one stated beside `value` (1 s by default).
    """

    kind: Annotated[Literal["velocity"], one_of(Literal["velocity"])]
    waveform: WaveformFile | None = None
    value: Velocity | None = None
    period: Period = Field(default_factory=_default_period)

    @field_validator("period", mode="wrap")
    @classmethod
    def _period(cls, stated: object, check: ValidatorFunctionWrapHandler, info: ValidationInfo) -> float:
        if info.data.get("waveform") is not None:
            raise refused(stated, "no period beside a waveform, which has its own")
        return float(check(stated))

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if (self.waveform is None) == (self.value is None):
            found = "neither waveform nor value" if self.value is None else "waveform and value"
            raise refused(found, "exactly one of waveform and value")
        return self


class ResistanceOutlet(Section):
    """A terminal resistance: P = P_res + R_res q.

    Attributes
    ----------
    resistance, offset : float
        R_res in Pa s/m³ and P_res in Pa.
    flow : str
        What q is: the flow rate of the whole ``section``, or each ``row``'s own.
    """

    kind: Annotated[Literal["resistance"], one_of(Literal["resistance"])]
    resistance: Resistance
    offset: Pressure
    flow: Annotated[Literal["section", "row"], one_of(Literal["section", "row"])] = "section"


class Solver(Section):
    """The numerical solution.

    Attributes
    ----------
    scheme : str
        The numerical scheme.
    n_x, n_phi : int
        Number of sections along x and of rows along φ.
    time_step : float
        Δt in s, at most the inlet's period.
    cycles : int
        Number of cycles; results are taken from the last one.
    closure : str
        How the velocity profile closes the equations.
    output_interval : float or None
        Time between saved states in s, at least the time step.
    """

    scheme: Annotated[Literal["semi_implicit"], one_of(Literal["semi_implicit"])]
    n_x: Annotated[int, Sections]
    n_phi: Annotated[int, Rows]
    time_step: TimeStep
    cycles: Annotated[int, Cycles]
    closure: Annotated[Literal["average"], one_of(Literal["average"])]
    output_interval: TimeStep | None = None

    @field_validator("output_interval")
    @classmethod
    def _output_interval(cls, interval: float | None, info: ValidationInfo) -> float | None:
        time_step = info.data.get("time_step")
        if interval is not None and time_step is not None and interval < time_step:
            raise refused(f"{interval:g} s", f"at least the time step ({time_step:g} s)")
        return interval


class Case(Section):
    """One complete case: an artery, its boundary conditions, a solver, and what to compare.

    Attributes
    ----------
    title : str
        Title of the variant.
    geometry, blood, wall, calcification, inlet, outlet, solver : Section
        See their classes.
    reference : FebioReference or None
        The 3D results to compare with.
    compare : Compare
        Cells (on the solver's grid), times and bands of the comparison.
    """

    title: Words
    geometry: Geometry
    blood: Blood
    wall: Wall
    calcification: Annotated[Calcification, Discriminator(pattern_of)]
    inlet: VelocityInlet
    outlet: ResistanceOutlet
    solver: Solver
    reference: FebioReference | None = None
    compare: Compare = Field(default=Compare(), validate_default=True)

    @field_validator("calcification")
    @classmethod
    def _inside_the_artery(cls, calcification: Calcification, info: ValidationInfo) -> Calcification:
        geometry = info.data.get("geometry")
        if geometry is None or isinstance(calcification, NoCalcification):
            return calcification
        if calcification.x[1] > geometry.length:
            found = f"{calcification.x[1]:g} m"
            raise refused(found, f"at most the artery's length ({geometry.length:g} m)", key=("x", 1))
        return calcification

    @field_validator("solver")
    @classmethod
    def _fits_the_case(cls, solver: Solver, info: ValidationInfo) -> Solver:
        inlet, calcification = info.data.get("inlet"), info.data.get("calcification")
        if inlet is not None and solver.time_step > inlet.period:
            allowed = f"at most the period of the inlet ({inlet.period:g} s)"
            raise refused(f"{solver.time_step:g} s", allowed, key=("time_step",))
        if isinstance(calcification, LocalCalcification) and solver.n_phi < FEWEST_ROWS:
            allowed = f"{FEWEST_ROWS} or more with a local calcification"
            raise refused(solver.n_phi, allowed, key=("n_phi",))
        return solver

    @field_validator("compare")
    @classmethod
    def _on_the_grid(cls, compare: Compare, info: ValidationInfo) -> Compare:
        inlet, solver = info.data.get("inlet"), info.data.get("solver")
        if inlet is None or solver is None:
            return compare
        for item, time in enumerate(compare.times):
            if isinstance(time, float) and time > inlet.period:
                allowed = f"at most the period of the inlet ({inlet.period:g} s)"
                raise refused(f"{time:g} s", allowed, key=("times", item))
        return compare.model_copy(update={"cells": compare.cells.on_grid(solver.n_x, solver.n_phi)})
