import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.wording import numbers

finite = st.floats(min_value=-1e9, max_value=1e9)


@given(finite, st.integers(0, 6))
def test_fixed_text_is_the_value_to_half_a_last_digit(value: float, decimals: int) -> None:
    text = numbers.fixed(value, decimals)
    read = float(text.replace("−", "-"))
    assert math.isclose(read, value, abs_tol=0.5 * 10.0**-decimals + 2 * math.ulp(value))
    assert "-" not in text


@given(finite.filter(lambda v: abs(v) > 1e-3))
def test_four_significant_digits_are_kept(value: float) -> None:
    read = float(numbers.rounded(value, 4).replace("−", "-"))
    assert math.isclose(read, value, rel_tol=5.0001e-4)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "—"),
        (math.nan, "—"),
        (math.inf, "∞"),
        (-math.inf, "−∞"),
        (-1e-12, "0.00"),
        (-4.705, "−4.71"),
    ],
)
def test_fixed(value: float | None, text: str) -> None:
    assert numbers.fixed(value, 2) == text


@pytest.mark.parametrize(
    ("ratio", "text"),
    [(0.0123, "+1.23 %"), (-0.5, "−50.00 %"), (0.0, "0.00 %"), (1e-9, "0.00 %"), (None, "—")],
)
def test_percent_has_a_sign_unless_it_is_zero(ratio: float | None, text: str) -> None:
    assert numbers.percent(ratio).replace("\u00a0", " ") == text


def test_round_off_is_not_given_digits() -> None:
    assert numbers.rounded(3.2e-14) == "0"
    assert numbers.decimals_for([1e-14, None, math.inf], 3, most=3) == 3


def test_lists_read_as_english() -> None:
    assert [numbers.listed(items) for items in ([], [1], [1, 2], [1, 2, 3])] == [
        "",
        "1",
        "1 and 2",
        "1, 2 and 3",
    ]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0 %"),
        (8.8e-11, "< 0.01 %"),
        (-4e-5, "< 0.01 %"),
        (-0.0081, "0.81 %"),
        (1.0, "100.00 %"),
        (None, "—"),
    ],
)
def test_a_share_too_small_for_its_decimals_is_not_zero(value: float | None, text: str) -> None:
    assert numbers.share(value).replace("\u00a0", " ") == text
