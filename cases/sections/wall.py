"""The wall: how its pressure follows from its radius."""

import math
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import Tag, create_model, field_validator, model_validator

from cases.sections.base import Section
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.law import CompressibleRatio, PoissonRatio, WallLaw
from cases.sections.wall_laws.saint_venant_kirchhoff import SaintVenantKirchhoffWall
from cases.values.kinds import Modulus, Pressure, counted, one_of, refused, registered

Supports = Literal["quarters", "free"]
MOST_ELEMENTS = 1000  # in one direction of a solid wall
MOST_IN_ALL = 20_000  # their equations are factorised: more would take minutes and gigabytes
FEWEST_ALONG = 3  # of a solid wall, as of the flow's grid
ElementCount = Annotated[int, counted(MOST_ELEMENTS)]


class MembraneWall(Section):
    """A wall that is one elastic sheet: stretched as a row law says, tied together around and along.

    The keys of the laws that it may follow stand beside; None where its base has none.

    Attributes
    ----------
    base : str
        The row law that it follows where it is uniform.
    poisson_ratio : float
        ν in [0, 0.5], less than 0.5 where its base needs that, for the shear modulus E/(2(1 + ν)) also where
        the base itself needs none.
    supports : str
        What keeps it from moving as a whole: ``quarters``, four generators φ = 0, 90, 180, 270 deg that move
        radially only; ``free``, nothing (its mean translation and rotation are zero).
    """

    law: Literal["membrane"]
    base: Annotated[str, registered(lambda: tuple(LAWS))]
    poisson_ratio: PoissonRatio
    supports: Annotated[Supports, one_of(Supports)] = "quarters"

    @model_validator(mode="after")
    def _keys_of_the_base(self) -> Self:
        fields = LAWS[self.base].model_fields
        beside = [key for key in type(self).model_fields if key not in MembraneWall.model_fields]
        needed = [key for key in beside if key in fields and fields[key].is_required()]
        if self.poisson_ratio == 0.5 and not LAWS[self.base].incompressible:
            raise refused("0.5", f"less than 0.5 with base {self.base}", key=("poisson_ratio",))
        for key in beside:
            stated = getattr(self, key) is not None
            if key in needed and not stated:
                raise refused(f"base {self.base} without {key}", f"with {', '.join(needed)}")
            if stated and key not in fields:
                allowed = ", ".join((*(known for known in beside if known in fields), "poisson_ratio"))
                raise refused(key, f"base {self.base} with {allowed}", key=(key,))
        return self


def _keys_beside() -> dict[str, Any]:
    """Return the keys of all laws but a membrane's own, each optional, as arguments of `create_model`."""
    fields = {key: field for law in LAWS.values() for key, field in law.model_fields.items()}
    return {
        key: (Annotated[field.annotation, *field.metadata] | None, None)
        for key, field in fields.items()
        if key not in MembraneWall.model_fields
    }


MembraneOnLaws = create_model(
    "MembraneOnLaws",
    __base__=MembraneWall,
    __doc__=MembraneWall.__doc__,
    __module__=__name__,
    **_keys_beside(),
)


class SolidWall(Section):
    """A wall that is a solid of finite elements, of Saint Venant–Kirchhoff material under finite strain.

    Attributes
    ----------
    youngs_modulus : float
        E of the healthy wall in Pa.
    poisson_ratio : float
        ν in [0, 0.5).
    reference_pressure : float
        Transmural pressure P₀ of the unloaded radius in Pa.
    elements : tuple of int
        Trilinear elements around (a multiple of 4, from 8 on), through the wall and along.
    """

    law: Literal["solid"]
    youngs_modulus: Modulus
    poisson_ratio: CompressibleRatio
    reference_pressure: Pressure = 0.0
    elements: tuple[ElementCount, ElementCount, ElementCount] = (24, 3, 30)

    @field_validator("elements")
    @classmethod
    def _in_quarters(cls, elements: tuple[int, int, int]) -> tuple[int, int, int]:
        if elements[0] < 8 or elements[0] % 4:
            raise refused(elements[0], "a multiple of 4 from 8 on", key=(0,))
        if elements[2] < FEWEST_ALONG:
            raise refused(elements[2], f"a whole number from {FEWEST_ALONG} to {MOST_ELEMENTS}", key=(2,))
        count = math.prod(elements)
        if count > MOST_IN_ALL:
            raise refused(f"{count} elements", f"at most {MOST_IN_ALL} in all")
        return elements


def row_wall(wall: "Wall") -> WallLaw:
    """Return the wall that each row would be by itself: a membrane's base, a solid's tube, or as it is."""
    if isinstance(wall, WallLaw):
        return wall
    if isinstance(wall, SolidWall):
        kept = {key: getattr(wall, key) for key in SaintVenantKirchhoffWall.model_fields}
        return SaintVenantKirchhoffWall.model_construct(None, **kept | {"law": "saint_venant_kirchhoff"})
    kind = LAWS[wall.base]
    stated = {key: getattr(wall, key) for key in kind.model_fields if key != "law"}
    values = {key: value for key, value in stated.items() if value is not None} | {"law": wall.base}
    return kind.model_construct(None, **values)


if TYPE_CHECKING:
    Wall = WallLaw | MembraneWall | SolidWall
else:
    WHOLE = {"membrane": MembraneOnLaws, "solid": SolidWall}
    Wall = reduce(or_, [Annotated[law, Tag(name)] for name, law in (LAWS | WHOLE).items()])
