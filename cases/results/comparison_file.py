"""Names and dimensions of the variables of comparison.nc: fields of both models, and what is of the case."""

from cases.fields import FIELDS
from cases.quantities import stored

MODELS = ("reference", "rom")
WALL_STIFFNESS, CALCIFIED = "wall_stiffness", "calcified"
CURVE_DIMS = ("compare_time", "compare_x", "compare_phi", "exponent")


def variable(model: str, quantity: str) -> str:
    """Name of a model's field."""
    return f"{model}_{quantity}"


PROFILE_ERROR = variable("reference", "profile_error")
PROFILE_ERROR_CURVE = f"{PROFILE_ERROR}_curve"


def variables() -> dict[str, tuple[str, ...]]:
    """Dimensions of the variables that every comparison has, by name."""
    of_models = {variable(model, name): FIELDS[name].dims for model in MODELS for name in stored()}
    of_one = {
        PROFILE_ERROR: FIELDS["profile_error"].dims,
        PROFILE_ERROR_CURVE: CURVE_DIMS,
        WALL_STIFFNESS: FIELDS[WALL_STIFFNESS].dims,
        CALCIFIED: ("x", "phi"),
    }
    return {name: ("variant", *dims) for name, dims in (of_models | of_one).items()}
