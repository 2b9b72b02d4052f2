"""Section of the error budget: what of each error is owed to inflow, meshes, inputs and the model."""

import math
from collections.abc import Iterable, Mapping
from functools import partial

from reports.blocks import Block, Bullets, Column, Figure, Paragraph, Table
from reports.figures.budget_bars import BudgetBars, budget_bars
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, of_each_model
from reports.sections.parts.error_budget import NOT_TOLD, Budget, budget, budgets, sentence
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import ABSENT, fixed, listed, share
from reports.wording.words import quantity_words

_WITHOUT_BANDS = ("section_flow_rate", "pressure", "radius")
_COLUMNS = {
    "error": "error",
    "inflow": "inflow",
    "matched": "error, same inflow",
    "mesh": "3D mesh",
    "grid": "2D grid, step",
    "inputs": "inputs",
    "shared_inputs": "shared inputs",
    "uncertainty": "all uncertain",
}
_READ = (
    "Root mean squares over all cells and states, or sizes of a number of the cycle, relative to 3D. What is "
    "uncertain counts with its factor of safety; the model is off by the error with the same inflow ± all "
    "that is uncertain and known; inputs that both models share change both and do not "
    "count. Orders are observed: of the 3D mesh, the 2D grid and the 2D time step."
)
_BARS = ("error", "inflow", "matched", "mesh", "grid", "inputs")


def _interval(found: Budget) -> str:
    if found["uncertainty"] is None:
        return ABSENT
    return f"{share(found['model_low'])} … {share(found['model_high'])}"


def _order(found: Budget) -> str:
    orders = [fixed(found[name], 1) for name in ("mesh_order", "grid_order", "step_order")]
    return " / ".join(orders)


def _known(comparison: Comparison, parts: Iterable[str]) -> list[str]:
    """Return the parts that are known of some budget."""
    found = [each for name in comparison.variants for each in budgets(comparison, name)]
    return [part for part in parts if any(of[part] is not None for of in found)]


def _table(comparison: Comparison, number: int, variant: str) -> Table:
    parts = _known(comparison, _COLUMNS)
    rows = tuple(
        (
            quantity_words(found.quantity),
            *(ABSENT if found[part] is None else share(found[part]) for part in parts),
            _interval(found),
            _order(found),
        )
        for found in budgets(comparison, variant)
    )
    return Table(
        f"budget-{number}",
        f"Variant {variant}: parts of the error, relative to 3D. {ABSENT}: not known.",
        (
            Column("quantity", "prose"),
            *(Column(_COLUMNS[part], "number") for part in parts),
            Column("error of the model", "number"),
            Column("orders", "number"),
        ),
        rows,
    )


def _shown(comparison: Comparison) -> list[str]:
    """Quantities worth a figure: those that bands judge, else the usual ones."""
    names = dict.fromkeys(row.quantity for row in comparison.metrics.bands()) or _WITHOUT_BANDS
    return [n for n in names if any(budget(comparison, v, n) for v in comparison.variants)]


def _figure(comparison: Comparison, quantity: str) -> Figure:
    found = {
        _named(comparison, variant, model): of
        for variant in comparison.variants
        for model in comparison.models
        if (of := budget(comparison.of(model), variant, quantity))
    }
    parts = _known(comparison, _BARS)
    bars = [
        BudgetBars(name, tuple(_percent(of[part]) for part in parts), _model(of))
        for name, of in found.items()
    ]
    said = _said(found)
    rows = [(name, part, value) for name, of in found.items() for part, value in of.parts.items()]
    return Figure(
        key=f"budget-figure-{quantity}",
        caption=f"Error of the {quantity_words(quantity)} and what it is owed to. {said}.",
        alt=f"Bars of the error of the {quantity_words(quantity)}, of the parts of its uncertainty and of "
        f"the error with the same inflow, for {listed(found)}. {said}.",
        drawing=partial(budget_bars, [_COLUMNS[part] for part in parts], bars),
        csv=comma_separated(("variant", "part", "value"), rows),
    )


def _said(found: Mapping[str, Budget]) -> str:
    """Say what the model answers for, those of which the same is said together."""
    same: dict[str, list[str]] = {}
    for name, of in found.items():
        told = NOT_TOLD if of.within_uncertainty else sentence(of)
        same.setdefault(told, []).append(name)
    said = "; ".join(f"{told}: {listed(names)}" for told, names in same.items())
    return said[:1].upper() + said[1:]


def _named(comparison: Comparison, variant: str, model: str) -> str:
    return variant if len(comparison.models) == 1 else f"{variant} {model}"


def _percent(value: float | None) -> float:
    return math.nan if value is None else 100.0 * value


def _model(found: Budget) -> tuple[float, float]:
    return _percent(found["model_low"]), _percent(found["model_high"])


def _unknown(comparison: Comparison) -> tuple[str, ...]:
    """Say which parts are not known, and of which variants."""
    said = []
    for parts, words in (
        (("inflow",), "what the inflow of the 3D mesh changes (compare.matched_inflow)"),
        (("mesh",), "the error of the 3D mesh (reference.levels)"),
        (("grid",), "that of the 2D grid and time step"),
        (("inputs", "shared_inputs"), "what uncertain inputs change"),
    ):
        names = [
            name
            for name in comparison.variants
            if (found := budgets(comparison, name))
            and all(of[each] is None for of in found for each in parts)
        ]
        said += [f"Not known of {listed(names)}: {words}."] if names else []
    return tuple(said)


@declared("budget", "Error budget")
def section(comparison: Comparison) -> Blocks:
    """Return what is not known, and a figure a quantity."""
    shown = [name for name in comparison.variants if budgets(comparison, name)]
    if not shown:
        return ()
    blocks: list[Block] = [
        Paragraph(
            "A difference between 2D and 3D mixes the model's error with what other inflow, meshes, steps "
            "and inputs do. Here they are told apart: where the error is no larger than what is uncertain, "
            "no error of the model can be told."
        )
    ]
    unknown = _unknown(comparison)
    blocks += [Bullets(unknown)] if unknown else []
    blocks += [_figure(comparison, quantity) for quantity in _shown(comparison)]
    return tuple(blocks)


@declared("budget-tables", "Error budget, in numbers", appendix=True)
@of_each_model
def tables(comparison: Comparison) -> Blocks:
    """Return how to read the tables, and one a variant."""
    shown = [name for name in comparison.variants if budgets(comparison, name)]
    if not shown:
        return ()
    return (Paragraph(_READ), *(_table(comparison, k, name) for k, name in enumerate(shown, start=1)))
