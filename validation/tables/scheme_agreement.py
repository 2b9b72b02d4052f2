"""Both schemes on the same pulsatile flows: the implicit one in long steps, the explicit one converged.

Compared where β is uniform: where it varies the explicit scheme's Q has dents of first order in Δx, as in
table 3.3. Both start from the implicit scheme's steady state and are compared in the second cycle.
"""

from functools import partial

import numpy as np

from cases.arrays import Floats
from solver.geometry.calcification import Patch
from solver.marching.columns import columns_of
from solver.marching.godunov import march
from solver.marching.godunov_setup import Setup, State, held
from solver.marching.semi_implicit import simulate
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, ResistanceOutlet
from solver.model.parameters import Model
from validation.tables.artery import (
    DENSITY,
    DIASTOLE,
    FINE_STEP,
    LENGTH,
    PULSATILE_OUTLET,
    QUARTER_CM,
    RADIUS,
    VISCOSITY,
    artery,
    plaque,
    ring,
    thesis_waveform,
)
from validation.tables.experiment import Check, Entry, Experiment, Result, Results, numbers

CELLS, CONVERGED = 120, 480  # n_x of the implicit and of the explicit scheme
STEP = 1e-3  # s, of the implicit scheme
PLACES = np.array([0, 1, 2, 6, 7.5, 9, 13, 14, 15]) * 1e-3  # m, outside the transitions
INSTANTS = 20  # of the second cycle
PATTERNS: dict[str, tuple[Patch | None, int]] = {
    "none": (None, 1),
    "axisymmetric": (ring(QUARTER_CM), 1),
    "local": (plaque(3 / 8 * np.pi), 12),
}
THREADS = 2
ALLOWED = 1e-3


def _times() -> Floats:
    """0 s, and instants of the second cycle, s."""
    return np.concatenate(([0.0], np.linspace(1, 2, INSTANTS) * thesis_waveform().period))


def _setup(pattern: str, n_x: int) -> Setup:
    patch, n_phi = PATTERNS[pattern]
    resistance, offset = PULSATILE_OUTLET
    step = FINE_STEP * 120 / n_x
    return artery(
        n_x, n_phi, step, patch, inlet=thesis_waveform(), resistance=resistance, offset=held(offset)
    )


def _model(setup: Setup) -> Model:
    resistance, offset = PULSATILE_OUTLET
    return Model(
        grid=setup.grid,
        radius=RADIUS,
        density=DENSITY,
        viscosity=VISCOSITY,
        reference_pressure=0.0,
        stiffness=np.ascontiguousarray(setup.wall.stiffness[1:-1]),
        inlet=Inlet("velocity", thesis_waveform()),
        outlet=ResistanceOutlet(resistance, offset, "row"),
    )


def explicit_flow(pattern: str, n_x: int = CONVERGED) -> Result:
    """Q of the explicit scheme at instants and places, m³/s, one list of places per row and instant."""
    setup = _setup(pattern, n_x)
    model = _model(setup)
    columns = columns_of(model, steady_state(model, DIASTOLE))
    start = State(0.0, columns.area, columns.flow, columns.exponent)
    run = march(setup, start, _times(), threads=THREADS if setup.grid.n_phi > 1 else 1)
    x = np.concatenate(([0.0], setup.grid.x, [LENGTH]))
    result: Result = {"steps": run.steps, "courant": run.courant}
    for n, state in enumerate(run.states[1:]):
        for j in range(setup.grid.n_phi):
            result[_key(n, j)] = [float(q) for q in np.interp(PLACES, x, state.flow[:, j])]
    return result


def implicit_flow(pattern: str) -> Floats:
    """Q of the implicit scheme, (instants, places, rows), m³/s."""
    model = _model(_setup(pattern, CELLS))
    run = simulate(model, _times(), STEP, steady_state(model, DIASTOLE))
    faces = np.rint(PLACES / model.grid.dx).astype(int)
    return np.asarray(run.flow[1:, faces])


def _key(instant: int, row: int) -> str:
    return f"instant {instant} j={row + 1}"


def difference(pattern: str, converged: Result) -> float:
    """Largest relative difference of the implicit scheme's Q from the explicit one's."""
    ours = implicit_flow(pattern)
    rows = [[numbers(converged, _key(n, j)) for j in range(ours.shape[2])] for n in range(ours.shape[0])]
    theirs = np.swapaxes(np.array(rows, dtype=float), 1, 2)
    return float(np.max(np.abs(ours / theirs - 1)))


def _rows(results: Results) -> list[Check]:
    return [
        Check(
            f"{pattern}, n_x = {CELLS} and 1 ms against n_x = {CONVERGED}",
            "largest relative difference of Q",
            "",
            difference(pattern, results[entry]),
            None,
            0.0,
            ALLOWED,
        )
        for pattern in PATTERNS
        if (entry := _entry(pattern)) in results
    ]


def _entry(pattern: str) -> str:
    return f"converged pulsatile {pattern}"


EXPERIMENT = Experiment(
    "schemes",
    "Pulsatile flow of the implicit scheme against the explicit one, converged",
    [Entry(_entry(name), partial(explicit_flow, name), quick=False) for name in PATTERNS],
    _rows,
)
