"""How every command starts and ends: exit status, interrupts, a closed pipe, one message for an error."""

import os
import signal
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import NoReturn

from cases.shell.errors import InputError
from cases.shell.interrupts import imports

# exit status; BAND_BROKEN is also that of a run that failed and of a pipe that its reader has closed
COMPLETE, BAND_BROKEN, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


def run(module: str, program: str | None = None, arguments: Sequence[str] | None = None) -> int:
    """Exit status of a command: its module is imported and its ``main`` run.

    Parameters
    ----------
    module : str
        The command's module, ``<package>.command``; its ``main`` takes the arguments.
    program : str, optional
        What the user called, for the usage; default: ``python -m <package>``.
    arguments : sequence of str, optional
        Default: those of the process.

    Notes
    -----
    SIGTERM is as Ctrl-C. One that comes while modules are imported ends the command without a word.
    """
    arguments = sys.argv[1:] if arguments is None else arguments
    sys.argv = [program or f"python -m {module.removesuffix('.command')}", *arguments]  # argparse's usage
    try:
        signal.signal(signal.SIGTERM, _interrupt)
        with imports():
            command = import_module(module)
        status = int(command.main(list(arguments)))
        sys.stdout.flush()
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # The reader of a pipe has seen enough; nothing may be flushed into it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BAND_BROKEN
    return status


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


def concluded(
    work: Callable[[], int], interrupted: str | Callable[[], str] = "interrupted", prefix: str = ""
) -> int:
    """Exit status of a command's work: its own, or that of an error or interrupt, with one message.

    Parameters
    ----------
    work : callable
        Gives the status.
    interrupted : str or callable
        What to say of an interrupt: what is left, and how to go on.
    prefix : str, optional
        What to begin the message of an error with.
    """
    try:
        return work()
    except InputError as error:
        print(f"{prefix}{error}", file=sys.stderr)
        return WRONG_INPUT
    except KeyboardInterrupt:
        print(interrupted if isinstance(interrupted, str) else interrupted(), file=sys.stderr)
        return INTERRUPTED
