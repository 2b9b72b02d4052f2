"""Units that cases usually state, known here since pint takes longer to load than a case to check."""

import re
from collections.abc import Mapping
from decimal import Decimal
from types import MappingProxyType

TERM = re.compile(r"\s*([*/]?)\s*([^\W\d_]+)(?:\^?(-?[1-9]))?(?!\w)")
PRODUCT = re.compile(f"(?:{TERM.pattern})+")
BASES = ("m", "kg", "s", "rad")

_STATED = {
    "m": ("1", "m"),
    "cm": ("1e-2", "m"),
    "mm": ("1e-3", "m"),
    "µm": ("1e-6", "m"),
    "s": ("1", "s"),
    "ms": ("1e-3", "s"),
    "µs": ("1e-6", "s"),
    "ns": ("1e-9", "s"),
    "min": ("60", "s"),
    "kg": ("1", "kg"),
    "g": ("1e-3", "kg"),
    "N": ("1", "kg m s-2"),
    "dyn": ("1e-5", "kg m s-2"),
    "Pa": ("1", "kg m-1 s-2"),
    "mPa": ("1e-3", "kg m-1 s-2"),
    "kPa": ("1e3", "kg m-1 s-2"),
    "MPa": ("1e6", "kg m-1 s-2"),
    "mmHg": ("133.322387415", "kg m-1 s-2"),
    "l": ("1e-3", "m3"),
    "ml": ("1e-6", "m3"),
    "poise": ("0.1", "kg m-1 s-1"),
    "cP": ("1e-3", "kg m-1 s-1"),
    "rad": ("1", "rad"),
}


def _exponents(text: str) -> tuple[int, ...]:
    found = {name: int(power or 1) for _, name, power in TERM.findall(text)}
    return tuple(found.get(base, 0) for base in BASES)


UNITS: Mapping[str, tuple[Decimal, tuple[int, ...]]] = MappingProxyType(
    {name: (Decimal(factor), _exponents(bases)) for name, (factor, bases) in _STATED.items()}
    | {"deg": (Decimal("3.1415926535897932384626433832795") / 180, _exponents("rad"))}
)


def common_unit(text: str) -> tuple[Decimal, tuple[int, ...]] | None:
    """SI factor of a product of powers of these units, and its exponents of `BASES`; None for any other.

    Parameters
    ----------
    text : str
        What `cases.values.units.UNIT` matches, such as "Pa s/m^3"; a stroke divides by the next term alone.
    """
    if PRODUCT.fullmatch(text) is None:
        return None
    factor, exponents = Decimal(1), (0,) * len(BASES)
    for operator, name, power in TERM.findall(text):
        if name not in UNITS:
            return None
        times = int(power or 1) * (-1 if operator == "/" else 1)
        one, own = UNITS[name]
        factor *= one**times
        exponents = tuple(total + times * each for total, each in zip(exponents, own, strict=True))
    return factor, exponents
