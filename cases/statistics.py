"""The statistics that rows are of: what each is called, and whether it is relative."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Statistic:
    """What a figure tells of a quantity.

    Attributes
    ----------
    name, label : str
        Name in metrics and bands; words for people.
    relative : bool
        Whether its error is a share of the reference; otherwise it has the quantity's unit.
    signed : bool
        Whether it may be negative.
    words_with_quantity : str
        Words before "of the <quantity>", where they are others than the label.
    """

    name: str
    label: str
    relative: bool = True
    signed: bool = True
    words_with_quantity: str = ""

    @property
    def of_quantity(self) -> str:
        """Words that stand before "of the <quantity>"."""
        return self.words_with_quantity or self.label


def _table(*statistics: Statistic) -> dict[str, Statistic]:
    return {statistic.name: statistic for statistic in statistics}


JUDGED = _table(  # what bands may limit
    Statistic("rms_error", "RMS error", signed=False),
    Statistic("max_error", "largest error"),
    Statistic("bias", "bias", words_with_quantity="mean error"),
    Statistic("scatter", "scatter", signed=False, words_with_quantity="scatter of the error"),
    Statistic("systolic_error", "error at systole", words_with_quantity="systolic error"),
    Statistic("diastolic_error", "error at end diastole", words_with_quantity="diastolic error"),
    Statistic("rms_difference", "RMS difference", relative=False),
    Statistic("max_difference", "largest difference", relative=False),
    Statistic("rms_over_rms", "RMS difference over the RMS of 3D", signed=False),
    Statistic("rms_over_largest", "RMS difference over the largest of 3D", signed=False),
)
OF_POSITIVE = tuple(name for name in JUDGED if not name.startswith("rms_over_"))
PLACED = JUDGED | _table(  # what reports have tables for
    Statistic("value", "value"),
    Statistic("cycle", "error over the cycle"),
    Statistic("change", "change by calcification"),
    Statistic("ratio", "ratio to the baseline"),
)
BUDGET_PARTS = {  # of an error, in words
    "error": "error as compared",
    "inflow": "what the inflow of the 3D mesh changes",
    "matched": "error with the inflow of the 3D mesh",
    "mesh": "uncertainty of the 3D mesh",
    "grid": "uncertainty of the 2D grid and time step",
    "inputs": "uncertainty of the inputs",
    "shared_inputs": "uncertainty of the inputs that both models share",
    "uncertainty": "uncertainty of the comparison",
    "model_low": "least error of the model",
    "model_high": "largest error of the model",
    "extrapolated": "error in the limit of fine 3D meshes",
    "mesh_order": "observed order of the 3D mesh",
    "mesh_safety": "factor of safety of the 3D mesh",
    "grid_order": "observed order of the 2D grid",
    "step_order": "observed order of the 2D time step",
}
BUDGET = _table(*(Statistic(f"budget_{name}", words, signed=False) for name, words in BUDGET_PARTS.items()))
STATISTICS = (
    PLACED
    | BUDGET
    | _table(
        Statistic("curved_rms_error", "RMS error against 3D with the section's edge taken round"),
        Statistic("worst_cell", "RMS error of the worst cell"),
    )
)


def statistic_of(name: str) -> Statistic:
    """Return a statistic by name; one that no table lists is named by its own name."""
    return STATISTICS.get(name) or Statistic(name, name.replace("_", " "))
