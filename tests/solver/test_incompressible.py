"""Inflation of an incompressible thick wall at finite strain."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_resume import changed

from cases.reading.case_file import load_case_file
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.thick import lame_stiffness
from solver.case.model import model_of
from solver.wall.finite_strain import inflation_curve
from solver.wall.incompressible import LARGEST_STRETCH, incompressible_curve
from solver.wall.table import hermite

MODULUS, RADIUS, THICKNESS = 0.6e6, 2.5e-3, 0.5e-3
STRESSES = LAWS["neo_hookean"].stresses


def curve(thickness=THICKNESS, lowest=-0.04 * MODULUS, highest=0.045 * MODULUS):
    return incompressible_curve(STRESSES, MODULUS, RADIUS, thickness, lowest, highest)


@given(st.floats(0.02, 1.0))
def test_it_is_the_closed_form(slenderness):
    found = curve(slenderness * RADIUS)
    inner, outer, c = RADIUS**2, ((1 + slenderness) * RADIUS) ** 2, found.radii**2 - RADIUS**2
    stretched = 0.5 * np.log((1 + c / inner) / (1 + c / outer))
    pressure = MODULUS / 3 * (stretched + 0.5 * c * (1 / (inner + c) - 1 / (outer + c)))
    np.testing.assert_allclose(found.loads, pressure, rtol=1e-9, atol=1e-9 * MODULUS)
    rises = MODULUS / 3 * (outer - inner) * (1 - 0.5 * c * (1 / (inner + c) + 1 / (outer + c)))
    rises *= 2 * found.radii / (inner + c) / (outer + c)
    np.testing.assert_allclose(found.slopes, 1 / rises, rtol=1e-8)


@given(st.floats(0.02, 0.6))
def test_the_slope_at_rest_is_lames(slenderness):
    found = curve(slenderness * RADIUS)
    at_rest = int(np.flatnonzero(found.radii == RADIUS)[0])
    assert found.loads[at_rest] == pytest.approx(0.0, abs=1e-9)
    beta = float(lame_stiffness(MODULUS, 0.5, RADIUS, slenderness * RADIUS))
    assert found.slopes[at_rest] == pytest.approx(RADIUS**2 / beta, rel=1e-9)


def test_compressible_walls_approach_it():
    limit, loads = curve(), np.linspace(-15e3, 20e3, 8)
    off = []
    for ratio in (0.49, 0.499, 0.4999):
        near = inflation_curve(STRESSES, MODULUS, ratio, RADIUS, THICKNESS, -20e3, 25e3)
        radii = [hermite(each)(loads)[0] for each in (near, limit)]
        off.append(np.abs(radii[0] / radii[1] - 1).max())
    assert off[0] < 1e-2
    np.testing.assert_allclose(np.divide(off[:-1], off[1:]), 10.0, rtol=0.15)


def test_it_ends_where_rubber_gives_way():
    found = curve(highest=0.12 * MODULUS)  # no pressure above μ ln(Ro/Ri) is borne
    assert found.radii[-1] == pytest.approx(LARGEST_STRETCH * RADIUS)
    assert found.loads[-1] < MODULUS / 3 * np.log(1 + THICKNESS / RADIUS)
    assert np.all(np.diff(found.loads) > 0)


def test_a_case_may_state_it(case_file):
    changed(case_file, "{law: thin, ", "{law: neo_hookean, ")
    case = load_case_file(case_file).variants["patch"]
    assert case.wall.poisson_ratio == 0.5
    table = model_of(case).wall_table
    healthy, stiff = table.values[0, 0], table.values[..., 0].min(axis=(0, 1))
    loads = table.start + table.step * np.arange(len(healthy))
    known = (loads > -15e3) & (loads < 25e3)
    expected = hermite(curve(lowest=-20e3, highest=30e3))(loads[known])[0]
    assert known.sum() > 50
    assert healthy[known, 0] == pytest.approx(expected, rel=1e-6)
    assert np.all(stiff[loads > 1e3] < healthy[loads > 1e3, 0])
