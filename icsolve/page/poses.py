"""Where every link is in the rows of a page's sweep: by its points, its guide or its rate; and the free ends
of ropes. Columns of numbers as they stand in a page."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from contextlib import suppress
from typing import Any

import numpy as np

from icsolve.case import Rope
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS
from icsolve.report.derivation.known import Known
from icsolve.screws import Point
from icsolve.screws.ropes import rope_length, rope_parts
from icsolve.structure import topology, welded
from icsolve.structure.torn_points import CarriedPoints
from icsolve.sweep import Sweep
from icsolve.tuples import NamedTuple

Array = np.ndarray

FINE = {"px": 10, "deg": 100, "told": 100_000, "far": 1e-5}
"""Steps a picture unit, or a degree: a tenth of a unit, a hundredth of a degree; of a point whose place is
read as a number, far finer; of a direction to infinity, whose numbers are large."""
FAR = 1e5
"""Numbers beyond this are written plainly, to five significant digits."""
DIGITS = 12
"""Significant digits of an answer: those that anyone is shown, and more."""


def compact(values: Array, fine: float) -> dict[str, Any]:
    """A column in steps of 1 / ``fine``, as differences of differences, which are small where a motion is
    smooth; ``n`` are the rows in which it is not a number."""
    known = np.isfinite(values)
    if known.any() and float(np.abs(values[known]).max()) * min(fine, 1.0) < FAR:
        rows = np.arange(len(values))
        whole = np.rint(np.interp(rows, rows[known], values[known]) * fine).astype(np.int64)
        none = {} if known.all() else {"n": np.flatnonzero(~known).tolist()}
        return {"s": fine, "d": np.diff(whole, 2, prepend=(0, 0)).tolist(), **none}
    return {"v": [_rounded(v, 5) for v in values.tolist()]}


def exact(values: Iterable[float], digits: int = DIGITS) -> dict[str, Any]:
    """A column of numbers that are read: all digits that are shown."""
    return {"v": [_rounded(v, digits) for v in values]}


def _rounded(value: float, digits: int) -> float | int | None:
    if not math.isfinite(value):
        return None
    value = float(format(value, f".{digits}g")) + 0.0
    return int(value) if value == int(value) and abs(value) < 1e15 else value


def moves(values: Array, fine: float) -> bool:
    """Whether a column changes as the picture shows it."""
    return bool(np.ptp(values) * fine > 0.5) if np.isfinite(values).all() else True


_UNSAFE = str.maketrans(
    {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}
)


def script_json(value: object) -> str:
    """JSON that can stand in a script element whatever its texts say."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.translate(_UNSAFE).encode("utf-8", "replace").decode("utf-8")


# --- the poses -----------------------------------------------------------------------------------------


class PagePose(NamedTuple):
    """Where a link is in every row: the place of one of its points, and its angle from the position as
    written, degrees counterclockwise."""

    point: str
    x: Array
    y: Array
    angle: Array


class PageRows(NamedTuple):
    """What a link's pose is found from: the input, its degrees, the row as written, the sweep, the poses so
    far, and which points go with which link."""

    known: Known
    driver: str
    degrees: Array
    zero: int
    found: Sweep
    poses: dict[str, PagePose]
    points: CarriedPoints

    def carried(self, link: str) -> list[str]:
        """The points of a link that the sweep has and that go with it."""
        names = self.known.case.carries.get(link, ())
        return [p for p in names if p in self.found.points and self.points.go_with(link, p)]


def poses_of(known: Known, driver: str, degrees: Array, zero: int, found: Sweep) -> dict[str, PagePose]:
    """The pose of every link that carries a point, and of the free ends of ropes."""
    case = known.case
    rows = PageRows(known, driver, degrees, zero, found, {}, CarriedPoints(case, topology(case)))
    waiting = [link for link in case.links if link != case.ground and rows.carried(link)]
    for attempt in (_by_points, _by_guide, _by_rate):
        for link in list(waiting):
            pose = attempt(rows, link)
            if pose is not None:
                rows.poses[link] = pose
                waiting.remove(link)
    for rope in case.ropes:
        if rope.is_free and {*rope.points} <= found.points.keys():
            rows.poses[rope.end] = _free_end(rows, rope)
    return rows.poses


def _by_points(rows: PageRows, link: str) -> PagePose | None:
    """By two points of the link that lie apart."""
    names, at = rows.carried(link), rows.known.points
    a, b = max(((p, q) for p in names for q in names), key=lambda two: math.dist(at[two[0]], at[two[1]]))
    if math.dist(at[a], at[b]) <= 1e-9 * rows.known.size:
        return None
    p, q = rows.found.points[a], rows.found.points[b]
    angle = np.degrees(np.arctan2(q[:, 1] - p[:, 1], q[:, 0] - p[:, 0]))
    turned = angle - angle[rows.zero]
    return PagePose(a, p[:, 0], p[:, 1], np.asarray((turned + 180.0) % 360.0 - 180.0))


def _by_guide(rows: PageRows, link: str) -> PagePose | None:
    """As the link turns on which it slides."""
    name = rows.carried(link)[0]
    for joint in rows.known.case.joints:
        if joint.guide is not None and joint.keeps_direction and link in joint.links:
            other = joint.links[1 - joint.links.index(link)]
            x, y = rows.found.points[name].T
            if other in welded(rows.known.case, rows.known.case.ground):
                return PagePose(name, x, y, np.zeros(len(rows.degrees)))
            if other in rows.poses:
                return PagePose(name, x, y, rows.poses[other].angle)
    return None


def _by_rate(rows: PageRows, link: str) -> PagePose:
    """By its rate beside the driver's, summed from row to row (a gear of which nothing else shows)."""
    name, rates = rows.carried(link)[0], rows.found.rates
    ratio = np.zeros(len(rows.degrees))
    if link in rates and rows.driver in rates:
        with np.errstate(all="ignore"):
            ratio = np.nan_to_num(rates[link] / rates[rows.driver], posinf=0.0, neginf=0.0)
    steps = 0.5 * (ratio[1:] + ratio[:-1]) * np.diff(rows.degrees)
    total = np.concatenate(([0.0], np.cumsum(steps)))
    x, y = rows.found.points[name].T
    return PagePose(name, x, y, total - total[rows.zero])


def _free_end(rows: PageRows, rope: Rope) -> PagePose:
    """A free end goes along the direction of its last part, by what the rest of the rope has become longer or
    shorter, and by what the drum at its beginning has let go; it has no place beyond its last pulley."""
    *_, last, end = rope.points
    at, places, count = rows.known.points, rows.found.points, len(rows.degrees)
    parts = rope_parts(rope, at, 1.0, FLOATS)
    carried = places[last] + np.subtract(at[end], at[last])
    lengths, turns = np.full(count, np.nan), np.full(count, np.nan)
    for n in range(count):
        here: dict[str, Point] = {p: tuple(places[p][n].tolist()) for p in rope.points}
        here[end] = tuple(carried[n].tolist())
        if np.isfinite(list(here.values())).all():
            with suppress(SceneError):
                x, y = rope_parts(rope, here, 1.0, FLOATS)[0].along
                turns[n] = math.atan2(y, x)
                lengths[n] = float(rope_length(rope, here, 1.0, FLOATS))
    drum = rows.poses.get(rope.links[0])
    turned = np.zeros(count) if drum is None else followed(np.radians(drum.angle))
    lengths -= float(parts[0].offset) * (turned - followed(turns))
    gone = lengths[rows.zero] - lengths
    gone[gone <= -float(parts[-1].length)] = np.nan  # the end would run through its pulley
    x, y = (carried + np.outer(gone, parts[-1].along)).T
    return PagePose(end, x, y, np.zeros(count))


def followed(angles: Array) -> Array:
    """Angles [rad] without the jumps of a turn from row to row; of rows that have none those beside them."""
    found, there = np.array(angles), np.isfinite(angles)
    found[there] = np.unwrap(angles[there])
    return found


def moved(pose: PagePose, start: tuple[float, float], p: tuple[float, float]) -> tuple[Array, Array]:
    """Where a point of a link is in every row; ``start`` is the place of the pose's point as written."""
    turn = np.radians(pose.angle)
    dx, dy = p[0] - start[0], p[1] - start[1]
    co, si = np.cos(turn), np.sin(turn)
    return pose.x + co * dx - si * dy, pose.y + si * dx + co * dy
