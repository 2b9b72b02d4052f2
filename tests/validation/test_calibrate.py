"""Calibration: known numbers are found again, errors are right, and what cannot be fitted is said."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML
from small_case import ROOT, small_case, written

from cases.reading.calibration_file import changed_values, load_calibration
from cases.reading.case_file import load_case_file
from cases.reading.numeric_keys import numeric_keys
from cases.reading.template import case_with
from solver.runs.batch import run_batch
from validation.calibrate import command as calibrate
from validation.calibrate.calibration import calibrated
from validation.calibrate.fit import fit
from validation.calibrate.fitted_case import check_case, snippet, write_case
from validation.calibrate.targets import observed
from validation.errors import ValidationError
from validation.runs.variants import watching

pytestmark = pytest.mark.slow

OUTLET = {
    "outlet.resistance": {"low": "1e8 Pa s/m^3", "high": "1e10 Pa s/m^3"},
    "outlet.offset": {"low": "1 kPa", "high": "20 kPa"},
}
MATERIAL = {"wall.youngs_modulus": {"low": "0.2 MPa", "high": "3 MPa"}}
PRESSURES = [
    {"quantity": "systolic_pressure", "value": "16 kPa"},
    {"quantity": "diastolic_pressure", "value": "12 kPa", "at": "outlet"},
]
RADIUS = {"quantity": "largest_radius", "value": "2.75 mm", "at": "7.5 mm"}


@pytest.fixture
def calibration_of(tmp_path):
    """A calibration of a variant of the ready case on a coarse grid."""

    def of(parameters, targets=(), variant="none", reference=None, **sections):
        content = small_case(variant)
        for name, changes in sections.items():
            content[name] |= changes
        case = written(content, tmp_path)
        stated = {"name": "found", "case": str(case), "variant": variant, "parameters": parameters}
        stated |= {"error_tolerance": "none"}  # steps as of the runs that a fit is held against
        stated |= {"targets": list(targets)} if targets else {"reference": reference}
        path = tmp_path / "calibration.yaml"
        with path.open("w", encoding="utf-8") as stream:
            YAML().dump(stated, stream)
        return path

    return of


def fitted(path):
    return calibrated(load_calibration(path))


def attained(calibration, wanted, values):
    """What the case attains with these values, by a run of its own."""
    keys = [parameter.key for parameter in calibration.parameters]
    case = case_with(calibration.template, changed_values(keys, values))
    (outcome,) = run_batch([case], wanted.times, wanted.measure)
    return outcome.kept


def test_the_thesiss_outlet_is_found(tmp_path, capsys):
    """7205.2 Pa and 5.7817e9 Pa s/m³ from the 15.88 and 10.66 kPa that they attain, to 1 %."""
    shipped = ROOT / "cases/calibration_of_outlet.yaml"
    assert calibrate.main([str(shipped), "--output", str(tmp_path / "out")]) == 0
    record = json.loads((tmp_path / "out/calibration.json").read_text())
    found = {each["key"]: each["value"] for each in record["parameters"]}
    assert found["outlet.resistance"] == pytest.approx(5.7817e9, rel=0.01)
    assert found["outlet.offset"] == pytest.approx(7205.2, rel=0.01)
    assert [each["start"] for each in record["parameters"]] == [1.358e9, 9330.0]
    for target in record["targets"]:
        assert target["attained"] == pytest.approx(target["value"], rel=1e-6)
    assert record["runs"] > 10
    assert record["provenance"]["case"]["path"] == "cases/calibration_of_outlet.yaml"
    printed = capsys.readouterr()
    assert "outlet.resistance" in printed.out
    assert "no standard errors; state each target's uncertainty" in printed.out
    assert printed.err == ""


@settings(max_examples=3, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(resistance=st.floats(5e8, 4e9), offset=st.floats(4e3, 14e3), modulus=st.floats(4e5, 2e6))
def test_known_numbers_are_found_again(calibration_of, resistance, offset, modulus):
    calibration = load_calibration(calibration_of(OUTLET | MATERIAL, [*PRESSURES, RADIUS]))
    truth = np.array([resistance, offset, modulus])
    with watching() as watch:
        wanted = observed(calibration, watch, None)
    wanted.values[:] = attained(calibration, wanted, truth)
    found = fit(calibration, wanted, lambda runs: None)
    np.testing.assert_allclose(found.values, truth, rtol=1e-4)
    np.testing.assert_allclose(found.attained, wanted.values, rtol=1e-6)
    assert found.failed == 0


def test_stated_uncertainties_give_standard_errors(calibration_of):
    """Those of a linear map: covariance J⁻¹ S J⁻ᵀ, with J by differences of independent runs."""
    targets = [PRESSURES[0] | {"uncertainty": "100 Pa"}, PRESSURES[1] | {"uncertainty": "50 Pa"}]
    calibration = load_calibration(calibration_of(OUTLET, targets))
    wanted, found = calibrated(calibration)
    steps = np.diag(1e-3 * found.values)
    columns = [
        (attained(calibration, wanted, found.values + step) - found.attained) / step.sum() for step in steps
    ]
    inverse = np.linalg.inv(np.stack(columns, axis=1))
    covariance = inverse @ np.diag([100.0**2, 50.0**2]) @ inverse.T
    np.testing.assert_allclose(found.standard_errors, np.sqrt(np.diag(covariance)), rtol=0.01)
    expected = covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])
    assert found.correlation[0, 1] == pytest.approx(expected, abs=0.01)
    assert wanted.uncertain


def test_more_targets_than_parameters_leave_differences(calibration_of):
    """Inlet and outlet have nearly one pressure; asked to differ by 400 Pa, the fit takes the middle."""
    one = {"quantity": "systolic_pressure", "value": "16.2 kPa", "at": "inlet"}
    other = {"quantity": "systolic_pressure", "value": "15.8 kPa", "at": "outlet"}
    path = calibration_of({"outlet.offset": OUTLET["outlet.offset"]}, [one, other])
    wanted, found = fitted(path)
    np.testing.assert_allclose(found.attained, [16000, 16000], atol=25)
    beside = attained(load_calibration(path), wanted, found.values + 100)
    gain = np.linalg.norm((beside - found.attained) / 100 / wanted.scales)
    misfit = np.linalg.norm((found.attained - wanted.values) / wanted.scales)  # one surplus target
    assert found.standard_errors[0] == pytest.approx(misfit / gain, rel=0.02)


def test_a_3d_run_is_fitted(calibration_of, tmp_path, capsys, known_runs):
    """FEBio's own outlet is found again from its pressure over the cycle."""
    bounds = {
        "outlet.resistance": OUTLET["outlet.resistance"] | {"start": "3e9 Pa s/m^3"},
        "outlet.offset": OUTLET["outlet.offset"] | {"start": "7 kPa"},
    }
    path = calibration_of(bounds, reference={"quantity": "section_pressure", "at": ["outlet", "7.5 mm"]})
    assert calibrate.main([str(path), "--output", str(tmp_path / "out")]) == 0
    record = json.loads((tmp_path / "out/calibration.json").read_text())
    resistance, offset = record["parameters"]
    assert resistance["value"] == pytest.approx(1.358e9, rel=0.05)
    assert offset["value"] == pytest.approx(9330, rel=0.02)
    assert 0 < offset["standard_error"] < 100
    assert record["rms_difference"] < 100
    assert "root mean square" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("parameters", "targets", "sections", "said"),
    [
        (
            {"outlet.offset": {"low": "1 kPa", "high": "9 kPa", "start": "5 kPa"}},
            PRESSURES[:1],
            {},
            "parameters.outlet.offset: ends on its limit high (9000); systolic pressure, artery: 15.7",
        ),
        (
            OUTLET,
            [PRESSURES[0], PRESSURES[1] | {"value": "15.9 kPa"}],
            {},
            "ends on its limit low",
        ),
        (
            {"calcification.x[2]": {"low": "9.5 mm", "high": "10.5 mm"}},  # between two sections' centres
            PRESSURES[:1],
            {"variant": "axisymmetric"},
            "no target depends on calcification.x[2]",
        ),
        (
            MATERIAL | {"geometry.wall_thickness": {"low": "0.1 mm", "high": "1 mm"}},
            [RADIUS, RADIUS | {"at": "inlet"}],
            {"wall": {"law": "thin"}},
            "the targets do not tell wall.youngs_modulus and geometry.wall_thickness apart",
        ),
        (
            {"outlet.offset": {"low": "-900 kPa", "high": "1 kPa", "start": "-400 kPa"}},
            PRESSURES[:1],
            {},
            "the run from which the search begins: the lumen collapses",
        ),
        (
            {"calcification.x[2]": {"low": "6 mm", "high": "20 mm", "start": "19 mm"}},
            PRESSURES[:1],
            {"variant": "axisymmetric"},
            "calcification.x[2]: 0.019 m; allowed: at most the artery",
        ),
    ],
    ids=["limit", "unreachable", "no effect", "alike", "failing start", "refused start"],
)
def test_what_cannot_be_fitted_is_said(calibration_of, tmp_path, capsys, parameters, targets, sections, said):
    variant = sections.pop("variant", "none") if "variant" in sections else "none"
    path = calibration_of(parameters, targets, variant, **sections)
    assert calibrate.main([str(path), "--output", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert said in told
    assert str(path) in told
    assert not (tmp_path / "out").exists()


def test_a_target_that_no_value_attains(calibration_of):
    """Pulse pressure falls to no less than what friction and inertia need, whatever the offset."""
    pulse = {"quantity": "pulse_pressure", "value": "8 kPa", "at": "outlet"}
    bounds = {"outlet.offset": {"low": "-3 kPa", "high": "16 kPa"}}
    with pytest.raises(
        ValidationError, match=r"ends on its limit|cannot be attained; pulse pressure, outlet"
    ):
        fitted(calibration_of(bounds, [pulse]))


def test_the_fitted_case_keeps_its_comments_and_other_variants(calibration_of, tmp_path):
    path = calibration_of(OUTLET, PRESSURES)
    case = tmp_path / "small.yaml"
    case.write_text(f"# mine\n{case.read_text()}")
    target = tmp_path / "fitted.yaml"
    options = ["--output", str(tmp_path / "out"), "--case", str(target)]
    assert calibrate.main([str(path), *options]) == 0
    assert target.read_text().startswith("# mine\n")
    record = json.loads((tmp_path / "out/calibration.json").read_text())
    keys = numeric_keys(load_case_file(target).variants["none"])
    for each in record["parameters"]:
        assert keys[each["key"]].value == each["value"]
    stated = YAML().load((tmp_path / "out/calibration.yaml").read_text())
    assert stated["outlet"]["offset"] == f"{record['parameters'][1]['value']!r} Pa"
    assert {each.name for each in tmp_path.iterdir() if each.name.startswith(".")} == set()


def test_a_value_of_a_variant_stays_in_it_and_a_list_whole(calibration_of, tmp_path):
    bounds = {"calcification.x[2]": {"low": "6 mm", "high": "14 mm"}}
    calibration = load_calibration(calibration_of(bounds, PRESSURES[:1], "axisymmetric"))
    assert YAML().load(snippet(calibration, np.array([0.008])))["calcification"]["x"] == ["5 mm", "0.008 m"]
    target = tmp_path / "fitted.yaml"
    write_case(target, calibration, np.array([0.008]))
    content = YAML().load(target.read_text())
    assert content["calcification"] == {"pattern": "none"}
    assert content["variants"]["axisymmetric"]["calcification"]["x"] == ["5 mm", "0.008 m"]


@pytest.mark.parametrize("where", ["itself", "elsewhere", "nowhere"])
def test_a_case_that_cannot_be_written_is_refused_at_once(
    calibration_of, tmp_path, capsys, monkeypatch, where
):
    path = calibration_of(OUTLET, PRESSURES)
    said = {
        "itself": "is the case file itself; choose another --case",
        "elsewhere": "inlet.csv: no such file; looked for in",
        "nowhere": "cannot be written: No such file or directory",
    }[where]
    target = tmp_path / {"itself": "small.yaml", "elsewhere": "new.yaml", "nowhere": "none/new.yaml"}[where]
    if where == "elsewhere":
        deep = tmp_path / "deep"
        deep.mkdir()
        own = YAML().load((tmp_path / "small.yaml").read_text())
        (deep / "inlet.csv").write_text(Path(own["inlet"]["waveform"]).read_text())
        own["inlet"]["waveform"] = "inlet.csv"
        written(own, deep)
        path.write_text(path.read_text().replace(str(tmp_path / "small.yaml"), str(deep / "small.yaml")))
    monkeypatch.setattr(
        "validation.calibrate.calibration.calibrated", lambda *_: pytest.fail("it was computed")
    )
    assert calibrate.main([str(path), "--output", str(tmp_path / "out"), "--case", str(target)]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert message.count("\n") == 1
    assert ("allowed as --case: " in message) == (where == "elsewhere")
    assert not (tmp_path / "out").exists()
    assert not [each for each in tmp_path.iterdir() if each.name.startswith(".")]


def test_numbers_are_kept_where_the_case_cannot_be_written_any_more(calibration_of, tmp_path, monkeypatch):
    def gone(path, *_):
        raise ValidationError(f"{path}: cannot be written")

    monkeypatch.setattr("validation.calibrate.fitted_case.write_case", gone)
    path = calibration_of(OUTLET, PRESSURES)
    options = ["--output", str(tmp_path / "out"), "--case", str(tmp_path / "new.yaml")]
    assert calibrate.main([str(path), *options]) == 2
    assert json.loads((tmp_path / "out/calibration.json").read_text())["parameters"]


def test_an_interrupt_leaves_nothing(calibration_of, tmp_path, capsys, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("validation.calibrate.fit.run_batch", interrupted)
    path = calibration_of(OUTLET, PRESSURES)
    assert calibrate.main([str(path), "--output", str(tmp_path / "out")]) == 130
    assert capsys.readouterr().err == "interrupted; no result was written\n"
    assert not (tmp_path / "out").exists()


def test_a_file_where_the_folder_should_be(calibration_of, tmp_path, capsys):
    path = calibration_of({"outlet.offset": OUTLET["outlet.offset"]}, PRESSURES[:1])
    assert calibrate.main([str(path), "--output", str(path)]) == 2
    assert "cannot be written" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("option", "place", "said"),
    [
        ("--case", "calibration.yaml", "is the calibration file itself; choose another --case"),
        ("--case", "inlet.csv", "is a file that the case names; choose another --case"),
        ("--case", "notes.yaml", "was not written by a calibration; remove it or choose another --case"),
        ("--case", "out/calibration.yaml", "is a file of the result; choose another --case"),
        ("--output", ".", "calibration.yaml: is the calibration file itself; choose another --output"),
        ("--output", "taken", "is no result of a calibration; remove it or choose another --output"),
    ],
)
def test_no_file_that_is_there_is_replaced(
    calibration_of, tmp_path, capsys, monkeypatch, option, place, said
):
    own = Path(small_case("none")["inlet"]["waveform"])
    (tmp_path / "inlet.csv").write_text(own.read_text())
    path = calibration_of(OUTLET, PRESSURES, inlet={"waveform": "inlet.csv"})
    for folder in ("out", "taken"):
        (tmp_path / folder).mkdir()
    (tmp_path / "notes.yaml").write_text("mine: true\n")
    (tmp_path / "taken/calibration.yaml").write_text("mine: true\n")
    before = {each: each.read_bytes() for each in tmp_path.rglob("*") if each.is_file()}
    monkeypatch.setattr(
        "validation.calibrate.calibration.calibrated", lambda *_: pytest.fail("it was computed")
    )
    chosen = {"--output": str(tmp_path / "out"), option: str(tmp_path / place)}
    assert calibrate.main([str(path), *(word for pair in chosen.items() for word in pair)]) == 2
    assert said in capsys.readouterr().err
    assert {each: each.read_bytes() for each in tmp_path.rglob("*") if each.is_file()} == before


def test_a_case_that_a_calibration_wrote_may_be_replaced(calibration_of, tmp_path):
    calibration = load_calibration(calibration_of(OUTLET, PRESSURES))
    target = tmp_path / "fitted.yaml"
    for offset in (9000.0, 9500.0):
        check_case(target, calibration)
        write_case(target, calibration, np.array([1e9, offset]))
    assert numeric_keys(load_case_file(target).variants["none"])["outlet.offset"].value == 9500.0


def test_a_value_of_the_first_model_stays_in_it(calibration_of, tmp_path):
    path = calibration_of(MATERIAL, [RADIUS])
    content = YAML().load(tmp_path / "small.yaml")
    content["models"] = {"soft": {"wall": {"youngs_modulus": "0.5 MPa"}}, "as_stated": None}
    written(content, tmp_path)
    calibration = load_calibration(path)
    assert calibration.parameters[0].start == 5e5
    target = tmp_path / "fitted.yaml"
    write_case(target, calibration, np.array([7e5]))
    moduli = {name: each["none"].wall.youngs_modulus for name, each in load_case_file(target).models.items()}
    assert moduli == {"soft": 7e5, "as_stated": 6e5}


def test_a_limit_far_below_a_value_is_not_where_it_ends(calibration_of):
    bounds = {"wall.youngs_modulus": {"low": "1 Pa", "high": "1e13 Pa"}}
    _, found = fitted(calibration_of(bounds, [RADIUS | {"value": "2.8 mm"}]))
    np.testing.assert_allclose(found.attained, 2.8e-3, rtol=1e-6)


def test_limits_decades_apart_do_not_widen_the_differences(calibration_of):
    """A thousandth of the wide range would be four times the radius."""
    target = [RADIUS | {"uncertainty": "0.01 mm"}]
    _, wide = fitted(calibration_of({"geometry.radius": {"low": "1 um", "high": "10 m"}}, target))
    _, narrow = fitted(calibration_of({"geometry.radius": {"low": "2 mm", "high": "3 mm"}}, target))
    np.testing.assert_allclose(wide.values, narrow.values, rtol=1e-5)
    np.testing.assert_allclose(wide.standard_errors, narrow.standard_errors, rtol=1e-2)
