"""Everything that determines a run of the reduced model, and its state, in SI."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.model.boundary import Inlet, Outlet
from solver.model.profiles import TwoModes
from solver.wall.sections import SectionWall
from solver.wall.stiffness import area_from_pressure, pressure_from_area
from solver.wall.table import WallTable


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
        Wall stiffness β, Pa m; of a nonlinear wall its value at P₀.
    inlet : Inlet
        Inlet law.
    outlet : Outlet
        Outlet law.
    wall_table : WallTable or None
        R(P) of a nonlinear wall; None for P = P₀ + β (R − R₀)/R₀².
    fixed_exponent : float or None
        γ everywhere, for the 1D model (n_phi = 1); None for the continuity closure.
    section_wall : SectionWall or None
        A(P) where all rows of a section share one pressure; None where each row has its own.
    two_modes : TwoModes or None
        Velocity profiles of two modes; None for those of one exponent γ.
    """

    grid: Grid
    radius: float
    density: float
    viscosity: float
    reference_pressure: float
    stiffness: Floats
    inlet: Inlet
    outlet: Outlet
    wall_table: WallTable | None = None
    fixed_exponent: float | None = None
    section_wall: SectionWall | None = None
    two_modes: TwoModes | None = None

    def __post_init__(self) -> None:
        shape = (self.grid.n_x, self.grid.n_phi)
        if self.stiffness.shape != shape:
            raise ModelError(f"stiffness has shape {self.stiffness.shape}; the grid needs {shape}")
        if not np.all(np.isfinite(self.stiffness) & (self.stiffness > 0)):
            raise ModelError("stiffness must be finite and positive in every cell")
        if self.wall_table is not None and self.wall_table.values.shape[:2] != shape:
            raise ModelError(f"the wall's table has cells {self.wall_table.values.shape[:2]}, not {shape}")
        if self.section_wall is not None and self.section_wall.shape != shape:
            raise ModelError(f"the sections' wall has cells {self.section_wall.shape}, not {shape}")
        for name in ("radius", "density"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ModelError(f"{name} = {getattr(self, name)}; allowed: positive and finite")
        if not (np.isfinite(self.viscosity) and self.viscosity >= 0):
            raise ModelError(f"viscosity = {self.viscosity}; allowed: 0 or more, finite")
        if not np.isfinite(self.reference_pressure):
            raise ModelError(f"reference pressure = {self.reference_pressure}; allowed: a finite pressure")
        if self.fixed_exponent is not None:
            self._check_exponent(self.fixed_exponent)

    def _check_exponent(self, exponent: float) -> None:
        if self.grid.n_phi != 1:
            raise ModelError(f"a fixed exponent needs n_phi = 1, found {self.grid.n_phi}")
        if not (np.isfinite(exponent) and exponent > 0):
            raise ModelError(f"exponent = {exponent}; allowed: positive and finite")

    def area(self, pressure: Floats | float) -> Floats:
        """Return A = R² in every cell at a pressure (broadcast to the grid), m².

        Raises
        ------
        ModelError
            Where the lumen collapses, or beyond the wall's table.
        """
        everywhere = np.broadcast_to(np.asarray(pressure, dtype=float), self.stiffness.shape)
        if self.section_wall is not None:
            return self.section_wall.area(everywhere.mean(axis=1))
        if self.wall_table is not None:
            return self.wall_table.area(everywhere)
        return area_from_pressure(everywhere, self.stiffness, self.radius, self.reference_pressure)

    def pressure(self, area: Floats) -> Floats:
        """P in every cell, (..., n_x, n_phi), Pa: the inverse of :meth:`area`."""
        if self.section_wall is not None:
            flat = area.reshape(-1, *self.stiffness.shape)
            sections = np.stack([self.section_wall.pressure(one) for one in flat])
            return np.broadcast_to(sections[..., None], flat.shape).reshape(area.shape)
        if self.wall_table is not None:
            return self.wall_table.pressure(area)
        return pressure_from_area(area, self.stiffness, self.radius, self.reference_pressure)


@dataclass
class State:
    """Unknowns at one time. Pressures left out follow from area and flow.

    Attributes
    ----------
    time : float
        s.
    area : ndarray (n_x, n_phi)
        A = R² at cell centres, m².
    flow : ndarray (n_x + 1, n_phi)
        Q = uR² on faces, from inlet to outlet, m³/s.
    pressure : ndarray (n_x, n_phi) or None
        P at cell centres, Pa.
    inlet_pressure, outlet_pressure : ndarray (n_phi,) or None
        P at the ends, Pa.
    reservoir : float or None
        P_c of a Windkessel, Pa.
    axis_velocity : ndarray (n_x + 1,) or None
        D on faces, m/s, where it is an unknown of its own.
    """

    time: float
    area: Floats
    flow: Floats
    pressure: Floats | None = None
    inlet_pressure: Floats | None = None
    outlet_pressure: Floats | None = None
    reservoir: float | None = None
    axis_velocity: Floats | None = None

    def copy(self) -> "State":
        """Return an independent copy."""

        def copied(part: Floats | None) -> Floats | None:
            return None if part is None else part.copy()

        return State(
            self.time,
            self.area.copy(),
            self.flow.copy(),
            copied(self.pressure),
            copied(self.inlet_pressure),
            copied(self.outlet_pressure),
            self.reservoir,
            copied(self.axis_velocity),
        )


class States(NamedTuple):
    """States at times (n,), s, one after another; parts as those of :class:`State`, (n, …)."""

    times: Floats
    area: Floats
    flow: Floats
    pressure: Floats
    inlet_pressure: Floats
    outlet_pressure: Floats
    reservoir: Floats
    axis_velocity: Floats | None = None

    def at(self, k: int) -> State:
        """State k; its arrays are views."""
        return State(
            float(self.times[k]),
            self.area[k],
            self.flow[k],
            self.pressure[k],
            self.inlet_pressure[k],
            self.outlet_pressure[k],
            float(self.reservoir[k]),
            None if self.axis_velocity is None else self.axis_velocity[k],
        )


def uniform_state(model: Model, pressure: float, velocity: float) -> State:
    """State of one pressure (Pa) everywhere and one mean velocity (m/s) times the inlet's area.

    Raises
    ------
    ModelError
        Where that pressure collapses the lumen.
    """
    area = model.area(pressure)
    flow = np.broadcast_to(velocity * area[0], (model.grid.n_x + 1, model.grid.n_phi)).copy()
    ends = np.full(model.grid.n_phi, float(pressure))
    return State(0.0, area, flow, np.full(area.shape, float(pressure)), ends.copy(), ends, float(pressure))
