"""Files of the states of a 3D result: a pattern with numbers, a .pvd collection, a list, or one file."""

import re
from collections import defaultdict
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from cases.errors import RefusedValueError
from cases.values.kinds import PATH_SCHEMA, Context, ValueKind, existing_file, refused
from cases.values.wording import shown_path

ALLOWED = "the path of a file, a pattern such as result_{:03d}.vtu, or a list of these"
FIELD = re.compile(r"\{(?::0?[0-9]*d)?\}")
ONE_STATE = (".vtu", ".vtk", ".pvtu", ".vtm", ".vtmb", ".vts", ".pvts", ".vti", ".pvti")
NAMED_IN_XML = re.compile(r'(?:[Ss]ource|file)="([^"]+)"')
NAMED_IN_XDMF = re.compile(r"([^\s<>:]+):/")


@dataclass(frozen=True)
class FileSeries:
    """One part of every state.

    Attributes
    ----------
    stated : str
        What the case says.
    paths : tuple of pathlib.Path
        A file for each state; one file alone may hold all states.
    numbers : tuple of int
        Number of each file: what stands for the field of the pattern, else 0, 1, …
    times : tuple of float or None
        Times that a .pvd states, in the files' unit.
    companions : tuple of pathlib.Path
        What else is read with ``paths``.
    """

    stated: str
    paths: tuple[Path, ...]
    numbers: tuple[int, ...]
    times: tuple[float, ...] | None = None
    companions: tuple[Path, ...] = ()


def _series(value: object, context: Context | None) -> tuple[FileSeries, ...]:
    items = value if isinstance(value, list | tuple) else [value]
    if not items or not all(isinstance(item, str) and item for item in items):
        raise refused(value, ALLOWED)
    found = [part for item in items for part in _parts(str(item), context)]
    if len(found) > 1 and all(_is_one_state(part) for part in found):
        paths = tuple(part.paths[0] for part in found)
        others = tuple(path for part in found for path in part.companions)
        return (FileSeries(found[0].stated, paths, tuple(range(len(paths))), companions=others),)
    _refuse_unequal(found)
    return tuple(found)


def _is_one_state(part: FileSeries) -> bool:
    plain = part.times is None and FIELD.search(part.stated) is None
    return plain and part.paths[0].suffix in ONE_STATE


def _parts(stated: str, context: Context | None) -> list[FileSeries]:
    """Return the parts that one text stands for: several for a .pvd with several files a time."""
    if "{" in stated:
        return [_numbered(stated, Path.cwd() if context is None else context.folder)]
    path = existing_file(stated, context)
    if path.suffix == ".pvd":
        return _collection(stated, path)
    return [FileSeries(stated, (path,), (0,), companions=companions(path))]


def _numbered(stated: str, folder: Path) -> FileSeries:
    """Return the files of a pattern by number: digits may be more than stated (999, 1000)."""
    place, name = Path(stated).parent, Path(stated).name
    fields = FIELD.findall(name)
    if len(fields) != 1 or "{" in FIELD.sub("", name) or "{" in str(place):
        raise refused(stated, "a file's name with one field, as result_{:03d}.vtu")
    before, after = FIELD.split(name)
    pattern = re.compile(f"{re.escape(before)}([0-9]+){re.escape(after)}")
    for start in (folder, *folder.parents):
        where = start / place
        matches = [pattern.fullmatch(path.name) for path in where.iterdir()] if where.is_dir() else []
        files = sorted((int(match[1]), where / match[0]) for match in matches if match)
        if files:
            numbers, paths = zip(*files, strict=True)
            twice = [number for number, after in pairwise(numbers) if number == after]
            if twice:
                raise refused(stated, "one file a number", f"two files of number {twice[0]}")
            others = tuple(other for path in paths for other in companions(path))
            return FileSeries(stated, tuple(path.resolve() for path in paths), numbers, companions=others)
    raise RefusedValueError(
        f"{shown_path(stated)}: no file of this pattern; looked for in {folder} and the folders above it"
    )


def _collection(stated: str, path: Path) -> list[FileSeries]:
    """Return what a .pvd lists: files by part, each with the same times."""
    from xml.etree import ElementTree

    try:
        entries = [
            (float(entry.attrib["timestep"]), entry.get("part", "0"), path.parent / entry.attrib["file"])
            for entry in ElementTree.parse(path).iter("DataSet")  # noqa: S314 - the user's own file
        ]
    except (ElementTree.ParseError, KeyError, ValueError) as error:
        raise refused(stated, "a .pvd file with timestep and file of each DataSet", str(error)) from error
    missing = [file for _, _, file in entries if not file.is_file()]
    if missing or not entries:
        reason = f"{missing[0].name}: no such file" if missing else "no DataSet"
        raise refused(stated, "a .pvd file of files that are there", reason)
    parts: dict[str, list[tuple[float, Path]]] = defaultdict(list)
    for time, part, file in entries:
        parts[part].append((time, file.resolve()))
    found = []
    for name, listed in parts.items():
        times, paths = zip(*listed, strict=True)
        others = (path, *(other for file in paths for other in companions(file)))
        label = stated if len(parts) == 1 else f"{stated}, part {name}"
        found.append(FileSeries(label, paths, tuple(range(len(paths))), times, others))
    return found


def _refuse_unequal(parts: list[FileSeries]) -> None:
    first = parts[0]
    for part in parts[1:]:
        same = part.numbers == first.numbers and part.times == first.times
        if not same:
            odd = sorted(set(part.numbers) ^ set(first.numbers))
            which = f", e.g. number {odd[0]}" if odd else " (times)"
            raise refused(part.stated, f"the states of {first.stated}", f"other states{which}")


def companions(path: Path) -> tuple[Path, ...]:
    """Return the files that are read with a file because it names them, or by its program's custom."""
    if path.suffix in (".pvtu", ".vtm", ".vtmb", ".pvts", ".pvti"):
        names = NAMED_IN_XML.findall(path.read_text(encoding="utf-8", errors="replace"))
        named = [path.parent / name for name in names]
        return tuple(f for file in named if file.is_file() for f in (file.resolve(), *companions(file)))
    if path.suffix in (".xdmf", ".xmf"):
        text = path.read_text(encoding="utf-8", errors="replace")
        heavy = [path.parent / name for name in dict.fromkeys(NAMED_IN_XDMF.findall(text))]
        return tuple(file.resolve() for file in heavy if file.is_file())
    if path.suffix == ".foam":
        folders = [f for f in sorted(path.parent.iterdir()) if f.is_dir() and _is_time(f.name)]
        mesh = path.parent / "constant" / "polyMesh"
        return tuple(
            f.resolve() for folder in (mesh, *folders) for f in sorted(folder.rglob("*")) if f.is_file()
        )
    if path.suffix in (".case", ".encas"):
        own = sorted(path.parent.glob(f"{path.stem}*"))
        return tuple(file.resolve() for file in own if file.is_file() and file != path)
    return ()


def _is_time(name: str) -> bool:
    return re.fullmatch(r"[0-9.]+(?:e-?[0-9]+)?", name) is not None


SERIES = ValueKind(
    _series, ALLOWED, {"anyOf": [PATH_SCHEMA, {"type": "array", "items": PATH_SCHEMA, "minItems": 1}]}
)
