"""Second order in Δx, Δφ and Δt, by self-convergence on a smooth problem.

The waveform is a smooth pulse of 0.2 s that starts from the steady state; β is a smooth bump on
(x, φ), up to 5.5 times stiffer than the healthy wall. Each mesh or step is half the one before; the order is
log₂ of the ratio of successive differences, for Q on the coarsest mesh's faces and P in its cells
after 80 ms. θ = ½ + 20/s·Δt, as in every run. Measured: between 1.94 and 2.05 for Δt and Δφ, and
falling from 2.7 towards 2 for Δx, where the coarsest of these meshes barely resolves the bump.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from thesis_artery import DIASTOLE, HEALTHY, LENGTH, SECTION_OUTLET, STEADY_OUTLET, artery, pressure

from solver.geometry.grid import Grid
from solver.marching.semi_implicit import simulate

END = 0.08


def smooth_pulse(time):
    """Infinitely smooth, unlike PCHIP; sin⁴ joins the steady state with three zero derivatives."""
    return DIASTOLE * (1 + 0.5 * np.sin(np.pi * np.asarray(time) / 0.2) ** 4)


@dataclass(frozen=True)
class Resolution:
    n_x: int
    n_phi: int
    time_step: float


def smooth_stiffness(grid, rise, asymmetry):
    bump = np.exp(-(((grid.x / LENGTH - 0.5) / 0.18) ** 2))
    return HEALTHY * (1 + rise * np.outer(bump, 1 + asymmetry * np.cos(grid.phi)))


def coarsened(fine, shape):
    """Mean over blocks: cell means, which are second-order point values."""
    (n_x, n_phi), (rows, columns) = shape, fine.shape
    return fine.reshape(n_x, rows // n_x, n_phi, columns // n_phi).mean(axis=(1, 3))


def answers(resolution, coarsest, rise, asymmetry, outlet):
    """Q on the coarsest grid's faces and P in its cells at the end."""
    grid = Grid(LENGTH, resolution.n_x, resolution.n_phi)
    stiffness = smooth_stiffness(grid, rise, asymmetry)
    model = artery(grid.n_x, grid.n_phi, outlet=outlet, inlet=smooth_pulse, stiffness=stiffness)
    run = simulate(model, [0.0, END], resolution.time_step)
    faces = run.flow[-1, :: grid.n_x // coarsest.n_x]
    flow = coarsened(faces, (coarsest.n_x + 1, coarsest.n_phi))
    return flow, coarsened(pressure(model, run.area[-1]), (coarsest.n_x, coarsest.n_phi))


def observed_orders(resolutions, rise, asymmetry, outlet):
    """Orders of Q and P in the largest and the mean-square norm, (n_resolutions − 2, 4)."""
    solutions = [answers(r, resolutions[0], rise, asymmetry, outlet) for r in resolutions]
    errors = []
    for coarse, fine in pairwise(solutions):
        differences = [np.abs(a - b) for a, b in zip(coarse, fine, strict=True)]
        errors.append([norm for d in differences for norm in (d.max(), np.sqrt(np.mean(d**2)))])
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


OUTLETS = pytest.mark.parametrize("outlet", [SECTION_OUTLET, STEADY_OUTLET], ids=["section", "row"])


@OUTLETS
@pytest.mark.parametrize(("rise", "asymmetry", "n_phi"), [(0, 0, 1), (3, 0, 1), (3, 0.5, 8)])
def test_in_time(rise, asymmetry, n_phi, outlet):
    steps = [Resolution(12, n_phi, dt) for dt in (4e-3, 2e-3, 1e-3, 0.5e-3)]
    orders = observed_orders(steps, rise, asymmetry, outlet)
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


@OUTLETS
def test_along_the_uniform_artery(outlet):
    grids = [Resolution(n_x, 1, 1e-3) for n_x in (8, 16, 32, 64)]
    orders = observed_orders(grids, 0, 0, outlet)
    assert np.all((orders > 1.95) & (orders < 2.05)), orders


@OUTLETS
@pytest.mark.parametrize(("asymmetry", "n_phi"), [(0, 1), (0.5, 4)])
def test_along_the_calcified_artery(asymmetry, n_phi, outlet):
    """From above: the area's first derivative in x dominates the error on coarse meshes."""
    grids = [Resolution(n_x, n_phi, 2e-3) for n_x in (20, 40, 80, 160, 320)]
    orders = observed_orders(grids, 3, asymmetry, outlet)
    assert np.all((orders > 1.95) & (orders < 3.0)), orders
    assert np.all(orders[-1] < 2.2), orders


@OUTLETS
def test_around_the_artery(outlet):
    grids = [Resolution(12, n_phi, 2e-3) for n_phi in (6, 12, 24, 48)]
    orders = observed_orders(grids, 3, 0.5, outlet)
    assert np.all((orders > 1.9) & (orders < 2.15)), orders


@OUTLETS
def test_all_together(outlet):
    refined = [Resolution(10 * 2**k, 6 * 2**k, 4e-3 / 2**k) for k in range(5)]
    orders = observed_orders(refined, 3, 0.5, outlet)
    assert np.all(orders[-1] > 1.95), orders
    assert np.all(np.diff(np.abs(orders - 2), axis=0) < 0.05), orders  # tends to 2
