"""One variant of a case file as a tree in which numbers may be replaced before it is checked."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from cases.errors import CaseFileError, Problem
from cases.reading.case_file import check_section, merged, variants_of
from cases.reading.models import models_of
from cases.reading.variants import merge_variant
from cases.reading.yaml_nodes import Node, Scalar, parse_yaml, read_text
from cases.sections.case import Case
from cases.values.kinds import Context

Keys = tuple[str | int, ...]
# sections that a case's own checks hand on as they are
SETTLED = frozenset(Case.model_fields) - {"title", "solver", "compare"}


@dataclass(frozen=True)
class Template:
    """What is checked again for every change of some numbers.

    Attributes
    ----------
    root : Node
        The keys of a case, the variant merged into the base.
    context : Context
        Where its files are looked for.
    variant : str
        The variant's name.
    """

    root: Node
    context: Context
    variant: str


def load_template(
    path: Path,
    variant: str,
    overrides: Node | None = None,
    model: str | None = None,
    text: str | None = None,
) -> Template:
    """Read one variant of a case file that :func:`cases.reading.case_file.load_case_file` accepts.

    The cells and times that a report tabulates are left out.

    Parameters
    ----------
    path : pathlib.Path
        The case file.
    variant : str
        One of its variants.
    overrides : Node, optional
        Keys to be stated otherwise in addition; merged as a variant is.
    model : str, optional
        One of its models; the first where none is named.
    text : str, optional
        What the file held when it was read; read again where it is not given.

    Raises
    ------
    CaseFileError
        The file cannot be read.
    """
    root = parse_yaml(read_text(path) if text is None else text, path)
    variants, models = variants_of(root, []), models_of(root, [])
    stated = merged(root, variants, models[model or next(iter(models))])[variant]
    if overrides is not None:
        stated = merge_variant(stated, overrides)
    title = Node(variant, root.line, "title")
    context = Context(path.resolve().parent, tuple(variants))
    sections = {"title": title, **stated.section, **_untabulated(stated)}
    return Template(Node(sections, root.line, root.key), context, variant)


def _untabulated(root: Node) -> dict[str, Node]:
    """Return what is compared without the cells and times of a report, which need not fit other grids."""
    compare = root.section.get("compare")
    if compare is None or not isinstance(compare.value, dict):
        return {}
    kept = {key: node for key, node in compare.section.items() if key not in ("cells", "times")}
    return {"compare": Node(kept, compare.line, compare.key)}


def check(
    template: Template, values: Mapping[Keys, Scalar] | None = None, unchanged: Case | None = None
) -> tuple[Case | None, list[Problem]]:
    """Check a template with some values replaced.

    Parameters
    ----------
    template : Template
    values : mapping of path to scalar, optional
        By the keys that lead to each, items counted from 0: what the case file would state there.
    unchanged : Case, optional
        The template's own case: sections of `SETTLED` without such values are taken from there, and only
        whether they go with the others is checked again.

    Returns
    -------
    Case or None
        The case; None where there are problems.
    list of Problem
        What is wrong.
    """
    root, changes, problems = template.root, values or {}, list[Problem]()
    for path, value in changes.items():
        root = _replaced(root, path, value)
    known = {}
    if unchanged is not None:
        kept = SETTLED.intersection(root.section).difference(path[0] for path in changes)
        known = {key: getattr(unchanged, key) for key in kept}
    return check_section(Case, root, template.context, problems, known), problems


def case_with(template: Template, values: Mapping[Keys, Scalar], unchanged: Case | None = None) -> Case:
    """Return the case that a template becomes with some values replaced, see :func:`check`.

    Raises
    ------
    CaseFileError
        The values are not allowed; a line for each problem with key, what was found and what is allowed.
    """
    case, problems = check(template, values, unchanged)
    if case is None:
        own = f"variants.{template.variant}."
        lines = dict.fromkeys(f"{p.key.removeprefix(own)}: {p.message}" for p in problems)
        raise CaseFileError(template.context.folder, "\n".join(lines), tuple(problems))
    return case


def _replaced(node: Node, path: Keys, value: Scalar) -> Node:
    """Return a node with the value at a path replaced; sections that lack the key gain it."""
    if not path:
        return Node(value, node.line, node.key)
    below = _replaced(node.find(path[:1]), path[1:], value)
    if isinstance(node.value, list):
        items = [below if number == path[0] else item for number, item in enumerate(node.value)]
        return Node(items, node.line, node.key)
    return Node({**node.section, str(path[0]): below}, node.line, node.key)
