"""``python -m validation.compare CASE.yaml``: run the reduced model, read the reference, score, report."""

import argparse
import shlex
import signal
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.case_file import CaseFile, load_case_file
from cases.errors import CaseError
from febio_io.errors import FebioError
from reports import ReportError, write_reports
from solver.errors import SolverError
from solver.files import write_netcdf
from solver.from_case import inlet_signal
from validation import metrics
from validation.account import described
from validation.bands import FAIL, MISSING, OK, band_rows
from validation.comparison import VariantRun, at_common_instants, check_variants, combine
from validation.errors import ValidationError
from validation.generated import check_computed
from validation.metrics import Row, models_of
from validation.output import check_target, result_directory, write_json, write_metrics
from validation.run import run_variants, watching

EXPECTED = (CaseError, SolverError, FebioError, ValidationError, ReportError)
COMPLETE, BAND_BROKEN, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


def variant_rows(comparison: xr.Dataset, name: str, run: VariantRun) -> list[Row]:
    """All rows of one variant, its bands' among them."""
    models = models_of(comparison, name)
    cells = (comparison.attrs["compare_i"], comparison.attrs["compare_j"])
    return [
        *band_rows(models, run.case),
        *metrics.pooled_rows(models),
        *metrics.cycle_rows(models),
        *metrics.check_rows(models),
        *metrics.value_rows(models, cells, comparison.attrs["compare_times_s"]),
        *metrics.cycle_error_rows(models, cells),
        *metrics.dominance_rows(models, cells),
        *metrics.plane_rows(models, run.reference.checks),
        *metrics.inflow_rows(models, run.reference.checks, prescribed_inflow(run)),
        *metrics.cost_rows(models, run.rom.description, run.reference.description),
    ]


def prescribed_inflow(run: VariantRun) -> NDArray[np.float64] | None:
    """Flow rate that the case prescribes at the 3D inlet, m³/s; None where it prescribes pressure."""
    signal = inlet_signal(run.case)(run.reference.alignment.cycle_times)
    if run.case.inlet.kind == "velocity":
        return np.asarray(signal * run.reference.checks["inlet_area"].to_numpy())
    return signal if run.case.inlet.kind == "flow" else None


@dataclass(frozen=True)
class Outcome:
    """Rows of the declared bands, and warnings that cast doubt on them."""

    bands: list[Row]
    warnings: list[str]


def compare_case(file: CaseFile, target: Path, command: list[str]) -> Outcome:
    """Run one case file and leave its result in ``target``; see ``harness`` for what that holds.

    Returns
    -------
    Outcome

    Raises
    ------
    CaseError, SolverError, FebioError, ValidationError, ReportError
        For input that is wrong; ``target`` is then as it was.
    """
    check_variants(file.variants)
    check_computed(file)
    with watching() as watch, result_directory(target) as directory:
        runs, notes = at_common_instants(run_variants(file.variants, watch))
        with watch.step("metrics"):
            comparison = combine(file, runs)
            rows = [row for name, run in runs.items() for row in variant_rows(comparison, name, run)]
            rows += metrics.change_rows(rows, comparison.attrs["baseline"])
            write_metrics(directory, metrics.to_frame(rows))
        with watch.step("comparison.nc"):
            write_netcdf(comparison, directory / "comparison.nc")
        account = described(file, runs, watch.wall_times, command, notes)
        write_json(directory / "provenance.json", account)
        with watch.step("reports"):
            write_reports(directory)
    return Outcome([row for row in rows if row.status], account["warnings"])


def summary(file: CaseFile, target: Path, bands: list[Row]) -> str:
    """One line for people."""
    counts = {status: sum(row.status == status for row in bands) for status in (OK, FAIL, MISSING)}
    verdict = ", ".join(f"{count} {status}" for status, count in counts.items() if count) or "none declared"
    return f"{file.name}: bands: {verdict}; report: {target / 'report.html'}, {target / 'report.pdf'}"


def _arguments(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m validation.compare",
        description="Compare the 2D reduced-order model with a 3D reference and write a report.",
        epilog="Exit status: 0 complete; 1 a band fails or is missing (with --check); 2 wrong input.",
    )
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE.yaml", help="case files")
    parser.add_argument(
        "--output",
        type=Path,
        metavar="DIR",
        help="result directory (default: results/NAME; with several cases: DIR/NAME)",
    )
    parser.add_argument("--check", action="store_true", help="exit 1 unless every band holds")
    return parser.parse_args(argv)


def targets(files: list[CaseFile], output: Path | None) -> list[Path]:
    """Choose the result directory of each case.

    Raises
    ------
    ValidationError
        If two cases have one name, or a target must not be replaced.
    """
    names = [file.name for file in files]
    if len(set(names)) < len(names):
        raise ValidationError(f"case names must differ, found: {', '.join(names)}")
    if output is not None and len(files) == 1:
        found = [output]
    else:
        found = [(output or Path("results")) / name for name in names]
    for target in found:
        check_target(target)
    return found


def _interrupt(*_: object) -> None:
    """Let a request to terminate clean up as Ctrl-C does."""
    raise KeyboardInterrupt


def main(argv: list[str] | None = None) -> int:
    """Run the command; return its exit status."""
    argv = sys.argv[1:] if argv is None else argv
    arguments = _arguments(argv)
    command = ["python", "-m", "validation.compare", *map(shlex.quote, argv)]
    broken = False
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        files = [load_case_file(path) for path in arguments.cases]
        for file, target in zip(files, targets(files, arguments.output), strict=True):
            outcome = compare_case(file, target, command)
            for warning in outcome.warnings:
                print(f"warning: {warning}", file=sys.stderr)
            bands = outcome.bands
            broken |= any(row.status in (FAIL, MISSING) for row in bands)
            print(summary(file, target, bands))
    except EXPECTED as error:
        print(error, file=sys.stderr)
        return WRONG_INPUT
    except KeyboardInterrupt:
        print("interrupted; no result was written", file=sys.stderr)
        return INTERRUPTED
    return BAND_BROKEN if broken and arguments.check else COMPLETE


if __name__ == "__main__":
    sys.exit(main())
