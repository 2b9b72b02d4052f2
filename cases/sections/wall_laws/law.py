"""What every wall law declares: its keys in a case file, its formulas, and its material in FEBio."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar

from cases.sections.base import Section
from cases.values.kinds import Modulus, Pressure, Switch, Thickness, Words, number

if TYPE_CHECKING:
    from cases.arrays import Floats

PoissonRatio = Annotated[float, number("a number from 0 to 0.5", lambda value: 0 <= value <= 0.5)]
CompressibleRatio = Annotated[
    float, number("a number from 0 on, less than 0.5", lambda value: 0 <= value < 0.5)
]


class Layer(Section):
    """One layer of a wall.

    Attributes
    ----------
    name : str
        Its name.
    thickness : float
        Thickness in m.
    youngs_modulus : float
        E of the healthy layer in Pa.
    calcifies : bool
        Whether a calcification's Young's modulus applies to it.
    """

    name: Words
    thickness: Thickness
    youngs_modulus: Modulus
    calcifies: Switch = False


class WallLaw(Section):
    """A wall whose every row answers to its own pressure alone.

    A law states its word as ``law``, a `Literal`, and its own keys; a key that two laws have means the same
    in both, for a membrane on either states it too. Moduli are E of each layer, one number or one a cell.

    Attributes
    ----------
    law : str
        Its word in the registry.
    linear : bool
        Whether P = P₀ + β (R − R₀)/R₀² holds at every pressure.
    febio_material : str or None
        FEBio's name of the material with its E and ν; None: ``not_in_febio`` says why there is none.
    """

    law: str

    linear: ClassVar[bool] = True
    incompressible: ClassVar[bool] = True
    febio_material: ClassVar[str | None] = None
    not_in_febio: ClassVar[str] = "no material of FEBio is declared for it"

    @abstractmethod
    def layers_within(self, thickness: float) -> tuple[Layer, ...]:
        """Return the healthy layers of a wall of a thickness in m, from inside to outside."""

    @abstractmethod
    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β at the unloaded radius R₀ from E of each layer, Pa, and R₀ and h, m; in Pa m."""

    @abstractmethod
    def unloaded_pressure(self, radius: float) -> float:
        """Return P₀, the transmural pressure of the unloaded radius in m, Pa."""

    def shear_stiffness(self, moduli: Sequence[Floats], thickness: float, poisson_ratio: float) -> Floats:
        """Return a membrane's resistance to shear, S = Σ G h of the layers with G = E/(2(1 + ν)), N/m."""
        import numpy as np

        layers = self.layers_within(thickness)
        tensile = sum(layer.thickness * modulus for layer, modulus in zip(layers, moduli, strict=True))
        return np.asarray(tensile / (2 * (1 + poisson_ratio)))

    def refuse_unfit(self, radius: float, thickness: float) -> None:
        """Refuse an unloaded lumen radius and wall thickness, m, that the law's keys do not fit."""


class HomogeneousWall(WallLaw):
    """A healthy wall of one material, which calcifies through its whole thickness.

    Attributes
    ----------
    youngs_modulus : float
        E in Pa.
    poisson_ratio : float
        ν in [0, 0.5].
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    """

    youngs_modulus: Modulus
    poisson_ratio: PoissonRatio
    reference_pressure: Pressure = 0.0

    def layers_within(self, thickness: float) -> tuple[Layer, ...]:
        """Return the one layer."""
        return (one_layer(thickness, self.youngs_modulus),)

    def unloaded_pressure(self, radius: float) -> float:
        """Return the stated reference pressure, Pa."""
        del radius
        return self.reference_pressure


class CurveWall(WallLaw):
    """A wall of one material with a known curve R(P), whose loads P − P₀ scale with E."""

    linear: ClassVar[bool] = False

    @abstractmethod
    def load_curve(self, radius: float) -> tuple[Floats, Floats, Floats]:
        """Return increasing loads P − P₀, Pa, R, m, and dR/dP, m/Pa, of the healthy wall."""


def one_layer(thickness: float, youngs_modulus: float) -> Layer:
    """Return the layer of a wall of one material, of thickness in m and E in Pa."""
    return Layer.model_construct(
        name="wall", thickness=thickness, youngs_modulus=youngs_modulus, calcifies=True
    )
