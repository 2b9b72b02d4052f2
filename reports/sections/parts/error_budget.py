"""Whose error it is: the budget of a quantity in one variant, and the sentence that follows from it."""

from dataclasses import dataclass

from cases.results.metric_row import MetricRow
from cases.statistics import BUDGET_PARTS
from reports.result.load import Comparison
from reports.wording.numbers import listed, share

NOT_TOLD = "no model error can be told from the uncertainty"


@dataclass(frozen=True)
class Budget:
    """Parts of an error by the names of `cases.statistics.BUDGET_PARTS`; None is not known."""

    quantity: str
    parts: dict[str, float | None]

    def __getitem__(self, part: str) -> float | None:
        return self.parts[part]

    @property
    def compared(self) -> float | None:
        """Error that the model answers for: with the inflow of the 3D mesh, where that is known."""
        return self["error"] if self["matched"] is None else self["matched"]

    @property
    def within_uncertainty(self) -> bool:
        """Whether what the model answers for is no larger than what is uncertain."""
        error, uncertainty = self.compared, self["uncertainty"]
        return error is not None and uncertainty is not None and error <= uncertainty


def budgets(comparison: Comparison, variant: str) -> list[Budget]:
    """Budgets of a variant, one a quantity; none where the comparison holds none."""
    rows = [
        row for row in comparison.metrics.rows if (row.variant, row.statistic) == (variant, "budget_error")
    ]
    return [found for row in rows if (found := budget(comparison, variant, row.quantity))]


def budget(comparison: Comparison, variant: str, quantity: str) -> Budget | None:
    """Return the budget of a quantity, or None where the comparison holds none."""
    found = {part: comparison.metrics.find(variant, quantity, f"budget_{part}") for part in BUDGET_PARTS}
    if found["error"] is None:
        return None
    return Budget(quantity, {part: None if row is None else row.error for part, row in found.items()})


def sentence(found: Budget) -> str:
    """Say what error the model answers for, and what is not known."""
    error, uncertainty = found.compared, found["uncertainty"]
    if error is None:
        return "the error was not told apart"
    if uncertainty is None:
        text = "what the model answers for is not known"
    elif found.within_uncertainty:
        text = f"{NOT_TOLD} of {_counted(found)} (error {share(error)}, uncertainty {share(uncertainty)})"
    elif found["mesh"] is None:
        text = f"error {share(error)}, beyond the uncertainty of {_counted(found)}"
    else:
        text = f"model error between {share(found['model_low'])} and {share(found['model_high'])}"
    return text if found["mesh"] is not None else f"{text}; the error of the 3D mesh is not known"


def _counted(found: Budget) -> str:
    """What the uncertainty counts; inputs that both models share are no part of it."""
    words = {"mesh": "the 3D mesh", "grid": "the 2D grid and step", "inputs": "the inputs"}
    return listed(text for part, text in words.items() if found[part] is not None)


def of_band(comparison: Comparison, row: MetricRow) -> str:
    """Say behind a band whose error it is; "" where the comparison holds no budget of its quantity.

    Budgets are of root mean squares of relative errors: of a difference over the size of 3D only the run
    with its inflow tells.
    """
    if row.statistic.startswith("rms_over_"):
        return _with_inflow_of_3d(comparison, row)
    found = budget(comparison, row.variant, row.quantity)
    if found is None:
        return ""
    if row.statistic != "rms_error":
        return f"of its RMS error: {sentence(found)}"
    half = None if row.band is None else 0.5 * row.band
    large = [
        f"{words} alone ({share(found[part])}) takes more than half of the limit"
        for part, words in (("inflow", "the inflow of the 3D mesh"), ("mesh", "the 3D mesh"))
        if half is not None and (found[part] or 0.0) > half
    ]
    return "; ".join([sentence(found), *large])


def _with_inflow_of_3d(comparison: Comparison, row: MetricRow) -> str:
    own = (row.variant, row.quantity, row.statistic, "matched")
    for each in comparison.metrics.rows:
        if (each.variant, each.quantity, each.statistic, each.inflow) == own and each.error is not None:
            return f"{share(each.error)} with the inflow of the 3D mesh"
    return ""
