"""Names and dimensions of the variables of comparison.nc: fields of the models, and what is of the case."""

from collections.abc import Iterable

from cases.fields import FIELDS
from cases.quantities import stored

REFERENCE, ROM = "reference", "rom"  # 3D, and the reduced model where a case names none
WALL_STIFFNESS, ERROR_BUDGET, CALCIFIED = "wall_stiffness", "error_budget", "calcified"
CURVE_DIMS = ("compare_time", "compare_x", "compare_phi", "exponent")


def variable(model: str, quantity: str) -> str:
    """Name of a model's field."""
    return f"{model}_{quantity}"


PROFILE_ERROR = variable(REFERENCE, "profile_error")
PROFILE_ERROR_CURVE = f"{PROFILE_ERROR}_curve"


def variables(models: Iterable[str] = (ROM,)) -> dict[str, tuple[str, ...]]:
    """Dimensions of the variables that every comparison with these reduced models has, by name."""
    stiffness = {variable(model, WALL_STIFFNESS): FIELDS[WALL_STIFFNESS].dims for model in models}
    of_models = {
        variable(model, name): FIELDS[name].dims for model in (REFERENCE, *models) for name in stored()
    }
    of_one = {
        PROFILE_ERROR: FIELDS["profile_error"].dims,
        PROFILE_ERROR_CURVE: CURVE_DIMS,
        CALCIFIED: ("x", "phi"),
    }
    return {name: ("variant", *dims) for name, dims in (of_models | stiffness | of_one).items()}
