"""The wall whose pressure is tabulated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from cases.sections.wall_laws.law import CurveWall, Layer, one_layer
from cases.values.kinds import Modulus, WallCurveFile, refused

if TYPE_CHECKING:
    from cases.arrays import Floats


class TableWall(CurveWall):
    """A wall whose pressure is tabulated; between the points by the monotone cubic (PCHIP).

    Attributes
    ----------
    table : WallCurve
        Pressure of the healthy wall over its radius; P₀ is its pressure at the unloaded radius.
    youngs_modulus : float
        E of the healthy wall in Pa: a calcification scales P − P₀ by its own E over this one.
    """

    law: Literal["table"]
    table: WallCurveFile
    youngs_modulus: Modulus

    not_in_febio: ClassVar[str] = "a curve P(R) is no material"

    def layers_within(self, thickness: float) -> tuple[Layer, ...]:
        """Return the one layer."""
        return (one_layer(thickness, self.youngs_modulus),)

    def unloaded_pressure(self, radius: float) -> float:
        """Return the tabulated pressure at the unloaded radius, Pa."""
        return float(_between(self.table.radii, self.table.pressures)[0](radius))

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β = R₀²/(dR/dP) at P₀, which grows with E, Pa m."""
        import numpy as np

        del thickness
        loads = self.table.pressures - self.unloaded_pressure(radius)
        slope = float(_between(loads, self.table.radii)[1](0.0))
        return np.asarray(moduli[0] / self.youngs_modulus * radius**2 / slope)

    def load_curve(self, radius: float) -> tuple[Floats, Floats, Floats]:
        """Return the table's points over P − P₀."""
        import numpy as np

        loads = self.table.pressures - self.unloaded_pressure(radius)
        return loads, self.table.radii, np.asarray(_between(loads, self.table.radii)[1](loads))

    def refuse_unfit(self, radius: float, thickness: float) -> None:
        """Refuse a table that does not hold the unloaded radius, m."""
        del thickness
        (least, _), *_, (largest, _) = self.table.rows
        if not least <= radius <= largest:
            allowed = f"a range that holds geometry.radius ({radius:g} m)"
            raise refused(f"radii from {least:g} m to {largest:g} m", allowed, key=("table",))


def _between(x: Floats, y: Floats) -> tuple[Callable[..., Floats], Callable[..., Floats]]:
    """Return the interpolant y(x) and its derivative."""
    # here, since it takes a second to import, which whoever only checks a case file need not wait for
    from scipy.interpolate import PchipInterpolator

    curve = PchipInterpolator(x, y)
    return curve, curve.derivative()
