"""Instant centres by the construction of Aronhold and Kennedy, each with the way in which it was found.

Three bodies in relative motion have their three centres on one line. A centre is therefore the meet of two
such lines; of all pairs of lines the search takes the one whose error, carried along from the joints, is
smallest (a shortest-path search on the estimated error). Where no two lines are left the construction has
stalled, and a centre from the loop equations lets it go on.

The construction by lines gives the way that is shown; the relative twist of the two links, which comes from
the loop equations group by group, must agree with it. What lies on one line where a group is dead is named
here too.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from operator import attrgetter

from icsolve.answer import Centre
from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Joint, Pair, is_named, ordered_pair
from icsolve.kinematics import Closure, is_dead, products, rate_sizes
from icsolve.numbers import ROUNDING, ROUNDING_NOISE, Arithmetic, Showing, all_vanish
from icsolve.screws import Point, Triple, cross, subtract
from icsolve.screws.joints import freedoms, joint_freedoms, joint_points, pitch_point
from icsolve.structure import Bond, Topology
from icsolve.tuples import NamedTuple, cached_property
from icsolve.wording import listed

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
        self.offered: dict[BodyPair, float] = {}
        self.partners: dict[int, frozenset[int]] | None = None
        self.joined: dict[int, set[int]] = {body: set() for body in self.bodies}
        self.settled: dict[int, set[int]] = {body: set() for body in self.bodies}
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
            # the first missing pair that most lines wait for: it lets the most others follow
            seed = max(sorted(self.missing), key=lambda pair: len(self.lines.get(pair, ())))
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

    def _settle_next(self) -> bool:
        while self.heap:
            _, _, pair, known = heapq.heappop(self.heap)
            if pair not in self.known:
                i, j = pair
                self.known[pair] = known
                self.settled[i].add(j)
                self.settled[j].add(i)
                self.missing.discard(pair)
                self._spread(pair)
                return True
        return False

    def _spread(self, pair: BodyPair) -> None:
        """The lines of all centres for which with a new one just two of a triangle are known."""
        i, j = pair
        thirds = (self.settled[i] ^ self.settled[j]) - {i, j}
        for k in sorted(thirds if self.partners is None else thirds & self.partners[i] & self.partners[j]):
            one, two = (i, j) if k in self.settled[j] else (j, i)
            target = ordered(one, k)
            if self.twist_of(target) is not None:
                self._join(target, pair, ordered(two, k))

    def _join(self, target: BodyPair, one: BodyPair, two: BodyPair) -> None:
        p, q = self.known[one], self.known[two]
        error = p.error + q.error
        lines: Sequence[CentreLine] = self.lines.get(target, ())
        worst = lines[-1].error if len(lines) >= ENOUGH else math.inf
        if ROUNDING + error >= worst:  # so is that of their line, whatever the sine
            return
        line = cross(p.point, q.point)
        sine = math.hypot(*line)
        if sine <= SAME + error:
            point = p if p.error <= q.error else q
            through = CentreLine((one, two), point.point, error)
            self._offer(target, LocatedCentre(point.point, error, "construction", (through,)))
        elif (error := ROUNDING + error / sine) < worst:
            self._draw(target, CentreLine((one, two), unit(line), error))

    def _draw(self, pair: BodyPair, line: CentreLine) -> None:
        lines = self.lines.setdefault(pair, [])
        del lines[ENOUGH - 1 :]
        for other in lines:
            error = line.error + other.error
            if ROUNDING + error >= self.offered.get(pair, math.inf):
                continue
            point = cross(line.line, other.line)
            sine = math.hypot(*point)
            if sine > SAME + error:
                error = ROUNDING + error / sine
                self._offer(pair, LocatedCentre(unit(point), error, "construction", (other, line)))
        lines.append(line)
        lines.sort(key=_error)

    def _offer(self, pair: BodyPair, known: LocatedCentre) -> None:
        if known.error < self.offered.get(pair, math.inf):
            self.offered[pair] = known.error
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


def sine_between(a: Triple, b: Triple) -> float:
    """Sine of the angle between two homogeneous vectors, of any length."""
    return math.hypot(*cross(unit(a), unit(b)))


LinkTwists = Mapping[str, Sequence[Triple]]
ONE = 5.0
"""In floats links move as one whose twists differ by less than so many times the rounding noise."""
SPREAD = 5e4
"""In floats relative twists of two motions share their centre within so many times the noise."""
TRUSTED = 1e-8
"""A construction that loses more digits than this is not told as the way; the loop equations are. So too
where the two disagree by more than the construction can have lost."""


class CentreFinder:
    """Centres of one scene.

    Parameters
    ----------
    place : the scene
    twists : by link, one twist for each motion that is meant [frame of size 1]
    a : arithmetic of these, which give the places; the search for the lines that lead to them runs on floats
    """

    def __init__(self, place: PlacedCase, twists: LinkTwists, a: Showing) -> None:
        self.case, self.frame, points, _ = place
        self.top = top = place.top
        self.twists = {top.body_of[link]: twists[link] for link in top.body_of if link in twists}
        self.points, self.arithmetic = points, a
        self.fastest = max((_length(t) for ts in twists.values() for t in ts), default=0.0)
        self.relative, self.moving = cache(self._relative), cache(self._moving)

    @cached_property
    def joints_of(self) -> Mapping[str, Sequence[Joint]]:
        """The joints that each link has."""
        found: dict[str, list[Joint]] = {}
        for joint in self.case.joints:
            for link in joint.links:
                found.setdefault(link, []).append(joint)
        return found

    def find(self, pairs: Iterable[Pair], slack: float = 0.0) -> dict[Pair, Centre]:
        """A `Centre` for every pair of links.

        Parameters
        ----------
        pairs : pairs of names, in either order
        slack : how far given centres contradict each other [fraction of the figure's size]

        Returns
        -------
        dict[Pair, Centre]
            Places in case lengths, directions in degrees; ``undefined`` where two links move as one,
            ``undetermined`` where they have more than one relative freedom: nothing is refused.
        """
        pairs = list(pairs)
        primaries, normals = self._by_inspection()
        joints = {pair: (_in_floats(point), by) for pair, (point, by) in primaries.items()}
        guides = {pair: tuple(map(_in_floats, lines)) for pair, lines in normals.items()}
        search = Kennedy(self.twists, joints, guides, self.moving, self.top.ground)
        search.find(ordered(self.top.body_of[a], self.top.body_of[b]) for a, b in pairs)
        return {pair: self._centre(pair, search, primaries, slack) for pair in pairs}

    def placed(self, pair: Pair) -> Point:
        """The centre of a pair that has one at no infinity [frame of size 1], in the arithmetic."""
        bodies = ordered(*(self.top.body_of[link] for link in pair))
        own = self._own(pair) or (self.moving(bodies) and self._by_inspection()[0].get(bodies))
        found = own[0] if own else self.relative(*bodies)
        assert found is not None
        x, y, w = found
        return x / w, y / w

    def _moving(self, pair: BodyPair) -> Triple | None:
        """The relative twist in floats of two bodies that have one centre in all motions meant; else None."""
        twist = self.relative(*pair)
        return None if twist is None or twist is REST else _in_floats(twist)

    def _relative(self, i: int, j: int) -> Triple | None:
        """The relative twist; REST where the two move as one, None where the centre is open."""
        a = self.arithmetic
        relatives: list[Triple] = []
        for ti, tj in zip(self.twists[i], self.twists[j], strict=True):
            t = subtract(tj, ti)
            if not all_vanish(a, ((part, ONE * self.fastest) for part in t)):
                relatives.append(t)
        best = max(relatives, key=_length, default=REST)
        for t in relatives:
            size = SPREAD * _length(best) * _length(t)
            if t is not best and not all_vanish(a, ((part, size) for part in cross(best, t))):
                return None
        return best

    def _by_inspection(
        self,
    ) -> tuple[dict[BodyPair, tuple[Triple, str]], dict[BodyPair, tuple[Triple, ...]]]:
        primaries: dict[BodyPair, tuple[Triple, str]] = {}
        normals: dict[BodyPair, tuple[Triple, ...]] = {}
        for bond in self.top.bonds:
            if bond.a not in self.twists or bond.b not in self.twists:
                continue
            pair = ordered(bond.a, bond.b)
            if bond.pivots:
                primaries.setdefault(pair, (pitch_point(bond, self.points, self.arithmetic), "inspection"))
                continue
            basis = freedoms(bond, self.points, self.arithmetic)
            if len(basis) == 2:
                normals[pair] = (*normals.get(pair, ()), cross(*basis))
            else:
                by = "given" if bond.joint.stands_in else "inspection"
                primaries.setdefault(pair, (basis[0], by))
        return primaries, normals

    def _centre(
        self,
        pair: Pair,
        search: Kennedy,
        primaries: Mapping[BodyPair, tuple[Triple, str]],
        slack: float,
    ) -> Centre:
        i, j = (self.top.body_of[link] for link in pair)
        bodies = ordered(i, j)
        own = self._own(pair)
        rough = self.moving(bodies)
        if own is not None or (bodies in primaries and rough is not None):
            point, by = own or primaries[bodies]
            return self._placed(pair, point, LocatedCentre(point, ROUNDING, by))
        if i == j or self.relative(*bodies) == REST:
            return Centre(pair, "undefined", why=f"{pair[0]} and {pair[1]} move as one")
        if rough is None:
            why = f"{pair[0]} and {pair[1]} have no one centre: they have more than one relative freedom"
            return Centre(pair, "undetermined", why=why)
        known = search.known[bodies]
        agreed = max(1e-12, 1e3 * known.error, 10.0 * slack)  # as far as the digits of the construction go
        if known.error > TRUSTED or not sine_between(known.point, rough) <= agreed:
            known = LocatedCentre(unit(rough), ROUNDING, "loop equations")
        twist = self.relative(*bodies)
        assert twist is not None
        return self._placed(pair, twist, known)

    def _own(self, pair: Pair) -> tuple[Triple, str] | None:
        """The centre of the joint between two links, which stands even where they do not move (a weld
        has none)."""
        shared = [joint for joint in self.joints_of.get(pair[0], ()) if pair[1] in joint.links]
        if any(not joint.freedom and set(joint.links) == set(pair) for joint in shared):
            return None
        for joint in shared:
            single = joint.freedom == 1
            if single and all(point in self.points for point in joint_points(joint)):
                by = "given" if joint.stands_in else "inspection"
                return joint_freedoms(joint, self.points, self.arithmetic)[0], by
        return None

    def _placed(self, pair: Pair, at: Triple, known: LocatedCentre) -> Centre:
        """The centre at a homogeneous point, found in a way that is known."""
        a, (x, y, w), (ox, oy, scale) = self.arithmetic, at, self.frame
        lines = tuple(tuple(self._names(end, pair) for end in line.ends) for line in known.lines)
        largest = max(abs(x), abs(y))
        if a.vanishes(w, max(INFINITE, min(4.0 * known.error, 1e-10) / ROUNDING_NOISE) * largest):
            toward = a.angle(x, y)
            angle, error = a.rounded(toward + 180.0 if float(toward) < 0.0 else toward, 180.0)
            angle = 0.0 if angle == 180.0 else angle
            return Centre(pair, "toward", (angle,), known.by, lines, "", _bound(error))
        place, errors = [], []
        for part, origin in ((x, ox), (y, oy)):
            shown, error = a.rounded(part / w / scale + origin, largest / abs(w) / scale + abs(origin))
            place.append(shown)
            errors.append(error)
        return Centre(pair, "at", (place[0], place[1]), known.by, lines, "", _bound(sum(errors)))

    def _names(self, bodies: BodyPair, of: Pair) -> Pair:
        """A link of each body: that of which the centre is asked, where that is one of its links."""
        members = (self.top.members[body] for body in bodies)
        a, b = (next((link for link in of if link in links), links[0]) for links in members)
        return ordered_pair(self.case, a, b)


REST: Triple = (0.0, 0.0, 0.0)


INFINITE = 0.1
"""In floats a centre lies at infinity whose weight is below so many times the rounding noise."""


def _bound(error: float) -> float | None:
    """A bound that is known."""
    return error if error < math.inf else None


def _length(t: Triple) -> float:
    return math.hypot(float(t[0]), float(t[1]), float(t[2]))


def _in_floats(t: Triple) -> Triple:
    """A homogeneous point in floats, of a size near 1."""
    x, y, w = (float(part) for part in t)
    size = max(abs(x), abs(y), abs(w))
    return (x / size, y / size, w / size)


def lined_up(closure: Closure, top: Topology, body: int, arithmetic: Arithmetic) -> tuple[int, ...]:
    """The bonds whose centres lie on one line and so hold a body at rest; empty where none do.

    A dead group holds the bodies before it. A body of the group itself rests where the line of its own
    two centres passes through the relative centre of the bodies that drive the group, where that is a
    joint's.
    """
    bodies, bonds = closure.group.bodies, closure.group.bonds
    if not closure.columns:
        return ()
    if body not in bodies:
        return tuple(sorted(bonds)) if is_dead(closure, arithmetic) else ()
    n = bodies.index(body)
    if not arithmetic.vanishes(closure.numerators[n], rate_sizes(closure)[n]):
        return ()
    kept = (bonds[1], bonds[2 if n == 0 else 0]) if closure.group.kind == "dyad" else bonds[1:]
    ends = closure.group.ends
    shared = (k for k in top.at[ends[0]] if top.bonds[k].other(ends[0]) == ends[1])
    driver = next((k for k in shared if top.bonds[k].freedom == 1), None)
    return () if driver is None else tuple(sorted((driver, *kept)))


def tightest(closures: Iterable[Closure]) -> Closure | None:
    """The group that is nearest to dead, or to leaving a body at rest."""
    return min((closure for closure in closures if closure.columns), key=_tightness, default=None)


def _tightness(closure: Closure) -> float:
    """The smallest determinant of a group, over the products that it is summed from."""
    pairs = zip(closure.numerators, rate_sizes(closure), strict=True)
    return min(flatness(closure), *(abs(value) / size if size > 0.0 else 1.0 for value, size in pairs))


def flatness(closure: Closure) -> float:
    """The determinant of a group's own bonds over its products: zero where their centres are in line."""
    *bases, _ = closure.columns
    size = products(*bases)
    return abs(closure.factor) / size if size > 0.0 else 1.0


def aligned(top: Topology, bonds: Iterable[int], verb: str = "lie on") -> str:
    """Names the centres of bonds that lie on one line; empty where one of them has no name."""
    joints = [top.bonds[k] for k in bonds]
    names = [_place(bond) for bond in joints if bond.freedom == 1]
    normals = [_normal(bond) for bond in joints if bond.freedom == 2]
    if not all((*names, *normals)):
        return ""
    if len(names) == 3:
        return f"{listed(names)} {verb} one line"
    if len(names) == len(normals) == 1:
        return f"{normals[0]} {'passes through' if verb == 'lie on' else 'nearly passes through'} {names[0]}"
    return ""


def _place(bond: Bond) -> str:
    pivot = bond.joint.pivot
    return pivot if pivot is not None and is_named(pivot) else ""


def _normal(bond: Bond) -> str:
    from icsolve.wording.joints import normal_words

    joint = bond.joint
    named = joint.has_normal and joint.at and is_named(joint.at)
    return f"the {normal_words(joint)} at {joint.at}" if named else ""
