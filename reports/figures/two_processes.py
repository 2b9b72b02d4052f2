"""Drawing of a report's figures, each once, by two processes where there are two processors."""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

Drawing = Callable[[], str]
Helper = subprocess.Popen[bytes]

_PACKAGE_FOLDER = str(Path(__file__).resolve().parents[2])
_PROGRAM = "from reports.figures.two_processes import serve; serve()"


@contextmanager
def helper() -> Iterator[Helper | None]:
    """Start a process that draws; it loads its libraries while this one reads the comparison.

    Yields
    ------
    subprocess.Popen or None
        None on a machine with one processor. The process ends with the block.
    """
    if (os.cpu_count() or 1) < 2:
        yield None
        return
    paths = [_PACKAGE_FOLDER, *filter(None, [os.environ.get("PYTHONPATH")])]
    process = subprocess.Popen(  # noqa: S603 (this interpreter, the program above)
        [sys.executable, "-c", _PROGRAM],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        start_new_session=True,  # Ctrl-C is for this process, which ends the other
    )
    with process:
        try:
            yield process
        finally:
            process.kill()


def draw(drawings: Mapping[str, Drawing], second: Helper | None) -> dict[str, str]:
    """Make all drawings, every other one by the second process if there is one.

    Raises
    ------
    RuntimeError
        If the second process ends without its share.
    """
    names = list(drawings)
    theirs = names[1::2] if second else []
    if second and second.stdin:
        pickle.dump([drawings[name] for name in theirs], second.stdin)
        second.stdin.close()
    made = {name: drawings[name]() for name in names if name not in theirs}
    if second and second.stdout:
        answer = second.stdout.read()
        if second.wait() != 0:
            raise RuntimeError(f"the process that draws ended with status {second.returncode}")
        made |= zip(theirs, pickle.loads(answer), strict=True)  # noqa: S301 (written by serve)
    return made


def serve() -> None:
    """Make the drawings that come in, write them out: what the second process does."""
    drawings: list[Drawing] = pickle.load(sys.stdin.buffer)  # noqa: S301 (written by draw)
    pickle.dump([drawing() for drawing in drawings], sys.stdout.buffer)
