"""One run of FEBio: started beside its model, watched, and ended with everything it started."""

import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from cases.shell.interrupts import interrupts_deferred
from febio_io.run.executable import FebioRunError
from febio_io.run.log_tail import LogTail

POLL = 0.2  # s between looks at the log
GRACE = 5.0  # s that FEBio has to end when it is asked to, before it is killed
SHOWN = 2000  # characters of its last words


@dataclass(frozen=True)
class Finished:
    """How the program ended: its exit status (negative: the signal that killed it), and its last words."""

    status: int
    last_words: str


def run_febio(
    febio: Path,
    model: Path,
    threads: int | None,
    watch: Callable[[LogTail], None],
    *,
    log: Path | None = None,
    configuration: Path | None = None,
) -> Finished:
    """Run FEBio on a model, in the model's folder.

    FEBio runs in a session of its own, so that a Ctrl-C at the terminal does not reach it (it would ask there
    what to do). Whatever ends this call, FEBio has ended when it returns or raises.

    Parameters
    ----------
    febio, model : Path
        The program and the model.
    threads : int or None
        Threads it may use; FEBio's own choice if None.
    watch : callable
        Called again and again with what the log has told.
    log : Path, optional
        The log, where the model names one of its own.
    configuration : Path, optional
        FEBio's configuration, absolute; that beside the program else.

    Raises
    ------
    FebioRunError
        If the program cannot be started.
    """
    environment = dict(os.environ)
    if threads is not None:
        environment |= dict.fromkeys(("OMP_NUM_THREADS", "MKL_NUM_THREADS"), str(threads))
    options = [] if configuration is None else ["-cnf", str(configuration)]
    tail = LogTail(log or model.with_suffix(".log"))
    with tempfile.TemporaryFile() as said:
        process: subprocess.Popen[bytes] | None = None
        try:
            with interrupts_deferred():
                process = subprocess.Popen(  # noqa: S603 - the program that the user chose
                    [str(febio), "-i", model.name, *options],
                    cwd=model.parent,
                    env=environment,
                    stdin=subprocess.DEVNULL,
                    stdout=said,
                    stderr=subprocess.STDOUT,
                    start_new_session=True,
                )
            while process.poll() is None:
                tail.read_on()
                watch(tail)
                time.sleep(POLL)
        except OSError as error:
            raise FebioRunError(f"{febio}: cannot be run: {error.strerror}") from error
        finally:
            if process is not None:
                with interrupts_deferred():
                    _end(process)
        tail.read_on()
        watch(tail)
        said.seek(max(said.seek(0, os.SEEK_END) - SHOWN, 0))
        return Finished(process.returncode, said.read().decode("utf-8", errors="replace").strip())


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the program and what it has started; ask first."""
    for request in (signal.SIGTERM, signal.SIGKILL):
        if process.poll() is not None:
            return
        os.killpg(process.pid, request)
        try:
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            continue
