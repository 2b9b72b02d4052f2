"""Everything that determines a run of the reduced model, in SI."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import ModelError
from solver.grid import Grid
from solver.waveform import Waveform


@dataclass(frozen=True)
class ResistanceOutlet:
    """P = P_res + R_res × flow (2.1.1).

    Attributes
    ----------
    resistance : float
        R_res, Pa s/m³.
    offset : float
        P_res, Pa.
    flow : str
        "section": the section's flow rate q = ½∮Q dφ and one outlet pressure; "row": each row's own
        Q = uR², as the thesis's code does.
    """

    resistance: float
    offset: float
    flow: str = "section"

    def __post_init__(self) -> None:
        if self.flow not in ("section", "row"):
            raise ModelError(f"outlet flow {self.flow!r}; allowed: section, row")
        if not self.resistance >= 0:
            raise ModelError(f"outlet resistance = {self.resistance} Pa s/m³; allowed: 0 or more")


@dataclass(frozen=True)
class Model:
    """Parameters of one run.

    Attributes
    ----------
    grid : Grid
        Cells on (x, φ).
    radius : float
        Reference lumen radius R₀, m.
    density, viscosity : float
        Blood's ρ, kg/m³, and μ, Pa s.
    reference_pressure : float
        P₀, the pressure at which R = R₀, Pa.
    stiffness : ndarray (n_x, n_phi)
        Wall stiffness β, Pa m.
    inlet_velocity : Waveform
        Mean velocity at the inlet, m/s.
    outlet : ResistanceOutlet
        Outlet law.
    """

    grid: Grid
    radius: float
    density: float
    viscosity: float
    reference_pressure: float
    stiffness: NDArray[np.float64]
    inlet_velocity: Waveform
    outlet: ResistanceOutlet

    def __post_init__(self) -> None:
        shape = (self.grid.n_x, self.grid.n_phi)
        if self.stiffness.shape != shape:
            raise ModelError(f"stiffness has shape {self.stiffness.shape}; the grid needs {shape}")
        if not np.all(np.isfinite(self.stiffness) & (self.stiffness > 0)):
            raise ModelError("stiffness must be finite and positive in every cell")
        for name in ("radius", "density"):
            if not getattr(self, name) > 0:
                raise ModelError(f"{name} = {getattr(self, name)}; allowed: positive")
        if not self.viscosity >= 0:
            raise ModelError(f"viscosity = {self.viscosity}; allowed: 0 or more")


@dataclass
class State:
    """Unknowns at one time.

    Attributes
    ----------
    time : float
        s.
    area : ndarray (n_x, n_phi)
        A = R² at cell centres, m².
    flow : ndarray (n_x + 1, n_phi)
        Q = uR² on faces, from inlet to outlet, m³/s.
    """

    time: float
    area: NDArray[np.float64]
    flow: NDArray[np.float64]

    def copy(self) -> "State":
        """Return an independent copy."""
        return State(self.time, self.area.copy(), self.flow.copy())


def uniform_state(model: Model, pressure: float, velocity: float) -> State:
    """State of one pressure (Pa) everywhere and one mean velocity (m/s) times the inlet's area."""
    from_wall = model.radius + (pressure - model.reference_pressure) * model.radius**2 / model.stiffness
    area = from_wall**2
    flow = np.broadcast_to(velocity * area[0], (model.grid.n_x + 1, model.grid.n_phi)).copy()
    return State(0.0, area, flow)
