"""One row of metrics.json and metrics.csv, and the verdict that follows from its error and its band."""

import math
from dataclasses import dataclass, fields
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, FiniteFloat

Status = Literal["", "OK", "FAIL", "MISSING"]
Model = Literal["reference", "rom"]
Inflow = Literal["", "matched"]
Number = Annotated[int, Field(ge=1)]
Limit = Annotated[float, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True)
class MetricRow:
    """One figure of a comparison; pydantic checks it where it is read, all columns must be there.

    Attributes
    ----------
    case, variant, model, quantity, statistic : str
        What it is about; `model` is the reduced one, quantities are those of `cases.fields`, statistics of
        `cases.statistics`.
    inflow : str
        Empty for the reduced model as the case states it; "matched" where the flow rate that the 3D
        reference takes in drives it.
    i, j : int or None
        Cell, counted from 1.
    t_s : float or None
        Time from the cycle's start, s.
    rom, reference, error : float or None
        Values of both models and the error, in `unit`; errors are relative unless the statistic is a
        difference. Files have null for what is not finite, such as γ of plug flow.
    unit : str
        SI unit of the values, or of an error that is a difference.
    band : float or None
        The limit that judges the error.
    status : str
        Empty where no band judges.
    """

    __pydantic_config__ = ConfigDict(strict=True)

    case: str
    variant: str
    model: str
    quantity: str
    statistic: str
    inflow: Inflow
    i: Number | None
    j: Number | None
    t_s: FiniteFloat | None
    rom: FiniteFloat | None
    reference: FiniteFloat | None
    error: FiniteFloat | None
    unit: str
    band: Limit | None
    status: Status

    @property
    def ratio(self) -> float:
        """|error| over its band's limit; infinite for a limit of zero, NaN without an error."""
        if self.error is None or self.band is None:
            return math.nan
        return abs(self.error) / self.band if self.band else math.inf


COLUMNS = [field.name for field in fields(MetricRow)]


def metric_row(
    case: str,
    variant: str,
    model: str,
    quantity: str,
    statistic: str,
    *,
    i: int | None = None,
    j: int | None = None,
    t_s: float | None = None,
    rom: float | None = None,
    reference: float | None = None,
    error: float | None = None,
    unit: str = "",
    band: float | None = None,
    inflow: Inflow = "",
) -> MetricRow:
    """Return a row with the columns that it has no figure for empty; a band judges its error."""
    status: Status = "" if band is None else judged(error, band)
    return MetricRow(
        case,
        variant,
        model,
        quantity,
        statistic,
        inflow,
        i,
        j,
        t_s,
        rom,
        reference,
        error,
        unit,
        band,
        status,
    )


def judged(error: float | None, band: float | None) -> Status:
    """Verdict on an error: "" where no band is declared, MISSING where it could not be computed."""
    if band is None:
        return ""
    if error is None:
        return "MISSING"
    return "OK" if abs(error) <= band else "FAIL"
