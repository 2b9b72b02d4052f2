import json

import pytest

from cases.command import main
from cases.reading.json_schema import case_file_schema
from cases.reading.yaml_nodes import parse_yaml
from cases.sections.case import Case


def test_a_line_for_each_variant(ready_file, capsys):
    assert main([str(ready_file)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == (
        f"{ready_file}: none, model row: calcification none, 120 x 48 cells, 3 cycles of 0.79733 s, "
        "reference none.xplt, none_16.xplt, none.log, none_axis_nodes.txt, none_mid_elements.txt, 2 bands"
    )
    assert [line.split(": ")[1] for line in lines] == [
        f"{variant}, model {model}"
        for model in ("row", "coupled")
        for variant in ("none", "axisymmetric", "local")
    ]


def test_a_wrong_file_does_not_hide_the_others(folder, ready_file, capsys):
    wrong = folder.write(("0.5 mm", "0.5"))
    assert main([str(wrong), str(ready_file)]) == 2
    output = capsys.readouterr()
    assert output.err.startswith(f"{wrong}, line 6: geometry.wall_thickness: ")
    assert "Traceback" not in output.err
    assert len(output.out.splitlines()) == 6


@pytest.mark.parametrize("arguments", [[], ["--schema", "x.yaml"], ["--nonsense"]])
def test_wrong_arguments_end_with_status_2(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2


def test_the_schema_is_json_and_knows_every_key(capsys):
    assert main(["--schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert set(schema["properties"]) == {"name", "models", "variants", *Case.model_fields}
    assert schema["additionalProperties"] is False


def accepts(schema, value, definitions):
    """Check the few JSON-schema words that the case file's schema uses."""
    if "$ref" in schema:
        return accepts(definitions[schema["$ref"].removeprefix("#/$defs/")], value, definitions)
    if "anyOf" in schema:
        return any(accepts(option, value, definitions) for option in schema["anyOf"])
    if "enum" in schema or "const" in schema:
        return value in schema.get("enum", [schema.get("const")])
    types = {
        "object": dict,
        "array": list,
        "string": str,
        "boolean": bool,
        "integer": int,
        "number": int | float,
        "null": type(None),
    }
    stated = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    if not any(isinstance(value, types[name]) for name in stated):
        return False
    if isinstance(value, dict):
        known, others = schema.get("properties", {}), schema["additionalProperties"]
        return all(
            accepts(known[key], below, definitions)
            if key in known
            else others and accepts(others, below, definitions)
            for key, below in value.items()
        )
    if isinstance(value, list):
        items = schema.get("prefixItems", [schema.get("items")] * len(value))
        return len(items) == len(value) and all(map(lambda s, v: accepts(s, v, definitions), items, value))
    return True


def test_the_schema_accepts_the_ready_file_and_refuses_mistakes(ready_file):
    schema = case_file_schema()

    def accepted(text):
        return accepts(schema, parse_yaml(text, ready_file).plain(), schema["$defs"])

    text = ready_file.read_text()
    assert accepted(text)
    for old, new in [
        ("wall_thickness", "wall_thicknes"),
        ("law: thick", "law: thik"),
        ("15 mm", "15"),
        ("n_x: 120", "n_x: 120 cells"),
        ("quantity: radius", "quantity: radios"),
        ("pattern: local", "pattern: lokal"),
        ("x: [5 mm, 10 mm]", "x: [5 mm]"),
        ("variants:", "variant:"),
        ("models:", "model:"),
        ("row: {}", "row: {calcification: {pattern: none}}"),
        ("pressure: section", "pressure: sections"),
        ("standard_deviation: 0.12 mm", "deviation: 0.12 mm"),
        ("closure: average", "limiter: van_leer, error_tolerance: 1 %"),
        ("kind: velocity, waveform", "kind: flux, waveform"),
        ("offset: 9330 Pa", "compliance: 1 m^3/Pa"),
    ]:
        assert not accepted(text.replace(old, new)), new
    for old, new in [
        ("law: thick, youngs_modulus: 0.6 MPa", "law: layered, layers: [{name: a, thickness: 1 mm}]"),
        (
            "{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48, reference_pressure: 0 Pa}",
            "{law: table, table: wall.csv}",
        ),
        ("waveform: reference_data/waveforms/thesis_inlet.csv", "fourier: {mean: 1 m/s, cosines: [1 m/s]}"),
        ("kind: velocity", "kind: pressure, ramp: 8 ms"),
        (
            "kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa, flow: section",
            "kind: non_reflecting",
        ),
        ("scheme: semi_implicit", "scheme: godunov, limiter: minmod"),
        ("scheme: semi_implicit", "scheme: semi_implicit, error_tolerance: 0.01"),
    ]:
        assert old in text
        assert accepted(text.replace(old, new)), new
