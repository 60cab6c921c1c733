"""What rubs, which way, and what it takes: of a scene and of its solution, in case units and in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.answer.bodies import Rubbing
from icsolve.assembly import Frame
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import STILL, Speed
from icsolve.solve.bounds import Bounded
from icsolve.statics.equilibrium import Statics
from icsolve.statics.holding import Held
from icsolve.statics.power import Balance, Solution
from icsolve.statics.reactions import names_by_tie
from icsolve.statics.rubs import kind_of_rub, rates_of
from icsolve.statics.sliding import Slid
from icsolve.statics.statics import Solved
from icsolve.statics.ties import Position, Tie
from icsolve.wording.sentences import listed


class Scene(NamedTuple):
    """What is known of a scene before its friction: position, sum of power, and the motion that is meant."""

    position: Position
    frame: Frame
    balance: Balance
    solution: Solution
    speed: Speed
    traced: Bounded | None = None
    """the same on a tape, where bounds are asked for"""


class Sense(NamedTuple):
    """Of each rub the rate in the motion that is meant, 0.0 where it is at rest."""

    rates: tuple[float, ...]

    @property
    def signs(self) -> tuple[float, ...]:
        """1, -1, or 0."""
        return tuple(math.copysign(1.0, rate) if rate else 0.0 for rate in self.rates)


def senses_of(scene: Scene, statics: Statics) -> Sense:
    """Rates of all rubs in the motion that is meant.

    Raises SceneError where a freedom that no motion fixes moves one.
    """
    motions = range(scene.position.mobility)
    by_motion = [rates_of(scene.position, statics.ties, statics.rubs, m) for m in motions]
    fastest = max((abs(x) for ts in scene.position.twists.values() for t in ts for x in t), default=0.0)
    found = []
    for k, rub in enumerate(statics.rubs):
        rate = scene.speed.of([row[k] for row in by_motion], fastest)
        if rate is None:
            raise SceneError(Status.MOBILITY, _open(statics.ties[rub.tie]))
        found.append(rate if abs(rate * scene.speed.divisor) > STILL * fastest else 0.0)
    return Sense(tuple(found))


def _open(tie: Tie) -> str:
    return (
        f"the sense of the friction of links {tie.by} and {tie.on}{place_of(tie)} is open: a freedom that no "
        "given motion fixes moves them. Give its `motion` too, or weld what does not turn."
    )


def place_of(tie: Tie) -> str:
    return f" at {tie.where}" if tie.where else ""


def rubbing_of(scene: Scene, solved: Solved, found: Slid, senses: Sense) -> tuple[Rubbing, ...]:
    statics, case = solved.statics, scene.position.case
    names = names_by_tie(case, statics.ties)
    rows = []
    for k, rub in enumerate(statics.rubs):
        tie, kind = statics.ties[rub.tie], kind_of_rub(statics.ties[rub.tie])
        turns = kind == "pin"
        per_unit = statics.scale * (scene.frame.scale / case.units.torque_per_force_length if turns else 1.0)
        rate = senses.rates[k] / (1.0 if turns else scene.frame.scale)
        loss = 0.0 - solved.friction[k] / statics.scale * (senses.rates[k] / scene.frame.scale)
        value, limit = solved.friction[k] / per_unit + 0.0, found.limits[k] / per_unit
        radius = rub.limit / scene.frame.scale if turns else None
        rows.append(Rubbing(names[rub.tie], tie.where, kind, value, limit, rate, loss, radius))
    return tuple(rows)


def refuse_power(rubbing: Sequence[Rubbing]) -> None:
    """Friction that gave power would be a fault: it opposes the rates, or is none."""
    for rub in rubbing:
        if rub.loss < 0.0:
            raise AssertionError(f"friction at {rub.joint} gives power")


def said_in_motion(scene: Scene, statics: Statics, found: Slid, senses: Sense) -> Sequence[str]:
    notes = []
    still = [statics.ties[rub.tie] for rub, rate in zip(statics.rubs, senses.rates, strict=True) if not rate]
    if still:
        places = listed(dict.fromkeys(f"{tie.by}-{tie.on}{place_of(tie)}" for tie in still))
        notes.append(f"{places} does not rub in this motion: its friction has no sense and is left out.")
    if found.others:
        values = listed(f"{value:.6g}" for value in found.others)
        notes.append(
            f"with this friction the motion is in equilibrium at other values of {statics.roots[0]} too: "
            f"{values}."
        )
    if not found.unique:
        notes.append("there are too many rubbing joints to count all solutions: there may be others.")
    return notes


def said_at_rest(root: str, found: Held) -> Sequence[str]:
    """Sentences about the range."""
    notes = [
        "without `motion` the friction at the joints, and with it their reactions, is open within its limits."
    ]
    if found.self_locking and found.least <= 0.0 <= found.most:
        notes.append(f"self-locking: it holds still with {root} = 0.")
    if math.isinf(found.least) and math.isinf(found.most):
        notes.append(f"no value of {root}, however large, moves it either way.")
    elif math.isinf(found.most):
        notes.append(f"no value of {root} above the range moves it, however large: it locks that way.")
    elif math.isinf(found.least):
        notes.append(f"no value of {root} below the range moves it, however large: it locks that way.")
    for value in found.again:
        notes.append(f"beyond {root} = {value:.6g}, where it is about to move too, it may hold again.")
    for end, more in zip((found.least, found.most), found.possible, strict=True):
        if end != more and abs(end - more) > 1e-9 * max(abs(end), abs(more)):
            notes.append(
                f"from {end:.6g} to {more:.6g} it may still hold, if friction was left the other way round "
                "at some joint (the end is that of impending motion)."
            )
    return notes
