"""What is needed of a 3D result, whatever solver wrote it: states of a deforming mesh of blood and wall.

A solver's kind of reference opens a :class:`MeshSeries`; all that follows is the same for every kind.
"""

from typing import Any, Literal, NamedTuple, Protocol

from cases.arrays import Floats
from validation.mapping.mesh import Block

Where = Literal["nodes", "cells"]


class SeriesMesh(NamedTuple):
    """The mesh that all states share.

    Attributes
    ----------
    coordinates : ndarray (n_nodes, 3)
        Of the nodes in the unloaded state, in the solver's frame, m.
    lumen, wall : list of Block
        Cells of blood and of wall by kind; both have the interface's nodes. Without wall cells the lumen's
        outer surface is the interface.
    calcified : list of Block or None
        Calcified cells of the wall, to be compared with the case's; None where nothing tells them.
    velocity_at, pressure_at : {"nodes", "cells"}
        Where a state has its velocity and pressure; cells are those of ``lumen``, in order.
    notes : tuple of str
        What a reader must know, as what was left out.
    unloaded : bool
        Whether ``coordinates`` are known to be of the unloaded state, so that its radius must be the case's.
    """

    coordinates: Floats
    lumen: list[Block]
    wall: list[Block]
    calcified: list[Block] | None = None
    velocity_at: Where = "nodes"
    pressure_at: Where = "nodes"
    notes: tuple[str, ...] = ()
    unloaded: bool = True


class MeshState(NamedTuple):
    """One state.

    Attributes
    ----------
    positions : ndarray (n_nodes, 3)
        Of the nodes in the deformed state, m.
    velocity : ndarray (n_nodes, 3) or (n_lumen_cells, 3)
        Absolute, that of the blood and not that relative to a moving mesh, m/s.
    pressure : ndarray (n_nodes,) or (n_lumen_cells,)
        Pa; what it is off the lumen does not count.
    """

    positions: Floats
    velocity: Floats
    pressure: Floats


class Account(NamedTuple):
    """What a run tells of itself.

    ``facts`` for provenance: ``file``, ``software``, ``nodes``, ``elements``, and where it is known ``cost``,
    as :func:`validation.reference.febio.log.account_of_log` gives it; notes; what casts doubt on the run.
    """

    facts: dict[str, Any]
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


class MeshSeries(Protocol):
    """An open 3D result, SI. Nothing is read before it is asked for, and one state at a time.

    All raise an UnusableReferenceError, or an error of the file's reader, with one line that names the file.
    """

    @property
    def name(self) -> str:
        """File that messages name."""

    @property
    def times(self) -> Floats:
        """Times of the states, (n_states,), s."""

    def mesh(self) -> SeriesMesh:
        """Return the mesh of all states."""

    def state(self, number: int) -> MeshState:
        """Return a state, counted from 0."""

    def account(self) -> Account:
        """Return what the run tells of itself; raises too where that is of another run."""
