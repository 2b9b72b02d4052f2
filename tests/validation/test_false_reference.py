"""A check of the checks: a reference made false by a known factor fails the rows that speak of it."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from small_case import bands, small_case, written

from validation.compare import command as compare
from validation.reference.mesh import read as mesh_reference

pytestmark = pytest.mark.slow

ALL_BANDS = [
    *(("pressure", "bias", "3 %"), ("section_pressure", "bias", "3 %"), ("systolic_pressure", "bias", "3 %")),
    *(("pulse_pressure", "bias", "5 %"), ("radius", "bias", "2 %"), ("largest_radius", "bias", "2 %")),
    *(("mean_velocity", "bias", "3 %"), ("sector_flow_rate", "bias", "3 %")),
    *(("section_flow_rate", "bias", "3 %"), ("axial_velocity", "rms_difference", "8 mm/s")),
    ("profile_exponent", "bias", "15 %"),
]
OF_PRESSURE = {"pressure", "section_pressure", "systolic_pressure", "pulse_pressure"}
OF_VELOCITY = {"mean_velocity", "sector_flow_rate", "section_flow_rate", "axial_velocity"}


@pytest.fixture(scope="module")
def right(tmp_path_factory, runs_read):
    """The case with all bands, and its rows against the reference as it is."""
    folder = tmp_path_factory.mktemp("right")
    path = written(bands(small_case("none"), *ALL_BANDS), folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(*runs_read)
        patch.setattr("validation.compare.case.write_reports", lambda directory: None)
        assert compare.main([str(path), "--output", str(folder / "result"), "--check"]) == 0
    return path, pd.read_csv(folder / "result/metrics.csv")


@pytest.mark.parametrize(
    ("false", "factor", "failing", "also_changed"),
    [
        (
            "pressure",
            1.1,
            OF_PRESSURE,
            {"diastolic_pressure", "largest_pressure_difference", "section_pressure_range"},
        ),
        ("velocity", 1.05, OF_VELOCITY, set()),
    ],
)
def test_a_false_reference_fails_just_the_rows_that_speak_of_it(
    right, tmp_path, quick, monkeypatch, false, factor, failing, also_changed
):
    path, right = right
    model_of = mesh_reference.mesh_model

    def false_model(series, stated):
        model = model_of(series, stated)

        def read(state):
            values = model.read(state)
            return values._replace(**{false: factor * getattr(values, false)})

        return replace(model, read=read)

    monkeypatch.setattr(mesh_reference, "mesh_model", false_model)
    assert compare.main([str(path), "--output", str(tmp_path / "false"), "--check"]) == 1
    wrong = pd.read_csv(tmp_path / "false/metrics.csv")
    judged = wrong[wrong["status"].notna()]
    assert set(judged.loc[judged["status"] == "FAIL", "quantity"]) == failing
    assert set(right["status"].dropna()) == {"OK"}
    numbers = ["rom", "reference", "error"]
    same = np.isclose(right[numbers], wrong[numbers], rtol=1e-3, atol=1e-15, equal_nan=True).all(axis=1)
    lag = {"phase_lag"} if false == "velocity" else set()  # found by search
    consequences = {"mass_defect"} if false == "velocity" else set()
    changed = set(right.loc[~same, "quantity"]) - lag - consequences
    assert changed == (failing | also_changed) - ({"axial_velocity"} - set(right.loc[~same, "quantity"]))
    values = right["statistic"].isin(["value", "cycle"]) & right["quantity"].isin(changed)
    np.testing.assert_allclose(wrong["reference"][values] / right["reference"][values], factor, rtol=1e-6)
    np.testing.assert_array_equal(wrong["rom"][values], right["rom"][values])
