"""Split explicit scheme on (x, φ): Godunov splitting, wave propagation with limited corrections.

The scheme of the thesis (2.2.42–57). One step of ∂_t q + H ∂_x q = s with ∂_φ[(γ+2)/γ Q/A] = 0:

    A  φ-sweep:     Q ← Q e^{hΔt}                                    :mod:`solver.schemes.godunov.exchange`
    B  x-sweep:     waves, limited corrections, sources, boundaries  :mod:`solver.schemes.godunov.waves`
    C  continuity:  γ = 2u/(D − u), D by a closure                   :mod:`solver.schemes.godunov.continuity`

Stable while the Courant number max|λ|Δt/Δx is at most 1. All arrays are float64 in SI.
"""

from cases.arrays import Floats
from solver.schemes.godunov.continuity import close_section_profiles
from solver.schemes.godunov.ends import advance_inlet, advance_outlet
from solver.schemes.godunov.exchange import exchange
from solver.schemes.godunov.layout import (
    FIXED,
    NO_ADMISSIBLE_PROFILE,
    OK,
    STEADY,
    WALL_COLLAPSE,
    Fields,
    Parameters,
    Ramp,
    Workspace,
    fill_ghosts,
)
from solver.schemes.godunov.sources import exponent_slopes, refresh, update
from solver.schemes.godunov.steady import Stopping, is_steady, remember, section_flow
from solver.schemes.godunov.waves import correct, decompose, decompose_end, uncorrected
from solver.schemes.vectorisation import exact_kernel


@exact_kernel
def sweep_x(
    fields: Fields, work: Workspace, parameters: Parameters, width: int, inlet: float, offset: float
) -> None:
    """Problem B: one x-sweep of all columns."""
    columns = parameters.columns
    stiffening = 0.5 / (parameters.density * parameters.radius**2)
    last = (columns - 2) * width  # the outlet's interface
    exponent_slopes(fields, work, columns, width, parameters.dx)
    decompose_end(fields, work, 0, width, 0, width, stiffening)
    decompose(fields, work, width, last, width, stiffening)
    decompose_end(fields, work, last + width, last, last, width, stiffening)
    uncorrected(work, 0, width)
    correct(work, width, last, width, parameters.dt / parameters.dx, parameters.limiter)
    uncorrected(work, last, last + width)
    if parameters.has_inlet:
        advance_inlet(fields, work, parameters, width, inlet)
    if parameters.has_outlet:
        advance_outlet(fields, work, parameters, width, offset)
    update(fields, work, parameters, width, last + width, width)


@exact_kernel
def close(fields: Fields, work: Workspace, parameters: Parameters, width: int) -> tuple[int, int, int]:
    """Problem C in every column; returns a status and the place (column, row) of a failure."""
    if refresh(fields, work):
        for k in range(fields.area.size):
            if not fields.area[k] > 0.0:
                return WALL_COLLAPSE, k // width, max(1, k % width + 1 - parameters.ghosts)
    if parameters.closure != FIXED:
        for i in range(parameters.columns):
            begin = i * width + parameters.ghosts
            u = work.velocity[begin : begin + parameters.n_phi]
            gamma = fields.exponent[begin : begin + parameters.n_phi]
            refused = close_section_profiles(u, gamma, parameters.closure)
            if refused:
                return NO_ADMISSIBLE_PROFILE, i, refused
    return OK, 0, 0


@exact_kernel
def set_wall(fields: Fields, ramp: Ramp, load: float) -> None:
    """β and ∂_xβ of a load between 0 and 1."""
    stiffness, slope = fields.stiffness, fields.stiffness_slope
    first, last = ramp.first, ramp.last
    first_slope, last_slope = ramp.first_slope, ramp.last_slope
    for k in range(stiffness.size):
        stiffness[k] = first[k] + load * (last[k] - first[k])
        slope[k] = first_slope[k] + load * (last_slope[k] - first_slope[k])


@exact_kernel
def step(
    fields: Fields, work: Workspace, parameters: Parameters, inlet: float, offset: float
) -> tuple[int, int, int]:
    """One time step; returns a status and, for a failure, its column and row."""
    width = parameters.n_phi + 2 * parameters.ghosts
    if parameters.ghosts:
        exchange(fields, parameters, work.velocity, 1, fields.area.size - 1)
        fill_ghosts(fields.flow, parameters.columns, parameters.n_phi)
    sweep_x(fields, work, parameters, width, inlet, offset)
    outcome = close(fields, work, parameters, width)
    if parameters.ghosts:
        fill_ghosts(fields.exponent, parameters.columns, parameters.n_phi)
    return outcome


@exact_kernel
def advance(
    fields: Fields,
    work: Workspace,
    parameters: Parameters,
    ramp: Ramp,
    stopping: Stopping,
    inlets: Floats,
    offsets: Floats,
    loads: Floats,
) -> tuple[int, int, int, int]:
    """One step per entry of ``inlets``, until one fails or the flow is steady.

    Parameters
    ----------
    fields, work, parameters, ramp, stopping : NamedTuple
        The first two are overwritten.
    inlets, offsets, loads : ndarray (n_steps,)
        After each step: inlet velocity (m/s) or pressure (Pa), P_res (Pa), load of the wall's ramp.

    Returns
    -------
    status, column, row, steps : int
        OK, a failure with its place, or STEADY; steps completed.
    """
    for n in range(inlets.size):
        if n == 0 or loads[n] != loads[n - 1]:
            set_wall(fields, ramp, loads[n])
        if stopping.active:
            remember(fields, work)
        status, column, row = step(fields, work, parameters, inlets[n], offsets[n])
        if status != OK:
            return status, column, row, n
        if parameters.has_inlet:
            work.passed[0] += section_flow(fields, parameters, 0)
        if parameters.has_outlet:
            work.passed[1] += section_flow(fields, parameters, parameters.columns - 1)
        if stopping.active and is_steady(fields, work, parameters, stopping):
            return STEADY, 0, 0, n + 1
    return OK, 0, 0, inlets.size
