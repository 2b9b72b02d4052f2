"""Grid convergence: known sequences, a real case on small grids, wrong input."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_case import small_case, written

from validation.converge import command as converge
from validation.converge.convergence import SAFETY, convergence

LIMITS = st.floats(0.1, 1e5)


@given(LIMITS, st.floats(0.6, 2.0), st.floats(1e-4, 0.3), st.booleans())
def test_a_power_law_is_recognised(limit, order, error, above):
    sign = 1.0 if above else -1.0
    values = [limit * (1 + sign * error * 0.5 ** (order * level)) for level in range(3)]
    found = convergence(*values)
    assert found.monotone
    assert found.order == pytest.approx(order, rel=1e-5)
    assert found.extrapolate == pytest.approx(limit, rel=1e-6)
    assert found.index == pytest.approx(SAFETY * abs(values[1] - limit) / values[2], rel=1e-4)


def test_an_order_above_the_schemes_is_not_relied_on():
    found = convergence(1 + 64e-4, 1 + 8e-4, 1 + 1e-4)
    assert found.order == pytest.approx(3.0)
    assert found.extrapolate == pytest.approx(1 + 1e-4 - 7e-4 / 3)


@pytest.mark.parametrize("values", [(1.0, 1.1, 1.0), (1.0, 1.1, 1.3)])
def test_what_does_not_converge_is_said(values):
    found = convergence(*values)
    assert (found.order, found.extrapolate, found.monotone) == (None, None, False)
    assert found.index >= SAFETY * abs(values[2] - values[1]) / values[2]


def test_what_does_not_change_is_converged():
    assert convergence(2.0, 2.0, 2.0) == convergence(2.0, 2.0 * (1 + 1e-15), 2.0)
    assert convergence(2.0, 2.0, 2.0).index == 0.0


def test_a_case_is_refined(tmp_path, capsys):
    path = written(small_case("none", n_x=16, n_phi=8), tmp_path)
    assert converge.main([str(path), "--output", str(tmp_path / "out")]) == 0
    rows = json.loads((tmp_path / "out/convergence.json").read_text())
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "convergence.json", "convergence.csv", "convergence.svg"
    }  # fmt: skip
    assert {row["study"] for row in rows} == {"grid", "time step"}
    by_name = {(row["study"], row["quantity"], row["where"]): row for row in rows}
    # the first and the last cell are a spacing nearer to each other than the artery's ends
    along = by_name["grid", "largest_pressure_difference", "cycle"]
    assert along["order"] == pytest.approx(1.0, abs=0.1)
    flow = by_name["time step", "section_flow_rate", "systole, i = 6"]
    assert flow["convergence_index"] < 0.02
    assert len(rows) == 2 * (7 + 3 * 3 * 3)
    assert "largest lumen radius" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "n_x", "said"),
    [(["--variant", "other"], 16, "no variant 'other'; it has: none"), ([], 15, "must be even")],
)
def test_wrong_input(tmp_path, capsys, options, n_x, said):
    path = written(small_case("none", n_x=n_x, n_phi=8), tmp_path)
    assert converge.main([str(path), "--output", str(tmp_path / "out"), *options]) == 2
    assert said in capsys.readouterr().err
    assert list((tmp_path / "out").iterdir()) == []
