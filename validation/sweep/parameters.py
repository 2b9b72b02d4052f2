"""What a study says of one parameter: values to take, or how they are distributed."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.reading.numeric_keys import NumericKey
from cases.results.sweep import VariedParameter
from validation.sweep.display import Display

MOST_VALUES = 100_000

# what each distribution needs and what it may have besides; a spread is a difference of two values
NEEDED = MappingProxyType(
    {
        "uniform": ("low", "high"),
        "loguniform": ("low", "high"),
        "triangular": ("low", "mode", "high"),
        "normal": ("mean", "standard_deviation"),
    }
)
OPTIONAL = MappingProxyType({"normal": ("low", "high")})
SPREAD = "standard_deviation"


@dataclass(frozen=True)
class Parameter:
    """A number of the case that is varied.

    Attributes
    ----------
    key : NumericKey
        Which one.
    label : str
        Words for people.
    display : Display
        How people read its values.
    kind : str
        ``list``, ``range`` or the name of a distribution.
    numbers : mapping of str to float
        What the study states of a distribution, SI.
    values : ndarray or None
        The values of a list or range, SI; None for a distribution.
    """

    key: NumericKey
    label: str
    display: Display
    kind: str
    numbers: Mapping[str, float]
    values: Floats | None = None

    @property
    def name(self) -> str:
        """Its key in the case, which is its column in the dataset."""
        return self.key.name

    @property
    def limits(self) -> tuple[float, float]:
        """Least and largest value that may be drawn; infinite where a distribution has no end."""
        if self.values is not None:
            return float(self.values.min()), float(self.values.max())
        return self.numbers.get("low", -math.inf), self.numbers.get("high", math.inf)

    def at(self, share: Floats) -> Floats:
        """Values at shares of the probability in (0, 1); those of a list are equally likely."""
        if self.values is not None:
            places = np.minimum((share * self.values.size).astype(int), self.values.size - 1)
            return np.asarray(self.values[places])
        return np.asarray(np.clip(_distribution(self.kind, self.numbers).ppf(share), *self.limits))


def _distribution(kind: str, n: Mapping[str, float]) -> Any:
    """Return scipy's distribution of a kind with these numbers, SI."""
    from scipy import stats

    if kind == "normal":
        mean, spread = n["mean"], n[SPREAD]
        low, high = ((n.get(name, end) - mean) / spread for name, end in (("low", -np.inf), ("high", np.inf)))
        return stats.truncnorm(low, high, mean, spread)
    if kind == "loguniform":
        return stats.loguniform(n["low"], n["high"])
    width = n["high"] - n["low"]
    if kind == "triangular":
        return stats.triang((n["mode"] - n["low"]) / width, n["low"], width)
    return stats.uniform(n["low"], width)


def described(parameter: Parameter) -> VariedParameter:
    """Return a parameter for study.json; numbers in SI, null for an end that a distribution lacks."""
    low, high = (end if math.isfinite(end) else None for end in parameter.limits)
    own = {name: number for name, number in parameter.numbers.items() if name not in ("low", "high")}
    return VariedParameter(
        name=parameter.name,
        label=parameter.label,
        unit=parameter.display.unit,
        unit_si=parameter.key.kind.unit,
        display_factor=parameter.display.factor,
        kind=parameter.kind,
        low=low,
        high=high,
        values=None if parameter.values is None else tuple(parameter.values.tolist()),
        base=parameter.key.value,
        **own,
    )
