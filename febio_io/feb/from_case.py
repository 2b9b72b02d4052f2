"""From a checked case to FEBio's model of it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.sections.calcification import LocalCalcification
from cases.sections.case import Case
from cases.sections.inlet import VelocityInlet
from cases.sections.outlet import NonReflectingOutlet, PressureOutlet, ResistanceOutlet, WindkesselOutlet
from cases.sections.references.base import ReferenceSection
from cases.sections.references.febio import FebioReference
from cases.sections.sources import FourierSeries
from cases.sections.wall import row_wall
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.law import HomogeneousWall
from cases.values.waveform_file import Waveform
from febio_io.feb.model import (
    ArteryModel,
    Blood,
    Curve,
    FebioModelError,
    Frame,
    MeshSize,
    Outlet,
    Patch,
    PrescribedPressure,
    Resistance,
    Timing,
    Vessel,
    Wall,
    Windkessel,
)
from febio_io.feb.windkessel_start import Periodic, cycles_from_rest, start_curves

RAMP_POINTS = 51
SPACING = 2e-3  # s, in a heartbeat: the waveform's curvature is followed to 1e-3 of its height
FEWEST_PER_CYCLE = 200

Signal = Callable[[Floats], Floats]


def ramp_curve(duration: float) -> Curve:
    """Half a cosine from 0 to 1 over a duration (s)."""
    share = np.linspace(0.0, 1.0, RAMP_POINTS)
    return Curve(duration * share, 0.5 - 0.5 * np.cos(np.pi * share))


def cycles_after_ramp(signal: Signal, period: float, cycles: int, ramp: float) -> Curve:
    """Give a periodic signal that is reached by a ramp.

    Parameters
    ----------
    signal : callable
        From times (n,) in [0, period) to values (n,).
    period : float
        Length of the cycle, s.
    cycles : int
        How many follow the ramp.
    ramp : float
        Duration of the ramp, s: half a cosine from 0 to the signal's first value.
    """
    start = ramp_curve(ramp)
    per_cycle = max(period / min(SPACING, period), FEWEST_PER_CYCLE)
    times = np.linspace(0.0, cycles * period, round(cycles * per_cycle) + 1)[1:]
    # The last instant of each cycle is the first of the next.
    phase = np.where(np.isclose(times % period, period, rtol=0, atol=1e-9 * period), 0.0, times % period)
    first = float(signal(np.zeros(1))[0])
    return Curve(
        np.concatenate([start.times, ramp + times]), np.concatenate([first * start.values, signal(phase)])
    )


STEPS_PER_CYCLE = 200
RAMP_SHARE = 0.25  # of a cycle, where no reference tells when the cycles start
SLACK = 1e-3  # of a step, by which the last one may miss the end of the last cycle

OutletFlow = Callable[[Case], Floats]


@dataclass(frozen=True)
class Choices:
    """What a case leaves open.

    Attributes
    ----------
    size : MeshSize
        Numbers of elements.
    cycles : int
        Cycles after the ramp.
    time_step : float or None
        s; a 200th of the cycle unless given.
    states_per_cycle : int
        States of the plot file, at least.
    records : str or None
        First part of the names of data records; None to have none.
    """

    size: MeshSize
    cycles: int = 2
    time_step: float | None = None
    states_per_cycle: int = 40
    records: str | None = None


def artery_model(case: Case, choices: Choices, outlet_flow: OutletFlow) -> ArteryModel:
    """Give the model of a case.

    Parameters
    ----------
    case : Case
        The case. Where it states a FEBio reference, the model lies in its frame, and the cycles start at its
        ``time_offset``.
    choices : Choices
        What the case leaves open.
    outlet_flow : callable
        From a case with a Windkessel to one cycle of its periodic flow through the outlet at equal intervals,
        without the cycle's end, m³/s (n,); asked last, and for no other outlet.

    Raises
    ------
    FebioModelError
        If the case has what such a model cannot have; the message names the key.
    """
    geometry, reference, period = case.geometry, case.reference, case.inlet.period
    offset = reference.time_offset if reference is not None else 0.0
    ramp = offset if offset > 0 else RAMP_SHARE * period
    if not isinstance(case.inlet, VelocityInlet):
        raise _refused("inlet.kind", case.inlet.kind, "velocity")
    inlet, timing = case.inlet, _timing(period, ramp, choices)
    prescribed = _signal(inlet.waveform, inlet.value, inlet.fourier, inlet.interpolation == "spline")
    inflow = partial(_scaled, prescribed, inlet.scale)
    return ArteryModel(
        vessel=Vessel(geometry.length, geometry.radius, geometry.wall_thickness),
        size=choices.size,
        frame=_frame(reference),
        blood=Blood(case.blood.density, case.blood.viscosity),
        wall=_wall(case),
        patch=_patch(case),
        inflow=cycles_after_ramp(inflow, period, choices.cycles, ramp),
        ramp=ramp_curve(ramp),
        timing=timing,
        records=choices.records,
        outlet=_outlet(case, choices, ramp, timing, outlet_flow),
    )


def _refused(key: str, found: str, allowed: str) -> FebioModelError:
    return FebioModelError(f"{key}: {found}; allowed in a FEBio model: {allowed}")


def _frame(reference: ReferenceSection | None) -> Frame:
    """Frame of the run to be: the model is whole, along an axis of its frame, in SI units."""
    if not isinstance(reference, FebioReference):
        return Frame()
    axis, phi_zero = reference.axis, reference.phi_zero
    if not isinstance(axis, str):
        raise _refused("reference.axis", str(list(axis)), "x, y, z")
    if not isinstance(phi_zero, str):
        raise _refused("reference.phi_zero", str(list(phi_zero)), "x, y, z, -x, -y, -z")
    if reference.symmetry is not None:
        raise _refused("reference.symmetry", "a plane", "none, the model is whole")
    for name in ("length_unit", "time_unit", "pressure_unit"):
        size = getattr(reference, name)
        if size != 1.0:
            raise _refused(f"reference.{name}", f"{size:g} of the SI unit", "the SI unit")
    return Frame(axis, phi_zero, reference.origin)


def _wall(case: Case) -> Wall:
    wall = row_wall(case.wall)
    if not isinstance(wall, HomogeneousWall) or wall.febio_material is None:
        known = [name for name, law in LAWS.items() if law.febio_material is not None]
        raise _refused("wall.law", f"{wall.law}, {wall.not_in_febio}", ", ".join(known))
    if wall.reference_pressure != 0:
        raise _refused(
            "wall.reference_pressure", f"{wall.reference_pressure:g} Pa", "0 Pa: it starts unloaded"
        )
    if wall.poisson_ratio == 0.5:
        raise _refused("wall.poisson_ratio", "0.5", "less than 0.5: FEBio's material is compressible")
    return Wall(wall.febio_material, wall.youngs_modulus, wall.poisson_ratio)


def _patch(case: Case) -> Patch | None:
    parts = case.calcification.parts
    if not parts:
        return None
    if len(parts) > 1:
        raise _refused("calcification.patches", f"{len(parts)} patches", "one patch")
    calcification = parts[0]
    if calcification.transition != "sharp":
        raise _refused("calcification.transition", "a smooth one", "sharp: elements have one modulus each")
    phi = calcification.phi if isinstance(calcification, LocalCalcification) else None
    return Patch(calcification.youngs_modulus, calcification.x, phi)


def _outlet(case: Case, choices: Choices, ramp: float, timing: Timing, outlet_flow: OutletFlow) -> Outlet:
    outlet = case.outlet
    match outlet:
        case ResistanceOutlet(flow="section"):
            return Resistance(outlet.resistance, outlet.offset)
        case ResistanceOutlet():
            raise _refused("outlet.flow", outlet.flow, "section: the 3D outlet has one pressure")
        case WindkesselOutlet():
            # The mesh's lumen is a polygon within the circle, and carries as much less.
            flow = choices.size.section_share * outlet_flow(case)
            return _windkessel(outlet, flow, case.inlet.period, ramp, timing)
        case PressureOutlet():
            signal = _signal(outlet.waveform, outlet.value, None)
            return PrescribedPressure(cycles_after_ramp(signal, case.inlet.period, choices.cycles, ramp))
        case NonReflectingOutlet():
            raise _refused("outlet.kind", outlet.kind, "resistance, windkessel, pressure")


def _windkessel(
    outlet: WindkesselOutlet, flow: Floats, period: float, ramp: float, timing: Timing
) -> Windkessel:
    periodic = Periodic(
        outlet.proximal_resistance,
        outlet.distal_resistance,
        outlet.compliance,
        outlet.venous_pressure,
        flow,
        period,
        timing.time_step,
    )
    start = ramp_curve(ramp)
    share, offset = start_curves(periodic, start, timing.n_steps)
    return Windkessel(
        periodic.proximal_resistance,
        periodic.distal_resistance,
        periodic.compliance,
        distal_share=share,
        offset=offset,
        start=float(periodic.pressure_at(np.zeros(1))[0]),
        cycles_from_rest=cycles_from_rest(periodic, start),
    )


def _signal(
    waveform: Waveform | None, value: float | None, fourier: FourierSeries | None, spline: bool = False
) -> Signal:
    """Give the one that is stated as a function of time; waveforms as the 2D model takes them."""
    if waveform is not None:
        from scipy.interpolate import CubicSpline, PchipInterpolator

        times, values = waveform.times, waveform.values
        if not spline:
            return PchipInterpolator(times, values)
        return CubicSpline(times, [*values[:-1], values[0]], bc_type="periodic")
    if fourier is not None:
        return partial(_fourier, fourier)
    return partial(np.full_like, fill_value=value)


def _scaled(signal: Signal, factor: float, time: Floats) -> Floats:
    return np.asarray(factor * signal(time))


def _fourier(series: FourierSeries, time: Floats) -> Floats:
    harmonics = np.arange(1, len(series.cosines) + 1)
    phase = 2.0 * np.pi / series.period * time[:, np.newaxis] * harmonics
    waves = np.cos(phase) @ np.array(series.cosines) + np.sin(phase) @ np.array(series.sines)
    return np.asarray(series.mean + waves)


def _timing(period: float, ramp: float, choices: Choices) -> Timing:
    step = period / STEPS_PER_CYCLE if choices.time_step is None else choices.time_step
    if step > period / choices.states_per_cycle:
        most = period / choices.states_per_cycle
        raise _refused(
            "time step", f"{step:g} s", f"up to {most:g} s, for {choices.states_per_cycle} states a cycle"
        )
    whole = (ramp + choices.cycles * period) / step
    return Timing(
        time_step=step,
        n_steps=math.ceil(whole - SLACK),
        stride=max(1, math.floor(period / choices.states_per_cycle / step + SLACK)),
    )
