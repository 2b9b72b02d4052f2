"""One case: run the reduced model, read the reference, score, report."""

import json
from collections.abc import Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.reading.case_file import CaseFile
from cases.reading.models import labelled
from cases.reading.template import load_template
from cases.results.comparison_file import ERROR_BUDGET, PROFILE_ERROR_CURVE, variable
from cases.results.metric_row import MetricRow
from solver.case.model import inlet_signal
from validation.compare.account import described
from validation.compare.budget.inputs import input_uncertainty
from validation.compare.budget.judged import judged_quantities
from validation.compare.budget.parts import budget_array, budget_rows, budgets_of
from validation.compare.comparison import (
    VariantRun,
    all_models,
    at_common_instants,
    attributes,
    check_variants,
    without_fields,
)
from validation.compare.comparison_file import ComparisonFile, comparison_file
from validation.compare.outcome import Outcome
from validation.compare.paraview import write_walls
from validation.compare.rendering import load_reports, write_reports
from validation.compare.unchanged import determinants, seal
from validation.metrics import rows as metrics
from validation.metrics.assumptions import assumption_rows
from validation.metrics.bands import band_rows
from validation.metrics.confidence import confidence_rows
from validation.metrics.curved_section import curved_section_rows
from validation.metrics.pooled_change import pooled_change_rows, without_rays
from validation.metrics.profile_curves import error_curves, profile_rows
from validation.metrics.rows import Models, models_of
from validation.reference.generated import check_computed, check_stated
from validation.runs.cache import Cache
from validation.runs.output import result_directory, write_json, write_metrics
from validation.runs.reduced_model import ReducedModelRun
from validation.runs.variants import Watch, align_variants, resolved, run_variants, watching


def variant_rows(models: Models, run: VariantRun, attributes: Mapping[str, Any]) -> list[MetricRow]:
    """All rows of one variant, its bands' among them."""
    cells = (attributes["compare_i"], attributes["compare_j"])
    return [
        *band_rows(models, run.case),
        *metrics.pooled_rows(models),
        *confidence_rows(models),
        *metrics.cycle_rows(models),
        *metrics.check_rows(models),
        *metrics.value_rows(models, cells, attributes["compare_times_s"]),
        *metrics.cycle_error_rows(models, cells),
        *metrics.dominance_rows(models, cells),
        *assumption_rows(models, attributes),
        *curved_section_rows(models, attributes),
        *profile_rows(models, attributes),
        *metrics.plane_rows(models, run.reference.checks),
        *metrics.inflow_rows(models, run.reference.checks, prescribed_inflow(run)),
        *metrics.cost_rows(models, run.rom.description, run.reference.description),
    ]


def matched_rows(models: Models, matched: ReducedModelRun) -> list[MetricRow]:
    """Rows of all cells and states, and of the cycle, with the inflow of the 3D reference."""
    fields = matched.fields.assign_coords(time=models.rom["time"])
    driven = replace(models, rom=fields)
    rows = [*metrics.pooled_rows(driven), *metrics.cycle_rows(driven)]
    return [replace(row, inflow="matched") for row in rows]


def uncertain_inputs(
    file: CaseFile, name: str, model: str, run: VariantRun, watch: Watch
) -> Mapping[str, float] | None:
    """By quantity, what uncertain inputs leave open; None where the case says nothing of them."""
    if run.case.uncertainty is None:
        return None
    label = labelled(name, model, file.models)
    with watch.step(f"{label}: uncertain inputs"):
        return input_uncertainty(
            lambda: load_template(file.path, name, model=model, text=file.text),
            run.case,
            run.reference.alignment.rom_times,
            judged_quantities(),
            watch.cache,
            lambda said: watch.remarks.append(f"{label}: {said}"),
        )


def source_rows(
    models: Models, run: VariantRun, inputs: Mapping[str, float] | None, both: xr.Dataset
) -> list[MetricRow]:
    """Rows of what errors owe to what; the budget is added to the dataset of ``both`` models."""
    sources, stated = run.sources, run.case.uncertainty
    if sources is None:
        both[variable(models.model, ERROR_BUDGET)] = budget_array({})
        return []
    budgets = budgets_of(models, sources, inputs, stated is None or stated.shared_with_reference)
    both[variable(models.model, ERROR_BUDGET)] = budget_array(budgets)
    matched = [] if sources.matched is None else matched_rows(models, sources.matched)
    return [*matched, *budget_rows(models, budgets)]


def prescribed_inflow(run: VariantRun) -> Floats | None:
    """Flow rate that the case prescribes at the 3D inlet, m³/s; None where there is none to compare."""
    if "inlet_flow_rate" not in run.reference.checks:
        return None
    signal = inlet_signal(run.case)(run.reference.alignment.cycle_times)
    if run.case.inlet.kind == "velocity":
        return np.asarray(signal * run.reference.checks["inlet_area"].to_numpy())
    return signal if run.case.inlet.kind == "flow" else None


def compare_case(
    file: CaseFile,
    target: Path,
    command: list[str],
    cache: Cache | None = None,
    determined_by: str = "",
) -> Outcome:
    """Run one case file and leave its result in ``target``; see ``harness`` for what that holds.

    ``determined_by`` is the digest of what determines the result, taken when the file was read.

    Returns
    -------
    Outcome

    Raises
    ------
    CaseError, SolverError, FebioError, ValidationError
        For input that is wrong; ``target`` is then as it was.
    """
    check_stated(file)
    check_computed(file.path, file.variants)
    stated, determined_by = file, determined_by or determinants(file)
    with watching(cache) as watch, result_directory(target) as directory:
        file = replace(file, models=resolved(file.models, watch))
        check_variants(file.variants)
        rows, runs, notes = _compared(file, directory, watch)
        with watch.step("metrics"):
            write_metrics(directory, rows)
        account = described(file, runs, watch.wall_times, command, [*watch.remarks, *notes])
        write_json(directory / "provenance.json", account.written())
        with watch.step("reports"):
            write_reports(directory)
        seal(directory, stated, determined_by, account.created, account.warnings)
    return Outcome(rows, [*watch.remarks, *account.warnings])


Runs = dict[str, dict[str, VariantRun]]  # by variant and model


def _compared(file: CaseFile, directory: Path, watch: Watch) -> tuple[list[MetricRow], Runs, list[str]]:
    """Run all models of all variants; leave comparison.nc. Returns all rows, the runs, and notes."""
    alignments, notes = at_common_instants(file.variants, align_variants(file.variants, watch))
    times = alignments[next(iter(file.variants))].cycle_times
    about = attributes(file, times)
    rows: dict[tuple[str, str], list[MetricRow]] = {}
    runs: Runs = {}
    compared: dict[tuple[str, str], Models] = {}
    writing: list[Future[None]] = []
    with (
        comparison_file(directory / "comparison.nc", list(file.variants), about) as stored,
        ThreadPoolExecutor(max_workers=1) as writer,  # netCDF works outside the interpreter's lock
    ):
        for name, by_model in run_variants(file.models, alignments, watch, load_reports):
            fields = all_models(by_model, times)
            for model, run in by_model.items():
                inputs = uncertain_inputs(file, name, model, run, watch)
                with watch.step("metrics"):
                    told = {"sparse": run.reference.sparse, "stated": run.reference.cycle}
                    models = models_of(file.name, name, fields, about["period_s"], model, **told)
                    owed = source_rows(models, run, inputs, fields)
                    rows[name, model] = [*variant_rows(models, run, about), *owed]
                    compared[name, model] = without_rays(models)
            with watch.step("metrics"):
                fields[PROFILE_ERROR_CURVE] = error_curves(models, about)
            writing.append(writer.submit(_store, stored, name, fields, watch))
            with watch.step("files for ParaView"):
                write_walls(directory, name, list(file.models), fields)
            runs[name] = {model: without_fields(run) for model, run in by_model.items()}
        for written in writing:
            written.result()
    ordered = [row for name in file.variants for model in file.models for row in rows[name, model]]
    baselines = json.loads(about["baselines"])
    changes = [*metrics.change_rows(ordered, baselines), *pooled_change_rows(compared, baselines)]
    return ordered + changes, {name: runs[name] for name in file.variants}, notes


def _store(stored: ComparisonFile, name: str, both: xr.Dataset, watch: Watch) -> None:
    with watch.step("comparison.nc"):
        stored.write(name, both)
