"""A(P) and dA/dP of the wall (numba kernels)."""

from cases.arrays import Floats
from solver.schemes.layout import BEYOND_WALL_TABLE, OK, WALL_COLLAPSE, Parameters
from solver.schemes.vectorisation import kernel


@kernel
def _linear(
    pressure: Floats, compliance: Floats, radius: float, reference: float, area: Floats, slope: Floats
) -> bool:
    """R = R₀ + (P − P₀) dR/dP, A = R², dA/dP = 2R dR/dP; whether dA/dP is positive everywhere."""
    P, per_load, A, dA_dP = pressure.flat, compliance.flat, area.flat, slope.flat
    count = 0
    for k in range(pressure.size):
        deformed = radius + (P[k] - reference) * per_load[k]
        A[k] = deformed * deformed
        dA_dP[k] = 2.0 * deformed * per_load[k]
        count += bool(dA_dP[k] > 0.0)
    return count == slope.size


@kernel
def tabulated_area(
    pressure: Floats, table: Floats, start: float, step: float, area: Floats, slope: Floats
) -> tuple[int, int, int]:
    """Find A and dA/dP of a tabulated wall by cubic Hermite interpolation; OK or BEYOND_WALL_TABLE, i, j."""
    last = table.shape[2] - 2
    for i in range(pressure.shape[0]):
        for j in range(pressure.shape[1]):
            position = (pressure[i, j] - start) / step
            if not 0.0 <= position <= last + 1.0:
                return BEYOND_WALL_TABLE, i, j
            k = min(int(position), last)
            t = position - k
            r0, r1 = table[i, j, k, 0], table[i, j, k + 1, 0]
            d0, d1 = step * table[i, j, k, 1], step * table[i, j, k + 1, 1]
            curve = 3.0 * (r1 - r0) - 2.0 * d0 - d1
            twist = d0 + d1 - 2.0 * (r1 - r0)
            radius = r0 + t * (d0 + t * (curve + t * twist))
            area[i, j] = radius * radius
            slope[i, j] = 2.0 * radius * (d0 + t * (2.0 * curve + 3.0 * t * twist)) / step
    return OK, 0, 0


@kernel
def _collapsed(slope: Floats) -> tuple[int, int, int]:
    """WALL_COLLAPSE and the first cell where dA/dP is not positive, or OK."""
    for i in range(slope.shape[0]):
        for j in range(slope.shape[1]):
            if not slope[i, j] > 0.0:
                return WALL_COLLAPSE, i, j
    return OK, 0, 0


@kernel
def wall_area(
    p: Parameters, first: int, pressure: Floats, area: Floats, slope: Floats
) -> tuple[int, int, int]:
    """Apply the wall law of the columns from ``first`` on to pressures (columns, n_phi).

    Returns
    -------
    status, i, j : int
        OK, or WALL_COLLAPSE or BEYOND_WALL_TABLE and the cell.
    """
    end = first + pressure.shape[0]
    if p.table.shape[2] > 0:
        table = p.table[first:end]
        status, i, j = tabulated_area(pressure, table, p.table_start, p.table_step, area, slope)
        if status != OK:
            return status, first + i, j
    elif _linear(pressure, p.compliance[first:end], p.radius, p.reference_pressure, area, slope):
        return OK, 0, 0
    status, i, j = _collapsed(slope)
    return status, first + i, j
