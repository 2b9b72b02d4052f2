"""What a calibration leaves: every number as JSON, and the fitted keys as YAML."""

from pathlib import Path
from typing import Any

import numpy as np

from cases.fields import FIELDS
from cases.reading.calibration_file import Calibration
from cases.shell.whole import write_text, writing
from validation.calibrate.fit import Fit
from validation.calibrate.fitted_case import require_none_read, snippet
from validation.calibrate.targets import Observed
from validation.calibrate.time_step import StepOfRuns
from validation.errors import ValidationError
from validation.metrics.statistics import rms
from validation.runs.output import write_json
from validation.runs.provenance import provenance

RECORD, KEYS = "calibration.json", "calibration.yaml"


def record_of(calibration: Calibration, wanted: Observed, found: Fit, command: list[str]) -> dict[str, Any]:
    """Return a calibration as data for JSON, SI."""
    case = calibration.case
    difference = found.attained - wanted.values
    return {
        "name": calibration.name,
        "title": calibration.title,
        "variant": calibration.variant,
        "parameters": parameter_records(calibration, found),
        "correlation": found.correlation.tolist(),
        "condition": found.condition,
        "targets": _target_records(wanted, found),
        "rms_difference": rms(difference) if len(set(wanted.quantities)) == 1 else None,
        "rms_scaled_difference": rms(difference / wanted.scales),
        "scaled_by": "stated uncertainties" if wanted.uncertain else "size of the values",
        "error_tolerance": calibration.error_tolerance,
        "time_step": None if found.step is None else _step_record(wanted, found.step),
        "runs": found.runs,
        "failed_runs": found.failed,
        "provenance": provenance(calibration.path, [calibration.file.path, *case.input_files], command),
    }


def parameter_records(calibration: Calibration, found: Fit) -> list[dict[str, Any]]:
    """Return each parameter as data."""
    errors = [None] * found.values.size if found.standard_errors is None else found.standard_errors.tolist()
    return [
        {
            "key": parameter.key.name,
            "unit": parameter.key.kind.unit,
            "value": value,
            "standard_error": error,
            "case_states": parameter.key.value,
            "low": parameter.low,
            "high": parameter.high,
            "start": parameter.start,
        }
        for parameter, value, error in zip(calibration.parameters, found.values.tolist(), errors, strict=True)
    ]


def _target_records(wanted: Observed, found: Fit) -> list[dict[str, Any]]:
    numbers = zip(wanted.quantities, wanted.names, wanted.values, found.attained, wanted.scales, strict=True)
    return [
        {
            "quantity": quantity,
            "words": words,
            "unit": FIELDS[quantity].unit,
            "value": float(value),
            "attained": float(attained),
            "uncertainty": float(scale) if wanted.uncertain else None,
        }
        for quantity, words, value, attained, scale in numbers
    ]


def _step_record(wanted: Observed, step: StepOfRuns) -> dict[str, Any]:
    """Time step of all runs as data: with its largest error, None where a run failed, and where that is."""
    return {
        "time_step_s": step.choice.time_step,
        "case_time_step_s": step.own,
        "error": step.choice.error if np.isfinite(step.choice.error) else None,
        "target": wanted.names[step.choice.worst],
        "samples": step.runs,
    }


def check_results(folder: Path, calibration: Calibration) -> None:
    """Refuse, before anything is computed, a folder in which :func:`write_results` would replace other files.

    Raises
    ------
    ValidationError
        If a result's file is one that the calibration reads, or lies there without the other one.
    """
    with writing(folder, ValidationError):
        for name in (RECORD, KEYS):
            require_none_read(folder / name, calibration, "--output")
        alone = (folder / KEYS).exists() and not (folder / RECORD).exists()
    if alone:
        raise ValidationError(
            f"{folder / KEYS}: is there already, and is no result of a calibration; remove it or choose "
            "another --output"
        )


def write_results(
    folder: Path, calibration: Calibration, wanted: Observed, found: Fit, command: list[str]
) -> None:
    """Write calibration.json and calibration.yaml, each whole or not at all.

    Raises
    ------
    ValidationError
        If they cannot be written.
    """
    with writing(folder, ValidationError):
        folder.mkdir(parents=True, exist_ok=True)
        write_json(folder / RECORD, record_of(calibration, wanted, found, command))
        write_text(folder / KEYS, snippet(calibration, found.values))
