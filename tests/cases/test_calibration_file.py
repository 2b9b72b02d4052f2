"""Calibration files: what they state, and every way to state it wrongly."""

import pytest

from cases.errors import CaseFileError
from cases.reading.calibration_file import changed_values, load_calibration
from cases.reading.case_file import load_case_file
from cases.reading.numeric_keys import numeric_keys
from cases.reading.template import case_with

CASE = """\
name: short
geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}
blood: {density: 1060 kg/m^3, viscosity: 0.003 Pa s}
wall: {law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}
calcification: {pattern: none}
inlet: {kind: velocity, value: 8 cm/s}
outlet: {kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}
solver: {scheme: semi_implicit, n_x: 12, n_phi: 8, time_step: 2 ms, cycles: 1, closure: average}
variants:
  healthy: {title: Healthy}
  patch:
    calcification:
      {pattern: local, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], phi: [135 deg, 225 deg], transition: sharp}
"""
CALIBRATION = """\
name: outlet
case: short.yaml
variant: patch
parameters:
  outlet.resistance: {low: 1e8 Pa s/m^3, high: 1e11 Pa s/m^3}
  outlet.offset: {low: 0 kPa, high: 15 kPa, start: 70 mmHg}
targets:
  - {quantity: systolic_pressure, value: 120 mmHg}
  - {quantity: diastolic_pressure, value: 80 mmHg, at: outlet}
  - {quantity: largest_radius, value: 2.8 mm, at: 7.5 mm}
"""


@pytest.fixture
def write(tmp_path):
    """Write the calibration, changed, beside its case; the replacements must all be found."""
    (tmp_path / "short.yaml").write_text(CASE)

    def written(*replacements):
        text = CALIBRATION
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "calibration.yaml"
        path.write_text(text)
        return path

    return written


def test_everything_is_read_in_si_units(write):
    found = load_calibration(write())
    resistance, offset = found.parameters
    assert (resistance.key.name, resistance.low, resistance.high) == ("outlet.resistance", 1e8, 1e11)
    assert resistance.start == 1.358e9  # the case's own
    assert offset.start == pytest.approx(9332.57, abs=0.01)
    assert [target.at for target in found.targets] == ["artery", "outlet", 0.0075]
    assert found.targets[0].value == pytest.approx(15998.7, abs=0.1)
    assert found.targets[2].value == pytest.approx(2.8e-3)
    assert (found.name, found.title, found.variant) == ("outlet", "outlet", "patch")
    assert found.case == load_case_file(found.file.path).variants["patch"]


def test_the_only_variant_need_not_be_named(write, tmp_path):
    path = write(("variant: patch\n", ""))
    (tmp_path / "short.yaml").write_text(CASE.partition("variants:")[0])
    assert load_calibration(path).variant == "base"


def test_a_reference_takes_the_targets_place(write, tmp_path):
    targets = CALIBRATION[CALIBRATION.index("targets:") :]
    path = write((targets, "reference: {quantity: section_pressure, at: [outlet, 5 mm]}\n"))
    with pytest.raises(CaseFileError, match="reference: the case states none; allowed: targets"):
        load_calibration(path)
    named = "reference: {kind: febio, plot_file: run.xplt, axis: z, lumen: [A], wall: [B]}\n"
    (tmp_path / "run.xplt").touch()
    (tmp_path / "short.yaml").write_text(CASE.replace("variants:", f"{named}variants:"))
    found = load_calibration(path)
    assert found.reference.at == ("outlet", 0.005)
    assert found.targets == ()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("name: outlet", "name: outlet\ncases: 1", "line 2: cases: unknown key cases; did you mean case"),
        ("case: short.yaml", "case: none.yaml", "line 2: case: none.yaml: no such file"),
        ("case: short.yaml\n", "", "case: missing; allowed: the path of a file"),
        ("variant: patch", "variant: path", "line 3: variant: path; did you mean patch? allowed: healthy"),
        ("variant: patch\n", "", "variant: missing; allowed: healthy, patch"),
        (
            "outlet.resistance",
            "outlet.resistanse",
            "line 5: parameters: unknown key outlet.resistanse; did you mean outlet.resistance? allowed",
        ),
        ("outlet.resistance", "solver.n_x", "line 5: parameters: unknown key solver.n_x"),
        ("low: 0 kPa", "low: 0", "line 6: parameters.outlet.offset.low: 0: no unit; allowed: a pressure"),
        ("low: 0 kPa, ", "", "line 6: parameters.outlet.offset.low: missing"),
        (
            "low: 0 kPa",
            "low: 20 kPa",
            "line 6: parameters.outlet.offset: low 20000, high 15000; allowed",
        ),
        ("start: 70 mmHg", "start: 20 kPa", "parameters.outlet.offset: start 20000; allowed: from low (0)"),
        ("high: 1e11", "high: 1e9", "the case's own value 1.358e+09; allowed: from low (1e+08) to high"),
        ("start: 70 mmHg", "begin: 70 mmHg", "unknown key begin; allowed: low, high, start"),
        (
            "{low: 1e8 Pa s/m^3, high: 1e11 Pa s/m^3}",
            "1e9 Pa s/m^3",
            "line 5: parameters.outlet.resistance: 1e9 Pa s/m^3; allowed: a section with the keys low, high",
        ),
        ("outlet.resistance", "blood.density", "parameters.blood.density.low: 1e8 Pa s/m^3: Pa s/m^3 is no"),
        ("systolic_pressure", "systole", "line 8: targets[1].quantity: systole; allowed: systolic_pressure"),
        ("value: 120 mmHg", "value: 120 mm", "targets[1].value: 120 mm: mm is no unit of pressure; allowed"),
        ("value: 120 mmHg", "value: -1 kPa", "targets[1].value: -1 kPa; allowed: a pressure from 1 Pa to"),
        ("value: 120 mmHg", "value: 1e-300 Pa", "targets[1].value: 1e-300 Pa; allowed: a pressure from 1 Pa"),
        ("at: 7.5 mm", "at: 7.5 mm, uncertainty: 1e300 m", "allowed: from 1e-06 to 10 times the value"),
        ("at: 7.5 mm", "at: 7.5 mm, uncertainty: 1e-300 m", "allowed: from 1e-06 to 10 times the value"),
        ("at: outlet", "at: exit", "targets[2].at: exit; allowed: artery (all of it), inlet, outlet, or a"),
        ("at: 7.5 mm", "at: 16 mm", "line 10: targets[3].at: 0.016 m; allowed: from 0 m to the artery's"),
        ("at: 7.5 mm", "at: 7.5 mm, uncertainty: 1 um", "targets: some without uncertainty; allowed: all"),
        ("  - {quantity: largest", "#", "targets"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(write, old, new, said):
    path = write((old, new))
    if new == "#":  # one target for two parameters
        path.write_text(path.read_text().replace("  - {quantity: diastolic", "#"))
        said = "line 7: targets: 1 for 2 parameters; allowed: as many as parameters, or more"
    with pytest.raises(CaseFileError) as caught:
        load_calibration(path)
    assert said in str(caught.value)
    assert str(path) in str(caught.value)


@pytest.mark.parametrize("stated", ["", "parameters: []\n", "parameters: {}\n"])
def test_parameters_are_needed(write, stated):
    first, last = CALIBRATION.index("parameters:"), CALIBRATION.index("targets:")
    with pytest.raises(CaseFileError, match=r"parameters: .*allowed: a section with low and high"):
        load_calibration(write((CALIBRATION[first:last], stated)))


def test_targets_or_a_reference_are_needed(write):
    targets = CALIBRATION[CALIBRATION.index("targets:") :]
    with pytest.raises(CaseFileError, match="targets: neither targets nor a reference; allowed: one of them"):
        load_calibration(write((targets, "")))
    with pytest.raises(CaseFileError, match="both targets and a reference"):
        load_calibration(write((targets, f"{targets}reference: {{quantity: radius}}\n")))


def test_what_is_wrong_with_the_case_is_its_own_error(write, tmp_path):
    path = write()
    (tmp_path / "short.yaml").write_text(CASE.replace("2.5 mm", "2.5"))
    with pytest.raises(CaseFileError, match=r"short.yaml, line 2: geometry.radius: 2.5: no unit"):
        load_calibration(path)


def test_every_number_of_a_case_is_stated_as_it_is_read(write):
    found = load_calibration(write())
    keys = [key for key in numeric_keys(found.case).values() if key.value is not None and not key.whole]
    assert {"calcification.phi[2]", "blood.viscosity", "wall.poisson_ratio"} <= {key.name for key in keys}
    same = case_with(found.template, changed_values(keys, [key.value for key in keys]))
    assert {n: k.value for n, k in numeric_keys(same).items()} == {
        n: k.value for n, k in numeric_keys(found.case).items()
    }


def test_numbers_keep_all_their_digits(write):
    key = load_calibration(write()).parameters[1].key
    assert key.stated(0.1 + 0.2) == "0.30000000000000004 Pa"
