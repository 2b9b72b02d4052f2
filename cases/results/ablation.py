"""Rows of ablation.json and ablation.csv: what each part of the coupled model buys against 3D."""

from dataclasses import dataclass

from pydantic import ConfigDict


@dataclass(frozen=True)
class AblationRow:
    """Relative errors of one model in one variant; None where it failed, or there is nothing to compare.

    Attributes
    ----------
    variant, model : str
    radius_rms, radius_max, pressure_rms, section_flow_rms : float or None
        Against the 3D run, over all cells or sections and states.
    sector_share_rms, sector_share_max : float or None
        The same of a sector's flow over its section's.
    thesis_sector_max : float or None
        Largest error of the sectors' flows over their mean against the thesis's table 3.8.
    run_s : float
        CPU seconds of the reduced model, tables and steady start included.
    failure : str
        What stopped the run, or "".
    """

    __pydantic_config__ = ConfigDict(strict=True)

    variant: str
    model: str
    radius_rms: float | None
    radius_max: float | None
    pressure_rms: float | None
    section_flow_rms: float | None
    sector_share_rms: float | None
    sector_share_max: float | None
    thesis_sector_max: float | None
    run_s: float
    failure: str


@dataclass(frozen=True)
class Measure:
    """Words for one error of a row: a heading for a terminal, the statistic, and what it is of."""

    heading: str
    statistic: str
    of: str


MEASURES: dict[str, Measure] = {
    "radius_rms": Measure("R rms", "RMS", "lumen radius"),
    "radius_max": Measure("R worst", "largest", "lumen radius"),
    "pressure_rms": Measure("P rms", "RMS", "pressure"),
    "section_flow_rms": Measure("section flow rms", "RMS", "section flow"),
    "sector_share_rms": Measure("sector share rms", "RMS", "share of a sector"),
    "sector_share_max": Measure("sector share worst", "largest", "share of a sector"),
    "thesis_sector_max": Measure("table 3.8 worst", "largest", "thesis's sectors"),
}
