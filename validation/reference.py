"""Where 3D data comes from: one protocol, one registry.

A kind of reference is a function from a case, its rays and a progress callback to a
:class:`Reference`; :data:`REFERENCES` holds one per ``reference.kind`` of the case file.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import xarray as xr

from cases.schema import Case
from validation.alignment import Alignment
from validation.rays import Rays

Progress = Callable[[float, float], None]


@dataclass(frozen=True)
class Reference:
    """3D data on the cells of the reduced model.

    Attributes
    ----------
    fields : xarray.Dataset
        On time (s into the last cycle), x, phi and y: pressure, radius, mean_velocity,
        profile_exponent, profile_error, sector_flow_rate, section_flow_rate, section_pressure,
        axial_velocity, radial_velocity, azimuthal_velocity, mass_defect, backflow_fraction,
        axial_dominance_radial, axial_dominance_azimuthal, axis_velocity_spread. SI.
    checks : xarray.Dataset
        Flow rates found independently: inlet_flow_rate, inlet_area on time; plane_flow_rate on
        (check_time, check_x). SI.
    alignment : Alignment
        How its states lie in the cycle.
    description : dict
        For provenance: file, software, mesh, states.
    notes : tuple of str
        What a reader must know.
    warnings : tuple of str
        What casts doubt on the reference.
    """

    fields: xr.Dataset
    checks: xr.Dataset
    alignment: Alignment
    description: dict[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...] = ()


ReferenceReader = Callable[[Case, Rays, Progress | None], Reference]
