"""Boundary columns of the Godunov scheme: compatibility conditions closed by the ends' laws.

The characteristic that leaves the artery is advanced from the values before the step with the end's own
λ±, differenced towards its neighbouring cell (the thesis prints the opposite difference in (2.2.49) and
(2.2.50), with which the update is unstable).
"""

import math

from solver.schemes.godunov.layout import (
    FLOW_INLET,
    NON_REFLECTING,
    PRESSURE_INLET,
    SECTION_RESISTANCE,
    WINDKESSEL,
    Fields,
    Parameters,
    Workspace,
)
from solver.schemes.godunov.sources import momentum_source
from solver.schemes.godunov.steady import section_flow
from solver.schemes.vectorisation import exact_kernel, exact_part_of_kernel

FLOW_PRECISION = 1e-14  # relative, of the velocity that belongs to a flow rate
MOST_ITERATIONS = 30


@exact_part_of_kernel
def source_at(fields: Fields, work: Workspace, parameters: Parameters, k: int) -> float:
    """s^x at the flat place ``k``."""
    return momentum_source(
        fields.area[k],
        fields.flow[k],
        fields.exponent[k],
        fields.root[k],
        fields.inverse_root[k],
        fields.stiffness_slope[k],
        work.exponent_slope[k],
        parameters,
    )


@exact_kernel
def advance_inlet(
    fields: Fields, work: Workspace, parameters: Parameters, width: int, prescribed: float
) -> None:
    """Advance A and Q on the inlet.

    ``prescribed`` is the velocity (m/s), pressure (Pa) or flow rate (m³/s) after the step.
    """
    courant = 2.0 * parameters.dt / parameters.dx
    excess = prescribed - parameters.reference_pressure
    for k in range(width):
        A, Q = fields.area[k], fields.flow[k]
        slow, fast = work.slow_speed[k], work.fast_speed[k]
        moved_A = A - slow * courant * (fields.area[width + k] - A)
        moved_Q = Q - slow * courant * (fields.flow[width + k] - Q)
        source = parameters.dt * source_at(fields, work, parameters, k)
        characteristic = fast * moved_A - moved_Q - source
        if parameters.inlet == PRESSURE_INLET:
            root = parameters.radius + excess * parameters.radius**2 / fields.stiffness[k]
            fields.area[k] = root * root
            fields.flow[k] = fast * fields.area[k] - characteristic
        else:  # kept in Q until the inlet's velocity closes it
            fields.flow[k] = characteristic
    if parameters.inlet == PRESSURE_INLET:
        return
    velocity = prescribed
    if parameters.inlet == FLOW_INLET:
        velocity = velocity_of_flow(fields, work, parameters, prescribed)
    for k in range(width):
        fields.area[k] = fields.flow[k] / (work.fast_speed[k] - velocity)
        fields.flow[k] = velocity * fields.area[k]


@exact_kernel
def velocity_of_flow(fields: Fields, work: Workspace, parameters: Parameters, flow_rate: float) -> float:
    """One velocity v of all rows with ½Δφ Σ v c/(λ₊ − v) = q, c the rows' characteristics in Q; by Newton."""
    first, sector, velocity = parameters.ghosts, 0.5 * parameters.dphi, 0.0
    for _ in range(MOST_ITERATIONS):
        total = slope = 0.0
        for k in range(first, first + parameters.n_phi):
            gap = work.fast_speed[k] - velocity
            total += sector * velocity * fields.flow[k] / gap
            slope += sector * work.fast_speed[k] * fields.flow[k] / (gap * gap)
        change = (flow_rate - total) / slope
        velocity += change
        if abs(change) <= FLOW_PRECISION * abs(velocity):
            break
    return velocity


@exact_kernel
def advance_outlet(
    fields: Fields, work: Workspace, parameters: Parameters, width: int, offset: float
) -> None:
    """Advance A and Q on the outlet; ``offset`` is P_res (Pa) after the step."""
    begin, face = (parameters.columns - 1) * width, (parameters.columns - 2) * width
    courant = 2.0 * parameters.dt / parameters.dx
    old = section_flow(fields, parameters, parameters.columns - 1)
    for k in range(width):
        b, c, f = begin + k, face + k, face + k
        slow, fast = work.slow_speed[f], work.fast_speed[f]
        jump_A, jump_Q = fields.area[b] - fields.area[c], fields.flow[b] - fields.flow[c]
        source = parameters.dt * source_at(fields, work, parameters, b)
        if parameters.outlet == NON_REFLECTING:
            change = fast * courant / (fast - slow) * (slow * jump_A - jump_Q)
            fields.area[b] += change
            fields.flow[b] += fast * change + source
        else:
            moved_A = fields.area[b] - fast * courant * jump_A
            moved_Q = fields.flow[b] - fast * courant * jump_Q
            # what the outlet law needs of the row: its characteristic, kept in Q until the law closes it
            fields.flow[b] = slow * moved_A - moved_Q - source
    if parameters.outlet == WINDKESSEL:
        close_windkessel(fields, work, parameters, width, old)
    elif parameters.outlet == SECTION_RESISTANCE:
        close_section(fields, work, parameters, width, offset, parameters.resistance)
    elif parameters.outlet != NON_REFLECTING:
        close_rows(fields, work, parameters, width, offset)


@exact_kernel
def close_rows(fields: Fields, work: Workspace, parameters: Parameters, width: int, offset: float) -> None:
    """P = P_res + R_res Q in every row: λ₋a₂Q² + (λ₋b₂ − 1)Q + λ₋c₂ − c₁ = 0 (2.2.50–51)."""
    begin, face = (parameters.columns - 1) * width, (parameters.columns - 2) * width
    for k in range(width):
        b, slow = begin + k, work.slow_speed[face + k]
        characteristic = fields.flow[b]
        compliance = parameters.radius**2 / fields.stiffness[b]
        root = parameters.radius + (offset - parameters.reference_pressure) * compliance
        widening = parameters.resistance * compliance
        linear = 1.0 - 2.0 * slow * widening * root
        constant = slow * root * root - characteristic
        discriminant = linear * linear - 4.0 * slow * widening * widening * constant
        fields.flow[b] = 2.0 * constant / (linear + math.sqrt(discriminant))
        fields.area[b] = (root + widening * fields.flow[b]) ** 2


@exact_kernel
def close_windkessel(
    fields: Fields, work: Workspace, parameters: Parameters, width: int, old_flow: float
) -> None:
    """P = P_c + R₁q, C dP_c/dt = q − (P_c − P_v)/R₂ by the trapezoidal rule; ``old_flow`` is q before."""
    gain = 0.5 * parameters.dt / parameters.capacitance
    leak = gain / parameters.distal_resistance
    held = fields.reservoir[0] * (1.0 - leak) + gain * old_flow + 2.0 * leak * parameters.venous_pressure
    held /= 1.0 + leak
    resistance = parameters.resistance + gain / (1.0 + leak)
    close_section(fields, work, parameters, width, held, resistance)
    new_flow = section_flow(fields, parameters, parameters.columns - 1)
    fields.reservoir[0] = held + (resistance - parameters.resistance) * new_flow


@exact_kernel
def close_section(
    fields: Fields, work: Workspace, parameters: Parameters, width: int, offset: float, resistance: float
) -> None:
    """P = P_res + R_res q with one outlet pressure and the section's q = ½Δφ ΣQ.

    Each row gives Q = λ₋(R₀ + (P−P₀)R₀²/β)² − c₁, so the law is one quadratic in P.
    """
    begin, face = (parameters.columns - 1) * width, (parameters.columns - 2) * width
    first = parameters.ghosts
    square = linear = constant = 0.0
    for k in range(first, first + parameters.n_phi):
        b, slow = begin + k, work.slow_speed[face + k]
        compliance = parameters.radius**2 / fields.stiffness[b]
        root = parameters.radius - parameters.reference_pressure * compliance
        square += slow * compliance * compliance
        linear += 2.0 * slow * compliance * root
        constant += slow * root * root - fields.flow[b]
    row_share = 0.5 * parameters.dphi * resistance
    b_, c_ = 1.0 - row_share * linear, offset + row_share * constant
    pressure = 2.0 * c_ / (b_ + math.sqrt(b_ * b_ - 4.0 * row_share * square * c_))
    for k in range(width):
        b = begin + k
        root = parameters.radius + (pressure - parameters.reference_pressure) * (
            parameters.radius**2 / fields.stiffness[b]
        )
        fields.area[b] = root * root
        fields.flow[b] = work.slow_speed[face + k] * fields.area[b] - fields.flow[b]
