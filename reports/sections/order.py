"""The sections of a report in reading order, a line each; their numbers follow from it."""

from reports.sections import (
    ablation,
    answer,
    artery,
    assumptions,
    budget,
    change,
    cycle,
    dominance,
    exponents,
    maps,
    moved,
    overview,
    provenance,
    velocity,
    verdict,
)
from reports.sections.declaration import Declared

SECTIONS: list[Declared] = [
    answer.section,
    overview.section,
    moved.section,
    verdict.section,
    budget.section,
    change.section,
    cycle.section,
    velocity.section,
    exponents.section,
    maps.section,
    dominance.section,
    assumptions.section,
    artery.section,
    ablation.section,
    provenance.section,
]
