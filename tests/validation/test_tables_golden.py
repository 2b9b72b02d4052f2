"""The thesis's numbers, recomputed: the quick ones always, all of them with ``-m long``."""

import numpy as np
import pytest

from validation.tables import pulsatile_tables, stability, steady_flow, steady_tables
from validation.tables.artery import QUARTER_CM
from validation.tables.command import main
from validation.tables.pulse import block_pulse

pytestmark = pytest.mark.slow  # compiles the explicit scheme


@pytest.mark.parametrize(
    ("transition", "pressure", "eps_2", "eps_inf", "eps_Q"),
    [(QUARTER_CM, 1e3, 143.9e-6, 37.37e-5, 39.48e-2), (2.5e-3, 1e4, 13.29e-4, 3.325e-3, 4.199)],
)
def test_tables_3_1_and_3_2_on_30_cells(transition, pressure, eps_2, eps_inf, eps_Q):
    result = steady_tables.pressure_inlet(30, transition, pressure)
    assert result["eps_2"] == pytest.approx(eps_2, rel=5e-4)
    assert result["eps_inf"] == pytest.approx(eps_inf, rel=5e-4)
    assert result["eps_Q"] == pytest.approx(eps_Q, rel=5e-4)


def test_table_3_1_takes_the_stated_number_of_steps():
    assert steady_tables.pressure_inlet(30, QUARTER_CM, 1e3)["steps"] == 223_556


@pytest.mark.parametrize(
    ("n_x", "transition", "printed"),
    [(30, QUARTER_CM, 4.259), (60, QUARTER_CM, 1.515), (60, 1.25e-3, 4.266)],
)
def test_table_3_3(n_x, transition, printed):
    assert steady_tables.velocity_inlet(n_x, transition)["eps_Q"] == pytest.approx(printed, rel=1e-3)


@pytest.mark.parametrize(
    ("n_phi", "transition", "printed"), [(12, np.pi / 2, 0.5349), (24, np.pi / 4, 0.5447)]
)
def test_table_3_4(n_phi, transition, printed):
    assert steady_tables.local_calcification(n_phi, transition)["eps_Q"] == pytest.approx(printed, rel=5e-4)


def test_table_3_6():
    entry = pulsatile_tables.EXPERIMENTS[0]
    rows = entry.rows({"table 3.6": entry.entries[0].compute()})
    assert len(rows) == 15
    assert max(abs(row.difference) for row in rows) < 3e-4


@pytest.mark.parametrize(("model", "stable", "unstable"), [("none", 23.2, 23.3), ("axisymmetric", 7.3, 7.5)])
def test_stability_limits(model, stable, unstable):
    courant = stability.RUNS[model](stable * 1e-6)
    assert courant is not None
    assert courant < stability.STABLE_COURANT[model]
    beyond = stability.RUNS[model](unstable * 1e-6)
    assert beyond is None or beyond > stability.STABLE_COURANT[model]


def test_steady_flow_belongs_to_the_pulsatile_outlet():
    rows = steady_flow.EXPERIMENT.rows({"steady flow": steady_flow.compute()})
    assert all(row.met for row in rows)
    assert rows[0].ours == pytest.approx(0.5982, abs=5e-5)
    assert rows[2].ours == pytest.approx(0.5945, abs=5e-5)


def test_block_pulse_on_60_cells():
    variation = {
        name: block_pulse(0, name)["variation 3.2"] for name in ("upwind", "lax_wendroff", "van_leer")
    }
    assert variation["upwind"] < 0.95
    assert variation["lax_wendroff"] > 1.3
    assert variation["van_leer"] == pytest.approx(1.0, abs=0.02)


@pytest.mark.long
def test_every_tolerance_is_met(tmp_path):
    assert main(["--output", str(tmp_path)]) == 0
