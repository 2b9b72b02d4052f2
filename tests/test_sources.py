"""What is kept is dropped by an edit of what determines it, and by no other."""

import ast
import re
import shutil
import subprocess
import sys
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest

from solver.kernel_cache import KERNELS, ROOT, sources_digest
from validation.runs.sources import DETERMINANTS

PACKAGES = ("cases", "solver", "febio_io", "validation", "reports")
ENTRIES = {
    "reduced model": ["validation.runs.reduced_model"],
    "reference": ["validation.reference.kinds"],
    "budget": ["validation.compare.budget.sources"],
    "sweep": ["validation.sweep.chunk", "validation.sweep.design", "validation.sweep.samples"],
    "input uncertainty": ["validation.compare.budget.inputs"],
    "tables": [
        f"validation.tables.{name}"
        for name in (
            "pulsatile_tables",
            "pulse",
            "scheme_agreement",
            "stability",
            "steady_flow",
            "steady_tables",
        )
    ],
}


def file_of(module: str) -> Path | None:
    """File of a module or package of ours; None for a name that is neither."""
    place = ROOT / module.replace(".", "/")
    return next((path for path in (place / "__init__.py", place.with_suffix(".py")) if path.exists()), None)


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def imported(path: Path) -> dict[str, str]:
    """Modules of ours that a file imports anywhere in it, by the names it imports them or from them."""
    found = {}
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            names = {alias.name: alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0
            assert node.module not in PACKAGES, f"{path} imports from a front hall, which hides the module"
            whole = {alias.name: f"{node.module}.{alias.name}" for alias in node.names}
            names = {name: full if file_of(full) else node.module for name, full in whole.items()}
        else:
            continue
        found |= {name: module for name, module in names.items() if module.split(".")[0] in PACKAGES}
    return found


def says_something(path: Path) -> bool:
    """Whether a file holds more than a docstring, or than the exports of a package of ours."""
    hall = path.name == "__init__.py" and path.parent.name in ("solver", "febio_io")
    return not hall and any(not isinstance(node, ast.Expr) for node in tree_of(path).body)


def needed(entries: list[str]) -> set[Path]:
    """Files that say something, of modules and of the packages they lie in, with all that they import."""
    seen, left = set(), list(entries)
    while left:
        module = left.pop()
        path = file_of(module)
        if path not in seen:
            seen.add(path)
            left += [*(imported(path).values() if says_something(path) else ()), module.rpartition(".")[0]]
            left = [name for name in left if name]
    return {path for path in seen if says_something(path)}


def declared(sources) -> set[Path]:
    files = set()
    for source in sources:
        place = ROOT / source
        assert place.exists(), source
        files |= set(place.rglob("*.py")) if place.is_dir() else {place}
    return files


@pytest.mark.parametrize("kind", DETERMINANTS)
def test_all_that_a_result_depends_on_is_declared(kind):
    wanted = needed(ENTRIES[kind])
    assert len(wanted) > 20
    forgotten = wanted - declared(DETERMINANTS[kind])
    assert not forgotten


def kernels_of(path: Path) -> list[ast.FunctionDef]:
    return [
        node
        for node in ast.walk(tree_of(path))
        if isinstance(node, ast.FunctionDef)
        and any(re.search(r"njit|vectorize|kernel$", ast.unparse(each)) for each in node.decorator_list)
    ]


def test_all_that_a_kernel_uses_is_declared():
    files = [path for package in PACKAGES for path in (ROOT / package).rglob("*.py") if kernels_of(path)]
    assert len(files) > 25
    assert not set(files) - declared(KERNELS)
    for path in files:
        modules = imported(path)
        for kernel in kernels_of(path):
            used = {
                node.id for part in kernel.body for node in ast.walk(part) if isinstance(node, ast.Name)
            } & set(modules)
            foreign = {
                name: modules[name] for name in used if file_of(modules[name]) not in declared(KERNELS)
            }
            assert not foreign, f"{path}: {kernel.name}"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    root = tmp_path_factory.mktemp("copy")
    for package in PACKAGES:
        shutil.copytree(ROOT / package, root / package, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(ROOT / "reference_data/waveforms", root / "reference_data/waveforms")
    return root


@pytest.fixture
def own_cache(copy, tmp_path, monkeypatch):
    """Processes run the copy, and keep what they compile in an empty folder."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(copy))
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    return tmp_path


@contextmanager
def edited(path):
    """A comment more in a file, for a while."""
    text = path.read_text(encoding="utf-8")
    path.write_text(text + "# a comment\n", encoding="utf-8")
    yield
    path.write_text(text, encoding="utf-8")


def digests(root):
    kinds = {"kernels": KERNELS} | DETERMINANTS
    return {what: sources_digest(root / source for source in sources) for what, sources in kinds.items()}


ALL_RESULTS = {"reduced model", "reference", "budget", "sweep", "input uncertainty"}


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("validation/compare/side_by_side.py", set()),
        ("validation/metrics/bands.py", {"sweep"}),
        ("febio_io/xplt/fields.py", {"reference", "budget", "sweep"}),
        ("febio_io/views/grids.py", set()),
        ("solver/schemes/rows/step.py", {"kernels", "tables"} | ALL_RESULTS),
        ("validation/mapping/profiles.py", {"kernels"} | ALL_RESULTS),
        ("validation/mapping/state.py", ALL_RESULTS),
    ],
)
def test_what_an_edit_drops(copy, file, expected):
    before = digests(copy)
    with edited(copy / file):
        after = digests(copy)
    assert {what for what in before if before[what] != after[what]} == expected


COMPILED = """
import numpy as np
from validation.mapping.surface import flux
flux(np.eye(4, 3), np.array([[0, 1, 2, 3]]), np.eye(4, 3))
"""


@pytest.mark.slow
def test_an_edit_of_a_comment_compiles_nothing_anew_and_one_of_a_kernel_does(copy, own_cache):
    def compiled():
        subprocess.run([sys.executable, "-c", COMPILED], cwd=copy, check=True)  # noqa: S603
        return {path: path.stat().st_mtime_ns for path in own_cache.rglob("*.nb*")}

    first = compiled()
    assert first
    with edited(copy / "validation/compare/side_by_side.py"):
        assert compiled() == first
    with edited(copy / "validation/mapping/surface.py"):
        assert len(compiled()) == 2 * len(first)
