"""Inputs of the 3D run, as its log tells them, beside those of the case."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from cases.sections.case import Case

CLOSE = 1e-3  # relative: inputs that differ by less are the same to the digits of a log
_WORDS = {"E": "Young's modulus", "v": "Poisson's ratio", "mu": "viscosity", "density": "density"}
_UNITS = {"E": "Pa", "v": "1", "mu": "Pa s", "density": "kg m-3"}


def compared_inputs(case: Case, materials: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Inputs of both, a mapping each.

    Parameters
    ----------
    case : Case
        Of one variant.
    materials : sequence of mapping
        What the log tells, SI: ``material``, ``name`` (E, v, mu, density) and ``value``.

    Returns
    -------
    list of dict
        ``name``, ``unit``, ``reference`` and ``case``; of several moduli of the case the one that is nearest,
        None where the reduced model has no such input, as the density of its wall.
    """
    return [
        {
            "name": f"{_WORDS[item['name']]} of {item['material']}",
            "unit": _UNITS[item["name"]],
            "reference": item["value"],
            "case": _nearest(item["value"], _of_case(case, item)),
        }
        for item in materials
    ]


def _of_case(case: Case, item: Mapping[str, Any]) -> list[float]:
    """Values of the case that an input may be."""
    if item["fluid"]:
        return [{"mu": case.blood.viscosity, "density": case.blood.density}[item["name"]]]
    stated = {
        "E": [case.wall, *getattr(case.calcification, "parts", ())],
        "v": [case.wall],
    }.get(item["name"], [])
    key = {"E": "youngs_modulus", "v": "poisson_ratio"}.get(item["name"], "")
    return [value for part in stated if (value := getattr(part, key, None)) is not None]


def _nearest(value: float, among: Sequence[float]) -> float | None:
    return min(among, key=lambda own: abs(own - value), default=None)


def differing(inputs: Sequence[Mapping[str, Any]]) -> list[str]:
    """Say of each input that the case has otherwise what both are."""
    return [
        f"{item['name']} {item['reference']:g} in 3D, {item['case']:g} in the case ({item['unit']})"
        for item in inputs
        if item["case"] is not None and not math.isclose(item["reference"], item["case"], rel_tol=CLOSE)
    ]
