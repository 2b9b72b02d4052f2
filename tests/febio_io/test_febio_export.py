"""Writing in other formats: what is written, and that nothing is left half written."""

import os
import signal

import numpy as np
import pandas as pd
import pytest
import pyvista as pv
import xarray as xr
from log_samples import sample_log
from numpy.testing import assert_allclose, assert_array_equal
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader
from xplt_samples import ITEMS, MESH, SMALL_MESH, sample_file, sample_sections, state_values
from xplt_writer import Item, Writer

from febio_io.command import parse_states
from febio_io.errors import FebioError, FebioFileError, FebioKeyError
from febio_io.text.data_records import read_data_record
from febio_io.text.log import read_log
from febio_io.views.export import export_log, export_plot, export_record
from febio_io.views.staging import safe_name
from febio_io.xplt import open_plot

FORMATS = ["vtu", "vtkhdf", "csv", "nc"]
WRITER = Writer()


@pytest.fixture
def plot(write):
    flow, corner = Item("surface", "flow/rate", "float", "region"), Item("domain", "corner", "float", "mult")
    states = [
        WRITER.state(
            0.1 * number,
            state_values(number)
            | {("surface", 1): {1: np.array(10.0 * number)}, ("domain", 2): {1: np.arange(16).reshape(2, 8)}},
        )
        for number in range(3)
    ]
    root = WRITER.root([*ITEMS, flow, corner])
    with open_plot(write(WRITER.file(root, WRITER.mesh(MESH), *states))) as opened:
        yield opened


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_vtu_series(plot, tmp_path):
    written = export_plot(plot, tmp_path / "out", "vtu", states=[0, 2])
    assert names(tmp_path / "out") == [
        "case.pvd",
        "case_0000.vtu",
        "case_0002.vtu",
        "case_Mixed.pvd",
        "case_Mixed_0000.vtu",
        "case_Mixed_0002.vtu",
    ]
    assert {path.name for path in written} == set(names(tmp_path / "out"))
    reader = pv.get_reader(tmp_path / "out" / "case.pvd")
    assert_allclose(reader.time_values, [0, 0.2])
    reader.set_active_time_point(1)
    (grid,) = reader.read()
    assert_array_equal(grid.cell_data["pressure"], [2, 2.5, np.nan, -2, -2.5])
    surface = pv.read(tmp_path / "out" / "case_Mixed_0002.vtu")
    assert_array_equal(surface.cell_data["flow/rate"], [20, 20])


def test_vtkhdf_holds_all_states(plot, tmp_path):
    export_plot(plot, tmp_path, "vtkhdf", variables=["pressure", "displacement"])
    assert names(tmp_path) == ["case.vtkhdf", "case.xplt"]
    reader = vtkHDFReader()
    reader.SetFileName(str(tmp_path / "case.vtkhdf"))
    reader.UpdateInformation()
    assert reader.GetNumberOfSteps() == 3
    for state in range(3):
        reader.SetStep(state)
        reader.Update()
        output = reader.GetOutputDataObject(0)
        values = vtk_to_numpy(output.GetCellData().GetArray("pressure"))
        assert_array_equal(values, [state, state + 0.5, np.nan, -state, -state - 0.5])
        moved = vtk_to_numpy(output.GetPointData().GetArray("displacement"))
        assert_array_equal(moved, state_values(state)["node", 1][0])


def test_csv_tables(plot, tmp_path):
    export_plot(plot, tmp_path, "csv")
    assert names(tmp_path) == [
        "case.xplt",
        "case_corner.csv",
        "case_displacement.csv",
        "case_flow_rate.csv",
        "case_pressure.csv",
    ]
    pressure = pd.read_csv(tmp_path / "case_pressure.csv")
    assert list(pressure) == ["state", "time", "domain", "domain_name", "element", "value"]
    assert pressure["element"].tolist() == [11, 12, 31, 32] * 3
    assert pressure["value"].tolist()[4:8] == [1, 1.5, -1, -1.5]
    moved = pd.read_csv(tmp_path / "case_displacement.csv")
    assert_array_equal(moved[["x", "y", "z"]][12:24], state_values(1)["node", 1][0])
    flow = pd.read_csv(tmp_path / "case_flow_rate.csv")
    assert flow.to_dict("list") == {
        "state": [0, 1, 2],
        "time": [0, 0.100000001, 0.200000003],
        "surface": [1] * 3,
        "surface_name": ["Mixed"] * 3,
        "value": [0, 10, 20],
    }
    corner = pd.read_csv(tmp_path / "case_corner.csv")
    assert corner["place"].tolist()[:9] == [*range(1, 9), 1]


def test_csv_leaves_out_the_padding_of_small_faces(write, tmp_path):
    item = Item("surface", "p", "float", "mult")
    state = WRITER.state(0, {("surface", 1): {1: np.arange(8).reshape(2, 4)}})
    with open_plot(write(WRITER.file(WRITER.root([item]), WRITER.mesh(MESH), state))) as plot:
        export_plot(plot, tmp_path, "csv")
    assert pd.read_csv(tmp_path / "case_p.csv")["value"].tolist() == [0, 1, 2, 4, 5, 6, 7]


def test_nc_is_the_labelled_arrays(plot, tmp_path):
    export_plot(plot, tmp_path, "nc", states=[1])
    with xr.open_dataset(tmp_path / "case.nc") as data:
        assert_array_equal(data["pressure"], [[1, 1.5, np.nan, -1, -1.5]])
        assert_array_equal(data["flow_rate"], [[10, np.nan]])
        assert data["displacement"].dtype == np.float32
        assert data.attrs["source"] == "case.xplt"


@pytest.mark.parametrize("file_format", ["vtu", "csv"])
def test_remeshed_files_are_written_state_by_state(write, tmp_path, file_format):
    later = [WRITER.mesh(SMALL_MESH), WRITER.state(3, {("node", 1): {0: np.ones((8, 3))}})]
    with open_plot(write(WRITER.file(*sample_sections(), *later))) as plot:
        export_plot(plot, tmp_path, file_format)
    if file_format == "vtu":
        assert pv.read(tmp_path / "case_0003.vtu").n_points == 8
    else:
        assert len(pd.read_csv(tmp_path / "case_displacement.csv")) == 3 * 12 + 8


@pytest.mark.parametrize("file_format", ["vtu", "vtkhdf"])
def test_states_of_one_time_are_refused_where_they_cannot_be_told_apart(write, tmp_path, file_format):
    states = [WRITER.state(time) for time in (0, 1, 1)]
    with open_plot(write(WRITER.file(WRITER.root(), WRITER.mesh(MESH), *states))) as plot:
        with pytest.raises(FebioKeyError, match="states 1 and 2 have times 1 and 1"):
            export_plot(plot, tmp_path / "out", file_format)
        assert not (tmp_path / "out").exists()
        export_plot(plot, tmp_path / "out", file_format, states=[0, 2])


@pytest.mark.parametrize("file_format", ["vtu", "vtkhdf", "csv"])
def test_an_interrupt_leaves_nothing_half_written(plot, tmp_path, file_format):
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "case.pvd").write_text("before")

    def interrupt():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export_plot(plot, folder, file_format, advance=interrupt)
    assert names(folder) == ["case.pvd"]
    assert (folder / "case.pvd").read_text() == "before"


def test_an_interrupt_within_vtk_is_not_lost(plot, tmp_path):
    with pytest.raises(KeyboardInterrupt):
        export_plot(plot, tmp_path / "out", "vtkhdf", advance=lambda: signal.raise_signal(signal.SIGINT))
    assert not (tmp_path / "out").exists()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize("file_format", FORMATS)
def test_damage_that_is_met_late_leaves_nothing(write, tmp_path, file_format):
    bad = WRITER.state(1, {("domain", 1): {1: np.zeros(5)}})
    with (
        open_plot(write(WRITER.file(*sample_sections(states=1), bad))) as plot,
        pytest.raises(FebioError, match="20 bytes where shape"),
    ):
        export_plot(plot, tmp_path / "out", file_format)
    assert not (tmp_path / "out").exists()


def test_folders_that_cannot_be_made(plot, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FebioFileError, match="cannot be written to"):
        export_plot(plot, tmp_path / "file" / "out", "csv")
    with pytest.raises(FebioFileError, match="cannot be written to"):
        export_plot(plot, tmp_path / "file", "csv")


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
def test_folders_that_may_not_be_written_to(plot, tmp_path):
    folder = tmp_path / "locked"
    folder.mkdir(mode=0o500)
    with pytest.raises(FebioFileError, match="Permission denied"):
        export_plot(plot, folder, "csv")


def test_records(write, tmp_path):
    text = "".join(f"*Step  = {k}\n*Time  = {k}\n*Data  = x;a/b\n1 {k} 2\n2 {k} 3\n" for k in range(3))
    record = read_data_record(write(text.encode(), "data.txt"))
    export_record(record, tmp_path, "csv", variables=["a/b"], blocks=[0, 2])
    table = pd.read_csv(tmp_path / "data.csv")
    assert table.to_dict("list") == {
        "step": [0, 0, 2, 2],
        "time": [0, 0, 2, 2],
        "item": [1, 2, 1, 2],
        "a/b": [2, 3, 2, 3],
    }
    export_record(record, tmp_path, "nc", blocks=[1])
    with xr.open_dataset(tmp_path / "data.nc") as data:
        assert_array_equal(data["x"], [[1, 1]])
        assert_array_equal(data["a_b"], [[2, 3]])
    with pytest.raises(FebioKeyError, match="no column 'y'; the file has 'x', 'a/b'"):
        export_record(record, tmp_path, "csv", variables=["y"])
    with pytest.raises(FebioKeyError, match="has no mesh to write as vtu"):
        export_record(record, tmp_path, "vtu")


def test_logs(write, tmp_path):
    log = read_log(write(sample_log().encode(), "run.log"))
    export_log(log, tmp_path / "csv", "csv")
    assert names(tmp_path / "csv") == [
        f"run_{name}.csv" for name in ("inputs", "iterations", "messages", "record1", "steps", "timings")
    ]
    steps = pd.read_csv(tmp_path / "csv" / "run_steps.csv")
    assert steps["outcome"].tolist() == ["failed", "converged", "converged"]
    iterations = pd.read_csv(tmp_path / "csv" / "run_iterations.csv")
    assert iterations["residual current"].tolist() == [1, 1, 1e-4, 1, 1]
    export_log(log, tmp_path / "nc", "nc")
    assert names(tmp_path / "nc") == ["run_iterations.nc", "run_record1.nc", "run_steps.nc"]
    with xr.open_dataset(tmp_path / "nc" / "run_steps.nc") as data:
        assert data["attempt"].values.tolist() == [1, 2, 1]


@pytest.mark.parametrize(
    ("text", "numbers"),
    [("0", [0]), ("-1", [9]), ("2:4", [2, 3, 4]), ("0:-1:4", [0, 4, 8]), ("3, 1,1:2", [1, 2, 3])],
)
def test_lists_of_states(text, numbers):
    assert parse_states(text, 10) == numbers


@pytest.mark.parametrize(
    ("text", "message"),
    [("", "is expected"), ("a", "'a': a number"), ("1:2:0", "is expected"), ("10", "0 to 9")],
)
def test_lists_that_are_wrong(text, message):
    with pytest.raises(FebioKeyError, match=message):
        parse_states(text, 10)


def test_names_of_files_are_safe():
    assert safe_name("a/b c:d") == "a_b_c_d"
    assert safe_name("../..") == "unnamed"
    assert safe_name("Wandung ä") == "Wandung_ä"


def test_sample_names_survive(write, tmp_path):
    with open_plot(write(sample_file(), "my case.xplt")) as plot:
        export_plot(plot, tmp_path, "nc")
    assert (tmp_path / "my_case.nc").is_file()
