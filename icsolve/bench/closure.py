"""Kennedy's construction as a textbook has it: the first two lines that are found, by either algebra."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain, combinations, islice
from typing import Any, Protocol

from icsolve.bench.rivals import Drawn, Failed, Posed, balanced, posed
from icsolve.screws.plane import Triple, cross, pairing, times

Pair = tuple[int, int]


class Algebra(Protocol):
    """How points and lines are written."""

    def point(self, triple: Triple) -> Any:
        """A joint's centre."""

    def join(self, p: Any, q: Any) -> Any:
        """The line through two points."""

    def meet(self, a: Any, b: Any) -> Any:
        """The point where two lines meet."""

    def line(self, a: Triple, b: Triple) -> Any:
        """The common normal of a slot, a contact or a mesh, by two of its points."""

    def twists(self, centres: dict[Pair, Any], bodies: int, ground: int) -> list[Triple]:
        """Twists to one scale from the centres."""


def closed(scene: Drawn, algebra: Algebra, normalised: bool) -> float:
    """The unknown load by centres, each by the first two lines that pass through it."""
    pose = posed(scene, normalised)
    centres = _centres(pose, algebra)
    top = pose.top
    try:
        return balanced(pose, algebra.twists(centres, len(top.members), top.ground))
    except KeyError:
        raise Failed("the construction stalls") from None


def _centres(pose: Posed, algebra: Algebra) -> dict[Pair, Any]:
    known: dict[Pair, Any] = {}
    normals: dict[Pair, list[Any]] = {}
    for k, bond in enumerate(pose.top.bonds):
        pair, basis = _pair(bond.a, bond.b), pose.bases[k]
        if len(basis) == 1:
            known.setdefault(pair, algebra.point(basis[0]))
        else:
            normals.setdefault(pair, []).append(algebra.line(*basis))
    bodies = range(len(pose.top.members))
    growing = True
    while growing:
        growing = False
        for pair in combinations(bodies, 2):
            if pair not in known:
                every = chain(normals.get(pair, ()), _lines(pair, known, algebra, bodies))
                lines = list(islice(every, 2))
                if len(lines) == 2:
                    known[pair] = algebra.meet(*lines)
                    growing = True
    return known


def _lines(pair: Pair, known: dict[Pair, Any], algebra: Algebra, bodies: range) -> Iterator[Any]:
    for k in bodies:
        one, two = _pair(pair[0], k), _pair(k, pair[1])
        if k not in pair and one in known and two in known and known[one] != known[two]:
            yield algebra.join(known[one], known[two])


def _pair(i: int, j: int) -> Pair:
    return (i, j) if i < j else (j, i)


class Homogeneous:
    """Cross products; a centre at infinity is a point like any other."""

    def point(self, triple: Triple) -> Triple:
        """As it is."""
        return triple

    def join(self, p: Triple, q: Triple) -> Triple:
        """Made to unit length, so that nothing overflows."""
        return self._unit(cross(p, q))

    meet = line = join

    def _unit(self, a: Triple) -> Triple:
        return times(1.0 / math.sqrt(pairing(a, a)), a)

    def twists(self, centres: dict[Pair, Triple], bodies: int, ground: int) -> list[Triple]:
        """By the first moving body: a t_i - b t_j is a multiple of the centre of i and j."""
        first = next(body for body in range(bodies) if body != ground)
        own = centres[_pair(ground, first)]
        result: list[Triple] = [(0.0, 0.0, 0.0)] * bodies
        result[first] = own
        for body in range(bodies):
            if body not in (ground, first):
                mine, shared = centres[_pair(ground, body)], centres[_pair(first, body)]
                one, two = cross(own, shared), cross(mine, shared)
                result[body] = times(pairing(one, two) / pairing(two, two), mine)
        return result


class Cartesian:
    """Slope and intercept: a point is ``(x, y)`` or a slope, a line ``(slope, intercept)`` or an x."""

    def point(self, triple: Triple) -> Any:
        """Finite, or at infinity on lines of one slope."""
        x, y, w = triple
        return (x / w, y / w) if w else self._slope(x, y)

    def _slope(self, dx: float, dy: float) -> float:
        return dy / dx if dx else math.inf

    def join(self, p: Any, q: Any) -> Any:
        """Two points, or one and a slope."""
        if isinstance(p, float):
            p, q = q, p
        if isinstance(p, float):
            raise Failed("a line through two points at infinity")
        slope = q if isinstance(q, float) else self._slope(q[0] - p[0], q[1] - p[1])
        return p[0] if slope == math.inf else (slope, p[1] - slope * p[0])

    def line(self, a: Triple, b: Triple) -> Any:
        """As the line through both."""
        return self.join(self.point(a), self.point(b))

    def meet(self, a: Any, b: Any) -> Any:
        """Equal slopes meet at infinity."""
        if isinstance(a, float):
            a, b = b, a
        if isinstance(a, float):
            return math.inf
        if isinstance(b, float):
            return (b, a[0] * b + a[1])
        if a[0] == b[0]:
            return a[0]
        x = (b[1] - a[1]) / (a[0] - b[0])
        return (x, a[0] * x + a[1])

    def twists(self, centres: dict[Pair, Any], bodies: int, ground: int) -> list[Triple]:
        """Angular velocities by the distances between three centres on one line."""
        moving = (body for body in range(bodies) if body != ground)
        first = next(body for body in moving if not isinstance(centres[_pair(ground, body)], float))
        ax, ay = centres[_pair(ground, first)]
        result: list[Triple] = [(0.0, 0.0, 0.0)] * bodies
        result[first] = (ax, ay, 1.0)
        for body in range(bodies):
            if body not in (ground, first):
                own, shared = centres[_pair(ground, body)], centres[_pair(first, body)]
                result[body] = self._twist(own, shared, ax, ay)
        return result

    def _twist(self, own: Any, shared: Any, ax: float, ay: float) -> Triple:
        if isinstance(own, float):
            if isinstance(shared, float):
                raise Failed("a translation whose speed no finite centre tells")
            return (ax - shared[0], ay - shared[1], 0.0)
        rate = 1.0
        if not isinstance(shared, float):
            k = 0 if abs(shared[0] - own[0]) > abs(shared[1] - own[1]) else 1
            rate = (shared[k] - (ax, ay)[k]) / (shared[k] - own[k])
        return (own[0] * rate, own[1] * rate, rate)
