"""Profiles of two modes against FEBio: where blood flows back, and beside profiles of one exponent."""

from pathlib import Path

import numpy as np
import pytest

from cases.reading.case_file import load_case_file
from solver.case.model import grid_of
from validation.mapping.rays import rays
from validation.reference.febio.series import KIND
from validation.runs.matched_inflow import with_inflow_of
from validation.runs.reduced_model import run_reduced_model

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
NEAR_ZERO = 0.05  # of the largest D


def off(ours, theirs):
    """Root mean square of the difference over that of 3D."""
    return float(np.sqrt(np.mean((ours - theirs) ** 2) / np.mean(np.asarray(theirs) ** 2)))


def both(case):
    grid = grid_of(case)
    points = rays(grid.x, grid.phi)
    reference = KIND.read(case, points)
    driven = with_inflow_of(case, reference)
    return reference.fields, [
        run_reduced_model(each, reference.alignment, points).fields for each in (case, driven)
    ]


def test_the_axis_flows_back_when_3d_does():
    case = load_case_file(ROOT / "cases/reversal.yaml").variants["axis_momentum"]
    theirs, (ours, driven) = both(case)
    d, expected = ours["axis_velocity"].to_numpy(), theirs["axis_velocity"].to_numpy()
    told = np.abs(expected) > NEAR_ZERO * np.abs(expected).max()
    assert 0.05 < (expected[told] < 0).mean() < 0.5
    assert np.all(np.sign(d[told]) == np.sign(expected[told]))
    assert off(d, expected) < 0.06
    assert off(driven["section_flow_rate"], theirs["section_flow_rate"]) < 0.02  # of 3D's own inflow


def test_two_modes_are_closer_than_one_exponent():
    """Figures of docs/methods.md."""
    power = load_case_file(ROOT / "cases/coupled.yaml").variants["local"]
    modes = {"profile": "two_mode", "closure": "axis_momentum"}
    case = power.model_copy(update={"solver": power.solver.model_copy(update=modes)})
    theirs, (ours, _) = both(case)
    _, (before, _) = both(power)
    of_power, of_modes = (missed(run, theirs) for run in (before, ours))
    assert of_power == pytest.approx([0.0340, 0.0416, 0.0266, 0.0071], rel=0.02)
    assert of_modes == pytest.approx([0.0125, 0.0131, 0.0066, 0.0051], rel=0.02)


def missed(ours, theirs):
    """RMS over cells and states: |v − v'|/|v'|, D, momentum flux over u², u over its section's mean."""
    y = theirs["y"].to_numpy()
    v, w = (each["axial_velocity"].to_numpy().astype(float) for each in (ours, theirs))
    u, m = (each["mean_velocity"].to_numpy() for each in (ours, theirs))
    flux, right = (np.trapezoid(each**2 * y, y) for each in (v, w))
    share, own = (each / each.mean(axis=-1, keepdims=True) for each in (u, m))
    return [
        rms(np.linalg.norm(v - w, axis=-1) / np.linalg.norm(w, axis=-1)),
        rms(ours["axis_velocity"].to_numpy() / theirs["axis_velocity"].to_numpy() - 1),
        rms(flux * m**2 / (right * u**2) - 1),
        rms(share / own - 1),
    ]


def rms(values):
    return float(np.sqrt(np.mean(values**2)))
