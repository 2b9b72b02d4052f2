"""Rows of metrics, and a check of the checks: a reference false by a known factor."""

from dataclasses import replace

import numpy as np
import pytest
from comparisons import (
    CELLS,
    N_PHI,
    N_T,
    N_X,
    PERIOD,
    TIMES,
    comparison,
    equal_models,
    model_fields,
    models_in,
    two_models,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from cases.fields import FIELDS
from cases.results.metric_row import COLUMNS, metric_row
from validation.metrics import rows as metrics
from validation.metrics.quantities import CYCLE_QUANTITIES, phase_lag
from validation.metrics.rows import to_frame

AFFECTED = {
    "pressure": {"pressure"},
    "radius": {"radius", "largest_radius", "least_radius", "largest_radius_variation"},
    "section_flow_rate": {"section_flow_rate", "sector_flow_share"},
    "section_pressure": {
        "section_pressure",
        "systolic_pressure",
        "diastolic_pressure",
        "pulse_pressure",
        "largest_pressure_difference",
    },
    "mean_velocity": {"mean_velocity"},
    "profile_exponent": {"profile_exponent"},
    "sector_flow_rate": {"sector_flow_rate", "sector_flow_share"},
    "axial_dominance_radial": {"axial_dominance_radial"},
}


def rows_of(models):
    return [
        *metrics.pooled_rows(models),
        *metrics.cycle_rows(models),
        *metrics.check_rows(models),
        *metrics.value_rows(models, CELLS, TIMES),
        *metrics.cycle_error_rows(models, CELLS),
        *metrics.dominance_rows(models, CELLS),
    ]


def scaled(models, quantity, factor):
    return replace(models, reference=models.reference.assign({quantity: models.reference[quantity] * factor}))


def test_each_model_has_its_own_place_of_the_largest_dominance():
    models = two_models()
    rom, three = np.zeros((2, *models.reference["axial_dominance_radial"].shape))
    rom[1, 0], three[0, 1] = 1.2, 0.3
    dims = models.reference["axial_dominance_radial"].dims
    name = "axial_dominance_radial"
    models = replace(
        models,
        rom=models.rom.assign({name: (dims, rom)}),
        reference=models.reference.assign({name: (dims, three)}),
    )
    found = [row for row in metrics.check_rows(models) if row.quantity == name]
    assert [(row.reference, row.rom, row.i, row.j) for row in found] == [(0.3, None, 1, 2), (None, 1.2, 2, 1)]


@pytest.mark.parametrize("quantity", AFFECTED)
def test_a_false_reference_changes_its_own_rows_and_no_others(quantity):
    right, false = rows_of(two_models()), rows_of(scaled(two_models(), quantity, 1.05))
    assert len(right) == len(false)
    changed = {old.quantity for old, new in zip(right, false, strict=True) if old != new}
    lags = [row.rom for row in (*right, *false) if row.quantity == "phase_lag"]
    assert lags[0] == pytest.approx(lags[1], abs=1e-6 * PERIOD)  # it is found by search
    changed -= {"phase_lag"}
    assert changed == AFFECTED[quantity]
    # and of these, each: what 3D says, or how far 2D is from it
    for old, new in zip(right, false, strict=True):
        if old.quantity in changed and (old.reference, old.error) != (None, None):  # not of 2D alone
            assert (old.reference, old.error) != (new.reference, new.error)
            assert (old.rom == new.rom) or old.statistic.startswith("max_")


@pytest.mark.parametrize("quantity", sorted(AFFECTED.keys() - {"axial_dominance_radial"}))
def test_a_reference_false_by_a_factor_has_just_this_error(quantity):
    for row in rows_of(scaled(equal_models(), quantity, 1.05)):
        if row.error is None or row.statistic.endswith("_difference") or row.statistic == "largest":
            continue
        inverse = row.quantity == "sector_flow_share" and quantity == "section_flow_rate"
        expected = 1.05 - 1 if inverse else 1 / 1.05 - 1
        if row.quantity not in AFFECTED[quantity] or row.statistic == "scatter":
            assert row.error == pytest.approx(0.0, abs=1e-12), row
        elif row.statistic in ("rms_error", "rms_over_rms"):
            assert row.error == pytest.approx(abs(expected), rel=1e-9), row
        elif row.statistic == "rms_over_largest":  # less by the quantity's RMS over its largest
            assert 0 < row.error < abs(expected), row
        else:
            assert row.error == pytest.approx(expected, rel=1e-9), row


def test_values_are_those_of_the_cell_and_instant_named():
    models = two_models()
    rows = [r for r in metrics.value_rows(models, CELLS, TIMES) if r.quantity == "pressure"]
    assert len(rows) == 3 * 2 * 2
    for row in rows:
        n = round(row.t_s / PERIOD * (N_T - 1))
        assert row.rom == models.rom["pressure"].to_numpy()[n, row.i - 1, row.j - 1]
        assert row.reference == models.reference["pressure"].to_numpy()[n, row.i - 1, row.j - 1]
        assert row.error == pytest.approx(row.rom / row.reference - 1)
        assert row.unit == "Pa"


def test_section_quantities_have_no_row_number():
    found = [*metrics.value_rows(two_models(), CELLS, TIMES), *metrics.cycle_error_rows(two_models(), CELLS)]
    for row in found:
        assert (row.j is None) == (row.quantity in ("section_flow_rate", "section_pressure"))


def test_the_largest_error_says_where_and_when_it_is():
    models = equal_models()
    pressure = models.reference["pressure"].copy()
    pressure[7, 3, 5] *= 1.25
    models = replace(models, reference=models.reference.assign(pressure=pressure))
    (row,) = [
        r for r in metrics.pooled_rows(models) if (r.quantity, r.statistic) == ("pressure", "max_error")
    ]
    assert (row.i, row.j) == (4, 6)
    assert row.t_s == pytest.approx(7 * PERIOD / (N_T - 1))
    assert row.error == pytest.approx(-0.2)
    assert row.reference == pytest.approx(1.25 * row.rom)


def test_errors_over_the_cycle_are_those_of_the_cell():
    models = two_models()
    rom, reference = (m["radius"].to_numpy()[:, 2, 6] for m in (models.rom, models.reference))
    found = {
        r.statistic: r.error
        for r in metrics.cycle_error_rows(models, CELLS)
        if (r.quantity, r.i, r.j) == ("radius", 3, 7)
    }
    error = rom / reference - 1
    assert found == pytest.approx(
        {
            "rms_error": np.sqrt(np.mean(error**2)),
            "max_error": error[np.argmax(np.abs(error))],
            "systolic_error": rom.max() / reference.max() - 1,
            "diastolic_error": rom.min() / reference.min() - 1,
        }
    )


def test_cycle_quantities_by_hand():
    model = model_fields(3, calcified=False)
    pressure, radius = model["section_pressure"].to_numpy(), model["radius"].to_numpy()
    found = {name: measure(model) for name, measure in CYCLE_QUANTITIES.items()}
    assert found == pytest.approx(
        {
            "systolic_pressure": pressure.max(),
            "diastolic_pressure": pressure.min(),
            "pulse_pressure": pressure.max() - pressure.min(),
            "largest_radius": radius.max(),
            "least_radius": radius.min(),
            "largest_pressure_difference": np.ptp(pressure, axis=1).max(),
            "largest_radius_variation": np.ptp(radius.reshape(N_T, -1), axis=1).max(),
        },
        rel=1e-14,
    )


def test_plug_flow_in_3d_leaves_the_exponents_errors_open():
    models = two_models()
    exponent = models.reference["profile_exponent"].copy()
    exponent[5, 2, 6] = np.inf
    models = replace(models, reference=models.reference.assign(profile_exponent=exponent))
    pooled = {r.statistic: r.error for r in metrics.pooled_rows(models) if r.quantity == "profile_exponent"}
    assert pooled.pop("diastolic_error") is not None  # the least exponents are finite
    assert set(pooled.values()) == {None}
    (cell,) = [
        r
        for r in metrics.value_rows(models, CELLS, np.array([5 * PERIOD / (N_T - 1)]))
        if (r.quantity, r.i, r.j) == ("profile_exponent", 3, 7)
    ]
    assert (cell.reference, cell.error) == (np.inf, None)


class TestChanges:
    def rows(self):
        rom, reference = (
            {"none": model_fields(seed, calcified=False), "local": model_fields(seed + 10, calcified=True)}
            for seed in (1, 2)
        )
        both = comparison(rom, reference)
        rows = [row for name in rom for row in rows_of(models_in(both, name))]
        return rows, list(metrics.change_rows(rows, {"none": "none", "local": "none"}))

    def test_a_change_is_the_value_less_the_baselines(self):
        rows, changes = self.rows()
        assert {row.variant for row in changes} == {"local"}
        assert {row.statistic for row in changes} == {"change", "ratio"}
        values = {
            (r.variant, r.quantity, r.i, r.j, r.t_s): r for r in rows if r.statistic in ("value", "cycle")
        }
        for row in changes:
            key = (row.quantity, row.i, row.j, row.t_s)
            base, here = values["none", *key], values["local", *key]
            if row.statistic == "change":
                assert (row.rom, row.reference) == (here.rom - base.rom, here.reference - base.reference)
                assert row.unit == FIELDS[row.quantity].unit
            else:
                assert (row.rom, row.reference) == (here.rom / base.rom, here.reference / base.reference)
                assert row.unit == "1"
            assert row.error == pytest.approx(row.rom / row.reference - 1)

    def test_every_value_of_both_models_has_its_change(self):
        rows, changes = self.rows()
        wanted = {
            (r.quantity, r.i, r.j, r.t_s)
            for r in rows
            if r.variant == "local" and r.statistic in ("value", "cycle") and None not in (r.rom, r.reference)
        }
        wanted = {place for place in wanted if place[0] not in metrics.DOMINANCE}  # a ratio to v_x already
        for statistic in ("change", "ratio"):
            found = [(r.quantity, r.i, r.j, r.t_s) for r in changes if r.statistic == statistic]
            assert len(found) == len(set(found))
            assert set(found) == wanted

    def test_without_a_baseline_there_is_no_change(self):
        rows, _ = self.rows()
        assert list(metrics.change_rows(rows, {})) == []

    def test_no_ratio_over_nothing(self):
        base = metric_row("c", "none", "rom", "pressure", "value", i=1, j=1, t_s=0.0, rom=0.0, reference=2.0)
        here = replace(base, variant="local", rom=1.0, reference=3.0)
        (row,) = metrics.change_rows([base, here], {"none": "none", here.variant: "none"})
        assert (row.statistic, row.rom, row.reference, row.error) == ("change", 1.0, 1.0, 0.0)


def with_outlet_flow(series):
    models = equal_models()
    flow = models.rom["section_flow_rate"].copy()
    flow[:, -1] = series
    return models.rom.assign(section_flow_rate=flow)


def wave(times):
    w = 2 * np.pi / PERIOD
    return 1.0 + 0.4 * np.sin(w * times) + 0.1 * np.cos(2 * w * times)


@given(st.floats(-0.08, 0.08), st.floats(0.5, 2.0))
@settings(max_examples=40)
def test_phase_lag_finds_a_shift_whatever_the_scale(share, scale):
    times = np.linspace(0.0, PERIOD, N_T)
    lag = share * PERIOD
    rom, reference = with_outlet_flow(scale * wave(times - lag)), with_outlet_flow(wave(times))
    assert phase_lag(rom, reference, PERIOD) == pytest.approx(lag, abs=1e-3 * PERIOD)


def test_no_phase_lag_without_a_whole_cycle():
    half = equal_models().rom.isel(time=slice(N_T // 2))
    assert phase_lag(half, half, PERIOD) is None


def test_table_has_the_columns_in_their_order():
    table = to_frame(rows_of(two_models()))
    assert list(table.columns) == COLUMNS == [
        "case", "variant", "model", "quantity", "statistic", "inflow", "i", "j", "t_s",
        "rom", "reference", "error", "unit", "band", "status",
    ]  # fmt: skip
    assert table["i"].max() <= N_X
    assert table["j"].max() <= N_PHI
