"""Reduced models that a case file names: what each states, and what is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cases.command import main
from cases.errors import CaseError, Problem
from cases.reading.case_file import merged
from cases.reading.models import OF_A_MODEL, labelled, models_of
from cases.reading.yaml_nodes import Node
from cases.results.comparison_file import REFERENCE, variable, variables

MODELS = """\
models:
  row:
  coupled:
    wall: {law: membrane, base: thick}
    solver: {pressure: section}
variants:
"""


def with_models(text):
    """The edit that gives the base case these models."""
    return "variants:\n", f"models: {text}\nvariants:\n"


def test_a_model_overrides_base_and_variants(folder):
    file = folder.load(("variants:\n", MODELS), ("    title: A patch", "    wall: {youngs_modulus: 0.8 MPa}"))
    assert list(file.models) == ["row", "coupled"]
    assert file.variants is file.models["row"] is file.model(None) is file.model("row")
    for name in ("none", "local"):
        row, coupled = (file.models[model][name] for model in ("row", "coupled"))
        assert (row.wall.law, coupled.wall.law, coupled.wall.base) == ("thick", "membrane", "thick")
        assert row.wall.youngs_modulus == coupled.wall.youngs_modulus == {"none": 6e5, "local": 8e5}[name]
        assert (row.solver.pressure, coupled.solver.pressure) == ("row", "section")
        same = {"wall": row.wall, "solver": row.solver}
        assert coupled.model_copy(update=same) == row


def test_a_model_has_the_last_word(folder):
    file = folder.load(
        with_models("{a: {wall: {youngs_modulus: 3 MPa}}, b: {}}"),
        ("    title: A patch", "    wall: {youngs_modulus: 2 MPa}"),
    )
    found = {(m, v): case.wall.youngs_modulus for m, of in file.models.items() for v, case in of.items()}
    assert found == {("a", "none"): 3e6, ("a", "local"): 3e6, ("b", "none"): 6e5, ("b", "local"): 2e6}


def test_without_models_there_is_one(folder):
    file = folder.load()
    assert list(file.models) == ["rom"]
    assert file.variants == folder.load(with_models("{any: {}}")).models["any"]


def test_an_unknown_model_is_refused(folder):
    with pytest.raises(CaseError, match=r"x\.yaml: has no model 'c'; allowed: row, coupled"):
        folder.load(("variants:\n", MODELS)).model("c")


@pytest.mark.parametrize(
    ("models", "message"),
    [
        ("{a: {wall: {law: thin}, blood: {density: 1}}}", "models.a.blood: unknown key blood; allowed: "),
        ("{a: {compare: {}}}", "models.a.compare: unknown key compare; allowed: wall, solver, uncertainty"),
        ("{a: {walls: {}}}", "models.a.walls: unknown key walls; did you mean wall? allowed: "),
        ("{a: 3}", "models.a: 3; allowed: a section with the keys wall, solver, uncertainty"),
        ("{a: {wall: {law: glass}}}", "models.a.wall.law: glass; allowed: thin, thick, "),
        ("{a: {wall: {young: 1 MPa}}}", "models.a.wall.young: unknown key young; "),
        ("{}", "models: a section; allowed: a section for each model, under its name"),
        ("[a]", "models: a list; allowed: a section for each model, under its name"),
        ("{a b: {}}", "models: model name a b; allowed: up to 64 letters, digits, - and _"),
        ("{reference: {}}", "models: model name reference, which is the 3D reference; allowed: another name"),
        ("{reference_2: {}}", "models: model name reference_2, which begins as the fields of reference do; "),
        (
            "{row: {}, Row: {}}",
            "models: model name Row, which differs from row in capitals only, as no file ",
        ),
        ("{a_b: {}, a: {}}", "models: model name a_b, which begins as the fields of a do; allowed: another"),
        ("{a: {}, b: {solver: {n_phi: 24}}}", "models.b.solver.n_phi: 24, but 48 in model a; allowed: the "),
        ("{a: {solver: {n_x: 60}}, b: }", "solver.n_x: 120, but 60 in model a; allowed: the same n_x in all"),
    ],
)
def test_each_problem_is_one_line_at_its_place(folder, models, message):
    (problem,) = folder.problems(with_models(models))
    place, problem = problem.split(": ", 1)
    line = 14 if message.startswith("solver.n_x") else 26
    assert (place, problem[: len(message)]) == (f"x.yaml, line {line}", message)


def test_a_problem_of_the_base_is_told_once(folder):
    (problem,) = folder.problems(("variants:\n", MODELS), ("radius: 2.5 mm", "radius: 2.5"))
    assert problem.startswith("x.yaml, line 5: geometry.radius: 2.5: no unit; ")
    assert "model" not in problem


def test_a_problem_of_some_models_names_them(folder):
    """Only a membrane has supports; where a key stands in a variant or a model, that names it."""
    supports = ("poisson_ratio: 0.48}", "poisson_ratio: 0.48, supports: free}")
    (problem,) = folder.problems(("variants:\n", MODELS), supports)
    assert problem.startswith("x.yaml, line 8: wall.supports: only with law membrane; ")
    assert problem.endswith(" (model row)")
    (problem,) = folder.problems(
        ("variants:\n", MODELS), ("    title: A patch", "    wall: {supports: free}")
    )
    assert problem.startswith("x.yaml, line 34: variants.local.wall.supports: only with law membrane; ")
    assert problem.endswith(" (model row)")
    (problem,) = folder.problems(
        with_models("{a: {wall: {supports: free}}}"),
        ("    title: A patch", "    wall: {law: membrane, base: thick}"),
    )
    assert problem.startswith("x.yaml, line 26: models.a.wall.supports: only with law membrane; ")
    assert problem.endswith(" (variant none)")


def test_a_number_that_one_model_has_may_be_uncertain(folder):
    inputs = "{inputs: {wall.supports_stiffness: {relative: 10 %, reason: measured}}}"
    (problem,) = folder.problems(("variants:\n", f"uncertainty: {inputs}\n{MODELS}"))
    assert problem.startswith("x.yaml, line 26: uncertainty.inputs.wall.supports_stiffness: no number of ")
    of_one = "{a: {}, b: {wall: {law: table, table: data/wall.csv}}}"
    inputs = "{inputs: {wall.poisson_ratio: {relative: 10 %, reason: measured}}}"
    file = folder.load(with_models(f"{of_one}\nuncertainty: {inputs}"))
    assert [len(file.models[name]["none"].uncertainty.inputs) for name in "ab"] == [1, 1]


names = st.text("ab_", min_size=1, max_size=5)


@given(st.lists(names, min_size=1, max_size=4, unique=True))
def test_names_that_are_accepted_never_share_a_variable(models):
    """Nor does a name begin as the variables of another model do."""
    root = Node({"models": Node({name: Node({}, 1, name) for name in models}, 1, "models")}, 1, "")
    problems: list[Problem] = []
    models_of(root, problems)
    stored = [variable(model, name) for model in models for name in ("a", "b_a", "a_b")]
    apart = len({*stored}) == len(stored) and all(
        sum(name.startswith(variable(model, "")) for model in models) == 1 for name in stored
    )
    proper = all(name[0] != "_" for name in models)
    assert (not problems) == (apart and proper)


trees = st.dictionaries(st.sampled_from("xyz"), st.integers(0, 3), max_size=3)
sections = st.dictionaries(st.sampled_from(OF_A_MODEL), trees, max_size=3)


def node(value):
    return Node(
        {key: node(below) for key, below in value.items()} if isinstance(value, dict) else value, 1, ""
    )


@given(sections, sections, sections)
def test_the_order_is_base_variant_model(base, variant, model):
    found = merged(node(base), {"v": node(variant)}, node(model))["v"].plain()
    expected = {
        key: {name: value for each in (base, variant, model) for name, value in each.get(key, {}).items()}
        for key in base | variant | model
    }
    assert found == expected


def test_variables_of_a_file_name_each_model():
    one, two = variables(), variables(("a", "b"))
    of_reference = {name for name in one if not name.startswith("rom_")}
    assert {name for name in two if name.startswith(REFERENCE) or name == "calcified"} == of_reference
    for model in ("a", "b"):
        assert {f"rom_{n[2:]}": dims for n, dims in two.items() if n.startswith(f"{model}_")} == {
            name: dims for name, dims in one.items() if name not in of_reference
        }


def test_a_variant_is_labelled_with_its_model_where_there_are_several():
    assert labelled("none", "rom", ["rom"]) == "none"
    assert labelled("none", "row", ["row", "coupled"]) == "none, model row"


def test_the_command_lists_every_model(folder, capsys):
    path = folder.write(("variants:\n", MODELS))
    assert main([str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(": ")[1] for line in lines] == [
        "none, model row", "local, model row", "none, model coupled", "local, model coupled"
    ]  # fmt: skip


def test_a_doubt_of_all_models_is_told_once(folder, capsys):
    path = folder.write(("variants:\n", MODELS), ("waveform: data/inlet.csv", "value: -5 cm/s"))
    assert main([str(path)]) == 0
    warnings = capsys.readouterr().err.splitlines()
    assert [line.split(": ")[2] for line in warnings] == ["none", "local"]
