"""From the schema's findings to messages: where each one stands, and what is allowed there."""

from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import Tag, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from cases.errors import Problem, RefusedValueError
from cases.section import Section
from cases.values import ValueKind
from cases.variants import DISCRIMINATORS
from cases.wording import choices, not_one_of, shown, unknown_key
from cases.yaml_nodes import Node

Path = tuple[str | int, ...]


def problems_of(error: ValidationError, schema: type[Section], root: Node) -> list[Problem]:
    """Describe what the schema found, with the lines of the file.

    Parameters
    ----------
    error : pydantic.ValidationError
        What `schema` found in ``root.plain()``.
    schema : type
        The schema.
    root : Node
        The checked tree.

    Returns
    -------
    list of Problem
        In the order of the schema.
    """
    found = []
    for detail in error.errors(include_url=False):
        if detail["type"] != "default_factory_not_called":  # follows from another problem
            path, kind = _resolve(schema, detail["loc"])
            key, message = _describe(detail, path, kind)
            node = root.find(key)
            found.append(Problem(node.line, node.key or "the whole file", message))
    return found


def _describe(detail: ErrorDetails, path: Path, kind: object) -> tuple[Path, str]:
    """Return the path that a finding blames and its message; `kind` is what the schema wants there."""
    value = detail["input"]

    def discriminator() -> Path:
        return (*path, DISCRIMINATORS[str(path[-1])])

    match detail["type"]:
        case "value_error":
            error = detail["ctx"]["error"]
            return path + (error.key if isinstance(error, RefusedValueError) else ()), str(error)
        case "missing":
            return path, f"missing; allowed: {_allowed(kind)}"
        case "extra_forbidden":
            return path, unknown_key(str(path[-1]), _keys_beside(kind))
        case "union_tag_not_found" if isinstance(value, dict):
            return discriminator(), f"missing; allowed: {choices(_tags(kind))}"
        case "union_tag_invalid":
            return discriminator(), not_one_of(detail["ctx"]["tag"], _tags(kind))
        case "too_long" | "too_short":
            return path, f"{detail['ctx']['actual_length']} items; allowed: {_allowed(kind)}"
        case _:
            return path, f"{shown(value)}; allowed: {_allowed(kind)}"


def _resolve(schema: type[Section], location: Path) -> tuple[Path, object]:
    """Follow a location through the schema; the tags that the schema puts between the keys drop out.

    Returns the path in the file and the annotation there; for an unknown key, that of its section.
    """
    path: list[str | int] = []
    kind: Any = schema
    for part in location:
        kind = _bare(kind)
        if _is_section(kind):
            path.append(part)
            field = kind.model_fields.get(part)
            kind = kind if field is None else _annotation(field)
        elif get_origin(kind) is tuple:
            path.append(part)
            items = get_args(kind)
            kind = items[0] if items[-1] is ... else items[int(part)]
        else:
            kind = next(member for member in get_args(kind) if _tag(member) == part)
    return tuple(path), kind


def _annotation(field: FieldInfo) -> object:
    return Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation


def _bare(kind: Any) -> Any:
    """Strip `Annotated` and `| None` from an annotation."""
    if get_origin(kind) is Annotated:
        return _bare(get_args(kind)[0])
    members = [member for member in get_args(kind) if member is not type(None)]
    if get_origin(kind) in (Union, UnionType) and len(members) == 1:
        return _bare(members[0])
    return kind


def _is_section(kind: object) -> bool:
    return isinstance(kind, type) and issubclass(kind, Section)


def _tag(member: Any) -> str | None:
    return next((mark.tag for mark in getattr(member, "__metadata__", ()) if isinstance(mark, Tag)), None)


def _tags(kind: object) -> list[str]:
    return [str(_tag(member)) for member in get_args(_bare(kind))]


def _keys_beside(kind: Any) -> list[str]:
    return list(_bare(kind).model_fields)


def _allowed(kind: Any) -> str:
    """Say in words what an annotation allows."""
    for mark in getattr(kind, "__metadata__", ()):
        if isinstance(mark, ValueKind):
            return mark.allowed
    bare = _bare(kind)
    if _is_section(bare):
        return f"a section with the keys {choices(_keys_beside(bare))}"
    if get_origin(bare) is tuple:
        items = get_args(bare)
        size = "" if items[-1] is ... else f" of {len(items)}"
        return f"a list{size}, each item {_allowed(items[0])}"
    members = [member for member in get_args(bare) if member is not type(None)]
    if all(_is_section(_bare(member)) for member in members):
        shared = set.intersection(*(set(_keys_beside(member)) for member in members))
        return f"a section with the key {choices(shared)} ({choices(_tags(bare))})"
    return ", or ".join(_allowed(member) for member in members)
