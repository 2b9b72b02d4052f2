"""Checks what refers to something else in a model: sets, surfaces, materials, load curves, maps."""

from collections.abc import Callable
from xml.etree.ElementTree import Element

from febio_io.errors import nearest_first
from febio_io.feb.contents import Contents

# Attributes whose value is a name, and what it names, wherever they stand.
ATTRIBUTES = {
    "node_set": "NodeSet",
    "surface": "Surface",
    "surface_pair": "SurfacePair",
    "elem_set": "ElementSet",
    "edge": "Edge",
    "discrete_set": "DiscreteSet",
    "dmat": "discrete_material",
    "lc": "load curve",
}
# What may stand for the nodes of something else, as node_set="@surface:NAME".
NODES_OF = {"surface": "Surface", "edge": "Edge", "elem_set": "ElementSet", "part_list": "PartList"}
DOMAINS = ("SolidDomain", "ShellDomain", "BeamDomain")
BODIES = ("rb", "body_a", "body_b")  # rigid ones, by the names or numbers of their materials
SHOWN = 10  # names that there are


class References:
    """What has been referred to so far: kind and name, with the first place that does so."""

    def __init__(self) -> None:
        self.first: dict[tuple[str, str], str] = {}

    def collect(self, section: Element, where_of: Callable[[Element], str]) -> None:
        """Take in what a section refers to."""
        for element in section.iter():
            for key, kind in ATTRIBUTES.items():
                if key in element.attrib and section.tag not in ("Mesh", "Geometry"):
                    self._add(kind, element.attrib[key], f"{where_of(element)}: {key}")
            if element.tag in DOMAINS:
                self._add(
                    "elements", element.get("name", ""), f"<{element.tag} name={element.get('name')!r}>: name"
                )
                self._add("material", element.get("mat", ""), f"{where_of(element)}: mat")
            elif element.tag == "Elements" and "mat" in element.attrib and section.tag == "Geometry":
                self._add("body", element.attrib["mat"], f"{where_of(element)}: mat")
            elif element.tag in BODIES:
                self._add("body", element.text or "", f"<{element.tag}>")
            elif element.get("type") == "map" and not len(element) and section.tag != "MeshData":
                self._add("map", element.text or "", f"{where_of(element)}: map")
            elif element.tag in ("primary", "secondary") and section.tag == "Mesh":
                self._add("Surface", element.text or "", f"<SurfacePair>, <{element.tag}>")

    def _add(self, kind: str, name: str, where: str) -> None:
        self.first.setdefault((kind, name.strip()), where)

    def check(self, contents: Contents) -> None:
        """Note what does not exist, in the contents; where parts are in other files, nothing is known."""
        known = {**contents.names, "elements": set(contents.elements)}
        known["body"] = known.get("material", set()) | known.get("number of a material", set())
        for kind in ("ElementSet", "Surface", "NodeSet"):
            lists = {f"@part_list:{name}" for name in known.get("PartList", ())}
            known[kind] = known.get(kind, set()) | lists
        for kind, name in self.first:
            if kind == "NodeSet" and name.startswith("@"):
                of, _, place = name[1:].partition(":")
                if of in NODES_OF and place in known.get(NODES_OF[of], ()):
                    known[kind].add(place)  # FEBio makes a set of this name
                    known[kind].add(name)
        if contents.elsewhere:
            return
        for (kind, name), where in self.first.items():
            if name not in known.get(kind, ()):
                contents.wrong(
                    f"{where}: {name!r} does not exist; there are: {_listed(name, known.get(kind, set()))}"
                )


def _listed(wanted: str, known: set[str]) -> str:
    names = nearest_first(wanted, sorted(known))
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return (", ".join(names[:SHOWN]) or "none") + more
