"""What a comparison says of itself: notes, warnings, and where everything came from."""

from collections.abc import Mapping

from cases.reading.case_file import CaseFile
from cases.results.provenance import DeclaredBand, Provenance
from cases.sections.case import Case
from cases.sections.compare import Band
from cases.sections.doubts import doubts_of
from solver.case.locality import locality_warning
from solver.case.periodicity import periodicity_warning
from validation.compare.comparison import VariantRun
from validation.metrics.confidence import SEED
from validation.reference.alignment import WHOLE
from validation.runs.instants import nearest_states, wanted_instants
from validation.runs.provenance import provenance


def notes_of(runs: Mapping[str, VariantRun]) -> list[str]:
    """Say what a reader should know, each thing once."""
    notes = [note for run in runs.values() for note in run.reference.notes]
    for name, run in runs.items():
        later = run.reference.alignment.cycles_later
        notes.append(
            f"{name}: instants are matched within the cycle; the reduced model's last cycle is "
            f"{abs(later)} cycle{'s' * (abs(later) != 1)} {'later' if later >= 0 else 'earlier'} than the "
            f"reference's, whose states cover {run.reference.alignment.coverage:.1%} of it"
        )
        notes.append(
            f"{name}: pressure and flow rate of the reduced model change by at most "
            f"{run.rom.cycle_change:.1e} (relative) from the start to the end of the last cycle"
        )
    for run in runs.values():
        notes += [] if run.sources is None else run.sources.notes
    stated = ", ".join(f"{value:g}" for value in sorted({run.case.blood.viscosity for run in runs.values()}))
    notes.append(
        f"viscosity of the reduced model: {stated} Pa s; that of the reference, its density and its wall's "
        "moduli are not compared with the case"
    )
    return list(dict.fromkeys(notes))


def warnings_of(runs: Mapping[str, VariantRun]) -> list[str]:
    """Say what casts doubt on the verdict."""
    found = []
    for name, run in runs.items():
        alignment, times = run.reference.alignment, run.reference.alignment.cycle_times
        found += [f"{name}: {doubt}" for doubt in doubts_of(run.case)]
        found += [f"{name}: {note}" for note in run.reference.notes if "cut off" in note]
        of_levels = () if run.sources is None else run.sources.warnings
        found += [f"{name}: {warning}" for warning in (*run.reference.warnings, *of_levels)]
        if alignment.coverage < WHOLE:
            found.append(
                f"{name}: the reference's states cover only {alignment.coverage:.1%} of the cycle, "
                "so the errors and the bands judge that part alone (is reference.time_offset right?)"
            )
        wanted = wanted_instants(run.case)
        missed = [instant for instant in wanted if instant not in nearest_states(wanted, times)]
        if missed:
            found.append(f"{name}: no state of the reference is near {', '.join(missed)}: not tabulated")
        warning = locality_warning(run.rom.description.get("wall_locality_error"))
        found += [f"{name}: {warning}"] if warning else []
        warning = periodicity_warning(run.rom.cycle_change)
        found += [f"{name}: {warning}"] if warning else []
    return found


def described(
    file: CaseFile,
    runs: Mapping[str, VariantRun],
    wall_times: dict[str, float],
    command: list[str],
    notes: list[str],
) -> Provenance:
    """Provenance of a finished comparison, with notes and warnings."""
    inputs = [path for case in file.variants.values() for path in case.input_files]
    stated = {
        "seeds": {"bootstrap": SEED} | _seeds_of_inputs(file.variants),
        "wall_times_s": wall_times,
        "notes": [*notes, *notes_of(runs)],
        "warnings": warnings_of(runs),
        "variants": {
            name: {"rom": run.rom.description, "reference": run.reference.description}
            for name, run in runs.items()
        },
        "bands": declared_bands(file.variants),
    }
    return Provenance.model_validate(provenance(file.path, inputs, command) | stated, strict=False)


def _seeds_of_inputs(cases: Mapping[str, Case]) -> dict[str, int]:
    """Seeds of the samples of uncertain inputs, by variant."""
    return {
        f"uncertainty of {name}": case.uncertainty.seed
        for name, case in cases.items()
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
