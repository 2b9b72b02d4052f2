"""An entry of the cache of results, for tests and for processes that they start."""

import numpy as np
import xarray as xr

from validation.runs.cache import Entry


def entry(size: int = 8) -> Entry:
    values = np.random.default_rng(1).normal(size=(size, 3))
    values[0, 0] = np.inf
    data = xr.Dataset(
        {"pressure": (("time", "x"), values, {"units": "Pa"}), "single": ("x", np.float32([1, 2, 3]))},
        coords={"time": np.arange(size) * 0.1, "x": ("x", [0.5, 1.5, 2.5], {"units": "m"})},
    )
    return Entry({"fields": data}, {"notes": ["äöφ"], "change": 0.1})
