"""A kind of reference of a solver that nobody has, registered from outside the package."""

from typing import Annotated, Literal

from cases.sections.references.base import MeshReference
from cases.sections.references.kinds import KINDS, RegisteredKind
from cases.values.kinds import one_of

Where = Literal["nodes", "cells"]


class TubeReference(MeshReference):
    kind: Annotated[Literal["tube"], one_of(Literal["tube"])]
    states: int
    cycles: int = 1
    approach: float | None = None
    values: Annotated[Where, one_of(Where)] = "nodes"


KINDS["tube"] = RegisteredKind(TubeReference, "made_up_reader")
