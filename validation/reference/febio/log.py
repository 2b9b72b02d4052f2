"""What the log of a FEBio run tells: whether it is that of the plot file, what the run cost, how it ended."""

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from febio_io.text.log import Log, read_log
from febio_io.xplt import Plot
from validation.errors import UnusableReferenceError
from validation.runs.provenance import shown_path

ENDS = {"normal": "normally", "error": "with an error", "none": "not told: killed, crashed or still running"}
_MATERIAL = re.compile(r"\d+ - (.*?)(?: \(type: .*\))?")
SIX_DIGITS = 1e-5  # of a time: what a log prints of it


@dataclass(frozen=True)
class LogAccount:
    """What a run cost, for provenance and metrics, its materials, and what casts doubt on the run."""

    cost: dict[str, Any]
    warnings: tuple[str, ...]
    materials: tuple[dict[str, Any], ...]


def account_of_log(path: Path, plot: Plot) -> LogAccount:
    """Read the log of the run that wrote a plot file.

    Returns
    -------
    LogAccount
        The cost: ``log``, ``febio_version``, ``ended``, ``wall_time_s``, ``simulated_s``, ``time_steps``
        (converged ones), ``retries``, ``iterations``, ``equations``; None for what the log does not tell.

    Raises
    ------
    FebioError
        If it cannot be read or is no log.
    UnusableReferenceError
        If it is the log of another run.
    """
    log = read_log(path)
    _check_same_run(log, plot)
    warnings = []
    if log.termination != "normal":
        warnings.append(f"{path.name}: how the 3D run ended: {ENDS[log.termination]}")
    named = log.files.get("Plot file")
    if named is not None and Path(named.replace("\\", "/")).name != plot.path.name:
        warnings.append(
            f"{path.name} is the log of a run that wrote {named}, while reference.plot_file is "
            f"{plot.path.name}: if they are of different runs, the cost of 3D is not that of this reference"
        )
    return LogAccount(_cost(log), tuple(warnings), tuple(_materials(log)))


def _materials(log: Log) -> Iterator[dict[str, Any]]:
    """Inputs of blood and wall as the log echoes them, in the units of the run.

    A log numbers its materials and tells their types, "2 - Healthy (type: isotropic elastic)", and behind a
    slash what a mixture consists of; the solid of the fluid's own mesh is no wall.
    """
    for item in log.inputs:
        material, _, part = item.item.partition(" / ")
        found = _MATERIAL.fullmatch(material)
        fluid = "fluid" in material
        if item.section != "MATERIAL DATA" or not found or part.startswith("solid"):
            continue
        if item.name in (("density", "mu") if fluid else ("E", "v", "density")):
            about = {"material": found[1], "fluid": fluid, "name": item.name}
            with suppress(ValueError):  # a value that is a function of time is no number
                yield about | {"value": float(item.value)}


def _cost(log: Log) -> dict[str, Any]:
    times = _converged_times(log)
    return {
        "log": shown_path(log.path),
        "febio_version": log.version or None,
        "ended": ENDS[log.termination],
        "wall_time_s": log.timings.get("Total elapsed time", log.timings.get("Solve time")),
        "simulated_s": float(times.max()) if times.size else None,
        "time_steps": log.n_converged,
        "retries": log.n_retries,
        "iterations": log.n_iterations,
        "equations": log.n_equations,
    }


def _converged_times(log: Log) -> np.ndarray:
    return np.array([step.time for step in log.time_steps if step.outcome == "converged"])


def _check_same_run(log: Log, plot: Plot) -> None:
    """Refuse a log whose version, mesh or time steps are not the plot file's.

    The log tells the mesh in words that depend on FEBio's version; what it does not tell is not checked.
    """
    if log.version and plot.software.startswith("FEBio ") and log.version not in plot.software:
        raise _another(log, plot, f"it is of FEBio {log.version}, the plot file of {plot.software}")
    stated = [item.value for item in log.inputs if item.name == "Number of nodes"]
    nodes = len(plot.mesh.node_ids)
    if stated and stated[0] != str(nodes):
        raise _another(log, plot, f"its mesh has {stated[0]} nodes, that of the plot file {nodes}")
    times = np.append(_converged_times(log), 0.0)
    for state, time in enumerate(plot.times, start=1):
        if np.min(np.abs(times - time)) > SIX_DIGITS * max(abs(time), float(np.ptp(times))):
            raise _another(log, plot, f"no step of it converged at {time:g} s, the time of state {state}")


def _another(log: Log, plot: Plot, why: str) -> UnusableReferenceError:
    return UnusableReferenceError(f"{log.path}: not the log of {plot.path}: {why} (reference.log)")
