"""Data of the page's picture of the samples."""

from typing import Any

import numpy as np
import pandas as pd

from cases.results.sweep import KeptOutput, VariedParameter
from reports.sweep.amounts import is_error
from reports.sweep.folder import OK, Sweep, shown
from reports.sweep.responses import logarithmic

MOST_SAMPLES = 5000  # points that a browser still moves at ease


def page_data(sweep: Sweep) -> dict[str, Any]:
    """Return JSON values for the page's scripts: display units, every n-th sample of a very large sweep."""
    done = sweep.samples[sweep.samples["status"] == OK]
    done = done.iloc[:: -(-len(done) // MOST_SAMPLES) or 1]
    judged = [k for k, output in enumerate(sweep.study.outputs) if output.band]
    errors = [k for k, output in enumerate(sweep.study.outputs) if is_error(output)]
    return {
        "variants": sweep.variants,
        "variant": [sweep.variants.index(name) for name in done["variant"]],
        "sample": [int(number) for number in done["sample"]],
        "start": next(iter((*judged, *errors)), 0),
        "parameters": [
            {**_column(p, done), "logarithmic": logarithmic(p, done)} for p in sweep.study.parameters
        ],
        "outputs": [
            {**_column(o, done), "limits": [_limit(sweep, variant, o) for variant in sweep.variants]}
            for o in sweep.study.outputs
        ],
    }


def _column(item: VariedParameter | KeptOutput, samples: pd.DataFrame) -> dict[str, object]:
    values = [float(f"{value:.6g}") if np.isfinite(value) else None for value in shown(item, samples)]
    return {"label": item.label, "unit": item.unit, "values": values}


def _limit(sweep: Sweep, variant: str, output: KeptOutput) -> float | None:
    band = sweep.band(variant, output)
    return None if band is None else float(f"{band.limit * output.display_factor:.6g}")
