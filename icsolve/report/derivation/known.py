"""All that is known of a scene: its answer or why there is none, every point that can be placed, how the
links move, and what loads and ropes do to them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer import Answer, Centre, Found, by_load
from icsolve.answer.equilibrium import EquilibriumPosition
from icsolve.assembly import Frame, case_point, solve_figure
from icsolve.assembly.workspace import PlacedCase
from icsolve.case import (
    Case,
    ForceVector,
    Like,
    Load,
    Pair,
    Rope,
    Torque,
    is_angle,
    ordered_pair,
    told_links,
)
from icsolve.case.figure import Unknown
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS, turn_of
from icsolve.scene.parts import AnswerBuilder, scene_of
from icsolve.screws import Point, Triple
from icsolve.screws.ropes import rope_parts
from icsolve.solve import Attempt, attempt
from icsolve.statics.load_wrenches import Wrench, as_given, line_of, place_of, points_of, wrenches
from icsolve.statics.power import has_friction, is_unknown, known_value
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import unit_of


class Known(NamedTuple):
    """What is known of a case, in case units.

    ``answer`` is None where the scene has none; ``refusal`` then says why. ``whole`` has all centres,
    rates and velocities (where it has no answer, those of the mechanism without its loads; None where
    nothing is known to move, and of a case in space). ``points`` has the hidden ones too. ``twists`` are
    the links' motions ``omega * (x, y, 1)``, those only that the case determines; ``size`` is the figure's.
    """

    case: Case
    answer: Answer | None
    refusal: SceneError | None
    whole: Answer | None
    points: Mapping[str, Point]
    twists: Mapping[str, Triple]
    size: float
    posed: tuple[Unknown, ...] = ()
    """the data of the figure that are asked for"""
    written: Case | None = None
    """the case as it is written, where its figure is moved from there"""
    given: Case | None = None
    """the case as it is asked, where its profiles place contacts in ``case``, and points with them"""

    @property
    def scene(self) -> AnswerBuilder | None:
        """The solved scene; None where nothing is known to move."""
        return None if self.whole is None else scene_of(self.whole)

    @property
    def structure(self) -> bool:
        """Whether nothing can move, so that statics alone gives what there is to find."""
        reactions = None if self.answer is None else self.answer.reactions
        return reactions is not None and self.scene is None

    @property
    def asks_holding(self) -> bool:
        """Whether it is asked if friction holds loads that are all known."""
        case = self.case
        given = case.loads and not any(map(is_unknown, case.loads))
        return bool(given) and not (case.motion or self.posed or self.structure) and has_friction(case)

    @property
    def title(self) -> str:
        """What the case is called."""
        return self.case.title or self.case.name

    @property
    def as_asked(self) -> Known:
        """The case as an exercise has it: without its answer, and without inertia forces, which are found;
        where a position is asked for, in another one."""
        here = _elsewhere(self) if self.posed else self
        return here._replace(answer=None, refusal=None, case=as_given(here.case), posed=self.posed)

    def centre(self, a: str, b: str) -> Centre | None:
        """The centre of two links, where one is known."""
        if self.whole is None:
            return None
        found = self.whole.centres.get(ordered_pair(self.case, a, b))
        return _by_roller(self, found) if found is not None and found.by == "loop equations" else found

    def pair(self, a: str, b: str) -> Pair:
        """The pair of links as it is named."""
        return ordered_pair(self.case, a, b)

    def rests(self, link: str) -> bool:
        """Whether a link is known not to move."""
        return self.twists.get(link) == (0.0, 0.0, 0.0)

    def slides(self, link: str) -> bool:
        """Whether a link is known not to turn."""
        return link in self.twists and self.twists[link][2] == 0.0

    def turns(self, link: str) -> bool:
        """Whether a link is known to turn."""
        return link in self.twists and self.twists[link][2] != 0.0


ON_NORMAL = 1e-9
"""A centre lies on a common normal where it is so near, of the figure's size."""


def _by_roller(known: Known, centre: Centre) -> Centre:
    """The centre of a cam and its follower, whose roller turns freely: the centres of the roller with both
    lie on the common normal, so theirs does, and on the line of theirs with the frame."""
    case, ground = known.case, known.case.ground
    if centre.kind != "at" or ground in centre.pair or known.whole is None:
        return centre
    for touch in case.joints:
        if touch.at not in known.points or touch.direction is None or not touch.only_pushes:
            continue
        for pin in case.joints:
            if pin.pivot is None or len({*touch.links} & {*pin.links}) != 1:
                continue
            both = {*touch.links} ^ {*pin.links}
            own = [known.whole.centres.get(ordered_pair(case, ground, link)) for link in centre.pair]
            (x, y), (u, v) = known.points[touch.at or ""], turn_of(touch.direction.value)
            places = (known.points[pin.pivot], centre.place)
            near = all(abs((px - x) * v - (py - y) * u) <= ON_NORMAL * known.size for px, py in places)
            if both == {*centre.pair} and near and all(c is not None and c.by == "inspection" for c in own):
                frame = tuple(ordered_pair(case, ground, link) for link in centre.pair)
                lines = (frame, (ordered_pair(case, *touch.links),))
                return centre._replace(by="construction", lines=lines)
    return centre


def known_of(case: Case, *, reactions: bool = False, centres: bool = True) -> Known:
    """Solve a case as far as it goes, with the pulls of its ropes, and its ``centres`` where they will be
    asked for; never raises `SceneError`."""
    found = attempt(case, reactions=reactions or bool(case.ropes))
    try:
        return _told(case, found, centres)
    except SceneError as undecided:  # what is worked out when it is asked for may need too many digits
        return _told(case, Attempt(None, found.refusal or undecided, None), False)


def _told(case: Case, found: Attempt, centres: bool) -> Known:
    if case.unknowns or (found.answer is not None and found.answer.positions):
        return _at_rest(case, found.answer, found.refusal)
    if case.space is not None:
        return Known(case, found.answer, found.refusal, None, {}, {}, 0.0)
    scene = found.scene
    own = case if scene is None else scene.case  # with the contacts where profiles put them
    points = _points(own, found.answer, scene)
    whole, twists = found.answer, {}
    try:  # where nothing moves, or given motions contradict one another, there is no motion to tell
        whole = whole if scene is None else scene.moving()
        scene = None if whole is None else scene_of(whole)
        twists = {} if scene is None else scene.twists
    except SceneError:
        pass
    if whole is not None and centres:
        len(whole.centres)
    asked = case if case.touches and own.joints != case.joints else None
    return Known(own, found.answer, found.refusal, whole, points, twists, _size(points), given=asked)


def _at_rest(case: Case, answer: Answer | None, refusal: SceneError | None) -> Known:
    """A case that asks for a position, in the first one that is stable (else the first; where there is none,
    in the middle of what was searched)."""
    from icsolve.solve.load_function import given_at

    positions = _by_stability(answer)
    if positions:
        at = {path: held if isinstance(held, float) else held[0] for path, held in positions[0].at.items()}
    else:
        at = {unknown.path: _somewhere(unknown) for unknown in case.unknowns}
    own, written = replace(case, unknowns=(), expect=()), None
    for path, value in at.items():
        own = given_at(own, path, value)
    if positions and any(one.start for one in case.unknowns):  # all that is written has moved with its links
        written = own
        row, angles = positions[0].answer.case, tuple(one for one in own.angles if one.value.path in at)
        own = replace(row, lengths=own.lengths, angles=angles, unknowns=(), expect=())
    elif positions:  # other ways in which the figure assembles at this value are not meant
        here, placed = positions[0].answer.shown_points, own.given_places
        own = replace(own, near={name: at for name, at in here.items() if name not in placed})
    known = known_of(own)
    posed = case.unknowns or tuple(map(Unknown, at))
    if answer is None or known.answer is None:
        return known._replace(answer=None, refusal=refusal or known.refusal, posed=posed, written=written)
    shown = replace(known.answer, positions=answer.positions, notes=answer.notes)
    if positions:
        shown = replace(shown, reactions=positions[0].answer.reactions)
    return known._replace(answer=shown, posed=posed, written=written)


def _by_stability(answer: Answer | None) -> list[EquilibriumPosition]:
    """The positions of an answer, the stable ones first."""
    return sorted((answer and answer.positions) or (), key=lambda one: one.stability != "stable")


def resting(known: Known) -> EquilibriumPosition | None:
    """The position that is shown of a case that asks for one."""
    return next(iter(_by_stability(known.answer)), None) if known.posed else None


APART = 0.05
"""A figure that does not tell a position asked for is so far from it at least, of what is searched."""


def _elsewhere(known: Known) -> Known:
    """The figure of a case that asks for a position, in one that is none: as it is written, or somewhere in
    what is searched where it assembles."""
    from icsolve.solve.load_function import given_at

    positions = () if known.answer is None else known.answer.positions or ()
    for share in (0.5, 0.35, 0.65, 0.2, 0.8, 0.42, 0.58, 0.9, 0.1):
        own, clear = known.written or known.case, True
        for unknown in known.posed:
            rests = [v if isinstance(v, float) else v[0] for one in positions for v in [one.at[unknown.path]]]
            low, high = _searched(unknown, rests)
            start = None if unknown.start is None else unknown.start.value
            value = low + share * (high - low) if start is None else start
            clear = clear and (
                start is not None or all(abs(value - at) > APART * (high - low) for at in rests)
            )
            own = given_at(own, unknown.path, value)
        moved = known_of(own) if clear else known
        if clear and moved.points.keys() >= known.points.keys():
            return moved
    return known


def _searched(unknown: Unknown, rests: Sequence[float]) -> Point:
    """The range that is given; of an angle a quarter to each side of a position, of another datum so much as
    keeps its sign."""
    if unknown.low is not None and unknown.high is not None:
        return unknown.low.value, unknown.high.value
    middle = rests[0] if rests else _somewhere(unknown)
    half = 90.0 if is_angle(unknown.path) else 0.5 * abs(middle) or 0.5
    return middle - half, middle + half


def known_at(known: Known, answer: Answer) -> Known:
    """The same of a position that was found, from the answer in it."""
    points = _points(answer.case, answer, scene_of(answer))
    return known._replace(case=answer.case, answer=answer, whole=answer, points=points, twists={})


def _somewhere(unknown: Unknown) -> float:
    """A value of a datum that is asked for."""
    if unknown.start is not None:
        return unknown.start.value
    ends = [end.value for end in (unknown.low, unknown.high) if end is not None]
    return sum(ends) / len(ends) if ends else 1.0


def _points(case: Case, answer: Answer | None, scene: AnswerBuilder | None) -> dict[str, Point]:
    """Every point that can be placed, in case units: those of the answer, and what the figure has beside."""
    names = list(dict.fromkeys((*case.points, *(p for ps in case.carries.values() for p in ps))))
    found = {} if answer is None else dict(answer.points)
    if scene is not None:
        found = {p: case_point(scene.figure.frame, at) for p, at in scene.figure.points.items()}
    found.update((name, at) for name, at in case.given_places.items() if name not in found)
    return found if set(names) <= set(found) else {**_figure(case, names), **found}


def _figure(case: Case, names: list[str]) -> dict[str, Point]:
    """All points of a figure, or each that can be placed alone."""
    try:
        figure = solve_figure(case)
    except SceneError:
        return {name: place for name in names if (place := _alone(case, name)) is not None}
    return {name: case_point(figure.frame, place) for name, place in figure.points.items()}


def _alone(case: Case, name: str) -> Point | None:
    try:
        figure = solve_figure(case, (name,))
    except SceneError:
        return None
    return case_point(figure.frame, figure.points[name])


def _size(points: Mapping[str, Point]) -> float:
    xs, ys = [x for x, _ in points.values()], [y for _, y in points.values()]
    return max(max(xs) - min(xs), max(ys) - min(ys), 0.0) if points else 0.0


# --- what loads exert ------------------------------------------------------------------------------------


class Acting(NamedTuple):
    """A load as it acts on ``link``; the opposite acts on ``against``.

    ``value`` is its number in ``unit`` (None where it was not found, or where it is ``held`` over a range),
    ``gain`` the force (force times
    length for a torque) per unit of it, ``direction`` the unit vector of a force of positive value;
    ``at`` the point's place, None for a torque.
    """

    load: Load
    link: str
    against: str
    at: Point | None
    direction: Point
    gain: float
    value: float | None
    unit: str
    unknown: bool
    held: Found | None = None

    @property
    def force(self) -> Point:
        """Components of the force in force units; zero for a torque, and where the number is not known."""
        size = 0.0 if self.at is None else (self.value or 0.0) * self.gain
        return (size * self.direction[0], size * self.direction[1])

    @property
    def sign(self) -> int:
        """-1 for a torque that is positive clockwise: its power has a minus in the equation."""
        return -1 if isinstance(self.load, Torque) and self.load.turns == "cw" else 1

    @property
    def couple(self) -> float:
        """The torque in force times length, ccw positive; zero for a force."""
        return (self.value or 0.0) * self.gain if self.at is None else 0.0


def acting_loads(known: Known) -> list[Acting]:
    """The loads whose points are known, in order."""
    case = known.case
    placed = [load for load in case.loads if set(points_of(load)) <= set(known.points)]
    names = {load.name for load in placed}
    placed = [load for load in placed if _like(load) in (None, *names)]
    some = replace(case, loads=tuple(placed))
    try:
        found = wrenches(PlacedCase(some, Frame(0.0, 0.0, 1.0), known.points, FLOATS))
    except (SceneError, ZeroDivisionError):
        return []
    return [_acting(known, w) for w in found]


def _like(load: Load) -> str | None:
    """The load whose number a load takes."""
    value = None if isinstance(load, ForceVector) else load.value
    return value.load if isinstance(value, Like) else None


def _acting(known: Known, w: Wrench) -> Acting:
    number = known_value(w)
    found = None if known.answer is None else by_load(known.answer.answers).get(w.load.name)
    held = None if found is None or found.holds is None else found
    if number is not None:
        value: float | None = float(w.ratio) * number
    else:
        value = None if found is None or held is not None else found.value
    at = place_of(w.load, known.points)
    torque = at is None
    gain = float(w.gain) * (float(w.unit[2]) if torque else 1.0)
    direction = (0.0, 0.0) if torque else (float(w.unit[1]), -float(w.unit[0]))
    unit = unit_of(w.load, known.case)
    return Acting(w.load, w.load.link, w.against, at, direction, gain, value, unit, number is None, held)


# --- what ropes do to a link -----------------------------------------------------------------------------


class Pull(NamedTuple):
    """``strands`` parts of a rope, on one line, pull ``link`` along ``direction`` at a place of the line.

    ``part`` is the number of the first from 1, ``tension`` what each pulls with (None where it is not known),
    ``symbol`` its name with what stands low, ``where`` the part by its points (or their common point). The
    link of a free end is the rope's ``end``.
    """

    rope: Rope
    part: int
    strands: int
    link: str
    at: Point
    direction: Point
    tension: float | None
    symbol: tuple[str, str]
    where: str

    @property
    def force(self) -> Point:
        """What all of them pull with; zero where that is not known."""
        size = self.strands * (self.tension or 0.0)
        return (size * self.direction[0], size * self.direction[1])


def rope_pulls(known: Known, rope: Rope) -> list[Pull]:
    """The pulls of a rope on all links, its free end and the frame; none where it can't be laid."""
    try:
        parts = rope_parts(rope, known.points, 1.0, FLOATS)
    except (SceneError, KeyError):
        return []
    tensions = () if known.answer is None else known.answer.tensions
    found = next((t for t in tensions if t.rope == rope.name), None)
    pulls = []
    for n, part in enumerate(parts, 1):
        pull = None if found is None else found.parts[n - 1] if found.parts else found.tension
        symbol = tension_name(known.case, rope, n if rope.slips else 0)
        (x, y), (u, v), length = part.at, part.along, float(part.length)
        where = "".join(rope.points[n - 1 : n + 1]) if all(len(p) == 1 for p in rope.points) else f"part {n}"
        ends = ((part.links[0], (x, y), (u, v)), (part.links[1], (x + length * u, y + length * v), (-u, -v)))
        for end, (link, at, way) in enumerate(ends):
            own = Pull(rope, n, 1, link or rope.end, at, way, pull, symbol, where)
            pulls.append((own, rope.points[n - 1 + end]))
    alike = Counter((p.link, p.at, p.direction, p.symbol) for p, _ in pulls)
    merged: dict[object, Pull] = {}
    for p, point in pulls:
        key = (p.link, p.at, p.direction, p.symbol)
        many = p._replace(strands=alike[key], where=point) if alike[key] > 1 else p
        merged.setdefault(key, many)
    return list(merged.values())


def pulls_on(known: Known, link: str) -> Iterable[Pull]:
    """The pulls of all ropes on a link, where their tensions are known."""
    for rope in known.case.ropes:
        for pull in rope_pulls(known, rope):
            if pull.link == link and pull.tension is not None:
                yield pull


def tension_name(case: Case, rope: Rope, part: int) -> tuple[str, str]:
    """The symbol of a rope's tension, and what stands low: T, of its second ``part`` T2; with the rope's
    name where there are several, or a load is called so."""
    low = str(part) if part else ""
    if len(case.ropes) > 1 or f"T{low}" in {load.name for load in case.loads}:
        low = f"{rope.name},{low}" if low else rope.name
    return ("T", low)


def moving_names(case: Case) -> tuple[str, ...]:
    """The links, and what stands for one: free ends of ropes, screws that a torque turns."""
    ends = (rope.end for rope in case.ropes if rope.is_free)
    return (*case.links, *ends, *(screw.rotor for screw in case.screws))


# --- bars: links that forces load at two points alone ---------------------------------------------------


ALONG = 1e-9
"""Of the length of a bar, and of its force: places are one, and forces along it, but for rounding."""

ROUNDED = 1e-14
"""What is left of the forces at an end, as a part of them, is rounding."""


def bars_of(answer: Answer) -> dict[str, float]:
    """The force along each link that is loaded at two points alone and by no couple, as its end without a
    load has it: positive where the bar is pulled [case force]. None is told of what equilibrium leaves open,
    nor of the barrel of a cylinder that its joints would have without force.
    """
    case, found = answer.case, dict[str, float]()
    tied = {link for rope in case.ropes for link in rope.links}
    tied.update(link for screw in case.screws for link in screw.links)
    strained = {
        link
        for load in case.loads
        if (other := getattr(load, "against", None))
        for link in (load.link, other)
    }
    moved = answer.accelerations is not None  # inertia forces act all along
    if answer.reactions is None or moved:
        return {}
    for link in told_links(case):
        held = [] if link == case.ground else [r for _, r in answer.reactions.of_link(link)]
        ends = [*dict.fromkeys(r.at for r in held)]
        if len(ends) != 2 or link in tied or any(None in (r.x, r.y) or r.moment != 0.0 for r in held):
            continue
        places, span = _loaded(answer, link), math.dist(*ends)
        free = [end for end in ends if not any(p and math.dist(p, end) <= ALONG * span for p in places)]
        if not free or not all(p and min(math.dist(p, end) for end in ends) <= ALONG * span for p in places):
            continue
        x, y = (sum(getattr(r, part) for r in held if r.at == free[0]) for part in "xy")
        own, other = free[0], ends[1 - ends.index(free[0])]
        u, v = ((a - b) / span for a, b in zip(own, other, strict=True))
        size = sum(r.magnitude or 0.0 for r in held if r.at == free[0])
        if math.hypot(x, y) <= ROUNDED * size:
            if link not in strained:
                found[link] = 0.0
        elif abs(x * v - y * u) <= ALONG * math.hypot(x, y):
            found[link] = x * u + y * v
    return found


def _loaded(answer: Answer, link: str) -> list[Point | None]:
    """The places of the loads on a link; None of a couple, and of a load along a line."""
    points = {
        **answer.case.given_places,
        **answer.points,
    }  # the case alone has those of loads at coordinates
    return [place for load in answer.case.loads for place in _places(answer.case, points, load, link)]


def _places(case: Case, points: Mapping[str, Point], load: Load, link: str) -> list[Point | None]:
    if link not in (load.link, getattr(load, "against", None) or case.ground):
        return []
    if not points.keys() >= {*points_of(load)}:  # spread along a line
        return [None]
    if link == load.link:
        return [place_of(load, points)]
    line = line_of(load)
    return [place_of(load, points) if line is None else points[line[1]]]
