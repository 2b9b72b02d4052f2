"""FEBio plot files onto cells: manufactured tubes, written as FEBio writes them."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from small_case import bands, small_case, written
from tube_plot import VARIABLES, write_tube
from tubes import Tube

from cases.case_file import load_case_file
from febio_io.errors import FebioError
from validation.errors import UnusableReferenceError
from validation.febio_reference import read_febio

TUBE = Tube(sectors=12, rings=4, stacks=10, layers=2)
TIMES = np.linspace(0.0, 2.392 / 3, 6)


@pytest.fixture
def read(tmp_path):
    """Write a tube, and map it as a case states."""

    def mapped(tube=TUBE, *, reference=None, geometry=None, times=TIMES, **options):
        path = write_tube(tmp_path / "tube.xplt", tube, times, **options)
        content = bands(small_case("none"))
        content["geometry"] |= geometry or {}
        del content["variants"]["none"]["reference"]
        content["reference"] = {"kind": "febio", "axis": "z", "plot_file": str(path)} | (reference or {})
        case = load_case_file(written(content, tmp_path)).variants["none"]
        return read_febio(case, tube.cells(12, 8))

    return mapped


def check(found, tube=TUBE):
    cells = tube.cells(12, 8)
    x, phi = cells.x[:, None], cells.phi[None, :]
    fields = found.fields.isel(time=2)
    for name, exact, share in (
        ("radius", tube.wall(x, phi), 5e-3),
        ("mean_velocity", tube.mean_velocity(x, phi), 0.05),
        ("profile_exponent", tube.gamma(x, phi), 0.08),
        ("pressure", tube.pressure(x), 1e-5),
    ):
        assert np.max(np.abs(fields[name].to_numpy() / exact - 1)) < share, name


@pytest.mark.parametrize("nodal_pressure", [False, True])
@pytest.mark.parametrize(
    ("axis", "phi_zero", "origin"),
    [("z", "x", (0, 0, 0)), ("x", "-z", (0.01, 0.02, -0.03)), ("y", "z", (-0.1, 0.0, 0.0))],
)
def test_a_tube_anywhere(read, axis, phi_zero, origin, nodal_pressure):
    stated = {"axis": axis, "phi_zero": phi_zero, "origin": [f"{part} m" for part in origin]}
    found = read(axis=axis, phi_zero=phi_zero, origin=origin, nodal_pressure=nodal_pressure, reference=stated)
    check(found)
    assert found.notes == ()
    assert found.description["states_compared"] == len(TIMES)


def test_a_tube_of_tetrahedra(read):
    check(read(Tube(sectors=12, rings=4, stacks=10, layers=2, tetrahedra=True)))


def test_a_turned_phi_zero_turns_the_rows(read):
    straight = read().fields["radius"].to_numpy()
    turned = read(reference={"phi_zero": "y"}).fields["radius"].to_numpy()
    assert_allclose(turned, np.roll(straight, -2, axis=2), rtol=1e-6)
    assert np.ptp(straight, axis=2).max() > 1e-4


def test_flow_through_planes_and_inlet_is_reported(read):
    found = read()
    q = found.fields["section_flow_rate"].to_numpy()[0]
    planes = found.checks["plane_flow_rate"].to_numpy()
    assert_allclose(planes, np.broadcast_to(q[[0, 5, 11]], planes.shape), rtol=0.03)
    assert_allclose(found.checks["inlet_area"], TUBE.area(0.0) * np.sinc(1 / 6), rtol=1e-5)


def test_domains_may_be_named(read):
    found = read(names=("A", "B"), reference={"lumen": ["A"], "wall": ["B", "C"]})
    check(found)
    assert found.notes == ("tube.xplt has no domain 'C' (named in reference.wall)",)


@pytest.mark.parametrize(
    ("reference", "said"),
    [
        ({"lumen": ["Blod"]}, r"no domain for reference\.lumen: Blod; the file has: Blood, Blood, Wall"),
        ({"wall": ["Blood"]}, r"named both lumen and wall: Blood"),
        ({"axis": "x"}, r"the lumen (has no plane inlet|runs from)"),
        ({"origin": ["0 m", "0 m", "5 mm"]}, r"starts at reference\.origin and is 0\.015 m long"),
        ({"origin": ["5 mm", "0 m", "0 m"]}, r"the unloaded lumen.s radius is 0\.00531"),
    ],
)
def test_a_reference_that_does_not_fit(read, reference, said):
    with pytest.raises(UnusableReferenceError, match=said):
        read(reference=reference)


def test_another_length(read):
    with pytest.raises(UnusableReferenceError, match=r"over 0\.015 m; .* 0\.016 m long \(geometry\.length\)"):
        read(geometry={"length": "16 mm"})


@pytest.mark.parametrize("missing", VARIABLES)
def test_a_missing_plot_variable_is_named(read, missing):
    with pytest.raises(
        UnusableReferenceError, match=f"tube.xplt: plot variable .*{missing}.* is missing"
    ) as e:
        read(variables=[name for name in VARIABLES if name != missing])
    assert all(name in str(e.value) for name in VARIABLES)


def test_too_few_states(read):
    with pytest.raises(UnusableReferenceError, match="states in the last cycle: 2"):
        read(times=[0.1, 0.2])


def test_no_states(read):
    with pytest.raises(FebioError, match="the file has no states"):
        read(times=[])


def test_progress_is_reported(tmp_path):
    path = write_tube(tmp_path / "tube.xplt", TUBE, TIMES)
    content = bands(small_case("none"))
    content["variants"]["none"]["reference"] = {"plot_file": str(path)}
    content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
    case = load_case_file(written(content, tmp_path)).variants["none"]
    seen = SimpleNamespace(calls=[])
    read_febio(case, TUBE.cells(12, 8), lambda done, total: seen.calls.append((done, total)))
    assert seen.calls == [(n, len(TIMES)) for n in range(1, len(TIMES) + 1)]
