"""Data records beside a plot file: equal values, and records that cannot be its own."""

from pathlib import Path

import numpy as np
import pytest
from small_case import RUNS
from tube_plot import write_tube
from tubes import Tube

from cases.sections.references.febio import RecordFile
from febio_io.errors import FebioFileError, FebioFormatError
from febio_io.xplt import open_plot
from validation.errors import UnusableReferenceError
from validation.reference.febio.records import account_of_record
from validation.reference.mesh.model import frame

TUBE = Tube(sectors=6, rings=2, stacks=3, layers=1)
TIMES = (0.0, 0.25, 0.5)
COLUMNS = ("x", "y", "z", "nfvx", "nfvy", "nfvz")


@pytest.fixture
def plot(tmp_path):
    with open_plot(write_tube(tmp_path / "tube.xplt", TUBE, TIMES)) as opened:
        yield opened


def node_blocks(times=TIMES, nodes=(1, 5, 7)):
    """Blocks as FEBio writes them, at more times than the plot file has."""
    turned = frame("z", "x", (0.0, 0.0, 0.0)).rotation  # as the plot file has it
    values = np.hstack([(TUBE.coordinates + TUBE.displacement) @ turned, TUBE.velocity @ turned])
    rows = values[np.minimum(np.array(nodes) - 1, len(values) - 1)]
    text = ""
    for step, time in enumerate(times):
        text += f"*Step  = {step}\n*Time  = {time:.9g}\n*Data  = {';'.join(COLUMNS)}\n"
        text += "".join(
            f"{node},{','.join(f'{v:.12g}' for v in row)}\n" for node, row in zip(nodes, rows, strict=True)
        )
    return text


def element_blocks(plot, name, factor=1.0):
    ids = [plot.mesh.domains[0].element_ids[3], plot.mesh.domains[-1].element_ids[0]]
    pressure = plot.field("fluid pressure", 0, 1)[3] * factor
    return "".join(
        f"*Step  = {k}\n*Time  = {t:.9g}\n*Data  = {name}\n{ids[0]} 1 {pressure:.12g}\n{ids[1]} 1 0\n"
        for k, t in enumerate(TIMES)
    )


@pytest.fixture
def account(tmp_path, plot):
    def read(text, items="nodes", columns=None):
        path = tmp_path / "record.txt"
        path.write_text(text)
        stated = RecordFile.model_construct(file=Path(path), items=items, columns=columns)
        return account_of_record(stated, plot)

    return read


def test_values_of_nodes(account):
    found = account(node_blocks(times=(0.0, 0.125, 0.25, 0.5)))
    assert found.facts["columns"] == list(COLUMNS)
    assert (found.facts["instants"], found.facts["values"]) == (3, 3 * 3 * 6)
    assert found.facts["largest_difference"] < 1e-7
    assert "54 values that FEBio wrote as text (x, y, z, nfvx, nfvy, nfvz; 3 instants)" in found.notes[0]
    assert found.warnings == ()


def test_values_of_elements_where_the_plot_file_has_them(account, plot):
    found = account(element_blocks(plot, "named"), "elements", ("x", "fp"))
    assert (found.facts["columns"], found.facts["values"]) == (["fp"], 3)
    assert found.warnings == ()


@pytest.mark.parametrize("factor", [1 + 1e-5, -1.0, np.inf])
def test_other_values_cast_doubt(account, plot, factor):
    found = account(element_blocks(plot, "x;fp", factor), "elements")
    (warning,) = found.warnings
    assert found.notes == ()
    assert "fluid pressure differs from the plot file by up to" in warning
    assert (found.facts["largest_difference"] is None) == np.isinf(factor)


def test_a_record_that_is_cut_off_casts_doubt(account):
    (warning,) = account(node_blocks()[:-30]).warnings
    assert "cut off" in warning


@pytest.mark.parametrize(
    ("text", "stated", "said"),
    [
        (node_blocks(times=(0.1, 0.2)), {}, "no time of its blocks is that of a state"),
        (node_blocks(), {"items": "elements"}, r"none of its columns \(x, y, z, nfvx, nfvy, nfvz\)"),
        (
            node_blocks(),
            {"columns": tuple("abcdef")},
            r"none of its columns \(a, b, c, d, e, f\) is a value of",
        ),
        (node_blocks(nodes=(10**6,)), {}, "no values of its nodes"),
        ("*Step  = 0\n*Time  = 0\n*Data  = x\n", {}, r"none of its columns \(none\)"),
    ],
)
def test_a_record_without_common_values_is_refused(account, text, stated, said):
    with pytest.raises(UnusableReferenceError, match=rf"{said}.* \(reference\.data_records\)"):
        account(text, **stated)


def test_unreadable_records(account):
    with pytest.raises(FebioFileError, match="not an FEBio data record"):
        account("hello")
    with pytest.raises(FebioFormatError, match="2 columns named where the file has 6"):
        account(node_blocks(), columns=("x", "y"))


@pytest.mark.parametrize("name", ["none", "axisymmetric", "local"])
def test_the_ready_runs(name):
    with open_plot(RUNS / f"{name}.xplt") as plot:
        for stated, values in (
            ({"file": RUNS / f"{name}_axis_nodes.txt", "items": "nodes"}, 41 * 31 * 6),
            ({"file": RUNS / f"{name}_mid_elements.txt", "items": "elements"}, 41 * 24),
        ):
            columns = ("x", "y", "z", "fp", "fvz") if stated["items"] == "elements" else None
            found = account_of_record(RecordFile.model_construct(columns=columns, **stated), plot)
            assert found.warnings == ()
            assert found.facts["values"] == values
            assert found.facts["largest_difference"] < 1e-7
