"""A closed surface that moves, with values of its cells, as one VTKHDF file of polygonal data.

Written by h5py as the format's specification says (docs.vtk.org, "VTKHDF File Format", version 2.2): points
and cells' values of all times lie one after the other, the polygons stand once for all times.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats, Integers
from validation.errors import ValidationError

VERSION = (2, 2)
KINDS = ("Vertices", "Lines", "Polygons", "Strips")  # of cells, in the order of the format's columns


def write_surfaces(
    path: Path, times: Floats, polygons: Integers, points: Floats, values: Mapping[str, NDArray[Any]]
) -> None:
    """Write a moving surface for ParaView.

    Parameters
    ----------
    path : Path
        The file.
    times : ndarray (n_t,)
        Increasing.
    polygons : ndarray (n_cells, corners)
        Numbers of the points at each cell's corners, at all times.
    points : ndarray (n_t, n_points, 3)
        Stored in single precision.
    values : mapping of str to ndarray (n_t, n_cells) or (n_cells,)
        Of cells by name, of each time or of all, stored as they are.

    Raises
    ------
    ValidationError
        If the file cannot be written.
    """
    try:
        # in memory first: on a full disk HDF5 can neither write a file nor close it, and crashes
        with h5py.File(path.name, "w", driver="core", backing_store=False) as file:
            _write(file.create_group("VTKHDF"), times, polygons, points, values)
            file.flush()
            path.write_bytes(file.id.get_file_image())
    except OSError as error:
        raise ValidationError(f"{path.name}: cannot be written: {error.strerror or error}") from error


def _write(
    root: Any, times: Floats, polygons: Integers, points: Floats, values: Mapping[str, NDArray[Any]]
) -> None:
    count, cells = times.size, len(polygons)
    root.attrs["Version"] = np.array(VERSION, dtype=np.int64)
    root.attrs.create("Type", np.bytes_(b"PolyData"))
    root["NumberOfPoints"] = np.array([points.shape[1]])
    root["Points"] = points.reshape(-1, 3).astype(np.float32)
    for kind in KINDS:
        _write_cells(root.create_group(kind), polygons if kind == "Polygons" else polygons[:0])
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = count
    steps["Values"] = times
    steps["PartOffsets"] = np.zeros(count, dtype=np.int64)  # one part, the same at all times
    steps["NumberOfParts"] = np.ones(count, dtype=np.int64)
    steps["PointOffsets"] = np.arange(count) * points.shape[1]
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        steps[name] = np.zeros((count, len(KINDS)), dtype=np.int64)
    for name, of_cells in values.items():
        root[f"CellData/{name}"] = of_cells.ravel()
        moving = of_cells.ndim > 1
        steps[f"CellDataOffsets/{name}"] = np.arange(count) * cells if moving else np.zeros(count, int)


def _write_cells(group: Any, corners: Integers) -> None:
    group["NumberOfCells"] = np.array([len(corners)])
    group["NumberOfConnectivityIds"] = np.array([corners.size])
    group["Connectivity"] = corners.ravel().astype(np.int64)
    group["Offsets"] = np.arange(len(corners) + 1) * corners.shape[1]
