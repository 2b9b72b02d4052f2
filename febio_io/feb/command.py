"""The command ``python -m febio_io.feb``: the FEBio model of a case file.

It alone joins the two models: the reduced one finds the periodic state in which FEBio's Windkessel starts.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from cases.arrays import Floats
from cases.errors import QuantityError
from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from febio_io.feb.model import FebioModelError, MeshSize, Windkessel
from febio_io.feb.windkessel_start import CLOSE

if TYPE_CHECKING:
    from cases.reading.case_file import CaseFile
    from cases.sections.case import Case
    from febio_io.feb.from_case import Choices


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 if the case or an option is wrong or the model cannot be written, 130 interrupted."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen), "interrupted; no model was written")


def _run(options: argparse.Namespace) -> int:
    with imports():
        from cases.reading.case_file import load_case_file
        from febio_io.feb.from_case import artery_model
        from febio_io.feb.writer import write_model

    if options.output.suffix != ".feb":
        raise FebioModelError(f"--output {options.output}: allowed: a name that ends in .feb")
    file = load_case_file(options.case, results_exist=False)
    name, case = _variant(file, options.variant)
    flow = partial(_periodic_flow, f"{file.name} {name}")
    model = artery_model(case, _choices(options, case), flow)
    begin = time.perf_counter()
    for warning in write_model(model, options.output):
        print(f"warning: {options.case}: {name}: {warning}", file=sys.stderr)
    print(
        f"wrote {options.output}: {file.name}, {name}: {model.size.n_elements} elements, "
        f"{model.timing.n_steps} steps of {model.timing.time_step:.6g} s "
        f"({time.perf_counter() - begin:.1f} s)"
    )
    if isinstance(model.outlet, Windkessel):
        print(_started(model.outlet))
    return COMPLETE


def _periodic_flow(label: str, case: Case) -> Floats:
    with imports():
        from cases.shell.terminal import progress_bar
        from solver.case.periodic_outlet import periodic_outlet_flow

    with progress_bar(label) as progress:
        return periodic_outlet_flow(case, progress)


def _started(outlet: Windkessel) -> str:
    """Tell where a Windkessel starts and what that saves."""
    from solver.case.periodicity import PERIODIC

    cycles = outlet.cycles_from_rest
    return (
        f"outlet: starts within {100 * PERIODIC:g} % of its periodic pressure by the reduced model, "
        f"{outlet.start / 1e3:.4g} kPa; started from zero it would take {cycles} "
        f"cycle{'' if cycles == 1 else 's'} to come within {100 * CLOSE:g} %"
    )


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Write the FEBio model (.feb) of a case, a fluid-structure simulation in 3D.",
        epilog="python -m febio_io.run MODEL.feb runs it. Options left out are those of the case's "
        "reference.generate, if it states any.",
    )
    parser.add_argument("case", type=Path, metavar="CASE.yaml", help="a case file")
    parser.add_argument(
        "--variant", metavar="NAME", help="which of its variants; not needed where it has one"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="MODEL.feb", help="the model to write")
    parser.add_argument(
        "--mesh",
        metavar="N,N,N,N",
        help="elements around, from the axis to the wall, through the wall, and along (24,8,3,30)",
    )
    parser.add_argument(
        "--bias", type=float, metavar="B", help="radial size at the axis over that at the wall (1)"
    )
    parser.add_argument(
        "--core", choices=("wedges", "o_grid"), help="elements at the axis: wedges (default), or squares"
    )
    parser.add_argument("--cycles", type=int, metavar="N", help="cycles after the ramp (2)")
    parser.add_argument("--time-step", metavar="TIME", help='e.g. "1 ms" (a 200th of the cycle)')
    parser.add_argument("--states-per-cycle", type=int, metavar="N", help="states of the plot file (40)")
    parser.add_argument(
        "--data-records",
        action="store_true",
        help="have FEBio write some values as text, to check the plot file by",
    )
    return parser.parse_args(argv)


def _variant(file: CaseFile, wanted: str | None) -> tuple[str, Case]:
    names = list(file.variants)
    if wanted is None and len(names) == 1:
        wanted = names[0]
    if wanted not in file.variants:
        found = "none is chosen" if wanted is None else f"it has no {wanted!r}"
        raise FebioModelError(f"{file.path}: {found}; --variant allows: {', '.join(names)}")
    return wanted, file.variants[wanted]


def _choices(options: argparse.Namespace, case: Case) -> Choices:
    """Options where they are given, else what the case states, else the defaults."""
    from cases.sections.references.febio import MOST_CYCLES, MOST_STATES_PER_CYCLE, FebioReference, Generate
    from febio_io.feb.from_case import Choices

    reference = case.reference
    own = reference.generate if isinstance(reference, FebioReference) else None
    stated = own or Generate()
    n_theta, n_r, n_wall, n_z = stated.mesh if options.mesh is None else _mesh(options.mesh)
    step = stated.time_step if options.time_step is None else _time_step(options.time_step)
    records = options.data_records or stated.data_records
    return Choices(
        size=MeshSize(
            *(n_theta, n_r, n_wall, n_z),
            bias=stated.bias if options.bias is None else options.bias,
            core=options.core or stated.core,
        ),
        cycles=_count("--cycles", options.cycles, stated.cycles, MOST_CYCLES),
        time_step=step,
        states_per_cycle=_count(
            "--states-per-cycle", options.states_per_cycle, stated.states_per_cycle, MOST_STATES_PER_CYCLE
        ),
        records=options.output.stem if records else None,
    )


def _mesh(text: str) -> list[int]:
    counts = text.split(",")
    if len(counts) != 4 or not all(count.strip().isdecimal() and len(count) < 10 for count in counts):
        raise FebioModelError(
            f"--mesh {text}: allowed: four whole numbers, around, from the axis to the wall, through the "
            "wall and along the artery, e.g. 24,8,3,30"
        )
    return [int(count) for count in counts]


def _count(option: str, given: int | None, otherwise: int, most: int) -> int:
    if given is not None and not 1 <= given <= most:
        raise FebioModelError(f"{option} {given}: allowed: 1 to {most}")
    return otherwise if given is None else given


def _time_step(text: str) -> float:
    from cases.values.ranges import TIME_STEPS
    from cases.values.units import DIMENSIONS, parse_quantity

    try:
        step = parse_quantity(text, DIMENSIONS[TIME_STEPS.dimension])
    except QuantityError as error:
        raise FebioModelError(f'--time-step {text}: {error}; allowed: {TIME_STEPS}, e.g. "1 ms"') from error
    if step not in TIME_STEPS:
        raise FebioModelError(f'--time-step {text}: allowed: {TIME_STEPS}, e.g. "1 ms"')
    return step
