"""Sections of a sweep's page: where bands hold, and outputs over parameters."""

from collections.abc import Sequence
from functools import partial
from itertools import combinations, islice

import numpy as np
import pandas as pd

from cases.results.sweep import KeptOutput, VariedParameter
from reports.blocks import Block, Figure, Interactive, Paragraph, Section, Subsection
from reports.sweep.amounts import amount, axis_label, ends, is_error, steady
from reports.sweep.folder import Sweep, shown
from reports.sweep.held import Held, sentence, varied
from reports.sweep.scatter import Abscissa, Ordinate, Plane, planes, responses
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import fixed, listed, plus

_ROWS = 5  # outputs of one figure
_COLUMNS = 4  # parameters side by side
_PAIRS = 3
_DECADES = 20.0  # largest over least value of a parameter that is drawn logarithmically


def logarithmic(parameter: VariedParameter, samples: pd.DataFrame) -> bool:
    """Whether a parameter spans so much that only a logarithmic axis shows it."""
    values = samples[parameter.name].to_numpy(dtype=float)
    return bool(values.size and values.min() > 0 and values.max() >= _DECADES * values.min())


def _abscissa(parameter: VariedParameter, samples: pd.DataFrame) -> Abscissa:
    return Abscissa(axis_label(parameter), shown(parameter, samples), logarithmic(parameter, samples))


def _ordinate(sweep: Sweep, variant: str, output: KeptOutput, samples: pd.DataFrame) -> Ordinate:
    band = sweep.band(variant, output)
    values = shown(output, samples)
    limit = np.nan if band is None else band.limit * output.display_factor
    ok = np.ones(values.size, dtype=bool) if band is None else np.abs(values) <= limit
    return Ordinate(axis_label(output), values, float(limit), ok)


def _size(found: Held) -> Ordinate:
    """Return what a limit is compared with: the size of an output."""
    values, factor = found.samples[found.output.name].to_numpy(dtype=float), found.output.display_factor
    label = axis_label(found.output)
    return Ordinate(
        f"size of {label}" if values.size and values.min() < 0 else label,
        found.sizes * factor,
        found.band.limit * factor,
        found.ok,
    )


def influence(
    sweep: Sweep, variant: str, output: KeptOutput, samples: pd.DataFrame
) -> list[tuple[float, VariedParameter]]:
    """Sort parameters by their total Sobol index, or where there is none by |rank correlation|."""
    totals = {
        row.parameter: row.ST
        for row in sweep.study.sensitivity or ()
        if (row.variant, row.output) == (variant, output.name) and row.ST is not None
    }
    found = [
        (
            totals.get(parameter.name, abs(_correlation(samples, parameter, output))),
            parameter,
        )
        for parameter in sweep.study.parameters
    ]
    return sorted(found, key=lambda pair: -pair[0])


def _correlation(samples: pd.DataFrame, parameter: VariedParameter, output: KeptOutput) -> float:
    """Rank correlation (Spearman); 0 where one of both does not vary."""
    ranks = samples[[parameter.name, output.name]].dropna().rank().to_numpy()
    if not len(ranks) or np.ptp(ranks, axis=0).min() == 0:
        return 0.0
    return float(np.corrcoef(ranks.T)[0, 1])


def _csv(sweep: Sweep, samples: pd.DataFrame, outputs: Sequence[KeptOutput]) -> str:
    names = ["sample", *(p.name for p in sweep.study.parameters), *(o.name for o in outputs)]
    return comma_separated(names, samples[names].itertuples(index=False, name=None), 6)


def _map(sweep: Sweep, number: int, found: Held) -> Figure | None:
    """Draw the samples over pairs of the parameters that matter most; None with a single parameter."""
    order = [p for _, p in influence(sweep, found.variant, found.output, found.samples)]
    order = [p for p in order if varied(p, found.samples)]
    as_stated = sweep.study.parameters.index
    pairs = [
        sorted(pair, key=as_stated)
        for pair in islice(combinations(order, 2), _PAIRS if len(order) > 2 else 1)
    ]
    if not pairs or not len(found.samples):
        return None
    grid = sweep.study.design.kind == "grid" and len(sweep.study.parameters) == 2
    drawn = [
        Plane(_abscissa(across, found.samples), _abscissa(up, found.samples), grid) for across, up in pairs
    ]
    words = "; ".join(f"{up.label} over {across.label}" for across, up in pairs)
    line = f" The line is where it meets the limit, {amount(found.output, found.band.limit)}." if grid else ""
    said = sentence(found, sweep.study.parameters)
    return Figure(
        key=f"held-{number}",
        caption=f"Where the band holds: {found.output.label} of each sample as colour, {words}. Circles are "
        f"within the limit, crosses beyond it.{line} What to see: the "
        "border between both; whether it runs along an axis tells whether that parameter alone decides.",
        alt=f"Samples over {words}, coloured by the {found.output.label}. {said}",
        drawing=partial(planes, drawn, _size(found)),
        csv=_csv(sweep, found.samples, [found.output]),
    )


def held_section(sweep: Sweep, bands: Sequence[Held]) -> Section:
    """Build the section of the maps of where bands hold."""
    title = "Where the bands hold"
    if not bands:
        told = "The study judges nothing by a band, so there is nothing to hold or to fail."
        return Section("held", title, (Paragraph(told),))
    divided = [found for found in bands if found.ok.any() and not found.ok.all()]
    figures = [figure for k, found in enumerate(divided, start=1) if (figure := _map(sweep, k, found))]
    if not figures:
        told = (
            "One parameter is varied: its response curves show where each band holds."
            if divided
            else "Each band holds in all samples or in none: there is no border to show."
        )
        return Section("held", title, (Paragraph(told),))
    several = len(sweep.study.parameters) > 2
    whole = [found for found in bands if found not in divided]
    named = "; ".join(f"{found.output.label} ({found.variant})" for found in whole)
    without = f"Without a border, held in all samples or in none, so not drawn: {named}." if whole else ""
    told = without + (
        " Of more than two parameters the pairs are shown that the output depends on most, by total Sobol "
        "index where the design gives it, else by rank correlation; the others vary within a picture."
        if several
        else ""
    )
    opening = (Paragraph(told.strip()),) if told else ()
    return Section("held", title, (*opening, *figures))


def _strongest(sweep: Sweep, output: KeptOutput, samples: pd.DataFrame) -> str:
    """Say what an output ranges over, and which parameter it follows most."""
    values = samples[output.name].to_numpy(dtype=float)
    values = values[np.isfinite(values)]
    if not values.size:
        return f"{output.label}: no value"
    low, high = float(values.min()), float(values.max())
    between = f"{output.label} {ends(output, low, high)}"
    if steady(low, high):
        return between
    correlation, parameter = max(
        ((_correlation(samples, p, output), p) for p in sweep.study.parameters), key=lambda pair: abs(pair[0])
    )
    return f"{between}, follows {parameter.label} most (rank correlation {plus(fixed(correlation, 2))})"


def _curves(sweep: Sweep, variant: str, key: str) -> tuple[Figure, ...]:
    samples = sweep.done(variant)
    parameters = [p for p in sweep.study.parameters if varied(p, samples)]
    outputs = [o for o in sweep.study.outputs if np.isfinite(samples[o.name].to_numpy(dtype=float)).any()]
    outputs.sort(key=lambda output: (sweep.band(variant, output) is None, not is_error(output)))
    figures = []
    for first in range(0, len(outputs), _ROWS):
        rows = outputs[first : first + _ROWS]
        for start in range(0, len(parameters), _COLUMNS):
            columns = parameters[start : start + _COLUMNS]
            what = listed(output.label for output in rows)
            over = listed(parameter.label for parameter in columns)
            said = "; ".join(_strongest(sweep, output, samples) for output in rows)
            figures.append(
                Figure(
                    key=f"{key}-{first + 1}-{start + 1}",
                    caption=f"Variant {variant}: {what} of each sample over {over}; the line is the mean of "
                    "neighbouring samples. What to see: a steep line is an effect, a wide cloud around it "
                    f"that of the other parameters. {said}.",
                    alt=f"Samples of variant {variant}: {what} over {over}. {said}.",
                    drawing=partial(
                        responses,
                        [_abscissa(parameter, samples) for parameter in columns],
                        [_ordinate(sweep, variant, output, samples) for output in rows],
                    ),
                    csv=_csv(sweep, samples, rows),
                )
            )
    return tuple(figures)


def responses_section(sweep: Sweep) -> Section:
    """Build the section of the response curves."""
    picture = Interactive(
        "samples-any",
        "samples",
        "Any output over any parameter",
        "Choose; point at a sample for all that was varied in it.",
    )
    parts: list[Block | Subsection] = [picture]
    for k, variant in enumerate(sweep.variants, start=1):
        figures = _curves(sweep, variant, f"responses-{k}")
        none = (Paragraph(f"No sample of variant {variant} has a value, or nothing varies in them."),)
        parts.append(Subsection(f"responses-{k}", f"Variant {variant}", figures or none))
    return Section("responses", "Response curves", tuple(parts))
