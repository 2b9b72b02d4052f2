"""Section of the verdict of a sweep's page."""

from collections.abc import Sequence

import numpy as np

from cases.results.metric_row import Status
from cases.results.sweep import FAILED, VariedParameter
from reports.blocks import Block, Bullets, Column, Paragraph, Section, Table, Warnings, numbers
from reports.sweep.amounts import amount, ends, is_error
from reports.sweep.folder import Sweep
from reports.sweep.held import Held, sentence
from reports.wording.numbers import ABSENT, counted, share

_AGAINST = {
    "coupled": "Errors are against the coupled 2D model (membrane wall, one pressure a section) of the same "
    "sample, not against 3D: what both 2D models miss is not seen here.",
    "reference": "Errors are against the one 3D run of the base case, whatever the sample's parameters are: "
    "they tell how far a changed input moves the model from that run.",
}


def headline(sweep: Sweep, bands: Sequence[Held]) -> str:
    """Say in one line how many samples are within all their bands."""
    counts = sweep.study.counts
    if not bands:
        ran = f"{len(sweep.samples)} of {counted(counts.total, 'sample')} run; no band judges them."
        errors = _errors(sweep)
        return f"{ran} Median and largest error: {errors}." if errors else ran
    judged = [found for found in bands if len(found.ok)]
    if not judged:
        return "No sample has a value that a band could judge."
    inside: dict[int, bool] = {}
    for found in judged:
        for number, ok in zip(found.samples["sample"], found.ok, strict=True):
            inside[int(number)] = inside.get(int(number), True) and bool(ok)
    within = sum(inside.values())
    return (
        f"{within} of {counted(len(inside), 'judged sample')} ({share(within / len(inside))}) are within all "
        "their bands."
    )


def _errors(sweep: Sweep) -> str:
    """Say how large the errors are over all samples; "" where the samples are compared with nothing."""
    said = []
    for output in filter(is_error, sweep.study.outputs):
        sizes = np.abs(sweep.samples[output.name].to_numpy(dtype=float))
        sizes = sizes[np.isfinite(sizes)]
        if sizes.size:
            middle, largest = (amount(output, float(size)) for size in (np.median(sizes), sizes.max()))
            said.append(f"{output.label} {middle} and {largest}")
    return "; ".join(said)


def _state(sweep: Sweep) -> tuple[str, ...]:
    """Say what keeps the sweep from being complete."""
    counts, said = sweep.study.counts, []
    if sweep.study.state != "finished":
        said.append(
            f"The sweep is {sweep.study.state}: {len(sweep.samples)} of {counts.total} samples are recorded, "
            "and every figure below is of these only."
        )
    failed = int((sweep.samples["status"] == FAILED).sum())
    if failed:
        said.append(
            f"{counted(failed, 'sample')} of {len(sweep.samples)} "
            f"({share(failed / len(sweep.samples))}) failed: they have no value and count neither "
            "as held nor as failed bands. The errors are listed below."
        )
    return tuple(said)


def _unknown(sweep: Sweep) -> tuple[str, ...]:
    ranges = "; ".join(f"{p.label} {_range(sweep, p)}" for p in sweep.study.parameters)
    said = [f"Outside what was sampled ({ranges}) nothing is said."]
    nothing = "The samples are compared with nothing: this page shows how outputs change, not errors."
    return (*said, _AGAINST.get(sweep.study.against or "", nothing))


def _range(sweep: Sweep, parameter: VariedParameter) -> str:
    values = sweep.samples[parameter.name].to_numpy(dtype=float)
    return ends(parameter, float(values.min()), float(values.max()))


def status(found: Held) -> Status:
    """Judge a band over all its samples: OK only where every one is within it."""
    if not len(found.ok):
        return "MISSING"
    return "OK" if found.ok.all() else "FAIL"


def _bands(bands: Sequence[Held]) -> Table:
    rows = []
    for found in sorted(bands, key=lambda f: float(f.ok.mean()) if len(f.ok) else -1.0):
        sizes = found.sizes
        count = len(sizes)
        worst = int(sizes.argmax()) if count else 0
        rows.append(
            (
                found.variant,
                status(found),
                found.output.label,
                amount(found.output, found.band.limit),
                f"{int(found.ok.sum())} of {count}",
                amount(found.output, float(np.median(sizes))) if count else ABSENT,
                f"{amount(found.output, float(sizes[worst]))}" if count else ABSENT,
                str(int(found.samples["sample"].iloc[worst])) if count else ABSENT,
                found.band.reason,
            )
        )
    return Table(
        "bands",
        "Every band over all samples that have a value, the smallest share that holds first; OK means in "
        "every sample. The worst sample is named by its number.",
        (
            Column("variant"),
            Column("verdict", "status"),
            Column("quantity", "prose"),
            *numbers("limit", "holds in", "median", "worst", "sample"),
            Column("reason for the limit", "prose"),
        ),
        tuple(rows),
        rule_by=1,
    )


def verdict_section(sweep: Sweep, bands: Sequence[Held]) -> Section:
    """Build the first section."""
    blocks: list[Block] = [Paragraph(headline(sweep, bands), lead=True)]
    state = _state(sweep)
    if state:
        blocks.append(Warnings(state))
    if bands:
        blocks += [Bullets(tuple(sentence(found, sweep.study.parameters) for found in bands)), _bands(bands)]
    blocks += [Paragraph("What this sweep does not tell:"), Bullets(_unknown(sweep))]
    return Section("verdict", "Verdict", tuple(blocks))
