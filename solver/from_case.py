"""From a checked case to the model that the solver runs. The one module here that knows the case schema."""

import numpy as np
from numpy.typing import NDArray

from cases.schema import (
    AxialTransition,
    AxisymmetricCalcification,
    Case,
    LocalCalcification,
    NoCalcification,
    PatchTransition,
)
from solver.calcification import Patch, calcified_stiffness, scaled_distance
from solver.grid import Grid
from solver.boundary import Inlet, ResistanceOutlet
from solver.model import Model
from solver.wall import wall_stiffness
from solver.waveform import Waveform, constant

OUTPUTS_PER_CYCLE = 100  # where the case states no output_interval


def grid_of(case: Case) -> Grid:
    """Grid on (x, φ) of a case."""
    return Grid(case.geometry.length, case.solver.n_x, case.solver.n_phi)


def patch_of(case: Case) -> Patch | None:
    """Calcified rectangle of a case; None for a healthy wall."""
    stated = case.calcification
    if isinstance(stated, NoCalcification):
        return None
    transition = stated.transition
    return Patch(
        x=stated.x,
        phi=stated.phi if isinstance(stated, LocalCalcification) else None,
        x_transition=transition.x if isinstance(transition, AxialTransition | PatchTransition) else None,
        phi_transition=transition.phi if isinstance(transition, PatchTransition) else None,
    )


def calcified_cells(case: Case) -> NDArray[np.bool_]:
    """Whether each cell's centre lies in the calcified rectangle, (n_x, n_phi)."""
    grid, patch = grid_of(case), patch_of(case)
    if patch is None:
        return np.zeros((grid.n_x, grid.n_phi), dtype=bool)
    return np.asarray(scaled_distance(grid, patch) == 0)


def stiffness_of(case: Case) -> NDArray[np.float64]:
    """Wall stiffness β of a case in every cell, (n_x, n_phi), Pa m."""
    grid, patch = grid_of(case), patch_of(case)
    moduli = [case.wall.youngs_modulus]
    if isinstance(case.calcification, AxisymmetricCalcification | LocalCalcification):
        moduli.append(case.calcification.youngs_modulus)
    betas = wall_stiffness(
        case.wall.law,
        np.array(moduli),
        case.geometry.radius,
        case.geometry.wall_thickness,
        case.wall.poisson_ratio,
    )
    if patch is None:
        return np.full((grid.n_x, grid.n_phi), betas[0])
    return calcified_stiffness(betas[0], betas[1], scaled_distance(grid, patch))


def inlet_waveform(case: Case) -> Waveform:
    """Mean velocity at the inlet over one cycle, m/s."""
    inlet = case.inlet
    if inlet.waveform is not None:
        return Waveform(inlet.waveform.times, inlet.waveform.values)
    if inlet.value is None:  # the schema states exactly one of the two
        raise ValueError("an inlet states neither waveform nor value")
    return constant(inlet.value, inlet.period)


def model_of(case: Case) -> Model:
    """Model of a case, in SI.

    Raises
    ------
    ModelError
        For parameters outside what the equations allow.
    """
    return Model(
        grid=grid_of(case),
        radius=case.geometry.radius,
        density=case.blood.density,
        viscosity=case.blood.viscosity,
        reference_pressure=case.wall.reference_pressure,
        stiffness=stiffness_of(case),
        inlet=Inlet(case.inlet.kind, inlet_waveform(case)),
        outlet=ResistanceOutlet(case.outlet.resistance, case.outlet.offset, case.outlet.flow),
    )


def default_output_times(case: Case) -> NDArray[np.float64]:
    """Return the times of the saved states of a plain run, from 0 to the end of the last cycle, s."""
    duration = case.inlet.period * case.solver.cycles
    interval = case.solver.output_interval or case.inlet.period / OUTPUTS_PER_CYCLE
    whole = np.arange(0.0, duration * (1 - 1e-9), interval)
    return np.append(whole, duration)
