"""The base of every section of a case file, and unions of sections that one word tells apart."""

from collections.abc import Mapping
from functools import reduce
from operator import or_
from types import UnionType
from typing import Annotated, Any, TypeGuard, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Discriminator, Tag
from pydantic.fields import FieldInfo

SAME = 1e-9  # relative difference of sums and periods that are meant to be equal


class Section(BaseModel):
    """A frozen section that refuses unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)


def told_apart_by(key: str) -> Discriminator:
    """Return the discriminator of a union: the word that a section states under a key."""

    def word(value: object) -> str | None:
        stated = value.get(key) if isinstance(value, dict) else getattr(value, key, None)
        return stated if isinstance(stated, str) else None

    return Discriminator(word)


def bare(kind: Any) -> Any:
    """Strip `Annotated` and `| None` from an annotation."""
    if get_origin(kind) is Annotated:
        return bare(get_args(kind)[0])
    members = [member for member in get_args(kind) if member is not type(None)]
    if get_origin(kind) in (Union, UnionType) and len(members) == 1:
        return bare(members[0])
    return kind


def annotation_of(field: FieldInfo) -> Any:
    """Return the whole annotation of a section's key."""
    return Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation


def is_section(kind: object) -> TypeGuard[type[Section]]:
    """Tell whether an annotation is a section's class."""
    return isinstance(kind, type) and issubclass(kind, Section)


def union_by_tag(members: Mapping[str, type[Section]]) -> Any:
    """Return the union of sections that :func:`told_apart_by` tells apart by these words."""
    return reduce(or_, (Annotated[member, Tag(word)] for word, member in members.items()))


def members_by_tag(union: Any) -> dict[str, Any]:
    """Return the members of a union by their tags; empty for anything else."""
    return {
        mark.tag: member
        for member in get_args(bare(union))
        for mark in getattr(member, "__metadata__", ())
        if isinstance(mark, Tag)
    }


def keys_by_tag(union: Any) -> dict[str, list[str]]:
    """Return the keys of each section of a union by its tag."""
    sections = {tag: bare(member) for tag, member in members_by_tag(union).items()}
    return {tag: list(kind.model_fields) for tag, kind in sections.items() if is_section(kind)}
