"""A FEBio run as a series of states of a mesh."""

import shlex
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from cases.arrays import Floats
from cases.sections.references.febio import FebioReference
from febio_io.xplt import Plot, open_plot
from validation.reference.febio.log import account_of_log
from validation.reference.febio.plot_file import (
    DISPLACEMENT,
    VELOCITY,
    Domains,
    blocks,
    choose_domains,
    lumen_pressure,
    pressure_at,
    require,
)
from validation.reference.febio.records import account_of_record
from validation.reference.mesh.read import mesh_kind
from validation.reference.mesh.series import Account, MeshState, SeriesMesh, Where
from validation.runs.provenance import shown_path


@dataclass(frozen=True)
class PlotSeries:
    """A :class:`MeshSeries` of an open plot file."""

    plot: Plot
    stated: FebioReference

    @property
    def name(self) -> str:
        """Path of the plot file."""
        return str(self.plot.path)

    @property
    def times(self) -> Floats:
        """Times of the states, s."""
        return self.plot.times * self.stated.time_unit

    @cached_property
    def _domains(self) -> Domains:
        require(self.plot)
        return choose_domains(self.plot, self.stated)

    @cached_property
    def _pressure_at(self) -> Where:
        return pressure_at(self.plot, self._domains.lumen)

    def mesh(self) -> SeriesMesh:
        """Return the undeformed mesh; the domains that the case names, else found by fluid pressure."""
        plot, domains = self.plot, self._domains
        return SeriesMesh(
            self.stated.length_unit * plot.mesh.coordinates.astype(float),
            blocks(plot, domains.lumen),
            blocks(plot, domains.wall),
            None if self.stated.calcified is None else blocks(plot, domains.calcified),
            pressure_at=self._pressure_at,
            notes=(*plot.warnings, *domains.notes),
        )

    def state(self, number: int) -> MeshState:
        """Return a state; "nodal fluid velocity" is absolute."""
        plot, stated = self.plot, self.stated
        displacement, velocity = (plot.field(name, number).astype(float) for name in (DISPLACEMENT, VELOCITY))
        pressure = lumen_pressure(plot, self._domains.lumen, number, self._pressure_at)
        return MeshState(
            stated.length_unit * (plot.mesh.coordinates.astype(float) + displacement),
            stated.length_unit / stated.time_unit * velocity,
            stated.pressure_unit * pressure,
        )

    def account(self) -> Account:
        """Return what the plot file, the log and the data records tell."""
        plot, stated = self.plot, self.stated
        log = None if stated.log is None else account_of_log(stated.log, plot)
        records = [account_of_record(record, plot) for record in stated.data_records]
        facts: dict[str, Any] = {
            "file": shown_path(plot.path),
            "software": plot.software,
            "version": f"{plot.version:#06x}",
            "nodes": len(plot.mesh.coordinates),
            "elements": plot.mesh.n_elements,
        }
        if log:
            facts["cost"] = log.cost
            units = {
                "E": stated.pressure_unit,
                "v": 1.0,
                "mu": stated.pressure_unit * stated.time_unit,
                "density": stated.pressure_unit * (stated.time_unit / stated.length_unit) ** 2,
            }
            facts["materials"] = [
                item | {"value": units[item["name"]] * item["value"]} for item in log.materials
            ]
        if records:
            facts["data_records"] = [record.facts for record in records]
        return Account(
            facts,
            notes=tuple(note for record in records for note in record.notes),
            warnings=tuple(warning for part in (log, *records) if part for warning in part.warnings),
        )


@contextmanager
def open_series(stated: FebioReference) -> Iterator[PlotSeries]:
    """Open the plot file of a run.

    Raises
    ------
    FebioError
        If it cannot be read.
    """
    with open_plot(stated.plot_file) as plot:
        yield PlotSeries(plot, stated)


def how_to_make(stated: FebioReference, case: Path, variant: str) -> list[str]:
    """Tell by which commands a plot file is made that is not there yet."""
    plot = stated.plot_file
    if plot.is_file():
        return []
    model = shown_path(plot.with_suffix(".feb"))
    make = ["python", "-m", "febio_io.feb", str(case), "--variant", variant, "--output", model]
    return [
        f"variant {variant!r}: reference.plot_file: {shown_path(plot)}: not there yet; to make it:",
        f"  {shlex.join(make)}",
        f"  {shlex.join(['python', '-m', 'febio_io.run', model])}",
    ]


KIND = mesh_kind(FebioReference, open_series, how_to_make)
