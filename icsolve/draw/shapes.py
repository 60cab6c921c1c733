"""Outlines by shapely: bars, plates, hatching, and lines clipped to a window."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import shapely

from icsolve.draw.marks import Area, Box, Point, Stroke
from icsolve.draw.view import along, unit

ROUND = 5
"""Segments of a quarter circle of an outline."""


def bar(points: Sequence[Point], half: float) -> shapely.Geometry:
    """A line made a bar with round ends; of one point, a disc."""
    line = shapely.Point(points[0]) if len(points) == 1 else shapely.LineString(points)
    return shapely.buffer(line, half, quad_segs=ROUND)


def plate(points: Sequence[Point], half: float) -> shapely.Geometry:
    """The hull of points with a rim; of points in line, a bar."""
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    return shapely.buffer(hull, half, quad_segs=ROUND)


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


def nearest(shape: shapely.Geometry, p: Point) -> Point:
    """The point of a shape that is nearest to p."""
    line = shapely.shortest_line(shape, shapely.Point(p))
    x, y = line.coords[0]
    return (x, y)


def area(shape: shapely.Geometry, kind: str) -> Area:
    """A shape with all its rings (of several parts too)."""
    parts = getattr(shape, "geoms", (shape,))
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    return Area(tuple(tuple(map(tuple, ring.coords[:-1])) for ring in rings), kind)


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
