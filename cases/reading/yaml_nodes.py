"""A YAML file as a tree whose every value knows its line and its key."""

import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError
from ruamel.yaml.nodes import MappingNode, ScalarNode, SequenceNode
from ruamel.yaml.nodes import Node as YamlNode
from ruamel.yaml.reader import ReaderError

from cases.errors import CaseFileError, Problem, UnreadableFileError
from cases.values.input_files import read_file

Scalar = str | int | float | bool | None
LARGEST_FILE = 1_000_000
TAG = "tag:yaml.org,2002:"
# what escapes such as "\0" and "\uD800" put into texts: control characters, and those that are none
NO_TEXT = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
NO_KEY = re.compile(rf"{NO_TEXT.pattern}|[\t\n]")
BEYOND_UNICODE = re.compile(r"\\U(?!0010|000)[0-9A-Fa-f]{8}")


@dataclass(frozen=True)
class Node:
    """A value of a case file and the place where it stands.

    Attributes
    ----------
    value : scalar, dict of str to Node, or list of Node
        The value; sections and lists hold nodes again.
    line : int
        Line counted from 1: of a scalar itself, of the key that opens a section or a list.
    key : str
        The key as the file states it, e.g. ``variants.local.calcification.x``; items count from 1.
    """

    value: "Scalar | dict[str, Node] | list[Node]"
    line: int
    key: str

    @property
    def section(self) -> "dict[str, Node]":
        """The keys of a section; none where the value is no section."""
        return self.value if isinstance(self.value, dict) else {}

    def plain(self) -> object:
        """Return the value without places: dictionaries, lists and scalars."""
        match self.value:
            case dict() as section:
                return {key: node.plain() for key, node in section.items()}
            case list() as items:
                return [node.plain() for node in items]
            case scalar:
                return scalar

    def find(self, path: tuple[str | int, ...]) -> "Node":
        """Return the node at a path; where keys are missing, the line of the section that lacks them."""
        node = self
        for depth, part in enumerate(path):
            below = node._child(part)
            if below is None:
                return Node(None, node.line, join(node.key, *path[depth:]))
            node = below
        return node

    def _child(self, part: str | int) -> "Node | None":
        if isinstance(self.value, dict):
            return self.value.get(str(part))
        if isinstance(self.value, list) and isinstance(part, int) and part < len(self.value):
            return self.value[part]
        return None


def join(key: str, *path: str | int) -> str:
    """Extend a key: ``join("compare", "bands", 0, "limit")`` is ``compare.bands[1].limit``."""
    for part in path:
        if isinstance(part, int):
            key += f"[{part + 1}]"
        else:
            key = f"{key}.{part}" if key else part
    return key


def read_text(path: Path) -> str:
    """Read a case file's text; raises as :func:`read_with_checksum`."""
    return read_with_checksum(path)[0]


def read_with_checksum(path: Path) -> tuple[str, str]:
    """Read a case file's text, and the SHA-256 of its bytes, hexadecimal.

    Raises
    ------
    CaseFileError
        The file is missing, no regular file, not readable, far too large or not UTF-8.
    """
    try:
        content = read_file(path, LARGEST_FILE)
        return content.decode("utf-8-sig"), hashlib.sha256(content).hexdigest()
    except UnreadableFileError as error:
        raise CaseFileError(path, f"{path}: {error}; allowed: a case file (.yaml)") from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        message = f"{path}, line {line}: not UTF-8 text (byte 0x{error.object[error.start]:02x})"
        raise CaseFileError(path, message) from error


def parse_yaml(text: str, path: Path) -> Node:
    """Parse the text of a case file, whose path is needed for messages only.

    Raises
    ------
    CaseFileError
        Broken YAML, a key stated twice, an anchored section used twice, a tag, or no keys at all.
    """
    try:
        root = _compose(text, path)
        nodes = None if root is None else _Tree(path).node(root, root.start_mark.line + 1, "")
    except RecursionError as error:
        raise CaseFileError(path, f"{path}: sections or lists nested too deeply") from error
    if nodes is None:
        raise CaseFileError(path, f"{path}: empty; allowed: a case file (.yaml)")
    if not isinstance(nodes.value, dict):
        raise CaseFileError(path, f"{path}, line {nodes.line}: no keys; allowed: a case file (.yaml)")
    return nodes


def _compose(text: str, path: Path) -> YamlNode | None:
    """Return the YAML library's own tree of a text; None where the text is empty."""
    try:
        root: YamlNode | None = YAML(pure=True).compose(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = "" if mark is None else f", line {mark.line + 1}"
        raise CaseFileError(path, f"{path}{line}: broken YAML: {error.problem or error.context}") from error
    except ReaderError as error:
        place = f"{path}, line {text.count(chr(10), 0, error.position) + 1}"
        character = f"U+{ord(text[error.position]):04X}"
        message = f"{place}: broken YAML: the character {character} is not allowed"
        raise CaseFileError(path, message) from error
    except (ValueError, OverflowError) as error:
        # the library makes a character of any escape; it does not say where this fails
        escape = BEYOND_UNICODE.search(text)
        if escape is None:
            raise
        place = f"{path}, line {text.count(chr(10), 0, escape.start()) + 1}"
        message = f"{place}: broken YAML: {escape[0]} is no character"
        raise CaseFileError(path, message) from error
    return root


class _Tree:
    """Turns composed YAML nodes into ours; remembers the sections and lists that it has met."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.met: set[int] = set()

    def node(self, yaml: YamlNode, line: int, key: str) -> Node:
        """Convert one YAML node; `line` is that of the key which opens it."""
        if isinstance(yaml, ScalarNode):
            value = self.scalar(yaml, key)  # one that is left out has no line of its own
            return Node(value, yaml.start_mark.line + 1 if yaml.value else line, key)
        if id(yaml) in self.met:
            raise self.refused(
                line, key, "an anchored section used again; allowed: variants, or the values themselves"
            )
        self.met.add(id(yaml))
        if isinstance(yaml, MappingNode) and yaml.tag == TAG + "map":
            return Node(dict(self.entries(yaml, key)), line, key)
        if isinstance(yaml, SequenceNode) and yaml.tag == TAG + "seq":
            items = enumerate(yaml.value)
            return Node([self.node(v, v.start_mark.line + 1, join(key, k)) for k, v in items], line, key)
        raise self.refused(line, key, f"the YAML tag {yaml.tag}; allowed: no tags")

    def entries(self, yaml: MappingNode, key: str) -> Iterator[tuple[str, Node]]:
        """Yield the keys of a section with their nodes."""
        lines: dict[str, int] = {}
        for name, value in yaml.value:
            line = name.start_mark.line + 1
            if not isinstance(name, ScalarNode) or name.tag == TAG + "merge":
                raise self.refused(line, key, "a YAML merge or compound key; allowed: plain keys")
            self.check_characters(name.value, NO_KEY, line, key)
            if name.value in lines:
                text = f"stated twice, first in line {lines[name.value]}"
                raise self.refused(line, join(key, name.value), text)
            lines[name.value] = line
            yield name.value, self.node(value, line, join(key, name.value))

    def scalar(self, yaml: ScalarNode, key: str) -> Scalar:
        """Return a scalar's value; only decimal numbers count as numbers."""
        text: str = yaml.value
        self.check_characters(text, NO_TEXT, yaml.start_mark.line + 1, key)
        match str(yaml.tag).removeprefix(TAG):
            case "null":
                return None
            case "bool":
                return text.lower() == "true"
            case "int" | "float" as kind:
                return _number(text, int if kind == "int" else float)
            case "str" | "timestamp" | "value":
                return text
            case tag:
                raise self.refused(yaml.start_mark.line + 1, key, f"the YAML tag {tag}; allowed: no tags")

    def check_characters(self, text: str, refused: re.Pattern[str], line: int, key: str) -> None:
        """Refuse a text that has a character which no file, terminal or report can show."""
        found = refused.search(text)
        if found is not None:
            character = f"the character U+{ord(found[0]):04X}"
            raise self.refused(line, key, f"{character} in a text or a key; allowed: readable characters")

    def refused(self, line: int, key: str, message: str) -> CaseFileError:
        """Return the error for one place of the file."""
        return CaseFileError.of_problems(self.path, [Problem(line, key or "the whole file", message)])


def _number(text: str, kind: type[int] | type[float]) -> int | float | str:
    try:
        return kind(text)
    except ValueError:  # .nan, 0x1F and the like stay text, which the schema refuses where it wants a number
        return text
