"""How far a run is, by its growing log."""

import re
from dataclasses import dataclass, field
from pathlib import Path

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
