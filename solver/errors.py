"""What can stop a run of the reduced model, by name."""

from cases.shell.errors import InputError


class SolverError(InputError):
    """Base of everything the solver raises on purpose."""


class ModelError(SolverError):
    """A parameter of the model is outside what its equations allow."""


class RunFailure(SolverError):
    """The run stopped in a cell.

    Attributes
    ----------
    time : float
        Time reached, s.
    i, j : int
        Cell along and around the artery, counted from 1; 0 where the failure belongs to no one cell.
    """

    reason = "the run failed"

    def __init__(self, time: float, i: int, j: int, detail: str = "") -> None:
        self.time, self.i, self.j = time, i, j
        where = f"t = {time:.6g} s" + (f", i = {i}" if i else "") + (f", j = {j}" if j else "")
        super().__init__(f"{self.reason} at {where}{': ' + detail if detail else ''}")


class NoAdmissibleProfile(RunFailure):
    """The continuity condition has no exponent γ > 0: |u| ≥ |D| or u and D of different sign."""

    reason = "no admissible velocity-profile exponent (the continuity condition needs 0 < u/D < 1)"


class WallCollapse(RunFailure):
    """The wall law gives a radius that is not positive."""

    reason = "the lumen collapsed (radius not positive)"


class BeyondWallTable(RunFailure):
    """A pressure lies beyond the range in which the wall law is known or stable."""

    reason = "the pressure left the range in which the wall law is known"


class NotConverged(RunFailure):
    """The iteration of one implicit step did not converge."""

    reason = "the implicit step did not converge"


class NotSteady(RunFailure):
    """A march to a steady state did not reach one."""

    reason = "no steady state was reached"


class NotFinite(RunFailure):
    """A field is infinite or not a number."""

    reason = "a field is not finite"


class CourantExceeded(RunFailure):
    """A Courant number is above the limit that the case states."""

    reason = "the Courant number is above its limit"


class MassNotConserved(RunFailure):
    """The mass defect is above the limit that the case states."""

    reason = "mass is not conserved to the limit"


class AxisNotContinuous(RunFailure):
    """The velocity on the axis differs over φ by more than the case allows."""

    reason = "the continuity condition on the axis is not satisfied to the limit"


class EnergyNotBalanced(RunFailure):
    """The balance of mechanical energy misses more than the case allows."""

    reason = "mechanical energy is not balanced to the limit"
