"""What the mapping takes from a FEBio plot file: lumen and wall, displacement, velocity, pressure."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.sections.references.febio import FebioReference
from febio_io.xplt import Domain, Plot
from validation.errors import UnusableReferenceError
from validation.mapping.elements import KIND_OF_VTK_TYPE, NODES
from validation.mapping.mesh import KIND_NAMES, Block
from validation.reference.mesh.series import Where

DISPLACEMENT, VELOCITY = "displacement", "nodal fluid velocity"
NODAL_PRESSURE, ELEMENT_PRESSURE = "effective fluid pressure", "fluid pressure"
FLUID_VARIABLES = (NODAL_PRESSURE, ELEMENT_PRESSURE)


@dataclass(frozen=True)
class Domains:
    """Domains that hold blood and wall, those of the wall that are calcified, notes on what was left out."""

    lumen: tuple[Domain, ...]
    wall: tuple[Domain, ...]
    calcified: tuple[Domain, ...]
    notes: tuple[str, ...]


def _named(plot: Plot, names: tuple[str, ...], what: str) -> tuple[list[Domain], list[str]]:
    found = [domain for domain in plot.mesh.domains if domain.name in names]
    present = {domain.name for domain in found}
    if not found:
        have = ", ".join(domain.name or "(unnamed)" for domain in plot.mesh.domains)
        raise UnusableReferenceError(
            f"{plot.path}: no domain for reference.{what}: {', '.join(names)}; the file has: {have}"
        )
    notes = [
        f"{plot.path.name} has no domain {name!r} (named in reference.{what})"
        for name in names
        if name not in present
    ]
    return found, notes


def choose_domains(plot: Plot, reference: FebioReference) -> Domains:
    """Lumen and wall domains: those the case names, else by whether they carry fluid pressure.

    Raises
    ------
    UnusableReferenceError
        If none is found, or one is named both lumen and wall.
    """
    wet = {region for name in FLUID_VARIABLES for region in _regions(plot, name)}
    lumen = [d for d in plot.mesh.domains if d.region in wet]
    wall = [d for d in plot.mesh.domains if d.region not in wet]
    notes: list[str] = []
    more: list[str] = []
    if reference.lumen:
        lumen, notes = _named(plot, reference.lumen, "lumen")
    if reference.wall:
        wall, more = _named(plot, reference.wall, "wall")
    if not (lumen and wall):
        raise UnusableReferenceError(
            f"{plot.path}: lumen and wall cannot be told apart by fluid pressure; "
            "name their domains in reference.lumen and reference.wall"
        )
    both = {d.name for d in lumen if d in wall}
    if both:
        raise UnusableReferenceError(
            f"{plot.path}: domains named both lumen and wall: {', '.join(sorted(both))}"
        )
    used = {d.region for d in lumen} | {d.region for d in wall}
    left = [d.name or f"number {d.region}" for d in plot.mesh.domains if d.region not in used]
    if left:
        notes.append(f"{plot.path.name}: domains neither lumen nor wall are left out: {', '.join(left)}")
    calcified = tuple(d for d in wall if d.name in (reference.calcified or ()))
    return Domains(tuple(lumen), tuple(wall), calcified, (*notes, *more))


def _regions(plot: Plot, name: str) -> tuple[int, ...]:
    known = any(v.name == name and v.section == "domain" for v in plot.variables)
    return tuple(plot.regions(name, 0)) if known else ()


def blocks(plot: Plot, domains: tuple[Domain, ...]) -> list[Block]:
    """Elements of domains, by kind.

    Raises
    ------
    UnusableReferenceError
        For an element type that the mapping cannot interpolate in.
    """
    chosen = []
    for domain in domains:
        kind = KIND_OF_VTK_TYPE.get(domain.element_type.vtk_type or 0)
        if kind is None:
            raise UnusableReferenceError(
                f"{plot.path}: domain {domain.name!r} has {domain.element_type.name} elements; "
                f"allowed in lumen and wall: {', '.join(KIND_NAMES.values())}"
            )
        chosen.append(Block(kind, domain.connectivity[:, : NODES[kind]].astype(np.int64)))
    return chosen


def require(plot: Plot) -> None:
    """Check that the plot file carries the variables that the mapping needs.

    Raises
    ------
    UnusableReferenceError
        Naming the missing variable and those present.
    """
    present = {variable.name for variable in plot.variables}
    have = ", ".join(sorted(present))
    for name in (DISPLACEMENT, VELOCITY):
        if name not in present:
            raise UnusableReferenceError(f"{plot.path}: plot variable {name!r} is missing; it has: {have}")
    if not present & set(FLUID_VARIABLES):
        wanted = " or ".join(repr(name) for name in FLUID_VARIABLES)
        raise UnusableReferenceError(f"{plot.path}: plot variable {wanted} is missing; it has: {have}")


def pressure_at(plot: Plot, lumen: tuple[Domain, ...]) -> Where:
    """Where the lumen has pressure: FEBio's continuous one at nodes, else averages of elements.

    Raises
    ------
    UnusableReferenceError
        Naming the domains without.
    """
    regions = {domain.region for domain in lumen}
    if regions <= set(_regions(plot, NODAL_PRESSURE)):
        return "nodes"
    missing = regions - set(_regions(plot, ELEMENT_PRESSURE))
    if missing:
        names = ", ".join(d.name for d in lumen if d.region in missing)
        raise UnusableReferenceError(f"{plot.path}: no fluid pressure in lumen domain {names}")
    return "cells"


def lumen_pressure(plot: Plot, lumen: tuple[Domain, ...], state: int, where: Where) -> Floats:
    """Pressure of the lumen's elements, or at all nodes and zero off the lumen, in the file's unit."""
    if where == "cells":
        averages = [plot.field(ELEMENT_PRESSURE, state, domain.region) for domain in lumen]
        return np.concatenate(averages).astype(float)
    nodal = np.zeros(len(plot.mesh.coordinates))
    for domain in lumen:
        nodal[domain.nodes] = plot.field(NODAL_PRESSURE, state, domain.region)
    return nodal
