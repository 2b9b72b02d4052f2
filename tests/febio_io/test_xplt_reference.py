"""Real plot files: those of the project, and the values FEBio itself recorded beside them."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from febio_io.text.data_records import read_data_record
from febio_io.xplt import open_plot

NAMES = ["none", "axisymmetric", "local", "tiny_raw", "tiny_zlib"]


def read_records(path):
    """Read a data record: times, and rows of numbers for each (first column: item number)."""
    record = read_data_record(path)
    assert (record.is_regular, record.warnings) == (True, ())
    rows = np.column_stack([record.items, record.values])
    return record.times, rows.reshape(len(record.times), -1, rows.shape[1])


@pytest.mark.parametrize("name", NAMES)
def test_every_value_is_read_and_finite(reference_folder, name):
    with open_plot(reference_folder / f"{name}.xplt") as plot:
        assert (plot.version, plot.warnings) == (0x35, ())
        assert plot.compressed == (name != "tiny_raw")
        assert (np.diff(plot.times) > 0).all()
        for state in range(plot.n_states):
            for variable in plot.variables:
                regions = plot.regions(variable, state)
                assert regions
                for region in regions:
                    assert np.isfinite(plot.field(variable, state, region)).all()


@pytest.mark.parametrize(
    ("name", "n_nodes", "n_elements", "n_states"),
    [
        ("none", 8215, 7920, 41),
        ("axisymmetric", 8215, 7920, 41),
        ("local", 8215, 7920, 41),
        ("tiny_raw", 533, 480, 6),
    ],
)
def test_meshes_are_those_of_the_runs(reference_folder, name, n_nodes, n_elements, n_states):
    with open_plot(reference_folder / f"{name}.xplt") as plot:
        mesh = plot.mesh
        assert (mesh.coordinates.shape, mesh.n_elements, plot.n_states) == (
            (n_nodes, 3),
            n_elements,
            n_states,
        )
        assert [domain.name for domain in mesh.domains[:3]] == ["LumenCore", "Lumen", "WallHealthy"]
        assert [surface.name for surface in mesh.surfaces] == ["Inlet", "Outlet", "Interface"]
        assert mesh.domains[0].element_type.name == "penta6"
        assert {domain.part_name for domain in mesh.domains} <= {"Blood", "Healthy", "Calcified"}
        element_ids = np.concatenate([domain.element_ids for domain in mesh.domains])
        assert_array_equal(np.sort(element_ids), np.arange(1, n_elements + 1))
        for surface in mesh.surfaces:
            facet_set = next(item for item in mesh.facet_sets if item.name == surface.name)
            assert_array_equal(surface.nodes, facet_set.nodes)


def test_compressed_and_raw_runs_of_one_model_agree(reference_folder):
    with (
        open_plot(reference_folder / "tiny_raw.xplt") as raw,
        open_plot(reference_folder / "tiny_zlib.xplt") as zlib,
    ):
        assert_array_equal(raw.times, zlib.times)
        assert_array_equal(raw.mesh.coordinates, zlib.mesh.coordinates)
        for state in range(raw.n_states):
            assert_allclose(
                raw.field("displacement", state), zlib.field("displacement", state), rtol=1e-5, atol=1e-12
            )


def test_flow_rates_of_two_surfaces_under_one_name(reference_folder):
    with open_plot(reference_folder / "local.xplt") as plot:
        names = [variable.name for variable in plot.variables]
        assert names.count("fluid flow rate") == 2
        inlet, outlet = (plot.field("fluid flow rate", 20, name) for name in ("Inlet", "Outlet"))
        assert inlet.shape == outlet.shape == ()
        assert inlet < 0 < outlet


@pytest.mark.parametrize("name", NAMES)
def test_axis_nodes_have_the_values_febio_recorded(reference_folder, shared_data, name):
    times, tables = read_records(shared_data / "febio" / f"{name}_axis_nodes.txt")
    with open_plot(reference_folder / f"{name}.xplt") as plot:
        mesh = plot.mesh
        for state, time in enumerate(plot.times):
            step = int(np.argmin(abs(times - time)))
            assert abs(times[step] - time) <= 1e-6 * max(time, 1)
            nodes = np.searchsorted(mesh.node_ids, tables[step][:, 0].astype(int))
            assert_array_equal(mesh.node_ids[nodes], tables[step][:, 0])
            position = mesh.coordinates + plot.field("displacement", state)
            assert_allclose(position[nodes], tables[step][:, 1:4], rtol=1e-6, atol=1e-9)
            velocity = plot.field("nodal fluid velocity", state)
            assert_allclose(velocity[nodes], tables[step][:, 4:7], rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_mid_elements_have_the_values_febio_recorded(reference_folder, shared_data, name):
    times, tables = read_records(shared_data / "febio" / f"{name}_mid_elements.txt")
    with open_plot(reference_folder / f"{name}.xplt") as plot:
        if "fluid pressure" not in {variable.name for variable in plot.variables}:
            pytest.skip("the run has no plot variable to compare")
        domains = plot.mesh.domains
        for state, time in enumerate(plot.times):
            step = int(np.argmin(abs(times - time)))
            wanted = tables[step][:, 0].astype(int)
            pressure = {}
            for region in plot.regions("fluid pressure", state):
                ids = domains[region - 1].element_ids.tolist()
                pressure |= dict(zip(ids, plot.field("fluid pressure", state, region).tolist(), strict=True))
            assert_allclose([pressure[number] for number in wanted], tables[step][:, 4], rtol=1e-6, atol=1e-3)
