"""Second order of the scheme with one pressure a section, by self-convergence on a smooth problem.

As :mod:`test_order_of_convergence`, with rows that exchange blood. Measured after 80 ms for Q: between 1.94
and 2.06 for Δt and Δφ, and falling towards 2 for Δx. P depends on sums over φ: it converges faster at first.
"""

import numpy as np
import pytest
import test_order_of_convergence as by_rows
from test_order_of_convergence import Resolution, observed_orders
from test_section_pressure import with_sections

import solver.marching.section_stepper


@pytest.fixture(autouse=True)
def _one_pressure_a_section(monkeypatch):
    monkeypatch.setattr(solver.marching.section_stepper, "TOLERANCE", 1e-10)
    monkeypatch.setattr(
        by_rows, "artery", lambda *sizes, **values: with_sections(artery_of_rows(*sizes, **values))
    )
    monkeypatch.setattr(by_rows, "pressure", lambda model, area: model.pressure(area))


artery_of_rows = by_rows.artery
OUTLET = by_rows.SECTION_OUTLET


def test_in_time():
    steps = [Resolution(12, 8, dt) for dt in (4e-3, 2e-3, 1e-3, 0.5e-3)]
    orders = observed_orders(steps, 3, 0.5, OUTLET)
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


def test_around_the_artery():
    grids = [Resolution(12, n_phi, 2e-3) for n_phi in (6, 12, 24, 48)]
    orders = observed_orders(grids, 3, 0.5, OUTLET)
    assert np.all((orders[:, :2] > 1.9) & (orders[:, :2] < 2.15)), orders
    assert np.all(orders[:, 2:] > 1.8), orders


def test_along_the_artery():
    grids = [Resolution(n_x, 4, 2e-3) for n_x in (20, 40, 80, 160)]
    orders = observed_orders(grids, 3, 0.5, OUTLET)
    assert np.all((orders > 1.95) & (orders < 3.2)), orders


def test_all_together():
    refined = [Resolution(20 * 2**k, 6 * 2**k, 4e-3 / 2**k) for k in range(4)]
    orders = observed_orders(refined, 3, 0.5, OUTLET)
    assert np.all((orders[-1, :2] > 1.95) & (orders[-1, :2] < 2.1)), orders
    assert np.all(orders[-1, 2:] > 1.95), orders
