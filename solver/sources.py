"""Digest of sources: what was computed by other code, or with other libraries, is not the same result."""

import hashlib
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
