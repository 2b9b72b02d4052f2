#!/usr/bin/env bash
# meshio 5.3.5, XDMF 3 time series: a mesh that each step states anew is read as the first step's, without a word.
#
# XDMF lets every grid of a temporal collection hold its own Geometry, as FEniCS writes with rewrite_function_mesh and as
# moving meshes need. meshio.xdmf.TimeSeriesReader has one read_points_cells() for the whole series, which gives the first
# step's points; read_data(k) skips Geometry. Of two temporal collections in one file (two functions written by FEniCS)
# it takes the last. No warning in either case: a moving wall stands still, and a field is missing.
# Seen (2026-11): "points of step 2: z up to 1.0 (the file says 3.0)", "arrays of two collections: ['b']".
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet "meshio==5.3.5" "numpy==2.2.6"
cd "$folder"
cat > show.py <<'PY'
import sys

from meshio.xdmf import TimeSeriesReader

TOPOLOGY = '<Topology TopologyType="Tetrahedron" NumberOfElements="1"><DataItem Dimensions="1 4" NumberType="Int" Format="XML">0 1 2 3</DataItem></Topology>'


def step(time, top, name="a"):
    points = f"0 0 0 1 0 0 0 1 0 0 0 {top}"
    return (
        f'<Grid Name="mesh" GridType="Uniform">{TOPOLOGY}<Geometry GeometryType="XYZ"><DataItem Dimensions="4 3" '
        f'Format="XML">{points}</DataItem></Geometry><Time Value="{time}"/><Attribute Name="{name}" AttributeType="Scalar" '
        f'Center="Node"><DataItem Dimensions="4 1" Format="XML">1 2 3 4</DataItem></Attribute></Grid>'
    )


def series(name, *steps):
    return f'<Grid Name="{name}" GridType="Collection" CollectionType="Temporal">{"".join(steps)}</Grid>'


def write(path, *all_series):
    with open(path, "w") as stream:
        stream.write(f'<Xdmf Version="3.0"><Domain>{"".join(all_series)}</Domain></Xdmf>')


write("moving.xdmf", series("a", step(0.0, 1.0), step(1.0, 3.0)))
with TimeSeriesReader("moving.xdmf") as reader:
    points, _ = reader.read_points_cells()
    time, arrays, _ = reader.read_data(1)
top = float(points[:, 2].max())
print(f"points of step 2: z up to {top} (the file says 3.0)")

write("two.xdmf", series("a", step(0.0, 1.0, "a")), series("b", step(0.0, 1.0, "b")))
with TimeSeriesReader("two.xdmf") as reader:
    reader.read_points_cells()
    _, arrays, _ = reader.read_data(0)
print(f"arrays of two collections: {sorted(arrays)}")
sys.exit(0 if top == 1.0 and sorted(arrays) == ["b"] else 1)
PY
"$folder/venv/bin/python" -W error::UserWarning show.py
