"""What a calibration found, for people: tables of parameters and targets, and how sure the numbers are."""

import numpy as np
from rich.table import Table

from cases.fields import FIELDS
from cases.reading.calibration_file import Calibration
from validation.calibrate.fit import Fit, misses
from validation.calibrate.output import parameter_records
from validation.calibrate.targets import Observed
from validation.calibrate.time_step import words

MOST_ROWS = 20  # of the table of targets


def parameter_table(calibration: Calibration, found: Fit) -> Table:
    """Parameters for the terminal, SI."""
    table = Table("parameter", "value", "standard error", "the case states", "unit")
    for record in parameter_records(calibration, found):
        error, stated = record["standard_error"], record["case_states"]
        table.add_row(
            record["key"],
            f"{record['value']:.6g}",
            "–" if error is None else f"{error:.2g} ({100 * abs(error / record['value']):.2g} %)",
            "–" if stated is None else f"{stated:.6g}",
            record["unit"],
        )
    return table


def target_table(wanted: Observed, found: Fit) -> Table:
    """Targets for the terminal, in the units people read."""
    table = Table("target", "value", "attained", "difference", "unit")
    rows = zip(wanted.names, wanted.quantities, wanted.values, found.attained, strict=True)
    for name, quantity, value, attained in rows:
        field = FIELDS[quantity]
        factor = field.display_factor
        share = f"{100 * (attained / value - 1):+.2g} %"
        table.add_row(name, f"{value * factor:.6g}", f"{attained * factor:.6g}", share, field.display_unit)
    return table


def remarks(calibration: Calibration, wanted: Observed, found: Fit) -> list[str]:
    """Sentences that say how sure the numbers are."""
    names = [parameter.key.name for parameter in calibration.parameters]
    told = [f"{found.runs} runs" + (f", {found.failed} of which failed on the way" if found.failed else "")]
    if found.step is not None and calibration.error_tolerance is not None:
        told.append(words(found.step, wanted, calibration.error_tolerance))
    told += [
        f"errors of {names[a]} and {names[b]} are correlated: {found.correlation[a, b]:+.2f}"
        for a, b in zip(*np.triu_indices(len(names), 1), strict=True)
    ]
    if found.standard_errors is None:
        told.append(
            "as many targets as parameters: no standard errors; state each target's uncertainty for them"
        )
    if len(wanted.names) > MOST_ROWS:
        told.append(misses(wanted, found.attained))
    return told
