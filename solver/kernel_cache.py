"""Where compiled kernels are kept: one folder per version of their sources.

Numba renews a cached kernel when its own file changes, not when a kernel or a tuple of arrays that it
imports from another file does. A folder named after all sources together cannot hold such a stale kernel,
and lies where the user may write even if the code does not.
"""

import hashlib
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

import numba

FOLDER = "arterial-rom-validation"
KERNELS = ("solver/schemes", "validation/mapping")  # every folder with kernels: they share one cache


def sources_digest(folders: Iterable[Path]) -> str:
    """Digest of all Python sources in folders, names and contents."""
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(path for folder in folders for path in folder.rglob("*.py")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def cache_folders() -> list[Path]:
    """Folders for what can be computed anew, the preferred one first; none need exist."""
    stated = os.environ.get("XDG_CACHE_HOME")
    home = Path("~").expanduser()
    own = f"{FOLDER}-{os.getuid()}" if hasattr(os, "getuid") else FOLDER
    caches = [Path(stated)] if stated else []
    return [*(cache / FOLDER for cache in [*caches, home / ".cache"]), Path(tempfile.gettempdir()) / own]


def _usable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK | os.X_OK)


def usable_folder(name: str) -> Path | None:
    """First place for cached files of this kind that can be written to, made; None if there is none."""
    return next((place / name for place in cache_folders() if _usable(place / name)), None)


def keep_kernels() -> None:
    """Tell numba where to keep compiled kernels; call before a module with kernels is imported.

    Without any writable place numba keeps to its own choice. An NUMBA_CACHE_DIR that the user set stands.
    """
    if "NUMBA_CACHE_DIR" in os.environ:
        return
    root = Path(__file__).parents[1]
    folder = usable_folder(sources_digest(root / folder for folder in KERNELS))
    if folder is not None:
        numba.config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]
