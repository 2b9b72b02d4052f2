"""Mean and spread of results that come one after the other, without keeping them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from cases.arrays import Floats

SMALLEST = 1e-9  # share of the largest mean below which a spread relative to it means nothing


@dataclass
class RunningSpread:
    """Mean and sum of squared deviations of arrays by name.

    Welford (1962), Technometrics 4, 419–420: M_n = M_{n−1} + (x_n − M_{n−1})/n and
    S_n = S_{n−1} + (x_n − M_{n−1})(x_n − M_n).
    """

    count: int = 0
    mean: dict[str, Floats] = field(default_factory=dict)
    squares: dict[str, Floats] = field(default_factory=dict)

    def add(self, values: Mapping[str, Floats]) -> None:
        """Take one result into account."""
        self.count += 1
        for name, value in values.items():
            before = self.mean.setdefault(name, np.zeros(np.shape(value)))
            off = value - before
            self.mean[name] = before + off / self.count
            self.squares[name] = self.squares.get(name, 0.0) + off * (value - self.mean[name])

    @property
    def variance(self) -> dict[str, Floats]:
        """Unbiased variance of every entry; of two results or more."""
        return {name: squares / (self.count - 1) for name, squares in self.squares.items()}


def relative_spread(mean: Mapping[str, Floats], variance: Mapping[str, Floats]) -> dict[str, float]:
    """Root mean square over all entries of the standard deviation over the mean's size, by name.

    A name is left out where a mean is next to zero or a variance is not finite.
    """
    found = {}
    for name, each in variance.items():
        size = np.abs(mean[name])
        if np.all(np.isfinite(each)) and np.all(size > SMALLEST * np.max(size)):
            found[name] = float(np.sqrt(np.mean(each / size**2)))
    return found
