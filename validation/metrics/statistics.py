"""Statistics of how far two series are apart, by the names of `cases.statistics`.

Relative errors are (2D − 3D)/3D, instant by instant, as Boileau et al. (2015) use them for 1D against 3D.
"""

from collections.abc import Callable

import numpy as np

from cases.arrays import Floats

SMALLEST = 1e-9  # share of the largest 3D value below which an error relative to it means nothing


def relative_error(rom: Floats, reference: Floats) -> Floats | None:
    """(rom − reference)/reference, or None where a 3D value is not finite or next to zero."""
    largest = np.max(np.abs(reference), initial=0.0)
    usable = np.isfinite(reference) & (np.abs(reference) > SMALLEST * largest) & np.isfinite(rom)
    if largest == 0 or not np.all(usable):
        return None
    return np.asarray((rom - reference) / reference)


def rms(error: Floats) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(error**2)))


def largest(error: Floats) -> float:
    """Error of largest magnitude, with its sign."""
    return float(error.flat[np.argmax(np.abs(error))])


def bias(error: Floats) -> float:
    """Mean error."""
    return float(np.mean(error))


def scatter(error: Floats) -> float:
    """Return the standard deviation of the error about its mean."""
    return float(np.std(error))


OF_ERROR: dict[str, Callable[[Floats], float]] = {
    "rms_error": rms,
    "max_error": largest,
    "bias": bias,
    "scatter": scatter,
}
OF_DIFFERENCE: dict[str, Callable[[Floats], float]] = {"rms_difference": rms, "max_difference": largest}
SIZES: dict[str, Callable[[Floats], float]] = {  # of 3D, over which an RMS difference is taken
    "rms_over_rms": rms,
    "rms_over_largest": lambda reference: float(np.max(np.abs(reference))),
}
EXTREMES = ("systolic_error", "diastolic_error")


def extreme_error(statistic: str, rom: Floats, reference: Floats) -> float | None:
    """Relative error of the largest or least value over the cycle, each model's own, (n_times,)."""
    choose = np.max if statistic == "systolic_error" else np.min
    error = relative_error(np.atleast_1d(choose(rom)), np.atleast_1d(choose(reference)))
    return None if error is None else float(error[0])


def _finite(rom: Floats, reference: Floats) -> bool:
    return bool(np.all(np.isfinite(rom)) and np.all(np.isfinite(reference)))


def statistic_value(statistic: str, rom: Floats, reference: Floats) -> float | None:
    """Value of a statistic over all entries; None where it has no meaning."""
    if statistic in EXTREMES:
        return extreme_error(statistic, rom, reference)
    if statistic in OF_DIFFERENCE:
        return OF_DIFFERENCE[statistic](rom - reference) if _finite(rom, reference) else None
    if statistic in SIZES:
        size = SIZES[statistic](reference) if _finite(rom, reference) else 0.0
        return rms(rom - reference) / size if size > 0 else None
    error = relative_error(rom, reference)
    return None if error is None else OF_ERROR[statistic](error)
