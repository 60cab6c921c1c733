"""What is known while a file is read; its numbers and units."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from icsolve.case import Coordinates, Mark, Number, Units, Unknown
from icsolve.numbers.units import (
    DIMENSIONS,
    ONE,
    UNITS,
    Numeral,
    Unit,
    UnitError,
    canonical,
    exact_ratio,
    exactly,
    factor,
    kind_of,
    nearest,
    parse_unit,
    split_quantity,
    times,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.keys import UNITS as UNIT_KEYS
from icsolve.read.names import Problems, is_name, meant_by, shown, suggestion, why_no_name
from icsolve.wording import listed

if TYPE_CHECKING:
    from fractions import Fraction

    from icsolve.case import Rope, Screw
    from icsolve.case.profiles import Touch
    from icsolve.case.space import SpatialPoint


class Reading:
    """The state of reading one case; sections read into values and leave here what others need.

    ``links`` are the links of the joints, in order of first mention, None where the joints can't be
    read at all; ``used`` the points that something needs, each with the place of its first use;
    ``given`` the points that coordinates, lengths, angles or guides involve (``measured``: lengths and
    angles, ``on_guides``: each guide), ``centroids`` those of others by their point; ``hidden`` the points
    that a load or centre gives by coordinates; ``kinds`` the kind of each load by its name. ``axes`` are
    those along which a force has components, ``couples`` those about which a couple has. ``profiled`` are the
    links under ``profile``, ``touches`` the contacts whose places the profiles give, ``ropes`` the names
    of ropes, ``ends`` those that have a free end, by its point, ``noticed`` sentences on what may be a slip,
    ``unknowns`` the data of the figure that are to find, ``middles`` the hidden points in the middle of two,
    ``directed`` the forces of unknown direction. ``driven`` are the pairs of links whose screws torques turn,
    ``screws`` these, ``unread`` those that can't be read. ``likes`` are loads that are like another: its
    name, and where that stands. ``forms`` read values of forms that only some sections have, ``coordinates``
    makes a point of its numbers.
    """

    axes = "xy"
    couples = ""
    coordinates: type[Coordinates | SpatialPoint] = Coordinates

    def __init__(self, problems: Problems, units: Units) -> None:
        self.problems = problems
        self.unit_names = unit_names(units)
        self.marks: dict[str, Mark] = {}
        self.links: dict[str, Mark] | None = None
        self.used: dict[str, Mark] = {}
        self.given: set[str] = set()
        self.measured: set[str] = set()
        self.on_guides: list[str] = []
        self.centroids: dict[str, tuple[str, ...]] = {}
        self.hidden: dict[str, Any] = {}
        self.kinds: dict[str, str] = {}
        self.forms: dict[str, Callable[..., Any]] = {}
        self.likes: dict[str, tuple[str, Mark]] = {}
        self.joint_number = 0
        self.profiled: set[str] = set()
        self.noticed: list[str] = []
        self.middles: dict[str, tuple[str, str]] = {}
        self.directed: list[str] = []
        self.unknowns: list[Unknown] = []
        self.touches: list[tuple[Touch, Mark]] = []
        self.ends: dict[str, Rope | None] = {}
        self.ropes: set[str] = set()
        self.driven: set[frozenset[str]] = set()
        self.screws: list[Screw] = []
        self.unread: set[frozenset[str]] = set()

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem."""
        self.problems.refuse(mark, message)

    def unit(self, dimension: str) -> Unit:
        """The unit in which the numbers of a dimension are kept."""
        if dimension == "power":  # named by the unit that is usual, kept in that of a torque at a speed
            return parse_unit(f"{self.unit_names['torque']}/s")
        return parse_unit(self.unit_names[dimension]) if dimension != "number" else ONE

    def mapping(self, node: Node, what: str, form: str) -> Mapping | None:
        """The node as a mapping; None, with the reason noted, where it is something else."""
        if type(node) is Mapping:
            return node
        from icsolve.read.syntax import missing_space

        if is_null(node):
            self.refuse(node.mark, f"{what} has no value; write {form}")
        elif type(node) is Scalar and missing_space(node.text.split(" ")[0]):
            said = f"{what} is read as one text, {shown(node.text)}"
            self.refuse(node.mark, f"{said}; write a space after each colon")
        else:
            told = "; take the dashes or brackets of a list away" if type(node) is Sequence else ""
            given = re.match(r"(\w+)\s*(?:=\s*|(?=\())(.*?)(?=\s\w+\s*(?:=|\()|$)", getattr(node, "text", ""))
            if given:
                value = given[2].replace("(", "[").replace(")", "]")
                told = f"; write a colon and a space after the name, {given[1]}: {value[:60]}"
            self.refuse(node.mark, f"{what} should be a mapping, {form}{told}")
        return None

    def name(self, node: Node, what: str) -> str | None:
        """The node's text as a name."""
        if type(node) is not Scalar:
            self.refuse(node.mark, f"{what} should be one name")
        elif node.text in ("", "~"):  # `null` is a word where a name stands
            self.refuse(node.mark, f"{what} has no value")
        elif not is_name(node.text):
            self.refuse(node.mark, f"{shown(node.text)} is not a name: {why_no_name(node.text)}")
        else:
            return node.text
        return None

    def point(self, node: Node, what: str) -> str | None:
        """The name of a point that is needed; that something gives it is checked at the end."""
        name = self.name(node, what)
        if name is not None:
            self.used.setdefault(name, node.mark)
        return name

    def link(self, node: Node, what: str) -> str | None:
        """The name of a link that a joint has."""
        name = self.name(node, what)
        if name is None or self.knows_link(name):
            return name
        likely = suggestion(name, self.links or ())
        if not likely and self.links and len(self.links) < 10:
            likely = f"; the links are {listed([*self.links])}"
        if len(name) == 2 and set(name) <= {*self.given, *self.measured, *self.used}:
            links = ", ".join(self.links or ())
            likely = f"; it names two points, and links are called as in 'joints': {links}"
        self.refuse(node.mark, f"no joint has a link '{name}'{likely}")
        return None

    def knows_link(self, name: str) -> bool:
        """Whether a joint has that link; True where the joints could not be read."""
        return self.links is None or name in self.links

    def names(self, node: Node, what: str, form: str) -> list[Scalar] | None:
        """The items of a list of names, checked as names."""
        if type(node) is not Sequence:
            self.refuse(node.mark, f"{what} should be a list, as in {form}")
            return None
        good = [item for item in node.items if self.name(item, f"each of {what}") is not None]
        return [item for item in good if type(item) is Scalar] if len(good) == len(node.items) else None

    def check_keys(
        self,
        node: Mapping,
        allowed: Iterable[str],
        what: str,
        elsewhere: Callable[[str], str] = lambda key: "",
    ) -> None:
        """Refuse keys that have no meaning here; what is likely meant is taken as said.

        ``elsewhere`` says where a key has a meaning.
        """
        for key in list(node.items):
            if key not in allowed:
                self.unknown_key(key, node.keys[key], allowed, what, elsewhere)
                self.take_for(node, key, allowed)

    def take_for(self, node: Mapping, key: str, allowed: Iterable[str]) -> None:
        """Put the value of a strange key under the one that is likely meant."""
        meant = meant_by(key, allowed)
        if meant and meant not in node.items:
            node.items[meant], node.keys[meant] = node.items[key], node.keys[key]

    def unknown_key(
        self, key: str, mark: Mark, allowed: Iterable[str], what: str, elsewhere: Callable[[str], str]
    ) -> None:
        """Refuse a key that is not known, with a suggestion: the likely one, or all that there are."""
        known = list(allowed)
        told = elsewhere(key) or suggestion(key, known) or f"; its keys are {listed(known)}"
        self.refuse(mark, f"{what} has no key {shown(key)}{told}")

    def text(self, node: Node, what: str) -> str:
        """Free text: a title, a source."""
        if type(node) is not Scalar:
            self.refuse(node.mark, f"{what} should be a text")
            return ""
        if not node.text.replace("\n", " ").isprintable():
            self.refuse(node.mark, f"{what} has a control character; delete it")
        return node.text.strip()


SMALLEST, LARGEST = 1e-300, 1e305
"""Magnitudes between which a number stays; the solver scales figures and forces by powers of two."""

_A = {
    "number": "a bare number",
    "angle": "an angle",
    "angular speed": "an angular speed",
    "acceleration": "an acceleration",
    "stiffness": "a stiffness (force per length)",
    "pitch": "a number per length",
    "angular acceleration": "an angular acceleration",
    "path acceleration": "an acceleration",
    "area": "an area",
    "line load": "a force per length",
    "torsional stiffness": "a stiffness of torsion (torque per angle)",
}


def number(reading: Reading, node: Node, dimension: str, path: str) -> Number | None:
    """The number at ``path`` in case units of its dimension; None, with the reason noted."""
    if type(node) is not Scalar:
        reading.refuse(node.mark, f"{_a(dimension)} should stand here, not a list or mapping")
        return None
    reading.marks[path] = node.mark
    return quantity(reading, node, node.text.strip(), dimension, path)


def numbers(
    reading: Reading, nodes: Iterable[Node], dimension: str, path: str, names: Iterable[str]
) -> tuple[Number, ...] | None:
    """The number of each node, at ``path.x``, ``path.y``; None, with the reason noted, where one has none."""
    found = [number(reading, n, dimension, f"{path}.{name}") for n, name in zip(nodes, names, strict=True)]
    good = tuple(one for one in found if one is not None)
    return good if len(good) == len(found) else None


def quantity(reading: Reading, node: Scalar, text: str, dimension: str, path: str) -> Number | None:
    """As ``number``, of a text that may be a part of the node's."""
    if text[:2] in ("0x", "0o") and re.fullmatch("0x[0-9A-Fa-f]+|0o[0-7]+", text):
        text = str(int(text, 0))  # integers of YAML 1.2, too
    try:
        parts = split_quantity(text)
        if parts is None:
            reading.refuse(node.mark, _no_number(node, text, dimension, path))
            return None
        return _checked(reading, node, _valued(reading, parts, node.exact, dimension, path))
    except UnitError as error:
        reading.refuse(node.mark, f"{shown(text)}: {error}")
    except OverflowError:
        reading.refuse(node.mark, f"{shown(text)} is too large")
    return None


def _valued(
    reading: Reading, parts: tuple[Numeral, str], worked: Fraction | None, dimension: str, path: str
) -> Number:
    """The numeral in the case's unit; one division, or none where the unit is the case's own.

    ``worked`` is what arithmetic gave, of which the numeral has only the first digits.
    """
    numeral, rest = parts
    if dimension == "pressure":
        rest = rest or "/".join((reading.unit_names["force"], reading.unit_names["area"]))
    if dimension == "acceleration" and not rest:
        rest = reading.unit_names["path acceleration"]
        if rest != reading.unit_names[dimension]:
            meant = f"if m/s^2 is meant, write {numeral.digits} m/s^2."
            reading.noticed.append(f"{path} is {numeral.digits} {rest}, by the lengths of the case; {meant}")
    places = float(f"5e{numeral.exponent - 1}")
    if not rest:
        if dimension == "mass":
            raise UnitError("a mass carries its unit: kg, g, t, lbm or slug")
        if dimension == "moment of inertia" and float(numeral.digits):  # 0 is 0 in any unit
            raise UnitError("a moment of inertia carries its unit, such as kg*m^2 or lbm*in^2")
        value = float(numeral.digits)
        if dimension == "angle" and _is_of_radians(value, numeral):
            reading.noticed.append(
                f"{path} is {numeral.digits} degrees; if radians are meant, write {numeral.digits} rad."
            )
        exact = None if worked is None else (worked.numerator, worked.denominator, 0)
        return Number(value, places, path, numeral.digits, 1.0, exact, "", dimension)
    target = reading.unit(dimension)
    unit = _fitting(reading, rest, dimension)
    scale = factor(unit, target)
    exact = exact_ratio(unit, target)
    if worked is None:
        exact = exactly(numeral, exact)
    else:
        exact = (worked.numerator * exact[0], worked.denominator * exact[1], exact[2])
    return Number(nearest(exact), places * scale, path, numeral.digits, scale, exact, "", dimension)


def _is_of_radians(value: float, numeral: Numeral) -> bool:
    """Whether a number is a twelfth of pi or several, as far as three decimals or more tell."""
    twelfth = math.pi / 12.0
    near = abs(value - round(value / twelfth) * twelfth) <= 0.51 * 10.0**numeral.exponent
    return 0.1 < abs(value) < 13.0 and near and (numeral.exponent <= -3 or abs(value) in (1.57, 3.14, 6.28))


_NO_UNITS = {
    r"(?:±|\+/?-)": "write the value alone; under `expect` its room stands beside it, {value: 70, within: 1}",
    r",\d": "write a decimal point, not a comma",
    r"[OolI][OolI\d.]*(?: |$)": "write digits, 0 and 1, not the letters O, l and I",
    r"[- ]?\d+/\d": "write the fraction as decimals, 3.5 for 3 1/2",
    r"['’]\s*\d+(?:\.\d+)?\s*[\"”]$": "write feet and inches as one number with one unit, 14 in for 1'2\"",
    r"\d(?!/[a-z])|[_'’]\d": "write the digits of a number without separators",
    r"[a-z]+\.?\s*\d+\.?\d*\s*[a-z]+$": "write it with one number and one unit, as decimals",
    r"%$": "write the number itself, 0.2 for 20 %",
    r"/\s*\d+$": "write the quotient as one decimal number",
    r"[x×*·]\s*10\s*\^": "write a power of ten with an e, 1e3 for 1*10^3",
    r"[*+]": "write the number that it comes to",
    r"-\s*\d+$": "one value is wanted here; a range is what `icsolve sweep --vary` goes through",
    r"°\d": "write minutes as decimals of the degree, 60.5 for 60°30'",
}
"""What begins the text behind a number where it is no unit, and what is to be written."""
_STROKES = {'"': "in", "''": "in", "″": "in", "'": "ft", "′": "ft"}


def _fitting(reading: Reading, text: str, dimension: str) -> Unit:
    """The unit, of the wanted dimension."""
    said = next((said for pattern, said in _NO_UNITS.items() if re.match(pattern, text)), "")
    if said:
        raise UnitError(said)
    if dimension == "number" and text.isalpha():
        raise UnitError(f"a bare number is wanted here, without '{text}'")
    if text in _STROKES and dimension == "length":
        raise UnitError(f"write '{_STROKES[text]}' for {text}")
    sense = re.search(r"\b(c?cw|(?:counter)?clockwise)$", text)
    if sense:
        turns = "ccw" if sense[1][:2] == "cc" or sense[1][:2] == "co" else "cw"
        raise UnitError(f"the sense stands beside the number, 'turns: {turns}'")
    unit = parse_unit(text)
    if unit.dims != reading.unit(dimension).dims and not is_through_speed(unit, text, dimension):
        raise UnitError(_wrong(reading, text, unit, dimension))
    return unit


def is_through_speed(unit: Unit, text: str, dimension: str) -> bool:
    """Whether a unit is of power by way of a torque at an angular speed, or of torque by way of a power.

    ``hp/rpm`` is a torque, ``lbf*ft*rpm`` a power. ``N*m/rad`` has the dimension of ``hp/rpm`` and is none:
    it is the stiffness of a torsion spring.
    """
    if dimension == "power":
        return unit.dims == (2, 1, -3, 1)
    words = re.findall(r"[^\W\d_]+", text)
    by_power = any((UNITS.get(w) or UNITS.get(w.lower(), ONE)).dims == DIMENSIONS["power"] for w in words)
    return dimension == "torque" and unit.dims == (2, 1, -2, -1) and by_power


def _wrong(reading: Reading, text: str, unit: Unit, dimension: str) -> str:
    given = kind_of(unit.dims)
    if given == "torsional stiffness" and dimension == "torque":
        given = None  # it has the dimension of hp/rpm, which is a torque
    if dimension == "number":
        return f"a bare number is wanted here, without the unit '{text}'"
    said = f"'{text}' is {_a(given)}" if given else f"'{text}' is no unit of {_a(dimension)}"
    wanted = f"{said}, but {_a(dimension)} is wanted here, such as '{reading.unit_names[dimension]}'"
    if dimension == "mass" and given == "force":
        return f"{wanted}; write 'lbm' for a mass in pounds, or 'weight' in place of 'mass' for a force"
    if dimension == "force" and given == "mass":
        return f"{wanted}; for a weight given by its mass write 'mass' in place of the force"
    if dimension == "torque" and given == "power":
        return f"{wanted}; for a power at a speed write 'power' and 'speed' in place of 'torque'"
    if dimension == "angular speed" and unit.dims == (0, 0, -1, 0):
        return f"{wanted}; write 'rpm', 'rev/min' or 'rev/s' for revolutions"
    if dimension == "stiffness" and given == "torsional stiffness":
        return f"{wanted}; a torsion spring has its angle, 'corner', in place of 'at' and 'to'"
    return wanted


def _a(dimension: str | None) -> str:
    return _A.get(dimension or "", f"a {dimension}")


def _checked(reading: Reading, node: Scalar, value: Number) -> Number | None:
    size = abs(value.value)
    zero = value.value == 0.0 and not value.digits.lower().partition("e")[0].strip("+-0.")
    zero = zero and (value.exact is None or value.exact[0] == 0)
    if zero or SMALLEST <= size <= LARGEST:
        return value
    extreme = "large" if size > LARGEST else "small"
    reading.refuse(node.mark, f"{shown(node.text.strip())} is too {extreme} for a mechanism")
    return None


COMPASS = {
    **dict.fromkeys(("right", "rightward", "rightwards", "east", "horizontal", "+x", "x"), 0),
    **dict.fromkeys(("up", "upward", "upwards", "north", "vertical", "+y", "y"), 90),
    **dict.fromkeys(("left", "leftward", "leftwards", "west", "-x"), 180),
    **dict.fromkeys(("down", "downward", "downwards", "south", "-y"), -90),
}
"""Directions in words, and the angle of each."""


SWEPT = "give one, and ask `icsolve sweep CASE --vary {}=FROM:TO:STEP --find hold`, or `--find` of an answer"
"""How a number of joints and loads that can't be `unknown` is found, by its path."""


def _no_number(node: Scalar, text: str, dimension: str, path: str) -> str:
    wanted = _a(dimension)
    if is_null(node):
        wanted_too = "; write 'unknown' for what is to find" if _is_of_load(path, dimension) else ""
        return f"{wanted} should stand here, but there is no value{wanted_too}"
    if text.lower().lstrip("+-") in (".inf", ".nan", "inf", "nan", "infinity"):
        return f"'{text}' is not a number that a mechanism can have"
    if dimension == "angle" and text.lower() in COMPASS:
        return f"an angle is in degrees counterclockwise from +x: write {COMPASS[text.lower()]} for '{text}'"
    if text == "unknown":
        said = f"'unknown' cannot stand here; {wanted} is wanted"
        if path.startswith("loads.") and path.endswith(".angle"):
            free = "a force of unknown direction is 'force: [unknown, unknown]'"
            return f"'unknown' cannot stand here; {free}; where its size is known, {SWEPT.format(path)}"
        return f"{said}: {SWEPT.format(path)}" if path.startswith(("joints.", "loads.")) else said
    if text.startswith("unknown "):
        return "write 'unknown' alone; its unit follows from those of the case"
    likely = suggestion(text, ("unknown",)) or _meant(text, dimension, path)
    return f"{wanted} should stand here, but {shown(text)} does not start with a number{likely}"


def _is_of_load(path: str, dimension: str) -> bool:
    """Whether a number is one that a load may leave to be found."""
    return path.startswith("loads.") and dimension in ("torque", "force", "mass", "pressure")


def _meant(text: str, dimension: str, path: str) -> str:
    """What a text that is no number may mean, and how it is written."""
    if text.startswith("$"):
        return f"; {text} stands for a number under 'variables', which this case has not"
    if path.endswith(".normal") and is_name(text):
        return "; the normal is a direction in degrees"
    if odd := _oddly_written(text):
        return odd
    if text.startswith("like ") and path.startswith("loads."):
        return f"; write {{like: {text[5:].strip()}}}"
    if path.startswith("loads.") and path.endswith(".angle") and not text.strip("?"):
        return "; a force of unknown direction is 'force: [unknown, unknown]'"
    may_be_open = _is_of_load(path, dimension) or path.startswith(("points.", "lengths.", "angles."))
    if may_be_open and (is_name(text.lstrip("-")) or not text.strip("?")):
        return "; write a number, or 'unknown' for what is to find"
    if path.endswith(".along") and all(map(is_name, ends := text.split("-"))):
        two = ends if len(ends) == 2 else text if len(text) == 2 else ("B" if text == "A" else "A") + text[:1]
        return f"; two points of the guide stand in brackets, as in [{two[0]}, {two[1]}]"
    share = re.fullmatch(r"(-?)(\d*)\s*\*?\s*(?:pi|π)\s*(?:/\s*(\d+))?", text)
    if dimension == "angle" and share:
        degrees = 180.0 * int(share[2] or 1) / max(int(share[3] or 1), 1)
        return f"; an angle is in degrees, {share[1]}{degrees:g}"
    if path.startswith("loads.") and path.endswith(".angle") and is_name(text):
        return f"; in the direction of a point is 'toward: {text}' in place of 'angle'"
    return ""


def _oddly_written(text: str) -> str:
    """How a number in other signs than digits, or behind one, is written."""
    import unicodedata

    plain = "".join(str(unicodedata.digit(c, c)) for c in unicodedata.normalize("NFKC", text))
    if plain != text and re.fullmatch(r"[-−+]?[\d.,]+", plain):
        return f"; write {plain.replace('−', '-')}"
    if text[1:2].isdigit() and text[0] in "–—‐‑~≈=":
        return f"; write {'' if text[0] in '~≈=' else '-'}{text[1:]}"
    if text[:1] in _QUOTES and (bare := text.strip(_QUOTES + " ")):
        return f"; write {bare} without these quotation marks"
    digits = text.translate(str.maketrans("OoIl", "0011"))
    if digits != text and re.fullmatch(r"-?[\d.]+", digits):
        return f"; write digits, {digits}"
    return "; write the number that it comes to" if re.fullmatch(r"[a-z]+\(.*\)", text) else ""


_QUOTES = "“”„«»‘’"


def read_units(node: Node | None, problems: Problems) -> Units:
    """The ``units`` section."""
    names = {"length": "m", "force": "N"}
    if type(node) is Mapping:
        for key, value in node.items.items():
            _unit_of_case(names, key, value, node, problems)
    elif node is not None and not is_null(node):
        problems.refuse(node.mark, "units should be a mapping, as in {length: in, force: lbf}")
    length, force = parse_unit(names["length"]), parse_unit(names["force"])
    product = times(force, length)
    torque_name = names.get("torque", f"{names['force']}*{names['length']}")
    torque = parse_unit(torque_name)
    return Units(
        names["length"],
        names["force"],
        torque_name,
        factor(product, torque),
        factor(parse_unit("N"), force),
        factor(parse_unit("m"), length),
        exact_ratio(product, torque),
        exact_ratio(parse_unit("N"), force),
    )


def _unit_of_case(names: dict[str, str], key: str, node: Node, section: Mapping, problems: Problems) -> None:
    if key not in UNIT_KEYS:
        told = suggestion(key, UNIT_KEYS) or "; other quantities carry their unit, as in 1.2 rad or 3 kg"
        problems.refuse(section.keys[key], f"units has no key {shown(key)}{told}")
        return
    text = node.text.strip() if type(node) is Scalar else ""
    try:
        unit = parse_unit(text)
        if unit.dims != DIMENSIONS[key]:
            given = kind_of(unit.dims)
            raise UnitError(f"'{text}' is {_a(given) if given else 'another kind of unit'}, not {_a(key)}")
        plain = "*".join(text.replace("·", " ").replace("*", " ").split())  # N·m and N m as N*m
        names[key] = plain if key == "torque" else canonical(text)
    except UnitError as error:
        problems.refuse(node.mark, str(error) if text else f"a unit of {key} should stand here")


def unit_names(units: Units) -> dict[str, str]:
    """The unit of each dimension, as messages and answers name it."""
    return {
        "length": units.length,
        "mass": "kg",
        "time": "s",
        "angle": "deg",
        "force": units.force,
        "torque": units.torque,
        "stiffness": f"{units.force}/{units.length}",
        "speed": f"{units.length}/s",
        "angular speed": "rad/s",
        "acceleration": "m/s^2",
        "power": "hp",
        "pitch": f"1/{units.length}",
        "line load": f"{units.force}/{units.length}",
        "area": f"{units.length}^2",
        "pressure": units.pressure,
        "torsional stiffness": f"{units.torque}/rad",
        "moment of inertia": "kg*m^2",
        "angular acceleration": "rad/s^2",
        "path acceleration": f"{units.length}/s^2",
    }
