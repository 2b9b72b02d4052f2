"""The three real runs on a coarse grid: what their own README says of them."""

import numpy as np
import pytest
from small_case import small_case, written

from cases.reading.case_file import load_case_file
from solver.case.model import inlet_signal
from validation.mapping.rays import rays
from validation.metrics.curved_section import curved_flow_rate
from validation.reference.febio.series import KIND

pytestmark = pytest.mark.slow

X = np.array([0.625e-3, 6.875e-3, 7.5e-3, 14.375e-3])
PHI = np.arange(8) * np.pi / 4
MIDDLE = 2


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    content = small_case("none", "axisymmetric", "local")
    content["compare"]["cells"]["i"] = [1, 2, 4]
    file = load_case_file(written(content, tmp_path_factory.mktemp("case")))
    return {name: (case, KIND.read(case, rays(X, PHI))) for name, case in file.variants.items()}


@pytest.fixture(scope="module")
def between_corners(tmp_path_factory):
    """The local run on rays between the corners of its 24-sided sections."""
    file = load_case_file(written(small_case("local"), tmp_path_factory.mktemp("case")))
    case = file.variants["local"]
    cells = rays((np.arange(12) + 0.5) * 1.25e-3, (np.arange(8) + 0.5) * np.pi / 4)
    return case, KIND.read(case, cells)


def test_all_states_of_one_cycle_are_used(runs):
    for _, found in runs.values():
        assert len(found.alignment.states) == 41
        assert found.alignment.coverage == pytest.approx(1.0, rel=1e-4)
        assert found.alignment.cycle_times[0] == pytest.approx(0.0, abs=1e-5)


def test_radius_and_pressure_without_calcification(runs):
    fields = runs["none"][1].fields
    radius, pressure = fields["radius"] * 1e3, fields["pressure"] * 1e-3
    assert (radius.min().item(), radius.max().item()) == pytest.approx((2.744, 2.824), abs=5e-4)
    assert (pressure.min().item(), pressure.max().item()) == pytest.approx((12.00, 15.97), abs=6e-3)


def test_radius_grows_with_pressure_as_stated(runs):
    case, found = runs["none"]
    compliance = (found.fields["radius"] - case.geometry.radius) / found.fields["pressure"]
    assert compliance.isel(x=MIDDLE).mean().item() == pytest.approx(2.03e-8, rel=5e-3)


def test_radius_around_the_local_calcification_at_systole(runs):
    radius = runs["local"][1].fields["radius"].isel(x=MIDDLE) * 1e3
    systole = radius.isel(time=int(radius.mean("phi").argmax("time")))
    # φ = 0 lies opposite to the calcification, π in its middle
    assert systole[0].item() == pytest.approx(2.865, abs=1e-3)
    assert systole[4].item() == pytest.approx(2.633, abs=1e-3)
    assert np.all(np.diff(systole[:5]) < 0)
    assert np.all(np.diff(systole[4:]) > 0)


def test_radius_does_not_depend_on_the_angle_without_a_patch(runs):
    for name in ("none", "axisymmetric"):
        radius = runs[name][1].fields["radius"].to_numpy()
        assert np.max(np.ptp(radius, axis=2) / radius.mean(axis=2)) < 1e-4


def test_pressure_is_uniform_over_sections(runs):
    for _, found in runs.values():
        assert np.max(np.ptp(found.fields["pressure"].to_numpy(), axis=2)) < 5.0


def test_flow_by_rays_and_through_planes_agree(between_corners):
    _, found = between_corners
    by_rays = found.fields["section_flow_rate"].sel(
        time=found.checks["check_time"].to_numpy(), x=found.checks["check_x"].to_numpy()
    )
    assert_within(by_rays.to_numpy(), found.checks["plane_flow_rate"].to_numpy(), 0.01)


def test_inflow_is_the_prescribed_velocity_times_the_area(runs):
    for case, found in runs.values():
        prescribed = inlet_signal(case)(found.alignment.cycle_times)
        inflow, area = (found.checks[name].to_numpy() for name in ("inlet_flow_rate", "inlet_area"))
        assert_within(inflow, prescribed * area, 0.01)


def test_the_outlets_resistance_feels_the_flow_of_the_mesh(between_corners):
    """P = offset + resistance × flow holds in FEBio with the mesh's flow, not with that of a round lumen."""
    case, found = between_corners
    last = found.fields.isel(x=-1)

    def off(flow):  # mean over the cycle: inertia between the last station and the outlet cancels
        excess = last["section_pressure"] - case.outlet.offset - case.outlet.resistance * flow
        return excess.isel(time=slice(1, None)).mean().item()

    assert abs(off(last["section_flow_rate"])) < 4.0
    assert off(curved_flow_rate(found.fields).isel(x=-1)) < -40.0


def test_mass_is_kept_to_a_percent(runs):
    for _, found in runs.values():
        assert np.max(np.abs(found.fields["mass_defect"])) < 0.01


def test_blood_flows_forward_everywhere(runs):
    for _, found in runs.values():
        assert not found.fields["backflow_fraction"].any()
        assert np.all(found.fields["axial_dominance_radial"] < 0.2)
        assert np.all(found.fields["axis_velocity_spread"] < 1e-6)


def test_closest_profiles_are_near_poiseuilles(between_corners):
    fields = between_corners[1].fields
    assert fields["profile_exponent"].min() > 1.4
    assert fields["profile_exponent"].max() < 3.5
    assert fields["profile_error"].max() < 0.15


def assert_within(found, expected, share):
    assert np.max(np.abs(found / expected - 1)) <= share
