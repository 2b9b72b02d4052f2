"""Trust in the 3D side: its own checks, variant by variant."""

from collections.abc import Callable

import numpy as np

from reports.blocks import Column, Table
from reports.result.load import Comparison
from reports.wording.numbers import ABSENT, SPACE, share

PLANES_LIMIT = 0.005
INFLOW_LIMIT = 0.02
COVERAGE_LIMIT = 0.95
NOT_PERIODIC = 0.05  # change of 3D over a cycle from which its difference from 2D is no model error
Check = Callable[[Comparison, str], float | None]


def planes(comparison: Comparison, variant: str) -> float | None:
    """Largest |error| of the 3D section flow by rays against planes cut through the mesh."""
    return comparison.metrics.largest(variant, "section_flow_rate", "plane_integral")


def inflow(comparison: Comparison, variant: str) -> float | None:
    """Largest |error| of the 3D inflow against the prescribed velocity times the mesh's deformed inlet."""
    return comparison.metrics.largest(variant, "section_flow_rate", "prescribed_inflow")


def coverage(comparison: Comparison, variant: str) -> float | None:
    """Share of the cycle that the 3D states cover."""
    return comparison.provenance.variants[variant].reference.coverage


def cycle_change(comparison: Comparison, variant: str) -> float | None:
    """Largest relative change of the 3D pressure, flow rate and lumen volume over a cycle."""
    return comparison.provenance.variants[variant].reference.cycle_change


def not_periodic(comparison: Comparison, variant: str) -> bool:
    """Tell whether 3D is known to change too much over a cycle for a verdict on the 2D model."""
    change = cycle_change(comparison, variant)
    return change is not None and change > NOT_PERIODIC


def _own_change(comparison: Comparison, variant: str) -> float | None:
    return comparison.settings(variant).cycle_change


def _inflow_apart(comparison: Comparison, variant: str) -> float | None:
    """Largest |2D − 3D| of the flow rate through the first section, over the largest of 3D."""
    flow = comparison.fields.sel(variant=variant).isel(x=0)
    three, two = (flow[f"{model}_section_flow_rate"].values.astype(float) for model in ("reference", "rom"))
    if np.isnan(three).any() or not three.any():
        return None
    return float(np.abs(two - three).max() / np.abs(three).max())


def _largest_of_3d(quantity: str) -> Check:
    def check(comparison: Comparison, variant: str) -> float | None:
        row = comparison.metrics.largest_row(variant, quantity, "reference")
        return row.reference if row else None

    return check


_CHECKS: tuple[tuple[str, Check, str], ...] = (
    (
        "3D flow rate: along rays against planes",
        planes,
        "how well the flow rate that the errors are taken from is read off the 3D mesh",
    ),
    (
        "3D mean velocity at the inlet against the prescribed one",
        inflow,
        "whether 3D carries what the case prescribes, over the inlet of its own mesh",
    ),
    (
        "2D inflow against that of 3D",
        _inflow_apart,
        "whether both are driven by the same flow: the same velocity over each model's own inlet area",
    ),
    (
        "3D mass defect",
        _largest_of_3d("mass_defect"),
        "share of the inflow that neither leaves nor widens the artery",
    ),
    (
        "3D backflow",
        _largest_of_3d("backflow_fraction"),
        "share of the points off the wall that do not flow forward",
    ),
    ("cycle covered by 3D states", coverage, "the rest of the cycle is not compared"),
    ("3D change over a cycle", cycle_change, "near zero, the 3D simulation had become periodic"),
    ("2D change over its last cycle", _own_change, "near zero, the 2D model had become periodic"),
)


def table(comparison: Comparison) -> Table | None:
    """Return the checks, a row each, a column a variant; None where a sparse reference allows none."""
    found = [
        (title, [check(comparison, name) for name in comparison.variants], meaning)
        for title, check, meaning in _CHECKS
    ]
    rows = tuple(
        (title, *map(share, values), meaning)
        for title, values, meaning in found
        if not comparison.sparse or any(value is not None for value in values)
    )
    if not rows:
        return None
    return Table(
        "trust",
        "How far the 3D side can be trusted: the largest figure of the cycle. A 2D error of the flow rate "
        "below the misreading or the mass defect of 3D says nothing about the 2D model. "
        f"{ABSENT}: not measured.",
        (
            Column("check", "prose"),
            *(Column(name, "number") for name in comparison.variants),
            Column("what it tells", "prose"),
        ),
        rows,
    )


def doubts(comparison: Comparison) -> tuple[str, ...]:
    """Say in a sentence each check of the 3D side that fails, before anyone reads a verdict."""
    return tuple(
        sentence.format(value=share(value), name=name)
        for check, fails, sentence in _DOUBTS
        for name in comparison.variants
        if (value := check(comparison, name)) is not None and fails(value)
    )


_DOUBTS: tuple[tuple[Check, Callable[[float], bool], str], ...] = (
    (
        planes,
        lambda error: error > PLANES_LIMIT,
        (
            "In {name} the 3D flow rate read along rays is up to {value} off the same flow through planes "
            f"cut through the mesh (more than 0.5{SPACE}%): part of the flow errors may come from that."
        ),
    ),
    (
        inflow,
        lambda error: error > INFLOW_LIMIT,
        (
            "In {name} the 3D mean velocity at the inlet is up to {value} off the prescribed one "
            f"(more than 2{SPACE}%): the two models are not driven by the same velocity."
        ),
    ),
    (
        coverage,
        lambda covered: covered < COVERAGE_LIMIT,
        "The 3D states of {name} cover only {value} of the cycle: the rest of it is not compared.",
    ),
)
