"""FEBio's files: readers for plot files, logs and data records, and models of arteries.

    from febio_io import open_plot, read_data_record, read_log, to_pyvista, to_xarray

    with open_plot("case.xplt") as plot:
        velocity = plot.field("nodal fluid velocity", state=-1)  # (n_nodes, 3)
        pressure = plot.field("fluid pressure", -1, "Lumen")  # (n_elements,)
        history = plot.series("displacement")  # (n_states, n_nodes, 3)
        dataset = to_xarray(plot, variables=["displacement"])
        grid = to_pyvista(plot, -1, deformed=True)

``pyvista.read("case.xplt")`` works without an import, by an entry point, where this package is installed
beside pyvista 0.49 or later. ``meshio.read("case.xplt")`` works after ``import
febio_io.views.meshio_format``, as meshio knows no entry points.

``python -m febio_io FILE`` tells what a file holds, and writes results in other formats; ``python -m
febio_io.feb CASE.yaml`` writes FEBio's model of a case, and ``python -m febio_io.run MODEL.feb`` runs it.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from febio_io.text.data_records import read_data_record
    from febio_io.text.log import read_log
    from febio_io.views.arrays import to_xarray
    from febio_io.views.grids import to_pyvista
    from febio_io.xplt.reader import open_plot

__all__ = ["open_plot", "read_data_record", "read_log", "to_pyvista", "to_xarray"]

_MODULES = {
    "open_plot": "febio_io.xplt.reader",
    "read_data_record": "febio_io.text.data_records",
    "read_log": "febio_io.text.log",
    "to_pyvista": "febio_io.views.grids",
    "to_xarray": "febio_io.views.arrays",
}

if not TYPE_CHECKING:  # of a type checker each name is known, and no other

    def __getattr__(name: str) -> Any:
        """What is exported, from its module when it is first asked for: importing the package stays cheap."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return getattr(import_module(_MODULES[name]), name)
