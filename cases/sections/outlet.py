"""The outlet: what lies behind the artery."""

from typing import Annotated, Literal, Self

from pydantic import Tag, model_validator

from cases.sections.base import Section
from cases.sections.sources import require_one_source
from cases.values.kinds import (
    Compliance,
    Pressure,
    PressureWaveform,
    Ramp,
    Resistance,
    SeriesResistance,
    one_of,
)


class ResistanceOutlet(Section):
    """A terminal resistance: P = P_res + R_res q.

    Attributes
    ----------
    resistance, offset : float
        R_res in Pa s/m³, 0 or more, and P_res in Pa.
    flow : str
        What q is: the flow rate of the whole ``section``, or each ``row``'s own.
    ramp : float or None
        Time in s over which P_res grows from 0 as half a cosine.
    """

    kind: Annotated[Literal["resistance"], one_of(Literal["resistance"])]
    resistance: SeriesResistance
    offset: Pressure
    flow: Annotated[Literal["section", "row"], one_of(Literal["section", "row"])] = "section"
    ramp: Ramp | None = None


class WindkesselOutlet(Section):
    """A three-element Windkessel: C dP_c/dt = q − (P_c − P_v)/R₂, P = P_c + R₁ q; q of the whole section.

    Attributes
    ----------
    proximal_resistance, distal_resistance : float
        R₁ (0 or more) and R₂ in Pa s/m³.
    compliance : float
        C in m³/Pa.
    venous_pressure : float
        P_v in Pa.
    """

    kind: Annotated[Literal["windkessel"], one_of(Literal["windkessel"])]
    proximal_resistance: SeriesResistance
    distal_resistance: Resistance
    compliance: Compliance
    venous_pressure: Pressure = 0.0


class NonReflectingOutlet(Section):
    """An outlet that waves leave without reflection."""

    kind: Annotated[Literal["non_reflecting"], one_of(Literal["non_reflecting"])]


class PressureOutlet(Section):
    """A prescribed pressure; exactly one of `value` and `waveform` is stated.

    Attributes
    ----------
    value : float or None
        A constant pressure in Pa.
    waveform : Waveform or None
        Pressure over one cycle.
    """

    kind: Annotated[Literal["pressure"], one_of(Literal["pressure"])]
    value: Pressure | None = None
    waveform: PressureWaveform | None = None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        require_one_source(self, ("value", "waveform"))
        return self


Outlet = (
    Annotated[ResistanceOutlet, Tag("resistance")]
    | Annotated[WindkesselOutlet, Tag("windkessel")]
    | Annotated[NonReflectingOutlet, Tag("non_reflecting")]
    | Annotated[PressureOutlet, Tag("pressure")]
)
