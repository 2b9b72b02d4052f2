"""Whether a result's units can be those that the case states, by sizes that both have."""

import math
from collections.abc import Mapping

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.inlet import PressureInlet, ReferenceInlet
from cases.sections.outlet import PressureOutlet, ResistanceOutlet, WindkesselOutlet
from solver.case.model import inlet_signal
from validation.errors import UnusableReferenceError
from validation.mapping.mesh import LumenMesh
from validation.reference.alignment import Alignment

CANNOT_BE = 5.0  # factor between sizes of one artery from which units are in question
NEAR = 1.25  # factor within which a known unit explains what is found
OF_LENGTH = {"µm": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0}
OF_PRESSURE = {"dyn/cm^2": 0.1, "Pa": 1.0, "mmHg": 133.322, "kPa": 1e3, "MPa": 1e6}


def check_length_unit(mesh: LumenMesh, case: Case, unit: float) -> None:
    """Refuse a lumen that is another one's enlargement: length and radius off by one factor."""
    radius = float(np.mean(np.hypot(*mesh.coordinates[mesh.interface_nodes, 1:].T)))
    ratios = np.array([mesh.length / case.geometry.length, radius / case.geometry.radius])
    if np.all(ratios > CANNOT_BE) or np.all(ratios < 1.0 / CANNOT_BE):
        likely = _explained(unit / math.sqrt(ratios.prod()), OF_LENGTH)
        raise UnusableReferenceError(
            f"the lumen is {mesh.length:.4g} m long and its radius {radius:.4g} m; the case's "
            f"{case.geometry.length:.4g} m and {case.geometry.radius:.4g} m: reference.length_unit cannot be "
            f"right{likely}"
        )


def check_velocity_units(inflow: Floats, area: Floats, alignment: Alignment, case: Case) -> None:
    """Refuse an inflow of another order of magnitude than the case's, where the case states one."""
    if isinstance(case.inlet, PressureInlet | ReferenceInlet):
        return
    prescribed = np.asarray(inlet_signal(case)(alignment.cycle_times))
    found = inflow / area if case.inlet.kind == "velocity" else inflow
    unit = "m/s" if case.inlet.kind == "velocity" else "m³/s"
    size, wanted = (float(np.sqrt(np.mean(values**2))) for values in (found, prescribed))
    if wanted > 0 and not 1.0 / CANNOT_BE < size / wanted < CANNOT_BE:
        raise UnusableReferenceError(
            f"the inflow is {size:.3g} {unit} (root of the mean square), the case's {wanted:.3g} {unit}: "
            "reference.velocity, or reference.length_unit over reference.time_unit, cannot be right"
        )


def pressure_doubts(pressure: float, flow_rate: float, case: Case, factor: float) -> list[str]:
    """Say that the mean pressure at the outlet is of another order of magnitude than the case's outlet gives.

    Parameters
    ----------
    pressure, flow_rate : float
        Means over the cycle at the outlet, Pa and m³/s.
    case : Case
    factor : float
        Pressure unit of the files, Pa.

    Raises
    ------
    UnusableReferenceError
        If another unit of pressure explains it.
    """
    expected = _outlet_pressure(case, flow_rate)
    if not expected or 1.0 / CANNOT_BE < pressure / expected < CANNOT_BE:
        return []
    what = f"pressure at the outlet is {pressure:.4g} Pa on average, {expected:.4g} Pa by the case's outlet"
    likely = _explained(factor * expected / pressure, OF_PRESSURE) if pressure * expected > 0 else ""
    if likely:
        raise UnusableReferenceError(f"{what}: reference.pressure_unit cannot be right{likely}")
    return [what]


def _outlet_pressure(case: Case, flow_rate: float) -> float:
    """Mean pressure that the case's outlet gives at a mean flow rate, Pa; 0 where it gives none."""
    outlet = case.outlet
    if isinstance(outlet, ResistanceOutlet):
        through = flow_rate if outlet.flow == "section" else flow_rate / math.pi
        return outlet.offset + outlet.resistance * through
    if isinstance(outlet, WindkesselOutlet):
        return outlet.venous_pressure + flow_rate * (outlet.proximal_resistance + outlet.distal_resistance)
    if isinstance(outlet, PressureOutlet):
        return float(np.mean(outlet.waveform.values)) if outlet.waveform else float(outlet.value or 0.0)
    return 0.0


def _explained(unit: float, known: Mapping[str, float]) -> str:
    near = [name for name, size in known.items() if 1.0 / NEAR < unit / size < NEAR]
    return f"; {near[0]} would fit" if near else ""
