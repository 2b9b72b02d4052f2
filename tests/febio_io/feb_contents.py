"""A model as FEBio would see it: what is left when numbering, names and order do not count."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np


class Parsed:
    """One parsed .feb file; nodes are told by their positions, elements by those of their nodes."""

    def __init__(self, path: Path) -> None:
        self.root = ElementTree.parse(path).getroot()  # noqa: S314 - our own files
        self.places = {
            node.get("id"): tuple(round(float(part) * 1e12) for part in node.text.split(","))
            for node in self.root.iter("node")
        }
        self.sets = {
            item.get("name"): frozenset(self.places[word] for word in item.text.split(","))
            for item in self.root.iter("NodeSet")
        }

    def elements(self):
        """Of each material, its elements by type and nodes, in FEBio's local order."""
        material = {item.get("name"): item.get("mat") for item in self.root.iter("SolidDomain")}
        found = {}
        for part in self.root.iter("Elements"):
            nodes = {tuple(self.places[word] for word in item.text.split(",")) for item in part}
            found.setdefault((material[part.get("name")], part.get("type")), set()).update(nodes)
        return found

    def domain_names(self):
        return [part.get("name") for part in self.root.iter("Elements")]

    def facets(self):
        """Of each surface, its facets: cycles of nodes, beginning with the least, that keep their sense."""
        found = {}
        for surface in self.root.iter("Surface"):
            facets = set()
            for facet in surface:
                nodes = [self.places[word] for word in facet.text.split(",")]
                first = nodes.index(min(nodes))
                facets.add((facet.tag, *nodes[first:], *nodes[:first]))
            found[surface.get("name")] = facets
        return found

    def materials(self):
        return {item.get("name"): parameters(item) for item in self.root.find("Material")}

    def conditions(self):
        """Boundary conditions and loads, by type and place, without those that fix nothing new."""
        found = set()
        for item in (*self.root.find("Boundary"), *self.root.find("Loads")):
            place = self.sets.get(item.get("node_set"), item.get("surface"))
            found.add((item.get("type"), place, parameters(item)))
        return found

    def curves(self):
        return {
            item.get("id"): np.array([[float(word) for word in pt.text.split(",")] for pt in item.iter("pt")])
            for item in self.root.iter("load_controller")
        }

    def control(self):
        """Each parameter by its path."""
        return dict(paths(self.root.find("Control"), ""))

    def output(self):
        """Plot variables, compression, and data records with their items by place."""
        plot = self.root.find("Output/plotfile")
        variables = sorted((item.get("type"), item.get("surface") or "") for item in plot.iter("var"))
        records = [
            (item.tag, tuple(sorted(item.attrib.items())), item.text)
            for item in self.root.find("Output/logfile")
        ]
        return variables, plot.findtext("compression"), records


def paths(element, above):
    for child in element:
        here = f"{above}/{child.tag}"
        yield f"{here}/type", child.get("type")
        if len(child):
            yield from paths(child, here)
        else:
            yield here, number(child.text)


def parameters(element):
    """Type, and parameters by name."""
    own = tuple((key, value) for key, value in sorted(element.attrib.items()) if key in ("type", "lc"))
    text = element.text.strip() if element.text and not len(element) else ""
    inner = tuple(sorted((child.tag, parameters(child)) for child in element))
    return own, number(text), inner


def number(text):
    try:
        return float(text)
    except ValueError:
        return text
