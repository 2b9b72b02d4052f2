"""Designs: within bounds, the same for the same seed, and each with the structure that its name promises."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from cases.reading.numeric_keys import NumericKey
from cases.values.kinds import quantity
from cases.values.ranges import MODULI
from validation.sweep.design import Design, points, samples_of
from validation.sweep.display import Display
from validation.sweep.parameters import Parameter

KEY = NumericKey("wall.youngs_modulus", ("wall", "youngs_modulus"), quantity(MODULI, "1 MPa"), False, None)


def parameter(kind, values=None, **numbers):
    return Parameter(KEY, "", Display("Pa", 1.0), kind, numbers, None if values is None else np.array(values))


sizes = st.floats(1.0, 1e9)
ends = st.tuples(sizes, st.floats(1.01, 1e3)).map(lambda pair: (pair[0], pair[0] * pair[1]))
inner = st.floats(0.0, 1.0)


@st.composite
def parameters(draw):
    low, high = draw(ends)
    between = low + draw(inner) * (high - low)
    kind = draw(st.sampled_from(["uniform", "loguniform", "triangular", "normal", "list"]))
    if kind == "list":
        return parameter("list", draw(st.lists(sizes, min_size=1, max_size=5)))
    extra = {"triangular": {"mode": between}, "normal": {"mean": between, "standard_deviation": 0.3 * high}}
    return parameter(kind, low=low, high=high, **extra.get(kind, {}))


@st.composite
def spread_designs(draw):
    kind = draw(st.sampled_from(["latin_hypercube", "sobol", "saltelli"]))
    count = draw(st.sampled_from([1, 2, 8, 16] if kind != "latin_hypercube" else [1, 3, 10]))
    return Design(kind=kind, count=count, seed=draw(st.integers(0, 2**32 - 1)))


@given(spread_designs(), st.lists(parameters(), min_size=1, max_size=4))
def test_samples_keep_their_bounds_and_depend_on_the_seed_alone(design, varied):
    found = points(design, varied)
    assert found.shape == (samples_of(design, varied), len(varied))
    for column, each in zip(found.T, varied, strict=True):
        low, high = each.limits
        assert np.all((column >= low) & (column <= high))
        if each.values is not None:
            assert set(column) <= set(each.values)
    np.testing.assert_array_equal(points(design, varied), found)


@pytest.mark.parametrize("kind", ["latin_hypercube", "sobol", "saltelli"])
def test_another_seed_gives_other_samples(kind):
    varied = [parameter("uniform", low=1.0, high=2.0)] * 2
    one, other = (points(Design(kind=kind, count=8, seed=seed), varied) for seed in (1, 2))
    assert np.all(one != other)


@given(st.lists(st.lists(sizes, min_size=1, max_size=4, unique=True), min_size=1, max_size=3))
def test_a_grid_has_every_combination_once(values):
    varied = [parameter("list", each) for each in values]
    found = points(Design(kind="grid"), varied)
    assert [tuple(row) for row in found] == list(itertools.product(*values))


def test_a_list_goes_row_by_row():
    varied = [parameter("list", [1.0, 2.0, 3.0]), parameter("range", [4.0, 5.0, 6.0])]
    assert points(Design(kind="list"), varied).tolist() == [[1, 4], [2, 5], [3, 6]]


def test_a_latin_hypercube_has_one_sample_in_each_slice_of_each_parameter():
    found = points(Design(kind="latin_hypercube", count=50), [parameter("uniform", low=0.0, high=1.0)] * 3)
    for column in found.T:
        assert sorted((column * 50).astype(int)) == list(range(50))


def test_a_saltelli_design_exchanges_one_parameter_at_a_time():
    varied = [parameter("uniform", low=0.0, high=1.0)] * 3
    groups = points(Design(kind="saltelli", count=16, seed=3), varied).reshape(16, 5, 3)
    first, last = groups[:, 0], groups[:, -1]
    for n in range(3):
        exchanged = first.copy()
        exchanged[:, n] = last[:, n]
        np.testing.assert_array_equal(groups[:, n + 1], exchanged)


@pytest.mark.parametrize(
    ("varied", "law"),
    [
        (parameter("uniform", low=2.0, high=6.0), stats.uniform(2.0, 4.0)),
        (parameter("loguniform", low=1.0, high=100.0), stats.loguniform(1.0, 100.0)),
        (parameter("triangular", low=0.0, mode=1.0, high=4.0), stats.triang(0.25, 0.0, 4.0)),
        (parameter("normal", mean=3.0, standard_deviation=0.5), stats.norm(3.0, 0.5)),
        (
            parameter("normal", mean=3.0, standard_deviation=0.5, low=2.5, high=3.2),
            stats.truncnorm(-1.0, 0.4, 3.0, 0.5),
        ),
    ],
)
def test_samples_follow_their_law(varied, law):
    found = points(Design(kind="sobol", count=1024, seed=5), [varied])[:, 0]
    assert stats.kstest(found, law.cdf).statistic < 3e-3
