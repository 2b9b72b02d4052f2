"""The models between the row-local and the coupled one, and their table."""

import json

import numpy as np
import pandas as pd
import pytest
from small_case import ROOT, small_case, written

from cases.reading.case_file import load_case_file
from cases.sections.wall import MembraneWall
from solver.errors import ModelError
from validation.ablation import command as ablation
from validation.ablation.ladder import models_between
from validation.ablation.study import ablation_row
from validation.ablation.thesis_sectors import read_table, sector_errors
from validation.errors import ValidationError

TABLE = ROOT / "reference_data/thesis/table_3_8.csv"


@pytest.fixture
def case_of(tmp_path):
    def of(**wall):
        content = small_case("local")
        content["wall"] |= wall
        return load_case_file(written(content, tmp_path)).variants["local"]

    return of


@pytest.mark.parametrize("wall", [{}, {"law": "membrane", "base": "thick", "supports": "free"}])
def test_each_model_changes_one_thing(case_of, wall):
    models = models_between(case_of(**wall))
    assert list(models) == [
        "thin wall, row pressure",
        "thick wall, row pressure",
        "membrane wall, row pressure",
        "thick wall, section pressure",
        "membrane wall, section pressure",
    ]
    for words, case in models.items():
        assert case.solver.pressure == ("section" if "section" in words else "row")
        assert case.wall.law == words.split(" ", 1)[0]
    coupled = models["membrane wall, section pressure"].wall
    assert isinstance(coupled, MembraneWall)
    assert (coupled.base, coupled.supports) == ("thick", wall.get("supports", "quarters"))


def test_a_nonlinear_wall_has_its_own_rows(case_of):
    assert list(models_between(case_of(law="neo_hookean"))) == [
        "neo_hookean wall, row pressure",
        "membrane wall, row pressure",
        "neo_hookean wall, section pressure",
        "membrane wall, section pressure",
    ]


def test_a_solid_stands_beside_the_membrane_of_its_material(case_of):
    models = models_between(case_of(law="solid", poisson_ratio=0.48))
    assert list(models) == [
        "saint_venant_kirchhoff wall, row pressure",
        "membrane wall, row pressure",
        "solid wall, row pressure",
        "saint_venant_kirchhoff wall, section pressure",
        "membrane wall, section pressure",
        "solid wall, section pressure",
    ]
    assert models["membrane wall, section pressure"].wall.base == "saint_venant_kirchhoff"


@pytest.mark.slow
def test_the_command_writes_a_row_a_model(tmp_path, capsys, known_runs):
    output = tmp_path / "found"
    assert ablation.main([str(written(small_case("local"), tmp_path)), "--output", str(output)]) == 0
    table = pd.read_csv(output / "ablation.csv")
    assert len(table) == 5
    assert set(table["variant"]) == {"local"}
    rows = table.set_index("model")
    assert rows.loc["membrane wall, section pressure", "radius_rms"] < 0.01
    assert rows.loc["thick wall, row pressure", "radius_rms"] > 0.015
    records = json.loads((output / "ablation.json").read_text())
    assert [record["model"] for record in records] == list(table["model"])
    assert "membrane wall, section pressure" in " ".join(capsys.readouterr().out.split())
    assert sorted(path.name for path in output.iterdir()) == ["ablation.csv", "ablation.json"]


def test_a_model_that_fails_is_a_row(case_of, monkeypatch):
    def fails(*_):
        raise ModelError("the membrane buckles")

    monkeypatch.setattr("validation.ablation.study.run_reduced_model", fails)
    reference = type("Reference", (), {"alignment": None})()
    row = ablation_row("local", "membrane wall", case_of(), reference, None)
    assert (row.failure, row.radius_rms) == ("the membrane buckles", None)


def test_a_missing_case_is_refused(tmp_path, capsys):
    assert ablation.main([str(tmp_path / "none.yaml")]) == 2
    assert "none.yaml" in capsys.readouterr().err


def test_a_variant_without_a_reference_is_refused(tmp_path, capsys):
    content = small_case("local")
    del content["reference"], content["variants"]["local"]["reference"]
    assert ablation.main([str(written(content, tmp_path)), "--output", str(tmp_path / "x")]) == 2
    assert "small.yaml: reference of variant 'local': missing" in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "cannot be read"),
        ("a,b\n1,2\n", "needs columns"),
        ("j,t_s,i_1\n4,1.692,0.1\n5,1.884,0.1\n", "lacks a number"),
        ("j,t_s,i_999\n4,1.692,0.1\n", "lacks"),
    ],
)
def test_what_a_table_of_sectors_needs(case_of, tmp_path, text, message):
    path = tmp_path / "table.csv"
    path.write_text(text)
    with pytest.raises(ValidationError, match=message):
        sector_errors(case_of(), path)


def test_the_printed_table_is_read_whole():
    table = read_table(TABLE)
    assert table.shape == (9, 7)
    assert np.isclose(table["i_61"].max(), 0.1103)
