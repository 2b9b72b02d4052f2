"""The arrays that the scheme with one pressure a section works on (SI)."""

from typing import NamedTuple

from cases.arrays import Floats
from solver.schemes.layout import arrays


class Parameters(NamedTuple):
    """Constants of a run.

    Attributes
    ----------
    dx, dphi : float
        m, rad.
    density, kinematic_viscosity : float
        ρ, kg/m³, and μ/ρ, m²/s.
    table : ndarray (n_x, knots, 2, n_phi)
        A (m²) and dA/dP (m²/Pa) of every cell at equidistant pressures.
    sums : ndarray (n_x, knots, 2)
        Their sums over φ.
    table_start, table_step : float
        First pressure of the table and spacing, Pa.
    fixed_exponent : float
        γ everywhere, or 0 for the continuity closure.
    rest_flow : float
        Q below which blood is at rest, m³/s.
    inlet_kind, outlet_kind : int
        See :mod:`solver.schemes.layout`.
    resistance : float
        R_res, or the Windkessel's R₁, Pa s/m³.
    distal_resistance, capacitance, venous_pressure : float
        The Windkessel's R₂, Pa s/m³, C, m³/Pa, and P_v, Pa.
    """

    dx: float
    dphi: float
    density: float
    kinematic_viscosity: float
    table: Floats
    sums: Floats
    table_start: float
    table_step: float
    fixed_exponent: float
    rest_flow: float
    inlet_kind: int
    outlet_kind: int
    resistance: float
    distal_resistance: float
    capacitance: float
    venous_pressure: float


class Fields(NamedTuple):
    """The state that a step advances in place.

    ``area`` A (n_x, n_phi), m²; ``flow`` Q (n_x + 1, n_phi), m³/s; ``pressure`` P (n_x + 2,), Pa: the
    inlet's, the sections' and the outlet's; ``reservoir`` (1,), the Windkessel's P_c, Pa.
    """

    area: Floats
    flow: Floats
    pressure: Floats
    reservoir: Floats


class Workspace(NamedTuple):
    """Scratch of a run."""

    iterate_flow: Floats  # faces: Q'
    iterate_area: Floats  # cells: A(P')
    mean_area: Floats  # cells: θ-weighted A
    mean_flow: Floats  # faces: θ-weighted Q
    face_area: Floats  # faces: θ-weighted, with periodic ghosts
    velocity: Floats  # faces: u, with periodic ghosts
    alpha: Floats  # faces
    damping: Floats  # faces: Δt S
    flux: Floats  # cells: αQ²/A
    cross_flow: Floats  # (n_x, n_phi + 1): W on the φ-faces of cells
    residual: Floats  # faces: momentum balance, then δQ
    older_flow: Floats  # faces: one step earlier, for the first iterate
    oldest_flow: Floats  # faces: two steps earlier
    old_end_area: Floats  # (2, n_phi): at inlet and outlet
    end_area: Floats  # (2, n_phi): of the iterate
    scratch: Floats  # (5, n_phi + 2)
    iterate_pressure: Floats  # (n_x + 2,)
    older_pressure: Floats
    oldest_pressure: Floats
    old_area_sum: Floats  # (n_x,): Σ A
    area_sum: Floats  # (n_x,): Σ A(P')
    slope_sum: Floats  # (n_x,): Σ dA/dP
    mass: Floats  # (n_x,): mass balance, then δP
    flux_slope: Floats  # (n_x,): θ ∂(αQ²/A)/∂Q, mean over φ
    flow_sum: Floats  # (n_x + 1,): Σ of the θ-weighted Q
    old_flow_sum: Floats  # (n_x + 1,): Σ Q
    new_flow_sum: Floats  # (n_x + 1,): Σ Q'
    mean_damping: Floats  # (n_x + 1,)
    area_total: Floats  # (n_x + 1,): Σ A on faces
    total: Floats  # (n_x + 1,): Σ of the momentum balance over φ
    matrix: Floats  # (3, n_x + 1): lower, middle, upper of the rows' advection
    section_matrix: Floats  # (3, n_x + 1): the same with the pressure eliminated
    change: Floats  # (n_x + 1,): δΣQ
    exchanged: Floats  # (2,): volumes that passed inlet and outlet since last reset, m³


def workspace(n_x: int, n_phi: int) -> Workspace:
    """Allocate the scratch of a run."""
    cells, faces, ghosted, pair = (n_x, n_phi), (n_x + 1, n_phi), (n_x + 1, n_phi + 2), (2, n_phi)
    shapes: list[tuple[int, ...]] = [faces, cells, cells, faces, ghosted, ghosted, faces, faces, cells]
    shapes += [(n_x, n_phi + 1), faces, faces, faces, pair, pair, (5, n_phi + 2)]
    shapes += [(n_x + 2,)] * 3 + [(n_x,)] * 5 + [(n_x + 1,)] * 6
    shapes += [(3, n_x + 1)] * 2 + [(n_x + 1,), (2,)]
    return Workspace(*arrays(shapes))
