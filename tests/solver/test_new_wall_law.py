"""The recipe for a wall law, followed from outside in a process of its own: a class and a line of LAWS."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from test_resume import changed

ROOT = Path(__file__).parents[2]
THIN = "{law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}"
RUBBER = "law: rubber, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48, share: 0.8"
SHIPPED = "thin, thick, layered, saint_venant_kirchhoff, neo_hookean, table"


class Done(NamedTuple):
    returncode: int
    stdout: str
    stderr: str


@pytest.fixture(scope="module")
def run_module():
    """Run a module, as `python -m` does, in the one process where the law is registered."""
    with subprocess.Popen(  # noqa: S603
        [sys.executable, Path(__file__).with_name("rubber_wall.py")],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:

        def run(*arguments):
            process.stdin.write(json.dumps([str(each) for each in arguments]) + "\n")
            process.stdin.flush()
            return Done(*json.loads(process.stdout.readline()))

        yield run


@pytest.fixture
def command(case_file, run_module):
    """Run a module on the case with a wall."""

    def run(module, wall, *options):
        changed(case_file, THIN, f"{{{wall}}}")
        done = run_module(module, case_file, *options)
        changed(case_file, f"{{{wall}}}", THIN)
        return done

    return run


def test_a_new_law_runs_and_is_the_base_of_a_membrane(command, tmp_path):
    walls = {"rows": RUBBER, "membrane": RUBBER.replace("law: rubber", "law: membrane, base: rubber")}
    found = {}
    for name, wall in walls.items():
        for variant in ("healthy", "patch"):
            output = tmp_path / f"{name}-{variant}.nc"
            done = command("solver", wall, "--variant", variant, "--output", output)
            assert done.returncode == 0, done.stderr
            found[name, variant] = xr.load_dataset(output)
    for name in walls:
        np.testing.assert_allclose(found[name, "healthy"]["wall_stiffness"], 0.8 * 0.6e6 * 0.5e-3, rtol=1e-14)
        assert float(found[name, "patch"]["wall_stiffness"].max()) == pytest.approx(0.8 * 10e6 * 0.5e-3)
    rows, membrane = (found[name, "healthy"]["radius"] for name in walls)
    np.testing.assert_allclose(membrane, rows, rtol=1e-6)
    rows, membrane = (found[name, "patch"]["radius"] for name in walls)
    assert np.max(np.abs(rows - membrane)) > 1e-5


@pytest.mark.parametrize(
    ("module", "wall", "said"),
    [
        (
            "cases",
            RUBBER.replace("rubber", "rubbr"),
            f"wall.law: rubbr; did you mean rubber? allowed: {SHIPPED}, rubber, membrane, solid",
        ),
        ("cases", RUBBER.replace("share: 0.8", "share: 2"), "wall.share: 2; allowed: a number from 0.1 to 1"),
        (
            "cases",
            RUBBER.replace("rubber", "thin"),
            "wall.share: only with law rubber, membrane;",
        ),
        (
            "cases",
            "law: membrane, base: gum, poisson_ratio: 0.48",
            f"wall.base: gum; allowed: {SHIPPED}, rubber",
        ),
        (
            "cases",
            "law: membrane, base: rubber, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48",
            "wall: base rubber without share; allowed: with youngs_modulus, share",
        ),
        (
            "febio_io.feb",
            RUBBER,
            "wall.law: rubber, it is made up; allowed in a FEBio model: thin, thick, saint_venant_kirchhoff,",
        ),
    ],
)
def test_messages_name_a_new_law(command, tmp_path, module, wall, said):
    options = () if module == "cases" else ("--variant", "healthy", "--output", tmp_path / "model.feb")
    done = command(module, wall, *options)
    assert done.returncode == 2
    assert said in done.stderr


def test_godunov_takes_a_new_linear_law(command, case_file):
    changed(case_file, "scheme: semi_implicit", "scheme: godunov")
    changed(case_file, "transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}")
    assert command("cases", RUBBER).returncode == 0
    done = command("cases", RUBBER.replace("rubber", "neo_hookean").replace(", share: 0.8", ""))
    assert "godunov with thin, thick, layered, rubber" in done.stderr


def test_the_schema_knows_a_new_law(run_module):
    definitions = json.loads(run_module("cases", "--schema").stdout)["$defs"]
    assert "share" in definitions["RubberWall"]["properties"]
    assert "rubber" in definitions["MembraneOnLaws"]["properties"]["base"]["enum"]
    assert "share" in definitions["MembraneOnLaws"]["properties"]
