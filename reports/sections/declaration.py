"""The declaration of a section: key, title, what it needs, and what it says."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from reports.blocks import Block, Figure, Section, Subsection, Table
from reports.result.load import Comparison

Blocks = tuple[Block | Subsection, ...]
Need = Callable[[Comparison], bool]


@dataclass(frozen=True)
class Declared:
    """A section of any comparison.

    Attributes
    ----------
    key, title : str
        Anchor and heading.
    needs : tuple of Need
        Conditions, asked in this order before anything is composed; without one of them it is left out.
    blocks : callable
        What the section of a comparison says; nothing leaves it out.
    appendix : bool
        Whether it holds what is looked up, behind what is read.
    """

    key: str
    title: str
    needs: tuple[Need, ...]
    blocks: Callable[[Comparison], Blocks]
    appendix: bool = False

    def __call__(self, comparison: Comparison) -> Section | None:
        """Return the section, or None where it has nothing to say."""
        blocks = self.blocks(comparison) if all(met(comparison) for met in self.needs) else ()
        return Section(self.key, self.title, blocks, self.appendix) if blocks else None


def declared(
    key: str, title: str, *needs: Need, appendix: bool = False
) -> Callable[[Callable[[Comparison], Blocks]], Declared]:
    """Return the decorator that makes a section of the function that gives its blocks."""
    return partial(Declared, key, title, needs, appendix=appendix)


def of_each_model(blocks: Callable[[Comparison], Blocks]) -> Callable[[Comparison], Blocks]:
    """Return what says the same of each reduced model in turn, under its name where there are several."""

    def composed(comparison: Comparison) -> Blocks:
        if len(comparison.models) == 1:
            return blocks(comparison)
        found = []
        for model in comparison.models:
            said = [
                replace(block, key=f"{block.key}-{model}") if isinstance(block, Table | Figure) else block
                for part in blocks(comparison.of(model))
                for block in (part.blocks if isinstance(part, Subsection) else (part,))
            ]
            if said:
                found.append(
                    Subsection(
                        f"of-{blocks.__module__.rpartition('.')[2]}-{model}", f"2D model {model}", tuple(said)
                    )
                )
        return tuple(found)

    return composed


def instants() -> Need:
    """Need of an instant that the case names."""
    return lambda comparison: bool(comparison.times)


def result_file(name: str) -> Need:
    """Need of a file in the comparison's directory that not every comparison has."""
    return lambda comparison: (comparison.directory / name).is_file()
