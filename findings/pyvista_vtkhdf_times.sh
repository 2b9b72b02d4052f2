#!/usr/bin/env bash
# pyvista 0.49.1 with VTK 9.7.2: of a VTKHDF file with time steps pyvista reads the first one only, and cannot be told another.
#
# VTKHDF (2.0 on) holds a whole transient run in one file. pyvista.get_reader gives EnSight, OpenFOAM, Exodus and PVD files a
# reader with time_values and set_active_time_value; its HDFReader has neither, and pyvista.read says nothing of the other steps.
# The vtkHDFReader below it can: UpdateInformation, TIME_STEPS, UpdateTimeStep.
# Seen (2026-11): "steps in the file: [0.0, 1.0, 2.0]; pyvista reads: 10.0; can choose: False; VTK at time 2: 12.0".
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet "pyvista==0.49.1" "vtk==9.7.2"
cd "$folder"
cat > show.py <<'PY'
import sys

import numpy as np
import pyvista as pv
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkIOHDF import vtkHDFWriter

TIMES = [0.0, 1.0, 2.0]


class Source(VTKPythonAlgorithmBase):
    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), TIMES, len(TIMES))
        information.Set(Pipeline.TIME_RANGE(), [TIMES[0], TIMES[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        key = Pipeline.UPDATE_TIME_STEP()
        time = information.Get(key) if information.Has(key) else 0.0
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        grid = pv.UnstructuredGrid(np.array([4, 0, 1, 2, 3]), np.array([10], np.uint8), points)
        grid.point_data["p"] = np.full(4, 10.0 + time)
        output = self.GetOutputData(outputs, 0)
        output.ShallowCopy(grid)
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1


source = Source()
writer = vtkHDFWriter()
writer.SetInputConnection(source.GetOutputPort())
writer.SetFileName("run.vtkhdf")
writer.SetWriteAllTimeSteps(True)
writer.Write()

reader = pv.get_reader("run.vtkhdf")
first = float(reader.read().point_data["p"][0])
chooses = hasattr(reader, "set_active_time_value")
below = pv.get_reader("run.vtkhdf").reader
below.UpdateInformation()
steps = list(below.GetOutputInformation(0).Get(Pipeline.TIME_STEPS()))
below.UpdateTimeStep(steps[2])
third = float(pv.wrap(below.GetOutputDataObject(0)).point_data["p"][0])
print(f"steps in the file: {steps}; pyvista reads: {first}; can choose: {chooses}; VTK at time 2: {third}")
sys.exit(0 if (steps, first, chooses, third) == (TIMES, 10.0, False, 12.0) else 1)
PY
"$folder/venv/bin/python" show.py
