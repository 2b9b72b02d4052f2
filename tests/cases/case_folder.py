"""A small case file with the files it names, for tests to edit."""

from pathlib import Path

import pytest

from cases.errors import CaseFileError
from cases.reading.case_file import CaseFile, load_case_file

WAVEFORM = """\
# one cycle
t_s,mean_velocity_cm_s
0.0,10.0
0.3,20.0
0.8,10.0
"""

FLOW = """\
t_ms,flow_rate_mL_min
0,300
300,600
800,300
"""

PRESSURE = """\
t_s,pressure_mmHg
0.0,80
0.3,120
0.8,80
"""

SHORT_PRESSURE = PRESSURE.replace("0.8,", "0.7,")

WALL = """\
radius_mm,pressure_kPa
2.0,-5
2.4,0
2.6,4
3.0,20
"""

BASE = """\
name: artery
title: An artery
geometry:
  length: 15 mm
  radius: 2.5 mm
  wall_thickness: 0.5 mm
blood: {density: 1060 kg/m^3, viscosity: 0.0035 Pa s}
wall: {law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}
calcification: {pattern: none}
inlet: {kind: velocity, waveform: data/inlet.csv}
outlet: {kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}
solver:
  scheme: semi_implicit
  n_x: 120
  n_phi: 48
  time_step: 1 ms
  cycles: 3
  closure: average
reference: {kind: febio, plot_file: data/run.xplt, axis: z}
compare:
  bands:
    - quantity: radius
      statistic: rms_error
      limit: 1 %
      reason: measured in another artery
variants:
  none:
  local:
    title: A patch
    calcification:
      pattern: local
      youngs_modulus: 10 MPa
      x: [5 mm, 10 mm]
      phi: [135 deg, 225 deg]
      transition: sharp
"""


class CaseFolder:
    """A folder with the base case; `load` applies edits to its text and loads it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        (path / "data").mkdir()
        (path / "data/inlet.csv").write_text(WAVEFORM)
        (path / "data/flow.csv").write_text(FLOW)
        (path / "data/pressure.csv").write_text(PRESSURE)
        (path / "data/short_pressure.csv").write_text(SHORT_PRESSURE)
        (path / "data/wall.csv").write_text(WALL)
        (path / "data/run.xplt").touch()

    def write(self, *edits: tuple[str, str]) -> Path:
        text = BASE
        for old, new in edits:
            assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the base case"
            text = text.replace(old, new)
        file = self.path / "x.yaml"
        file.write_text(text, encoding="utf-8")
        return file

    def load(self, *edits: tuple[str, str]) -> CaseFile:
        return load_case_file(self.write(*edits))

    def problems(self, *edits: tuple[str, str]) -> list[str]:
        """Return the message's lines without the folder."""
        with pytest.raises(CaseFileError) as caught:
            self.load(*edits)
        return str(caught.value).replace(f"{self.path}/", "").splitlines()

    def problems_of_text(self, text: str | bytes) -> list[str]:
        (self.path / "x.yaml").write_bytes(text if isinstance(text, bytes) else text.encode())
        with pytest.raises(CaseFileError) as caught:
            load_case_file(self.path / "x.yaml")
        return str(caught.value).replace(f"{self.path}/", "").splitlines()
