"""``reference.kind: tables``: the thesis's rows land where they are printed; wrong tables are refused."""

import json

import numpy as np
import pandas as pd
import pytest
from ruamel.yaml import YAML
from small_case import ROOT, written

from cases.reading.case_file import load_case_file
from solver.case.model import grid_of
from validation.compare import command as compare
from validation.compare.comparison import baselines_of
from validation.errors import UnusableReferenceError
from validation.mapping.rays import rays
from validation.reference.tables import align_tables, read_tables

THESIS = ROOT / "reference_data" / "thesis"
READY = ROOT / "cases/thesis.yaml"
PERIOD = 2.392 / 3


def content(*variants):
    """The ready case with some of its variants and absolute paths."""
    case = YAML().load(READY)
    case["inlet"]["waveform"] = str(ROOT / case["inlet"]["waveform"])
    case["compare"]["bands"] = []
    case["variants"] = {name: case["variants"][name] for name in variants}
    for reference in (case["reference"], *(variant["reference"] for variant in case["variants"].values())):
        for key, value in reference.items():
            if str(value).startswith("reference_data"):
                reference[key] = str(ROOT / value)
    return case


def read(folder, stated, variant):
    case = load_case_file(written(stated, folder)).variants[variant]
    grid = grid_of(case)
    return read_tables(case, rays(grid.x, grid.phi))


def printed(values):
    return values[~np.isnan(values)]


def test_every_printed_flow_rate_is_at_its_cell_and_instant(tmp_path):
    found = read(tmp_path, content("none"), "none")
    table = pd.read_csv(THESIS / "table_3_6.csv")
    lines = table[table["simulation"] == "3D"].set_index("t_s")
    q = found.fields["section_flow_rate"]
    assert printed(q.to_numpy()).size == 15
    for t in lines.index:
        state = q.isel(time=int(np.argmin(np.abs(q["time"].to_numpy() - (t - 2 * PERIOD)))))
        assert abs(state["time"].item() - (t - 2 * PERIOD)) < 2e-3
        for i in (1, 39, 61, 82, 120):
            assert state[i - 1].item() == pytest.approx(1e-6 * lines.loc[t, f"i_{i}"], rel=1e-12)


def test_sectors_and_dominance_are_at_their_rows(tmp_path):
    found = read(tmp_path, content("none", "local"), "local").fields
    table = pd.read_csv(THESIS / "table_3_8.csv")
    sectors = found["sector_flow_rate"].to_numpy()
    assert printed(sectors).size == 45
    for n, t in enumerate(sorted(table["t_s"].unique())):
        state = sectors[~np.isnan(sectors).all(axis=(1, 2))][n]
        for line in table[table["t_s"] == t].to_dict("records"):
            assert state[38, int(line["j"]) - 1] == pytest.approx(1e-6 * line["i_39"], rel=1e-12)
    radial = found["axial_dominance_radial"].to_numpy()
    assert printed(radial).size == 15
    assert (radial[119, 24], np.nanmax(radial)) == (0.16928, 0.16928)
    assert np.nanmax(found["axial_dominance_azimuthal"]) == 0.09851


@pytest.mark.parametrize(
    ("variant", "pressure", "radius"), [("none", 16.09e3, 2.822e-3), ("none-2D", 15.88e3, 2.748e-3)]
)
def test_quoted_values_are_numbers_of_the_cycle(tmp_path, variant, pressure, radius):
    found = read(tmp_path, content(variant), variant).cycle
    assert (found["systolic_pressure"], found["largest_radius"]) == pytest.approx((pressure, radius))
    assert found["pulse_pressure"] == found["systolic_pressure"] - found["diastolic_pressure"]


def test_changes_are_counted_within_one_simulation():
    assert baselines_of(load_case_file(READY)) == {
        "none": "none", "axisymmetric": "none", "local": "none",
        "none-2D": "none-2D", "axisymmetric-2D": "none-2D", "local-2D": "none-2D",
    }  # fmt: skip


def test_the_cycle_is_covered_by_instants(tmp_path):
    case = load_case_file(written(content("none"), tmp_path)).variants["none"]
    found = align_tables(case)
    assert found.coverage == pytest.approx(1.0)
    assert np.all(np.diff(found.cycle_times) > 1e-3)
    assert found.cycles_later == 0


def of_table(folder, text):
    path = folder / "table.csv"
    path.write_text(text)
    case = content("none")
    case["variants"]["none"]["reference"]["section_flow_rate"] = str(path)
    return case


def edited(section, key, value):
    case = content("none")
    case[section][key] = value
    return case


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,i_1\n1.693,4.9\n", "no column t_s; it has: t, i_1"),
        ("t_s,simulation,i_1\n1.693,1D,4.9\n", "no rows of simulation 3D"),
        ("t_s,i_121\n1.693,4.9\n", "cell i = 121; allowed: 1 to 120"),
        ("t_s,i_one\n1.693,4.9\n", "column i_one; allowed: i_ and a cell's number"),
        ("t_s,i_1\n1.7,4.9\n", r"t = 1\.7 s is none of reference\.instants \(1\.693 s, 1\.884 s, 2\.392 s\)"),
        ("", "cannot be read as CSV"),
    ],
)
def test_a_table_that_does_not_fit_is_refused(tmp_path, text, said):
    with pytest.raises(UnusableReferenceError, match=said):
        read(tmp_path, of_table(tmp_path, text), "none")


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (
            edited("solver", "n_x", 60) | {"compare": {}},
            r"reference\.n_x: .* cells of 120, .* solver\.n_x 60",
        ),
        (edited("reference", "time_offset", "0 s"), "is reference.time_offset right"),
    ],
)
def test_a_case_that_does_not_fit_is_refused(tmp_path, case, said):
    with pytest.raises(UnusableReferenceError, match=said):
        read(tmp_path, case, "none")


def test_our_2d_model_is_the_thesiss(tmp_path, monkeypatch):
    monkeypatch.setattr("validation.compare.case.write_reports", lambda directory: None)
    case = content("none-2D", "none")
    case["solver"] |= {"n_phi": 4, "time_step": "4 ms"}
    case["reference"]["n_phi"] = 4
    case["compare"]["cells"] = {"i": [1, 39, 61, 82, 120], "j": [1]}
    case["compare"]["bands"] = [
        {"quantity": "section_flow_rate", "statistic": "rms_error", "limit": "0.2 %", "reason": "stated"},
        {"quantity": "pressure", "statistic": "rms_error", "limit": "9 %", "reason": "not in the tables"},
    ]
    assert compare.main([str(written(case, tmp_path)), "--output", str(tmp_path / "result"), "--check"]) == 1
    rows = pd.DataFrame(json.loads((tmp_path / "result/metrics.json").read_text()))
    judged = rows[rows["status"] != ""].set_index(["variant", "quantity"])["status"].to_dict()
    assert judged == {
        ("none-2D", "section_flow_rate"): "OK",
        ("none-2D", "pressure"): "MISSING",
        ("none", "section_flow_rate"): "FAIL",
        ("none", "pressure"): "MISSING",
    }
    values = rows[(rows["quantity"] == "section_flow_rate") & (rows["statistic"] == "value")]
    assert values["reference"].notna().sum() == 30
    assert not rows[rows["quantity"] == "radius"]["reference"].notna().any()
