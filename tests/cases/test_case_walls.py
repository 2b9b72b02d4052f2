"""Wall laws: what each states, and what a variant keeps when it states another one."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from cases.sections.wall_laws.law import HomogeneousWall
from cases.sections.wall_laws.layered import LayeredWall
from cases.sections.wall_laws.table import TableWall

THICK = "{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}"
LAYERS = (
    "[{name: intima, thickness: 0.1 mm, youngs_modulus: 0.3 MPa}, "
    "{name: media, thickness: 0.25 mm, youngs_modulus: 0.9 MPa, calcifies: true}, "
    "{name: adventitia, thickness: 0.15 mm, youngs_modulus: 0.6 MPa}]"
)
LAYERED = f"{{law: layered, layers: {LAYERS}, poisson_ratio: 0.45}}"
TABLE = "{law: table, table: data/wall.csv, youngs_modulus: 0.6 MPa}"
HEALTHY = (
    (
        "    calcification:\n      pattern: local\n      youngs_modulus: 10 MPa\n      x: [5 mm, 10 mm]\n"
        "      phi: [135 deg, 225 deg]\n      transition: sharp\n"
    ),
    "",
)


def wall_of(folder, base, override=None):
    edits = [] if override is None else [("title: A patch", f"title: A patch\n    wall: {override}")]
    return folder.load((THICK, base), *edits).variants["local"].wall


@pytest.mark.parametrize("law", ["thin", "thick", "saint_venant_kirchhoff", "neo_hookean"])
def test_laws_of_one_material_share_their_keys(folder, law):
    wall = wall_of(folder, THICK, f"{{law: {law}}}")
    assert isinstance(wall, HomogeneousWall)
    assert (wall.law, wall.youngs_modulus, wall.poisson_ratio) == (law, 600_000.0, 0.48)
    assert wall.reference_pressure == 0.0


def test_layers_stand_from_inside_to_outside(folder):
    wall = wall_of(folder, LAYERED)
    assert isinstance(wall, LayeredWall)
    assert [layer.name for layer in wall.layers] == ["intima", "media", "adventitia"]
    assert [layer.thickness for layer in wall.layers] == [0.0001, 0.00025, 0.00015]
    assert [layer.youngs_modulus for layer in wall.layers] == [0.3e6, 0.9e6, 0.6e6]
    assert [layer.calcifies for layer in wall.layers] == [False, True, False]
    assert (wall.poisson_ratio, wall.reference_pressure) == (0.45, 0.0)


def test_layers_need_not_calcify_in_a_healthy_artery(folder):
    layered = LAYERED.replace(", calcifies: true", "")
    wall = folder.load((THICK, layered), HEALTHY).variants["local"].wall
    assert not any(layer.calcifies for layer in wall.layers)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=20)
@given(st.lists(st.integers(1, 400), min_size=1, max_size=8))
def test_any_layers_that_sum_to_the_wall_are_taken(folder, thicknesses):
    layers = [
        f"{{name: l{item}, thickness: {thickness} µm, youngs_modulus: 1 MPa, calcifies: true}}"
        for item, thickness in enumerate(thicknesses)
    ]
    layered = f"{{law: layered, poisson_ratio: 0.4, layers: [{', '.join(layers)}]}}"
    file = folder.load((THICK, layered), ("0.5 mm", f"{sum(thicknesses)} µm"))
    assert len(file.variants["none"].wall.layers) == len(thicknesses)
    problems = folder.problems((THICK, layered), ("0.5 mm", f"{sum(thicknesses) + 1} µm"))
    assert "thicknesses that sum to geometry.wall_thickness" in problems[0]


def test_a_table_is_read(folder):
    wall = wall_of(folder, TABLE)
    assert isinstance(wall, TableWall)
    assert wall.table.radii.tolist() == [0.002, 0.0024, 0.0026, 0.003]
    assert wall.table.pressures.tolist() == [-5000.0, 0.0, 4000.0, 20000.0]
    assert wall.table.path == (folder.path / "data/wall.csv").resolve()
    assert wall.youngs_modulus == 600_000.0


@pytest.mark.parametrize(("radius", "allowed"), [("2 mm", True), ("3 mm", True), ("3.1 mm", False)])
def test_a_table_must_hold_the_unloaded_radius(folder, radius, allowed):
    edits = ((THICK, TABLE), ("2.5 mm", radius))
    if allowed:
        assert folder.load(*edits).variants["none"].wall.law == "table"
        return
    assert folder.problems(*edits) == [
        (
            "x.yaml, line 8: wall.table: radii from 0.002 m to 0.003 m; "
            "allowed: a range that holds geometry.radius (0.0031 m)"
        )
    ]


def test_another_law_keeps_the_keys_that_it_has_too(folder):
    wall = wall_of(folder, THICK, f"{{law: layered, layers: {LAYERS}}}")
    assert (wall.law, wall.poisson_ratio) == ("layered", 0.48)
    wall = wall_of(folder, THICK, "{law: table, table: data/wall.csv}")
    assert (wall.law, wall.youngs_modulus) == ("table", 600_000.0)
    wall = wall_of(folder, LAYERED, "{law: thin, youngs_modulus: 1 MPa}")
    assert (wall.law, wall.poisson_ratio) == ("thin", 0.45)


def test_another_law_does_not_hide_a_misspelt_key(folder):
    override = ("title: A patch", "title: A patch\n    wall: {law: thin}")
    problems = folder.problems((THICK, THICK.replace("}", ", reference_presure: 0 Pa}")), override)
    assert problems == [
        (
            "x.yaml, line 8: wall.reference_presure: unknown key reference_presure; did you mean "
            "reference_pressure? allowed: law, youngs_modulus, poisson_ratio, reference_pressure"
        )
    ]


def test_the_wall_is_hashable_and_can_be_written_as_json(folder):
    edits = ((THICK, TABLE),)
    one, other = folder.load(*edits).variants["none"], folder.load(*edits).variants["none"]
    assert one == other
    assert hash(one) == hash(other)
    assert one.model_dump(mode="json")["wall"]["table"] == {
        "radii": [0.002, 0.0024, 0.0026, 0.003],
        "pressures": [-5000.0, 0.0, 4000.0, 20000.0],
    }
