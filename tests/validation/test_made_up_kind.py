"""The recipe for a 3D solver, followed from outside: a kind of reference that no file of the package names.

A kind must be registered before the case file's schema is built, and leaves with the process.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from small_case import GENEROUS, bands, small_case, written
from tubes import Tube

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file

HERE = Path(__file__).parent
TUBE = Tube(sectors=12, rings=4, stacks=10, layers=2)
COMMAND = "import sys, made_up_kind; from validation.compare import command; sys.exit(command.main())"


def tube_case(folder, **stated):
    content = bands(small_case("none"), GENEROUS)
    del content["variants"]["none"]["reference"]
    content["reference"] = {"kind": "tube", "axis": "y", "phi_zero": "-x", "states": 5} | stated
    content["reference"]["origin"] = ["1 mm", "2 mm", "-3 mm"]
    return written(content, folder)


def compared(path, *options):
    search = os.pathsep.join([str(HERE), str(HERE.parents[1])])
    return subprocess.run(  # noqa: S603
        [sys.executable, "-c", COMMAND, str(path), *options],
        check=False,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": search, "ARTERIAL_ROM_CACHE": ""},
    )


# a velocity constant in cells says nothing of its slope at the wall, and with 4 rings little of its mean
@pytest.mark.parametrize(("values", "share"), [("nodes", 0.05), ("cells", None)])
def test_a_kind_from_outside_is_compared(tmp_path, values, share):
    path, output = tube_case(tmp_path, values=values), tmp_path / "out"
    done = compared(path, "--output", str(output))
    assert done.returncode == 0, done.stderr
    with xr.open_dataset(output / "comparison.nc") as both:
        found = both.isel(variant=0, time=2).load()
    cells = TUBE.cells(12, 8)
    x, phi = cells.x[:, None], cells.phi[None, :]
    for name, exact, within in (
        ("radius", TUBE.wall(x, phi), 5e-3),
        ("pressure", TUBE.pressure(x), 1e-5),
        *([("mean_velocity", TUBE.mean_velocity(x, phi), share)] if share else []),
    ):
        assert np.max(np.abs(found[f"reference_{name}"].to_numpy() / exact - 1)) < within, name
    provenance = json.loads((output / "provenance.json").read_text())
    facts = provenance["variants"]["none"]["reference"]
    assert (facts["kind"], facts["software"], facts["states_compared"]) == ("tube", "formulas", 5)
    assert any("made up" in warning for warning in provenance["warnings"])
    assert any("no solver" in note for note in provenance["notes"])


def test_checks_and_messages_are_those_of_every_kind(tmp_path):
    done = compared(tube_case(tmp_path, states=2), "--output", str(tmp_path / "out"))
    assert done.returncode == 2
    assert "a tube of formulas: states in the last cycle: 2, allowed: 3 or more" in done.stderr
    done = compared(tube_case(tmp_path, plot_file="run.xplt"), "--output", str(tmp_path / "out"))
    assert done.returncode == 2
    assert "reference.plot_file: only with kind febio; allowed: kind, time_offset, axis," in done.stderr
    assert "Traceback" not in done.stderr


def test_it_left_with_its_process(tmp_path):
    with pytest.raises(
        CaseFileError, match=r"reference\.kind: tube; did you mean tables\? allowed: febio, tables"
    ):
        load_case_file(tube_case(tmp_path))
