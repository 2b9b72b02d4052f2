"""Which quantities a comparison tells of, and how: read off the table of fields whenever it is asked."""

from collections.abc import Iterator

from cases.fields import FIELDS, Compared


def compared_quantities() -> tuple[str, ...]:
    """Names of all quantities that bands may judge."""
    return tuple(name for name, _ in _compared())


def _compared() -> Iterator[tuple[str, Compared]]:
    return ((name, field.compared) for name, field in FIELDS.items() if field.compared)


def tabulated() -> tuple[str, ...]:
    """Names of the quantities whose values at cells and instants have rows."""
    return tuple(name for name, how in _compared() if FIELDS[name].dims and how.tabulated)


def pooled() -> tuple[str, ...]:
    """Names of the quantities whose errors over cells and states have rows."""
    return tuple(name for name, how in _compared() if FIELDS[name].dims and how.pooled)


def of_cycle() -> tuple[str, ...]:
    """Names of the numbers of the cycle that are compared."""
    return tuple(name for name, _ in _compared() if not FIELDS[name].dims)


def stored() -> tuple[str, ...]:
    """Names of the compared fields that both models hold themselves, as comparison.nc does."""
    return tuple(name for name, how in _compared() if not how.reads)


def statistics_of(name: str) -> tuple[str, ...]:
    """Names of the statistics that are pooled of a quantity, and that bands may limit."""
    compared = FIELDS[name].compared
    return compared.statistics if compared else ()


def reads(name: str) -> tuple[str, ...]:
    """Names of the fields that a compared quantity is computed from; its own where it is one itself."""
    compared = FIELDS[name].compared
    return compared.reads if compared and compared.reads else (name,)
