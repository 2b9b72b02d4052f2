import csv
import dataclasses
import io
import json
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from cases.fields import FIELDS
from reports.blocks import Bullets, Figure, Paragraph, Section, Subsection, Table, Warnings
from reports.result.load import Comparison, load
from reports.sections import answer, assumptions, change, cycle, provenance, velocity, verdict
from reports.sections.parts.places import degrees_words, place_words

Rows = list[dict[str, Any]]


def _blocks(section: Section, kind: type) -> list[Any]:
    parts = [
        b for block in section.blocks for b in (block.blocks if isinstance(block, Subsection) else [block])
    ]
    return [block for block in parts if isinstance(block, kind)]


@pytest.fixture(scope="module")
def curves(finished: tuple[Path, Rows]) -> Section:
    """The section of the curves over the cycle."""
    return cycle.section(load(finished[0]))


def _table(section: Section, key: str) -> Table:
    tables: list[Table] = _blocks(section, Table)
    return next(table for table in tables if table.key == key)


def _number(text: str) -> float:
    return float(text.replace("−", "-").replace("\u00a0", "").rstrip("%"))


def _find(rows: Rows, **what: Any) -> dict[str, Any]:
    return next(row for row in rows if not row["status"] and all(row[key] == v for key, v in what.items()))


def test_the_band_table_has_every_band_worst_first(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    bands = [row for row in rows if row["status"]]
    table = _table(verdict.section(load(directory)), "bands")
    titles = [column.title for column in table.columns]
    assert len(table.rows) == len(bands)
    status = [row[titles.index("verdict")] for row in table.rows]
    assert status == sorted(status, key=["FAIL", "MISSING", "OK"].index)
    assert {"FAIL", "MISSING", "OK"} == set(status)
    for kind in ("FAIL", "OK"):
        shares = [_number(row[titles.index("of limit")]) for row in table.rows if row[1] == kind]
        assert shares == sorted(shares, reverse=True)
    worst = max((b for b in bands if b["error"] is not None), key=lambda b: abs(b["error"]) / b["band"])
    assert _number(table.rows[0][titles.index("error")]) == pytest.approx(100 * worst["error"], abs=0.005)
    assert table.rows[0][titles.index("reason for the limit")] == "the inlet polygon has 1.1 % less area"


def test_the_verdict_counts_what_the_metrics_hold(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    bands = [row for row in rows if row["status"]]
    held = sum(row["status"] == "OK" for row in bands)
    said = verdict.headline(load(directory))
    assert said.startswith(f"{held} of {len(bands)} bands hold (none: ")
    local = [row["status"] for row in bands if row["variant"] == "local"]
    assert f"local: {local.count('OK')} of {len(local)} hold, {local.count('FAIL')} fail, 1 missing)." in said


def test_a_reason_is_that_of_the_limit_and_the_variant(tmp_path: Path, small: synthetic.Setup) -> None:
    def band(limit: float, reason: str, *variants: str) -> dict[str, Any]:
        return {**small.bands[0], "limit": limit, "reason": reason, "variants": list(variants)}

    bands = [
        band(0.03, "loose", "none", "local"),
        band(0.02, "tight", "local"),
        band(0.02, "tighter in none", "none"),
    ]
    setup = dataclasses.replace(small, variants=("none", "local"), bands=bands)
    synthetic.write(tmp_path, setup)
    table = _table(verdict.section(load(tmp_path)), "bands")
    found = {(row[0], row[5].replace("\u00a0", " ")): row[-1] for row in table.rows}
    assert found == {
        ("none", "3 %"): "loose",
        ("local", "3 %"): "loose",
        ("local", "2 %"): "tight",
        ("none", "2 %"): "tighter in none",
    }


def test_the_checks_of_the_3d_side_are_shown(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    table = _table(verdict.section(load(directory)), "trust")
    assert [column.title for column in table.columns[1:-1]] == list(synthetic.VARIANTS)
    inflow = max(row["error"] for row in rows if row["statistic"] == "prescribed_inflow")

    def apart(variant: str) -> float:
        with xr.open_dataset(directory / "comparison.nc", decode_times=False) as data:
            flow = data.sel(variant=variant).isel(x=0)
            two, three = (flow[f"{model}_section_flow_rate"].values for model in ("rom", "reference"))
            return float(np.abs(two - three).max() / np.abs(three).max())

    for column, variant in enumerate(synthetic.VARIANTS, start=1):
        defect = _find(rows, variant=variant, quantity="mass_defect", statistic="largest")["reference"]
        shown = [row[column].replace("\u00a0", " ") for row in table.rows]
        assert shown == [
            "0.10 %",
            f"{100 * inflow:.2f} %",
            f"{100 * apart(variant):.2f} %",
            f"{100 * defect:.2f} %",
            "0 %",
            "100.00 %",
            "—",
            "< 0.01 %",
        ]


def _warnings(directory: Path) -> tuple[str, ...]:
    section = answer.section(load(directory))
    kinds = [type(block) for block in section.blocks]
    assert kinds[:2] == [Bullets, Warnings], "before any figure or table"
    (found,) = _blocks(section, Warnings)
    return found.items


@pytest.mark.parametrize(
    ("statistic", "error", "said"),
    [
        ("plane_integral", -0.00501, "In local the 3D flow rate read along rays is up to 0.50 %"),
        ("prescribed_inflow", 0.0201, "In local the 3D mean velocity at the inlet is up to 2.01 %"),
    ],
)
def test_a_failed_check_of_the_3d_side_is_a_warning(
    tmp_path: Path, small: synthetic.Setup, statistic: str, error: float, said: str
) -> None:
    rows = synthetic.write(tmp_path, small)
    next(row for row in rows if row["statistic"] == statistic)["error"] = error
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    (warning,) = _warnings(tmp_path)
    assert warning.replace("\u00a0", " ").startswith(said)


def test_a_cycle_that_is_not_covered_is_a_warning(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    path.write_text(path.read_text().replace('"coverage": 1.0', '"coverage": 0.94'))
    (warning,) = _warnings(tmp_path)
    assert "local cover only 94.00\u00a0% of the cycle" in warning


def test_without_doubt_there_is_no_warning(finished: tuple[Path, Rows]) -> None:
    assert not _blocks(answer.section(load(finished[0])), Warnings)


def test_an_older_result_without_the_newer_keys_is_shown(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    record = json.loads(path.read_text())
    del record["warnings"]
    del record["variants"]["local"]["reference"]["coverage"]
    del record["variants"]["local"]["models"]["rom"]["cycle_change"]
    for band in record["bands"]:
        band["variants"] = None
    path.write_text(json.dumps(record))
    assert not _blocks(answer.section(load(tmp_path)), Warnings)
    section = verdict.section(load(tmp_path))
    assert [row[1] for row in _table(section, "trust").rows[-2:]] == ["—", "—"]
    assert all(row[-1] for row in _table(section, "bands").rows)


def test_what_is_missing_is_said_not_to_be_known(finished: tuple[Path, Rows]) -> None:
    unknown = verdict.unknowns(load(finished[0]))
    assert any("lag of the reduced model's outlet flow" in said for said in unknown)
    assert any("finer mesh" in said for said in unknown)


@pytest.mark.parametrize("change", [0.0023, 0.05, 0.083])
def test_a_reference_that_is_not_periodic_is_not_judged(tmp_path: Path, change: float) -> None:
    synthetic.write(tmp_path, synthetic.Setup(variants=("none", "local")))
    path = tmp_path / "provenance.json"
    record = json.loads(path.read_text())
    record["variants"]["local"]["reference"]["cycle_change"] = change
    path.write_text(json.dumps(record))
    comparison = load(tmp_path)
    section = verdict.section(comparison)
    row = next(row for row in _table(section, "trust").rows if row[0] == "3D change over a cycle")
    column = [column.title for column in _table(section, "trust").columns].index("local")
    assert row[column].replace("\u00a0", " ") == f"{100 * change:.2f} %"
    unsettled = change > 0.05
    said = dict(line.split(": ", 1) for line in verdict.by_variant(comparison))
    assert said["local"].startswith("3D is not periodic (it changes by 8.30") == unsettled
    assert said["local"].endswith("so that its difference from 2D is no model error.") == unsettled
    assert ("the 2D model" in said["local"]) == (not unsettled)
    assert ("local: 3D is not periodic" in verdict.headline(comparison)) == unsettled
    bands = [row for row in comparison.metrics.bands() if row.variant != "local" or not unsettled]
    assert f"of {len(bands)} bands hold" in verdict.headline(comparison)
    assert not (unsettled and "in variant local" in verdict.worst(comparison))
    unmeasured = [words for words in verdict.unknowns(comparison) if words.startswith("Of 3D one cycle")]
    assert not any("local" in words for words in unmeasured)


def test_nothing_is_judged_where_no_reference_is_periodic(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    path.write_text(path.read_text().replace('"coverage": 1.0', '"coverage": 1.0, "cycle_change": 1.4'))
    comparison = load(tmp_path)
    assert verdict.headline(comparison).startswith("Nothing is judged (")
    assert verdict.worst(comparison) == ""
    assert len(_blocks(verdict.section(comparison), Table)) > 1


def test_a_single_cycle_is_said(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    path.write_text(path.read_text().replace('"cycles": 3', '"cycles": 1'))
    assert any("single cycle for local" in said for said in verdict.unknowns(load(tmp_path)))


def test_without_bands_nothing_is_judged(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, bands=[]))
    section = verdict.section(load(tmp_path))
    assert "declares no band" in section.blocks[0].text  # type: ignore[union-attr]
    assert [table.key for table in _blocks(section, Table)] == ["trust", "pooled"]


def test_an_error_close_to_its_limit_is_told_from_it(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    judged = next(row for row in rows if row["status"])
    judged.update(error=0.020004, band=0.02, status="FAIL")
    (tmp_path / "metrics.json").write_text(json.dumps([judged]))
    table = _table(verdict.section(load(tmp_path)), "bands")
    assert table.rows[0][4:6] == ("2.0004\u00a0%", "2\u00a0%")


def test_a_difference_is_shown_in_the_unit_of_its_quantity(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    judged = next(row for row in rows if row["status"])
    judged.update(quantity="pressure", statistic="rms_difference", unit="Pa", error=1250.0, band=500.0)
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    table = _table(verdict.section(load(tmp_path)), "bands")
    assert table.rows[0][4:7] == ("1.25\u00a0kPa", "0.5\u00a0kPa", "2.5")


def _section_at(comparison: Comparison, words: str) -> int:
    """Number of the shown cell that "x = 7.6 mm" names."""
    return next(i for i in comparison.i if place_words(comparison, i) == words)


def _row_at(comparison: Comparison, words: str) -> int:
    """Number of the shown row that "184°" names."""
    return next(j for j in comparison.j if degrees_words(comparison, j) == words)


@pytest.mark.parametrize(
    ("key", "quantity", "statistic", "factor", "has_row"),
    [
        ("section-flow", "section_flow_rate", "value", 1e6, False),
        ("sector-flow", "sector_flow_rate", "value", 1e6, True),
        ("change-pressure", "pressure", "change", 1.0, True),
        ("change-radius", "radius", "change", 1e6, True),
        ("change-sector_flow_rate", "sector_flow_rate", "change", 1e9, True),
        ("change-section-flow", "section_flow_rate", "change", 1e9, False),
    ],
)
def test_cell_tables_hold_the_metrics(
    finished: tuple[Path, Rows], key: str, quantity: str, statistic: str, factor: float, has_row: bool
) -> None:
    directory, rows = finished
    comparison = load(directory)
    table = _table(change.section(comparison), key)
    times = dict(zip(synthetic.Setup().time_names, (t for _, t in comparison.times), strict=True))
    checked = 0
    for line in table.rows:
        t = times[line[1].split(" (")[0]]
        j = _row_at(comparison, line[2]) if has_row else None
        for column, text in zip(table.columns[2 + has_row :], line[2 + has_row :], strict=True):
            i = _section_at(comparison, column.group)
            row = _find(rows, variant=line[0], quantity=quantity, statistic=statistic, i=i, j=j, t_s=t)
            value = factor * row["reference" if column.title == "3D" else "rom"]
            decimals = len(text.partition(".")[2])
            assert _number(text) == pytest.approx(value, abs=0.5001 * 10.0**-decimals)
            checked += 1
    assert checked == len(table.rows) * 2 * len(comparison.i)


def test_cycle_quantities_hold_value_change_and_ratio(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    table = _table(change.section(load(directory)), "cycle-quantities")
    line = next(row for row in table.rows if row[:2] == ("least lumen radius", "local"))
    what = {"variant": "local", "quantity": "least_radius"}
    value, changed, ratio = (_find(rows, **what, statistic=name) for name in ("cycle", "change", "ratio"))
    expected = [
        1e3 * value["reference"],
        1e3 * value["rom"],
        100 * value["error"],
        1e3 * changed["reference"],
        1e3 * changed["rom"],
        ratio["reference"],
        ratio["rom"],
    ]
    assert [_number(text) for text in line[3:]] == pytest.approx(expected, abs=6e-3)


def test_without_a_baseline_no_change_is_claimed(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    section = change.section(load(tmp_path))
    assert any("no baseline" in p.text for p in _blocks(section, Paragraph))
    assert not [table for table in _blocks(section, Table) if table.key.startswith("change")]
    assert "ratio" not in [column.group for column in _table(section, "cycle-quantities").columns]


def test_a_wall_that_is_the_same_all_around_shows_one_row(curves: Section) -> None:
    figures = {figure.key: figure for figure in _blocks(curves, Figure)}
    assert list(figures) == ["cycle-1-1", "cycle-2-1", "cycle-3-1"]
    rows = {
        key: dict.fromkeys((line["quantity"], line["row"]) for line in csv.DictReader(io.StringIO(of.csv)))
        for key, of in figures.items()
    }
    alike = [("pressure", "φ = 22°"), ("radius", "φ = 22°"), ("section_flow_rate", "section")]
    assert list(rows["cycle-1-1"]) == list(rows["cycle-2-1"]) == alike
    both = [("radius", "sector_flow_rate"), ("φ = 22°", "φ = 158°")]
    assert set(rows["cycle-3-1"]) == {*alike, *product(*both)}
    assert "flow rate through one sector" in figures["cycle-3-1"].caption
    assert "flow rate through one sector" not in figures["cycle-1-1"].caption


def test_a_figures_data_are_the_models_own(finished: tuple[Path, Rows], curves: Section) -> None:
    directory, _ = finished
    figure = _blocks(curves, Figure)[2]
    with xr.open_dataset(directory / "comparison.nc", decode_times=False) as data:
        local = data.sel(variant="local")
        rows = list(csv.DictReader(io.StringIO(figure.csv)))
        assert len(rows) == data.sizes["time"] * 3 * (2 * 2 + 2)
        for row in rows[::7]:
            field = FIELDS[row["quantity"]]
            at = {"x": {"1": 0, "2": 5, "3": 11}[row["column"][0]]}
            at |= {} if row["row"] == "section" else {"phi": {"22": 0, "158": 3}[row["row"][4:-1]]}
            for model, column in (("reference", "reference"), ("rom", "rom")):
                curve = local[f"{model}_{field.name}"].isel(at)
                there = curve.sel(time=float(row["time into the cycle (s)"]), method="nearest")
                assert float(row[column]) == pytest.approx(field.display_factor * float(there), rel=1e-8)
            assert row["unit"] == field.display_unit


def test_a_caption_names_where_the_profiles_are_farthest_apart(finished: tuple[Path, Rows]) -> None:
    comparison = load(finished[0])
    figure = _blocks(velocity.section(comparison), Figure)[0]
    first = comparison.profiles.isel(time=comparison.states[0])
    difference = (first["rom_axial_velocity"] - first["reference_axial_velocity"]).values
    at = np.unravel_index(int(np.abs(difference).argmax()), difference.shape)
    x, phi = 1e3 * comparison.x[at[1]], np.degrees(comparison.phi[at[2]])
    y = float(comparison.profiles["y"][at[3]])
    assert (
        f"2D {100 * difference[at]:+.2f} cm/s ({comparison.variants[at[0]]}, x = {x:.1f} mm, "
        f"φ = {phi:.0f}°, r/R = {y:.2f})"
    ).replace("-", "−") in figure.caption.replace("\u00a0", " ")
    assert figure.alt


def test_many_cells_are_spread_over_several_figures_and_tables(
    tmp_path: Path, small: synthetic.Setup
) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, i=tuple(range(1, 8))))
    comparison = load(tmp_path)
    keys = [table.key for table in _blocks(change.section(comparison), Table)]
    assert [key for key in keys if key.startswith("section-flow")] == ["section-flow-1", "section-flow-6"]
    figures = [f for f in _blocks(velocity.section(comparison), Figure) if f.key.startswith("profiles")]
    columns = [{line["column"][0] for line in csv.DictReader(io.StringIO(figure.csv))} for figure in figures]
    assert columns == [set("12345"), set("67")]


def test_rows_without_figures_leave_gaps_not_errors(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    for row in rows:
        row.update(reference=None, error=None, status="MISSING" if row["status"] else "")
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    comparison = load(tmp_path)
    assert "—" in _table(change.section(comparison), "section-flow").rows[0]
    assert "—" in _table(verdict.section(comparison), "trust").rows[0]
    assert _blocks(verdict.section(comparison), Bullets)


def test_settings_are_named_in_words_with_their_unit(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    path.write_text(path.read_text().replace('"scheme"', '"viscosity_Pa_s": 0.0035, "scheme"'))
    table = _table(provenance.settings(load(tmp_path)), "rom")
    assert ("viscosity (Pa s)", "0.0035") in table.rows
    assert ("time step (s)", "0.001") in table.rows


def _extra(variant: str, **what: Any) -> dict[str, Any]:
    blank = dict.fromkeys(("i", "j", "t_s", "rom", "reference", "error", "band"))
    about = {"case": "synthetic", "variant": variant, "model": "rom", "inflow": ""}
    return {**about, "unit": "1", "status": "", **blank, **what}


def test_rows_that_the_report_does_not_know_are_shown(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    rows += [
        _extra("local", quantity="wall_shear_stress", statistic="cycle", unit="Pa", rom=1.5, reference=1.2),
        _extra(
            "local", quantity="wall_shear_stress", statistic="largest", unit="Pa", reference=4.5, i=3, j=2
        ),
        _extra("local", quantity="radius", statistic="waveform_correlation", error=0.031),
        _extra("local", quantity="radius", statistic="rms_difference", unit="m", error=5.8e-5),
    ]
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    comparison = load(tmp_path)
    cycle_rows = _table(change.section(comparison), "cycle-quantities").rows
    assert [row[3:5] for row in cycle_rows if row[0] == "wall shear stress"] == [("1.200", "1.500")]
    found = {row[1:3]: row[3:] for row in _table(assumptions.others(comparison), "further").rows}
    said = {key: tuple(text.replace("\u00a0", " ") for text in texts) for key, texts in found.items()}
    assert said["wall shear stress", "largest"] == ("4.500 Pa", "—", "—", "x = 3.1 mm, φ = 68°")
    assert said["lumen radius", "waveform correlation"] == ("—", "—", "+3.10 %", "—")
    pooled_rows = _table(verdict.section(comparison), "pooled").rows
    assert [row[6].replace("\u00a0", " ") for row in pooled_rows if row[1] == "lumen radius"] == ["58.0 μm"]


def test_quantities_whose_figures_agree_share_a_line(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    for row in rows:
        if row["quantity"] == "sector_flow_rate" and row["statistic"] in (
            "bias",
            "scatter",
            "rms_error",
            "max_error",
        ):
            same = _find(rows, quantity="section_flow_rate", statistic=row["statistic"])
            row["error"] = same["error"]
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    names = [row[1] for row in _table(verdict.section(load(tmp_path)), "pooled").rows]
    assert "flow rate through one sector; flow rate through the section" in names


def test_cells_inside_the_calcification_are_marked(finished: tuple[Path, Rows]) -> None:
    comparison = load(finished[0])
    table = _table(change.section(comparison), "change-radius")
    assert "Shaded: inside the calcification." in table.caption
    for number, row in enumerate(table.rows):
        for column, heading in enumerate(table.columns):
            if heading.kind == "number" and heading.group:
                i = _section_at(comparison, heading.group)
                inside = comparison.calcified(row[0], i, _row_at(comparison, row[2]))
                assert table.marks(number, column) == inside
    assert table.marked


@pytest.mark.parametrize(("states", "shown"), [(11, "3"), (81, "3"), (401, "3.1")])
def test_a_lag_has_no_more_digits_than_states_carry(
    tmp_path: Path, small: synthetic.Setup, states: int, shown: str
) -> None:
    setup = dataclasses.replace(small, n_time=states, n_x=6, n_phi=4)
    rows = synthetic.write(tmp_path, setup)
    rows.append(_extra("local", quantity="phase_lag", statistic="cycle", unit="s", rom=3.12345e-3))
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    table = _table(change.section(load(tmp_path)), "cycle-quantities")
    assert [row[4] for row in table.rows if row[0].startswith("lag")] == [shown]
    assert "a lag is known no better" in table.caption


def test_each_variant_has_its_own_verdict(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    said = verdict.by_variant(load(directory))
    assert [text.partition(":")[0] for text in said] == list(synthetic.VARIANTS)
    for variant, text in zip(synthetic.VARIANTS, said, strict=True):
        status = {row["status"] for row in rows if row["status"] and row["variant"] == variant}
        assert ("is not within what was declared" in text) == ("FAIL" in status)
        assert ("could not be judged" in text) == ("MISSING" in status)


def test_many_rows_of_curves_are_two_figures(
    finished: tuple[Path, Rows], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cycle, "_MOST_ROWS", 4)
    figures = {figure.key: figure for figure in _blocks(cycle.section(load(finished[0])), Figure)}
    assert list(figures) == ["cycle-1-1", "cycle-2-1", "cycle-3-1", "cycle-3-1-2"]
    halves = [
        list(dict.fromkeys((line["quantity"], line["row"]) for line in csv.DictReader(io.StringIO(of.csv))))
        for key, of in figures.items()
        if key.startswith("cycle-3")
    ]
    assert [len(half) for half in halves] == [3, 3]
    assert not set(halves[0]) & set(halves[1])


def test_notes_that_say_the_same_are_one(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    path = tmp_path / "provenance.json"
    stated = json.loads(path.read_text())
    stated["notes"] = [
        "none, model row: two meshes",
        "no colon",
        "local, model row: two meshes",
        "local: other",
    ]
    path.write_text(json.dumps(stated))
    section = provenance.settings(load(tmp_path))
    (notes,) = _blocks(section, Bullets)
    assert notes.items == ("no colon", "none, model row; local, model row: two meshes", "local: other")
    assert any(block.text.startswith("3 notes") for block in _blocks(section, Paragraph))


def test_inputs_of_3d_stand_beside_those_of_the_case(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    assert "inputs-of-both" not in [
        table.key for table in _blocks(provenance.settings(load(tmp_path)), Table)
    ]
    path = tmp_path / "provenance.json"
    stated = json.loads(path.read_text())
    stated["variants"]["local"]["reference"]["inputs"] = [
        {"name": "Young's modulus of Healthy", "unit": "Pa", "reference": 6e5, "case": 5e5},
        {"name": "density of Healthy", "unit": "kg m-3", "reference": 1000.0, "case": None},
    ]
    path.write_text(json.dumps(stated))
    table = _table(provenance.settings(load(tmp_path)), "inputs-of-both")
    assert table.rows == (
        ("Young's modulus of Healthy", "MPa", "0.6", "0.5"),
        ("density of Healthy", "kg/m³", "1000", "—"),
    )
