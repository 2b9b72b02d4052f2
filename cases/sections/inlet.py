"""The inlet: a prescribed mean velocity, flow rate or pressure, or the inflow of the 3D reference."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, InstanceOf, Tag, ValidationInfo, field_validator, model_validator
from pydantic_core.core_schema import ValidatorFunctionWrapHandler

from cases.sections.base import Section
from cases.sections.sources import (
    FlowFourier,
    FourierSeries,
    PressureFourier,
    VelocityFourier,
    period_of,
    require_one_source,
)
from cases.values.kinds import (
    FlowRate,
    FlowWaveform,
    Period,
    Pressure,
    PressureWaveform,
    Ramp,
    Scale,
    Velocity,
    VelocityWaveform,
    one_of,
    refused,
)
from cases.values.waveform_file import Waveform

DEFAULT_PERIOD = 1.0
Interpolation = Literal["monotone", "spline"]


def _default_period(inlet: dict[str, Any]) -> float:
    own = period_of(inlet)
    return DEFAULT_PERIOD if own is None else own[1]


class PrescribedInlet(Section):
    """A quantity prescribed at the inlet; exactly one of `waveform`, `value` and `fourier` is stated.

    Attributes
    ----------
    waveform : Waveform or None
        The quantity over one cycle.
    value : float or None
        A constant, in SI units.
    fourier : FourierSeries or None
        The quantity as a Fourier series.
    interpolation : str
        Between the points of a waveform: monotone (no value beyond its neighbours', PCHIP) or spline (the
        periodic cubic spline, for points of a smooth curve).
    scale : float
        Factor of the quantity at all times.
    ramp : float or None
        Time in s over which the quantity grows from 0 as half a cosine.
    period : float
        Duration of a cycle in s: that of the waveform or the series, or the one stated beside `value` (1 s by
        default).
    """

    kind: str
    waveform: InstanceOf[Waveform] | None = None
    value: float | None = None
    fourier: FourierSeries | None = None
    interpolation: Annotated[Interpolation, one_of(Interpolation)] = "monotone"
    scale: Scale = 1.0
    ramp: Ramp | None = None
    period: Period = Field(default_factory=_default_period)

    @field_validator("period", mode="wrap")
    @classmethod
    def _period(cls, stated: object, check: ValidatorFunctionWrapHandler, info: ValidationInfo) -> float:
        own = period_of(info.data)
        if own is not None:
            article = {"waveform": "a waveform", "fourier": "a Fourier series"}[own[0]]
            raise refused(stated, f"no period beside {article}, which has its own")
        return float(check(stated))

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        require_one_source(self, ("waveform", "value", "fourier"))
        if self.waveform is None and self.interpolation != "monotone":
            raise refused(self.interpolation, "only beside waveform", key=("interpolation",))
        return self


class VelocityInlet(PrescribedInlet):
    """A prescribed mean velocity in m/s, the same in every direction φ."""

    kind: Annotated[Literal["velocity"], one_of(Literal["velocity"])]
    waveform: VelocityWaveform | None = None
    value: Velocity | None = None
    fourier: VelocityFourier | None = None


class FlowInlet(PrescribedInlet):
    """A prescribed flow rate of the section in m³/s."""

    kind: Annotated[Literal["flow"], one_of(Literal["flow"])]
    waveform: FlowWaveform | None = None
    value: FlowRate | None = None
    fourier: FlowFourier | None = None


class PressureInlet(PrescribedInlet):
    """A prescribed pressure in Pa."""

    kind: Annotated[Literal["pressure"], one_of(Literal["pressure"])]
    waveform: PressureWaveform | None = None
    value: Pressure | None = None
    fourier: PressureFourier | None = None


class ReferenceInlet(Section):
    """The flow rate that the mesh of the 3D reference takes in, which a comparison reads from it.

    Attributes
    ----------
    period : float
        Duration of a cycle in s.
    """

    waveform: ClassVar[None] = None
    value: ClassVar[None] = None
    fourier: ClassVar[None] = None
    scale: ClassVar[float] = 1.0
    ramp: ClassVar[None] = None

    kind: Annotated[Literal["reference"], one_of(Literal["reference"])]
    period: Period


Inlet = (
    Annotated[VelocityInlet, Tag("velocity")]
    | Annotated[FlowInlet, Tag("flow")]
    | Annotated[PressureInlet, Tag("pressure")]
    | Annotated[ReferenceInlet, Tag("reference")]
)
