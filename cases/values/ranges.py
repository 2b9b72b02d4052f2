"""Between what limits each quantity may lie: wide enough for any artery, narrow enough for the arithmetic."""

from dataclasses import dataclass
from functools import cached_property

from cases.values.units import DIMENSIONS, parse_quantity


@dataclass(frozen=True)
class Range:
    """A least and a largest quantity, both allowed.

    Attributes
    ----------
    dimension : str
        A name of `cases.values.units.DIMENSIONS`.
    least, largest : str
        The limits with their units, as messages show them.
    """

    dimension: str
    least: str
    largest: str

    @cached_property
    def limits(self) -> tuple[float, float]:
        """The limits in the dimension's SI unit."""
        least, largest = (
            parse_quantity(text, DIMENSIONS[self.dimension]) for text in (self.least, self.largest)
        )
        return least, largest

    def __contains__(self, value: float) -> bool:
        """Tell whether a number in SI units lies within."""
        least, largest = self.limits
        return least <= value <= largest

    def __str__(self) -> str:
        """Describe the range, e.g. "a length from 1 µm to 10 m"."""
        article = "an" if self.dimension[0] in "aeiou" else "a"
        return f"{article} {self.dimension} from {self.least} to {self.largest}"


SIZES = Range("length", "1 µm", "10 m")
POSITIONS = Range("length", "0 m", "10 m")
COORDINATES = Range("length", "-10 m", "10 m")
ANGLES = Range("angle", "0 deg", "360 deg")
TRANSITION_ANGLES = Range("angle", "0.001 deg", "360 deg")
TIME_STEPS = Range("time", "1 ns", "1e4 s")
PERIODS = Range("time", "1 µs", "1e4 s")
CYCLE_TIMES = Range("time", "0 s", "1e4 s")
OFFSETS = Range("time", "-1e4 s", "1e4 s")
VELOCITIES = Range("velocity", "-1e3 m/s", "1e3 m/s")
FLOW_RATES = Range("flow rate", "-1e3 m^3/s", "1e3 m^3/s")
PRESSURES = Range("pressure", "-1e9 Pa", "1e9 Pa")
MODULI = Range("pressure", "1 Pa", "1e13 Pa")
DENSITIES = Range("density", "1 kg/m^3", "1e5 kg/m^3")
VISCOSITIES = Range("viscosity", "1e-9 Pa s", "1e3 Pa s")
RESISTANCES = Range("resistance", "1 Pa s/m^3", "1e20 Pa s/m^3")
SERIES_RESISTANCES = Range("resistance", "0 Pa s/m^3", "1e20 Pa s/m^3")
COMPLIANCES = Range("compliance", "1e-20 m^3/Pa", "1 m^3/Pa")
