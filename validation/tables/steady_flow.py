"""Figures 2.8 and 3.7a: the steady flow of a velocity inlet and a resistance outlet without calcification.

The thesis states 0.5982 cm³/s for P_res = 9330 Pa and R_res = 1.358e9 Pa s/m³. These give 0.5945; the
number belongs to the outlet of its pulsatile runs, 7205.2 Pa and 5.7817e9 Pa s/m³.
"""

import numpy as np
from scipy.optimize import brentq

from solver.marching.godunov_setup import State
from validation.tables.artery import (
    CM3,
    DENSITY,
    DIASTOLE,
    HEALTHY,
    LENGTH,
    PULSATILE_OUTLET,
    RADIUS,
    STEADY_OUTLET,
    VISCOSITY,
    healthy_steady_state,
    quoted,
)
from validation.tables.experiment import Check, Entry, Experiment, Result, Results, number

DIGITS = 0.5e-4  # cm³/s: half a unit of the last printed digit
RESIDUAL = 1e-12
STOPPED = 1e-4  # cm³/s: ε of the marched state's stopping criteria


def momentum_defect(flow: float, outlet: tuple[float, float]) -> tuple[float, float]:
    """Both sides' difference in (2.2.69), and its largest term, m⁶/s².

    Parameters
    ----------
    flow : float
        Q = uR², m³/s.
    outlet : tuple of float
        R_res, Pa s/m³, and P_res, Pa.
    """
    resistance, offset = outlet
    area_in = flow / DIASTOLE
    area_out = (RADIUS + (offset + resistance * flow) * RADIUS**2 / HEALTHY) ** 2
    elastic = HEALTHY / (5 * DENSITY * RADIUS**2)
    inertia = 4 / 3 * flow**2 * np.log(area_out / area_in)
    friction = 8 * VISCOSITY / DENSITY * flow * LENGTH
    defect = elastic * (area_out**2.5 - area_in**2.5) - inertia + friction
    return float(defect), float(elastic * area_out**2.5)


def steady_flow(outlet: tuple[float, float]) -> tuple[float, float]:
    """Physiological root Q (m³/s) of (2.2.69), and its residual over the largest term."""
    guess = DIASTOLE * RADIUS**2
    flow = float(brentq(lambda q: momentum_defect(q, outlet)[0], 0.2 * guess, 5 * guess, xtol=1e-22))
    defect, largest = momentum_defect(flow, outlet)
    return flow, abs(defect) / largest


def _mean_flow(state: State) -> float:
    return float(np.mean(state.flow)) * CM3


def compute() -> Result:
    """Analytic and marched flows with both outlets, cm³/s."""
    pulsatile, residual = steady_flow(PULSATILE_OUTLET)
    stated, stated_residual = steady_flow(STEADY_OUTLET)
    return {
        "flow": pulsatile * CM3,
        "flow_stated_outlet": stated * CM3,
        "residual": max(residual, stated_residual),
        "marched": _mean_flow(healthy_steady_state(PULSATILE_OUTLET)),
        "marched_stated_outlet": _mean_flow(healthy_steady_state(STEADY_OUTLET)),
    }


def _rows(results: Results) -> list[Check]:
    if "steady flow" not in results:
        return []
    result = results["steady flow"]
    thesis = quoted("steady_flow_rate", "none")
    analytic, stated = number(result, "flow"), number(result, "flow_stated_outlet")
    marched, marched_stated = number(result, "marched"), number(result, "marched_stated_outlet")
    return [
        Check("outlet 7205.2 Pa", "Q", "cm^3/s", analytic, thesis, thesis - DIGITS, thesis + DIGITS),
        Check(
            "outlet 7205.2 Pa",
            "Q, marched",
            "cm^3/s",
            marched,
            thesis,
            analytic - STOPPED,
            analytic + STOPPED,
        ),
        Check(
            "outlet 9330 Pa",
            "Q, marched",
            "cm^3/s",
            marched_stated,
            None,
            stated - STOPPED,
            stated + STOPPED,
        ),
        Check("both outlets", "residual of (2.2.69)", "", number(result, "residual"), None, 0.0, RESIDUAL),
    ]


EXPERIMENT = Experiment(
    "steady",
    "Analytic steady flow with a velocity inlet (figures 2.8 and 3.7a)",
    [Entry("steady flow", compute, quick=True)],
    _rows,
)
