"""Both schemes give the same pulsatile flow; the converged comparison is the table "schemes"."""

import pytest

from validation.tables.scheme_agreement import _rows, difference, explicit_flow

pytestmark = pytest.mark.slow  # compiles the explicit scheme


def test_already_on_a_coarse_grid_without_calcification():
    found = explicit_flow("none", n_x=60)
    assert found["courant"] < 0.25
    assert 0 < difference("none", found) < 1e-3


def test_a_difference_of_one_percent_is_missed():
    found = explicit_flow("none", n_x=60)
    wrong = {
        key: [1.01 * q for q in value] if isinstance(value, list) else value for key, value in found.items()
    }
    (row,) = _rows({"converged pulsatile none": wrong})
    assert not row.met
    assert row.ours == pytest.approx(1 - 1 / 1.01, rel=0.1)
