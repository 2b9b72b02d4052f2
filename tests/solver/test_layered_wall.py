"""Layered walls: bonded Lamé cylinders."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cases.sections.wall_laws.law import Layer as StatedLayer
from cases.sections.wall_laws.layered import LayeredWall
from cases.sections.wall_laws.thick import lame_stiffness

RADIUS, RATIO = 2.5e-3, 0.48


class Layer(NamedTuple):
    thickness: float
    youngs_modulus: object


def layered_wall_stiffness(layers, radius, ratio):
    parts = tuple(StatedLayer.model_construct(thickness=layer.thickness) for layer in layers)
    wall = LayeredWall.model_construct(layers=parts, poisson_ratio=ratio)
    moduli = [layer.youngs_modulus for layer in layers]
    return wall.stiffness(moduli, radius, sum(layer.thickness for layer in layers))


INTIMA, MEDIA, ADVENTITIA = Layer(0.05e-3, 0.4e6), Layer(0.3e-3, 0.8e6), Layer(0.15e-3, 0.5e6)

thicknesses = st.lists(st.floats(1e-5, 1e-3), min_size=1, max_size=5)
moduli = st.floats(1e4, 1e8)


def force_balance(layers, ratio, pressure=1.0):
    """u at R₀ from a linear system: u = a r + b/r in each layer, traction and displacement continuous."""
    edges = RADIUS + np.concatenate([[0.0], np.cumsum([layer.thickness for layer in layers])])
    n = len(layers)
    matrix, load = np.zeros((2 * n, 2 * n)), np.zeros(2 * n)

    def traction(layer, r):
        factor = layer.youngs_modulus / (1 + ratio)
        return factor * np.array([1 / (1 - 2 * ratio), -1 / r**2])

    matrix[0, :2], load[0] = traction(layers[0], edges[0]), -pressure
    for k in range(n - 1):
        r, here, there = edges[k + 1], slice(2 * k, 2 * k + 2), slice(2 * k + 2, 2 * k + 4)
        matrix[2 * k + 1, here], matrix[2 * k + 1, there] = (r, 1 / r), (-r, -1 / r)
        matrix[2 * k + 2, here], matrix[2 * k + 2, there] = (
            traction(layers[k], r),
            -traction(layers[k + 1], r),
        )
    matrix[-1, -2:] = traction(layers[-1], edges[-1])
    scale_rows = np.max(np.abs(matrix), axis=1)
    scale = np.tile([1.0, RADIUS**2], n)  # b is of the size of a R₀²
    scaled = matrix / scale_rows[:, None] * scale
    a, b = (np.linalg.solve(scaled, load / scale_rows) * scale)[:2]
    return a * RADIUS + b / RADIUS


@given(thicknesses, moduli, st.floats(0.0, 0.499))
def test_equal_layers_are_one_thick_wall(parts, modulus, ratio):
    layers = [Layer(part, modulus) for part in parts]
    one = lame_stiffness(modulus, ratio, RADIUS, sum(parts))
    assert layered_wall_stiffness(layers, RADIUS, ratio) == pytest.approx(float(one), rel=1e-9)


@given(st.lists(st.tuples(st.floats(5e-5, 1e-3), st.floats(1e5, 1e7)), min_size=1, max_size=4))
def test_layers_balance_forces(parts):
    layers = [Layer(thickness, modulus) for thickness, modulus in parts]
    beta = float(layered_wall_stiffness(layers, RADIUS, RATIO))
    assert RADIUS**2 / beta == pytest.approx(force_balance(layers, RATIO), rel=1e-8)


def test_a_calcified_media_lies_between_healthy_and_calcified():
    def wall(media, others=1.0):
        layers = [
            Layer(layer.thickness, others * layer.youngs_modulus) for layer in (INTIMA, MEDIA, ADVENTITIA)
        ]
        layers[1] = Layer(MEDIA.thickness, media)
        return float(layered_wall_stiffness(layers, RADIUS, RATIO))

    calcified = 10e6
    everywhere = float(lame_stiffness(calcified, RATIO, RADIUS, 0.5e-3))
    alone = float(lame_stiffness(calcified, RATIO, RADIUS, 0.3e-3))
    assert wall(MEDIA.youngs_modulus) < wall(calcified) < everywhere
    # nearly that of the calcified media alone, on its own radius
    assert wall(calcified) == pytest.approx(alone, rel=0.2)
    grown = [wall(modulus) for modulus in np.geomspace(0.8e6, 1e9, 20)]
    assert np.all(np.diff(grown) > 0)


@given(st.floats(1.001, 50.0), st.integers(0, 2))
def test_stiffer_layers_make_a_stiffer_wall(factor, which):
    layers = [INTIMA, MEDIA, ADVENTITIA]
    stiffer = list(layers)
    stiffer[which] = Layer(layers[which].thickness, factor * layers[which].youngs_modulus)
    before, after = (float(layered_wall_stiffness(part, RADIUS, RATIO)) for part in (layers, stiffer))
    assert before < after < factor * before


def test_moduli_of_cells_are_broadcast():
    media = np.array([[0.8e6, 10e6], [0.8e6, 5e6]])
    beta = layered_wall_stiffness([INTIMA, Layer(0.3e-3, media), ADVENTITIA], RADIUS, RATIO)
    assert beta.shape == (2, 2)
    assert beta[0, 0] == beta[1, 0] < beta[1, 1] < beta[0, 1]
    single = layered_wall_stiffness([INTIMA, MEDIA, ADVENTITIA], RADIUS, RATIO)
    assert beta[0, 0] == pytest.approx(float(single), rel=1e-14)
