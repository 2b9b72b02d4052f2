"""How far a 3D run is from periodic: which states are compared, and what of them."""

from dataclasses import replace

import numpy as np
import pytest
from tubes import SHORT

from validation.mapping.derived import derived_fields
from validation.mapping.state import Mapper
from validation.reference.mesh.periodicity import a_cycle_apart, cycle_change, periodicity_doubts
from validation.reference.mesh.series import MeshState

CELLS = SHORT.cells(4, 8)
STEADY = MeshState(SHORT.coordinates + SHORT.displacement, SHORT.velocity, SHORT.nodal_pressure)
WIDER = replace(SHORT, bulge=0.2)


def changed(first):
    """What changes of a run whose first state is another than all others."""
    states = [first, *[STEADY] * 4]
    mapper = Mapper(SHORT.mesh, CELLS)
    times = np.linspace(0.2, 1.0, 5)
    fields = derived_fields((mapper.map_state(*state) for state in states), CELLS, times)
    return cycle_change(times, np.arange(5), 0.8, lambda number: states[number], mapper, fields)


@pytest.mark.parametrize("share", [0.004, 0.2])
def test_each_quantity_is_watched(share):
    scaled = (1 - share) * STEADY.pressure
    assert changed(STEADY._replace(pressure=scaled))[:2] == ("pressure", pytest.approx(share, rel=1e-9))
    slower = STEADY._replace(velocity=(1 - share) * STEADY.velocity)
    assert changed(slower)[:2] == ("flow rate", pytest.approx(share, rel=1e-9))


def test_the_volume_is_watched():
    """A wider tube with the velocity that keeps its flow rate nearly."""
    moved = [tube.coordinates + tube.displacement for tube in (WIDER, SHORT)]
    mapped = [Mapper(SHORT.mesh, CELLS).map_state(points, *STEADY[1:]) for points in moved]
    wide, own = (state.sector_area.sum() for state in mapped)
    still = STEADY._replace(velocity=0 * SHORT.velocity)
    states = [still._replace(positions=WIDER.coordinates + WIDER.displacement), *[still] * 4]
    mapper, times = Mapper(SHORT.mesh, CELLS), np.linspace(0.0, 0.8, 5)
    fields = derived_fields((mapper.map_state(*state) for state in states[1:]), CELLS, times[1:])
    found = cycle_change(times, np.arange(5), 0.8, lambda number: states[number], mapper, fields)
    assert found[:2] == ("lumen volume", pytest.approx(wide / own - 1, rel=1e-9))


def test_a_steady_run_is_periodic():
    found = changed(STEADY)
    assert found.amount < 1e-12
    assert periodicity_doubts(found) == ()
    assert periodicity_doubts(None) == ()


def test_what_is_not_periodic_is_said():
    (said,) = periodicity_doubts(changed(STEADY._replace(pressure=0.98 * STEADY.pressure)))
    assert said.startswith("3D is not periodic yet: its pressure at 1 s is 2.0% of the cycle's largest off")
    assert said.endswith("a cycle earlier, at 0.2 s")


@pytest.mark.parametrize(
    ("times", "compared", "found"),
    [
        (np.linspace(0.0, 0.8, 5), range(5), (0, 4)),
        (np.linspace(0.0, 1.6, 9), range(4, 9), (4, 8)),
        (np.linspace(0.3, 1.6, 14), range(5, 14), (5, 13)),  # from 0.8 s on
        (np.linspace(0.0, 1.5, 16), range(8, 16), (7, 15)),  # one phase of two cycles
        (np.array([0.1, 0.4, 0.7]), range(3), None),
        (np.array([0.0, 0.4, 0.79]), range(3), None),
    ],
)
def test_the_latest_states_a_cycle_apart(times, compared, found):
    assert a_cycle_apart(times, np.array(compared), 0.8) == found
