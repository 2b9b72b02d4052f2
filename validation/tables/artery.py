"""The artery of the thesis as the Godunov scheme's set-up, and the thesis's numbers as tables."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from solver.geometry.calcification import Patch
from solver.geometry.grid import Grid
from solver.marching.godunov import march_to_steady, thesis_criteria
from solver.marching.godunov_setup import Setup, State, held, load, reference_state, repeated
from solver.model.waveform import Waveform
from solver.wall.smooth_patch import smooth_wall

REFERENCE_DATA = Path(__file__).parents[2] / "reference_data"

LENGTH, RADIUS, DENSITY, VISCOSITY = 15e-3, 2.5e-3, 1060.0, 0.003
HEALTHY, CALCIFIED = 400.0, 20000.0 / 3  # β = (4/3) E h of 0.6 and 10 MPa, Pa m
DIASTOLE = 0.0841199  # m/s
STEADY_OUTLET = (1.358e9, 9330.0)  # R_res, Pa s/m³, on Q = uR² of each row; P_res, Pa
PULSATILE_OUTLET = (5.7817e9, 7205.2)
QUARTER_CM = 2.5e-3  # ξ^x, m
RING = (5e-3, 10e-3)
SECTOR = (0.75 * np.pi, 1.25 * np.pi)
FINE_STEP = 3.125e-6  # s, with n_x = 120
LONGEST = 3.0  # s: no steady state takes longer
PRINTED = {"viscous_exchange": "printed", "exponent_gradient": "printed"}
CM3 = 1e6  # cm³ in a m³


def thesis_table(number: str) -> pd.DataFrame:
    """Return a table of the thesis, such as "3_1"."""
    return pd.read_csv(REFERENCE_DATA / "thesis" / f"table_{number}.csv")


def quoted(quantity: str, model: str) -> float:
    """Return a number that the thesis quotes of its 2D simulations, in the unit of quoted_values.csv."""
    table = pd.read_csv(REFERENCE_DATA / "thesis" / "quoted_values.csv")
    chosen = (table["quantity"] == quantity) & (table["model"] == model) & (table["simulation"] == "2D")
    return float(table.loc[chosen, "value"].iloc[0])


@cache
def thesis_waveform() -> Waveform:
    """Inlet velocity over one cycle, m/s."""
    points = pd.read_csv(REFERENCE_DATA / "waveforms" / "thesis_inlet.csv")
    return Waveform(points["t_s"].to_numpy(float), points["mean_velocity_cm_s"].to_numpy(float) / 100)


def ring(transition: float) -> Patch:
    """Axisymmetric calcification with ξ^x (m)."""
    return Patch(RING, x_transition=transition)


def plaque(phi_transition: float) -> Patch:
    """Local calcification with ξ^x = 2.5 mm and ξ^φ (rad)."""
    return Patch(RING, SECTOR, QUARTER_CM, phi_transition)


def artery(n_x: int, n_phi: int, time_step: float, patch: Patch | None, **changes: Any) -> Setup:
    """Set up diastolic velocity at the inlet and the steady outlet; ``changes`` are fields of the set-up."""
    grid = Grid(LENGTH, n_x, n_phi)
    resistance, offset = STEADY_OUTLET
    values: dict[str, Any] = {
        "grid": grid,
        "time_step": time_step,
        "radius": RADIUS,
        "density": DENSITY,
        "viscosity": VISCOSITY,
        "wall": smooth_wall(grid, patch, HEALTHY, CALCIFIED),
        "inlet_kind": "velocity",
        "inlet": held(DIASTOLE),
        "outlet_kind": "row",
        "resistance": resistance,
        "offset": held(offset),
    }
    return Setup(**(values | changes))


def calcifying(n_phi: int, duration: float) -> dict[str, Any]:
    """Fields of a set-up with n_x = 120 whose wall grows from healthy over ``duration`` s (3.3.2)."""
    return {
        "wall_before": smooth_wall(Grid(LENGTH, 120, n_phi), None, HEALTHY, CALCIFIED),
        "wall_load": load(0.0, duration, 0.0, 1.0),
    }


@cache
def healthy_steady_state(outlet: tuple[float, float]) -> State:
    """Steady state without calcification, n_x = 120, one row, at t = 0."""
    resistance, offset = outlet
    setup = artery(120, 1, FINE_STEP, None, resistance=resistance, offset=held(offset))
    steady = march_to_steady(setup, reference_state(setup), thesis_criteria("flow"), longest=LONGEST)
    return repeated(steady.state, 1)


def flow_range(state: State) -> float:
    """ε_Q = max Q − min Q over the cells, cm³/s (3.2.1)."""
    cells = state.flow[1:-1]
    return float(cells.max() - cells.min()) * CM3
