"""The membrane wall and one pressure a section in the case file."""

import pytest
from test_case_walls import LAYERS, THICK, wall_of

from cases.sections.wall import MembraneWall, row_wall
from cases.sections.wall_laws.law import HomogeneousWall
from cases.sections.wall_laws.layered import LayeredWall
from cases.sections.wall_laws.table import TableWall

MATERIAL = "youngs_modulus: 0.6 MPa, poisson_ratio: 0.48"
MEMBRANES = {
    "thin": f"{{law: membrane, base: thin, {MATERIAL}}}",
    "thick": f"{{law: membrane, base: thick, {MATERIAL}, reference_pressure: 100 Pa, supports: free}}",
    "neo_hookean": f"{{law: membrane, base: neo_hookean, {MATERIAL}}}",
    "layered": f"{{law: membrane, base: layered, poisson_ratio: 0.45, layers: {LAYERS}}}",
    "table": f"{{law: membrane, base: table, table: data/wall.csv, {MATERIAL}}}",
}
SOLVER = ("  closure: average", "  closure: average\n  pressure: section")


@pytest.mark.parametrize(
    ("base", "kind"),
    [
        ("thin", HomogeneousWall),
        ("thick", HomogeneousWall),
        ("neo_hookean", HomogeneousWall),
        ("layered", LayeredWall),
        ("table", TableWall),
    ],
)
def test_a_membrane_follows_any_row_law(folder, base, kind):
    wall = wall_of(folder, MEMBRANES[base])
    assert isinstance(wall, MembraneWall)
    own = row_wall(wall)
    assert isinstance(own, kind)
    assert own.law == base
    assert row_wall(own) is own


def test_what_a_membrane_states_reaches_its_base(folder):
    wall = wall_of(folder, MEMBRANES["thick"])
    assert (wall.supports, row_wall(wall).reference_pressure) == ("free", 100.0)
    other = wall_of(folder, MEMBRANES["thin"])
    assert (other.supports, row_wall(other).reference_pressure) == ("quarters", 0.0)


def test_a_variant_becomes_a_membrane_and_keeps_its_material(folder):
    wall = wall_of(folder, THICK, "{law: membrane, base: thick}")
    assert isinstance(wall, MembraneWall)
    assert (wall.youngs_modulus, wall.poisson_ratio) == (600_000.0, 0.48)
    back = wall_of(folder, MEMBRANES["thick"], "{law: thin}")
    assert isinstance(back, HomogeneousWall)


@pytest.mark.parametrize(
    ("wall", "message"),
    [
        ("{law: membrane, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}", "base: missing; allowed: thin"),
        ("{law: membrane, base: ring, poisson_ratio: 0.48}", "base: ring; allowed: thin"),
        ("{law: membrane, base: thick, poisson_ratio: 0.48}", "base thick without youngs_modulus"),
        ("{law: membrane, base: layered, poisson_ratio: 0.48}", "base layered without layers"),
        (f"{{law: membrane, base: table, {MATERIAL}}}", "base table without table"),
        (
            f"{{law: membrane, base: thick, {MATERIAL}, supports: glue}}",
            "supports: glue; allowed: quarters, free",
        ),
        (
            f"{{law: membrane, base: thick, {MATERIAL}, table: data/wall.csv}}",
            "wall.table: table; allowed: base thick",
        ),
        (f"{{law: thick, {MATERIAL}, base: thin}}", "wall.base: only with law membrane"),
        (
            "{law: membrane, base: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.51}",
            "poisson_ratio: 0.51; allowed: a number from 0 to 0.5",
        ),
        (
            "{law: membrane, base: saint_venant_kirchhoff, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}",
            "poisson_ratio: 0.5; allowed: less than 0.5 with base saint_venant_kirchhoff",
        ),
    ],
)
def test_what_a_membrane_refuses(folder, wall, message):
    found = folder.problems((THICK, wall))
    assert any(message in problem for problem in found), found


def test_pressure_belongs_to_rows_unless_a_section_is_asked_for(folder):
    assert folder.load().variants["local"].solver.pressure == "row"
    assert folder.load(SOLVER).variants["local"].solver.pressure == "section"


def test_what_pressure_refuses(folder):
    wrong = ("  closure: average", "  closure: average\n  pressure: cell")
    assert any("pressure: cell; allowed: row, section" in problem for problem in folder.problems(wrong))
    godunov = ("scheme: semi_implicit", "scheme: godunov\n  pressure: section")
    assert any("only with scheme semi_implicit" in problem for problem in folder.problems(godunov))


def test_godunov_has_no_membrane(folder):
    found = folder.problems((THICK, MEMBRANES["thick"]), ("scheme: semi_implicit", "scheme: godunov"))
    assert any("semi_implicit with the wall law membrane" in problem for problem in found), found
