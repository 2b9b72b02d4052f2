"""What the packages export: there, by name, and loaded only when it is used."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("package", ["febio_io", "solver"])
def test_every_export_is_there(package):
    hall = import_module(package)
    for name in hall.__all__:
        assert getattr(hall, name).__name__ == name
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        hall.nothing  # noqa: B018


def test_a_front_hall_loads_no_library():
    code = (
        "import sys, febio_io, solver\n"
        "print([name for name in ('numpy', 'numba', 'xarray', 'pyvista', 'cases') if name in sys.modules])"
    )
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
