"""Fields of a reference that states some values only: NaN for all others."""

import numpy as np
from numpy.typing import NDArray

from cases.fields import FIELDS
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment

RAY_FIELDS = ("axial_velocity", "radial_velocity", "azimuthal_velocity")
COMPARED = (
    *("pressure", "radius", "mean_velocity", "profile_exponent", "profile_error", "section_pressure"),
    "section_pressure_range",
    *("mass_defect", "backflow_fraction", "axis_velocity_spread"),
    *("section_flow_rate", "sector_flow_rate", "axial_dominance_radial", "axial_dominance_azimuthal"),
)


def nothing_stated(rays: Rays, alignment: Alignment, *further: str) -> dict[str, NDArray[np.floating]]:
    """Fields that a comparison asks of every reference, and ``further`` ones, NaN everywhere."""
    sizes = dict(zip(("x", "phi", "y"), rays.shape, strict=True)) | {"time": alignment.cycle_times.size}
    return {
        name: np.full(
            [sizes[dim] for dim in FIELDS[name].dims],
            np.nan,
            np.float32 if name in RAY_FIELDS else np.float64,
        )
        for name in (*COMPARED, *RAY_FIELDS, *further)
    }
