"""Two reduced models in one case: both are compared with one reference, as if each were alone."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import pyvista as pv
import xarray as xr
from comparisons import two_models
from hypothesis import given
from hypothesis import strategies as st
from small_case import GENEROUS, bands, small_case, written
from test_metrics import rows_of
from tube_plot import write_tube
from tubes import SHORT
from vtkmodules.vtkIOHDF import vtkHDFReader

from cases.results.comparison_file import variables
from reports.result.load import load
from validation.compare import command as compare
from validation.compare.side_by_side import FIGURES, side_by_side

pytestmark = pytest.mark.slow

MODELS = {
    "row": {},
    "coupled": {
        "wall": {"law": "membrane", "base": "thick"},
        "solver": {"pressure": "section"},
        "uncertainty": {"method": "local"},
    },
}
INPUTS = {"wall.youngs_modulus": {"relative": "10 %", "reason": "stated"}}
VARIANTS = ("none", "local")
ROWS = rows_of(two_models())


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The case with both models, with each of them alone, and with the first as no model."""
    folder = tmp_path_factory.mktemp("models")
    plot = write_tube(folder / "tube.xplt", SHORT, np.linspace(0.0, 0.79, 5))
    content = bands(small_case(*VARIANTS), GENEROUS)
    content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
    del content["reference"]["calcified"]
    content["uncertainty"] = {"inputs": INPUTS, "samples": 4}
    for variant in content["variants"].values():
        variant["reference"] = {"plot_file": str(plot)}
    paths = {}
    for name, models in {
        "both": MODELS,
        "second": {"coupled": MODELS["coupled"]},
        "unnamed": None,
    }.items():
        content["name"] = name
        content.pop("models", None)
        content |= {} if models is None else {"models": models}
        paths[name] = written(content, folder, f"{name}.yaml")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ARTERIAL_ROM_CACHE", str(folder / "cache"))
        patch.setattr("validation.compare.case.write_reports", lambda directory: None)
        assert compare.main([*map(str, paths.values()), "--output", str(folder / "out")]) == 0
    return folder / "out"


def rows(results, name):
    return json.loads((results / name / "metrics.json").read_text(encoding="utf-8"))


def unnamed(rows):
    """Rows without names of case and model."""
    return [{key: row[key] for key in row if key not in ("case", "model")} for row in rows]


def test_rows_of_each_model_are_those_of_the_model_alone(results):
    found = rows(results, "both")
    assert {row["model"] for row in found} == set(MODELS)
    for model, alone in (("row", "unnamed"), ("coupled", "second")):
        own = [row for row in found if row["model"] == model]
        assert unnamed(own) == unnamed(rows(results, alone)) != []
    assert {row["model"] for row in rows(results, "unnamed")} == {"rom"}
    assert {row["model"] for row in rows(results, "second")} == {"coupled"}


def test_models_differ_and_share_the_reference(results):
    found = [row for row in rows(results, "both") if row["statistic"] == "value" and row["error"] is not None]
    one, two = ([row for row in found if row["model"] == model] for model in MODELS)
    shared = ("variant", "quantity", "i", "j", "t_s", "reference")
    for first, second in zip(one, two, strict=True):
        assert [first[key] for key in shared] == [second[key] for key in shared]
    assert all(a["rom"] != b["rom"] for a, b in zip(one, two, strict=True) if a["quantity"] == "pressure")


def test_the_dataset_has_fields_of_every_model(results):
    with (
        xr.open_dataset(results / "both/comparison.nc") as both,
        xr.open_dataset(results / "unnamed/comparison.nc") as first,
        xr.open_dataset(results / "second/comparison.nc") as second,
    ):
        assert json.loads(both.attrs["models"]) == ["row", "coupled"]
        assert json.loads(first.attrs["models"]) == ["rom"]
        assert variables(MODELS).items() <= {name: each.dims for name, each in both.data_vars.items()}.items()
        for name in both.data_vars:
            model, _, field = name.partition("_")
            source = second if model == "coupled" else first
            xr.testing.assert_identical(
                both[name], source[f"rom_{field}" if model == "row" else name].rename(name)
            )
        of_second = [name for name in second.data_vars if str(name).startswith("coupled_")]
        assert len(both.data_vars) == len(first.data_vars) + len(of_second)


def test_every_model_has_walls_for_paraview(results):
    names = {path.name for path in (results / "both").glob("*.vtkhdf")}
    assert names == {f"{model}_{variant}.vtkhdf" for model in (*MODELS, "reference") for variant in VARIANTS}
    with xr.open_dataset(results / "both/comparison.nc") as data:
        last = data.sel(variant="local").isel(time=-1).load()
    for model in (*MODELS, "reference"):
        reader = vtkHDFReader()
        reader.SetFileName(str(results / f"both/{model}_local.vtkhdf"))
        reader.UpdateInformation()
        reader.SetStep(reader.GetNumberOfSteps() - 1)
        reader.Update()
        wall = pv.wrap(reader.GetOutput())
        np.testing.assert_allclose(wall.cell_data["radius"], last[f"{model}_radius"].to_numpy().ravel(), 1e-6)
        stiffness = last[f"{'row' if model == 'reference' else model}_wall_stiffness"].to_numpy().ravel()
        np.testing.assert_allclose(wall.cell_data["wall_stiffness"], stiffness, 1e-6)


def test_provenance_tells_how_each_model_ran(results):
    about = json.loads((results / "both/provenance.json").read_text(encoding="utf-8"))
    for variant in VARIANTS:
        models = about["variants"][variant]["models"]
        assert list(models) == ["row", "coupled"]
        assert [models[name]["wall_law"] for name in MODELS] == ["thick", "membrane on thick"]
        assert f"{variant}, model coupled: reduced model" in about["wall_times_s"]
        assert f"{variant}: 3D onto cells" in about["wall_times_s"]
    assert [key for key in about["seeds"] if key != "bootstrap"] == [
        "uncertainty of none, model row", "uncertainty of local, model row"
    ]  # fmt: skip
    assert len(set(about["notes"])) == len(about["notes"])
    changes = [note for note in about["notes"] if "of the reduced model change by at most" in note]
    assert [note.split(":")[0] for note in changes] == [
        "none, model row", "none, model coupled", "local, model row", "local, model coupled"
    ]  # fmt: skip


def test_a_report_sees_one_model_at_a_time(results):
    comparison = load(results / "both")
    assert (comparison.models, comparison.model) == (("row", "coupled"), "row")
    other = comparison.of("coupled")
    assert (other.model, other.models) == ("coupled", ("row", "coupled"))
    assert other.of("row") is comparison
    alone = load(results / "unnamed")
    xr.testing.assert_equal(comparison.fields, alone.fields)
    assert unnamed(map(vars, comparison.metrics.rows)) == unnamed(map(vars, alone.metrics.rows))
    xr.testing.assert_equal(other.fields, load(results / "second").fields)
    assert other.settings("none").wall_law == "membrane on thick"


def test_side_by_side_a_model_has_columns_of_its_own(results):
    table = pd.read_csv(results / "side_by_side.csv")
    places = ["both, model row", "both, model coupled", "second", "unnamed"]
    assert [name for name in table.columns if ": " in name] == [f"{p}: {f}" for p in places for f in FIGURES]
    for one, other in (("both, model row", "unnamed"), ("both, model coupled", "second")):
        for figure in FIGURES:
            pd.testing.assert_series_equal(
                table[f"{one}: {figure}"], table[f"{other}: {figure}"], check_names=False
            )
    assert table["both, model row: error"].notna().any()


@given(st.permutations(["a", "b", "rom"]))
def test_lines_of_cases_meet_whatever_their_models_are_called(names):
    of_one = [row for row in ROWS if row.quantity == "radius"]
    several = [replace(row, model=name) for name in names for row in of_one]
    table = side_by_side({"one": of_one, "several": several})
    assert len(table) == len(side_by_side({"one": of_one}))
    for name in names:
        assert table[f"several, model {name}: error"].equals(table["one: error"])


def test_a_result_is_replaced_with_the_walls_of_its_models_alone(results, tmp_path, capsys, quick):
    folder = tmp_path / "out"
    folder.mkdir()
    for name in ("provenance.json", "comparison.nc", "coupled_none.vtkhdf", "reference_none.vtkhdf"):
        (folder / name).write_bytes((results / "both" / name).read_bytes())
    own = folder / "reference_mine.vtkhdf"
    own.write_text("precious")
    case = written(bands(small_case("none")), tmp_path)
    assert compare.main([str(case), "--output", str(folder)]) == 2
    assert "holds other files than a result (reference_mine.vtkhdf)" in capsys.readouterr().err
    assert own.read_text() == "precious"
