"""Writes a model: small sections by the standard library, the lists of the mesh as text, piece by piece."""

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element, tostring

import numpy as np

from cases.arrays import Floats, Integers
from cases.shell.whole import write_whole, writing
from febio_io.errors import FebioFileError
from febio_io.feb import sections
from febio_io.feb.calcified import calcified_elements
from febio_io.feb.model import ArteryModel
from febio_io.feb.tube_mesh import ELEMENT_KINDS, Facets, TubeMesh, tube_mesh

ROWS_AT_ONCE = 20_000
NODE = '<node id="%d">%.9e,%.9e,%.9e</node>\n'


def write_model(model: ArteryModel, path: Path) -> tuple[str, ...]:
    """Write a model; the file appears whole or not at all.

    Parameters
    ----------
    model : ArteryModel
        The model.
    path : Path
        The file; its folder is made if it is not there.

    Returns
    -------
    tuple of str
        Warnings: where the model is not quite what was asked for.

    Raises
    ------
    FebioModelError
        If the calcification holds no element.
    FebioFileError
        If the file cannot be written.
    """
    mesh = tube_mesh(model.vessel, model.size, model.frame)
    hard = np.zeros(len(mesh.wall), dtype=bool)
    warnings: tuple[str, ...] = ()
    if model.patch is not None:
        calcified = calcified_elements(model.vessel, model.size, model.patch)
        hard = calcified.elements
        warnings = () if calcified.warning is None else (calcified.warning,)
    with writing(path, FebioFileError):
        path.parent.mkdir(parents=True, exist_ok=True)
        with write_whole(path) as partial, partial.open("w", encoding="utf-8", newline="\n") as stream:
            stream.writelines(_document(model, mesh, hard))
    return warnings


def _document(model: ArteryModel, mesh: TubeMesh, hard: Integers) -> Iterator[str]:
    yield '<?xml version="1.0" encoding="UTF-8"?>\n<febio_spec version="4.0">\n'
    for section in (
        sections.module(),
        sections.control(model.timing),
        sections.global_constants(),
        sections.materials(model),
    ):
        yield _text(section)
    yield "<Mesh>\n"
    yield from _mesh(mesh, hard)
    yield "</Mesh>\n"
    for section in (
        sections.mesh_domains(with_calcified=bool(hard.any()), with_healthy=not hard.all()),
        sections.boundary(model),
        sections.loads(),
        sections.load_data(model),
        sections.output(model, mesh.axis.tolist()),
    ):
        yield _text(section)
    yield "</febio_spec>\n"


def _text(section: Element) -> str:
    """One element a line, so that people can read and compare files."""
    return tostring(section, encoding="unicode").replace("><", ">\n<") + "\n"


def _mesh(mesh: TubeMesh, hard: Integers) -> Iterator[str]:
    yield '<Nodes name="all">\n'
    yield from _node_rows(mesh.nodes)
    yield "</Nodes>\n"
    first = 1
    for name, elements in (
        (sections.CORE, mesh.core),
        (sections.LUMEN, mesh.lumen),
        (sections.WALL_HEALTHY, mesh.wall[~hard]),
        (sections.WALL_CALCIFIED, mesh.wall[hard]),
    ):
        if len(elements):
            yield f'<Elements type="{ELEMENT_KINDS[elements.shape[1]]}" name="{name}">\n'
            yield from _rows("elem", first, elements)
            yield "</Elements>\n"
            first += len(elements)
    for name, nodes in (
        (sections.BLOOD_NODES, mesh.blood),
        (sections.INTERFACE_NODES, mesh.interface),
        (sections.INLET_NODES, mesh.inlet),
        (sections.ACROSS_NODES, mesh.across),
        (sections.ALONG_NODES, mesh.along_zero),
        (sections.AXIS_NODES, mesh.axis),
        (sections.ALL_NODES, np.arange(1, len(mesh.nodes) + 1)),
    ):
        yield f'<NodeSet name="{name}">{",".join(map(str, nodes.tolist()))}</NodeSet>\n'
    for name, facets in mesh.surfaces.items():
        yield f'<Surface name="{name}">\n'
        yield from _facets(facets)
        yield "</Surface>\n"


def _facets(parts: tuple[Facets, ...]) -> Iterator[str]:
    first = 1
    for part in parts:
        yield from _rows(part.kind, first, part.nodes)
        first += len(part.nodes)


def _node_rows(nodes: Floats) -> Iterator[str]:
    for start in range(0, len(nodes), ROWS_AT_ONCE):
        part = nodes[start : start + ROWS_AT_ONCE] + 0.0  # no negative zeros
        numbers = np.arange(start + 1, start + 1 + len(part))
        yield NODE * len(part) % tuple(np.column_stack([numbers, part]).ravel().tolist())


def _rows(tag: str, first: int, table: Integers) -> Iterator[str]:
    """Rows of numbers, each with its own, as elements of one tag."""
    template = f'<{tag} id="%d">{",".join(["%d"] * table.shape[1])}</{tag}>\n'
    for start in range(0, len(table), ROWS_AT_ONCE):
        part = table[start : start + ROWS_AT_ONCE]
        numbers = np.arange(first + start, first + start + len(part))
        yield template * len(part) % tuple(np.column_stack([numbers, part]).ravel().tolist())
