"""The inflow of a 3D mesh as an inlet of the reduced model, so that both are driven by the same flow.

A mesh of flat faces takes in less than the artery's circle does. What it takes in is known at its
states only; between them q(t) = c p(t) + s(t) with the prescribed inflow p, its factor c by least squares,
and a periodic cubic spline s through the rest, so that what p does between two states is kept.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.inlet import FlowInlet, PressureInlet, ReferenceInlet
from cases.values.waveform_file import Waveform
from solver.case.model import inlet_signal
from validation.errors import ValidationError
from validation.reference.alignment import SLACK, WHOLE, Alignment
from validation.reference.kind import Reference

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

SAMPLES = 2000  # points of the waveform in a cycle
SAME_INSTANT = 1e-3  # share of a cycle within which two states are one


def with_inflow_of(case: Case, reference: Reference) -> Case:
    """Case whose inlet is the flow rate that a reference takes in.

    Parameters
    ----------
    case : Case
    reference : Reference
        With ``inlet_flow_rate`` among its checks.

    Raises
    ------
    ValidationError
        If the reference tells no inflow, or covers too little of the cycle.
    """
    if "inlet_flow_rate" not in reference.checks:
        raise ValidationError(
            "compare.matched_inflow, inlet.kind: reference: the reference tells no inflow; allowed: one of "
            "a mesh"
        )
    inflow = reference.checks["inlet_flow_rate"].to_numpy()
    try:
        inlet = inlet_through(case, reference.alignment, inflow)
    except ValidationError as error:
        name = "" if case.reference is None else f"{case.reference.files[0]}: "
        raise ValidationError(f"{name}{error}") from error
    return case.model_copy(update={"inlet": inlet})


def inlet_through(case: Case, alignment: Alignment, inflow: Floats) -> FlowInlet:
    """Inlet whose flow rate goes through ``inflow`` at the instants of a reference.

    Parameters
    ----------
    case : Case
        Its inlet is the prescribed one.
    alignment : Alignment
    inflow : ndarray (n_states,)
        m³/s.

    Raises
    ------
    ValidationError
        If the instants cover too little of the cycle.
    """
    if alignment.coverage < WHOLE - SLACK:
        raise ValidationError(
            f"the inflow of the reference: its states cover {alignment.coverage:.1%} of the cycle; allowed: "
            f"{WHOLE:.0%} or more"
        )
    period = case.inlet.period
    fine = np.linspace(0.0, period, SAMPLES + 1)
    prescribed, sampled = _prescribed(case, alignment.cycle_times), _prescribed(case, fine)
    size = prescribed @ prescribed
    factor = (prescribed @ inflow) / size if size else 0.0
    rest = _periodic(alignment.cycle_times, inflow - factor * prescribed, period)
    values = factor * sampled + rest(fine)
    values[-1] = values[0]
    return FlowInlet.model_construct(
        None,
        kind="flow",
        waveform=Waveform(tuple(zip(fine.tolist(), values.tolist(), strict=True)), period),
        value=None,
        fourier=None,
        scale=1.0,
        ramp=case.inlet.ramp,
        period=period,
    )


def _prescribed(case: Case, times: Floats) -> Floats:
    """What the case prescribes of the inflow; zeros where it prescribes none."""
    if isinstance(case.inlet, PressureInlet | ReferenceInlet):
        return np.zeros(times.shape)
    return inlet_signal(case)(times)


def _periodic(times: Floats, values: Floats, period: float) -> CubicSpline:
    """Periodic cubic spline through values at instants, those of one instant taken once."""
    from scipy.interpolate import CubicSpline

    phases = np.mod(times, period)
    order = np.argsort(phases, kind="stable")
    phases, values = phases[order], values[order]
    apart = np.diff(phases, prepend=-period) > SAME_INSTANT * period
    apart[1:] &= phases[1:] < phases[0] + (1.0 - SAME_INSTANT) * period
    phases, values = phases[apart], values[apart]
    return CubicSpline(
        np.append(phases, phases[0] + period), np.append(values, values[0]), bc_type="periodic"
    )
