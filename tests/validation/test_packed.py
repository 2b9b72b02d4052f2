"""Values of cells in blocks as HDF5 packs them: as arrays, in the cache, and in comparison.nc."""

import h5py
import netCDF4
import numpy as np
import pytest
import xarray as xr

from validation.compare.comparison_file import comparison_file
from validation.runs import packed as packing
from validation.runs.cache import Cache, Entry
from validation.runs.packed import Packed, pack, packed_of, with_packed

SHAPE = (5, 11, 6, 4)  # 11 columns fill no whole number of blocks


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch):
    monkeypatch.setattr(packing, "BLOCK", 4 * 5 * 6 * 4 * 4)  # 4 columns of a field on rays


@pytest.fixture
def fields():
    rng = np.random.default_rng(2)
    rays = rng.normal(size=SHAPE).astype(np.float32)
    cells = rng.normal(size=SHAPE[:3])
    cells[0, 0, 0], cells[1, 2, 3] = np.nan, np.inf
    axes = ("time", "x", "phi", "y")
    data = {
        "axial_velocity": (axes, rays, {"units": "m s-1"}),
        "pressure": (axes[:3], cells, {"units": "Pa"}),
        "section_pressure": (axes[:2], cells[..., 1], {"units": "Pa"}),
    }
    return xr.Dataset(data, coords={name: np.arange(float(n)) for name, n in zip(axes, SHAPE, strict=True)})


@pytest.mark.parametrize(
    "key",
    [
        np.s_[...],
        np.s_[2],
        np.s_[:, 3],
        np.s_[:, -1, 2],
        np.s_[1:3, 2:9:3],
        np.s_[..., 0],
        np.s_[[0, 4]],
        np.s_[:, [10, 0], 1:],
        np.ix_([1, 3], [10, 2, 2], [5], [0, 1]),
        np.s_[:, np.arange(11) > 8],
    ],
)
def test_indexed_as_the_array(fields, key):
    values = fields["axial_velocity"].to_numpy()
    np.testing.assert_array_equal(pack(values)[key], values[key])


def test_computed_with_as_the_array(fields):
    given, kept = fields["axial_velocity"], with_packed(fields)["axial_velocity"]
    assert isinstance(kept.data, Packed)
    for work in (
        lambda v: v.max(("x", "y")),
        lambda v: 2 * v - v**2,
        lambda v: v.isel(x=[7, 1], phi=2).astype(float).mean(),
        lambda v: xr.concat([v, v], "x"),
    ):
        xr.testing.assert_identical(work(kept), work(given))


def test_the_cache_keeps_what_is_packed(tmp_path, fields):
    store = Cache(tmp_path)
    store.put("a", Entry({"fields": with_packed(fields)}, {}))
    found = store.get("a").datasets["fields"]
    xr.testing.assert_identical(found.map(lambda v: v.copy(data=v.to_numpy()), keep_attrs=True), fields)
    for name in ("axial_velocity", "pressure"):
        assert packed_of(found[name]).blocks == pack(fields[name].to_numpy()).blocks


def test_values_changed_since_are_packed_anew(fields):
    kept = with_packed(fields)
    for changed in (kept["pressure"] * 2, kept["pressure"].isel(x=slice(None, None, -1))):
        np.testing.assert_array_equal(packed_of(changed), changed.to_numpy())


def test_comparison_file_holds_the_blocks_and_any_netcdf_reads_them(tmp_path, fields):
    path = tmp_path / "comparison.nc"
    with comparison_file(path, ["none", "local"], {"case": "made"}) as stored:
        stored.write("local", with_packed(fields) * 1)  # packed here
        stored.write("none", with_packed(fields))
    with xr.open_dataset(path) as found:
        for name, given in fields.data_vars.items():
            assert found[name].dims == ("variant", *given.dims)
            assert found[name].dtype == given.dtype
            for variant in ("none", "local"):
                np.testing.assert_array_equal(found[name].sel(variant=variant), given)
    with netCDF4.Dataset(path) as found:
        assert found["axial_velocity"].filters()["zlib"]
        assert found["axial_velocity"].chunking() == [1, 5, 4, 6, 4]
    with h5py.File(path) as found:
        _, block = found["pressure"].id.read_direct_chunk((0, 0, 0, 0))
        assert block == pack(fields["pressure"].to_numpy()).blocks[0]
