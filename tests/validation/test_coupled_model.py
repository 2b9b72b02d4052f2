"""The coupled model against the 3D runs and the thesis's 3D: nothing is fitted, so these figures are results.

Every tenth section and all its rows are compared; over all sections and states of the local run R is
0.63 % RMS and 1.8 % at worst, P 0.49 %, a sector's share of its section's flow 0.92 % RMS and 3.5 % at worst.
"""

import numpy as np
import pytest

from cases.reading.case_file import load_case_file
from solver.case.model import grid_of
from solver.case.run import run_case
from validation.ablation.ladder import models_between
from validation.ablation.thesis_sectors import sector_errors
from validation.mapping.rays import rays
from validation.metrics.statistics import largest, rms
from validation.reference.febio.series import KIND

from small_case import ROOT  # isort: skip

pytestmark = pytest.mark.slow

TABLE = ROOT / "reference_data/thesis/table_3_8.csv"
SECTIONS = np.array([1, 11, 21, 31, 39, 51, 61, 71, 82, 91, 101, 111, 120]) - 1
CASES = load_case_file(ROOT / "cases/coupled.yaml").variants


def pair_of(case, reference):
    """Fields of the reduced model at the reference's instants and sections, and of the reference."""
    times = reference.alignment.rom_times
    run = run_case(case, np.unique(np.concatenate([[0.0], times]))).sel(time=times).isel(x=SECTIONS)
    return run, reference.fields


def relative(pair, name, over=None):
    one, other = (fields[name].to_numpy() for fields in pair)
    if over is not None:
        one, other = (
            a / fields[over].to_numpy()[..., None] for a, fields in zip((one, other), pair, strict=True)
        )
    return one / other - 1


@pytest.fixture(scope="module")
def references():
    found = {}

    def of(variant):
        if variant not in found:
            cells = CASES[variant].compare.cells.model_copy(update={"i": (1, len(SECTIONS))})
            compare = CASES[variant].compare.model_copy(update={"cells": cells})
            case = CASES[variant].model_copy(update={"compare": compare})
            grid = grid_of(case)
            found[variant] = KIND.read(case, rays(grid.x[SECTIONS], grid.phi))
        return found[variant]

    return of


@pytest.fixture(scope="module")
def local(references):
    return pair_of(CASES["local"], references("local"))


def test_radius_at_the_local_calcification(local):
    error = relative(local, "radius")
    assert rms(error) < 0.7e-2
    assert abs(largest(error)) < 2e-2


def test_pressure_at_the_local_calcification(local):
    assert rms(relative(local, "pressure")) < 0.5e-2


def test_sectors_share_their_sections_flow_as_in_3d(local):
    error = relative(local, "sector_flow_rate", "section_flow_rate")
    assert rms(error) < 1e-2
    assert abs(largest(error)) < 4e-2
    inside = error[:, (SECTIONS >= 10) & (SECTIONS <= 60)]
    assert abs(largest(inside)) < 3e-2


def test_the_ring_of_an_axisymmetric_calcification(references):
    error = relative(pair_of(CASES["axisymmetric"], references("axisymmetric")), "radius")
    assert abs(largest(error)) < 0.45e-2


def test_rows_alone_miss_both(references):
    rows = models_between(CASES["local"])["thick wall, row pressure"]
    pair = pair_of(rows, references("local"))
    assert abs(largest(relative(pair, "radius"))) > 5e-2
    assert abs(largest(relative(pair, "sector_flow_rate", "section_flow_rate"))) > 7e-2


def test_the_thesis_3d_sectors():
    assert np.max(np.abs(sector_errors(CASES["local"], TABLE))) < 2.5e-2


def test_on_3ds_own_wall_the_radius_is_3ds_and_sectors_share_better(references):
    """All cells: R 0.03 % RMS and 0.10 % at worst, shares 0.42 % and 1.94 %; bands are what was asked for."""
    case = load_case_file(ROOT / "cases/solid.yaml").variants["local"]
    pair = pair_of(case, references("local"))
    radius = relative(pair, "radius")
    assert rms(radius) < 0.4e-2
    assert abs(largest(radius)) < 0.2e-2  # the pressure, 0.4 % off, moves R by a tenth of that
    share = relative(pair, "sector_flow_rate", "section_flow_rate")
    assert rms(share) < 0.7e-2
    assert abs(largest(share)) < 2e-2
