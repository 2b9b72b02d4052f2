"""What a run is watched by: Courant numbers, mass, the continuity condition and mechanical energy.

Evaluated at the states that are saved, outside the schemes. A limit that is exceeded stops the run.
"""

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.errors import AxisNotContinuous, CourantExceeded, EnergyNotBalanced, MassNotConserved, RunFailure
from solver.model.parameters import Model
from solver.model.two_mode_balance import two_mode_balance
from solver.schemes.rows.balance import balance, linear_wall
from solver.schemes.walls import tabulated_area
from solver.wall.sections import SectionWall

GAUSS_POINTS = 6  # of ∫A dP for a tabulated wall
HISTORY = 3  # earlier states that the energy balance interpolates the powers through
MOMENTS = np.array([(-1.0) ** n / (n + 1) for n in range(HISTORY + 1)])  # of powers over the last interval


@dataclass(frozen=True)
class Limits:
    """Largest values allowed; None for no limit.

    Attributes
    ----------
    courant_number, advective_courant_number : float or None
        max|λ±|Δt/Δx and max|u|Δt/Δx.
    mass_defect : float or None
        |inflow − outflow − dV/dt| over the inflow.
    continuity_residual : float or None
        Largest relative distance of the axis velocity from its section's mean.
    energy_defect : float or None
        Power that the balance of mechanical energy misses, over the largest exchange of power so far.
    """

    courant_number: float | None = None
    advective_courant_number: float | None = None
    mass_defect: float | None = None
    continuity_residual: float | None = None
    energy_defect: float | None = None


FAILURES: dict[str, type[RunFailure]] = {
    "courant_number": CourantExceeded,
    "advective_courant_number": CourantExceeded,
    "mass_defect": MassNotConserved,
    "continuity_residual": AxisNotContinuous,
    "energy_defect": EnergyNotBalanced,
}


class Columns(NamedTuple):
    """A state on inlet, cells and outlet: A, m², Q, m³/s, γ and P, Pa, all (n_x + 2, n_phi).

    With profiles of two modes D (n_x + 2,), m/s, stands for γ, which is 2 then.
    """

    area: Floats
    flow: Floats
    exponent: Floats
    pressure: Floats
    axis_velocity: Floats | None = None


class Diagnostics(NamedTuple):
    """Values of one state, as in the table of fields; J, W and ratios.

    ``energy_defect`` is NaN where the states before do not resolve the powers over time.
    """

    courant_number: float
    advective_courant_number: float
    mass_defect: float
    continuity_residual: float
    kinetic_energy: float
    wall_energy: float
    end_power: float
    dissipated_power: float
    profile_power: float
    energy_defect: float


def by_name(taken: list[Diagnostics]) -> dict[str, Floats]:
    """Diagnostics of several states as arrays (n,), by name."""
    columns = zip(*taken, strict=True)
    return {name: np.array(values) for name, values in zip(Diagnostics._fields, columns, strict=True)}


class Monitor:
    """Evaluates states in the order of time and stops a run that exceeds a limit.

    Parameters
    ----------
    model : Model
    limits : Limits
    resolved : float
        Longest time between states over which powers are integrated, s.
    history : ndarray (k, 6), optional
        :attr:`history` of the monitor of the run that is continued.

    Attributes
    ----------
    history : ndarray (k, 6)
        Time, s, energy, J, end, dissipated and profile power, W, and the largest exchange of power so far, W,
        of up to three states before.
    """

    def __init__(
        self, model: Model, limits: Limits, resolved: float = np.inf, history: Floats | None = None
    ) -> None:
        self.model, self.resolved = model, resolved
        self.history: Floats = np.empty((0, 6)) if history is None else history
        stated = {part.name: getattr(limits, part.name) for part in fields(Limits)}
        self._limited = {name: limit for name, limit in stated.items() if limit is not None}

    def look(self, time: float, state: Columns, longest_step: float, mass_defect: float) -> Diagnostics:
        """Evaluate a state.

        Parameters
        ----------
        time : float
            s.
        state : Columns
        longest_step : float
            Longest Δt since the state before, s.
        mass_defect : float
            Inflow − outflow − change of volume since the state before, over the inflow.

        Raises
        ------
        RunFailure
            CourantExceeded, MassNotConserved, AxisNotContinuous or EnergyNotBalanced.
        """
        model, grid = self.model, self.model.grid
        cells = Columns(*(values[1:-1] for values in state[:4]))
        slope, wall = wall_state(model, cells)
        constants = model.density, model.viscosity, grid.dx, grid.dphi
        if model.two_modes is None or state.axis_velocity is None:
            found = balance(*state[:4], slope, *constants)
        else:
            known = state.area, state.flow, state.axis_velocity, state.pressure
            found = two_mode_balance(model.two_modes, *known, slope, *constants)
        stored = 0.5 * grid.dphi * grid.dx * wall
        now = np.array(
            [time, found.kinetic + stored, found.end_power, found.dissipated, found.profile_power, 0.0]
        )
        carry = longest_step / grid.dx
        diagnostics = Diagnostics(
            courant_number=found.fastest_wave * carry,
            advective_courant_number=found.fastest_flow * carry,
            mass_defect=mass_defect,
            continuity_residual=found.axis_gap,
            kinetic_energy=found.kinetic,
            wall_energy=stored,
            end_power=found.end_power,
            dissipated_power=found.dissipated,
            profile_power=found.profile_power,
            energy_defect=self._energy_defect(now),
        )
        self._check(time, diagnostics)
        return diagnostics

    def _energy_defect(self, now: Floats) -> float:
        """Power gained beyond what is supplied, over the largest exchange so far; remembers the state."""
        past = self.history
        if past.size:
            now[5] = past[-1, 5]
            if past[-1, 0] >= now[0]:  # a run that goes on begins with the state it ended on
                past = past[past[:, 0] < now[0]]
        if past.size and now[0] - past[-1, 0] > self.resolved * (1 + 1e-9):
            past = past[:0]
        points = np.concatenate([past, now[None]])
        self.history = points[-HISTORY:]
        if len(points) <= HISTORY:
            return float("nan")
        interval = points[-1, 0] - points[-2, 0]
        gained = (points[-1, 1] - points[-2, 1]) / interval
        supplied, dissipated, shaped = last_interval_weights(points[:, 0]) @ points[:, 2:5]
        exchange = abs(gained) + abs(supplied) + abs(dissipated)
        self.history[-1, 5] = largest = max(now[5], exchange, np.finfo(float).tiny)
        return float((gained - supplied + dissipated + shaped) / largest)

    def _check(self, time: float, diagnostics: Diagnostics) -> None:
        for name, limit in self._limited.items():
            value = getattr(diagnostics, name)
            if abs(value) > limit:
                detail = f"{name} = {value:.6g}; allowed: at most {limit:g}"
                raise FAILURES[name](time, 0, 0, detail)


def last_interval_weights(times: Floats) -> Floats:
    """Weights of the mean over the last interval, by the polynomial through all ``times`` (increasing)."""
    places = (times - times[-1]) / (times[-1] - times[-2])
    powers = np.ones((times.size, times.size))
    for n in range(1, times.size):
        np.multiply(powers[n - 1], places, out=powers[n])
    return np.asarray(np.linalg.solve(powers, MOMENTS[: times.size]), dtype=float)


def wall_state(model: Model, cells: Columns) -> tuple[Floats, float]:
    """dA/dP of every cell, (n_x, n_phi), m²/Pa, and the sum of ∫P dA from the reference area, J/m per ½dφ."""
    if model.section_wall is not None:
        return _section_wall_state(model, model.section_wall, cells)
    start, rest, table = model.reference_pressure, model.radius, model.wall_table
    slope = np.empty(cells.area.shape)
    if table is None:
        return slope, float(linear_wall(cells.area, model.stiffness, rest, start, slope))
    pressure = np.clip(cells.pressure, table.start, table.end)  # round-off may pass the table's end
    tabulated_area(pressure, table.values, table.start, table.step, np.empty(slope.shape), slope)
    load = pressure - start
    mean_area = np.zeros(load.shape)
    for place, weight in zip(*np.polynomial.legendre.leggauss(GAUSS_POINTS), strict=True):
        mean_area += 0.5 * weight * model.area(start + 0.5 * (1 + place) * load)
    return slope, float(np.sum(pressure * cells.area - start * rest**2 - mean_area * load))


def _section_wall_state(model: Model, wall: SectionWall, cells: Columns) -> tuple[Floats, float]:
    """:func:`wall_state` with one pressure a section: ∫P dA by parts, ∫A dP exactly."""
    pressure, start = cells.pressure[:, 0], model.reference_pressure
    rest = start * model.radius**2 * cells.area.size
    swept = wall.area_integral(pressure) - wall.area_integral(np.full(pressure.shape, start))
    energy = np.sum(pressure * cells.area.sum(axis=1)) - rest - np.sum(swept)
    return wall.area_and_slope(pressure)[1], float(energy)
