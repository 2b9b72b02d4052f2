import pytest

CASE = """\
name: short
title: A short artery
geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}
blood: {density: 1060 kg/m^3, viscosity: 0.003 Pa s}
wall: {law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}
calcification: {pattern: none}
inlet: {kind: velocity, waveform: inlet.csv}
outlet: {kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}
solver: {scheme: semi_implicit, n_x: 12, n_phi: 8, time_step: 2 ms, cycles: 2, closure: average,
  output_interval: 20 ms}
variants:
  healthy: {title: Healthy}
  patch:
    title: Patch
    calcification:
      {pattern: local, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], phi: [135 deg, 225 deg], transition: sharp}
"""
INLET = "t_s,mean_velocity_cm_s\n0,8\n0.05,20\n0.15,12\n0.2,8\n"


@pytest.fixture
def case_file(tmp_path):
    """Case file with two variants, beside its waveform."""
    (tmp_path / "inlet.csv").write_text(INLET)
    path = tmp_path / "short.yaml"
    path.write_text(CASE)
    return path
