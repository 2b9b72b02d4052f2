"""The wall: how its pressure follows from its radius."""

from typing import Annotated, Literal

from pydantic import Tag, field_validator

from cases.section import Section
from cases.values import (
    Modulus,
    Pressure,
    Switch,
    Thickness,
    WallCurveFile,
    Words,
    number,
    one_of,
    refused,
)

HomogeneousLaw = Literal["thin", "thick", "saint_venant_kirchhoff", "neo_hookean"]
LINEAR_LAWS = ("thin", "thick", "layered")

PoissonRatio = Annotated[float, number("a number from 0 on, less than 0.5", lambda value: 0 <= value < 0.5)]


class HomogeneousWall(Section):
    """A healthy wall of one material.

    Attributes
    ----------
    law : str
        ``thin`` or ``thick``: a linear thin-walled or thick-walled tube; ``saint_venant_kirchhoff`` or
        ``neo_hookean``: a thick-walled tube of that material under finite strain.
    youngs_modulus : float
        E in Pa.
    poisson_ratio : float
        ν in [0, 0.5).
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    """

    law: Annotated[HomogeneousLaw, one_of(HomogeneousLaw)]
    youngs_modulus: Modulus
    poisson_ratio: PoissonRatio
    reference_pressure: Pressure = 0.0


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


class LayeredWall(Section):
    """A linear thick-walled tube of bonded layers.

    Attributes
    ----------
    layers : tuple of Layer
        The layers from inside to outside; their thicknesses sum to that of the wall.
    poisson_ratio : float
        ν in [0, 0.5) of all layers.
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    """

    law: Annotated[Literal["layered"], one_of(Literal["layered"])]
    layers: tuple[Layer, ...]
    poisson_ratio: PoissonRatio
    reference_pressure: Pressure = 0.0

    @field_validator("layers")
    @classmethod
    def _layers(cls, layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
        if not layers:
            raise refused(layers, "one layer or more, from inside to outside", "no layers")
        names = [layer.name for layer in layers]
        for item, name in enumerate(names):
            if name in names[:item]:
                raise refused(name, "a name that no other layer has", key=(item, "name"))
        return layers


class TableWall(Section):
    """A wall whose pressure is tabulated.

    Attributes
    ----------
    table : WallCurve
        Pressure of the healthy wall over its radius; P₀ is its pressure at the unloaded radius.
    youngs_modulus : float
        E of the healthy wall in Pa: a calcification scales P − P₀ by its own E over this one.
    """

    law: Annotated[Literal["table"], one_of(Literal["table"])]
    table: WallCurveFile
    youngs_modulus: Modulus


Wall = (
    Annotated[HomogeneousWall, Tag("thin")]
    | Annotated[HomogeneousWall, Tag("thick")]
    | Annotated[LayeredWall, Tag("layered")]
    | Annotated[HomogeneousWall, Tag("saint_venant_kirchhoff")]
    | Annotated[HomogeneousWall, Tag("neo_hookean")]
    | Annotated[TableWall, Tag("table")]
)
