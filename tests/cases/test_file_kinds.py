from pathlib import Path

import pytest

from cases.command import main
from cases.errors import CaseFileError
from cases.reading.calibration_file import load_calibration
from cases.reading.case_file import load_case_file

SHIPPED = Path(__file__).parents[2] / "cases"


@pytest.mark.parametrize(
    ("name", "called", "command"),
    [
        ("sweep.yaml", "the study of a sweep (it states 'base')", "validation.sweep"),
        (
            "calibration_of_outlet.yaml",
            "a calibration file (it states 'case')",
            "validation.calibrate",
        ),
    ],
)
def test_another_kind_of_file_is_no_case_file(name, called, command, capsys):
    path = SHIPPED / name
    assert main([str(path)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert lines == [f"{path}: is {called}; allowed: a case file; to run it: python -m {command} {path}"]


@pytest.mark.parametrize(("name", "called"), [("thesis.yaml", "a case file"), ("sweep.yaml", "the study")])
def test_another_kind_of_file_is_no_calibration_file(name, called):
    with pytest.raises(CaseFileError, match=f"is {called}.*; allowed: a calibration file; to run it: "):
        load_calibration(SHIPPED / name)


def test_a_case_file_with_a_key_of_another_kind_is_judged_as_a_case(folder):
    path = folder.write(("name: ", "base: x.yaml\nname: "))
    with pytest.raises(CaseFileError, match="unknown key base"):
        load_case_file(path)


def test_a_file_of_no_kind_is_judged_as_what_is_wanted(tmp_path):
    path = tmp_path / "x.yaml"
    path.write_text("name: x\n", encoding="utf-8")
    with pytest.raises(CaseFileError, match="geometry: missing"):
        load_case_file(path)
