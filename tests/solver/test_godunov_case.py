"""A case file's `scheme: godunov`, from the case to the dataset."""

import numpy as np
import pytest

from cases.case_file import load_case_file
from solver.case_run import run_case
from solver.errors import ModelError

PARTS = {
    "wall": "{law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}",
    "calcification": "{pattern: none}",
    "inlet": "{kind: velocity, waveform: inlet.csv}",
    "outlet": "{kind: resistance, resistance: 5.7817e9 Pa s/m^3, offset: 7205.2 Pa, flow: row}",
    "solver": "{scheme: godunov, n_x: 30, n_phi: 4, time_step: 20 us, cycles: 1, closure: average}",
}
IMPLICIT = "{scheme: semi_implicit, n_x: 30, n_phi: 4, time_step: 0.5 ms, cycles: 1, closure: average}"
SHARP = "{pattern: axisymmetric, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], transition: sharp}"


@pytest.fixture
def case(tmp_path):
    def load(**changes):
        lines = [
            "name: one",
            "geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}",
            "blood: {density: 1060 kg/m^3, viscosity: 0.003 Pa s}",
            *(f"{key}: {value}" for key, value in (PARTS | changes).items()),
        ]
        (tmp_path / "inlet.csv").write_text("t_s,mean_velocity_cm_s\n0,8\n0.05,20\n0.15,12\n0.2,8\n")
        (tmp_path / "one.yaml").write_text("\n".join(lines))
        return load_case_file(tmp_path / "one.yaml").variants["base"]

    return load


def test_both_schemes_agree_without_calcification(case):
    times = np.linspace(0.0, 0.2, 11)
    explicit, implicit = run_case(case(), times), run_case(case(solver=IMPLICIT), times)
    assert explicit.attrs["scheme"] == "godunov"
    assert 0.1 < float(explicit["courant_number"].max()) < 1.0
    for name, share in (("section_flow_rate", 2e-3), ("pressure", 2e-3), ("radius", 1e-4)):
        difference = np.abs(explicit[name].to_numpy() - implicit[name].to_numpy())
        assert np.max(difference) < share * np.max(implicit[name].to_numpy()), name
    np.testing.assert_allclose(explicit["profile_exponent"], 2.0, rtol=1e-9)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"calcification": SHARP}, "smooth calcification"),
        ({"inlet": "{kind: flow, value: 2 cm^3/s}"}, "inlet of kind velocity or pressure"),
        ({"outlet": "{kind: pressure, value: 10 kPa}"}, "outlet of kind resistance or non_reflecting"),
    ],
)
def test_what_the_scheme_lacks_is_refused(case, changes, said):
    with pytest.raises(ModelError, match=said):
        run_case(case(**changes), [0.0, 0.1])
