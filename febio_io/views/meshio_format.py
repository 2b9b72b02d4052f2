"""Plot files as meshes of meshio.

``import febio_io.views.meshio_format`` makes ``meshio.read("case.xplt")`` work. meshio has no entry
points for formats of other packages, hence the import.
"""

from os import PathLike
from typing import Any

import meshio
import numpy as np

from febio_io.errors import FebioError
from febio_io.xplt import Domain, Mesh, Plot, open_plot
from febio_io.xplt.lookup import find_state
from febio_io.xplt.whole import quantities, values_in, whole_values

FORMAT = "febio-xplt"
POINT_ARRAYS = ("node_id",)
CELL_ARRAYS = ("element_id", "domain", "active")
# FEBio's name: meshio's, and how many of the nodes its cell has.
CELLS = {
    "hex8": ("hexahedron", 8),
    "penta6": ("wedge", 6),
    "tet4": ("tetra", 4),
    "quad4": ("quad", 4),
    "tri3": ("triangle", 3),
    "line2": ("line", 2),
    "hex20": ("hexahedron20", 20),
    "tet10": ("tetra10", 10),
    "tet15": ("tetra10", 10),
    "hex27": ("hexahedron27", 27),
    "tri6": ("triangle6", 6),
    "quad8": ("quad8", 8),
    "quad9": ("quad9", 9),
    "penta15": ("wedge15", 15),
    "tet20": ("tetra", 4),
    "tri10": ("triangle", 3),
    "pyra5": ("pyramid", 5),
    "tet5": ("tetra", 4),
    "pyra13": ("pyramid13", 13),
    "line3": ("line3", 3),
}


def to_meshio(plot: Plot, state: int = -1) -> meshio.Mesh:
    """Give one state as a mesh of meshio.

    Parameters
    ----------
    plot : Plot
        The open file.
    state : int, optional
        Number of the state, 0-based; negative ones from the end. The last, unless given.

    Returns
    -------
    meshio.Mesh
        One block of cells for each domain, nodes at their reference positions. Node variables are point data;
        values of elements, and of whole domains, are cell data; other storages, surfaces and edges have no
        place in meshio's model. Point sets and cell sets are FEBio's node and element sets.

    Raises
    ------
    FebioKeyError
        If there is no such state.
    FebioFormatError
        If the file contradicts its format.
    """
    number = find_state(plot.path, plot.n_states, state)
    mesh = plot.mesh_of(number)
    point_data: dict[str, Any] = {"node_id": mesh.node_ids}
    for quantity in quantities(plot.variables, ("node",), POINT_ARRAYS):
        point_data[quantity.label] = whole_values(plot, quantity, number)
    return meshio.Mesh(
        mesh.coordinates,
        [_cells(domain) for domain in mesh.domains],
        point_data=point_data,
        cell_data=_cell_data(plot, mesh, number),
        point_sets={item.name: item.nodes for item in mesh.node_sets},
        cell_sets={item.name: _members(mesh, item.element_ids) for item in mesh.element_sets},
    )


def _cells(domain: Domain) -> tuple[str, Any]:
    name, count = CELLS[domain.element_type.name]
    order = domain.element_type.vtk_order[:count]
    return name, domain.connectivity[:, order]


def _cell_data(plot: Plot, mesh: Mesh, number: int) -> dict[str, list[Any]]:
    sizes = [domain.n_items for domain in mesh.domains]
    active = np.split(plot.active_elements(number), np.cumsum(sizes)[:-1]) if sizes else []
    data: dict[str, list[Any]] = {
        "element_id": [domain.element_ids for domain in mesh.domains],
        "domain": [np.full(domain.n_items, domain.region) for domain in mesh.domains],
        "active": [part.astype(np.uint8) for part in active],
    }
    for quantity in quantities(plot.variables, ("domain",), CELL_ARRAYS):
        kind = quantity.kind
        if kind.storage in ("node", "mult"):
            continue
        found = values_in(plot, quantity, number)
        shape = () if kind.is_scalar else (kind.n_components or 0,)
        missing = np.full(shape, np.nan, dtype=np.float32)
        data[quantity.label] = [
            np.broadcast_to(found.get(domain.region, missing), (domain.n_items, *shape)).copy()
            for domain in mesh.domains
        ]
    return data


def _members(mesh: Mesh, element_ids: Any) -> list[Any]:
    return [np.flatnonzero(np.isin(domain.element_ids, element_ids)) for domain in mesh.domains]


def read(path: str | PathLike[str]) -> meshio.Mesh:
    """Read the last state of a plot file, for meshio.

    Raises
    ------
    meshio.ReadError
        If the file cannot be read.
    """
    try:
        with open_plot(path) as plot:
            return to_meshio(plot)
    except FebioError as error:
        raise meshio.ReadError(str(error)) from error


meshio.register_format(FORMAT, [".xplt"], read, {})
