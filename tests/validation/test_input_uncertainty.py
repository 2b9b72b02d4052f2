"""What uncertain inputs leave open of the reduced model's results, where that is known in closed form."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from small_case import small_case, written

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file
from cases.reading.template import load_template
from validation.compare.budget.inputs import input_uncertainty
from validation.compare.budget.spread import RunningSpread, relative_spread
from validation.runs.cache import Cache

pytestmark = pytest.mark.slow

RESISTANCE, OFFSET, FLOW = 1.358e9, 9330.0, 5e-6
INSTANTS = np.array([0.05, 0.1])
REASON = {"reason": "stated"}


def steady_case(folder, inputs, **stated):
    """A constant flow through the ready artery: behind it P = offset + resistance × flow."""
    case = small_case("none", "local")
    case["inlet"] = {"kind": "flow", "value": "5 ml/s", "period": "0.1 s"}
    case["compare"] = {"cells": {"i": [1], "j": [1]}}
    case["uncertainty"] = {"inputs": {key: each | REASON for key, each in inputs.items()}} | stated
    return written(case, folder)


def found(path, quantities, variant="none", store=None):
    said = []
    case = load_case_file(path).variants[variant]
    return input_uncertainty(
        lambda: load_template(path, variant), case, INSTANTS, quantities, store, said.append
    ), said


def of_pressure(resistance=0.0, offset=0.0):
    """dP/P at the outlet; the loss along the artery is 1e-3 of P."""
    spread = np.hypot(resistance * RESISTANCE * FLOW, offset)
    return spread / (OFFSET + RESISTANCE * FLOW)


@pytest.mark.parametrize(("method", "within"), [("local", 2e-3), ("latin_hypercube", 0.05)])
def test_of_a_resistance_in_closed_form(tmp_path, method, within):
    inputs = {"outlet.resistance": {"relative": "10 %"}}
    relative, said = found(
        steady_case(tmp_path, inputs, method=method), ("pressure", "section_flow_rate", "systolic_pressure")
    )
    assert said == []
    assert relative["pressure"] == pytest.approx(of_pressure(0.1), rel=within)
    assert relative["systolic_pressure"] == pytest.approx(of_pressure(0.1), rel=within)
    assert relative["section_flow_rate"] < 1e-9


@pytest.mark.parametrize(("method", "within"), [("local", 2e-3), ("latin_hypercube", 0.1)])
def test_inputs_add_as_variances(tmp_path, method, within):
    inputs = {
        "outlet.resistance": {"relative": "10 %"},
        "outlet.offset": {"standard_deviation": "1 kPa"},
    }
    relative, _ = found(steady_case(tmp_path, inputs, method=method), ("pressure",))
    assert relative["pressure"] == pytest.approx(of_pressure(0.1, 1e3), rel=within)


@pytest.mark.parametrize(("method", "within"), [("local", 2e-3), ("latin_hypercube", 0.02)])
def test_a_range_is_uniform(tmp_path, method, within):
    inputs = {"outlet.offset": {"range": ["9 kPa", "10 kPa"]}}
    relative, _ = found(steady_case(tmp_path, inputs, method=method), ("pressure",))
    mean = 9500.0 if method == "latin_hypercube" else OFFSET
    spread = 1e3 / np.sqrt(12) / (mean + RESISTANCE * FLOW)
    assert relative["pressure"] == pytest.approx(spread, rel=within)


def test_seeds_reproduce(tmp_path):
    inputs = {"wall.youngs_modulus": {"relative": "20 %"}, "outlet.resistance": {"relative": "10 %"}}
    quantities = ("pressure", "radius", "sector_flow_share", "axial_velocity")
    first, again, other = (
        found(steady_case(tmp_path, inputs, samples=12, seed=seed), quantities, "local")[0]
        for seed in (3, 3, 4)
    )
    assert first == again
    assert first != other
    assert set(first) == {"pressure", "radius", "sector_flow_share"}  # those on rays have no number


def test_what_a_variant_lacks_is_left_out_and_said(tmp_path):
    inputs = {
        "outlet.resistance": {"relative": "10 %"},
        "calcification.youngs_modulus": {"range": ["5 MPa", "20 MPa"]},
    }
    path = steady_case(tmp_path, inputs, method="local")
    relative, said = found(path, ("pressure", "radius"))
    assert said == ["uncertainty: has no calcification.youngs_modulus: left out"]
    patched, said = found(path, ("pressure", "radius"), "local")
    assert said == []
    assert patched["radius"] > 0
    assert relative["pressure"] == pytest.approx(patched["pressure"], rel=0.01)


def test_failed_samples_are_said(tmp_path):
    """Viscosities below those that a case may have are samples that fail."""
    inputs = {"blood.viscosity": {"standard_deviation": "0.001405 Pa s"}}
    path = steady_case(tmp_path, inputs, samples=160)
    relative, said = found(path, ("pressure",))
    assert said == ["uncertainty: 1 of 160 samples failed"]
    assert relative["pressure"] > 0
    inputs = {"blood.viscosity": {"standard_deviation": "0.011 Pa s"}}
    relative, said = found(steady_case(tmp_path, inputs, samples=16), ("pressure",))
    assert relative == {}
    assert said == ["uncertainty: 6 of 16 samples failed: no number"]


def test_a_result_is_kept(tmp_path, monkeypatch):
    inputs = {"outlet.resistance": {"relative": "10 %"}}
    path = steady_case(tmp_path, inputs, samples=8)
    store = Cache(tmp_path / "cache")
    store.folder.mkdir()
    first, _ = found(path, ("pressure",), store=store)
    monkeypatch.setattr("validation.compare.budget.inputs.run_batch", None)
    assert found(path, ("pressure",), store=store)[0] == first
    with pytest.raises(TypeError):
        found(steady_case(tmp_path, inputs, samples=9), ("pressure",), store=store)


def test_nothing_uncertain_gives_nothing(tmp_path):
    path = written(small_case("none"), tmp_path)
    assert found(path, ("pressure",)) == ({}, [])


@pytest.mark.parametrize(
    ("inputs", "stated", "message"),
    [
        (
            {"wall.youngs_modulus": {"relative": "20"}},
            {},
            "youngs_modulus.relative: 20; allowed: a positive p",
        ),
        ({"wall.youngs_modulus": {"relative": "-5 %"}}, {}, "relative: -5 %; allowed: a positive percentage"),
        (
            {"wall.young_modulus": {"relative": "20 %"}},
            {},
            "no number of the case that may be uncertain; did you mean wall.youngs_modulus? allowed: ",
        ),
        ({"solver.n_x": {"relative": "20 %"}}, {}, "solver.n_x: no number of the case that may be uncertain"),
        ({"inlet.period": {"relative": "2 %"}}, {}, "inlet.period: no number of the case that may be uncert"),
        (
            {"wall.youngs_modulus": {"standard_deviation": "1 mm"}},
            {},
            "standard_deviation: 1 mm: mm is no unit of pressure; allowed: a positive pressure with its unit",
        ),
        (
            {"wall.youngs_modulus": {"standard_deviation": "-1 kPa"}},
            {},
            "standard_deviation: -1 kPa; allowed: a positive pressure with its unit",
        ),
        (
            {"wall.youngs_modulus": {"range": ["1 MPa", "2 MPa"]}},
            {},
            "range: 1 MPa to 2 MPa; allowed: a low and a high value around that of the case (600000.0 Pa)",
        ),
        ({"wall.youngs_modulus": {"range": "1 MPa"}}, {}, "range: 1 MPa; allowed: [low, high]"),
        ({"wall.youngs_modulus": {"range": ["0 MPa", "1 MPa"]}}, {}, "range[1]: 0 MPa; allowed: "),
        (
            {"wall.youngs_modulus": {"relative": "2 %", "range": ["0.5 MPa", "1 MPa"]}},
            {},
            "range, relative; allowed: exactly one of standard_deviation, range, relative",
        ),
        ({"wall.youngs_modulus": {}}, {}, "none of them; allowed: exactly one of standard_deviation, range"),
        ({"wall.youngs_modulus": {"relativ": "2 %"}}, {}, "unknown key relativ; did you mean relative? "),
        (
            {"wall.reference_pressure": {"relative": "2 %"}},
            {},
            "a share of 0; allowed: standard_deviation",
        ),
        ({}, {}, "uncertainty.inputs: a section; allowed: keys of the case, each with one of standard_devi"),
        ({"blood.viscosity": {"relative": "2 %"}}, {"method": "sobol"}, "method: sobol; allowed: latin_hyp"),
        ({"blood.viscosity": {"relative": "2 %"}}, {"samples": 0}, "samples: 0; allowed: a whole number fr"),
        ({"blood.viscosity": {"relative": "2 %"}}, {"sample": 8}, "unknown key sample; did you mean sampl"),
    ],
)
def test_one_message_for_what_is_wrong(tmp_path, inputs, stated, message):
    with pytest.raises(CaseFileError) as caught:
        load_case_file(steady_case(tmp_path, inputs, **stated))
    (line,) = str(caught.value).splitlines()
    assert message in line
    text = (tmp_path / "small.yaml").read_text().splitlines()
    number = int(line.partition("line ")[2].partition(":")[0])
    assert number > text.index("uncertainty:")


def test_a_reason_is_required(tmp_path):
    case = small_case("none")
    case["uncertainty"] = {"inputs": {"wall.youngs_modulus": {"relative": "20 %"}}}
    with pytest.raises(CaseFileError, match=r"youngs_modulus\.reason: nothing; allowed: a text, where"):
        load_case_file(written(case, tmp_path))


@given(
    arrays(float, st.tuples(st.integers(2, 30), st.integers(1, 4)), elements=st.floats(-1e3, 1e3, width=32))
)
def test_running_sums_give_mean_and_variance(values):
    spread = RunningSpread()
    for each in values:
        spread.add({"pressure": each})
    assert np.allclose(spread.mean["pressure"], values.mean(axis=0), rtol=1e-10, atol=1e-10)
    assert np.allclose(spread.variance["pressure"], values.var(axis=0, ddof=1), rtol=1e-9, atol=1e-7)


def test_a_spread_relative_to_nothing_is_none():
    mean = {"pressure": np.array([1.0, -2.0]), "flow": np.array([1.0, 0.0])}
    variance = {"pressure": np.array([0.01, 0.16]), "flow": np.array([0.01, 0.01])}
    assert relative_spread(mean, variance) == {"pressure": pytest.approx(np.sqrt((0.01 + 0.04) / 2))}


def test_an_inflow_read_from_the_reference_is_that_of_the_samples(tmp_path):
    path = steady_case(tmp_path, {"outlet.resistance": {"relative": "10 %"}}, method="local")
    driven = load_case_file(path).variants["none"]
    expected, _ = found(path, ("pressure",))
    text = path.read_text(encoding="utf-8").replace("kind: flow", "kind: reference")
    path.write_text("".join(line for line in text.splitlines(True) if "value: 5 ml/s" not in line))
    relative = input_uncertainty(lambda: load_template(path, "none"), driven, INSTANTS, ("pressure",))
    assert relative == expected
