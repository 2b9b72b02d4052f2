"""Inputs of the 3D run's log stand beside those of the case, and what differs is told."""

from pathlib import Path

import pytest

from cases.reading.case_file import load_case_file
from validation.compare.inputs import compared_inputs, differing

CASE = Path(__file__).parents[2] / "cases" / "calcification.yaml"
TOLD = [
    {"material": "Blood", "fluid": True, "name": "density", "value": 1060.0},
    {"material": "Blood", "fluid": True, "name": "mu", "value": 0.004},
    {"material": "Healthy", "fluid": False, "name": "density", "value": 1000.0},
    {"material": "Healthy", "fluid": False, "name": "E", "value": 6e5},
    {"material": "Calcified", "fluid": False, "name": "E", "value": 9e6},
    {"material": "Calcified", "fluid": False, "name": "v", "value": 0.48},
]


@pytest.mark.parametrize(("variant", "nearest"), [("none", 0.6e6), ("local", 10e6)])
def test_each_input_stands_beside_the_nearest_of_the_case(variant: str, nearest: float) -> None:
    found = compared_inputs(load_case_file(CASE).variants[variant], TOLD)
    assert [item["case"] for item in found] == [1060.0, 0.0035, None, 0.6e6, nearest, 0.48]
    assert differing(found) == [
        "viscosity of Blood 0.004 in 3D, 0.0035 in the case (Pa s)",
        f"Young's modulus of Calcified 9e+06 in 3D, {nearest:g} in the case (Pa)",
    ]
