"""What a model of an artery is made of, in SI units and radians; nothing here knows case files or XML."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from cases.arrays import Floats
from febio_io.errors import FebioError

Core = Literal["wedges", "o_grid"]
LARGEST_MESH = 50_000_000  # elements; FEBio numbers nodes and elements with 32 bits


class FebioModelError(FebioError):
    """What is asked for cannot be made a FEBio model; the message says what is allowed."""


@dataclass(frozen=True)
class Frame:
    """Where the artery lies in FEBio's coordinates.

    Attributes
    ----------
    axis : {"x", "y", "z"}
        Direction of the axis and of the flow.
    phi_zero : str
        Direction of φ = 0, across the axis: "x", "y", "z", "-x", "-y" or "-z".
    origin : tuple of float
        Centre of the inlet, m.
    """

    axis: str = "z"
    phi_zero: str = "x"
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def rotation(self) -> Floats:
        """Rows: unit vectors towards φ = 0, towards φ = π/2, and along the axis; (3, 3)."""
        along, first = _direction(self.axis), _direction(self.phi_zero)
        return np.array([first, np.cross(along, first), along])


def _direction(name: str) -> Floats:
    unit = np.zeros(3)
    unit["xyz".index(name[-1])] = -1.0 if name.startswith("-") else 1.0
    return unit


@dataclass(frozen=True)
class Vessel:
    """The unloaded artery: length, lumen radius and wall thickness in m."""

    length: float
    radius: float
    thickness: float


@dataclass(frozen=True)
class MeshSize:
    """Elements around the axis, from it to the wall, through the wall and along it.

    Attributes
    ----------
    n_theta : int
        A multiple of 4, as nodes at φ = 0, π/2, π and 3π/2 are supported; 8 or more.
    n_r : int
        2 or more; with wedges at the axis, those count too.
    n_wall, n_z : int
        1 or more.
    bias : float
        Radial size of the innermost elements over that of those at the wall; 1 for equal ones.
    core : {"wedges", "o_grid"}
        Wedges (penta6) that meet in the axis, or a square of hexahedra (hex8), which needs a multiple of 8
        elements around. All other elements are hexahedra.
    """

    n_theta: int = 24
    n_r: int = 8
    n_wall: int = 3
    n_z: int = 30
    bias: float = 1.0
    core: Core = "wedges"

    def __post_init__(self) -> None:
        share = 8 if self.core == "o_grid" else 4
        if self.n_theta < 8 or self.n_theta % share:
            raise FebioModelError(
                f"mesh: {self.n_theta} elements around; allowed: a multiple of {share} from 8 on"
            )
        for name, count, least in (
            ("from the axis to the wall", self.n_r, 2),
            ("through the wall", self.n_wall, 1),
            ("along the artery", self.n_z, 1),
        ):
            if count < least:
                raise FebioModelError(f"mesh: {count} elements {name}; allowed: {least} or more")
        if self.n_elements > LARGEST_MESH:
            raise FebioModelError(f"mesh: {self.n_elements} elements; allowed: up to {LARGEST_MESH}")
        if not 0.05 <= self.bias <= 20:
            raise FebioModelError(f"mesh: a bias of {self.bias:g}; allowed: 0.05 to 20")

    @property
    def n_elements(self) -> int:
        """Elements of the whole mesh."""
        squares = (self.n_theta // 4) ** 2 if self.core == "o_grid" else 0
        return (squares + self.n_theta * (self.n_r + self.n_wall)) * self.n_z

    @property
    def section_share(self) -> float:
        """Area of the lumen's section, a polygon, over the circle's."""
        turn = 2.0 * np.pi / self.n_theta
        return float(np.sin(turn) / turn)

    @property
    def core_elements(self) -> int:
        """Elements at the axis between two planes."""
        return (self.n_theta // 4) ** 2 if self.core == "o_grid" else self.n_theta


@dataclass(frozen=True)
class Blood:
    """A Newtonian fluid: density in kg/m³, dynamic viscosity in Pa s, bulk modulus in Pa."""

    density: float
    viscosity: float
    bulk_modulus: float = 2.2e9


@dataclass(frozen=True)
class Wall:
    """The wall's material: FEBio's name of it, Young's modulus (Pa), Poisson's ratio, density (kg/m³)."""

    law: str
    youngs_modulus: float
    poisson_ratio: float
    density: float = 1000.0


@dataclass(frozen=True)
class Patch:
    """Where the wall is calcified, through its whole thickness.

    Attributes
    ----------
    youngs_modulus : float
        Young's modulus there, Pa.
    x : tuple of float
        Its ends along the artery, m.
    phi : tuple of float or None
        Its ends around the artery, rad, from the first to the second in positive direction; None: all around.
    """

    youngs_modulus: float
    x: tuple[float, float]
    phi: tuple[float, float] | None = None


@dataclass(frozen=True)
class Curve:
    """A load curve: times in s, increasing, and values; straight between them, constant outside."""

    times: Floats
    values: Floats


@dataclass(frozen=True)
class Resistance:
    """P = offset + resistance × flow rate, both ramped; Pa s/m³ and Pa."""

    resistance: float
    offset: float


@dataclass(frozen=True)
class Windkessel:
    """C dP_c/dt = q − (P_c − P_v)/R₂, P = P_c + R₁ q; Pa s/m³, m³/Pa.

    Attributes
    ----------
    proximal_resistance, distal_resistance, compliance : float
        R₁, which is ramped, R₂ and C.
    distal_share : Curve
        By what R₂ is multiplied.
    offset : Curve
        P_v and, at the start, the charge that the capacitor does not hold yet, Pa.
    start : float
        Its periodic pressure where the cycles begin, Pa.
    cycles_from_rest : int
        Cycles in which it would come within 1 % of its periodic pressure without that charge.
    """

    proximal_resistance: float
    distal_resistance: float
    compliance: float
    distal_share: Curve
    offset: Curve
    start: float
    cycles_from_rest: int


@dataclass(frozen=True)
class PrescribedPressure:
    """A pressure over time, Pa."""

    pressure: Curve


Outlet = Resistance | Windkessel | PrescribedPressure


@dataclass(frozen=True)
class Timing:
    """Time stepping.

    Attributes
    ----------
    time_step : float
        Step, also the longest, s.
    n_steps : int
        Steps.
    stride : int
        Steps between states of the plot file.
    """

    time_step: float
    n_steps: int
    stride: int


@dataclass(frozen=True)
class ArteryModel:
    """A fluid-FSI model of a straight artery.

    Attributes
    ----------
    vessel, size, frame, blood, wall, patch, outlet, timing
        See their classes; `patch` is None without calcification.
    inflow : Curve
        Mean velocity at the inlet, m/s.
    ramp : Curve
        From 0 to 1: by what the outlet's values grow at the start.
    records : str or None
        First part of the names of the data records' files; None to have none.
    """

    vessel: Vessel
    size: MeshSize
    frame: Frame
    blood: Blood
    wall: Wall
    patch: Patch | None
    inflow: Curve
    ramp: Curve
    outlet: Outlet
    timing: Timing
    records: str | None = None
