"""How the Godunov scheme lays its fields out in memory, and the names of its choices.

A field is one flat float64 array of ``n_x + 2`` columns: column 0 lies **on** the inlet, column i is cell
i (counted from 1), column n_x + 1 lies **on** the outlet. Within a column the rows j = 1 … n_phi are
contiguous; with more than one row a ghost on either side holds the periodic neighbour, so that a sweep
in x or φ is one loop over the flat array. Interfaces are laid out alike: interface f, from 0 (inlet) to
n_x (outlet), lies left of cell f + 1.
"""

from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.schemes.vectorisation import exact_kernel

UPWIND, LAX_WENDROFF, VAN_LEER, SUPERBEE, MINMOD, MONOTONIZED_CENTRAL = range(6)
FIXED, AVERAGE, MAXIMUM, LEAST_SQUARES = range(4)
VELOCITY_INLET, PRESSURE_INLET, FLOW_INLET = range(3)
ROW_RESISTANCE, SECTION_RESISTANCE, NON_REFLECTING, WINDKESSEL = range(4)
OK, NO_ADMISSIBLE_PROFILE, WALL_COLLAPSE, STEADY = range(4)

AVERAGE_AXIS_RATIO = 2.0  # (γ_avg + 2)/γ_avg with γ_avg = 2, (2.2.56)
PARABOLIC = 2.0  # γ of Poiseuille flow
REST_VELOCITY = 1e-12  # m/s: a section slower than this in every row is at rest


class Parameters(NamedTuple):
    """Scalars of one run, SI.

    ``has_inlet`` and ``has_outlet`` tell whether the first and last column lie on the artery's ends or
    are frozen copies of a neighbouring slab's.
    """

    columns: int
    n_phi: int
    ghosts: int
    dt: float
    dx: float
    dphi: float
    radius: float
    density: float
    kinematic_viscosity: float
    reference_pressure: float
    resistance: float
    distal_resistance: float
    capacitance: float
    venous_pressure: float
    inlet: int
    outlet: int
    limiter: int
    closure: int
    printed_exchange: bool
    printed_gradient: bool
    has_inlet: bool
    has_outlet: bool


class Fields(NamedTuple):
    """State and wall, flat arrays of columns × stride.

    ``root`` is √A and ``inverse_root`` 1/√A; ``stiffness`` β (Pa m) and its derivative ``stiffness_slope``
    ∂_xβ (Pa) are those of the present instant; ``fastest`` is the largest |λ| yet met on each interface.
    ``reservoir`` (1,) is the pressure P_c of a Windkessel's capacitor, Pa.
    """

    area: Floats
    flow: Floats
    exponent: Floats
    root: Floats
    inverse_root: Floats
    stiffness: Floats
    stiffness_slope: Floats
    fastest: Floats
    reservoir: Floats


class Ramp(NamedTuple):
    """Two walls between which β moves by a load curve: β = first + load·(last − first)."""

    first: Floats
    last: Floats
    first_slope: Floats
    last_slope: Floats


class Workspace(NamedTuple):
    """Scratch of a step, flat arrays of columns × stride; what the stopping criteria compare; what passed."""

    slow_speed: Floats
    fast_speed: Floats
    slow_strength: Floats
    fast_strength: Floats
    to_left_area: Floats
    to_left_flow: Floats
    to_right_area: Floats
    to_right_flow: Floats
    exponent_slope: Floats
    velocity: Floats
    area_before: Floats
    flow_before: Floats
    passed: Floats  # (2,): sums of the section's flow rate on inlet and outlet after each step, m³/s


def stride(n_phi: int) -> int:
    """Entries of one column: the rows and, if there is more than one, two periodic ghosts."""
    return n_phi + 2 if n_phi > 1 else 1


def workspace(columns: int, n_phi: int) -> Workspace:
    """Scratch for ``columns`` columns (ends included) of ``n_phi`` rows."""
    size = columns * stride(n_phi)
    scratch = {name: np.zeros(size) for name in Workspace._fields}
    return Workspace(**(scratch | {"passed": np.zeros(2)}))


def flattened(values: Floats) -> Floats:
    """Lay a field (columns, n_phi) out flat, ghosts filled."""
    wide = np.asarray(values, dtype=float)
    if wide.shape[1] > 1:
        wide = np.concatenate((wide[:, -1:], wide, wide[:, :1]), axis=1)
    return np.ascontiguousarray(wide).ravel()


def unflattened(flat: Floats, columns: int, n_phi: int) -> Floats:
    """Inverse of :func:`flattened`: a copy of the field, (columns, n_phi), without ghosts."""
    wide = flat.reshape(columns, stride(n_phi))
    return np.array(wide[:, 1:-1] if n_phi > 1 else wide)


@exact_kernel
def fill_ghosts(values: Floats, columns: int, n_phi: int) -> None:
    """Copy the last row before the first and the first behind the last, in every column."""
    width = n_phi + 2
    for i in range(columns):
        first = i * width
        values[first] = values[first + n_phi]
        values[first + n_phi + 1] = values[first + 1]
