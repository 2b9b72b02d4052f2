from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from cases.reading.variants import DISCRIMINATORS, KEYS_OF_KINDS, merge_variant
from cases.reading.yaml_nodes import Node, parse_yaml

words = st.text("abc", min_size=1, max_size=2)
trees = st.dictionaries(words, st.recursive(words, lambda below: st.dictionaries(words, below), max_leaves=6))


def node(value, line=1, key=""):
    if isinstance(value, dict):
        return Node({name: node(below, line, name) for name, below in value.items()}, line, key)
    return Node(value, line, key)


def merged(base: str, override: str) -> object:
    path = Path("x.yaml")
    return merge_variant(parse_yaml(base, path), parse_yaml(override, path)).plain()


@given(trees)
def test_merging_nothing_changes_nothing(tree):
    assert merge_variant(node(tree), node({})).plain() == tree


@given(trees, trees)
def test_an_override_wins_and_nothing_else_changes(base, override):
    result = merge_variant(node(base), node(override)).plain()

    def check(result, base, override):
        assert set(result) == set(base) | set(override)
        for key, value in result.items():
            if key not in override:
                assert value == base[key]
            elif isinstance(value, dict) and isinstance(base.get(key), dict):
                check(value, base[key], override[key])
            else:
                assert value == override[key]

    check(result, base, override)


@given(trees, trees)
def test_merging_twice_is_merging_once(base, override):
    once = merge_variant(node(base), node(override))
    assert merge_variant(once, node(override)).plain() == once.plain()


def test_sections_merge_and_lists_are_replaced():
    assert merged("wall: {law: thin, x: [1, 2]}", "wall: {x: [3]}") == {"wall": {"law": "thin", "x": [3]}}


def test_another_discriminator_replaces_the_section():
    for section, key in DISCRIMINATORS.items():
        if section in KEYS_OF_KINDS:
            continue
        base = f"{section}: {{{key}: old, a: 1}}"
        assert merged(base, f"{section}: {{{key}: new, b: 2}}") == {section: {key: "new", "b": 2}}
        assert merged(base, f"{section}: {{{key}: old, b: 2}}") == {section: {key: "old", "a": 1, "b": 2}}
        assert merged(base, f"{section}: {{b: 2}}") == {section: {key: "old", "a": 1, "b": 2}}


def test_values_keep_their_lines():
    path = Path("x.yaml")
    base = parse_yaml("wall:\n  law: thin\n  nu: 0.4\n", path)
    override = parse_yaml("#\n#\n#\nwall:\n  nu: 0.3\n", path)
    result = merge_variant(base, override)
    assert result.find(("wall", "law")).line == 2
    assert result.find(("wall", "nu")).line == 5
    assert result.find(("wall", "missing")).line == 4


def test_bands_may_differ_and_equal_tables_may_be_stated(folder):
    cells, times = "{i: [1, 39, 61, 82, 120]}", "[systole, second trough, end diastole]"
    same = f"compare: {{bands: [], cells: {cells}, times: {times}}}"
    file = folder.load(("title: A patch", same))
    none, local = file.variants["none"].compare, file.variants["local"].compare
    assert (len(none.bands), len(local.bands)) == (1, 0)
    assert (none.cells, none.times) == (local.cells, local.times)


def test_default_tables_may_differ_with_the_grid_and_the_inlet(folder):
    override = (
        "title: A patch\n    solver: {n_x: 60}\n    inlet: {kind: pressure, value: 1 kPa, period: 0.8 s}"
    )
    none, local = (case.compare for case in folder.load(("title: A patch", override)).variants.values())
    assert none.cells.i == (1, 39, 61, 82, 120)
    assert local.cells.i == (1, 20, 31, 41, 60)
    assert local.times == ("end diastole",)


def test_variants_override_the_base(folder):
    override = "title: A patch\n    solver: {n_x: 60}\n    inlet: {waveform: null, value: 10 cm/s}"
    file = folder.load(("title: A patch", override))
    none, local = file.variants["none"], file.variants["local"]
    assert (none.solver.n_x, local.solver.n_x) == (120, 60)
    assert (none.solver.n_phi, local.solver.n_phi) == (48, 48)
    assert (none.inlet.value, local.inlet.value) == (None, 0.1)
    assert none.calcification.pattern == "none"
    assert local.calcification.pattern == "local"
    assert (none.title, local.title) == ("none", "A patch")
    assert local.geometry == none.geometry
