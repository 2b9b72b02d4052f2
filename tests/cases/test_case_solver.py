"""The solver's section: both schemes."""

import pytest

from cases.sections.solver import GodunovSolver, SemiImplicitSolver

THICK = "{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}"
GODUNOV = ("scheme: semi_implicit", "scheme: godunov")
SMOOTH = ("transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}")
ONE_ROW = (("n_phi: 48", "n_phi: 1"), ("pattern: local", "pattern: axisymmetric"))
NO_ANGLES = ("      phi: [135 deg, 225 deg]\n", "")


def solver_of(folder, *edits):
    return folder.load(*edits).variants["local"].solver


def test_defaults_of_the_schemes(folder):
    solver = solver_of(folder)
    assert isinstance(solver, SemiImplicitSolver)
    assert (solver.closure, solver.error_tolerance, solver.profile_exponent) == ("average", None, None)
    solver = solver_of(folder, SMOOTH, GODUNOV)
    assert isinstance(solver, GodunovSolver)
    assert (solver.closure, solver.limiter, solver.coefficients) == ("average", "van_leer", "corrected")


@pytest.mark.parametrize("closure", ["average", "maximum", "least_squares"])
def test_closures_of_godunov(folder, closure):
    assert solver_of(folder, SMOOTH, GODUNOV, ("average", closure)).closure == closure


@pytest.mark.parametrize("limiter", ["van_leer", "superbee", "minmod", "upwind", "lax_wendroff"])
def test_limiters(folder, limiter):
    stated = ("average", f"average\n  limiter: {limiter}\n  coefficients: printed")
    solver = solver_of(folder, SMOOTH, GODUNOV, stated)
    assert (solver.limiter, solver.coefficients) == (limiter, "printed")


@pytest.mark.parametrize(("stated", "ratio"), [("0.1 %", 0.001), ("1e-4", 1e-4), ("10 %", 0.1), ("0.1", 0.1)])
def test_an_error_tolerance_is_a_ratio(folder, stated, ratio):
    solver = solver_of(folder, ("average", f"average\n  error_tolerance: {stated}"))
    assert solver.error_tolerance == ratio


@pytest.mark.parametrize("exponent", [9, 0.5])
def test_one_row_may_have_a_fixed_profile(folder, exponent):
    stated = ("average", f"average\n  profile_exponent: {exponent}")
    assert solver_of(folder, *ONE_ROW, NO_ANGLES, stated).profile_exponent == exponent


@pytest.mark.parametrize("law", ["saint_venant_kirchhoff", "neo_hookean"])
def test_godunov_takes_linear_walls_only(folder, law):
    problem = f"godunov; allowed: semi_implicit with the wall law {law}; godunov with thin, thick, layered"
    assert folder.problems(GODUNOV, ("law: thick", f"law: {law}")) == [
        f"x.yaml, line 13: solver.scheme: {problem}"
    ]


def test_godunov_takes_smooth_calcifications_only(folder):
    allowed = "semi_implicit with a sharp calcification; godunov with transition lengths (variant local)"
    assert folder.problems(GODUNOV) == [f"x.yaml, line 13: solver.scheme: godunov; allowed: {allowed}"]


def test_godunov_takes_no_table(folder):
    table = "{law: table, table: data/wall.csv, youngs_modulus: 0.6 MPa}"
    (problem,) = folder.problems(GODUNOV, (THICK, table))
    assert problem.startswith("x.yaml, line 13: solver.scheme: godunov; allowed: semi_implicit with ")


def test_godunov_takes_layers(folder):
    layer = "{name: media, thickness: 0.5 mm, youngs_modulus: 1 MPa, calcifies: true}"
    layered = f"{{law: layered, layers: [{layer}], poisson_ratio: 0.4}}"
    assert solver_of(folder, SMOOTH, GODUNOV, (THICK, layered)).scheme == "godunov"


def test_another_scheme_keeps_the_keys_that_it_has_too(folder):
    tolerance = ("average", "average\n  error_tolerance: 0.1 %\n  output_interval: 10 ms")
    override = ("title: A patch", "title: A patch\n    solver: {scheme: godunov, limiter: minmod}")
    file = folder.load(tolerance, override, SMOOTH)
    none, local = file.variants["none"].solver, file.variants["local"].solver
    assert (none.scheme, none.error_tolerance) == ("semi_implicit", 0.001)
    assert (local.scheme, local.limiter) == ("godunov", "minmod")
    assert (local.n_x, local.output_interval) == (none.n_x, none.output_interval) == (120, 0.01)
