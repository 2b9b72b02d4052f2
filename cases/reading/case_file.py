"""Loading a case file: YAML → base and variants → checked cases in SI units."""

import re
from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from cases.errors import CaseFileError, Problem
from cases.reading.file_kinds import require_kind
from cases.reading.problems import problems_of
from cases.reading.uncertain_numbers import uncertainty_problems
from cases.reading.variants import merge_variant
from cases.reading.yaml_nodes import Node, parse_yaml, read_text
from cases.sections.base import Section
from cases.sections.case import Case
from cases.values.kinds import NAME_CHARACTERS, NAME_PATTERN, Context, Name, Words
from cases.values.wording import choices, shown, unknown_key

ONLY_VARIANT = "base"
S = TypeVar("S", bound=Section)


@dataclass(frozen=True)
class CaseFile:
    """A checked case file.

    Attributes
    ----------
    path : pathlib.Path
        The file, as it was given.
    text : str
        Its text.
    name, title : str
        Its name (up to 64 letters, digits, - and _) and its title; the title is the name where none is
        stated.
    variants : dict of str to Case
        The cases by name, in the file's order; one named "base" where the file states no variants.
    """

    path: Path
    text: str
    name: str
    title: str
    variants: dict[str, Case]


class _Heading(Section):
    """What a file states about itself."""

    name: Name
    title: Words | None = None


CASE_KEYS = tuple(key for key in Case.model_fields if key != "title")
FILE_KEYS = ("name", "title", *CASE_KEYS, "variants")


def load_case_file(path: str | Path, results_exist: bool = True) -> CaseFile:
    """Read and check a case file.

    Files that it names are looked for relative to its folder, then to each folder above.

    Parameters
    ----------
    path : str or pathlib.Path
        The case file (YAML).
    results_exist : bool, optional
        Whether the files of a 3D run must exist even where the case does not say how they are made.

    Returns
    -------
    CaseFile
        All values in SI units, angles in radians.

    Raises
    ------
    CaseFileError
        Anything wrong with the file or with a file that it names: a line for each problem, with file,
        line, key, what was found and what is allowed.
    """
    path = Path(path)
    text = read_text(path)
    root = parse_yaml(text, path)
    require_kind(root, path, "case")
    problems = unknown_keys(root, FILE_KEYS)
    heading = check_section(_Heading, part_of(root, ("name", "title")), None, problems)
    overrides = overrides_of(root, problems)
    cases = _cases(root, overrides, Context(path.resolve().parent, tuple(overrides), results_exist), problems)
    problems += _tables_apart(cases, overrides)
    merged = {name: merge_variant(part_of(root, CASE_KEYS), overrides[name]) for name in cases}
    problems += uncertainty_problems(cases, merged)
    if problems or heading is None:
        raise CaseFileError.of_problems(path, problems)
    return CaseFile(path, text, heading.name, heading.title or heading.name, cases)


def _cases(
    root: Node, overrides: dict[str, Node], context: Context, problems: list[Problem]
) -> dict[str, Case]:
    """Return the checked cases by variant; add what is wrong to the problems."""
    base = part_of(root, CASE_KEYS)
    cases = {}
    found: dict[Problem, list[str]] = {}
    for name, override in overrides.items():
        merged = merge_variant(base, override)
        title = Node(name, root.line, "title") if "variants" in root.section else _title(root)
        wrong: list[Problem] = []
        case = check_section(
            Case, Node({"title": title, **merged.section}, root.line, root.key), context, wrong
        )
        if case is not None:
            cases[name] = case
        for problem in wrong:
            found.setdefault(problem, []).append(name)
    problems += [_of_variants(problem, names, len(overrides)) for problem, names in found.items()]
    return cases


def _tables_apart(cases: dict[str, Case], overrides: dict[str, Node]) -> list[Problem]:
    """Refuse overrides of the cells and times that one report tabulates for all variants."""
    problems = []
    for name, case in cases.items():
        compare = overrides[name].section.get("compare")
        for key in ("cells", "times"):
            stated = None if compare is None else compare.section.get(key)
            if stated is None:
                continue
            here = getattr(case.compare, key)
            apart = [other for other, each in cases.items() if getattr(each.compare, key) != here]
            if apart:
                message = f"other {key} than variant {apart[0]}; allowed: the same {key} in all variants"
                problems.append(Problem(stated.line, stated.key, message))
    return problems


def _of_variants(problem: Problem, names: list[str], count: int) -> Problem:
    """Name the variants in a problem that stands in the base but not in all variants."""
    if problem.key.startswith("variants.") or len(names) == count:
        return problem
    return replace(problem, message=f"{problem.message} (variant {choices(names)})")


def _title(root: Node) -> Node:
    """Return the title of a file's only case."""
    stated = root.section.get("title")
    return Node(ONLY_VARIANT, root.line, "title") if stated is None else stated


def part_of(root: Node, keys: tuple[str, ...]) -> Node:
    """Return a section with some of its keys."""
    return Node({key: node for key, node in root.section.items() if key in keys}, root.line, root.key)


def check_section(schema: type[S], node: Node, context: Context | None, problems: list[Problem]) -> S | None:
    """Return the checked section, or None and more problems."""
    try:
        return schema.model_validate(node.plain(), context=context)
    except ValidationError as error:
        problems += problems_of(error, schema, node)
        return None


def unknown_keys(root: Node, known: Collection[str]) -> list[Problem]:
    """Return a problem for each key of a file that it does not have."""
    return [
        Problem(node.line, node.key, unknown_key(key, known))
        for key, node in root.section.items()
        if key not in known
    ]


def overrides_of(root: Node, problems: list[Problem]) -> dict[str, Node]:
    """Return the overrides by variant; one that changes nothing where the file states no variants."""
    if "variants" not in root.section:
        return {ONLY_VARIANT: Node({}, root.line, root.key)}
    variants = root.section["variants"]
    if not isinstance(variants.value, dict) or not variants.value:
        message = f"{shown(variants.plain())}; allowed: a section for each variant, under its name"
        problems.append(Problem(variants.line, variants.key, message))
        return {}
    overrides = {}
    for name, node in variants.value.items():
        overrides[name] = Node({}, node.line, node.key) if node.value is None else node
        if re.fullmatch(NAME_PATTERN, name) is None:
            message = f"variant name {shown(name)}; allowed: {NAME_CHARACTERS}"
            problems.append(Problem(node.line, variants.key, message))
        if not isinstance(overrides[name].value, dict):
            message = f"{shown(node.plain())}; allowed: a section with the keys {choices(Case.model_fields)}"
            problems.append(Problem(node.line, node.key, message))
            del overrides[name]
    return overrides
