"""``python -m validation.tables``: choice, kept results, exit status, files."""

import csv
import json

import pytest

from solver.errors import WallCollapse
from validation.tables import command as tables
from validation.tables import experiments, presentation, pulse, stability, store
from validation.tables.experiment import Check, Entry, Experiment, number, numbers, within

pytestmark = pytest.mark.slow  # compiles the explicit scheme


@pytest.fixture
def counted(monkeypatch):
    """Two small experiments that share an entry, and how often each entry was computed."""
    calls = {"slow one": 0, "quick one": 0}

    def entry(name, value, quick):
        def compute():
            calls[name] += 1
            return {"value": value}

        return Entry(name, compute, quick)

    slow, quick = entry("slow one", 2.0, False), entry("quick one", 1.001, True)

    def rows(results):
        return [
            within(name, "value", "m", number(results[name], "value"), thesis, 0.01)
            for name, thesis in (("quick one", 1.0), ("slow one", 2.0))
            if name in results
        ]

    few = {
        "a": Experiment("a", "both", [quick, slow], rows),
        "b": Experiment("b", "slow", [slow], rows),
    }
    monkeypatch.setattr(experiments, "EXPERIMENTS", few)
    monkeypatch.setattr(tables, "NAMES", tuple(few))
    return calls


def test_all_tables_are_offered():
    thesis = {"3.1", "3.2", "3.3", "3.4", "3.6", "3.7", "3.9", "stability", "orders", "steady", "pulse"}
    assert set(experiments.EXPERIMENTS) == thesis | {"schemes"}
    assert tuple(experiments.EXPERIMENTS) == tables.NAMES


def test_entry_names_are_unique_files():
    computed = {}
    for experiment in experiments.EXPERIMENTS.values():
        for entry in experiment.entries:
            computed.setdefault(entry.name, set()).add(str(entry.compute))
    assert all(len(ways) == 1 for ways in computed.values())


def test_unknown_name_exits_2(capsys, tmp_path):
    with pytest.raises(SystemExit) as stop:
        tables.main(["3.5", "--output", str(tmp_path)])
    assert stop.value.code == 2
    assert "3.5" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_output_that_is_a_file_exits_2(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit) as stop:
        tables.main(["steady", "--output", str(tmp_path / "file")])
    assert stop.value.code == 2


def test_finished_entries_are_kept(counted, tmp_path):
    assert tables.main(["--output", str(tmp_path)]) == 0
    assert tables.main(["--output", str(tmp_path)]) == 0
    assert counted == {"slow one": 1, "quick one": 1}


def test_other_sources_compute_anew(counted, tmp_path, monkeypatch):
    tables.main(["--output", str(tmp_path)])
    monkeypatch.setattr(store, "code_digest", lambda kind: "other")
    tables.main(["--output", str(tmp_path)])
    assert counted == {"slow one": 2, "quick one": 2}


def test_torn_entry_computes_anew(counted, tmp_path):
    tables.main(["--output", str(tmp_path)])
    (tmp_path / "entries" / "slow_one.json").write_text('{"name": "slow')
    tables.main(["--output", str(tmp_path)])
    assert counted == {"slow one": 2, "quick one": 1}


def test_quick_leaves_the_slow_ones(counted, tmp_path, capsys):
    assert tables.main(["--quick", "--output", str(tmp_path)]) == 0
    assert counted == {"slow one": 0, "quick one": 1}
    assert "not in the quick subset" in capsys.readouterr().out


def test_interrupted_run_continues(counted, tmp_path, monkeypatch):
    experiment = experiments.EXPERIMENTS["a"]
    stopped = Entry("slow one", _interrupt, quick=False)
    entries = [experiment.entries[0], stopped]
    interrupted = Experiment("a", "both", entries, experiment.rows)
    monkeypatch.setitem(experiments.EXPERIMENTS, "a", interrupted)
    assert tables.main(["a", "--output", str(tmp_path)]) == 130
    monkeypatch.setitem(experiments.EXPERIMENTS, "a", experiment)
    assert tables.main(["a", "--output", str(tmp_path)]) == 0
    assert counted == {"slow one": 1, "quick one": 1}


def _interrupt():
    raise KeyboardInterrupt


def test_missed_tolerance_exits_1(monkeypatch, tmp_path, capsys):
    row = within("far", "value", "", 1.02, 1.0, 0.01)
    monkeypatch.setattr(experiments, "EXPERIMENTS", {"c": Experiment("c", "missed", [], lambda _: [row])})
    monkeypatch.setattr(tables, "NAMES", ("c",))
    assert tables.main(["--output", str(tmp_path)]) == 1
    assert "missed" in capsys.readouterr().out
    with (tmp_path / "c.csv").open(encoding="utf-8") as file:
        line = next(csv.DictReader(file))
    assert line["met"] == "False"
    assert float(line["relative_difference"]) == pytest.approx(0.02)


def test_failed_run_exits_1_and_names_itself(monkeypatch, tmp_path, capsys):
    def fail():
        raise WallCollapse(1.0, 2, 3)

    experiment = Experiment("c", "failing", [Entry("collapse", fail, quick=True)], lambda _: [])
    monkeypatch.setattr(experiments, "EXPERIMENTS", {"c": experiment})
    monkeypatch.setattr(tables, "NAMES", ("c",))
    assert tables.main(["--output", str(tmp_path)]) == 1
    assert "collapse: the lumen collapsed" in capsys.readouterr().err.replace("\n", " ")


def test_json_names_sources_and_rows(counted, tmp_path):
    tables.main(["--output", str(tmp_path)])
    content = json.loads((tmp_path / "tables.json").read_text(encoding="utf-8"))
    assert content["sources"] == store.code_digest("tables")
    assert [row["case"] for row in content["experiments"]["a"]] == ["quick one", "slow one"]
    assert set(content["cpu_s"]) == {"quick one", "slow one"}


def test_figures_of_the_block_pulse(tmp_path):
    result = {"radius_mm 3.1": [2.5, 2.6], "radius_mm 3.2": [2.5, 2.6]}
    paths = pulse.EXPERIMENT.draw({"block pulse upwind n_x=60": result}, tmp_path)
    assert [path.name for path in paths] == ["figure_3_1.png", "figure_3_2.png"]
    assert all(path.stat().st_size > 1000 for path in paths)


def test_figures_of_the_stability_scan(tmp_path):
    result = {"time_step_us": [23.0, 23.1], "courant": [0.99, None]}
    paths = stability.EXPERIMENT.draw({"stability none 23 us": result}, tmp_path)
    assert [path.name for path in paths] == ["figure_3_3.png", "figure_3_16.png"]


def test_stability_limit_is_the_last_stable_step():
    result = {"time_step_us": [23.0, 23.1, 23.2, 23.3, 23.4], "courant": [0.98, 1.01, 0.99, 1.03, None]}
    (row,) = stability.EXPERIMENT.rows({"stability none 23 us": result})
    assert row.ours == 23.2
    assert row.met


@pytest.mark.parametrize(
    ("row", "text"),
    [
        (within("", "", "", 1.0, 2.0, 0.05), "± 5 %"),
        (Check("", "", "", 1.0, None, 1.4, float("inf")), "≥ 1.4"),
        (Check("", "", "", 1.0, None, 0.0, 1e-12), "≤ 1e-12"),
        (Check("", "", "", 1.0, None, 0.9, 1.1), "0.9 to 1.1"),
    ],
)
def test_allowed_range_in_words(row, text):
    assert presentation._allowed(row) == text


def test_results_refuse_what_is_no_number():
    with pytest.raises(TypeError):
        number({"a": [1.0]}, "a")
    with pytest.raises(TypeError):
        numbers({"a": 1.0}, "a")
