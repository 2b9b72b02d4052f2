"""A wall that is one elastic sheet: a prestressed membrane on (x, φ) without axial displacement.

Row walls answer a pressure point by point; a real wall carries one hoop force around the ring and shear
along the axis. For displacements u_r(x, φ), u_φ(x, φ) of the unloaded cylinder r = R₀ and a pressure p over
the one that the wall is unloaded at, the energy

    Π = ½∬ [K ε² + p R₀ ω² + S ((∂_x u_r)² + (∂_x u_φ)²)] R₀ dφ dx
        − ∬ p [R₀ u_r + ½(u_r² + u_φ² + u_r ∂_φu_φ − u_φ ∂_φu_r)] dφ dx,
    ε = (u_r + ∂_φu_φ)/R₀,  ω = (∂_φu_r − u_φ)/R₀,  K = β + p R₀,  S = G h

is stationary where

    K ε − R₀ ∂_x(S ∂_x u_r) = p (R₀ + u_r + ∂²_φu_r),        −∂_φ(K ε) − R₀ ∂_x(S ∂_x u_φ) = 0.

Both ends are free, ∂_x u = 0. Uniform β gives u_r = p R₀²/β, the row law.

Differences: u_r lives at the centres of cells, u_φ on their φ-faces. Along φ they divide by 2 sin(Δφ/2)
instead of Δφ, which is as accurate and leaves the rigid motions of the tube free of stress.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from cases.arrays import Flags, Floats, Integers
from solver.errors import ModelError

QUARTERS, FREE = "quarters", "free"
SUPPORTS = (QUARTERS, FREE)


@dataclass(frozen=True)
class Membrane:
    """A membrane's geometry and stiffness on n_x × m cells, m a multiple of 4.

    Attributes
    ----------
    dx : float
        Width of a cell, m.
    radius : float
        R₀, m.
    shear : ndarray (n_x, m)
        S = G h, N/m.
    supports : str
        What keeps it from moving as a whole. ``quarters``: u_φ = 0 at φ = 0, π/2, π, 3π/2; ``free``: its mean
        translation and rotation are zero.
    """

    dx: float
    radius: float
    shear: Floats
    supports: str = QUARTERS

    def __post_init__(self) -> None:
        if self.shear.ndim != 2 or self.shear.shape[1] % 4:
            raise ModelError("a membrane needs a multiple of 4 cells around the artery")
        if not np.all(np.isfinite(self.shear) & (self.shear > 0)):
            raise ModelError("a membrane needs a finite, positive shear stiffness in every cell")
        if self.supports not in SUPPORTS:
            raise ModelError(f"supports {self.supports!r}; allowed: {', '.join(SUPPORTS)}")

    @cached_property
    def difference(self) -> sparse.csr_array:
        """∂_φ from φ-faces to cells of one section, (m, m); its negative transpose is ∂_φ back."""
        m = self.shear.shape[1]
        here, after = np.arange(m), np.roll(np.arange(m), -1)
        width = 2 * np.sin(np.pi / m)
        values = np.concatenate([-np.ones(m), np.ones(m)]) / width
        places = np.concatenate([here, here]), np.concatenate([here, after])
        return sparse.csr_array((values, places), shape=(m, m))

    @cached_property
    def axial_shear(self) -> sparse.csr_array:
        """−R₀ ∂_x(S ∂_x ·) on all u_r, then all u_φ; S is a series of springs along x."""
        n_x, _ = self.shear.shape
        between = 2.0 / (1.0 / self.shear[1:] + 1.0 / self.shear[:-1])
        on_faces = 0.5 * (between + np.roll(between, 1, axis=1))
        step = sparse.eye_array(n_x - 1, n_x, k=1) - sparse.eye_array(n_x - 1, n_x)
        parts = []
        for stiffness in (between, on_faces):
            along = sparse.kron(step / self.dx, sparse.eye_array(self.shear.shape[1]), format="csr")
            parts.append(along.T @ sparse.diags_array(self.radius * stiffness.ravel()) @ along)
        return sparse.csr_array(sparse.block_diag(parts, format="csr"))

    @cached_property
    def held(self) -> Flags:
        """Which u_φ are held at 0, (n_x, m)."""
        n_x, m = self.shear.shape
        held = np.zeros((n_x, m), dtype=bool)
        if self.supports == QUARTERS:
            held[:, :: m // 4] = True
        else:  # rigid motions cost no energy: three points of one section stop them without stress
            held[0, [0, m // 4, m // 2]] = True
        return held


def operator(membrane: Membrane, stiffness: Floats, pressure: Floats) -> sparse.csr_array:
    """Symmetric matrix of the two equations, per unit of area R₀ dφ dx over R₀, Pa/m.

    Parameters
    ----------
    membrane : Membrane
    stiffness : ndarray (n_x, m)
        β, Pa m.
    pressure : ndarray (n_x,)
        p of each section, Pa.

    Returns
    -------
    csr_array (2 n_x m, 2 n_x m)
        On all u_r, then all u_φ, both x-major.
    """
    n_x, m = stiffness.shape
    load = np.repeat(pressure, m)
    hoop = stiffness.ravel() / membrane.radius + load  # K/R₀
    around = sparse.kron(sparse.eye_array(n_x), membrane.difference, format="csr")
    spring = sparse.diags_array(hoop)
    bend = around @ sparse.diags_array(load) @ around.T
    radial = sparse.diags_array(hoop - load) + bend
    mixed = spring @ around
    tangential = around.T @ spring @ around
    local = sparse.block_array([[radial, mixed], [mixed.T, tangential]], format="csr")
    return sparse.csr_array(local + membrane.axial_shear)


def displacement(
    membrane: Membrane, stiffness: Floats, pressure: Floats, extra_load: tuple[Floats, Floats] | None = None
) -> tuple[Floats, Floats]:
    """Displacements of the wall under a pressure for each section.

    Parameters
    ----------
    membrane, stiffness, pressure
        As :func:`operator`.
    extra_load : tuple of ndarray (n_x, m), optional
        Right-hand sides that are added to the two equations, Pa.

    Returns
    -------
    radial, tangential : ndarray (n_x, m)
        u_r at cell centres and u_φ on the φ-faces before them, m.

    Raises
    ------
    ModelError
        Where the wall buckles: no unique answer to the pressure.
    """
    n_x, m = stiffness.shape
    matrix = operator(membrane, stiffness, pressure)
    load = np.concatenate([np.repeat(pressure * membrane.radius, m), np.zeros(n_x * m)])
    if extra_load is not None:
        load += np.concatenate([part.ravel() for part in extra_load])
    kept = np.concatenate([np.ones(n_x * m, dtype=bool), ~membrane.held.ravel()])
    order = _sections_first(n_x, m)
    order = order[kept[order]]
    solution = np.zeros(load.size)
    try:
        factor = splu(
            sparse.csc_array(matrix[order][:, order]),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:  # exactly singular
        raise ModelError("the membrane buckles: its stiffness is singular") from error
    solution[order] = factor.solve(load[order])
    if not np.all(np.isfinite(solution)):
        raise ModelError("the membrane buckles: its stiffness is singular")
    radial, tangential = solution.reshape(2, n_x, m)
    if membrane.supports == FREE:
        return without_rigid_motion(radial, tangential)
    return radial, tangential


def _sections_first(n_x: int, m: int) -> Integers:
    """Order of unknowns in which those of a section are neighbours."""
    return np.arange(2 * n_x * m).reshape(2, n_x, m).transpose(1, 2, 0).ravel()


def without_rigid_motion(radial: Floats, tangential: Floats) -> tuple[Floats, Floats]:
    """Displacements without the tube's mean translation across the axis and rotation about it."""
    m = radial.shape[1]
    width = 2 * np.pi / m
    centre, face = (np.arange(m) + 0.5) * width, np.arange(m) * width
    modes = ((np.cos(centre), -np.sin(face)), (np.sin(centre), np.cos(face)), (np.zeros(m), np.ones(m)))
    for across, around in modes:
        share = np.mean(radial @ across + tangential @ around) / (across @ across + around @ around)
        radial = radial - share * across
        tangential = tangential - share * around
    return radial, tangential
