"""Parts of a report, whatever it is rendered to."""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any, Literal

_FILTERED = ("variant", "quantity", "verdict")

Shade = Literal["within", "beyond", "far", "unjudged"]
ColumnKind = Literal["text", "prose", "number", "status", "code"]


@dataclass(frozen=True)
class Paragraph:
    """One paragraph; `lead` sets the sentence that a hurried reader must see."""

    text: str
    lead: bool = False


@dataclass(frozen=True)
class Bullets:
    """Short statements, one a line; `lead` sets those that a hurried reader must see."""

    items: tuple[str, ...]
    lead: bool = False


@dataclass(frozen=True)
class Warnings:
    """Statements that cast doubt on the report, set so that nobody overlooks them."""

    items: tuple[str, ...]


@dataclass(frozen=True)
class Listing:
    """Text that is shown as it is: a command, a case file; `attached` names it as a file of a PDF."""

    caption: str
    text: str
    attached: str = ""


@dataclass(frozen=True)
class Column:
    """A table's column; neighbours of the same `group` share a heading above their own."""

    title: str
    kind: ColumnKind = "text"
    group: str = ""

    @property
    def filters(self) -> bool:
        """Whether readers may want only the rows with one of this column's values."""
        return self.title in _FILTERED


def numbers(*titles: str, group: str = "") -> Iterator[Column]:
    """Neighbouring columns of numbers."""
    return (Column(title, "number", group) for title in titles)


def prose(*titles: str) -> Iterator[Column]:
    """Neighbouring columns of words that may take several lines."""
    return (Column(title, "prose") for title in titles)


@dataclass(frozen=True)
class Table:
    """Rows of text under captioned columns; a rule separates rows that differ in column `rule_by`.

    Cells (row, column), counted from 0, in `marked` are set apart from the others; `mark` says what they are.
    `shades` colour cells by how far an error is within or beyond its limit; their numbers say it too.
    """

    key: str
    caption: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    rule_by: int | None = None
    marked: frozenset[tuple[int, int]] = frozenset()
    mark: str = ""
    shades: Mapping[tuple[int, int], Shade] = field(default_factory=dict)

    def shade(self, row: int, column: int) -> str:
        """Shade of a cell, "" for none."""
        return self.shades.get((row, column), "")

    def marks(self, row: int, column: int) -> bool:
        """Whether a cell is set apart."""
        return (row, column) in self.marked

    def groups(self) -> tuple[tuple[str, int], ...]:
        """Headings above the columns' own, with how many columns each spans; empty if there are none."""
        spans = tuple((name, len(list(run))) for name, run in groupby(c.group for c in self.columns))
        return spans if any(name for name, _ in spans) else ()

    def rules(self) -> tuple[bool, ...]:
        """Whether a rule stands above each row."""
        if self.rule_by is None:
            return (False,) * len(self.rows)
        values = [row[self.rule_by] for row in self.rows]
        return tuple(k > 0 and values[k] != values[k - 1] for k in range(len(values)))


@dataclass(frozen=True)
class Figure:
    """A drawing with the words that stand for it and the numbers behind it.

    `drawing` returns its SVG, always the same; it can be pickled, so that another process may call it.
    """

    key: str
    caption: str
    alt: str
    drawing: Callable[[], str]
    csv: str


@dataclass(frozen=True)
class Interactive:
    """A picture that a page with scripts draws from its data; elsewhere the figures stand for it.

    Attributes
    ----------
    key, title : str
        Anchor and heading.
    picture : str
        Which of the page's scripts draws it.
    text : str
        What can be done with it.
    data : mapping
        JSON values by name that the script draws from beside those of the report.
    """

    key: str
    picture: str
    title: str
    text: str
    data: Mapping[str, Any] = field(default_factory=dict)


Block = Paragraph | Bullets | Warnings | Listing | Table | Figure | Interactive


@dataclass(frozen=True)
class Section:
    """A numbered section of the report; an `appendix` holds what is looked up."""

    key: str
    title: str
    blocks: tuple["Block | Subsection", ...]
    appendix: bool = False


@dataclass(frozen=True)
class Subsection:
    """A titled part of a section."""

    key: str
    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Report:
    """Everything a rendering needs.

    Attributes
    ----------
    title, subtitle : str
        Heading and the line under it.
    identity : str
        What the footer of every page says: case, commit, date.
    created : str
        ISO time of the comparison; the only clock a report knows.
    sections : tuple of Section
        In reading order.
    data : mapping
        JSON values by name that several interactive pictures are drawn from.
    """

    title: str
    subtitle: str
    identity: str
    created: str
    sections: tuple[Section, ...]
    data: Mapping[str, Any]

    def blocks(self) -> Iterator[Block]:
        """All blocks, in reading order."""
        for section in self.sections:
            for part in section.blocks:
                yield from part.blocks if isinstance(part, Subsection) else (part,)

    def figures(self) -> Iterator[Figure]:
        """All figures, in reading order."""
        return (block for block in self.blocks() if isinstance(block, Figure))

    def interactives(self) -> Iterator[Interactive]:
        """All interactive pictures, in reading order."""
        return (block for block in self.blocks() if isinstance(block, Interactive))

    def page_data(self) -> str:
        """JSON of all that the page's scripts read."""
        content = dict(self.data)
        for picture in self.interactives():
            content |= picture.data
        return json.dumps(content, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
