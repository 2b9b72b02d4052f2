"""What a model has, as plain data and as text."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from febio_io.feb.structure import Contents

Summary = dict[str, Any]


def summarize_model(path: Path, contents: Contents) -> Summary:
    """Describe a model in values that JSON can hold."""
    return {
        "path": str(path),
        "kind": "model",
        "module": contents.module,
        "nodes": len(contents.nodes),
        "domains": [
            {"name": name, "elements": count, "material": contents.domains[name]}
            for name, count in contents.elements.items()
        ],
        "surfaces": sorted(contents.surfaces),
        "time_steps": contents.n_steps,
        "end_time": contents.end,
    }


def model_lines(summary: Summary) -> Iterator[str]:
    """Write a model's summary for people, line by line."""
    yield f"{summary['path']}: FEBio model, {summary['module']}, its structure is in order"
    total = sum(domain["elements"] for domain in summary["domains"])
    yield f"  mesh         {summary['nodes']} nodes, {total} elements"
    for domain in summary["domains"]:
        yield f"    domain {domain['name']}: {domain['elements']} elements, material {domain['material']}"
    yield f"  surfaces     {', '.join(summary['surfaces']) or 'none'}"
    yield f"  time steps   {summary['time_steps']}, to {summary['end_time']:g}"
