"""The words of an answer: names in a row, texts that can be no markup, and of a load's value its sense, its
unit, and the range in which friction lets it be."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.case import (
    Area,
    Case,
    Force,
    Load,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
    is_link,
    is_named,
)
from icsolve.case.loads import aim_of
from icsolve.numbers import turn_of

if TYPE_CHECKING:
    from icsolve.answer import Found
    from icsolve.case.space import Load as SpatialLoad


def listed(names: Iterable[str]) -> str:
    """a, b and c."""
    *head, last = list(names) or [""]
    return f"{', '.join(head)} and {last}" if head else last


def links_named(names: Collection[str]) -> str:
    """link 5; links 5 and 6."""
    return f"link{'' if len(names) == 1 else 's'} {listed(names)}"


def plural(count: int, word: str) -> str:
    """1 load, 2 loads."""
    return f"{count} {word}" + ("" if count == 1 else "s")


_ENTITIES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;"}


def escaped(text: str) -> str:
    """A text that stays text in XML and HTML, in content and in attributes, whatever it says."""
    if not text.isprintable():
        text = "".join(c if _is_written(c) else "\N{REPLACEMENT CHARACTER}" for c in text)
    return "".join(_ENTITIES.get(c, c) for c in text)


def _is_written(c: str) -> bool:
    """Whether XML has a way to write a character."""
    return c in "\t\n\r" or " " <= c <= "\ud7ff" or "\ue000" <= c <= "\ufffd" or c > "\uffff"


def link_words(link: str) -> str:
    """``link 3``; what stands for a link where loads pull the free end of a rope or turn a screw."""
    if link.startswith("@screw "):
        return f"the {link[1:]}"
    return f"link {link}" if is_link(link) else f"the end of the rope {link[1:]}"


def at_words(point: str | None) -> str:
    """`` at B``; nothing of a point without a name."""
    return f" at {point}" if point and is_named(point) else ""


SPELT = {"ccw": "counterclockwise", "cw": "clockwise"}


NOTHING = 1e-12
"""A component is nothing beside a vector of which it is less: what rounding leaves of a zero."""


def plain_vector(vector: Sequence[float], size: float | None = None) -> tuple[float, float]:
    """A vector of the plane as people are told it: a component that is nothing beside ``size``, by default
    its own, is 0."""
    least = NOTHING * (math.hypot(*vector) if size is None else size)
    x, y = (c if abs(c) > least else 0.0 for c in vector)
    return x, y


def degrees_of(vector: Sequence[float]) -> float:
    """The direction of a vector as people are told it, degrees in [0, 360): along an axis but for rounding it
    is that of the axis."""
    x, y = plain_vector(vector)
    degrees = math.degrees(math.atan2(y, x)) % 360.0
    return degrees if degrees < 360.0 else 0.0


def sense_of(load: Load, value: float, gain: float, degrees: float) -> str:
    """Sense of a load with this value, whose unit exerts ``gain`` in the direction ``degrees``: ``ccw``,
    ``at 210 deg``, ``toward A``, ``pull``; '' for zero.
    """
    if value == 0.0:
        return ""
    match load:
        case Torque():
            return "ccw" if (value > 0) == (load.positive == "ccw") else "cw"
        case TorsionSpring():
            return "ccw" if value * gain > 0 else "cw"
        case Spring():
            return "pull" if value * gain > 0 else "push"
        case Force(link=link) if not is_link(link):
            return "pull" if value > 0 else "push"
        case Force(heading=Toward() as heading):
            if load.against is not None:
                return "pull" if (value > 0) != heading.away else "push"
            if (value > 0) != heading.away:
                return f"toward {heading.point}"
    return f"at {direction_words(degrees if value > 0 else degrees + 180.0)}"


def direction_words(degrees: float) -> str:
    """A direction counterclockwise from +x, to six digits, in [0, 360): what rounds to a whole turn is 0."""
    rounded = float(f"{round(degrees % 360.0, 6):.6g}")
    return f"{rounded % 360.0:.6g} deg"


Show = Callable[[float], str]
"""A number with the digits that are wanted."""


def spelt(sense: str, show: Show | None = None) -> str:
    """``ccw`` spelt out; with ``show`` the degrees of ``at 339.778 deg`` by their sign."""
    if show is not None and sense.startswith("at ") and sense.endswith(" deg"):
        return f"at {show(float(sense[3:-4]))}°"
    return SPELT.get(sense, sense)


def reach_of(holds: tuple[float, float], unit: str, show: Show, error: float | None) -> str:
    """A range of values: ``from 3 to 4 N``, ``only at 3 N`` where its ends are one within the error."""
    least, most = holds
    if most - least <= 2.0 * (error or 0.0):
        return f"only at {show(least)} {unit}"
    if math.isfinite(least) and math.isfinite(most):
        return f"from {' to '.join(_apart(least, most, show))} {unit}"
    if math.isfinite(least):
        return f"from {show(least)} {unit} up"
    return f"up to {show(most)} {unit}" if math.isfinite(most) else "at any value"


def _apart(low: float, high: float, show: Show) -> tuple[str, str]:
    """Two numbers, with as many more digits as tell them apart."""
    texts, minus, own = (show(low), show(high)), show(-1.0)[0], len(show(math.pi)) - 1
    for digits in range(own + 1, DOUBLE + 1):
        if texts[0] != texts[1]:
            break
        texts = (f"{low:.{digits}g}".replace("-", minus), f"{high:.{digits}g}".replace("-", minus))
    return texts


DOUBLE = 17
"""Digits that tell any two doubles apart."""


def holding(found: Found, show: Show) -> str:
    """``holds still from 3 to 4 N``, and whether it locks itself."""
    return f"holds still {held(found, show)}" + (", self-locking" if found.self_locking else "")


def held(found: Found, show: Show) -> str:
    """The range alone."""
    return reach_of(found.holds or (math.nan, math.nan), found.unit, show, found.error)


def unit_of(load: Load | SpatialLoad, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    match load:
        case Torque():
            return case.units.torque
        case Weight(mass=True):
            return "kg"
        case Spring() | Force(over=Stretch()):
            return f"{case.units.force}/{case.units.length}"
        case TorsionSpring():
            return f"{case.units.torque}/rad"
        case Force(over=Area()):
            return case.units.pressure
    return case.units.force


# --- senses as directions: ``right``, ``at 30 deg``, ``toward P``, ``pull`` -----------------------------


Places = Mapping[str, Sequence[float]]
"""Points of the plane, or of space."""
Way = tuple[float, float, float]

_WORDS = {"right": (1.0, 0.0), "up": (0.0, 1.0), "left": (-1.0, 0.0), "down": (0.0, -1.0)}
_LOOSE = 45.0
"""Degrees within which a direction may be called by one of the four words."""
_CLOSE = 1.0
"""Degrees within which it may be called by an angle or by a point."""


def less_than_none(
    loads: Iterable[Load | SpatialLoad], answers: Mapping[str, Found]
) -> list[Load | SpatialLoad]:
    """Of masses, springs and pressures those that are found to be negative, with friction throughout."""
    return [load for load in loads if load.name in answers and _is_below(load, answers[load.name])]


def _is_below(load: Load | SpatialLoad, found: Found) -> bool:
    kind = isinstance(load, Spring | TorsionSpring) or (isinstance(load, Weight) and load.mass)
    most = found.value if found.holds is None else found.holds[1]
    return most < 0.0 and (kind or (isinstance(load, Force) and isinstance(load.over, Area)))


def with_or_against(published: str, found: str, load: Load | SpatialLoad, places: Places) -> int:
    """1 where a load of sense ``found`` goes the way that ``published`` says, as books round directions (in
    space ``along -z`` may be published as ``down``, or as ``away from P`` where P lies above), -1 where it
    goes the opposite way, 0 where neither.
    """
    theirs, ours = (way_of(sense, load, places) for sense in (published, found))
    if theirs is None or ours is None:
        opposite = {published, found} == {"pull", "push"}
        return 1 if published == found else -1 if opposite else 0
    return along_or_back(theirs, ours, published)


def along_or_back(theirs: Way, ours: Way, published: str) -> int:
    """1 where two unit vectors differ by no more than the published words leave open, -1 where one and the
    opposite of the other do, 0 where neither."""
    room = math.cos(math.radians(_LOOSE if published in _WORDS else _CLOSE)) - 1e-12
    along = sum(a * b for a, b in zip(theirs, ours, strict=True))
    return 1 if along >= room else -1 if -along >= room else 0


def way_of(
    sense: str, load: Load | SpatialLoad | None, places: Places, start: Sequence[float] | None = None
) -> Way | None:
    """The unit vector of a sense; None where the words alone do not give one. The sense is that of a load, or
    of what acts or moves at ``start``.
    """
    lead, _, rest = sense.partition(" ")
    if sense in _WORDS:
        across, up = _WORDS[sense]
        in_space = any(len(place) > 2 for place in places.values())
        return (across, 0.0, up) if in_space else (across, up, 0.0)
    if lead == "at":
        degrees = _number(rest)
        return None if degrees is None else (*turn_of(degrees), 0.0)
    start, end = start or places.get(getattr(load, "at", "")), places.get(rest.removeprefix("from "))
    if lead in ("pull", "push"):
        end = places.get(aim_of(load))
    elif lead in ("along", "about"):
        one, _, other = rest.partition(" to ")
        start, end = places.get(one), places.get(other)
        if not other:
            start, end = (0.0, 0.0, 0.0), _components(rest)
    if start is None or end is None:
        return None
    x, y, *z = (b - a for a, b in zip(start, end, strict=True))
    size = math.hypot(x, y, *z) * (-1.0 if lead in ("away", "push") else 1.0)
    return (x / size, y / size, sum(z) / size) if size else None


def _components(words: str) -> Way | None:
    """``-z``, ``[0, 0.6, -0.8]``."""
    sign, axis = (-1.0, words[1:]) if words.startswith("-") else (1.0, words)
    if axis in ("x", "y", "z"):
        return (sign * (axis == "x"), sign * (axis == "y"), sign * (axis == "z"))
    parts = [_number(part) for part in words.strip("[]()").split(",")]
    x, y, z = parts if len(parts) == 3 else (None, None, None)
    return None if x is None or y is None or z is None else (x, y, z)


def _number(text: str) -> float | None:
    """The number that a text begins with."""
    try:
        return float(text.split(maxsplit=1)[0])
    except (ValueError, IndexError):
        return None
