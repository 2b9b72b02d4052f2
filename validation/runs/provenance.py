"""What produced a comparison: inputs by checksum, versions, machine, times."""

import hashlib
import os
import platform
import subprocess
import sys
from collections.abc import Iterable
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

PACKAGE = "arterial-rom-validation"
LIBRARIES = (
    "matplotlib",
    "netCDF4",
    "numba",
    "numpy",
    "pandas",
    "pyvista",
    "scipy",
    "typst",
    "vtk",
    "xarray",
)


def checksum(path: Path) -> str:
    """SHA-256 of a file, hexadecimal."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def shown_path(path: Path) -> str:
    """Path relative to the current directory if it lies below it, so that a result tells no one's folders."""
    place = path.resolve()
    return str(place.relative_to(Path.cwd()) if place.is_relative_to(Path.cwd()) else place)


def git_commit(folder: Path) -> str | None:
    """Commit of the checkout that holds ``folder``, with "+" where files differ from it; None outside git."""
    try:
        commit = _git(folder, "rev-parse", "HEAD")
        changed = _git(folder, "status", "--porcelain", "--untracked-files=no")
    except (OSError, subprocess.CalledProcessError):
        return None
    return commit + ("+" if changed else "")


def _git(folder: Path, *arguments: str) -> str:
    command = ["git", "-C", str(folder), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()  # noqa: S603


def installed(name: str) -> str | None:
    """Version of an installed package; None where it is not."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def provenance(
    case: Path, inputs: Iterable[Path], command: list[str], sha256: str | None = None
) -> dict[str, Any]:
    """Describe this run: when, from what, with what, where.

    Parameters
    ----------
    case : Path
        The case file.
    inputs : iterable of Path
        Other files that were read.
    command : list of str
        The command line that repeats the run.
    sha256 : str, optional
        Checksum of the case file when it was read; that of the file as it is now where it is not given.
    """
    listed = [
        {"path": shown_path(path), "sha256": checksum(path), "bytes": path.stat().st_size}
        for path in dict.fromkeys(inputs)
    ]
    return {
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "command": " ".join(command),
        "git_commit": git_commit(Path(__file__).parent),
        "package_version": installed(PACKAGE),
        "python": platform.python_version(),
        "versions": {name: found for name in LIBRARIES if (found := installed(name))},
        "machine": {
            "system": platform.platform(),
            "processor": platform.processor() or platform.machine(),
            "cores": os.cpu_count(),
            "byte_order": sys.byteorder,
        },
        "case": {"path": shown_path(case), "sha256": sha256 or checksum(case)},
        "inputs": listed,
    }
