"""The study file: which case is run, what is varied, how samples are chosen and what is kept of each."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field

from cases.errors import CaseFileError, Problem
from cases.reading.case_file import check_section, load_case_file, part_of, unknown_keys
from cases.reading.file_kinds import require_kind
from cases.reading.numeric_keys import NumericKey, numeric_keys
from cases.reading.template import Template, check, load_template
from cases.reading.yaml_nodes import Node, parse_yaml, read_text
from cases.sections.base import Section
from cases.sections.case import Case
from cases.values.kinds import (
    STEP_TOLERANCE,
    Context,
    ExistingFile,
    Name,
    StepTolerance,
    ValueKind,
    Words,
    distinct,
    one_of,
    refused,
    whole_number,
)
from cases.values.wording import but_allowed, choices, nearest, not_one_of, shown
from validation.sweep.design import Design, misfit
from validation.sweep.judging import Against, unfit_for_judging
from validation.sweep.outputs import Output, offered_outputs
from validation.sweep.parameter_keys import read_parameters
from validation.sweep.parameters import Parameter
from validation.sweep.spans import span_keys

MOST_IN_CHUNK = 10_000
STUDY_KEYS = (
    "name",
    "title",
    "base",
    "variant",
    "overrides",
    "parameters",
    "design",
    "against",
    "outputs",
    "error_tolerance",
    "chunk",
)


def _names(value: object, _context: Context | None) -> tuple[str, ...]:
    names = value if isinstance(value, list) else [value]
    if not all(isinstance(name, str) and name for name in names):
        raise refused(value, NAMES)
    return distinct(tuple(names))


NAMES = "a name, or a list of names"
Names = Annotated[tuple[str, ...], ValueKind(_names, NAMES, {"type": ["string", "array"]})]
Chunk = Annotated[
    int, whole_number(f"a whole number from 1 to {MOST_IN_CHUNK}", lambda n: 1 <= n <= MOST_IN_CHUNK)
]


class _Stated(Section):
    """What a study states besides overrides and parameters, whose keys are those of its case."""

    name: Name
    title: Words | None = None
    base: ExistingFile
    variant: Names | None = None
    design: Design = Field(default=Design(kind="grid"))
    against: Annotated[Against, one_of(Against)] = "none"
    outputs: Names | None = None
    error_tolerance: StepTolerance = STEP_TOLERANCE
    chunk: Chunk | None = None


@dataclass(frozen=True)
class Study:
    """A checked study.

    Attributes
    ----------
    path, text : pathlib.Path, str
        The file and what it says.
    name, title : str
        Its name, also of its result's folder, and its title.
    base : pathlib.Path
        The case file.
    templates, cases : dict of str to Template, of str to Case
        By variant: what samples are made of, and the case as it is with the study's overrides.
    parameters : tuple of Parameter
        What is varied.
    design : Design
        How samples are chosen.
    against : str
        What each sample is judged against: ``none``, ``coupled`` or ``reference``.
    outputs : tuple of Output
        What is kept of each sample.
    error_tolerance : float or None
        Relative error of each output by which the time step is chosen; None: the case's own step.
    chunk : int or None
        Samples computed in one task and kept in one file; None where the study leaves it open.
    """

    path: Path
    text: str
    name: str
    title: str
    base: Path
    templates: Mapping[str, Template]
    cases: Mapping[str, Case]
    parameters: tuple[Parameter, ...]
    design: Design
    against: Against
    outputs: tuple[Output, ...]
    error_tolerance: float | None
    chunk: int | None = None


def load_study(path: Path) -> Study:
    """Read and check a study.

    Raises
    ------
    CaseFileError
        Anything wrong with the study or with the case that it names: a line for each problem, with file,
        line, key, what was found and what is allowed.
    """
    text = read_text(path)
    root = parse_yaml(text, path)
    require_kind(root, path, "study")
    problems = unknown_keys(root, STUDY_KEYS)
    kept = part_of(root, tuple(_Stated.model_fields))
    stated = check_section(_Stated, _spelt_out(kept), Context(path.resolve().parent, ()), problems)
    if stated is None:
        raise CaseFileError.of_problems(path, problems)
    variants = _variants(stated, root, problems)
    templates, cases = _cases(stated.base, variants, root, problems)
    if not cases:
        raise CaseFileError.of_problems(path, problems)
    parameters = read_parameters(_section(root, "parameters"), _shared_keys(cases), problems)
    problems += _misfits(root, stated, parameters, cases, problems)
    outputs = _outputs(root, stated, cases, problems)
    if problems:
        raise CaseFileError.of_problems(path, problems)
    return Study(
        path, text, stated.name, stated.title or stated.name, stated.base, templates, cases, parameters,
        stated.design, stated.against, outputs, stated.error_tolerance, stated.chunk,
    )  # fmt: skip


def _section(root: Node, key: str) -> Node:
    return root.section.get(key, Node(None, root.line, key))


def _spelt_out(root: Node) -> Node:
    """Return a study with `design: grid` as the section that it stands for."""
    design = root.section.get("design")
    if design is None or not isinstance(design.value, str):
        return root
    kind = Node(design.value, design.line, f"{design.key}.kind")
    return Node(
        {**root.section, "design": Node({"kind": kind}, design.line, design.key)}, root.line, root.key
    )


def _variants(stated: _Stated, root: Node, problems: list[Problem]) -> tuple[str, ...]:
    """Return the variants to run; those of the case file that the study names, or its only one."""
    known, place = load_case_file(stated.base).variants, _section(root, "variant")
    if stated.variant is None:
        if len(known) > 1:
            problems.append(
                Problem(place.line, "variant", f"missing; allowed: {choices(known)}, or several of them")
            )
        return tuple(known)[:1]
    unknown = [name for name in stated.variant if name not in known]
    problems += [Problem(place.line, "variant", not_one_of(name, known)) for name in unknown]
    return tuple(name for name in stated.variant if name in known)


def _cases(
    base: Path, variants: tuple[str, ...], root: Node, problems: list[Problem]
) -> tuple[dict[str, Template], dict[str, Case]]:
    """Return templates and cases by variant, with the study's overrides."""
    overrides = root.section.get("overrides")
    if overrides is not None and not isinstance(overrides.value, dict):
        problems.append(
            Problem(overrides.line, overrides.key, f"{shown(overrides.plain())}; allowed: keys of the case")
        )
        overrides = None
    templates, cases = {}, {}
    for name in variants:
        templates[name] = load_template(base, name, overrides)
        case, wrong = check(templates[name])
        if case is not None:
            cases[name] = case
        problems += [_of_overrides(problem, overrides, base) for problem in wrong]
    return templates, cases


def _of_overrides(problem: Problem, overrides: Node | None, base: Path) -> Problem:
    """Blame the overrides for what is wrong with a case that is right without them."""
    if overrides is None or problem.key.startswith("overrides"):
        return problem
    message = f"{problem.message} (with {base.name}, line {problem.line})"
    return Problem(overrides.line, f"overrides: {problem.key}", message)


def _shared_keys(cases: Mapping[str, Case]) -> dict[str, NumericKey]:
    """Numbers that all cases have, by name."""
    each = [numeric_keys(case) | span_keys(case) for case in cases.values()]
    return {name: key for name, key in each[0].items() if all(name in other for other in each)}


def _misfits(
    root: Node,
    stated: _Stated,
    parameters: tuple[Parameter, ...],
    cases: Mapping[str, Case],
    found: list[Problem],
) -> list[Problem]:
    """Check that design, parameters and what samples are judged against go together."""
    design, against = _section(root, "design"), _section(root, "against")
    if found or not parameters:
        return []
    problems = []
    reason = misfit(stated.design, parameters)
    if reason:
        problems.append(Problem(design.line, "design", reason))
    for name, case in cases.items():
        reason = unfit_for_judging(stated.against, case, [parameter.name for parameter in parameters])
        if reason:
            problems.append(Problem(against.line, "against", f"{stated.against}: {reason} (variant {name})"))
    return problems


def _outputs(
    root: Node, stated: _Stated, cases: Mapping[str, Case], problems: list[Problem]
) -> tuple[Output, ...]:
    """Return the outputs that the study names, or all that there are."""
    offered = offered_outputs(cases, stated.against)
    if stated.outputs is None:
        return tuple(offered.values())
    place = _section(root, "outputs")
    for name in stated.outputs:
        if name not in offered:
            message = but_allowed(f"{shown(name)}{nearest(name, offered)}", choices(offered))
            problems.append(Problem(place.line, "outputs", message))
    return tuple(offered[name] for name in stated.outputs if name in offered)
