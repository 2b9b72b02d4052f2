"""Directions in the frame of a 3D result, by name or by components."""

import math
from typing import Literal

from cases.values.kinds import Context, ValueKind, refused, words_of
from cases.values.wording import choices

Axis = Literal["x", "y", "z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
Vector = tuple[float, float, float]


def direction(literal: object) -> ValueKind:
    """Return the kind of directions: the names that a `Literal` lists, or three components."""
    words = words_of(literal)
    allowed = f"{choices(words)}, or three components, e.g. [0, 0.1, 1]"
    items = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

    def parse(value: object, _context: Context | None) -> str | Vector:
        if isinstance(value, str) and value in words:
            return value
        if isinstance(value, list | tuple) and len(value) == 3 and all(map(_is_number, value)) and any(value):
            first, second, third = map(float, value)
            return first, second, third
        raise refused(value, allowed)

    return ValueKind(parse, allowed, {"anyOf": [{"enum": list(words)}, items]})


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def components(direction: str | Vector) -> Vector:
    """Return the components of a direction of length 1, stated by name ("x", "-y") or by components."""
    if isinstance(direction, str):
        sign = -1.0 if direction.startswith("-") else 1.0
        x, y, z = (sign * float(name == direction.removeprefix("-")) for name in "xyz")
        return x, y, z
    size = math.hypot(*direction)
    x, y, z = (part / size for part in direction)
    return x, y, z
