"""Published values, to compare when the case is solved."""

from typing import NamedTuple

from icsolve.case import (
    ArmIs,
    CentreIs,
    DistanceIs,
    Expected,
    FrictionRadiusIs,
    LoadIs,
    Number,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.listed import DIMENSION
from icsolve.read.names import is_name
from icsolve.read.quantities import number, quantity
from icsolve.read.reading import Reading
from icsolve.read.targets import target_of
from icsolve.units import UnitError, split_quantity

KEYS = ("value", "toward", "within", "erratum")
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
    entry = Entry(reading, node, f"expect.{key}", f"the expected {key}")
    entry.only(*KEYS)
    which = entry.one_of(("value", "toward"))
    if which is None:
        entry.need("value", "the published one")
        return None
    toward = which == "toward"
    value = _toward(entry, target) if toward else _value(reading, node.items["value"], target, entry.path)
    within = _within(entry, "angle" if toward else _dimension(reading, target))
    erratum = reading.text(node.items["erratum"], f"the erratum of {key}") if entry.has("erratum") else None
    if erratum == "":
        entry.refuse(entry.mark("erratum"), f"the erratum of {key} should say what is wrong with the value")
    if value is None or within is None:
        return None
    width, relative = within
    return Expected(key, target, *value, within=width, relative=relative, erratum=erratum)


def _toward(entry: Entry, target: Target) -> _Value | None:
    if not isinstance(target, CentreIs):
        entry.refuse(entry.mark("toward"), f"{entry.what} is not a centre; only a centre can lie 'toward'")
        return None
    toward = entry.number("toward", "angle")
    return _Value(toward=toward) if toward is not None else None


def _within(entry: Entry, dimension: str) -> tuple[float | None, bool] | None:
    """Width of agreement and whether it is a fraction; None where it can't be read."""
    node = entry.node.items.get("within")
    if node is None:
        return None, False
    text = node.text.strip() if type(node) is Scalar else ""
    if not text.endswith("%"):
        width = entry.number("within", dimension, "not negative")
        return (width.value, False) if width is not None else None
    assert type(node) is Scalar
    path = f"{entry.path}.within"
    percent = quantity(entry.reading, node, text[:-1].strip(), "number", path)
    if percent is not None and percent.value < 0.0:
        entry.refuse(node.mark, f"the width {text} should not be negative")
        return None
    return (percent.value / 100.0, True) if percent is not None else None


def _value(reading: Reading, node: Node, target: Target, path: str) -> _Value | None:
    if isinstance(target, CentreIs):
        return _place(reading, node, path)
    dimension = _dimension(reading, target)
    if not dimension:
        return None
    if type(node) is not Scalar:
        number(reading, node, dimension, path)
        return None
    text, sense = _divided(node.text)
    reading.marks[path] = node.mark
    value = quantity(reading, node, text, dimension, path)
    fits, allowed = (_fits_space, _ALLOWED) if reading.axes == "xyz" else (_fits, _allowed(dimension))
    if sense is not None and not fits(sense, dimension):
        reading.refuse(node.mark, f"'{sense}' is not a sense of {path.removeprefix('expect.')}; {allowed}")
        return None
    return _Value((value,), None, sense) if value is not None else None


def _place(reading: Reading, node: Node, path: str) -> _Value | None:
    if type(node) is not Sequence or len(node.items) != 2:
        reading.refuse(node.mark, "a centre is published as [x, y], or as {toward: 90} at infinity")
        return None
    values = [
        number(reading, item, "length", f"{path}.{axis}") for item, axis in zip(node.items, "xy", strict=True)
    ]
    good = tuple(value for value in values if value is not None)
    return _Value(good) if len(good) == 2 else None


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


def _fits(sense: str, dimension: str) -> bool:
    lead, _, rest = sense.partition(" ")
    if dimension in ("torque", "angular speed"):
        return sense in _TURNS
    if dimension in ("force", "speed"):
        return sense in _LINES or (lead == "toward" and is_name(rest)) or (lead == "at" and _is_angle(rest))
    return False


def _fits_space(sense: str, dimension: str) -> bool:
    """As `_fits`, of a case in space."""
    lead = sense.partition(" ")[0]
    if dimension == "torque":
        return lead == "about"
    return dimension == "force" and (lead in ("along", "toward", "away") or sense in _LINES[2:])


_ALLOWED = "in space it is 'along -z', 'toward P', pull, push, up or down; of a torque 'about -z'"


def _is_angle(text: str) -> bool:
    """Whether a text is an angle in degrees, with or without its unit."""
    try:
        parts = split_quantity(text)
    except UnitError:
        return False
    return parts is not None and parts[1] in ("", "deg", "°", "degrees")


def _allowed(dimension: str) -> str:
    if dimension in ("torque", "angular speed"):
        return "it is ccw or cw"
    if dimension in ("force", "speed"):
        return "it is right, left, up, down, pull, push, 'at 30 deg' or 'toward P'"
    return "it is a number without a sense"


def _dimension(reading: Reading, target: Target) -> str:
    """The dimension of a target; '' of a load whose kind could not be read, and of a vector."""
    if isinstance(target, LoadIs):
        kind = reading.kinds[target.load]
        return {"vector": "force", "couple": "torque"}.get(kind) or DIMENSION.get(kind, "")
    if isinstance(target, ReactionIs):
        return "torque" if target.part.partition(" ")[0] in ("moment", "couple") else "force"
    if isinstance(target, RateIs):
        return "angular speed"
    if isinstance(target, SpeedIs):
        return "speed"
    if isinstance(target, CentreIs | DistanceIs | ArmIs | FrictionRadiusIs):
        return "length"
    assert isinstance(target, RatioIs)
    return "number"
