"""A wall that is a solid: finite elements through its thickness, which answer pressure by the lumen's radius.

Trilinear hexahedra with 2 × 2 × 2 points of Saint Venant–Kirchhoff material move across the axis, not along
it; the pressure p follows the deformed lumen. The displacements make the potential energy

    Π = ∫ [½λ (tr E)² + μ E:E] dV − ∫ p A dx,    E = ½(FᵀF − I),

stationary, A the area of the lumen's polygon. Both ends are free; at φ = 0, π/2, π, 3π/2 the wall moves
radially only. FEBio's wall is the same on the same elements ("isotropic elastic", Bonet and Wood 2008,
section 6.4); trilinear elements are too stiff where few (ν near ½), the same elements equally so.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded

from cases.arrays import Flags, Floats, Integers
from solver.errors import ModelError
from solver.schemes.solid_wall import add_elements, add_pressure, hold

CLOSE = 1e-5  # of R₀: after a Newton step this small the error is about its square
MOST_STEPS = 12  # of Newton's method
CORNERS = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])  # along, around, outwards
POINTS = 0.5 + (CORNERS - 0.5) / np.sqrt(3)


@dataclass(frozen=True)
class Solid:
    """A tube's elements: stacks along it, sectors around it (a multiple of 4), layers through its wall.

    Attributes
    ----------
    length, radius, thickness : float
        Of the unloaded wall, its radius that of the lumen R₀, m.
    moduli : ndarray (n_stacks, n_sectors)
        E, Pa.
    poisson_ratio : float
        ν < ½.
    n_layers : int
        Layers through the wall.
    """

    length: float
    radius: float
    thickness: float
    moduli: Floats
    poisson_ratio: float
    n_layers: int

    def __post_init__(self) -> None:
        if self.moduli.ndim != 2 or self.moduli.shape[1] < 8 or self.moduli.shape[1] % 4:
            raise ModelError("a solid wall needs a multiple of 4 elements around the artery, 8 or more")
        if not np.all(np.isfinite(self.moduli) & (self.moduli > 0)):
            raise ModelError("a solid wall needs a finite, positive Young's modulus in every element")
        if not 0 <= self.poisson_ratio < 0.5:
            raise ModelError("a solid wall needs a Poisson's ratio from 0 on, less than 0.5")

    @cached_property
    def places(self) -> Floats:
        """Places x of the planes between stacks, m, (n_stacks + 1,)."""
        return np.linspace(0.0, self.length, len(self.moduli) + 1)

    @cached_property
    def nodes(self) -> Integers:
        """Numbers of the nodes, (n_stacks + 1, n_sectors, n_layers + 1), so that neighbours' are close."""
        planes, around = len(self.moduli) + 1, self.moduli.shape[1]
        layers = self.n_layers + 1
        j = np.arange(around)
        folded = np.where(2 * j < around, 2 * j, 2 * (around - 1 - j) + 1)  # j and m − 1 − j side by side
        plane = np.arange(planes)[:, None, None] * around
        return np.asarray((plane + folded[:, None]) * layers + np.arange(layers))

    @cached_property
    def unloaded(self) -> Floats:
        """Positions across the axis of the unloaded nodes by number, m, (n_nodes, 2)."""
        n_sectors = self.moduli.shape[1]
        angle = 2 * np.pi * np.arange(n_sectors) / n_sectors
        outwards = np.linspace(self.radius, self.radius + self.thickness, self.n_layers + 1)
        rays = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        found = np.empty((self.nodes.size, 2))
        found[self.nodes] = rays[:, None, :] * outwards[:, None]
        return found

    @cached_property
    def held(self) -> Flags:
        """Which displacements are zero, (2 n_nodes,)."""
        quarter = self.moduli.shape[1] // 4
        found = np.zeros((self.nodes.size, 2), dtype=bool)
        found[self.nodes[:, :: 2 * quarter], 1] = True
        found[self.nodes[:, quarter :: 2 * quarter], 0] = True
        return found.ravel()

    @cached_property
    def elements(self) -> tuple[Integers, Floats, Floats, Floats]:
        """Nodes, gradients and weights of quadrature points, and λ and μ, of all elements as the kernel's."""
        around = np.concatenate([self.nodes, self.nodes[:, :1]], axis=1)
        last = tuple(size - 1 for size in around.shape)
        corners = [
            around[tuple(slice(c, c + n) for c, n in zip(corner, last, strict=True))].ravel()
            for corner in CORNERS
        ]
        nodes = np.stack(corners, axis=1)
        x = np.empty(self.nodes.size)
        x[self.nodes] = self.places[:, None, None]
        positions = np.concatenate([self.unloaded, x[:, None]], axis=1)[nodes]
        gradients, weights = zip(*(_at_point(point, positions) for point in POINTS), strict=True)
        modulus = np.repeat(self.moduli.ravel(), self.n_layers)
        nu = self.poisson_ratio
        shear = modulus / (2 * (1 + nu))
        lame = np.stack([2 * shear * nu / (1 - 2 * nu), shear], axis=1)
        return nodes, np.stack(gradients, axis=1), np.stack(weights, axis=1), lame

    @property
    def width(self) -> int:
        """Diagonals of the stiffness matrix on one side, the main one among them."""
        nodes = self.elements[0]
        return int(2 * np.max(np.ptp(nodes, axis=1)) + 2)


def _at_point(point: Floats, positions: Floats) -> tuple[Floats, Floats]:
    """Gradients (n_e, 8, 3) and volume (n_e,) of one of eight points, from corners (n_e, 8, 3)."""
    factors = np.where(CORNERS == 1, point, 1 - point)
    signs = 2.0 * CORNERS - 1
    natural = np.stack(
        [signs[:, k] * np.prod(np.delete(factors, k, axis=1), axis=1) for k in range(3)], axis=1
    )
    jacobian = np.einsum("eai,ak->eik", positions, natural)
    gradients = np.einsum("ak,eki->eai", natural, np.linalg.inv(jacobian))
    return gradients, np.abs(np.linalg.det(jacobian)) / 8


def equilibrium(solid: Solid, pressure: Floats, start: Floats) -> Floats:
    """Displacements under a pressure for each stack, by Newton's method.

    Parameters
    ----------
    solid : Solid
    pressure : ndarray (n_stacks,)
        Over the one that the wall is unloaded at, Pa.
    start : ndarray (n_nodes, 2)
        First guess, m.

    Returns
    -------
    ndarray (n_nodes, 2)
        m.

    Raises
    ------
    ModelError
        Where no stable equilibrium is near the first guess: the wall buckles or runs away.
    """
    moved, load = start.copy(), pressure * np.diff(solid.places)
    share = np.array([[1.0, 0.5], [0.5, 1.0]]) / 3
    lumen = np.ascontiguousarray(solid.nodes[:, :, 0])
    for _ in range(MOST_STEPS):
        force, band = np.zeros(moved.size), np.zeros((moved.size, solid.width))
        add_elements(*solid.elements, moved, force, band)
        add_pressure(lumen, load, solid.unloaded + moved, share, force, band)
        hold(solid.held, force, band)
        try:
            factor = cholesky_banded(band.T, overwrite_ab=True, lower=True, check_finite=False)
        except LinAlgError:
            break
        change = cho_solve_banded((factor, True), force, check_finite=False).reshape(moved.shape)
        moved -= change
        largest = float(np.max(np.abs(change)))
        if largest < CLOSE * solid.radius:
            return moved
        if not largest < solid.radius:
            break
    raise ModelError(f"the solid wall has no stable equilibrium at {float(np.max(pressure)):g} Pa")


def lumen_radius(solid: Solid, moved: Floats, x: Floats, phi: Floats) -> Floats:
    """R at places x, m, and spatial angles φ, (n_x, n_phi), m: linear between nodes in x, φ and r.

    Raises
    ------
    ModelError
        Where the wall folds over: an angle is met twice.
    """
    nodes = solid.nodes[:, :, 0]
    y, z = np.moveaxis((solid.unloaded + moved)[nodes], -1, 0)
    unloaded = 2 * np.pi * np.arange(nodes.shape[1]) / nodes.shape[1]
    angle = unloaded + (np.arctan2(z, y) - unloaded + np.pi) % (2 * np.pi) - np.pi
    if np.any(np.diff(angle, axis=1) <= 0):
        raise ModelError("the solid wall folds over itself")
    place = np.clip(x / solid.length, 0, 1) * (len(nodes) - 1)
    first = np.minimum(place.astype(int), len(nodes) - 2)
    share = (place - first)[:, None]
    angles = (1 - share) * angle[first] + share * angle[first + 1]
    distance = np.hypot(y, z)
    radii = (1 - share) * distance[first] + share * distance[first + 1]
    return np.stack([np.interp(phi, a, r, period=2 * np.pi) for a, r in zip(angles, radii, strict=True)])
