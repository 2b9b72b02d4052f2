"""The JSON schema of a case file, for editors that complete and check YAML."""

from typing import Any

from cases.reading.models import OF_A_MODEL
from cases.sections.case import Case
from cases.values.kinds import NAME_PATTERN

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def case_file_schema() -> dict[str, Any]:
    """Return the JSON schema of a case file.

    It knows every key and word, and that quantities are texts. It asks for no key but `name`, since base and
    variants complete each other; units, numbers and files are checked by
    `cases.reading.case_file.load_case_file`.

    Returns
    -------
    dict
        A JSON schema of the 2020-12 dialect.
    """
    case = _partial(Case.model_json_schema())
    definitions = case.pop("$defs")
    variant = {**case, "title": "Variant", "description": "What a variant states otherwise than the base."}
    name = {"type": "string", "pattern": f"^{NAME_PATTERN}$"}
    model = {
        "type": "object",
        "title": "Model",
        "description": "What a reduced model states otherwise than the base.",
        "properties": {key: case["properties"][key] for key in OF_A_MODEL},
        "additionalProperties": False,
    }
    return {
        "$schema": DIALECT,
        "title": "Case file",
        "type": "object",
        "properties": {
            "name": name,
            **case["properties"],
            "models": _named(name, "Model"),
            "variants": _named(name, "Variant"),
        },
        "required": ["name"],
        "additionalProperties": False,
        "$defs": {**definitions, "Model": model, "Variant": variant},
    }


def _named(name: dict[str, str], definition: str) -> dict[str, Any]:
    """Return the schema of sections under names, each of which may be empty."""
    return {
        "type": "object",
        "minProperties": 1,
        "propertyNames": name,
        "additionalProperties": {"anyOf": [{"$ref": f"#/$defs/{definition}"}, {"type": "null"}]},
    }


def _partial(schema: Any) -> Any:
    """Drop what part of a section cannot satisfy: required keys, and exactly one match of a union.

    Defaults drop out too: the schema has them in SI units, which a case file may not state bare.
    """
    if isinstance(schema, list):
        return [_partial(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {key: value for key, value in schema.items() if key not in ("required", "default")}
    return {"anyOf" if key == "oneOf" else key: _partial(value) for key, value in kept.items()}
