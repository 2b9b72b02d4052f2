"""What is allowed in a case, but is seldom meant."""

from collections.abc import Iterator
from itertools import pairwise

from cases.sections.case import Case
from cases.sections.inlet import PrescribedInlet

SHORTEST, LONGEST = 0.2, 3.0  # s, of a heart's cycle


def doubts_of(case: Case) -> Iterator[str]:
    """Warnings of boundary values that are allowed, but seldom meant.

    Parameters
    ----------
    case : Case
        The case.

    Yields
    ------
    str
        A sentence each: a cycle read from a file that is no heart's, or a mean inflow below zero.
    """
    for name in ("inlet", "outlet"):
        waveform = getattr(getattr(case, name), "waveform", None)
        if waveform is not None and not SHORTEST <= waveform.period <= LONGEST:
            mistake = "ms under t_s" if waveform.period > LONGEST else "s under t_ms"
            file = "" if waveform.path is None else f" of {waveform.path.name}"
            yield (
                f"{name}: the cycle{file} takes {waveform.period:g} s, "
                f"a heart's {SHORTEST:g} to {LONGEST:g} s: {mistake}?"
            )
    flows_in = case.inlet.kind in ("velocity", "flow")
    if flows_in and isinstance(case.inlet, PrescribedInlet) and (mean := mean_of(case.inlet)) < 0:
        unit = "m/s" if case.inlet.kind == "velocity" else "m^3/s"
        yield (
            f"inlet: a mean inflow below zero, {mean:.4g} {unit}: blood leaves by the inlet; "
            "is the sign that of an outward normal?"
        )


def mean_of(inlet: PrescribedInlet) -> float:
    """Mean of an inlet's quantity over a cycle, in SI units, between a waveform's times linear."""
    if inlet.waveform is not None:
        wave = inlet.waveform
        twice = sum((t - s) * (u + v) for (s, u), (t, v) in pairwise(wave.rows))
        return inlet.scale * twice / 2.0 / wave.period
    return inlet.scale * ((inlet.value or 0.0) if inlet.fourier is None else inlet.fourier.mean)
