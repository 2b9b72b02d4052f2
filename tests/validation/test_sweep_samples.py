"""Samples: what a design says reaches the case with all its digits, or is told why it does not."""

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_case import READY, small_case, written
from small_sweep import small_study

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file
from cases.reading.numeric_keys import numeric_keys
from cases.reading.template import case_with, load_template
from solver.runs.batch import run_batch
from solver.runs.result import cell_dataset
from validation.runs.reduced_model import change_of, run_times
from validation.sweep.outputs import CYCLE_CHANGE, MEASURED, MEASURES
from validation.sweep.samples import samples_of_study
from validation.sweep.spans import ends_of, span_keys

BASE = load_case_file(READY).variants["local"]
TEMPLATE = load_template(READY, "local")


def first_case(folder, **parameters):
    study = small_study(folder, parameters={key: [value] for key, value in parameters.items()})
    return samples_of_study(study)[0].case


@given(st.floats(1e5, 1e11), st.floats(1e-6, 1.0), st.floats(0.001, 1000.0))
def test_numbers_arrive_bit_by_bit(modulus, viscosity, scale):
    values = {
        ("calcification", "youngs_modulus"): f"{modulus!r} Pa",
        ("blood", "viscosity"): f"{viscosity!r} Pa s",
        ("inlet", "scale"): scale,
    }
    case = case_with(TEMPLATE, values)
    assert (case.calcification.youngs_modulus, case.blood.viscosity, case.inlet.scale) == (
        modulus,
        viscosity,
        scale,
    )
    assert case.wall == BASE.wall


def test_the_numbers_of_a_case_are_found():
    keys = numeric_keys(BASE)
    assert keys["outlet.resistance"].value == 1.358e9
    assert keys["calcification.x[2]"].value == 0.01
    assert (keys["solver.n_x"].whole, keys["geometry.radius"].whole) == (True, False)
    assert keys["inlet.ramp"].value is None
    assert not {"wall.law", "title", "inlet.waveform", "solver.closure", "inlet.fourier.mean"} & set(keys)


FACTORS = st.sampled_from([-1.0, 0.0, 0.1, 0.5, 0.99, 1.01, 2.0, 30.0])


@given(st.dictionaries(st.sampled_from(sorted(numeric_keys(BASE))), FACTORS, min_size=1, max_size=3))
def test_a_sample_is_what_a_check_of_the_whole_case_says(factors):
    keys = numeric_keys(BASE)
    values = {
        keys[name].path: keys[name].stated(factor * (keys[name].value or 1.0))
        for name, factor in factors.items()
    }
    found = []
    for unchanged in (None, BASE):
        try:
            found.append(case_with(TEMPLATE, values, unchanged))
        except CaseFileError as error:
            found.append(str(error))
    assert found[0] == found[1]


@given(st.floats(1e-3, 1.4e-2), st.floats(1e-4, 1e-3), st.floats(0.0, 2 * math.pi), st.floats(0.01, 6.2))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_centre_and_extent_are_those_of_the_ends(centre, extent, direction, angle):
    stated = {
        ("calcification", "x", "centre"): centre,
        ("calcification", "x", "extent"): extent,
        ("calcification", "phi", "centre"): direction,
        ("calcification", "phi", "extent"): angle,
    }
    case = case_with(TEMPLATE, ends_of(BASE, stated))
    for name, key in span_keys(case).items():
        wanted = stated[key.path]
        apart = abs(key.value - wanted)
        if name == "calcification.phi.centre":
            apart = min(apart, 2 * math.pi - apart)
        assert apart < 1e-12


def test_what_a_study_does_not_state_of_a_span_stays(tmp_path):
    moved = first_case(tmp_path, **{"calcification.x.centre": "8 mm"})
    assert moved.calcification.x == pytest.approx((5.5e-3, 10.5e-3))
    turned = first_case(tmp_path, **{"calcification.phi.centre": "10 deg"})
    assert turned.calcification.phi == pytest.approx(tuple(math.radians(angle) for angle in (325.0, 55.0)))
    assert turned.calcification.x == (0.005, 0.01)


def test_patches_of_several_are_moved_one_by_one(tmp_path):
    case = small_case("local")
    patch = case["variants"]["local"]["calcification"]
    other = dict(patch) | {"x": ["1 mm", "3 mm"], "phi": ["135 deg", "225 deg"]}
    case["variants"]["local"]["calcification"] = {"pattern": "several", "patches": [patch, other]}
    keys = {
        "calcification.patches[2].x.centre": ["5 mm"],
        "calcification.patches[1].youngs_modulus": ["2 MPa"],
    }
    found = samples_of_study(small_study(tmp_path, case=case, parameters=keys))[0].case
    assert found.calcification.patches[1].x == pytest.approx((4e-3, 6e-3))
    assert found.calcification.patches[0].x == (0.005, 0.01)
    assert [part.youngs_modulus for part in found.calcification.patches] == [2e6, 1e7]


def test_whole_numbers_stay_whole(tmp_path):
    assert first_case(tmp_path, **{"solver.n_x": 24}).solver.n_x == 24


def test_a_sample_that_is_refused_says_why(tmp_path):
    sample = samples_of_study(small_study(tmp_path))[2]
    assert sample.case is None
    assert sample.error.startswith("calcification.x[1]: -0.0025")
    assert "m; allowed: a length from 0 m to 10 m" in sample.error
    assert sample.values == (1e6, 0.02)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("angles", "rows"),
    [
        ([("135 deg", "225 deg")], 4),
        ([("315 deg", "45 deg")], 4),
        ([("225 deg", "315 deg"), ("45 deg", "135 deg")], 4),  # the first lies in the half that is left out
        ([("90 deg", "225 deg")], 8),
    ],
)
def test_outputs_of_the_computed_rows_are_those_of_all(tmp_path, angles, rows):
    content = small_case("local")
    patches = [
        {
            "pattern": "local",
            "youngs_modulus": "10 MPa",
            "x": ["5 mm", "10 mm"],
            "phi": list(ends),
            "transition": "sharp",
        }
        for ends in angles
    ]
    content["variants"]["local"]["calcification"] = {"pattern": "several", "patches": patches}
    case = load_case_file(written(content, tmp_path)).variants["local"]
    times = run_times(case, [0.0, 0.2 * case.inlet.period, 0.5 * case.inlet.period, case.inlet.period])

    def outputs(model, cells):
        last = cell_dataset(model, cells, MEASURED)
        last = last.assign_attrs({CYCLE_CHANGE: change_of(case, last)})
        return last.sizes["phi"], {name: measure(case, last) for name, measure in MEASURES.items()}

    computed, everywhere = (
        run_batch([case], times, outputs, every_row=each)[0].kept for each in (False, True)
    )
    assert (computed[0], everywhere[0]) == (rows, 8)
    for name, value in everywhere[1].items():
        assert computed[1][name] == pytest.approx(value, rel=1e-12), name
