"""Models written from the ready case, beside those that the ready FEBio runs were made from."""

from pathlib import Path

import numpy as np
import pytest
from feb_contents import Parsed
from numpy.testing import assert_allclose

from cases.reading.case_file import load_case_file
from febio_io.feb.command import main
from febio_io.feb.structure import read_structure

ROOT = Path(__file__).parents[2]
READY = ROOT / "cases/calcification.yaml"


@pytest.fixture(scope="module", params=["none", "axisymmetric", "local"])
def pair(request, shared_data, tmp_path_factory):
    """The model of a variant, and that of its run."""
    path = tmp_path_factory.mktemp("models") / f"{request.param}.feb"
    assert main([str(READY), "--variant", request.param, "--output", str(path), "--data-records"]) == 0
    return Parsed(path), Parsed(shared_data / "febio" / path.name)


def test_the_mesh_is_the_same_node_for_node(pair):
    ours, theirs = pair
    assert set(ours.places.values()) == set(theirs.places.values())
    assert len(ours.places) == len(theirs.places) == 8215
    assert ours.elements() == theirs.elements()
    assert ours.domain_names() == theirs.domain_names()


def test_surfaces_and_node_sets_are_the_same(pair):
    ours, theirs = pair
    assert ours.facets() == theirs.facets()
    assert set(ours.sets.values()) == set(theirs.sets.values())


def test_materials_conditions_and_control_are_the_same(pair):
    ours, theirs = pair
    used = {material for material, _ in theirs.elements()}
    assert ours.materials() == {name: item for name, item in theirs.materials().items() if name in used}
    assert ours.conditions() == theirs.conditions()
    here, there = ours.control(), theirs.control()
    assert set(here) == set(there)
    for name, value in there.items():  # the period of the waveform is given to 1e-5 s
        assert here[name] == (pytest.approx(value, rel=1e-5) if isinstance(value, float) else value)


def test_load_curves_are_the_same(pair):
    ours, theirs = (model.curves() for model in pair)
    assert set(ours) == set(theirs) == {"1", "2"}
    for number in ("1", "2"):
        assert ours[number].shape == theirs[number].shape
        assert_allclose(ours[number][:, 0], theirs[number][:, 0], atol=1e-5)  # the period is given to 1e-5 s
        assert_allclose(ours[number][:, 1], theirs[number][:, 1], atol=2e-6)


def test_output_is_the_same(pair):
    ours, theirs = (model.output() for model in pair)
    assert ours == theirs


def test_both_have_the_structure_of_the_specification(shared_data, tmp_path):
    path = tmp_path / "local.feb"
    assert main([str(READY), "--variant", "local", "--output", str(path)]) == 0
    ours, theirs = read_structure(path), read_structure(shared_data / "febio" / "local.feb")
    assert (ours.nodes, ours.elements, ours.domains) == (theirs.nodes, theirs.elements, theirs.domains)
    assert ours.n_steps == theirs.n_steps
    assert ours.end == pytest.approx(theirs.end, rel=1e-5)


def test_the_same_case_gives_the_same_bytes(tmp_path):
    for name in ("a.feb", "b.feb"):
        assert main([str(READY), "--variant", "none", "--output", str(tmp_path / name)]) == 0
    assert (tmp_path / "a.feb").read_bytes() == (tmp_path / "b.feb").read_bytes()


def test_the_inflow_is_the_cases_waveform(tmp_path):
    path = tmp_path / "none.feb"
    assert main([str(READY), "--variant", "none", "--output", str(path), "--cycles", "1"]) == 0
    curve = Parsed(path).curves()["1"]
    case = load_case_file(READY).variants["none"]
    offset, waveform = case.reference.time_offset, case.inlet.waveform
    assert curve[0].tolist() == [0, 0]
    assert curve[-1, 0] == pytest.approx(offset + waveform.period)
    found = np.interp(offset + waveform.times, *curve.T)
    assert_allclose(found, waveform.values, rtol=2e-3)


def test_a_scaled_inlet_scales_the_inflow_of_the_model(tmp_path):
    text = READY.read_text(encoding="utf-8")
    scaled = tmp_path / "scaled.yaml"
    folder = READY.parents[1].as_posix()
    text = text.replace("{kind: velocity, ", "{kind: velocity, scale: 1.5, ")
    scaled.write_text(text.replace("reference_data/", f"{folder}/reference_data/"), encoding="utf-8")
    curves = []
    for case in (READY, scaled):
        path = tmp_path / f"{case.stem}.feb"
        assert main([str(case), "--variant", "none", "--output", str(path), "--cycles", "1"]) == 0
        curves.append(Parsed(path).curves()["1"])
    assert_allclose(curves[1], curves[0] * [1.0, 1.5], rtol=1e-6)
