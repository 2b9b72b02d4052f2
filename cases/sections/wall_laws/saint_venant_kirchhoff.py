"""The Saint Venant–Kirchhoff tube."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal

from cases.sections.wall_laws.hyperelastic import HyperelasticWall, Stresses

if TYPE_CHECKING:
    from cases.arrays import Floats


class SaintVenantKirchhoffWall(HyperelasticWall):
    """A thick-walled tube of Saint Venant–Kirchhoff material under finite strain."""

    law: Literal["saint_venant_kirchhoff"]

    febio_material: ClassVar[str] = "isotropic elastic"

    @staticmethod
    def stresses(lam: float, mu: float, r: Floats, t: Floats) -> Stresses:
        """W = ½λ(E_r + E_θ)² + μ(E_r² + E_θ²) with Green–Lagrange strains E = ½(λ² − 1)."""
        er, et = 0.5 * (r * r - 1), 0.5 * (t * t - 1)
        sr, st = lam * (er + et) + 2 * mu * er, lam * (er + et) + 2 * mu * et
        return Stresses(r * sr, t * st, sr + (lam + 2 * mu) * r * r, lam * r * t, st + (lam + 2 * mu) * t * t)
