"""What a run is watched by: Courant numbers, mass, the continuity condition and mechanical energy.

Evaluated at the states that are saved, outside the schemes. A limit that is exceeded stops the run.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.errors import AxisNotContinuous, CourantExceeded, EnergyNotBalanced, MassNotConserved, RunFailure
from solver.model.parameters import Model
from solver.model.two_mode_balance import two_mode_balance
from solver.schemes.rows.balance import Balance, balance, linear_wall
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

    def at(self, k: int | None) -> "Columns":
        """State k of several, as views; with None for k, this one as one of several."""
        axis = None if self.axis_velocity is None else self.axis_velocity[k]
        return Columns(self.area[k], self.flow[k], self.exponent[k], self.pressure[k], axis)


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
        """Evaluate a state; arguments and errors are those of :meth:`follow`, of one state."""
        instant, longest, defect = np.array([[time], [longest_step], [mass_defect]])
        return next(self.follow(instant, longest, defect, state.at(None)))

    def follow(
        self, times: Floats, longest_step: Floats, mass_defect: Floats, states: Columns
    ) -> Iterator[Diagnostics]:
        """Evaluate states one after another; :attr:`history` is that of the one told last.

        Parameters
        ----------
        times : ndarray (n,)
            s.
        longest_step : ndarray (n,)
            Longest Δt since the state before, s.
        mass_defect : ndarray (n,)
            Inflow − outflow − change of volume since the state before, over the inflow.
        states : Columns
            n of them.

        Raises
        ------
        RunFailure
            CourantExceeded, MassNotConserved, AxisNotContinuous or EnergyNotBalanced.
        """
        grid = self.model.grid
        found, wall = balances(self.model, states)
        stored = 0.5 * grid.dphi * grid.dx * wall
        powers = found.end_power, found.dissipated, found.profile_power
        points, begins, defects = self._energy_defects(np.array([times, found.kinetic + stored, *powers]).T)
        carry = longest_step / grid.dx
        courant = found.fastest_wave * carry, found.fastest_flow * carry
        values = *courant, mass_defect, found.axis_gap, found.kinetic, stored, *powers, defects
        for k, each in enumerate(zip(*np.array(values).tolist(), strict=True)):
            diagnostics = Diagnostics(*each)
            end = len(points) - times.size + k + 1
            self.history = points[max(begins[k], end - HISTORY) : end]
            self._check(float(times[k]), diagnostics)
            yield diagnostics

    def _energy_defects(self, now: Floats) -> tuple[Floats, list[int], Floats]:
        """Power gained beyond what is supplied, over the largest exchange so far, of states (n, 5).

        Returns
        -------
        points : ndarray (k, 6)
            History and states; the latter are the last.
        begins : list of int
            Where the states known before each one, and resolved, begin.
        defects : ndarray (n,)
        """
        past = self.history
        largest = past[-1, 5] if past.size else 0.0
        past = past[past[:, 0] < now[0, 0]]  # a run that goes on begins with the state it ended on
        points = np.zeros((len(past) + len(now), 6))
        points[: len(past)], points[len(past) :, :5] = past, now
        gaps = np.diff(points[:, 0], prepend=-np.inf) > self.resolved * (1 + 1e-9)
        places = np.arange(len(points))
        begins = np.maximum.accumulate(np.where(gaps, places, 0))
        known = places[(places >= len(past)) & (places - begins >= HISTORY)]
        around = points[known[:, None] + np.arange(-HISTORY, 1)]
        gained = (around[:, -1, 1] - around[:, -2, 1]) / (around[:, -1, 0] - around[:, -2, 0])
        weights = last_interval_weights(around[..., 0])
        supplied, dissipated, shaped = (weights[:, None] @ around[..., 2:5])[:, 0].T
        exchange = np.zeros(len(points))
        exchange[known] = np.fmax(abs(gained) + abs(supplied) + abs(dissipated), np.finfo(float).tiny)
        new = slice(len(past), None)
        points[new, 5] = np.fmax.accumulate([largest, *exchange[new]])[1:]
        defects = np.full(len(points), np.nan)
        defects[known] = (gained - supplied + dissipated + shaped) / points[known, 5]
        return points, begins[new].tolist(), defects[new]

    def _check(self, time: float, diagnostics: Diagnostics) -> None:
        for name, limit in self._limited.items():
            value = getattr(diagnostics, name)
            if abs(value) > limit:
                detail = f"{name} = {value:.6g}; allowed: at most {limit:g}"
                raise FAILURES[name](time, 0, 0, detail)


def last_interval_weights(times: Floats) -> Floats:
    """Weights of the mean over the last interval, by the polynomial through ``times`` (..., k), rising."""
    count = times.shape[-1]
    places = (times - times[..., -1:]) / (times[..., -1:] - times[..., -2:-1])
    powers = np.ones((*times.shape[:-1], count, count))
    for n in range(1, count):
        np.multiply(powers[..., n - 1, :], places, out=powers[..., n, :])
    return np.asarray(np.linalg.solve(powers, MOMENTS[:count, None]), dtype=float)[..., 0]


def balances(model: Model, states: Columns) -> tuple[Balance, Floats]:
    """Balance of each of n states, whose parts are (n,), and the wall's energy, J/m per ½dφ, (n,)."""
    slope, wall = wall_state(model, Columns(*(part[:, 1:-1] for part in states[:4])))
    constants = model.density, model.viscosity, model.grid.dx, model.grid.dphi
    if model.two_modes is None or states.axis_velocity is None:
        each = zip(*states[:4], slope, strict=True)
        found = [balance(*parts, *constants) for parts in each]
    else:
        each = zip(states.area, states.flow, states.axis_velocity, states.pressure, slope, strict=True)
        found = [two_mode_balance(model.two_modes, *parts, *constants) for parts in each]
    return Balance(*np.array(found).T), wall


def wall_state(model: Model, cells: Columns) -> tuple[Floats, Floats]:
    """dA/dP of every cell, (..., n_x, n_phi), m²/Pa, and the sum of ∫P dA from the reference area (...).

    The latter in J/m per ½dφ.
    """
    if model.section_wall is not None:
        return _section_wall_state(model, model.section_wall, cells)
    slope, states = np.empty(cells.area.shape), (-1, *model.stiffness.shape)
    each = zip(*(part.reshape(states) for part in (cells.area, cells.pressure, slope)), strict=True)
    energy = [_row_wall_energy(model, *parts) for parts in each]
    return slope, np.reshape(energy, cells.area.shape[:-2])


def _row_wall_energy(model: Model, area: Floats, pressure: Floats, slope: Floats) -> float:
    """Sum of ∫P dA of one state; leaves dA/dP in ``slope``."""
    start, rest, table = model.reference_pressure, model.radius, model.wall_table
    if table is None:
        return float(linear_wall(area, model.stiffness, rest, start, slope))
    pressure = np.clip(pressure, table.start, table.end)  # round-off may pass the table's end
    tabulated_area(pressure, table.values, table.start, table.step, np.empty(slope.shape), slope)
    load = pressure - start
    mean_area = np.zeros(load.shape)
    for place, weight in zip(*np.polynomial.legendre.leggauss(GAUSS_POINTS), strict=True):
        mean_area += 0.5 * weight * model.area(start + 0.5 * (1 + place) * load)
    return float(np.sum(pressure * area - start * rest**2 - mean_area * load))


def _section_wall_state(model: Model, wall: SectionWall, cells: Columns) -> tuple[Floats, Floats]:
    """:func:`wall_state` with one pressure a section: ∫P dA by parts, ∫A dP exactly."""
    pressure, start = cells.pressure[..., 0], model.reference_pressure
    rest = start * model.radius**2 * model.stiffness.size
    swept = wall.area_integral(pressure) - wall.area_integral(np.full(model.grid.n_x, start))
    energy = np.sum(pressure * cells.area.sum(axis=-1), axis=-1) - rest - np.sum(swept, axis=-1)
    return wall.area_and_slope(pressure)[1], np.asarray(energy)
