"""Other ways to the same numbers: FEBio's run through VTK's files, and svMultiPhysics' run read wrongly."""

import numpy as np
import pandas as pd
import pytest
import pyvista as pv
from small_case import ROOT, RUNS, bands, small_case, written

from cases.reading.case_file import load_case_file
from febio_io.views.export import export_plot
from febio_io.xplt import open_plot
from validation.mapping.rays import rays
from validation.reference.kinds import kind_of

TETRAHEDRA = ROOT / "reference_data/svmultiphysics/tetrahedra"
CELLS = rays((np.arange(12) + 0.5) * 15e-3 / 12, (np.arange(8) + 0.5) * np.pi / 4)


def fields(content, folder):
    case = load_case_file(written(content, folder)).variants
    (name, only), *_ = case.items()
    return kind_of(name, only).read(only, CELLS, None, None)


@pytest.fixture(scope="module")
def plot(tmp_path_factory):
    return fields(small_case("local"), tmp_path_factory.mktemp("plot")).fields


@pytest.mark.slow
@pytest.mark.parametrize("file_format", ["vtu", "vtkhdf"])
def test_a_febio_run_through_vtk_gives_the_plot_files_fields(tmp_path, file_format, plot):
    content = small_case("local")
    with open_plot(RUNS / "local.xplt") as opened:
        export_plot(opened, tmp_path / "files", file_format)
    ending = "pvd" if file_format == "vtu" else "vtkhdf"
    domain = {"array": "domain"}
    reference = {
        "kind": "vtk",
        "result_files": str(tmp_path / f"files/local.{ending}"),
        **{key: content["reference"][key] for key in ("axis", "phi_zero", "time_offset")},
        "velocity": "nodal fluid velocity",
        "pressure": "fluid pressure",
        "displacement": "displacement",
        "lumen": domain | {"values": [1, 2]},
        "wall": domain | {"values": [3, 4]},
    }
    del content["variants"]["local"]["reference"]
    content["reference"] = reference
    found = fields(content, tmp_path).fields
    for name in plot.data_vars:
        if not name.startswith("axial_dominance"):
            size = float(np.nanmax(np.abs(plot[name].where(np.isfinite(plot[name])))))
            np.testing.assert_allclose(
                found[name], plot[name], rtol=1e-6, atol=1e-6 * size, err_msg=str(name)
            )


def svmultiphysics(folder, **stated):
    """The tetrahedra's case on a coarse grid."""
    content = bands(small_case("local"))
    content["wall"] = {
        "law": "saint_venant_kirchhoff",
        "youngs_modulus": "0.6 MPa",
        "poisson_ratio": 0.45,
        "reference_pressure": "0 Pa",
    }
    content["inlet"] = {"kind": "flow", "waveform": str(TETRAHEDRA.parent / "inflow.csv")}
    del content["variants"]["local"]["reference"]
    domain = {"array": "Domain_ID"}
    content["reference"] = {
        "kind": "vtk",
        "result_files": str(folder / "result_{:03d}.vtu"),
        "time_step": "3.986665 ms",
        "time_offset": "199.33325 ms",
        "axis": "z",
        "phi_zero": "x",
        "length_unit": "cm",
        "pressure_unit": "dyn/cm^2",
        "velocity": "Velocity",
        "pressure": "Pressure",
        "displacement": "Displacement",
        "lumen": domain | {"values": [1]},
        "wall": domain | {"values": [2, 4]},
        "calcified": domain | {"values": [4]},
    } | stated
    return content


def test_tetrahedra_of_svmultiphysics(tmp_path):
    found = fields(svmultiphysics(TETRAHEDRA), tmp_path)
    assert found.warnings == ()
    assert found.description["states_compared"] == 21
    radius = found.fields["radius"] / 2.5e-3 - 1
    assert 0.09 < float(radius.isel(x=0).max()) < 0.125  # its README: 9.5 to 11.8 %
    assert 0.04 < float(radius.sel(x=7.5e-3, phi=np.pi, method="nearest").min()) < 0.06
    written = [pv.read(path) for path in sorted(TETRAHEDRA.glob("*.vtu"))]
    lumen = [grid.extract_cells(grid.cell_data["Domain_ID"] == 1) for grid in written]
    pressure = [0.1 * grid.point_data["Pressure"].mean() for grid in lumen]  # varies by 0.3 % in the lumen
    np.testing.assert_allclose(found.fields["section_pressure"].mean("x"), pressure, rtol=2e-3)
    assert float(found.checks["inlet_flow_rate"].mean()) == pytest.approx(2.37e-6, rel=0.02)


def test_the_path_of_the_blood_is_refused(refused):
    line = refused(svmultiphysics(TETRAHEDRA, displacement="FS_Displacement"))
    assert "result_050.vtu: state 1: nodes of the lumen are up to 0.0" in line
    assert "the wall does not move with the lumen; positions must be those of the mesh" in line


def test_relative_velocity_is_told(tmp_path):
    """Velocity minus the mesh's, as Absolute_velocity of svMultiPhysics, which this run did not write."""
    files = sorted(TETRAHEDRA.glob("*.vtu"))
    grids = [pv.read(path) for path in files]
    moved = [grid.point_data["Displacement"] for grid in grids]
    step = 10 * 3.986665e-3
    for k, (path, grid) in enumerate(zip(files, grids, strict=True)):
        before, after = moved[max(k - 1, 0)], moved[min(k + 1, len(moved) - 1)]
        span = step * (min(k + 1, len(moved) - 1) - max(k - 1, 0))
        grid.point_data["Velocity"] = grid.point_data["Velocity"] - (after - before) / span
        grid.save(tmp_path / path.name)
    found = fields(svmultiphysics(tmp_path), tmp_path)
    assert any("it is relative to the mesh" in warning for warning in found.warnings)


def test_inspect_tells_the_axis_units_and_parts(capsys):
    from validation.reference import command

    assert command.main([str(path) for path in sorted(TETRAHEDRA.glob("*.vtu"))]) == 0
    said = capsys.readouterr().out
    assert "states: 21; times: not in the files" in said
    assert "axis: z" in said
    for line in ("length_unit: cm", "pressure_unit: dyn/cm^2", "velocity: Velocity", "pressure: Pressure"):
        assert f"  {line}" in said
    assert "  displacement: Displacement\n  positions: reference\n" in said
    assert "  lumen: {array: Domain_ID, values: [1]}\n  wall: {array: Domain_ID, values: [2, 4]}\n" in said
    assert "  time_step: to be stated # not in the files" in said  # no time, so that none is taken by mistake


def test_what_inspect_prints_can_be_pasted(tmp_path, capsys):
    from ruamel.yaml import YAML

    from validation.reference import command

    assert command.main([str(RUNS / "local.xplt")]) == 0
    section = YAML().load(capsys.readouterr().out.partition("\nreference:")[2].partition("\n")[2])
    content = small_case("local")
    content["variants"]["local"]["reference"] = dict(section)
    content["reference"] = {"kind": "febio", "time_offset": "0.199333 s"}
    found = fields(content, tmp_path)
    assert found.description["states_compared"] == 41


def test_inspect_refuses_what_is_no_result_in_one_line(tmp_path, capfd):
    from validation.reference import command

    path = tmp_path / "empty.vtu"
    path.write_text("nothing")
    assert command.main([str(path)]) == 2
    (line,) = capfd.readouterr().err.splitlines()
    assert "empty.vtu: VTK cannot read it" in line
    assert command.main(["not_there.vtu"]) == 2
    (line,) = capfd.readouterr().err.splitlines()
    assert "not_there.vtu: no such file" in line


@pytest.mark.long  # two models and 41 states twice: minutes
def test_the_bands_of_the_ready_case_hold(tmp_path):
    from validation.compare import command

    case = str(ROOT / "cases/svmultiphysics.yaml")
    assert command.main([case, "--check", "--output", str(tmp_path / "result")]) == 0
    metrics = pd.read_csv(tmp_path / "result/metrics.csv")
    assert metrics["status"].notna().sum() == 8
