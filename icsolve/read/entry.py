"""One joint, load or motion: a mapping whose values are taken key by key."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from icsolve.case import Coordinates, Mark, Number
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.problems import shown, suggestion
from icsolve.read.quantities import number
from icsolve.read.reading import Reading

_BOUNDS: dict[str, tuple[Callable[[float], bool], str]] = {
    "positive": (lambda v: v > 0.0, "should be greater than zero"),
    "not negative": (lambda v: v >= 0.0, "should not be negative"),
}


class Entry:
    """A mapping at ``path``, called ``what`` in messages; every value asked for is checked and read."""

    def __init__(self, reading: Reading, node: Mapping, path: str, what: str) -> None:
        self.reading = reading
        self.node = node
        self.path = path
        self.what = what

    def has(self, key: str) -> bool:
        """Whether the key stands there."""
        return key in self.node.items

    def mark(self, key: str) -> Mark:
        """Where the key stands."""
        return self.node.keys[key]

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem."""
        self.reading.refuse(mark, message)

    def only(self, *allowed: str) -> None:
        """Refuse every other key."""
        self.reading.check_keys(self.node, allowed, self.what)

    def need(self, key: str, meaning: str) -> Node | None:
        """The value of a key that must stand there; a missing one is refused with its meaning."""
        node = self.node.items.get(key)
        if node is None:
            self.refuse(self.node.mark, f"{self.what} needs '{key}': {meaning}")
        return node

    def one_of(self, keys: Iterable[str]) -> str | None:
        """The one key of several that stands there; None for none; two are refused."""
        there = [key for key in keys if key in self.node.items]
        if len(there) > 1:
            said = " and ".join(f"'{key}'" for key in there)
            self.refuse(self.mark(there[1]), f"{self.what} has {said}; give one of them")
        return there[0] if there else None

    def number(self, key: str, dimension: str, bound: str = "", path: str = "") -> Number | None:
        """A number if the key stands there, within its bound."""
        node = self.node.items.get(key)
        if node is None:
            return None
        return self.value(node, dimension, path or f"{self.path}.{key}", key, bound)

    def value(self, node: Node, dimension: str, path: str, key: str, bound: str = "") -> Number | None:
        """The number of a node, within its bound."""
        found = number(self.reading, node, dimension, path)
        if found is None or not bound or _BOUNDS[bound][0](found.value):
            return found
        self.refuse(node.mark, f"the {key} {found.digits} of {self.what} {_BOUNDS[bound][1]}")
        return None

    def pair(self, key: str, dimension: str, names: str, meaning: str) -> tuple[Number, Number] | None:
        """A list of two numbers, at paths ``key.x`` and ``key.y`` for names ``xy``."""
        node = self.node.items.get(key)
        if type(node) is not Sequence or len(node.items) != 2:
            mark = node.mark if node is not None else self.node.mark
            self.refuse(mark, f"'{key}' of {self.what} should be {meaning}")
            return None
        first, second = (
            number(self.reading, item, dimension, f"{self.path}.{key}.{name}")
            for item, name in zip(node.items, names, strict=True)
        )
        return (first, second) if first is not None and second is not None else None

    def point(self, key: str) -> str | None:
        """The name of a point if the key stands there."""
        node = self.node.items.get(key)
        if type(node) is Sequence:
            self.refuse(
                node.mark, f"'{key}' of {self.what} should be a point's name; coordinates stand in 'points'"
            )
            return None
        return self.reading.point(node, f"'{key}' of {self.what}") if node is not None else None

    def place(self, key: str, hidden: str, meaning: str) -> str | None:
        """A point's name, or that of the hidden point whose coordinates stand in its stead."""
        node = self.need(key, meaning)
        if type(node) is not Sequence:
            return self.point(key) if node is not None else None
        pair = self.pair(key, "length", "xy", "a point, or two coordinates [x, y]")
        if pair is None:
            return None
        while hidden in self.reading.hidden:
            hidden += "'"
        self.reading.hidden[hidden] = Coordinates(*pair)
        self.reading.marks[f"points.{hidden}"] = node.mark
        return hidden

    def link(self, key: str, meaning: str = "") -> str | None:
        """The name of a link; with a ``meaning``, one that must stand there."""
        node = self.need(key, meaning) if meaning else self.node.items.get(key)
        return self.reading.link(node, f"'{key}' of {self.what}") if node is not None else None

    def word(self, key: str, words: tuple[str, ...]) -> str | None:
        """One word of several if the key stands there."""
        node = self.node.items.get(key)
        if node is None:
            return None
        text = node.text if type(node) is Scalar else ""
        if text in words:
            return text
        likely = suggestion(text, words) if text else ""
        said = f", not {shown(text)}" if text else ""
        self.refuse(node.mark, f"'{key}' of {self.what} should be {' or '.join(words)}{said}{likely}")
        return None
