"""How sure a bias is, and how far apart the changes by calcification are, as a reader sees them."""

from dataclasses import replace
from types import SimpleNamespace

from cases.results.metric_row import metric_row
from reports.result.metrics import Metrics
from reports.sections.assumptions import further_figures
from reports.sections.parts import pooled


def row(statistic, error, rom=None, reference=None, variant="local"):
    values = {"rom": rom, "reference": reference, "error": error}
    return metric_row("case", variant, "rom", "radius", statistic, unit="m", **values)


def comparison(*rows):
    index = {(r.variant, r.quantity, r.statistic, r.i, r.j, r.t_s, r.inflow): r for r in rows}
    return SimpleNamespace(
        metrics=Metrics(rows, index),
        variants=("none", "local"),
        baselines={"local": "none"},
        changed=("local",),
    )


def plain(line):
    return [text.replace("\u202f", " ").replace("\u00a0", " ") for text in line]


def test_a_bias_stands_beside_its_interval():
    rows = (
        row("bias", 0.0078),
        row("scatter", 0.02),
        row("bias_low", 0.0074),
        row("bias_high", 0.0083),
        row("rms_difference", 6.4e-6),
    )
    table = pooled.table(comparison(*rows))
    assert plain(table.rows[0]) == [
        "local",
        "lumen radius",
        "+0.78 %",
        "+0.74 … +0.83 %",
        "2.00 %",
        "—",
        "6.40 μm",
        "—",
        "—",
    ]
    assert further_figures(comparison(*rows), frozenset()) is None
    assert "passes zero" not in table.caption
    assert (
        "passes zero" in pooled.table(comparison(*rows, replace(row("max_error", -148.4), t_s=0.1))).caption
    )


def test_a_bias_without_an_interval_says_so():
    table = pooled.table(comparison(row("bias", 0.0078)))
    assert plain(table.rows[0])[3] == "—"


def test_changes_are_shown_with_their_sizes_and_distance():
    apart = row("change_rms", 0.869, rom=75.0e-6, reference=64.1e-6)
    table = pooled.change_apart(comparison(apart, row("change_rms", 0.0, variant="none")), ("local",))
    assert [plain(line) for line in table.rows] == [["local", "lumen radius", "64.1 μm", "75.0 μm", "87 %"]]


def test_without_changes_there_is_no_table():
    assert pooled.change_apart(comparison(row("bias", 0.1)), ("local",)) is None
