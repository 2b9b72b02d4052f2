"""Manufactured tubes as plot files."""

import importlib.util
from collections.abc import Collection
from pathlib import Path

import numpy as np
from tubes import Tube

from validation.mapping.elements import HEXAHEDRON, TETRAHEDRON, WEDGE
from validation.mapping.interpolation import Topology
from validation.mapping.mesh import padded
from validation.mapping.pressure import element_centres
from validation.reference.mesh.model import frame

WRITER = Path(__file__).parents[1] / "febio_io/xplt_writer.py"
FEBIO_TYPE = {HEXAHEDRON: 0, WEDGE: 1, TETRAHEDRON: 2}
VARIABLES = ("displacement", "nodal fluid velocity", "fluid pressure")


def _writer_module():
    spec = importlib.util.spec_from_file_location("plot_file_writer", WRITER)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


xplt = _writer_module()


def write_tube(
    path: Path,
    tube: Tube,
    times: Collection[float],
    *,
    axis: str = "z",
    phi_zero: str = "x",
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    variables: Collection[str] = VARIABLES,
    nodal_pressure: bool = False,
    names: tuple[str, ...] = ("Blood", "Wall"),
    length: float = 1.0,
    time: float = 1.0,
    pressure: float = 1.0,
) -> Path:
    """Write a plot file of equal states; pressure in the lumen's domains as averages or at nodes.

    ``names``: of the lumen's domains, then one for each block of the wall, the last for all that follow.
    ``length``, ``time``, ``pressure``: units of the file, SI.
    """
    place = frame(axis, phi_zero, origin)
    coordinates = (tube.coordinates @ place.rotation + place.origin) / length
    blocks = [*tube.lumen, *tube.vessel_wall]
    wet = len(tube.lumen)
    items = {
        "displacement": xplt.Item("node", "displacement", "vec3f", "node"),
        "nodal fluid velocity": xplt.Item("node", "nodal fluid velocity", "vec3f", "node"),
        "fluid pressure": (
            xplt.Item("domain", "effective fluid pressure", "float", "node")
            if nodal_pressure
            else xplt.Item("domain", "fluid pressure", "float", "item")
        ),
    }
    node_data = {
        "displacement": tube.displacement @ place.rotation / length,
        "nodal fluid velocity": tube.velocity @ place.rotation * time / length,
    }
    data, node_index = {}, 0
    for name in VARIABLES:
        if name in variables and name in node_data:
            node_index += 1
            data["node", node_index] = {0: node_data[name]}
    if "fluid pressure" in variables:
        data["domain", 1] = {n + 1: _pressure(tube, blocks[n], nodal_pressure) / pressure for n in range(wet)}
    first = np.cumsum([0, *(len(block.nodes) for block in blocks)]) + 1
    domains = [
        xplt.DomainOf(
            FEBIO_TYPE[block.kind],
            np.column_stack([np.arange(len(block.nodes)) + first[n], block.nodes]).tolist(),
            names[0] if n < wet else names[min(1 + n - wet, len(names) - 1)],
            part=1 + (n >= wet),
        )
        for n, block in enumerate(blocks)
    ]
    writer = xplt.Writer()
    states = [writer.state(float(instant) / time, data) for instant in times]
    mesh = writer.mesh(xplt.MeshOf(coordinates, domains, parts={1: "Blood", 2: "Vessel"}))
    path.write_bytes(writer.file(writer.root([items[name] for name in variables]), mesh, *states))
    return path


def _pressure(tube, block, nodal):
    if nodal:
        return tube.nodal_pressure[list(dict.fromkeys(block.nodes.ravel().tolist()))]  # as first met
    nothing = np.zeros(0, dtype=np.int64)
    kinds, nodes = padded([block])
    return tube.pressure(element_centres(Topology(kinds, nodes, nothing, nothing), tube.coordinates)[:, 0])
