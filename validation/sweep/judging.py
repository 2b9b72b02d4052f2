"""What a sample is judged against: the coupled model of the same sample, or the 3D reference of its case."""

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from cases.fields import FIELDS
from cases.sections.case import Case
from cases.sections.compare import Band
from validation.ablation.ladder import coupled_model
from validation.errors import ValidationError

Against = Literal["none", "coupled", "reference"]

STATES = 100  # instants of the last cycle in which extremes are looked for
ALWAYS = ("radius", "section_flow_rate", "sector_flow_rate", "pressure")  # told also without a band
UNJUDGED = np.inf  # limit of what no band limits
# numbers that a 3D run has too: it says nothing of samples with others
OF_THE_REFERENCE = (
    "geometry.length",
    "solver.n_x",
    "solver.n_phi",
    "solver.cycles",
    "inlet.period",
    "inlet.fourier.period",
)


def unfit_for_judging(against: Against, case: Case, varied: Sequence[str]) -> str:
    """Say why a case cannot be judged as a study asks; empty where it can."""
    if against == "coupled":
        try:
            if coupled_model(case) == case:
                return "the case is the coupled model itself"
        except ValidationError as error:
            return str(error)
    if against == "reference":
        if case.reference is None:
            return "the case states no reference"
        taken = [name for name in varied if name in OF_THE_REFERENCE]
        if taken:
            return f"{taken[0]} is the reference's own; allowed: other parameters"
    return ""


def judged_bands(cases: Mapping[str, Case], against: Against) -> list[tuple[Band, ...]]:
    """Return what is judged: the bands of each quantity and statistic, and some that no band limits.

    Bands of quantities on rays are left out: samples keep no velocities across the section.
    """
    if against == "none":
        return []
    told = {(name, "rms_error"): (_unlimited(name),) for name in ALWAYS}
    declared: dict[tuple[str, str], list[Band]] = {}
    for name, case in cases.items():
        for band in case.compare.bands:
            applies = band.variants is None or name in band.variants
            seen = declared.setdefault((band.quantity, band.statistic), [])
            if applies and "y" not in FIELDS[band.quantity].dims and band not in seen:
                seen.append(band)
    return list((told | {key: tuple(bands) for key, bands in declared.items() if bands}).values())


def _unlimited(quantity: str) -> Band:
    return Band.model_construct(
        None, quantity=quantity, statistic="rms_error", limit=UNJUDGED, reason="", variants=None
    )
