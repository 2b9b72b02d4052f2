"""The schema of a case: every section, its keys and what they may hold. Values are in SI units."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, ValidationInfo, field_validator

from cases.sections.base import SAME, Section, told_apart_by, union_by_tag
from cases.sections.calcification import Calcification, LocalCalcification, Part, SeveralCalcifications
from cases.sections.compare import Compare
from cases.sections.inlet import Inlet
from cases.sections.outlet import NonReflectingOutlet, Outlet, PressureOutlet, ResistanceOutlet
from cases.sections.references.base import ReferenceSection
from cases.sections.references.kinds import KINDS
from cases.sections.solver import (
    FEWEST_ROWS,
    MOST_STATES,
    MOST_STEPS,
    RESOLVED_PER_CYCLE,
    GodunovSolver,
    Solver,
    Start,
)
from cases.sections.uncertainty import Uncertainty
from cases.sections.wall import Wall, row_wall
from cases.sections.wall_laws import LAWS
from cases.values.kinds import ArteryLength, Density, Radius, Thickness, Viscosity, Words, refused

if TYPE_CHECKING:
    Reference = ReferenceSection
else:
    Reference = union_by_tag({name: kind.section for name, kind in KINDS.items()})


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


class Case(Section):
    """One complete case: an artery, its boundary conditions, a solver, and what to compare.

    Attributes
    ----------
    title : str
        Title of the variant.
    geometry, blood, wall, calcification, inlet, outlet, solver : Section
        See their classes.
    reference : ReferenceSection or None
        The 3D results to compare with, of a kind of :data:`cases.sections.references.kinds.KINDS`.
    compare : Compare
        Cells (on the solver's grid), times (of the inlet's cycle) and bands of the comparison.
    uncertainty : Uncertainty or None
        How uncertain its inputs are.
    """

    title: Words
    geometry: Geometry
    blood: Blood
    wall: Annotated[Wall, told_apart_by("law")]
    calcification: Annotated[Calcification, told_apart_by("pattern")]
    inlet: Annotated[Inlet, told_apart_by("kind")]
    outlet: Annotated[Outlet, told_apart_by("kind")]
    solver: Annotated[Solver, told_apart_by("scheme")]
    reference: Annotated[Reference, told_apart_by("kind")] | None = None
    compare: Compare = Field(default=Compare(), validate_default=True)
    uncertainty: Uncertainty | None = None

    @field_validator("wall")
    @classmethod
    def _around_the_lumen(cls, wall: Wall, info: ValidationInfo) -> Wall:
        geometry = info.data.get("geometry")
        if geometry is not None:
            row_wall(wall).refuse_unfit(geometry.radius, geometry.wall_thickness)
        return wall

    @field_validator("calcification")
    @classmethod
    def _inside_the_artery(cls, calcification: Calcification, info: ValidationInfo) -> Calcification:
        geometry, wall = info.data.get("geometry"), info.data.get("wall")
        for k, part in enumerate(calcification.parts):
            if geometry is not None and part.x[1] > geometry.length:
                where = ("patches", k) if isinstance(calcification, SeveralCalcifications) else ()
                allowed = f"at most the artery's length ({geometry.length:g} m)"
                raise refused(f"{part.x[1]:g} m", allowed, key=(*where, "x", 1))
        if wall is not None and calcification.parts:
            layers = row_wall(wall).layers_within(0.0 if geometry is None else geometry.wall_thickness)
            if not any(layer.calcifies for layer in layers):
                allowed = "none, unless a layer of the wall states calcifies: true"
                raise refused(calcification.pattern, allowed, key=("pattern",))
        return calcification

    @field_validator("outlet")
    @classmethod
    def _in_step_with_the_inlet(cls, outlet: Outlet, info: ValidationInfo) -> Outlet:
        inlet = info.data.get("inlet")
        if inlet is not None and isinstance(outlet, PressureOutlet) and outlet.waveform is not None:
            period = outlet.waveform.period
            if abs(period - inlet.period) > SAME * inlet.period:
                allowed = f"the period of the inlet ({inlet.period:g} s)"
                raise refused(f"a period of {period:g} s", allowed, key=("waveform",))
        return outlet

    @field_validator("solver")
    @classmethod
    def _fits_the_case(cls, solver: Solver, info: ValidationInfo) -> Solver:
        inlet, calcification = info.data.get("inlet"), info.data.get("calcification")
        outlet, parts = info.data.get("outlet"), () if calcification is None else calcification.parts
        if isinstance(solver, GodunovSolver):
            _refuse_unfit_for_godunov(solver, info.data.get("wall"), parts)
        if inlet is not None and solver.time_step > inlet.period:
            allowed = f"at most the period of the inlet ({inlet.period:g} s)"
            raise refused(f"{solver.time_step:g} s", allowed, key=("time_step",))
        if any(isinstance(part, LocalCalcification) for part in parts) and solver.n_phi < FEWEST_ROWS:
            allowed = f"{FEWEST_ROWS} or more with a local calcification"
            raise refused(solver.n_phi, allowed, key=("n_phi",))
        if inlet is not None:
            _refuse_endless_runs(solver, inlet)
            _refuse_unresolved_energy(solver, inlet)
        if inlet is not None and outlet is not None:
            start = _default_start(inlet, outlet)
            if "start" not in solver.model_fields_set:
                return solver.model_copy(update={"start": start})
            if solver.start == "periodic" and start == "rest":
                allowed = "rest or steady with a ramp, and with a non-reflecting outlet"
                raise refused(solver.start, allowed, key=("start",))
        return solver

    @field_validator("compare")
    @classmethod
    def _in_the_grid_and_the_cycle(cls, compare: Compare, info: ValidationInfo) -> Compare:
        inlet, solver = info.data.get("inlet"), info.data.get("solver")
        if inlet is None or solver is None:
            return compare
        times = compare.in_cycle(inlet.period, constant=inlet.value is not None)
        cells = compare.cells.on_grid(solver.n_x, solver.n_phi)
        return compare.model_copy(update={"cells": cells, "times": times})

    @property
    def input_files(self) -> tuple[Path, ...]:
        """Absolute paths of the files that the case was read from, besides the case file itself."""
        outlet = self.outlet
        paths = (
            *(() if self.reference is None else self.reference.files),
            *(getattr(value, "path", None) for _, value in self.wall),
            None if self.inlet.waveform is None else self.inlet.waveform.path,
            outlet.waveform.path if isinstance(outlet, PressureOutlet) and outlet.waveform else None,
        )
        return tuple(path for path in paths if path is not None)


def _refuse_unfit_for_godunov(solver: Solver, wall: Wall | None, parts: Sequence[Part]) -> None:
    linear = [name for name, law in LAWS.items() if law.linear]
    allowed = ""
    if wall is not None and wall.law not in linear:
        allowed = f"semi_implicit with the wall law {wall.law}; godunov with {', '.join(linear)}"
    elif len(parts) > 1:
        allowed = "semi_implicit with several patches; godunov with one"
    elif any(part.transition == "sharp" for part in parts):
        allowed = "semi_implicit with a sharp calcification; godunov with transition lengths"
    if allowed:
        raise refused(solver.scheme, allowed, key=("scheme",))


def _refuse_endless_runs(solver: Solver, inlet: Inlet) -> None:
    """Refuse more steps or saved states than a run can take."""
    asked = (
        ("time_step", solver.time_step, MOST_STEPS[solver.scheme], "steps"),
        ("output_interval", solver.output_interval, MOST_STATES, "states"),
    )
    for key, interval, most, words in asked:
        count = 0.0 if interval is None else solver.cycles * inlet.period / interval
        if count > most * (1.0 + SAME):
            reason = f"{count:.4g} {words} in {solver.cycles} cycles of {inlet.period:g} s"
            raise refused(f"{interval:g} s", f"at most {most} {words}", reason, key=(key,))


def _refuse_unresolved_energy(solver: Solver, inlet: Inlet) -> None:
    """Refuse a limit on the energy balance where the saved states cannot resolve it."""
    longest, interval = inlet.period / RESOLVED_PER_CYCLE, solver.output_interval
    stated = solver.limits is not None and solver.limits.energy_defect is not None
    if stated and interval is not None and interval > longest * (1.0 + SAME):
        allowed = f"with limits.energy_defect at most a {RESOLVED_PER_CYCLE}th of the cycle ({longest:g} s)"
        raise refused(f"{interval:g} s", allowed, key=("output_interval",))


def _default_start(inlet: Inlet, outlet: Outlet) -> Start:
    """Return rest where a ramp leads away from it, or where the outlet lets no steady state settle."""
    ramped = inlet.ramp is not None or (isinstance(outlet, ResistanceOutlet) and outlet.ramp is not None)
    return "rest" if ramped or isinstance(outlet, NonReflectingOutlet) else "steady"
