"""Set-ups of the Godunov scheme that its tests share."""

import numpy as np

from solver.geometry.grid import Grid
from solver.marching.godunov_setup import State, held
from solver.wall.smooth_patch import smooth_wall
from validation.tables.artery import DIASTOLE, HEALTHY, LENGTH, RADIUS, artery, plaque

SOFT = 1.2 * HEALTHY  # a plaque so mild that a sudden start turns no row backwards


def local(n_x=40, n_phi=12, time_step=9e-6, patch=None, **changes):
    """Mild local calcification on a coarse grid."""
    wall = smooth_wall(Grid(LENGTH, n_x, n_phi), patch or plaque(np.pi / 2), HEALTHY, SOFT)
    return artery(n_x, n_phi, time_step, None, wall=wall, **changes)


def flowing(setup, pressure=10.2e3, velocity=DIASTOLE):
    """State of one pressure (Pa) and one velocity (m/s)."""
    area = (RADIUS + pressure * RADIUS**2 / setup.wall.stiffness) ** 2
    return State(0.0, area, velocity * area, np.full_like(area, 2.0))


def at_rest(**changes):
    """Fields of a closed artery: no pressure at the inlet, a non-reflecting outlet."""
    return {
        "inlet_kind": "pressure",
        "inlet": held(0.0),
        "outlet_kind": "non_reflecting",
        **changes,
    }
