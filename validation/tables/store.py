"""Results kept on disk as they finish, one small file per entry, valid for the sources that made them."""

import json
from pathlib import Path

from cases.shell.whole import write_text
from validation.runs.sources import code_digest
from validation.tables.experiment import Result


class Store:
    """Kept results of one folder.

    Parameters
    ----------
    folder : Path
        Exists; the entries go to its folder ``entries``.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder / "entries"
        self._folder.mkdir(exist_ok=True)
        self._digest = code_digest("tables")

    def _path(self, name: str) -> Path:
        return self._folder / f"{name.replace(' ', '_').replace('=', '_')}.json"

    def get(self, name: str) -> tuple[Result, float] | None:
        """Return a kept result and the CPU seconds it took.

        None where there is none of the present sources, or no whole file.
        """
        path = self._path(name)
        if not path.exists():
            return None
        try:
            kept = json.loads(path.read_text(encoding="utf-8"))
        except ValueError:
            return None
        if not isinstance(kept, dict) or (kept.get("name"), kept.get("sources")) != (name, self._digest):
            return None
        return kept["result"], kept["cpu_s"]

    def put(self, name: str, result: Result, cpu: float) -> None:
        """Keep a result and the CPU seconds it took."""
        kept = {"name": name, "sources": self._digest, "cpu_s": round(cpu, 3), "result": result}
        write_text(self._path(name), json.dumps(kept, indent=1) + "\n")
