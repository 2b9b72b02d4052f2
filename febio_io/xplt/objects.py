"""Rigid bodies, connectors and springs: what the file says of them, and where they are in a state."""

from collections import Counter
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from cases.arrays import Floats, Singles
from febio_io.xplt.container import Chunk, Source, children, required
from febio_io.xplt.dictionary import Variable, read_variable
from febio_io.xplt.tags import Tag

ObjectKind = Literal["point", "line"]
KINDS: dict[int, ObjectKind] = {Tag.POINT_OBJECT: "point", Tag.LINE_OBJECT: "line"}


@dataclass(frozen=True, eq=False)
class ModelObject:
    """One object of the model, as it is at the start.

    Attributes
    ----------
    kind : {"point", "line"}
        "point" for rigid bodies and joints, "line" for springs and other connectors.
    object_id : int
        Number of the object among those of its kind.
    name : str
        Name; empty where the file has none.
    tag : int
        FEBio's number for what it is.
    position : (3,) float64 array
        Position.
    rotation : (4,) float64 array
        Orientation: a quaternion, x y z w.
    ends : (2, 3) float64 array or None
        Both ends of a line; None for a point.
    variables : tuple of Variable
        What the states hold of it, with distinct names.
    """

    kind: ObjectKind
    object_id: int
    name: str
    tag: int
    position: Floats
    rotation: Floats
    ends: Floats | None
    variables: tuple[Variable, ...]


@dataclass(frozen=True, eq=False)
class ObjectState:
    """One object in one state.

    Attributes
    ----------
    model_object : ModelObject
        The object.
    position, rotation, ends
        As those of the object, in this state.
    values : dict of str to float32 array
        Its values by the names of its variables: shape (), or (n_components,).
    """

    model_object: ModelObject
    position: Floats
    rotation: Floats
    ends: Floats | None
    values: dict[str, Singles]


def read_objects(source: Source, section: Chunk) -> tuple[ModelObject, ...]:
    """Read the objects of a mesh.

    Raises
    ------
    FebioFormatError
        If an object lacks its number or place, or has another's number.
    """
    found: dict[tuple[ObjectKind, int], ModelObject] = {}
    for chunk in children(source, section):
        if chunk.tag in KINDS:
            item = _read_object(source, chunk)
            key = (item.kind, item.object_id)
            if key in found:
                raise source.error_in(chunk, f"two {key[0]} objects have the number {key[1]}")
            found[key] = item
    return tuple(found.values())


def read_object_states(
    source: Source, section: Chunk, objects: tuple[ModelObject, ...]
) -> tuple[ObjectState, ...]:
    """Read where the objects are in a state, and their values.

    Raises
    ------
    FebioFormatError
        If an object is not the mesh's, or its values do not have the size of their type.
    """
    known = {(item.kind, item.object_id): item for item in objects}
    return tuple(
        _read_state(source, chunk, known) for chunk in children(source, section) if chunk.tag in KINDS
    )


def _read_object(source: Source, chunk: Chunk) -> ModelObject:
    parts, data = _split(source, chunk)
    position, rotation, ends = _place(source, chunk, parts)
    variables = [read_variable(source, item, "object", index) for index, item in enumerate(data, start=1)]
    return ModelObject(
        kind=KINDS[chunk.tag],
        object_id=source.integer(required(source, chunk, parts, Tag.OBJECT_ID)),
        name=source.counted_text(parts[Tag.OBJECT_NAME]) if Tag.OBJECT_NAME in parts else "",
        tag=source.integer(parts[Tag.OBJECT_TAG]) if Tag.OBJECT_TAG in parts else 0,
        position=position,
        rotation=rotation,
        ends=ends,
        variables=_distinct(variables),
    )


def _read_state(
    source: Source, chunk: Chunk, known: dict[tuple[ObjectKind, int], ModelObject]
) -> ObjectState:
    parts, data = _split(source, chunk)
    key = (KINDS[chunk.tag], source.integer(required(source, chunk, parts, Tag.OBJECT_ID)))
    if key not in known:
        raise source.error_in(chunk, f"the mesh has no {key[0]} object {key[1]}")
    item = known[key]
    values = {}
    for block in (block for branch in data for block in children(source, branch)):
        if not block.tag < len(item.variables):
            raise source.error_in(block, f"object {item.name!r} has no variable {block.tag}")
        variable = item.variables[block.tag]
        if variable.n_components is None or block.size != 4 * variable.n_components:
            raise source.error_in(
                block,
                f"{block.size} bytes for {variable.name!r} of object {item.name!r}, "
                f"which is of type {variable.value_type}",
            )
        numbers = source.array(block, "f4").astype(np.float32)
        values[variable.name] = numbers.reshape(()) if variable.is_scalar else numbers
    return ObjectState(item, *_place(source, chunk, parts), values)


def _split(source: Source, chunk: Chunk) -> tuple[dict[int, Chunk], list[Chunk]]:
    """Tell the branches of data, which repeat, from the other children."""
    parts: dict[int, Chunk] = {}
    data = []
    for child in children(source, chunk):
        if child.tag == Tag.OBJECT_DATA:
            data.append(child)
        else:
            parts[child.tag] = child
    return parts, data


def _place(source: Source, chunk: Chunk, parts: dict[int, Chunk]) -> tuple[Floats, Floats, Floats | None]:
    ends = None
    if KINDS[chunk.tag] == "line":
        ends = _numbers(source, required(source, chunk, parts, Tag.LINE_COORDS), 6).reshape(2, 3)
    position = _numbers(source, required(source, chunk, parts, Tag.OBJECT_POSITION), 3)
    rotation = _numbers(source, required(source, chunk, parts, Tag.OBJECT_ROTATION), 4)
    return position, rotation, ends


def _numbers(source: Source, chunk: Chunk, count: int) -> Floats:
    if chunk.size != 4 * count:
        raise source.error_in(chunk, f"{count} numbers expected, {chunk.size} bytes found")
    return source.array(chunk, "f4").astype(np.float64)


def _distinct(variables: list[Variable]) -> tuple[Variable, ...]:
    seen: Counter[str] = Counter()
    named = []
    for variable in variables:
        seen[variable.name] += 1
        count = seen[variable.name]
        named.append(replace(variable, name=f"{variable.name} ({count})") if count > 1 else variable)
    return tuple(named)
