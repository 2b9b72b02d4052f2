"""Ctrl-C where it must not cut in at once: in code of others that breaks, or loses it, when it does."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from types import FrameType

INTERRUPTED = 130  # exit status


@contextmanager
def interrupts_told_to(tell: Callable[[], None]) -> Iterator[None]:
    """Call a function for each Ctrl-C in a block, instead of raising KeyboardInterrupt there.

    Outside the main thread, which alone gets them, the block runs as it is.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def handle(_number: int, _frame: FrameType | None) -> None:
        tell()

    before = signal.signal(signal.SIGINT, handle)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """Hold a Ctrl-C back until the block has ended.

    For imports of compiled modules. Those of VTK import each other: one that is interrupted leaves the others
    without it, which ends in an ImportError or in a segmentation fault. NumPy's take an interrupt for a
    broken installation.
    """
    count = 0

    def note() -> None:
        nonlocal count
        count += 1

    with interrupts_told_to(note):
        yield
    if count:
        signal.raise_signal(signal.SIGINT)


def run_command(module: str) -> int:
    """Import a command's module and run its ``main``; exit status.

    A Ctrl-C ends it quietly, even one that comes while it is still being imported.
    """
    try:
        with interrupts_deferred():
            command = import_module(module)
        return int(command.main())
    except KeyboardInterrupt:
        return INTERRUPTED
