"""Which way blood flows through the inlet on average, as a case states it."""

import numpy as np

from cases.sections.case import Case
from cases.sections.inlet import PressureInlet, ReferenceInlet
from solver.case.model import inlet_signal
from validation.reference.alignment import Alignment


def inflow_sign(case: Case, alignment: Alignment) -> float:
    """Sign of the mean inflow at the instants of ``alignment``; 0 where a pressure is prescribed."""
    if isinstance(case.inlet, PressureInlet):
        return 0.0
    if isinstance(case.inlet, ReferenceInlet):
        return 1.0
    return float(np.sign(np.mean(inlet_signal(case)(alignment.cycle_times))))
