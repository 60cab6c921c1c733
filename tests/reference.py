"""An independent witness: the joints' velocity constraints as one dense matrix, and its null space.

Nothing of the solver is used here, only the values of a case. Each joint says in plain words what it
forbids (two coincident points have one velocity; a pin has none across its slot), each sentence is a
row over the twists (X, Y, W) = omega * (x, y, 1) of the moving links, and every motion of the mechanism
is in the null space. A point p of a link that turns about (x, y) moves with omega * (y - py, px - x), which
is (Y - W py, W px - X). `DOUBLE` takes the null space by SVD, `MANY` by elimination in 60 digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from mpmath import mp

from icsolve import case as c

many = mp.clone()
many.dps = 60

Place = tuple[Any, Any]
Twist = tuple[Any, Any, Any]
Points = dict[str, Place]

ZERO_PIVOT = 1e-11
"""Data of 16 digits leave exact coincidences 1e-16 apart; generators keep the rest above 1e-6."""


class Digits(NamedTuple):
    """A kind of number: how a double becomes one, and the functions that geometry needs."""

    num: Callable[[Any], Any]
    turn: Callable[[float], Place]
    sqrt: Callable[[Any], Any]
    null: Callable[[list[list[Any]], int], list[list[Any]]]


class Frame(NamedTuple):
    """The normalised frame: origin at a pin of the case, size a power of two."""

    origin: tuple[float, float]
    size: float

    def place(self, point: Sequence[Any], num: Callable[[Any], Any]) -> Place:
        """A point of the case in this frame."""
        x, y = ((num(a) - num(o)) / num(self.size) for a, o in zip(point, self.origin, strict=True))
        return x, y


class Motions(NamedTuple):
    """All motions of a mechanism: a basis, each a twist per link (the frame's is zero)."""

    case: c.Case
    points: Points
    frame: Frame
    digits: Digits
    basis: list[dict[str, Twist]]

    def velocity(self, motion: int, point: str, link: str) -> Place:
        """Of a point on a link, in units of the frame's size a second."""
        x, y, w = self.basis[motion][link]
        px, py = self.frame.place(self.points[point], self.digits.num)
        return y - w * py, w * px - x


# --- geometry of a case ----------------------------------------------------------------------------


def points_of(case: c.Case) -> Points:
    """Points of a case that gives coordinates (or centroids of such) for all."""
    known = {
        name: (p.x.value, p.y.value)
        for name, p in case.points.items()
        if isinstance(p, c.Coordinates) and p.x is not None and p.y is not None
    }
    for name, p in case.points.items():
        if isinstance(p, c.Centroid):
            x, y = (math.fsum(known[q][k] for q in p.of) / len(p.of) for k in (0, 1))
            known[name] = x, y
    return known


def frame_of(case: c.Case, points: Points) -> Frame:
    """Origin at the first joint's point; size the next power of two above the mechanism's extent."""
    names = (getattr(joint, "at", None) for joint in case.joints)
    used = [points[name] for name in names if name is not None]
    origin = (float(used[0][0]), float(used[0][1]))
    extent = max(max(abs(float(p[k]) - origin[k]) for k in (0, 1)) for p in used)
    return Frame(origin, 2.0 ** math.frexp(extent or 1.0)[1])


def along(guide: c.Guide, points: Points, digits: Digits) -> Place:
    """Unit vector along a guide."""
    if guide.angle is not None:
        return digits.turn(guide.angle.value)
    assert guide.ends is not None
    return unit(points[guide.ends[0]], points[guide.ends[1]], digits)


def unit(a: Place, b: Place, digits: Digits) -> Place:
    """Unit vector from a to b."""
    dx, dy = (digits.num(b[k]) - digits.num(a[k]) for k in (0, 1))
    length = digits.sqrt(dx * dx + dy * dy)
    return dx / length, dy / length


# --- what each joint forbids -----------------------------------------------------------------------

Row = dict[str, Twist]
"""One linear condition: a coefficient triple for each link's twist."""


def same_speed(i: str, j: str, p: Place, u: Place) -> Row:
    """The point p has the same velocity component along u on both links."""
    x, y, w = -u[1], u[0], u[1] * p[0] - u[0] * p[1]
    return {i: (x, y, w), j: (-x, -y, -w)}


def same_spin(i: str, j: str) -> Row:
    """Two links turn equally fast."""
    return {i: (0, 0, 1), j: (0, 0, -1)}


def one_point(i: str, j: str, p: Place) -> list[Row]:
    """The point p has one velocity on both links."""
    return [same_speed(i, j, p, (1, 0)), same_speed(i, j, p, (0, 1))]


def train(i: str, j: str, carrier: str, a: Any, b: Any) -> Row:
    """Relative to the carrier, a * spin of i + b * spin of j = 0."""
    row = {i: (0, 0, a), j: (0, 0, b)}
    row[carrier] = (0, 0, -(a + b))
    return row


def coaxial(case: c.Case) -> list[tuple[str, set[str]]]:
    """The pins, with the links they hold: pins of one named point that share a link are one pin."""
    groups: list[tuple[str, set[str]]] = []
    for joint in (j for j in case.joints if isinstance(j, c.Pin)):
        held = set(joint.links)
        near = [g for g in groups if g[0] == joint.at and g[1] & held]
        for g in near:
            held |= g[1]
            groups.remove(g)
        groups.append((joint.at, held))
    return groups


def carriers(case: c.Case, joint: c.Gears | c.Belt) -> list[tuple[str, str, str]]:
    """Links that could carry two wheels, and the points at which they bear the first and the second."""
    pins = coaxial(case)

    def bearing(wheel: str, carrier: str) -> str | None:
        return next((at for at, held in pins if {wheel, carrier} <= held), None)

    others = [joint.carrier] if joint.carrier else [n for n in case.links if n not in joint.links]
    found = [(n, bearing(joint.links[0], n), bearing(joint.links[1], n)) for n in others]
    return [(n, a, b) for n, a, b in found if a is not None and b is not None]


def pivots(case: c.Case, joint: c.Gears | c.Belt) -> tuple[str, str, str]:
    """The carrier of two wheels, and the points at which it bears the first and the second."""
    (found,) = carriers(case, joint)
    return found


def forbidden(case: c.Case, joint: c.Joint, points: Points, frame: Frame, digits: Digits) -> list[Row]:
    """What a joint forbids, as rows."""
    i, j = joint.links[0], joint.links[1]
    if isinstance(joint, c.Gears | c.Belt):
        return [_train(case, joint, digits)]
    at = getattr(joint, "at", None)
    p = frame.place(points[at], digits.num) if at is not None else (0, 0)
    if isinstance(joint, c.Pin):
        return [row for other in joint.links[1:] for row in one_point(i, other, p)]
    if isinstance(joint, c.Weld):
        return [*one_point(i, j, p), same_spin(i, j)]
    if isinstance(joint, c.Roll):
        return one_point(i, j, p)
    if isinstance(joint, c.Contact):
        return [same_speed(i, j, p, digits.turn(joint.normal.value))]
    if isinstance(joint, c.KnownCentre):
        if joint.toward is None:
            return one_point(i, j, p)
        return [same_spin(i, j), same_speed(i, j, (0, 0), digits.turn(joint.toward.value))]
    u = along(joint.guide, points, digits)
    across = same_speed(i, j, p, (-u[1], u[0]))
    return [across, same_spin(i, j)] if isinstance(joint, c.Slide) else [across]


def _train(case: c.Case, joint: c.Gears | c.Belt, digits: Digits) -> Row:
    """Equal arcs on both wheels, seen from the carrier."""
    carrier = pivots(case, joint)[0]
    if isinstance(joint, c.Gears):
        return train(*joint.links, carrier, *(digits.num(t.value) for t in joint.teeth))
    a, b = (digits.num(r.value) for r in joint.radii)
    return train(*joint.links, carrier, a / (a + b), (b if joint.crossed else -b) / (a + b))


def matrix(case: c.Case, points: Points, frame: Frame, digits: Digits) -> tuple[list[str], list[list[Any]]]:
    """The moving links, and the rows over their twists (three columns a link), each of unit length."""
    moving = [n for n in case.links if n != case.ground]
    column = {n: 3 * k for k, n in enumerate(moving)}
    rows = []
    for joint in case.joints:
        for condition in forbidden(case, joint, points, frame, digits):
            row = [digits.num(0)] * (3 * len(moving))
            for link, entries in condition.items():
                for k, entry in enumerate(entries if link in column else ()):
                    row[column[link] + k] += entry
            length = digits.sqrt(sum(a * a for a in row))
            rows.append([a / (length or 1) for a in row])
    return moving, rows


# --- null space ------------------------------------------------------------------------------------


def null_by_svd(rows: list[list[Any]], columns: int) -> list[list[Any]]:
    """Right singular vectors of the singular values below 1e-11 of the largest."""
    full = np.zeros((max(len(rows), columns), columns))
    full[: len(rows)] = rows
    _, s, vt = np.linalg.svd(full)
    return [list(v) for v in vt[int(np.sum(s > ZERO_PIVOT * s[0])) :]]


def null_by_elimination(rows: list[list[Any]], columns: int) -> list[list[Any]]:
    """Gauss-Jordan with complete pivoting in many digits; doubles tell which pivot is the largest."""
    a = np.array(rows, dtype=object).reshape(len(rows), columns)
    order: list[int] = []
    for k in range(min(a.shape)):
        sizes = np.abs(a[k:].astype(float))
        sizes[:, order] = 0.0
        i, j = np.unravel_index(int(np.argmax(sizes)), sizes.shape)
        if sizes[i, j] < ZERO_PIVOT:
            break
        a[[k, k + i]] = a[[k + i, k]]
        order.append(int(j))
        a[k] = a[k] / a[k, j]
        filled = np.flatnonzero(a[k])
        for n in np.flatnonzero(a[:, j]):
            if n != k:
                a[n, filled] = a[n, filled] - a[n, j] * a[k, filled]
    return [_solution(a, order, j) for j in range(columns) if j not in order]


def _solution(a: Any, order: list[int], free: int) -> list[Any]:
    """The null vector whose only free entry is 1."""
    v = [many.mpf(0)] * a.shape[1]
    v[free] = many.mpf(1)
    for k, j in enumerate(order):
        v[j] = -a[k, free]
    return v


def _turn_double(degrees: float) -> Place:
    quarter = round(degrees / 90)
    s, co = math.sin(math.radians(degrees - 90 * quarter)), math.cos(math.radians(degrees - 90 * quarter))
    return ((co, s), (-s, co), (-co, -s), (s, -co))[quarter % 4]


def _turn_many(degrees: float) -> Place:
    angle = many.mpf(degrees) * many.pi / 180
    return many.cos(angle), many.sin(angle)


DOUBLE = Digits(float, _turn_double, math.sqrt, null_by_svd)
MANY = Digits(many.mpf, _turn_many, many.sqrt, null_by_elimination)


def motions(case: c.Case, points: Points | None = None, digits: Digits = DOUBLE) -> Motions:
    """All motions that the joints leave, by rank."""
    points = points_of(case) if points is None else points
    frame = frame_of(case, points)
    moving, rows = matrix(case, points, frame, digits)
    zero = (digits.num(0),) * 3
    basis = [
        {case.ground: zero} | {n: (v[3 * k], v[3 * k + 1], v[3 * k + 2]) for k, n in enumerate(moving)}
        for v in digits.null(rows, 3 * len(moving))
    ]
    return Motions(case, points, frame, digits, basis)


def clearance(case: c.Case, points: Points | None = None) -> float:
    """Smallest singular value that is not zero, over the largest: how far from another mobility."""
    points = points_of(case) if points is None else points
    s = np.linalg.svd(np.array(matrix(case, points, frame_of(case, points), DOUBLE)[1]), compute_uv=False)
    return float(min(s[s > ZERO_PIVOT * s[0]]) / s[0])
