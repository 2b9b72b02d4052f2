"""The stepper that a model needs."""

from solver.model import Model, State
from solver.section_stepper import SectionStepper
from solver.stepper import Stepper


def stepper_of(model: Model, state: State) -> Stepper:
    """Stepper of a model's rows, or of its sections where they have one pressure each."""
    return Stepper(model, state) if model.section_wall is None else SectionStepper(model, state)
