"""Reader of the made-up kind of reference: a tube of formulas."""

from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from made_up_kind import TubeReference
from tubes import Tube

from validation.mapping.interpolation import topology
from validation.mapping.mesh import padded
from validation.mapping.pressure import element_centres
from validation.reference.mesh.model import frame
from validation.reference.mesh.read import mesh_kind
from validation.reference.mesh.series import Account, MeshState, SeriesMesh

PERIOD = 2.392 / 3


@dataclass(frozen=True)
class TubeSeries:
    """A tube at rest in its deformed state, whose mesh lies as the section says.

    Its pressure is steady, or grows from half of that as 1 − e^(−t/τ)/2 with τ = ``approach`` in s.
    """

    stated: TubeReference
    tube: Tube

    @property
    def name(self):
        return "a tube of formulas"

    @property
    def times(self):
        return (
            PERIOD * np.arange((self.stated.states - 1) * self.stated.cycles + 1) / (self.stated.states - 1)
        )

    def _points(self, points):
        place = frame(self.stated.axis, self.stated.phi_zero, self.stated.origin)
        return points @ place.rotation + place.origin

    def _directions(self, parts):
        return parts @ frame(self.stated.axis, self.stated.phi_zero, self.stated.origin).rotation

    def mesh(self):
        tube, where = self.tube, self.stated.values
        return SeriesMesh(
            self._points(tube.coordinates), tube.lumen, tube.vessel_wall, None, where, where, ("no solver",)
        )

    def state(self, number):
        assert 0 <= number < len(self.times)
        tube, approach = self.tube, self.stated.approach
        grown = 1.0 if approach is None else 1 - 0.5 * np.exp(-self.times[number] / approach)
        positions = self._points(tube.coordinates + tube.displacement)
        if self.stated.values == "nodes":
            return MeshState(positions, self._directions(tube.velocity), grown * tube.nodal_pressure)
        lumen = topology(*padded(tube.lumen), len(tube.coordinates))
        values = [element_centres(lumen, tube.velocity)]
        values.append(element_centres(lumen, np.tile(grown * tube.nodal_pressure[:, None], 3)))
        return MeshState(positions, self._directions(values[0]), values[1][:, 0])

    def account(self):
        return Account({"software": "formulas", "nodes": len(self.tube.coordinates)}, warnings=("made up",))


@contextmanager
def open_tube(stated):
    yield TubeSeries(stated, Tube(sectors=12, rings=4, stacks=10, layers=2))


KIND = mesh_kind(TubeReference, open_tube)
