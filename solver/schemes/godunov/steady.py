"""The thesis's criteria for a steady state, compared over one step."""

from typing import NamedTuple

from solver.schemes.godunov.layout import Fields, Parameters, Workspace
from solver.schemes.vectorisation import exact_kernel


class Stopping(NamedTuple):
    """Criteria that all must hold, (3.1.2)–(3.1.5), (3.3.3), (3.3.4); infinite where one does not apply.

    ``flow_change`` is of Q = uR² (m³/s), ``balance`` and ``rest`` of section flow rates ½ΣQΔφ (m³/s),
    the others are relative.
    """

    active: bool
    area_change: float
    flow_change: float
    end_flow_change: float
    balance: float
    rest: float


@exact_kernel
def section_flow(fields: Fields, parameters: Parameters, column: int) -> float:
    """½ΣQΔφ of one column, m³/s."""
    begin = column * (parameters.n_phi + 2 * parameters.ghosts) + parameters.ghosts
    total = 0.0
    for k in range(begin, begin + parameters.n_phi):
        total += fields.flow[k]
    return 0.5 * parameters.dphi * total


@exact_kernel
def remember(fields: Fields, work: Workspace) -> None:
    """Keep A and Q, to see by how much a step changes them."""
    for k in range(fields.area.size):
        work.area_before[k] = fields.area[k]
        work.flow_before[k] = fields.flow[k]


@exact_kernel
def largest_end_change(fields: Fields, work: Workspace, parameters: Parameters) -> float:
    """Largest relative change of Q on the inlet and the outlet."""
    width = parameters.n_phi + 2 * parameters.ghosts
    outlet, largest = (parameters.columns - 1) * width, 0.0
    for k in range(width):
        for place in (k, outlet + k):
            change = abs(fields.flow[place] - work.flow_before[place]) / abs(work.flow_before[place])
            largest = max(largest, change)
    return largest


@exact_kernel
def is_steady(fields: Fields, work: Workspace, parameters: Parameters, stopping: Stopping) -> bool:
    """Whether the last step satisfies every criterion."""
    inflow = section_flow(fields, parameters, 0)
    outflow = section_flow(fields, parameters, parameters.columns - 1)
    if not abs(inflow - outflow) < stopping.balance:
        return False
    if not max(abs(inflow), abs(outflow)) < stopping.rest:
        return False
    moving = 0
    for k in range(fields.area.size):
        change = abs(fields.area[k] - work.area_before[k])
        moving += not change < stopping.area_change * work.area_before[k]
        moving += not abs(fields.flow[k] - work.flow_before[k]) < stopping.flow_change
    if moving:
        return False
    if stopping.end_flow_change == float("inf"):
        return True
    return largest_end_change(fields, work, parameters) < stopping.end_flow_change
