"""Joints: which two links, of what kind, where."""

from __future__ import annotations

from icsolve.case import (
    Belt,
    Contact,
    Friction,
    Gears,
    Guide,
    Joint,
    KnownCentre,
    Number,
    Pin,
    Roll,
    Slide,
    Slot,
    Weld,
)
from icsolve.read.document import Sequence
from icsolve.read.entry import Entry
from icsolve.read.jointed import Kinds, read_list
from icsolve.read.reading import Reading

Pair = tuple[str, str]
HELICAL = (
    *("helix angle", "hand", "bearing span", "normal pressure angle", "transverse pressure angle"),
    *("normal diametral pitch", "transverse diametral pitch", "normal module", "transverse module"),
)
"""What gears take besides where their teeth are helical."""


def read_joints(reading: Reading, section: Sequence) -> tuple[Joint, ...]:
    """The joints of a planar case that could be read."""
    return read_list(reading, section, KINDS, "{pin: [1, 2], at: B}")


def _friction(entry: Entry, extra: str = "") -> Friction | None:
    """``mu``, with the pin's ``radius`` or the block's ``length``."""
    mu = entry.number("mu", "number", "not negative")
    size = entry.number(extra, "length", "positive") if extra else None
    if mu is None:
        return None
    return Friction(mu, radius=size) if extra == "radius" else Friction(mu, length=size)


def _pin(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = _needed_point(entry, "the point about which its links turn")
    friction = _friction(entry, "radius")
    if entry.has("mu") and not entry.has("radius"):
        entry.refuse(entry.mark("mu"), f"friction of {entry.what} needs 'radius', the pin's own")
    return Pin(links, at, friction) if at and whole else None


def _needed_point(entry: Entry, meaning: str) -> str | None:
    return entry.point("at") if entry.need("at", meaning) is not None else None


def _slide(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = _needed_point(entry, "the point of the block")
    guide = _guide(entry, at)
    friction = _friction(entry, "length")
    return Slide(_two(links), at, guide, friction) if at and guide and whole else None


def _slot(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = _needed_point(entry, "the pin's point")
    guide = _guide(entry, at)
    friction = _friction(entry)
    return Slot(_two(links), at, guide, friction) if at and guide and whole else None


def _two(links: tuple[str, ...]) -> Pair:
    return links[0], links[1]


def _guide(entry: Entry, at: str | None) -> Guide | None:
    """The guide line; its joint's own point is then given by it."""
    if at:
        entry.reading.given.add(at)
    along = entry.need("along", "a direction in degrees, or two points of the guide as in [A, G]")
    through = entry.point("through")
    if along is None or (entry.has("through") and through is None):
        return None
    if type(along) is not Sequence:
        angle = entry.number("along", "angle")
        named = [through] if through else []
        guide = Guide(angle, None, through) if angle is not None else None
    else:
        ends = _ends(entry, along)
        named = [*(ends or ()), *([through] if through else [])]
        guide = Guide(None, ends, through) if ends else None
    entry.reading.on_guides.extend(named)
    return guide


def _ends(entry: Entry, node: Sequence) -> Pair | None:
    items = entry.reading.names(node, f"'along' of {entry.what}", "[A, G]")
    if items is None:
        return None
    for item in items:
        entry.reading.used.setdefault(item.text, item.mark)
    if len(items) == 2 and items[0].text != items[1].text:
        return items[0].text, items[1].text
    entry.refuse(node.mark, f"'along' of {entry.what} should be a direction or two different points")
    return None


def _roll(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = _needed_point(entry, "the point of contact")
    radii = _radii(entry) if entry.has("radii") else None
    if radii and max(radius.value for radius in radii) <= 0.0:
        entry.refuse(entry.mark("radii"), f"one of the radii of {entry.what} should be greater than zero")
    angle = _pressure_angle(entry)
    return Roll(_two(links), at, radii, angle) if at and whole else None


def _pressure_angle(entry: Entry) -> Number | None:
    angle = entry.number("pressure angle", "angle", "positive")
    if angle is not None and angle.value >= 90.0:
        entry.refuse(entry.mark("pressure angle"), "a pressure angle is less than 90 degrees")
    return angle


def _radii(entry: Entry) -> tuple[Number, Number] | None:
    return entry.pair("radii", "length", "01", "two radii, as in [1.5, 3]")


def _gears(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    teeth = _teeth(entry)
    carrier = _carrier(entry, links)
    if any(key in HELICAL for key in entry.node.items):
        from icsolve.read.teeth import read_helical

        form = read_helical(entry)
        return Gears(_two(links), teeth, carrier, *form) if teeth and form and whole else None
    entry.one_of(("diametral pitch", "module"))
    angle = _pressure_angle(entry)
    pitch = entry.number("diametral pitch", "pitch", "positive")
    module = entry.number("module", "length", "positive")
    return Gears(_two(links), teeth, carrier, angle, pitch, module) if teeth and whole else None


MOST_TEETH = 1e9


def _teeth(entry: Entry) -> tuple[Number, Number] | None:
    meaning = "the two numbers of teeth, as in [31, 57], or [31, -92] where 92 are internal"
    if entry.need("teeth", meaning) is None:
        return None
    teeth = entry.pair("teeth", "number", "01", meaning)
    if teeth is None:
        return None
    counts = [number.value for number in teeth]
    if any(count == 0.0 or abs(count) > MOST_TEETH or count != int(count) for count in counts):
        entry.refuse(entry.mark("teeth"), f"the teeth of {entry.what} should be whole numbers other than 0")
    elif max(counts) < 0.0:
        entry.refuse(entry.mark("teeth"), f"only one gear of {entry.what} can be internal (negative)")
    elif min(counts) < 0.0 and abs(min(counts)) <= max(counts):
        entry.refuse(entry.mark("teeth"), "an internal gear has more teeth than the one inside it")
    else:
        return teeth
    return None


def _carrier(entry: Entry, links: tuple[str, ...]) -> str | None:
    carrier = entry.link("carrier")
    if carrier in links:
        entry.refuse(entry.mark("carrier"), f"the carrier of {entry.what} is a third link")
    return carrier


def _belt(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    carrier = _carrier(entry, links)
    crossed = (entry.word("crossed", ("true", "false", "True", "False")) or "").lower() == "true"
    if entry.need("radii", "the two radii, as in [3, 5]") is None:
        return None
    radii = _radii(entry)
    if radii and min(radius.value for radius in radii) <= 0.0:
        entry.refuse(entry.mark("radii"), f"the radii of {entry.what} should be greater than zero")
    return Belt(_two(links), radii, crossed, carrier) if radii and whole else None


def _contact(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    if whole and not entry.has("at") and {*links} <= entry.reading.profiled:
        _touch(entry, links)
        return None
    at = _needed_point(entry, "the point of contact")
    into = f" from {links[0]} into {links[1]}" if whole else ""
    entry.need("normal", f"the direction of the common normal in degrees{into}")
    normal = entry.number("normal", "angle")
    friction = _friction(entry)
    return Contact(_two(links), at, normal, friction) if at and normal is not None and whole else None


def _touch(entry: Entry, links: tuple[str, ...]) -> None:
    """A contact whose place the profiles of its links give; it stands apart from the joints until then."""
    from icsolve.case.profiles import Touch

    normal = entry.number("normal", "angle")
    touch = Touch(_two(links), entry.reading.joint_number, normal, _friction(entry))
    entry.reading.touches.append((touch, entry.node.mark))


def _centre(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    both = entry.one_of(("at", "toward"))
    if both is None:
        entry.need("at", "its place, or 'toward', its direction where it is at infinity")
    if both == "toward":
        toward = entry.number("toward", "angle")
        return KnownCentre(_two(links), None, toward) if toward is not None and whole else None
    at = entry.place("at", f"@{'-'.join(links)}", "its place") if both else None
    return KnownCentre(_two(links), at) if at and whole else None


def _weld(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = entry.point("at")
    return Weld(_two(links), at) if whole else None


KINDS: Kinds[Joint] = {
    "pin": (("at", "mu", "radius"), _pin),
    "slide": (("at", "along", "through", "mu", "length"), _slide),
    "slot": (("at", "along", "through", "mu"), _slot),
    "roll": (("at", "radii", "pressure angle"), _roll),
    "gears": (("teeth", "carrier", "pressure angle", "diametral pitch", "module", *HELICAL), _gears),
    "belt": (("radii", "carrier", "crossed"), _belt),
    "contact": (("at", "normal", "mu"), _contact),
    "centre": (("at", "toward"), _centre),
    "weld": (("at",), _weld),
}
"""Each kind's keys besides its links, and what reads it."""
