"""Numbers for the page: thousands of smooth values in a few kilobytes of text.

A value becomes a whole number of 16 bits between its field's least and largest. Differences between
neighbours along every axis are mostly small, so that zlib, on low and high bytes apart, packs them well.
"""

import base64
import zlib
from dataclasses import asdict, dataclass

import numpy as np

from cases.arrays import Floats

LEVELS = 65534  # the largest whole number that stands for a value
ABSENT = 65535  # stands for what is not finite


@dataclass(frozen=True)
class Packed:
    """An array as text.

    Attributes
    ----------
    shape : tuple of int
        Of the array.
    low, step : float
        Value = low + step × whole number.
    data : str
        Base 64 of zlib of all low bytes, then all high bytes, of the whole numbers' differences along each
        axis in turn (modulo 2¹⁶).
    """

    shape: tuple[int, ...]
    low: float
    step: float
    data: str

    def plain(self) -> dict[str, object]:
        """As JSON."""
        return asdict(self)


def pack(values: Floats) -> Packed:
    """Pack an array of any shape; the values come back to 1/131068 of their range."""
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 0.0)
    step = (high - low) / LEVELS or 1.0
    whole = np.full(values.shape, ABSENT, dtype=np.uint16)
    whole[finite] = np.round((values[finite] - low) / step).astype(np.uint16)
    for axis in range(whole.ndim):
        whole = np.diff(whole, axis=axis, prepend=np.uint16(0))
    octets = (whole & 0xFF).astype(np.uint8).tobytes() + (whole >> 8).astype(np.uint8).tobytes()
    return Packed(values.shape, low, step, base64.b64encode(zlib.compress(octets, 6)).decode())
