"""What a comparison says of itself: notes, warnings, and where everything came from."""

from collections.abc import Iterator, Mapping
from typing import Any

from cases.reading.case_file import CaseFile
from cases.reading.models import labelled
from cases.results.provenance import DeclaredBand, Provenance
from cases.sections.case import Case
from cases.sections.compare import Band
from cases.sections.doubts import doubts_of
from solver.case.locality import locality_warning
from solver.case.periodicity import periodicity_warning
from validation.compare.comparison import VariantRun
from validation.compare.inputs import compared_inputs, differing
from validation.metrics.confidence import SEED
from validation.reference.alignment import WHOLE
from validation.runs.instants import nearest_states, wanted_instants
from validation.runs.provenance import provenance

Runs = Mapping[str, Mapping[str, VariantRun]]  # by variant and model


def notes_of(runs: Runs) -> list[str]:
    """Say what a reader should know, each thing once."""
    firsts = {name: next(iter(models.values())) for name, models in runs.items()}
    notes = [note for run in firsts.values() for note in run.reference.notes]
    for name, run in firsts.items():
        later = run.reference.alignment.cycles_later
        notes.append(
            f"{name}: instants are matched within the cycle; the reduced model's last cycle is "
            f"{abs(later)} cycle{'s' * (abs(later) != 1)} {'later' if later >= 0 else 'earlier'} than the "
            f"reference's, whose states cover {run.reference.alignment.coverage:.1%} of it"
        )
    each = _labelled(runs)
    for name, run in each.items():
        notes.append(
            f"{name}: pressure and flow rate of the reduced model change by at most "
            f"{run.rom.cycle_change:.1e} (relative) from the start to the end of the last cycle"
        )
        notes += [] if run.sources is None else run.sources.notes
    stated = ", ".join(f"{value:g}" for value in sorted({run.case.blood.viscosity for run in each.values()}))
    told = f"viscosity of the reduced model: {stated} Pa s"
    inputs = [_inputs(run) for run in firsts.values()]
    if not all(inputs):
        told += "; that of the reference, its density and its wall's moduli are not compared with the case"
    elif all(item["case"] is None for items in inputs for item in items):
        told += "; the case has none of the inputs that the reference's log tells"
    else:
        differ = dict.fromkeys(said for items in inputs for said in differing(items))
        told += "; of the inputs that the reference's log tells "
        told += f"these differ: {'; '.join(differ)}" if differ else "those that the case has are the same"
    notes.append(told)
    return list(dict.fromkeys(notes))


def _inputs(run: VariantRun) -> list[dict[str, Any]]:
    """Inputs of 3D beside the case's; none where no log tells them."""
    return compared_inputs(run.case, run.reference.description.get("materials", ()))


def _of_reference(run: VariantRun) -> dict[str, Any]:
    """What the reference is, with its inputs beside the case's in place of the log's materials."""
    facts = {key: fact for key, fact in run.reference.description.items() if key != "materials"}
    inputs = _inputs(run)
    return facts | ({"inputs": inputs} if inputs else {})


def _labelled(runs: Runs) -> dict[str, VariantRun]:
    return {
        labelled(name, model, models): run for name, models in runs.items() for model, run in models.items()
    }


def warnings_of(runs: Runs) -> list[str]:
    """Say what casts doubt on the verdict: of each reference, then of each run of a reduced model."""
    found: list[str] = []
    for name, models in runs.items():
        found += _warnings_of_reference(name, next(iter(models.values())))
    for name, run in _labelled(runs).items():
        warnings = (
            *(() if run.sources is None else run.sources.warnings),
            locality_warning(run.rom.description.get("wall_locality_error")),
            periodicity_warning(run.rom.cycle_change),
        )
        found += [f"{name}: {warning}" for warning in warnings if warning]
    return found


def _warnings_of_reference(name: str, run: VariantRun) -> Iterator[str]:
    """Warnings of what a variant's models share: boundary values, and the reference."""
    alignment, times = run.reference.alignment, run.reference.alignment.cycle_times
    notes = [note for note in run.reference.notes if "cut off" in note]
    for warning in (*doubts_of(run.case), *notes, *run.reference.warnings):
        yield f"{name}: {warning}"
    if alignment.coverage < WHOLE:
        yield (
            f"{name}: the reference's states cover only {alignment.coverage:.1%} of the cycle, "
            "so the errors and the bands judge that part alone (is reference.time_offset right?)"
        )
    wanted = wanted_instants(run.case)
    missed = [instant for instant in wanted if instant not in nearest_states(wanted, times)]
    if missed:
        yield f"{name}: no state of the reference is near {', '.join(missed)}: not tabulated"


def described(
    file: CaseFile,
    runs: Runs,
    wall_times: dict[str, float],
    command: list[str],
    notes: list[str],
) -> Provenance:
    """Provenance of a finished comparison, with notes and warnings."""
    stated = {
        "seeds": {"bootstrap": SEED} | _seeds_of_inputs(file),
        "wall_times_s": wall_times,
        "notes": [*notes, *notes_of(runs)],
        "warnings": warnings_of(runs),
        "variants": {
            name: {
                "models": {model: run.rom.description for model, run in models.items()},
                "reference": _of_reference(next(iter(models.values()))),
            }
            for name, models in runs.items()
        },
        "bands": declared_bands(file.variants),
    }
    about = provenance(file.path, file.input_files, command, file.sha256)
    return Provenance.model_validate(about | stated, strict=False)


def _seeds_of_inputs(file: CaseFile) -> dict[str, int]:
    """Seeds of the samples of uncertain inputs, by variant and model."""
    return {
        f"uncertainty of {labelled(variant, model, file.models)}": case.uncertainty.seed
        for model, variants in file.models.items()
        for variant, case in variants.items()
        if case.uncertainty is not None and case.uncertainty.method == "latin_hypercube"
    }


def declared_bands(cases: Mapping[str, Case]) -> list[DeclaredBand]:
    """Every declared band once, with the names of the variants that it judges."""
    judged: dict[Band, list[str]] = {}
    for name, case in cases.items():
        for band in case.compare.bands:
            if band.variants is None or name in band.variants:
                judged.setdefault(band, []).append(name)
    return [
        DeclaredBand(
            quantity=band.quantity,
            statistic=band.statistic,
            limit=band.limit,
            reason=band.reason,
            variants=tuple(names),
        )
        for band, names in judged.items()
    ]
