"""Random figures from which the data are read off: every kind of datum, in any order of mention."""

from __future__ import annotations

import math
from random import Random

import numpy as np

from icsolve.case import (
    Case,
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Guide,
    Length,
    Number,
    Pin,
    Slot,
)

Place = tuple[float, float]


def bearing(a: Place, b: Place) -> float:
    """Direction from a to b in degrees."""
    return math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))


class Draft:
    """Points that are known, and the data read off them so far; no two data say the same."""

    def __init__(self, seed: int, count: int) -> None:
        self.rng = Random(seed)
        self.names = [f"P{k}" for k in range(count)]
        self.at: dict[str, Place] = {
            p: (self.rng.uniform(-3, 3), self.rng.uniform(-3, 3)) for p in self.names
        }
        self.points: dict[str, Coordinates | Centroid] = {}
        self.lengths: list[Length] = []
        self.angles: list[Direction | Corner] = []
        self.joints: list[Pin | Slot] = []
        self.near: dict[str, Place] = {}
        self.said: set[object] = set()

    def number(self, value: float, path: str) -> Number:
        """A number with all its digits."""
        return Number(value, 0.0, path, repr(value))

    def say(self, *what: object) -> bool:
        """Whether it was not said before."""
        fresh = what not in self.said
        self.said.add(what)
        return fresh

    def coordinates(self, p: str, x: bool = True, y: bool = True) -> bool:
        """Coordinates, or one of them."""
        if p in self.points:
            return False
        u, v = self.at[p]
        self.points[p] = Coordinates(
            self.number(u, f"points.{p}.x") if x else None, self.number(v, f"points.{p}.y") if y else None
        )
        return True

    def mean(self, p: str, of: list[str]) -> None:
        """Move a point to the centroid of others."""
        u, v = (sum(self.at[q][k] for q in of) / len(of) for k in (0, 1))
        self.at[p] = (u, v)
        self.points[p] = Centroid(tuple(of))

    def length(self, a: str, b: str) -> bool:
        """A length, named either way about."""
        if not self.say("length", frozenset((a, b))):
            return False
        a, b = self.rng.sample([a, b], 2)
        self.lengths.append(Length(a, b, self.number(math.dist(self.at[a], self.at[b]), f"lengths.{a}-{b}")))
        return True

    def ray(self, a: str, b: str) -> bool:
        """A direction, in any turn."""
        if not self.say("sight", a, b):
            return False
        a, b = self.rng.sample([a, b], 2)
        value = bearing(self.at[a], self.at[b]) + self.rng.choice((0, 0, 360, -360))
        self.angles.append(Direction(a, b, self.number(value, f"angles.{a}-{b}")))
        return True

    def corner(self, a: str, at: str, b: str) -> bool:
        """An angle at a point, from either arm."""
        if not self.say("corner", frozenset((a, b)), at):
            return False
        a, b = self.rng.sample([a, b], 2)
        value = bearing(self.at[at], self.at[b]) - bearing(self.at[at], self.at[a])
        self.angles.append(Corner(a, at, b, self.number(value, f"angles.{a}-{at}-{b}")))
        return True

    def guide(self, at: str, through: str) -> bool:
        """A guide line by its direction, modulo 180."""
        if not self.say("sight", through, at):
            return False
        value = bearing(self.at[at], self.at[through]) + self.rng.choice((0, 180))
        angle = self.number(value, f"joints.{len(self.joints)}.along")
        self.joints.append(Slot(("2", "3"), at, Guide(angle, None, through)))
        return True

    def approximately(self, p: str, off: float) -> None:
        """`near` for a point."""
        (x, y), r = self.at[p], self.rng
        self.near[p] = (x + r.uniform(-off, off), y + r.uniform(-off, off))

    def case(self) -> Case:
        """The case, its data in any order."""
        for data in (self.lengths, self.angles, self.joints):
            self.rng.shuffle(data)
        points = list(self.points.items())
        self.rng.shuffle(points)
        return Case(
            points=dict(points), lengths=tuple(self.lengths), angles=tuple(self.angles),
            joints=tuple(self.joints), near=self.near,
        )  # fmt: skip


def sequence(seed: int, count: int = 9) -> Draft:
    """Each point by two data that bind it to points before it."""
    draft = Draft(seed, count)
    rng = draft.rng
    for i, p in enumerate(draft.names):
        before = draft.names[:i]
        if i < 2 or rng.random() < 0.1:
            draft.coordinates(p)
        elif i > 4 and rng.random() < 0.1:
            draft.mean(p, rng.sample(before, 3))
        else:
            bound = 0
            while bound < 2:
                bound += _bind(draft, p, before)
            draft.approximately(p, 0.02)
    return draft


def _bind(draft: Draft, p: str, before: list[str]) -> bool:
    """One more datum for a point, of any kind, that does not follow from those it has."""
    rng = draft.rng
    kind, (q, other) = rng.choice("llllrrccaagxy"), rng.sample(before, 2)
    if kind == "l":
        return draft.length(q, p)
    if kind == "r":
        return draft.ray(q, p)
    if kind == "c":
        return draft.say("sight", q, p) and draft.corner(other, q, p)
    if kind == "a":
        return draft.corner(q, p, other)
    if kind == "g":
        return draft.guide(p, q)
    return draft.coordinates(p, x=kind == "x", y=kind == "y")


def framework(seed: int, count: int, split: float, corners: float) -> Draft:
    """A framework of bars that is just rigid (Henneberg 1911).

    Each point joins two others; or, with probability ``split``, takes the place of a bar and joins
    a third, which may leave no order of construction. Triangles lose a bar to the corner that faces it
    with probability ``corners``.
    """
    draft = Draft(seed, count)
    _with_corners(draft, _henneberg(draft, split), corners)
    return draft


def _henneberg(draft: Draft, split: float) -> set[frozenset[str]]:
    """The bars of a framework, the first two points on the ground, the others with a `near`."""
    rng = draft.rng
    bars: set[frozenset[str]] = set()
    for i, p in enumerate(draft.names):
        if i < 2:
            draft.coordinates(p)
            continue
        before = draft.names[:i]
        if bars and rng.random() < split:
            bar = rng.choice(sorted(bars, key=sorted))
            bars.remove(bar)
            ends = [*sorted(bar), rng.choice([q for q in before if q not in bar])]
        else:
            ends = rng.sample(before, 2)
        bars |= {frozenset((q, p)) for q in ends}
        draft.approximately(p, 0.02)
    return bars


Aligned = tuple[str, str, str]
"""A point, and the two between which it lies."""


def aligned(seed: int, count: int) -> Draft | None:
    """A framework some of whose points lie between two others instead of having one of their bars: by a slot
    along those two, or by an angle of 180 degrees. None where that leaves it loose.
    """
    draft = Draft(seed, count)
    rng, at = draft.rng, draft.at
    bars = _henneberg(draft, 0.9)
    lines: list[Aligned] = []
    still = set(draft.names[:2])
    for p in draft.names[2:]:
        held = sorted((bar for bar in bars if p in bar), key=sorted)
        ends = [q for q in draft.names if q != p]
        if p not in still and len(held) > 2 and rng.random() < 0.7:
            a, b = rng.sample(ends, 2)
            share = rng.uniform(0.3, 0.7)
            at[p] = tuple(share * u + (1.0 - share) * v for u, v in zip(at[a], at[b], strict=True))
            draft.approximately(p, 0.02)
            bars.remove(rng.choice(held))
            lines.append((p, a, b))
            still |= {p, a, b}
    if not lines or _loose(draft, bars, lines):
        return None
    for p, a, b in lines:
        if rng.random() < 0.5:
            draft.joints.append(Slot(("2", "3"), p, Guide(None, (a, b), a)))
        else:
            draft.angles.append(Corner(a, p, b, draft.number(180.0, f"angles.{a}-{p}-{b}")))
    for a, b in sorted(sorted(bar) for bar in bars):
        draft.length(a, b)
    return draft


def _loose(draft: Draft, bars: set[frozenset[str]], lines: list[Aligned]) -> bool:
    """Whether the points can move, or nearly, where bars keep their lengths and lines pass through points."""
    at, free = draft.at, draft.names[2:]
    slopes = []
    for bar in bars:
        a, b = bar
        along = (at[a][0] - at[b][0], at[a][1] - at[b][1])
        slopes.append({a: along, b: (-along[0], -along[1])})
    for p, a, b in lines:
        across = (at[a][1] - at[b][1], at[b][0] - at[a][0])
        share = math.dist(at[p], at[b]) / math.dist(at[a], at[b])
        parts = ((p, 1.0), (a, -share), (b, share - 1.0))
        slopes.append({q: (part * across[0], part * across[1]) for q, part in parts})
    rows = [[slope.get(p, (0.0, 0.0))[k] for p in free for k in (0, 1)] for slope in slopes]
    return len(rows) != 2 * len(free) or bool(np.linalg.svd(np.array(rows), compute_uv=False)[-1] < 0.05)


def block_on_a_bent_link(seed: int) -> Draft | None:
    """A block PQ whose angle is told from its guide AG, of a link that is drawn about its third point C: no
    length names A and G. Three bars tie both to the ground, one the block to the link. None where that
    leaves them loose.
    """
    draft = Draft(seed, 8)
    rng, at = draft.rng, draft.at
    ground, (p, q, a, g, c) = draft.names[:3], draft.names[3:]
    share = rng.uniform(-0.5, 1.5)
    at[p] = tuple((1.0 - share) * u + share * v for u, v in zip(at[a], at[g], strict=True))
    for name in ground:
        draft.coordinates(name)
    for name in (p, q, a, g, c):
        draft.approximately(name, 0.02)
    draft.joints.append(Slot(("2", "3"), p, Guide(None, (a, g), a)))
    draft.corner(g, p, q)
    draft.corner(a, c, g)
    ties = zip(ground, rng.sample([p, q, a, g, c], 3), strict=True)
    for pair in ((p, q), (c, a), (c, g), rng.choice([(q, a), (q, c), (p, c)]), *ties):
        draft.length(*pair)
    return draft if _stiffness(draft, [p, q, a, g, c]) > 0.05 else None


def _stiffness(draft: Draft, free: list[str]) -> float:
    """The least change of lengths, angles and distances from guides when the free points move by one."""

    def measured(step: float, moved: tuple[str, int]) -> list[float]:
        at = {p: np.array(xy) + [step * ((p, k) == moved) for k in (0, 1)] for p, xy in draft.at.items()}
        values = [math.dist(at[one.a], at[one.b]) for one in draft.lengths]
        for corner in draft.angles:
            assert isinstance(corner, Corner)
            u, v = at[corner.a] - at[corner.at], at[corner.b] - at[corner.at]
            values.append(math.atan2(u[0] * v[1] - u[1] * v[0], u @ v))
        for joint in draft.joints:
            assert isinstance(joint, Slot) and joint.guide.ends is not None
            start, end = (at[p] for p in joint.guide.ends)
            across = np.array([start[1] - end[1], end[0] - start[0]]) / math.dist(start, end)
            values.append(across @ (at[str(joint.at)] - start))
        return values

    columns = [(p, k) for p in free for k in (0, 1)]
    slopes = [np.subtract(measured(1e-6, moved), measured(-1e-6, moved)) / 2e-6 for moved in columns]
    return float(np.linalg.svd(np.array(slopes), compute_uv=False)[-1])


def _with_corners(draft: Draft, bars: set[frozenset[str]], share: float) -> None:
    arms: set[frozenset[str]] = set()
    for a in draft.names:
        for b in draft.names:
            for at in draft.names:
                sides = {frozenset(pair) for pair in ((a, b), (a, at), (b, at))}
                if a < b and sides <= bars and not sides & arms and draft.rng.random() < share:
                    bars.discard(frozenset((a, b)))
                    arms |= sides
                    draft.corner(a, at, b)
    for a, b in sorted(sorted(bar) for bar in bars):
        draft.length(a, b)


def straight_plates(seed: int, count: int) -> Draft:
    """Straight ternary links by three lengths each, in a ring: each on two rods from the ground and one from
    the next link, so that none has a place without the others."""
    draft = Draft(seed, 0)
    rng = draft.rng

    def put(name: str, at: Place) -> str:
        draft.names.append(name)
        draft.at[name] = at
        return name

    plates: list[list[str]] = []
    for i in range(count):
        (x, y), turn = (rng.uniform(-3, 3), rng.uniform(-3, 3)), rng.uniform(0.0, 2.0 * math.pi)
        whole = round(rng.uniform(1, 3), 2)
        along = round(rng.uniform(0.2, whole - 0.2) if rng.random() < 0.6 else -rng.uniform(0.3, 1.5), 2)
        steps = (("P", 0.0), ("Q", whole), ("R", along))
        plates.append([put(f"{n}{i}", (x + d * math.cos(turn), y + d * math.sin(turn))) for n, d in steps])
        p, q, r = plates[-1]
        for a, b, size in ((p, q, whole), (p, r, abs(along)), (r, q, round(abs(whole - along), 2))):
            draft.lengths.append(Length(a, b, draft.number(size, f"lengths.{a}-{b}")))
    used = [rng.sample(plate, 3) for plate in plates]
    for i, (one, two, three) in enumerate(used):
        for end in (one, two):
            ground = put(f"G{len(draft.names)}", (rng.uniform(-5, 5), rng.uniform(-5, 5)))
            draft.coordinates(ground)
            draft.length(ground, end)
        draft.length(used[(i + 1) % count][i % 2], three)
    for p in (p for plate in plates for p in plate):
        draft.approximately(p, 0.001)
    return draft
