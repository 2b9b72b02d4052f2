"""Data records in their separate files."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from febio_io.command import main
from febio_io.errors import FebioError, FebioFileError, FebioFormatError
from febio_io.text.data_records import read_data_record


def block(step, time, *lines, name="ux;uy"):
    return f"*Step  = {step}\n*Time  = {time:.9g}\n*Data  = {name}\n" + "".join(f"{line}\n" for line in lines)


TWO = block(0, 0, "1 0 0", "4 0 0") + block(1, 0.1, "1 1.5 -2", "4 nan inf")


@pytest.fixture
def record_of(write):
    return lambda text, **options: read_data_record(write(text.encode(), "data.txt"), **options)


def test_blocks_become_a_labelled_table(record_of):
    record = record_of(TWO)
    assert (record.name, record.columns, record.units) == ("ux;uy", ("ux", "uy"), ("L", "L"))
    assert record.warnings == ()
    data = record.to_xarray()
    assert data["ux"].dims == ("time", "item")
    assert_array_equal(data["time"], [0, 0.1])
    assert_array_equal(data["step"], [0, 1])
    assert_array_equal(data["item"], [1, 4])
    assert_array_equal(data["ux"], [[0, 0], [1.5, math.nan]])
    assert_array_equal(data["uy"], [[0, 0], [-2, math.inf]])
    assert data["ux"].attrs == {"unit": "L"}
    table = record.to_pandas()
    assert list(table) == ["step", "time", "item", "ux", "uy"]
    assert table["item"].tolist() == [1, 4, 1, 4]


@pytest.mark.parametrize("delimiter", [" ", ",", ", ", "\t", ";", " | "])
def test_delimiters(record_of, delimiter):
    lines = [delimiter.join(["3", "1e-3", "-2.5E+10"]), delimiter.join(["2", "7", "8"])]
    assert_array_equal(record_of(block(0, 0, *lines)).values, [[1e-3, -2.5e10], [7, 8]])


def test_line_ends_and_values_of_windows(record_of):
    record = record_of(block(0, 0, "1 -1.#IND 1.#INF", "2 -1.#INF 1.#QNAN").replace("\n", "\r\n"))
    assert_array_equal(record.values, [[math.nan, math.inf], [-math.inf, math.nan]])
    assert record.name == "ux;uy"


def test_a_name_hides_the_columns_until_they_are_given(record_of):
    text = block(0, 0, "1 2 3", name="my record")
    assert record_of(text).columns == ("1", "2")
    record = record_of(text, columns=("sx", "J"))
    assert (record.name, record.columns, record.units) == ("my record", ("sx", "J"), ("P", None))
    with pytest.raises(FebioFormatError, match="3 columns named where the file has 2"):
        record_of(text, columns=("a", "b", "c"))


def test_column_names_that_repeat_or_collide_stay_apart(record_of):
    record = record_of(block(0, 0, "1 2 3 4", name="x;x;time"))
    assert list(record.to_xarray().data_vars) == ["x", "x (2)", "time (2)"]
    assert list(record.to_pandas())[3:] == ["x", "x (2)", "time (2)"]


def test_comments_off(record_of):
    record = record_of("7 1\n9 2\n7 3\n9 4\n7 5\n9 6\n")
    assert record.is_regular
    assert_array_equal(record.to_xarray()["1"], [[1, 2], [3, 4], [5, 6]])
    assert_array_equal(record.steps, [0, 1, 2])
    assert np.isnan(record.times).all()


def test_titles_of_the_oldest_files_are_passed_over(record_of):
    assert record_of("*Title:test\n" + TWO).times.tolist() == [0, 0.1]


def test_steps_restart_with_each_analysis_step(record_of):
    text = "".join(block(step, time, "1 0 0") for step, time in [(1, 0.5), (2, 1), (1, 1.5), (2, 2)])
    data = record_of(text).to_xarray()
    assert_array_equal(data["time"], [0.5, 1, 1.5, 2])
    assert_array_equal(data["step"], [1, 2, 1, 2])


def test_after_a_restart_what_was_written_last_counts(record_of):
    times = [0.1, 0.2, 0.3, 0.2, 0.25, 0.4]
    text = "".join(block(k, time, f"1 {k} 0") for k, time in enumerate(times))
    record = record_of(text)
    assert record.times.tolist() == [0.1, 0.2, 0.25, 0.4]
    assert record.values[:, 0].tolist() == [0, 3, 4, 5]
    assert record.warnings == (
        "data.txt: 2 blocks were written again later; only the last of each time count",
    )
    assert record_of(text, repeats="all").times.tolist() == times


def test_blocks_of_different_items(record_of):
    record = record_of(block(0, 0, "1 2 3") + block(1, 1, "1 4 5", "2 6 7"))
    assert not record.is_regular
    data = record.to_xarray()
    assert data["ux"].dims == ("row",)
    assert_array_equal(data["ux"], [2, 4, 6])
    assert_array_equal(data["time"], [0, 1, 1])
    assert record.to_pandas()["time"].tolist() == [0, 1, 1]


def test_a_file_cut_anywhere_gives_whole_blocks(record_of):
    blocks = [block(k, k, f"1 {k} 2.25", f"2 {k} 3.75") for k in range(4)]
    ends = np.cumsum([len(item) for item in blocks])
    text = "".join(blocks)
    for length in range(ends[1], ends[-1]):
        record = record_of(text[:length])
        complete = int(np.searchsorted(ends, length, side="right"))
        assert len(record.times) == complete
        assert set(record.values[:, 1]) == {2.25, 3.75}
        assert bool(record.warnings) == (length not in ends)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (block(0, 0, "1 2 3", "2 4"), "line 5: 1 values where 2 are expected"),
        (block(0, 0, "1 2 3") + block(1, 1, "1 2"), "line 5: a block with 1 values an item, after others"),
        (block(0, 0, "1 2 x"), "line 4: 'x' is no number"),
        (block(0, 0, "1.5 2 3"), "line 4: the number of an item expected, '1.5' found"),
        ("*Step = one\n", "line 1: the number of a time step expected, 'one' found"),
        ("*Step = 1\n*Time = now\n", "line 2: 'now' is no number"),
        (block(0, 0, ", ,"), "line 4: the number of an item expected, '' found"),
    ],
)
def test_contradictions_are_named_by_line(record_of, text, message):
    with pytest.raises(FebioFormatError, match=message):
        record_of(text)


@pytest.mark.parametrize("content", ["", "time,value\n", "# comment\n", "<xml/>", "*Heading\n"])
def test_other_files_are_refused(record_of, content):
    with pytest.raises(FebioFileError, match="not an FEBio data record"):
        record_of(content)


def test_missing_files(tmp_path):
    with pytest.raises(FebioFileError, match="cannot be opened"):
        read_data_record(tmp_path / "none.txt")


@pytest.mark.parametrize("end", ["", "%s"])
def test_lines_without_item_numbers_are_read_by_position(record_of, end):
    rows = ("0 0 0", "1 0 0", "0 1 0.5")
    whole = record_of("".join(block(k, k, *(f"{row}{end}" for row in rows), name="x;y;z") for k in (0, 1)))
    assert_array_equal(whole.to_xarray()["item"], [1, 2, 3])
    assert_array_equal(whole.to_xarray()["z"], [[0, 0, 0.5]] * 2)
    assert "its lines have no item numbers" in whole.warnings[0]
    one_a_line = record_of(block(0, 0, *" ".join(rows).split(), name="x;y;z"))
    assert_array_equal(one_a_line.values, whole.values[:3])
    (single,) = record_of(block(0, 0, "0.25", "0.75", name="ux")).to_xarray()["ux"].values
    assert_array_equal(single, [0.25, 0.75])


def test_one_value_a_line_that_ends_in_an_item(record_of):
    text = "".join(block(k, k, "1", "2", "3", "4") for k in (0, 1))
    cut = record_of(text.removesuffix("4\n"))
    assert (len(cut.times), "cut off" in cut.warnings[0]) == (1, True)
    with pytest.raises(FebioFormatError, match="line 1: a block whose last item lacks values"):
        record_of(block(0, -1, "1", "2", "3") + text)


def test_items_that_repeat_in_a_block_are_warned_of(record_of):
    (warning,) = record_of(block(0, 0, "0 0 0.5", "1 0 0.5", "0 1 0.5", name="a name")).warnings
    assert "an item stands twice in a block: item numbers may be missing" in warning


@pytest.mark.parametrize("row", ["1 0,5 0,25", "1;0,5;0,25", "1\t0,5\t0,25"])
def test_decimal_commas_are_refused(record_of, row):
    with pytest.raises(FebioFormatError, match=r"line 4: .*commas in numbers.*allowed: decimal points"):
        record_of(block(0, 0, row))


def test_names_against_values(record_of):
    (warning,) = record_of(block(0, 0, "1,0,5,0,25")).warnings
    assert "2 names (ux;uy) but 4 values an item: are there decimal commas?" in warning
    assert record_of(block(0, 0, "1 0.5,2.25")).warnings == ()  # a format of two separators
    assert record_of(block(0, 0, "1 5,2")).warnings == ()


@pytest.mark.parametrize(
    ("row", "found"),
    [
        ("5 -nan(ind) nan", [math.nan, math.nan]),
        ("6 inf -inf", [math.inf, -math.inf]),
        ("7 nan(snan) 1.0", [math.nan, 1]),
        ("8 1.#QNAN -1.#INF", [math.nan, -math.inf]),
        ("9 -1.#IND00e+000 1.#INF00", [math.nan, math.inf]),
        ("1 NaN(0x7ff) -Inf", [math.nan, -math.inf]),
    ],
)
def test_values_that_are_no_numbers(record_of, row, found):
    assert_array_equal(record_of(block(0, 0, row)).values, [found])


@pytest.mark.parametrize(
    "row", ["5:0.5:-0.25", "5 / 0.5 / -0.25", "5: 0.5 -0.25", "5&.5&-25e-02", "5=>.5=>-.25"]
)
def test_any_separator_is_found(record_of, row):
    assert_array_equal(record_of(block(0, 0, row)).values, [[0.5, -0.25]])


def test_a_separator_may_be_named(record_of):
    text = block(0, 0, "5 x 0.5 x -0.25")
    with pytest.raises(FebioFormatError, match="'x' is no number; separators are blanks, commas, semicolons"):
        record_of(text)
    assert_array_equal(record_of(text, delimiter="x").values, [[0.5, -0.25]])
    for delimiter in ("", "-", "e"):
        with pytest.raises(FebioFormatError, match="allowed: a text that is no part of a number"):
            record_of(text, delimiter=delimiter)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
@pytest.mark.parametrize("before", ["", "# exported\n", "\n# a\n#b\n"])
def test_marks_of_encodings_and_comments(write, encoding, before):
    path = write((before + TWO).encode(encoding), "data.txt")
    assert read_data_record(path).columns == ("ux", "uy")
    assert main([str(path)]) == 0


@pytest.mark.parametrize("name", ["bom", "delim_colon", "format_noitem", "hash_comment", "ucrt_nan"])
def test_small_records_as_people_have_them(shared_data, name):
    record = read_data_record(shared_data / "inputs_that_fail" / f"rec_{name}.txt")
    assert record.columns == tuple(record.name.split(";"))
    assert bool(record.warnings) == (name == "format_noitem")


def test_a_small_record_with_decimal_commas(shared_data, capsys):
    assert main([str(shared_data / "inputs_that_fail" / "rec_decimal_comma.txt")]) == 2
    assert "allowed: decimal points" in capsys.readouterr().err


def test_real_records(shared_data):
    record = read_data_record(shared_data / "febio" / "none_axis_nodes.txt")
    assert record.columns == ("x", "y", "z", "nfvx", "nfvy", "nfvz")
    assert record.units == ("L", "L", "L", "L/t", "L/t", "L/t")
    assert dict(record.to_xarray().sizes) == {"time": 451, "item": 31}
    named = read_data_record(shared_data / "febio" / "none_mid_elements.txt")
    assert (named.name, named.values.shape) == ("mid-plane fluid", (451 * 24, 5))


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(
        st.one_of(
            st.sampled_from(["*Step  = 1\n", "*Time  = 0.5\n", "*Data  = a;b\n", "1 2 3\n", "2,nan,-inf\n"]),
            st.sampled_from(["1 2\n", "\n", "*", "9" * 30 + " 1\n", "1 1e999 1_0\n", "1 2 3"]),
            st.text(max_size=12),
        ),
        max_size=25,
    )
)
@example(["1", "\n"])
def test_any_text_raises_only_errors_of_the_family(write, pieces):
    path = write("".join(pieces).encode("utf-8", "surrogatepass"), "data.txt")
    try:
        record = read_data_record(path)
    except FebioError as error:
        assert str(path) in str(error)  # noqa: PT017
        return
    assert len(record.items) == len(record.values) == len(record.blocks)
    assert len(record.to_pandas()) == len(record.items)
    record.to_xarray()
