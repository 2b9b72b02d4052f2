"""Section flow with the lumen's edge taken round instead of through the mesh's flat faces.

½ ∫ u R² dφ with the radius that follows the nodes: the flow of the smooth field that nodal values stand for,
as the reduced model defines its own. It does not balance mass in the mesh, whose lumen is smaller, so it
stands beside the flow that is compared, and tells how much of a difference the mesh's sides account for.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from cases.results.metric_row import MetricRow
from validation.metrics.rows import Models
from validation.metrics.statistics import relative_error, rms


def curved_flow_rate(fields: xr.Dataset) -> xr.DataArray:
    """Flow rate ½ Σ u R² Δφ of each section, (time, x), m³/s."""
    dphi = 2.0 * np.pi / fields.sizes["phi"]
    return (0.5 * dphi * fields["mean_velocity"] * fields["radius"] ** 2).sum("phi", skipna=False)


def curved_section_rows(models: Models, attributes: Mapping[str, Any]) -> Iterator[MetricRow]:
    """Error of the 2D section flow against it: at the tabulated sections and instants, and pooled."""
    if models.sparse:
        return
    flow = curved_flow_rate(models.reference).to_numpy()
    rom = models.rom["section_flow_rate"].to_numpy()
    error = relative_error(rom, flow)
    yield models.row("section_flow_rate", "curved_rms_error", error=None if error is None else rms(error))
    times = models.reference["time"].to_numpy()
    for t in attributes["compare_times_s"]:
        n = int(np.argmin(np.abs(times - t)))
        for i in attributes["compare_i"]:
            yield models.row(
                "section_flow_rate",
                "curved_section",
                i=int(i),
                t_s=float(t),
                rom=float(rom[n, i - 1]),
                reference=float(flow[n, i - 1]),
                error=None if error is None else float(error[n, i - 1]),
            )
