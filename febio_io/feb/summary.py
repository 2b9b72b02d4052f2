"""What a model has, as plain data and as text."""

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

from febio_io.feb.contents import Contents

MOST_SHOWN = 10  # problems told one by one
Summary = dict[str, Any]


def summarize_model(path: Path, contents: Contents) -> Summary:
    """Describe a model in values that JSON can hold."""
    return {
        "path": str(path),
        "kind": "model",
        "version": contents.version,
        "module": contents.module,
        "units": contents.units,
        "nodes": len(contents.nodes),
        "domains": [
            {
                "name": name,
                "type": contents.element_types.get(name, ""),
                "elements": count,
                "material": contents.domains.get(name, ""),
            }
            for name, count in contents.elements.items()
        ],
        "surfaces": sorted(contents.surfaces),
        "materials": [{"name": name, "type": kind} for name, kind in contents.materials.items()],
        "conditions": [condition._asdict() for condition in contents.conditions],
        "steps": [step._asdict() for step in contents.steps],
        "time_steps": contents.n_steps,
        "end_time": contents.end,
        "plot_variables": contents.variables,
        "problems": contents.problems,
        "n_problems": contents.n_problems,
        "not_checked": list(contents.unchecked),
    }


def model_lines(summary: Summary) -> Iterator[str]:
    """Write a model's summary for people, line by line."""
    n_problems = summary["n_problems"]
    found = f"{n_problems} problem{'s' * (n_problems > 1)}" if n_problems else "its structure is in order"
    units = f", units {summary['units']}" if summary["units"] else ""
    yield f"{summary['path']}: FEBio model {summary['version']}, {summary['module']}{units}, {found}"
    total = sum(domain["elements"] for domain in summary["domains"])
    yield f"  mesh         {summary['nodes']} nodes, {total} elements"
    for domain in summary["domains"]:
        kind = f" {domain['type']}" if domain["type"] else ""
        material = domain["material"] or "not said"
        yield f"    domain {domain['name']}: {domain['elements']}{kind} elements, material {material}"
    yield f"  surfaces     {', '.join(summary['surfaces']) or 'none'}"
    materials = [f"{item['name']} ({item['type']})" for item in summary["materials"]]
    yield f"  materials    {', '.join(materials) or 'none'}"
    yield "  conditions" if summary["conditions"] else "  conditions   none"
    for section, items in groupby(summary["conditions"], key=lambda item: item["section"]):
        places = (f"{item['kind']} on {item['place']}" if item["place"] else item["kind"] for item in items)
        yield f"    {section.lower()}: {', '.join(dict.fromkeys(places))}"
    several = f" in {len(summary['steps'])} analysis steps" if len(summary["steps"]) > 1 else ""
    yield f"  time steps   {summary['time_steps']}{several}, to {summary['end_time']:g}"
    if summary["not_checked"]:
        yield f"  not checked: {'; '.join(summary['not_checked'])}"


def problem_lines(contents: Contents) -> Iterator[str]:
    """Tell a model's problems one by one, of many the first."""
    yield from contents.problems[:MOST_SHOWN]
    if contents.n_problems > MOST_SHOWN:
        yield f"and {contents.n_problems - MOST_SHOWN} more problems"
