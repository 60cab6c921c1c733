"""Positions of equilibrium of mechanisms with points that only all together have places.

The unknown datum drives the mechanism from each way in which it assembles; where a torque that would hold it
vanishes, the loads balance (the principle of virtual work). No enclosure shows that none is missing: what was
searched is said.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from icsolve.answer import Answer
from icsolve.answer.equilibrium import Stiffness
from icsolve.assembly.ways import ways_of
from icsolve.case import Case, Coordinates, Direction, Number, Torque, is_angle, is_named
from icsolve.errors import SceneError, Status
from icsolve.numbers import RADIAN
from icsolve.numbers.decimals import as_written
from icsolve.numbers.replay import Array, Code
from icsolve.scene import solve_scene
from icsolve.solve.load_function import bearers, given_at, nearest
from icsolve.solve.rest_position import AT_LIMIT, PROBE, RestPosition
from icsolve.sweep.find_by_scenes import Query
from icsolve.sweep.find_on_record import RangeSearch
from icsolve.sweep.program import RowRequest
from icsolve.sweep.request import columns_of
from icsolve.sweep.row_parts import SweepParts
from icsolve.sweep.starting_position import start_of
from icsolve.sweep.varied_numbers import points_of
from icsolve.tuples import replace
from icsolve.wording import sentences

STARTS = (0.5, 0.1, 0.9, 0.3, 0.7, 0.02, 0.98)
"""Where in the range the ways of assembling are sought."""
SAMPLES = 181
ROUNDS = 4
SAME = 1e-6
MOST_WORK = 400
"""So many mechanisms are driven at most, times the square of how many links they have."""
NOT_ALL = "the ways in which the figure assembles are not shown to be all."
UNPROVEN = "beside what was balanced no bound of its error is proven."


class DrivenMechanism:
    """A mechanism driven from the position as written over a range of a datum, or of a link's turning
    (degrees).

    Raises SceneError where nothing turns in it, or it can't be driven so.
    """

    def __init__(self, case: Case, along: str, span: tuple[float, float]) -> None:
        self.case, self.along, self.span = replace(case, motion=(), expect=(), unknowns=()), along, span
        rates = solve_scene(self.case, rates=True).rates or {}
        turning = {link: abs(rate) for link, rate in rates.items() if isinstance(rate, float) and rate}
        if not turning:
            said = "no link turns, and points of this mechanism can only all together be placed as it moves. "
            said += "Take a coordinate or a length that poses the figure, where there is one."
            raise SceneError(Status.UNSUPPORTED, said)
        self.links = sorted(turning, key=lambda link: (link != along, -turning[link]))
        loaded = replace(self.case, loads=(*self.case.loads, Torque(PROBE, self.links[0], None)))
        varied = {along: np.array(span)}
        columns = columns_of(loaded, *((None, varied) if along in case.links else (varied, None)))
        parts = SweepParts(start_of(loaded, columns, RowRequest()), columns)
        self.search = RangeSearch(parts, parts.whole(), along, Query("value", PROBE))

    def places(self, values: Array) -> tuple[list[str], Array]:
        """The points that are named, and where they are: (values, points, 2), not numbers where the links
        do not assemble."""
        compiled, record = self.search.compiled, self.search.record
        named = {name: at for name, at in compiled.scene.points.items() if is_named(name)}
        given, good = self.search.along.floats(self.along, values)
        nodes = [record.lifted(v).index for at in named.values() for v in at]
        found = [np.broadcast_to(v, len(values)) for v in Code(record, nodes).run(given, len(values))]
        ox, oy, scale = compiled.scene.frame
        at = np.stack(found, axis=1).reshape(len(values), -1, 2) / scale + (ox, oy)
        return list(named), np.where(good[:, None, None], at, np.nan)

    def passes(self, value: float, points: dict[str, tuple[float, float]]) -> bool:
        """Whether it comes through a position."""
        names, at = self.places(np.array([value]))
        wanted = np.array([points.get(name, (np.nan, np.nan)) for name in names])
        size = np.nanmax(np.abs(wanted), initial=1.0)
        off = np.abs(at[0] - wanted)[~np.isnan(wanted)]
        return bool(np.all(off <= SAME * size))

    def off(self, near: dict[str, tuple[float, float]]) -> float:
        """How near it comes to `near`: sampled, then closed in on."""
        low, high = self.span
        best = (math.inf, low)
        for _ in range(ROUNDS):
            values = np.linspace(low, high, SAMPLES)
            names, at = self.places(values)
            square = np.zeros(len(at))
            for n, name in enumerate(names):
                if name in near:
                    square += np.sum((at[:, n] - np.array(near[name])) ** 2, axis=1)
            square = np.where(np.isnan(square), np.inf, square)
            k = int(np.argmin(square))
            best = min(best, (float(square[k]), float(values[k])))
            step = (high - low) / (SAMPLES - 1)
            low, high = max(best[1] - step, self.span[0]), min(best[1] + step, self.span[1])
        return math.sqrt(best[0])

    def scene(self, value: float) -> Case:
        """The case in a position."""
        case = self.search.scene(as_written(value))
        bare = tuple(load for load in case.loads if load.name != PROBE)
        return replace(case, loads=bare, near={}, motion=(), expect=())

    def balances_everywhere(self) -> bool:
        """Whether the loads balance in every position."""
        at = [self.span[0] + part * (self.span[1] - self.span[0]) for part in STARTS]
        found = [torque for value in at if not math.isnan(torque := self.search.answer(as_written(value))[0])]
        return bool(found) and all(abs(torque) <= 1e-30 for torque in found)

    def rests(self) -> list[RestPosition]:
        """The positions in which the loads balance."""
        return [self.described(spot.at, spot.error + 4.0 * math.ulp(spot.at)) for spot in self.search.found()]

    def described(self, value: float, error: float) -> RestPosition:
        """A position with its stiffness: the derivative of the torque that holds it, by the record in many
        digits, times the square of the rates' ratio (once for the torque, once for the datum)."""
        case = self.scene(value)
        answer = solve_scene(case, rates=True)
        rate = rate_of(answer, self.along) / float((answer.rates or {})[self.links[0]])
        if not rate:
            return RestPosition(
                value, error, "neutral", None, AT_LIMIT, answer, case, self.links, self._size()
            )
        turns = is_angle(self.along) or self.along in case.links
        units = case.units
        _, slope = self.search.answer(as_written(value))
        stiffness = slope / rate * (1.0 / RADIAN if turns else 1.0 / units.torque_per_force_length)
        size = abs(self._size() / rate**2) * (1.0 if turns else 1.0 / units.torque_per_force_length)
        kind = "neutral" if abs(stiffness) <= 1e-12 * size else "stable" if stiffness > 0.0 else "unstable"
        unit = f"{units.torque}/rad" if turns else f"{units.force}/{units.length}"
        return RestPosition(
            value,
            error,
            kind,
            Stiffness(stiffness, unit, None),
            UNPROVEN,
            answer,
            case,
            self.links,
            self._size(),
        )

    def load(self, value: float) -> float:
        """The size of the generalised load at a value, infinite where the links do not assemble."""
        try:
            answer = solve_scene(self.scene(value), rates=True)
            rate = rate_of(answer, self.along) / float((answer.rates or {})[self.links[0]])
        except SceneError:
            return math.inf
        return abs(self.search.answer(as_written(value))[0] / rate) if rate else math.inf

    def _size(self) -> float:
        """The torque of the largest load at the size of the figure [case units]."""
        scene = self.search.compiled.scene
        numbers = [getattr(load, "value", None) for load in self.case.loads]
        largest = max((abs(n.value) for n in numbers if n is not None and hasattr(n, "value")), default=1.0)
        return float(largest) / scene.frame.scale * self.case.units.torque_per_force_length


def rate_of(answer: Answer, along: str) -> float:
    """The rate of a datum, or of a link, in the motion of a solved scene [case units, rad]."""
    rates, at = answer.rates or {}, answer.points
    if along in rates:
        return float(rates[along])
    points = points_of(along)
    velocities = answer.velocities or {}
    paces = {name: velocities.get((name, link)) for name, (link, *_) in bearers(answer.case).items()}
    moving = {name: v for name, v in paces.items() if isinstance(v, tuple)}
    v = {p: np.array(moving.get(p, (0.0, 0.0)), dtype=float) for p in points}
    if along.startswith("points."):
        return float(v[points[0]]["xy".index(along[-1])])
    *first, corner, last = points
    arms = [(np.subtract(at[p], at[corner]), v[p] - v[corner]) for p in (last, *first)]
    if along.startswith("lengths."):
        ((d, w),) = arms
        return float(d @ w / math.hypot(*d))
    turned = [float((d[0] * w[1] - d[1] * w[0]) / (d @ d)) for d, w in arms]
    return turned[0] - sum(turned[1:])


def value_of(answer: Answer, path: str) -> float:
    """The value of a datum in a solved scene [case units, degrees]."""
    at = [answer.points[name] for name in points_of(path)]
    if path.startswith("points."):
        return float(at[0]["xy".index(path[-1])])
    *first, corner, last = at
    if path.startswith("lengths."):
        return math.dist(corner, last)
    heads = [math.degrees(math.atan2(y - corner[1], x - corner[0])) for x, y in (last, *first)]
    return heads[0] - sum(heads[1:])


def without(case: Case, path: str) -> Case:
    """The case with nothing in place of the datum at ``path``."""
    section, name, *part = path.split(".")
    lengths = tuple(one for one in case.lengths if one.value.path != path)
    angles = tuple(one for one in case.angles if one.value.path != path)
    points = dict(case.points)
    at = points.get(name)
    if section == "points" and isinstance(at, Coordinates):
        points[name] = at._replace(x=None) if part == ["x"] else at._replace(y=None)
    return replace(case, points=points, lengths=lengths, angles=angles)


def exchanged(case: Case, path: str) -> Iterator[tuple[Case, str]]:
    """The case with another datum in place of the one at ``path``, directions of lengths one after the other,
    each with its path: with some of them the points may have places one by one.
    """
    bare = without(case, path)
    points = bare.points
    known = {one.value.path for one in case.angles}
    for length in bare.lengths:
        a, b = (length.a, length.b) if length.a in points else (length.b, length.a)
        other = f"angles.{a}-{b}"
        if a in points and b not in points and not known & {other, f"angles.{a}{b}"}:
            turned = Direction(a, b, Number(0.0, 0.0, other, "0"))
            yield replace(bare, angles=(*bare.angles, turned), near={}), other


def converted(
    rests: Sequence[RestPosition], path: str, span: tuple[float, float], other: str
) -> list[RestPosition]:
    """Positions that were found by another datum, by the one at ``path``: those whose values lie in a range.

    The stiffness is the other's times the square of the ratio of the rates.
    """
    found = []
    turns = is_angle(path)
    for rest in rests:
        if not rest.answer.points.keys() >= {*points_of(path)}:
            raise SceneError(Status.UNSUPPORTED, sentences.poses_nothing(path))
        own, by = rate_of(rest.answer, path), rate_of(rest.answer, other)
        value = value_of(rest.answer, path)
        size = max(abs(c) for at in rest.answer.points.values() for c in at)
        named = [rest.answer.points[name] for name in points_of(path)]
        arm = min((math.dist(a, b) for a, b in pairwise(named)), default=1.0)
        moved = abs(rest.error * own / by) * (1.0 if turns else RADIAN) if by else 0.0
        error = (
            moved + 8.0 * math.ulp(size) * (1.0 / (arm * RADIAN) if turns else 1.0) + 2.0 * math.ulp(value)
        )
        stiffness, why = None, AT_LIMIT
        if rest.stiffness is not None and own:
            unit = rest.stiffness.unit if turns else f"{rest.case.units.force}/{rest.case.units.length}"
            per = 1.0 if turns else 1.0 / rest.case.units.torque_per_force_length
            stiffness, why = Stiffness(rest.stiffness.value * (by / own) ** 2 * per, unit, None), UNPROVEN
        first = math.ceil((span[0] - error - value) / 360.0) if turns else 0
        for whole in range(first, first + 1 + int((span[1] - span[0]) // 360.0)):
            there = value + 360.0 * whole
            if span[0] - error <= there <= span[1] + error:
                there = min(max(there, span[0]), span[1])
                found.append(rest._replace(value=there, error=error, stiffness=stiffness, why=why))
    return found


def driven_mechanisms(
    case: Case, path: str, span: tuple[float, float], start: float | None, known: Sequence[RestPosition]
) -> tuple[list[DrivenMechanism], bool]:
    """The mechanism in each way in which it assembles at some values of a datum and in known positions, or in
    that which `near` means; whether these are all there.

    Raises SceneError where it assembles at none, or two are about equally near.
    """
    low, high = span
    found: list[DrivenMechanism] = []
    complete, refusal, most = True, None, max(2, MOST_WORK // len(case.links) ** 2)
    for value in [low + part * (high - low) for part in STARTS] if start is None else [start]:
        written = given_at(case, path, value)
        try:
            ways = ways_of(written)
        except SceneError as error:
            refusal = error
            continue
        complete = complete and ways.complete
        for way in ways.ways:
            if not any(one.passes(value, way.points) for one in found):
                if len(found) >= most:
                    return _meant(case, found), False
                found.append(DrivenMechanism(replace(written, near=way.near), path, span))
    for rest in known:
        if not any(one.passes(rest.value, dict(rest.answer.points)) for one in found):
            near = {name: at for name, at in rest.answer.points.items() if name not in case.points}
            found.append(DrivenMechanism(replace(given_at(case, path, rest.value), near=near), path, span))
    if not found:
        raise refusal or SceneError(Status.CANNOT_ASSEMBLE, f"the figure assembles for no {path} searched.")
    return _meant(case, found), complete


def _meant(case: Case, found: list[DrivenMechanism]) -> list[DrivenMechanism]:
    return [found[nearest(case, [one.off(case.near) for one in found])]] if case.near else found


def nearest_of(driven: Sequence[DrivenMechanism]) -> float | None:
    """Where the generalised load is smallest: sampled, then closed in on."""
    best = (math.inf, math.nan)
    for one in driven:
        step = (one.span[1] - one.span[0]) / 72
        values = np.linspace(*one.span, 73).tolist()
        for _ in range(9):
            best = min([best, *((one.load(value), value) for value in values)])
            values = [best[1] + k * step / 4.0 for k in (-3, -2, -1, 1, 2, 3)]
            values = [value for value in values if one.span[0] <= value <= one.span[1]]
            step /= 3.0
    return None if math.isinf(best[0]) else best[1]
