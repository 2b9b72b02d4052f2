"""The sentence behind a band names what its uncertainty counts, and nothing else."""

import pytest

from cases.statistics import BUDGET_PARTS
from reports.sections.parts.error_budget import Budget, sentence


@pytest.mark.parametrize(
    ("known", "named"),
    [
        ({"mesh": 0.002, "grid": 0.001, "shared_inputs": 0.1}, "the 3D mesh and the 2D grid and step"),
        ({"mesh": 0.002, "inputs": 0.1}, "the 3D mesh and the inputs"),
        ({"mesh": 0.002}, "the 3D mesh"),
    ],
)
def test_no_model_error_is_told_from_what_counts(known: dict[str, float], named: str) -> None:
    parts = dict.fromkeys(BUDGET_PARTS) | {"error": 0.001, "uncertainty": 0.002} | known
    assert sentence(Budget("radius", parts)).replace("\u00a0", " ") == (
        f"no model error can be told from the uncertainty of {named} (error 0.10 %, uncertainty 0.20 %)"
    )
