"""Cost of the 3D simulation beside the 2D model, and whether its own records confirm its plot file."""

from cases.results.provenance import ReducedModelSettings, SimulationCost
from reports.blocks import Column, Table, numbers, prose
from reports.result.load import Comparison
from reports.sections.parts.models import headed
from reports.wording.numbers import ABSENT, SPACE, rounded, with_unit

_SHOWN = {"Pa": ("MPa", 1e-6), "kg m-3": ("kg/m³", 1.0), "1": ("–", 1.0)}  # units of inputs: of moduli, …


def cost_table(comparison: Comparison) -> Table | None:
    """Return the cost of each variant in both models; None where no log tells that of 3D."""
    of_3d = {name: comparison.provenance.variants[name].reference.cost for name in comparison.variants}
    rows = tuple(_cost_row(comparison, name, cost) for name, cost in of_3d.items() if cost is not None)
    if not rows:
        return None
    return Table(
        "cost",
        "Cost of the simulations: 3D as told by the log, on the machine where it ran; 2D as measured when it "
        "was computed, without compiling, perhaps beside another variant. The last column is "
        "wall time per simulated cycle over the same of 2D, whatever the machines.",
        (
            Column("variant"),
            *numbers("wall time", "simulated", "steps", "iterations", "equations", group="3D"),
            Column("ended", "prose", "3D"),
            *numbers("wall time", "cycles", "steps", group="2D"),
            Column("3D over 2D", "number"),
        ),
        rows,
    )


def _cost_row(comparison: Comparison, name: str, cost: SimulationCost) -> tuple[str, ...]:
    two = comparison.settings(name)
    retries = f" ({cost.retries} retried)" if cost.retries else ""
    version = f"FEBio {cost.febio_version}" if cost.febio_version else "FEBio"
    return (
        name,
        _duration(cost.wall_time_s),
        with_unit(rounded(cost.simulated_s), "s"),
        f"{cost.time_steps}{retries}",
        str(cost.iterations),
        ABSENT if cost.equations is None else str(cost.equations),
        f"{cost.ended} ({version})",
        _duration(two.simulation_wall_time_s),
        ABSENT if two.cycles is None else str(two.cycles),
        ABSENT if two.steps is None else str(two.steps),
        rounded(_per_cycle(comparison.period, cost, two), 2),
    )


def cost_sentence(comparison: Comparison) -> str:
    """Say what 3D and each model took; "" where no log tells that of 3D."""
    of_3d = [r.reference.cost for r in comparison.provenance.variants.values() if r.reference.cost]
    known = [c for c in of_3d if c.wall_time_s and c.simulated_s]
    if not known:
        return ""
    most = max(known, key=lambda c: (c.wall_time_s or 0.0) / (c.simulated_s or 1.0))
    cycles = (most.simulated_s or 0.0) / comparison.period
    said = [f"3D {_duration((most.wall_time_s or 0.0) / cycles)} a cycle (as its log tells)"]
    for model in comparison.models:
        took = [
            of.simulation_wall_time_s / of.cycles
            for name in comparison.variants
            if (of := comparison.of(model).settings(name)).simulation_wall_time_s and of.cycles
        ]
        if took:
            said.append(f"{headed(comparison, model)} {_duration(max(took))}")
    return f"Cost, of the variant that took longest: {', '.join(said)}; the machines differ."


def _per_cycle(period: float, cost: SimulationCost, two: ReducedModelSettings) -> float | None:
    """Wall time of a cycle in 3D over that in 2D; None where either, or how much it simulated, is unknown."""
    if not (cost.wall_time_s and cost.simulated_s and two.simulation_wall_time_s and two.cycles):
        return None
    return (cost.wall_time_s / (cost.simulated_s / period)) / (two.simulation_wall_time_s / two.cycles)


def _duration(seconds: float | None) -> str:
    """E.g. "15.8 min"; days for what takes days."""
    if seconds is None:
        return ABSENT
    for size, unit in ((86400.0, "d"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * size:
            return with_unit(rounded(seconds / size, 3), unit)
    return with_unit(rounded(seconds, 3), "s")


def records_table(comparison: Comparison) -> Table | None:
    """Return what FEBio's text records say of its plot files; None without such records."""
    rows = tuple(
        (
            name,
            record.file,
            ", ".join(record.columns),
            str(record.instants),
            str(record.values),
            ABSENT if record.largest_difference is None else f"{record.largest_difference:.1e}",
        )
        for name in comparison.variants
        for record in comparison.provenance.variants[name].reference.data_records
    )
    if not rows:
        return None
    return Table(
        "data-records",
        "Values that FEBio wrote as text during the run, beside those of its plot file: largest difference "
        f"over the largest value. Plot files are in single precision, about 6{SPACE}·{SPACE}10⁻⁸.",
        (Column("variant"), *prose("record", "columns"), *numbers("instants", "values", "difference")),
        rows,
    )


def inputs_table(comparison: Comparison) -> Table | None:
    """Return the inputs that the logs of 3D tell beside the case's; None without a log."""
    names = comparison.variants
    found = {name: comparison.provenance.variants[name].reference.inputs for name in names}
    by_name = {name: {item.name: item for item in items} for name, items in found.items()}
    rows = []
    for each in dict.fromkeys(item.name for items in found.values() for item in items):
        both = [by_name[name].get(each) for name in names]
        stated = next(item.unit for item in both if item is not None)
        unit, factor = _SHOWN.get(stated, (stated, 1.0))
        values = ((None, None) if item is None else (item.reference, item.case) for item in both)
        texts = (ABSENT if value is None else f"{factor * value:.6g}" for pair in values for value in pair)
        rows.append((each, unit, *texts))
    if not rows:
        return None
    return Table(
        "inputs-of-both",
        "Inputs of the 3D run, as its log tells them, beside the case's, of several moduli the nearest. "
        f"{ABSENT}: there is none, as the density of a wall in 2D.",
        (
            Column("input", "prose"),
            Column("unit"),
            *(Column(side, "number", name) for name in names for side in ("3D", "case")),
        ),
        tuple(rows),
    )
