"""Run a case in pieces, so that memory stays bounded and an interrupted run can go on bit by bit equal.

Every few states are a piece: what was asked for since the last piece, and the whole state at its end. Pieces
are left beside the result file every few seconds, and when the run is interrupted; the result is written from
them when the last one is there. So a run of few seconds leaves none, which took longer than to compute it.
"""

import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from time import monotonic
from typing import Any

import netCDF4
import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.shell.whole import write_whole, writing
from solver.case.locality import wall_locality_error, widest
from solver.case.model import default_output_times, model_of
from solver.case.periodicity import cycle_change
from solver.case.run import counts, walk
from solver.errors import SolverError
from solver.marching.semi_implicit import Progress
from solver.marching.walk import Kept, Stop, history_of
from solver.model.diagnostics import Diagnostics
from solver.model.parameters import Model
from solver.runs.files import pieces_folder
from solver.runs.netcdf import append_netcdf, write_netcdf
from solver.runs.result import CellHistory, cell_fields

PIECE = 25  # states
MARK = "identity"  # file beside the pieces: of which run they are
SECONDS = 2.0  # that pieces are held in memory
LARGEST = 16e6  # bytes of one field that they may take there


@dataclass(frozen=True)
class Piece:
    """Consecutive states of a run, what it took to compute them, and what the scheme needs to go on.

    ``steps`` and ``sweeps`` are those of this piece; ``longest_step`` in s.
    """

    cells: CellHistory
    steps: int
    sweeps: int
    longest_step: float
    kept: Kept


def run_identity(text: str, variant: str, inputs: Iterable[Path]) -> str:
    """Digest of what must not change between a run and its continuation.

    Parameters
    ----------
    text : str
        The case file.
    variant : str
        Name of the variant, with its model where the file has several.
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
        ``steps``, ``time_step_s``, ``largest``, the largest magnitude of each diagnostic by name, and
        ``cycle_change``, None where it cannot be told.

    Raises
    ------
    SolverError
        If a run fails, pieces belong to another run, or a file cannot be written.
    """
    folder = _prepare(pieces_folder(result), identity, resume)
    model, times = model_of(case), default_output_times(case)
    places, held = sorted(folder.glob("*.npz")), dict[Path, Piece]()
    try:
        began = monotonic()
        for path, piece in _computed(case, model, times, folder, places[-1:], progress):
            places.append(path)
            held[path] = piece
            size = sum(each.cells.pressure.nbytes for each in held.values())
            if size > LARGEST or monotonic() - began > SECONDS:
                _leave(held)
                began = monotonic()
        parts = [held.get(path, path) for path in places]
        error = wall_locality_error(case, model.section_wall, _widest_of(parts))
        told = {} if error is None else {"wall_locality_error": error}
        try:
            found = _join(case, model, parts, result, attributes | told)
        except RuntimeError as failure:  # so netCDF reports a full disk
            raise SolverError(f"{result}: cannot be written: {failure}") from failure
    except KeyboardInterrupt:
        _leave(held)
        raise
    _remove(folder)
    return found | told


def _computed(
    case: Case, model: Model, times: Floats, folder: Path, last: list[Path], progress: Progress
) -> Iterator[tuple[Path, Piece]]:
    """Pieces behind the last one in a folder, if there is one, as they are computed, each with its place."""
    first, kept = (int(last[0].stem), _read(last[0]).kept) if last else (0, None)
    taken: list[Stop] = []
    steps = sweeps = 0
    for number, stop in enumerate(walk(case, model, times[first:], kept), start=first):
        if kept is None or number > first:
            taken.append(stop)
        progress(float(times[number]), float(times[-1]))
        if len(taken) == PIECE or (number == times.size - 1 and taken):
            longest = max(each.longest_step for each in taken)
            piece = Piece(history_of(taken), stop.steps - steps, stop.sweeps - sweeps, longest, stop.kept)
            yield folder / f"{number:08d}.npz", piece
            taken, steps, sweeps = [], stop.steps, stop.sweeps


def _prepare(folder: Path, identity: str, resume: bool) -> Path:
    mark = folder / MARK
    if resume:
        if not mark.is_file():
            raise SolverError(f"{folder}: no interrupted run to resume; run without --resume")
        if mark.read_text(encoding="ascii") != identity:
            raise SolverError(
                f"{folder}: belongs to another case, variant, model or version; run without --resume"
            )
        return folder
    with writing(folder, SolverError):
        _remove(folder)
        folder.mkdir()
        mark.write_text(identity, encoding="ascii")
    return folder


def _remove(folder: Path) -> None:
    """Remove pieces; first their mark: no run may go on from what an interrupt leaves of them."""
    (folder / MARK).unlink(missing_ok=True)
    shutil.rmtree(folder, ignore_errors=True)


_ARRAYS = ("times", "area", "flow", "pressure", "exponent")
_OPTIONAL = ("azimuthal_flux", "axis_velocity")
_NUMBERS = ("steps", "sweeps", "longest_step")


def _leave(held: dict[Path, Piece]) -> None:
    """Write pieces to their places, and hold them no longer."""
    for path, piece in held.items():
        _write(path, piece)
    held.clear()


def _write(path: Path, piece: Piece) -> None:
    values = {name: getattr(piece.cells, name) for name in _ARRAYS}
    values |= {name: np.asarray(getattr(piece, name)) for name in _NUMBERS}
    known = {name: getattr(piece.cells, name) for name in _OPTIONAL}
    values |= {name: found for name, found in known.items() if found is not None}
    values |= {f"diagnostic_{name}": found for name, found in piece.cells.diagnostics.items()}
    values |= {f"kept_{name}": found for name, found in piece.kept.items()}
    with writing(path, SolverError), write_whole(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **values)
        stream.flush()
        os.fsync(stream.fileno())


def _read(part: Path | Piece) -> Piece:
    """Return a piece, from its place if it is no longer held."""
    if isinstance(part, Piece):
        return part
    with writing(part, SolverError, "cannot be read"), np.load(part) as stored:
        diagnostics = {name: stored[f"diagnostic_{name}"] for name in Diagnostics._fields}
        arrays = {name: stored[name] for name in (*_ARRAYS, *_OPTIONAL) if name in stored.files}
        cells = CellHistory(**arrays, diagnostics=diagnostics)
        numbers = {name: stored[name].item() for name in _NUMBERS}
        names = [name for name in stored.files if name.startswith("kept_")]
        return Piece(cells, **numbers, kept={name.removeprefix("kept_"): stored[name] for name in names})


def _widest_of(parts: list[Path | Piece]) -> Floats:
    """Section pressures at the instant of a run at which they vary most along the artery, Pa, (n_x,)."""
    profiles = []
    for part in parts:
        if isinstance(part, Piece):
            profiles.append(widest(part.cells.pressure))
        else:
            with writing(part, SolverError, "cannot be read"), np.load(part) as stored:
                profiles.append(widest(stored["pressure"]))
    return max(profiles, key=lambda profile: float(np.ptp(profile)))


def _join(
    case: Case, model: Model, parts: list[Path | Piece], result: Path, attributes: dict[str, Any]
) -> dict[str, Any]:
    """Write the result from its pieces, one in memory at a time."""
    steps = sweeps = 0
    longest = 0.0
    largest = dict.fromkeys(Diagnostics._fields, float("nan"))
    first = _read(parts[0]).cells
    axes = {"time": first.times, "x": model.grid.x, "phi": model.grid.phi}
    with writing(result, SolverError), write_whole(result) as partial:
        write_netcdf(partial, axes, cell_fields(model, first), attributes)
        with netCDF4.Dataset(partial, "a") as stored:
            for field in stored.variables.values():  # HDF5 would keep 16 MB of each
                field.set_var_chunk_cache(2 * first.pressure.nbytes)
            for number, piece in enumerate(map(_read, parts)):
                steps, sweeps = steps + piece.steps, sweeps + piece.sweeps
                longest = max(longest, piece.longest_step)
                for name, values in piece.cells.diagnostics.items():
                    largest[name] = float(np.fmax.reduce(np.abs(values), initial=largest[name]))
                if number > 0:
                    append_netcdf(stored, piece.cells.times, cell_fields(model, piece.cells))
            stored.setncatts(counts(case, steps, sweeps, longest))
            change = cycle_change(case, stored.variables)
            if change is not None:
                stored.setncatts({"cycle_change": change})
    return {"steps": steps, "time_step_s": longest, "largest": largest, "cycle_change": change}
