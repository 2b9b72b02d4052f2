"""What a user sees: progress on standard error if that is a terminal, tables on standard output."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import Progress, ProgressColumn


@contextmanager
def progress(*columns: str | ProgressColumn) -> Iterator[Progress]:
    """Progress of tasks, silent where standard error is no terminal; columns are rich's own by default."""
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as display:
        yield display


@contextmanager
def progress_bar(label: str) -> Iterator[Callable[[float, float], None]]:
    """Progress of one task under ``label``; yields a function of (done, total)."""
    with progress() as display:
        task = display.add_task(label, total=None)

        def update(done: float, total: float) -> None:
            display.update(task, completed=done, total=total)

        yield update


def page(width: int) -> Console:
    """Standard output for tables, ``width`` columns wide where it is no terminal."""
    return Console(width=None if sys.stdout.isatty() else width)
