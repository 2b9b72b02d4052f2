"""The wall: how its pressure follows from its radius."""

from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import Tag, field_validator, model_validator

from cases.sections.base import Section
from cases.values.kinds import (
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
RowLaw = Literal[HomogeneousLaw, "layered", "table"]
Supports = Literal["quarters", "free"]
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


def _named_apart(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
    if not layers:
        raise refused(layers, "one layer or more, from inside to outside", "no layers")
    names = [layer.name for layer in layers]
    for item, name in enumerate(names):
        if name in names[:item]:
            raise refused(name, "a name that no other layer has", key=(item, "name"))
    return layers


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
        return _named_apart(layers)


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


OwnWall = HomogeneousWall | LayeredWall | TableWall

_KEYS_OF_BASES = MappingProxyType(
    {
        "layered": (("layers",), ("reference_pressure",)),
        "table": (("table", "youngs_modulus"), ()),
    }
)
_KEYS_OF_ONE_MATERIAL = (("youngs_modulus",), ("reference_pressure",))


class MembraneWall(Section):
    """A wall that is one elastic sheet: stretched as a row law says, tied together around and along.

    Attributes
    ----------
    base : str
        The row law that it follows where it is uniform; its keys are stated beside.
    poisson_ratio : float
        ν in [0, 0.5), for the shear modulus E/(2(1 + ν)) also where the base itself needs none.
    supports : str
        What keeps it from moving as a whole: ``quarters``, four generators φ = 0, 90, 180, 270 deg that move
        radially only; ``free``, nothing (its mean translation and rotation are zero).
    youngs_modulus, reference_pressure, layers, table
        Those of the base; None where it has none.
    """

    law: Annotated[Literal["membrane"], one_of(Literal["membrane"])]
    base: Annotated[RowLaw, one_of(RowLaw)]
    poisson_ratio: PoissonRatio
    supports: Annotated[Supports, one_of(Supports)] = "quarters"
    youngs_modulus: Modulus | None = None
    reference_pressure: Pressure | None = None
    layers: tuple[Layer, ...] | None = None
    table: WallCurveFile | None = None

    @field_validator("layers")
    @classmethod
    def _layers(cls, layers: tuple[Layer, ...] | None) -> tuple[Layer, ...] | None:
        return None if layers is None else _named_apart(layers)

    @model_validator(mode="after")
    def _keys_of_the_base(self) -> Self:
        needed, optional = _KEYS_OF_BASES.get(self.base, _KEYS_OF_ONE_MATERIAL)
        for key in ("youngs_modulus", "reference_pressure", "layers", "table"):
            stated = getattr(self, key) is not None
            if key in needed and not stated:
                raise refused(f"base {self.base} without {key}", f"with {', '.join(needed)}")
            if stated and key not in (*needed, *optional):
                allowed = f"base {self.base} with {', '.join((*needed, *optional, 'poisson_ratio'))}"
                raise refused(key, allowed, key=(key,))
        return self


def row_wall(wall: "OwnWall | MembraneWall") -> OwnWall:
    """Return the wall that each row would be by itself: a membrane's base, or the wall as it is."""
    if not isinstance(wall, MembraneWall):
        return wall
    kinds: dict[str, type[OwnWall]] = {"layered": LayeredWall, "table": TableWall}
    kind = kinds.get(wall.base, HomogeneousWall)
    stated = {key: getattr(wall, key) for key in kind.model_fields if key != "law"}
    values = {key: value for key, value in stated.items() if value is not None} | {"law": wall.base}
    return kind.model_construct(None, **values)


Wall = (
    Annotated[HomogeneousWall, Tag("thin")]
    | Annotated[HomogeneousWall, Tag("thick")]
    | Annotated[LayeredWall, Tag("layered")]
    | Annotated[HomogeneousWall, Tag("saint_venant_kirchhoff")]
    | Annotated[HomogeneousWall, Tag("neo_hookean")]
    | Annotated[TableWall, Tag("table")]
    | Annotated[MembraneWall, Tag("membrane")]
)
