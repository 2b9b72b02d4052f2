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
from ruamel.yaml import YAML
from small_case import GENEROUS, bands, small_case, written
from tubes import Tube

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file

pytestmark = pytest.mark.slow

HERE = Path(__file__).parent
PERIOD = 2.392 / 3
TUBE = Tube(sectors=12, rings=4, stacks=10, layers=2)
COMMANDS = """import sys, made_up_kind
from validation.compare import command
found, *refused = sys.argv[1:]
print([command.main([path, "--output", "refused"]) for path in refused], file=sys.stderr)
print("of the comparison:", file=sys.stderr)
sys.exit(command.main([found, "--output", "out"]))
"""


def tube_case(folder, **stated):
    content = bands(small_case("none"), GENEROUS)
    del content["variants"]["none"]["reference"]
    content["reference"] = {"kind": "tube", "axis": "y", "phi_zero": "-x", "states": 5} | stated
    content["reference"]["origin"] = ["1 mm", "2 mm", "-3 mm"]
    return written(content, folder)


def started(*arguments, folder):
    search = os.pathsep.join([str(HERE), str(HERE.parents[1])])
    return subprocess.run(  # noqa: S603
        [sys.executable, "-c", COMMANDS, *map(str, arguments)],
        cwd=folder,
        check=False,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": search, "ARTERIAL_ROM_CACHE": ""},
    )


VALUES = {"nodes": {"values": "nodes"}, "cells": {"values": "cells"}}
APPROACHES = {"fast": (0.1, 2), "slower": (0.25, 2), "slow": (1.2, 2), "single": (1.2, 1)}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """One comparison of all that a tube may be, a variant each, what the command said, and of two refused."""
    folder = tmp_path_factory.mktemp("tube")
    path, output = tube_case(folder), folder / "out"
    content = YAML().load(path)
    stated = VALUES | {name: {"approach": tau, "cycles": n} for name, (tau, n) in APPROACHES.items()}
    content["variants"] = {name: {"reference": each} for name, each in stated.items()}
    refused = [folder / "few", folder / "of_febio"]
    for each, wrong in zip(refused, ({"states": 2}, {"plot_file": "run.xplt"}), strict=True):
        each.mkdir()
        tube_case(each, **wrong)
    done = started(written(content, folder), *(each / "small.yaml" for each in refused), folder=folder)
    assert done.returncode == 0, done.stderr
    of_refused, _, said = done.stderr.partition("of the comparison:\n")
    return output, said, json.loads((output / "provenance.json").read_text()), of_refused


# a velocity constant in cells says nothing of its slope at the wall, and with 4 rings little of its mean
@pytest.mark.parametrize(("values", "share"), [("nodes", 0.05), ("cells", None)])
def test_a_kind_from_outside_is_compared(finished, values, share):
    output, _, provenance, _ = finished
    with xr.open_dataset(output / "comparison.nc") as both:
        found = both.sel(variant=values).isel(time=2).load()
    cells = TUBE.cells(12, 8)
    x, phi = cells.x[:, None], cells.phi[None, :]
    for name, exact, within in (
        ("radius", TUBE.wall(x, phi), 5e-3),
        ("pressure", TUBE.pressure(x), 1e-5),
        *([("mean_velocity", TUBE.mean_velocity(x, phi), share)] if share else []),
    ):
        assert np.max(np.abs(found[f"reference_{name}"].to_numpy() / exact - 1)) < within, name
    facts = provenance["variants"][values]["reference"]
    assert (facts["kind"], facts["software"], facts["states_compared"]) == ("tube", "formulas", 5)
    assert any("made up" in warning for warning in provenance["warnings"])
    assert any("no solver" in note for note in provenance["notes"])


@pytest.mark.parametrize("name", APPROACHES)
def test_whether_3d_is_periodic_is_told(finished, name):
    """Of P∞ (1 − e^(−t/τ)/2): the change from the start to the end of the last cycle, over the largest."""
    output, said, provenance, _ = finished
    approach, cycles = APPROACHES[name]
    start, end = (1 - 0.5 * np.exp(-PERIOD * np.array([cycles - 1, cycles]) / approach)).tolist()
    change = 1 - start / end
    found = provenance["variants"][name]["reference"]["cycle_change"]
    assert found == pytest.approx(change, rel=1e-6)
    doubt = f"3D is not periodic yet: its pressure at {cycles * PERIOD:.6g} s is {change:.1%} of"
    assert (doubt in said) == any(doubt in each for each in provenance["warnings"]) == (change > 0.01)
    text = (output / "report.html").read_text().replace("\u00a0", " ")
    assert (doubt in text) == (change > 0.01)
    assert (f"{name}: 3D is not periodic (it changes by" in text) == (change > 0.05)
    assert (f"{name}: the 2D model is within every judged limit" in text) == (change <= 0.05)


def test_checks_and_messages_are_those_of_every_kind(finished):
    *_, said = finished
    assert said.endswith("[2, 2]\n")
    assert "a tube of formulas: states in the last cycle: 2, allowed: 3 or more" in said
    assert "reference.plot_file: only with kind febio; allowed: kind, time_offset, axis," in said
    assert "Traceback" not in said


def test_it_left_with_its_process(tmp_path):
    with pytest.raises(
        CaseFileError,
        match=r"reference\.kind: tube; did you mean tables\? allowed: febio, series, tables, vtk, xdmf",
    ):
        load_case_file(tube_case(tmp_path))
