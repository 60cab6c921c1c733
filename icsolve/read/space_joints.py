"""Joints in space."""

from __future__ import annotations

from icsolve.case import Number, Toward
from icsolve.case.space import Axis, Ball, Gears, Hinge, Joint, Radial, Thrust, Weld
from icsolve.read.document import Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.jointed import Kinds, read_list
from icsolve.read.quantities import number
from icsolve.read.reading import Reading
from icsolve.read.teeth import KEYS as TEETH
from icsolve.read.teeth import read_teeth, whole
from icsolve.read.vectors import WORDS, axis


def read_space_joints(reading: Reading, section: Sequence) -> tuple[Joint, ...]:
    """The joints of a case in space that could be read."""
    return read_list(reading, section, KINDS, "{hinge: [1, 2], at: A, axis: z}")


def _at(entry: Entry) -> str | None:
    return (
        entry.point("at") if entry.need("at", "the point through which its force acts") is not None else None
    )


def _ball(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    at = _at(entry)
    return Ball((links[0], links[1]), at) if at and complete else None


def _weld(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    at = _at(entry)
    return Weld((links[0], links[1]), at) if at and complete else None


def _radial(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    at, along = _at(entry), axis(entry, "axis", "the direction of the shaft")
    return Radial((links[0], links[1]), at, along) if at and along and complete else None


def _thrust(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    at, along = _at(entry), axis(entry, "axis", "the direction of the shaft")
    return Thrust((links[0], links[1]), at, along) if at and along and complete else None


def _hinge(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    at, along = _at(entry), axis(entry, "axis", "the direction about which its links turn")
    return Hinge((links[0], links[1]), at, along) if at and along and complete else None


def _gears(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    along = axis(entry, "axis", "the direction of the shafts")
    counts = _counts(entry)
    alone = counts is not None and len(counts) == 1
    centres = _centres(entry, 1 if alone else 2)
    teeth = read_teeth(entry, alone)
    toward = _toward(entry, alone, counts is not None)
    if not (along and counts and centres and teeth and complete) or (alone and toward is None):
        return None
    return _checked(entry, Gears((links[0], links[1]), centres, counts, along, teeth, toward))


def _checked(entry: Entry, joint: Gears) -> Gears | None:
    if not whole(entry, joint.counts):
        return None
    if len(joint.counts) == 1 and joint.counts[0].value < 0.0:
        entry.refuse(entry.mark("teeth"), "a gear whose mate is not shown has external teeth")
        return None
    return joint


def _counts(entry: Entry) -> tuple[Number, ...] | None:
    """One number of teeth, or those of both gears."""
    meaning = "the number of teeth of each gear, as in [31, 57]; one number where the mate is not shown"
    node = entry.need("teeth", meaning)
    if node is None:
        return None
    if type(node) is not Sequence:
        count = entry.number("teeth", "number")
        return (count,) if count is not None else None
    if len(node.items) != 2:
        entry.refuse(node.mark, f"'teeth' of {entry.what} should be {meaning}")
        return None
    found = [
        number(entry.reading, item, "number", f"{entry.path}.teeth.{n}") for n, item in enumerate(node.items)
    ]
    good = tuple(count for count in found if count is not None)
    return good if len(good) == 2 else None


def _centres(entry: Entry, count: int) -> tuple[str, ...] | None:
    """The centres of the wheels: one point, or two."""
    node = entry.need("at", "the centre of each wheel, as in [G, H]; one point where the mate is not shown")
    if node is None:
        return None
    if type(node) is not Sequence:
        centre = entry.point("at")
        if count == 2:
            entry.refuse(
                node.mark, f"'at' of {entry.what} should be the centres of both wheels, as in [G, H]"
            )
        return (centre,) if centre and count == 1 else None
    items = entry.reading.names(node, f"'at' of {entry.what}", "[G, H]")
    if items is None:
        return None
    for item in items:
        entry.reading.used.setdefault(item.text, item.mark)
    names = tuple(item.text for item in items)
    if len(names) != count or len(set(names)) < count:
        wanted = "one point" if count == 1 else "two different points"
        entry.refuse(node.mark, f"'at' of {entry.what} should be {wanted}: the teeth are those of {count}")
        return None
    return names


def _toward(entry: Entry, alone: bool, counted: bool) -> Axis | Toward | None:
    """Where the mate of a single gear lies."""
    if not alone:
        if entry.has("toward") and counted:
            said = "is for one gear whose mate is not shown; here both centres stand under 'at'"
            entry.refuse(entry.mark("toward"), f"'toward' of {entry.what} {said}")
        return None
    meaning = "where the mate lies, seen from the centre of the gear"
    node = entry.need("toward", meaning)
    if node is None:
        return None
    if type(node) is Scalar and node.text not in WORDS:
        point = entry.point("toward")
        return Toward(point) if point else None
    return axis(entry, "toward", meaning)


KINDS: Kinds[Joint] = {
    "ball": (("at",), _ball),
    "radial": (("at", "axis"), _radial),
    "thrust": (("at", "axis"), _thrust),
    "hinge": (("at", "axis"), _hinge),
    "weld": (("at",), _weld),
    "gears": (("teeth", "at", "axis", "toward", *TEETH), _gears),
}
"""Each kind's keys besides its links, and what reads it."""
