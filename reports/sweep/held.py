"""Samples in which a band holds, in numbers and words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from cases.arrays import Flags, Floats
from cases.results.sweep import KeptOutput, OutputBand, VariedParameter
from reports.sweep.amounts import amount
from reports.sweep.folder import Sweep
from reports.wording.numbers import SPACE, counted

_WORTH_SAYING = 0.2  # of the samples that one parameter alone decides


@dataclass(frozen=True)
class Split:
    """How far one parameter alone decides whether a band holds.

    Attributes
    ----------
    parameter : VariedParameter
        Which.
    below : bool
        Whether the band holds at its low values (else at its high ones).
    holds, fails : (int, float)
        How many samples at that end all hold, and up to which value (SI); how many at the other all fail, and
        from which value on. The value is NaN for none.
    single : (bool, bool)
        Whether those that all hold, and that all fail, share one value.
    """

    parameter: VariedParameter
    below: bool
    holds: tuple[int, float]
    fails: tuple[int, float]
    single: tuple[bool, bool] = (False, False)


@dataclass(frozen=True)
class Held:
    """One band over the samples of one variant.

    Attributes
    ----------
    variant : str
        Of the base case.
    output : KeptOutput
        What is judged.
    band : OutputBand
        Its limit.
    ok : ndarray of bool, shape (n,)
        Which judged samples are within the limit.
    samples : pandas.DataFrame
        The judged samples: those with a value.
    """

    variant: str
    output: KeptOutput
    band: OutputBand
    ok: Flags
    samples: pd.DataFrame

    @property
    def sizes(self) -> Floats:
        """What the limit is compared with, shape (n,)."""
        return np.asarray(np.abs(self.samples[self.output.name].to_numpy(dtype=float)))

    @property
    def furthest(self) -> float:
        """Largest size over the limit; infinite beyond a limit of zero, 0 without a sample."""
        largest = float(self.sizes.max(initial=0.0))
        if self.band.limit:
            return largest / self.band.limit
        return math.inf if largest else 0.0


def held(sweep: Sweep, variant: str, output: KeptOutput, band: OutputBand) -> Held:
    """Judge the samples that have a value of the output."""
    done = sweep.done(variant)
    samples = done[np.isfinite(done[output.name].to_numpy(dtype=float))]
    return Held(
        variant, output, band, np.abs(samples[output.name].to_numpy(dtype=float)) <= band.limit, samples
    )


def all_held(sweep: Sweep) -> tuple[Held, ...]:
    """All bands of all variants."""
    return tuple(
        held(sweep, variant, output, band)
        for variant in sweep.variants
        for output, band in sweep.judged(variant)
    )


def varied(parameter: VariedParameter, samples: pd.DataFrame) -> bool:
    """Whether samples differ in a parameter."""
    values = samples[parameter.name].to_numpy(dtype=float)
    return bool(values.size and values.min() < values.max())


def splits(found: Held, parameters: Sequence[VariedParameter]) -> list[Split]:
    """For each parameter, how far it alone decides; the most decisive first."""
    made = [
        _split(found, parameter, below)
        for parameter in parameters
        if varied(parameter, found.samples)
        for below in (True, False)
    ]
    return sorted(made, key=lambda split: -(split.holds[0] + split.fails[0]))


def _split(found: Held, parameter: VariedParameter, below: bool) -> Split:
    values = found.samples[parameter.name].to_numpy(dtype=float)
    sign = 1.0 if below else -1.0
    least_failing = np.min(sign * values[~found.ok], initial=np.inf)
    most_holding = np.max(sign * values[found.ok], initial=-np.inf)
    held_all = sign * values < least_failing
    failed_all = sign * values > most_holding
    return Split(
        parameter,
        below,
        (int(held_all.sum()), float(sign * np.max(sign * values[held_all], initial=-np.inf))),
        (int(failed_all.sum()), float(sign * np.min(sign * values[failed_all], initial=np.inf))),
        (np.unique(values[held_all]).size == 1, np.unique(values[failed_all]).size == 1),
    )


def sentence(found: Held, parameters: Sequence[VariedParameter]) -> str:
    """Say in how many samples the band holds, and where."""
    count, within = len(found.ok), int(found.ok.sum())
    band = f"the band on the {found.output.label} (≤{SPACE}{amount(found.output, found.band.limit)})"
    if count == 0:
        return f"{found.variant}: no sample has a value that {band} could judge."
    if within in (0, count):
        how = "every one" if within else "none"
        return f"{found.variant}: {band} holds in {how} of {counted(count, 'sample')}; {_nearest(found)}."
    opening = f"{found.variant}: {band} holds in {within} of {counted(count, 'sample')}"
    best = next(iter(splits(found, parameters)), None)
    decided = 0 if best is None else best.holds[0] + best.fails[0]
    if best is None or decided < _WORTH_SAYING * count:
        return f"{opening}; no single parameter decides."
    return f"{opening}: {_where(best, count)}."


def _where(split: Split, count: int) -> str:
    parameter, (held_all, last), (failed_all, first) = split.parameter, split.holds, split.fails
    signs = ("≤", "≥") if split.below else ("≥", "≤")
    to, beyond = (f"{'=' if one else sign}{SPACE}" for one, sign in zip(split.single, signs, strict=True))
    if held_all + failed_all == count:
        return (
            f"in all with {parameter.label} {to}{amount(parameter, last)} and in none with "
            f"{beyond}{amount(parameter, first)}"
        )
    parts = []
    if held_all:
        parts.append(f"in all {held_all} with {parameter.label} {to}{amount(parameter, last)}")
    if failed_all:
        parts.append(f"in none of the {failed_all} with {parameter.label} {beyond}{amount(parameter, first)}")
    return f"{' and '.join(parts)}; elsewhere it depends on the others"


def _nearest(found: Held) -> str:
    """Name the sample nearest to the limit."""
    at = int(np.abs(found.sizes - found.band.limit).argmin())
    number = int(found.samples["sample"].iloc[at])
    return f"nearest to the limit is {amount(found.output, float(found.sizes[at]))} (sample {number})"
