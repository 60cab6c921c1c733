"""What a picture is made of: shapes and texts in picture units (y down), grouped under ids.

A mark knows its class (the style sheet has its colours) and where it lies; nothing here knows of mechanisms.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from icsolve.tuples import NamedTuple

Point = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""


class AreaMark(NamedTuple):
    """A filled region: an outer ring and its holes."""

    rings: tuple[tuple[Point, ...], ...]
    kind: str


class Stroke(NamedTuple):
    """An open line."""

    points: tuple[Point, ...]
    kind: str


class Disc(NamedTuple):
    """A circle."""

    centre: Point
    radius: float
    kind: str


class ArcMark(NamedTuple):
    """Part of a circle, from one direction (degrees, counterclockwise as seen) through ``sweep``."""

    centre: Point
    radius: float
    start: float
    sweep: float
    kind: str

    def at(self, degrees: float) -> Point:
        """The point of the circle in a direction, counterclockwise as seen from the start."""
        angle = math.radians(self.start + degrees)
        return (
            self.centre[0] + self.radius * math.cos(angle),
            self.centre[1] - self.radius * math.sin(angle),
        )


class TextRun(NamedTuple):
    """A piece of a text; ``low`` sets it as a subscript."""

    text: str
    low: bool = False


class TextMark(NamedTuple):
    """A text on one line, centred at ``at``; ``size`` is its font size, ``anchor`` start, middle or end."""

    at: Point
    runs: tuple[TextRun, ...]
    kind: str
    size: float
    anchor: str = "middle"


Follows = tuple[tuple[str, str], ...]
"""What goes with what where the mechanism moves: ``turn`` with a link, ``at`` with a point, ``on`` with a
place of a link without turning, ``rail`` with a guide of the frame, ``load``, ``span`` (a spring), ``label``
and ``rope`` with what has that name."""


class MarkGroup(NamedTuple):
    """Marks that belong together, under an id and with a title that a reader can call up.

    ``data`` are further attributes; what the group ``follows`` is told in pictures that move.
    """

    name: str
    kind: str
    marks: tuple[Mark, ...]
    title: str = ""
    data: tuple[tuple[str, str], ...] = ()
    follows: Follows = ()


Mark = AreaMark | Stroke | Disc | ArcMark | TextMark | MarkGroup


def moved(mark: Mark, dx: float, dy: float) -> Mark:
    """A mark in another place."""
    match mark:
        case AreaMark():
            rings = tuple(tuple((x + dx, y + dy) for x, y in ring) for ring in mark.rings)
            return mark._replace(rings=rings)
        case Stroke():
            return mark._replace(points=tuple((x + dx, y + dy) for x, y in mark.points))
        case Disc() | ArcMark():
            return mark._replace(centre=(mark.centre[0] + dx, mark.centre[1] + dy))
        case TextMark():
            return mark._replace(at=(mark.at[0] + dx, mark.at[1] + dy))
        case MarkGroup():
            return mark._replace(marks=tuple(moved(m, dx, dy) for m in mark.marks))


def leaves(marks: Iterable[Mark]) -> Iterator[AreaMark | Stroke | Disc | ArcMark | TextMark]:
    """The marks in all groups, in order."""
    for mark in marks:
        if isinstance(mark, MarkGroup):
            yield from leaves(mark.marks)
        else:
            yield mark


def kinds_of(marks: Iterable[Mark]) -> frozenset[str]:
    """The classes of marks, for each of which a style is needed."""
    return frozenset(name for mark in leaves(marks) for name in mark.kind.split())


def box_of(mark: AreaMark | Stroke | Disc | ArcMark | TextMark) -> Box:
    """The upright rectangle around a mark (that of an arc is its whole circle's)."""
    match mark:
        case Disc() | ArcMark():
            (x, y), r = mark.centre, mark.radius
            return (x - r, y - r, x + r, y + r)
        case TextMark():
            return text_box(mark)
        case AreaMark():
            points: Iterable[Point] = mark.rings[0]
        case Stroke():
            points = mark.points
    xs, ys = zip(*points, strict=True)
    return (min(xs), min(ys), max(xs), max(ys))


def bounds(marks: Iterable[Mark], room: float = 0.0) -> Box:
    """The rectangle around marks and so much room on each side; about the origin where there are none."""
    left, top, right, bottom = around_all([box_of(mark) for mark in leaves(marks)])
    return (left - room, top - room, right + room, bottom + room)


def around_all(boxes: Sequence[Box]) -> Box:
    """The rectangle around rectangles; empty at the origin where there are none."""
    if not boxes:
        return (0.0, 0.0, 0.0, 0.0)
    left, top, right, bottom = zip(*boxes, strict=True)
    return (min(left), min(top), max(right), max(bottom))


LOW = 0.72
"""Size of a subscript, of the text's."""
NARROW = frozenset("iljtfrI.,:;'|!()[]/ -·²°")
WIDE = frozenset("mwMWOQGCDHNU%@—∞")


def text_width(text: str, size: float) -> float:
    """About how wide a sans-serif text is set, never less than the usual fonts need."""
    return size * sum(_advance(c) for c in text)


def _advance(character: str) -> float:
    if character in NARROW:
        return 0.42
    if character in WIDE:
        return 0.95
    if character.isupper() or character in "=+<>~−×":
        return 0.8
    return 0.64 if ord(character) < 0x2E80 else 1.1


def text_box(text: TextMark) -> Box:
    """The rectangle that a text fills: cap height above its middle, subscripts below."""
    width = sum(text_width(run.text, text.size * (LOW if run.low else 1.0)) for run in text.runs)
    left = {"start": 0.0, "middle": -width / 2.0, "end": -width}[text.anchor]
    x, y = text.at
    below = 0.62 if any(run.low for run in text.runs) else 0.52
    return (x + left, y - 0.52 * text.size, x + left + width, y + below * text.size)


def plain_text(runs: Iterable[TextRun]) -> str:
    """The characters of a text."""
    return "".join(run.text for run in runs)


# --- case units to picture units -------------------------------------------------------------------------


WIDTH, HEIGHT = 560.0, 420.0
"""The largest that the mechanism and its near centres are drawn."""
MARGIN = 58.0
"""Room for symbols and loads around what is drawn to scale."""
NEAR = 2.1
"""Centres that make the figure no larger than so many times the mechanism are drawn in place."""


class View(NamedTuple):
    """``scale`` picture units per case unit; ``origin`` is the case point at picture (0, 0); y turns."""

    scale: float
    origin: Point
    window: Box

    def at(self, p: Point) -> Point:
        """A point of the case in the picture."""
        return ((p[0] - self.origin[0]) * self.scale, (self.origin[1] - p[1]) * self.scale)

    def holds(self, p: Point) -> bool:
        """Whether a picture point lies in the window."""
        left, top, right, bottom = self.window
        return left <= p[0] <= right and top <= p[1] <= bottom


def view_of(
    mechanism: Sequence[Box], centres: Iterable[Point], size: float, room: Point = (WIDTH, HEIGHT)
) -> View:
    """The view of a mechanism (rectangles in case units) and of those centres that are not far, in a room."""
    left, low, right, high = around_all(mechanism)
    span = max(right - left, high - low, 0.2 * size) or 1.0
    middle = ((left + right) / 2.0, (low + high) / 2.0)
    for x, y in sorted(centres, key=lambda p: math.dist(p, middle)):
        wider = (min(left, x), min(low, y), max(right, x), max(high, y))
        if max(wider[2] - wider[0], wider[3] - wider[1]) <= NEAR * span:
            left, low, right, high = wider
    width, height = max(right - left, 1e-9 * span), max(high - low, 1e-9 * span)
    scale = min(room[0] / width, room[1] / height, 0.75 * max(room) / (0.4 * span))
    half = (width * scale / 2.0 + MARGIN, height * scale / 2.0 + MARGIN)
    return View(scale, ((left + right) / 2.0, (low + high) / 2.0), (-half[0], -half[1], *half))


def direction(degrees: float) -> Point:
    """Unit vector in the picture (y down) of a direction counterclockwise from +x."""
    angle = math.radians(degrees)
    return (math.cos(angle), -math.sin(angle))


def along(p: Point, u: Point, distance: float) -> Point:
    """The point at a distance from p in the direction u."""
    return (p[0] + u[0] * distance, p[1] + u[1] * distance)


def unit(dx: float, dy: float) -> Point:
    """The vector with length 1; of no length: to the right."""
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size else (1.0, 0.0)


# --- arrows ----------------------------------------------------------------------------------------------


HEAD = 11.0
"""Length of an arrow's head; it is 0.8 times as wide."""


def head(tip: Point, u: Point, kind: str, size: float = HEAD) -> AreaMark:
    """A head that ends at ``tip``, pointing along u."""
    back, v = along(tip, u, -size), (-u[1], u[0])
    return AreaMark(
        ((tip, along(back, v, 0.4 * size), along(tip, u, -0.75 * size), along(back, v, -0.4 * size)),), kind
    )


def arrow(tail: Point, tip: Point, kind: str, size: float = HEAD) -> tuple[Mark, ...]:
    """A straight arrow; its head is no longer than the whole."""
    u = unit(tip[0] - tail[0], tip[1] - tail[1])
    size = min(size, 0.9 * math.dist(tail, tip))
    neck = along(tip, u, -0.7 * size)
    return (Stroke((tail, neck), kind), head(tip, u, f"{kind}-head", size))


def turning(centre: Point, radius: float, start: float, ccw: bool, kind: str) -> tuple[Mark, ...]:
    """An arc with a head, counterclockwise or clockwise as seen, from a direction in degrees."""
    lean = math.degrees(0.75 * HEAD / radius)
    sweep, lean = (250.0, lean) if ccw else (-250.0, -lean)
    arc = ArcMark(centre, radius, start, sweep - lean, kind)
    tip, tail = arc.at(sweep), arc.at(sweep - lean * 1.25)
    return (arc, head(tip, unit(tip[0] - tail[0], tip[1] - tail[1]), f"{kind}-head"))
