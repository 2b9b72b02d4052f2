"""What all tests share: reproducible examples in continuous integration, and which files go first."""

import os

from hypothesis import settings

# no deadline: the first example may compile kernels
settings.register_profile("ci", derandomize=True, deadline=None, max_examples=30)
settings.register_profile("explore", deadline=None, max_examples=30)
settings.load_profile("ci" if os.environ.get("CI") else "explore")

# Each process takes the next file when it has done one. The first compile most kernels, and not the same.
LONGEST_FIRST = (
    "reports/test_reports_page.py",
    "solver/test_two_modes.py",
    "solver/test_batch.py",
    "validation/test_command_result.py",
    "validation/test_sweep_kills.py",
    "validation/test_made_up_kind.py",
    "solver/test_godunov_case.py",
    "reports/test_reports_claims.py",
    "reports/test_reports_other_pages.py",
    "validation/test_calibrate.py",
    "solver/test_resume.py",
    "validation/test_meshed_profiles.py",
    "validation/test_error_budget.py",
    "validation/test_two_solvers.py",
    "validation/test_sweep_runs.py",
    "validation/test_cache.py",
    "validation/test_closest_profile.py",
    "tests/test_commands.py",
    "validation/test_grid_references.py",
    "solver/test_manufactured_orders.py",
    "validation/test_tables_golden.py",
    "validation/test_input_uncertainty.py",
    "validation/test_command_input.py",
    "febio_io/test_febio_run.py",
)
RANKS = {name: rank for rank, name in enumerate(LONGEST_FIRST)}


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: RANKS.get("/".join(item.path.parts[-2:]), len(RANKS)))
