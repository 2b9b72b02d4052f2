"""Reads a model (.feb), and tells what is wrong with it as far as that is known for sure."""

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element, ParseError, iterparse

from febio_io.errors import FebioFileError
from febio_io.feb.contents import Contents
from febio_io.feb.mesh_rows import LISTS, Late, check_row
from febio_io.feb.references import References
from febio_io.feb.sections_read import READERS, check_tags, where_of
from febio_io.feb.specification import CHECKED, READ_BY_FEBIO_4, SECTIONS, UNKNOWN
from febio_io.files import open_file

__all__ = ["Contents", "read_structure"]

ROOT = "febio_spec"
OTHER_ROOTS = {
    "febio_optimize": "an optimization of FEBio, which names its model",
    "febio_config": "a configuration of FEBio",
    "febio_restart": "a restart file of FEBio",
}


def read_structure(path: Path) -> Contents:
    """Read a model of any version, and check what can be known for sure of versions 2.5 to 4.0.

    Parameters
    ----------
    path : Path
        The model.

    Returns
    -------
    Contents
        What it has, what is wrong with it, and what has not been checked.

    Raises
    ------
    FebioFileError
        If the file cannot be read, is no XML, or no model.
    """
    contents, references = Contents(), References()
    try:
        with open_file(path) as stream:
            events = iterparse(stream, ("start", "end"))  # noqa: S314 - expat bounds what entities become
            for section in _sections(iter(events), contents, path):
                _read_section(section, contents, references)
    except (ParseError, LookupError, ValueError) as error:  # the latter of an encoding that Python lacks
        raise FebioFileError(f"{path}: not a FEBio model: {error}") from error
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be read: {error.strerror}") from error
    _check_whole(contents, references)
    return contents


def _sections(events: Iterator[tuple[str, Element]], contents: Contents, file: Path) -> Iterator[Element]:
    """Give each section when it is complete; rows of the mesh are checked and dropped on the way."""
    path: list[Element] = []
    late: Late = []
    for event, element in events:
        if event == "start":
            path.append(element)
            if len(path) == 1:
                _check_root(element, contents, file)
            elif len(path) == 2 and not contents.module and element.tag != "Module":
                _check_first(element, contents)
            continue
        path.pop()
        if len(path) > 2 and path[1].tag in LISTS and path[-1].tag in LISTS[path[1].tag]:
            check_row(element, path[-1], contents, late)
            path[-1].remove(element)
        elif len(path) == 1:
            yield element
            path[0].remove(element)
    for where, nodes in late:
        if not contents.elsewhere and (missing := nodes - contents.nodes):
            contents.wrong(f"{where}: node {min(missing)}, which does not exist")


def _check_root(root: Element, contents: Contents, path: Path) -> None:
    if root.tag != ROOT:
        what = OTHER_ROOTS.get(root.tag, f"its first tag is <{root.tag[:40]}>")
        raise FebioFileError(f"{path}: not a FEBio model: {what}; allowed: <{ROOT} version='4.0'>")
    contents.version = root.get("version", "")
    if contents.version not in READ_BY_FEBIO_4:
        contents.wrong(
            f"<{ROOT} version={contents.version!r}>; FEBio 4 reads versions {', '.join(READ_BY_FEBIO_4)}"
        )
    if contents.version not in CHECKED:
        contents.skip(f"what version {contents.version or '(not stated)'} allows")


def _check_first(section: Element, contents: Contents) -> None:
    contents.module = "not stated"
    if contents.version in CHECKED:
        contents.wrong(f"<Module> is missing: it must stand first, before <{section.tag}>")


def _read_section(section: Element, contents: Contents, references: References) -> None:
    where = f"<{section.tag}>"
    if contents.version == "4.0":
        if section.tag not in SECTIONS:
            contents.skip(f"{where}, {UNKNOWN}")
            return
        check_tags(section, contents)
    if section.tag == "Include" or "from" in section.attrib:
        contents.elsewhere = True
        contents.skip(f"{where} of another file, and names that may be there")
    if section.tag in READERS:
        READERS[section.tag](section, contents)
    if section.tag == "Step":
        for step in section.iter("step"):
            for part in step:
                if part.tag in READERS:
                    READERS[part.tag](part, contents)
    if contents.version in CHECKED:
        references.collect(section, where_of)


def _check_whole(contents: Contents, references: References) -> None:
    if contents.version not in CHECKED:
        return
    references.check(contents)
    if contents.elsewhere:
        return
    for what, there in (("Module", contents.module), ("Mesh", contents.nodes)):
        if not there:
            contents.wrong(f"<{what}> is missing or empty")
    if not contents.steps:
        contents.wrong("<Control> is missing, with its <time_steps>; so is a <Step>")
    if contents.version == "4.0":
        for name in contents.elements:
            if name not in contents.domains:
                contents.wrong(f"MeshDomains lacks the elements; Elements name: {name!r}")
