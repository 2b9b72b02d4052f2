"""What a report tells of the cost of 3D and of FEBio's data records."""

import json

import pytest
from synthetic_comparison import COST, Setup, write

from reports.errors import ReportError
from reports.result.load import load
from reports.sections.parts import cost

RECORD = {
    "file": "axis.txt",
    "columns": ["x", "nfvx"],
    "instants": 41,
    "values": 82,
    "largest_difference": 3.7e-8,
}


@pytest.fixture
def comparison(tmp_path):
    """Write a comparison whose first variant has facts of its 3D run."""

    def loaded(rom=None, **facts):
        write(tmp_path, Setup(n_x=6, n_phi=4, n_time=7, n_y=5, i=(1, 3), j=(1, 3)))
        path = tmp_path / "provenance.json"
        content = json.loads(path.read_text(encoding="utf-8"))
        content["variants"]["none"]["reference"] |= facts
        content["variants"]["none"]["models"]["rom"] |= rom or {}
        path.write_text(json.dumps(content), encoding="utf-8")
        return load(tmp_path)

    return loaded


def test_without_log_and_records_there_is_nothing_to_tell(comparison):
    plain = comparison()
    assert (cost.cost_table(plain), cost.records_table(plain)) == (None, None)


def test_the_cost_of_both_models(comparison):
    read = comparison({"simulation_wall_time_s": 0.5}, cost=COST)
    table = cost.cost_table(read)
    per_cycle = (949.057 / (1.794 / read.period)) / (0.5 / 3)
    assert [tuple(text.replace("\u00a0", " ") for text in row) for row in table.rows] == [
        (
            "none", "15.8 min", "1.794 s", "450 (2 retried)", "2211", "37572", "normally (FEBio 4.11.0)",
            "0.500 s", "3", "2391", f"{per_cycle:.0f}",
        )
    ]  # fmt: skip


def test_what_the_log_does_not_tell_is_left_out(comparison):
    unknown = dict.fromkeys(("wall_time_s", "simulated_s", "equations", "febio_version"))
    (row,) = cost.cost_table(comparison(cost=COST | unknown)).rows
    assert row == (
        "none",
        "—",
        "—",
        "450 (2 retried)",
        "2211",
        "—",
        "normally (FEBio)",
        "—",
        "3",
        "2391",
        "—",
    )


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.5, "0.500 s"), (119, "119 s"), (1e4, "2.78 h"), (1e6, "11.6 d")]
)
def test_long_times_are_in_long_units(comparison, seconds, text):
    (row,) = cost.cost_table(comparison(cost=COST | {"wall_time_s": seconds})).rows
    assert row[1].replace("\u00a0", " ") == text


def test_data_records(comparison):
    (row,) = cost.records_table(comparison(data_records=[RECORD])).rows
    assert row == ("none", "axis.txt", "x, nfvx", "41", "82", "3.7e-08")


def test_the_cost_of_2d_is_told_once(comparison):
    assert (
        "simulation_wall_time_s"
        not in comparison({"simulation_wall_time_s": 0.5}).provenance.variants["none"].models["rom"].facts()
    )


def test_neither_is_listed_among_the_settings(comparison):
    facts = comparison(cost=COST, data_records=[RECORD]).provenance.variants["none"].reference.facts()
    assert not {"cost", "data_records"} & set(facts)


def test_a_cost_of_another_kind_is_refused(comparison):
    with pytest.raises(ReportError, match=r"cost, wall_time_s: .* found 'long'"):
        comparison(cost=COST | {"wall_time_s": "long"})
