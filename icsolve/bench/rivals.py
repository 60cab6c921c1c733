"""The methods that are compared: each takes a drawn case and gives its unknown load."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, combinations, islice
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.assembly.workspace import Frame, PlacedCase
from icsolve.case import Case, Coordinates
from icsolve.numbers import FLOATS
from icsolve.scene.program import Program, Want, prepare
from icsolve.screws import Bases, Point, Triple, cross, pairing, times
from icsolve.screws.joints import freedoms, transmitted
from icsolve.solve import solve
from icsolve.statics import load_wrenches, power
from icsolve.structure import Topology
from icsolve.tuples import NamedTuple

Twists = Sequence[Triple]
"""Twist of every body relative to the frame."""


class Failed(Exception):
    """A method that has no answer for a scene."""


class OtherData(Exception):
    """A method for figures that are given in another way."""


class RivalFigure(NamedTuple):
    """A case to be solved by any method: its points as they were read; empty where lengths are given."""

    program: Program
    raw: dict[str, Point]

    @property
    def case(self) -> Case:
        """The case."""
        return self.program.case

    @property
    def top(self) -> Topology:
        """Its bodies and bonds."""
        return self.program.top


class Posed(NamedTuple):
    """Basis twists and unit wrenches in one frame."""

    top: Topology
    bases: Bases
    wrenches: tuple[load_wrenches.Wrench, ...]


def drawn(case: Case) -> RivalFigure:
    """A case by coordinates, or a four-bar by its lengths."""
    program = prepare(case, Want(centres=True))
    raw = {}
    for name, place in case.points.items():
        assert isinstance(place, Coordinates) and place.x is not None and place.y is not None
        raw[name] = (place.x.value, place.y.value)
    return RivalFigure(program, {} if case.lengths else raw)


def posed(scene: RivalFigure, normalised: bool = False) -> Posed:
    """The scene in raw coordinates, or moved to an input pin and scaled by a power of two."""
    ox, oy, scale = scene.program.figure.frame if normalised else (0.0, 0.0, 1.0)
    raw = scene.raw or by_cosines(scene.case)
    points = {name: ((x - ox) * scale, (y - oy) * scale) for name, (x, y) in raw.items()}
    bases = {k: freedoms(bond, points, FLOATS) for k, bond in enumerate(scene.top.bonds)}
    place = PlacedCase(scene.case, Frame(0.0, 0.0, scale), points, FLOATS)
    return Posed(scene.top, bases, load_wrenches.wrenches(place))


def _sides(case: Case) -> tuple[float, float, float, float, float]:
    """The sides AB, BC, CD, AD of a four-bar, and the crank's angle in radians."""
    a, b, c = (length.value.value for length in case.lengths)
    place = case.points["D"]
    assert isinstance(place, Coordinates) and place.x is not None
    return a, b, c, place.x.value, math.radians(case.angles[0].value.value)


def by_cosines(case: Case) -> dict[str, Point]:
    """The pins A, B, C, D of a four-bar from its lengths and the crank's angle, by the law of cosines."""
    a, b, c, d, angle = _sides(case)
    bx, by = a * math.cos(angle), a * math.sin(angle)
    apart = math.sqrt(a * a + d * d - 2.0 * a * d * math.cos(angle))
    turn = math.acos((b * b + apart * apart - c * c) / (2.0 * b * apart)) + math.atan2(-by, d - bx)
    return {
        "A": (0.0, 0.0),
        "B": (bx, by),
        "C": (bx + b * math.cos(turn), by + b * math.sin(turn)),
        "D": (d, 0.0),
    }


def balanced(pose: Posed, twists: Twists) -> float:
    """The unknown load from the sum of power, without any test."""
    of_link = {link: (twists[body],) for link, body in pose.top.body_of.items()}
    factors = power.balance(pose.wrenches, of_link, 1).factors[0]
    known = factor = measure = 0.0
    for w, value in zip(pose.wrenches, factors, strict=True):
        number = power.known_value(w)
        if number is None:
            factor, measure = factor + value, w.measure
        else:
            known += number * value * w.measure
    return -known / factor / measure


Pair = tuple[int, int]


def closed(scene: RivalFigure, algebra: Algebra, normalised: bool) -> float:
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
        both = cross(p, q)
        return times(1.0 / math.sqrt(pairing(both, both)), both)

    meet = line = join

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


Algebra = Homogeneous | Cartesian
"""How points and lines are written."""
Matrix = npt.NDArray[np.float64]


def by_svd(scene: RivalFigure) -> float:
    """Twists as the last right singular vector of the joints' conditions."""
    pose = posed(scene)
    return balanced(pose, _twists(pose, np.linalg.svd(_conditions(pose))[2][-1]))


def by_lu(scene: RivalFigure) -> float:
    """Twists by LU with the rate of one joint at the frame fixed to 1."""
    pose = posed(scene)
    rows = _conditions(pose)
    top = pose.top
    if rows.shape[0] + 1 != rows.shape[1]:
        raise Failed("not as many conditions as unknowns")
    k = next(k for k in top.at[top.ground] if top.bonds[k].freedom == 1)
    basis, body = pose.bases[k][0], top.bonds[k].other(top.ground)
    drive = np.zeros(rows.shape[1])
    place = _columns(pose)[body]
    drive[place : place + 3] = (0.0, 0.0, 1.0) if basis[2] else basis
    right = np.zeros(rows.shape[1])
    right[-1] = 1.0
    return balanced(pose, _twists(pose, _solved(np.vstack([rows, drive]), right)))


def by_free_bodies(scene: RivalFigure) -> float:
    """The wrenches of all joints and the unknown load from the equilibrium of every body, by LU."""
    pose = posed(scene)
    rows, columns = _conditions(pose), _columns(pose)
    known, unknown, measure = np.zeros(rows.shape[1]), np.zeros(rows.shape[1]), 1.0
    for w in pose.wrenches:
        number = power.known_value(w)
        for link, sign in ((w.load.link, 1.0), (w.against, -1.0)):
            place = columns.get(pose.top.body_of[link])
            if place is None:
                continue
            wrench = sign * w.gain * np.array(w.unit)
            if number is None:
                unknown[place : place + 3] += wrench
            else:
                known[place : place + 3] += wrench * number * w.measure
        measure = w.measure if number is None else measure
    matrix = np.column_stack([rows.T, unknown])
    if matrix.shape[0] != matrix.shape[1]:
        raise Failed("not as many equations as unknowns")
    return float(_solved(matrix, -known)[-1]) / measure


def by_newton(scene: RivalFigure) -> float:
    """The pins of a four-bar from its lengths by Newton's method, started at ``near``; then SVD."""
    if scene.raw:
        raise OtherData("only for figures that are given by lengths")
    return by_svd(scene._replace(raw=_assembled(scene.case)))


def _solved(matrix: Matrix, right: Matrix) -> Matrix:
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise Failed("a singular matrix") from None


def _columns(pose: Posed) -> dict[int, int]:
    """The first column of every moving body."""
    moving = [body for body in range(len(pose.top.members)) if body != pose.top.ground]
    return {body: 3 * n for n, body in enumerate(moving)}


def _conditions(pose: Posed) -> Matrix:
    """A row a wrench that a joint transmits, three columns a moving body."""
    columns = _columns(pose)
    rows = []
    for k, bond in enumerate(pose.top.bonds):
        for wrench in transmitted(pose.bases[k]):
            row = np.zeros(3 * len(columns))
            for body, sign in ((bond.a, -1.0), (bond.b, 1.0)):
                if body in columns:
                    row[columns[body] : columns[body] + 3] = sign * np.array(wrench)
            rows.append(row)
    return np.array(rows)


def _twists(pose: Posed, vector: Matrix) -> list[Triple]:
    columns = _columns(pose)
    result: list[Triple] = [(0.0, 0.0, 0.0)] * len(pose.top.members)
    for body, k in columns.items():
        result[body] = (float(vector[k]), float(vector[k + 1]), float(vector[k + 2]))
    return result


MOST_STEPS = 50


def _assembled(case: Case) -> dict[str, Point]:
    """The pin C at the distances b from B and c from D; A, B and D follow from what is given."""
    a, b, c, d, angle = _sides(case)
    crank, pivot = np.array([a * math.cos(angle), a * math.sin(angle)]), np.array([d, 0.0])
    rod = np.array(case.near["C"])
    for _ in range(MOST_STEPS):
        arms = np.array([rod - crank, rod - pivot])
        off = np.hypot(arms[:, 0], arms[:, 1]) - (b, c)
        step = _solved(arms / np.hypot(arms[:, 0], arms[:, 1])[:, None], off)
        rod = rod - step
        if np.abs(step).max() <= 1e-16 * (b + c):
            break
    pins = {"A": np.zeros(2), "B": crank, "C": rod, "D": pivot}
    return {name: (float(x), float(y)) for name, (x, y) in pins.items()}


class Method(NamedTuple):
    """A method by its name in tables and pictures."""

    name: str
    run: Callable[[RivalFigure], float]
    as_written: bool = False
    """whether it answers for the decimals of the file; the others for the doubles nearest to them"""


OWN = ("icsolve", "icsolve with bound")
"""The names of our own, the one with bounds last."""

METHODS: tuple[Method, ...] = (
    Method(OWN[0], lambda scene: solve(scene.case, bound=False).answers["U"].value),
    Method(OWN[1], lambda scene: solve(scene.case).answers["U"].value, as_written=True),
    Method("slope and intercept", lambda scene: closed(scene, Cartesian(), False)),
    Method("homogeneous, raw", lambda scene: closed(scene, Homogeneous(), False)),
    Method("homogeneous, normalised", lambda scene: closed(scene, Homogeneous(), True)),
    Method("SVD null space", by_svd),
    Method("LU, input fixed", by_lu),
    Method("free bodies, LU", by_free_bodies),
    Method("Newton and SVD", by_newton),
)
