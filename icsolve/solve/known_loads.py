"""Whether a mechanism whose loads are all known holds still, or keeps up its motion, friction counted: asked
of one of them as the unknown, so that it is what `icsolve solve` says of that one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache

from icsolve.answer import Answer
from icsolve.case import Case, Force, ForceVector, Load, Number, Stretch, Torque
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import joint_order
from icsolve.numbers import largest_of
from icsolve.scene import beyond_friction, jammed, solve_scene, standing
from icsolve.scene.program import HeldAt
from icsolve.solve.rest_position import PROBE, holding, probes
from icsolve.statics.friction import AS_SHARED, PROVEN, SharedError
from icsolve.statics.power import smooth
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import reach_of, unit_of

Range = tuple[float, float]


class Held(NamedTuple):
    """From what to what value of a load it holds still, turned about where nowhere; how far off these may be;
    where it may hold as friction was left, and where it holds again; whether joints share what they carry;
    whether it is proven that friction holds no other value; and the name of the load that was asked."""

    low: float
    high: float
    error: float = 0.0
    possible: tuple[Range, ...] = ()
    again: tuple[Range, ...] = ()
    shared: bool = False
    proven: bool = False
    load: str = ""

    def left(self, value: float) -> bool:
        """Whether this value is held only if friction was left the other way round at some joint."""
        return any(low <= value <= high for low, high in self.possible) and not self.low <= value <= self.high


NOWHERE = Held(math.inf, -math.inf)
Spare = tuple[float, float]
"""How far from slipping, and the bound of its error."""


class AskedLoad(NamedTuple):
    """The load that was asked, as an unknown one, its own value (0.0 of one that the case does not have), and
    where it holds still: of several ranges the one with its value in it."""

    load: Load
    value: float
    held: Held

    @property
    def holds(self) -> bool:
        """Whether it holds still."""
        return self.held.low <= self.value <= self.held.high

    @property
    def open(self) -> bool:
        """Whether it does only if friction was left the other way round at some joint."""
        return self.held.left(self.value)


def asked_of(case: Case, path: str = "", here: bool = False) -> AskedLoad | None:
    """Where a mechanism under known loads holds still as written, by one load; None where none does work.

    First that whose number has this ``path`` is asked, then the others; where none of its own does work, one
    more. It may be asked whether it holds ``here`` alone, unless that number varies: of several freedoms the
    range is then one that holds, perhaps in a wider one.

    Raises SceneError where no load says.
    """
    case = replace(case, motion=(), expect=())
    refusal: SceneError | None = None
    for one, load, number in _one_unknown(case, path):
        value, varied = number.value, bool(path) and number.path == path
        if not _works(SaidCase(smooth(one)), varied):
            continue
        try:
            said = SaidCase(one)
            alone = HeldAt(value) if here and not varied else not varied
            held = _about(_held(said, load.name, alone), value)
            if alone and not (held.low <= value <= held.high or held.proven) and _may_hold(case):
                held = _about(_held(said, load.name, False), value)
        except SharedError:  # of joints, whichever load is asked
            raise
        except SceneError as error:
            refusal = error
            continue
        return AskedLoad(load, value, held)
    if refusal is not None:
        raise refusal
    return None


def _about(held: Held, value: float) -> Held:
    """Of several ranges the one with a value in it."""
    own = next((one for one in held.again if one[0] <= value <= one[1]), held[:2])
    others = tuple([one for one in (held[:2], *held.again) if one != own])
    return held._replace(low=own[0], high=own[1], again=others)


def _may_hold(case: Case) -> bool:
    """Whether some friction within its limits holds known loads, or that is open."""
    with suppress(SceneError):
        return standing(case).depth >= 0.0
    return True


UNPROVEN = 1e-9
"""Ends of a range of which no bound is proven may be off by so much of their size."""


def moving_loads(case: Case, path: str = "") -> Held:
    """From what load to what load more a mechanism under known loads holds still as written [case units]:
    infinite where none would move it, or where any does (turned about).

    Parameters as of `asked_of`. Where no one load says, as of several freedoms, it is so many shares of the
    forces that bound friction. Raises SceneError where it is open.
    """
    found = None
    with suppress(SceneError):
        found = asked_of(case, path, here=True)
    if found is None:
        return _of_all(replace(case, motion=(), expect=()))
    held, value = found.held, found.value
    possible = tuple([(low - value, high - value) for low, high in held.possible])
    return Held(held.low - value, held.high - value, held.error, possible, load=found.load.name)


def held_along(case: Case, path: str) -> tuple[Range, ...]:
    """The ranges of a load's own number in which a mechanism under known loads holds still; none of another
    number, on which they hang, and where no load says."""
    own = next((load.name for load, number in _known(case) if number.path == path), None)
    with suppress(SceneError):
        found = None if own is None else asked_of(case, path)
        if found is not None and found.load.name == own:
            return (found.held[:2], *found.held.again)
    return ()


def spare_friction(held: Held) -> Spare:
    """How far a mechanism is from slipping under these loads more: the least in either sense that would move
    it, negative where it slips, with the bound of its error; infinite where none or any would."""
    return min(held.high, -held.low), held.error


def _one_unknown(case: Case, path: str = "") -> Iterator[tuple[Case, Load, Number]]:
    """The case with one load unknown, in turn: with its own, that of the ``path`` first, and with one more,
    whose number is none."""
    known = sorted(_known(case), key=lambda one: one[1].path != path)
    idle = {load.name for load, number in known if number.value == 0.0}
    acting = {load.name for load in case.loads} - idle
    alone = [number for load, number in known if {load.name} == acting and number.path != path]
    for load, number in known:
        if number not in alone:
            yield _in_place(case, load), load, number
    links = [link for link in joint_order(case) if link != case.ground]
    for more in (*probes(case, links, 1), *probes(case, [], 1)):  # where nothing turns a force holds it
        yield replace(case, loads=(*case.loads, more)), more, Number(0.0, 0.0, "", "0")
    for load, number in known:  # that acts alone: it holds at any number or at none, by its sign
        if number in alone:
            yield _in_place(case, load), load, number


def _in_place(case: Case, load: Load) -> Case:
    """The case with a load in place of its own of that name."""
    return replace(case, loads=tuple([load if other.name == load.name else other for other in case.loads]))


def _known(case: Case) -> Iterator[tuple[Load, Number]]:
    """The loads that have a number of their own, as unknown ones, with it."""
    for load in case.loads:
        linear = isinstance(load, Force) and isinstance(load.over, Stretch) and load.over.end is not None
        if not isinstance(load, ForceVector) and isinstance(load.value, Number) and not linear:
            yield load._replace(value=None), load.value


class SaidCase:
    """A case that is equal to any that says the same: where a load or a coefficient varies, what does not
    hang on it is asked once."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.said = tuple([tuple(v.items()) if type(v) is dict else v for v in vars(case).values()])
        figure = (case.lengths, case.angles, tuple(case.points.items()))
        self.key = hash((case.joints, case.loads, case.ropes, figure))

    def __hash__(self) -> int:
        return self.key

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SaidCase) and self.key == other.key and self.said == other.said


@lru_cache(maxsize=256)
def _works(said: SaidCase, several: bool = False) -> bool:
    """Whether an unknown load does work, in a case without friction (of ``several`` freedoms too): one that
    does none holds by the friction alone that it makes."""
    try:
        solve_scene(said.case)
    except SceneError as refusal:
        return refusal.status == Status.SLACK or (several and refusal.status == Status.MOBILITY)
    return True


@lru_cache(maxsize=256)
def _held(said: SaidCase, load: str, alone: bool | HeldAt) -> Held:
    """Where it holds still; with ``alone`` it is not told where it holds again beyond a range without end."""
    case = said.case
    try:
        answer = solve_scene(case, alone=alone)
    except SceneError as refusal:
        if refusal.status in (Status.NO_VALUE, Status.SLACK):
            return NOWHERE
        raise
    found, friction = answer.answers[load], answer.friction
    if found.holds is None:
        parts = (
            any(joint.only_pushes for joint in case.joints) and standing(holding(case, answer)).depth < 0.0
        )
        return NOWHERE if parts else Held(found.value, found.value, found.error or 0.0)
    largest = largest_of([end for end in found.holds if math.isfinite(end)])
    error = UNPROVEN * largest if found.error is None else found.error
    if friction is None or friction.possible is None:
        return Held(*found.holds, error)
    again, possible = friction.again if friction.grown is None else friction.grown, friction.possible
    proven = friction.unique == PROVEN
    return Held(*found.holds, error, (possible, *friction.again), again, friction.shared, proven)


def _of_all(case: Case) -> Held:
    """The same by all loads at once.

    Raises SceneError where it is open.
    """
    try:
        depth, error, _ = standing(case)
    except SceneError as refusal:
        if refusal.status == Status.UNSUPPORTED:
            raise
        return NOWHERE
    return Held(-depth, depth, error)


# --- what is said of it ---------------------------------------------------------------------------

HOLDS = "friction is enough: under the known loads the mechanism holds still."
SLIPS = "friction is not enough: under the known loads the mechanism moves."
OPEN = "whether friction is enough for the known loads is open: {}"
LEFT = (
    "it is if it was left the other way round at some joint, and the mechanism moves under loads that grew "
    "from rest. It would hold anyway with {}."
)
KEPT_UP = "friction counted, the known loads keep up this motion."


def judged(answer: Answer, case: Case) -> Answer:
    """The answer of a case whose loads are all known, with whether these hold it still, or keep up the given
    motion, friction counted."""
    holds = None
    try:
        if case.motion:
            said = _of_motion(case)
        else:
            holds, said = _at_rest(case)
            if holds and (jams := jammed(replace(case, expect=()))):
                said = f"{said} But {jams}"
            if holds is False:
                with suppress(SceneError):
                    said = f"{said} {beyond_friction(replace(case, expect=()))}".rstrip()
    except SceneError as refusal:
        said = OPEN.format(refusal.message)
    return replace(answer, notes=(*answer.notes, said), holds_still=holds)


def _at_rest(case: Case) -> tuple[bool | None, str]:
    """Whether it holds still, None where that is open; and the sentence on it."""
    found = None
    with suppress(SceneError):
        found = asked_of(case)
    if found is None:
        depth, _, shared = standing(replace(case, expect=()))
        if depth < 0.0:
            return False, SLIPS
        return True, f"{HOLDS} So it does {AS_SHARED}" if shared else HOLDS
    low, high = found.held[:2]
    reach = reach_of((low, high), unit_of(found.load, case), lambda end: f"{end + 0.0:.6g}", None)
    what = f"{_named(found.load)} {reach}"
    if found.holds:
        return True, f"{HOLDS} So it does with {what}{', ' + AS_SHARED if found.held.shared else '.'}"
    if found.open:
        return None, OPEN.format(LEFT.format(what))
    return False, f"{SLIPS} It would hold with {what}." if low <= high else SLIPS


def _named(load: Load) -> str:
    """A load by its name; one that the case does not have by what and where it is."""
    if load.name != PROBE:
        return load.name
    if isinstance(load, Torque):
        return f"a torque more on link {load.link} (ccw positive)"
    assert isinstance(load, Force) and isinstance(load.heading, Number)
    return f"a force more on link {load.link} at {load.at} toward {load.heading.value:g} deg"


def _of_motion(case: Case) -> str:
    """What would keep up the given motion; raises SceneError where no load does."""
    refusal = SceneError(Status.NO_VALUE, "no load does work.")
    for one, load, number in _one_unknown(replace(case, expect=())):
        if _works(SaidCase(smooth(replace(one, motion=())))):
            try:
                found = solve_scene(one).answers[load.name]
            except SceneError as error:
                refusal = error
                continue
            if abs(found.value - number.value) <= (found.error or 0.0) + number.half:
                return KEPT_UP
            takes = f"friction counted, this motion takes {_named(load)} = {found.value:.6g} {found.unit}"
            return f"{takes}." if load.name == PROBE else f"{takes}, and not {number.value:.6g}."
    raise refusal
