"""The values of all regions of a state in one array: all elements, all faces, all lines."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Singles
from febio_io.errors import FebioFormatError
from febio_io.xplt.dictionary import SectionName, Variable
from febio_io.xplt.fields import WHOLE
from febio_io.xplt.mesh import Mesh, Region
from febio_io.xplt.reader import Plot

Shape = tuple[int, ...]


@dataclass(frozen=True)
class Quantity:
    """Variables that count as one: FEBio repeats a name where the values are on different surfaces.

    Attributes
    ----------
    label : str
        Name; where variables of one name differ in type or storage, the later ones' have a count added.
    variables : tuple of Variable
        The variables, alike in section, name, type and storage.
    """

    label: str
    variables: tuple[Variable, ...]

    @property
    def kind(self) -> Variable:
        """Any of the variables, for what they have in common."""
        return self.variables[0]


def quantities(
    variables: tuple[Variable, ...], sections: tuple[SectionName, ...], taken: tuple[str, ...] = ()
) -> tuple[Quantity, ...]:
    """Group the variables of some sections, those of a type or storage that cannot be read left out.

    Parameters
    ----------
    variables : tuple of Variable
        The variables.
    sections : tuple of str
        The sections.
    taken : tuple of str, optional
        Labels that are not free.
    """
    groups: dict[tuple[object, ...], list[Variable]] = {}
    for variable in variables:
        readable = bool(variable.n_components) and not variable.storage.startswith("unknown")
        if variable.section in sections and readable:
            alike = (variable.value_type, variable.storage, variable.array_size)
            groups.setdefault((variable.section, variable.name, *alike), []).append(variable)
    labels = set(taken)
    found = []
    for members in groups.values():
        label, count = members[0].name, 1
        while label in labels:
            count += 1
            label = f"{members[0].name} ({count})"
        labels.add(label)
        found.append(Quantity(label, tuple(members)))
    return tuple(found)


def regions_in(mesh: Mesh, section: SectionName) -> tuple[Region, ...]:
    """Give the domains, surfaces or edges; none for global and node variables."""
    tables: dict[SectionName, tuple[Region, ...]] = {
        "domain": mesh.domains,
        "surface": mesh.surfaces,
        "edge": mesh.edges,
    }
    return tables.get(section, ())


def values_in(plot: Plot, quantity: Quantity, state: int) -> dict[int, Singles]:
    """View a quantity's values in all regions.

    Raises
    ------
    FebioFormatError
        If two of its variables have different values in one region.
    """
    found: dict[int, Singles] = {}
    for variable in quantity.variables:
        for region, values in plot.fields(variable, state).items():
            if region in found and not np.array_equal(found[region], values, equal_nan=True):
                raise FebioFormatError(
                    f"two variables {variable.name!r} have different values in {variable.section} region "
                    f"{region}, state {state}",
                    path=plot.path,
                )
            found.setdefault(region, values)
    return found


def whole_shape(mesh: Mesh, kind: Variable) -> Shape:
    """Give the shape of a quantity's values in all regions together.

    Returns
    -------
    tuple of int
        Nodes of the mesh, or rows of all regions (nodes, items or regions, by storage); for storage "mult"
        the nodes of the largest item; components unless the variable is a scalar.
    """
    components = () if kind.is_scalar else (kind.n_components or 0,)
    if kind.section == "global":
        return components
    if kind.section == "node":
        return (len(mesh.node_ids), *components)
    regions = regions_in(mesh, kind.section)
    rows = sum(_rows(region, kind.storage) for region in regions)
    if kind.storage == "mult":
        return (rows, max((region.nodes_per_item for region in regions), default=0), *components)
    return (rows, *components)


def fill_whole(plot: Plot, quantity: Quantity, state: int, out: Singles) -> None:
    """Put a quantity's values in a state into an array of :func:`whole_shape`; leave the rest as it is.

    Raises
    ------
    FebioFormatError
        If a block's size is wrong, or two variables contradict each other.
    """
    kind = quantity.kind
    found = values_in(plot, quantity, state)
    if kind.section in ("global", "node"):
        if WHOLE in found:
            out[...] = found[WHOLE]
        return
    start = 0
    for region in regions_in(plot.mesh_of(state), kind.section):
        stop = start + _rows(region, kind.storage)
        if region.region in found:
            values = found[region.region]
            if kind.storage == "mult":
                out[start:stop, : region.nodes_per_item] = values
            else:
                out[start:stop] = values
        start = stop


def whole_values(plot: Plot, quantity: Quantity, state: int) -> Singles:
    """Give a quantity's values in a state, NaN where it has none.

    Returns
    -------
    float32 array
        In the shape of :func:`whole_shape`.

    Raises
    ------
    FebioFormatError
        If a block's size is wrong, or two variables contradict each other.
    """
    values = np.full(whole_shape(plot.mesh_of(state), quantity.kind), np.nan, dtype=np.float32)
    fill_whole(plot, quantity, state, values)
    return values


def _rows(region: Region, storage: str) -> int:
    if storage == "node":
        return len(region.nodes)
    return 1 if storage == "region" else region.n_items
