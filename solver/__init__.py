"""The 2D reduced-order model of an artery: lumen and wall on (x, φ), velocity profiles along r.

from cases.reading.case_file import load_case_file
from solver import run_case

dataset = run_case(load_case_file("case.yaml").variants["local"], times)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from solver.case.run import run_case
    from solver.model.parameters import Model
    from solver.runs.batch import run_batch

__all__ = ["Model", "run_batch", "run_case"]

_MODULES = {
    "Model": "solver.model.parameters",
    "run_batch": "solver.runs.batch",
    "run_case": "solver.case.run",
}

if not TYPE_CHECKING:  # of a type checker each name is known, and no other

    def __getattr__(name: str) -> Any:
        """What is exported, from its module when it is first asked for: importing the package stays cheap."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return getattr(import_module(_MODULES[name]), name)
