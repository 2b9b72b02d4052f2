"""Sobol indices of outputs, where the design is Saltelli's."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from cases.results.sweep import SobolIndex
from validation.sweep.design import unit_cube
from validation.sweep.folder import all_records
from validation.sweep.study import Study

CONFIDENCE = 0.95
FEWEST_GROUPS = 8  # base samples without a failure, for intervals that mean something
STEADY = 1e-12  # relative standard deviation of an output that does not vary


def sensitivity(study: Study, folder: Path) -> tuple[SobolIndex, ...] | None:
    """Return first-order and total indices with their confidence; None for other designs.

    A base sample of which a run failed or an output has no meaning is left out with all its runs, so that the
    estimators see whole groups only. Saltelli et al. (2010), Comput. Phys. Commun. 181, 259–270.
    """
    if study.design.kind != "saltelli":
        return None
    names = [output.name for output in study.outputs]
    table = all_records(folder, ["variant", *names])
    variants = np.array(table["variant"].to_pylist())
    return tuple(
        row
        for variant in study.templates
        for name in names
        for row in _indices(
            study, variant, name, np.array(table[name].to_numpy(), dtype=float)[variants == variant]
        )
    )


def whole_groups(values: Floats, parameters: int) -> Floats:
    """Return the values of base samples all of whose runs gave one, (groups, parameters + 2)."""
    groups = values.reshape(-1, parameters + 2)
    return groups[np.all(np.isfinite(groups), axis=1)]


def _indices(study: Study, variant: str, output: str, values: Floats) -> Iterator[SobolIndex]:
    from SALib.analyze import sobol

    count = len(study.parameters)
    groups = whole_groups(values, count)
    varies = groups.size > 0 and np.std(groups) > STEADY * np.max(np.abs(groups))
    found = None
    if len(groups) >= FEWEST_GROUPS and varies:
        found = sobol.analyze(
            unit_cube(count),
            groups.ravel(),
            calc_second_order=False,
            conf_level=CONFIDENCE,
            seed=study.design.seed,
        )
    for place, parameter in enumerate(study.parameters):
        indices = {
            name: None if found is None or not np.isfinite(found[name][place]) else float(found[name][place])
            for name in ("S1", "S1_conf", "ST", "ST_conf")
        }
        yield SobolIndex(
            variant=variant, output=output, parameter=parameter.name, **indices, groups=len(groups)
        )
