"""Words for the numbers of a study, and the units in which it states them, which people read them in."""

import re
from dataclasses import dataclass
from types import MappingProxyType

from cases.values.units import DIMENSION_OF_UNIT, NUMBER, parse_quantity


@dataclass(frozen=True)
class Display:
    """A unit for people: display value = SI value × factor."""

    unit: str
    factor: float


def display_of(stated: object, unit: str) -> Display:
    """Return the unit of a quantity as a study states it.

    Parameters
    ----------
    stated : object
        What was accepted as a number of ``unit``: a text with a unit, a percentage or a plain number.
    unit : str
        SI unit, as `cases.fields` writes it.
    """
    text = str(stated).strip()
    words = text[len(match[0]) :].strip() if (match := re.match(NUMBER, text)) else ""
    if unit == "1":
        return Display("%", 100.0) if words == "%" else Display("1", 1.0)
    return Display(words, 1.0 / parse_quantity(f"1 {words}", DIMENSION_OF_UNIT[unit]))


LABELS = MappingProxyType(
    {
        "geometry.length": "length of the artery",
        "geometry.radius": "unloaded lumen radius",
        "geometry.wall_thickness": "wall thickness",
        "blood.density": "density of blood",
        "blood.viscosity": "viscosity of blood",
        "wall.youngs_modulus": "Young's modulus of the healthy wall",
        "wall.poisson_ratio": "Poisson's ratio of the wall",
        "wall.reference_pressure": "pressure of the unloaded radius",
        "calcification.youngs_modulus": "Young's modulus of the calcification",
        "calcification.x.centre": "axial position of the calcification",
        "calcification.x.extent": "axial extent of the calcification",
        "calcification.x[1]": "start of the calcification",
        "calcification.x[2]": "end of the calcification",
        "calcification.phi.centre": "angular position of the calcification",
        "calcification.phi.extent": "angular extent of the calcification",
        "calcification.phi[1]": "first angle of the calcification",
        "calcification.phi[2]": "last angle of the calcification",
        "calcification.transition.x": "axial transition of the calcification",
        "calcification.transition.phi": "angular transition of the calcification",
        "inlet.scale": "scale of the inlet's waveform",
        "inlet.value": "value at the inlet",
        "inlet.period": "period of the inlet",
        "outlet.resistance": "resistance of the outlet",
        "outlet.offset": "pressure offset of the outlet",
        "outlet.proximal_resistance": "proximal resistance of the outlet",
        "outlet.distal_resistance": "distal resistance of the outlet",
        "outlet.compliance": "compliance of the outlet",
        "outlet.venous_pressure": "venous pressure of the outlet",
        "solver.n_x": "sections of the grid",
        "solver.n_phi": "rows of the grid",
        "solver.time_step": "time step",
        "solver.cycles": "cycles computed",
    }
)


def label_of(key: str) -> str:
    """Words for a key; its own where none are known."""
    return LABELS.get(key, key.replace("_", " "))
