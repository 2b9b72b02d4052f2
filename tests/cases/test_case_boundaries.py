"""Inlets and outlets: what each states, and from where a run starts."""

import pytest

from cases.errors import CaseError
from cases.sections.inlet import FlowInlet, PressureInlet, VelocityInlet
from cases.sections.outlet import NonReflectingOutlet, PressureOutlet, WindkesselOutlet
from solver.case.model import inlet_signal

INLET = "{kind: velocity, waveform: data/inlet.csv}"
OUTLET = "{kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}"


def case_of(folder, inlet=INLET, outlet=OUTLET, *edits):
    return folder.load((INLET, inlet), (OUTLET, outlet), *edits).variants["none"]


def test_waveforms_of_each_quantity(folder):
    inlet = case_of(folder, "{kind: flow, waveform: data/flow.csv}").inlet
    assert isinstance(inlet, FlowInlet)
    assert inlet.waveform.values == pytest.approx([5e-6, 1e-5, 5e-6], rel=1e-15)
    inlet = case_of(folder, "{kind: pressure, waveform: data/pressure.csv}").inlet
    assert isinstance(inlet, PressureInlet)
    assert inlet.waveform.values == pytest.approx([10665.7909932, 15998.6864898, 10665.7909932], rel=1e-15)
    assert inlet.period == 0.8
    assert isinstance(case_of(folder).inlet, VelocityInlet)


@pytest.mark.parametrize(
    ("kind", "value", "si"),
    [("velocity", "-10 cm/s", -0.1), ("flow", "6 cm^3/s", 6e-6), ("pressure", "16 kPa", 16e3)],
)
def test_constants_of_each_quantity(folder, kind, value, si):
    inlet = case_of(folder, f"{{kind: {kind}, value: {value}, period: 0.5 s}}").inlet
    assert (inlet.value, inlet.waveform, inlet.fourier, inlet.period) == (si, None, None, 0.5)


@pytest.mark.parametrize(
    ("kind", "unit", "factor"), [("velocity", "cm/s", 0.01), ("flow", "l/s", 0.001), ("pressure", "kPa", 1e3)]
)
def test_a_fourier_series_has_a_period_of_its_own(folder, kind, unit, factor):
    series = f"period: 700 ms, mean: 5 {unit}, cosines: [1 {unit}, 2 {unit}], sines: [3 {unit}, 4 {unit}]"
    inlet = case_of(folder, f"{{kind: {kind}, fourier: {{{series}}}}}").inlet
    assert (inlet.period, inlet.fourier.period) == (0.7, 0.7)
    assert inlet.fourier.mean == pytest.approx(5 * factor)
    assert inlet.fourier.cosines == pytest.approx((factor, 2 * factor))
    assert inlet.fourier.sines == pytest.approx((3 * factor, 4 * factor))


def test_a_resistance_may_be_zero(folder):
    assert case_of(folder, outlet=OUTLET.replace("1.358e9", "0")).outlet.resistance == 0.0


def test_a_windkessel(folder):
    resistances = "proximal_resistance: 1e8 Pa s/m^3, distal_resistance: 1 mmHg s/ml"
    outlet = case_of(folder, outlet=f"{{kind: windkessel, {resistances}, compliance: 1 ml/mmHg}}").outlet
    assert isinstance(outlet, WindkesselOutlet)
    assert outlet.proximal_resistance == 1e8
    assert outlet.distal_resistance == pytest.approx(1.33322387415e8)
    assert outlet.compliance == pytest.approx(1 / 1.33322387415e8)
    assert outlet.venous_pressure == 0.0


def test_a_non_reflecting_outlet_states_no_more(folder):
    assert isinstance(case_of(folder, outlet="{kind: non_reflecting}").outlet, NonReflectingOutlet)


def test_a_pressure_outlet_is_constant_or_a_waveform(folder):
    outlet = case_of(folder, outlet="{kind: pressure, value: -1 kPa}").outlet
    assert isinstance(outlet, PressureOutlet)
    assert (outlet.value, outlet.waveform) == (-1000.0, None)
    outlet = case_of(folder, outlet="{kind: pressure, waveform: data/pressure.csv}").outlet
    assert outlet.value is None
    assert outlet.waveform.period == 0.8


PRESSURE_INLET = "{kind: pressure, value: 1 kPa}"


@pytest.mark.parametrize(
    ("inlet", "outlet", "start"),
    [
        (INLET, OUTLET, "steady"),
        (INLET, "{kind: non_reflecting}", "rest"),
        (PRESSURE_INLET, OUTLET, "steady"),
        (PRESSURE_INLET, "{kind: non_reflecting}", "rest"),
        (INLET.replace("}", ", ramp: 8 ms}"), OUTLET, "rest"),
        (INLET, OUTLET.replace("}", ", ramp: 8 ms}"), "rest"),
    ],
)
def test_a_run_starts_steady_unless_a_ramp_or_the_boundaries_forbid_it(folder, inlet, outlet, start):
    assert case_of(folder, inlet, outlet).solver.start == start
    for stated in ("steady", "rest"):
        edit = ("average", f"average\n  start: {stated}")
        assert case_of(folder, inlet, outlet, edit).solver.start == stated


def test_ramps_are_times(folder):
    case = case_of(folder, INLET.replace("}", ", ramp: 8 ms}"), OUTLET.replace("}", ", ramp: 4 ms}"))
    assert (case.inlet.ramp, case.outlet.ramp) == (0.008, 0.004)
    assert (case_of(folder).inlet.ramp, case_of(folder).outlet.ramp) == (None, None)


def test_a_waveform_may_be_a_spline(folder):
    assert case_of(folder).inlet.interpolation == "monotone"
    assert case_of(folder, INLET.replace("}", ", interpolation: spline}")).inlet.interpolation == "spline"
    (problem,) = folder.problems((INLET, INLET.replace("}", ", interpolation: cubic}")))
    assert "inlet.interpolation: cubic; allowed: monotone, spline" in problem
    (problem,) = folder.problems((INLET, "{kind: velocity, value: 8 cm/s, interpolation: spline}"))
    assert "inlet.interpolation: spline; allowed: only beside waveform" in problem


def test_another_kind_of_inlet_replaces_it(folder):
    override = ("title: A patch", "title: A patch\n    inlet: {kind: pressure, value: 1 kPa}")
    inlet = folder.load(override).variants["local"].inlet
    assert (inlet.kind, inlet.value, inlet.waveform) == ("pressure", 1000.0, None)


def test_a_case_knows_the_files_that_it_was_read_from(folder):
    wall = ("{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}", "")
    table = (wall[0], "{law: table, table: data/wall.csv, youngs_modulus: 0.6 MPa}")
    case = case_of(folder, INLET, "{kind: pressure, waveform: data/pressure.csv}", table)
    names = ("run.xplt", "wall.csv", "inlet.csv", "pressure.csv")
    assert case.input_files == tuple((folder.path / "data" / name).resolve() for name in names)
    case = case_of(
        folder, PRESSURE_INLET, OUTLET, ("reference: {kind: febio, plot_file: data/run.xplt, axis: z}\n", "")
    )
    assert case.input_files == ()


def test_an_inlet_may_be_scaled(folder):
    assert case_of(folder).inlet.scale == 1.0
    scaled = case_of(folder, INLET.replace("}", ", scale: 1.2}"))
    signal, own = inlet_signal(scaled), inlet_signal(case_of(folder))
    assert signal(0.1) == pytest.approx(1.2 * float(own(0.1)), rel=1e-15)


@pytest.mark.parametrize("scale", ["0", "-1", "1e9", ".nan", "2 m"])
def test_scales_that_are_refused(folder, scale):
    with pytest.raises(CaseError, match=r"inlet\.scale: .*allowed: a number from 0\.001 to 1000"):
        case_of(folder, INLET.replace("}", f", scale: {scale}}}"))
