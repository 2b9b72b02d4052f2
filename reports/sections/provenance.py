"""Section of the provenance: what the comparison was made from, and how to make it again."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import replace

from pydantic import JsonValue

from reports.blocks import Block, Bullets, Column, Listing, Paragraph, Table
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.cost import cost_table, inputs_table, records_table
from reports.wording.numbers import ABSENT, counted

Facts = Mapping[str, JsonValue]
_SMALL = 1e-4  # figures that matter by their order of magnitude only
_KEYS = {
    "n_x": "cells along the artery",
    "n_phi": "cells around the artery",
    "viscosity_Pa_s": "viscosity (Pa s)",
    "coverage": "share of the cycle covered",
    "cycle_change": "relative change over the last cycle",
    "wall_locality_error": "largest error of R by a pressure for each section (relative)",
    "version": "version of the plot file",
}
_OF_MACHINE = {"cores": "{} cores", "byte_order": "{}-endian"}


def _word(value: object) -> str:
    if value is None or value == "":
        return ABSENT
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and 0.0 < abs(value) < _SMALL:
        return f"{value:.1e}"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, dict | list):
        return json.dumps(value, ensure_ascii=False)
    return str(value)


def _key(name: str) -> str:
    """Name of a setting in words, with the unit that its last letters tell."""
    if name in _KEYS:
        return _KEYS[name]
    return (f"{name[:-2]} (s)" if name.endswith("_s") else name).replace("_", " ")


def pairs(key: str, caption: str, headings: tuple[str, str], facts: Mapping[str, object]) -> Table:
    """Table of named facts, a row each."""
    rows = tuple((_key(name), _word(value)) for name, value in facts.items())
    return Table(key, caption, (Column(headings[0]), Column(headings[1], "prose")), rows)


def _run(comparison: Comparison) -> Table:
    p = comparison.provenance
    return pairs(
        "run",
        "The run that this report draws.",
        ("what", "value"),
        {
            "case": comparison.case,
            "case file": p.case.path,
            "created": p.created,
            "package version": p.package_version,
            "git commit": (p.git_commit or "").replace("+", " with local changes"),
            "Python": p.python,
            "machine": ", ".join(_OF_MACHINE.get(k, "{}").format(value) for k, value in p.machine.items()),
        },
    )


def _facts(comparison: Comparison, key: str, caption: str, facts: Mapping[str, Facts]) -> Table:
    """Write facts of one model, a row each, with a column for each variant."""
    keys = dict.fromkeys(key for of_variant in facts.values() for key in of_variant)
    return Table(
        key,
        caption,
        (Column("setting"), *(Column(name, "prose") for name in comparison.variants)),
        tuple((_key(key), *(_word(facts[name].get(key)) for name in comparison.variants)) for key in keys),
    )


def _inputs(comparison: Comparison) -> Table:
    p = comparison.provenance
    text = comparison.case_yaml.encode()
    as_kept = hashlib.sha256(text).hexdigest() == p.case.sha256  # else with other line ends or a mark
    files = [(p.case.path, str(len(text)) if as_kept else ABSENT, p.case.sha256)]
    files += [(file.path, str(file.bytes), file.sha256) for file in p.inputs]
    rows = tuple({(path, sha): (path, size, sha) for path, size, sha in files}.values())
    return Table(
        "inputs",
        "Files read, with the checksums that identify them.",
        (Column("file", "prose"), Column("bytes", "number"), Column("sha256", "code")),
        rows,
    )


@declared("provenance", "Provenance")
def section(comparison: Comparison) -> Blocks:
    """Return the command and what it ran on and from; the case file goes with it."""
    return (
        Paragraph(
            "How to repeat it: check out the commit named below, install the package, put the files listed "
            "under inputs in place and run the command."
        ),
        Listing("Command", comparison.provenance.command),
        _run(comparison),
        Listing("The case file", comparison.case_yaml, attached="case.yaml"),
    )


@declared("settings", "Settings, inputs and notes", appendix=True)
def settings(comparison: Comparison) -> Blocks:
    """Return all models' settings, the inputs, the libraries and the notes of the run."""
    p = comparison.provenance
    blocks: list[Block] = []
    for model in comparison.models:
        told = {name: comparison.of(model).settings(name).facts() for name in comparison.variants}
        which = "2D model" if len(comparison.models) == 1 else f"2D model {model}"
        blocks.append(_facts(comparison, model, f"{which}: grid, time step and settings.", told))
    told = {name: p.variants[name].reference.facts() for name in comparison.variants}
    blocks.append(_facts(comparison, "reference", "3D reference: files, mesh and states.", told))
    blocks += [table for table in (inputs_table(comparison), records_table(comparison)) if table]
    for model in comparison.models:
        cost = cost_table(comparison.of(model))
        named = "" if len(comparison.models) == 1 else f"2D model {model}. "
        blocks += [replace(cost, key=f"cost-{model}", caption=named + cost.caption)] if cost else []
    if p.wall_times_s:
        blocks.append(
            pairs(
                "wall-times",
                "Wall-clock times of this run; what comes from the cache takes as long as reading it. "
                "Steps of several variants run at once, so their sum is more than the run took; the first "
                "run of the reduced model compiles its kernels.",
                ("step", "seconds"),
                p.wall_times_s,
            )
        )
    blocks.append(_inputs(comparison))
    blocks.append(pairs("versions", "Versions of the libraries.", ("package", "version"), p.versions))
    if p.notes:
        notes = _once(p.notes)
        blocks.append(Paragraph(f"{counted(len(notes), 'note')} of the run, warnings and assumptions:"))
        blocks.append(Bullets(notes))
    return tuple(blocks)


def _once(notes: Iterable[str]) -> tuple[str, ...]:
    """Notes that say the same of several variants and models, or files, as one that names them all."""
    same: dict[str, list[str]] = {}
    for note in notes:
        of, colon, said = note.partition(": ")
        same.setdefault(said if colon else "", []).append(of)
    alone = [(of, "") for of in same.pop("", [])]
    both = [*alone, *(("; ".join(of), said) for said, of in same.items())]
    return tuple(f"{of}: {said}" if said else of for of, said in both)
