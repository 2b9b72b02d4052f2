"""``python -m solver CASE.yaml [--variant NAME] --output FILE.nc``: run the reduced model alone."""

import argparse
import sys
from pathlib import Path

import xarray as xr

from cases.case_file import CaseFile, load_case_file
from cases.errors import CaseError
from cases.schema import Case
from solver.errors import SolverError
from solver.files import check_folder, write_netcdf
from solver.from_case import default_output_times, model_of
from solver.progress import progress_bar
from solver.result import to_dataset
from solver.simulate import simulate

WRONG_INPUT, INTERRUPTED = 2, 130


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m solver", description="Run the 2D reduced-order model.")
    parser.add_argument("case", type=Path, help="case file (YAML)")
    parser.add_argument("--variant", help="variant of the case file (needed where it has several)")
    parser.add_argument("--output", type=Path, required=True, help="result file (NetCDF), e.g. run.nc")
    return parser.parse_args()


def chosen_variant(file: CaseFile, name: str | None) -> str:
    """Name of the variant to run.

    Raises
    ------
    SolverError
        Where the name is unknown, or none is given and there are several.
    """
    names = ", ".join(file.variants)
    if name is None and len(file.variants) == 1:
        return next(iter(file.variants))
    if name is None:
        raise SolverError(f"{file.path}: has several variants; choose one with --variant: {names}")
    if name not in file.variants:
        raise SolverError(f"{file.path}: has no variant {name!r}; allowed: {names}")
    return name


def run(case: Case, label: str) -> xr.Dataset:
    """Run a case from the steady state of its first inlet velocity; see :func:`solver.result.to_dataset`."""
    with progress_bar(label) as progress:
        trajectory = simulate(
            model_of(case), default_output_times(case), case.solver.time_step, progress=progress
        )
    return to_dataset(trajectory)


def main() -> int:
    """Run the command; return its exit status."""
    arguments = _arguments()
    try:
        check_folder(arguments.output)
        file = load_case_file(arguments.case)
        variant = chosen_variant(file, arguments.variant)
        dataset = run(file.variants[variant], f"{file.name} {variant}")
        dataset.attrs.update(case=file.name, title=file.title, variant=variant, case_yaml=file.text)
        write_netcdf(dataset, arguments.output)
    except (CaseError, SolverError) as error:
        print(error, file=sys.stderr)
        return WRONG_INPUT
    except KeyboardInterrupt:
        print("interrupted; nothing was written", file=sys.stderr)
        return INTERRUPTED
    print(
        f"{arguments.output}: {dataset.attrs['steps']} steps of at most {dataset.attrs['time_step_s']:.6g} s"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
