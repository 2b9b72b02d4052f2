"""Run a case in pieces, so that memory stays bounded and an interrupted run can go on bit by bit equal.

Every few states the run leaves a piece beside the result file: what was asked for since the last piece, and
the whole state at its end. The result is written from the pieces when the last one is there.
"""

import hashlib
import os
import shutil
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from cases.schema import Case
from solver.case_run import run_case
from solver.errors import SolverError
from solver.files import write_netcdf
from solver.from_case import default_output_times, error_tolerance, initial_state, model_of
from solver.locality import wall_locality_error, widest
from solver.model import Model, State
from solver.result import to_dataset
from solver.simulate import Progress, Snapshot, Trajectory, collect, snapshots

PIECE = 25  # states


@dataclass(frozen=True)
class Piece:
    """Consecutive states of a run, the state at their end, and the Δt to try from there, s."""

    trajectory: Trajectory
    end: State
    next_step: float


def pieces_folder(result: Path) -> Path:
    """Folder of the pieces of a result file."""
    return result.with_name(result.name + ".pieces")


def run_identity(text: str, variant: str, inputs: Iterable[Path]) -> str:
    """Digest of what must not change between a run and its continuation.

    Parameters
    ----------
    text : str
        The case file.
    variant : str
        Name of the variant.
    inputs : iterable of Path
        Files that the model is read from besides.

    Raises
    ------
    SolverError
        If one of them cannot be read.
    """
    try:
        own = version("arterial-rom-validation")
    except PackageNotFoundError:
        own = "unknown"
    digest = hashlib.sha256(f"{own}\0{variant}\0{text}".encode())
    for path in inputs:
        try:
            digest.update(b"\0" + path.read_bytes())
        except OSError as error:
            raise SolverError(f"{path}: cannot be read: {error.strerror or error}") from error
    return digest.hexdigest()


def run_to_file(
    case: Case, result: Path, identity: str, attributes: dict[str, Any], resume: bool, progress: Progress
) -> dict[str, Any]:
    """Run a case and write its result file.

    Parameters
    ----------
    case : Case
    result : Path
        NetCDF file to write.
    identity : str
        From :func:`run_identity`.
    attributes : dict
        Global attributes to add.
    resume : bool
        Go on from the pieces of an interrupted run; else they are removed.
    progress : callable
        Called with (time reached, last time).

    Returns
    -------
    dict
        Global attributes of the result.

    Raises
    ------
    SolverError
        If a run fails, pieces belong to another run, or a file cannot be written.
    """
    folder = _prepare(pieces_folder(result), identity, resume)
    model, times = model_of(case), default_output_times(case)
    done = sorted(folder.glob("*.npz"))
    last = _read(model, done[-1]) if done else None
    start = initial_state(case, model) if last is None else last.end
    first = 0 if last is None else int(np.searchsorted(times, last.end.time))
    taken: list[Snapshot] = []
    steps = sweeps = 0
    next_step = None if last is None else last.next_step
    walk = snapshots(model, times[first:], case.solver.time_step, start, error_tolerance(case), next_step)
    for number, snapshot in enumerate(walk, start=first):
        if last is None or number > first:
            taken.append(snapshot)
        progress(snapshot.state.time, float(times[-1]))
        if len(taken) == PIECE or (number == times.size - 1 and taken):
            piece = collect(model, taken)
            own = replace(piece, steps=piece.steps - steps, sweeps=piece.sweeps - sweeps)
            _write(folder / f"{number:08d}.npz", own, snapshot)
            taken, steps, sweeps = [], piece.steps, piece.sweeps
    paths = sorted(folder.glob("*.npz"))
    error = wall_locality_error(case, model.section_wall, _widest_of(model, paths))
    if error is not None:
        attributes = {**attributes, "wall_locality_error": error}
    described = _join(model, paths, result, attributes)
    shutil.rmtree(folder)
    return described if error is None else {**described, "wall_locality_error": error}


def run_whole(
    case: Case, result: Path, attributes: dict[str, Any], resume: bool, progress: Progress
) -> dict[str, Any]:
    """Run a case that leaves no pieces (scheme godunov) and write its result file.

    Parameters, return value and errors are those of :func:`run_to_file`.
    """
    if resume:
        raise SolverError(f"scheme {case.solver.scheme} keeps no pieces to resume from; run without --resume")
    dataset = run_case(case, default_output_times(case), progress).assign_attrs(attributes)
    write_netcdf(dataset, result)
    return dict(dataset.attrs)


def _prepare(folder: Path, identity: str, resume: bool) -> Path:
    mark = folder / "identity"
    if resume:
        if not mark.is_file():
            raise SolverError(f"{folder}: no interrupted run to resume; run without --resume")
        if mark.read_text(encoding="ascii") != identity:
            raise SolverError(f"{folder}: belongs to another case, variant or version; run without --resume")
        return folder
    try:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        mark.write_text(identity, encoding="ascii")
    except OSError as error:
        raise SolverError(f"{folder}: cannot be written: {error.strerror or error}") from error
    return folder


_ARRAYS = ("times", "area", "pressure", "flow", "mass_defect")
_NUMBERS = ("steps", "sweeps", "longest_step")


def _write(path: Path, trajectory: Trajectory, end: Snapshot) -> None:
    values = {name: getattr(trajectory, name) for name in (*_ARRAYS, *_NUMBERS)}
    values |= {f"end_{part.name}": getattr(end.state, part.name) for part in fields(State)}
    values["next_step"] = end.next_step
    partial = path.with_suffix(".part")
    try:
        with partial.open("wb") as stream:
            np.savez(stream, **values)
            stream.flush()
            os.fsync(stream.fileno())
        partial.replace(path)
    except OSError as error:
        raise SolverError(f"{path}: cannot be written: {error.strerror or error}") from error


def _read(model: Model, path: Path) -> Piece:
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in _ARRAYS}
        numbers = {name: stored[name].item() for name in _NUMBERS}
        next_step = float(stored["next_step"])
        end = {part.name: stored[f"end_{part.name}"] for part in fields(State)}
    end |= {name: float(end[name]) for name in ("time", "reservoir")}
    return Piece(Trajectory(model=model, **arrays, **numbers), State(**end), next_step)


def _widest_of(model: Model, paths: list[Path]) -> np.ndarray:
    """Section pressures at the instant of a run at which they vary most along the artery, Pa, (n_x,)."""
    profiles = [widest(_read(model, path).trajectory.pressure) for path in paths]
    return max(profiles, key=lambda profile: float(np.ptp(profile)))


def _join(model: Model, paths: list[Path], result: Path, attributes: dict[str, Any]) -> dict[str, Any]:
    """Write the result from its pieces, one in memory at a time."""
    partial = result.with_name(f".{result.name}.{os.getpid()}.part")
    steps = sweeps = 0
    longest = 0.0
    try:
        for path in paths:
            trajectory = _read(model, path).trajectory
            steps, sweeps = steps + trajectory.steps, sweeps + trajectory.sweeps
            longest = max(longest, trajectory.longest_step)
            total = replace(trajectory, steps=steps, sweeps=sweeps, longest_step=longest)
            dataset = to_dataset(total).assign_attrs(attributes)
            if path == paths[0]:
                write_netcdf(dataset, partial, unlimited=("time",))
            else:
                with netCDF4.Dataset(partial, "a") as stored:
                    count = stored.dimensions["time"].size
                    for name in (str(n) for n in dataset.variables if "time" in dataset[n].dims):
                        stored[name][count:] = dataset[name].to_numpy()
        with netCDF4.Dataset(partial, "a") as stored:
            stored.setncatts({"steps": steps, "iteration_sweeps": sweeps, "time_step_s": longest})
        partial.replace(result)
    except OSError as error:
        raise SolverError(f"{result}: cannot be written: {error.strerror or error}") from error
    finally:
        partial.unlink(missing_ok=True)
    return {"steps": steps, "time_step_s": longest}
