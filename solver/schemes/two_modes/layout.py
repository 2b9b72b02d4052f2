"""The arrays that the scheme needs besides those of one family of profiles (SI)."""

from typing import Any, NamedTuple

from cases.arrays import Floats
from solver.schemes.layout import arrays


class Modes(NamedTuple):
    """v = D (1 − yⁿ) + B y²(1 − y⁴) with B = 4(u − aD), in numbers; see :mod:`solver.model.profiles`.

    Attributes
    ----------
    exponent, share : float
        n and a = n/(n+2), the base's mean over D.
    uu, ud, dd : float
        2∫v²y dy = uu u² + ud uD + dd D².
    wall_axis : float
        −∂_y v(1) = 16u + wall_axis D.
    momentum : bool
        Whether D follows from the momentum on the axis; otherwise it is the mean of u/a over the section.
    """

    exponent: float
    share: float
    uu: float
    ud: float
    dd: float
    wall_axis: float
    momentum: bool


class Parameters(NamedTuple):
    """Constants of a run: those of the scheme with pressures of rows, or of sections, and the modes."""

    base: Any
    modes: Modes


class Fields(NamedTuple):
    """The state that a step advances in place.

    ``base``: that of the scheme, whose A and Q are also ``area`` and ``flow``; ``axis_velocity`` D on faces
    (n_x + 1,), m/s, unused where it is the section's mean.
    """

    base: Any
    area: Floats
    flow: Floats
    axis_velocity: Floats


class Workspace(NamedTuple):
    """Scratch of a run; ``base`` and ``exchanged``, a part of it, are the scheme's."""

    base: Any
    exchanged: Floats
    axis: Floats  # faces: D of the iterate
    mean_axis: Floats  # faces: θ-weighted D
    older_axis: Floats  # faces: one step earlier, for the first iterate
    oldest_axis: Floats  # faces: two steps earlier
    axis_drive: Floats  # faces: Δt/ρ ∂_xP
    axis_change: Floats  # faces
    axis_matrix: Floats  # (3, faces)
    excess: Floats  # (faces, n_phi): viscous terms without their share of Q, times Δt
    section_slope: Floats  # cells along x: θ ∂flux/∂Q of whole sections, which rows have no use for
    row_slope: Floats  # cells along x: θ ∂flux/∂Q of rows that deviate from their section
    row_damping: Floats  # faces: mean Δt S of rows that deviate from their section
    around: Floats  # (4, n_phi + 2)
    velocity: Floats  # (faces, n_phi + 2): u, with ghosts
    face_area: Floats  # (faces, n_phi + 2): θ-weighted A, with ghosts; unused with pressures of sections


def workspace(base: Any, n_x: int, n_phi: int) -> Workspace:
    """Allocate the scratch of a run beside that of its scheme."""
    faces = n_x + 1
    shapes: list[tuple[int, ...]] = [(faces,)] * 6
    shapes += [(3, faces), (faces, n_phi), (n_x,), (n_x,), (faces,), (4, n_phi + 2)]
    shapes += [(faces, n_phi + 2)] * 2
    return Workspace(base, base.exchanged, *arrays(shapes))
