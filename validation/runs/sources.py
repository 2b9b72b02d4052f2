"""Sources that determine each kind of result: an edit of any other keeps what is in the cache."""

from functools import cache
from typing import Literal

from solver.kernel_cache import ROOT, sources_digest

Kind = Literal["reduced model", "reference", "budget", "sweep", "tables", "input uncertainty"]

LIBRARIES = ("numba", "numpy", "scipy", "xarray")

CASE = (
    "cases/arrays.py",
    "cases/errors.py",
    "cases/fields.py",
    "cases/quantities.py",
    "cases/sections",
    "cases/shell/errors.py",
    "cases/statistics.py",
    "cases/values",
)
SOLVER = (
    "solver/errors.py",
    "solver/geometry",
    "solver/kept.py",
    "solver/kernel_cache.py",
    "solver/marching",
    "solver/model",
    "solver/schemes",
    "solver/wall",
)
CELLS = (
    "validation/__init__.py",
    "validation/errors.py",
    "validation/mapping",
    "validation/reference/alignment.py",
    "validation/reference/direction.py",
    "validation/reference/kind.py",
    "validation/runs/cache.py",
    "validation/runs/cached.py",
    "validation/runs/keys.py",
    "validation/runs/packed.py",
)
REDUCED_MODEL = (
    *CASE,
    *SOLVER,
    *CELLS,
    "solver/case",
    "solver/runs/result.py",
    "validation/runs/reduced_model.py",
)
REFERENCE = (
    *CASE,
    *SOLVER,
    *CELLS,
    "solver/case",
    "febio_io/errors.py",
    "febio_io/files.py",
    "febio_io/text",
    "febio_io/xplt",
    "validation/reference",
    "validation/runs/provenance.py",
)
DETERMINANTS: dict[Kind, tuple[str, ...]] = {
    "reduced model": REDUCED_MODEL,
    "reference": REFERENCE,
    "budget": (
        *REDUCED_MODEL,
        *REFERENCE,
        "validation/compare/budget",
        "validation/converge",
        "validation/metrics/quantities.py",
        "validation/metrics/statistics.py",
        "validation/runs/instants.py",
        "validation/runs/matched_inflow.py",
        "validation/runs/sources.py",
    ),
    "sweep": (
        *REDUCED_MODEL,
        *REFERENCE,
        "cases/reading",
        "cases/results",
        "solver/runs/batch.py",
        "validation/ablation/ladder.py",
        "validation/metrics",
        "validation/runs/sources.py",
        "validation/runs/time_step.py",
        "validation/sweep",
    ),
    "input uncertainty": (
        *REDUCED_MODEL,
        "cases/reading",
        "cases/results",
        "solver/runs/batch.py",
        "validation/compare/budget/inputs.py",
        "validation/compare/budget/spread.py",
        "validation/converge/convergence.py",
        "validation/converge/refinement.py",
        "validation/metrics/quantities.py",
        "validation/runs/instants.py",
        "validation/runs/provenance.py",
        "validation/runs/sources.py",
        "validation/sweep/design.py",
        "validation/sweep/display.py",
        "validation/sweep/parameters.py",
    ),
    "tables": (
        *SOLVER,
        "cases/arrays.py",
        "cases/shell/errors.py",
        "reference_data/waveforms/thesis_inlet.csv",
        "validation/__init__.py",
        "reports/figures/plots.py",
        "validation/tables",
    ),
}


@cache
def code_digest(kind: Kind) -> str:
    """Digest of the code that determines one kind of result, and of the libraries' versions."""
    meshes = ("h5py", "meshio", "pyvista", "vtk")
    libraries = (*LIBRARIES, *meshes) if kind in ("reference", "budget", "sweep") else LIBRARIES
    sources = dict.fromkeys(DETERMINANTS[kind])
    return sources_digest((ROOT / source for source in sources), libraries)
