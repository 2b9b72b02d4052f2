"""``reference.kind: series``: values land at their place and instants; wrong files are refused."""

import numpy as np
import pytest
from ruamel.yaml import YAML
from small_case import ROOT, written

from cases.reading.case_file import load_case_file
from solver.case.model import grid_of
from validation.compare import command as compare
from validation.errors import UnusableReferenceError
from validation.mapping.rays import rays
from validation.metrics.quantities import radius_change
from validation.metrics.statistics import statistic_value
from validation.reference.series import align_series, read_series

READY = ROOT / "cases/boileau_cca.yaml"
PERIOD, COUNT = 1.1, 66
TIMES = PERIOD * np.arange(COUNT) / COUNT


def wave(times):
    return np.cos(2 * np.pi * times / PERIOD) + 0.3 * np.sin(6 * np.pi * times / PERIOD)


def content(folder, offset=0.0, table=None, **reference):
    """The ready case with a series of its own: pressure, flow and the change of radius."""
    case = YAML().load(READY)
    case["inlet"]["waveform"] = str(ROOT / case["inlet"]["waveform"])
    case["solver"] |= {"cycles": 1, "time_step": "5 ms", "n_x": 11}
    case["compare"] = {"cells": {"i": [6], "j": [1]}}
    path = folder / "series.csv"
    if table is None:
        values = wave(TIMES - offset)
        rows = [f"{t},{12 + v},{1e3 * v},{v + 2}" for t, v in zip(TIMES, values, strict=True)]
        table = "\n".join(["t_s,pressure_kPa,flow_rate_mL_s,radius_change_mm", *rows])
    path.write_text(table)
    case["variants"] = {"only": {"title": "Only"}}
    case["reference"] |= {"file": str(path), "time_offset": f"{offset} s"} | reference
    return case


def read(folder, case):
    (loaded,) = load_case_file(written(case, folder)).variants.values()
    grid = grid_of(loaded)
    return read_series(loaded, rays(grid.x, grid.phi))


@pytest.mark.parametrize("offset", [0.0, 0.0573, -0.2])
def test_values_are_at_their_place_and_instant(tmp_path, offset):
    found = read(tmp_path, content(tmp_path, offset))
    at = found.fields.isel(x=5)
    expected = wave(at["time"].to_numpy())
    np.testing.assert_allclose(at["section_pressure"], 1e3 * (12 + expected), atol=1.0)
    np.testing.assert_allclose(at["section_flow_rate"], 1e-3 * expected, atol=1e-6)
    change = radius_change(found.fields)[:, 5]
    assert change.min() == 0.0  # over its least, whatever the file is over
    np.testing.assert_allclose(change, 1e-3 * (expected - expected.min()), atol=1e-6)
    for name, values in found.fields.data_vars.items():
        elsewhere = values if "x" not in values.dims else values.drop_isel(x=5)
        if name not in ("radius_change", "section_pressure", "section_flow_rate") or "x" in values.dims:
            assert np.all(np.isnan(elsewhere)), name


@pytest.mark.parametrize(
    ("table", "reference", "said"),
    [
        ("t_s,pressure_kPa\n0,1\n0.5,2\n0.4,1\n1.09,1\n", {}, "4 times that do not all increase"),
        ("t_s,pressure_kPa\n0,1\n0.2,2\n0.4,1\n", {}, "allowed: one cycle of 1.1 s"),
        ("pressure_kPa\n1\n2\n", {}, "no column t_s, t_ms; it has: pressure_kPa"),
        (
            "t_s,force_N\n0,1\n0.5,2\n1.09,1\n",
            {},
            "columns t_s, force_N; allowed: one or more of",
        ),
        ("t_s,pressure_kPa\n0,1\n0.5,x\n1.09,1\n", {}, "row 2 of pressure_kPa: x; allowed: a number"),
        (None, {"x": "50 mm"}, "allowed: the middle of a section"),
    ],
)
def test_what_does_not_fit_is_refused(tmp_path, table, reference, said):
    with pytest.raises(UnusableReferenceError, match=said.replace("(", r"\(")) as raised:
        read(tmp_path, content(tmp_path, table=table, **reference))
    assert reference or "series.csv" in str(raised.value)


def test_variants_share_their_instants(tmp_path):
    one, other = content(tmp_path), content(tmp_path, 0.0573)
    times = [
        align_series(next(iter(load_case_file(written(c, tmp_path)).variants.values()))).cycle_times
        for c in (one, other)
    ]
    assert np.array_equal(*times)


def test_the_study_s_statistic():
    reference = np.array([0.0, 2.0, -4.0])
    value = statistic_value("rms_over_largest", reference + np.array([0.3, -0.3, 0.3]), reference)
    assert value == pytest.approx(0.3 / 4)


@pytest.mark.long
def test_a_comparison_with_a_report(tmp_path):
    case = content(tmp_path)
    case["compare"]["bands"] = [
        {"quantity": "section_pressure", "statistic": "rms_error", "limit": "50 %", "reason": "generous"},
        {"quantity": "radius_change", "statistic": "rms_over_largest", "limit": "0.001 %", "reason": "none"},
    ]
    target = tmp_path / "out"
    status = compare.main([str(written(case, tmp_path)), "--output", str(target)])
    table = (target / "metrics.csv").read_text()
    assert status == 0
    assert "OK" in table
    assert "FAIL" in table
    assert (target / "report.pdf").stat().st_size > 0


@pytest.mark.long
@pytest.mark.parametrize("name", ["cca", "uta"])
def test_boileau_s_arteries(tmp_path, name):
    compare.main([str(ROOT / f"cases/boileau_{name}.yaml"), "--output", str(tmp_path / "out")])
    lines = [line.split(",") for line in (tmp_path / "out/metrics.csv").read_text().splitlines()]
    at = {key: lines[0].index(key) for key in ("variant", "quantity", "status")}
    missed = [
        (line[at["variant"]], line[at["quantity"]]) for line in lines[1:] if line[at["status"]] == "FAIL"
    ]
    assert missed == []
