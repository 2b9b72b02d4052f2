"""How far the 3D side can be trusted: its own checks, variant by variant."""

from collections.abc import Callable

from reports.blocks import Column, Table
from reports.load import Comparison
from reports.numbers import ABSENT, SPACE, percent, unsigned

PLANES_LIMIT = 0.005
INFLOW_LIMIT = 0.02
COVERAGE_LIMIT = 0.95
Check = Callable[[Comparison, str], float | None]

_LEAST_SHOWN = 5e-5  # what two decimals of a percentage can tell from zero


def _share(value: float | None) -> str:
    """Write the size of a relative figure; one too small for two decimals is not shown as zero."""
    if value is None:
        return ABSENT
    if value == 0:
        return f"0{SPACE}%"
    return f"<{SPACE}0.01{SPACE}%" if abs(value) < _LEAST_SHOWN else unsigned(percent(abs(value)))


def planes(comparison: Comparison, variant: str) -> float | None:
    """Largest |error| of the 3D section flow by rays against planes cut through the mesh."""
    return comparison.metrics.largest(variant, "section_flow_rate", "plane_integral")


def inflow(comparison: Comparison, variant: str) -> float | None:
    """Largest |error| of the 3D inflow against the prescribed one."""
    return comparison.metrics.largest(variant, "section_flow_rate", "prescribed_inflow")


def coverage(comparison: Comparison, variant: str) -> float | None:
    """Share of the cycle that the 3D states cover."""
    return comparison.provenance.variants[variant].reference.coverage


def _cycle_change(comparison: Comparison, variant: str) -> float | None:
    return comparison.provenance.variants[variant].rom.cycle_change


def _largest_of_3d(quantity: str) -> Check:
    def check(comparison: Comparison, variant: str) -> float | None:
        row = comparison.metrics.find(variant, quantity, "largest")
        return row.reference if row else None

    return check


_CHECKS: tuple[tuple[str, Check], ...] = (
    ("flow by rays against planes", planes),
    ("inflow against prescribed", inflow),
    ("mass defect", _largest_of_3d("mass_defect")),
    ("backflow", _largest_of_3d("backflow_fraction")),
    ("cycle covered", coverage),
    ("change over the last 2D cycle", _cycle_change),
)


_CAPTION = (
    "How far the 3D side can be trusted; each figure is the largest of the cycle. Flow by rays: the 3D flow "
    "rate that errors are taken from, against planes cut through the 3D mesh. Inflow: through the 3D inlet, "
    "against the waveform of the case. Mass defect: share of the 3D inflow that neither leaves nor widens "
    "the artery. Backflow: share of 3D points off the wall that do not flow forward. A 2D error smaller "
    "than these says nothing about the 2D model. Last column: how much the 2D model still changed over its "
    f"last cycle; near zero, it had become periodic. {ABSENT}: not measured."
)


def table(comparison: Comparison) -> Table:
    """Return the checks, a row for each variant."""
    return Table(
        "trust",
        _CAPTION,
        (Column("variant"), *(Column(title, "number") for title, _ in _CHECKS)),
        tuple(
            (name, *(_share(check(comparison, name)) for _, check in _CHECKS)) for name in comparison.variants
        ),
    )


def doubts(comparison: Comparison) -> tuple[str, ...]:
    """Say in a sentence each check of the 3D side that fails, before anyone reads a verdict."""
    return tuple(
        sentence.format(value=_share(value), name=name)
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
            "In {name} the 3D inflow is up to {value} off the prescribed one "
            f"(more than 2{SPACE}%): the two models are not driven by the same flow."
        ),
    ),
    (
        coverage,
        lambda share: share < COVERAGE_LIMIT,
        "The 3D states of {name} cover only {value} of the cycle: the rest of it is not compared.",
    ),
)
