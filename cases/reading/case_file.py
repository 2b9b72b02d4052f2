"""Loading a case file: YAML → base and variants → checked cases in SI units."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from cases.errors import CaseError, CaseFileError, Problem
from cases.reading.file_kinds import require_kind
from cases.reading.models import ModelVariant, cells_apart, models_of
from cases.reading.problems import problems_of
from cases.reading.uncertain_numbers import uncertainty_problems
from cases.reading.variants import merge_variant, overrides_of
from cases.reading.yaml_nodes import Node, parse_yaml, read_with_checksum
from cases.sections.base import Section
from cases.sections.case import Case
from cases.values.kinds import Context, Name, Words
from cases.values.wording import choices, unknown_key

ONLY_VARIANT = "base"
S = TypeVar("S", bound=Section)


@dataclass(frozen=True)
class CaseFile:
    """A checked case file.

    Attributes
    ----------
    path : pathlib.Path
        The file, as it was given.
    text, sha256 : str
        Its text, and the checksum of its bytes when it was read.
    name, title : str
        Its name (up to 64 letters, digits, - and _) and its title; the title is the name where none is
        stated.
    models : dict of str to dict of str to Case
        The cases by model and variant, in the file's order; one model named "rom" where the file states none,
        one variant named "base" where it states none.
    """

    path: Path
    text: str
    sha256: str
    name: str
    title: str
    models: dict[str, dict[str, Case]]

    @property
    def variants(self) -> dict[str, Case]:
        """The cases of the first model."""
        return next(iter(self.models.values()))

    @property
    def input_files(self) -> tuple[Path, ...]:
        """Files that the cases of all models and variants were read from, each once."""
        cases = (case for variants in self.models.values() for case in variants.values())
        return tuple(dict.fromkeys(path for case in cases for path in case.input_files))

    def model(self, name: str | None) -> dict[str, Case]:
        """Return the cases of a model, without a name those of the first.

        Raises
        ------
        CaseError
            The file has no such model.
        """
        if name is None:
            return self.variants
        if name not in self.models:
            raise CaseError(f"{self.path}: has no model {name!r}; allowed: {', '.join(self.models)}")
        return self.models[name]


class _Heading(Section):
    """What a file states about itself."""

    name: Name
    title: Words | None = None


CASE_KEYS = tuple(key for key in Case.model_fields if key != "title")
FILE_KEYS = ("name", "title", *CASE_KEYS, "models", "variants")


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
    text, sha256 = read_with_checksum(path)
    root = parse_yaml(text, path)
    require_kind(root, path, "case")
    problems = unknown_keys(root, FILE_KEYS)
    heading = check_section(_Heading, part_of(root, ("name", "title")), None, problems)
    variants, models = variants_of(root, problems), models_of(root, problems)
    context = Context(path.resolve().parent, tuple(variants), results_exist)
    stated = {
        (model, variant): node
        for model, override in models.items()
        for variant, node in merged(root, variants, override).items()
    }
    cases = _cases(root, stated, context, problems)
    problems += [*_tables_apart(cases, variants), *cells_apart(cases, stated)]
    if problems or heading is None:
        raise CaseFileError.of_problems(path, problems)
    by_model = {model: {variant: cases[model, variant] for variant in variants} for model in models}
    return CaseFile(path, text, sha256, heading.name, heading.title or heading.name, by_model)


def merged(root: Node, variants: dict[str, Node], model: Node) -> dict[str, Node]:
    """Return what is stated of each variant of a model: the base, the variant's keys, then the model's."""
    base = part_of(root, CASE_KEYS)
    return {name: merge_variant(merge_variant(base, stated), model) for name, stated in variants.items()}


def _cases(
    root: Node, stated: dict[ModelVariant, Node], context: Context, problems: list[Problem]
) -> dict[ModelVariant, Case]:
    """Return the checked cases by model and variant; add what is wrong to the problems."""
    cases = {}
    found: dict[Problem, list[ModelVariant]] = {}
    for place, node in stated.items():
        title = Node(place[1], root.line, "title") if "variants" in root.section else _title(root)
        wrong: list[Problem] = []
        case = check_section(
            Case, Node({"title": title, **node.section}, root.line, root.key), context, wrong
        )
        if case is not None:
            cases[place] = case
        for problem in wrong:
            found.setdefault(problem, []).append(place)
    problems += [_of_some(problem, places, stated) for problem, places in found.items()]
    problems += uncertainty_problems(cases, stated)
    return cases


def _tables_apart(cases: dict[ModelVariant, Case], overrides: dict[str, Node]) -> list[Problem]:
    """Refuse overrides of the cells and times that one report tabulates for all variants."""
    problems = []
    for (model, name), case in cases.items():
        compare = overrides[name].section.get("compare")
        for key in ("cells", "times"):
            stated = None if compare is None else compare.section.get(key)
            if stated is None:
                continue
            here = getattr(case.compare, key)
            apart = [
                other
                for (of, other), each in cases.items()
                if of == model and getattr(each.compare, key) != here
            ]
            if apart:
                message = f"other {key} than variant {apart[0]}; allowed: the same {key} in all variants"
                problems.append(Problem(stated.line, stated.key, message))
    return problems


def _of_some(problem: Problem, places: list[ModelVariant], all_places: Iterable[ModelVariant]) -> Problem:
    """Name the variants and models in a problem that does not stand in one and is not of all of them."""
    words = []
    for number, word in ((1, "variant"), (0, "model")):
        names, all_names = (dict.fromkeys(each[number] for each in part) for part in (places, all_places))
        if len(names) < len(all_names) and not problem.key.startswith(f"{word}s."):
            words.append(f"{word} {choices(names)}")
    return replace(problem, message=f"{problem.message} ({', '.join(words)})") if words else problem


def _title(root: Node) -> Node:
    """Return the title of a file's only case."""
    stated = root.section.get("title")
    return Node(ONLY_VARIANT, root.line, "title") if stated is None else stated


def part_of(root: Node, keys: tuple[str, ...]) -> Node:
    """Return a section with some of its keys."""
    return Node({key: node for key, node in root.section.items() if key in keys}, root.line, root.key)


def check_section(
    schema: type[S],
    node: Node,
    context: Context | None,
    problems: list[Problem],
    known: Mapping[str, object] | None = None,
) -> S | None:
    """Return the checked section, or None and more problems; ``known`` are checked values of some keys."""
    stated = node.plain()
    if known and isinstance(stated, dict):
        stated |= known
    try:
        return schema.model_validate(stated, context=context)
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


def variants_of(root: Node, problems: list[Problem]) -> dict[str, Node]:
    """Return the overrides by variant; one that changes nothing where the file states no variants."""
    return overrides_of(root, "variants", ONLY_VARIANT, tuple(Case.model_fields), problems)
