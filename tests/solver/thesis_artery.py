"""The thesis's artery (thin wall, SI) and the case data that several tests of the solver share."""

from pathlib import Path

import numpy as np

from cases.values.waveform_file import read_waveform
from solver.geometry.calcification import Patch, calcified_stiffness, scaled_distance
from solver.geometry.grid import Grid
from solver.model.boundary import Inlet, ResistanceOutlet
from solver.model.parameters import Model
from solver.model.waveform import Waveform, constant
from solver.wall.stiffness import pressure_from_area

REFERENCE_DATA = Path(__file__).parents[2] / "reference_data"

LENGTH, RADIUS, DENSITY, VISCOSITY = 15e-3, 2.5e-3, 1060.0, 0.003
HEALTHY, CALCIFIED = 400.0, 20000.0 / 3  # β = (4/3) E h for 0.6 and 10 MPa, N/m
DIASTOLE = 0.0841199  # m/s

STEADY_OUTLET = ResistanceOutlet(1.358e9, 9330.0, "row")
PULSATILE_OUTLET = ResistanceOutlet(5.7817e9, 7205.2, "row")
SECTION_OUTLET = ResistanceOutlet(1.358e9, 9330.0, "section")

RING = (5e-3, 10e-3)
SECTOR = (0.75 * np.pi, 1.25 * np.pi)
PATTERNS = {
    "none": None,
    "axisymmetric, sharp": Patch(RING),
    "axisymmetric, smooth": Patch(RING, x_transition=2.5e-3),
    "local, sharp": Patch(RING, SECTOR),
    "local, smooth": Patch(RING, SECTOR, 2.5e-3, 0.375 * np.pi),
}


def thesis_waveform():
    read = read_waveform(REFERENCE_DATA / "waveforms" / "thesis_inlet.csv")
    return Waveform(read.times, read.values)


def patched(grid, patch, calcified=CALCIFIED):
    """β of a calcified patch in the thesis's healthy wall, (n_x, n_phi)."""
    if patch is None:
        return np.full((grid.n_x, grid.n_phi), HEALTHY)
    return calcified_stiffness(HEALTHY, calcified, scaled_distance(grid, patch))


def artery(n_x, n_phi, *, outlet=SECTION_OUTLET, inlet=None, patch=None, stiffness=None, **changes):
    """Model of the thesis's artery; ``inlet`` is an Inlet or the signal of a velocity inlet.

    ``changes`` are fields of Model, or ``length``.
    """
    grid = Grid(changes.pop("length", LENGTH), n_x, n_phi)
    values = {
        "grid": grid,
        "radius": RADIUS,
        "density": DENSITY,
        "viscosity": VISCOSITY,
        "reference_pressure": 0.0,
        "stiffness": patched(grid, patch) if stiffness is None else stiffness,
        "inlet": inlet if isinstance(inlet, Inlet) else Inlet("velocity", inlet or constant(DIASTOLE, 1.0)),
        "outlet": outlet,
    }
    return Model(**(values | changes))


def pressure(model, area):
    return pressure_from_area(area, model.stiffness, model.radius, model.reference_pressure)


def section_flow(trajectory):
    """Flow rate ½∮Q dφ through each section of cells, (n_times, n_x), m³/s."""
    at_cells = 0.5 * (trajectory.flow[:, 1:] + trajectory.flow[:, :-1])
    return np.pi * at_cells.mean(axis=-1)
