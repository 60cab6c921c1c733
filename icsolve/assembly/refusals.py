"""How points, data, loci and steps of a construction are named to a reader, and what a figure can be refused
for: the facts of a step that failed, and of redundant data, which are compared with the figure.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from icsolve.assembly.conditions import (
    CONDITIONS,
    ROUNDING,
    TOO_CLOSE,
    Residual,
    is_vague,
    parts_of,
    residual,
    scale_of,
)
from icsolve.assembly.loci import (
    ArcLocus,
    Axis,
    CircleLocus,
    Locus,
    PlacedCircle,
    Shifted,
    Tether,
    is_round,
)
from icsolve.assembly.steps import Base, Given, Mean, Meet, Miss, PointGroup, Polar, Step, Turned, leading_to
from icsolve.assembly.workspace import (
    CORNER,
    GUIDE,
    LENGTH,
    LINE,
    MEAN,
    RAY,
    ROPE,
    Apart,
    Datum,
    Key,
    LineDirection,
    Span,
    Workspace,
    X,
    Y,
    case_point,
    data_in,
    given_points,
    number_of,
)
from icsolve.case import Number, bare_name
from icsolve.errors import Status
from icsolve.numbers import Floats, turn_of
from icsolve.numbers.units import numbers_in
from icsolve.wording import listed


def plain(key: Key) -> str:
    """A point's name."""
    name = key if isinstance(key, str) else key[1]
    return bare_name(name)


def joined(*points: str) -> str:
    """Points written together as the format writes pairs and triples: ``AB``, ``O2-A``."""
    names = [plain(point) for point in points]
    return "".join(names) if all(len(name) == 1 for name in names) else "-".join(names)


def datum_words(datum: Datum) -> str:
    """A datum by its name: ``length AB``, ``angle ABC``, ``the guide of C``."""
    if datum.kind == LENGTH:
        return f"length {joined(*datum.points)}"
    if datum.kind == ROPE:
        return f"length of the rope {'-'.join(map(plain, datum.points))}"
    if datum.kind in (RAY, CORNER):
        return f"angle {joined(*datum.points)}"
    if datum.kind in (GUIDE, LINE):
        return f"the guide of {plain(datum.points[0])}"
    if datum.kind == MEAN:
        return f"the centroid {plain(datum.points[0])}"
    return f"{datum.kind} of {plain(datum.points[0])}"


def span_words(span: Span) -> str:
    """A length by its ends."""
    return joined(*span.points) if isinstance(span, Datum) else joined(plain(span.a), plain(span.b))


def direction_words(direction: LineDirection) -> str:
    """A direction by its data."""
    root = direction.root
    if isinstance(root, Datum):
        start = datum_words(root)
    else:
        start = f"the line {joined(plain(root.a), plain(root.b))}"
    turns = "".join(f", turned by angle {joined(*datum.points)}" for datum, _ in direction.turns)
    return f"{'the reverse of ' if direction.flip else ''}{start}{turns}"


def locus_words(locus: Locus) -> str:
    """A locus by what makes it."""
    if isinstance(locus, CircleLocus):
        return f"the circle about {plain(locus.centre)} of radius {span_words(locus.radius)}"
    if isinstance(locus, Tether):
        return f"the circle about {plain(locus.centre)} that the {datum_words(locus.rope)} leaves"
    if isinstance(locus, ArcLocus):
        return f"the circle of {datum_words(locus.corner)}"
    if isinstance(locus, Axis):
        return f"the line of its given {locus.datum.kind}"
    if isinstance(locus, Shifted):
        return f"{locus_words(locus.base)}, moved by {span_words(locus.span)}"
    what = "ray" if locus.ray else "line"
    return f"the {what} from {plain(locus.through)} along {direction_words(locus.direction)}"


def step_words(step: Step) -> str:
    """A step of a construction as a sentence."""
    return f"{', '.join(map(plain, step.targets))}: {_how(step)}"


def _how(step: Step) -> str:
    match step:
        case Given():
            return "by coordinates"
        case Mean(_, datum, _, centroid):
            of = ", ".join(map(plain, datum.points[1:]))
            return (
                f"centroid of {of}" if centroid is None else f"from {plain(centroid)}, the centroid of {of}"
            )
        case Polar(_, base, span, direction):
            return f"from {plain(base)} by {span_words(span)} along {direction_words(direction)}"
        case Meet(_, first, second, sign):
            words = f"where {locus_words(first)} meets {locus_words(second)}"
            if sign == 0:
                return f"{words} (touching)" if is_round(second) else words
            side = ("left", "right") if is_round(first) else ("farther", "nearer")
            return f"{words} ({side[sign < 0]})"
        case Base(_, _, span):
            return f"{span_words(span)} apart, a shape still to be placed"
        case Turned(_, base, direction):
            root, held = direction.root, direction_words(direction)
            if isinstance(root, Apart) and root.a == base and not direction.turns:
                held = plain(root.b)
            return f"carried by the shape that {plain(base)} and {held} hold"
        case PointGroup(_, equations):
            return f"together, by Newton's method on their {len(equations)} data"


def measure(workspace: Workspace, length: float) -> str:
    """A normalised length with its unit."""
    return f"{length / workspace.frame.scale:.6g} {workspace.case.units.length}"


def bare(workspace: Workspace, length: float) -> str:
    """A normalised length in case units."""
    return f"{length / workspace.frame.scale:.6g}"


def all_but_in_line(workspace: Workspace, sides: Sequence[Datum], gap: float) -> str:
    """The note on points that three lengths put in line but for their last digits."""
    names = listed([joined(*side.points) for side in sides])
    return (
        f"{names} put their points in line but for {measure(workspace, gap)}, which half a unit of the last "
        "digits of numbers of 15 digits or more explains: they count as in line."
    )


def too_far(step: Meet, workspace: Workspace, gaps: list[float]) -> Miss:
    """Two loci that do not meet."""
    gap = -min(gaps)
    if isinstance(step.first, CircleLocus) and isinstance(step.second, CircleLocus):
        return Miss(Status.CANNOT_ASSEMBLE, _circles(step, step.first, step.second, workspace, gaps), gap)
    message = (
        f"the figure cannot be assembled at {plain(step.target)}: {locus_words(step.first)} and "
        f"{locus_words(step.second)} do not meet (closest gap {measure(workspace, gap)})"
    )
    return Miss(Status.CANNOT_ASSEMBLE, message, gap)


def _circles(step: Meet, one: CircleLocus, two: CircleLocus, workspace: Workspace, gaps: list[float]) -> str:
    a, b, at = plain(one.centre), plain(two.centre), plain(step.target)
    gap = -min(gaps)
    apart = math.dist(workspace.points[one.centre], workspace.points[two.centre])
    kind = "too far" if gaps[0] < 0.0 else "too close"
    first, second = (
        f"{span_words(c.radius)} = {bare(workspace, workspace.length(c.radius))}" for c in (one, two)
    )
    return (
        f"{first} and {second} cannot meet at {at}: {a} and {b} are {bare(workspace, apart)} apart, "
        f"{bare(workspace, gap)} {kind} (closest gap {measure(workspace, gap)})"
    )


def concentric(step: Meet, workspace: Workspace) -> Miss:
    """Two circles about one centre."""
    a, b = (c.radius for c in step.loci(workspace) if isinstance(c, PlacedCircle))
    at = plain(step.target)
    centres = " and ".join(plain(c.centre) for c in (step.first, step.second) if isinstance(c, CircleLocus))
    if math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-300):
        message = (
            f"{at} may lie anywhere about {centres}: they coincide and their distances to {at} are equal, "
            f"so any angle fits; give a direction (angles) or coordinates of {at}"
        )
        return Miss(Status.UNDERDETERMINED, message, 0.0, frozenset((step.first, step.second)))
    message = (
        f"the figure cannot be assembled at {at}: {centres} coincide, but their distances to {at} are "
        f"{bare(workspace, a)} and {bare(workspace, b)} (gap {measure(workspace, abs(a - b))})"
    )
    return Miss(Status.CANNOT_ASSEMBLE, message, abs(a - b))


def parallel(step: Meet, workspace: Workspace) -> Miss:
    """Two lines that are parallel, or are one line."""
    ((px, py), (ux, uy)), ((qx, qy), _) = step.loci(workspace)
    off = abs(ux * (qy - py) - uy * (qx - px))
    lines = f"{locus_words(step.first)} and {locus_words(step.second)}"
    at = plain(step.target)
    if off <= 1e-12 * (1.0 + math.hypot(px, py) + math.hypot(qx, qy)):
        message = (
            f"{at} may lie anywhere on a line: {lines} coincide; give one more length or coordinate for {at}"
        )
        return Miss(Status.UNDERDETERMINED, message, 0.0, frozenset((step.first, step.second)))
    message = (
        f"the figure cannot be assembled at {at}: {lines} are parallel, {measure(workspace, off)} apart, "
        "and never meet"
    )
    return Miss(Status.CANNOT_ASSEMBLE, message, off)


def behind(step: Meet, workspace: Workspace, amount: float) -> Miss:
    """A point that lies on the wrong side of a ray's start."""
    message = (
        f"the figure cannot be assembled at {plain(step.target)}: {locus_words(step.first)} meets "
        f"{locus_words(step.second)} only on the wrong side, {measure(workspace, -amount)} "
        "behind the ray's start"
    )
    return Miss(Status.CANNOT_ASSEMBLE, message, abs(amount))


def merged(target: str, a: str, b: str) -> Miss:
    """A direction between two points that coincide."""
    message = f"{target} has no place: its data go by the direction from {a} to {b}, and these coincide"
    return Miss(Status.CANNOT_ASSEMBLE, message, vague=True)


def degenerate(step: Step, workspace: Workspace) -> Miss:
    """A step that divides by zero: parallel lines, concentric circles."""
    if isinstance(step, Meet):
        return concentric(step, workspace) if is_round(step.second) else parallel(step, workspace)
    message = f"{plain(step.targets[0])} has no place ({step_words(step)})"
    return Miss(Status.CANNOT_ASSEMBLE, message, vague=True)


class Mirrored(Floats):
    """Floats on which every angle counts the other way round."""

    def turn(self, number: Number) -> tuple[float, float]:
        """Cosine, and the sine of the opposite angle."""
        c, s = turn_of(number.value)
        return c, -s


Turning = Polar | Meet | Turned
"""The steps that an angle may turn."""
ROUGH = 0.05
"""What `near` may be off, over the figure's size: a mirrored place that is meant is nearer by more."""


def mirrored(
    workspace: Workspace, steps: Sequence[Turning], near: Mapping[str, tuple[float, float]], size: float
) -> Miss | None:
    """The first point whose `near` lies where the opposite angles would put it, and not where it is."""
    for step in steps:
        angles = [d for d in data_in(step) if d.kind in (RAY, CORNER)]
        p = str(step.target)
        at, other = workspace.points[p], _opposite(step, workspace, near[p])
        off, beside = math.dist(at, near[p]), math.dist(other, near[p])
        if beside + ROUGH * size < off and beside < math.dist(other, at) / 2.0:
            return Miss(Status.INCONSISTENT, _mirrored(workspace, p, at, angles))
    return None


def _opposite(step: Turning, workspace: Workspace, near: tuple[float, float]) -> tuple[float, float]:
    """Where the opposite angles would put a step's point: of two places the one nearer to its `near`."""
    scratch = Workspace(workspace.case, workspace.frame, Mirrored())
    scratch.points = dict(workspace.points)
    places = []
    signs = (1, -1) if isinstance(step, Meet) and step.sign else (0,)
    for sign in signs:
        (step._replace(sign=sign) if isinstance(step, Meet) else step).place(scratch)
        x, y = scratch.points[step.target]
        places.append((float(x), float(y)))
    return min(places, key=lambda at: math.dist(at, near))


def _mirrored(workspace: Workspace, p: str, at: tuple[float, float], angles: list[Datum]) -> str:
    said = " and ".join(f"{joined(*d.points)} = {number_of(workspace.case, d).value:.6g}" for d in angles)
    x, y = case_point(workspace.frame, at)
    corner = angles[-1]
    how = "from the x axis"
    if corner.kind == CORNER:
        a, v, b = map(plain, corner.points)
        how = f"from {joined(v, a)} to {joined(v, b)}"
    return (
        f"near: has {plain(p)} on the other side: {said}, counterclockwise {how}, puts it at "
        f"({x:.6g}, {y:.6g}), mirrored; write the opposite angle, or correct near: {{{plain(p)}: ...}}"
    )


def clash(workspace: Workspace, datum: Datum, off: float, ahead: bool) -> Miss:
    """A datum that the points contradict."""
    return Miss(Status.INCONSISTENT, _clash(workspace, datum, off, ahead), abs(off) if ahead else math.inf)


def _clash(workspace: Workspace, datum: Datum, off: float, ahead: bool) -> str:
    points, kind = datum.points, datum.kind
    name = plain(points[0])
    if kind == MEAN:
        of = ", ".join(map(plain, points[1:]))
        return f"{name} is {measure(workspace, abs(off))} off the centroid of {of}"
    if kind == CORNER and (none := [p for p in points[::2] if _apart(workspace, p, points[1]) <= TOO_CLOSE]):
        return f"{datum_words(datum)} has no direction: {plain(none[0])} and {plain(points[1])} are one point"
    if kind in (LENGTH, ROPE, RAY, CORNER, X, Y):
        subject, value, found = _values(workspace, datum, off)
        given = {*given_points(workspace.case)} >= {*points}
        makers = "the coordinates make" if given else "the other data make"
        return f"{subject} is given as {value}, {makers} it {found}"
    if not ahead:
        return f"{datum_words(datum)} has no direction: {joined(*points[2:])} are one point"
    along = joined(*points[2:]) if kind == LINE else f"{number_of(workspace.case, datum).value:.6g} deg"
    line = f"the line through {plain(points[1])} along {along}"
    return f"{name} is {measure(workspace, abs(off))} off its guide, {line}"


def _apart(workspace: Workspace, p: Key, q: Key) -> float:
    return math.dist(workspace.points[p], workspace.points[q])


def _values(workspace: Workspace, datum: Datum, off: float) -> tuple[str, str, str]:
    """What a number is of, the number, and what the points make it."""
    points, kind = datum.points, datum.kind
    if kind in (LENGTH, ROPE):
        length = workspace.length(datum)
        subject = joined(*points) if kind == LENGTH else f"the {datum_words(datum)}"
        return subject, bare(workspace, length), bare(workspace, length + off)
    value = number_of(workspace.case, datum).value
    if kind in (X, Y):
        return datum_words(datum), f"{value:.6g}", f"{value + off / workspace.frame.scale:.6g}"
    return datum_words(datum), f"{value:.6g}", _angle(workspace, datum)


def _angle(workspace: Workspace, datum: Datum) -> str:
    """What the points make of an angle: 0 to 360 degrees, -180 to 180 where a negative one is given."""
    at = [workspace.points[p] for p in datum.points]
    if datum.kind == RAY:
        (ax, ay), (bx, by) = at
        angle = math.atan2(by - ay, bx - ax)
    else:
        (ax, ay), (vx, vy), (bx, by) = at
        angle = math.atan2(by - vy, bx - vx) - math.atan2(ay - vy, ax - vx)
    degrees = math.degrees(angle)
    negative = number_of(workspace.case, datum).value < 0.0
    return f"{math.remainder(degrees, 360.0) if negative else degrees % 360.0:.6g}"


# --- data that the construction did not need: compared with the figure, and said so ---


SURE = 1e-12
"""A residual (normalised) is known where its bound is less than this."""
OF_SIZE = 0.002
"""Data that are off by more of the figure's size contradict it, whatever their last decimals are."""


def compare(
    workspace: Workspace, steps: tuple[Step, ...], data: list[Datum], size: float
) -> tuple[Miss | None, dict[Datum, float]]:
    """The first datum that the points contradict, and how far off each of the others is."""
    offs: dict[Datum, float] = {}
    for datum in data:
        off, ahead = residual(workspace, datum)
        if is_vague(workspace, datum):
            off, ahead = _closely(workspace, steps, datum) or (off, ahead)
        if not ahead:
            return clash(workspace, datum, off, ahead), offs
        offs[datum] = abs(off)
        if abs(off) <= ROUNDING * size:
            continue
        if abs(off) > OF_SIZE * size or abs(off) > allowance(workspace, steps, datum):
            return clash(workspace, datum, off, ahead), offs
    return None, offs


def _closely(workspace: Workspace, steps: tuple[Step, ...], datum: Datum) -> Residual | None:
    """The residual in as many digits as it takes; None where none tell it."""
    from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

    for digits in PRECISIONS:
        balls = Balls(digits, highest=digits == PRECISIONS[-1])
        exact = Workspace(workspace.case, workspace.frame, balls)
        try:
            for step in leading_to(datum.points, steps):
                step.place(exact)
            off, ahead = residual(exact, datum)
            values = [CONDITIONS[datum.kind](exact, datum, part).value for part in parts_of(datum)]
            open_ = max(float(getattr(value, "radius", 0.0)) for value in values)
            if open_ <= SURE * (scale_of(exact, datum)[0] or 1.0):
                return off, ahead
        except (MoreDigits, BelowZero, ZeroDivisionError):
            continue
    return None


def allowance(workspace: Workspace, steps: tuple[Step, ...], datum: Datum) -> float:
    """What half a unit of every number involved does to a residual, to first order: the sum of all."""
    from icsolve.numbers.tape import Tape

    case, tape = workspace.case, Tape()
    exact = Workspace(case, workspace.frame, tape)
    size, _ = scale_of(workspace, datum)
    try:
        for step in leading_to(datum.points, steps):
            step.place(exact)
        values = [CONDITIONS[datum.kind](exact, datum, part).value for part in parts_of(datum)]
        slopes = [tape.back(value).by_path for value in values]
    except ZeroDivisionError:
        return math.inf
    numbers = numbers_in(case.points, case.lengths, case.angles, case.joints, case.ropes)
    halves = {number.path: number.half for number in numbers}
    return max(sum(abs(slope) * halves[path] for path, slope in by.items()) for by in slopes) / (size or 1.0)


def notes_of(
    workspace: Workspace, offs: Mapping[Datum, float], used: frozenset[Datum], given: bool, size: float
) -> tuple[str, ...]:
    """Which data set the points and which were only compared, where there were more than needed."""
    spare = {
        datum: off
        for datum, off in offs.items()
        if datum not in used and (off > ROUNDING * size or datum.kind not in (GUIDE, LINE))
    }
    if not spare:
        return ()
    setters = ["the coordinates"] if given else []
    for kinds, one, many in (((LENGTH,), "length", "lengths"), ((RAY, CORNER), "angle", "angles")):
        names = sorted(joined(*d.points) for d in used if d.kind in kinds)
        if names:
            setters.append(f"{one if len(names) == 1 else many} {', '.join(names)}")
    only = "; ".join(
        f"{_said(workspace, datum)} "
        + ("(agrees)" if off <= ROUNDING * size else f"(off by {measure(workspace, off)})")
        for datum, off in spare.items()
    )
    by = f"set by {listed(setters)}" if setters else "set by the other data"
    return (f"more data than the figure needs: the points are {by}; only compared: {only}",)


def _said(workspace: Workspace, datum: Datum) -> str:
    if datum.kind in (MEAN, LINE, GUIDE):
        return datum_words(datum)
    return f"{datum_words(datum)} = {number_of(workspace.case, datum).value:.6g}"
