"""The positions of a mechanism over the whole range of its input, solved beforehand by the sweep; and what
acts on every link in each of them, as a figure of free bodies draws it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from icsolve.answer import Answer, by_load
from icsolve.case import (
    Case,
    Centroid,
    Coordinates,
    Like,
    Load,
    Number,
    Pair,
    Torque,
    is_link,
    is_named,
    pair_name,
)
from icsolve.case.joints import Guided, Mesh, without_friction
from icsolve.draw.bodies import DrawnPush, pushes_on
from icsolve.draw.figure import genevas
from icsolve.draw.loads import round_at_most
from icsolve.draw.marks import plain_text
from icsolve.draw.plot import DEAD, asymptotes, dead_centres
from icsolve.draw.scene import Scene
from icsolve.draw.words import figure_number, unit_word
from icsolve.errors import SceneError, Status
from icsolve.page.poses import Array, PagePose, exact, poses_of
from icsolve.report.derivation.known import Known, known_at
from icsolve.report.derivation.ratios import loaded_links
from icsolve.scene import solve_scene
from icsolve.scene.refusals import rubs
from icsolve.screws import Point, Triple
from icsolve.statics.load_wrenches import as_given
from icsolve.statics.power import is_unknown
from icsolve.structure import welded
from icsolve.sweep import Sweep, sweep
from icsolve.sweep.request import RequestError
from icsolve.tuples import NamedTuple, replace

STILL = 1e-12
"""A part of the figure's size: a link that turns by less, for a way as long as the figure, only slides."""
ROWS = 50
"""Positions to either side of the one as written where everything slides."""


class PageInput(NamedTuple):
    """A link, and where it slides, for each coordinate that then changes (by its path) its number as written
    and its change by one unit of the link's way; ``unit`` and ``senses`` say how a position is told."""

    link: str
    slides: Mapping[str, tuple[float, float]] = {}
    unit: str = "°"
    senses: tuple[str, str] = ("counterclockwise", "clockwise")

    @property
    def verb(self) -> str:
        """What is done to the link."""
        return "moved" if self.slides else "turned"

    @property
    def unit_name(self) -> str:
        """The unit of its positions as an axis has it."""
        return self.unit.strip() if self.slides else "degrees"

    def driven(self, rows: Array) -> dict[str, Array]:
        """The sweep's ``drive``."""
        return {} if self.slides else {self.link: rows}

    def varied(self, rows: Array) -> dict[str, Array]:
        """The sweep's ``vary``."""
        return {path: start + pace * rows for path, (start, pace) in self.slides.items()}


def sliding(known: Known) -> tuple[Case, PageInput] | None:
    """The case with all points by coordinates, and its input, where every link only slides; None elsewhere.

    No guide turns then, so that every link goes straight on at the velocity of the position as written.
    """
    case = known.case
    if known.answer is None or known.answer.mobility != 1:
        return None
    nameless = any(not is_named(name) for name in known.points)
    if nameless or not all(joint.stays_known and not isinstance(joint, Mesh) for joint in case.joints):
        return None
    going = {link: (t[1], -t[0]) for link, t in known.twists.items()}
    fastest = max((math.hypot(*v) for v in going.values()), default=0.0)
    if fastest == 0.0 or any(abs(t[2]) * known.size > STILL * fastest for t in known.twists.values()):
        return None
    paces = _paces(case, going)
    driver = _driver(case, going, fastest)
    if paces is None or driver is None:
        return None
    speed = math.hypot(*going[driver])
    moved = {name: (x / speed, y / speed) for name, (x, y) in paces.items()}
    return _by_coordinates(known), _input(known, driver, moved)


def _driver(case: Case, going: Mapping[str, Point], fastest: float) -> str | None:
    """The link whose motion is given, else the first that moves."""
    ranked = (*(m.link for m in case.motion), *case.links)
    return next((link for link in ranked if math.hypot(*going.get(link, (0.0, 0.0))) > 1e-3 * fastest), None)


def _paces(case: Case, going: Mapping[str, Point]) -> dict[str, Point] | None:
    """The velocity of every point that a link carries; None where a guide's points do not go with it."""
    paces = {p: going[link] for link in case.links if link != case.ground for p in case.carries.get(link, ())}
    paces |= dict.fromkeys(case.carries.get(case.ground, ()), (0.0, 0.0))
    for joint in case.joints:
        if isinstance(joint, Guided):
            ends = {*(joint.guide.ends or ()), joint.guide.through} - {None, joint.at}
            own = going[joint.links[1]]
            if any(math.dist(paces.get(str(p), (0.0, 0.0)), own) > STILL * math.hypot(*own) for p in ends):
                return None
    return paces


def _by_coordinates(known: Known) -> Case:
    def number(value: float, path: str) -> Number:
        return Number(value, 0.0, path, repr(value))

    points: dict[str, Coordinates | Centroid] = {
        name: Coordinates(number(x, f"points.{name}.x"), number(y, f"points.{name}.y"))
        for name, (x, y) in known.points.items()
    }
    return replace(as_given(known.case), points=points, lengths=(), angles=(), near={})


def _input(known: Known, driver: str, moved: Mapping[str, Point]) -> PageInput:
    """The input; its way is positive to the right, straight up where it goes neither right nor left."""
    t = known.twists[driver]
    angle = math.degrees(math.atan2(-t[0], t[1]))
    sign = 1.0 if -90.0 < round(angle, 9) <= 90.0 else -1.0
    toward = angle if sign > 0.0 else angle + (180.0 if angle <= 0.0 else -180.0)
    slides = {
        f"points.{name}.{axis}": (known.points[name][n], sign * pace[n])
        for name, pace in moved.items()
        for n, axis in enumerate("xy")
        if pace[n] != 0.0
    }
    senses = (f"at {figure_number(toward % 360.0)}°", f"at {figure_number((toward + 180.0) % 360.0)}°")
    return PageInput(driver, slides, f" {unit_word(known.case.units.length)}", senses)


def places(known: Known, by: PageInput, rows: Array) -> dict[str, Array]:
    """Where every point is, in positions too in which nothing can be solved."""
    now = by.varied(rows)

    def column(path: str, written: float) -> Array:
        return now.get(path, np.full(len(rows), written))

    return {
        name: np.column_stack((column(f"points.{name}.x", x), column(f"points.{name}.y", y)))
        for name, (x, y) in known.points.items()
    }


def ways(known: Known) -> Array:
    """Ways to either side, in round numbers, together about as long as the figure.

    The guides have no ends in a case, so that no range is the whole one.
    """
    size = max((math.dist(p, q) for p in known.points.values() for q in known.points.values()), default=0.0)
    size = size or known.size or 1.0
    return np.arange(-ROWS, ROWS + 1) * (round_at_most(0.5 * size) / ROWS)


STEP, MIDDLE, COARSE = 1.0, 2.0, 5.0
"""Degrees between positions; cams take longer, and with friction each position is a scene of its own."""
SLOW = 0.02
"""A link that turns at less than this fraction of the fastest one's rate is no input."""
TRIES = 4
SHORT = 90.0
"""A range of fewer degrees than this gets finer steps."""


class PageMotion(NamedTuple):
    """Rows of positions: ``degrees`` by which the input's link is turned from the position as written (row
    ``zero``; where everything slides its way, case length), the sweep's arrays, and for each moving link its
    pose.

    The links assemble, without a break from the position as written, in the rows ``first`` to ``last``.
    """

    by: PageInput
    degrees: Array
    zero: int
    first: int
    last: int
    found: Sweep
    poses: Mapping[str, PagePose]
    shares: Mapping[str, Array]
    """for each known load the power that it does while the unknown load does 1 (where there is one)"""
    dead: list[float]
    """the dead centres between the first and the last row"""
    ends: str = "the links do not meet"
    """what is so beyond them"""

    @property
    def driver(self) -> str:
        """The link of the input."""
        return self.by.link

    @property
    def rows(self) -> slice:
        """The rows in which the links assemble."""
        return slice(self.first, self.last + 1)

    @property
    def positions(self) -> int:
        """How many they are."""
        return self.last + 1 - self.first

    @property
    def status(self) -> list[str]:
        """The status of every row."""
        return [str(word) for word in self.found.status]

    @property
    def whole_turn(self) -> bool:
        """Whether the input can be turned round and round."""
        span = self.degrees[self.last] - self.degrees[self.first]
        return bool(not self.by.slides and span > 359.99)


def motion_of(known: Known, pairs: Sequence[Pair]) -> PageMotion | None:
    """The motion of a case over the whole range of its input, with these centres; None where none is known.

    Of the links that may drive it is the first that turns fully, else that with the longest range.
    """
    if known.answer is None or known.case.space is not None:
        return None
    case = as_given(known.answer.case)
    want = ["answers", "status", "points", "rates"]
    want += ["velocities", "accelerations"] if case.dynamic else ["terms"]
    want += [f"centres.{pair_name(case, pair)}" for pair in pairs]
    slides = sliding(known)
    if slides is not None:
        case, by = slides
        rows = ways(known)
        straight = _swept(case, by, rows, want)
        best = None if straight is None else (by, rows, replace(straight, points=places(known, by, rows)))
    else:
        best = _widest(known, want)
    if best is None:
        return None
    by, degrees, found = best
    zero = int(np.argmin(np.abs(degrees)))
    _pass_change_points(found)
    poses = poses_of(known, by.link, degrees, zero, found)
    ends = {rope.end for rope in case.ropes} & poses.keys()
    ends_at = {poses[end].point: np.column_stack((poses[end].x, poses[end].y)) for end in ends}
    found = replace(found, points={**found.points, **ends_at})
    first, last = _run(known, found, zero)
    if first == last:
        return None
    dead = _dead(case, by, degrees, (float(degrees[first]), float(degrees[last])), found)
    moves = PageMotion(by, degrees, zero, first, last, found, poses, _shares(case, found), dead)
    return moves._replace(ends="the pin is out of its slot") if genevas(known) else moves


def _pass_change_points(found: Sweep) -> None:
    """Exactly at a change point pins that coincide leave open where others are: there the picture is midway
    between the rows beside it, without centres."""
    for row in np.flatnonzero(found.status == str(Status.CHANGE_POINT)).tolist():
        if 0 < row < len(found) - 1 and (found.status[[row - 1, row + 1]] == str(Status.OK)).all():
            for column in found.points.values():
                column[row] = 0.5 * (column[row - 1] + column[row + 1])
            for column in found.centres.values():
                column[row] = np.nan


BESIDE, GROWN = 1e-3, 3.0
"""Degrees beside a dead centre, and by how much an answer grows at least from ten times as far away."""


def _dead(case: Case, by: PageInput, degrees: Array, reach: tuple[float, float], found: Sweep) -> list[float]:
    """The dead centres within reach, each to its last digit; where they can't be looked for, the rows that
    are, and with them the places where an answer runs off to infinity.

    Where each position is a scene they are looked for only if an answer changes its sign or is missing; with
    friction they are those of the mechanism without, at which the answer jams or grows all the same, unless
    it has several freedoms, whose motion friction does not leave as it is.
    """
    if _one_by_one(case) and all(np.all(v > 0.0) or np.all(v < 0.0) for v in found.answers.values()):
        return []
    alone = len(found.answers) == 1
    smooth = _smooth(case) if alone else case
    some = None if by.slides else dead_centres(smooth, by.driven(degrees))
    if some is None:
        x = degrees.tolist()
        some = [at for at, word in zip(x, found.status, strict=True) if word in DEAD]
        for values in () if rubs(case) else found.answers.values():
            some = asymptotes(x, values.tolist(), some)
    elif rubs(case) and alone:
        some = [at for at in some if _jams(case, by, at)]
    return [at + 0.0 for at in some if reach[0] <= at <= reach[1]]


def _jams(case: Case, by: PageInput, at: float) -> bool:
    """Whether with friction there is no answer beside a place, or one that grows toward it (a jump of
    friction is neither)."""
    beside = _swept(case, by, at + BESIDE * np.array([-1.0, 1.0, -10.0, 10.0]), ("answers",))
    if beside is None:
        return True
    values = (np.abs(v).reshape(2, 2).max(axis=1) for v in beside.answers.values())
    return any(not near <= GROWN * far for near, far in values)


def why_still(known: Known) -> str:
    """Why a case that has an answer has no motion to show, as a sentence."""
    case = known.case
    if case.space is not None:
        return "This case is in space: it is shown as it stands."
    if not any(t != (0.0, 0.0, 0.0) for t in known.twists.values()):
        return "Nothing moves here: the links hold each other."
    if any(joint.stands_in for joint in case.joints):
        return "A given centre holds in the position as written only, so nothing can be moved from it."
    drivers = inputs(known)
    if not drivers or known.answer is None:
        return "No link turns about the frame in this position, so there is no input to turn."
    try:
        case = as_given(known.answer.case)
        sweep(case, None, ("status", "points"), drive={drivers[0]: np.array([0.0, STEP])})
    except SceneError as refusal:
        return f"It cannot be moved: {refusal.message}"
    return "The links leave no room to move from the position as written."


def _widest(known: Known, want: Sequence[str]) -> tuple[PageInput, Array, Sweep] | None:
    """The first input that turns fully, else that with the longest range."""
    assert known.answer is not None
    case = as_given(known.answer.case)
    step = COARSE if _one_by_one(case) else STEP if case.profiles is None else MIDDLE
    turn = np.arange(-180.0, 180.0 + 0.5 * step, step)
    best: tuple[float, PageInput, Array, Sweep] | None = None
    for driver in map(PageInput, inputs(known)[:TRIES]):
        found = _swept(case, driver, turn, want)
        if found is None:
            continue
        first, last = _run(known, found, len(turn) // 2)
        reach = float(turn[last] - turn[first])
        if best is None or reach > best[0]:
            best = (reach, driver, turn, found)
        if reach == 360.0:
            break
    if best is None:
        return None
    reach, driver, turn, found = best
    finer = None if _one_by_one(case) else _suited(turn, *_run(known, found, len(turn) // 2), step)
    again = None if finer is None else _swept(case, driver, finer, want)
    return (driver, turn, found) if finer is None or again is None else (driver, finer, again)


def _one_by_one(case: Case) -> bool:
    """Whether each position, or its free bodies, is solved as a scene of its own, which takes its time."""
    return rubs(case) or case.dynamic or bool(case.ropes)


def _suited(turn: Array, first: int, last: int, step: float) -> Array | None:
    """Rows that suit the range better: past half a turn where it goes on there, finer where it is short."""
    low, high = float(turn[first]), float(turn[last])
    if high - low == 360.0:
        return None
    if low == -180.0 or high == 180.0:
        ends = (high - 360.0 + step, high + step) if low == -180.0 else (low - step, low + 360.0 - step)
        return np.arange(round(ends[0] / step), round(ends[1] / step) + 1) * step
    if high - low < SHORT and step == STEP:
        pace = next(p for p in (0.5, 0.2, 0.1, 0.05) if high - low + 2.0 * step > 60.0 * p or p == 0.05)
        return np.arange(round((low - step) / pace), round((high + step) / pace) + 1) * pace
    return None


def _run(known: Known, found: Sweep, zero: int) -> tuple[int, int]:
    """The first and last row of those around row zero in which all places are known, and pins are in the
    slots of Geneva wheels."""
    placed = np.ones(len(found), bool)
    for wheel in genevas(known):
        pin = next(name for name, at in known.points.items() if at == wheel.pin)
        placed &= np.hypot(*(found.points[pin] - wheel.centre).T) <= wheel.radius * (1.0 + 1e-9)
    for column in found.points.values():
        placed &= np.isfinite(column[:, 0])
    missing = np.flatnonzero(~placed)
    if not placed[zero]:
        return zero, zero
    before, after = missing[missing < zero], missing[missing > zero]
    return int(before[-1]) + 1 if len(before) else 0, int(after[0]) - 1 if len(after) else len(placed) - 1


def _swept(case: Case, by: PageInput, degrees: Array, want: Sequence[str]) -> Sweep | None:
    vary, drive = by.varied(degrees), by.driven(degrees)
    try:
        found = sweep(case, vary, want, drive=drive)
        if not rubs(case):
            return found
        placed = sweep(_smooth(case), vary, [w for w in want if w != "answers"], drive=drive)
    except (SceneError, ArithmeticError, RequestError):  # the last of ways that nobody would count
        return None
    return replace(found, points=placed.points, centres=placed.centres, rates=placed.rates)


def _smooth(case: Case) -> Case:
    """The case without friction: its places do not ask whether a load holds. One without is itself, of which
    all that was found is remembered."""
    joints = tuple(map(without_friction, case.joints))
    return case if joints == case.joints else replace(case, joints=joints)


def inputs(known: Known) -> list[str]:
    """Links that may drive, best first: those that turn about the frame and not too slowly."""
    case = known.case
    frame = {*welded(case, case.ground)}
    rates = {link: abs(t[2]) for link, t in known.twists.items() if link not in frame}
    least = SLOW * max(rates.values(), default=0.0)
    pinned = [
        link
        for joint in case.joints
        if joint.pivot is not None and not frame.isdisjoint(joint.links)
        for link in joint.links
    ]
    first = [m.link for m in case.motion]
    torques = [
        load.link
        for load in sorted(case.loads, key=lambda load: not is_unknown(load))
        if isinstance(load, Torque)
    ]
    ranked = [*first, *torques, *pinned, *loaded_links(case), *case.links]
    quick = [q for q in dict.fromkeys(ranked) if rates.get(q, 0.0) > least and is_link(q)]
    return sorted(quick, key=lambda link: link not in pinned)


def _shares(case: Case, found: Sweep) -> dict[str, Array]:
    """The power of each known load per unit, while the one unknown does 1; without friction."""
    alone = len(found.answers) == 1 and found.terms.keys() >= found.answers.keys()
    if not alone or rubs(case) or case.dynamic or any(map(_like, case.loads)):
        return {}
    (name,) = found.answers
    if not found.terms[name].any():  # of several freedoms the motion that is told may leave it in its place
        return {}
    with np.errstate(all="ignore"):
        return {load: own / found.terms[name] for load, own in found.terms.items() if load != name}


def _like(load: Load) -> bool:
    return isinstance(getattr(load, "value", None), Like)


# --- free bodies through the positions -----------------------------------------------------------------


MOST = 200
"""In more positions than these forces are not solved for: each is a scene of its own."""
SIZES = 6
"""Significant digits of a force."""
NOISE = 1e-12
"""Below this fraction a force is rounding."""


def forces_data(scene: Scene, motion: PageMotion | None) -> dict[str, Any]:
    """For every link its places as written, its twist, and the forces and couples on it in every position;
    empty where they are known in none.

    A force has its place in picture units and its components in case units, y up; a twist is (X, Y, W) in
    case lengths.
    """
    known = scene.known
    if known.answer is None or not known.answer.reactions or known.case.space is not None:
        return {}
    rows = 1 if motion is None else motion.positions
    if rows > MOST:
        return {}
    poses = [known] if motion is None else [_in_row(known, motion, motion.first + n) for n in range(rows)]
    data: dict[str, Any] = {}
    places = known.points.values()
    reach = max(math.dist(p, q) for p in places for q in places)
    for link in known.case.links:
        spots = [scene.at[p] for p in known.case.carries.get(link, ()) if p in scene.at]
        if link == known.case.ground or not spots:
            continue
        some = [dict(_named(scene, pose, link)) for pose in poses]
        every = dict.fromkeys(name for one in some for name in one)
        most = max((math.hypot(*push.force) for one in some for push in one.values()), default=0.0)
        twists = [_nothing if pose is None else _twists(pose).get(link, _nothing) for pose in poses]
        data[link] = {
            "spots": [[round(x, 5), round(y, 5)] for x, y in spots],
            "names": [p for p in known.case.carries.get(link, ()) if p in scene.at],
            "twist": [exact(column) for column in zip(*twists, strict=True)],
            "pushes": [_through([one.get(name) for one in some], most, reach) for name in every],
        }
    units = known.case.units
    words = [unit_word(unit) for unit in (units.force, units.torque, units.length)]
    return {"links": data, "units": words}


_nothing = (math.nan, math.nan, math.nan)


def _twists(pose: Known) -> Mapping[str, Triple]:
    with suppress(SceneError):  # too close to a dead centre to be told
        return pose.twists or ({} if pose.scene is None else pose.scene.twists)
    return {}


def _in_row(known: Known, motion: PageMotion, row: int) -> Known | None:
    """The scene of a row with its reactions; None where it has none."""
    if row == motion.zero:
        return known
    for bound in (False, True):
        with suppress(SceneError, ValueError, ArithmeticError):
            case = motion.found.case_of(row)
            answer = solve_scene(case, reactions=True, dynamic=case.dynamic, alone=True, bound=bound)
            if bound or _agrees(answer, motion.found, row):
                return known_at(known, answer) if answer.reactions else None
    return None


def _agrees(answer: Answer, found: Sweep, row: int) -> bool:
    """Whether floats have the answers of a row to more digits than a force has: its bodies need no others."""
    swept = {name: float(array[row]) for name, array in found.answers.items()}
    told = {name: one.value for name, one in by_load(answer.answers).items() if name in swept}
    close = (abs(told[name] - value) <= 10.0 ** (-SIZES - 3) * abs(value) for name, value in swept.items())
    return bool(swept) and told.keys() == swept.keys() and all(close)


def _named(scene: Scene, here: Known | None, link: str) -> Iterable[tuple[str, DrawnPush]]:
    """What acts on a link in a position, by name."""
    if here is not None:
        places = {name: scene.view.at(p) for name, p in here.points.items()}
        for push in pushes_on(scene._replace(known=here, at=places), link):
            yield push.name, push


def _through(pushes: list[DrawnPush | None], most: float, reach: float) -> dict[str, Any]:
    """One force or couple in all positions; what is rounding beside the largest force, and the figure's size
    [case length], is nothing."""
    one = next(push for push in pushes if push is not None)
    label = plain_text(one.words)
    nothing = (math.nan,) * 5
    rows = [nothing if p is None else (*p.at, p.force[0], -p.force[1], p.couple) for p in pushes]
    sizes = zip(("x", "y", "u", "v", "couple"), (1.0, 1.0, most, most, most * reach), strict=True)
    told: dict[str, Any] = {
        part: exact([0.0 if abs(v) <= NOISE * size else v for v in column], SIZES)
        for (part, size), column in zip(sizes, zip(*rows, strict=True), strict=True)
    }
    told |= {"open": True} if label.endswith("= ?") else {}
    told |= {"touches": True} if any(p is not None and p.circle is not None for p in pushes) else {}
    return {"name": label.partition(" = ")[0], "known": one.kind != "reaction", **told}
