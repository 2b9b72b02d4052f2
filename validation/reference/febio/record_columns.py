"""Columns of data records that a plot file has too, and its values of them."""

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.xplt import Plot, Variable
from validation.reference.febio.plot_file import DISPLACEMENT, ELEMENT_PRESSURE, VELOCITY

Shared = dict[str, list[tuple[int, int]]]
"""Name of a variable → pairs of a column's place in the record and the variable's component."""

POSITION = "position"  # not in plot files: reference position and displacement
_SYMMETRIC = ("xx", "yy", "zz", "xy", "yz", "xz")


def _vector(prefix: str, variable: str) -> dict[str, tuple[str, int]]:
    return {f"{prefix}{axis}": (variable, place) for place, axis in enumerate("xyz")}


# FEBio's name of a column → variable of the plot file, and which component of it
NODE_COLUMNS = {
    **_vector("", POSITION),
    **_vector("u", DISPLACEMENT),
    **_vector("v", "velocity"),
    **_vector("nfv", VELOCITY),
}
ELEMENT_COLUMNS = {
    "fp": (ELEMENT_PRESSURE, 0),
    "fJ": ("fluid volume ratio", 0),
    "J": ("relative volume", 0),
    **_vector("fv", "fluid velocity"),
    **{f"fs{part}": ("fluid stress", place) for place, part in enumerate(_SYMMETRIC)},
    **{name: ("stress", place) for place, name in enumerate(("sx", "sy", "sz", "sxy", "syz", "sxz"))},
}


def shared_columns(columns: tuple[str, ...], items: str, plot: Plot) -> Shared:
    """Find the columns that a plot file has too.

    Parameters
    ----------
    columns : tuple of str
        FEBio's names of the record's values.
    items : {"nodes", "elements"}
        What they belong to.
    plot : Plot
        The open plot file.
    """
    known = NODE_COLUMNS if items == "nodes" else ELEMENT_COLUMNS
    shared: Shared = {}
    for place, column in enumerate(columns):
        if column in known:
            name, component = known[column]
            if _stored(plot, items, name) is not None:
                shared.setdefault(name, []).append((place, component))
    return shared


def values_at(plot: Plot, state: int, items: str, name: str, numbers: Integers) -> Floats:
    """Values of a shared variable at some items.

    Parameters
    ----------
    plot : Plot
        The open plot file.
    state : int
        Number of the state.
    items : {"nodes", "elements"}
        What the values belong to.
    name : str
        Key of :data:`Shared`.
    numbers : ndarray (n,)
        Nodes by their place in the mesh, from 1; elements by their number in the model.

    Returns
    -------
    ndarray (n, n_components)
        NaN where the plot file has no value.
    """
    stored = _stored(plot, items, name)
    if stored is None:
        raise KeyError(name)
    fields, mesh = plot.fields(stored, state), plot.mesh_of(state)
    found = np.full((len(numbers), stored.n_components or 1), np.nan)
    for region, values in fields.items():
        if items == "nodes":
            offset = mesh.coordinates if name == POSITION else 0.0
            table, keys = values + offset, np.arange(1, len(mesh.node_ids) + 1)
        else:
            table, keys = values, mesh.domains[region - 1].element_ids
        order = np.argsort(keys)
        places = order[np.minimum(np.searchsorted(keys, numbers, sorter=order), len(keys) - 1)]
        here = keys[places] == numbers
        found[here] = table.reshape(len(keys), -1)[places[here]]
    return found


def _stored(plot: Plot, items: str, name: str) -> Variable | None:
    section, storage = ("node", "node") if items == "nodes" else ("domain", "item")
    wanted = (section, storage, DISPLACEMENT if name == POSITION else name)
    stored = (v for v in plot.variables if (v.section, v.storage, v.name) == wanted)
    return next(stored, None)
