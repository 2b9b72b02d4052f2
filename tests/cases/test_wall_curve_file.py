import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cases.errors import ColumnFileError
from cases.values.wall_curve_file import read_wall_curve

HEADER = "radius_m,pressure_Pa"


@pytest.fixture
def read(tmp_path):
    def read(text):
        file = tmp_path / "wall.csv"
        file.write_text(text)
        return read_wall_curve(file, "wall.csv")

    return read


@pytest.mark.parametrize(("unit", "pascals"), [("Pa", 1.0), ("kPa", 1000.0), ("mmHg", 133.322387415)])
def test_values_become_si(read, unit, pascals):
    curve = read(f"# comment\nradius_mm, pressure_{unit}\n2,-1\n2.5,0\n2.75,1\n\n3,2\n")
    np.testing.assert_array_equal(curve.radii, [0.002, 0.0025, 0.00275, 0.003])
    np.testing.assert_array_equal(curve.pressures, np.array([-1.0, 0.0, 1.0, 2.0]) * pascals)
    assert curve.path.name == "wall.csv"


def test_arrays_cannot_be_written_to(read):
    curve = read(f"{HEADER}\n1,1\n2,2\n3,3\n4,4\n")
    with pytest.raises(ValueError, match="read-only"):
        curve.radii[0] = 3.0
    with pytest.raises(ValueError, match="read-only"):
        curve.pressures[0] = 3.0


def test_equal_curves_are_equal_wherever_they_come_from(read):
    text = f"{HEADER}\n1,1\n2,2\n3,3\n4,4\n"
    one, other = read(text), read("# again\n" + text)
    assert one == other
    assert hash(one) == hash(other)
    assert one != read(f"{HEADER}\n1,1\n2,2\n3,3\n4,5\n")


@given(
    st.lists(st.tuples(st.floats(1e-6, 1e-2), st.floats(1.0, 1e4)), min_size=4, max_size=20),
)
def test_written_curves_are_read_back(tmp_path_factory, steps):
    curve = np.cumsum(np.array(steps), axis=0)
    rows = "\n".join(f"{radius!r},{pressure!r}" for radius, pressure in curve.tolist())
    file = tmp_path_factory.mktemp("curve") / "wall.csv"
    file.write_text(f"{HEADER}\n{rows}\n")
    read = read_wall_curve(file)
    np.testing.assert_array_equal(read.radii, curve[:, 0])
    np.testing.assert_array_equal(read.pressures, curve[:, 1])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "wall.csv: empty; allowed: a header and rows of numbers"),
        (f"{HEADER}\n1,1\n2,2\n3,3\n", "wall.csv: 3 rows; allowed: 4 or more"),
        (
            "radius_m,pressure_MPa\n1,1\n",
            (
                "wall.csv, line 1: unknown column pressure_MPa; did you mean pressure_Pa? "
                "allowed: radius_mm, radius_m, pressure_Pa, pressure_kPa, pressure_mmHg"
            ),
        ),
        (
            "radius_m,mean_velocity_m_s\n1,1\n",
            (
                "wall.csv, line 1: column mean_velocity_m_s is a mean velocity; "
                "allowed: radius_mm, radius_m, pressure_Pa, pressure_kPa, pressure_mmHg"
            ),
        ),
        (
            "pressure_Pa,radius_m\n1,1\n",
            (
                "wall.csv, line 1: columns pressure_Pa, radius_m; "
                "allowed: radius_mm, radius_m, then pressure_Pa, pressure_kPa, pressure_mmHg"
            ),
        ),
        (f"{HEADER}\n1,1\n2,x\n3,3\n4,4\n", "wall.csv, line 3: pressure_Pa: x; allowed: a finite number"),
        (
            f"{HEADER}\n0,1\n2,2\n3,3\n4,4\n",
            "wall.csv, line 2: radius_m: 0; allowed: a length from 1 µm to 10 m",
        ),
        (
            f"{HEADER}\n1,1\n2,2\n#\n2,3\n4,4\n",
            "wall.csv, line 5: radius does not increase; allowed: strictly increasing radii",
        ),
        (
            f"{HEADER}\n1,1\n2,2\n3,3\n4,3\n",
            "wall.csv, line 5: pressure does not increase; allowed: strictly increasing pressures",
        ),
    ],
)
def test_what_is_no_increasing_curve_is_refused(read, text, message):
    with pytest.raises(ColumnFileError) as caught:
        read(text)
    assert str(caught.value) == message


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(ColumnFileError, match=r"none\.csv: No such file"):
        read_wall_curve(tmp_path / "none.csv")
