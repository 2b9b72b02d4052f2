"""How a study's samples are chosen: all combinations, row by row, or spread over the unit cube."""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import model_validator

from cases.arrays import Floats
from cases.sections.base import Section
from cases.values.kinds import one_of, refused, whole_number
from validation.sweep.parameters import Parameter

Kind = Literal["grid", "list", "latin_hypercube", "sobol", "saltelli"]
MOST_SAMPLES = 1_000_000
MOST_SEED = 2**32 - 1
OF_VALUES = ("grid", "list")  # designs that take the stated values, no more and no fewer
OF_TWOS = ("sobol", "saltelli")  # sequences that are balanced after a power of two
EDGE = 2.0**-53  # of the unit cube, where a distribution without an end has no value


class Design(Section):
    """How samples are chosen.

    Attributes
    ----------
    kind : str
        ``grid``: every combination of the values; ``list``: the first values of all parameters, the
        second, …; ``latin_hypercube``, ``sobol``: spread over the distributions; ``saltelli``: as Sobol
        indices need them.
    count : int or None
        How many samples; of a saltelli design the base samples, each of which gives 2 + parameters. None for
        a grid and a list, whose values count.
    seed : int
        What random numbers start from.
    """

    kind: Annotated[Kind, one_of(Kind)]
    count: (
        Annotated[
            int, whole_number(f"a whole number from 1 to {MOST_SAMPLES}", lambda n: 1 <= n <= MOST_SAMPLES)
        ]
        | None
    ) = None
    seed: Annotated[
        int, whole_number(f"a whole number from 0 to {MOST_SEED}", lambda n: 0 <= n <= MOST_SEED)
    ] = 0

    @model_validator(mode="after")
    def _count(self) -> Self:
        if self.kind in OF_VALUES:
            for key in ("count", "seed"):
                if key in self.model_fields_set:
                    raise refused(
                        getattr(self, key), f"none with design {self.kind}: the values count", key=(key,)
                    )
        elif self.count is None:
            raise refused(None, f"a number of samples with design {self.kind}", key=("count",))
        elif self.kind in OF_TWOS and self.count & (self.count - 1):
            below = 1 << (self.count.bit_length() - 1)
            raise refused(
                self.count,
                f"a power of two with design {self.kind}, e.g. {below} or {2 * below}",
                key=("count",),
            )
        return self


def misfit(design: Design, parameters: Sequence[Parameter]) -> str:
    """Say why parameters do not fit a design; empty where they do."""
    if design.kind in OF_VALUES:
        drawn = [parameter.name for parameter in parameters if parameter.values is None]
        if drawn:
            return (
                f"{design.kind}: {drawn[0]} is a distribution; allowed: lists and ranges, or another design"
            )
    if design.kind == "list":
        sizes = {parameter.name: size_of(parameter) for parameter in parameters}
        if len(set(sizes.values())) > 1:
            words = ", ".join(f"{name} {size}" for name, size in sizes.items())
            return f"list: other numbers of values ({words}); allowed: equally many"
    count = samples_of(design, parameters)
    return "" if count <= MOST_SAMPLES else f"{count} samples; allowed: up to {MOST_SAMPLES}"


def size_of(parameter: Parameter) -> int:
    """How many values a list or range has; 0 for a distribution."""
    return 0 if parameter.values is None else parameter.values.size


def samples_of(design: Design, parameters: Sequence[Parameter]) -> int:
    """How many samples a design has."""
    if design.kind == "grid":
        return int(np.prod([size_of(parameter) for parameter in parameters], dtype=object))
    if design.kind == "list":
        return size_of(parameters[0])
    count = design.count or 0
    return count * (len(parameters) + 2) if design.kind == "saltelli" else count


def points(design: Design, parameters: Sequence[Parameter]) -> Floats:
    """Values of all samples, SI, (samples, parameters); the same for the same design and parameters."""
    if design.kind in OF_VALUES:
        values = [parameter.values for parameter in parameters if parameter.values is not None]
        if design.kind == "list":
            return np.stack(values, axis=-1)
        return np.stack([axis.ravel() for axis in np.meshgrid(*values, indexing="ij")], axis=-1)
    shares = np.clip(SPREADS[design.kind](design, len(parameters)), EDGE, 1.0 - EDGE)
    return np.stack([parameter.at(shares[:, n]) for n, parameter in enumerate(parameters)], axis=-1)


def _latin_hypercube(design: Design, dimensions: int) -> Floats:
    from scipy.stats import qmc

    return np.asarray(qmc.LatinHypercube(dimensions, rng=design.seed).random(design.count or 0))


def _sobol(design: Design, dimensions: int) -> Floats:
    from scipy.stats import qmc

    return np.asarray(qmc.Sobol(dimensions, rng=design.seed).random(design.count or 0))


def _saltelli(design: Design, dimensions: int) -> Floats:
    from SALib.sample import sobol

    return np.asarray(
        sobol.sample(
            unit_cube(dimensions), design.count or 0, calc_second_order=False, scramble=True, seed=design.seed
        )
    )


def unit_cube(dimensions: int) -> dict[str, Any]:
    """Return SALib's description of a unit cube."""
    return {
        "num_vars": dimensions,
        "names": [f"x{n}" for n in range(dimensions)],
        "bounds": [[0.0, 1.0]] * dimensions,
    }


SPREADS: Mapping[str, Callable[[Design, int], Floats]] = MappingProxyType(
    {"latin_hypercube": _latin_hypercube, "sobol": _sobol, "saltelli": _saltelli}
)
