"""Where the modes of a figure end, and the positions of equilibrium in which two of them meet there."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from icsolve.answer import Answer
from icsolve.case import Force, Torque
from icsolve.errors import SceneError
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.replay import Code
from icsolve.numbers.roots import last_that_holds
from icsolve.numbers.units import Number
from icsolve.scene import solve_scene
from icsolve.solve.branches import Branches
from icsolve.solve.load_function import LoadFunction
from icsolve.solve.refinement import balancing_torque, plain_within, scene_at, told
from icsolve.solve.rest_position import AT_LIMIT, PROBE, RestPosition, probes
from icsolve.tuples import NamedTuple


class Limit(NamedTuple):
    """Where a mode ends: the last value at which it assembles, how far from it the limit may be, and on which
    side the mode assembles (1: below)."""

    mode: int
    value: float
    error: float
    side: float


def limits_of(functions: Sequence[LoadFunction], branches: Branches) -> list[Limit]:
    """The ends of all modes in the range, also at its ends."""
    found = []
    low, high = branches.low, branches.high
    beyond = np.array([low - branches.slack, high + branches.slack])
    values = np.array([beyond[0], *branches.values, beyond[1]])
    first, last = branches.assemble(beyond).T
    for n, function in enumerate(functions):
        whole = np.array([first[n], *branches.whole[n], last[n]])
        for k in np.flatnonzero(whole[1:] != whole[:-1]).tolist():
            inside, outside = (k, k + 1) if whole[k] else (k + 1, k)
            value = _last(function, float(values[inside]), float(values[outside]))
            side = 1.0 if inside < outside else -1.0
            error = _reach(function, value, side, branches.slack)
            if low - error <= value <= high + error:
                found.append(Limit(n, min(max(value, low), high), error, side))
    return found


def _reach(function: LoadFunction, value: float, side: float, most: float) -> float:
    """So far on either side of a limit it is certain that a mode assembles, and that it does not."""
    least = math.ulp(value)
    count = max(math.frexp(most)[1] - math.frexp(least)[1], 0) + 1
    reach = np.ldexp(least, np.arange(count + 1))
    about = np.concatenate([value - side * reach, value + side * reach])
    margins = enclose(function.record, function.margins, function.enclosed(Interval(about, about)))
    inside = np.all([np.broadcast_to(margin.low, len(about)) > 0.0 for margin in margins], axis=0)
    outside = np.any([np.broadcast_to(margin.high, len(about)) < 0.0 for margin in margins], axis=0)
    certain = (inside[: count + 1] & outside[count + 1 :]) | (reach >= most)
    return float(reach[np.argmax(certain)])


def _last(function: LoadFunction, inside: float, outside: float) -> float:
    """The last double at which a mode assembles, between one at which it does and one at which not."""
    code = Code(function.record, function.margins)

    def assembles(value: float) -> bool:
        return all(float(np.ravel(m)[0]) > 0.0 for m in code.run(function.given(np.array(value)), 1))

    return last_that_holds(assembles, inside, outside)[0]


def at_limits(
    functions: Sequence[LoadFunction],
    branches: Branches,
    kept: frozenset[int] | None,
    limits: Sequence[Limit],
) -> list[RestPosition]:
    """Rests at limits of the free datum: there two modes meet, and the load changes its sign from one
    to the other along the motion that the mechanism has."""
    found = []
    for k, one in enumerate(limits):
        for other in limits[k + 1 :]:
            near = abs(one.value - other.value) <= branches.slack
            if not near or one.side != other.side or one.mode == other.mode:
                continue
            on = {branches.on(limit.mode, limit.value) for limit in (one, other)}
            if kept is None or on & kept:
                found += _rest_at_limit(functions[one.mode], functions[other.mode], one)
    return found


def _rest_at_limit(one: LoadFunction, two: LoadFunction, limit: Limit) -> list[RestPosition]:
    """The position between two modes that meet at a limit, where the load changes its sign there."""
    step = 1e-7 * max(1.0, abs(limit.value))
    here = limit.value - limit.side * step
    try:
        a, b = solve_scene(scene_at(one, here), rates=True), solve_scene(scene_at(two, here), rates=True)
        size = max((abs(c) for at in a.points.values() for c in at), default=1.0)
        if any(math.dist(at, b.points[name]) > 0.02 * size for name, at in a.points.items()):
            return []
        load = _fastest(a, one)  # of the motion there: the link that is driven stands still
        last = limit.value - limit.side * max(4.0 * limit.error, 1e-9 * step)  # a length of 0 has no ulp
        p, q = balancing_torque(one, last, load), balancing_torque(two, last, load)
        if (p > 0.0) == (q > 0.0) and p != 0.0 and q != 0.0:
            return []
        far, away = balancing_torque(one, here, load), balancing_torque(two, here, load)
        if abs(p - q) > abs(far - away) * (abs(limit.value - last) / step) ** 0.25:
            return []  # one position, but not one motion: a corner, as where a rope runs out
        way = _swing(one, two, load, here)
    except SceneError:
        return []
    rises = (away - far) * way
    stability = "stable" if rises > 0.0 else "unstable" if rises < 0.0 else "neutral"
    value = plain_within(limit.value, limit.error)
    error = limit.error + abs(value - limit.value)
    try:
        return [told(one, value, error, stability, None, AT_LIMIT)]
    except SceneError:
        return [told(one, value, error, stability, None, AT_LIMIT, last)]


def _fastest(answer: Answer, function: LoadFunction) -> Torque | Force:
    """The unknown load on what moves fastest in a solved scene: a torque on a link, where none turns a force
    along an axis on a point."""
    if function.links:
        rates = {link: rate for link, rate in (answer.rates or {}).items() if isinstance(rate, float)}
        return Torque(PROBE, max(function.links, key=lambda link: abs(rates.get(link, 0.0))), None)
    speeds = answer.velocities or {}
    forces = [load for load in probes(function.case, [], 1) if isinstance(load, Force)]

    def speed(force: Force) -> float:
        known = speeds.get((force.at, force.link), "")
        return 0.0 if isinstance(known, str) else abs(known[_axis(force)])

    return max(forces, key=speed)


def _axis(force: Force) -> int:
    """The axis along which a force on what moves acts."""
    assert isinstance(force.heading, Number)
    return 1 if force.heading.value else 0


def _swing(one: LoadFunction, two: LoadFunction, load: Torque | Force, value: float) -> float:
    """The sense in which what a load moves goes from one mode to the other through the limit."""
    first, second = solve_scene(scene_at(one, value)).points, solve_scene(scene_at(two, value)).points
    if isinstance(load, Force):
        return second[load.at][_axis(load)] - first[load.at][_axis(load)]
    carried = [p for p in one.case.carries[load.link] if p in one.places]
    a, b = max(
        ((p, q) for p in carried for q in carried if p != q),
        key=lambda pair: math.dist(first[pair[0]], first[pair[1]]),
        default=("", ""),
    )
    if not a:
        return 0.0
    (ax, ay), (bx, by) = first[a], first[b]
    (cx, cy), (dx, dy) = second[a], second[b]
    return (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
