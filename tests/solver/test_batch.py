"""Many cases in one call: what an ordinary run gives, failures that end alone, and Ctrl-C."""

import threading

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from thesis_artery import artery

from cases.reading.case_file import load_case_file
from cases.sections.solver import Limits
from solver.case.run import run_case
from solver.errors import ModelError, SolverError
from solver.geometry.grid import Grid
from solver.geometry.symmetry import all_rows, fewer_rows
from solver.runs import batch
from solver.runs.batch import run_batch
from solver.runs.result import cell_dataset

TIMES = np.array([0.0, 0.01, 0.035, 0.1, 0.2])
ROUND_OFF = 1e-12  # of rows that stand for others


def with_patch(case, modulus, start, phi):
    """A case whose calcification is another one."""
    patch = case.calcification.model_copy(
        update={"youngs_modulus": modulus, "x": (start, start + 4e-3), "phi": phi}
    )
    return case.model_copy(update={"calcification": patch})


def with_outlet(case, **changes):
    return case.model_copy(update={"outlet": case.outlet.model_copy(update=changes)})


def with_solver(case, **changes):
    return case.model_copy(update={"solver": case.solver.model_copy(update=changes)})


def limited_to(case, advective):
    """A case whose advective Courant number may not pass a limit."""
    return with_solver(case, limits=Limits(advective_courant_number=advective))


@pytest.fixture
def variants(case_file):
    return load_case_file(case_file).variants


def assert_same_fields(found, ordinary, tolerance=0.0):
    for name in found.data_vars:
        largest = float(np.abs(ordinary[name]).max())
        np.testing.assert_allclose(
            found[name], ordinary[name], rtol=0, atol=tolerance * largest, err_msg=name
        )


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    modulus=st.floats(1e6, 2e7),
    start=st.floats(1e-3, 9e-3),
    phi=st.tuples(st.floats(0.1, 1.0), st.floats(1.5, 2.9)),  # not symmetric
    flow=st.sampled_from(["row", "section"]),
    viscosity=st.floats(0.001, 0.01),
)
def test_a_case_in_a_batch_has_the_bits_of_an_ordinary_run(variants, modulus, start, phi, flow, viscosity):
    case = with_outlet(with_patch(variants["patch"], modulus, start, phi), flow=flow)
    case = case.model_copy(update={"blood": case.blood.model_copy(update={"viscosity": viscosity})})
    other = with_patch(variants["patch"], 5e6, 5e-3, (1.0, 2.0))
    outcomes = run_batch([other, case, other], TIMES, cell_dataset, threads=2)
    assert outcomes[1].error is None
    assert_same_fields(outcomes[1].kept, run_case(case, TIMES))


def test_rows_that_are_alike_are_computed_once(variants):
    case = variants["healthy"]
    (outcome,) = run_batch([case], TIMES, cell_dataset)
    ordinary = run_case(case, TIMES)
    assert outcome.kept["pressure"].shape == ordinary["pressure"].shape
    assert np.ptp(outcome.kept["mean_velocity"].to_numpy(), axis=-1).max() == 0
    assert_same_fields(outcome.kept, ordinary, ROUND_OFF)


def test_a_tabulated_wall_that_is_alike_is_computed_once(case_file):
    text = case_file.read_text().replace("law: thin", "law: neo_hookean")
    case_file.write_text(text.replace("poisson_ratio: 0.5", "poisson_ratio: 0.48"))
    case = load_case_file(case_file).variants["healthy"]
    (outcome,) = run_batch(
        [case], TIMES, lambda model, cells: (fewer_rows(model), cell_dataset(model, cells))
    )
    single, found = outcome.kept
    assert single.wall_table.values.shape[:2] == (12, 1)
    assert_same_fields(found, run_case(case, TIMES), ROUND_OFF)


@settings(max_examples=6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    half=st.floats(0.4, 2.8),
    centre=st.sampled_from([0.0, np.pi]),
    modulus=st.floats(1e5, 2e7),
    changes=st.sampled_from([{"flow": "row"}, {"flow": "section"}]),
)
def test_one_half_of_a_symmetric_ring_stands_for_both(variants, half, centre, modulus, changes):
    phi = tuple(float(angle % (2 * np.pi)) for angle in (centre - half, centre + half))
    case = with_outlet(with_patch(variants["patch"], modulus, 5e-3, phi), **changes)
    (outcome,) = run_batch(
        [case], TIMES, lambda model, cells: (fewer_rows(model).grid, cell_dataset(model, cells))
    )
    grid, found = outcome.kept
    assert grid == Grid(15e-3, 12, 4, mirrored=True) or grid.n_phi == 1
    assert_same_fields(found, run_case(case, TIMES), ROUND_OFF)


@pytest.mark.parametrize(("phi", "rows"), [((1.0, 2 * np.pi - 1.0), 4), ((1.0, 2.0), 8)])
def test_only_computed_rows_are_kept_where_no_other_is_wanted(variants, phi, rows):
    case = with_patch(variants["patch"], 1e7, 5e-3, phi)
    (outcome,) = run_batch([case], TIMES, cell_dataset, every_row=False)
    (whole,) = run_batch([case], TIMES, cell_dataset)
    assert outcome.kept.sizes["phi"] == rows
    for name in ("pressure", "radius", "mean_velocity", "profile_exponent"):
        np.testing.assert_array_equal(all_rows(outcome.kept[name].to_numpy(), 8), whole.kept[name])
    sections = ["section_flow_rate", "section_pressure"]
    assert_same_fields(outcome.kept[sections], whole.kept, 1e-14)
    assert outcome.kept["phi"][0] == whole.kept["phi"][0]


@pytest.mark.parametrize(
    ("rows", "kept"),
    [([1, 2, 3, 4, 4, 3, 2, 1], 4), ([1, 2, 3, 4, 4, 3, 2, 2], 8), ([5] * 8, 1), ([1, 2, 2, 1], 4)],
)
def test_rows_are_left_out_where_others_stand_for_them(rows, kept):
    model = artery(6, len(rows), stiffness=np.tile(400.0 * np.array(rows, dtype=float), (6, 1)))
    fewer = fewer_rows(model)
    assert fewer.grid.n_phi == kept
    assert fewer.grid.dphi == pytest.approx(2 * np.pi / (1 if kept == 1 else len(rows)))
    assert fewer.grid.sector * kept == pytest.approx(np.pi)
    np.testing.assert_array_equal(all_rows(fewer.stiffness, len(rows)), model.stiffness)
    assert fewer_rows(fewer) is fewer


@pytest.mark.parametrize(
    "changes",
    [
        {"pressure": "section"},
        {"error_tolerance": 1e-3},
        {"n_phi": 1, "profile_exponent": 5.0},
    ],
    ids=str,
)
def test_every_way_to_solve(variants, changes):
    case = with_solver(variants["healthy" if "n_phi" in changes else "patch"], **changes)
    (outcome,) = run_batch([case], TIMES, cell_dataset)
    assert outcome.error is None
    assert_same_fields(outcome.kept, run_case(case, TIMES))
    assert ("azimuthal_flux" in outcome.kept) == ("pressure" in changes)


def test_a_failure_ends_alone_in_its_own_words(variants):
    good = variants["patch"]
    failing = [
        with_outlet(good, offset=-4e5),  # has no steady start
        with_solver(good, start="rest"),  # nor a profile after the first step
        limited_to(good, 0.001),
    ]
    outcomes = run_batch([good, *failing, good], TIMES, lambda model, cells: cells.pressure.max())
    for case, outcome in zip(failing, outcomes[1:-1], strict=True):
        with pytest.raises(SolverError) as ordinary:
            run_case(case, TIMES)
        assert type(outcome.error) is ordinary.type
        assert str(outcome.error) == str(ordinary.value)
        assert outcome.kept is None
    assert outcomes[0].kept == outcomes[-1].kept > 9e3
    assert outcomes[0].error is None


def test_each_case_may_have_times_of_its_own(variants):
    wanted = [np.array([0.0, 0.05]), TIMES]
    outcomes = run_batch([variants["patch"]] * 2, wanted, lambda model, cells: cells.times)
    for outcome, times in zip(outcomes, wanted, strict=True):
        np.testing.assert_array_equal(outcome.kept, times)


@pytest.mark.parametrize(
    ("times", "said"),
    [(np.array([0.0, 0.2, 0.1]), "increase"), ([TIMES], "output times of 1 cases; allowed: one array")],
)
def test_times_that_do_not_fit(variants, times, said):
    with pytest.raises(ModelError, match=said):
        run_batch([variants["patch"]] * 2, times, cell_dataset)


def test_no_cases_take_no_time():
    assert run_batch([], TIMES, cell_dataset) == []


def test_progress_counts_cases(variants):
    seen = []
    cases = [variants["healthy"]] * 3
    run_batch(cases, TIMES, lambda model, cells: None, 1, lambda done, total: seen.append((done, total)))
    assert seen[-1] == (3, 3)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)


def test_an_interrupt_ends_the_runs_that_go_on(variants):
    def interrupted(done, total):
        raise KeyboardInterrupt

    kept = []
    cases = [variants["healthy"]] + [variants["patch"]] * 40
    with pytest.raises(KeyboardInterrupt):
        run_batch(cases, TIMES, lambda model, cells: kept.append(1), 1, interrupted)
    assert 1 <= len(kept) < 10
    assert not [thread for thread in threading.enumerate() if "ThreadPoolExecutor" in thread.name]


def test_what_is_wrong_with_the_program_is_no_failure_of_a_case(variants):
    with pytest.raises(ZeroDivisionError):
        run_batch([variants["healthy"]] * 3, TIMES, lambda model, cells: 1 / 0)


def test_threads_are_those_that_may_be_used(monkeypatch):
    monkeypatch.setattr(batch.os, "sched_getaffinity", lambda process: {0, 1, 2}, raising=False)
    assert batch.available_threads() == 3
    monkeypatch.delattr(batch.os, "sched_getaffinity")
    assert batch.available_threads() >= 1
