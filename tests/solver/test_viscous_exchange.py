"""α and S of the kernels against the formulas for h, α and friction, with spectral derivatives in φ."""

import numpy as np
import pytest
from closed_forms import continuity_exponent, momentum_correction

from solver.schemes.layout import FLOW_INLET, NO_ADMISSIBLE_PROFILE, OK, PRESSURE_INLET, VELOCITY_INLET
from solver.schemes.rows.ends import face_areas
from solver.schemes.rows.profile import closure_sources, fixed_sources

KINEMATIC_VISCOSITY = 0.003 / 1060
MEAN_AREA = 7e-6


def spectral(values):
    """First and second derivative of a smooth periodic row on [0, 2π)."""
    wave_number = 1j * np.fft.fftfreq(values.size, 1 / values.size)
    transformed = np.fft.fft(values)
    return tuple(np.fft.ifft(wave_number**k * transformed).real for k in (1, 2))


def exact_source(area, gamma):
    """S = h − 2(γ+2)(μ/ρ)/A, with h as in (2.2.35), corrected form, in A and γ."""
    area_1, area_2 = spectral(area)
    gamma_1, gamma_2 = spectral(gamma)
    bracket = (
        -(gamma + 2) / 4 * (area_1 / area) ** 2
        + 0.5 * area_2 / area
        - 2 / gamma**3 * gamma_1**2
        + gamma_2 / gamma**2
    )
    exchange = 2 * KINEMATIC_VISCOSITY * (gamma + 2) / (gamma * area) * bracket
    return exchange - 2 * (gamma + 2) * KINEMATIC_VISCOSITY / area


def closure(area, velocity):
    """Status, row and the two results of the kernel for one face."""
    *scratch, alpha, source = (np.empty((1, area.size)) for _ in range(5))
    dphi = 2 * np.pi / area.size
    flow = (velocity * area)[None, :]
    status, _, row = closure_sources(
        flow, area[None], KINEMATIC_VISCOSITY, dphi, False, *scratch, np.empty(1), alpha, source
    )
    return status, row, alpha[0], source[0]


def kernel(area, velocity):
    status, _, alpha, source = closure(area, velocity)
    assert status == OK
    return alpha, source


def smooth_rows(rows, area_variation, velocity_variation):
    phi = (np.arange(rows) + 0.5) * 2 * np.pi / rows
    area = MEAN_AREA * (1 + area_variation * np.cos(phi - 0.3) + 0.3 * area_variation * np.sin(2 * phi))
    return area, 0.1 * (1 + velocity_variation * np.sin(phi) + 0.3 * velocity_variation * np.cos(3 * phi))


@pytest.mark.parametrize(("area", "velocity"), [(0.0, 0.3), (0.3, 0.0), (0.1, 0.1), (0.3, 0.3)])
def test_source_converges_to_the_model(area, velocity):
    errors = []
    for rows in (64, 128, 256):
        areas, velocities = smooth_rows(rows, area, velocity)
        gamma = continuity_exponent(velocities, 0.0)
        alpha, source = kernel(areas, velocities)
        np.testing.assert_allclose(alpha, momentum_correction(gamma), rtol=1e-13)
        exact = exact_source(areas, gamma)
        errors.append(np.max(np.abs(source - exact)) / np.max(np.abs(exact)))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all((orders > 1.9) & (orders < 2.1)), (errors, orders)
    assert errors[-1] < 2e-3


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_equal_rows_feel_poiseuille_friction_only(sign):
    area = np.full(5, MEAN_AREA)
    alpha, source = kernel(area, np.full(5, sign * 0.1))
    np.testing.assert_allclose(alpha, 4 / 3)
    np.testing.assert_allclose(source, -8 * KINEMATIC_VISCOSITY / area)


def test_exchange_does_not_see_the_direction_of_flow():
    area, velocity = smooth_rows(24, 0.2, 0.2)
    for forward, backward in zip(kernel(area, velocity), kernel(area, -velocity), strict=True):
        np.testing.assert_allclose(backward, forward, rtol=1e-13)


def test_a_section_at_rest_feels_poiseuille_friction():
    """The limit of slow equal rows."""
    area = MEAN_AREA * np.array([1.0, 1.1, 0.9, 1.0])
    alpha, source = kernel(area, np.zeros(4))
    np.testing.assert_allclose(alpha, 4 / 3)
    np.testing.assert_allclose(source, -8 * KINEMATIC_VISCOSITY / area)


@pytest.mark.parametrize("rows", [1, 4])
@pytest.mark.parametrize("kind", [FLOW_INLET, PRESSURE_INLET])
def test_a_fixed_exponent_gives_its_own_friction(rows, kind):
    """At the areas that faces have; those of the ends follow from the inlet's kind."""
    cells = MEAN_AREA * (1 + 0.1 * np.sin(np.arange(5 * rows))).reshape(5, rows)
    ends = MEAN_AREA * (1 + 0.1 * np.cos(np.arange(2 * rows))).reshape(2, rows)
    area, alpha, source = (np.empty((6, rows)) for _ in range(3))
    face_areas(cells, ends, kind, area)
    fixed_sources(cells, ends, kind, 9.0, KINEMATIC_VISCOSITY, alpha, source)
    np.testing.assert_allclose(alpha, 11 / 10)
    np.testing.assert_allclose(source, -22 * KINEMATIC_VISCOSITY / area)


@pytest.mark.parametrize("row", [0, 3])
@pytest.mark.parametrize("share", [-0.1, 3.9])
def test_a_row_without_an_admissible_profile_is_told(row, share):
    """A row against the flow, and one faster than D, twice the mean."""
    velocity = np.full(4, 0.1)
    velocity[row] = share * 0.1
    status, found, _, _ = closure(np.full(4, MEAN_AREA), velocity)
    assert (status, found) == (NO_ADMISSIBLE_PROFILE, row)


def test_a_row_that_rounding_makes_as_fast_as_the_axis_is_told():
    """The kernel takes u times 1/D, which may be 1 where u/D is just below."""
    velocity = np.array([np.nextafter(1.842, 0.0), 0.384, 0.461, 0.997])
    status, found, _, _ = closure(np.ones(4), velocity)
    assert (status, found) == (NO_ADMISSIBLE_PROFILE, 0)


def test_a_face_at_rest_beside_moving_ones():
    moving, still = np.array([0.09, 0.1, 0.11, 0.1]), np.zeros(4)
    flow = MEAN_AREA * np.array([moving, still, moving])
    *scratch, alpha, source = (np.empty((3, 4)) for _ in range(5))
    area = np.full((3, 4), MEAN_AREA)
    status, _, _ = closure_sources(
        flow, area, KINEMATIC_VISCOSITY, np.pi / 2, False, *scratch, np.empty(3), alpha, source
    )
    assert status == OK
    for face, velocity in enumerate((moving, still, moving)):
        for found, alone in zip((alpha[face], source[face]), kernel(area[0], velocity), strict=True):
            np.testing.assert_allclose(found, alone, rtol=1e-14)


@pytest.mark.parametrize(
    ("kind", "inlet"), [(VELOCITY_INLET, 10.0), (FLOW_INLET, 10.0), (PRESSURE_INLET, 9.0)]
)
def test_areas_of_faces_are_exact_where_the_area_is_linear(kind, inlet):
    """Half a cell beyond the first; at a pressure inlet, that of the end's own pressure."""
    x = np.arange(6) + 0.5
    slopes = np.array([0.0, 0.1, -0.2, 0.3])
    mean, ends = 10 + np.outer(x, slopes), np.array([np.full(4, 9.0), 10 + 6 * slopes])
    area = np.empty((7, 4))
    face_areas(mean, ends, kind, area)
    for face in range(7):
        expected = 10 + face * slopes if face else np.full(4, inlet)
        np.testing.assert_allclose(area[face], expected, rtol=1e-14)
