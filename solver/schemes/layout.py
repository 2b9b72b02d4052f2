"""What the semi-implicit kernels share: status codes, kinds, and the arrays they work on (SI)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

OK = 0
NO_ADMISSIBLE_PROFILE = 1
WALL_COLLAPSE = 2
NOT_CONVERGED = 3
NOT_FINITE = 4
BEYOND_WALL_TABLE = 5

VELOCITY_INLET, FLOW_INLET, PRESSURE_INLET = 0, 1, 2
SECTION_RESISTANCE, ROW_RESISTANCE, WINDKESSEL, NON_REFLECTING = 0, 1, 2, 3

CACHE_LINE = 64  # bytes
REST_VELOCITY = 1e-9  # m/s: a section slower than this is at rest and has γ = 2

Array = NDArray[np.float64]


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
    compliance: Array
    table: Array
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

    area: Array
    flow: Array
    pressure: Array
    inlet_pressure: Array
    outlet_pressure: Array
    reservoir: Array


class Workspace(NamedTuple):
    """Scratch of a run; (n_x, n_phi) at cells, (n_x + 1, n_phi) on faces, (n_phi,) per row.

    A mean is the θ-weighted one of the old state and the iterate.
    """

    iterate_pressure: Array  # cells: P of the iterate
    iterate_area: Array  # cells
    area_slope: Array  # cells: dA/dP of the iterate
    mean_area: Array  # cells
    mean_pressure: Array  # cells
    held_area: Array  # cells: A' if Q' were 0
    momentum_flux: Array  # cells: αQ²/A
    correction: Array  # cells: P' − P of the iterate
    inverse_pivot: Array  # cells
    iterate_flow: Array  # faces
    mean_flow: Array  # faces
    alpha: Array  # faces
    damping: Array  # faces: Δt S
    explicit_flow: Array  # faces: G at the iterate's pressure
    conductance: Array  # faces: κ
    inverse_area: Array  # faces
    velocity: Array  # faces
    face_area: Array  # (n_x + 1, n_phi + 2): mean, with periodic ghosts
    inverse_share: Array  # (n_x + 1, n_phi + 2): D/u, with periodic ghosts
    axis_velocity: Array  # (n_x + 1,): D
    end_pressure: Array  # (2, n_phi): the iterate's at inlet and outlet
    end_area: Array  # (2, n_phi): mean, from the end pressures
    old_end_area: Array  # (2, n_phi)
    end_slope: Array  # (2, n_phi): dA/dP
    law: Array  # (2, n_phi): outlet pressure = law[0] + law[1] × flow
    exchanged: Array  # (2,): volumes that passed inlet and outlet since last reset, m³


def aligned(shape: tuple[int, ...]) -> Array:
    """Zeros that begin on a cache line, so that no vector of a row straddles two."""
    size = int(np.prod(shape))
    buffer = np.zeros(size + CACHE_LINE // 8)
    start = -buffer.ctypes.data % CACHE_LINE // 8
    return buffer[start : start + size].reshape(shape)


def workspace(n_x: int, n_phi: int) -> Workspace:
    """Allocate the scratch of a run."""
    cells, faces, ghosted = (n_x, n_phi), (n_x + 1, n_phi), (n_x + 1, n_phi + 2)
    shapes = [*[cells] * 9, *[faces] * 8, *[ghosted] * 2, (n_x + 1,), *[(2, n_phi)] * 5, (2,)]
    return Workspace(*(aligned(shape) for shape in shapes))
