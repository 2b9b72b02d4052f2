"""Compiled kernels never outlive their sources."""

import pkgutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from numba.core.registry import CPUDispatcher

from solver import schemes
from solver.kernel_cache import sources_digest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def sources(tmp_path):
    for folder, name in (("a", "one.py"), ("a", "two.py"), ("b", "three.py")):
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / name).write_text(f"# {name}\n")
    return [tmp_path / "a", tmp_path / "b"]


def test_the_digest_is_that_of_the_sources(sources):
    first = sources_digest(sources)
    assert sources_digest(sources) == first
    (sources[0] / "notes.txt").write_text("no source")
    assert sources_digest(sources) == first


def test_any_change_of_any_source_changes_the_digest(sources):
    seen = {sources_digest(sources)}
    for change in (
        lambda: (sources[1] / "three.py").write_text("# three\n"),
        lambda: (sources[0] / "two.py").rename(sources[0] / "four.py"),
        lambda: (sources[0] / "new.py").write_text(""),
        lambda: (sources[0] / "one.py").unlink(),
    ):
        change()
        seen.add(sources_digest(sources))
    assert len(seen) == 5


def cache_folder(**environment):
    """Folder that a new process keeps its kernels in."""
    code = "import numba, solver.schemes; print(numba.config.CACHE_DIR)"
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", code],
        cwd=ROOT,
        env={"PATH": "/usr/bin:/bin", **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


def test_kernels_lie_in_the_users_cache(tmp_path):
    folder = Path(cache_folder(XDG_CACHE_HOME=str(tmp_path)))
    assert folder.parent == tmp_path / "arterial-rom-validation"
    assert folder.is_dir()
    assert cache_folder(XDG_CACHE_HOME=str(tmp_path)) == str(folder)


def test_a_users_own_choice_stands(tmp_path):
    assert cache_folder(NUMBA_CACHE_DIR=str(tmp_path), XDG_CACHE_HOME="/nonexistent") == str(tmp_path)


def test_without_a_home_the_temporary_folder_serves(tmp_path):
    """A home that cannot hold a folder, as in a container."""
    blocked = tmp_path / "file"
    blocked.write_text("")
    folder = Path(cache_folder(HOME=str(blocked), TMPDIR=str(tmp_path)))
    assert folder.parent.parent == tmp_path
    assert folder.is_dir()


def test_no_kernel_takes_an_option_from_the_caller_that_compiles_it_first():
    """Numba 0.68.1 would, and keep the digits that come of it for every other caller."""
    kernels = {
        kernel.py_func: kernel.targetoptions
        for module in pkgutil.walk_packages(schemes.__path__, f"{schemes.__name__}.")
        for kernel in vars(import_module(module.name)).values()
        if isinstance(kernel, CPUDispatcher)
    }
    assert len(kernels) > 100
    for function, options in kernels.items():
        assert {"fastmath", "error_model", "forceinline", "_nrt"} <= options.keys(), function
