"""Ctrl-C and SIGTERM where they must not cut in at once: in code of others that breaks, or loses them."""

import gc
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

INTERRUPTS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def interrupts_told_to(tell: Callable[[signal.Signals], None]) -> Iterator[None]:
    """Call a function for each Ctrl-C or SIGTERM in a block, in place of what else would handle it there.

    One that is ignored, or ends the process at once, is left so. Outside the main thread, which alone gets
    them, the block runs as it is.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def handle(number: int, _frame: FrameType | None) -> None:
        tell(signal.Signals(number))

    before = {number: signal.getsignal(number) for number in INTERRUPTS}
    handled = {number: handler for number, handler in before.items() if callable(handler)}
    for number in handled:
        signal.signal(number, handle)
    try:
        yield
    finally:
        for number, handler in handled.items():
            signal.signal(number, handler)


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """Hold a Ctrl-C or SIGTERM back until the block has ended."""
    caught: list[signal.Signals] = []
    with interrupts_told_to(caught.append):
        yield
    if caught:
        signal.raise_signal(caught[0])


@contextmanager
def imports() -> Iterator[None]:
    """Imports in a block: interrupts are held back, and nothing that they make is looked through for garbage.

    Modules of VTK import each other: one that is interrupted leaves the others without it, which ends in an
    ImportError or in a segmentation fault; NumPy's take an interrupt for a broken installation. And what
    modules are made of stays: to look for garbage in it was a sixth of the time of a start.
    """
    gc.disable()
    try:
        with interrupts_deferred():
            yield
    finally:
        gc.freeze()
        gc.enable()
