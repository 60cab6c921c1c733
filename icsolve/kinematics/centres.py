"""The centres that are asked for, each with the way in which it was found.

The construction by lines gives the place that is shown; the relative twist of the two links, which
comes from the loop equations group by group, must agree with it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cache

from icsolve.answer import Centre
from icsolve.assembly.workspace import Frame
from icsolve.case import Case, Pair
from icsolve.case.joints import Mesh
from icsolve.case.names import ordered_pair
from icsolve.kinematics.kennedy import BodyPair, Kennedy, LocatedCentre, ordered, sine_between, unit
from icsolve.numbers.arithmetic import ROUNDING_NOISE, Showing, all_vanish
from icsolve.numbers.null_space import ROUNDING
from icsolve.screws.joints import Points, freedoms, joint_freedoms, joint_points, pitch_point
from icsolve.screws.plane import Triple, cross, subtract
from icsolve.structure.topology import Topology

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
    case, top, frame, points : the scene; points by name [frame]
    twists : by link, one twist for each motion that is meant [frame of size 1]
    a : arithmetic of the twists, which give the places; the search for the lines that lead to them runs
        on floats
    """

    def __init__(
        self, case: Case, top: Topology, twists: LinkTwists, frame: Frame, points: Points, a: Showing
    ) -> None:
        self.case, self.top, self.frame = case, top, frame
        self.twists = {top.body_of[link]: twists[link] for link in top.body_of if link in twists}
        self.points, self.arithmetic = points, a
        self.fastest = max((_length(t) for ts in twists.values() for t in ts), default=0.0)
        self.relative, self.moving = cache(self._relative), cache(self._moving)

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
            if isinstance(bond.joint, Mesh):
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
        if known.error > TRUSTED or not _agree(known, rough, slack):
            known = LocatedCentre(unit(rough), ROUNDING, "loop equations")
        twist = self.relative(*bodies)
        assert twist is not None
        return self._placed(pair, twist, known)

    def _own(self, pair: Pair) -> tuple[Triple, str] | None:
        """The centre of the joint between two links, which stands even where they do not move (a weld
        has none)."""
        if any(not joint.freedom and set(joint.links) == set(pair) for joint in self.case.joints):
            return None
        for joint in self.case.joints:
            single = {*pair} <= {*joint.links} and joint.freedom == 1
            if single and all(point in self.points for point in joint_points(joint)):
                by = "given" if joint.stands_in else "inspection"
                return joint_freedoms(joint, self.points, self.arithmetic)[0], by
        return None

    def _placed(self, pair: Pair, at: Triple, known: LocatedCentre) -> Centre:
        """The centre at a homogeneous point, found in a way that is known."""
        a, (x, y, w), (ox, oy, scale) = self.arithmetic, at, self.frame
        lines = tuple(tuple(self._names(end) for end in line.ends) for line in known.lines)
        largest = max(abs(x), abs(y))
        if a.vanishes(w, max(INFINITE, min(4.0 * known.error, 1e-10) / ROUNDING_NOISE) * largest):
            toward = a.degrees(x, y)
            angle, error = a.rounded(toward + 180.0 if float(toward) < 0.0 else toward, 180.0)
            angle = 0.0 if angle == 180.0 else angle
            return Centre(pair, "toward", (angle,), known.by, lines, "", _bound(error))
        place, errors = [], []
        for part, origin in ((x, ox), (y, oy)):
            shown, error = a.rounded(part / w / scale + origin, largest / abs(w) / scale + abs(origin))
            place.append(shown)
            errors.append(error)
        return Centre(pair, "at", (place[0], place[1]), known.by, lines, "", _bound(sum(errors)))

    def _names(self, pair: BodyPair) -> Pair:
        return ordered_pair(self.case, self.top.members[pair[0]][0], self.top.members[pair[1]][0])


def _agree(known: LocatedCentre, twist: Triple, slack: float) -> bool:
    """Whether a construction and the loop equations give one place, as far as its digits go."""
    return sine_between(known.point, twist) <= max(1e-12, 1e3 * known.error, 10.0 * slack)


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
