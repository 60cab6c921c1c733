"""One mapping of a case, checked and read as the table of keys says: each key by its form, then its ties.

All that is wrong with an entry is told, whether its other keys can be read or not; what makes a joint or a
load of it is called with its values where nothing was.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from collections.abc import Mapping as Table
from typing import Any

from icsolve.case import Like, Magnitude, Mark, Number, Slope
from icsolve.numbers.units import BOUNDS, exactly, nearest, quotient, split_quantity
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import LIKE, Key, Rule
from icsolve.read.names import shown, suggestion
from icsolve.read.reading import Reading, number, numbers

Values = dict[str, Any]
"""What an entry holds under each key of its table; None of what is left out."""


class Entry:
    """A mapping at ``path``, called ``what`` in messages, with the keys of a table and what ties them.

    ``hidden`` names the points that it gives by coordinates.
    """

    def __init__(
        self,
        reading: Reading,
        node: Mapping,
        path: str,
        what: str,
        keys: Table[str, Key] | None = None,
        ties: tuple[Rule, ...] = (),
        hidden: str = "",
    ) -> None:
        self.reading = reading
        self.node = node
        self.path = path
        self.what = what
        self.keys = keys or {}
        self.ties = ties
        self.hidden = hidden
        self.before = reading.problems.noted

    @property
    def whole(self) -> bool:
        """Whether nothing was refused since the reading of this entry began."""
        return self.reading.problems.noted == self.before

    def read(self, *besides: str) -> Values:
        """All values by the table; keys that it has not, nor are named ``besides``, are refused.

        What can't be read is None as what is left out is: `whole` tells.
        """
        self.check(*besides)
        values: Values = {key: self.form(key) for key in self.keys}
        self.check_ties()
        return values

    def form(self, key: str) -> Any:
        """The value of a key in its form; None where it is left out, or can't be read."""
        node = self.node.items.get(key)
        if node is None:
            return None
        form = self.keys[key].form
        return (self.reading.forms.get(form) or FORMS[form])(self, key, node)

    def has(self, key: str) -> bool:
        """Whether the key stands there."""
        return key in self.node.items

    def mark(self, key: str) -> Mark:
        """Where the key stands."""
        return self.node.keys[key]

    def text(self, key: str) -> str:
        """The text of a key, '' where there is none."""
        node = self.node.items.get(key)
        return node.text if type(node) is Scalar else ""

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem."""
        self.reading.refuse(mark, message)

    def refuse_value(self, node: Node, key: str, wanted: str) -> None:
        """Note that a key's value is not of its form: what it should be, by the table unless it is said."""
        self.refuse(node.mark, f"'{key}' of {self.what} should be {wanted or self.keys[key].says}")

    def check(self, *besides: str) -> None:
        """Refuse keys that the table has not, nor are named ``besides``; and miss those that it needs."""
        self.reading.check_keys(self.node, (*self.keys, *besides), self.what)
        for name, key in self.keys.items():
            if key.needed:
                self.need(name)

    def need(self, key: str, meaning: str = "") -> Node | None:
        """The value of a key that must stand there; a missing one is refused with its meaning."""
        node = self.node.items.get(key)
        if node is None:
            self.refuse(self.node.mark, f"{self.what} needs '{key}': {meaning or self.keys[key].says}")
        return node

    def check_ties(self) -> None:
        """Refuse keys that stand together and should not, or apart."""
        told: set[str] = set()
        for tie in self.ties:
            if told.isdisjoint(tie.keys) and not self._holds(tie):
                told.update(tie.keys)

    def _holds(self, tie: Rule) -> bool:
        first, *others = tie.keys
        said = tie.says.format(what=self.what)
        there = [key for key in tie.keys if self.has(key)]
        if tie.kind == "needs":
            if first not in there or all(self.has(key) for key in others):
                return True
            self.refuse(self.mark(first), said) if said else self.need(others[0])
            return False
        if tie.kind == "any":
            if not there:
                self.refuse(self.node.mark, said)
            return bool(there)
        if tie.kind == "direction" and self._has_components:
            if there:
                given = f"{self.what} is given by components, so it takes no '{there[0]}'"
                self.refuse(self.mark(there[0]), given)
            return not there
        if self.one_of(tie.keys) is None and tie.kind != "at most one":
            self.refuse(self.node.mark, said) if said else self.need(first)
            return False
        return len(there) < 2

    @property
    def _has_components(self) -> bool:
        """Whether the key that says of which kind the entry is, the first of its table, has a list."""
        return type(self.node.items.get(next(iter(self.keys), ""))) is Sequence

    def one_of(self, keys: Iterable[str]) -> str | None:
        """The one key of several that stands there; None for none; two are refused."""
        there = [key for key in keys if key in self.node.items]
        if len(there) > 1:
            said = " and ".join(f"'{key}'" for key in there)
            self.refuse(self.mark(there[1]), f"{self.what} has {said}; give one of them")
        return there[0] if there else None

    # What stands under a key

    def number(self, key: str, dimension: str = "", bound: str = "") -> Number | None:
        """A number if the key stands there, within its bound; by the table unless a dimension is given."""
        node = self.node.items.get(key)
        if node is None:
            return None
        if not dimension:
            dimension, bound = self.keys[key].dimension, self.keys[key].bound
        return self.value(node, dimension, f"{self.path}.{key}", key, bound)

    def value(self, node: Node, dimension: str, path: str, key: str, bound: str = "") -> Number | None:
        """The number of a node, within its bound."""
        found = number(self.reading, node, dimension, path)
        for limit in BOUNDS[bound]:
            if found is not None and not limit.holds(found.value):
                self.refuse(node.mark, f"the {key} {found.digits} of {self.what} {limit.says}")
                return None
        if found is not None and key == "mu" and found.value > ROUGHEST:
            said = f"{path} is {found.digits}: few surfaces that rub have more than 1"
            self.reading.noticed.append(f"{said}; if percent are meant, write {found.value / 100:g}.")
        return found._replace(bound=bound) if found is not None and bound else found

    def numbers(
        self, key: str, node: Node, names: str, path: str = "", dimension: str = "", wanted: str = ""
    ) -> tuple[Number, ...] | None:
        """A list of a number for each name, at paths ``path.x``, ``path.y``: those of the key unless told."""
        if type(node) is not Sequence or len(node.items) != len(names):
            self.refuse_value(node, key, wanted)
            return None
        path, dimension = path or f"{self.path}.{key}", dimension or self.keys[key].dimension
        return numbers(self.reading, node.items, dimension, path, names)

    def pair(self, key: str, node: Node) -> tuple[Number, ...] | None:
        """A list of two numbers, at paths ``key.0`` and ``key.1``, within the key's bound."""
        found = self.numbers(key, node, "01")
        if found is None or not (bound := self.keys[key].bound):
            return found
        holds, said = PAIR_BOUNDS[bound]
        if holds([one.value for one in found]):
            return tuple(one._replace(bound=bound if bound in BOUNDS else "") for one in found)
        self.refuse(self.mark(key), said.format(key=key, what=self.what))
        return None

    def teeth(self, key: str, node: Node) -> tuple[Number, ...] | None:
        """The numbers of teeth of two gears, or of one alone; whole, and internal ones around the others."""
        if type(node) is not Sequence and self.keys[key].form == "count or counts":
            count = self.number(key)
            found: tuple[Number, ...] | None = (count,) if count is not None else None
        else:
            found = self.numbers(key, node, "01")
        values = [count.value for count in found or ()]
        if not found:
            return None
        if any(value == 0.0 or abs(value) > MOST_TEETH or value != int(value) for value in values):
            said = f"the teeth of {self.what} should be whole numbers other than 0"
        elif len(values) == 2 and max(values) < 0.0:
            said = f"only one gear of {self.what} can be internal (negative)"
        elif max(values) < 0.0:
            said = "a gear whose mate is not shown has external teeth"
        elif min(values) < 0.0 and abs(min(values)) <= max(values):
            said = "an internal gear has more teeth than the one inside it"
        else:
            return tuple(count._replace(bound="teeth") for count in found)
        self.refuse(self.mark(key), said)
        return None

    def point(self, key: str) -> str | None:
        """The name of a point if the key stands there."""
        node = self.node.items.get(key)
        if type(node) is Sequence:
            self.refuse_value(node, key, "a point's name; coordinates stand in 'points'")
            return None
        return self.reading.point(node, f"'{key}' of {self.what}") if node is not None else None

    def place(self, key: str, node: Node, what: str = "") -> str | None:
        """A point's name, or that of the hidden point whose coordinates stand in its stead."""
        what = what or f"'{key}' of {self.what}"
        if type(node) is not Sequence:
            return self.reading.point(node, what)
        axes = self.reading.axes
        named = all(type(one) is Scalar and one.text[:1].isalpha() for one in node.items)
        if named or len(node.items) != len(axes):
            count = "two" if len(axes) == 2 else "three"
            self.refuse(node.mark, f"{what} should be a point, or {count} coordinates [{', '.join(axes)}]")
            return None
        parts = self.numbers(key, node, axes, dimension="length")
        if parts is None:
            return None
        hidden = (self.hidden if key != "to" else f"{self.hidden}'") or f"@{self.path}.{key}"
        while hidden in self.reading.hidden:
            hidden += "'"
        self.reading.hidden[hidden] = self.reading.coordinates(*parts)
        self.reading.marks[f"points.{hidden}"] = node.mark
        return hidden

    def link(self, key: str) -> str | None:
        """The name of a link if the key stands there."""
        node = self.node.items.get(key)
        return self.reading.link(node, f"'{key}' of {self.what}") if node is not None else None

    def points(self, key: str, node: Node, form: str) -> tuple[str, ...] | None:
        """The names of a list of points, which are needed."""
        items = self.reading.names(node, f"'{key}' of {self.what}", form)
        for item in items or ():
            self.reading.used.setdefault(item.text, item.mark)
        return tuple(item.text for item in items) if items is not None else None

    def line(self, key: str, node: Node) -> Number | tuple[str, ...] | None:
        """A direction in degrees, or two different points."""
        if type(node) is not Sequence:
            return self.number(key)
        names = self.points(key, node, "[A, G]")
        if names is None or (len(names) == 2 and names[0] != names[1]):
            return names
        self.refuse_value(node, key, "a direction or two different points")
        return None

    def slope(self, key: str, node: Node) -> Slope | None:
        """A direction by run and rise."""
        pair = self.numbers(key, node, "xy")
        if pair and pair[0].value == 0.0 and pair[1].value == 0.0:
            self.refuse(self.mark(key), f"the slope [0, 0] of {self.what} has no direction")
            return None
        return Slope(*pair) if pair else None

    def word(self, key: str, words: tuple[str, ...]) -> str | None:
        """One word of several if the key stands there."""
        node = self.node.items.get(key)
        text = node.text if type(node) is Scalar else ""
        if node is None or text in words:
            return text or None
        likely = suggestion(text, words) if text else ""
        said = f", not {shown(text)}" if text else ""
        self.refuse_value(node, key, f"{' or '.join(words)}{said}{likely}")
        return None

    # What gives a load its number

    def magnitude(self, key: str, node: Node) -> Magnitude:
        """The number of a load, the load that it is like; None for the unknown."""
        self.reading.marks[self.path] = node.mark
        if type(node) is Mapping and "like" in node.items:
            return self._like(node)
        if type(node) is Mapping:
            self.refuse(node.mark, _no_mapping(key, node))
            return None
        if type(node) is Sequence and [type(one) is Scalar and one.text for one in node.items] == ["unknown"]:
            self.refuse(node.mark, f"write it without brackets, {key}: unknown")
            return None
        if type(node) is Scalar and node.text.strip().lower() in WANTED:
            self.refuse(node.mark, f"write 'unknown' for what is to find, {key}: unknown")
            return None
        own = self.keys[key]
        is_open = type(node) is Scalar and node.text == "unknown"
        return None if is_open else self.value(node, own.dimension, self.path, key, own.bound)

    def vector(self, key: str, node: Node) -> Magnitude | tuple[Number, ...]:
        """The number of a load, or its components, ``loads.P.x``; () where all are to find."""
        if type(node) is not Sequence:
            return self.magnitude(key, node)
        axes = self.reading.axes
        found = [type(one) is Scalar and one.text == "unknown" for one in node.items]
        if not any(found):
            return self.numbers(key, node, axes, self.path)
        self.reading.marks[self.path] = node.mark
        in_space = len(axes) > 2
        if in_space or not all(found) or len(found) != len(axes):
            said = f"along a known line it is `{key}: unknown` with its direction, " + (
                "as in `along: -z`; else one such load along each of x, y and z"
                if in_space
                else "else [unknown, unknown]"
            )
            self.refuse(node.mark, f"'{key}' of {self.what}: {said}")
        return ()

    def ends(self, key: str, node: Node) -> Magnitude | tuple[Number, ...]:
        """The number of a load along a line, or those at both ends."""
        if type(node) is not Sequence:
            return self.magnitude(key, node)
        return self.numbers(key, node, "01", self.path)

    def _like(self, node: Mapping) -> Like | None:
        inner = Entry(self.reading, node, self.path, self.what, LIKE)
        inner.check()
        target = node.items["like"]
        other = self.reading.name(target, f"'like' of {self.what}")
        times = inner.number("times")
        if other is None or not inner.whole:
            return None
        self.reading.likes[self.path.partition(".")[2]] = (other, target.mark)
        return Like(other, times)

    def power(self, key: str, node: Node) -> Number | None:
        """Power over speed in the case's unit of torque, rounded once.

        Positive power at a positive speed is a positive torque, which drives its link; a negative power is
        taken out of the link.
        """
        speed = self.number("speed")
        if type(node) is Mapping or (type(node) is Scalar and node.text == "unknown"):
            said = "is a number with its unit; what is to find is a torque, `torque: unknown`"
            self.refuse(node.mark, f"the power of {self.what} {said}")
            return None
        power = self.value(node, "power", self.path, key)
        if power is None or speed is None:
            return None
        if speed.value == 0.0:
            self.refuse(self.mark("speed"), f"at the speed 0 {self.what} would need an endless torque")
            return None
        if power.exact is None:
            self.refuse(node.mark, f"the power of {self.what} carries its unit: W, kW or hp")
            return None
        numeral = split_quantity(speed.digits)
        assert numeral is not None
        exact = quotient(power.exact, speed.exact or exactly(numeral[0]))
        value = nearest(exact)
        per_power = value / power.value if power.value else 1.0
        half = abs(per_power) * power.half
        factor = per_power * power.factor
        return Number(value, half, self.path, power.digits, factor, exact, dimension="torque")


WANTED = (
    "?",
    "??",
    "???",
    "x",
    "find",
    "to find",
    "wanted",
    "solve",
    "tbd",
    "unk",
    "required",
    "to be found",
)
"""What people write for the unknown."""


def _no_mapping(kind: str, node: Mapping) -> str:
    """A mapping in place of a number: what it may have been."""
    parts = [node.items[key] for key in ("value", "magnitude", "size", "unit", "units") if key in node.items]
    text = (
        " ".join(part.text for part in parts if type(part) is Scalar) or next(iter(node.items), "") or "100"
    )
    return f"a number stands here without braces, '{kind}: {text}', or the name of another load, {{like: M2}}"


ROUGHEST = 2.0
"""A coefficient of friction above this is told: soft rubber on a dry road has less."""
MOST_TEETH = 1e9
PAIR_BOUNDS: dict[str, tuple[Callable[[list[float]], bool], str]] = {
    "positive": (lambda both: min(both) > 0.0, "the {key} of {what} should be greater than zero"),
    "one positive": (lambda both: max(both) > 0.0, "one of the {key} of {what} should be greater than zero"),
}

Form = Callable[[Entry, str, Node], Any]
"""What reads a key's value, which stands there."""


def _words(*words: str) -> Form:
    return lambda entry, key, node: entry.word(key, words)


TRUTHS = {"yes": True, "true": True, "no": False, "false": False}


def truth_of(node: Node) -> bool | None:
    """yes or no, in any of the ways that YAML writes it; None for anything else."""
    return TRUTHS.get(node.text.lower()) if type(node) is Scalar else None


def _truth(entry: Entry, key: str, node: Node) -> bool:
    found = truth_of(node)
    if found is None:
        entry.refuse(node.mark, f"'{key}' of {entry.what} should be yes or no")
    return bool(found)


FORMS: dict[str, Form] = {
    "name": lambda entry, key, node: entry.point(key),
    "link": lambda entry, key, node: entry.link(key),
    "quantity": lambda entry, key, node: entry.number(key),
    "number": lambda entry, key, node: entry.number(key),
    "with unit": lambda entry, key, node: entry.number(key),
    "with unit or 0": lambda entry, key, node: entry.number(key),
    "pair": Entry.pair,
    "counts": Entry.teeth,
    "count or counts": Entry.teeth,
    "slope": Entry.slope,
    "place": Entry.place,
    "spot": Entry.place,
    "line": Entry.line,
    "load": Entry.magnitude,
    "load with unit": Entry.magnitude,
    "load or vector": Entry.vector,
    "load or triple": Entry.vector,
    "load or pair": Entry.ends,
    "power": Entry.power,
    "corner": lambda entry, key, node: node,
    "sense": _words("ccw", "cw"),
    "hand": _words("right", "left"),
    "truth": _truth,
    "text": lambda entry, key, node: node,
}
"""What reads a value of each form; a room with forms of its own has them in its `Reading.forms`."""
