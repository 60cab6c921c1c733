"""The order in which a driven mechanism closes, link by link, from the frame.

Closed forms as far as they go: a link turns as another does, is placed by one or two points that are known,
turns until its slot meets one; two loci of a pin meet. Where nothing of this kind is left, the smallest set
of links that their conditions determine goes to Newton's method.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from icsolve.assembly.driven.constraints import (
    Constraint,
    OnLine,
    Pointed,
    RolledRound,
    RolledStraight,
    Roped,
    Spinning,
    SpotDistance,
    Turning,
    bodies_of,
    spun,
)
from icsolve.assembly.driven.poses import (
    Places,
    Shape,
    Spot,
    dot,
    minus,
    plus,
    product,
    quotient,
    scaled,
    square,
)
from icsolve.assembly.loci import PlacedCircle, PlacedLine, PlacedLocus, crossing_sine, sideways
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar
from icsolve.numbers.record import Record, varies
from icsolve.screws import Point
from icsolve.tuples import NamedTuple

FLUSH = 1e-15
"""A line that passes its pivot by less than this passes through it (rounding; normalised)."""


def rotation_to_line(record: Record, e: Point, along: Point, h: Scalar, sign: Scalar) -> Point:
    """The rotation after which a line passes a place at a given distance.

    Parameters
    ----------
    e : vector from the pivot of the line's body to the place [frame]
    along : unit vector along the line as written
    h : distance of the place to the left of the line through the pivot [frame]
    sign : +1 where the place lies ahead, -1 behind

    Returns
    -------
    Point
        Cosine and sine since the position as written.
    """
    d2 = dot(e, e)
    if not varies(h) and abs(float(h)) <= FLUSH:
        d = record.root((d2, 1.0), (1.0, 1.0))
        z = quotient((sign * (e[0] / d), sign * (e[1] / d)), along)
        return z if isinstance(h, float) and h == 0.0 else scaled(record.about(1.0, FLUSH), z)
    ahead = sign * record.root((d2 - h * h, d2 + h * h), (1.0, 1.0))
    x, y = product((ahead, h), along)
    return ((e[0] * x + e[1] * y) / d2, (e[1] * x - e[0] * y) / d2)


# --- the loci of a spot: about another spot of its body, or what a joint leaves to a body that has turned ---


class Through(NamedTuple):
    """The spot is on the circle about another spot of its body."""

    spot: Spot
    pivot: Spot


class ThroughTurned(NamedTuple):
    """The spot is on the locus that a condition gives to a body.

    ``own`` is the body's spot that the condition speaks of; None where it speaks of the body's line.
    A spot other than ``own`` needs a body whose rotation is known.
    """

    spot: Spot
    by: OnLine | SpotDistance | RolledStraight | Roped
    own: Spot | None


By = Through | ThroughTurned


def locus(shape: Shape, places: Places, by: By) -> PlacedLocus:
    """The locus where the bodies are."""
    if isinstance(by, Through):
        return PlacedCircle(places.place(by.pivot), shape.span(by.spot, by.pivot))
    c = by.by
    if isinstance(c, SpotDistance):
        own, other = (c.one, c.two) if by.own == c.one else (c.two, c.one)
        return PlacedCircle(plus(places.place(other), _off(shape, places, own, by.spot)), c.distance)
    if isinstance(c, Roped):
        assert by.own is not None
        tied = c.tied_to(by.own)
        assert tied is not None
        record = shape.record
        more = c.longer(places, record, record.turns, by.own) + spun(c.terms, places) * record.radian
        left = -more / float(tied[1])
        return PlacedCircle(plus(places.place(tied[0]), _off(shape, places, by.own, by.spot)), left)
    if by.own is None:
        return _of_line(shape, places, c, by.spot)
    along = places.vector(c.line.body, c.line.along)
    through = plus(places.point(c.line.body, c.line.through), _off(shape, places, by.own, by.spot))
    if isinstance(c, OnLine):
        return PlacedLine(plus(through, scaled(c.offset, square(along))), along)
    return PlacedLine(plus(through, scaled(_way(shape, places, c), along)), square(along))


def _of_line(shape: Shape, places: Places, c: OnLine | RolledStraight, spot: Spot) -> PlacedLine:
    """Of a body whose line meets a known spot: so lies a spot of that body."""
    body = spot[0]
    along = places.vector(body, c.line.along)
    x, y = shape.ref[spot[1]]
    from_line = places.vector(body, minus((x, y), c.line.through))
    if isinstance(c, OnLine):
        foot = minus(places.place(c.spot), scaled(c.offset, square(along)))
        return PlacedLine(plus(foot, from_line), along)
    foot = minus(places.place(c.centre), scaled(_way(shape, places, c), along))
    return PlacedLine(plus(foot, from_line), square(along))


def _way(shape: Shape, places: Places, c: RolledStraight) -> Scalar:
    """How far the centre has gone along the flank."""
    return -(spun(c.terms, places) * shape.record.radian)


def _off(shape: Shape, places: Places, own: Spot, spot: Spot) -> Point:
    """Vector from the body's own spot to another of its spots."""
    if shape.one(own) == shape.one(spot):
        return (0.0, 0.0)
    return places.vector(spot[0], shape.between((spot[0], own[1]), spot))


def reference(shape: Shape, by: By) -> PlacedLocus:
    """The locus in the position as written, in floats."""
    found = locus(shape, Places(shape), by)
    if isinstance(found, PlacedCircle):
        return PlacedCircle(_floats(found.centre), float(found.radius))
    return PlacedLine(_floats(found.through), _floats(found.along))


def _floats(p: Point) -> Point:
    return (float(p[0]), float(p[1]))


GONE = 1e-12
"""A factor that elimination leaves below this fraction of its parts is zero."""


class _Row(NamedTuple):
    """A sum of ratios: factors by body, degrees, and the ratio that it stands instead of."""

    factors: dict[int, Scalar]
    degrees: Scalar
    source: Turning

    def share(self, body: int) -> float:
        """How large the factor of a body is beside the largest."""
        return abs(float(self.factors[body])) / max(abs(float(factor)) for factor in self.factors.values())


def train_ratios(ratios: Sequence[Turning], known: Collection[int]) -> tuple[int, Turning, Turning] | None:
    """A body, the ratio of its rotation to known ones, and which of the given ratios that stands instead of.

    Elimination without division, so that whole numbers of teeth stay whole; None where no rotation
    follows from the known ones.
    """
    rows = [_row(ratio) for ratio in ratios]
    done: list[tuple[int, _Row]] = []
    while rows:
        choices = [(b, r) for r in rows for b in _open(r, known)]
        if not choices:
            break
        body, row = max(choices, key=lambda pair: pair[1].share(pair[0]))
        rows = [_without(other, row, body) for other in rows if other is not row]
        done = [(b, _without(other, row, body)) for b, other in done]
        done.append((body, row))
    for body, row in done:
        if _open(row, known) == [body]:
            return body, Turning(tuple(row.factors.items()), row.degrees), row.source
    return None


def _row(ratio: Turning) -> _Row:
    factors: dict[int, Scalar] = {}
    for body, factor in ratio.terms:
        factors[body] = factors[body] + factor if body in factors else factor
    return _Row(factors, ratio.degrees, ratio)


def _open(row: _Row, known: Collection[int]) -> list[int]:
    """The bodies of a sum whose rotation is not known."""
    return [body for body in row.factors if body not in known]


def _without(row: _Row, pivot: _Row, body: int) -> _Row:
    """A sum less so many times another that a body is no longer in it."""
    if body not in row.factors:
        return row
    own, its = row.factors[body], pivot.factors[body]
    factors: dict[int, Scalar] = {}
    for other in dict.fromkeys((*row.factors, *pivot.factors)):
        a, b = row.factors.get(other, 0.0) * its, pivot.factors.get(other, 0.0) * own
        if other != body and abs(float(a - b)) > GONE * (abs(float(a)) + abs(float(b))):
            factors[other] = a - b
    return _Row(factors, row.degrees * its - pivot.degrees * own, row.source)


# --- the order in which a driven mechanism closes, link by link, from the frame ---


TOUCHING = 1e-7
"""Loci that cross at a smaller angle (sine) in the position as written touch."""
ROUGH, SIDEWAYS = 2e-3, 0.05
"""How far (normalised) to one side `near` lies at least where it tells the side, and as a part of how far it
is off."""


class RotateWith(NamedTuple):
    """A body's rotation from those of the others in a `Turning`, or from a driver; ``instead`` of a
    condition where several were taken together."""

    body: int
    by: Spinning | Pointed
    instead: Turning | None = None


class PlaceByPoint(NamedTuple):
    """A body whose rotation is known is placed by a spot."""

    body: int
    spot: Spot


class PlaceByTwoPoints(NamedTuple):
    """A body is placed by two spots."""

    body: int
    spots: tuple[Spot, Spot]


class PlaceAtIntersection(NamedTuple):
    """A spot is where two of its loci meet."""

    spot: Spot
    loci: tuple[By, By]


class RotateToLine(NamedTuple):
    """Bodies turn alike about ``pivot`` of the first until its line passes beside ``aim`` as it is to."""

    bodies: tuple[int, ...]
    pivot: Spot
    aim: Spot
    by: OnLine


class AssurGroup(NamedTuple):
    """Bodies that only all their conditions together determine."""

    bodies: tuple[int, ...]
    constraints: tuple[Constraint, ...]


AssemblyStep = RotateWith | PlaceByPoint | PlaceByTwoPoints | PlaceAtIntersection | RotateToLine | AssurGroup


class Closing(NamedTuple):
    """How a mechanism closes: its steps, all its conditions, and which of these they use (by id)."""

    steps: tuple[AssemblyStep, ...]
    constraints: list[Constraint]
    used: set[int]


class AssemblyOrder:
    """The steps as they are found; ``full`` bodies are placed, ``turned`` have their rotation.

    A point in ``near`` [frame] may be where two loci only touch as written: `near` tells which way it goes on
    where it lies to one side.
    """

    def __init__(
        self,
        shape: Shape,
        spots: dict[int, list[Spot]],
        constraints: list[Constraint],
        near: Mapping[str, Point] | None = None,
    ) -> None:
        self.shape, self.spots, self.constraints, self.near = shape, spots, constraints, near or {}
        self.full, self.turned = {shape.ground}, {shape.ground}
        self.located = {*map(shape.one, spots.get(shape.ground, ()))}
        self.steps: list[AssemblyStep] = []
        self.used: set[int] = set()
        self.nearest: str | None = None
        """a spot whose loci only touch as written"""
        self.ties = {id(c): bodies_of(c) for c in constraints}
        """by constraint the bodies that it ties"""
        self.members: dict[Spot, list[Spot]] = {}
        for carried in spots.values():
            for spot in carried:
                self.members.setdefault(shape.one(spot), []).append(spot)

    @property
    def closing(self) -> Closing:
        """The steps so far."""
        return Closing(tuple(self.steps), self.constraints, self.used)

    def advance(self) -> bool:
        """Take the next closed form; False where there is none."""
        for rule in (
            self._rotations,
            self._by_point,
            self._by_two_points,
            self._to_line,
            self._at_intersection,
            self._by_gears,
        ):
            step = next(rule(), None)
            if step is not None:
                self.take(step)
                return True
        return False

    def take(self, step: AssemblyStep) -> None:
        """Note what a step makes known."""
        self.steps.append(step)
        match step:
            case RotateWith(body, by, instead):
                self.turned.add(body)
                self.used.update((id(by), id(instead)))
            case PlaceByPoint(body) | PlaceByTwoPoints(body):
                self._fill((body,))
            case PlaceAtIntersection(spot, loci):
                self.located.add(self.shape.one(spot))
                self.used.update(id(locus.by) for locus in loci if isinstance(locus, ThroughTurned))
            case RotateToLine(bodies, _, _, by):
                self.turned.update(bodies)
                self.used.add(id(by))
            case AssurGroup(bodies, constraints):
                self._fill(bodies)
                self.used.update(map(id, constraints))

    def _fill(self, bodies: Iterable[int]) -> None:
        for body in bodies:
            self.full.add(body)
            self.turned.add(body)
            self.located.update(map(self.shape.one, self.spots[body]))

    def known(self, spot: Spot) -> bool:
        """Whether the place of a spot is known."""
        return spot[0] in self.full or self.shape.one(spot) in self.located

    def _open(self) -> list[int]:
        return [body for body in self.spots if body not in self.full]

    # --- rules ------------------------------------------------------------------------------------

    def _rotations(self) -> Iterator[RotateWith]:
        for c in self.constraints:
            if id(c) in self.used or not isinstance(c, (Spinning, Pointed)):
                continue
            wheels = {c.body} if isinstance(c, Pointed) else {body for body, _ in c.terms}
            left = [body for body in wheels if body not in self.turned]
            if len(left) == 1 and self._tells(c):
                yield RotateWith(left[0], c)

    def _by_gears(self) -> Iterator[RotateWith]:
        """A rotation that several ratios of wheels tell together."""
        ratios = [c for c in self.constraints if isinstance(c, Turning) and id(c) not in self.used]
        found = train_ratios(ratios, self.turned)
        if found is not None:
            yield RotateWith(*found)

    def _tells(self, c: Spinning | Pointed) -> bool:
        """Whether a condition tells the one rotation in it that is not known."""
        if isinstance(c, Roped):
            return all(map(self.known, c.spots))
        if isinstance(c, RolledStraight):
            return c.line.body in self.full and self.known(c.centre)
        return not isinstance(c, RolledRound) or (self.known(c.one) and self.known(c.two))

    def _by_point(self) -> Iterator[PlaceByPoint]:
        for body in self._open():
            if body in self.turned:
                yield from (PlaceByPoint(body, spot) for spot in self.spots[body] if self.known(spot))

    def _by_two_points(self) -> Iterator[PlaceByTwoPoints]:
        """By the two known spots that are farthest apart."""
        for body in self._open():
            known = [spot for spot in self.spots[body] if self.known(spot)]
            pairs = [(p, q) for n, p in enumerate(known) for q in known[n + 1 :]]
            apart = max(pairs, key=lambda pair: self.shape.apart(*pair), default=None)
            if apart is not None and self.shape.apart(*apart) > TOUCHING:
                yield PlaceByTwoPoints(body, apart)

    def _to_line(self) -> Iterator[RotateToLine]:
        for c in self.constraints:
            if not isinstance(c, OnLine) or c.line.body in self.turned:
                continue
            pivot = self._pivot(c.line.body)
            if pivot is None:
                continue
            if self.known(c.spot):
                yield RotateToLine((c.line.body,), pivot, c.spot, c)
                continue
            aim = self._pivot(c.spot[0])
            if aim is not None and c.spot[0] not in self.turned and self._alike(c.line.body, c.spot[0]):
                yield RotateToLine((c.line.body, c.spot[0]), pivot, aim, c)

    def _pivot(self, body: int) -> Spot | None:
        return next((spot for spot in self.spots[body] if self.known(spot)), None)

    def _alike(self, a: int, b: int) -> bool:
        """Whether two bodies turn alike: the block of a slide and its guide."""
        return any(
            isinstance(c, Turning) and c.alike and self.ties[id(c)] == {a, b} for c in self.constraints
        )

    def _at_intersection(self) -> Iterator[PlaceAtIntersection]:
        """The spot whose two loci cross best; else one at which they touch and `near` tells the side."""
        best: tuple[float, PlaceAtIntersection] | None = None
        self.nearest = None
        for one, members in self.members.items():
            if one in self.located or any(spot[0] in self.full for spot in members):
                continue
            loci = list(self._loci(members))
            for n, first in enumerate(loci):
                for second in loci[n + 1 :]:
                    still, at = reference(self.shape, first), reference(self.shape, second)
                    found = crossing_sine(still, at, self.shape.still[one[1]])
                    if found <= TOUCHING and not self._told(one[1], still, at):
                        self.nearest = one[1]
                    elif best is None or found > best[0]:
                        best = (found, PlaceAtIntersection(one, (first, second)))
        if best is not None:
            yield best[1]

    def _told(self, name: str, one: PlacedLocus, two: PlacedLocus) -> bool:
        """Whether `near` tells to which side a point goes on at which two loci touch: it is roughly where the
        point lies, and what it is off by its digits, or along the line of both, is no side."""
        near = self.near.get(name)
        if near is None:
            return False
        off = math.dist(near, self.shape.still[name])
        return sideways(one, two, near) > max(ROUGH, SIDEWAYS * off)

    def _loci(self, members: list[Spot]) -> Iterator[By]:
        for spot in members:
            body = spot[0]
            pivot = max(
                (p for p in self.spots[body] if self.known(p)),
                key=lambda p: self.shape.apart(p, spot),
                default=None,
            )
            if pivot is not None and self.shape.apart(pivot, spot) > TOUCHING:
                yield Through(spot, pivot)
            for c in self.constraints:
                if id(c) not in self.used:
                    yield from self._through(spot, c)

    def _through(self, spot: Spot, c: Constraint) -> Iterator[ThroughTurned]:
        """The locus that a condition gives to a spot: of the spot itself, or of a body that has turned."""
        body, turned = spot[0], spot[0] in self.turned
        if isinstance(c, OnLine):
            if c.line.body in self.full and c.spot[0] == body and (turned or self._same(c.spot, spot)):
                yield ThroughTurned(spot, c, c.spot)
            elif c.line.body == body and turned and self.known(c.spot):
                yield ThroughTurned(spot, c, None)
        elif isinstance(c, SpotDistance):
            for mine, other in ((c.one, c.two), (c.two, c.one)):
                if mine[0] == body and self.known(other) and (turned or self._same(mine, spot)):
                    yield ThroughTurned(spot, c, mine)
        elif isinstance(c, Roped):
            ends = [s for s in dict.fromkeys(c.spots) if s[0] == body and (turned or self._same(s, spot))]
            yield from (ThroughTurned(spot, c, mine) for mine in ends if self._ropes(c, mine))
        elif isinstance(c, RolledStraight) and self.ties[id(c)] <= self.turned:
            if c.line.body in self.full and c.centre[0] == body:
                yield ThroughTurned(spot, c, c.centre)
            elif c.line.body == body and self.known(c.centre):
                yield ThroughTurned(spot, c, None)

    def _ropes(self, c: Roped, spot: Spot) -> bool:
        """Whether a rope ties a spot to one place, and all else about it is known."""
        wound = (body for body, _ in c.terms)
        others = (other for other in c.spots if other != spot)
        return c.tied_to(spot) is not None and all(map(self.known, others)) and self.turned.issuperset(wound)

    def _same(self, a: Spot, b: Spot) -> bool:
        return self.shape.one(a) == self.shape.one(b)


def touching(name: str) -> SceneError:
    """The refusal of a position as written in which a pin could go on in two ways."""
    return SceneError(
        Status.CHANGE_POINT,
        f"the position as written is a limit or a change point: at {name} the links are in line, and nothing "
        "says which way it goes on. Write the case in another position.",
    )
