"""A file's bytes to text, and text to a tree of texts, lists and mappings, each with its line and column.

Only PyYAML's event parser is used: it builds no typed values (which turn ``3:4`` into 184 and raise
what is not a YAMLError) and does not recurse. Anchors, aliases and tags are refused, as is what is
too deep, too large, or given twice.
"""

from __future__ import annotations

import os
import re
from collections.abc import Container, Iterator
from typing import TYPE_CHECKING, Any

import yaml
from yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

from icsolve.case import Mark
from icsolve.files import reading
from icsolve.read.names import Problems, Stop, meant_by, shown
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from fractions import Fraction

LARGEST = 4_000_000
"""Bytes or characters of a case; the largest mechanism in print needs a thousandth of it."""

_FOREIGN = "[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
"""Characters that YAML does not allow; compiled only where a text is not plainly printable."""
_SPACING = dict.fromkeys(map(ord, "\n\r\t"))


def text_of(path: str | os.PathLike[str], problems: Problems) -> str:
    """The text of a file.

    Raises
    ------
    Stop
        No such file, a folder, a binary, too large, or not UTF-8 (UTF-16 with its mark is read too).
    """
    try:
        with reading(path) as file:
            data = file.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, FileNotFoundError) and os.path.islink(path):
            said = f"this link leads to {shown(os.readlink(path))}, which is not there"
            raise problems.stop((1, 1), said) from None
        raise problems.stop((1, 1), _unreadable(error) + _likely_file(path, error)) from None
    if len(data) > LARGEST:
        raise problems.stop((1, 1), f"the file is larger than {LARGEST // 10**6} MB, too large for a case")
    return _decoded(data, problems)


def _unreadable(error: OSError | ValueError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, IsADirectoryError):
        return "this is a folder, not a file"
    if isinstance(error, PermissionError):
        return "this file may not be read (permission denied)"
    return f"this file cannot be read: {getattr(error, 'strerror', None) or error}"


def _likely_file(path: str | os.PathLike[str], error: OSError | ValueError) -> str:
    """``; did you mean press.yaml?``: the file with its ending, or one of nearly that name beside it."""
    if not isinstance(error, FileNotFoundError):
        return ""
    folder, name = os.path.split(os.fspath(path))
    try:
        there = sorted(one for one in os.listdir(folder or ".") if one.endswith((".yaml", ".yml")))
    except OSError:
        return ""
    stems = {os.path.splitext(one)[0]: one for one in reversed(there)}
    near = meant_by(name if name in stems else os.path.splitext(name)[0], stems)
    return f"; did you mean '{stems[near]}'?" if near else ""


def _decoded(data: bytes, problems: Problems) -> str:
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8"
    if encoding != "utf-16" and b"\0" in data:
        raise problems.stop((1, 1), "this is a binary file, not the text of a case")
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        before = data[: error.start].decode(encoding, "replace").removeprefix("\ufeff")
        raise problems.stop(_place(before, len(before)), _not_utf8(data[error.start])) from None


def _not_utf8(byte: int) -> str:
    return f"the byte 0x{byte:02X} is not UTF-8 text; save the file in the encoding UTF-8"


def _foreign(code: int) -> str:
    """What a character is that YAML does not allow; a stream's undecoded bytes are U+DC80 to U+DCFF."""
    if 0xDC80 <= code <= 0xDCFF:
        return _not_utf8(code - 0xDC00)
    return f"the character U+{code:04X} has no place in a text; delete it"


def checked(text: str, problems: Problems) -> str:
    """The text without its byte order mark, its letters in one character each: some editors write an accent
    after its letter, and both are one name.

    Raises
    ------
    Stop
        It is too long, or holds a control character or half a surrogate pair.
    """
    text = text.removeprefix("\ufeff")
    if len(text) > LARGEST:
        raise problems.stop((1, 1), f"the text is longer than {LARGEST} characters, too long for a case")
    if not text.isascii():
        from unicodedata import normalize

        text = normalize("NFC", text)
    if text.translate(_SPACING).isprintable():
        return text
    found = re.search(_FOREIGN, text)
    if found:
        mark = _place(text, found.start())
        raise problems.stop(mark, _foreign(ord(found.group())))
    return text


def _place(text: str, index: int) -> Mark:
    start = text.rfind("\n", 0, index) + 1
    return text.count("\n", 0, index) + 1, index - start + 1


LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""libyaml's parser; the pure one where libyaml is missing."""

DEEPEST = 50
MOST_NODES = 200_000


class Scalar(NamedTuple):
    """A text; ``plain`` where it stands without quotes.

    ``exact`` is the number that arithmetic gave, where the decimal in the text is not quite it.
    """

    text: str
    plain: bool
    mark: Mark
    exact: Fraction | None = None


class Sequence(NamedTuple):
    """A list."""

    items: list[Node]
    mark: Mark


class Mapping(NamedTuple):
    """Keys (raw text) to values, in the order of the file; ``keys`` has the place of each key."""

    items: dict[str, Node]
    keys: dict[str, Mark]
    mark: Mark


Node = Scalar | Sequence | Mapping


def is_null(node: Node) -> bool:
    """Whether nothing is given: an empty value, ``null`` or ``~``."""
    return type(node) is Scalar and node.plain and node.text in ("", "~", "null")


def scalars(node: Node | None) -> Iterator[Scalar]:
    """The scalars of a tree, in the order of the file."""
    if type(node) is Scalar:
        yield node
    elif type(node) is Mapping:
        for item in node.items.values():
            yield from scalars(item)
    elif type(node) is Sequence:
        for item in node.items:
            yield from scalars(item)


def parse(text: str, problems: Problems) -> Node | None:
    """The tree of a text of one document; None for an empty one.

    Raises
    ------
    Stop
        The text is not YAML, or is of a kind that no case needs; the problem is noted.
    """
    parser = LOADER(text)
    try:
        return _Tree(problems).grow(parser)
    except yaml.MarkedYAMLError as error:
        from icsolve.read.syntax import explained

        mark, message = explained(error, text)
        raise problems.stop(mark, message) from None
    except (yaml.YAMLError, ValueError) as error:
        raise problems.stop((1, 1), f"this is not YAML text: {error}") from None
    finally:
        parser.dispose()


class _Tree:
    """Takes events one by one; ``stack`` has the open lists and mappings, ``pending`` the key of each."""

    def __init__(self, problems: Problems) -> None:
        self.problems = problems
        self.root: Node | None = None
        self.stack: list[Sequence | Mapping] = []
        self.pending: list[tuple[str, Mark] | None] = []
        self.nodes = 0
        self.documents = 0

    def grow(self, parser: Any) -> Node | None:
        """Read all events."""
        get = parser.get_event
        while True:
            event = get()
            kind = event.__class__
            if kind is ScalarEvent:
                self._scalar(event)
            elif kind is MappingStartEvent or kind is SequenceStartEvent:
                self._open(event, kind is MappingStartEvent)
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                self.stack.pop()
                self.pending.pop()
            elif kind is AliasEvent:
                raise self._refuse(event, f"'*{event.anchor}': a case has no aliases; write the value out")
            elif kind is DocumentStartEvent:
                self.documents += 1
                if self.documents > 1:
                    raise self._refuse(event, "a second document starts here; give each case its own file")
            elif kind is StreamEndEvent:
                return self.root

    def _refuse(self, event: Any, message: str) -> Stop:
        return self.problems.stop(_mark(event), message)

    def _scalar(self, event: Any) -> None:
        mark = _mark(event)
        self._examine(event, mark)
        if not event.value.isascii():
            self._seen(event, mark)
        plain = not event.style  # None of the pure parser, empty of libyaml
        pending = self.pending
        if pending and pending[-1] is None and type(self.stack[-1]) is Mapping:
            pending[-1] = (event.value, mark)
        else:
            self._place(Scalar(event.value, plain, mark))

    def _open(self, event: Any, mapping: bool) -> None:
        mark = _mark(event)
        self._examine(event, mark)
        node: Sequence | Mapping = Mapping({}, {}, mark) if mapping else Sequence([], mark)
        self._place(node)
        if len(self.stack) >= DEEPEST:
            raise self.problems.stop(mark, f"more than {DEEPEST} brackets or lists within each other")
        self.stack.append(node)
        self.pending.append(None)

    def _examine(self, event: Any, mark: Mark) -> None:
        """Anchors, tags and sheer number."""
        self.nodes += 1
        if self.nodes > MOST_NODES:
            raise self.problems.stop(mark, f"more than {MOST_NODES} values; this is too large for a case")
        if event.anchor is not None:
            self.problems.refuse(mark, f"'&{event.anchor}': a case has no anchors; write the value out")
        if event.tag is not None:
            tag = event.tag.replace("tag:yaml.org,2002:", "!!")[:40]
            self.problems.refuse(mark, f"the tag '{tag}': a case has no tags; take it away")

    def _seen(self, event: Any, mark: Mark) -> None:
        """Without what no one sees, such as a space of no width: it would make another name of a name."""
        from unicodedata import category

        unseen = next((n for n, c in enumerate(event.value) if category(c) == "Cf"), None)
        if unseen is not None:
            said = f"U+{ord(event.value[unseen]):04X}, which nobody sees, stands here; take it away"
            self.problems.refuse((mark[0], mark[1] + unseen), said)
            event.value = "".join(c for c in event.value if category(c) != "Cf")

    def _place(self, node: Node) -> None:
        """Put a node where it belongs: in the list or mapping that is open, or at the root."""
        if not self.stack:
            self.root = node
            return
        top = self.stack[-1]
        if type(top) is Sequence:
            top.items.append(node)
            return
        assert type(top) is Mapping
        key = self.pending[-1]
        self.pending[-1] = None
        if key is None:
            raise self.problems.stop(node.mark, "a list or mapping stands where a key should")
        self._enter(top, key, node)

    def _goes_on(self, mapping: Mapping, name: str, mark: Mark) -> bool:
        """Whether a key without a value is the rest of the value before it, cut off at a comma: ``3,5``."""
        before = next(reversed(mapping.items.values()), None)
        if type(before) is not Scalar or not before.plain:
            return False
        if before.text[:1] == "(" and ")" not in before.text and mark[0] == before.mark[0]:
            return self._in_round_brackets(mapping, before, name, mark)
        if name[:1].isdigit() and (mark[0], mark[1] - 1) == (
            before.mark[0],
            before.mark[1] + len(before.text),
        ):
            said = f"'{before.text},{name}' is cut at its comma; {_uncut(before.text, name)}"
        elif re.fullmatch(r"-?[\d.]+", name) and re.fullmatch(r"-?[\d.]+", before.text):
            said = f"two numbers stand in square brackets, [{before.text}, {name}]"
        elif re.fullmatch(r"[A-Z]\w?'?", name) and re.fullmatch(r"[A-Z]\w?'?", before.text):
            said = f"two points stand in square brackets, [{before.text}, {name}]"
        else:
            return False
        self.problems.refuse(before.mark, said)
        self.problems.cut.add(before.mark)
        return True

    def _in_round_brackets(self, mapping: Mapping, before: Scalar, name: str, mark: Mark) -> bool:
        """Take a key without a value into the list that round brackets began, up to the one that ends it."""
        last, text = next(reversed(mapping.items)), f"{before.text}, {name}"
        if name[-1:] != ")":
            mapping.items[last] = before._replace(text=text)
            return True
        self.problems.refuse(before.mark, f"write square brackets, [{text[1:-1]}]")
        self.problems.cut.add(before.mark)
        parts: list[Node] = [Scalar(part, True, before.mark) for part in text[1:-1].split(", ")]
        mapping.items[last] = Sequence(parts, before.mark)
        return True

    def _enter(self, mapping: Mapping, key: tuple[str, Mark], node: Node) -> None:
        name, mark = key
        if type(node) is Scalar and node.text == "" and node.plain and self._goes_on(mapping, name, mark):
            return
        if "\xa0" in (name[:1], name[-1:]):
            if name[0] == "\xa0":
                raise self.problems.stop(mark, "this line starts with a no-break space")
            name = name.rstrip("\xa0 ")
            self.problems.refuse(mark, f"write {shown(name)} without the no-break space behind it")
        first = mapping.keys.get(name)
        if first is not None:
            place = f"line {first[0]}, column {first[1]}"
            self.problems.refuse(mark, f"'{name}' is given twice, the first time in {place}")
            if is_null(mapping.items[name]):
                mapping.items[name] = node  # a heading twice, with its entries under the second
            return
        if type(node) is Scalar and node.text == "" and node.plain:
            if ":" in name and _runs_on(name):
                odd = ", an ordinary one" if "\xa0" in name else ""
                self.problems.refuse(mark, f"{shown(name)}: write a space after the colon{odd}")
                name, _, value = name.partition(":")
            elif given := re.fullmatch(r"([\w' -]*[\w']) ?:?(=|：)[=>]* ?(.+)", name):
                name, sign, value = given.groups()
                self.problems.refuse(mark, f"write a colon in place of '{sign}', {name}: {value[:60]}")
            elif node.mark == (mark[0], mark[1] + len(name)) and (given := _UNDIVIDED.fullmatch(name)):
                name, value = given.groups()
                self.problems.refuse(mark, f"write a colon after '{name}', {name}: {value}")
            else:
                value = ""
            if value:
                node = Scalar(value, True, mark)
            if name in mapping.keys:
                return
        mapping.keys[name] = mark
        mapping.items[name] = node


_UNDIVIDED = re.compile(r"([\w']+) +([-+.]?\d[\w.]*|[A-Z]['\d]?|unknown|c?cw)")
"""A key and its value with no colon between; in a key of two (``pressure angle``) the second is longer."""


def take_in(section: Mapping, strays: Container[str], problems: Problems) -> None:
    """Put keys that stand beside the empty key that they belong under, unindented, in it; told once."""
    over = ""
    for key, node in list(section.items.items()):
        if not over or key not in strays:
            over = key if is_null(node) and key not in strays else ""
            continue
        inner = section.items[over]
        if type(inner) is not Mapping:
            problems.refuse(
                section.keys[key], f"indent {shown(key)} by two more spaces: it belongs under '{over}'"
            )
            inner = section.items[over] = Mapping({}, {}, section.keys[key])
        inner.items[key], inner.keys[key] = section.items.pop(key), section.keys.pop(key)


def take_out(root: Mapping, sections: Container[str], problems: Problems) -> None:
    """Put sections that are indented into the one above beside it; told once a section."""
    for name in ("units", "points", "lengths", "angles", "near", "links"):
        over = root.items.get(name)
        if type(over) is not Mapping:
            continue
        for key, node in list(over.items.items()):
            if key in sections and key not in root.items and _is_section(node, name == "links"):
                problems.refuse(
                    over.keys[key], f"take the spaces before '{key}' away: '{name}' ends above it"
                )
                root.items[key], root.keys[key] = over.items.pop(key), over.keys.pop(key)


def _is_section(node: Node, of_links: bool) -> bool:
    """Whether a value is entries of its own, or a list of some, and no place, number or mass of a name."""
    if type(node) is Mapping:
        inner = [type(value) is Mapping for value in node.items.values()]
        return all(inner) if of_links else not node.items.keys() & {"centroid", "unknown"}
    return type(node) is Sequence and any(type(item) is Mapping for item in node.items)


def _uncut(before: str, after: str) -> str:
    """How a number that a comma cuts is to be written, or two; three digits after a comma or a point may be
    thousands."""
    thousands = re.match(r"\d{3}(?!\d)", after)
    if "." in before and not re.fullmatch(r"-?\d+(\.\d{3})+", before):
        return f"write square brackets, [{before}, {after}]"
    if "." in before:
        return f"write a decimal point and no other, {before.replace('.', '')}.{after}"
    if thousands and "." in after:
        return f"write no comma, {before}{after}"
    meant = f"write a decimal point, {before}.{after}"
    meant += f", or for thousands no comma, {before}{after}" if thousands else ""
    two = re.fullmatch(r"-?\d+", before) and re.fullmatch(r"\d+", after)
    return f"{meant}, or if these are two, square brackets, [{before}, {after}]" if two else meant


def _mark(event: Any) -> Mark:
    start = event.start_mark
    return start.line + 1, start.column + 1


def _runs_on(name: str) -> bool:
    from icsolve.read.syntax import missing_space

    return missing_space(name)
