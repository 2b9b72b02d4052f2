"""What a plot file holds, as plain data and as text."""

from collections import Counter
from collections.abc import Iterator
from math import isfinite
from typing import Any

from febio_io.xplt.mesh import Mesh
from febio_io.xplt.reader import Plot

Summary = dict[str, Any]


def summarize(plot: Plot) -> Summary:
    """Describe a plot file in values that JSON can hold.

    Returns
    -------
    dict
        Header, states, meshes and variables. A variable's `regions` are those with values in the last state.

    Raises
    ------
    FebioFormatError
        If a mesh or the last state contradicts the format.
    """
    last = plot.n_states - 1
    return {
        "path": str(plot.path),
        "kind": "plot file",
        "version": f"{plot.version:#04x}",
        "software": plot.software,
        "units": plot.units,
        "compressed": plot.compressed,
        "warnings": list(plot.warnings),
        "states": {
            "count": plot.n_states,
            "times": [time if isfinite(time) else None for time in plot.times.tolist()],
            "status": {str(value): count for value, count in sorted(Counter(plot.status.tolist()).items())},
        },
        "meshes": [_summarize_mesh(mesh) for mesh in plot.meshes],
        "variables": [
            {
                "section": variable.section,
                "index": variable.index,
                "name": variable.name,
                "value_type": variable.value_type,
                "storage": variable.storage,
                "components": list(variable.components),
                "unit": variable.unit,
                "regions": list(plot.regions(variable, last)) if plot.n_states else [],
            }
            for variable in plot.variables
        ],
    }


def _summarize_mesh(mesh: Mesh) -> Summary:
    return {
        "nodes": len(mesh.node_ids),
        "elements": mesh.n_elements,
        "domains": [
            {
                "region": domain.region,
                "name": domain.name,
                "part": domain.part_name,
                "element_type": domain.element_type.name,
                "elements": domain.n_items,
            }
            for domain in mesh.domains
        ],
        "surfaces": [{"region": s.region, "name": s.name, "faces": s.n_items} for s in mesh.surfaces],
        "edges": [{"region": e.region, "name": e.name, "lines": e.n_items} for e in mesh.edges],
        "facet_sets": [{"name": s.name, "faces": s.n_items} for s in mesh.facet_sets],
        "node_sets": [{"name": s.name, "nodes": len(s.nodes)} for s in mesh.node_sets],
        "element_sets": [{"name": s.name, "elements": len(s.element_ids)} for s in mesh.element_sets],
        "objects": [
            {
                "kind": item.kind,
                "id": item.object_id,
                "name": item.name,
                "variables": [variable.name for variable in item.variables],
            }
            for item in mesh.objects
        ],
        "parts": [{"id": part.part_id, "name": part.name} for part in mesh.parts],
    }


def summary_lines(summary: Summary) -> Iterator[str]:
    """Write a summary for people, line by line."""
    yield f"{summary['path']}: FEBio plot file, version {summary['version']}"
    yield f"  written by   {summary['software'] or 'not said'}"
    yield f"  units        {summary['units'] or 'not said'}"
    yield f"  compression  {'zlib' if summary['compressed'] else 'none'}"
    yield f"  states       {_states(summary['states'])}"
    for warning in summary["warnings"]:
        yield f"  warning      {warning}"
    for number, mesh in enumerate(summary["meshes"], start=1):
        which = f" {number} of {len(summary['meshes'])}" if len(summary["meshes"]) > 1 else ""
        yield f"  mesh{which}: {mesh['nodes']} nodes, {mesh['elements']} elements"
        yield from _mesh_lines(mesh)
    yield "  variables (regions with values in the last state)"
    for variable in summary["variables"]:
        unit = f" [{variable['unit']}]" if variable["unit"] else ""
        kind = f"{variable['section']:8} {variable['value_type']:12} {variable['storage']:7}"
        regions = ", ".join(map(str, variable["regions"])) or "none"
        whole = variable["section"] in ("global", "node") and variable["regions"]
        yield f"    {kind} {variable['name']}{unit}" + ("" if whole else f"  regions {regions}")


def _states(states: Summary) -> str:
    if not states["count"]:
        return "none"
    status = ", ".join(f"{count} with status {value}" for value, count in states["status"].items())
    first, last = (
        "not a number" if time is None else f"{time:g}" for time in (states["times"][0], states["times"][-1])
    )
    return f"{states['count']}, time {first} to {last}; {status}"


def _mesh_lines(mesh: Summary) -> Iterator[str]:
    for domain in mesh["domains"]:
        yield (
            f"    domain {domain['region']} {domain['name'] or '(no name)'}: "
            f"{domain['elements']} {domain['element_type']}, material {domain['part'] or '(no name)'}"
        )
    for surface in mesh["surfaces"]:
        yield f"    surface {surface['region']} {surface['name']}: {surface['faces']} faces"
    for edge in mesh["edges"]:
        yield f"    edge {edge['region']} {edge['name']}: {edge['lines']} lines"
    for item in mesh["objects"]:
        what = "rigid body or joint" if item["kind"] == "point" else "connector"
        yield f"    {what} {item['id']} {item['name'] or '(no name)'}: {', '.join(item['variables'])}"
    for kind, members in (("facet", "faces"), ("node", "nodes"), ("element", "elements")):
        if sets := mesh[f"{kind}_sets"]:
            yield f"    {kind} sets: " + ", ".join(f"{item['name']} ({item[members]})" for item in sets)
