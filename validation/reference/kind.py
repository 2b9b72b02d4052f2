"""Where 3D data comes from: the protocol that a kind of reference follows.

A kind is one module that holds a :class:`ReferenceKind` named ``KIND`` and a section of the case file;
:mod:`cases.sections.references.kinds` registers both.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import xarray as xr

from cases.sections.case import Case
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment

Progress = Callable[[float, float], None]
HowToMake = Callable[[Any, Path, str], list[str]]


@dataclass(frozen=True)
class Reference:
    """3D data on the cells of the reduced model.

    Attributes
    ----------
    fields : xarray.Dataset
        On time (s into the last cycle), x, phi and y: pressure, radius, mean_velocity,
        profile_exponent, profile_error, axis_velocity, profile_bend,
        two_mode_error, sector_flow_rate, section_flow_rate, section_pressure,
        section_pressure_range, axial_velocity, radial_velocity, azimuthal_velocity, mass_defect,
        backflow_fraction, axial_dominance_radial, axial_dominance_azimuthal, axis_velocity_spread. SI.
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
        What casts doubt on a comparison with it.
    sparse : bool
        Whether NaN stands for what the reference does not state, rather than for something wrong.
    cycle : mapping of str to float
        Numbers of the whole cycle that the reference states itself, SI, by name of the quantity; they
        count instead of those found from ``fields``.
    """

    fields: xr.Dataset
    checks: xr.Dataset
    alignment: Alignment
    description: dict[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...] = ()
    sparse: bool = False
    cycle: Mapping[str, float] = field(default_factory=dict)


def nothing_to_make(_stated: Any, _case: Path, _variant: str) -> list[str]:
    """Tell of a reference that its files must exist."""
    return []


@dataclass(frozen=True)
class ReferenceKind:
    """How a kind of reference is read.

    Attributes
    ----------
    align : callable (case) -> Alignment
        The instants that the reference has, at little cost: the reduced model runs through them, and those
        that other variants lack are left out.
    read : callable (case, rays, progress, alignment) -> Reference
        Data at the instants of ``alignment`` on ``rays``; calls ``progress(done, total)``, if given. Both
        raise a `ValidationError` or an error of the file's reader with one line that names the file.
    how_to_make : callable (section, path of the case file, variant) -> list of str
        What to do about files that are yet to be computed, in lines; none where they are there.
    """

    align: Callable[[Case], Alignment]
    read: Callable[[Case, Rays, Progress | None, Alignment | None], Reference]
    how_to_make: HowToMake = nothing_to_make
