"""What the semi-implicit kernels share: status codes, kinds, and the arrays they work on (SI)."""

from collections.abc import Sequence
from math import prod
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats

OK = 0
NO_ADMISSIBLE_PROFILE = 1
WALL_COLLAPSE = 2
NOT_CONVERGED = 3
NOT_FINITE = 4
BEYOND_WALL_TABLE = 5

VELOCITY_INLET, FLOW_INLET, PRESSURE_INLET = 0, 1, 2
SECTION_RESISTANCE, ROW_RESISTANCE, WINDKESSEL, NON_REFLECTING = 0, 1, 2, 3

Shapes = Sequence[tuple[int, ...]]

CACHE_LINE = 64  # bytes
REST_VELOCITY = 1e-9  # m/s: a section slower than this is at rest and has γ = 2


class Parameters(NamedTuple):
    """Constants of a run.

    Attributes
    ----------
    dx, dphi : float
        m, rad.
    sector : float
        Flow rate of a section over the sum of its rows' Q: ½Δφ, or Δφ where each row stands for two.
    mirrored : bool
        Whether the rows are one half of the ring, and the other half is its mirror image.
    radius, reference_pressure : float
        R₀, m, and P₀, Pa.
    density, kinematic_viscosity : float
        ρ, kg/m³, and μ/ρ, m²/s.
    compliance : ndarray (n_x, n_phi)
        dR/dP = R₀²/β of a linear wall, m/Pa.
    table : ndarray (n_x, n_phi, m, 2)
        R (m) and dR/dP (m/Pa) of a nonlinear wall at equidistant pressures; m = 0 for a linear wall.
    table_start, table_step : float
        First pressure of the table and spacing, Pa.
    fixed_exponent : float
        γ everywhere, or 0 for the continuity closure.
    inlet_kind, outlet_kind : int
        See the constants above.
    resistance : float
        R_res, or the Windkessel's R₁, Pa s/m³.
    distal_resistance, capacitance, venous_pressure : float
        The Windkessel's R₂, Pa s/m³, C, m³/Pa, and P_v, Pa.
    """

    dx: float
    dphi: float
    sector: float
    mirrored: bool
    radius: float
    reference_pressure: float
    density: float
    kinematic_viscosity: float
    compliance: Floats
    table: Floats
    table_start: float
    table_step: float
    fixed_exponent: float
    inlet_kind: int
    outlet_kind: int
    resistance: float
    distal_resistance: float
    capacitance: float
    venous_pressure: float


class Stepping(NamedTuple):
    """Δt (s), implicitness θ in [½, 1], relative tolerance and most sweeps of a step's iteration."""

    time_step: float
    theta: float
    tolerance: float
    max_sweeps: int


class Fields(NamedTuple):
    """The state that a step advances in place.

    ``area`` A and ``pressure`` P (n_x, n_phi), m² and Pa; ``flow`` Q (n_x + 1, n_phi), m³/s;
    ``inlet_pressure`` and ``outlet_pressure`` (n_phi,), Pa; ``reservoir`` (1,), the Windkessel's P_c, Pa.
    """

    area: Floats
    flow: Floats
    pressure: Floats
    inlet_pressure: Floats
    outlet_pressure: Floats
    reservoir: Floats


class Workspace(NamedTuple):
    """Scratch of a run; (n_x, n_phi) at cells, (n_x + 1, n_phi) on faces, (n_phi,) per row.

    A mean is the θ-weighted one of the old state and the iterate.
    """

    iterate_pressure: Floats  # cells: P of the iterate
    iterate_area: Floats  # cells
    area_slope: Floats  # cells: dA/dP of the iterate
    mean_area: Floats  # cells
    mean_pressure: Floats  # cells
    held_area: Floats  # cells: A' if Q' were 0
    momentum_flux: Floats  # cells: αQ²/A
    correction: Floats  # cells: P' − P of the iterate
    inverse_pivot: Floats  # cells
    iterate_flow: Floats  # faces
    mean_flow: Floats  # faces
    alpha: Floats  # faces
    damping: Floats  # faces: Δt S
    explicit_flow: Floats  # faces: G at the iterate's pressure
    conductance: Floats  # faces: κ
    inverse_area: Floats  # faces
    velocity: Floats  # faces
    face_area: Floats  # faces: mean
    inverse_share: Floats  # faces: D/u
    axis_velocity: Floats  # (n_x + 1,): D
    end_pressure: Floats  # (2, n_phi): the iterate's at inlet and outlet
    end_area: Floats  # (2, n_phi): mean, from the end pressures
    old_end_area: Floats  # (2, n_phi)
    end_slope: Floats  # (2, n_phi): dA/dP
    law: Floats  # (2, n_phi): outlet pressure = law[0] + law[1] × flow
    exchanged: Floats  # (2,): volumes that passed inlet and outlet since last reset, m³


def joined(shapes: Shapes) -> Floats:
    """Zeros of one array that holds parts of these shapes, see :func:`split`; it begins on a cache line."""
    size = sum(_room(shape) for shape in shapes)
    buffer = np.zeros(size + CACHE_LINE // 8)
    start = -buffer.ctypes.data % CACHE_LINE // 8
    return buffer[start : start + size]


def split(whole: Floats, shapes: Shapes) -> list[Floats]:
    """Views (..., *shape) of the parts of ``whole`` (..., size); each begins on a cache line if that does."""
    parts, start = [], 0
    for shape in shapes:
        part = whole[..., start : start + prod(shape)]
        parts.append(part.reshape(*whole.shape[:-1], *shape))
        start += _room(shape)
    return parts


def _room(shape: tuple[int, ...]) -> int:
    """Numbers from one part's begin to the next."""
    line = CACHE_LINE // 8
    return -(-prod(shape) // line) * line


def arrays(shapes: Shapes) -> list[Floats]:
    """Zeros of these shapes, each of which begins on a cache line: no vector of a row straddles two."""
    return split(joined(shapes), shapes)


def workspace(n_x: int, n_phi: int) -> Workspace:
    """Allocate the scratch of a run."""
    cells, faces = (n_x, n_phi), (n_x + 1, n_phi)
    shapes = [*[cells] * 9, *[faces] * 10, (n_x + 1,), *[(2, n_phi)] * 5, (2,)]
    return Workspace(*arrays(shapes))
