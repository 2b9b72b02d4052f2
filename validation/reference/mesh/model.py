"""A series as the mapping takes it: whole, in the artery's frame, with values at nodes."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from cases.sections.references.base import MeshReference, Vector, components
from validation.errors import UnusableReferenceError
from validation.mapping.interpolation import topology
from validation.mapping.mesh import Block, LumenMesh, lumen_mesh, padded
from validation.mapping.mirror import mirror
from validation.mapping.pressure import element_means, recovery_operator
from validation.reference.mesh.series import MeshSeries, MeshState, SeriesMesh

Recovery = Callable[[Floats], Floats]
# Of nodal velocity, by what its means in the cells miss: 2 to 20 % of the flow by one fit alone.
CORRECTIONS = 2


@dataclass(frozen=True)
class MeshModel:
    """What the mapping needs of a series.

    Attributes
    ----------
    mesh : LumenMesh
    calcified : list of Block or None
        Calcified elements of the wall; None where nothing tells them.
    read : callable
        Number of a state → its nodal values; raises UnusableReferenceError where one is not finite.
    notes : tuple of str
        What was left out.
    nodal_velocity : bool
        Whether the files have velocity at nodes, so that it is exact at the wall.
    unloaded : bool
        Whether the mesh's radius must be the case's.
    """

    mesh: LumenMesh
    calcified: list[Block] | None
    read: Callable[[int], MeshState]
    notes: tuple[str, ...]
    nodal_velocity: bool = True
    unloaded: bool = True


def mesh_model(series: MeshSeries, stated: MeshReference) -> MeshModel:
    """Read the mesh of a series, and how its states are read.

    Raises
    ------
    UnusableReferenceError
        If it lacks what the mapping needs.
    """
    found = series.mesh()
    place = frame(stated.axis, stated.phi_zero, stated.origin)
    coordinates = place.points(found.coordinates)
    if not np.all(np.isfinite(coordinates)):
        raise UnusableReferenceError("coordinates of the mesh: not finite everywhere")
    of_velocity, of_pressure = _to_nodes(found, coordinates)

    def read(number: int) -> MeshState:
        state = series.state(number)
        nodal = MeshState(
            place.points(state.positions),
            place.directions(of_velocity(state.velocity) if found.velocity_at == "cells" else state.velocity),
            of_pressure(state.pressure) if found.pressure_at == "cells" else state.pressure,
        )
        for name, array in zip(nodal._fields, nodal, strict=True):
            if not np.all(np.isfinite(array)):
                raise UnusableReferenceError(f"{name} of state {number + 1}: not finite everywhere")
        return nodal

    known = (found.velocity_at == "nodes", found.unloaded)
    if stated.symmetry is None:
        mesh = lumen_mesh(coordinates, found.lumen, found.wall)
        return MeshModel(mesh, found.calcified, read, found.notes, *known)
    used = np.unique(np.concatenate([block.nodes.ravel() for block in (*found.lumen, *found.wall)]))
    both = mirror(coordinates, used, place.directions(np.array(components(stated.symmetry))))

    def read_both(number: int) -> MeshState:
        half = read(number)
        return MeshState(
            both.vectors(half.positions), both.vectors(half.velocity), both.scalars(half.pressure)
        )

    return MeshModel(
        lumen_mesh(both.vectors(coordinates), both.blocks(found.lumen), both.blocks(found.wall)),
        None if found.calcified is None else both.blocks(found.calcified),
        read_both,
        (
            *found.notes,
            f"{Path(series.name).name} holds one half; the other is its image in the plane of symmetry",
        ),
        *known,
    )


def _to_nodes(found: SeriesMesh, coordinates: Floats) -> tuple[Recovery, Recovery]:
    """Return how velocity and pressure of the lumen's cells become nodal, zero off the lumen."""
    if "cells" not in (found.velocity_at, found.pressure_at):
        return np.asarray, np.asarray
    mesh = topology(*padded(found.lumen), len(coordinates))
    operator, means = recovery_operator(mesh, coordinates), element_means(mesh, len(coordinates))

    def velocity(values: Floats) -> Floats:
        nodal = np.asarray(operator @ values)
        for _ in range(CORRECTIONS):
            nodal = nodal + operator @ (values - means @ nodal)
        return nodal

    return velocity, lambda values: np.asarray(operator @ values)


@dataclass(frozen=True)
class Frame:
    """Where the artery lies.

    Attributes
    ----------
    origin : ndarray (3,)
        Centre of the inlet, m.
    rotation : ndarray (3, 3)
        Rows: unit vectors along the artery, towards φ = 0 and towards φ = π/2.
    """

    origin: Floats
    rotation: Floats

    def points(self, coordinates: Floats) -> Floats:
        """Points (..., 3) of the reference in the artery's frame, m."""
        return np.asarray((coordinates - self.origin) @ self.rotation.T)

    def directions(self, parts: Floats) -> Floats:
        """Components (..., 3) in the artery's frame."""
        return np.asarray(parts @ self.rotation.T)


def frame(axis: str | Vector, phi_zero: str | Vector, origin: Vector) -> Frame:
    """Frame from the artery's axis and where φ = 0 points; its part along the axis does not count.

    Parameters
    ----------
    axis, phi_zero : str or tuple of float
        By name ("x", "-y") or components.
    origin : tuple of float
        m.
    """
    along, towards = np.array(components(axis)), np.array(components(phi_zero))
    across = towards - (towards @ along) * along
    first = across / np.linalg.norm(across)
    return Frame(np.array(origin), np.array([along, first, np.cross(along, first)]))
