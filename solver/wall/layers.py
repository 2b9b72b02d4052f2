"""A wall of several linear-elastic layers in plane strain: the composite Lamé cylinder."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats


@dataclass(frozen=True)
class Layer:
    """One layer: thickness, m, and Young's modulus, Pa, a number or one per cell."""

    thickness: float
    youngs_modulus: ArrayLike


def layered_wall_stiffness(layers: list[Layer], radius: float, poisson_ratio: float) -> Floats:
    """β of bonded layers, from inside to outside, Pa m.

    In each layer u_r = a r + b/r and σ_r = E/(1+ν) [a/(1−2ν) − b/r²] (plane strain). From the outer
    surface, where σ_r = 0, the ratio of traction to displacement is carried inwards through the layers;
    at R₀ it gives u_r = P R₀²/β.

    Parameters
    ----------
    layers : list of Layer
        From the lumen outwards.
    radius : float
        R₀, m.
    poisson_ratio : float
        ν of all layers, below ½.

    Returns
    -------
    ndarray
        Of the broadcast shape of the moduli.
    """
    edges = radius + np.concatenate([[0.0], np.cumsum([layer.thickness for layer in layers])])
    nu = poisson_ratio
    support: Floats | float = 0.0  # −σ_r/u_r at the layer's outer edge, Pa/m
    for layer, inner, outer in reversed(list(zip(layers, edges[:-1], edges[1:], strict=True))):
        factor = np.asarray(layer.youngs_modulus, dtype=float) / (1 + nu)
        # b/a from −σ_r = support · u_r at the outer edge
        top = factor / (1 - 2 * nu) + support * outer
        bottom = factor / outer**2 - support / outer
        ratio = top / bottom
        stress = factor * (1 / (1 - 2 * nu) - ratio / inner**2)
        support = -stress / (inner + ratio / inner)
    return np.asarray(support * radius**2)
