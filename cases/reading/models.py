"""Reduced models that a case file names: what each states otherwise, and what they have alike."""

from collections.abc import Collection, Mapping

from cases.errors import Problem
from cases.reading.variants import overrides_of
from cases.reading.yaml_nodes import Node
from cases.results.comparison_file import REFERENCE, ROM, variable
from cases.sections.case import Case
from cases.values.wording import shown, unknown_key

OF_A_MODEL = ("wall", "solver", "uncertainty")  # keys that models may state otherwise
ALIKE = ("n_x", "n_phi")  # the cells on which all are compared

ModelVariant = tuple[str, str]


def labelled(variant: str, model: str, models: Collection[str]) -> str:
    """Name a variant, or a case, with its model where there are several."""
    return variant if len(models) == 1 else f"{variant}, model {model}"


def models_of(root: Node, problems: list[Problem]) -> dict[str, Node]:
    """Return the overrides by reduced model; one that changes nothing where the file states no models.

    What a model may not state is left out, and a problem.
    """
    models = overrides_of(root, "models", ROM, OF_A_MODEL, problems)
    for name, override in models.items():
        problems += _name_problems(name, override, models)
        problems += [
            Problem(node.line, node.key, unknown_key(key, OF_A_MODEL))
            for key, node in override.section.items()
            if key not in OF_A_MODEL
        ]
    return {name: _allowed(override) for name, override in models.items()}


def _allowed(override: Node) -> Node:
    kept = {key: node for key, node in override.section.items() if key in OF_A_MODEL}
    return Node(kept, override.line, override.key)


def _name_problems(name: str, override: Node, models: Collection[str]) -> list[Problem]:
    """Refuse a name under which a field or a file would be another model's, or the reference's, too."""
    if name == REFERENCE:
        why = ", which is the 3D reference"
    else:
        taken = [each for each in (REFERENCE, *models) if name.startswith(variable(each, ""))]
        alike = [each for each in models if each.casefold() == name.casefold()]
        why = f", which begins as the fields of {taken[0]} do" if taken else ""
        if alike[0] != name:
            why = f", which differs from {alike[0]} in capitals only, as no file of some systems does"
    message = f"model name {shown(name)}{why}; allowed: another name"
    return [Problem(override.line, "models", message)] if why else []


def cells_apart(cases: Mapping[ModelVariant, Case], stated: Mapping[ModelVariant, Node]) -> list[Problem]:
    """Refuse models on other cells than those of the first.

    Parameters
    ----------
    cases, stated : mapping of (str, str) to Case, to Node
        By model and variant; those of the first model come first.
    """
    problems = []
    first = next((model for model, _ in stated), "")
    for (model, variant), case in cases.items():
        other = cases.get((first, variant), case).solver
        for key in ALIKE:
            here, there = getattr(case.solver, key), getattr(other, key)
            if here != there:
                node = stated[model, variant].find(("solver", key))
                message = f"{here}, but {there} in model {first}; allowed: the same {key} in all models"
                problems.append(Problem(node.line, node.key, message))
    return problems
