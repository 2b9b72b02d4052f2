"""A plot file as one model: mesh and nodal values in the artery's frame, SI, whole."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from cases.sections.case import FebioReference
from cases.sections.reference import components
from febio_io.xplt import Plot
from validation.errors import UnusableReferenceError
from validation.mapping.interpolation import topology
from validation.mapping.mesh import Block, LumenMesh, lumen_mesh, padded
from validation.mapping.mirror import mirror
from validation.reference.febio.plot_file import (
    DISPLACEMENT,
    VELOCITY,
    blocks,
    choose_domains,
    pressure_reader,
    require,
)
from validation.reference.frame import frame


class NodalValues(NamedTuple):
    """One state: ``displacement`` (n_nodes, 3), m; ``velocity`` (n_nodes, 3), m/s; ``pressure``, Pa."""

    displacement: Floats
    velocity: Floats
    pressure: Floats


@dataclass(frozen=True)
class PlotModel:
    """What the mapping needs of a plot file.

    Attributes
    ----------
    mesh : LumenMesh
    calcified : list of Block
        Calcified elements of the wall.
    read : callable
        State → NodalValues; raises UnusableReferenceError where a value is not finite.
    notes : tuple of str
        What was left out.
    """

    mesh: LumenMesh
    calcified: list[Block]
    read: Callable[[int], NodalValues]
    notes: tuple[str, ...]


def plot_model(plot: Plot, stated: FebioReference) -> PlotModel:
    """Read the mesh of a plot file, and how its states are read.

    Raises
    ------
    UnusableReferenceError
        If the file lacks what the mapping needs.
    """
    require(plot)
    domains = choose_domains(plot, stated)
    place = frame(
        stated.axis,
        stated.phi_zero,
        stated.origin,
        length=stated.length_unit,
        velocity=stated.length_unit / stated.time_unit,
    )
    coordinates = place.points(plot.mesh.coordinates.astype(float))
    parts = [blocks(plot, which) for which in (domains.lumen, domains.wall, domains.calcified)]
    lumen = topology(*padded(parts[0]), len(coordinates))
    nodal_pressure = pressure_reader(plot, domains.lumen, lumen, coordinates)

    def read(state: int) -> NodalValues:
        values = NodalValues(
            place.displacements(plot.field(DISPLACEMENT, state).astype(float)),
            place.velocities(plot.field(VELOCITY, state).astype(float)),
            stated.pressure_unit * nodal_pressure(state),
        )
        for name, array in zip(values._fields, values, strict=True):
            if not np.all(np.isfinite(array)):
                raise UnusableReferenceError(
                    f"{plot.path}: {name} of state {state + 1} is not finite everywhere"
                )
        return values

    if stated.symmetry is None:
        mesh = lumen_mesh(coordinates, parts[0], parts[1])
        return PlotModel(mesh, parts[2], read, domains.notes)
    used = np.unique(np.concatenate([block.nodes.ravel() for block in (*parts[0], *parts[1])]))
    both = mirror(coordinates, used, place.directions(np.array(components(stated.symmetry))))
    parts = [both.blocks(part) for part in parts]

    def read_both(state: int) -> NodalValues:
        half = read(state)
        return NodalValues(
            both.vectors(half.displacement), both.vectors(half.velocity), both.scalars(half.pressure)
        )

    mesh = lumen_mesh(both.vectors(coordinates), parts[0], parts[1])
    notes = (
        *domains.notes,
        f"{plot.path.name} holds one half; the other is its image in the plane of symmetry",
    )
    return PlotModel(mesh, parts[2], read_both, notes)
