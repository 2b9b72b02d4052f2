"""Order of the Godunov scheme on an exact simple wave of ∂_t q + H ∂_x q = 0 (2.2.46)."""

import numpy as np
import pytest

from validation.tables.simple_wave import area_error, exact_area, initial_area

pytestmark = pytest.mark.slow  # compiles a scheme that no other quick test needs


@pytest.mark.parametrize(
    ("limiter", "least", "largest"),
    [
        ("upwind", 0.85, 1.05),
        ("lax_wendroff", 1.95, 2.05),
        ("van_leer", 1.9, 2.2),
        ("monotonized_central", 1.9, 2.3),
    ],
)
def test_order_on_equation_2_2_46(limiter, least, largest):
    order = np.log2(area_error(240, limiter) / area_error(480, limiter))
    assert least < order < largest


def test_exact_wave_starts_as_given_and_moves_right():
    x = np.linspace(1e-3, 14e-3, 200)
    np.testing.assert_allclose(exact_area(x, 0.0), initial_area(x), rtol=1e-13)
    crest = [x[np.argmax(exact_area(x, time))] for time in (0.0, 3e-4, 6e-4)]
    assert crest[0] < crest[1] < crest[2]
