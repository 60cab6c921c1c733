"""The positions of a mechanism over the whole range of its input, solved beforehand by the sweep."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from icsolve.case import Case, Contact, ForceVector, KnownCentre, Load, Number, Pair, Pin, Slide, Slot, Torque
from icsolve.case.names import pair_name
from icsolve.construction import Known, loaded_links
from icsolve.errors import SceneError
from icsolve.page.input import Input, places, sliding, ways
from icsolve.page.poses import Array, Pose, poses_of
from icsolve.solve.refusals import rubs
from icsolve.statics.power import is_unknown
from icsolve.sweep import Sweep, sweep

STEP, MIDDLE, COARSE = 1.0, 2.0, 5.0
"""Degrees between positions; cams take longer, and with friction each position is a scene of its own."""
SLOW = 0.02
"""A link that turns at less than this fraction of the fastest one's rate is no input."""
TRIES = 4
SHORT = 90.0
"""A range of fewer degrees than this gets finer steps."""


class Motion(NamedTuple):
    """Rows of positions: ``degrees`` by which the input's link is turned from the position as written (row
    ``zero``; where everything slides its way, case length), the sweep's arrays, and for each moving link its
    pose.

    The links assemble, without a break from the position as written, in the rows ``first`` to ``last``.
    """

    by: Input
    degrees: Array
    zero: int
    first: int
    last: int
    found: Sweep
    poses: Mapping[str, Pose]
    shares: Mapping[str, Array]
    """for each known load the power that it does while the unknown load does 1 (where there is one)"""

    @property
    def driver(self) -> str:
        """The link of the input."""
        return self.by.link

    @property
    def status(self) -> list[str]:
        """The status of every row."""
        return [str(word) for word in self.found.status]

    @property
    def whole_turn(self) -> bool:
        """Whether the input can be turned round and round."""
        span = self.degrees[self.last] - self.degrees[self.first]
        return bool(not self.by.slides and span > 359.99)


def motion_of(known: Known, pairs: Sequence[Pair]) -> Motion | None:
    """The motion of a case over the whole range of its input, with these centres; None where none is known.

    Of the links that may drive it is the first that turns fully, else that with the longest range.
    """
    if known.answer is None or known.case.space is not None:
        return None
    case = known.answer.case
    want = ["answers", "status", "points", "rates"]
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
    first, last = _run(found, zero)
    if first == last:
        return None
    poses = poses_of(known, by.link, degrees, zero, found)
    return Motion(by, degrees, zero, first, last, found, poses, _shares(case, by, degrees, found))


def why_still(known: Known) -> str:
    """Why a case that has an answer has no motion to show, as a sentence."""
    case = known.case
    if case.space is not None:
        return "This case is in space: it is shown as it stands."
    if not any(t != (0.0, 0.0, 0.0) for t in known.twists.values()):
        return "Nothing moves here: the links hold each other."
    if any(isinstance(joint, KnownCentre) for joint in case.joints):
        return "A given centre holds in the position as written only, so nothing can be moved from it."
    drivers = inputs(known)
    if not drivers or known.answer is None:
        return "No link turns about the frame in this position, so there is no input to turn."
    try:
        sweep(known.answer.case, None, ("status", "points"), drive={drivers[0]: np.array([0.0, STEP])})
    except SceneError as refusal:
        return f"It cannot be moved: {refusal.message}"
    return "The links leave no room to move from the position as written."


def _widest(known: Known, want: Sequence[str]) -> tuple[Input, Array, Sweep] | None:
    """The first input that turns fully, else that with the longest range."""
    assert known.answer is not None
    case = known.answer.case
    step = COARSE if rubs(case) else STEP if case.profiles is None else MIDDLE
    turn = np.arange(-180.0, 180.0 + 0.5 * step, step)
    best: tuple[float, Input, Array, Sweep] | None = None
    for driver in map(Input, inputs(known)[:TRIES]):
        found = _swept(case, driver, turn, want)
        if found is None:
            continue
        first, last = _run(found, len(turn) // 2)
        reach = float(turn[last] - turn[first])
        if best is None or reach > best[0]:
            best = (reach, driver, turn, found)
        if reach == 360.0:
            break
    if best is None:
        return None
    reach, driver, turn, found = best
    finer = None if rubs(case) else _suited(turn, *_run(found, len(turn) // 2), step)
    again = None if finer is None else _swept(case, driver, finer, want)
    return (driver, turn, found) if finer is None or again is None else (driver, finer, again)


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


def _run(found: Sweep, zero: int) -> tuple[int, int]:
    """The first and last row of those around row zero in which all places are known."""
    placed = np.ones(len(found), bool)
    for column in found.points.values():
        placed &= np.isfinite(column[:, 0])
    missing = np.flatnonzero(~placed)
    if not placed[zero]:
        return zero, zero
    before, after = missing[missing < zero], missing[missing > zero]
    return int(before[-1]) + 1 if len(before) else 0, int(after[0]) - 1 if len(after) else len(placed) - 1


def _swept(case: Case, by: Input, degrees: Array, want: Sequence[str]) -> Sweep | None:
    vary, drive = by.varied(degrees), by.driven(degrees)
    try:
        found = sweep(case, vary, want, drive=drive)
        if not rubs(case):
            return found
        placed = sweep(_smooth(case), vary, [w for w in want if w != "answers"], drive=drive)
    except (SceneError, ArithmeticError):
        return None
    return replace(found, points=placed.points, centres=placed.centres, rates=placed.rates)


def _smooth(case: Case) -> Case:
    """The case without friction: its places do not ask whether a load holds."""
    rubbing = (Pin, Slide, Slot, Contact)
    joints = (j._replace(friction=None) if isinstance(j, rubbing) else j for j in case.joints)
    return replace(case, joints=tuple(joints))


def inputs(known: Known) -> list[str]:
    """Links that may drive, best first: those that turn about the frame and not too slowly."""
    case = known.case
    rates = {link: abs(t[2]) for link, t in known.twists.items() if link != case.ground}
    least = SLOW * max(rates.values(), default=0.0)
    pinned = [
        link
        for joint in case.joints
        if isinstance(joint, Pin) and case.ground in joint.links
        for link in joint.links
    ]
    first = [m.link for m in case.motion]
    torques = [
        load.link
        for load in sorted(case.loads, key=lambda load: not is_unknown(load))
        if isinstance(load, Torque)
    ]
    ranked = [*first, *torques, *pinned, *loaded_links(case), *case.links]
    quick = [link for link in dict.fromkeys(ranked) if rates.get(link, 0.0) > least]
    return sorted(quick, key=lambda link: link not in pinned)


def _shares(case: Case, by: Input, degrees: Array, found: Sweep) -> dict[str, Array]:
    """The power of each known load per unit, while the unknown one does 1: by that load alone (the equation
    of power is linear), for one unknown and no friction."""
    if len(found.answers) != 1 or rubs(case) or not any(map(is_unknown, case.loads)):
        return {}
    known = [load for load in case.loads if not is_unknown(load)]
    if any(_like(load) for load in case.loads):
        return {}
    (name,) = found.answers
    if len(known) > 1 and not any(isinstance(load, ForceVector) for load in known):
        return _one_by_one(case, by, degrees, name, [load.name for load in known])
    shares = {}
    for load in known:
        alone = found if len(known) == 1 else _swept(_only(case, load), by, degrees, ("answers",))
        value = _number(load)
        if alone is None or value == 0.0 or name not in alone.answers:
            return {}
        shares[load.name] = -alone.answers[name] / value
    return shares


def _one_by_one(case: Case, by: Input, degrees: Array, name: str, known: Sequence[str]) -> dict[str, Array]:
    """All positions once for each known load, which alone is there and is 1, in one sweep."""
    ones = np.eye(len(known)).repeat(len(degrees), axis=1)
    vary = {f"loads.{load}": row for load, row in zip(known, ones, strict=True)}
    rows = np.tile(degrees, len(known))
    found = sweep(case, {**vary, **by.varied(rows)}, ("answers",), drive=by.driven(rows))
    shares = -found.answers[name].reshape(len(known), len(degrees))
    return dict(zip(known, shares, strict=True))


def _like(load: Load) -> bool:
    value = None if isinstance(load, ForceVector) else load.value
    return value is not None and not isinstance(value, Number)


def _number(load: Load) -> float:
    if isinstance(load, ForceVector):
        return math.hypot(load.x.value, load.y.value)
    return load.value.value if isinstance(load.value, Number) else 0.0


def _only(case: Case, kept: Load) -> Case:
    """The case with all other known loads zero."""
    return replace(case, loads=tuple(load if load is kept else _zero(load) for load in case.loads))


def _zero(load: Load) -> Load:
    nothing: Any = Number(0.0, 0.0, "", "0")
    if isinstance(load, ForceVector):
        return load._replace(x=nothing, y=nothing)
    return load if is_unknown(load) else load._replace(value=nothing)
