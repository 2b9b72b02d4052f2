"""The reader that makes ``pyvista.read("case.xplt")`` work, from version 0.49 of pyvista on.

It is declared as an entry point, so that nothing need be imported: installing this package is enough.
"""

from typing import Any

import pyvista as pv

from febio_io.views.grids import to_pyvista
from febio_io.xplt import Plot, open_plot
from febio_io.xplt.lookup import find_state


class _PlotSource(pv.BaseVTKReader):
    """What pyvista drives: opens the file when it is told of, makes a mesh when one is asked for."""

    def __init__(self) -> None:
        super().__init__()
        self.plot: Plot | None = None
        self.state = -1
        self.deformed = False

    def UpdateInformation(self) -> None:
        """Open the file."""
        self.plot = open_plot(self._filename)
        self.state = max(self.plot.n_states - 1, 0)

    def Update(self) -> None:
        """Make the mesh of the active state."""
        self._data_object = to_pyvista(self.opened, self.state, deformed=self.deformed)

    @property
    def opened(self) -> Plot:
        """The open file."""
        if self.plot is None:
            raise ValueError("no file has been given")
        return self.plot


class PlotReader(pv.BaseReader[pv.UnstructuredGrid], pv.TimeReader):
    """Reads states of an FEBio plot file; the last one, unless another is made active.

    Examples
    --------
    >>> reader = pyvista.get_reader("case.xplt")  # doctest: +SKIP
    >>> reader.set_active_time_point(0)  # doctest: +SKIP
    >>> mesh = reader.read()  # doctest: +SKIP
    >>> mesh = pyvista.read("case.xplt", state=0, deformed=True)  # doctest: +SKIP
    """

    _class_reader = _PlotSource

    @property
    def number_time_points(self) -> int:
        """Number of states."""
        return self._plot.n_states

    def time_point_value(self, time_point: int) -> float:
        """Give the time of a state."""
        return float(self._plot.times[find_state(self._plot.path, self._plot.n_states, time_point)])

    @property
    def active_time_value(self) -> float:
        """Time of the active state."""
        return self.time_point_value(self.state)

    def set_active_time_value(self, time_value: float) -> None:
        """Make the last of the states of one time active.

        Raises
        ------
        ValueError
            If there is no state of this time.
        """
        matches = [number for number, time in enumerate(self.time_values) if time == time_value]
        if not matches:
            raise ValueError(f"no state of time {time_value}; the file has {self.time_values}")
        self.state = matches[-1]

    def set_active_time_point(self, time_point: int) -> None:
        """Make a state active, by its number."""
        self.state = time_point

    @property
    def state(self) -> int:
        """Number of the active state; may be set, also by ``pyvista.read(path, state=NUMBER)``."""
        return self._source.state

    @state.setter
    def state(self, number: int) -> None:
        self._source.state = find_state(self._plot.path, self._plot.n_states, number)

    @property
    def deformed(self) -> bool:
        """Whether nodes are where they have moved to; may be set."""
        return self._source.deformed

    @deformed.setter
    def deformed(self, value: bool) -> None:
        self._source.deformed = value

    @property
    def _source(self) -> _PlotSource:
        source: Any = self.reader
        assert isinstance(source, _PlotSource)  # noqa: S101 - pyvista makes it from _class_reader
        return source

    @property
    def _plot(self) -> Plot:
        return self._source.opened
