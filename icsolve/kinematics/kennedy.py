"""Centres by the construction of Aronhold and Kennedy, each by the best pair of lines.

Three bodies in relative motion have their three centres on one line. A centre is therefore the
meet of two such lines; of all pairs of lines the search takes the one whose error, carried along
from the joints, is smallest (a shortest-path search on the estimated error). Where no two lines
are left the construction has stalled, and a centre from the loop equations lets it go on.
"""

from __future__ import annotations

import heapq
import math
from bisect import insort
from collections.abc import Callable, Iterable, Mapping
from operator import attrgetter

from icsolve.numbers.null_space import ROUNDING
from icsolve.screws.plane import Triple, cross
from icsolve.tuples import NamedTuple

BodyPair = tuple[int, int]


class CentreLine(NamedTuple):
    """A line on which a centre lies.

    Attributes
    ----------
    ends : the two pairs whose centres it joins; one entry, the pair itself: the common normal of its joint
    line : coordinates of unit length: (a, b, c) with ``a x + b y + c w = 0``
    error : estimated error of the direction of that vector (sine)
    """

    ends: tuple[BodyPair, ...]
    line: Triple
    error: float


class LocatedCentre(NamedTuple):
    """A centre as it was found: a homogeneous point of unit length and the estimated error (sine)."""

    point: Triple
    error: float
    by: str
    lines: tuple[CentreLine, ...] = ()


_error = attrgetter("error")


class Kennedy:
    """The construction over the bodies of a scene (Aronhold 1872; A. B. W. Kennedy, The Mechanics of
    Machinery, 1886).

    Centres are sought first among pairs that have one of the wanted bodies or the hub, or whose bodies
    are joined by one joint or two: their number grows as that of the bodies does. Only where these stall
    are all pairs looked at.

    Parameters
    ----------
    bodies : indices
    primaries : by pair (lower index first), the centre by inspection as (X, Y, W) and how it is known
    normals : by pair, the common normals of slots and contacts, as lines
    twist_of : of a pair its relative twist, None where it has no one centre: a seed where the construction
        stalls
    hub : the body (the frame) with which pairs are looked at in any case

    All are floats, in a frame of size 1 (errors are measured as angles between homogeneous vectors).
    """

    def __init__(
        self,
        bodies: Iterable[int],
        primaries: Mapping[BodyPair, tuple[Triple, str]],
        normals: Mapping[BodyPair, tuple[Triple, ...]],
        twist_of: Callable[[BodyPair], Triple | None],
        hub: int,
    ) -> None:
        self.bodies = frozenset(bodies)
        self.twist_of = twist_of
        self.hub = hub
        self.known: dict[BodyPair, LocatedCentre] = {}
        self.missing: set[BodyPair] = set()
        self.lines: dict[BodyPair, list[CentreLine]] = {}
        self.heap: list[tuple[float, int, BodyPair, LocatedCentre]] = []
        self.partners: dict[int, frozenset[int]] | None = None
        self.joined: dict[int, set[int]] = {body: set() for body in self.bodies}
        for i, j in (*primaries, *normals):
            self.joined[i].add(j)
            self.joined[j].add(i)
        for pair, (point, by) in primaries.items():
            self._offer(pair, LocatedCentre(unit(point), ROUNDING, by))
        for pair, normal in normals.items():
            for line in normal:
                self._draw(pair, CentreLine((pair,), unit(line), ROUNDING))

    def find(self, wanted: Iterable[BodyPair]) -> None:
        """Construct until every wanted pair that has a relative twist is in ``known``.

        Pairs without one (they move as one, or have no one centre) are passed over.
        """
        self.missing = {pair for pair in wanted if pair not in self.known and self.twist_of(pair) is not None}
        if 2 * len(self.missing) < len(self.bodies):
            self.partners = self._near({body for pair in self.missing for body in pair} | {self.hub})
        while self.missing:
            if self._settle_next():
                continue
            if self.partners is not None and len(self.bodies) <= WHOLE:
                self.partners = None
                for pair in tuple(self.known):
                    self._spread(pair)
                continue
            seed = self._seed(self.missing)
            twist = self.twist_of(seed)
            assert twist is not None
            self._offer(seed, LocatedCentre(unit(twist), ROUNDING, "loop equations"))

    def _near(self, centre: set[int]) -> dict[int, frozenset[int]]:
        """For every body those with which its centre is sought: ``centre``, and those two joints away at
        most, not over the hub."""
        around = {body: near - {self.hub} for body, near in self.joined.items()}
        around[self.hub] = set()
        near = {b: centre.union(n, *(around[m] for m in n)) for b, n in around.items()}
        return {b: self.bodies if b in centre else frozenset(n - {b}) for b, n in near.items()}

    def _seed(self, missing: set[BodyPair]) -> BodyPair:
        """The missing pair that most lines wait for: it lets the most others follow."""
        return max(missing, key=lambda pair: (len(self.lines.get(pair, ())), -pair[0], -pair[1]))

    def _settle_next(self) -> bool:
        while self.heap:
            _, _, pair, known = heapq.heappop(self.heap)
            if pair not in self.known:
                self.known[pair] = known
                self.missing.discard(pair)
                self._spread(pair)
                return True
        return False

    def _spread(self, pair: BodyPair) -> None:
        i, j = pair
        known = self.known
        thirds = self.bodies if self.partners is None else self.partners[i] & self.partners[j]
        for k in thirds:
            if k in pair:
                continue
            ik, jk = ordered(i, k), ordered(j, k)
            if jk in known:
                if ik not in known and self.twist_of(ik) is not None:
                    self._join(ik, pair, jk)
            elif ik in known and self.twist_of(jk) is not None:
                self._join(jk, pair, ik)

    def _join(self, target: BodyPair, one: BodyPair, two: BodyPair) -> None:
        p, q = self.known[one], self.known[two]
        line, sine = _meet(p.point, q.point)
        error = p.error + q.error
        if sine <= SAME + error:
            point = p if p.error <= q.error else q
            through = CentreLine((one, two), point.point, error)
            self._offer(target, LocatedCentre(point.point, error, "construction", (through,)))
            return
        self._draw(target, CentreLine((one, two), line, ROUNDING + error / sine))

    def _draw(self, pair: BodyPair, line: CentreLine) -> None:
        lines = self.lines.setdefault(pair, [])
        if len(lines) == ENOUGH:
            if line.error >= lines[-1].error:
                return
            lines.pop()
        for other in lines:
            point, sine = _meet(line.line, other.line)
            error = line.error + other.error
            if sine > SAME + error:
                self._offer(
                    pair, LocatedCentre(point, ROUNDING + error / sine, "construction", (other, line))
                )
        insort(lines, line, key=_error)

    def _offer(self, pair: BodyPair, known: LocatedCentre) -> None:
        if pair not in self.known:
            heapq.heappush(self.heap, (known.error, len(self.heap), pair, known))


WHOLE = 64
"""In a chain of more links a centre that those near it do not give (of wheels in one line) is not looked for
over all pairs: it comes from the loop equations."""
ENOUGH = 4
"""The best lines of a centre that are kept: on any two of them it is sought."""
SAME = 64 * ROUNDING
"""Two points (lines) nearer than this angle are one: they have no join (meet)."""


def ordered(i: int, j: int) -> BodyPair:
    """The pair with the lower number first."""
    return (i, j) if i < j else (j, i)


def unit(a: Triple) -> Triple:
    """The homogeneous triple with unit length; ZeroDivisionError for (0, 0, 0)."""
    length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return (a[0] / length, a[1] / length, a[2] / length)


def _meet(a: Triple, b: Triple) -> tuple[Triple, float]:
    """Cross product of unit triples, made unit, and its length: the sine between them."""
    c = cross(a, b)
    sine = math.sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2])
    return (c if sine == 0.0 else (c[0] / sine, c[1] / sine, c[2] / sine)), sine


def sine_between(a: Triple, b: Triple) -> float:
    """Sine of the angle between two homogeneous vectors, of any length."""
    return _meet(unit(a), unit(b))[1]
