"""Where and how the wall is calcified."""

import math
from typing import Annotated, Literal

from pydantic import AfterValidator, Discriminator, Tag, field_validator

from cases.sections.base import Section, told_apart_by
from cases.values.kinds import (
    Angle,
    Context,
    Modulus,
    Position,
    TransitionAngle,
    TransitionLength,
    ValueKind,
    refused,
)

FULL_TURN = 2.0 * math.pi


class AxialTransition(Section):
    """Smooth axial ends of a calcification: `x` is the transition length ξ^x in m."""

    x: TransitionLength


class PatchTransition(Section):
    """Smooth edges of a patch: transition length ξ^x in m, transition angle ξ^φ in rad."""

    x: TransitionLength
    phi: TransitionAngle


def _transition_tag(value: object) -> str:
    return "smooth" if isinstance(value, dict | Section) else "sharp"


def _sharp(value: object, _context: Context | None) -> str:
    if value != "sharp":
        raise refused(value, "sharp, or a section with the transition's lengths")
    return "sharp"


Sharp = Annotated[Literal["sharp"], ValueKind(_sharp, "sharp", {"enum": ["sharp"]}), Tag("sharp")]


def _increasing(x: tuple[float, float]) -> tuple[float, float]:
    if not x[0] < x[1]:
        raise refused(f"{x[0]:g} m to {x[1]:g} m", "a first position below the last one")
    return x


Ends = Annotated[tuple[Position, Position], AfterValidator(_increasing)]


class NoCalcification(Section):
    """A healthy wall everywhere."""

    pattern: Literal["none"]

    @property
    def parts(self) -> tuple["Part", ...]:
        """No calcified part."""
        return ()


class AxisymmetricCalcification(Section):
    """A calcified ring.

    Attributes
    ----------
    youngs_modulus : float
        E of the calcified wall in Pa.
    x : tuple of float
        First and last position (x1, x2) in m, 0 ≤ x1 < x2.
    transition : "sharp" or AxialTransition
        How its ends meet the healthy wall.
    """

    pattern: Literal["axisymmetric"]
    youngs_modulus: Modulus
    x: Ends
    transition: Annotated[Sharp | Annotated[AxialTransition, Tag("smooth")], Discriminator(_transition_tag)]

    @property
    def parts(self) -> tuple["Part", ...]:
        """The ring itself."""
        return (self,)


class LocalCalcification(Section):
    """A calcified patch.

    Attributes
    ----------
    youngs_modulus : float
        E of the calcified wall in Pa.
    x : tuple of float
        First and last position (x1, x2) in m, 0 ≤ x1 < x2.
    phi : tuple of float
        First and last angle (φ1, φ2) in rad, in [0, 2π]; with φ1 > φ2 the patch crosses φ = 0.
    transition : "sharp" or PatchTransition
        How its edges meet the healthy wall.
    """

    pattern: Literal["local"]
    youngs_modulus: Modulus
    x: Ends
    phi: tuple[Angle, Angle]
    transition: Annotated[Sharp | Annotated[PatchTransition, Tag("smooth")], Discriminator(_transition_tag)]

    @field_validator("phi")
    @classmethod
    def _phi(cls, phi: tuple[float, float]) -> tuple[float, float]:
        if phi[0] == phi[1] or phi == (FULL_TURN, 0.0):
            found = " to ".join(f"{math.degrees(angle):g} deg" for angle in phi)
            raise refused(found, "a first and a last angle with a patch between them")
        return phi

    @property
    def parts(self) -> tuple["Part", ...]:
        """The patch itself."""
        return (self,)


Part = Annotated[AxisymmetricCalcification, Tag("axisymmetric")] | Annotated[LocalCalcification, Tag("local")]


class SeveralCalcifications(Section):
    """Several rings and patches; where they overlap, the one that changes the modulus most counts.

    Attributes
    ----------
    patches : tuple of AxisymmetricCalcification or LocalCalcification
        One or more.
    """

    pattern: Literal["several"]
    patches: tuple[Annotated[Part, told_apart_by("pattern")], ...]

    @field_validator("patches")
    @classmethod
    def _patches(cls, patches: tuple[Part, ...]) -> tuple[Part, ...]:
        if not patches:
            raise refused("no patches", "one patch or more")
        return patches

    @property
    def parts(self) -> tuple[Part, ...]:
        """The rings and patches."""
        return self.patches


Calcification = (
    Annotated[NoCalcification, Tag("none")]
    | Annotated[AxisymmetricCalcification, Tag("axisymmetric")]
    | Annotated[LocalCalcification, Tag("local")]
    | Annotated[SeveralCalcifications, Tag("several")]
)
