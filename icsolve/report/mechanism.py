"""`solve --report`: what kind of mechanism this is, how well it drives, and where its input stops.

Of four-bars and slider-cranks by their lengths: who turns fully, where the input stops, how well it drives.
Formulas: K. J. Waldron, G. L. Kinzel and S. K. Agrawal, Kinematics, Dynamics, and Design of Machinery, 3rd
ed., chapters 1 and 6; each is the law of cosines on the diagonal of the loop. Which sum of lengths is the
longer is decided in as many digits as that needs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer
from icsolve.case import Case
from icsolve.case.joints import Guided
from icsolve.numbers import FLOATS, Arithmetic, Scalar, Showing, size_of
from icsolve.scene.parts import scene_of
from icsolve.scene.program import places_in
from icsolve.structure import topology
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.sweep.cam_sweep import Pressure


class AngleRange(NamedTuple):
    """Transmission angle in degrees: in this position, and between what it moves."""

    now: float
    least: float
    greatest: float


class Side(NamedTuple):
    """A four-bar seen from its input: lengths of input, coupler, output and base, in any arithmetic.

    ``turned`` is the direction of the input less that of the base (from the input's pivot), degrees.
    """

    driver: Scalar
    coupler: Scalar
    output: Scalar
    base: Scalar
    turned: float


class Crank(NamedTuple):
    """A slider-crank: crank and rod lengths; height of the slider's path over the crank's pivot.

    ``turned`` is the direction of the crank less that of the path, degrees.
    """

    radius: Scalar
    rod: Scalar
    offset: Scalar
    turned: float


def _sign(a: Arithmetic, difference: Scalar, size: float) -> int:
    """-1, 0 or 1: of a difference of lengths whose sum is ``size``."""
    return 0 if a.vanishes(difference, size) else 1 if float(difference) > 0.0 else -1


def _in_line(side: Side, a: Arithmetic) -> tuple[int, int]:
    """Whether the input brings coupler and output in line, stretched out and folded: 1 where it stops there,
    0 where it goes on, -1 where it does not come so far."""
    size = sum(map(float, side[:4]))
    stretched = side.driver + side.base - side.coupler - side.output
    folded = size_of(side.coupler - side.output) - size_of(side.driver - side.base)
    return _sign(a, stretched, size), _sign(a, folded, size)


def transmission_of(side: Side, arithmetic: Arithmetic = FLOATS) -> AngleRange:
    """Angle between coupler and output: the diagonal opposite to it is longest with the input stretched out.

    cos mu = (b^2 + c^2 - f^2) / 2bc, with f^2 = a^2 + d^2 - 2ad cos(turned).
    """
    stretched, folded = _in_line(side, arithmetic)
    a, b, c, d, turned = map(float, side)
    diagonal = math.sqrt(max(a * a + d * d - 2.0 * a * d * math.cos(math.radians(turned)), 0.0))
    least = 0.0 if folded >= 0 else _angle_opposite(abs(d - a), b, c)
    greatest = 180.0 if stretched >= 0 else _angle_opposite(d + a, b, c)
    return AngleRange(_angle_opposite(diagonal, b, c), least, greatest)


def limits_of(side: Side, arithmetic: Arithmetic = FLOATS) -> tuple[float, ...]:
    """Where the input stops, as degrees from the base, the two ends of its range; empty if it turns fully.

    It stops where coupler and output lie in line: stretched out (f = b + c) or folded (f = |b - c|).
    """
    stretched, folded = (sign > 0 for sign in _in_line(side, arithmetic))
    a, b, c, d, turned = map(float, side)
    far, near = _angle_opposite(b + c, a, d), _angle_opposite(abs(b - c), a, d)
    if stretched and folded:
        return (near, far) if math.sin(math.radians(turned)) >= 0.0 else (-far, -near)
    if stretched:
        return (-far, far)
    return (near, 360.0 - near) if folded else ()


def transmission_in_slider_crank(crank: Crank) -> AngleRange:
    """Angle between the rod and the normal of the guide: cos mu = |e - r sin(turned)| / l."""
    r, rod, e, turned = map(float, crank)
    now = abs(e - r * math.sin(math.radians(turned)))
    most, fewest = min(r + abs(e), rod), max(abs(e) - r, 0.0)
    return AngleRange(*(_arccos(height / rod) for height in (now, most, fewest)))


def limits_in_slider_crank(crank: Crank, arithmetic: Arithmetic = FLOATS) -> tuple[float, ...]:
    """Where the crank stops, degrees from the guide, the two ends of its range; empty if it turns fully.

    It stops where the rod is square to the guide: r sin(turned) = e - l or e + l.
    """
    r, rod, e, turned = crank
    size = float(r + rod + size_of(e))
    above, below = (_sign(arithmetic, r - rod - e, size) > 0, _sign(arithmetic, r - rod + e, size) > 0)
    r, rod, e = map(float, (r, rod, e))
    high, low = _arcsin((e + rod) / r), _arcsin((e - rod) / r)
    if above and below:
        return (low, high) if math.cos(math.radians(turned)) >= 0.0 else (180.0 - high, 180.0 - low)
    if above:
        return (180.0 - high, 360.0 + high)
    return (low, 180.0 - low) if below else ()


def stroke_of(crank: Crank, a: Arithmetic) -> tuple[Scalar, ...]:
    """Where the slider turns back, along its path from the foot of the crank's pivot.

    There crank and rod lie in line, folded and stretched out: sqrt((l -+ r)^2 - e^2). Empty if the crank
    does not turn fully.
    """
    r, rod, e, _ = crank
    size = float(r + rod + size_of(e))
    if _sign(a, r + size_of(e) - rod, size) > 0:
        return ()
    squares = [(both - e) * (both + e) for both in (rod - r, rod + r)]
    return tuple(0.0 if a.vanishes(square, size * size) else a.sqrt(square) for square in squares)


def _angle_opposite(side: float, b: float, c: float) -> float:
    """Angle of a triangle opposite to a side, degrees, by the other two: tan^2 of its half, which keeps its
    digits where the triangle is flat.
    """
    folded, stretched = (side - b + c) * (side + b - c), (b + c - side) * (b + c + side)
    return math.degrees(2.0 * math.atan2(math.sqrt(max(folded, 0.0)), math.sqrt(max(stretched, 0.0))))


def _arccos(value: float) -> float:
    return math.degrees(math.acos(min(max(value, -1.0), 1.0)))


def _arcsin(value: float) -> float:
    return math.degrees(math.asin(min(max(value, -1.0), 1.0)))


Place = tuple[Scalar, Scalar]


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
    stroke: tuple[tuple[float, ...], ...] | None = None


class Report(NamedTuple):
    """What `solve --report` shows of an answer."""

    mobility: int | None
    advantage: float | None
    loops: tuple[Loop, ...]
    unit: str
    contacts: tuple[Pressure, ...] = ()
    asked: tuple[str, ...] = ()
    """the data of the figure that are to find: in each position the angles are others"""

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
        if self.asked:
            given = " ".join(f"--set {path}=..." for path in self.asked)
            lines.append(f"  Grashof kind, angles and limits are told of one position: {given}")
        elif not self.loops and not self.contacts:
            lines.append("  no four-bar and no slider-crank among the loops: no Grashof kind")
        return "\n".join(lines)


def report(answer: Answer) -> Report:
    """The report of an answer whose points are all known (solved with ``examine``)."""
    scene = scene_of(answer)
    if scene is None:  # of a case in space, or one that asks for a position, there are none
        loops = _loops(answer.case, answer.points, FLOATS) if answer.points else ()
    else:
        loops = scene.scene.ask(lambda found: _loops(scene.case, places_in(found), found.arithmetic))
    asked, unit = tuple(unknown.path for unknown in answer.case.unknowns), answer.case.units.length
    return Report(answer.mobility, answer.advantage, loops, unit, _contacts(answer), asked)


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
    bodies = topology(case)
    names = [members[0] for members in bodies.members]
    names[bodies.ground] = case.ground
    return {link: names[body] for link, body in bodies.body_of.items()}


Pivots = dict[str, list[tuple[str, str]]]


def _pivots(case: Case) -> Pivots:
    """For each body, the bodies pinned to it and the points where."""
    body = _bodies(case)
    pivots: Pivots = {its: [] for its in body.values()}
    for joint in case.joints:
        if joint.pivot is not None:
            ends = dict.fromkeys(body[link] for link in joint.links)
            for a in ends:
                pivots[a].extend((b, joint.pivot) for b in ends if b != a)
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


Places = Mapping[str, tuple[Scalar, Scalar]]


def _loops(case: Case, places: Places, a: Showing) -> tuple[Loop, ...]:
    """The loops of a case with its points in an arithmetic, case units."""
    return (*_four_bars(case, places, a), *_slider_cranks(case, places, a))


def _four_bars(case: Case, places: Places, a: Showing) -> Iterator[Loop]:
    pivots = _pivots(case)
    ground = _bodies(case).get(case.ground, "")
    seen: set[frozenset[str]] = set()
    for base in sorted(pivots, key=lambda link: link != ground):
        for bodies, points in _chains(pivots, base, 4):
            placed = all(point in places for point in points)
            if placed and bodies[-1] == base and frozenset(points) not in seen:
                seen.add(frozenset(points))
                at = tuple(places[point] for point in points)
                yield _four_bar(a, bodies[:4], points, at, base == ground)


def _four_bar(
    a: Showing, links: tuple[str, ...], points: tuple[str, ...], at: tuple[Place, ...], grounded: bool
) -> Loop:
    driver, coupler, output, base = (_distance(a, p, q) for p, q in zip(at, (*at[1:], at[0]), strict=True))
    lengths = (base, driver, coupler, output)
    size = sum(map(float, lengths))
    shown = tuple(a.rounded(length, size)[0] for length in lengths)
    kind = _grashof_kind(links, lengths, grounded, a)
    if not grounded or any(a.vanishes(length, size) for length in lengths):
        return Loop("four-bar", links, points, shown, kind)
    p, q, r, s = at
    toward = _direction(p, s)
    inputs = (
        _side(links[1], points[2], Side(driver, coupler, output, base, _direction(p, q) - toward), toward, a),
        _side(
            links[3],
            points[1],
            Side(output, coupler, driver, base, _direction(s, r) - toward - 180.0),
            toward + 180.0,
            a,
        ),
    )
    return Loop("four-bar", links, points, shown, kind, inputs)


def _grashof_kind(links: tuple[str, ...], lengths: tuple[Scalar, ...], grounded: bool, a: Arithmetic) -> str:
    order = sorted(range(4), key=lambda n: float(lengths[n] - lengths[0]))
    shortest, one, other, longest = order
    excess = lengths[shortest] + lengths[longest] - lengths[one] - lengths[other]
    sign = _sign(a, excess, sum(map(float, lengths)))
    if sign == 0:
        return "change point (shortest + longest = the other two)"
    if sign > 0:
        return "triple-rocker, not Grashof: no link turns fully"
    if not grounded:
        return f"Grashof: link {links[shortest]} turns fully against the others"
    return (
        f"Grashof double-crank (drag link): links {links[1]} and {links[3]} turn fully",
        f"Grashof crank-rocker: link {links[1]} turns fully, link {links[3]} rocks",
        f"Grashof double-rocker: links {links[1]} and {links[3]} rock, link {links[2]} turns fully",
        f"Grashof crank-rocker: link {links[3]} turns fully, link {links[1]} rocks",
    )[shortest]


def _side(link: str, at: str, side: Side, base: float, a: Arithmetic) -> Input:
    """A link as input, by the direction of the base from its pivot [degrees]."""
    return Input(link, at, transmission_of(side, a), _turned(limits_of(side, a), base))


def _distance(a: Arithmetic, p: Place, q: Place) -> Scalar:
    x, y = q[0] - p[0], q[1] - p[1]
    return a.sqrt(x * x + y * y)


def _direction(a: Place, b: Place) -> float:
    return math.degrees(math.atan2(float(b[1] - a[1]), float(b[0] - a[0])))


def _turned(angles: tuple[float, ...], by: float) -> tuple[float, ...]:
    return tuple((angle + by) % 360.0 for angle in angles)


def _slider_cranks(case: Case, places: Places, a: Showing) -> Iterator[Loop]:
    body = _bodies(case)
    ground = body.get(case.ground, "")
    pivots = _pivots(case)
    for slide in (j for j in case.joints if isinstance(j, Guided) and j.keeps_direction):
        block, guide = (body[link] for link in slide.links)
        if guide == ground != block:
            for bodies, points in _chains(pivots, ground, 3):
                if bodies[-1] == block and all(point in places for point in points):
                    yield from _slider_crank(a, slide, bodies, points, places)


def _slider_crank(
    a: Showing, slide: Guided, links: tuple[str, ...], points: tuple[str, ...], places: Places
) -> Iterator[Loop]:
    """The loop, where crank and rod have a length."""
    pivot, pin, slider = (places[point] for point in points)
    ux, uy = _along(a, slide, places)
    path = math.degrees(math.atan2(float(uy), float(ux)))
    offset = ux * (slider[1] - pivot[1]) - uy * (slider[0] - pivot[0])
    radius, rod = _distance(a, pivot, pin), _distance(a, pin, slider)
    crank = Crank(radius, rod, offset, _direction(pivot, pin) - path)
    size = float(radius + rod + size_of(offset))
    if a.vanishes(radius, size) or a.vanishes(rod, size):
        return
    lengths = tuple(a.rounded(length, size)[0] for length in (radius, rod, size_of(offset)))
    limits = _turned(limits_in_slider_crank(crank, a), path)
    kind = f"link {links[1]} {'does not turn' if limits else 'turns'} fully"
    name = "in-line slider-crank" if a.vanishes(offset, size) else "offset slider-crank"
    inputs = (Input(links[1], points[2], transmission_in_slider_crank(crank), limits),)
    ahead = float(ux * (slider[0] - pin[0]) + uy * (slider[1] - pin[1])) >= 0.0
    foot = (pivot[0] - uy * offset, pivot[1] + ux * offset)
    ends = [
        tuple(a.rounded(f + (s if ahead else -s) * u, size)[0] for f, u in zip(foot, (ux, uy), strict=True))
        for s in stroke_of(crank, a)
    ]
    yield Loop(name, links, points, lengths, kind, inputs, tuple(ends) or None)


def _along(a: Arithmetic, slide: Guided, places: Places) -> Place:
    """Unit vector of a slide's guide."""
    if slide.guide.angle is not None:
        return a.turn(slide.guide.angle)
    assert slide.guide.ends is not None
    one, other = (places[end] for end in slide.guide.ends)
    length = _distance(a, one, other)
    return (other[0] - one[0]) / length, (other[1] - one[1]) / length
