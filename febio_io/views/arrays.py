"""Plot files as labelled arrays (xarray)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from febio_io.errors import FebioKeyError
from febio_io.xplt.lookup import find_state, find_variables
from febio_io.xplt.whole import Quantity, fill_whole, quantities, regions_in, whole_shape

if TYPE_CHECKING:
    import xarray as xr

    from febio_io.xplt.dictionary import SectionName, Variable
    from febio_io.xplt.mesh import Mesh
    from febio_io.xplt.reader import Plot

SECTIONS: tuple[SectionName, ...] = ("global", "node", "domain", "surface", "edge")
ITEMS = {"domain": "element", "surface": "face", "edge": "line"}
ACTIVE = "active"
NODES_OF_ITEMS = tuple(f"{item}_node" for item in ITEMS.values())
TAKEN = (ACTIVE, "time", "state", "status", "node", *ITEMS.values(), *NODES_OF_ITEMS)


def to_xarray(
    plot: Plot, *, variables: Iterable[str] | None = None, states: Iterable[int] | None = None
) -> xr.Dataset:
    """Read a plot file into labelled arrays.

    Parameters
    ----------
    plot : Plot
        The open file.
    variables : iterable of str, optional
        Names of variables; all, unless given.
    states : iterable of int, optional
        Numbers of states, 0-based, negative ones from the end; all, unless given.

    Returns
    -------
    Dataset
        One variable for each of the file's, in float32 and with NaN where it has no values. First axis
        "time", last axis the components where there are several. Between them: none for global variables;
        "node"; "element", "face" or "line" (with coordinates that tell their domain, surface or edge);
        "domain", "surface" or "edge" for values of a whole region; "domain_node" and so on for nodes of each
        region apart; for values at the nodes of each item also "element_node" and so on. "active" is False
        for eroded elements. Attribute "unit" where the file has it.

    Raises
    ------
    FebioKeyError
        If there is no such variable or state, or the states have different meshes.
    FebioFormatError
        If the file contradicts its format.
    """
    import xarray as xr

    numbers = pick_states(plot, states)
    mesh = common_mesh(plot, numbers)
    coordinates = _coordinates(mesh)
    data: dict[str, Any] = {
        quantity.label: _array(plot, quantity, numbers, mesh)
        for quantity in quantities(pick_variables(plot, variables), SECTIONS, (*coordinates, *TAKEN))
    }
    active = [plot.active_elements(number) for number in numbers]
    data[ACTIVE] = (("time", "element"), np.array(active, dtype=bool).reshape(len(numbers), mesh.n_elements))
    coordinates |= {
        "time": plot.times[numbers],
        "state": ("time", numbers),
        "status": ("time", plot.status[numbers]),
    }
    dataset = xr.Dataset(
        data, attrs={"source": plot.path.name, "software": plot.software, "units": plot.units or ""}
    )
    # Only those of dimensions that some variable has.
    used = {
        name: value
        for name, value in coordinates.items()
        if name == "time" or (isinstance(value, tuple) and value[0] in dataset.sizes)
    }
    return dataset.assign_coords(used)


def pick_states(plot: Plot, states: Iterable[int] | None) -> list[int]:
    """Give the numbers of the states that are meant, without negative ones.

    Raises
    ------
    FebioKeyError
        If there is no such state.
    """
    if states is None:
        return list(range(plot.n_states))
    return [find_state(plot.path, plot.n_states, state) for state in states]


def pick_variables(plot: Plot, names: Iterable[str] | None) -> tuple[Variable, ...]:
    """Give the variables of some names, of all sections.

    Raises
    ------
    FebioKeyError
        If there is none of a name.
    """
    if names is None:
        return plot.variables
    wanted = set(names)
    for name in sorted(wanted - {variable.name for variable in plot.variables}):
        find_variables(plot.path, plot.variables, name, None)
    return tuple(variable for variable in plot.variables if variable.name in wanted)


def common_mesh(plot: Plot, numbers: list[int]) -> Mesh:
    """Give the mesh of some states; the first mesh if there are none.

    Raises
    ------
    FebioKeyError
        If they have different meshes.
    """
    mesh = plot.mesh_of(numbers[0]) if numbers else plot.mesh
    for number in numbers:
        if plot.mesh_of(number) is not mesh:
            raise FebioKeyError(
                f"{plot.path}: states {numbers[0]} and {number} have different meshes; "
                "take states of one mesh at a time"
            )
    return mesh


def _array(plot: Plot, quantity: Quantity, numbers: list[int], mesh: Mesh) -> tuple[Any, ...]:
    kind = quantity.kind
    values = np.full((len(numbers), *whole_shape(mesh, kind)), np.nan, dtype=np.float32)
    for place, number in enumerate(numbers):
        fill_whole(plot, quantity, number, values[place, ...])
    attributes = {"storage": kind.storage}
    if not kind.is_scalar:
        attributes["components"] = " ".join(kind.components)
    if kind.unit:
        attributes["unit"] = kind.unit
    return (("time", *_dimensions(kind, quantity.label)), values, attributes)


def _dimensions(kind: Variable, label: str) -> tuple[str, ...]:
    component: tuple[str, ...] = ()
    if not kind.is_scalar:
        named = {"vec3f": "axis", "array": f"member of {label}", "array_vec3f": f"member of {label}"}
        component = (named.get(kind.value_type, kind.value_type),)
    if kind.section == "global":
        return component
    if kind.section == "node":
        return ("node", *component)
    item = ITEMS[kind.section]
    rows = {"node": f"{kind.section}_node", "region": kind.section}.get(kind.storage, item)
    return (rows, f"{item}_node", *component) if kind.storage == "mult" else (rows, *component)


def _coordinates(mesh: Mesh) -> dict[str, Any]:
    found: dict[str, Any] = {
        "axis": ("axis", ["x", "y", "z"]),
        "node_id": ("node", mesh.node_ids),
        **{axis: ("node", mesh.coordinates[:, place]) for place, axis in enumerate("xyz")},
        "element_id": ("element", _joined([domain.element_ids for domain in mesh.domains])),
    }
    sections: tuple[SectionName, ...] = ("domain", "surface", "edge")
    for section in sections:
        regions = regions_in(mesh, section)
        numbers = np.array([region.region for region in regions], dtype=np.int64)
        found[section] = (section, numbers)
        found[f"{section}_name"] = (section, [region.name for region in regions])
        sizes = [region.n_items for region in regions]
        found[f"{ITEMS[section]}_{section}"] = (ITEMS[section], np.repeat(numbers, sizes))
        nodes = [region.nodes for region in regions]
        rows = f"{section}_node"
        found[f"{rows}_{section}"] = (rows, np.repeat(numbers, [len(item) for item in nodes]))
        found[f"{rows}_id"] = (rows, mesh.node_ids[_joined(nodes)])
    return found


def _joined(parts: list[Any]) -> Any:
    return np.concatenate([np.empty(0, dtype=np.int64), *parts])
