"""What a case says of its figure, as data that bear on points.

A `Datum` refers into its case (by kind and index), so a construction that is made of data can be
run again on another case of the same shape.
"""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import Case, Centroid, Coordinates, Corner, Guide, Number, Rope
from icsolve.case.joints import Guided
from icsolve.tuples import NamedTuple

X, Y, MEAN, GUIDE, LINE, LENGTH, RAY, CORNER = "x", "y", "mean", "guide", "line", "length", "ray", "corner"
ROPE = "rope"


class Datum(NamedTuple):
    """One condition on points.

    ``kind`` and ``points``: ``x`` and ``y`` (p) a coordinate of a point whose other one is
    unknown; ``mean`` (p, of...) a centroid; ``guide`` (at, through) a guide line by its angle;
    ``line`` (at, through, e1, e2) a guide line by two points; ``length`` (a, b); ``ray`` (a, b)
    a direction; ``corner`` (a, at, b); ``rope`` (a, p, ..., b) one that is as long as given.
    ``ref`` is its place in the case.
    """

    kind: str
    ref: int | str
    points: tuple[str, ...]


def number_of(case: Case, datum: Datum) -> Number:
    """The number that the case writes for a datum (not for ``mean`` and ``line``, which have none)."""
    kind, ref = datum.kind, datum.ref
    if kind == LENGTH:
        return case.lengths[ref].value  # type: ignore[index]
    if kind in (RAY, CORNER):
        return case.angles[ref].value  # type: ignore[index]
    if kind == ROPE:
        return case.ropes[ref].length  # type: ignore[index, return-value]
    if kind == GUIDE:
        return case.joints[ref].guide.angle  # type: ignore[index, union-attr, return-value]
    place = case.points[ref]  # type: ignore[index]
    return place.x if kind == X else place.y  # type: ignore[union-attr, return-value]


def given_points(case: Case) -> list[str]:
    """The points that both coordinates are given of."""
    return [
        name
        for name, place in case.points.items()
        if type(place) is Coordinates and place.x is not None and place.y is not None
    ]


def data_of(case: Case) -> Iterator[Datum]:
    """Every datum but the full coordinates: those of greatest authority first."""
    for name, place in case.points.items():
        if type(place) is Centroid:
            yield Datum(MEAN, name, (name, *place.of))
        elif type(place) is Coordinates and (place.x is None) != (place.y is None):
            yield Datum(Y if place.x is None else X, name, (name,))
    for i, joint in enumerate(case.joints):
        if isinstance(joint, Guided):
            yield from _guide(i, joint.at, joint.guide)
    for i, length in enumerate(case.lengths):
        yield Datum(LENGTH, i, (length.a, length.b))
    for i, angle in enumerate(case.angles):
        if type(angle) is Corner:
            yield Datum(CORNER, i, (angle.a, angle.at, angle.b))
        else:
            yield Datum(RAY, i, (angle.a, angle.b))
    for i, rope in enumerate(case.ropes):
        if rope.length is not None and not rope.is_free:
            yield Datum(ROPE, i, rope.points)


def _guide(index: int, at: str, guide: Guide) -> Iterator[Datum]:
    """The guide's condition on its points; none where its line goes through the point by definition."""
    if guide.ends is None:
        if guide.through is not None and guide.through != at:
            yield Datum(GUIDE, index, (at, guide.through))
        return
    first, second = guide.ends
    through = first if guide.through is None else guide.through
    if through != at and not (at in guide.ends and through in guide.ends):
        yield Datum(LINE, index, (at, through, first, second))


def names_of(case: Case) -> list[str]:
    """Every point that the case names, in order of first mention in the figure, joints and links."""
    names = dict.fromkeys(case.points)
    for datum in data_of(case):
        names.update(dict.fromkeys(datum.points))
    for joint in case.joints:
        names.update(dict.fromkeys(joint.named))
    for carried in case.carries.values():
        names.update(dict.fromkeys(carried))
    return list(names)


class Facts(NamedTuple):
    """The data of a figure, looked up by point.

    ``of`` has the data that bear on each point. ``arms`` has for each arm (vertex, point) of a
    corner the corners that turn it into another arm: (corner, the other arm's point, +1 or -1).
    ``flat`` has the corners of a multiple of 180 degrees.
    """

    data: tuple[Datum, ...]
    of: dict[str, list[Datum]]
    arms: dict[tuple[str, str], list[tuple[Datum, str, int]]]
    flat: frozenset[Datum]
    ropes: tuple[Rope, ...]


def facts_of(case: Case, only: tuple[Datum, ...] | None = None) -> Facts:
    """Look-up tables over the data of a case, or over some of them."""
    data = tuple(data_of(case)) if only is None else only
    of: dict[str, list[Datum]] = {}
    arms: dict[tuple[str, str], list[tuple[Datum, str, int]]] = {}
    for datum in data:
        for point in dict.fromkeys(datum.points):
            of.setdefault(point, []).append(datum)
        if datum.kind == CORNER:
            a, at, b = datum.points
            arms.setdefault((at, a), []).append((datum, b, 1))
            arms.setdefault((at, b), []).append((datum, a, -1))
    flat = frozenset(d for d in data if d.kind == CORNER and number_of(case, d).value % 180.0 == 0.0)
    return Facts(data, of, arms, flat, case.ropes)
