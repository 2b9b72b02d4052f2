"""Fitted values in YAML: the keys alone, to be copied, and the case file with them."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from cases.arrays import Floats
from cases.errors import CaseError
from cases.reading.calibration_file import Calibration
from cases.reading.case_file import load_case_file
from cases.reading.numeric_keys import numeric_keys
from cases.shell.whole import beside, writing
from validation.errors import ValidationError

SAME = 1e-12  # relative difference of a value that was written and read
MARK = "# values fitted by python -m validation.calibrate\n"  # last line of a case that may be replaced

Keys = tuple[str | int, ...]


def snippet(calibration: Calibration, values: Floats) -> str:
    """Return the parameters with values, SI, as a case file states them.

    A list is stated whole, with its other items as the case has them.
    """
    root: dict[str, Any] = {}
    for parameter, value in zip(calibration.parameters, values, strict=True):
        section: Any = root
        path = parameter.key.path
        for depth, (key, below) in enumerate(pairwise(path), start=1):
            if isinstance(below, int) and key not in section:
                section[key] = calibration.template.root.find(path[:depth]).plain()
            section = _below(section, key)
        section[path[-1]] = parameter.key.stated(float(value))
    fitted = f"fitted with variant {calibration.variant} of {calibration.file.path.name}"
    return f"# {calibration.title}: {fitted}\n{_dumped(root)}"


def _below(section: Any, key: str | int) -> Any:
    """Return what a section or a list holds under a key; a section gains one where it has none."""
    return section.setdefault(key, {}) if isinstance(section, dict) else section[key]


def calibrated_text(calibration: Calibration, values: Floats) -> str:
    """Return the case file with other values of the parameters, SI, its comments kept.

    A value goes where the file states it: in the first model, or else in the variant, or else in the base,
    where it holds for all.
    """
    content = _yaml().load(calibration.file.text)
    own = content.get("variants", {}).get(calibration.variant)
    model = content.get("models", {}).get(next(iter(calibration.file.models)))
    for parameter, value in zip(calibration.parameters, values, strict=True):
        path = parameter.key.path
        places = [tree for tree in (model, own, content) if tree is not None and _holds(tree, path)]
        section: Any = places[0] if places else content if own is None else own
        for key in path[:-1]:
            section = _below(section, key)
        section[path[-1]] = parameter.key.stated(float(value))
    text = _dumped(content)
    return text if MARK in text else text + MARK


def _holds(tree: Any, path: Keys) -> bool:
    """Whether a tree states something under these keys."""
    for key in path:
        if isinstance(key, int):
            if not isinstance(tree, list) or key >= len(tree):
                return False
        elif not isinstance(tree, dict) or key not in tree:
            return False
        tree = tree[key]
    return True


def _yaml() -> YAML:
    yaml = YAML()
    yaml.preserve_quotes = True
    yaml.width = 4096  # lines stay as they are
    yaml.indent(mapping=2, sequence=4, offset=2)
    return yaml


def _dumped(content: Any) -> str:
    stream = io.StringIO()
    _yaml().dump(content, stream)
    return stream.getvalue()


def check_case(path: Path, calibration: Calibration) -> None:
    """Refuse, before anything is computed, a path at which :func:`write_case` could not write.

    Raises
    ------
    ValidationError
        As it does, if the path is a file that the calibration reads, or one that no calibration wrote.
    """
    _refuse_what_is_there(path, calibration)
    begin = np.array([parameter.start for parameter in calibration.parameters])
    with _staged_case(path, calibration, begin):
        pass


def _refuse_what_is_there(path: Path, calibration: Calibration) -> None:
    with writing(path, ValidationError):
        require_none_read(path, calibration, "--case")
        written = not path.exists() or MARK in path.read_text(encoding="utf-8", errors="replace")
    if not written:
        raise ValidationError(
            f"{path}: is there already, and was not written by a calibration; remove it or choose another "
            "--case"
        )


def require_none_read(path: Path, calibration: Calibration, option: str) -> None:
    """Refuse a path to write to that is a file which the calibration reads.

    Raises
    ------
    ValidationError
        If it is one; the message names the option by which another is chosen.
    OSError
        If the path cannot be looked at.
    """
    read = {
        "the calibration file itself": [calibration.path],
        "the case file itself": [calibration.file.path],
        "a file that the case names": calibration.case.input_files,
    }
    for words, files in read.items():
        if path.exists() and any(file.exists() and path.samefile(file) for file in files):
            raise ValidationError(f"{path}: is {words}; choose another {option}")


def write_case(path: Path, calibration: Calibration, values: Floats) -> None:
    """Write the case file with other values of the parameters, SI, whole or not at all.

    Raises
    ------
    ValidationError
        If it cannot be written, or would not be the same case there: files that it names are looked for in
        its folder and those above.
    """
    with _staged_case(path, calibration, values) as partial:
        partial.replace(path)


@contextmanager
def _staged_case(path: Path, calibration: Calibration, values: Floats) -> Iterator[Path]:
    """Write the case file under a temporary name, and check it there."""
    with writing(path, ValidationError), beside(path) as partial:
        try:
            partial.write_text(calibrated_text(calibration, values), encoding="utf-8")
            _require_values(partial, calibration, values)
        except CaseError as error:
            raise ValidationError(_no_case(path, calibration, error, partial)) from error
        yield partial


def _no_case(path: Path, calibration: Calibration, error: CaseError, partial: Path) -> str:
    """Say in one line why the case would not be one at a path, and where it may lie."""
    first, *others = str(error).replace(str(partial), str(path)).splitlines()
    more = f" (and {len(others)} more)" if others else ""
    own = calibration.file.path
    return (
        f"{first}{more}; allowed as --case: a file in a folder from which the files that {own} names are "
        f"found, e.g. {own.with_name(path.name)}; without --case the fitted values are written alone"
    )


def _require_values(path: Path, calibration: Calibration, values: Floats) -> None:
    """Refuse a case file in which the variant has other values."""
    keys = numeric_keys(load_case_file(path).variants[calibration.variant])
    for parameter, value in zip(calibration.parameters, values, strict=True):
        read = keys[parameter.key.name].value
        if read is None or abs(read - value) > SAME * abs(value):
            raise ValidationError(
                f"{calibration.file.path}: {parameter.key.name} cannot be replaced in it; copy it by hand"
            )
