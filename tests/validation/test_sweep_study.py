"""The study file: what it may state, and the one message for each thing that is wrong."""

import math
from pathlib import Path

import numpy as np
import pytest
from small_case import ROOT
from small_sweep import GRID, small_study, study_file

from cases.errors import CaseFileError
from validation.sweep.command import main
from validation.sweep.design import samples_of
from validation.sweep.samples import samples_of_study
from validation.sweep.study import load_study

MODULUS = "calcification.youngs_modulus"


def parameter(folder: Path, key: str, stated: object):
    (found,) = small_study(folder, parameters={key: stated}, design=design_for(stated)).parameters
    return found


def design_for(stated: object):
    drawn = isinstance(stated, dict) and "distribution" in stated
    return {"kind": "sobol", "count": 8} if drawn else "grid"


def test_the_ready_study_is_one():
    study = load_study(ROOT / "cases/sweep.yaml")
    assert samples_of(study.design, study.parameters) == 64


def test_values_are_read_with_their_units(tmp_path):
    found = parameter(tmp_path, MODULUS, ["0.6 MPa", "1e6 Pa"])
    assert found.values.tolist() == [6e5, 1e6]
    assert (found.display.unit, found.display.factor, found.label) == (
        "MPa",
        1e-6,
        "Young's modulus of the calcification",
    )


def test_angles_scales_and_whole_numbers(tmp_path):
    angle = parameter(tmp_path, "calcification.phi.extent", ["90 deg"])
    assert angle.values == pytest.approx([math.pi / 2])
    assert angle.display.factor * math.pi == pytest.approx(180.0)
    assert parameter(tmp_path, "inlet.scale", [0.9, 1.1]).values.tolist() == [0.9, 1.1]
    assert parameter(tmp_path, "solver.n_x", {"start": 12, "stop": 36, "count": 3}).values.tolist() == [
        12,
        24,
        36,
    ]


def test_ranges_are_even_or_of_equal_ratios(tmp_path):
    ends = {"start": "1 MPa", "stop": "100 MPa", "count": 3}
    assert parameter(tmp_path, MODULUS, ends).values == pytest.approx([1e6, 50.5e6, 1e8])
    assert parameter(tmp_path, MODULUS, ends | {"spacing": "log"}).values == pytest.approx([1e6, 1e7, 1e8])


def test_a_label_is_the_users(tmp_path):
    stated = {"start": "1 MPa", "stop": "2 MPa", "count": 2, "label": "plaque"}
    assert parameter(tmp_path, MODULUS, stated).label == "plaque"


def test_overrides_change_the_case_and_variants_share_a_design(tmp_path):
    overrides = {"solver": {"n_x": 8}, "wall": {"law": "thin"}}
    study = small_study(
        tmp_path, "axisymmetric", "local", variant=["axisymmetric", "local"], overrides=overrides
    )
    assert [(case.solver.n_x, case.wall.law) for case in study.cases.values()] == [(8, "thin")] * 2
    samples = samples_of_study(study)
    assert len(samples) == 12
    assert [samples[n].variant for n in (0, 5, 6, 11)] == ["axisymmetric", "axisymmetric", "local", "local"]
    assert samples[1].values == samples[7].values


def test_bands_of_the_case_are_outputs_where_something_judges(tmp_path):
    assert not [output for output in small_study(tmp_path).outputs if output.bands]
    judged = {o.name: o.bands[0].limit for o in small_study(tmp_path, against="reference").outputs if o.bands}
    assert judged["radius_rms_error"] == 0.01
    assert judged["pressure_rms_error"] == math.inf  # told, not judged


def test_outputs_may_be_chosen(tmp_path):
    study = small_study(tmp_path, outputs=["flow_amplitude", "systolic_pressure_inlet"])
    assert [output.name for output in study.outputs] == ["flow_amplitude", "systolic_pressure_inlet"]


UNIFORM = {"distribution": "uniform", "low": "1 MPa", "high": "2 MPa"}
RANGE = {"start": "1 MPa", "stop": "2 MPa", "count": 2}


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"parametres": {}}, "parametres: unknown key parametres; did you mean parameters?"),
        ({"base": "none.yaml"}, "base: none.yaml: no such file"),
        ({"base": None}, "base: missing"),
        ({"variant": "lokal"}, "variant: lokal; did you mean local?"),
        ({"against": "3D"}, "against: 3D; allowed: none, coupled, reference"),
        ({"parameters": None}, "parameters: nothing; allowed: keys of the case"),
        (
            {"parameters": {"inlet.scale": {"distribution": ["uniform"], "low": 1, "high": 2}}},
            "distribution: a list; allowed: uniform, loguniform",
        ),
        (
            {"parameters": {"inlet.scale": {"distribution": {"a": 1}, "low": 1, "high": 2}}},
            "distribution: a section; allowed: uniform, loguniform",
        ),
        (
            {"parameters": {"calcification.phi.extent": ["360 deg"]}},
            "360 deg; allowed: an angle from 0.001 deg to 359.999 deg",
        ),
        (
            {"parameters": {"blood.viscosty": ["1 Pa s"]}},
            "no number of the case; did you mean blood.viscosity?",
        ),
        (
            {"parameters": {"viscosity": ["1 Pa s"]}},
            "parameters.viscosity: no number of the case; did you mean",
        ),
        ({"parameters": {"wall.law": ["thin"]}}, "parameters.wall.law: no number of the case"),
        ({"parameters": {MODULUS: []}}, f"parameters.{MODULUS}: no values; allowed: a list"),
        ({"parameters": {MODULUS: "1 MPa"}}, f"parameters.{MODULUS}: 1 MPa; allowed: a list"),
        ({"parameters": {MODULUS: ["1 mm"]}}, "1 mm: mm is no unit of pressure; allowed: a pressure from"),
        ({"parameters": {MODULUS: [1]}}, "1: no unit; allowed: a pressure from"),
        ({"parameters": {MODULUS: ["1 mPa"]}}, "1 mPa; allowed: a pressure from 1 Pa"),
        ({"parameters": {MODULUS: {**RANGE, "count": 1}}}, "count: 1; allowed: a whole number from 2"),
        ({"parameters": {MODULUS: {**RANGE, "step": 1}}}, "step: unknown key step; did you mean stop?"),
        ({"parameters": {MODULUS: {**RANGE, "spacing": "cubic"}}}, "spacing: cubic; allowed: linear, log"),
        ({"parameters": {MODULUS: {"start": "1 MPa", "stop": "2 MPa"}}}, "count: missing"),
        (
            {"parameters": {"solver.n_x": {"start": 8, "stop": 11, "count": 3}}},
            "9.5 among the values; allowed: whole",
        ),
        ({"parameters": {MODULUS: {"distribution": "gauss"}}}, "distribution: gauss; allowed: uniform"),
        ({"parameters": {MODULUS: {**UNIFORM, "high": "0.5 MPa"}}}, "high: 0.5 MPa; allowed: above low"),
        (
            {"parameters": {MODULUS: {**UNIFORM, "distribution": "triangular", "mode": "3 MPa"}}},
            "mode: 3 MPa; allowed: from low to high",
        ),
        (
            {
                "parameters": {
                    MODULUS: {"distribution": "normal", "mean": "1 MPa", "standard_deviation": "-1 Pa"}
                }
            },
            "standard_deviation: -1 Pa; allowed: a positive pressure",
        ),
        (
            {"parameters": {"outlet.offset": {"distribution": "loguniform", "low": "-1 Pa", "high": "1 Pa"}}},
            "low: -1 Pa; allowed: above 0",
        ),
        (
            {"parameters": {"solver.n_x": {"distribution": "uniform", "low": 8, "high": 9}}},
            "uniform for a whole number",
        ),
        ({"parameters": {MODULUS: UNIFORM}}, f"design: grid: {MODULUS} is a distribution"),
        (
            {"parameters": {"calcification.x.extent": ["1 mm"], "calcification.x[1]": ["1 mm"]}},
            "beside calcification.x[1]; allowed: centre and extent, or the ends",
        ),
        ({"design": "list"}, "design: list: other numbers of values"),
        ({"design": "random"}, "design.kind: random; allowed: grid, list"),
        ({"design": {"kind": "sobol"}}, "design.count: nothing; allowed: a number of samples"),
        ({"design": {"kind": "sobol", "count": 12}}, "design.count: 12; allowed: a power of two"),
        ({"design": {"kind": "grid", "count": 12}}, "design.count: 12; allowed: none with design grid"),
        (
            {"design": {"kind": "latin_hypercube", "count": 2_000_000}},
            "design.count: 2000000; allowed: a whole",
        ),
        ({"overrides": {"solver": {"n_y": 8}}}, "overrides.solver.n_y: unknown key n_y"),
        ({"overrides": {"solver": {"n_x": 1}}}, "overrides.solver.n_x: 1; allowed: a whole number from 3"),
        ({"overrides": 3}, "overrides: 3; allowed: keys of the case"),
        ({"outputs": ["systolic_presure_inlet"]}, "did you mean systolic_pressure_inlet?"),
        ({"outputs": ["radius_rms_error"]}, "outputs: radius_rms_error"),
        ({"chunk": 0}, "chunk: 0; allowed: a whole number from 1"),
        (
            {"against": "reference", "parameters": {"solver.n_x": [12]}},
            "against: reference: solver.n_x is the reference's",
        ),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path, capsys, keys, message):
    path = study_file(tmp_path, **keys)
    with pytest.raises(CaseFileError) as caught:
        load_study(path)
    assert message in str(caught.value)
    assert str(caught.value).startswith(str(path))
    assert main([str(path), "--output", str(tmp_path / "out")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_several_variants_need_a_choice(tmp_path):
    with pytest.raises(CaseFileError, match="variant: missing; allowed: none, local, or several of them"):
        small_study(tmp_path, "none", "local", parameters={"inlet.scale": [1]})


def test_the_coupled_model_is_not_judged_by_itself(tmp_path):
    overrides = {
        "wall": {"law": "membrane", "base": "thick"},
        "solver": {"pressure": "section"},
    }
    with pytest.raises(CaseFileError, match="against: coupled: the case is the coupled model itself"):
        small_study(tmp_path, overrides=overrides, against="coupled")


def test_a_study_all_of_whose_samples_are_refused_is_refused(tmp_path):
    study = small_study(tmp_path, parameters={"inlet.period": ["0.5 s", "0.6 s"]})
    with pytest.raises(CaseFileError, match=r"no sample is a case .* inlet\.period: .* which has its own"):
        samples_of_study(study)


def test_a_case_that_is_wrong_is_blamed_itself(tmp_path):
    path = study_file(tmp_path)
    (tmp_path / "small.yaml").write_text("name: small\n", encoding="utf-8")
    with pytest.raises(CaseFileError, match=r"small\.yaml"):
        load_study(path)


def test_what_is_no_study_is_refused(tmp_path):
    for text, message in (
        ("", "empty"),
        ("- 1", "no keys"),
        ("name: [", "broken YAML"),
        ("name: x", "base: missing"),
    ):
        path = tmp_path / "study.yaml"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(CaseFileError, match=message):
            load_study(path)
    with pytest.raises(CaseFileError, match="allowed: a case file"):
        load_study(tmp_path / "none.yaml")


def test_the_grid_of_the_helper_has_a_sample_that_is_refused(tmp_path):
    samples = samples_of_study(small_study(tmp_path))
    refused = [sample.number for sample in samples.block(range(len(samples))) if sample.case is None]
    assert refused == [2, 5]
    assert np.prod([len(values) for values in GRID.values()]) == len(samples)


@pytest.mark.parametrize("name", ["thesis.yaml", "calibration_of_outlet.yaml"])
def test_another_kind_of_file_is_no_study(name):
    path = Path(__file__).parents[2] / "cases" / name
    with pytest.raises(CaseFileError, match="; allowed: the study of a sweep; to run it: python -m valid"):
        load_study(path)
