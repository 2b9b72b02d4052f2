"""Where compiled kernels are kept: one folder per version of their sources.

Numba renews a cached kernel when its own file changes, not when a kernel or a tuple of arrays that it
imports from another file does. A folder named after all sources together cannot hold such a stale kernel,
and lies where the user may write even if the code does not.
"""

import hashlib
import os
import tempfile
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[1]


def sources_digest(sources: Iterable[Path], libraries: Iterable[str] = ("numba",)) -> str:
    """Digest of sources, names and contents, and of the versions of libraries.

    Parameters
    ----------
    sources : iterable of Path
        Files, and folders, of which all Python modules count.
    libraries : iterable of str
        Names of installed packages.
    """
    digest = hashlib.sha256()
    for name in sorted(libraries):
        digest.update(f"{name} {version(name)}\0".encode())
    for source in sources:
        for path in sorted(source.rglob("*.py")) if source.is_dir() else [source]:
            name = path.relative_to(source.parent).as_posix()
            digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:32]


FOLDER = "arterial-rom-validation"
KERNELS = (  # every module with kernels: they share one cache
    "solver/schemes",
    "validation/mapping/elements.py",
    "validation/mapping/interpolation.py",
    "validation/mapping/meshed_profiles.py",
    "validation/mapping/nodal_shares.py",
    "validation/mapping/profiles.py",
    "validation/mapping/surface.py",
    "validation/mapping/wall_radius.py",
)


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
    import numba

    if "NUMBA_CACHE_DIR" in os.environ:
        return
    folder = usable_folder(sources_digest(ROOT / kernels for kernels in KERNELS))
    if folder is not None:
        numba.config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]
