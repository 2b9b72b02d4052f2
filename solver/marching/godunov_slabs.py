"""The Godunov scheme's columns, whole or cut along the artery into slabs that step side by side.

A slab keeps copies of its neighbour's columns, of which every step spoils two; after a round of
``ROUND`` steps the copies are renewed. The result is bit for bit that of the whole.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cases.arrays import Floats
from solver.schemes.godunov import step as scheme
from solver.schemes.godunov.layout import OK, Fields, Parameters, Ramp, Workspace, stride, workspace
from solver.schemes.godunov.steady import Stopping

ROUND = 8  # steps between two exchanges of copies
OVERLAP = 2 * ROUND + 1  # columns copied

Outcome = tuple[int, int, int, int]
ALONG = tuple(name for name in Fields._fields if name != "reservoir")  # laid out along the artery
STATE = ("area", "flow", "exponent", "root", "inverse_root")


@dataclass
class Slab:
    """Columns ``first`` … of the artery, of which those from ``begin`` to ``end`` are its own."""

    first: int
    begin: int
    end: int
    fields: Fields
    ramp: Ramp
    parameters: Parameters
    work: Workspace


def cut(fields: Fields, ramp: Ramp, parameters: Parameters, count: int) -> list[Slab]:
    """Cut the columns into ``count`` slabs of about equal width; fewer if they would not be wide enough."""
    columns, width = parameters.columns, stride(parameters.n_phi)
    count = max(1, min(count, columns // (2 * OVERLAP)))
    edges = np.linspace(0, columns, count + 1).round().astype(int)
    slabs = []
    for begin, end in pairwise(edges):
        first, last = max(0, begin - OVERLAP), min(columns, end + OVERLAP)
        part = slice(first * width, last * width)
        own = parameters._replace(
            columns=int(last - first), has_inlet=bool(first == 0), has_outlet=bool(last == columns)
        )
        slabs.append(
            Slab(
                int(first),
                int(begin),
                int(end),
                _fields({name: getattr(fields, name)[part] for name in ALONG}, fields),
                Ramp(*(np.array(values[part]) for values in ramp)),
                own,
                workspace(own.columns, own.n_phi),
            )
        )
    return slabs


def _fields(along: dict[str, Floats], behind: Fields) -> Fields:
    """Copy fields along a part of the artery, and what lies behind the outlet."""
    copied = {name: np.array(values) for name, values in along.items()}
    return Fields(**copied, reservoir=behind.reservoir.copy())


def _columns(slab: Slab, values: Floats, begin: int, end: int) -> Floats:
    width = stride(slab.parameters.n_phi)
    return values[(begin - slab.first) * width : (end - slab.first) * width]


def gather(slabs: list[Slab]) -> Fields:
    """Put the slabs' own columns together: flat copies."""
    along = {
        name: np.concatenate([_columns(s, getattr(s.fields, name), s.begin, s.end) for s in slabs])
        for name in ALONG
    }
    return _fields(along, slabs[-1].fields)


def _renew(slabs: list[Slab]) -> None:
    """Copy each slab's own columns into its neighbours' copies of them."""
    for left, right in pairwise(slabs):
        edge = left.end
        for name in STATE:
            of_left, of_right = getattr(left.fields, name), getattr(right.fields, name)
            behind, before = edge + OVERLAP, edge - OVERLAP
            _columns(left, of_left, edge, behind)[:] = _columns(right, of_right, edge, behind)
            _columns(right, of_right, before, edge)[:] = _columns(left, of_left, before, edge)


def advance(
    slabs: list[Slab],
    pool: ThreadPoolExecutor,
    stopping: Stopping,
    inlets: Floats,
    offsets: Floats,
    loads: Floats,
) -> Outcome:
    """Advance all slabs by one step per entry of ``inlets``; as :func:`solver.schemes.godunov.step.advance`.

    Several slabs take no stopping criteria. The column of a failure is the artery's.
    """

    def run(slab: Slab, part: slice) -> Outcome:
        status, column, row, steps = scheme.advance(
            slab.fields,
            slab.work,
            slab.parameters,
            slab.ramp,
            stopping,
            inlets[part],
            offsets[part],
            loads[part],
        )
        return status, column + slab.first, row, steps + part.start

    if len(slabs) == 1:
        return run(slabs[0], slice(0, inlets.size))
    for start in range(0, inlets.size, ROUND):
        part = slice(start, min(start + ROUND, inlets.size))
        others = [pool.submit(run, slab, part) for slab in slabs[1:]]
        outcomes = [run(slabs[0], part), *(other.result() for other in others)]
        failures = [outcome for outcome in outcomes if outcome[0] != OK]
        if failures:
            return min(failures, key=lambda outcome: outcome[3])
        _renew(slabs)
    return OK, 0, 0, inlets.size
