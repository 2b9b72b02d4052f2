"""From the schema's findings to messages: where each one stands, and what is allowed there."""

from dataclasses import dataclass
from typing import Any, get_args, get_origin

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from cases.errors import Problem, RefusedValueError
from cases.reading.variants import DISCRIMINATORS
from cases.reading.yaml_nodes import Node
from cases.sections.base import Section, annotation_of, bare, is_section, keys_by_tag, members_by_tag
from cases.values.kinds import ValueKind
from cases.values.wording import choices, not_one_of, shown, unknown_key

Path = tuple[str | int, ...]


def problems_of(error: ValidationError, schema: type[Section], root: Node) -> list[Problem]:
    """Describe what the schema found, with the lines of the file.

    Returns
    -------
    list of Problem
        In the order of the schema.
    """
    found = []
    for detail in error.errors(include_url=False):
        if detail["type"] != "default_factory_not_called":  # follows from another problem
            key, message = _describe(detail, _resolve(schema, detail["loc"]))
            node = root.find(key)
            found.append(Problem(node.line, node.key or "the whole file", message))
    return found


@dataclass(frozen=True)
class _Place:
    """Where a finding stands.

    Attributes
    ----------
    path : tuple of str or int
        Its keys in the file.
    kind : object
        What the schema wants there; for an unknown key, the section that lacks it.
    section : tuple of str or int, union : object
        The innermost section that is one of several kinds, and their union; None where none is.
    """

    path: Path
    kind: object
    section: Path = ()
    union: object = None


def _describe(detail: ErrorDetails, place: _Place) -> tuple[Path, str]:
    """Return the path that a finding blames and its message."""
    value, path, kind = detail["input"], place.path, place.kind
    match detail["type"]:
        case "value_error":
            error = detail["ctx"]["error"]
            return path + (error.key if isinstance(error, RefusedValueError) else ()), str(error)
        case "missing":
            return path, f"missing; allowed: {_allowed(kind)}"
        case "extra_forbidden":
            return path, _unknown_key(place)
        case "union_tag_not_found" | "union_tag_invalid" if isinstance(value, dict):
            key, tags = _discriminator(path), list(members_by_tag(kind))
            stated = not_one_of(value[key], tags) if key in value else f"missing; allowed: {choices(tags)}"
            return (*path, key), stated
        case "too_long" | "too_short":
            return path, f"{detail['ctx']['actual_length']} items; allowed: {_allowed(kind)}"
        case _:
            return path, f"{shown(value)}; allowed: {_allowed(kind)}"


def _discriminator(path: Path) -> str:
    """Key that says of what kind the section at a path is; those of a list are of one union."""
    return DISCRIMINATORS[next(part for part in reversed(path) if isinstance(part, str))]


def _unknown_key(place: _Place) -> str:
    """Describe a key that a section does not have, though another kind of the section may have it."""
    key, keys = str(place.path[-1]), _keys_beside(place.kind)
    owners = []
    if place.section == place.path[:-1]:
        owners = [tag for tag, known in keys_by_tag(place.union).items() if key in known]
    if not owners:
        return unknown_key(key, keys)
    return f"only with {_discriminator(place.section)} {', '.join(owners)}; allowed: {choices(keys)}"


def _resolve(schema: type[Section], location: Path) -> _Place:
    """Follow a location through the schema; the tags that the schema puts between the keys drop out."""
    path: Path = ()
    section: Path = ()
    kind: Any = schema
    union: Any = None
    for part in location:
        kind = bare(kind)
        if is_section(kind):
            path += (part,)
            field = kind.model_fields.get(str(part))
            kind = kind if field is None else annotation_of(field)
        elif get_origin(kind) is tuple:
            path += (part,)
            items = get_args(kind)
            kind = items[0] if items[-1] is ... else items[int(part)]
        else:
            section, union = path, kind
            kind = members_by_tag(kind)[str(part)]
    return _Place(path, kind, section, union)


def _keys_beside(kind: Any) -> list[str]:
    return list(bare(kind).model_fields)


def _allowed(kind: Any) -> str:
    """Say in words what an annotation allows."""
    for mark in getattr(kind, "__metadata__", ()):
        if isinstance(mark, ValueKind):
            return mark.allowed
    bare_kind = bare(kind)
    if is_section(bare_kind):
        return f"a section with the keys {choices(_keys_beside(bare_kind))}"
    if get_origin(bare_kind) is tuple:
        items = get_args(bare_kind)
        size = "" if items[-1] is ... else f" of {len(items)}"
        return f"a list{size}, each item {_allowed(items[0])}"
    tags = members_by_tag(bare_kind)
    if tags and all(is_section(bare(member)) for member in tags.values()):
        key = _keys_beside(next(iter(tags.values())))[0]  # each kind of a section states first which it is
        return f"a section with the key {key} ({choices(tags)})"
    members = [member for member in get_args(bare_kind) if member is not type(None)]
    return ", or ".join(_allowed(member) for member in members)
