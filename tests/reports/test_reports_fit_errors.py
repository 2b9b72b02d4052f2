import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.fit_errors import fit_errors

Y = np.linspace(0, 1, 25)


def profile(mean: float, exponent: float) -> np.ndarray:
    """u (γ + 2)/γ (1 − y^γ)."""
    return mean * (exponent + 2) / exponent * (1 - Y**exponent)


@given(st.floats(1e-3, 10.0), st.floats(1.0, 12.0))
def test_a_profile_of_the_family_has_no_error_at_its_own_exponent(mean: float, exponent: float) -> None:
    errors = fit_errors(profile(mean, exponent), Y, np.array([exponent, exponent + 1.0]))
    assert errors[0] < 1e-6
    assert errors[1] > 1e-4


def test_the_error_is_that_of_least_squares() -> None:
    rng = np.random.default_rng(1)
    velocity = profile(0.3, 2.0) + 0.02 * rng.standard_normal((4, Y.size))
    exponents = np.array([1.3, 2.0, 5.0])
    found = fit_errors(velocity, Y, exponents)
    for ray in range(4):
        for k, exponent in enumerate(exponents):
            shape = profile(1.0, exponent)
            mean = np.linalg.lstsq(shape[:, None], velocity[ray], rcond=None)[0][0]
            rest = np.linalg.norm(velocity[ray] - mean * shape) / np.linalg.norm(velocity[ray])
            assert found[ray, k] == pytest.approx(rest, rel=1e-6)


def test_where_nothing_flows_there_is_no_error() -> None:
    assert np.isnan(fit_errors(np.zeros(Y.size), Y, np.array([2.0]))).all()
