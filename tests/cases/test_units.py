import math
from decimal import Decimal

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from cases.errors import QuantityError
from cases.fields import FIELDS
from cases.quantities import compared_quantities
from cases.values.common_units import BASES, UNITS, common_unit
from cases.values.units import DIMENSION_OF_UNIT, DIMENSIONS, _base_units, parse_quantity, parse_ratio

FACTORS = {
    ("length", "mm"): "0.001",
    ("length", "µm"): "0.000001",
    ("length", "cm"): "0.01",
    ("time", "ms"): "0.001",
    ("time", "min"): "60",
    ("velocity", "cm/s"): "0.01",
    ("velocity", "cm s^-1"): "0.01",
    ("velocity", "m s-1"): "1",
    ("pressure", "kPa"): "1000",
    ("pressure", "MPa"): "1000000",
    ("pressure", "dyn/cm^2"): "0.1",
    ("pressure", "mmHg"): "133.322387415",
    ("pressure", "cmH2O"): "98.0665",
    ("density", "g/cm^3"): "1000",
    ("density", "kg/m³"): "1",
    ("viscosity", "mPa s"): "0.001",
    ("viscosity", "Pa·s"): "1",
    ("viscosity", "Pa*s"): "1",
    ("viscosity", "poise"): "0.1",
    ("flow rate", "cm3/s"): "0.000001",
    ("flow rate", "ml/s"): "0.000001",
    ("resistance", "Pa s/m^3"): "1",
    ("resistance", "dyn s/cm^5"): "100000",
    ("angle", "rad"): "1",
}
finite = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e280, max_value=1e280)


@given(finite, st.sampled_from(sorted(FACTORS)))
def test_a_quantity_is_the_float_closest_to_its_exact_decimal_value(value, kind):
    name, unit = kind
    exact = Decimal(repr(value)) * Decimal(FACTORS[kind])
    assert parse_quantity(f"{value!r} {unit}", DIMENSIONS[name]) == float(exact)


@given(st.floats(min_value=-1e3, max_value=1e3))
def test_degrees_become_radians(angle):
    assert parse_quantity(f"{angle!r} deg", DIMENSIONS["angle"]) == pytest.approx(
        math.radians(angle), rel=1e-15, abs=1e-300
    )


def test_a_full_turn_is_two_pi_to_the_last_bit():
    assert parse_quantity("360 deg", DIMENSIONS["angle"]) == 2 * math.pi


@given(finite, st.sampled_from(["15{} mm", "{} mm", " {}mm ", "{}\tmm"]))
def test_blanks_do_not_matter(value, form):
    text = form.format(repr(value)) if "15" not in form else "15 mm"
    assert parse_quantity(text, DIMENSIONS["length"]) == parse_quantity(text.strip(), DIMENSIONS["length"])


@given(
    st.text() | st.from_regex(r"[0-9.]+ ?[a-zA-Zµ°%/*^ 0-9-]+", fullmatch=True),
    st.sampled_from(sorted(DIMENSIONS)),
)
def test_any_text_is_a_finite_quantity_or_refused(text, name):
    try:
        value = parse_quantity(text, DIMENSIONS[name])
    except QuantityError:
        return
    assert math.isfinite(value)


@pytest.mark.parametrize(
    ("text", "dimension", "reason"),
    [
        (0.5, "length", "no unit"),
        (15, "length", "no unit"),
        ("15", "length", "no unit"),
        ("1e5", "pressure", "no unit"),
        ("15 s", "length", "s is no unit of length"),
        ("15 mm rad", "length", "mm rad is no unit of length"),
        ("15 %", "angle", "% is no unit of angle"),
        ("37 degC", "pressure", "degC is no unit of pressure"),
        ("15 mmm", "length", "unknown unit mmm; did you mean mm?"),
        ("15 mpa", "pressure", "unknown unit mpa; did you mean MPa?"),
        ("15 xyzzy", "length", "unknown unit xyzzy"),
        ("15 nan", "length", "unknown unit nan"),
        ("15 m^0", "length", "not a number with a unit"),
        ("1e999 m", "length", "out of range"),
        ("1e9999999999999999999999 m", "length", "out of range"),
        ("nan m", "length", "not a number with a unit"),
        ("inf m", "length", "not a number with a unit"),
        ("2,5 mm", "length", "not a number with a unit"),
        ("15³ mm", "length", "not a number with a unit"),
        ("2*3 mm", "length", "not a number with a unit"),
        ("1 m**1", "length", "not a number with a unit"),
        ("__import__('os') m", "length", "not a number with a unit"),
        ("1 " + "m" * 200, "length", "not a number with a unit"),
        ("", "length", "not a number with a unit"),
        (None, "length", "not a number with a unit"),
        (True, "length", "not a number with a unit"),
    ],
)
def test_what_is_no_quantity_is_refused_with_its_reason(text, dimension, reason):
    with pytest.raises(QuantityError) as caught:
        parse_quantity(text, DIMENSIONS[dimension])
    assert str(caught.value) == reason


@pytest.mark.parametrize(
    ("text", "ratio"), [("2 %", 0.02), ("2%", 0.02), (0.02, 0.02), ("0.02", 0.02), (1, 1.0)]
)
def test_ratios(text, ratio):
    assert parse_ratio(text) == ratio


@pytest.mark.parametrize("text", ["2 mm", "2 % %", "%", "", None, True, float("nan"), "1e999 %"])
def test_what_is_no_ratio_is_refused(text):
    with pytest.raises(QuantityError):
        parse_ratio(text)


def test_every_compared_quantity_can_carry_a_limit():
    units = {FIELDS[name].unit for name in compared_quantities()}
    assert units <= {"1", *DIMENSION_OF_UNIT}


@pytest.mark.parametrize("dimension", DIMENSIONS.values(), ids=DIMENSIONS)
def test_suggested_units_belong_to_their_dimension(dimension):
    for unit in dimension.common_units:
        assert parse_quantity(f"1 {unit}", dimension) > 0


POWERS = ("", "2", "^3", "-1", "^-2")
TERMS = st.tuples(st.sampled_from(sorted(UNITS)), st.sampled_from(POWERS)).map("".join)


@given(TERMS, st.lists(st.tuples(st.sampled_from((" ", "/", "*", " / ")), TERMS).map("".join), max_size=3))
@example("ml", ["/mmHg"])
@example("mmHg", [" s", "/ml"])
def test_units_that_are_known_without_pint_are_those_of_pint(first, others):
    unit = first + "".join(others)
    factor, exponents = common_unit(unit)
    theirs, base = _base_units(unit)
    assert float(factor) == float(theirs)
    powers = [f"{name}^{power}" for name, power in zip(BASES, exponents, strict=True) if power]
    assert base == _base_units(" ".join(powers) or "m/m")[1]


@pytest.mark.parametrize("unit", ["cmH2O", "mm2kg", "mm °", "mm %", "inch", "Mm", "mm cmH2O"])
def test_any_other_unit_is_left_to_pint(unit):
    assert common_unit(unit) is None


def test_every_suggested_unit_is_known_without_pint():
    for dimension in DIMENSIONS.values():
        for unit in (dimension.unit, *dimension.common_units):
            assert common_unit(unit) is not None, unit
