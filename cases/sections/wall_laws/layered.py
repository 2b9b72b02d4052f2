"""The linear thick-walled tube of bonded layers: the composite Lamé cylinder."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import AfterValidator

from cases.sections.base import SAME
from cases.sections.wall_laws.law import Layer, PoissonRatio, WallLaw
from cases.values.kinds import Pressure, refused

if TYPE_CHECKING:
    from cases.arrays import Floats


def _named_apart(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
    if not layers:
        raise refused(layers, "one layer or more, from inside to outside", "no layers")
    names = [layer.name for layer in layers]
    for item, name in enumerate(names):
        if name in names[:item]:
            raise refused(name, "a name that no other layer has", key=(item, "name"))
    return layers


class LayeredWall(WallLaw):
    """A linear thick-walled tube of bonded layers.

    Attributes
    ----------
    layers : tuple of Layer
        The layers from inside to outside; their thicknesses sum to that of the wall.
    poisson_ratio : float
        ν in [0, 0.5] of all layers.
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    """

    law: Literal["layered"]
    layers: Annotated[tuple[Layer, ...], AfterValidator(_named_apart)]
    poisson_ratio: PoissonRatio
    reference_pressure: Pressure = 0.0

    not_in_febio: ClassVar[str] = "the wall of such a model has one layer"

    def layers_within(self, thickness: float) -> tuple[Layer, ...]:
        """Return the stated layers, whose thicknesses sum to the wall's."""
        del thickness
        return self.layers

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β of the bonded layers, Pa m.

        In each layer u_r = a r + b/r and σ_r = E/(1+ν) [a/(1−2ν) − b/r²] (plane strain); with a = (1−2ν) c
        and b over c instead of a the terms stay finite at ν = ½. From the outer
        surface, where σ_r = 0, the ratio of traction to displacement is carried inwards through the layers;
        at R₀ it gives u_r = P R₀²/β.
        """
        import numpy as np

        del thickness
        edges = radius + np.concatenate([[0.0], np.cumsum([layer.thickness for layer in self.layers])])
        nu = self.poisson_ratio
        support: Floats | float = 0.0  # −σ_r/u_r at the layer's outer edge, Pa/m
        for modulus, inner, outer in reversed(list(zip(moduli, edges[:-1], edges[1:], strict=True))):
            factor = modulus / (1 + nu)
            # b/c from −σ_r = support · u_r at the outer edge
            top = factor + (1 - 2 * nu) * support * outer
            bottom = factor / outer**2 - support / outer
            ratio = top / bottom
            stress = factor * (1 - ratio / inner**2)
            support = -stress / ((1 - 2 * nu) * inner + ratio / inner)
        return np.asarray(support * radius**2)

    def unloaded_pressure(self, radius: float) -> float:
        """Return the stated reference pressure, Pa."""
        del radius
        return self.reference_pressure

    def refuse_unfit(self, radius: float, thickness: float) -> None:
        """Refuse layers whose thicknesses do not sum to the wall's, m."""
        del radius
        total = sum(layer.thickness for layer in self.layers)
        if abs(total - thickness) > SAME * thickness:
            allowed = f"thicknesses that sum to geometry.wall_thickness ({thickness:g} m)"
            raise refused(f"{total:.9g} m in all", allowed, key=("layers",))
