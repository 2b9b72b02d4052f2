"""Digests of what determines a result, under which it is kept."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

from validation.runs.provenance import checksum
from validation.runs.sources import Kind, code_digest


def canonical(value: Any) -> Any:
    """Return a value as JSON tells it apart: files by their content, floats with all their digits.

    Raises
    ------
    TypeError
        For a type that has no such form.
    """
    if value is None or isinstance(value, str | bool | int):
        return value
    if isinstance(value, float | np.floating):
        return float(value).hex()
    if isinstance(value, Path):
        return checksum(value)
    if isinstance(value, np.ndarray):
        return {"dtype": str(value.dtype), "values": canonical(value.ravel().tolist())}
    if isinstance(value, BaseModel):
        return {name: canonical(getattr(value, name)) for name in type(value).model_fields}
    if is_dataclass(value):
        return {part.name: canonical(getattr(value, part.name)) for part in fields(value)}
    if isinstance(value, Mapping):
        return {str(name): canonical(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [canonical(each) for each in value]
    raise TypeError(f"{type(value).__name__} has no canonical form")


def key_of(kind: Kind, parts: Mapping[str, Any]) -> str:
    """Digest of what determines a result: code, libraries, parts of the case, contents of files."""
    stated = {"kind": kind, "code": code_digest(kind), "parts": canonical(parts)}
    return hashlib.sha256(json.dumps(stated, sort_keys=True).encode()).hexdigest()
