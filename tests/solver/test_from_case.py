"""From a case to the model that the solver runs."""

import numpy as np
import pytest
from thesis_artery import HEALTHY, REFERENCE_DATA, thesis_waveform

from cases.reading.case_file import load_case_file
from solver.case.model import calcified_cells, default_output_times, model_of
from solver.errors import ModelError


@pytest.fixture
def variant_of(case_file):
    def load(name, *replacements):
        text = case_file.read_text()
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        case_file.write_text(text)
        return load_case_file(case_file).variants[name]

    return load


def test_the_model_holds_what_the_case_states(variant_of):
    model = model_of(variant_of("healthy"))
    assert (model.grid.length, model.grid.n_x, model.grid.n_phi) == (pytest.approx(15e-3), 12, 8)
    assert model.radius == pytest.approx(2.5e-3)
    assert (model.density, model.viscosity, model.reference_pressure) == (1060, pytest.approx(0.003), 0)
    assert (model.outlet.resistance, model.outlet.offset, model.outlet.flow) == (1.358e9, 9330, "section")
    np.testing.assert_allclose(model.stiffness, HEALTHY)
    assert model.inlet.signal.period == pytest.approx(0.2)
    assert model.inlet.signal(0.05) == pytest.approx(0.2)


def test_the_wall_law_is_the_cases(variant_of):
    thick = model_of(
        variant_of("healthy", ("law: thin", "law: thick"), ("poisson_ratio: 0.5", "poisson_ratio: 0.48"))
    )
    np.testing.assert_allclose(thick.stiffness, 301, atol=0.5)


def test_a_sharp_patch(variant_of):
    case = variant_of("patch")
    calcified = calcified_cells(case)
    assert np.argwhere(calcified).tolist() == [[i, j] for i in range(4, 8) for j in (3, 4)]
    np.testing.assert_allclose(model_of(case).stiffness, np.where(calcified, 20000 / 3, HEALTHY))
    assert not np.any(calcified_cells(variant_of("healthy")))


def test_smooth_edges_keep_the_patch_and_widen_its_stiffness(variant_of):
    sharp = variant_of("patch")
    smooth = variant_of("patch", ("transition: sharp", "transition: {x: 2.5 mm, phi: 67.5 deg}"))
    np.testing.assert_array_equal(calcified_cells(smooth), calcified_cells(sharp))
    assert np.all(model_of(smooth).stiffness >= model_of(sharp).stiffness * (1 - 1e-12))
    between = (model_of(smooth).stiffness > 1.01 * HEALTHY) & ~calcified_cells(smooth)
    assert np.sum(between) > 8


PATCH = (
    "{pattern: local, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], phi: [135 deg, 225 deg], transition: sharp}"
)
RING = "{pattern: axisymmetric, youngs_modulus: 3 MPa, x: [7.5 mm, 12.5 mm], transition: sharp}"
SOFT = "{pattern: axisymmetric, youngs_modulus: 0.5 MPa, x: [0 mm, 15 mm], transition: {x: 1 mm}}"


def test_several_patches(variant_of):
    patch = model_of(variant_of("patch")).stiffness
    several = f"{{pattern: several, patches: [{PATCH}, {RING}, {SOFT}]}}"
    case = variant_of("patch", (PATCH, several))
    wanted = np.where(patch > 2 * HEALTHY, patch, np.full(patch.shape, HEALTHY) * 5 / 6)
    ring = np.zeros((12, 8), dtype=bool)
    ring[6:10] = True
    wanted[ring & (patch < 2 * HEALTHY)] = 5 * HEALTHY
    np.testing.assert_allclose(model_of(case).stiffness, wanted, rtol=1e-12)
    assert np.all(calcified_cells(case))


def test_a_patch_between_cell_centres_is_refused(variant_of):
    case = variant_of("patch", ("[135 deg, 225 deg]", "[158 deg, 202 deg]"))
    with pytest.raises(ModelError, match=r"the local one from x = 0.005 m holds no centre .* 12 x 8"):
        model_of(case)


def test_one_of_several_patches_is_that_patch(variant_of):
    single = variant_of("patch")
    listed = variant_of("patch", (PATCH, f"{{pattern: several, patches: [{PATCH}]}}"))
    np.testing.assert_array_equal(model_of(listed).stiffness, model_of(single).stiffness)
    np.testing.assert_array_equal(calcified_cells(listed), calcified_cells(single))


def test_a_constant_inlet(variant_of):
    case = variant_of("healthy", ("waveform: inlet.csv", "value: 10 cm/s, period: 0.8 s"))
    model = model_of(case)
    assert model.inlet.signal.period == pytest.approx(0.8)
    np.testing.assert_allclose(model.inlet.signal(np.linspace(0, 2, 9)), 0.1)


def test_output_times(variant_of):
    times = default_output_times(variant_of("healthy"))
    np.testing.assert_allclose(times, np.linspace(0, 0.4, 21), atol=1e-15)
    uneven = default_output_times(variant_of("healthy", ("output_interval: 20 ms", "output_interval: 30 ms")))
    assert uneven[-2:] == pytest.approx([0.39, 0.4])
    usual = default_output_times(variant_of("healthy", (",\n  output_interval: 30 ms", "")))
    np.testing.assert_allclose(usual, np.linspace(0, 0.4, 201), atol=1e-12)


def test_the_shipped_case_is_runnable():
    shipped = load_case_file(REFERENCE_DATA.parent / "cases" / "calcification.yaml")
    for case in shipped.variants.values():
        model = model_of(case)
        assert model.stiffness.shape == (120, 48)
        np.testing.assert_allclose(model.inlet.signal(0.2), thesis_waveform()(0.2))
    assert calcified_cells(shipped.variants["local"]).sum() == 40 * 12
    assert calcified_cells(shipped.variants["axisymmetric"]).sum() == 40 * 48
