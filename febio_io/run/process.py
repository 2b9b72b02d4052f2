"""One run of FEBio: started beside its model, watched, and ended with everything it started."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from cases.shell.interrupts import interrupts_deferred
from febio_io.errors import FebioError

CONVERGED = re.compile(rb"-+ converged at time : ([-+0-9.eE]{1,30})\s*")
FAILED = b"------- failed to converge"


@dataclass
class LogTail:
    """What the log has told so far; :meth:`read_on` takes in what has been written since.

    Attributes
    ----------
    path : Path
        The log; it need not exist yet.
    steps : int
        Time steps that converged.
    retries : int
        Attempts that failed.
    time : float
        Time of the last converged step, s.
    """

    path: Path
    steps: int = 0
    retries: int = 0
    time: float = 0.0
    _position: int = field(default=0, repr=False)
    _rest: bytes = field(default=b"", repr=False)

    def read_on(self) -> None:
        """Read the lines that have been completed since the last call."""
        try:
            with self.path.open("rb") as stream:
                stream.seek(self._position)
                new = stream.read()
        except FileNotFoundError:
            return
        self._position += len(new)
        *lines, self._rest = (self._rest + new).split(b"\n")
        for line in lines:
            if match := CONVERGED.fullmatch(line):
                self.steps += 1
                self.time = float(match[1])
            elif line.startswith(FAILED):
                self.retries += 1


NAME = "febio4"
VARIABLE = "FEBIO"
INSTALL = (
    "Install FEBio 4 (https://febio.org/downloads, or build https://github.com/febiosoftware/FEBio), then "
    f"put the folder of {NAME} on PATH, set the environment variable {VARIABLE} to the program, or state "
    "--febio PATH"
)


class FebioRunError(FebioError):
    """FEBio cannot be run, or did not end as it should."""


def find_febio(stated: str | None) -> Path:
    """Find FEBio's program.

    Parameters
    ----------
    stated : str or None
        What the user states: a path, or a name on PATH. Else the environment variable FEBIO says it, else it
        is febio4 on PATH.

    Raises
    ------
    FebioRunError
        If there is none; the message says what to install.
    """
    wanted, origin = stated, "--febio"
    if wanted is None and (configured := os.environ.get(VARIABLE)):
        wanted, origin = configured, f"the environment variable {VARIABLE}"
    found = shutil.which(wanted or NAME)
    if found is not None:
        return Path(found).absolute()
    if wanted is None:
        raise FebioRunError(f"FEBio is not installed: there is no {NAME} on PATH. {INSTALL}")
    what = "is a folder" if Path(wanted).is_dir() else "is no program that can be run"
    raise FebioRunError(f"{wanted}, stated by {origin}, {what}. {INSTALL}")


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
