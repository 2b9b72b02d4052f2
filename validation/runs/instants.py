"""Instants of the cycle: those a case names, and those that all variants' references share."""

from collections.abc import Sequence

import numpy as np

from cases.arrays import Floats, Integers
from cases.sections.case import Case
from solver.case.model import inlet_signal
from solver.model.waveform import local_minima
from validation.errors import ValidationError

TOLERANCE = 1e-4  # share of a cycle by which two states of one instant may differ
FEWEST = 3


def wanted_instants(case: Case) -> dict[str, float]:
    """Instants that the case wants tabulated, by name, s into the cycle.

    Systole is the inlet's maximum, the troughs are its local minima after it, end diastole is the end of
    the cycle.

    Raises
    ------
    ValidationError
        If the inlet has no such instant.
    """
    signal = inlet_signal(case)
    fine = np.linspace(0.0, signal.period, 4001)
    known = {"systole": float(fine[np.argmax(signal(fine))]), "end diastole": signal.period}
    troughs = zip(("first", "second"), local_minima(signal), strict=False)
    known |= {f"{word} trough": float(time) for word, time in troughs}
    wanted = {}
    for stated in case.compare.times:
        if isinstance(stated, str) and stated not in known:
            raise ValidationError(
                f"compare.times: the inlet has no {stated!r}; it has: {', '.join(sorted(known))}"
            )
        wanted[stated if isinstance(stated, str) else f"{stated:g} s"] = (
            known[stated] if isinstance(stated, str) else stated
        )
    return wanted


def nearest_states(wanted: dict[str, float], times: Floats) -> dict[str, int]:
    """State nearest to each wanted instant; without those farther from one than states are apart.

    Of several instants with one nearest state the first stands for all.
    """
    apart = float(np.max(np.diff(times)))
    states = {name: int(np.argmin(np.abs(times - instant))) for name, instant in wanted.items()}
    near = {name: state for name, state in states.items() if abs(times[state] - wanted[name]) <= apart}
    first = {state: name for name, state in reversed(near.items())}
    return {name: state for name, state in near.items() if first[state] == name}


def common_states(times: Sequence[Floats], period: float) -> list[Integers]:
    """States of each reference at the instants that all of them have.

    Raises
    ------
    ValidationError
        If they share fewer than three instants.
    """
    first, rest = times[0], times[1:]
    shared = np.array(
        [all(np.min(np.abs(o - t)) < TOLERANCE * period for o in rest) for t in first], dtype=bool
    )
    instants = first[shared]
    if instants.size < FEWEST:
        raise ValidationError(
            f"the variants' references have {instants.size} instants of the cycle in common; allowed: "
            f"{FEWEST} or more (compare them in case files of their own)"
        )
    return [np.argmin(np.abs(other[:, None] - instants), axis=0) for other in times]
