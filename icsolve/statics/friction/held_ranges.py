"""The ranges of one unknown load in which friction within its limits holds.

A part in which guides press in given senses and the forces of pins point in given directions is one range of
loads, by linear inequalities (`pushing`), and all loads in it hold. A part in which these are open, or known
to lie within angles, holds every load that friction can hold so, and a little more: it is cut until all of it
lies in ranges that hold.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial

from icsolve.errors import SceneError
from icsolve.numbers import Scalar, Showing, largest_of
from icsolve.numbers.inequalities import Form, deepest, region
from icsolve.statics.friction import PROVEN
from icsolve.statics.friction.pushing import (
    ROUNDED,
    FrictionLimits,
    Pointing,
    ReducedLimits,
    RestingScene,
    at,
    every_flanks,
    limits_in_floats,
    limits_of,
    rows_of,
    sum_of,
    value_where,
    vanishes_where,
)
from icsolve.statics.power import Balance, Value
from icsolve.statics.reaction_basis import Position
from icsolve.tuples import NamedTuple

MOST_PARTS = 1000
"""So many parts are looked at at most."""
TURNS = 60
"""A pin's force is turned so often at most."""
NARROW = 2.0**-24
"""An angle is cut no further [rad]: to second order it says what its middle does."""
SAME = 1e-9
"""Ends that differ by less of their size are one."""
POINT = 2.0**-48
"""An inequality over its largest number keeps its sign but for so much."""
NEAR = 1e-7
"""What is left of an inequality, as a fraction of its terms, where it is an equation but for rounding."""
UNFINISHED = "what friction within its limits can hold was not looked at to the end: it may hold more"


class _End(NamedTuple):
    """An end of what a part leaves the load, and where that is: (w, x) of open variables x / w; with w = 0 it
    is without end in the direction x."""

    load: float
    point: tuple[float, ...]


class Vertex(NamedTuple):
    """An end of a range, the least load (``end`` is 0) or the most (1), and the part whose end it is."""

    end: int
    at: _End
    toward: tuple[Pointing | None, ...]
    search: _Search

    @property
    def parts(self) -> bool:
        """Whether a contact parts there: however joints share, it presses with nothing, and with something
        where the load is not yet at its end."""
        return math.isfinite(self.at.load) and self.search.is_lost(self)


class HeldRange(NamedTuple):
    """From what load to what load it holds, perhaps infinite, and what the two ends follow from."""

    low: float
    high: float
    vertices: tuple[Vertex, Vertex]


class HeldRanges(NamedTuple):
    """The ranges by rising value [case units], and whether these are all."""

    ranges: tuple[HeldRange, ...]
    complete: bool

    @property
    def how(self) -> str:
        """How it is known that no friction holds more."""
        return PROVEN if self.complete else UNFINISHED

    def nearest(self, load: float) -> tuple[HeldRange, tuple[tuple[float, float], ...]]:
        """The range that is nearest to a load, and from where to where the others go."""
        own = min(self.ranges, key=lambda one: max(one.low - load, load - one.high))
        return own, tuple([(one.low, one.high) for one in self.ranges if one is not own])


def held(scene: RestingScene, at: float | None = None) -> HeldRanges:
    """The ranges of the one unknown load in which friction within its limits holds; where it is asked only
    whether it holds ``at`` a load [case units], some that hold, with that in one of them if it does."""
    found, complete = list[HeldRange](), True
    for flanks in every_flanks(scene):
        limits = limits_in_floats(scene, flanks)
        search = _Search(limits, flanks)
        complete &= search.is_complete(None if at is None else at * limits.scale)
        unit = 1.0 / limits.scale
        found += [one._replace(low=one.low * unit, high=one.high * unit) for one in search.found]
    ranges = joined(joined(found), partial(_meet, scene))
    if len(ranges) > 1 and at is None:  # of one alone the ends are told as they are proven
        ranges = [_in_all_digits(scene, one) for one in ranges]
    return HeldRanges(tuple(ranges), complete)


def _in_all_digits(scene: RestingScene, one: HeldRange) -> HeldRange:
    """A range with its finite ends rounded once, where inequalities say them: doubles lose the digits of one
    that lies far out."""
    ends = [one.low, one.high]
    for n, vertex in enumerate(one.vertices):
        with suppress(SceneError):  # no digits settle it
            exact = exactly(scene, vertex) if math.isfinite(ends[n]) else None
            ends[n] = ends[n] if exact is None else exact.value
    return one._replace(low=ends[0], high=ends[1])


def _meet(scene: RestingScene, lower: HeldRange, upper: HeldRange) -> bool:
    """Whether two ranges that doubles leave apart meet in all digits."""
    ends = (lower.vertices[1], upper.vertices[0])
    one, other = (end.at.load for end in ends)
    if other - one > SAME * max(abs(one), abs(other), ends[0].search.unit):
        return False
    with suppress(SceneError):  # no digits settle it
        below, above = (exactly(scene, end) for end in ends)
        return below is not None and above is not None and below.value >= above.value
    return False


class _Search:
    """The search for the ranges [scaled]; ``found`` has those that hold."""

    def __init__(self, limits: FrictionLimits, flanks: Mapping[int, float]) -> None:
        assert limits.root is not None
        self.limits, self.flanks, self.reduced = limits, flanks, ReducedLimits(limits)
        self.load = self.reduced.form({limits.root: 1.0})
        self.unit = largest_of(self.load[1:])
        self.found: list[HeldRange] = []
        self.is_pin = [len(rub.forces) > 1 for rub in limits.rubs]

    def is_complete(self, at: float | None = None) -> bool:
        """Look at every part, or at those that have a load in them; whether all lie in ranges that hold."""
        if not self.reduced.balances:
            return True
        parts, sure = [self.limits.pushing], True
        for _ in range(MOST_PARTS):
            if not parts:
                return sure
            toward = parts.pop()
            ends = self.ends(toward)
            if ends is None or self.holds(ends) or _is_beside(at, ends):
                continue
            beyond = [end for end, one in enumerate(ends) if not self.holds((one, one))]
            for end in beyond or (0, 1):
                self.look(toward, ends, end)
            if self.holds(ends) or (at is not None and self.holds((_End(at, ()), _End(at, ())))):
                continue
            halves = list(self.cut(toward, [one.point for one in ends]))
            parts += halves
            sure &= bool(halves)
        return False

    def holds(self, ends: tuple[_End, _End]) -> bool:
        """Whether all between two ends is known to hold."""
        low, high = (one.load for one in ends)
        return any(
            one.low <= low + self.room(low) and high - self.room(high) <= one.high for one in self.found
        )

    def room(self, load: float) -> float:
        return SAME * max(abs(load), ROUNDED * self.unit) if math.isfinite(load) else 0.0

    def forms(self, toward: Sequence[Pointing | None]) -> list[Form]:
        """The inequalities of a part, each over its largest number, in the order of `rows_of`."""
        found = [form for form, *_ in self.reduced.rows(toward)]
        return [tuple([a / size for a in form]) if (size := largest_of(form)) else form for form in found]

    def ends(self, toward: Sequence[Pointing | None]) -> tuple[_End, _End] | None:
        """The least and the most that a part leaves the load; None where it is empty."""
        forms = [form for form in self.forms(toward) if any(form)]
        for room in (0.0, POINT):  # what is no more than a point may for rounding not even be that
            wider = [(form[0] + room, *form[1:]) for form in forms]
            least = self.end(wider, -1.0)
            most = None if least is None else self.end(wider, 1.0)
            if least is not None and most is not None:
                short = min([at(form, one.point) for form in forms for one in (least, most)], default=0.0)
                nothing = (1.0, *[0.0] * (len(self.load) - 1))
                return (
                    (least, most)
                    if short >= -ROUNDED or deepest([*forms, nothing]).depth >= -ROUNDED
                    else None
                )
        return None

    def end(self, forms: Sequence[Form], side: float) -> _End | None:
        """The most, or the least, that some inequalities leave the load; None where nothing."""
        counts, scale = [*[0.0] * len(forms), 1.0], self.unit or 2.0 * abs(self.load[0]) or 1.0
        ahead = [(0.0, *form[1:]) for form in forms]
        while True:
            aim = tuple([side * a / scale for a in self.load])
            depth, _, point, _ = deepest([*forms, aim], counts)
            if depth < 1.0:
                return None if math.isinf(depth) else _End(side * depth * scale, (1.0, *point))
            endless, _, way, _ = deepest([*ahead, (0.0, *aim[1:])], counts)
            if endless > 0.5 or scale * ROUNDED > self.unit:
                return _End(side * math.inf, (0.0, *way))
            scale *= 1e3

    def look(self, part: tuple[Pointing | None, ...], ends: tuple[_End, _End], end: int) -> None:
        """What holds where the forces that press point as at an end of a part, and turn on from there."""
        toward = self.reduced.toward(part, ends[end].point)
        inside = ends if toward == part else self.ends(toward)
        if inside is not None:
            low, high = (Vertex(n, one, toward, self) for n, one in enumerate(inside))
            low, high = (self.turned(low), high) if end == 0 else (low, self.turned(high))
            self.found = joined([*self.found, HeldRange(low.at.load, high.at.load, (low, high))])

    def turned(self, last: Vertex) -> Vertex:
        """An end with the forces of pins turned to where they lie there, until it goes no farther."""
        free = [None if pin else to for to, pin in zip(last.toward, self.is_pin, strict=True)]
        for _ in range(TURNS if None in free else 0):
            toward = self.reduced.toward(free, last.at.point)
            if (further := self.ends(toward)) is None:
                break
            ahead = further[last.end].load - last.at.load
            if not (ahead < 0.0 if last.end == 0 else ahead > 0.0):
                break
            last = last._replace(at=further[last.end], toward=toward)
        return last

    def cut(
        self, toward: tuple[Pointing | None, ...], points: Sequence[Sequence[float]]
    ) -> Iterator[tuple[Pointing | None, ...]]:
        """A part, cut by whereto the force points that bounds its friction least."""
        open_ = [k for k, to in enumerate(toward) if to is None or to.half > NARROW]
        spare = {(k, n): self.reduced.spare(k, point) for k in open_ for n, point in enumerate(points)}
        if spare:
            k, n = min(spare, key=lambda of: (min(spare[of], -ROUNDED), -_half(toward[of[0]])))
            for angle in self.reduced.cut(k, toward[k], points[n]):
                yield (*toward[:k], angle, *toward[k + 1 :])

    def equations(self, vertex: Vertex) -> tuple[frozenset[int], ...]:
        """Sets of inequalities, by their places, of each of which as equations an end follows: those that are
        equations there but for rounding."""
        forms = self.forms(vertex.toward)
        near = [n for n, form in enumerate(forms) if any(form) and _is_near(form, vertex.at.point)]
        by_load = self.by_load([forms[n] for n in near])
        sets = region(by_load).vertex(vertex.end) if by_load else (frozenset[int](),)
        return tuple(frozenset(near[n] for n in one) for one in sets)

    def is_lost(self, vertex: Vertex) -> bool:
        """Whether a contact that presses elsewhere in a part can't at an end of it."""
        forms, side = [form for form in self.forms(vertex.toward) if any(form)], (-1.0, 1.0)[vertex.end]
        scale = max(self.unit, abs(vertex.at.load)) or 1.0
        aim = [side * a / scale for a in self.load]
        beside = (aim[0] - side * vertex.at.load / scale + SAME, *aim[1:])
        for normal in map(self.reduced.form, self.limits.normals.values()):
            size = largest_of(normal)
            push = tuple([a / size for a in normal]) if size else normal
            if _most(push, [*forms, beside]) <= NEAR < _most(push, forms):
                return True
        return False

    def by_load(self, forms: Sequence[Form]) -> list[Form]:
        """Inequalities with the load, in its unit, as the first variable; none where it has one value."""
        if not self.unit:
            return []
        gone = max(range(1, len(self.load)), key=lambda j: abs(self.load[j]))
        base = [-a / self.load[gone] for a in self.load]
        found = []
        for form in forms:
            share = form[gone]
            rest = [sum_of((a, share * b)) for a, b in zip(form, base, strict=True)]
            found.append((rest[0], share * self.unit / self.load[gone], *rest[1:gone], *rest[gone + 1 :]))
        return found


def _is_beside(at: float | None, ends: tuple[_End, _End]) -> bool:
    """Whether a load, if any, lies not between two ends."""
    return at is not None and not ends[0].load <= at <= ends[1].load


def _most(form: Form, within: Sequence[Form]) -> float:
    """The most that inequalities leave a form, or 1 where that is more."""
    depth: float = deepest([*within, form], [*[0.0] * len(within), 1.0]).depth
    return depth


def _half(to: Pointing | None) -> float:
    return math.inf if to is None else to.half


def _is_near(form: Form, point: Sequence[float]) -> bool:
    """Whether an inequality is an equation at a point, but for rounding."""
    terms = [a * x for a, x in zip(form, point, strict=True)]
    return abs(sum(terms)) <= NEAR * largest_of(terms) + 8.0 * ROUNDED


def joined(
    found: Sequence[HeldRange], meet: Callable[[HeldRange, HeldRange], bool] | None = None
) -> list[HeldRange]:
    """The ranges that ``meet`` as one; without it those that do but for rounding."""
    meet = meet or _overlap
    joined: list[HeldRange] = []
    for one in sorted(found, key=lambda one: (one.low, one.high)):
        if joined and meet(joined[-1], one):
            last = joined[-1]
            if one.high > last.high:
                joined[-1] = last._replace(high=one.high, vertices=(last.vertices[0], one.vertices[1]))
        else:
            joined.append(one)
    return joined


def _overlap(lower: HeldRange, upper: HeldRange) -> bool:
    room = 2.0**-48 * largest_of([end for end in upper[:2] if math.isfinite(end)])
    return upper.low <= lower.high + room


def exactly(scene: RestingScene, vertex: Vertex) -> Value | None:
    """The load at an end, rounded once [case units]; None where no inequalities say it, or those of a pin do
    and its force has a direction there, which doubles alone know.

    Raises SceneError where no digits settle it.
    """
    search = vertex.search
    of, flanks, is_pin = search.equations(vertex), search.flanks, search.is_pin

    def rounded(position: Position, balance: Balance, a: Showing) -> Value | None:
        limits = limits_of(position, balance, flanks)
        assert limits.root is not None
        bounds, found = [*rows_of(limits, vertex.toward)], list[Scalar | None]()
        rows = [row for row, *_ in bounds]
        for one in map(sorted, of):
            pins = {k for *_, k in (bounds[n] for n in one) if k is not None and is_pin[k]}
            forces = [force for k in pins for force in limits.rubs[k].forces]
            if not all(vanishes_where(limits, rows, one, force, a) for force in forces):
                return None
            found.append(value_where(limits, rows, one, limits.root, a))
        loads = [load for load in found if load is not None]
        if not loads or len(loads) < len(found):
            return None
        return Value(*a.rounded((max, min)[vertex.end](loads, key=float) / limits.scale))

    return scene.ask(rounded) if of else None
