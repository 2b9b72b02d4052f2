"""Sections of a sweep's page: failed samples, design and provenance."""

import numpy as np

from cases.results.sweep import FAILED, ChosenTimeStep, KeptOutput, VariedParameter
from reports.blocks import Block, Column, Listing, Paragraph, Section, Table, numbers, prose
from reports.sections.provenance import pairs
from reports.sweep.amounts import DESIGNS, amount, is_error
from reports.sweep.folder import Sweep
from reports.wording.numbers import ABSENT, listed, rounded

_MOST_FAILURES = 200


def failures_section(sweep: Sweep) -> Section:
    """Build the section of the failed samples with their errors."""
    failed = sweep.samples[sweep.samples["status"] == FAILED]
    title = "Failed samples"
    if failed.empty:
        return Section("failures", title, (Paragraph("No sample failed."),))
    rows = tuple(
        (
            str(int(row["sample"])),
            str(row["variant"]),
            *(amount(p, float(row[p.name])) for p in sweep.study.parameters),
            str(row["error"]),
        )
        for _, row in failed.head(_MOST_FAILURES).iterrows()
    )
    more = f" The first {_MOST_FAILURES} of {len(failed)}." if len(failed) > _MOST_FAILURES else ""
    table = Table(
        "failed",
        f"Samples without a value, what was varied in them, and their error.{more}",
        (
            Column("sample", "number"),
            Column("variant"),
            *(Column(p.label, "number") for p in sweep.study.parameters),
            Column("error", "prose"),
        ),
        rows,
    )
    return Section("failures", title, (table,))


def _drawn(parameter: VariedParameter) -> str:
    """Say what values a parameter takes."""
    if parameter.values is not None and len(parameter.values) <= 8:
        listed_values = ", ".join(rounded(v * parameter.display_factor, 4) for v in parameter.values)
        return f"{parameter.kind}: {listed_values}"
    ends = f"{amount(parameter, parameter.low)} … {amount(parameter, parameter.high)}"
    count = "" if parameter.values is None else f", {len(parameter.values)} values"
    return f"{parameter.kind}: {ends}{count}"


def _parameters(sweep: Sweep) -> Table:
    return Table(
        "parameters",
        "What was varied; all other inputs are those of the base case.",
        (
            *prose("parameter", "key"),
            Column("unit"),
            Column("base case", "number"),
            Column("values", "prose"),
        ),
        tuple((p.label, p.name, p.unit, amount(p, p.base, 4), _drawn(p)) for p in sweep.study.parameters),
    )


def _outputs(sweep: Sweep) -> Table:
    def figures(variant: str, output: KeptOutput) -> tuple[str, ...]:
        values = sweep.done(variant)[output.name].to_numpy(dtype=float)
        values = values[np.isfinite(values)]
        if not values.size:
            return (ABSENT,) * 5
        parts = (values.min(), *np.quantile(values, (0.025, 0.5, 0.975)), values.max())
        return tuple(rounded(float(value) * output.display_factor, 4) for value in parts)

    return Table(
        "outputs",
        "What was kept of each sample, over all samples with a value: the ends and the quantiles between "
        "which 95 % of the samples lie.",
        (
            Column("output", "prose"),
            Column("variant"),
            Column("unit"),
            *numbers("least", "2.5 %", "median", "97.5 %", "largest"),
        ),
        tuple(
            (output.label, variant, output.unit, *figures(variant, output))
            for output in sorted(sweep.study.outputs, key=lambda output: not is_error(output))
            for variant in sweep.variants
        ),
        rule_by=0,
    )


def _time_step(variant: str, chosen: ChosenTimeStep, tolerance: float | None) -> str:
    """Say which time step a variant's samples were run with, and why."""
    step, own = (f"{rounded(1e3 * each, 3)} ms" for each in (chosen.time_step_s, chosen.case_time_step_s))
    if chosen.error is None or (tolerance is not None and chosen.error > tolerance):
        error = "is unknown" if chosen.error is None else f"of {chosen.output} is {rounded(chosen.error, 2)}"
        return f"{step} ({variant}): the case's own, though its error {error}; tolerance {tolerance:g}"
    return (
        f"{step} ({variant}; the case states {own}): largest error {rounded(chosen.error, 2)}, of "
        f"{chosen.output}, by halving it on {chosen.samples} samples; tolerance {tolerance:g}"
    )


def provenance_section(sweep: Sweep) -> Section:
    """Build the last section."""
    study = sweep.study
    chosen = (study.time_steps or {}).items()
    steps = [_time_step(name, step, study.error_tolerance) for name, step in chosen]
    run = {
        "study": study.name,
        "base case": study.base_case,
        "variants": listed(study.variants),
        "design": DESIGNS.get(study.design.kind, study.design.kind),
        "samples": study.design.samples,
        "seed": study.design.seed,
        "time step": listed(steps) or "the case's own",
        "judged against": study.against,
        "state": f"{study.state}, {len(sweep.samples)} of {study.counts.total} samples recorded",
        "created": study.created,
        "git commit": study.git_commit,
    }
    blocks: list[Block] = [
        Paragraph(
            "Every sample with its values is in samples/ (Parquet, SI units; any data-frame library reads "
            "the folder). How to repeat it: check out the commit named below, and run the study again with "
            "python -m validation.sweep."
        ),
        pairs("run", "The sweep that this page draws.", ("what", "value"), run),
        _parameters(sweep),
        _outputs(sweep),
        pairs("versions", "Versions of the libraries.", ("package", "version"), study.versions),
    ]
    if sweep.text:
        blocks.append(Listing("The study", sweep.text))
    return Section("provenance", "Design and provenance", tuple(blocks))
