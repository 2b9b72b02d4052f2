"""Checks a model (.feb) against the specification: tags, attributes, and what refers to something else."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar
from xml.etree.ElementTree import Element, ParseError, iterparse

import numpy as np

from febio_io.errors import FebioFileError, FebioFormatError
from febio_io.feb.specification import (
    NODES_OF_ELEMENT,
    NODES_OF_FACET,
    PARAMETER,
    SECTIONS,
    VERSION,
    Tag,
)
from febio_io.files import open_file

T = TypeVar("T")
ROWS = ("node", "elem", *NODES_OF_FACET)  # checked where they stand and dropped: there may be millions


@dataclass
class Contents:
    """What a model has, by name or number, for what refers to it.

    Attributes
    ----------
    module : str
        The equations that it solves.
    nodes : set of int
        Numbers of its nodes.
    elements : dict of str to int
        How many elements the lists of elements have.
    node_sets, surfaces, materials : set of str
        Their names.
    domains : dict of str to str
        The material of each domain.
    curves : set of str
        Numbers of load curves.
    n_steps : int
        Time steps asked for.
    end : float
        Time at the end of the last step, s.
    """

    module: str = ""
    nodes: set[int] = field(default_factory=set)
    elements: dict[str, int] = field(default_factory=dict)
    node_sets: set[str] = field(default_factory=set)
    surfaces: set[str] = field(default_factory=set)
    materials: set[str] = field(default_factory=set)
    domains: dict[str, str] = field(default_factory=dict)
    curves: set[str] = field(default_factory=set)
    n_steps: int = 0
    end: float = 0.0
    element_ids: set[int] = field(default_factory=set)


class _BrokenRuleError(Exception):
    """A rule is broken; the message says where and how."""


def read_structure(path: Path) -> Contents:
    """Read a model, and check its structure.

    Parameters
    ----------
    path : Path
        The model.

    Returns
    -------
    Contents
        What it has.

    Raises
    ------
    FebioFileError
        If the file cannot be read, or is no XML.
    FebioFormatError
        If it is no model of FEBio 4, or breaks a rule: an unknown or missing tag or attribute, a number that
        is none, a reference to what is not there.
    """
    contents = Contents()
    try:
        with open_file(path) as stream:
            events = iterparse(stream, ("start", "end"))  # noqa: S314 - expat bounds what entities become
            for section in _sections(iter(events), contents):
                _check_section(section, contents)
        _check_whole(contents)
    except ParseError as error:
        raise FebioFileError(f"{path}: not a FEBio model: {error}") from error
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be read: {error.strerror}") from error
    except _BrokenRuleError as error:
        raise FebioFormatError(str(error), path=path) from error
    return contents


def _sections(events: Iterator[tuple[str, Element]], contents: Contents) -> Iterator[Element]:
    """Give each section when it is complete; rows of the mesh are checked and dropped on the way."""
    path: list[Element] = []
    seen: set[str] = set()
    for event, element in events:
        if event == "start":
            path.append(element)
            if len(path) == 1 and (element.tag, element.get("version")) != ("febio_spec", VERSION):
                found = f"<{element.tag} version={element.get('version')!r}>"
                raise _BrokenRuleError(f"{found}; allowed: <febio_spec version='{VERSION}'>")
            continue
        path.pop()
        if len(path) == 3 and path[1].tag == "Mesh" and element.tag in ROWS:
            _check_row(element, path[2], contents)
            path[2].remove(element)
        elif len(path) == 1:
            if element.tag in seen:
                raise _BrokenRuleError(f"<{element.tag}> stands twice")
            seen.add(element.tag)
            yield element
            path[0].remove(element)


def _check_row(element: Element, parent: Element, contents: Contents) -> None:
    where = f"<{parent.tag} name={parent.get('name')!r}>, <{element.tag} id={element.get('id')!r}>"
    known = SECTIONS["Mesh"].children
    if parent.tag not in known or element.tag not in known[parent.tag].children:
        raise _BrokenRuleError(f"{where}: not allowed there")
    if set(element.attrib) != {"id"}:
        raise _BrokenRuleError(f"{where}: attributes {', '.join(element.attrib) or 'none'}; allowed: id")
    number, words = _integer(element.get("id"), where), (element.text or "").split(",")
    if element.tag == "node":
        if len(words) != 3 or not np.isfinite([_real(word, where) for word in words]).all():
            raise _BrokenRuleError(f"{where}: {element.text!r}; allowed: three finite numbers")
        _add(contents.nodes, number, where)
        return
    sizes = NODES_OF_ELEMENT if element.tag == "elem" else NODES_OF_FACET
    kind = parent.get("type", "") if element.tag == "elem" else element.tag
    if kind not in sizes:
        raise _BrokenRuleError(f"{where}: type {kind!r}; allowed: {', '.join(sizes)}")
    nodes = {_integer(word, where) for word in words}
    if len(nodes) != sizes[kind] or len(words) != sizes[kind]:
        raise _BrokenRuleError(f"{where}: {element.text!r}; allowed: {sizes[kind]} different nodes")
    if missing := nodes - contents.nodes:
        raise _BrokenRuleError(f"{where}: node {min(missing)}, which does not exist")
    if element.tag == "elem":
        _add(contents.element_ids, number, where)
        name = parent.get("name", "")
        contents.elements[name] = contents.elements.get(name, 0) + 1


def _check_section(section: Element, contents: Contents) -> None:
    if section.tag not in SECTIONS:
        raise _BrokenRuleError(f"<{section.tag}>: not known; allowed: {', '.join(SECTIONS)}")
    _check_tag(section, SECTIONS[section.tag], f"<{section.tag}>")
    collect = _COLLECT.get(section.tag)
    if collect is not None:
        collect(section, contents)


def _check_tag(element: Element, tag: Tag, where: str) -> None:
    missing = [name for name in tag.required if name not in element.attrib]
    unknown = [name for name in element.attrib if name not in (*tag.required, *tag.optional)]
    if missing or unknown:
        what = f"without {missing[0]}" if missing else f"with {unknown[0]}"
        raise _BrokenRuleError(f"{where}: {what}; attributes: {', '.join((*tag.required, *tag.optional))}")
    parameters: tuple[str, ...] = ()
    if tag.types:
        kind = element.get("type", "")
        if kind not in tag.types:
            raise _BrokenRuleError(f"{where}: type {kind!r}; allowed: {', '.join(tag.types)}")
        parameters = tag.types[kind]
    for child in element:
        here = f"{where}, <{child.tag}{_name(child)}>"
        if child.tag in parameters:
            _check_tag(child, PARAMETER, here)
            _real(child.text, here)
        elif child.tag in tag.children:
            _check_tag(child, tag.children[child.tag], here)
        else:
            allowed = ", ".join((*parameters, *tag.children)) or "none"
            raise _BrokenRuleError(f"{here}: not allowed there; allowed: {allowed}")


def _name(element: Element) -> str:
    return "".join(f" {key}={element.get(key)!r}" for key in ("id", "name") if key in element.attrib)


def _collect_control(section: Element, contents: Contents) -> None:
    contents.n_steps = _integer(section.findtext("time_steps"), "<Control>, <time_steps>")
    contents.end = contents.n_steps * _real(section.findtext("step_size"), "<Control>, <step_size>")


def _collect_module(section: Element, contents: Contents) -> None:
    contents.module = section.get("type", "")


def _collect_materials(section: Element, contents: Contents) -> None:
    for material in section:
        _add(contents.materials, material.get("name", ""), "<Material>")


def _collect_mesh(section: Element, contents: Contents) -> None:
    for part in section:
        where = f"<{part.tag} name={part.get('name')!r}>"
        if part.tag == "NodeSet":
            nodes = {_integer(word, where) for word in (part.text or "").split(",")}
            if missing := nodes - contents.nodes:
                raise _BrokenRuleError(f"{where}: node {min(missing)}, which does not exist")
            _add(contents.node_sets, part.get("name", ""), where)
        elif part.tag == "Surface":
            _add(contents.surfaces, part.get("name", ""), where)


def _collect_domains(section: Element, contents: Contents) -> None:
    for domain in section:
        name, material = domain.get("name", ""), domain.get("mat", "")
        where = f"<SolidDomain name={name!r}>"
        _need(name, contents.elements, f"{where}: name")
        _need(material, contents.materials, f"{where}: mat")
        contents.domains[name] = material


def _collect_conditions(section: Element, contents: Contents) -> None:
    for item in section:
        where = f"<{item.tag}{_name(item)}>"
        if "node_set" in item.attrib:
            _need(item.attrib["node_set"], contents.node_sets, f"{where}: node_set")
        elif "surface" in item.attrib:
            _need(item.attrib["surface"], contents.surfaces, f"{where}: surface")
        else:
            raise _BrokenRuleError(f"{where}: without node_set and surface")
        for parameter in item:
            if "lc" in parameter.attrib:
                contents.curves.add(parameter.attrib["lc"])


def _collect_curves(section: Element, contents: Contents) -> None:
    known = {controller.get("id", "") for controller in section}
    for wanted in sorted(contents.curves):
        _need(wanted, known, "lc")
    for controller in section:
        where = f"<load_controller{_name(controller)}>"
        points = [(point.text or "").split(",") for point in controller.iter("pt")]
        if not points or any(len(point) != 2 for point in points):
            raise _BrokenRuleError(f"{where}: allowed: points of a time and a value")
        table = np.array([[_real(word, where) for word in point] for point in points])
        if not np.isfinite(table).all() or not (np.diff(table[:, 0]) > 0).all():
            raise _BrokenRuleError(f"{where}: allowed: finite values at increasing times")


def _collect_output(section: Element, contents: Contents) -> None:
    for variable in section.iter("var"):
        if "surface" in variable.attrib:
            _need(
                variable.attrib["surface"], contents.surfaces, f"<var type={variable.get('type')!r}>: surface"
            )


_COLLECT = {
    "Module": _collect_module,
    "Control": _collect_control,
    "Material": _collect_materials,
    "Mesh": _collect_mesh,
    "MeshDomains": _collect_domains,
    "Boundary": _collect_conditions,
    "Loads": _collect_conditions,
    "LoadData": _collect_curves,
    "Output": _collect_output,
}


def _check_whole(contents: Contents) -> None:
    for what, there in (("Module", contents.module), ("Control", contents.n_steps), ("Mesh", contents.nodes)):
        if not there:
            raise _BrokenRuleError(f"<{what}> is missing or empty")
    for name in contents.elements:
        _need(name, contents.domains, "MeshDomains lacks the elements; Elements name")


def _need(wanted: str, known: "set[str] | dict[str, int] | dict[str, str]", where: str) -> None:
    if wanted not in known:
        raise _BrokenRuleError(
            f"{where}: {wanted!r} does not exist; there are: {', '.join(sorted(known)) or 'none'}"
        )


def _add(known: set[T], item: T, where: str) -> None:
    if item in known:
        raise _BrokenRuleError(f"{where}: {item!r} stands twice")
    known.add(item)


def _integer(text: str | None, where: str) -> int:
    if text is None or not text.strip().isdecimal():
        raise _BrokenRuleError(f"{where}: {text!r}; allowed: a whole number")
    return int(text)


def _real(text: str | None, where: str) -> float:
    try:
        return float(text or "")
    except ValueError:
        raise _BrokenRuleError(f"{where}: {text!r}; allowed: a number") from None
