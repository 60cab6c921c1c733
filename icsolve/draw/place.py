"""Outlines by shapely (bars, plates, hatching), and labels where they can be read: beside what they name, on
no other label and on no joint.

Each label has candidate places around its anchors. One that touches another label or a joint is out;
of the rest the one that covers least of links, lines and arrows wins, near before far. Where all
the near ones are taken it goes farther out, with a thin leader back.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from icsolve.draw.marks import LOW as LOW_SIZE
from icsolve.draw.marks import (
    AreaMark,
    Box,
    Disc,
    Follows,
    Mark,
    MarkGroup,
    Point,
    Stroke,
    TextMark,
    TextRun,
    along,
    text_width,
    unit,
)
from icsolve.tuples import NamedTuple

# --- outlines by shapely -----------------------------------------------------------------------------------

QUARTER = 5
"""Segments of a quarter circle of an outline."""
SLIT = 1.0
"""Half the width of the narrowest hole that is drawn."""


def bar(points: Sequence[Point], half: float) -> shapely.Geometry:
    """A line made a bar with round ends; of one point, a disc."""
    line = shapely.Point(points[0]) if len(points) == 1 else shapely.LineString(points)
    return shapely.buffer(line, half, quad_segs=QUARTER)


def plate(points: Sequence[Point], half: float) -> shapely.Geometry:
    """The hull of points with a rim; of points in line, a bar."""
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    return shapely.buffer(hull, half, quad_segs=QUARTER)


def tilted(centre: Point, u: Point, length: float, height: float) -> shapely.Geometry:
    """A rectangle whose length lies along u."""
    v = (-u[1], u[0])
    corners = [
        along(along(centre, u, a * length / 2.0), v, b * height / 2.0)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    return shapely.Polygon(corners)


def joined(shapes: Iterable[shapely.Geometry]) -> shapely.Geometry:
    """The union of shapes."""
    return shapely.union_all(list(shapes))


def without_slits(shape: shapely.Geometry) -> shapely.Geometry:
    """A shape without holes so narrow that the lines about them would meet."""
    if shape.geom_type != "Polygon" or not shape.interiors:
        return shape
    holes = [ring for ring in shape.interiors if not shapely.Polygon(ring).buffer(-SLIT).is_empty]
    return shapely.Polygon(shape.exterior, holes)


def nearest(shape: shapely.Geometry, p: Point) -> Point:
    """The point of a shape that is nearest to p."""
    line = shapely.shortest_line(shape, shapely.Point(p))
    x, y = line.coords[0]
    return (x, y)


def area(shape: shapely.Geometry, kind: str) -> AreaMark:
    """A shape with all its rings (of several parts too)."""
    parts = getattr(shape, "geoms", (shape,))
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    return AreaMark(tuple(tuple(map(tuple, ring.coords[:-1])) for ring in rings), kind)


def clipped(points: Sequence[Point], window: Box) -> tuple[tuple[Point, ...], ...]:
    """The parts of a line that lie in a window."""
    cut = shapely.intersection(shapely.LineString(points), shapely.box(*window))
    parts = getattr(cut, "geoms", (cut,))
    return tuple(
        tuple((x, y) for x, y in part.coords)
        for part in parts
        if part.geom_type == "LineString" and not part.is_empty
    )


def hatched(a: Point, b: Point, side: float, depth: float = 7.0, pitch: float = 6.0) -> list[Stroke]:
    """A line from a to b with hatching on one side: ``side`` 1 is to the right of a to b as seen."""
    u = unit(b[0] - a[0], b[1] - a[1])
    v = (-u[1] * side, u[0] * side)
    length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
    count = max(int(length / pitch), 1)
    step = length / count
    marks = [Stroke((a, b), "frame")]
    for k in range(count):
        start = along(a, u, (k + 0.75) * step)
        marks.append(Stroke((start, along(along(start, v, depth), u, -0.75 * step)), "hatch"))
    return marks


# --- labels ------------------------------------------------------------------------------------------------

RINGS = (
    *((0.0, 4.0, 9.0), (15.0, 22.0, 30.0), (40.0, 54.0, 70.0), (90.0, 115.0, 145.0)),
    *((200.0 * 1.6**k, 250.0 * 1.6**k) for k in range(24)),
)
"""Distances from the anchor's rim that are tried together; the last are far outside any picture."""
ROUND = [(math.cos(math.pi * k / 8.0), -math.sin(math.pi * k / 8.0)) for k in range(16)]
SQUARE = [(x / max(abs(x), abs(y)), y / max(abs(x), abs(y))) for n, (x, y) in enumerate(ROUND) if n % 4]
COMPASS = np.array(ROUND + SQUARE)
"""Directions from an anchor: on an oval around it, and the corners and sides of a rectangle."""
PREFERENCE = np.array(
    [0.0 if k in (2, 6, 14, 10) else 0.6 if k % 4 == 0 else 1.0 for k in range(16)] + [1.2] * len(SQUARE)
)
CLEAR = 1.5
"""Room around each label."""
GOOD = 14.0
"""A place of this cost is taken without looking farther."""
ASIDE = 40.0
"""What it costs a label that may stand on its anchors not to."""
CHUNK = 8
"""Candidates that are measured together."""
LEADER = 20.0
"""From this distance on a leader shows what a label names."""


class Label(NamedTuple):
    """A text to be placed.

    ``anchors`` are points that it may stand beside, best first, ``gap`` the distance kept from them;
    ``badge`` puts it in a circle (a link's number), ``on`` lets it stand on its anchors too. ``name`` is
    the id of its group. One that ``follows`` nothing is true of the position as written alone.
    """

    name: str
    runs: tuple[TextRun, ...]
    kind: str
    size: float
    anchors: tuple[Point, ...]
    gap: float
    badge: bool = False
    on: bool = False
    follows: Follows = ()


class Soft(NamedTuple):
    """Something that a label had better not cover, and how much covering a unit of it costs."""

    geometry: shapely.Geometry
    weight: float


class Placer:
    """Places labels one after another; ``solid`` rectangles are out of bounds for all of them."""

    def __init__(self, solid: Sequence[Box], soft: Sequence[Soft], window: Box) -> None:
        self.solid = [tuple(box) for box in solid]
        self.geometries = np.array([s.geometry for s in soft], dtype=object)
        self.weights = np.array([s.weight for s in soft])
        self.tree = shapely.STRtree(self.geometries) if soft else None
        self.window = window

    def put(self, label: Label) -> MarkGroup:
        """The label at its place; what is placed later keeps off it."""
        width, height = label_size(label)
        spot = self._best(label, width, height)
        x, y, anchor = spot
        half = (width / 2.0, height / 2.0)
        self.solid.append((x - half[0], y - half[1], x + half[0], y + half[1]))
        return MarkGroup(label.name, "", tuple(_marks(label, (x, y), anchor, half)))

    def _best(self, label: Label, width: float, height: float) -> tuple[float, float, Point]:
        """The cheapest place: candidates by what their place costs, until no later one can be cheaper."""
        best: tuple[float, float, float, Point] | None = None
        for ring in RINGS:
            spots, costs, anchors = _candidates(label, ring, width, height)
            half = np.array((width / 2.0, height / 2.0))
            boxes = np.hstack((spots - half, spots + half))
            costs = costs + self._outside(boxes)
            costs[self._taken(boxes)] = math.inf
            order = np.argsort(costs, kind="stable")
            for first in range(0, len(order), CHUNK):
                some = order[first : first + CHUNK]
                if costs[some[0]] >= (math.inf if best is None else best[0]):
                    break
                full = costs[some] + self._covered(boxes[some])
                n = int(np.argmin(full))
                if full[n] < (math.inf if best is None else best[0]):
                    k = some[n]
                    best = (float(full[n]), float(spots[k][0]), float(spots[k][1]), label.anchors[anchors[k]])
            if best is not None and (best[0] <= GOOD or ring[0] >= 40.0):
                return best[1:]
        raise AssertionError("the plane has room for every label")

    def _taken(self, boxes: np.ndarray) -> np.ndarray:
        """Which boxes touch a label or a joint."""
        if not self.solid:
            return np.zeros(len(boxes), dtype=bool)
        solid = np.array(self.solid)
        left, top, right, bottom = (boxes[:, k, None] for k in range(4))
        apart = (
            (left - CLEAR >= solid[:, 2])
            | (right + CLEAR <= solid[:, 0])
            | (top - CLEAR >= solid[:, 3])
            | (bottom + CLEAR <= solid[:, 1])
        )
        return np.asarray(~apart.all(axis=1))

    def _covered(self, boxes: np.ndarray) -> np.ndarray:
        """What the boxes would cover, by its weight."""
        costs = np.zeros(len(boxes))
        if self.tree is None:
            return costs
        ours, theirs = self.tree.query(shapely.box(*boxes.T))
        for n in dict.fromkeys(ours.tolist()):
            under = theirs[ours == n]
            cuts = _cut(self.geometries[under], boxes[n])
            areas, lengths = shapely.area(cuts), shapely.length(cuts)
            costs[n] = np.sum(self.weights[under] * np.where(areas > 0.0, areas / 8.0, lengths))
        return costs

    def _outside(self, boxes: np.ndarray) -> np.ndarray:
        """How far boxes reach out of the window."""
        left, top, right, bottom = self.window
        over = np.maximum(0.0, left - boxes[:, 0]) + np.maximum(0.0, boxes[:, 2] - right)
        return 0.12 * (over + np.maximum(0.0, top - boxes[:, 1]) + np.maximum(0.0, boxes[:, 3] - bottom))


def _cut(geometries: np.ndarray, box: np.ndarray) -> np.ndarray:
    """What of geometries lies in a rectangle."""
    try:
        return np.asarray(shapely.clip_by_rect(geometries, *box))
    except shapely.errors.GEOSException:  # it makes rings of three points where a box cuts off a corner's tip
        return np.asarray(shapely.intersection(geometries, shapely.box(*box)))


def _candidates(
    label: Label, ring: tuple[float, ...], width: float, height: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Centres of the boxes to try, what their distance and direction cost, and their anchors."""
    anchors = np.array(label.anchors)
    reach = label.gap + np.array(ring)
    across = COMPASS[:, 0] * (reach[:, None] + width / 2.0)
    down = COMPASS[:, 1] * (reach[:, None] + height / 2.0)
    costs = 0.8 * np.array(ring)[:, None] + PREFERENCE
    if label.on:
        costs += ASIDE
        if ring[0] == 0.0:
            across[0, 0] = down[0, 0] = costs[0, 0] = 0.0
    spots = anchors[:, None, None, :] + np.stack((across, down), axis=-1)
    costs = 1.5 * np.arange(len(anchors))[:, None, None] + costs
    which = np.repeat(np.arange(len(anchors)), len(ring) * len(COMPASS))
    return spots.reshape(-1, 2), costs.ravel(), which


def label_size(label: Label) -> tuple[float, float]:
    """Width and height of a label."""
    width = sum(text_width(run.text, label.size * (LOW_SIZE if run.low else 1.0)) for run in label.runs)
    height = 1.15 * label.size
    if label.badge:
        height = 1.6 * label.size
        return max(width + 0.55 * label.size, height), height
    return width, height


def _marks(label: Label, at: Point, anchor: Point, half: Point) -> list[Mark]:
    marks: list[Mark] = []
    nearest = (
        min(max(anchor[0], at[0] - half[0]), at[0] + half[0]),
        min(max(anchor[1], at[1] - half[1]), at[1] + half[1]),
    )
    if not label.on and math.dist(nearest, anchor) > label.gap + LEADER:
        marks.append(Stroke((anchor, nearest), "leader"))
    if label.badge:
        marks.append(_badge(at, half))
    marks.append(TextMark(at, label.runs, label.kind, label.size))
    return marks


def _badge(at: Point, half: Point) -> Mark:
    """A circle around a number; around a word an oblong."""
    if half[0] <= half[1] * 1.01:
        return Disc(at, half[1], "badge")
    reach = half[0] - half[1]
    return area(bar([(at[0] - reach, at[1]), (at[0] + reach, at[1])], half[1]), "badge")
