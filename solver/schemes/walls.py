"""A(P) and dA/dP of the wall, row by row (numba kernels)."""

from numba import njit

from solver.schemes.layout import BEYOND_WALL_TABLE, OK, WALL_COLLAPSE, Array, Parameters


@njit(cache=True, nogil=True, error_model="numpy")
def _linear(pressure: Array, compliance: Array, p: Parameters, area: Array, slope: Array) -> None:
    """R = R₀ + (P − P₀) dR/dP, A = R², dA/dP = 2R dR/dP."""
    for j in range(pressure.size):
        radius = p.radius + (pressure[j] - p.reference_pressure) * compliance[j]
        area[j] = radius * radius
        slope[j] = 2.0 * radius * compliance[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _tabulated(pressure: Array, table: Array, start: float, step: float, area: Array, slope: Array) -> int:
    """R by cubic Hermite interpolation of the table; first row beyond the table, or −1."""
    last = table.shape[1] - 2
    for j in range(pressure.size):
        position = (pressure[j] - start) / step
        if not 0.0 <= position <= last + 1.0:
            return j
        k = min(int(position), last)
        t = position - k
        r0, r1 = table[j, k, 0], table[j, k + 1, 0]
        d0, d1 = step * table[j, k, 1], step * table[j, k + 1, 1]
        curve = 3.0 * (r1 - r0) - 2.0 * d0 - d1
        twist = d0 + d1 - 2.0 * (r1 - r0)
        radius = r0 + t * (d0 + t * (curve + t * twist))
        area[j] = radius * radius
        slope[j] = 2.0 * radius * (d0 + t * (2.0 * curve + 3.0 * t * twist)) / step
    return -1


@njit(cache=True, nogil=True, error_model="numpy")
def _first_not_positive(values: Array) -> int:
    """First entry that is not above 0, or −1."""
    count = 0
    for j in range(values.size):
        count += values[j] > 0.0
    if count == values.size:
        return -1
    for j in range(values.size):
        if not values[j] > 0.0:
            return j
    return -1


@njit(cache=True, nogil=True, error_model="numpy")
def wall_row(p: Parameters, i: int, pressure: Array, area: Array, slope: Array) -> tuple[int, int]:
    """Apply the wall law of cells (i, ·) to a row of pressures.

    Returns
    -------
    status, j : int
        OK, or WALL_COLLAPSE or BEYOND_WALL_TABLE and the row.
    """
    if p.table.shape[2] > 0:
        j = _tabulated(pressure, p.table[i], p.table_start, p.table_step, area, slope)
        if j >= 0:
            return BEYOND_WALL_TABLE, j
    else:
        _linear(pressure, p.compliance[i], p, area, slope)
    j = _first_not_positive(slope)
    if j >= 0:
        return WALL_COLLAPSE, j
    return OK, 0


@njit(cache=True, nogil=True, error_model="numpy")
def wall_area(p: Parameters, pressure: Array, area: Array, slope: Array) -> tuple[int, int, int]:
    """Apply the wall law to pressures (n_x, n_phi); status, i, j as :func:`wall_row`."""
    for i in range(pressure.shape[0]):
        status, j = wall_row(p, i, pressure[i], area[i], slope[i])
        if status != OK:
            return status, i, j
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def tabulated_area(
    pressure: Array, table: Array, start: float, step: float, area: Array, slope: Array
) -> tuple[int, int, int]:
    """Find A and dA/dP of a tabulated wall at pressures (n_x, n_phi); OK or BEYOND_WALL_TABLE, i, j."""
    for i in range(pressure.shape[0]):
        j = _tabulated(pressure[i], table[i], start, step, area[i], slope[i])
        if j >= 0:
            return BEYOND_WALL_TABLE, i, j
    return OK, 0, 0
