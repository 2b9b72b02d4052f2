"""The dictionary of a plot file: which variables its states hold, and how."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Literal

from febio_io.xplt.container import Chunk, Source, children, required
from febio_io.xplt.tags import Tag

SectionName = Literal["global", "node", "domain", "surface", "edge", "object"]

SECTIONS: dict[int, SectionName] = {
    Tag.DIC_GLOBAL: "global",
    Tag.DIC_NODE: "node",
    Tag.DIC_DOMAIN: "domain",
    Tag.DIC_SURFACE: "surface",
    Tag.DIC_EDGE: "edge",
}
STORAGES = {0: "node", 1: "item", 2: "mult", 3: "region"}

_SYMMETRIC = ("xx", "yy", "zz", "xy", "yz", "xz")
# The upper triangle of the 6 × 6 Voigt matrix, column by column.
_FOURTH_ORDER = tuple(
    f"{_SYMMETRIC[row]}{_SYMMETRIC[column]}" for column in range(6) for row in range(column + 1)
)
FIXED_TYPES = {
    0: ("float", ("value",)),
    1: ("vec3f", ("x", "y", "z")),
    2: ("mat3fs", _SYMMETRIC),
    3: ("mat3fd", ("xx", "yy", "zz")),
    4: ("tens4fs", _FOURTH_ORDER),
    5: ("mat3f", tuple(a + b for a, b in product("xyz", repeat=2))),
}
LARGEST_ARRAY = 65536  # far above any of FEBio's: its arrays have a member per solute, say
ARRAYS = {6: ("array", 1), 7: ("array_vec3f", 3)}
TYPE_NAMES = {code: name for code, (name, *_) in (FIXED_TYPES | ARRAYS).items()}
FIXED_COMPONENTS = dict(FIXED_TYPES.values())
ARRAY_FACTORS = dict(ARRAYS.values())


@dataclass(frozen=True)
class Variable:
    """One variable of a plot file.

    Attributes
    ----------
    section : {"global", "node", "domain", "surface", "edge", "object"}
        What its values belong to; "object" only in the variables of a mesh's objects.
    index : int
        Its 1-based place in its section's list; names may repeat, places do not.
    name : str
        Name, as in the FEBio model.
    value_type : str
        "float", "vec3f", "mat3fs", "mat3fd", "tens4fs", "mat3f", "array" or "array_vec3f"; "unknown (CODE)"
        for a type that is none of these, whose values cannot be read.
    storage : str
        One value for each "node" or "item" (element, face, line), one for each node of each item ("mult"),
        one for the "region"; "unknown (CODE)" else.
    unit : str or None
        FEBio's unit pattern, e.g. "P" or "L/t"; None where the file has none.
    array_size : int
        Members of an array; 0 for other types.
    array_names : tuple of str
        Names of an array's members, where the file has them.
    """

    section: SectionName
    index: int
    name: str
    value_type: str
    storage: str
    unit: str | None = None
    array_size: int = 0
    array_names: tuple[str, ...] = ()

    @property
    def is_scalar(self) -> bool:
        """Whether a value is one plain number."""
        return self.value_type == "float"

    @property
    def n_components(self) -> int | None:
        """Numbers in one value; None for an unknown type."""
        if self.value_type in ARRAY_FACTORS:
            return self.array_size * ARRAY_FACTORS[self.value_type]
        return len(FIXED_COMPONENTS[self.value_type]) if self.value_type in FIXED_COMPONENTS else None

    @property
    def components(self) -> tuple[str, ...]:
        """Names of a value's components; one, "value", for a scalar; none for an unknown type."""
        if self.value_type not in ARRAY_FACTORS:
            return FIXED_COMPONENTS.get(self.value_type, ())
        names = self.array_names
        if len(names) != self.array_size:
            names = tuple(str(number) for number in range(1, self.array_size + 1))
        if self.value_type == "array":
            return names
        return tuple(f"{name} {axis}" for name in names for axis in "xyz")


def read_dictionary(source: Source, dictionary: Chunk) -> tuple[Variable, ...]:
    """Read the dictionary.

    Returns
    -------
    tuple of Variable
        All variables: section by section, in the file's order.

    Raises
    ------
    FebioFormatError
        If an item lacks its name, type or format.
    """
    return tuple(_variables(source, dictionary))


def _variables(source: Source, dictionary: Chunk) -> Iterator[Variable]:
    for section in children(source, dictionary):
        if section.tag in SECTIONS:
            items = (item for item in children(source, section) if item.tag == Tag.DIC_ITEM)
            for index, item in enumerate(items, start=1):
                yield read_variable(source, item, SECTIONS[section.tag], index)


def read_variable(source: Source, item: Chunk, section: SectionName, index: int) -> Variable:
    """Read one item of the dictionary, or of an object's own list of variables.

    Raises
    ------
    FebioFormatError
        If it lacks its name, type or format.
    """
    parts: dict[int, Chunk] = {}
    array_names = []
    for part in children(source, item):
        if part.tag == Tag.ITEM_ARRAY_NAME:
            array_names.append(source.fixed_text(part))
        else:
            parts[part.tag] = part
    type_code = source.integer(required(source, item, parts, Tag.ITEM_TYPE))
    storage_code = source.integer(required(source, item, parts, Tag.ITEM_FORMAT))
    array_size = source.integer(parts[Tag.ITEM_ARRAY_SIZE]) if Tag.ITEM_ARRAY_SIZE in parts else 0
    if not 0 <= array_size <= LARGEST_ARRAY:
        raise source.error(f"an array of {array_size} values", item.start, Tag.ITEM_ARRAY_SIZE)
    # Old files have "name=alias".
    name = source.fixed_text(required(source, item, parts, Tag.ITEM_NAME)).rpartition("=")[2]
    unit = source.fixed_text(parts[Tag.ITEM_UNITS]) if Tag.ITEM_UNITS in parts else ""
    return Variable(
        section,
        index,
        name,
        value_type=TYPE_NAMES.get(type_code, f"unknown ({type_code})"),
        storage=STORAGES.get(storage_code, f"unknown ({storage_code})"),
        unit=unit or None,
        array_size=array_size,
        array_names=tuple(array_names),
    )
