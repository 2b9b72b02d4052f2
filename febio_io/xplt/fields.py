"""The blocks of values in a state: where they are, what shape they must have, and the values."""

from dataclasses import dataclass
from math import prod

import numpy as np

from cases.arrays import Flags, Singles
from febio_io.xplt.container import Chunk, Source, children, children_by_tag, required
from febio_io.xplt.dictionary import SectionName, Variable
from febio_io.xplt.mesh import Mesh, Region
from febio_io.xplt.tags import Tag

DATA_SECTIONS: dict[int, SectionName] = {
    Tag.GLOBAL_DATA: "global",
    Tag.NODE_DATA: "node",
    Tag.DOMAIN_DATA: "domain",
    Tag.SURFACE_DATA: "surface",
    Tag.EDGE_DATA: "edge",
}
WHOLE = 0  # region number of values of the whole mesh or model


@dataclass(frozen=True)
class StateData:
    """Where the values of one state are.

    Attributes
    ----------
    number : int
        Number of the state, 0-based.
    source : Source
        The file, or the inflated state.
    variables : dict
        The data chunk of each (section, index) that the state has.
    mesh_state, objects : Chunk or None
        What the state says of its elements and of the objects, where it does.
    """

    number: int
    source: Source
    variables: dict[tuple[SectionName, int], Chunk]
    mesh_state: Chunk | None = None
    objects: Chunk | None = None


def locate_variables(source: Source, state: Chunk, number: int) -> StateData:
    """Find the data of every variable of a state; no values are read.

    Raises
    ------
    FebioFormatError
        If a chunk does not fit or a variable occurs twice.
    """
    found: dict[tuple[SectionName, int], Chunk] = {}
    branches = children_by_tag(source, state)
    data = branches.get(Tag.STATE_DATA)
    for section in children(source, data) if data else ():
        if section.tag not in DATA_SECTIONS:
            continue
        for entry in children(source, section):
            if entry.tag != Tag.STATE_VARIABLE:
                continue
            parts = children_by_tag(source, entry)
            index = source.integer(required(source, entry, parts, Tag.VARIABLE_ID))
            key = (DATA_SECTIONS[section.tag], index)
            if key in found:
                raise source.error(
                    f"{key[0]} variable {index} occurs twice in state {number}", entry.start, entry.tag
                )
            found[key] = required(source, entry, parts, Tag.VARIABLE_DATA)
    return StateData(number, source, found, branches.get(Tag.MESH_STATE), branches.get(Tag.OBJECTS_STATE))


def regions_of(variable: Variable, mesh: Mesh) -> dict[int, Region | None]:
    """Give the regions a variable can have values in, by number; global and node variables have 0: None."""
    tables: dict[SectionName, tuple[Region, ...]] = {
        "domain": mesh.domains,
        "surface": mesh.surfaces,
        "edge": mesh.edges,
    }
    if variable.section not in tables:
        return {WHOLE: None}
    return {region.region: region for region in tables[variable.section]}


def block_shape(variable: Variable, mesh: Mesh, region: Region | None) -> tuple[int, ...] | None:
    """Give the shape of a variable's values in a region.

    Parameters
    ----------
    variable : Variable
        The variable.
    mesh : Mesh
        The mesh.
    region : Region or None
        The domain, surface or edge; None for global and node variables.

    Returns
    -------
    tuple of int or None
        Items, nodes of each item, components: each only where there is more than one by kind; None if the
        variable's type or storage is unknown.
    """
    if region is None:
        items: tuple[int, ...] | None = (len(mesh.node_ids),) if variable.section == "node" else ()
    elif variable.storage == "node":
        items = (len(region.nodes),)
    else:
        items = {
            "item": (region.n_items,),
            "mult": (region.n_items, region.nodes_per_item),
            "region": (),
        }.get(variable.storage)
    if items is None or variable.n_components is None:
        return None
    return items if variable.is_scalar else (*items, variable.n_components)


def find_blocks(state: StateData, variable: Variable, mesh: Mesh) -> dict[int, Chunk]:
    """Find a variable's blocks of values and check their sizes.

    Returns
    -------
    dict of int to Chunk
        The block of each region that has values, by the region's number; 0 for global and node variables.

    Raises
    ------
    FebioFormatError
        If a region is not the mesh's or occurs twice, a block's size is not what dictionary and mesh
        require, or the variable's type or storage is unknown.
    """
    data = state.variables.get((variable.section, variable.index))
    if data is None:
        return {}
    regions = regions_of(variable, mesh)
    blocks: dict[int, Chunk] = {}
    for block in children(state.source, data):
        problem = _problem(variable, mesh, regions, blocks, block)
        if problem:
            where = f"variable {variable.name!r}, {variable.section} region {block.tag}, state {state.number}"
            raise state.source.error(f"{where}: {problem}", block.start)
        blocks[block.tag] = block
    return blocks


def _problem(
    variable: Variable, mesh: Mesh, regions: dict[int, Region | None], seen: dict[int, Chunk], block: Chunk
) -> str | None:
    if block.tag not in regions:
        return "the mesh has no such region"
    if block.tag in seen:
        return "the region occurs twice"
    shape = block_shape(variable, mesh, regions[block.tag])
    if shape is None:
        return f"values of type {variable.value_type} and storage {variable.storage} cannot be read"
    if block.size != 4 * prod(shape):
        return f"{block.size} bytes where shape {shape} of float32 needs {4 * prod(shape)}"
    return None


def view_block(
    state: StateData, variable: Variable, mesh: Mesh, region: Region | None, block: Chunk
) -> Singles:
    """View the values of a block that :func:`find_blocks` found.

    Parameters
    ----------
    state : StateData
        The state.
    variable : Variable
        The variable.
    mesh : Mesh
        The mesh.
    region : Region or None
        The block's domain, surface or edge; None for global and node variables.
    block : Chunk
        The block.

    Returns
    -------
    float32 array
        The values, in the shape of :func:`block_shape`: read-only, and the stored bytes themselves where
        these have the machine's byte order.
    """
    shape = block_shape(variable, mesh, region)
    values = state.source.array(block, "f4").astype(np.float32, copy=False).reshape(shape or ())
    values.flags.writeable = False
    return values


def read_active_elements(state: StateData, mesh: Mesh) -> Flags:
    """Read which elements take part in a state.

    Returns
    -------
    (n_elements,) bool array
        False for eroded elements; domain by domain, in the order of each domain's elements.

    Raises
    ------
    FebioFormatError
        If the state does not tell of as many elements as the mesh has.
    """
    flags = children_by_tag(state.source, state.mesh_state) if state.mesh_state else {}
    if Tag.ELEMENT_STATE not in flags:
        return np.ones(mesh.n_elements, dtype=bool)
    chunk = flags[Tag.ELEMENT_STATE]
    values = state.source.array(chunk, "u4")
    if len(values) != mesh.n_elements:
        raise state.source.error_in(
            chunk,
            f"flags of {len(values)} elements in state {state.number}, whose mesh has {mesh.n_elements}",
        )
    return (values & 1).astype(bool)
