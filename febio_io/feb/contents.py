"""What a model (.feb) has, and what its checks have found."""

from dataclasses import dataclass, field
from typing import NamedTuple

UNIQUE = ("3.0", "4.0")  # versions in which nothing may have another's name or number
MOST_KEPT = 100  # problems of one file


class Condition(NamedTuple):
    """A boundary condition, load, contact, constraint …: section, type, and the set or surface it is on."""

    section: str
    kind: str
    place: str


class Step(NamedTuple):
    """An analysis step: how many time steps it asks for, and the size of the first, s."""

    time_steps: int
    step_size: float


@dataclass
class Contents:
    """What a model has, by name or number, and what is wrong with it.

    Attributes
    ----------
    version : str
        Version of the format, e.g. "4.0".
    module, units : str
        The equations that it solves, and the system of units it states; empty where it states none.
    nodes, element_ids : set of int
        Numbers of its nodes and elements.
    elements : dict of str to int
        How many elements each list of elements has.
    element_types : dict of str to str
        The type of each list's elements.
    names : dict of str to set of str
        The names of what the mesh and other sections define, by tag: "NodeSet", "Surface" …
    materials : dict of str to str
        The type of each material.
    domains : dict of str to str
        The material of each domain.
    conditions : list of Condition
        Boundary conditions, loads, contacts, constraints …
    steps : list of Step
        The analysis steps.
    variables : list of str
        What its plot file is to hold.
    log, plot : str or None
        Names that the model gives to its log and plot file, against FEBio's rule; None if it does not.
    writes_plot : bool
        Whether it asks for a plot file (.xplt).
    elsewhere : bool
        Whether parts of it are in other files, or made by FEBio from templates, so that names may be missing.
    problems : list of str
        What is wrong with it, each with where.
    n_problems : int
        How many problems there are; the list holds the first.
    unchecked : dict of str to None
        What nothing is known about, each once.
    """

    version: str = ""
    module: str = ""
    units: str = ""
    nodes: set[int] = field(default_factory=set)
    element_ids: set[int] = field(default_factory=set)
    elements: dict[str, int] = field(default_factory=dict)
    element_types: dict[str, str] = field(default_factory=dict)
    names: dict[str, set[str]] = field(default_factory=dict)
    materials: dict[str, str] = field(default_factory=dict)
    domains: dict[str, str] = field(default_factory=dict)
    conditions: list[Condition] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    variables: list[str] = field(default_factory=list)
    log: str | None = None
    plot: str | None = None
    writes_plot: bool = True
    elsewhere: bool = False
    problems: list[str] = field(default_factory=list)
    n_problems: int = 0
    unchecked: dict[str, None] = field(default_factory=dict)

    @property
    def n_steps(self) -> int:
        """Time steps asked for, of all analysis steps."""
        return sum(step.time_steps for step in self.steps)

    @property
    def end(self) -> float:
        """Time at the end of the last step, s."""
        return sum(step.time_steps * step.step_size for step in self.steps)

    @property
    def surfaces(self) -> set[str]:
        """Names of its surfaces."""
        return self.names.get("Surface", set())

    def wrong(self, problem: str) -> None:
        """Note a problem."""
        self.n_problems += 1
        if len(self.problems) < MOST_KEPT:
            self.problems.append(problem)

    def skip(self, what: str) -> None:
        """Note what is not checked."""
        self.unchecked[what] = None

    def define(self, kind: str, name: str, where: str) -> None:
        """Take in a name; one that stands twice is a problem."""
        known = self.names.setdefault(kind, set())
        if name in known and self.version in UNIQUE:
            self.wrong(f"{where}: {name!r} stands twice")
        known.add(name)
