"""From a case to the walls that the flow sees, and a coupled run from the command line."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from test_resume import assert_same_bytes, changed, run  # noqa: F401

import solver.command as command
from cases.reading.case_file import load_case_file
from solver.case.model import default_output_times, model_of
from solver.case.run import run_case
from solver.errors import ModelError

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
THIN = "wall: {law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}"
LAYERS = (
    "layers: [{name: media, thickness: 0.3 mm, youngs_modulus: 0.9 MPa, calcifies: true}, "
    "{name: adventitia, thickness: 0.2 mm, youngs_modulus: 0.4 MPa}]"
)
BASES = {
    "thin": "base: thin, youngs_modulus: 0.6 MPa",
    "thick": "base: thick, youngs_modulus: 0.6 MPa",
    "layered": f"base: layered, {LAYERS}",
    "saint_venant_kirchhoff": "base: saint_venant_kirchhoff, youngs_modulus: 0.6 MPa",
    "neo_hookean": "base: neo_hookean, youngs_modulus: 0.6 MPa",
}


def edited(case_file, wall, pressure="section"):
    changed(case_file, THIN, f"wall: {{{wall}, poisson_ratio: 0.48}}")
    changed(case_file, "closure: average", f"closure: average, pressure: {pressure}")
    return case_file


@pytest.mark.parametrize("base", list(BASES))
def test_where_it_is_uniform_a_membrane_is_its_base(case_file, base):
    """To the accuracy of a polynomial in p, for bases that are not linear."""
    text = case_file.read_text()
    edited(case_file, f"law: membrane, {BASES[base]}")
    membrane = model_of(load_case_file(case_file).variants["healthy"])
    case_file.write_text(text)
    edited(case_file, BASES[base].replace("base", "law", 1))
    rows = model_of(load_case_file(case_file).variants["healthy"])
    for pressure in (8e3, 16e3):
        assert np.allclose(membrane.area(pressure), rows.area(pressure), rtol=1e-6, atol=0)


def test_two_patches_that_face_each_other_leave_the_wall_symmetric(case_file):
    edited(case_file, f"law: membrane, {BASES['thick']}")
    patch = case_file.read_text().partition("calcification:\n")[2].strip()
    other = patch.replace("[135 deg, 225 deg]", "[315 deg, 45 deg]")
    changed(case_file, patch, f"{{pattern: several, patches: [{patch}, {other}]}}")
    radius = np.sqrt(model_of(load_case_file(case_file).variants["patch"]).area(16e3))
    np.testing.assert_allclose(radius, np.roll(radius, 4, axis=1), rtol=1e-12)
    assert np.ptp(radius[6]) > 1e-6


def test_a_membrane_with_a_pressure_each_row(case_file):
    edited(case_file, f"law: membrane, {BASES['thick']}", "row")
    case = load_case_file(case_file).variants["patch"]
    result = run_case(case, default_output_times(case))
    assert "azimuthal_flux" not in result
    assert "wall_locality_error" not in result.attrs
    radius = result["radius"].isel(time=-1, x=6)
    assert float(radius.max() - radius.min()) > 0.05e-3


def test_a_solid_with_a_pressure_each_row_or_each_section(case_file):
    text = case_file.read_text()
    found = {}
    for pressure in ("row", "section"):
        case_file.write_text(text)
        edited(case_file, "law: solid, youngs_modulus: 0.6 MPa, elements: [16, 1, 12]", pressure)
        case = load_case_file(case_file).variants["patch"]
        found[pressure] = run_case(case, default_output_times(case))
    assert "wall_locality_error" not in found["row"].attrs
    assert 0 < found["section"].attrs["wall_locality_error"] < 1e-3
    radius = found["section"]["radius"].isel(time=-1, x=6)
    assert float(radius.max() - radius.min()) > 0.05e-3


def test_the_coupled_run_says_what_crosses_and_how_local_its_wall_is(case_file):
    edited(case_file, f"law: membrane, {BASES['thick']}")
    case = load_case_file(case_file).variants["patch"]
    result = run_case(case, default_output_times(case))
    assert result["azimuthal_flux"].dims == ("time", "x", "phi")
    assert result["azimuthal_flux"].attrs["units"] == "m2 s-1"
    assert 0 < result.attrs["wall_locality_error"] < 1e-3
    assert np.ptp(result["pressure"].to_numpy(), axis=-1).max() == 0.0


def test_a_negative_load_is_not_judged(case_file):
    edited(case_file, f"law: membrane, reference_pressure: 20 kPa, {BASES['thick']}")
    case = load_case_file(case_file).variants["healthy"]
    with pytest.raises(ModelError, match="known from"):  # 11 kPa is beyond what is continued below P₀
        run_case(case, default_output_times(case))


@pytest.mark.parametrize("control", ["", " error_tolerance: 1e-4,"])
def test_an_interrupted_coupled_run_goes_on_bit_by_bit(case_file, run, control):  # noqa: F811
    edited(case_file, f"law: membrane, {BASES['thick']}")
    changed(case_file, "closure: average", f"closure: average,{control}".rstrip(","))
    folder = case_file.parent
    arguments = [case_file, "--variant", "patch", "--output"]
    assert run(*arguments, folder / "whole.nc")[0] == 0
    assert run(*arguments, folder / "parts.nc", after=10)[0] == 130
    assert run(*arguments, folder / "parts.nc", "--resume")[0] == 0
    assert_same_bytes(folder / "whole.nc", folder / "parts.nc")


def test_the_command_warns_where_a_section_is_not_local(case_file, capsys):
    edited(case_file, f"law: membrane, {BASES['thick']}")
    changed(
        case_file,
        "{length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}",
        "{length: 2 m, radius: 2.5 mm, wall_thickness: 0.5 mm}",
    )
    changed(case_file, "viscosity: 0.003 Pa s", "viscosity: 0.05 Pa s")
    changed(case_file, "x: [5 mm, 10 mm]", "x: [0.2 m, 0.6 m]")
    output = case_file.parent / "long.nc"
    assert command.main([str(case_file), "--variant", "patch", "--output", str(output)]) == 0
    with xr.open_dataset(output) as result:
        far = result.attrs["wall_locality_error"] > 1e-3
    assert ("docs/coupled_model.md" in capsys.readouterr().err) == far
