"""A reference that states a few cells only: what cannot be drawn is said."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from reports import artery
from reports.blocks import Paragraph
from reports.page_data import _artery


def comparison(reference):
    shape = ("variant", "time", "x", "phi")
    fields = xr.Dataset(
        {"reference_radius": (shape, reference), "rom_radius": (shape, np.ones((1, 2, 3, 4)))}
    )
    return SimpleNamespace(fields=fields, times=(("systole", 0.1),), states=(0,))


@pytest.mark.parametrize("missing", [1, 24])
def test_an_artery_without_all_radii_is_not_drawn(missing):
    radius = np.ones(24)
    radius[:missing] = np.nan
    sparse = comparison(radius.reshape(1, 2, 3, 4))
    (told,) = artery.section(sparse).blocks
    assert isinstance(told, Paragraph)
    assert "does not state the radius" in told.text
    assert _artery(sparse) is None


def test_a_whole_artery_has_a_shape():
    assert artery.has_shape(comparison(np.ones((1, 2, 3, 4))))
