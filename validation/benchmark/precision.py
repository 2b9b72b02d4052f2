"""Work and precision: what runs cost, and how far they are from fine ones."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.reading.case_file import load_case_file
from cases.sections.case import Case
from cases.sections.solver import Solver
from solver.errors import SolverError
from solver.model.parameters import Model
from solver.runs.batch import run_batch
from solver.runs.result import CellHistory, cell_dataset
from validation.ablation.ladder import coupled_model
from validation.benchmark.measure import EXPLICIT
from validation.runs.provenance import provenance
from validation.runs.time_step import at_step, chosen
from validation.sweep.outputs import MEASURED, MEASURES

VARIANT, RINGS = "local", "axisymmetric"
ROW = "row"
STATES = 100  # of the cycle
OUTPUTS = (
    "systolic_pressure_inlet",
    "pulse_pressure_outlet",
    "flow_amplitude",
    "largest_radius",
    "radius_change_calcified",
)
PIECES = (1, 2, 4, 8, 16)  # steps between two states
FINE_PIECES = 32
GRIDS = (0.125, 0.25, 0.5, 1.0)  # sections and rows over the case's own
EXPLICIT_GRIDS = (0.125, 0.25, 0.5)  # 1.0 would take minutes
FINE_GRID = 2.0
LOCAL_TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)  # solver.error_tolerance: of a step
TOLERANCES = (1e-2, 1e-3, 1e-4)  # error_tolerance: of an output, as in sweeps and calibrations
FEWEST_ROWS = 4


@dataclass(frozen=True)
class Point:
    """One run: what was varied, its cost and its largest error.

    Attributes
    ----------
    series : str
        ``time steps``, ``grids``, ``local error`` (``solver.error_tolerance``) or ``error_tolerance``.
    scheme, model : str
        The model is ``row`` or ``coupled``.
    n_x, n_phi : int
    time_step : float
        s; of a step of its own choosing the longest allowed.
    tolerance : float or None
        Stated tolerance of the last two series.
    cpu_s : float
        Processor seconds of model, steady start and run: the least of the repetitions.
    error : float or None
        Largest error of any output, relative to it; None for a run that fails.
    output : str
        The output that has it, or why the run failed.
    """

    series: str
    scheme: str
    model: str
    n_x: int
    n_phi: int
    time_step: float
    tolerance: float | None
    cpu_s: float
    error: float | None
    output: str


@dataclass(frozen=True)
class Run:
    """Outputs of a run (n,), NaN where it failed with ``failure``, and its processor seconds."""

    outputs: Floats
    cpu_s: float
    failure: str = ""


Runner = Callable[[Case], Run]


def runner(repeat: int) -> Runner:
    """Run cases for one cycle, ``repeat`` times each."""

    def run(case: Case) -> Run:
        period = case.inlet.period

        def outputs(model: Model, cells: CellHistory) -> Floats:
            cycle = cell_dataset(model, cells, MEASURED)
            return np.array([MEASURES[name](case, cycle) for name in OUTPUTS])

        times = np.linspace(0.0, period, STATES + 1)
        costs = []
        for _ in range(repeat):
            begin = time.process_time()  # all threads of the explicit scheme
            (outcome,) = run_batch([case], times, outputs, 1)
            costs.append(time.process_time() - begin)
        if outcome.kept is None:
            return Run(np.full(len(OUTPUTS), np.nan), min(costs), str(outcome.error))
        return Run(outcome.kept, min(costs))

    return run


def on_grid(case: Case, share: float) -> Case:
    """Case of one cycle on a coarser or finer grid; the explicit scheme's step goes with the cells."""
    own = case.solver
    sections, rows = round(share * own.n_x), max(FEWEST_ROWS, round(share * own.n_phi))
    changes: dict[str, object] = {"n_x": max(3, sections), "n_phi": rows, "cycles": 1}
    if own.scheme == "godunov":
        changes["time_step"] = own.time_step * own.n_x / changes["n_x"]  # type: ignore[operator]
    return case.model_copy(update={"solver": own.model_copy(update=changes)})


def measure(path: Path, repeat: int, shown: Callable[[str], None]) -> list[Point]:
    """Measure all points; ``shown`` is told what is measured next.

    Raises
    ------
    CaseError, SolverError
        If the case cannot be read or the run that others are held against fails.
    """
    variants = load_case_file(path).variants
    row = on_grid(variants[VARIANT], 1.0)
    run, points = runner(repeat), []
    for model, case in {ROW: row, "coupled": coupled_model(row)}.items():
        run(case)  # compiles
        shown(f"{model}: time steps")
        fine = _fine(runner(1), at_step(case, case.inlet.period / STATES / FINE_PIECES))
        points += [
            _point("time steps", model, at_step(case, case.inlet.period / STATES / pieces), run, fine)
            for pieces in PIECES
        ]
        shown(f"{model}: tolerances")
        points += [
            _point("local error", model, _adaptive(case, limit), run, fine, limit)
            for limit in LOCAL_TOLERANCES
        ]
        points += [
            _point("error_tolerance", model, at_step(case, _step(case, limit)), run, fine, limit)
            for limit in TOLERANCES
        ]
        shown(f"{model}: grids")
        finest = _fine(runner(1), on_grid(case, FINE_GRID))
        points += [_point("grids", model, on_grid(case, share), run, finest) for share in GRIDS]
    shown("explicit scheme: grids")
    return points + _explicit(variants[RINGS], variants[EXPLICIT].solver)


def _explicit(rings: Case, settings: Solver) -> list[Point]:
    """Points of the explicit scheme; of rings, for coarse grids fail beside a patch."""
    finest = _fine(runner(1), on_grid(rings, FINE_GRID))
    explicit = rings.model_copy(update={"solver": settings})
    return [_point("grids", ROW, on_grid(explicit, share), runner(1), finest) for share in EXPLICIT_GRIDS]


def _fine(run: Runner, case: Case) -> Floats:
    found = run(case)
    if found.failure:
        raise SolverError(found.failure)
    return found.outputs


def _adaptive(case: Case, limit: float) -> Case:
    longest = case.inlet.period / STATES
    changes = {"error_tolerance": limit, "time_step": longest}
    return case.model_copy(update={"solver": case.solver.model_copy(update=changes)})


def _step(case: Case, limit: float) -> float:
    """Time step that a sweep of this one case would choose."""
    run, times = runner(1), np.linspace(0.0, case.inlet.period, STATES + 1)

    def numbers(step: float) -> Floats:
        return run(at_step(case, step)).outputs[None]

    return chosen(case.solver.time_step, times, 0.0, numbers, lambda fine: np.abs(fine[0]), limit).time_step


def _point(
    series: str, model: str, case: Case, run: Runner, fine: Floats, tolerance: float | None = None
) -> Point:
    found, settings = run(case), case.solver
    point = Point(
        series, settings.scheme, model, settings.n_x, settings.n_phi, settings.time_step, tolerance,
        found.cpu_s, None, found.failure,
    )  # fmt: skip
    if found.failure:
        return point
    errors = np.abs(found.outputs - fine) / np.abs(fine)
    worst = int(np.argmax(errors))
    return replace(point, error=float(errors[worst]), output=OUTPUTS[worst])


def lines_of(points: Sequence[Point]) -> Mapping[str, Mapping[str, tuple[Floats, Floats]]]:
    """Return costs and errors of each line, by model and by the words for the line."""
    found: dict[str, dict[str, list[Point]]] = {}
    for point in points:
        if point.error:
            words = point.series + ("" if point.scheme == "semi_implicit" else f", {point.scheme}, ring")
            found.setdefault(point.model, {}).setdefault(words, []).append(point)
    return {
        model: {
            words: (np.array([each.cpu_s for each in line]), np.array([each.error for each in line]))
            for words, line in lines.items()
        }
        for model, lines in found.items()
    }


def result_of(points: Sequence[Point], path: Path, command: list[str]) -> dict[str, Any]:
    """Collect what is kept: the points, and what measured them."""
    return {**provenance(path, [], command), "outputs": OUTPUTS, "points": [asdict(each) for each in points]}
