"""Values that no run could bear are refused when the file is read; those at the limits load."""

import pytest
from case_folder import FLOW, PRESSURE, WALL, WAVEFORM
from hypothesis import given
from hypothesis import strategies as st

from cases.values import ranges
from cases.values.ranges import Range
from cases.values.units import DIMENSIONS, parse_quantity

INLET = "{kind: velocity, waveform: data/inlet.csv}"
OUTLET = "{kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}"
ALL_RANGES = [each for each in vars(ranges).values() if isinstance(each, Range)]


@pytest.mark.parametrize(
    ("old", "new", "place"),
    [
        ("15 mm", "1e300 m", "line 4: geometry.length"),
        ("15 mm", "1e-300 m", "line 4: geometry.length"),
        ("2.5 mm", "1e200 m", "line 5: geometry.radius"),
        ("0.5 mm", "1e300 m", "line 6: geometry.wall_thickness"),
        ("1060 kg/m^3", "1e300 kg/m^3", "line 7: blood.density"),
        ("0.0035 Pa s", "1e-300 Pa s", "line 7: blood.viscosity"),
        ("0.6 MPa", "1e-300 Pa", "line 8: wall.youngs_modulus"),
        ("0.48}", "0.48, reference_pressure: 1e300 Pa}", "line 8: wall.reference_pressure"),
        ("waveform: data/inlet.csv", "value: 1e300 m/s", "line 10: inlet.value"),
        ("waveform: data/inlet.csv", "value: 1 m/s, period: 1e308 s", "line 10: inlet.period"),
        ("data/inlet.csv", "data/inlet.csv, ramp: 1e-300 s", "line 10: inlet.ramp"),
        ("1.358e9", "1e300", "line 11: outlet.resistance"),
        ("9330 Pa", "1e300 Pa", "line 11: outlet.offset"),
        (OUTLET, "{kind: pressure, value: -1e300 Pa}", "line 11: outlet.value"),
        ("n_x: 120", f"n_x: {10**12}", "line 14: solver.n_x"),
        ("n_phi: 48", "n_phi: 100000", "line 15: solver.n_phi"),
        ("n_phi: 48", f"n_phi: {10**30}", "line 15: solver.n_phi"),
        ("1 ms", "1e-12 s", "line 16: solver.time_step"),
        ("cycles: 3", "cycles: 1e9", "line 17: solver.cycles"),
        ("cycles: 3", f"cycles: {10**9}", "line 17: solver.cycles"),
        ("cycles: 3", f"cycles: {10**400}", "line 17: solver.cycles"),
        ("cycles: 3", f"cycles: 1{'0' * 5000}", "line 17: solver.cycles"),
        ("average", "average\n  output_interval: 1e-300 s", "line 19: solver.output_interval"),
        ("average", f"average\n  profile_exponent: {10**400}", "line 19: solver.profile_exponent"),
        ("average", "average\n  error_tolerance: 1e-300", "line 19: solver.error_tolerance"),
        ("axis: z", "axis: z, time_offset: 1e300 s", "line 19: reference.time_offset"),
        ("axis: z", "axis: z, origin: [0 m, 1e300 m, 0 m]", "line 19: reference.origin[2]"),
        ("10 MPa", "1e300 Pa", "line 32: variants.local.calcification.youngs_modulus"),
        ("[135 deg", "[1e300 deg", "line 34: variants.local.calcification.phi[1]"),
    ],
)
def test_what_no_run_could_bear_is_refused_in_one_line(folder, old, new, place):
    (problem,) = folder.problems((old, new))
    assert problem.startswith(f"x.yaml, {place}: ")
    assert "; allowed: " in problem
    assert len(problem) < 200


@pytest.mark.parametrize("limits", ALL_RANGES, ids=str)
def test_a_range_holds_its_limits_and_nothing_beyond(limits):
    least, largest = (parse_quantity(t, DIMENSIONS[limits.dimension]) for t in (limits.least, limits.largest))
    assert least in limits
    assert largest in limits
    assert largest * (1 + 1e-12) not in limits
    assert least - abs(least) * 1e-12 - 1e-300 not in limits
    assert float("nan") not in limits


@given(st.sampled_from(ALL_RANGES), st.floats(allow_nan=False))
def test_a_range_holds_what_lies_between_its_limits(limits, value):
    least, largest = limits.limits
    assert (value in limits) == (least <= value <= largest)


def test_the_number_of_cells_is_limited(folder):
    assert folder.load(("n_x: 120", "n_x: 10000"), ("n_phi: 48", "n_phi: 200")).variants["none"]
    (problem,) = folder.problems(("n_x: 120", "n_x: 10000"), ("n_phi: 48", "n_phi: 201"))
    assert (
        problem == "x.yaml, line 15: solver.n_phi: 201; allowed: at most 200 with n_x 10000 (2000000 cells)"
    )


@pytest.mark.parametrize(
    ("scheme", "least", "less", "most"),
    [("semi_implicit", "0.24 µs", "0.23 µs", 10_000_000), ("godunov", "24 ns", "23 ns", 100_000_000)],
)
def test_the_number_of_steps_is_limited(folder, scheme, least, less, most):
    chosen = ("scheme: semi_implicit", f"scheme: {scheme}")
    smooth = ("transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}")
    assert folder.load(chosen, smooth, ("1 ms", least)).variants["none"].solver.cycles == 3
    (problem,) = folder.problems(chosen, smooth, ("1 ms", less))
    assert problem.startswith("x.yaml, line 16: solver.time_step: 2.3e-")
    assert problem.endswith(
        f"e+0{len(str(most)) - 1} steps in 3 cycles of 0.8 s; allowed: at most {most} steps"
    )


def test_the_number_of_saved_states_is_limited(folder):
    edits = (("1 ms", "10 µs"),)
    assert folder.load(*edits, ("average", "average\n  output_interval: 24 µs")).variants["none"]
    (problem,) = folder.problems(*edits, ("average", "average\n  output_interval: 20 µs"))
    assert problem == (
        "x.yaml, line 19: solver.output_interval: 2e-05 s: 1.2e+05 states in 3 cycles of 0.8 s; "
        "allowed: at most 100000 states"
    )


def test_the_most_cycles_are_saved_by_default(folder):
    assert folder.load(("cycles: 3", "cycles: 1000")).variants["none"].solver.cycles == 1000


@pytest.mark.parametrize(
    ("name", "text", "base", "stated", "problem"),
    [
        (
            "inlet.csv",
            WAVEFORM.replace("0.8,", "1e308,"),
            INLET,
            INLET,
            "line 10: inlet.waveform: data/inlet.csv, line 5: t_s: 1e308; allowed: a time from 0 s to 1e4 s",
        ),
        (
            "inlet.csv",
            WAVEFORM.replace("0.8,", "2e-7,").replace("0.3,", "1e-7,"),
            INLET,
            INLET,
            (
                "line 10: inlet.waveform: data/inlet.csv, line 5: a period of 2e-07 s; "
                "allowed: a time from 1 µs to 1e4 s"
            ),
        ),
        (
            "inlet.csv",
            WAVEFORM.replace("20.0", "1e300"),
            INLET,
            INLET,
            (
                "line 10: inlet.waveform: data/inlet.csv, line 4: mean_velocity_cm_s: 1e300; "
                "allowed: a velocity from -1e3 m/s to 1e3 m/s"
            ),
        ),
        (
            "flow.csv",
            FLOW.replace("600", "1e300"),
            INLET,
            "{kind: flow, waveform: data/flow.csv}",
            (
                "line 10: inlet.waveform: data/flow.csv, line 3: flow_rate_mL_min: 1e300; "
                "allowed: a flow rate from -1e3 m^3/s to 1e3 m^3/s"
            ),
        ),
        (
            "pressure.csv",
            PRESSURE.replace("120", "-1e300"),
            OUTLET,
            "{kind: pressure, waveform: data/pressure.csv}",
            (
                "line 11: outlet.waveform: data/pressure.csv, line 3: pressure_mmHg: -1e300; "
                "allowed: a pressure from -1e9 Pa to 1e9 Pa"
            ),
        ),
        (
            "wall.csv",
            WALL.replace("2.0,", "1e-300,"),
            "{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}",
            "{law: table, table: data/wall.csv, youngs_modulus: 1 MPa}",
            (
                "line 8: wall.table: data/wall.csv, line 2: radius_mm: 1e-300; "
                "allowed: a length from 1 µm to 10 m"
            ),
        ),
    ],
)
def test_columns_have_limits_too(folder, name, text, base, stated, problem):
    (folder.path / "data" / name).write_text(text)
    assert folder.problems((base, stated)) == [f"x.yaml, {problem}"]


def test_limits_of_diagnostics_are_read_and_bounded(folder):
    stated = ("average", "average\n  limits: {courant_number: 1, energy_defect: 0.5 %}")
    limits = folder.load(stated).variants["none"].solver.limits
    assert (limits.courant_number, limits.energy_defect, limits.mass_defect) == (1.0, 0.005, None)
    (problem,) = folder.problems(("average", "average\n  limits: {mass_defect: 2}"))
    assert problem == (
        'x.yaml, line 19: solver.limits.mass_defect: 2; allowed: a ratio from 1e-15 to 1, e.g. "0.1 %"'
    )
    (problem,) = folder.problems(("average", "average\n  limits: {energy: 2}"))
    assert problem.startswith("x.yaml, line 19: solver.limits.energy: unknown")


def test_a_limit_on_energy_needs_states_close_together(folder):
    limits = "average\n  limits: {energy_defect: 1e-3}\n  output_interval: "
    assert folder.load(("average", f"{limits}16 ms")).variants["none"]
    (problem,) = folder.problems(("average", f"{limits}17 ms"))
    assert problem == (
        "x.yaml, line 20: solver.output_interval: 0.017 s; "
        "allowed: with limits.energy_defect at most a 50th of the cycle (0.016 s)"
    )
