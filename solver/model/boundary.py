"""What happens at the two ends of the artery."""

from dataclasses import dataclass

import numpy as np

from solver.errors import ModelError
from solver.model.waveform import Signal

INLET_KINDS = ("velocity", "flow", "pressure")


@dataclass(frozen=True)
class Inlet:
    """A prescribed quantity.

    Attributes
    ----------
    kind : str
        "velocity": mean velocity v, Q = vA (2.2.38), m/s; "flow": the section's flow rate, shared at one
        mean velocity, m³/s; "pressure": P (2.2.40), Pa.
    signal : Signal
        Its value over time, SI.
    """

    kind: str
    signal: Signal

    def __post_init__(self) -> None:
        if self.kind not in INLET_KINDS:
            raise ModelError(f"inlet kind {self.kind!r}; allowed: {', '.join(INLET_KINDS)}")


@dataclass(frozen=True)
class ResistanceOutlet:
    """P = P_res + R_res × flow (2.1.1).

    Attributes
    ----------
    resistance : float
        R_res, Pa s/m³.
    offset : float or Signal
        P_res, Pa.
    flow : str
        "section": the section's flow rate q = ½∮Q dφ and one outlet pressure; "row": each row's own
        Q = uR², as the thesis's code does.
    """

    resistance: float
    offset: float | Signal
    flow: str = "section"

    def __post_init__(self) -> None:
        if self.flow not in ("section", "row"):
            raise ModelError(f"outlet flow {self.flow!r}; allowed: section, row")
        _not_negative("outlet resistance", self.resistance, "Pa s/m³")
        if not callable(self.offset) and not np.isfinite(self.offset):
            raise ModelError(f"outlet offset = {self.offset} Pa; allowed: a finite pressure")


@dataclass(frozen=True)
class WindkesselOutlet:
    """Three elements: P = P_c + R₁ q, C dP_c/dt = q − (P_c − P_v)/R₂, q the section's flow rate.

    Attributes
    ----------
    proximal_resistance, distal_resistance : float
        R₁ and R₂, Pa s/m³.
    compliance : float
        C, m³/Pa.
    venous_pressure : float
        P_v, Pa.
    """

    proximal_resistance: float
    distal_resistance: float
    compliance: float
    venous_pressure: float = 0.0

    def __post_init__(self) -> None:
        _not_negative("proximal resistance", self.proximal_resistance, "Pa s/m³")
        _positive("distal resistance", self.distal_resistance, "Pa s/m³")
        _positive("compliance", self.compliance, "m³/Pa")
        if not np.isfinite(self.venous_pressure):
            raise ModelError(f"venous pressure = {self.venous_pressure} Pa; allowed: a finite pressure")


@dataclass(frozen=True)
class NonReflectingOutlet:
    """No wave enters through the outlet (2.2.41)."""


@dataclass(frozen=True)
class PressureOutlet:
    """A prescribed pressure over time, Pa."""

    signal: Signal


Outlet = ResistanceOutlet | WindkesselOutlet | NonReflectingOutlet | PressureOutlet


def _positive(name: str, value: float, unit: str) -> None:
    if not (np.isfinite(value) and value > 0):
        raise ModelError(f"{name} = {value} {unit}; allowed: positive and finite")


def _not_negative(name: str, value: float, unit: str) -> None:
    if not (np.isfinite(value) and value >= 0):
        raise ModelError(f"{name} = {value} {unit}; allowed: 0 or more, finite")
