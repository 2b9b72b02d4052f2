import math
import os
from pathlib import Path

import pytest
from pydantic import ValidationError

from cases.errors import CaseError, CaseFileError
from cases.reading.case_file import load_case_file
from cases.sections.calcification import LocalCalcification
from cases.sections.case import Case


def test_the_ready_file_loads(ready_file):
    file = load_case_file(ready_file)
    assert file.name == "calcification"
    assert list(file.models) == ["row", "coupled"]
    row, coupled = (each["local"] for each in file.models.values())
    assert (row.wall.law, coupled.wall.law, coupled.wall.base) == ("thick", "membrane", "thick")
    assert (row.solver.pressure, coupled.solver.pressure) == ("row", "section")
    assert (row.uncertainty.method, coupled.uncertainty.method) == ("latin_hypercube", "local")
    assert list(file.variants) == ["none", "axisymmetric", "local"]
    for name, case in file.variants.items():
        assert case.reference.plot_file == ready_file.parents[1] / f"reference_data/febio/{name}.xplt"
        assert case.calcification.pattern == name
        assert case.inlet.period == 0.79733
        assert case.compare.cells.i == (1, 39, 61, 82, 120)
    local = file.variants["local"].calcification
    assert local.youngs_modulus == 10e6
    assert local.x == (0.005, 0.01)
    assert local.phi == pytest.approx((0.75 * math.pi, 1.25 * math.pi))


def test_values_are_si(folder):
    case = folder.load().variants["none"]
    assert case.geometry.model_dump() == {"length": 0.015, "radius": 0.0025, "wall_thickness": 0.0005}
    assert case.blood.model_dump() == {"density": 1060.0, "viscosity": 0.0035}
    assert case.wall.youngs_modulus == 600_000.0
    assert case.outlet.resistance == 1.358e9
    assert case.solver.time_step == 0.001
    assert case.compare.bands[0].limit == 0.01
    assert case.compare.bands[0].relative


def test_defaults(folder):
    case = folder.load().variants["none"]
    assert case.wall.reference_pressure == 0.0
    assert case.outlet.flow == "section"
    assert case.solver.output_interval is None
    assert case.reference.origin == (0.0, 0.0, 0.0)
    assert case.reference.time_offset == 0.0
    assert case.reference.lumen is None
    assert case.reference.wall is None
    assert case.compare.times == ("systole", "second trough", "end diastole")


def test_text_and_path_are_kept(folder):
    path = folder.write()
    file = load_case_file(str(path))
    assert file.path == path
    assert file.text == path.read_text()


def test_a_file_without_variants_holds_one_case(folder):
    text = folder.write().read_text()
    path = folder.path / "x.yaml"
    path.write_text(text[: text.index("variants:")])
    (case,) = load_case_file(path).variants.items()
    assert case[0] == "base"
    assert case[1].title == "An artery"


def test_a_case_is_frozen_and_hashable(folder):
    one, other = folder.load().variants["local"], folder.load().variants["local"]
    assert one == other
    assert hash(one) == hash(other)
    with pytest.raises(ValidationError, match="frozen"):
        one.geometry.length = 1.0


def test_a_case_can_be_written_as_json(folder):
    case = folder.load().variants["local"]
    stated = case.model_dump(mode="json")
    assert stated["inlet"]["waveform"] == {"times": [0.0, 0.3, 0.8], "values": [0.1, 0.2, 0.1]}
    assert stated["calcification"]["x"] == [0.005, 0.01]


def test_a_byte_order_mark_and_crlf_do_not_matter(folder):
    text = folder.write().read_text()
    path = folder.path / "x.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    assert load_case_file(path).variants == folder.load().variants


@pytest.mark.parametrize(("axis", "default"), [("x", "y"), ("y", "z"), ("z", "x")])
def test_phi_starts_at_the_next_axis(folder, axis, default):
    assert folder.load(("axis: z", f"axis: {axis}")).variants["none"].reference.phi_zero == default


def test_a_constant_inlet_has_a_period_of_its_own(folder):
    waveform = "waveform: data/inlet.csv"
    inlet = folder.load((waveform, "value: 8.41199 cm/s")).variants["none"].inlet
    assert (inlet.value, inlet.waveform, inlet.period) == (0.0841199, None, 1.0)
    inlet = folder.load((waveform, "value: 8 cm/s, period: 0.5 s")).variants["none"].inlet
    assert inlet.period == 0.5


@pytest.mark.parametrize(
    ("n_x", "n_phi", "i", "j"),
    [
        (120, 48, (1, 39, 61, 82, 120), (4, 15, 25)),
        (240, 24, (1, 77, 122, 164, 240), (2, 8, 13)),
        (60, 1, (1, 20, 31, 41, 60), (1,)),
        (3, 4, (1, 2, 3), (1, 2, 3)),
    ],
)
def test_default_cells_move_to_the_grid(folder, n_x, n_phi, i, j):
    transition = ("pattern: local", "pattern: axisymmetric")
    angles = ("      phi: [135 deg, 225 deg]\n", "")
    case = folder.load(("n_x: 120", f"n_x: {n_x}"), ("n_phi: 48", f"n_phi: {n_phi}"), transition, angles)
    assert case.variants["none"].compare.cells.i == i
    assert case.variants["none"].compare.cells.j == j


def test_stated_cells_stay_as_stated(folder):
    case = folder.load(("compare:", "compare:\n  cells: {i: [7]}"), ("n_phi: 48", "n_phi: 24")).variants[
        "none"
    ]
    assert case.compare.cells.i == (7,)
    assert case.compare.cells.j == (2, 8, 13)


def test_times_are_events_or_seconds(folder):
    case = folder.load(("compare:", "compare:\n  times: [first trough, 0.3 s, 0 s]")).variants["none"]
    assert case.compare.times == ("first trough", 0.3, 0.0)


def test_a_band_of_differences_carries_the_unit_of_its_quantity(folder):
    edits = (("rms_error", "max_difference"), ("limit: 1 %", "limit: 10 µm\n      variants: [local]"))
    (band,) = folder.load(*edits).variants["local"].compare.bands
    assert band.limit == 1e-5
    assert not band.relative
    assert band.variants == ("local",)


@pytest.mark.parametrize(("stated", "limit"), [("2 %", 0.02), ("150 %", 1.5), ("0.99", 0.99), ("100%", 1.0)])
def test_a_relative_limit_is_a_percentage_or_a_ratio(folder, stated, limit):
    (band,) = folder.load(("limit: 1 %", f"limit: {stated}")).variants["none"].compare.bands
    assert band.limit == limit


def test_a_difference_of_exponents_has_no_unit(folder):
    edits = (("quantity: radius", "quantity: profile_exponent"), ("rms_error", "rms_difference"))
    (band,) = folder.load(*edits, ("limit: 1 %", "limit: 2")).variants["none"].compare.bands
    assert band.limit == 2.0
    (problem,) = folder.problems(*edits, ("limit: 1 %", "limit: 0"))
    assert problem == "x.yaml, line 24: compare.bands[1].limit: 0; allowed: a positive number"


CONSTANT = ("waveform: data/inlet.csv", "value: 8 cm/s")


def test_a_constant_inlet_is_compared_at_the_end_of_the_cycle(folder):
    assert folder.load(CONSTANT).variants["none"].compare.times == ("end diastole",)
    stated = ("compare:", "compare:\n  times: [0.3 s, end diastole]")
    assert folder.load(CONSTANT, stated).variants["none"].compare.times == (0.3, "end diastole")


@pytest.mark.parametrize("event", ["systole", "first trough", "second trough"])
def test_a_constant_inlet_has_no_pulse_to_compare(folder, event):
    assert folder.problems(CONSTANT, ("compare:", f"compare:\n  times: [0.3 s, {event}]")) == [
        (
            f"x.yaml, line 21: compare.times[2]: {event}: a constant inlet has none; "
            'allowed: end diastole, or a time into the last cycle, e.g. "0.3 s"'
        )
    ]


@pytest.mark.parametrize(("stated", "found"), [("data/new.xplt", "data/new.xplt"), ("a/b.xplt", "a/b.xplt")])
def test_a_reference_that_is_generated_need_not_exist_yet(folder, stated, found):
    edit = (
        "plot_file: data/run.xplt, axis: z",
        f"plot_file: {stated}, axis: z, log: data/new.log, generate: {{}}",
    )
    reference = folder.load(edit).variants["none"].reference
    assert reference.plot_file == folder.path / found
    assert reference.log == folder.path / "data/new.log"
    assert reference.generate.mesh == (24, 8, 3, 30)


def test_a_file_to_come_is_in_the_nearest_folder_that_has_its_own(folder):
    (folder.path / "deep").mkdir()
    (folder.path / "deep/x.yaml").write_bytes(
        folder.write(
            ("plot_file: data/run.xplt, axis: z", "plot_file: data/new.xplt, axis: z, generate: {}")
        ).read_bytes()
    )
    reference = load_case_file(folder.path / "deep/x.yaml").variants["none"].reference
    assert reference.plot_file == folder.path / "data/new.xplt"


def test_a_reference_may_have_a_log_and_data_records(folder):
    stated = (
        "axis: z, log: data/flow.csv, data_records: [{file: data/wall.csv, items: elements, columns: [fp]}]"
    )
    reference = folder.load(("axis: z", stated)).variants["none"].reference
    assert reference.log == folder.path / "data/flow.csv"
    (record,) = reference.data_records
    assert (record.items, record.columns) == ("elements", ("fp",))
    assert reference.files == (reference.plot_file, reference.log, folder.path / "data/wall.csv")
    assert folder.load().variants["none"].reference.files == (reference.plot_file,)


@pytest.mark.parametrize("phi", ["[225 deg, 135 deg]", "[0 deg, 360 deg]", "[0 rad, 1 rad]"])
def test_a_patch_may_cross_zero_or_go_all_round(folder, phi):
    calcification = folder.load(("[135 deg, 225 deg]", phi)).variants["local"].calcification
    assert isinstance(calcification, LocalCalcification)
    assert all(0 <= angle <= 2 * math.pi for angle in calcification.phi)


def test_a_smooth_patch(folder):
    smooth = ("transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}")
    transition = folder.load(smooth).variants["local"].calcification.transition
    assert (transition.x, transition.phi) == (0.0025, pytest.approx(3 * math.pi / 8))


def test_files_are_found_in_the_nearest_folder_above(folder, monkeypatch):
    inner = folder.path / "a/b"
    inner.mkdir(parents=True)
    folder.write().rename(inner / "x.yaml")
    monkeypatch.chdir(inner)
    case = load_case_file("x.yaml").variants["none"]
    assert case.reference.plot_file == (folder.path / "data/run.xplt").resolve()
    (folder.path / "a/data").mkdir()
    (folder.path / "a/data/run.xplt").touch()
    case = load_case_file("x.yaml").variants["none"]
    assert case.reference.plot_file == (folder.path / "a/data/run.xplt").resolve()
    assert case.inlet.waveform.path == (folder.path / "data/inlet.csv").resolve()


@pytest.mark.parametrize(
    ("path", "shown"),
    [
        ("runs/2024/absent.xplt", "runs/2024/absent.xplt"),
        (f"/a{'b' * 60}/c{'d' * 60}/absent.xplt", f"/a{'b' * 22}…{'d' * 24}/absent.xplt"),
        (f"runs/{'n' * 80}.xplt", f"runs/{'n' * 80}.xplt"),
        (f"{'m' * 30}/{'n' * 80}.xplt", f"{'m' * 10}…{'m' * 10}/{'n' * 80}.xplt"),
        (f"runs/{'n' * 300}", f"runs/{'n' * 54}…"),
    ],
)
def test_a_missing_file_is_named_in_full(folder, path, shown):
    searched = "" if path[0] == "/" else f"; looked for in {folder.path} and the folders above it"
    assert folder.problems(("data/run.xplt", path)) == [
        f"x.yaml, line 19: reference.plot_file: {shown}: no such file{searched}"
    ]


def test_an_absolute_path_is_taken_as_it_is(folder, tmp_path_factory):
    file = tmp_path_factory.mktemp("elsewhere") / "run.xplt"
    file.touch()
    case = folder.load(("data/run.xplt", str(file))).variants["none"]
    assert case.reference.plot_file == file.resolve()


def test_bare_numbers_are_refused_from_python_too():
    with pytest.raises(ValidationError, match="no unit"):
        Case.model_validate({"geometry": {"length": 0.015}})


def test_errors_are_one_family(folder):
    with pytest.raises(CaseError) as caught:
        folder.load(("0.5 mm", "-0.5 mm"), ("law: thick", "law: thik"))
    error = caught.value
    assert isinstance(error, CaseFileError)
    assert error.path == folder.path / "x.yaml"
    assert [(problem.line, problem.key) for problem in error.problems] == [
        (6, "geometry.wall_thickness"),
        (8, "wall.law"),
    ]


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    with pytest.raises(CaseFileError) as caught:
        load_case_file(tmp_path / "none.yaml")
    assert (
        str(caught.value) == f"{tmp_path}/none.yaml: No such file or directory; allowed: a case file (.yaml)"
    )
    with pytest.raises(CaseFileError) as caught:
        load_case_file(tmp_path)
    assert str(caught.value) == f"{tmp_path}: a folder; allowed: a case file (.yaml)"


def test_a_file_far_too_large_is_not_read(tmp_path):
    file = Path(tmp_path / "x.yaml")
    file.write_bytes(b"#" * 1_000_001)
    with pytest.raises(CaseFileError, match="larger than 1000000 bytes; allowed: a case file"):
        load_case_file(file)


def test_a_device_and_a_pipe_are_refused_unread(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")  # to open it would wait for a writer
    for path in (Path("/dev/zero"), tmp_path / "pipe.yaml"):
        with pytest.raises(CaseFileError) as caught:
            load_case_file(path)
        assert str(caught.value) == f"{path}: a device or a pipe; allowed: a case file (.yaml)"


def test_a_waveform_far_too_large_is_refused(folder):
    (folder.path / "data/inlet.csv").write_bytes(b"#" * 10_000_001)
    assert folder.problems() == [
        "x.yaml, line 10: inlet.waveform: data/inlet.csv: larger than 10000000 bytes"
    ]
