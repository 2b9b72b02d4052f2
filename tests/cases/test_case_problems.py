"""Every kind of mistake, with the exact line and key where it stands."""

from pathlib import Path

import pytest
from ruamel.yaml import YAML

CASE_KEYS = (
    "title, geometry, blood, wall, calcification, inlet, outlet, solver, reference, compare, uncertainty"
)
FILE_KEYS = f"name, {CASE_KEYS}, models, variants"
PROBLEMS = YAML(typ="safe").load(Path(__file__).with_name("problems.yaml"))
CASES = [(each["old"], each["new"], each["problem"]) for each in PROBLEMS]


@pytest.mark.parametrize(("old", "new", "problem"), CASES)
def test_the_message_says_where_what_and_what_is_allowed(folder, old, new, problem):
    expected = problem.replace("{folder}", str(folder.path))
    lines = folder.problems((old, new))
    assert lines[0] == f"x.yaml, {expected}"
    assert len(lines) <= 2  # a misspelt key is also a missing one
    jargon = ("pydantic", "Input should", "validat", "dict", "NoneType")
    assert not any(word in line for line in lines for word in jargon)


def test_a_misspelt_key_is_unknown_and_the_right_one_missing(folder):
    assert folder.problems(("wall_thickness", "wall_thicknes")) == [
        (
            "x.yaml, line 3: geometry.wall_thickness: missing; "
            'allowed: a length from 1 µm to 10 m, e.g. "0.5 mm"'
        ),
        (
            "x.yaml, line 6: geometry.wall_thicknes: unknown key wall_thicknes; did you mean wall_thickness? "
            "allowed: length, radius, wall_thickness"
        ),
    ]


def test_an_unknown_section_is_told_from_all_keys_of_a_file(folder):
    problems = folder.problems(("variants:", "variant:"))
    assert problems[0] == (
        f"x.yaml, line 26: variant: unknown key variant; did you mean variants? allowed: {FILE_KEYS}"
    )


def test_a_difference_needs_the_unit_of_its_quantity(folder):
    assert folder.problems(("rms_error", "rms_difference")) == [
        (
            "x.yaml, line 24: compare.bands[1].limit: 1 %: % is no unit of length; "
            "allowed: a positive length in units such as m, cm, mm, µm"
        )
    ]


def test_only_quantities_of_both_models_are_compared(folder):
    (problem,) = folder.problems(("quantity: radius", "quantity: wall_stiffness"))
    assert problem.startswith(
        "x.yaml, line 22: compare.bands[1].quantity: wall_stiffness; allowed: pressure, "
    )
    (problem,) = folder.problems(("quantity: radius", "quantity: radios"))
    assert "radios; did you mean radius? allowed: " in problem


def test_a_problem_of_the_base_is_told_once(folder):
    assert len(folder.problems(("15 mm", "x"), ("2.5 mm", "y"))) == 2


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "x.yaml: empty; allowed: a case file (.yaml)"),
        ("# nothing\n", "x.yaml: empty; allowed: a case file (.yaml)"),
        ("- 1\n", "x.yaml, line 1: no keys; allowed: a case file (.yaml)"),
        ("artery\n", "x.yaml, line 1: no keys; allowed: a case file (.yaml)"),
        (b"name: x\n\xff\n", "x.yaml, line 2: not UTF-8 text (byte 0xff)"),
        ("name: x\na: \x01\n", "x.yaml, line 2: broken YAML: the character U+0001 is not allowed"),
        ("name: x\ntitle: [1\n", "x.yaml, line 3: broken YAML: expected ',' or ']', but got '<stream end>'"),
        (
            "name: x\n\ttitle: y\n",
            "x.yaml, line 2: broken YAML: found character '\\t' that cannot start any token",
        ),
        ("name: *x\n", "x.yaml, line 1: broken YAML: found undefined alias 'x'"),
        ("name: x\n---\nname: y\n", "x.yaml, line 2: broken YAML: but found another document"),
        ("[" * 500, "x.yaml: sections or lists nested too deeply"),
        (
            "name: x\nwall:\n  law: thin\n  law: thick\n",
            "x.yaml, line 4: wall.law: stated twice, first in line 3",
        ),
        (
            "wall: &w {law: thin}\nblood: *w\n",
            (
                "x.yaml, line 2: blood: an anchored section used again; "
                "allowed: variants, or the values themselves"
            ),
        ),
        (
            "wall: &w [*w]\n",
            (
                "x.yaml, line 1: wall[1]: an anchored section used again; "
                "allowed: variants, or the values themselves"
            ),
        ),
        (
            "wall: &w {law: thin}\nblood: {<<: *w}\n",
            "x.yaml, line 2: blood: a YAML merge or compound key; allowed: plain keys",
        ),
        ("{[1]: 2}\n", "x.yaml, line 1: the whole file: a YAML merge or compound key; allowed: plain keys"),
        ('name: x\nname2: "\\U00110000"\n', "x.yaml, line 2: broken YAML: \\U00110000 is no character"),
        ('a: \\U0010FFFF\nb: "\\UFFFFFFFF"\n', "x.yaml, line 2: broken YAML: \\UFFFFFFFF is no character"),
        ("wall: !foo {}\n", "x.yaml, line 1: wall: the YAML tag !foo; allowed: no tags"),
        ("name: !!binary eA==\n", "x.yaml, line 1: name: the YAML tag binary; allowed: no tags"),
    ],
)
def test_a_broken_file_is_refused_in_one_line(folder, text, problem):
    assert folder.problems_of_text(text) == [problem]


@pytest.mark.parametrize(
    ("escape", "code"),
    [
        (r"\uD800", "U+D800"),
        (r"\uDFFF", "U+DFFF"),
        (r"\0", "U+0000"),
        (r"\x1b", "U+001B"),
        (r"\r", "U+000D"),
        (r"\x7f", "U+007F"),
        (r"\N", "U+0085"),
        (r"\uFFFF", "U+FFFF"),
    ],
)
@pytest.mark.parametrize(
    ("old", "line", "key"),
    [
        ("An artery", 2, "title"),
        ("15 mm", 4, "geometry.length"),
        ("data/run.xplt", 19, "reference.plot_file"),
        ("measured in another artery", 25, "compare.bands[1].reason"),
        ("wall_thickness", 6, "geometry"),
    ],
)
def test_characters_that_nothing_can_show_are_refused(folder, escape, code, old, line, key):
    assert folder.problems((old, f'"a{escape}b"')) == [
        f"x.yaml, line {line}: {key}: the character {code} in a text or a key; allowed: readable characters"
    ]


def test_a_text_may_have_lines_and_a_key_may_not(folder):
    reason = '"one\\n\\ttwo µ 動 \\U0001F9EA"'
    (band,) = folder.load(("measured in another artery", reason)).variants["none"].compare.bands
    assert band.reason == "one\n\ttwo µ 動 \U0001f9ea"
    (problem,) = folder.problems(("wall_thickness", '"a\\nb"'))
    assert problem.startswith("x.yaml, line 6: geometry: the character U+000A in a text or a key; ")


@pytest.mark.parametrize("variants", ["variants:\n", "variants: {}\n", "variants: 3\n", "variants: [a]\n"])
def test_variants_must_be_named_sections(folder, variants):
    text = folder.write().read_text()
    (problem,) = folder.problems_of_text(text[: text.index("variants:")] + variants)
    assert problem.startswith("x.yaml, line 26: variants: ")
    assert problem.endswith("; allowed: a section for each variant, under its name")
