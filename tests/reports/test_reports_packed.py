import base64
import json
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from reports.result.load import load
from reports.sections.content import report
from reports.sections.parts.page_data import ABSENT, LEVELS, Packed, pack


def unpack(packed: Packed) -> np.ndarray:
    """What the page's script does, written down again."""
    octets = np.frombuffer(zlib.decompress(base64.b64decode(packed.data)), dtype=np.uint8)
    low, high = octets.reshape(2, -1).astype(np.uint16)
    whole = (low | high << 8).reshape(packed.shape)
    for axis in range(whole.ndim):
        whole = np.cumsum(whole, axis=axis, dtype=np.uint16)
    return np.where(whole == ABSENT, np.nan, packed.low + packed.step * whole)


@given(
    arrays.arrays(
        np.float64,
        arrays.array_shapes(min_dims=1, max_dims=4, max_side=5),
        elements=st.one_of(st.floats(-1e6, 1e6), st.sampled_from([np.nan, np.inf])),
    )
)
def test_values_come_back_to_a_part_in_sixty_thousand_of_their_range(values: np.ndarray) -> None:
    back = unpack(pack(values))
    finite = np.isfinite(values)
    assert np.array_equal(np.isfinite(back), finite)
    if finite.any():
        span = np.ptp(values[finite])
        assert (
            np.abs(back - values)[finite].max() <= 0.51 * span / LEVELS + 1e-9 * np.abs(values[finite]).max()
        )


def test_smooth_fields_take_a_third_of_their_whole_numbers() -> None:
    t, x, phi = np.meshgrid(
        np.linspace(0, 1, 41), np.linspace(0, 1, 120), np.linspace(0, 6, 48), indexing="ij"
    )
    packed = pack(np.sin(9 * t) * (1 + 0.1 * np.cos(phi) * x))
    assert len(packed.data) < 2 * t.size / 3


def test_the_page_has_every_metric_and_every_cell(finished: tuple[Path, list[dict[str, Any]]]) -> None:
    directory, rows = finished
    data = json.loads(report(load(directory)).page_data())
    columns = json.loads(zlib.decompress(base64.b64decode(data["metrics"])))
    assert len(columns["error"]) == len(rows)
    assert data["models"] == [{"name": "rom", "label": "2D"}]
    field = data["fields"]["radius"]
    assert field["unit"] == "mm"
    assert [packed["shape"] for packed in field["values"]["rom"]] == [[11, 12, 8]] * 3
    assert data["named"][0]["name"] == "systole"


@pytest.mark.parametrize(("value", "shown"), [(np.inf, np.nan), (250.0, np.nan), (99.0, 99.0)])
def test_plug_flow_does_not_coarsen_other_exponents(
    tmp_path: Path, small: synthetic.Setup, value: float, shown: float
) -> None:
    synthetic.write(tmp_path, small)
    fields = synthetic.fields(small)
    fields["rom_profile_exponent"][0, 0, 0, 0] = value
    synthetic.dataset(small, fields).to_netcdf(tmp_path / "comparison.nc")
    data = json.loads(report(load(tmp_path)).page_data())["fields"]["profile_exponent"]["values"]["rom"][0]
    back = unpack(Packed(tuple(data["shape"]), data["low"], data["step"], data["data"]))
    assert back[0, 0, 0] == pytest.approx(shown, nan_ok=True)
