"""Whose error it is: budgets of made-up models, and of a small case from end to end."""

from dataclasses import replace

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from small_case import ROOT, bands, small_case, written
from test_budget_discretization import fields

from cases.reading.case_file import load_case_file
from solver.case.model import inlet_signal
from validation.compare import command as compare
from validation.compare.budget.discretization import Estimate
from validation.compare.budget.parts import Budget, budgets_of
from validation.compare.budget.sources import Sources
from validation.errors import ValidationError
from validation.metrics.rows import Models
from validation.reference.alignment import align
from validation.reference.kind import Reference
from validation.reference.mesh import read as mesh_reference
from validation.runs.matched_inflow import inlet_through, with_inflow_of
from validation.runs.reduced_model import ReducedModelRun

pytestmark = pytest.mark.slow

JUDGED = ("section_flow_rate", "pressure", "radius")


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return load_case_file(written(small_case("none"), tmp_path_factory.mktemp("case"))).variants["none"]


@pytest.mark.parametrize("states", [40, 41])
@pytest.mark.parametrize("beats", [1, 2])
def test_the_matched_inflow_keeps_the_mean(case, states, beats):
    prescribed, period = inlet_signal(case), case.inlet.period

    def taken_in(times):  # the inlet's area breathes
        return 2e-5 * prescribed(times) * (1.0 + 0.01 * np.sin(2.0 * np.pi * beats * times / period))

    times = np.linspace(0.0, period, states)
    alignment = align(times, 0.0, period, 1)
    waveform = inlet_through(case, alignment, taken_in(alignment.cycle_times)).waveform
    fine = np.linspace(0.0, period, 200_001)
    mean = np.trapezoid(waveform.values, waveform.times)
    assert mean == pytest.approx(np.trapezoid(taken_in(fine), fine), rel=1e-6)
    assert waveform.period == period


def test_the_inflow_of_a_half_cycle_is_refused(case):
    times = np.linspace(0.0, 0.5 * case.inlet.period, 21)
    with pytest.raises(Exception, match="the inflow of the reference: its states cover 50"):
        inlet_through(case, align(times, 0.0, case.inlet.period, 1), np.ones(21))


def test_a_reference_that_tells_too_little_inflow_is_named(case):
    alignment = align(np.linspace(0.0, 0.5 * case.inlet.period, 21), 0.0, case.inlet.period, 1)
    checks = xr.Dataset({"inlet_flow_rate": ("time", np.ones(21))})
    reference = Reference(xr.Dataset(), checks, alignment, {}, ())
    with pytest.raises(
        ValidationError, match=r"none\.xplt: the inflow of the reference: its states cover 50"
    ):
        with_inflow_of(case, reference)


def test_a_coarser_mesh_of_another_artery_is_said(tmp_path, quick, capsys, known_runs):
    content = small_case("none")
    other = str(ROOT / "reference_data/febio_levels/local_16.xplt")
    content["variants"]["none"]["reference"]["levels"] = [other]
    assert compare.main([str(written(content, tmp_path)), "--output", str(tmp_path / "result")]) == 0
    said = "none: reference.levels: local_16.xplt: the reference is calcified at x 5 to 10 mm"
    assert said in capsys.readouterr().err


def test_a_reference_scaled_in_one_quantity_is_an_error_of_the_model_there_alone():
    exact = fields(0.0)
    reference = exact.copy()
    reference["radius"] = exact["radius"] * 1.03
    run = ReducedModelRun(exact, exact["radius"], 0.0, {})
    mesh = {name: Estimate(5e-4, None, 2.0, 3.0) for name in ("radius", "pressure")}
    models = Models("made", "up", exact * 1.01, reference, 0.8)
    found = budgets_of(models, Sources(run, {}, mesh, ()), {"pressure": 2e-3}, shared=False)
    radius, pressure = found["radius"], found["pressure"]
    assert radius.matched == pytest.approx(0.03, abs=1e-3)
    assert (radius.model_low, radius.model_high) == pytest.approx((0.03, 0.03), abs=1.5e-3)
    assert (pressure.matched, pressure.model_low) == (0.0, 0.0)
    assert pressure.error == pytest.approx(0.01)
    assert pressure.inflow == pytest.approx(0.01)
    assert pressure.uncertainty == pytest.approx(np.hypot(5e-4, 2e-3))
    assert found["mean_velocity"].mesh is None


def test_what_is_not_known_does_not_count():
    assert Budget(0.02).uncertainty is None
    assert (Budget(0.02).model_low, Budget(0.02).model_high) == (0.02, 0.02)
    assert Budget(0.02, matched=0.001, grid=0.004).model_low == 0.0


def budget_of(result):
    rows = pd.read_csv(result / "metrics.csv", keep_default_na=False)
    rows = rows[rows["statistic"].str.startswith("budget_")]
    return {(r.quantity, r.statistic.removeprefix("budget_")): r.error for r in rows.itertuples()}


@pytest.fixture(scope="module")
def against_the_real_run(tmp_path_factory, runs_read):
    folder = tmp_path_factory.mktemp("budget")
    content = bands(small_case("none"), ("section_flow_rate", "rms_error", "2 %"))
    content["compare"]["matched_inflow"] = True
    content["variants"]["none"]["reference"] |= {
        "levels": [str(ROOT / "reference_data/febio_levels/none_16.xplt")]
    }
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(*runs_read)
        assert compare.main([str(written(content, folder)), "--output", str(folder / "result")]) == 0
    return folder / "result"


def test_the_healthy_artery_owes_its_error_to_inflow_and_mesh(against_the_real_run):
    found = budget_of(against_the_real_run)
    for quantity, most in zip(JUDGED, (0.003, 0.002, 0.0025), strict=True):
        assert float(found[quantity, "matched"]) < most
        assert float(found[quantity, "mesh"]) > 0.0
        assert found[quantity, "inputs"] == ""
    for quantity in ("section_flow_rate", "pressure"):
        assert float(found[quantity, "inflow"]) > float(found[quantity, "matched"])
    rows = pd.read_csv(against_the_real_run / "metrics.csv", keep_default_na=False)
    matched = rows[(rows["inflow"] == "matched") & (rows["statistic"] == "rms_error")]
    flow = matched.loc[matched["quantity"] == "section_flow_rate", "error"]
    assert float(flow.iloc[0]) == pytest.approx(float(found["section_flow_rate", "matched"]), rel=1e-6)
    assert set(matched["status"]) == {""}
    with netCDF4.Dataset(against_the_real_run / "comparison.nc") as stored:
        parts, names = list(stored["part"][:]), list(stored["quantity"][:])
        value = stored["rom_error_budget"][0, names.index("pressure"), parts.index("mesh")]
    assert float(value) == pytest.approx(float(found["pressure", "mesh"]), rel=1e-12)


def test_the_report_says_whose_error_it_is(against_the_real_run):
    page = (against_the_real_run / "report.html").read_text(encoding="utf-8")
    assert "Error budget" in page
    assert "formal order 2 and a factor of safety of 3" in page
    assert "the inflow of the 3D mesh alone" in page


def test_a_false_reference_is_an_error_of_the_model(tmp_path, quick, made, monkeypatch):
    content = made(("radius", "rms_error", "50 %"))
    content["compare"]["matched_inflow"] = True
    path = written(content, tmp_path)
    model_of = mesh_reference.mesh_model

    def false_model(series, stated):
        model = model_of(series, stated)

        def read(state):
            values = model.read(state)
            return values._replace(pressure=values.pressure / 0.97)

        return replace(model, read=read)

    assert compare.main([str(path), "--output", str(tmp_path / "right")]) == 0
    monkeypatch.setattr(mesh_reference, "mesh_model", false_model)
    assert compare.main([str(path), "--output", str(tmp_path / "false")]) == 0
    right, false = budget_of(tmp_path / "right"), budget_of(tmp_path / "false")
    assert false["radius", "matched"] == right["radius", "matched"]
    assert false["pressure", "matched"] != right["pressure", "matched"]
    assert {part for (_, part), value in right.items() if value == ""} >= {"mesh", "inputs"}


def test_the_inlet_may_be_that_of_the_reference(tmp_path, quick, made, case):
    content = made()
    content["inlet"] = {"kind": "reference", "period": f"{case.inlet.period!r} s"}
    content["compare"]["times"] = ["end diastole"]
    assert compare.main([str(written(content, tmp_path)), "--output", str(tmp_path / "result")]) == 0
    found = budget_of(tmp_path / "result")
    assert float(found["section_flow_rate", "inflow"]) < 1e-6


def test_only_a_comparison_knows_the_inflow_of_the_reference(tmp_path, made, capsys):
    from solver import command as solver

    content = made()
    content["inlet"] = {"kind": "reference", "period": "0.8 s"}
    content["compare"]["times"] = ["end diastole"]
    path = written(content, tmp_path)
    assert solver.main([str(path), "--output", str(tmp_path / "run.nc")]) == 2
    assert "inlet.kind: reference" in capsys.readouterr().err


@pytest.mark.parametrize("shared", [False, True])
def test_uncertain_inputs_enter_the_budget(tmp_path, quick, made, shared):
    content = made()
    stated = {"outlet.resistance": {"relative": "5 %", "reason": "made up"}}
    content["uncertainty"] = {"samples": 8, "inputs": stated, "shared_with_reference": shared}
    assert compare.main([str(written(content, tmp_path)), "--output", str(tmp_path / "result")]) == 0
    found = budget_of(tmp_path / "result")
    part = "shared_inputs" if shared else "inputs"
    share = float(found["pressure", part])
    assert 0.005 < share < 0.05  # the resistance carries a part of the pressure
    assert (float(found["pressure", "uncertainty"]) >= share) == (not shared)
    assert float(found["section_flow_rate", part]) < share  # the inflow is prescribed
