"""Measure what a 3D result of many states and cells costs to map: time per state, and memory.

    python benchmarks/reference_series.py [--cells 1000000] [--states 3 10] [--folder DIR]

Reads and maps the ready FEBio run, from its plot file and exported to .vtu. Aimed at: the second is slower by
the reading of its files only. Then writes a tube of one state as .vtu into a temporary folder (below DIR),
with links for the other states, and reads and maps each number of states in a process of its own, onto a few
cells. Aimed at: memory that does not grow with the number of states.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "validation"))  # its made-up tubes

from small_case import RUNS, small_case, written
from tube_grids import cells_of, grid_of
from tubes import Tube

from cases.reading.case_file import load_case_file
from febio_io.views.export import export_plot
from febio_io.xplt import open_plot
from validation.mapping.rays import rays
from validation.mapping.state import Mapper
from validation.reference.febio.series import open_series as open_febio
from validation.reference.grid.vtk import open_series as open_vtk
from validation.reference.kinds import kind_of
from validation.reference.mesh.model import mesh_model

PERIOD = 2.392 / 3
CELLS, FEW = (
    rays((np.arange(n_x) + 0.5) * 15e-3 / n_x, (np.arange(n_phi) + 0.5) * 2 * np.pi / n_phi)
    for n_x, n_phi in ((120, 48), (12, 8))
)
PARTS = {name: {"array": "Domain_ID", "values": [n]} for name, n in (("lumen", 1), ("wall", 2))}
ARRAYS = {"velocity": "Velocity", "pressure": "Pressure", "displacement": "Displacement"}
DOMAIN = {
    name: {"array": "domain", "values": values} for name, values in (("lumen", [1, 2]), ("wall", [3, 4]))
}
OF_FEBIO = {"velocity": "nodal fluid velocity", "pressure": "fluid pressure", "displacement": "displacement"}


def case_of(folder: Path, reference: dict[str, Any]) -> Any:
    """The ready case without calcification and this reference."""
    content = small_case("none")
    content["compare"]["bands"] = []
    content["variants"]["none"]["reference"] = reference
    del content["reference"]
    return load_case_file(written(content, folder)).variants["none"]


def write_states(folder: Path, cells: int, most: int) -> None:
    around = max(16, round((cells / 3.3) ** (1 / 3)))
    tube = Tube(around, around // 3, round(cells / (around * (around // 3 + 1))), 1)
    grid = grid_of(*cells_of(tube, "hexahedra"))
    grid.save(folder / "state_0.vtu")
    for number in range(1, most):
        os.link(folder / "state_0.vtu", folder / f"state_{number}.vtu")
    megabytes = (folder / "state_0.vtu").stat().st_size / 1e6
    print(f"{grid.n_cells} cells, {grid.n_points} points, {megabytes:.0f} MB a file", flush=True)


def measured(folder: Path, states: int) -> None:
    """Read and map so many states of one cycle; print time and peak memory."""
    rule = {"result_files": str(folder / "state_{:d}.vtu"), "last": states - 1}
    rule["time_step"] = f"{PERIOD / (states - 1)} s"
    case = case_of(folder, {"kind": "vtk", "axis": "x", "phi_zero": "y"} | rule | ARRAYS | PARTS)
    start, begun = time.perf_counter(), []
    kind_of("none", case).read(case, FEW, lambda _done, _all: begun.append(time.perf_counter()), None)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    each = (begun[-1] - begun[0]) / (states - 1)
    first = begun[0] - start - each
    print(f"{states:5} states: peak {peak:.0f} MB; {each:.2f} s a state, {first:.0f} s before", flush=True)


def of_febio(folder: Path) -> None:
    """Seconds a state of the ready run takes to be read and to be mapped, from both kinds of files."""
    with open_plot(RUNS / "local.xplt") as opened:
        export_plot(opened, folder / "febio", "vtu")
    frame = {"axis": "z", "phi_zero": "x"}
    plot = {"kind": "febio", "plot_file": str(RUNS / "local.xplt"), "lumen": ["LumenCore", "Lumen"]}
    files = {"kind": "vtk", "result_files": str(folder / "febio" / "local.pvd")} | DOMAIN | OF_FEBIO
    for name, opening, stated in (("xplt", open_febio, plot), ("vtu", open_vtk, files)):
        case = case_of(folder, frame | stated | {"time_offset": "0.199333 s"})
        with opening(case.reference) as series:
            model = mesh_model(series, case.reference)
            mapper = Mapper(model.mesh, CELLS)
            mapper.map_state(*model.read(0))
            times = []
            for number in range(1, 12):
                begun = time.perf_counter()
                state = model.read(number)
                read = time.perf_counter()
                mapper.map_state(*state)
                times.append((read - begun, time.perf_counter() - read))
        read, mapped = 1e3 * np.median(times, axis=0)
        print(f"{name:5} {read:.1f} ms to read a state, {mapped:.1f} ms to map it", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cells", type=int, default=1_000_000)
    parser.add_argument("--states", type=int, nargs="+", default=[3, 10])
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--only", type=int, help=argparse.SUPPRESS)  # states, of files that are there
    options = parser.parse_args()
    if options.only:
        measured(options.folder, options.only)
        return 0
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        of_febio(Path(name))
        write_states(Path(name), options.cells, max(options.states))
        for states in options.states:
            itself = [sys.executable, __file__, "--folder", name, "--only", str(states)]
            subprocess.run(itself, check=True)  # noqa: S603 - this file
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
