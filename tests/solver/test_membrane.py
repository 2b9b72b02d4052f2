"""The membrane wall: exact limits, a closed form, manufactured solutions, supports."""

import numpy as np
import pytest
import scipy.sparse.linalg
from hypothesis import given
from hypothesis import strategies as st

from solver.errors import ModelError
from solver.geometry.spatial_angle import radius_at_angles
from solver.wall.membrane import FREE, QUARTERS, Membrane, displacement, operator

RADIUS, LENGTH, PRESSURE = 2.5e-3, 15e-3, 16e3
HEALTHY, CALCIFIED = 301.0, 5017.0
SHEAR = 0.6e6 / (2 * 1.48) * 0.5e-3


def grid(n_x, m):
    """Δx, and the places of cells along, and of cells and faces around."""
    width = 2 * np.pi / m
    return (
        LENGTH / n_x,
        (np.arange(n_x) + 0.5) * LENGTH / n_x,
        (np.arange(m) + 0.5) * width,
        np.arange(m) * width,
    )


def membrane(shear, supports=QUARTERS):
    return Membrane(LENGTH / shear.shape[0], RADIUS, shear, supports)


@given(st.floats(50.0, 1e5), st.floats(100.0, 3e4), st.sampled_from([QUARTERS, FREE]))
def test_a_uniform_wall_follows_the_row_law(stiffness, pressure, supports):
    wall = membrane(np.full((6, 8), SHEAR), supports)
    radial, tangential = displacement(wall, np.full((6, 8), stiffness), np.full(6, pressure))
    expected = pressure * RADIUS**2 / stiffness
    assert np.allclose(radial, expected, rtol=1e-8, atol=0)
    assert np.max(np.abs(tangential)) < 1e-8 * expected


def test_the_matrix_is_symmetric_and_positive_where_supported():
    rng = np.random.default_rng(1)
    wall = membrane(SHEAR * rng.uniform(0.5, 20.0, (5, 8)))
    matrix = operator(wall, HEALTHY * rng.uniform(0.5, 20.0, (5, 8)), np.full(5, PRESSURE)).toarray()
    assert np.max(np.abs(matrix - matrix.T)) == 0.0
    kept = np.concatenate([np.ones(40, dtype=bool), ~wall.held.ravel()])
    assert np.linalg.eigvalsh(matrix[kept][:, kept]).min() > 0


@pytest.mark.parametrize("motion", ["along y", "along z", "turn"])
def test_rigid_motions_cost_no_energy(motion):
    _, _, centre, face = grid(4, 12)
    modes = {
        "along y": (np.cos(centre), -np.sin(face)),
        "along z": (np.sin(centre), np.cos(face)),
        "turn": (np.zeros(12), np.ones(12)),
    }
    across, around = modes[motion]
    rng = np.random.default_rng(2)
    matrix = operator(
        membrane(np.full((4, 12), SHEAR)), HEALTHY * rng.uniform(1, 9, (4, 12)), rng.uniform(1e3, 2e4, 4)
    )
    moved = np.concatenate([np.tile(across, 4), np.tile(around, 4)])
    assert np.max(np.abs(matrix @ moved)) < 1e-9 * scipy.sparse.linalg.norm(matrix)


def string_with_a_step(x, place, pressure, left, right):
    """(β/R₀)u − R₀ (S u')' = p R₀ with β and S that jump, u' = 0 at both ends.

    On each side u = p R₀²/β + C cosh((x − end)/λ), λ = R₀ √(S/β); u and S u' match at the step.
    """
    (beta_l, shear_l), (beta_r, shear_r) = left, right
    rest = [pressure * RADIUS**2 / beta for beta in (beta_l, beta_r)]
    scale = [RADIUS * np.sqrt(shear / beta) for beta, shear in (left, right)]
    a, b = place / scale[0], (place - LENGTH) / scale[1]
    matching = [
        [np.cosh(a), -np.cosh(b)],
        [shear_l / scale[0] * np.sinh(a), -shear_r / scale[1] * np.sinh(b)],
    ]
    c = np.linalg.solve(matching, [rest[1] - rest[0], 0.0])
    return np.where(
        x < place,
        rest[0] + c[0] * np.cosh(x / scale[0]),
        rest[1] + c[1] * np.cosh((x - LENGTH) / scale[1]),
    )


def test_a_ring_is_a_generalised_string():
    """An axisymmetric step in β and S, which lies between cells: second order."""
    errors = []
    for n_x in (30, 60, 120, 240):
        _, x, _, _ = grid(n_x, 4)
        stiff = (x > LENGTH / 3)[:, None] & np.ones(4, dtype=bool)
        shear = np.where(stiff, CALCIFIED / HEALTHY * SHEAR, SHEAR)
        radial, tangential = displacement(
            membrane(shear), np.where(stiff, CALCIFIED, HEALTHY), np.full(n_x, PRESSURE)
        )
        left, right = (HEALTHY, SHEAR), (CALCIFIED, CALCIFIED / HEALTHY * SHEAR)
        exact = string_with_a_step(x, LENGTH / 3, PRESSURE, left, right)
        assert np.max(np.abs(tangential)) < 1e-12 * np.max(radial)
        errors.append(np.max(np.abs(radial - exact[:, None])) / np.max(exact))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert errors[-1] < 3e-4
    assert np.all((orders > 1.8) & (orders < 2.2)), orders


def manufactured(n_x, m, along_x=1, around=1):
    """Error of u_r = a X (1 + c cos 2φ), u_φ = b X sin 2φ, X = cos(πx/L) for smooth β, S and p."""
    _, x, centre, face = grid(n_x, m)
    a, b, c, k = 2e-4, 0.6e-4 * around, 0.5 * around, along_x * np.pi / LENGTH
    load = PRESSURE * (1 + 0.05 * np.sin(x / LENGTH))[:, None]
    along, slope, bend = np.cos(k * x)[:, None], -k * np.sin(k * x)[:, None], -(k**2) * np.cos(k * x)[:, None]
    taper = 1 + 0.1 * along
    drawn = 0.1 * slope**2 + taper * bend  # ((1 + 0.1 X) X')'

    def beta(phi):
        return HEALTHY * (1 + 0.3 * around * np.cos(phi))

    def shear(phi):
        return SHEAR * (1 + 0.2 * around * np.cos(phi))

    radial, tangential = a * along * (1 + c * np.cos(2 * centre)), b * along * np.sin(2 * face)
    second = a * c + 2 * b
    strain = along * (a + second * np.cos(2 * centre)) / RADIUS
    bent = -4 * a * c * along * np.cos(2 * centre)
    force_r = (beta(centre) + load * RADIUS) * strain
    force_r = (
        force_r - RADIUS * shear(centre) * a * (1 + c * np.cos(2 * centre)) * drawn - load * (radial + bent)
    )
    strain_face = along * (a + second * np.cos(2 * face)) / RADIUS
    rise = -HEALTHY * 0.3 * around * np.sin(face) * strain_face
    rise = rise - (beta(face) + load * RADIUS) * along * 2 * second * np.sin(2 * face) / RADIUS
    force_phi = -rise - RADIUS * shear(face) * b * np.sin(2 * face) * drawn
    extra = force_r - load * RADIUS, force_phi
    found = displacement(membrane(shear(centre) * taper), beta(centre) + 0 * x[:, None], load[:, 0], extra)
    return max(np.max(np.abs(u - v)) for u, v in zip(found, (radial, tangential), strict=True)) / a


@pytest.mark.parametrize(
    ("sizes", "along_x", "around"),
    [
        ([(n, 4) for n in (12, 24, 48, 96)], 1, 0),
        ([(3, m) for m in (16, 32, 64, 128)], 0, 1),
        ([(n, n) for n in (16, 32, 64)], 1, 1),
    ],
    ids=["along", "around", "both"],
)
def test_second_order_on_a_manufactured_solution(sizes, along_x, around):
    errors = np.array([manufactured(*size, along_x, around) for size in sizes])
    orders = np.log2(errors[:-1] / errors[1:])
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


def test_free_supports_leave_no_rigid_motion():
    _, x, centre, face = grid(20, 16)
    stiff = ((x > 5e-3) & (x < 10e-3))[:, None] & (np.abs(centre - 2.0) < 0.8)
    wall = membrane(np.full((20, 16), SHEAR), FREE)
    radial, tangential = displacement(wall, np.where(stiff, CALCIFIED, HEALTHY), np.full(20, PRESSURE))
    for across, around in (
        (np.cos(centre), -np.sin(face)),
        (np.sin(centre), np.cos(face)),
        (0 * centre, 0 * face + 1),
    ):
        assert abs(np.mean(radial @ across + tangential @ around)) < 1e-12 * np.max(radial)


def test_a_patch_may_sit_anywhere_on_a_free_wall():
    """Turning the patch by a whole number of cells turns the answer."""
    _, x, centre, _ = grid(12, 16)
    stiff = ((x > 5e-3) & (x < 10e-3))[:, None] & (np.abs(centre - np.pi) < 0.8)
    answers = []
    for turn in (0, 5):
        stiffness = np.roll(np.where(stiff, CALCIFIED, HEALTHY), turn, axis=1)
        moved = displacement(membrane(np.full((12, 16), SHEAR), FREE), stiffness, np.full(12, PRESSURE))
        answers.append(np.roll(radius_at_angles(RADIUS, *moved), -turn, axis=1))
    assert np.allclose(*answers, rtol=1e-9, atol=0)


def test_spatial_angles_of_a_shifted_circle():
    """A circle that moved by d along y: R(φ) = d cos φ + √(R₀² − d² sin² φ)."""
    _, _, centre, face = grid(3, 96)
    shift = 0.1 * RADIUS
    radial = shift * np.cos(centre) + np.zeros((3, 1))
    tangential = -shift * np.sin(face) + np.zeros((3, 1))
    exact = shift * np.cos(centre) + np.sqrt(RADIUS**2 - (shift * np.sin(centre)) ** 2)
    assert np.max(np.abs(radius_at_angles(RADIUS, radial, tangential) / exact - 1)) < 1e-4


@pytest.mark.parametrize(
    ("shear", "supports", "message"),
    [
        (np.ones((4, 6)), QUARTERS, "multiple of 4"),
        (np.zeros((4, 8)), QUARTERS, "shear stiffness"),
        (np.ones((4, 8)), "none", "supports"),
    ],
)
def test_what_a_membrane_needs(shear, supports, message):
    with pytest.raises(ModelError, match=message):
        Membrane(1e-3, RADIUS, shear, supports)
