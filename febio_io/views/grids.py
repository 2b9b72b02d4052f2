"""Plot files as meshes with values (pyvista)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from cases.arrays import Floats, Integers, Singles
from febio_io.errors import FebioFormatError, FebioKeyError
from febio_io.xplt.lookup import find_region, find_state
from febio_io.xplt.mesh import PADDING, Domain, Edge, Mesh, Surface
from febio_io.xplt.whole import Quantity, quantities, values_in, whole_values

if TYPE_CHECKING:
    import pyvista as pv

    from febio_io.xplt.dictionary import Variable
    from febio_io.xplt.reader import Plot

DISPLACEMENT = "displacement"
POINT_ARRAYS = ("node_id",)
CELL_ARRAYS = ("element_id", "domain", "part_id", "active", "face_id")
FIELD_ARRAYS = ("TimeValue", "state", "status")
# By number of nodes: VTK cell type, and how many of the nodes it has.
FACES = {3: (5, 3), 4: (9, 4), 6: (22, 6), 7: (34, 7), 8: (23, 8), 9: (28, 9), 10: (5, 3)}
LINES = {2: (3, 2), 3: (21, 3)}


def to_pyvista(
    plot: Plot,
    state: int = -1,
    *,
    surface: str | int | None = None,
    edge: str | int | None = None,
    deformed: bool = False,
    variables: tuple[Variable, ...] | None = None,
) -> pv.UnstructuredGrid:
    """Give one state as a mesh with its values.

    Parameters
    ----------
    plot : Plot
        The open file.
    state : int, optional
        Number of the state, 0-based; negative ones from the end. The last, unless given.
    surface, edge : str or int, optional
        Name or number of a surface or edge, to have that instead of the elements of all domains.
    deformed : bool, optional
        Whether nodes are where they have moved to, by "displacement"; else they are at their reference
        positions.
    variables : tuple of Variable, optional
        Only these variables; all, unless given.

    Returns
    -------
    UnstructuredGrid
        Node variables are point data; values of elements, faces or lines cell data; values of whole regions
        are repeated in each of their cells; global values are field data. NaN stands where there are none.
        Values at the nodes of one domain are point data, named "VARIABLE (DOMAIN)" where several domains have
        some, because these may differ at a node. Values at the nodes of each element are cell data of
        n_nodes × n_components numbers in FEBio's order. "active" is 0 for eroded elements. Field data
        "TimeValue", "state" and "status" tell of the state.

    Raises
    ------
    FebioKeyError
        If there is no such state, surface or edge.
    FebioFormatError
        If the file contradicts its format, or a face has a number of nodes that no VTK cell has.

    Notes
    -----
    Elements that VTK does not have (tet15, tet20, tet5, tri10) are shown by their corners, tet15 by its first
    ten nodes. Nodes of wedges (penta6) keep FEBio's order, in which VTK computes positive volumes.
    """
    number = find_state(plot.path, plot.n_states, state)
    mesh = plot.mesh_of(number)
    chosen = plot.variables if variables is None else variables
    positions = _positions(plot, mesh, number, deformed)
    if surface is not None or edge is not None:
        region = _find(plot, mesh, surface, edge)
        grid = _region_grid(plot, mesh, region, positions)
        _add_region_values(plot, grid, region, chosen, number)
    else:
        grid = _whole_grid(mesh, positions)
        grid.cell_data["active"] = plot.active_elements(number).astype(np.uint8)
        _add_domain_values(plot, grid, mesh, chosen, number)
    for quantity in quantities(chosen, ("global",), FIELD_ARRAYS):
        grid.field_data[quantity.label] = np.atleast_1d(whole_values(plot, quantity, number))
    grid.field_data["TimeValue"] = [plot.times[number]]
    grid.field_data["state"] = [number]
    grid.field_data["status"] = [plot.status[number]]
    return grid


def _positions(plot: Plot, mesh: Mesh, number: int, deformed: bool) -> Floats:
    if not deformed:
        return mesh.coordinates
    wanted = ("node", DISPLACEMENT, "vec3f")
    found = [item for item in plot.variables if (item.section, item.name, item.value_type) == wanted]
    values = plot.fields(found[0], number) if found else {}
    if not values:
        raise FebioKeyError(f"{plot.path}: state {number} has no displacement to show it deformed by")
    moved: Floats = mesh.coordinates + values[0]
    return moved


def _whole_grid(mesh: Mesh, positions: Floats) -> pv.UnstructuredGrid:
    import pyvista as pv

    cells, types = [np.empty(0, np.int64)], [np.empty(0, np.uint8)]
    for domain in mesh.domains:
        nodes = domain.connectivity[:, domain.element_type.vtk_order]
        cells.append(np.insert(nodes, 0, nodes.shape[1], axis=1).ravel())
        types.append(np.full(len(nodes), domain.element_type.vtk_type, np.uint8))
    grid = pv.UnstructuredGrid(np.concatenate(cells), np.concatenate(types), positions.copy())
    grid.point_data["node_id"] = mesh.node_ids
    sizes = [domain.n_items for domain in mesh.domains]
    ids = [domain.element_ids for domain in mesh.domains]
    grid.cell_data["element_id"] = np.concatenate([np.empty(0, np.int64), *ids])
    grid.cell_data["domain"] = np.repeat([domain.region for domain in mesh.domains], sizes).astype(np.int64)
    grid.cell_data["part_id"] = np.repeat([domain.part_id for domain in mesh.domains], sizes).astype(np.int64)
    return grid


def _add_domain_values(
    plot: Plot, grid: pv.UnstructuredGrid, mesh: Mesh, variables: tuple[Variable, ...], number: int
) -> None:
    for quantity in quantities(variables, ("node",), POINT_ARRAYS):
        _set(grid.point_data, quantity.label, whole_values(plot, quantity, number), quantity.kind)
    cell_quantities = quantities(variables, ("domain",), CELL_ARRAYS)
    for quantity in cell_quantities:
        kind = quantity.kind
        if kind.storage == "node":
            _add_domain_nodes(plot, grid, mesh, quantity, number)
            continue
        values = whole_values(plot, quantity, number)
        if kind.storage == "region":
            values = np.repeat(values, [domain.n_items for domain in mesh.domains], axis=0)
        _set(grid.cell_data, quantity.label, values, kind)


def _add_domain_nodes(
    plot: Plot, grid: pv.UnstructuredGrid, mesh: Mesh, quantity: Quantity, number: int
) -> None:
    found = values_in(plot, quantity, number)
    for domain in mesh.domains:
        if domain.region in found:
            part = found[domain.region]
            values = np.full((len(mesh.node_ids), *part.shape[1:]), np.nan, dtype=np.float32)
            values[domain.nodes] = part
            label = quantity.label if len(found) == 1 else f"{quantity.label} ({_name(mesh, domain)})"
            while label in grid.point_data:
                label += "'"
            _set(grid.point_data, label, values, quantity.kind)


def _name(mesh: Mesh, domain: Domain) -> str:
    alone = sum(other.name == domain.name for other in mesh.domains) == 1
    return domain.name if domain.name and alone else f"domain {domain.region}"


def _find(plot: Plot, mesh: Mesh, surface: str | int | None, edge: str | int | None) -> Surface | Edge:
    regions: tuple[Surface | Edge, ...] = mesh.surfaces if surface is not None else mesh.edges
    names = {region.region: region.name for region in regions}
    wanted = surface if surface is not None else edge
    number = find_region(plot.path, "the mesh", names, wanted)
    return next(region for region in regions if region.region == number)


def _region_grid(plot: Plot, mesh: Mesh, region: Surface | Edge, positions: Floats) -> pv.UnstructuredGrid:
    import pyvista as pv

    table, known = (region.faces, FACES) if isinstance(region, Surface) else (region.lines, LINES)
    counts = (table != PADDING).sum(axis=1)
    unknown = set(counts.tolist()) - set(known)
    if unknown:
        raise FebioFormatError(
            f"{region.name!r} has faces or lines of {min(unknown)} nodes, which VTK has no cell for",
            path=plot.path,
        )
    nodes = region.nodes
    place = np.zeros(len(mesh.node_ids), dtype=np.int64)
    place[nodes] = np.arange(len(nodes))
    kept = np.array([known.get(count, (0, 0))[1] for count in range(table.shape[1] + 1)])[counts]
    types = np.array([known.get(count, (0, 0))[0] for count in range(table.shape[1] + 1)])[counts]
    cells = _cells(place[table], kept)
    grid = pv.UnstructuredGrid(cells, types.astype(np.uint8), positions[nodes])
    grid.point_data["node_id"] = mesh.node_ids[nodes]
    if isinstance(region, Surface):
        grid.cell_data["face_id"] = region.face_ids
    return grid


def _cells(table: Integers, counts: Integers) -> Integers:
    """Write each row's first nodes behind their count."""
    rows = np.insert(table, 0, counts, axis=1)
    used = np.arange(rows.shape[1]) <= counts[:, np.newaxis]
    cells: Integers = rows[used]
    return cells


def _add_region_values(
    plot: Plot,
    grid: pv.UnstructuredGrid,
    region: Surface | Edge,
    variables: tuple[Variable, ...],
    number: int,
) -> None:
    for quantity in quantities(variables, ("node",), POINT_ARRAYS):
        values = whole_values(plot, quantity, number)
        _set(grid.point_data, quantity.label, values[region.nodes], quantity.kind)
    section = "surface" if isinstance(region, Surface) else "edge"
    taken = (*grid.point_data, *CELL_ARRAYS)
    for quantity in quantities(variables, ("surface" if section == "surface" else "edge",), taken):
        found = values_in(plot, quantity, number)
        if region.region not in found:
            continue
        values, kind = found[region.region], quantity.kind
        if kind.storage == "node":
            _set(grid.point_data, quantity.label, values, kind)
        else:
            whole = np.repeat(values[np.newaxis], region.n_items, axis=0)
            _set(grid.cell_data, quantity.label, whole if kind.storage == "region" else values, kind)


def _set(attributes: Any, label: str, values: Singles, kind: Variable) -> None:
    """Add an array, with names of the components where each cell or point has one value."""
    if not values.size:
        return  # pyvista takes no empty arrays
    one_each = kind.storage != "mult"
    flat = values if values.ndim == 1 else values.reshape(len(values), math.prod(values.shape[1:]))
    attributes[label] = np.ascontiguousarray(flat)
    if one_each and not kind.is_scalar:
        array = attributes.VTKObject.GetAbstractArray(label)
        for place, name in enumerate(kind.components):
            array.SetComponentName(place, name)
