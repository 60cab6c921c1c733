"""Published values, to compare when the case is solved: what their keys name; and how near is near enough."""

from __future__ import annotations

import re
from collections.abc import Iterator

from icsolve.case import Number, Pair
from icsolve.case.expected import (
    ArmIs,
    CentreIs,
    DistanceIs,
    Expected,
    FrictionRadiusIs,
    LoadIs,
    PositionIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
    TensionIs,
    Tolerance,
    dimension_of,
)
from icsolve.numbers.units import DIMENSIONS, UnitError, parse_unit, split_quantity
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.entry import Entry
from icsolve.read.joints import NAMES
from icsolve.read.keys import EXPECTED, EXPECTED_TIES
from icsolve.read.loads import dimension_of as load_dimension
from icsolve.read.names import LONGEST_KEY, is_name, meant_by, pairs, parts, shown, suggestion
from icsolve.read.reading import Reading, number, numbers, quantity
from icsolve.tuples import NamedTuple

SHARES = (
    *("normal", "friction", "tangential", "separating", "transverse", "axial", "radial", "thrust"),
    *("couple", "bearing"),
)
"""Shares of a reaction that a key can name before it: ``thrust F12@A``."""


def target_of(reading: Reading, key: str, points: set[str]) -> Target | str:
    """The target of a key, or what is wrong with the key. A load's name wins over other readings."""
    if key in reading.kinds:
        return LoadIs(key)
    if len(key) > LONGEST_KEY:
        return "this key is too long"
    if key.partition(".")[0] in ("angles", "lengths", "points"):
        return _position(reading, key)
    found = list(dict.fromkeys(_readings(reading, key, points))) or _between_points(key, points)
    if reading.axes == "xyz":
        found = [target for target in found if _is_of_space(target)]
    if len(found) == 1:
        return found[0]
    if found:
        return f"{shown(key)} can be read in {len(found)} ways; write the links with hyphens, as in I3-14"
    return _unknown(reading, key, points)


def _position(reading: Reading, key: str) -> Target | str:
    """A datum of the figure that is to find, however its points are joined in the key."""
    section, _, rest = key.partition(".")
    for path in (unknown.path for unknown in reading.unknowns):
        if path == key or (path.startswith(f"{section}.") and _names_of(path) == _names_of(key)):
            return PositionIs(path)
    if section == "points" and rest.partition(".")[0] in reading.given:
        return PositionIs(key)
    likely = suggestion(key, [unknown.path for unknown in reading.unknowns])
    return f"{shown(key)} is no datum of the figure that is to find{likely}"


def _names_of(path: str) -> tuple[str, ...]:
    names = parts(path.partition(".")[2])
    return tuple(sorted(names)) if path.startswith("lengths.") else names


def _is_of_space(target: Target) -> bool:
    """Whether a case in space has such a value."""
    between = isinstance(target, DistanceIs) and isinstance(target.a, str) and isinstance(target.b, str)
    return between or isinstance(target, ReactionIs | ArmIs)


def dimension_of_target(reading: Reading, target: Target) -> str:
    """The dimension of what a key names; '' of a load whose kind could not be read, and of a vector."""
    return load_dimension(reading.kinds[target.load]) if isinstance(target, LoadIs) else dimension_of(target)


_OMEGA = re.compile(r"(?:omega|ω|Ω|n)_?(?=\w)", re.IGNORECASE)


def _unknown(reading: Reading, key: str, points: set[str]) -> str:
    likely = suggestion(key, reading.kinds)
    bare = re.sub("[ _]", "", key)
    for meant in dict.fromkeys((bare, bare[:1].upper() + bare[1:], _OMEGA.sub("w", bare))):
        if not likely and any(_readings(reading, meant, points)):
            likely = f"; did you mean '{meant}'?"
    if not likely and bare[:1] in ("v", "V") and bare[1:] in points and reading.axes != "xyz":
        likely = f"; write 'v {bare[1:]} on' and its link"
    forms = "a load, I24, I12-I26, I24-A, w4/w2, w2, 'v C on 8', F34, M34, 'h F32 A', 'rf B' or 'T A-P-B'"
    if reading.axes == "xyz":
        forms = "a load, A-B, F34, F34z, F1-2@B, M34, M34x, 'thrust F12@B' or 'h F32 A'"
    return f"{shown(key)} names nothing in this case" + (likely or f"; a key can be {forms}")


def _readings(reading: Reading, key: str, points: set[str]) -> Iterator[Target]:
    words = key.split()
    if len(words) > 1:
        yield from _in_words(reading, words, points)
        return
    yield from _rates(reading, key)
    yield from map(CentreIs, _links(reading, key[1:]) if key.startswith("I") else ())  # I24, I2-4
    yield from map(CentreIs, _links(reading, key))
    yield from _distances(reading, key, points)
    yield from _reactions(reading, key, points)


def _in_words(reading: Reading, words: list[str], points: set[str]) -> Iterator[Target]:
    """``v C on 8``, ``h F32 A``, ``rf B``, ``T A-P-B``, of a part ``T A-P-B 2``; a share, ``thrust F12@A``,
    ``couple 3 F23``: of a pair of gears, that of gear 3; ``F1-2@A contact 2``, of several joints at A."""
    match words:
        case ["v", point, "on", link] if point in points and reading.knows_link(link):
            yield SpeedIs(point, link)
        case ["h", force, point] if force.startswith("F") and point in points:
            yield from (ArmIs(by, on, point) for by, on in pairs(force[1:], reading.knows_link))
        case ["rf", point] if point in points:
            yield FrictionRadiusIs(point)
        case ["T", rope, *part] if rope in reading.ropes and len(part) < 2:
            digits = part[0] if part else "1"
            if digits.isdigit() and 0 < int(digits) < len(rope.split("-")):
                yield TensionIs(rope, int(digits))
        case [*share, force, kind, number] if kind in NAMES and number.isdigit() and len(share) < 2:
            of = _in_words(reading, [*share, force], points) if share else _reactions(reading, force, points)
            yield from (
                one._replace(at=f"{one.at} {kind} {number}")
                for one in of
                if isinstance(one, ReactionIs) and one.at
            )
        case [share, *gear, force] if share in SHARES and len(gear) < 2:
            if all(map(reading.knows_link, gear)):
                wholes = (whole for whole in _reactions(reading, force, points) if whole.part == "")
                yield from (whole._replace(part=" ".join(words[:-1])) for whole in wholes)


def _rates(reading: Reading, key: str) -> Iterator[Target]:
    over, slash, under = key.partition("/")
    if over[:1] == "w" and is_name(over[1:] or "-") and reading.knows_link(over[1:]):
        if not slash:
            yield RateIs(over[1:])
        elif under[:1] == "w" and reading.knows_link(under[1:]):
            yield RatioIs(over[1:], under[1:])


def _links(reading: Reading, text: str) -> list[Pair]:
    """The pairs of different links that a text can mean."""
    return [pair for pair in pairs(text, reading.knows_link) if pair[0] != pair[1]]


def _distances(reading: Reading, key: str, points: set[str]) -> Iterator[Target]:
    """Cut at each hyphen: a centre or a point on both sides, a centre on one at least."""
    for at in [i for i, character in enumerate(key) if character == "-"]:
        for a in _ends(reading, key[:at], points):
            for b in _ends(reading, key[at + 1 :], points):
                if a != b and not (isinstance(a, str) and isinstance(b, str)):
                    yield DistanceIs(a, b)


def _between_points(key: str, points: set[str]) -> list[Target]:
    """``A-B`` where it means nothing else."""
    a, _, b = key.partition("-")
    return [DistanceIs(a, b)] if a in points and b in points and a != b else []


def _ends(reading: Reading, text: str, points: set[str]) -> list[Pair | str]:
    found: list[Pair | str] = [text] if text in points else []
    if text.startswith("I"):
        found += _links(reading, text[1:])
    return found


def _reactions(reading: Reading, key: str, points: set[str]) -> Iterator[ReactionIs]:
    """``F34``, ``F34x``, ``F3-14``, ``F3-4@B``, ``M34``, without a point ``F3-4@belt``; a part stands after
    the links or the place."""
    if key[:1] not in ("F", "M"):
        return
    links, mark, place = key[1:].partition("@")
    for text, part in _parts(reading, key[0], links):
        if not mark:
            yield from _reaction(reading, text, part, None)
        elif place in points or place in NAMES:
            yield from _reaction(reading, text, part, place)
        elif part in ("", "moment") and place[:-1] in points:
            component = _component(reading, key[0], place[-1:])
            yield from _reaction(reading, text, component, place[:-1]) if component else ()


def _parts(reading: Reading, letter: str, links: str) -> list[tuple[str, str]]:
    """Where the links end and a component's letter may stand."""
    whole = (links, "" if letter == "F" else "moment")
    part = _component(reading, letter, links[-1:])
    return [whole, (links[:-1], part)] if part else [whole]


def _component(reading: Reading, letter: str, axis: str) -> str:
    """The part that a letter at the end names: ``x`` of a force, ``moment x`` of a couple; '' for none."""
    if not axis or axis not in (reading.axes if letter == "F" else reading.couples):
        return ""
    return axis if letter == "F" else f"moment {axis}"


def _reaction(reading: Reading, text: str, part: str, at: str | None) -> Iterator[ReactionIs]:
    yield from (ReactionIs(by, on, part, at) for by, on in _links(reading, text))


SENSES = {
    "clockwise": "cw",
    "counterclockwise": "ccw",
    "counter-clockwise": "ccw",
    "anticlockwise": "ccw",
    "tension": "pull",
    "compression": "push",
    "upward": "up",
    "upwards": "up",
    "downward": "down",
    "downwards": "down",
}
"""Spellings of a sense and the word that stands for each."""

_TURNS = ("ccw", "cw")
_LINES = ("right", "left", "up", "down", "pull", "push")
_LEADS = ("at", "toward", "towards", "to", "along", "about", "away")


class _Value(NamedTuple):
    """What a published value says."""

    value: tuple[Number, ...] = ()
    toward: Number | None = None
    sense: str | None = None


def read_expect(reading: Reading, section: Mapping, points: set[str]) -> tuple[Expected, ...]:
    """The published values that could be read."""
    found: list[Expected] = []
    if reading.links is None:  # the joints can't be read: no key could be understood
        return ()
    for key, node in section.items.items():
        reading.marks[f"expect.{key}"] = section.keys[key]
        target = target_of(reading, key, points)
        if isinstance(target, str):
            reading.refuse(section.keys[key], target)
            continue
        expected = _expected(reading, key, target, node)
        if expected is not None:
            found.append(expected)
    return tuple(found)


def _expected(reading: Reading, key: str, target: Target, node: Node) -> Expected | None:
    if type(node) is not Mapping:
        bare = _value(reading, node, target, f"expect.{key}")
        return Expected(key, target, *bare) if bare is not None else None
    entry = Entry(reading, node, f"expect.{key}", f"the expected {key}", EXPECTED, EXPECTED_TIES)
    entry.check()
    if isinstance(target, LoadIs) and not dimension_of_target(reading, target):
        return None  # the load can't be read, and that is told
    entry.check_ties()
    which = next((key for key in ("value", "toward", "holds") if entry.has(key)), None)
    if which is None:
        return None
    toward = which == "toward"
    holds, value = None, None
    if which == "holds":
        holds = _holds(entry, target)
        value = _Value() if holds is not None else None
    else:
        value = _toward(entry, target) if toward else _value(reading, node.items["value"], target, entry.path)
    stability = entry.word("stability", ("stable", "unstable", "neutral"))
    if stability is not None and not isinstance(target, PositionIs):
        said = f"{entry.what} is not a position, which alone can be {stability}"
        entry.refuse(entry.mark("stability"), said)
    within = _within(entry, "angle" if toward else dimension_of_target(reading, target))
    erratum = reading.text(node.items["erratum"], f"the erratum of {key}") if entry.has("erratum") else None
    if erratum == "":
        entry.refuse(entry.mark("erratum"), f"the erratum of {key} should say what is wrong with the value")
    if value is None or within is None:
        return None
    width, relative = within
    return Expected(key, target, *value, width, relative, erratum, holds, stability)


def _holds(entry: Entry, target: Target) -> tuple[Number | None, Number | None] | None:
    """The two ends of a range in which a load holds; null for no end."""
    node = entry.node.items["holds"]
    if not isinstance(target, LoadIs):
        entry.refuse(entry.mark("holds"), f"{entry.what} is not a load; only a load holds over a range")
        return None
    if type(node) is not Sequence or len(node.items) != 2 or all(is_null(item) for item in node.items):
        form = "the two ends of the range, as in [113, 287], null for one that it has not"
        entry.refuse(node.mark, f"'holds' of {entry.what} should be {form}")
        return None
    dimension = dimension_of_target(entry.reading, target)
    low, high = (
        None if is_null(item) else number(entry.reading, item, dimension, f"{entry.path}.holds.{n}")
        for n, item in enumerate(node.items)
    )
    whole = [is_null(item) == (end is None) for item, end in zip(node.items, (low, high), strict=True)]
    if not all(whole):
        return None
    if low is not None and high is not None and low.value > high.value:
        entry.refuse(node.mark, f"'holds' of {entry.what} goes from the lower to the higher end")
        return None
    return low, high


def _toward(entry: Entry, target: Target) -> _Value | None:
    if not isinstance(target, CentreIs):
        entry.refuse(entry.mark("toward"), f"{entry.what} is not a centre; only a centre can lie 'toward'")
        return None
    toward = entry.number("toward")
    return _Value(toward=toward) if toward is not None else None


def _within(entry: Entry, dimension: str) -> tuple[float | None, bool] | None:
    """Width of agreement and whether it is a fraction; None where it can't be read."""
    node = entry.node.items.get("within")
    if node is None:
        return None, False
    text = node.text.strip() if type(node) is Scalar else ""
    share = re.fullmatch(rf"(.*?) ?{_SHARE}", text)
    if share is None:
        width = entry.number("within", dimension, "not negative")
        return (width.value, False) if width is not None else None
    assert type(node) is Scalar
    path = f"{entry.path}.within"
    percent = quantity(entry.reading, node, share[1].strip(), "number", path)
    if percent is not None and percent.value < 0.0:
        entry.refuse(node.mark, f"the width {text} should not be negative")
        return None
    return (percent.value / 100.0, True) if percent is not None else None


def _value(reading: Reading, node: Node, target: Target, path: str) -> _Value | None:
    if isinstance(target, CentreIs):
        return _place(reading, node, path)
    dimension = dimension_of_target(reading, target)
    if not dimension:
        return None
    if type(node) is not Scalar:
        number(reading, node, dimension, path)
        return None
    text, sense = _divided(node.text)
    reading.marks[path] = node.mark
    if sense is None and (slip := _misspelt(text)):
        reading.refuse(node.mark, slip)
        return None
    value = quantity(reading, node, text, dimension, path)
    if sense is not None:
        fits, allowed = _senses(reading, target, sense, dimension)
        if not fits:
            said = f"'{sense}' is not a sense of {path.removeprefix('expect.')}; {allowed}"
            reading.refuse(node.mark, said)
            return None
    return _Value((value,), None, sense) if value is not None else None


def _misspelt(text: str) -> str:
    """What is wrong where the last word of a value is like no unit, and much like a sense; '' for nothing."""
    word = " ".join(text.split()[1:]).rpartition(" ")[2]
    try:
        parse_unit(word or "m")
    except UnitError as error:
        meant = meant_by(word, (*_TURNS, *_LINES, *SENSES))
        if meant and "did you mean" not in str(error):
            return f"{shown(word)} is neither a unit nor a sense; did you mean '{meant}'?"
    return ""


def _place(reading: Reading, node: Node, path: str) -> _Value | None:
    if type(node) is not Sequence or len(node.items) != 2:
        reading.refuse(node.mark, "a centre is published as [x, y], or as {toward: 90} at infinity")
        return None
    place = numbers(reading, node.items, "length", path, "xy")
    return _Value(place) if place is not None else None


def _divided(text: str) -> tuple[str, str | None]:
    """The quantity and the sense in words after it."""
    words = text.split()
    for index, word in enumerate(words):
        lower = word.lower()
        if index and lower in (*_TURNS, *_LINES, *_LEADS, *SENSES):
            sense = [SENSES.get(lower, lower), *words[index + 1 :]]
            if sense[:2] == ["to", "the"]:
                sense = sense[2:]
            return " ".join(words[:index]), " ".join(sense).replace("towards ", "toward ")
    return text.strip(), None


def _senses(reading: Reading, target: Target, sense: str, dimension: str) -> tuple[bool, str]:
    """Whether a target has a sense in words by which it is compared, and which it may have."""
    allowed = _ALLOWED.get(dimension, _WITHOUT)
    lines, words = _fits(sense, dimension), _LINES[:4]
    match target:
        case LoadIs() if reading.axes == "xyz":
            return _fits_space(sense, dimension), _ALLOWED_IN_SPACE
        case ReactionIs(part="moment") if reading.axes == "xy":
            return lines, allowed
        case ReactionIs(part="x" | "y" as axis) if reading.axes == "xy":
            own = words[:2] if axis == "x" else words[2:]
            return sense in own, f"it is {' or '.join(own)}"
        case ReactionIs(part="") if reading.axes == "xy":
            return lines and sense not in ("pull", "push"), _PLAIN_LINE
        case SpeedIs():
            return lines and sense not in ("pull", "push"), _PLAIN_LINE
        case TensionIs():
            return sense in ("pull", "push"), "it is pull"
        case ReactionIs():
            return False, _WITHOUT
    return lines, allowed


def _fits(sense: str, dimension: str) -> bool:
    lead, _, rest = sense.partition(" ")
    if dimension in _ABOUT:
        return sense in _TURNS
    if dimension in _ALONG:
        return sense in _LINES or (lead == "toward" and is_name(rest)) or (lead == "at" and _is_angle(rest))
    return False


def _fits_space(sense: str, dimension: str) -> bool:
    """As `_fits`, of a case in space."""
    lead = sense.partition(" ")[0]
    if dimension == "torque":
        return lead == "about"
    return dimension in _ALONG and (lead in ("along", "toward", "away") or sense in _LINES[2:])


_WITHOUT = "it is a number without a sense"
_PLAIN_LINE = "it is right, left, up, down, 'at 30 deg' or 'toward P'"
_TURNING, _LINE = "it is ccw or cw", "it is right, left, up, down, pull, push, 'at 30 deg' or 'toward P'"
_ABOUT = ("torque", "angular speed", "torsional stiffness")
_ALONG = ("force", "speed", "pressure", "mass", "line load", "stiffness")
_ALLOWED = {**dict.fromkeys(_ABOUT, _TURNING), **dict.fromkeys(_ALONG, _LINE)}
"""The senses of a dimension in words."""
_ALLOWED_IN_SPACE = "in space it is 'along -z', 'toward P', pull, push, up or down; of a torque 'about -z'"


def _is_angle(text: str) -> bool:
    """Whether a text is an angle in degrees, with or without its unit."""
    try:
        parts = split_quantity(text)
    except UnitError:
        return False
    return parts is not None and parts[1] in ("", "deg", "°", "º", "˚", "degrees")


_SHARE = "(?:%|per ?cent)"
_PERCENT = rf"(\d+(?:\.\d+)?|\.\d+) ?{_SHARE}$"
_COUNT = r"(?i)(\d{1,2}) ?(?:sf|s\.f\.|sig figs?|figures?|significant figures?)$"
_WIDTH = r"(\d+(?:\.\d+)?(?:[eE][-+]?\d+)?|\.\d+) ?([^\d\s%].*)?$"
_FORM = "write 1%, 3 sf, a width such as 0.5 N, or {drawing: 0.02 in}"


def read_tolerance(reading: Reading, node: Node) -> Tolerance | None:
    """The tolerance of a case; None, with the reason noted, where it is none."""
    try:
        return tolerance_of(node)
    except ValueError as error:
        reading.refuse(node.mark, f"'tolerance': {error}")
        return None


def tolerance_of(node: Node) -> Tolerance:
    """``1%``, ``3 sf``, ``0.5 N``, or a mapping with ``relative``, ``absolute``, ``figures``, ``drawing``.

    Raises ValueError, with a sentence.
    """
    if type(node) is Scalar:
        return parse_tolerance(node.text)
    if type(node) is not Mapping or not node.items:
        raise ValueError(_FORM)
    found = Tolerance()
    for key, value in node.items.items():
        if type(value) is not Scalar:
            raise ValueError(f"'{key}' should be one quantity")
        found = _with_part(found, key, value.text.strip())
    return found


def _with_part(found: Tolerance, key: str, text: str) -> Tolerance:
    """With one key of the mapping."""
    share = re.search(f"{_SHARE}$", text)
    if key == "relative" and share:
        return found._replace(relative=parse_tolerance(text).relative)
    if key == "absolute" and not share:
        width = parse_tolerance(text)
        return found._replace(absolute=width.absolute, unit=width.unit)
    if key == "figures":
        return found._replace(figures=parse_tolerance(f"{text} sf").figures)
    if key == "drawing":
        _length(text)
        return found._replace(drawing=text)
    raise ValueError(f"{shown(key)} with {shown(text)} is not understood; {_FORM}")


def _length(text: str) -> None:
    width = re.match(_WIDTH, text)
    unit = width.group(2) if width else None
    try:
        if width and (unit is None or parse_unit(unit).dims == DIMENSIONS["length"]):
            return
    except UnitError:
        pass
    raise ValueError(f"{shown(text)} is not a length, such as 0.02 in")


def parse_tolerance(text: str) -> Tolerance:
    """``1%``, ``3 sf``, ``0.5``, ``0.5 N``.

    Raises ValueError, with a sentence, where the text is none of these.
    """
    text = " ".join(text.split())
    percent, count, width = (re.match(form, text) for form in (_PERCENT, _COUNT, _WIDTH))
    if percent:
        return _limited(Tolerance(relative=float(percent.group(1)) / 100.0))
    if count:
        return _limited(Tolerance(figures=int(count.group(1))))
    if re.match(r"\d+,\d", text):
        raise ValueError(f"write a decimal point, {text.replace(',', '.', 1)}")
    if width:
        try:
            unit = parse_unit(width.group(2) or "m")
        except UnitError as error:
            raise ValueError(f"{shown(text)} is not a tolerance: {_FORM} ({error})") from None
        if unit.dims == DIMENSIONS["time"]:
            raise ValueError(f"{shown(text)} is a time, which no answer is: {_FORM}")
        return _limited(Tolerance(absolute=float(width.group(1)), unit=width.group(2) or ""))
    raise ValueError(f"{shown(text)} is not a tolerance: {_FORM}")


def _limited(tolerance: Tolerance) -> Tolerance:
    if tolerance.relative >= 1.0:
        raise ValueError("a tolerance of 100 % or more would accept anything")
    if not tolerance.relative and not tolerance.absolute and not 1 <= tolerance.figures <= 15:
        raise ValueError("a tolerance is more than zero, or 1 to 15 significant figures")
    return tolerance
