"""Checks the rows of a model's mesh one by one: nodes, elements, facets, and lists of numbers."""

from math import isfinite
from xml.etree.ElementTree import Element

from febio_io.feb.contents import UNIQUE, Contents
from febio_io.feb.specification import NODES_OF_FACET, UNKNOWN, nodes_of_element

MESH_LISTS = ("Nodes", "Elements", "Surface", "Edge", "NodeSet", "ElementSet", "DiscreteSet")
# Which lists have rows that are dropped once they are read, section by section.
LISTS = {
    **dict.fromkeys(("Mesh", "Geometry"), MESH_LISTS),
    "MeshData": ("NodeData", "SurfaceData", "ElementData", "EdgeData"),
}
FLAT = ("tri", "quad", "q4")
# Rows that name nodes before these stand: where, and which.
Late = list[tuple[str, set[int]]]


def check_row(row: Element, parent: Element, contents: Contents, late: Late) -> None:
    """Check a row of a list, and take in its number.

    Parameters
    ----------
    row, parent : Element
        The row and its list.
    contents : Contents
        Takes in numbers and problems.
    late : list
        Takes in nodes that do not stand yet.
    """
    if parent.tag == "Nodes":
        _check_node(row, parent, contents)
    elif parent.tag == "Elements":
        name = parent.get("name", "")
        contents.elements[name] = contents.elements.get(name, 0) + 1
        _check_number(row, parent, contents, contents.element_ids)
        if contents.version != "1.2":  # where the row's tag is the type
            _check_element(row, parent, contents, late)
    elif parent.tag in ("Surface", "Edge"):
        if row.tag not in NODES_OF_FACET:
            contents.skip(f"<{parent.tag}>, <{row.tag}>, {UNKNOWN}")
        else:
            _check_nodes(row, parent, row.tag, NODES_OF_FACET[row.tag], contents, late)
    elif parent.tag == "NodeSet":
        node = _integer(row.get("id"))
        if node is not None and node not in contents.nodes:
            late.append((f"<NodeSet name={parent.get('name')!r}>", {node}))


def _where(row: Element, parent: Element) -> str:
    return f"<{parent.tag} name={parent.get('name')!r}>, <{row.tag} id={row.get('id')!r}>"


def _check_number(row: Element, parent: Element, contents: Contents, known: set[int]) -> None:
    text = row.get("id")
    number = _integer(text)
    if number is None:
        found = f"id {text!r}; allowed: a whole number" if text is not None else "without id"
        contents.wrong(f"{_where(row, parent)}: {found}")
    elif number in known and contents.version in UNIQUE:
        contents.wrong(f"{_where(row, parent)}: {number} stands twice")
    else:
        known.add(number)


def _check_node(row: Element, parent: Element, contents: Contents) -> None:
    _check_number(row, parent, contents, contents.nodes)
    try:
        place = [float(word) for word in (row.text or "").split(",")]
    except ValueError:
        place = []
    if len(place) != 3 or not all(map(isfinite, place)):
        contents.wrong(f"{_where(row, parent)}: {row.text!r}; allowed: three finite numbers")


def _check_element(row: Element, parent: Element, contents: Contents, late: Late) -> None:
    kind = parent.get("type", "")
    size = nodes_of_element(kind)
    if size is not None:
        _check_nodes(row, parent, kind.lower(), size, contents, late)
    else:
        contents.skip(f"elements of type {kind!r}, {UNKNOWN}")
    contents.element_types[parent.get("name", "")] = kind


def _check_nodes(row: Element, parent: Element, kind: str, size: int, contents: Contents, late: Late) -> None:
    """Check the nodes of an element or facet; some may stand twice, as in a hexahedron for a wedge."""
    words = (row.text or "").split(",")
    numbers = [_integer(word) for word in words]
    nodes = {number for number in numbers if number is not None}
    least = 2 if kind.startswith(("line", "truss")) else 3 if kind.startswith(FLAT) else 4
    if None in numbers:
        contents.wrong(f"{_where(row, parent)}: {(row.text or '')[:80]!r}; allowed: whole numbers")
    elif len(words) < size or len(nodes) < least:
        wanted = f"{size} nodes, {least} of them different" if size > least else f"{size} different nodes"
        contents.wrong(f"{_where(row, parent)}: {(row.text or '')[:80]!r}; allowed: {wanted}")
    elif not nodes <= contents.nodes:
        late.append((_where(row, parent), nodes - contents.nodes))


def _integer(text: str | None) -> int | None:
    try:
        return int(text or "")
    except ValueError:
        return None
