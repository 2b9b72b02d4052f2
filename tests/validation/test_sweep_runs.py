"""Sweeps: their numbers are those of ordinary runs, and of a comparison; an interrupted one ends the same."""

import errno
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from pandas.testing import assert_frame_equal
from small_case import ROOT, small_case, written
from small_sweep import GRID, records, small_study, study_file, swept

from cases.reading.case_file import load_case_file
from febio_io.errors import FebioError
from reports.errors import ReportError
from reports.sweep.folder import load_sweep
from solver.case.run import run_case
from validation.ablation.ladder import coupled_model
from validation.compare import command as compare
from validation.errors import ValidationError
from validation.metrics.statistics import rms
from validation.sweep import page, run
from validation.sweep.command import main
from validation.sweep.folder import PAGE_FILES, claimed
from validation.sweep.page import up_to_date_page

pytestmark = pytest.mark.slow

MODULUS = "calcification.youngs_modulus"
ONE = {MODULUS: ["10 MPa"]}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """An uninterrupted sweep of six samples in three parts, two samples refused."""
    folder = tmp_path_factory.mktemp("whole")
    return small_study(folder), swept(small_study(folder), folder / "out"), folder / "out"


def account(folder):
    return json.loads((folder / "study.json").read_text(encoding="utf-8"))


def write_account(folder, content):
    (folder / "study.json").write_text(json.dumps(content), encoding="utf-8")


def test_every_sample_is_recorded_once_and_failures_say_why(whole):
    study, found, folder = whole
    assert found["sample"].tolist() == list(range(6))
    assert found["status"].tolist() == ["ok", "ok", "failed"] * 2
    assert found[MODULUS].tolist() == [1e6] * 3 + [1e7] * 3
    assert found["error"].isna().tolist() == [True, True, False] * 2
    assert found["error"][2].startswith("calcification.x[1]: ")
    names = [output.name for output in study.outputs]
    assert found[names].notna().all(axis=1).tolist() == [True, True, False] * 2
    assert sorted(path.name for path in (folder / "samples").iterdir()) == [
        f"part-{number:06d}.parquet" for number in range(3)
    ]


def test_the_account_tells_what_the_page_needs(whole):
    study, _, folder = whole
    found = account(folder)
    assert (found["state"], found["sensitivity"]) == ("finished", None)
    assert found["counts"] == {"done": 6, "failed": 2, "total": 6}
    assert found["design"]["kind"] == "grid"
    assert [one["name"] for one in found["parameters"]] == list(GRID)
    assert found["parameters"][1]["unit"] == "mm"
    assert found["parameters"][1]["base"] == pytest.approx(5e-3)
    assert {one["name"] for one in found["outputs"]} == {output.name for output in study.outputs}
    assert (folder / "study.yaml").read_text(encoding="utf-8") == study.text


def test_outputs_are_those_of_the_ordinary_run(whole):
    study, found, _ = whole
    case = study.cases["local"]
    period = case.inlet.period
    last = run_case(case, np.linspace(0.0, period, 101))
    row = found.iloc[4]  # 10 MPa over 5 mm: the case itself
    pressure, radius = last["section_pressure"].to_numpy(), last["radius"].to_numpy()
    assert row["systolic_pressure_inlet"] == pytest.approx(pressure[:, 0].max(), rel=1e-9)
    assert row["diastolic_pressure_outlet"] == pytest.approx(pressure[:, -1].min(), rel=1e-9)
    assert row["mean_pressure_inlet"] == pytest.approx(np.trapezoid(pressure[:, 0], dx=0.01), rel=1e-9)
    ends = last.isel(time=[0, -1])
    drifts = [
        float(np.abs(v[1] - v[0]).max() / np.abs(v[0]).max())
        for v in (ends["pressure"], ends["section_flow_rate"])
    ]
    assert row["cycle_change"] == pytest.approx(max(drifts), rel=1e-6)
    flow = last["section_flow_rate"].to_numpy()[:, 6]
    assert row["flow_amplitude"] == pytest.approx(np.ptp(flow), rel=1e-9)
    section = int(np.argmin(np.abs(last["x"].to_numpy() - 7.5e-3)))
    growths = radius[:, section].max(axis=0) / radius[:, section].min(axis=0) - 1.0
    assert row["radius_change_calcified"] == pytest.approx(growths.min(), rel=1e-9)
    mean = radius[:, section].mean(axis=1)
    assert row["radius_change"] == pytest.approx(mean.max() / mean.min() - 1.0, rel=1e-9)


def test_errors_against_3d_are_those_of_a_comparison(tmp_path, quick, known_runs):
    path = written(small_case("local"), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "compared")]) == 0
    metrics = pd.read_csv(tmp_path / "compared/metrics.csv").query("band.notna()")
    limits = {f"{row.quantity}_{row.statistic}": (row.error, row.band) for row in metrics.itertuples()}
    study = small_study(tmp_path, parameters=ONE, against="reference")
    found = swept(study, tmp_path / "out")
    declared = {one["name"]: one["band"] for one in account(tmp_path / "out")["outputs"] if one["band"]}
    assert limits.keys() == declared.keys() == {"section_flow_rate_rms_error", "radius_rms_error"}
    for name, (error, limit) in limits.items():
        assert found[name][0] == pytest.approx(error, rel=1e-9)
        assert declared[name]["limit"] == limit


def test_errors_against_the_coupled_model_are_those_of_two_runs(tmp_path):
    study = small_study(tmp_path, parameters=ONE, against="coupled", outputs=["radius_rms_error"])
    found = swept(study, tmp_path / "out")
    case = study.cases["local"]
    times = np.linspace(0.0, case.inlet.period, 101)
    own, other = (run_case(each, times)["radius"].to_numpy() for each in (case, coupled_model(case)))
    assert found["radius_rms_error"][0] == pytest.approx(rms(own / other - 1.0), rel=1e-9)
    assert found["radius_rms_error"][0] > 1e-3


def test_a_run_that_fails_is_recorded_with_the_solvers_words(tmp_path):
    parameters = {"outlet.offset": ["9330 Pa", "-300 kPa"]}
    found = swept(small_study(tmp_path, parameters=parameters), tmp_path / "out")
    assert found["status"].tolist() == ["ok", "failed"]
    assert found["error"][1].startswith("the lumen collapses at P = ")


def test_a_limit_that_is_exceeded_ends_its_sample_alone(tmp_path):
    overrides = {"solver": {"limits": {"advective_courant_number": 1.5}}}
    study = small_study(tmp_path, parameters={"inlet.scale": [0.5, 2.0]}, overrides=overrides)
    found = swept(study, tmp_path / "out")
    assert found["status"].tolist() == ["ok", "failed"]
    assert found["error"][1].startswith("the Courant number is above its limit at t = ")


@pytest.mark.parametrize("lost", [(0,), (1, 2)])
def test_a_sweep_that_goes_on_ends_as_one_that_was_not_interrupted(whole, tmp_path, monkeypatch, lost):
    study, expected, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    samples = tmp_path / "out/samples"
    for number in lost:
        (samples / f"part-{number:06d}.parquet").unlink()
    (samples / ".part-000000.parquet.1.part").write_bytes(b"half")
    kept = {path.name: path.stat().st_mtime_ns for path in samples.glob("part-*")}
    assert_frame_equal(swept(study, tmp_path / "out"), expected, check_exact=True)
    for name, time in kept.items():
        assert (samples / name).stat().st_mtime_ns == time
    assert not list(samples.glob(".*"))


def test_a_damaged_part_is_computed_again(whole, tmp_path):
    study, expected, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    part = tmp_path / "out/samples/part-000001.parquet"
    part.write_bytes(part.read_bytes()[:-20])
    assert_frame_equal(swept(study, tmp_path / "out"), expected, check_exact=True)


def one_bit_changed(content):
    """The bytes of a part with one bit of a stored modulus (1e7 Pa) changed, its metadata intact."""
    at = content.index(np.array([1e7]).tobytes())
    return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]


def test_a_part_with_a_changed_number_is_computed_again(whole, tmp_path):
    study, expected, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    part = tmp_path / "out/samples/part-000002.parquet"
    part.write_bytes(one_bit_changed(part.read_bytes()))
    with pytest.raises(ReportError, match=r"part-000002\.parquet: cannot be read as Parquet"):
        load_sweep(tmp_path / "out")
    assert_frame_equal(swept(study, tmp_path / "out"), expected, check_exact=True)


def test_a_part_without_some_columns_is_computed_again(whole, tmp_path):
    study, expected, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    part = tmp_path / "out/samples/part-000001.parquet"
    pd.read_parquet(part)[["sample", "status"]].to_parquet(part)
    assert_frame_equal(swept(study, tmp_path / "out"), expected, check_exact=True)


@pytest.mark.parametrize("name", ["notes.txt", "part-000099.parquet", "part-000001.parquet"])
def test_what_is_no_part_is_refused(whole, tmp_path, name):
    study, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    stray = tmp_path / "out/samples" / name
    stray.unlink(missing_ok=True)
    stray.mkdir()
    with pytest.raises(ValidationError, match=rf"{name}: no part of this sweep; allowed there: its \d parts"):
        swept(study, tmp_path / "out")


def test_a_finished_sweep_computes_nothing(whole, monkeypatch):
    study, expected, folder = whole
    monkeypatch.setattr("validation.sweep.missing.connected", None)  # whoever calls it fails
    assert_frame_equal(swept(study, folder), expected)


NOT_NEEDED = (
    *("SALib", "distributed", "jinja2", "matplotlib", "numba", "pandas", "pint", "pyvista"),
    *("rich", "scipy", "typst", "xarray"),
)
LOADED = """
import sys
from validation.sweep.command import main
main(sys.argv[1:])
print(*sorted(set(sys.modules) & {names}))
"""


def test_a_sweep_with_nothing_to_do_leaves_all_as_it_is_and_loads_little(whole, tmp_path, capsys):
    shutil.copytree(whole[2], tmp_path / "out")
    command = [str(study_file(tmp_path)), "--output", str(tmp_path / "out")]
    assert main(command) == 0
    said = capsys.readouterr().out
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in files(tmp_path / "out")}
    assert [path.name for path in before if path.suffix in (".html", ".pdf")] == list(PAGE_FILES)
    again = subprocess.run(  # noqa: S603
        [sys.executable, "-c", LOADED.format(names=set(NOT_NEEDED)), *command],
        env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert (again.stdout, again.stderr) == (f"{said}\n", "")
    assert before == {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in files(tmp_path / "out")}


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


def edit(path):
    path.write_bytes(path.read_bytes().replace(b"a", b"b", 1))


@pytest.mark.parametrize(
    "changed",
    [
        lambda folder, _: (folder / "index.html").unlink(),
        lambda folder, _: (folder / "index.pdf").write_bytes(b""),
        lambda folder, _: edit(folder / "index.html"),
        lambda folder, _: edit(folder / "study.yaml"),
        lambda folder, _: edit(folder / "samples/part-000000.parquet"),
        lambda folder, _: (folder / "samples/part-000000.parquet").unlink(),
        lambda folder, _: write_account(folder, account(folder) | {"title": "Another title"}),
        lambda folder, _: write_account(folder, account(folder) | {"page": None}),
        lambda _, patch: patch.setattr(page, "LIBRARIES", ("numpy",)),
        lambda _, patch: patch.setattr(page, "DRAWN_BY", ("cases",)),
    ],
)
def test_a_page_is_drawn_again_only_where_it_is_not_that_of_these_samples(
    whole, tmp_path, monkeypatch, changed
):
    drawn = []

    def draw(folder):
        drawn.append(folder)
        for name in PAGE_FILES:
            (folder / name).write_text("a page", encoding="utf-8")

    folder = tmp_path / "out"
    shutil.copytree(whole[2], folder)
    monkeypatch.setattr("reports.sweep.write_sweep_page", draw)
    for _ in range(2):
        assert up_to_date_page(folder) == folder / "index.html"
    assert len(drawn) == 1
    changed(folder, monkeypatch)
    for _ in range(2):
        up_to_date_page(folder)
    assert len(drawn) == 2


def test_another_study_is_refused_unless_fresh(whole, tmp_path, capsys):
    _, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    path = study_file(tmp_path, parameters=ONE)
    command = [str(path), "--output", str(tmp_path / "out"), "--scheduler", "threads", "--workers", "1"]
    assert main(command) == 2
    assert "holds a sweep of another study" in capsys.readouterr().err
    assert len(records(tmp_path / "out")) == 6
    assert main([*command, "--fresh"]) == 0
    assert "trial: 1 samples; page: " in capsys.readouterr().out
    assert len(records(tmp_path / "out")) == 1


def test_a_3d_run_that_is_not_there_is_said_before_another_study_is_refused_or_removed(whole, tmp_path):
    _, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    case = small_case("local")
    case["variants"]["local"]["reference"] = {"plot_file": "absent.xplt", "generate": {}}
    study = small_study(tmp_path, case=case, parameters=ONE, against="reference")
    for fresh in (False, True):
        with pytest.raises(ValidationError, match=r"absent\.xplt: not there yet; to make it:"):
            swept(study, tmp_path / "out", fresh=fresh)
    assert len(records(tmp_path / "out")) == 6


def test_a_3d_run_that_cannot_be_read_does_not_remove_the_earlier_sweep(whole, tmp_path):
    _, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    case = small_case("local")
    case["variants"]["local"]["reference"] = {"plot_file": "text.xplt"}
    (tmp_path / "text.xplt").write_text("time,pressure", encoding="utf-8")
    study = small_study(tmp_path, case=case, parameters=ONE, against="reference")
    with pytest.raises(FebioError, match=r"text\.xplt: not an FEBio plot file"):
        swept(study, tmp_path / "out", fresh=True)
    assert len(records(tmp_path / "out")) == 6


def test_words_do_not_make_another_study(whole, tmp_path, monkeypatch):
    _, expected, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    monkeypatch.setattr("validation.sweep.missing.connected", None)
    study = small_study(tmp_path, title="Another title")
    assert_frame_equal(swept(study, tmp_path / "out"), expected)
    assert account(tmp_path / "out")["title"] == "Another title"


def test_a_folder_of_other_things_and_one_in_use_are_refused(tmp_path):
    study = small_study(tmp_path)
    taken = tmp_path / "taken"
    taken.mkdir()
    (taken / "thesis.docx").write_text("mine", encoding="utf-8")
    with pytest.raises(ValidationError, match=r"holds other files than a sweep \(thesis\.docx\)"):
        swept(study, taken, fresh=True)
    with claimed(tmp_path / "busy"), pytest.raises(ValidationError, match="another sweep is writing there"):
        swept(study, tmp_path / "busy")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(ValidationError, match="file: cannot be written"):
        swept(study, tmp_path / "file")


@pytest.mark.parametrize(
    ("writer", "name"),
    [
        ("validation.sweep.account.write_text", "study.yaml"),
        ("validation.sweep.account.write_json", "study.json"),
        ("validation.sweep.folder.pq.write_table", "samples/part-000002.parquet"),
        ("reports.sweep.write_sweep_page", "index.html"),
    ],
)
def test_a_full_disk_is_one_message(whole, tmp_path, capsys, monkeypatch, writer, name):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    shutil.copytree(whole[2], tmp_path / "out")
    (tmp_path / "out/samples/part-000002.parquet").unlink()
    monkeypatch.setattr(writer, full)
    command = [str(study_file(tmp_path)), "--scheduler", "threads", "--workers", "1"]
    assert main([*command, "--output", str(tmp_path / "out")]) == 2
    said = f"{tmp_path / 'out' / name}: cannot be written: No space left on device\n"
    assert capsys.readouterr().err == said


def test_samples_of_which_nothing_tells_the_study_are_refused_unless_fresh(whole, tmp_path):
    _, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    (tmp_path / "out/study.json").unlink()
    other = GRID | {"calcification.youngs_modulus": ["2 MPa", "5 MPa"]}
    study = small_study(tmp_path, parameters=other)
    with pytest.raises(ValidationError, match=r"out: holds samples, but no study\.json .* --fresh"):
        swept(study, tmp_path / "out")
    found = swept(study, tmp_path / "out", fresh=True)
    assert set(found["calcification.youngs_modulus"]) == {2e6, 5e6}


@pytest.mark.parametrize("text", ["{", "[" * 100_000])
def test_an_account_that_is_damaged_is_refused(whole, tmp_path, text):
    study, _, folder = whole
    shutil.copytree(folder, tmp_path / "out")
    (tmp_path / "out/study.json").write_text(text, encoding="utf-8")
    with pytest.raises(ValidationError, match=r"study\.json: cannot be read: .* --fresh starts anew"):
        swept(study, tmp_path / "out")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--scheduler", "slurm"], "--scheduler slurm; allowed: processes, threads, or an address"),
        (["--workers", "0"], "0; allowed: 1, 2, …"),
    ],
)
def test_wrong_options_are_refused(tmp_path, capsys, arguments, message):
    path = study_file(tmp_path)
    try:
        status = main([str(path), *arguments])
    except SystemExit as stop:
        status = stop.code
    assert status == 2
    assert message in capsys.readouterr().err


def test_missing_libraries_are_named(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("validation.sweep.command.find_spec", lambda name: None)
    assert main([str(study_file(tmp_path))]) == 2
    assert "sweeps need distributed, locket, pyarrow, SALib; install them" in capsys.readouterr().err


def test_large_sweeps_have_larger_parts(whole):
    study, _, _ = whole
    assert run.chunk_size(study, 10**6) == 2
    (free,) = [study.__class__(**(vars(study) | {"chunk": None}))]
    assert [run.chunk_size(free, total) for total in (1, 1000, 10_000, 10**6)] == [8, 8, 20, 64]


def test_the_case_file_is_not_needed_any_more_than_its_numbers(tmp_path):
    """Another title of the case, or its own bands' reasons, leave the numbers as they are."""
    study = small_study(tmp_path, parameters=ONE)
    expected = swept(study, tmp_path / "out")
    case = small_case("local")
    case["title"] = "Another title"
    again = small_study(tmp_path, parameters=ONE, case=case)
    assert_frame_equal(swept(again, tmp_path / "out"), expected)
    assert load_case_file(tmp_path / "small.yaml").title == "Another title"
