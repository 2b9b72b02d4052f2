"""Files named on a command line as the grids of two of their states."""

import re
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError as SchemaError

from cases.arrays import Floats
from cases.errors import RefusedValueError
from cases.sections.references.vtk import VtkReference
from cases.sections.references.xdmf import XdmfReference
from febio_io.views.grids import to_pyvista
from febio_io.xplt import Plot, open_plot
from validation.errors import UnusableReferenceError
from validation.reference.grid.contents import Grid
from validation.reference.grid.vtk_files import VtkFiles, grid_of
from validation.reference.grid.xdmf_files import XdmfFiles, opened

UNKNOWN = {"axis": "z", "velocity": "-", "pressure": "-"}  # not asked for
NUMBER = re.compile(r"[0-9]+(?=[^0-9]*$)")


@dataclass(frozen=True)
class Contents:
    """What is looked at.

    Attributes
    ----------
    kind : str
        That of the reference.
    stated : str or list of str
        How a case file names the files.
    count : int
        Number of states.
    times : ndarray (count,) or None
        None where the files do not tell.
    first, last : Grid
        Two states.
    domains : mapping of int to str
        FEBio's names of the domains.
    """

    kind: str
    stated: str | list[str]
    count: int
    times: Floats | None
    first: Grid
    last: Grid
    domains: dict[int, str]


@contextmanager
def looked_at(names: Sequence[str]) -> Iterator[Contents]:
    """Open files of one result.

    Raises
    ------
    UnusableReferenceError, FebioError
        If they cannot be read.
    """
    stated = _pattern(names)
    suffix = Path(names[0]).suffix
    if suffix == ".xplt":
        with open_plot(Path(names[0])) as plot:
            yield _of_plot(plot, names[0])
        return
    kind = XdmfReference if suffix in (".xdmf", ".xmf") else VtkReference
    word = "xdmf" if kind is XdmfReference else "vtk"
    try:
        section: Any = kind.model_validate({"kind": word, "result_files": stated} | UNKNOWN)
    except SchemaError as error:
        found = error.errors()[0]
        reason = found.get("ctx", {}).get("error", found["msg"])
        raise UnusableReferenceError(str(reason)) from error
    except RefusedValueError as error:
        raise UnusableReferenceError(str(error)) from error
    with ExitStack() as stack:
        if isinstance(section, XdmfReference):
            parts = [stack.enter_context(opened(part.paths[0])) for part in section.result_files]
            files: VtkFiles | XdmfFiles = XdmfFiles(section, parts)
            count = len(files.times)
        else:
            files = VtkFiles(section)
            count = files.count
        times = files.times_if_told
        yield Contents(word, stated, count, times, files.first(), files.state(count - 1), {})


def _pattern(names: Sequence[str]) -> str | list[str]:
    """Return one text for names that differ in a number only."""
    if len(names) == 1:
        return names[0]
    matches = [NUMBER.search(name) for name in names]
    around = {
        (name[: match.start()], name[match.end() :])
        for name, match in zip(names, matches, strict=True)
        if match
    }
    if len(around) != 1 or not all(matches):
        return list(names)
    before, after = around.pop()
    width = min(len(match[0]) for match in matches if match)
    return f"{before}{{:0{width}d}}{after}"


def _of_plot(plot: Plot, name: str) -> Contents:
    domains = {domain.region: domain.name for domain in plot.mesh.domains}
    first, last = (grid_of(to_pyvista(plot, state), name) for state in (0, -1))
    return Contents("febio", name, plot.n_states, np.asarray(plot.times), first, last, domains)
