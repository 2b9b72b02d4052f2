"""On dark paper the parts of a figure differ as they do on white."""

import pytest

from reports.figures.budget_bars import _COLOURS
from reports.figures.colours import HATCH
from reports.html.picture import _ON_DARK


def test_parts_of_a_budget_differ_on_dark_paper() -> None:
    assert len({_ON_DARK.get(colour, colour) for colour in _COLOURS}) == len(_COLOURS)


@pytest.mark.parametrize("colour", [HATCH])
def test_what_lies_on_colours_is_the_same_on_dark_paper(colour: str) -> None:
    assert colour not in _ON_DARK
    assert min(int(colour[k : k + 2], 16) for k in (1, 3, 5)) > 0xF0
