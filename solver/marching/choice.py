"""The stepper that a model needs."""

from solver.marching.row_stepper import Stepper
from solver.marching.section_stepper import SectionStepper
from solver.model.parameters import Model, State


def stepper_of(model: Model, state: State) -> Stepper:
    """Stepper of a model's rows, or of its sections where they have one pressure each."""
    return Stepper(model, state) if model.section_wall is None else SectionStepper(model, state)
