"""The solid wall in the case file."""

import pytest
from test_case_walls import THICK, wall_of

from cases.sections.wall import SolidWall, row_wall
from cases.sections.wall_laws.saint_venant_kirchhoff import SaintVenantKirchhoffWall

MATERIAL = "youngs_modulus: 0.6 MPa, poisson_ratio: 0.48"


def test_a_solid_states_its_material_and_elements(folder):
    wall = wall_of(folder, f"{{law: solid, {MATERIAL}, elements: [48, 6, 60], reference_pressure: 100 Pa}}")
    assert isinstance(wall, SolidWall)
    assert wall.elements == (48, 6, 60)
    rows = row_wall(wall)
    assert isinstance(rows, SaintVenantKirchhoffWall)
    assert (rows.youngs_modulus, rows.poisson_ratio, rows.reference_pressure) == (600_000.0, 0.48, 100.0)


def test_a_variant_becomes_a_solid_and_keeps_its_material(folder):
    wall = wall_of(folder, THICK, "{law: solid}")
    assert isinstance(wall, SolidWall)
    assert (wall.youngs_modulus, wall.poisson_ratio, wall.elements) == (600_000.0, 0.48, (24, 3, 30))


@pytest.mark.parametrize(
    ("wall", "message"),
    [
        (f"{{law: solid, {MATERIAL}, elements: [6, 3, 30]}}", "elements[1]: 6; allowed: a multiple of 4"),
        (f"{{law: solid, {MATERIAL}, elements: [24, 3]}}", "elements"),
        (f"{{law: solid, {MATERIAL}, elements: [24, 0, 30]}}", "elements[2]: 0; allowed"),
        (f"{{law: solid, {MATERIAL}, elements: [24, 3, 2]}}", "elements[3]: 2; allowed"),
        (
            f"{{law: solid, {MATERIAL}, elements: [1000, 3, 1000]}}",
            "3000000 elements; allowed: at most 20000",
        ),
        ("{law: solid, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}", "poisson_ratio: 0.5; allowed"),
        (f"{{law: solid, {MATERIAL}, base: thick}}", "wall.base: only with law membrane"),
    ],
)
def test_what_a_solid_refuses(folder, wall, message):
    problems = folder.problems((THICK, wall))
    assert any(message in problem for problem in problems), problems
