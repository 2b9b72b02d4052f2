"""What a boundary's quantity follows over time: a waveform, a constant, or a Fourier series."""

from typing import Any

from pydantic import field_validator
from pydantic_core.core_schema import ValidationInfo

from cases.sections.base import Section
from cases.values.kinds import FlowRate, Period, Pressure, Velocity, refused


class FourierSeries(Section):
    """A periodic quantity: mean + Σ_k (cosines_k cos(2πkt/period) + sines_k sin(2πkt/period)), k from 1 on.

    Attributes
    ----------
    period : float
        Period in s.
    mean : float
        Mean in SI units.
    cosines, sines : tuple of float
        Amplitudes in SI units; as many of the ones as of the others.
    """

    period: Period
    mean: float
    cosines: tuple[float, ...]
    sines: tuple[float, ...]

    @field_validator("sines")
    @classmethod
    def _as_many(cls, sines: tuple[float, ...], info: ValidationInfo) -> tuple[float, ...]:
        cosines = info.data.get("cosines")
        if cosines is not None and len(sines) != len(cosines):
            raise refused(f"{len(sines)} items", f"{len(cosines)}, as many as cosines")
        return sines


class VelocityFourier(FourierSeries):
    """A Fourier series of a mean velocity in m/s."""

    mean: Velocity
    cosines: tuple[Velocity, ...]
    sines: tuple[Velocity, ...]


class FlowFourier(FourierSeries):
    """A Fourier series of a flow rate in m³/s."""

    mean: FlowRate
    cosines: tuple[FlowRate, ...]
    sines: tuple[FlowRate, ...]


class PressureFourier(FourierSeries):
    """A Fourier series of a pressure in Pa."""

    mean: Pressure
    cosines: tuple[Pressure, ...]
    sines: tuple[Pressure, ...]


def require_one_source(section: Section, keys: tuple[str, ...]) -> None:
    """Refuse a section that does not state exactly one of some keys.

    Raises
    ------
    RefusedValueError
        None of them is stated, or more than one.
    """
    stated = [key for key in keys if getattr(section, key) is not None]
    *others, last = keys
    if not stated:
        words = f"neither {', '.join(others)} nor {last}"
        raise refused(words, f"exactly one of {', '.join(others)} and {last}")
    if len(stated) > 1:
        raise refused(" and ".join(stated), f"exactly one of {', '.join(others)} and {last}")


def period_of(data: dict[str, Any]) -> tuple[str, float] | None:
    """Return the source that has a period of its own, and the period; None where none has."""
    for key in ("waveform", "fourier"):
        source = data.get(key)
        if source is not None:
            return key, float(source.period)
    return None
