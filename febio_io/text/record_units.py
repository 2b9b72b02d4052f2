"""Unit patterns of the values that data records can hold, in FEBio's own notation."""

_COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")
_AXES = "xyz"

UNITS: dict[str, tuple[str, ...]] = {
    "L": (*_AXES, "ux", "uy", "uz", "contact gap"),
    "L/t": (
        *(f"v{axis}" for axis in _AXES),
        *(f"w{axis}" for axis in _AXES),
        *(f"nfv{axis}" for axis in _AXES),
        *(f"fv{axis}" for axis in _AXES),
    ),
    "L/t^2": (*(f"a{axis}" for axis in _AXES), *(f"fa{axis}" for axis in _AXES)),
    "F": (*(f"R{axis}" for axis in _AXES),),
    "P": (
        *(f"s{part}" for part in _AXES),
        *(f"s{part}" for part in ("xy", "yz", "xz", "1", "2", "3")),
        *(f"fs{part}" for part in (*_COMPONENTS, "1", "2", "3")),
        "fp",
        "fmxs",
        "contact pressure",
        *(f"contact_traction.{axis}" for axis in _AXES),
    ),
    "1/t": (*(f"fd{part}" for part in _COMPONENTS), *(f"fw{axis}" for axis in _AXES)),
    "L^2": ("facet area",),
    "L^3": ("volume",),
    "M/L^3": ("fd",),
}
_UNIT_OF = {column: unit for unit, columns in UNITS.items() for column in columns}


def unit_of(column: str) -> str | None:
    """Give the unit pattern of a column of a data record.

    Parameters
    ----------
    column : str
        Its name in FEBio's model, e.g. "nfvx".

    Returns
    -------
    str or None
        L length, t time, M mass, F force, P pressure, in the model's units; None where it is not known, as of
        numbers without unit and of expressions.
    """
    return _UNIT_OF.get(column)
