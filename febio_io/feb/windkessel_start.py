"""How FEBio's Windkessel (`fluid RCR`) starts at its periodic pressure, whatever its time constant.

FEBio advances p = p_d + R q + v, v being what the capacitor holds, by backward Euler (FEFluidRCRBC, 4.11):

    p_n = p_d,n + (R_d/(1 + τ/Δt) + R) q_n + τ/(Δt + τ) (p_{n−1} − p_d,n−1 − R q_{n−1}),  τ = R_d C.

Started from rest, v takes several τ to become periodic. A ramp that charges it by the flow would need to know
the 3D flow through the ramp, and that it is positive. Here the offset carries the charge instead: R_d is 0
through the ramp, which keeps v at 0 whatever the flow, while p_d grows to P_v and the charge that v will
lack; from then on R_d is the true one, and that charge leaks by τ/(Δt + τ) a step, as v itself does. The law
is linear, so p_d − P_v + v is the periodic charge from the cycles' first step on.
"""

import math
from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from febio_io.feb.model import Curve

SLACK = 1e-3  # of a step, by which a step may miss the ramp's end and still end with it
CLOSE = 0.01  # of the periodic pressure, at which a run counts as periodic


@dataclass(frozen=True)
class Periodic:
    """A Windkessel in its periodic state under one cycle of flow, in FEBio's steps.

    Attributes
    ----------
    proximal_resistance, distal_resistance, compliance, venous_pressure : float
        R and R_d, Pa s/m³; C, m³/Pa; P_v, Pa.
    flow : ndarray (n,)
        Its flow rate at equal intervals from the cycle's start, without its end, m³/s.
    period, time_step : float
        Of the cycle, and Δt, s.
    """

    proximal_resistance: float
    distal_resistance: float
    compliance: float
    venous_pressure: float
    flow: Floats
    period: float
    time_step: float

    @property
    def kept(self) -> float:
        """τ/(Δt + τ): the share of v that a step leaves."""
        time_constant = self.distal_resistance * self.compliance
        return time_constant / (self.time_step + time_constant)

    @property
    def gain(self) -> float:
        """R_d/(1 + τ/Δt): by how much a flow rate raises v in a step, Pa s/m³."""
        return self.distal_resistance * (1.0 - self.kept)

    def flow_at(self, time: Floats) -> Floats:
        """Flow rate at times (m,) since a cycle's start, m³/s."""
        return self._advanced(time, 0.0, 1.0)

    def charge_at(self, time: Floats) -> Floats:
        """Periodic v at times (m,), Pa."""
        return self._advanced(time, self.kept, self.gain)

    def pressure_at(self, time: Floats) -> Floats:
        """Periodic p at times (m,), Pa."""
        return self.venous_pressure + self.proximal_resistance * self.flow_at(time) + self.charge_at(time)

    def _advanced(self, time: Floats, kept: float, gain: float) -> Floats:
        """Periodic v of v_n = kept v_{n−1} + gain q_n at times, harmonic by harmonic."""
        turn = 2.0 * np.pi * np.fft.fftfreq(self.flow.size, 1.0 / self.flow.size) / self.period
        spectrum = np.fft.fft(self.flow) * gain / (1.0 - kept * np.exp(-1j * turn * self.time_step))
        return np.asarray((np.exp(1j * np.outer(time, turn)) @ spectrum).real / self.flow.size)


def start_curves(periodic: Periodic, ramp: Curve, n_steps: int) -> tuple[Curve, Curve]:
    """Give the load curves of `Rd`, as a factor, and of `pressure_offset`, Pa.

    Parameters
    ----------
    periodic : Periodic
        The state to start in, where the ramp ends.
    ramp : Curve
        The ramp, from 0 to 1.
    n_steps : int
        FEBio's steps in all.
    """
    step, end = periodic.time_step, float(ramp.times[-1])
    last = math.floor(end / step + SLACK)  # step of the ramp; the next is the cycles' first
    times: Floats = step * np.arange(last + 1.0, n_steps + 1.0)
    first = times[:1] - end
    missing = float((periodic.charge_at(first) - periodic.gain * periodic.flow_at(first))[0])
    rate = math.log(periodic.kept) / step
    held = missing * np.exp(rate * (times - times[0]))
    top = periodic.venous_pressure + missing * math.exp(rate * (end - times[0]))
    offset = Curve(
        np.concatenate([ramp.times, times]),
        np.concatenate([top * ramp.values, periodic.venous_pressure + held]),
    )
    return Curve(step * np.array([last, last + 1.0]), np.array([0.0, 1.0])), offset


def cycles_from_rest(periodic: Periodic, ramp: Curve) -> int:
    """Count the cycles until a start without charge would be periodic to 1 %.

    In such a start R_d, R, p_d and the flow grow by the ramp alike; what v then lacks leaks step by step.
    """
    step, compliance = periodic.time_step, periodic.compliance
    first = periodic.flow_at(np.zeros(1))[0]
    charge = flow = 0.0
    before = 0.0
    for time in np.arange(step, ramp.times[-1] * (1 + 1e-9), step):
        grown = float(np.interp(time, ramp.times, ramp.values))
        distal = grown * periodic.distal_resistance
        kept = distal * compliance / (step + distal * compliance)
        # FEBio takes R q off the pressure before with the R of now.
        charge += (before - grown) * periodic.proximal_resistance * flow
        before, flow = grown, grown * first
        charge = distal * (1.0 - kept) * flow + kept * charge
    instants = periodic.period * np.arange(periodic.flow.size) / periodic.flow.size
    highest = float(np.max(np.abs(periodic.pressure_at(instants))))
    lacking = abs(float(periodic.charge_at(np.zeros(1))[0]) - charge) / highest
    if lacking <= CLOSE:
        return 0
    return math.ceil(math.log(CLOSE / lacking) / math.log(periodic.kept) * step / periodic.period)
