"""Finds what a caller names: a variable, a state, a region; if it is not there, the error says what is."""

import operator
from collections.abc import Iterable, Mapping
from pathlib import Path

from febio_io.errors import FebioKeyError, nearest_first
from febio_io.xplt.dictionary import SectionName, Variable


def find_variables(
    path: Path, variables: tuple[Variable, ...], name: str | Variable, section: SectionName | None
) -> tuple[Variable, ...]:
    """Find the variables of one section and name.

    Raises
    ------
    FebioKeyError
        If there is none, or if variables of several sections have the name.
    """
    if isinstance(name, Variable):
        if name not in variables:
            raise FebioKeyError(f"{path}: {name} is not a variable of this file")
        return (name,)
    candidates = [variable for variable in variables if section in (None, variable.section)]
    named = tuple(variable for variable in candidates if variable.name == name)
    if not named:
        kind = f"{section} variable" if section else "variable"
        known = nearest_first(name, (variable.name for variable in candidates))
        raise FebioKeyError(f"{path}: no {kind} {name!r}; the file has {_listed(known)}")
    sections = dict.fromkeys(variable.section for variable in named)
    if len(sections) > 1:
        raise FebioKeyError(
            f"{path}: variables of several sections are named {name!r}; give one section: {_listed(sections)}"
        )
    return named


def find_state(path: Path, n_states: int, state: int) -> int:
    """Give the number of a state, from 0; negative numbers count from the end.

    Raises
    ------
    FebioKeyError
        If there is no such state.
    """
    number = operator.index(state)
    if not -n_states <= number < n_states:
        have = f"states 0 to {n_states - 1}" if n_states else "no states"
        raise FebioKeyError(f"{path}: no state {number}; the file has {have}")
    return number % n_states


def find_region(path: Path, what: str, names: Mapping[int, str], wanted: str | int | None) -> int:
    """Give the number of the one region that is meant.

    Parameters
    ----------
    path : Path
        The file, for messages.
    what : str
        The variable and state, for messages.
    names : mapping of int to str
        Numbers and names of the regions that have values.
    wanted : str, int or None
        Name or number; None for the only one.

    Raises
    ------
    FebioKeyError
        If no region, or more than one, is meant.
    """
    if wanted is None:
        matches = list(names)
    elif isinstance(wanted, str):
        matches = [number for number, name in names.items() if name == wanted]
    else:
        matches = [number for number in names if number == wanted]
    if len(matches) == 1:
        return matches[0]
    have = _listed_regions(names, wanted)
    if not names:
        problem = "has no values"
    elif wanted is None:
        problem = f"has values in several regions; give one: {have}"
    elif matches:
        problem = f"has values in {len(matches)} regions named {wanted!r}; give a number: {have}"
    else:
        problem = f"has no values in region {wanted!r}; it has some in {have}"
    raise FebioKeyError(f"{path}: {what} {problem}")


def _listed_regions(names: Mapping[int, str], wanted: str | int | None) -> str:
    order = list(names)
    if isinstance(wanted, str):
        likeness = nearest_first(wanted, names.values())
        order.sort(key=lambda number: likeness.index(names[number]))
    return ", ".join(f"{number} ({names[number]})" if names[number] else str(number) for number in order)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(repr(name) for name in names) or "none"
