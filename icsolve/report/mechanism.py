"""`solve --report`: what kind of mechanism this is, how well it drives, and where its input stops.

Of four-bars and slider-cranks by their lengths: who turns fully, where the input stops, how well it drives.
Formulas: K. J. Waldron, G. L. Kinzel and S. K. Agrawal, Kinematics, Dynamics, and Design of Machinery, 3rd
ed., chapters 1 and 6; each is the law of cosines on the diagonal of the loop.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer
from icsolve.case import Case, Pin
from icsolve.case.joints import Guided
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.sweep.cam_sweep import Pressure


_EVEN = 1e-9
"""Relative to the sum of the lengths: closer than this, two sums of lengths are equal."""


class AngleRange(NamedTuple):
    """Transmission angle in degrees: in this position, and between what it moves."""

    now: float
    least: float
    greatest: float


class Side(NamedTuple):
    """A four-bar seen from its input: lengths of input, coupler, output and base.

    ``turned`` is the direction of the input less that of the base (from the input's pivot), degrees.
    """

    driver: float
    coupler: float
    output: float
    base: float
    turned: float


class Crank(NamedTuple):
    """A slider-crank: crank and rod lengths; height of the slider's path over the crank's pivot.

    ``turned`` is the direction of the crank less that of the path, degrees.
    """

    radius: float
    rod: float
    offset: float
    turned: float


def grashof_excess(lengths: tuple[float, float, float, float]) -> float:
    """Shortest plus longest less the other two; 0 where they are equal within rounding (change point)."""
    ordered = sorted(lengths)
    excess = ordered[0] + ordered[3] - ordered[1] - ordered[2]
    return 0.0 if abs(excess) <= _EVEN * sum(lengths) else excess


def transmission_of(side: Side) -> AngleRange:
    """Angle between coupler and output: the diagonal opposite to it is longest with the input stretched out.

    cos mu = (b^2 + c^2 - f^2) / 2bc, with f^2 = a^2 + d^2 - 2ad cos(turned).
    """
    a, b, c, d, turned = side
    diagonal = math.sqrt(max(a * a + d * d - 2.0 * a * d * math.cos(math.radians(turned)), 0.0))
    least, greatest = max(abs(d - a), abs(b - c)), min(d + a, b + c)
    return AngleRange(*(_angle_opposite(f, b, c) for f in (diagonal, least, greatest)))


def limits_of(side: Side) -> tuple[float, ...]:
    """Where the input stops, as degrees from the base, the two ends of its range; empty if it turns fully.

    It stops where coupler and output lie in line: stretched out (f = b + c) or folded (f = |b - c|).
    """
    a, b, c, d, turned = side
    far = _angle_opposite(b + c, a, d) if b + c < (a + d) * (1.0 - _EVEN) else None
    near = _angle_opposite(abs(b - c), a, d) if abs(b - c) > abs(a - d) + _EVEN * (a + d) else None
    if far is not None and near is not None:
        return (near, far) if math.sin(math.radians(turned)) >= 0.0 else (-far, -near)
    if far is not None:
        return (-far, far)
    return () if near is None else (near, 360.0 - near)


def transmission_in_slider_crank(crank: Crank) -> AngleRange:
    """Angle between the rod and the normal of the guide: cos mu = |e - r sin(turned)| / l."""
    r, rod, e, turned = crank
    now = abs(e - r * math.sin(math.radians(turned)))
    most, fewest = min(r + abs(e), rod), max(abs(e) - r, 0.0)
    return AngleRange(*(_arccos(height / rod) for height in (now, most, fewest)))


def limits_in_slider_crank(crank: Crank) -> tuple[float, ...]:
    """Where the crank stops, degrees from the guide, the two ends of its range; empty if it turns fully.

    It stops where the rod is square to the guide: r sin(turned) = e - l or e + l.
    """
    r, rod, e, turned = crank
    high = _arcsin((e + rod) / r) if (e + rod) / r < 1.0 - _EVEN else None
    low = _arcsin((e - rod) / r) if (e - rod) / r > _EVEN - 1.0 else None
    if high is not None and low is not None:
        return (low, high) if math.cos(math.radians(turned)) >= 0.0 else (180.0 - high, 180.0 - low)
    if high is not None:
        return (180.0 - high, 360.0 + high)
    return () if low is None else (low, 180.0 - low)


def stroke_of(crank: Crank) -> tuple[float, float] | None:
    """Where the slider turns back, along its path from the foot of the crank's pivot.

    There crank and rod lie in line, folded and stretched out. None if the crank does not turn fully.
    """
    r, rod, e, _ = crank
    if r + abs(e) > rod * (1.0 + _EVEN):
        return None
    folded, stretched = (math.sqrt(max(sum_ * sum_ - e * e, 0.0)) for sum_ in (rod - r, rod + r))
    return folded, stretched


def _angle_opposite(side: float, b: float, c: float) -> float:
    """Angle of a triangle opposite to a side, degrees, by the other two (law of cosines)."""
    return _arccos((b * b + c * c - side * side) / (2.0 * b * c))


def _arccos(value: float) -> float:
    return math.degrees(math.acos(min(max(value, -1.0), 1.0)))


def _arcsin(value: float) -> float:
    return math.degrees(math.asin(min(max(value, -1.0), 1.0)))


Place = tuple[float, float]


class Input(NamedTuple):
    """A link of a loop as its input.

    ``transmission`` is the angle at ``at``, degrees. ``limits`` are the directions of the input, degrees in
    [0, 360), in which it stops: its range goes counterclockwise from the first to the second. Empty: it
    turns fully.
    """

    link: str
    at: str
    transmission: AngleRange
    limits: tuple[float, ...]


class Loop(NamedTuple):
    """A four-bar or slider-crank: its links from the base on, the points between them, and what it can do."""

    name: str
    links: tuple[str, ...]
    points: tuple[str, ...]
    lengths: tuple[float, ...]
    kind: str
    inputs: tuple[Input, ...] = ()
    stroke: tuple[Place, Place] | None = None


class Report(NamedTuple):
    """What `solve --report` shows of an answer."""

    mobility: int | None
    advantage: float | None
    loops: tuple[Loop, ...]
    unit: str
    contacts: tuple[Pressure, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """The object under ``report`` in the JSON of an answer."""
        return {
            "mobility": self.mobility,
            "advantage": self.advantage,
            "loops": [_loop_dict(loop) for loop in self.loops],
            **({"contacts": [each._asdict() for each in self.contacts]} if self.contacts else {}),
        }

    def text(self, digits: int = 6) -> str:
        """The report in lines for people, numbers to ``digits`` digits."""
        lines = ["Report", f"  mobility {self.mobility}"]
        if self.advantage is not None:
            lines.append(f"  mechanical advantage (unknown / known) {_show(self.advantage, digits)}")
        lines.extend(each.text(digits) for each in self.contacts)
        for loop in self.loops:
            lines.extend(_loop_text(loop, digits, self.unit))
        if not self.loops and not self.contacts:
            lines.append("  no four-bar and no slider-crank among the loops: no Grashof kind")
        return "\n".join(lines)


def report(answer: Answer) -> Report:
    """The report of an answer whose points are all known (solved with ``examine``)."""
    loops = (*_four_bars(answer), *_slider_cranks(answer))
    return Report(answer.mobility, answer.advantage, loops, answer.case.units.length, _contacts(answer))


def _contacts(answer: Answer) -> tuple[Pressure, ...]:
    """The pressure angles of contacts that profiles gave."""
    if not answer.touching:
        return ()
    from icsolve.sweep.cam_sweep import pressures

    return pressures(answer)


def _loop_dict(loop: Loop) -> dict[str, Any]:
    inputs = [{**each._asdict(), "transmission": each.transmission._asdict()} for each in loop.inputs]
    return {**loop._asdict(), "inputs": inputs}


def _show(value: float, digits: int) -> str:
    return format(value + 0.0, f".{digits}g")


def _loop_text(loop: Loop, digits: int, unit: str) -> Iterator[str]:
    lengths = ", ".join(_show(length, digits) for length in loop.lengths)
    names = f"{' '.join(loop.links)} ({' '.join(loop.points)}; {lengths} {unit})"
    yield f"  {loop.name} of links {names}: {loop.kind}"
    for each in loop.inputs:
        now, least, greatest = (_show(angle, digits) for angle in each.transmission)
        yield (
            f"    link {each.link} as input: transmission angle at {each.at} {now} deg,"
            f" from {least} to {greatest} over the motion; {_stops(each, digits)}"
        )
    if loop.stroke is not None:
        ends = " and ".join(f"({_show(x, digits)}, {_show(y, digits)})" for x, y in loop.stroke)
        yield f"    {loop.points[-1]} turns back at {ends} (dead centres, with the slider as input)"


def _stops(each: Input, digits: int) -> str:
    if not each.limits:
        return "it turns fully"
    first, second = (_show(limit, digits) for limit in each.limits)
    return f"it turns from {first} ccw to {second} deg and stops there"


def _bodies(case: Case) -> dict[str, str]:
    """Each link's body: links that are welded count as one, the frame by its own name."""
    body = {link: link for link in case.links}
    for joint in case.joints:
        if not joint.freedom:
            kept, gone = (body[link] for link in joint.links)
            if gone == body.get(case.ground):
                kept, gone = gone, kept
            body = {link: kept if its == gone else its for link, its in body.items()}
    return body


Pivots = dict[str, list[tuple[str, str]]]


def _pivots(case: Case) -> Pivots:
    """For each body, the bodies pinned to it and the points where."""
    body = _bodies(case)
    pivots: Pivots = {its: [] for its in body.values()}
    for joint in case.joints:
        if isinstance(joint, Pin):
            ends = dict.fromkeys(body[link] for link in joint.links)
            for a in ends:
                pivots[a].extend((b, joint.at) for b in ends if b != a)
    return pivots


def _chains(pivots: Pivots, start: str, pins: int) -> Iterator[tuple[tuple[str, ...], tuple[str, ...]]]:
    """Chains of distinct bodies over ``pins`` distinct pins from a body: the bodies and the points."""
    chains: list[tuple[tuple[str, ...], tuple[str, ...]]] = [((start,), ())]
    for _ in range(pins):
        chains = [
            ((*bodies, after), (*points, at))
            for bodies, points in chains
            for after, at in pivots[bodies[-1]]
            if at not in points and (after not in bodies or (len(points) == 3 and after == start))
        ]
    yield from chains


def _four_bars(answer: Answer) -> Iterator[Loop]:
    pivots = _pivots(answer.case)
    ground = _bodies(answer.case).get(answer.case.ground, "")
    seen: set[frozenset[str]] = set()
    for base in sorted(pivots, key=lambda link: link != ground):
        for bodies, points in _chains(pivots, base, 4):
            placed = all(point in answer.points for point in points)
            if placed and bodies[-1] == base and frozenset(points) not in seen:
                seen.add(frozenset(points))
                yield _four_bar(answer, bodies[:4], points, base == ground)


def _four_bar(answer: Answer, links: tuple[str, ...], points: tuple[str, ...], grounded: bool) -> Loop:
    a, b, c, d = (answer.points[point] for point in points)
    lengths = (math.dist(d, a), math.dist(a, b), math.dist(b, c), math.dist(c, d))
    kind = _grashof_kind(links, lengths, grounded)
    if not grounded or min(lengths) == 0.0:
        return Loop("four-bar", links, points, lengths, kind)
    inputs = (
        _side(links[1], points[2], (a, b, c, d)),
        _side(links[3], points[1], (d, c, b, a)),
    )
    return Loop("four-bar", links, points, lengths, kind, inputs)


def _grashof_kind(links: tuple[str, ...], lengths: tuple[float, ...], grounded: bool) -> str:
    base, driver, coupler, output = lengths
    excess = grashof_excess((base, driver, coupler, output))
    if excess == 0.0:
        return "change point (shortest + longest = the other two)"
    if excess > 0.0:
        return "triple-rocker, not Grashof: no link turns fully"
    shortest = lengths.index(min(lengths))
    if not grounded:
        return f"Grashof: link {links[shortest]} turns fully against the others"
    return (
        f"Grashof double-crank (drag link): links {links[1]} and {links[3]} turn fully",
        f"Grashof crank-rocker: link {links[1]} turns fully, link {links[3]} rocks",
        f"Grashof double-rocker: links {links[1]} and {links[3]} rock, link {links[2]} turns fully",
        f"Grashof crank-rocker: link {links[3]} turns fully, link {links[1]} rocks",
    )[shortest]


def _side(link: str, at: str, places: tuple[Place, Place, Place, Place]) -> Input:
    """A link as input: pivot of the input, crank pin, output pin, pivot of the output."""
    a, b, c, d = places
    base = _direction(a, d)
    side = Side(math.dist(a, b), math.dist(b, c), math.dist(c, d), math.dist(d, a), _direction(a, b) - base)
    return Input(link, at, transmission_of(side), _turned(limits_of(side), base))


def _direction(a: Place, b: Place) -> float:
    return math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))


def _turned(angles: tuple[float, ...], by: float) -> tuple[float, ...]:
    return tuple((angle + by) % 360.0 for angle in angles)


def _slider_cranks(answer: Answer) -> Iterator[Loop]:
    case = answer.case
    body = _bodies(case)
    ground = body.get(case.ground, "")
    pivots = _pivots(case)
    for slide in (j for j in case.joints if isinstance(j, Guided) and j.keeps_direction):
        block, guide = (body[link] for link in slide.links)
        if guide == ground != block:
            for bodies, points in _chains(pivots, ground, 3):
                if bodies[-1] == block and _has_extent(answer, points):
                    yield _slider_crank(answer, slide, bodies, points)


def _slider_crank(answer: Answer, slide: Guided, links: tuple[str, ...], points: tuple[str, ...]) -> Loop:
    a, b, c = (answer.points[point] for point in points)
    path = _path(answer, slide)
    ux, uy = math.cos(math.radians(path)), math.sin(math.radians(path))
    offset = ux * (c[1] - a[1]) - uy * (c[0] - a[0])
    crank = Crank(math.dist(a, b), math.dist(b, c), offset, _direction(a, b) - path)
    lengths = (crank.radius, crank.rod, abs(offset))
    limits = _turned(limits_in_slider_crank(crank), path)
    kind = f"link {links[1]} {'does not turn' if limits else 'turns'} fully"
    name = "in-line slider-crank" if abs(offset) <= 1e-9 * sum(lengths) else "offset slider-crank"
    inputs = (Input(links[1], points[2], transmission_in_slider_crank(crank), limits),)
    return Loop(name, links, points, lengths, kind, inputs, _stroke(crank, a, b, c, (ux, uy)))


def _has_extent(answer: Answer, points: tuple[str, ...]) -> bool:
    """Whether the crank and the rod have a length, with all their ends placed."""
    a, b, c = (answer.points.get(point) for point in points)
    return None not in (a, b, c) and a != b != c


def _path(answer: Answer, slide: Guided) -> float:
    """Direction of a slide's guide, degrees."""
    if slide.guide.angle is not None:
        return slide.guide.angle.value
    assert slide.guide.ends is not None
    a, b = (answer.points[end] for end in slide.guide.ends)
    return _direction(a, b)


def _stroke(crank: Crank, a: Place, b: Place, c: Place, u: Place) -> tuple[Place, Place] | None:
    """Where the slider turns back, on the side of the crank on which it is now."""
    ends = stroke_of(crank)
    if ends is None:
        return None
    side = math.copysign(1.0, u[0] * (c[0] - b[0]) + u[1] * (c[1] - b[1]))
    foot = (a[0] - u[1] * crank.offset, a[1] + u[0] * crank.offset)
    first, second = ((foot[0] + side * s * u[0], foot[1] + side * s * u[1]) for s in ends)
    return first, second
