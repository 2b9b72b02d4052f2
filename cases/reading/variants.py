"""Named overrides of one base, of variants and of models, merged key by key."""

import re
from collections.abc import Mapping
from types import MappingProxyType

from cases.errors import Problem
from cases.reading.yaml_nodes import Node
from cases.sections.base import keys_by_tag
from cases.sections.solver import Solver
from cases.sections.wall import Wall
from cases.values.kinds import NAME_CHARACTERS, NAME_PATTERN
from cases.values.wording import choices, shown

# what a section is; stating another one replaces the section, since the old keys do not fit the new kind
DISCRIMINATORS = MappingProxyType(
    {
        "wall": "law",
        "calcification": "pattern",
        "patches": "pattern",
        "inlet": "kind",
        "outlet": "kind",
        "solver": "scheme",
        "reference": "kind",
    }
)
# sections whose kinds share most keys; stating another kind drops only the keys that it does not have
KEYS_OF_KINDS = MappingProxyType({"wall": keys_by_tag(Wall), "solver": keys_by_tag(Solver)})
Keys = Mapping[str, list[str]]
NO_DISCRIMINATORS: Mapping[str, str] = MappingProxyType({})


def overrides_of(
    root: Node, part: str, only: str, keys: tuple[str, ...], problems: list[Problem]
) -> dict[str, Node]:
    """Return the named overrides in a part of a case file.

    Parameters
    ----------
    root : Node
        The file.
    part : str
        ``variants`` or ``models``.
    only : str
        Name of the one that changes nothing where the file has no such part.
    keys : tuple of str
        What each may state, for messages.
    problems : list of Problem
        Gains what is wrong with the names, and what is no section.

    Returns
    -------
    dict of str to Node
        Sections by name, in the file's order; an empty one where nothing is stated.
    """
    if part not in root.section:
        return {only: Node({}, root.line, root.key)}
    stated = root.section[part]
    word = part.removesuffix("s")
    if not stated.section:
        message = f"{shown(stated.plain())}; allowed: a section for each {word}, under its name"
        problems.append(Problem(stated.line, stated.key, message))
        return {}
    overrides = {}
    for name, node in stated.section.items():
        if re.fullmatch(NAME_PATTERN, name) is None:
            message = f"{word} name {shown(name)}; allowed: {NAME_CHARACTERS}"
            problems.append(Problem(node.line, stated.key, message))
        if node.value is None or isinstance(node.value, dict):
            overrides[name] = Node(node.section, node.line, node.key)
        else:
            message = f"{shown(node.plain())}; allowed: a section with the keys {choices(keys)}"
            problems.append(Problem(node.line, node.key, message))
    return overrides


def merge_variant(base: Node, override: Node) -> Node:
    """Merge the override of one variant into the base.

    Sections merge key by key, anything else is replaced, lists included. A section whose override states
    another discriminator (`calcification.pattern`, `inlet.kind`, …) is replaced whole, but of `wall` and
    `solver` the keys stay that the new `law` or `scheme` has too.

    Parameters
    ----------
    base, override : Node
        Sections of the case file; values keep the lines where they stand.

    Returns
    -------
    Node
        The merged section, at the place of the base.
    """
    return Node(_merge(base, override, DISCRIMINATORS).value, base.line, base.key)


def _merge(base: Node, override: Node, discriminators: Mapping[str, str]) -> Node:
    if not isinstance(base.value, dict) or not isinstance(override.value, dict):
        return override
    merged = dict(base.value)
    for key, node in override.value.items():
        present = merged.get(key)
        if present is None:
            merged[key] = node
        elif _is_another(present, node, discriminators.get(key)):
            kept = _kept(present, node, discriminators[key], KEYS_OF_KINDS.get(key))
            merged[key] = _merge(kept, node, NO_DISCRIMINATORS)
        else:
            merged[key] = _merge(present, node, NO_DISCRIMINATORS)
    return Node(merged, override.line, override.key)


def _is_another(present: Node, stated: Node, discriminator: str | None) -> bool:
    """Tell whether a section states another discriminator than the one it overrides."""
    if discriminator is None or not isinstance(present.value, dict) or not isinstance(stated.value, dict):
        return False
    old, new = present.value.get(discriminator), stated.value.get(discriminator)
    return new is not None and (old is None or old.value != new.value)


def _kept(present: Node, stated: Node, discriminator: str, keys: Keys | None) -> Node:
    """Return what stays of a section of which another kind is stated; misspelt keys do, to be refused."""
    if keys is None:
        return Node({}, present.line, present.key)
    old, new = present.section.get(discriminator), stated.section[discriminator]
    dropped = set() if old is None else set(keys.get(str(old.value), ()))
    dropped -= set(keys.get(str(new.value), ()))
    kept = {key: node for key, node in present.section.items() if key not in dropped}
    return Node(kept, present.line, present.key)
