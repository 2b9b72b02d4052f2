"""`python -m validation.compare` again: told where nothing has changed, computed where anything has."""

import json
import shutil

import pytest
from small_case import IMPOSSIBLE, written

from reports.result.load import load
from validation.compare import command as compare
from validation.runs.provenance import checksum


class ComputedError(Exception):
    pass


def compute(*_):
    raise ComputedError


@pytest.fixture
def again(tmp_path, monkeypatch, quick, made, capsys):
    """Run a finished comparison again, where computing is an error; the case, and what the first run said."""
    case = made(IMPOSSIBLE)
    case["inlet"]["waveform"] = shutil.copy(case["inlet"]["waveform"], tmp_path / "inlet.csv").name
    case["solver"] |= {"n_x": 6, "n_phi": 4}
    case["compare"]["cells"] = {"i": [1, 6], "j": [1]}
    path = written(case, tmp_path)
    monkeypatch.chdir(tmp_path)

    def run(*options):
        return compare.main([path.name, "--output", "result", *options])

    assert run() == 0
    said = capsys.readouterr()
    monkeypatch.setattr("validation.compare.case.compare_case", compute)
    return run, path, said


def test_nothing_is_computed_where_nothing_has_changed(again, capsys, tmp_path):
    run, _, first = again
    files = {path: path.stat().st_mtime_ns for path in (tmp_path / "result").iterdir()}
    created = json.loads((tmp_path / "result/provenance.json").read_text())["created"]
    assert (run(), run("--check")) == (0, 1)
    said = capsys.readouterr()
    name, rest = first.out.split(": ", 1)
    assert said.out == 2 * f"{name}: nothing has changed since {created}: {rest}"
    assert said.err == 2 * first.err
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "result").iterdir()} == files


def appended(name):
    def change(folder, _):
        with (folder / name).open("a") as stream:
            stream.write("\n")

    return change


def replaced(path):
    path.unlink(missing_ok=True)
    path.mkdir()


CHANGES = {
    "the case": appended("small.yaml"),
    "a file that it reads": appended("inlet.csv"),
    "a file of the result": appended("result/metrics.csv"),
    "a folder in the place of a file": lambda folder, _: replaced(folder / "result/report.pdf"),
    "a link to nowhere": lambda folder, _: (folder / "result/report.pdf").symlink_to("nowhere"),
    "files that name others": lambda _, patch: patch.setattr(
        "validation.compare.unchanged.NAMING_OTHERS", (".csv",)
    ),
    "a file less": lambda folder, _: (folder / "result/comparison.nc").unlink(),
    "a damaged list of checksums": lambda folder, _: (folder / "result/checksums.json").write_text("{}"),
    "none": lambda folder, _: (folder / "result/checksums.json").unlink(),
    "the code": lambda _, patch: patch.setattr("validation.compare.unchanged._code", lambda: "other"),
    "from outside": lambda _, patch: patch.setattr("validation.compare.unchanged.PACKAGES", ("solver",)),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=list(CHANGES))
def test_any_change_is_computed(again, change, tmp_path, monkeypatch):
    change(tmp_path, monkeypatch)
    with pytest.raises(ComputedError):
        again[0]()


def test_fresh_computes(again):
    with pytest.raises(ComputedError):
        again[0]("--fresh")


def test_what_changes_while_it_is_computed_is_not_sealed(again, tmp_path, monkeypatch):
    (tmp_path / "result/checksums.json").unlink()
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)

    def meanwhile(_):
        appended("inlet.csv")(tmp_path, None)

    monkeypatch.setattr("validation.compare.case.write_reports", meanwhile)
    assert again[0]() == 0
    assert not (tmp_path / "result/checksums.json").exists()


def test_a_result_tells_the_case_file_that_was_read(again, tmp_path, monkeypatch):
    (tmp_path / "result/checksums.json").unlink()
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    before = checksum(again[1])

    def meanwhile(directory):
        again[1].write_text(again[1].read_text() + "\n# edited while it was computed\n")
        load(directory)

    monkeypatch.setattr("validation.compare.case.write_reports", meanwhile)
    assert again[0]() == 0
    told = json.loads((tmp_path / "result/provenance.json").read_text(encoding="utf-8"))
    assert told["case"]["sha256"] == before
