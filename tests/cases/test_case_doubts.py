"""What is allowed in a case, but seldom meant, is warned of."""

import pytest
from case_folder import WAVEFORM

from cases.command import main
from cases.reading.case_file import load_case_file
from cases.sections.doubts import doubts_of, mean_of


@pytest.fixture
def doubts(folder):
    """Doubts of the case with another inlet."""

    def of(waveform, inlet=None):
        case_file = folder.write(*(() if inlet is None else (inlet,)))
        (folder.path / "data/inlet.csv").write_text(waveform)
        (case, *_) = load_case_file(case_file).variants.values()
        return list(doubts_of(case)), case.inlet, case_file

    return of


def test_an_ordinary_case_raises_none(doubts):
    assert doubts(WAVEFORM)[0] == []


@pytest.mark.parametrize(
    ("name", "factor", "said"),
    [
        ("t_s", 1000, "takes 800 s, a heart's 0.2 to 3 s: ms under t_s?"),
        ("t_ms", 100, "takes 0.08 s, a heart's 0.2 to 3 s: s under t_ms?"),
    ],
)
def test_a_cycle_that_is_no_hearts(doubts, capsys, name, factor, said):
    times = [f"{factor * time:g},{value}" for time, value in ((0, 10), (0.3, 20), (0.8, 10))]
    (doubt,), _, case_file = doubts("\n".join([f"{name},mean_velocity_cm_s", *times, ""]))
    assert said in doubt
    assert doubt.startswith("inlet: the cycle of ")
    assert main([str(case_file)]) == 0
    err = capsys.readouterr().err.splitlines()
    assert err
    assert all(line.startswith(f"warning: {case_file}: ") and said in line for line in err)


def test_a_mean_inflow_below_zero(doubts):
    (doubt,), inlet, _ = doubts(WAVEFORM.replace(",10", ",-30"))
    assert "a mean inflow below zero, -0.05 m/s: blood leaves by the inlet" in doubt
    assert mean_of(inlet) == pytest.approx(-0.05)


def test_backflow_for_a_part_of_the_cycle_raises_none(doubts):
    assert doubts(WAVEFORM.replace("20.0", "-5.0"))[0] == []
