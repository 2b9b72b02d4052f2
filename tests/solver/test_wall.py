"""Wall laws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.law import Layer
from solver.wall.stiffness import area_from_pressure, pressure_from_area

RADIUS, THICKNESS, MODULUS = 2.5e-3, 0.5e-3, 0.6e6


def wall_stiffness(law, modulus, radius, thickness, ratio):
    wall = LAWS[law].model_construct(youngs_modulus=modulus, poisson_ratio=ratio)
    return wall.stiffness([modulus], radius, thickness)


def test_the_thesis_artery():
    assert wall_stiffness("thin", MODULUS, RADIUS, THICKNESS, 0.5) == pytest.approx(400, rel=1e-12)
    assert wall_stiffness("thick", MODULUS, RADIUS, THICKNESS, 0.48) == pytest.approx(301, abs=0.5)


def test_displacement_per_pressure_is_lames():
    """Lamé's displacement gives 2.074e-8 m/Pa, the thin wall 1.5625e-8 m/Pa."""
    for law, ratio, flexibility in (("thin", 0.5, 1.5625e-8), ("thick", 0.48, 2.074e-8)):
        beta = wall_stiffness(law, MODULUS, RADIUS, THICKNESS, ratio)
        assert RADIUS**2 / beta == pytest.approx(flexibility, rel=5e-4)


@given(st.floats(1e-3, 0.4), st.floats(0.0, 0.499), st.floats(1e4, 1e8))
def test_thick_wall_solves_lames_problem(slenderness, ratio, modulus):
    """σ_r = −P at R₀, 0 at b, plane strain: u = C₁ r + C₂/r, by solving for C₁ and C₂."""
    inner, outer = RADIUS, RADIUS * (1 + slenderness)
    shear = modulus / (2 * (1 + ratio))
    matrix = [[2 * shear / (1 - 2 * ratio), -2 * shear / r**2] for r in (inner, outer)]
    first, second = np.linalg.solve(matrix, [-1.0, 0.0])
    displacement = first * inner + second / inner
    beta = wall_stiffness("thick", modulus, RADIUS, RADIUS * slenderness, ratio)
    assert RADIUS**2 / beta == pytest.approx(displacement, rel=1e-6)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.48, 0.5])
def test_a_thin_thick_wall_is_the_thin_wall(ratio):
    thickness = 1e-5 * RADIUS
    thick = wall_stiffness("thick", MODULUS, RADIUS, thickness, ratio)
    thin = wall_stiffness("thin", MODULUS, RADIUS, thickness, ratio)
    assert thick == pytest.approx(thin, rel=2e-5)


@pytest.mark.parametrize("law", ["thin", "thick", "layered"])
def test_the_incompressible_wall_is_the_limit(law):
    layer = Layer.model_construct(name="all", thickness=THICKNESS, youngs_modulus=MODULUS)

    def stiffness(ratio):
        if law != "layered":
            return wall_stiffness(law, MODULUS, RADIUS, THICKNESS, ratio)
        wall = LAWS[law].model_construct(layers=(layer,), poisson_ratio=ratio)
        return wall.stiffness([np.array(MODULUS)], RADIUS, THICKNESS)

    assert stiffness(0.5) == pytest.approx(stiffness(0.5 - 1e-9), rel=1e-7)
    # one thick layer: u = P (1 + ν)/E R b²/(b² − R²)
    outer = RADIUS + THICKNESS
    lame = MODULUS / 1.5 * (outer**2 - RADIUS**2) * RADIUS / outer**2
    if law != "thin":
        assert stiffness(0.5) == pytest.approx(lame, rel=1e-9)


@pytest.mark.parametrize("law", ["thin", "thick"])
def test_stiffness_is_proportional_to_the_modulus(law):
    one = wall_stiffness(law, 1.0, RADIUS, THICKNESS, 0.48)
    moduli = np.array([[0.6e6, 10e6]])
    result = wall_stiffness(law, moduli, RADIUS, THICKNESS, 0.48)
    assert result.shape == moduli.shape
    np.testing.assert_allclose(result, one * moduli, rtol=1e-14)


@given(st.floats(-1e4, 3e4), st.floats(300, 1e4), st.floats(-5e3, 5e3))
def test_pressure_and_area_are_inverse(pressure, stiffness, reference):
    beta = np.array([stiffness])
    area = area_from_pressure(pressure, beta, RADIUS, reference)
    back = pressure_from_area(area, beta, RADIUS, reference)
    assert back[0] == pytest.approx(pressure, rel=1e-9, abs=1e-6)


def test_pressure_law():
    """10 kPa widen the thin wall to 2.65625 mm, 1 kPa to 2.515625 mm (2.2.1)."""
    for load, radius in ((10e3, 2.65625e-3), (1e3, 2.515625e-3)):
        assert np.sqrt(area_from_pressure(load, np.array([400.0]), RADIUS, 0.0))[0] == pytest.approx(radius)
        assert pressure_from_area(np.array([radius**2]), np.array([400.0]), RADIUS, 0.0)[0] == pytest.approx(
            load
        )
