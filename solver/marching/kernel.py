"""What a stepper calls: one of the schemes' kernels."""

from collections.abc import Callable
from typing import Any, NamedTuple

from solver.schemes.layout import Shapes


class Kernel(NamedTuple):
    """A scheme's kernel, the parameters and the workspace that it is called with, and the fields it moves.

    ``fields`` makes what the kernel takes of parts of such ``shapes``; see :mod:`solver.schemes.layout`.
    """

    advance: Callable[..., tuple[int, int, int, int]]
    parameters: Any
    workspace: Any
    fields: Callable[..., Any]
    shapes: Shapes
