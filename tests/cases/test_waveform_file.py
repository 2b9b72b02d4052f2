import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cases.errors import ColumnFileError
from cases.values.column_file import FLOW_RATE, PRESSURE
from cases.values.waveform_file import read_waveform

HEADER = "t_s,mean_velocity_m_s"


@pytest.fixture
def read(tmp_path):
    def read(text):
        file = tmp_path / "w.csv"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_waveform(file, "w.csv")

    return read


def test_values_become_si(read):
    waveform = read("# comment\n\nt_ms, mean_velocity_cm_s\n0,8.41199\n 500 , 20\r\n797.33,8.41199\n")
    np.testing.assert_array_equal(waveform.times, [0.0, 0.5, 0.79733])
    np.testing.assert_array_equal(waveform.values, [0.0841199, 0.2, 0.0841199])
    assert waveform.period == 0.79733
    assert waveform.path.name == "w.csv"


@pytest.mark.parametrize(
    ("quantity", "header", "si"),
    [
        (FLOW_RATE, "flow_rate_m3_s", 3.0),
        (FLOW_RATE, "flow_rate_cm3_s", 3e-6),
        (FLOW_RATE, "flow_rate_mL_s", 3e-6),
        (FLOW_RATE, "flow_rate_mL_min", 5e-8),
        (PRESSURE, "pressure_Pa", 3.0),
        (PRESSURE, "pressure_kPa", 3000.0),
        (PRESSURE, "pressure_mmHg", 399.967162245),
    ],
)
def test_other_quantities_become_si(tmp_path, quantity, header, si):
    file = tmp_path / "w.csv"
    file.write_text(f"t_s,{header}\n0,0\n1,3\n2,0\n")
    np.testing.assert_array_equal(read_waveform(file, quantity=quantity).values, [0.0, si, 0.0])


def test_the_closure_is_told_in_the_unit_of_the_quantity(tmp_path):
    file = tmp_path / "w.csv"
    file.write_text("t_s,pressure_kPa\n0,1\n1,3\n2,2\n")
    with pytest.raises(ColumnFileError, match="ends at 2000 Pa but starts at 1000 Pa"):
        read_waveform(file, quantity=PRESSURE)


def test_arrays_cannot_be_written_to(read):
    waveform = read(f"{HEADER}\n0,1\n1,2\n2,1\n")
    with pytest.raises(ValueError, match="read-only"):
        waveform.values[0] = 3.0
    with pytest.raises(ValueError, match="read-only"):
        waveform.times[0] = 3.0


def test_equal_samples_are_equal_wherever_they_come_from(read, tmp_path):
    text = f"{HEADER}\n0,1\n1,2\n2,1\n"
    one, other = read(text), read("# again\n" + text)
    assert one == other
    assert hash(one) == hash(other)
    assert one != read(f"{HEADER}\n0,1\n1,3\n2,1\n")


@given(
    st.lists(st.floats(1e-3, 10), min_size=2, max_size=20),
    st.lists(st.floats(-5, 5), min_size=2, max_size=20),
)
def test_written_samples_are_read_back(tmp_path_factory, steps, values):
    size = min(len(steps), len(values))
    times = np.concatenate([[0.0], np.cumsum(steps[:size])])
    cycle = np.array([*values[:size], values[0]])
    rows = "\n".join(f"{t!r},{v!r}" for t, v in zip(times.tolist(), cycle.tolist(), strict=True))
    file = tmp_path_factory.mktemp("waveform") / "w.csv"
    file.write_text(f"{HEADER}\n{rows}\n")
    waveform = read_waveform(file)
    np.testing.assert_array_equal(waveform.times, times)
    np.testing.assert_array_equal(waveform.values, cycle)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "w.csv: empty; allowed: a header and rows of numbers"),
        ("# only\n", "w.csv: empty; allowed: a header and rows of numbers"),
        (b"\xff\xfe", "w.csv: not UTF-8 text"),
        (f"{HEADER}\n0,1\n1,1\n", "w.csv: 2 rows; allowed: 3 or more"),
        (
            "#\nt_s,mean_velocity\n0,1\n",
            (
                "w.csv, line 2: unknown column mean_velocity; did you mean mean_velocity_m_s? "
                "allowed: t_s, t_ms, mean_velocity_m_s, mean_velocity_cm_s"
            ),
        ),
        (
            "mean_velocity_m_s,t_s\n0,1\n",
            (
                "w.csv, line 1: columns mean_velocity_m_s, t_s; "
                "allowed: t_s, t_ms, then mean_velocity_m_s, mean_velocity_cm_s"
            ),
        ),
        (f"{HEADER}\n0,1\n1,x\n2,1\n", "w.csv, line 3: mean_velocity_m_s: x; allowed: a finite number"),
        (f"{HEADER}\n0,1\nnan,2\n2,1\n", "w.csv, line 3: t_s: nan; allowed: a finite number"),
        (
            f"{HEADER}\n0,1\n1,1e999\n2,1\n",
            "w.csv, line 3: mean_velocity_m_s: 1e999; allowed: a finite number",
        ),
        (f"{HEADER}\n0,1\n1,\n2,1\n", "w.csv, line 3: mean_velocity_m_s: nothing; allowed: a finite number"),
        (f"{HEADER}\n0,1\n1,2,3\n2,1\n", "w.csv, line 3: 3 columns; allowed: 2"),
        (f"{HEADER}\n0.1,1\n1,2\n2,1\n", "w.csv, line 2: starts at 0.1 s; allowed: a first time of 0"),
        (
            f"{HEADER}\n0,1\n#\n1,2\n1,2\n2,1\n",
            "w.csv, line 5: time does not increase; allowed: strictly increasing times",
        ),
        (
            f"{HEADER}\n0,1\n1,2\n2,1.001\n",
            "w.csv, line 4: ends at 1.001 m/s but starts at 1 m/s; allowed: a last value equal to the first",
        ),
    ],
)
def test_what_is_no_closed_waveform_is_refused(read, text, message):
    with pytest.raises(ColumnFileError) as caught:
        read(text)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("separator", "word"),
    [("\t", "tabs"), (";", "semicolons"), ("|", "bars"), ("  ", "blanks"), (" ; ", "semicolons")],
)
def test_other_separators_are_named(read, separator, word):
    text = "t_s,mean_velocity_m_s\n0,1\n0.5,2\n1,1\n".replace(",", separator)
    with pytest.raises(ColumnFileError, match=f"line 1: {word} separate columns; allowed: commas"):
        read(text)


def test_decimal_commas_are_asked_after(read):
    with pytest.raises(ColumnFileError, match=r"line 2: 4 columns; allowed: 2: are there decimal commas\?"):
        read(f"{HEADER}\n0,0,1,0\n0,5,2,0\n1,0,1,0\n")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(ColumnFileError, match=r"none\.csv: No such file"):
        read_waveform(tmp_path / "none.csv")
