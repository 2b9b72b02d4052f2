"""Takes in the sections of a model one by one, and checks what is known of their tags."""

from collections.abc import Callable, Iterator
from math import isfinite
from xml.etree.ElementTree import Element

from febio_io.feb.contents import Condition, Contents, Step
from febio_io.feb.specification import CHILDREN, KNOWN_MODULE, PARAMETERS, REQUIRED, UNKNOWN

CONDITIONS = ("Boundary", "Initial", "Loads", "Contact", "Constraints", "Rigid")
PLACES = ("node_set", "surface", "surface_pair", "elem_set", "edge")
MESH_SETS = ("NodeSet", "Surface", "Edge", "ElementSet", "PartList", "SurfacePair", "DiscreteSet")


def where_of(element: Element) -> str:
    """Say which element of a model is meant, by its tag and number or name."""
    keys = ("type",) if element.tag == "var" else ("id", "name")
    return (
        f"<{element.tag}{''.join(f' {key}={element.get(key)!r}' for key in keys if key in element.attrib)}>"
    )


def check_tags(section: Element, contents: Contents) -> None:
    """Check the children of a section of version 4.0, their attributes, and parameters of known types."""
    allowed = CHILDREN.get(section.tag)
    for child in section:
        where = where_of(child)
        if section.tag == "Step":
            for part in child:
                check_tags(part, contents)
        if allowed is not None and child.tag not in allowed:
            contents.skip(f"<{section.tag}>, <{child.tag}>, {UNKNOWN}")
            continue
        for name in REQUIRED.get(child.tag, ()):
            if name not in child.attrib:
                contents.wrong(f"{where}: without {name}")
        if child.tag in PARAMETERS or section.tag in (*CONDITIONS, "Discrete"):
            _check_parameters(child, where, contents)


def _check_parameters(element: Element, where: str, contents: Contents) -> None:
    """Check the parameters of what is of a known type; all others are skipped by their names."""
    kind = element.get("type", "")
    known = PARAMETERS.get(element.tag, {}).get(kind) if contents.module == KNOWN_MODULE else None
    if known is None:
        contents.skip(f"<{element.tag} type={kind!r}>" if kind else f"<{element.tag}>")
        return
    for child in element:
        here = f"{where}, {where_of(child)}"
        if child.tag not in known:
            contents.skip(f"{here} of {kind!r}, {UNKNOWN}")
        elif child.tag in PARAMETERS:
            _check_parameters(child, here, contents)
        elif child.get("type", "const") == "const" and not len(child) and _real(child.text) is None:
            contents.skip(f"{here}: the expression {(child.text or '').strip()[:40]!r}")


def _read_module(section: Element, contents: Contents) -> None:
    if contents.module:
        contents.wrong("<Module> stands twice" if contents.module != "not stated" else "<Module> stands late")
    if not section.get("type"):
        contents.wrong("<Module>: without type")
    contents.module = section.get("type", "not stated")
    contents.units = (section.findtext("units") or "").strip()


def _read_control(section: Element, contents: Contents) -> None:
    contents.skip("parameters of <Control>")
    found = []
    for name, what in (("time_steps", "a whole number"), ("step_size", "a number")):
        text = section.findtext(name)
        value = _real(text)
        if text is not None and (value is None or not isfinite(value) or (what[2] == "w" and value % 1)):
            contents.wrong(f"<Control>, <{name}>: {text[:40]!r}; allowed: {what}")
            value = None
        found.append(value or 0.0)
    contents.steps.append(Step(int(found[0]), found[1]))
    if (section.findtext("plot_level") or "").strip() in ("PLOT_NEVER", "0"):
        contents.writes_plot = False


def _read_materials(section: Element, contents: Contents) -> None:
    for material in section.iter("material"):
        name = material.get("name", "") or material.get("id", "")
        contents.define("material", name, where_of(material))
        if "id" in material.attrib:
            contents.define("number of a material", material.attrib["id"], where_of(material))
        contents.materials[name] = material.get("type", "")


def _read_mesh(section: Element, contents: Contents) -> None:
    """Take in a mesh; its rows have been read and dropped."""
    for part in section:
        name, where = part.get("name", ""), where_of(part)
        if part.tag in ("Part", "Instance"):
            contents.elsewhere = True
            contents.skip("parts made from templates, and names that may be there")
        elif part.tag == "Nodes" and name:
            contents.names.setdefault("NodeSet", set()).add(name)
        elif part.tag == "Elements":
            contents.names.setdefault("ElementSet", set()).add(name)
            if contents.version in ("1.2", "2.0", "2.5") and name in contents.elements:
                contents.domains[name] = part.get("mat", "")
        elif part.tag in MESH_SETS:
            contents.define(part.tag, name, where)
            if part.tag == "NodeSet" and not contents.elsewhere:
                missing = next((node for node in _numbers(part.text) if node not in contents.nodes), None)
                if missing is not None:
                    contents.wrong(f"{where}: node {missing}, which does not exist")


def _numbers(text: str | None) -> Iterator[int]:
    """Go through the numbers of a list such as "1,4:8,10:20:2"; what is none is left to FEBio."""
    for word in (text or "").split(","):
        try:
            first, last, step = (*(int(part) for part in word.split(":")), 1, 1)[:3]
        except ValueError:
            continue
        if word.count(":") == 0:
            last, step = first, 1
        elif word.count(":") == 1:
            step = 1
        yield from range(first, min(last, first + 10_000_000) + 1, max(step, 1))


def _read_domains(section: Element, contents: Contents) -> None:
    for domain in section:
        contents.domains[domain.get("name", "")] = domain.get("mat", "")


def _read_conditions(section: Element, contents: Contents) -> None:
    for item in section:
        place = next((item.attrib[key] for key in PLACES if key in item.attrib), "")
        kind = item.get("type") or item.get("bc") or item.get("name") or item.tag
        contents.conditions.append(Condition(section.tag, kind, place))
        if item.tag == "bc" and not place and kind not in ("linear constraint", item.get("name")):
            contents.wrong(f"{where_of(item)}: without node_set and surface")


def _read_discrete(section: Element, contents: Contents) -> None:
    for item in section.iter("discrete_material"):
        contents.define("discrete_material", item.get("id", ""), where_of(item))


def _read_curves(section: Element, contents: Contents) -> None:
    for curve in section:
        contents.define("load curve", curve.get("id", "").strip(), where_of(curve))
        if curve.get("type", "loadcurve") == "loadcurve":
            for point in (point for tag in ("pt", "point", "loadpoint") for point in curve.iter(tag)):
                words = (point.text or "").split(",")
                if len(words) < 2 or not all(isfinite(_real(word) or 0.0) for word in words):
                    contents.wrong(
                        f"{where_of(curve)}: {point.text!r}; allowed: points of a time and a value"
                    )


def _read_maps(section: Element, contents: Contents) -> None:
    contents.names.setdefault("map", set()).update(part.get("name", "") for part in section)


def _read_output(section: Element, contents: Contents) -> None:
    contents.skip("variables of <Output>")
    contents.variables += [variable.get("type", "") for variable in section.iter("var")]
    for plot in section.iter("plotfile"):
        contents.plot = plot.get("file")
        contents.writes_plot &= plot.get("type", "febio") == "febio"
    for log in section.iter("logfile"):
        contents.log = log.get("file")


def _real(text: str | None) -> float | None:
    try:
        return float(text or "")
    except ValueError:
        return None


READERS: dict[str, Callable[[Element, Contents], None]] = {
    "Module": _read_module,
    "Control": _read_control,
    "Material": _read_materials,
    "Mesh": _read_mesh,
    "Geometry": _read_mesh,
    "MeshDomains": _read_domains,
    "MeshData": _read_maps,
    **dict.fromkeys(CONDITIONS, _read_conditions),
    "Discrete": _read_discrete,
    "LoadData": _read_curves,
    "Output": _read_output,
}
