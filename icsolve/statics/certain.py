"""The bound of an unknown load that was found with friction, or why none is proven; its slopes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.case import Gears
from icsolve.kinematics.speeds import Speed
from icsolve.solve.bounds import SMALL, Bounded
from icsolve.statics import gears
from icsolve.statics.bounding import Exact, Sliding, Weights, open_frictions, outputs_of, step, weights_of
from icsolve.statics.power import Balance
from icsolve.statics.rubs import rates_of, rubs_of
from icsolve.statics.statics import Solved, carrying_flanks
from icsolve.statics.ties import Position, ties_of

UNBOUND = "no bound was asked for"
UNSURE = "with friction no bound of the rounding error is proven"
AT_KINK = "next to no force presses at a joint that rubs, and there its friction has no slope"
HELICAL = f"{UNSURE} with helical teeth"
MISSED = f"{UNSURE} where given centres or contacts miss the motion"
TOO_CLOSE = f"{UNSURE} so near to a dead centre or a jam"


class Certain(NamedTuple):
    """By load: the bound (case units; None: not proven, and ``why``), and its slope by each number's path."""

    bounds: Mapping[str, float]
    slopes: Mapping[str, Mapping[str, float]]
    why: str = ""


def certain(
    position: Position,
    balance: Balance,
    solved: Solved,
    senses: Sequence[float],
    traced: Bounded | None,
    speed: Speed,
) -> Certain:
    """Bounds of the loads of a solution, whose rubs all have these senses."""
    if traced is None:
        return Certain({}, {}, UNBOUND)
    found = Sliding(solved.statics, solved.statics.filled(solved.parameters), tuple(senses))
    weights = weights_of(position, balance, found, outputs_of(found))
    why = _doubt(position, traced)
    if weights is None or why:
        return Certain({}, {}, why or UNSURE)
    exact = _exact(position, solved, found, traced)
    if not _senses_are_sure(position, exact, senses, traced, speed):
        return Certain({}, {}, TOO_CLOSE)
    return _judged(solved, *_swept(found, solved, weights, exact, traced))


def _swept(
    found: Sliding, solved: Solved, weights: Sequence[Weights], exact: Exact, traced: Bounded
) -> tuple[list[float] | None, dict[str, dict[str, float]]]:
    """Bounds of the unknown loads (scaled; None: without limit), and slopes where nothing has a kink."""
    rests = [step(found, by, exact) for by in weights]
    passes = [traced.tape.back(rest) for rest in rests]
    bounds = [abs(rest) + swept.bound for rest, swept in zip(rests, passes, strict=True)]
    roots, scale = solved.statics.roots, solved.statics.scale
    count = len(roots)
    by_root = zip(roots, passes, strict=False)
    slopes = {q: {path: -slope / scale for path, slope in swept.by_path.items()} for q, swept in by_root}
    if not found.kinks:
        return bounds, slopes
    most = open_frictions(found, weights[count:], bounds[count:])
    if most is None:
        return None, {}
    for n in range(count):
        bounds[n] += sum(abs(weights[n].rubs[k]) * f for k, f in zip(found.kinks, most, strict=True))
    return bounds[:count], {}


def _judged(solved: Solved, scaled: list[float] | None, slopes: dict[str, dict[str, float]]) -> Certain:
    """Bounds that are small beside their loads."""
    if scaled is None:
        return Certain({}, {}, AT_KINK)
    bounds = {q: bound / solved.statics.scale for q, bound in zip(solved.statics.roots, scaled, strict=False)}
    sizes = {root: abs(solved.unknowns[root]) for root in bounds}
    if any(SMALL * sizes[root] < bound < sizes[root] for root, bound in bounds.items()):
        return Certain({}, slopes, TOO_CLOSE)
    return Certain(bounds, slopes, "" if slopes else AT_KINK)


def _doubt(position: Position, traced: Bounded) -> str:
    """Why a bound of first order would not do."""
    if position.slack:
        return MISSED
    if any(isinstance(joint, Gears) and joint.helix is not None for joint in position.case.joints):
        return HELICAL
    return TOO_CLOSE if max(traced.tape.doubts(SMALL), default=0.0) else ""


def _exact(position: Position, solved: Solved, found: Sliding, traced: Bounded) -> Exact:
    """The scene on the tape."""
    tape, outcome = traced.tape, traced.outcome
    placed = position._replace(points=outcome.points)
    flanks = carrying_flanks(position, solved.statics.ties, solved)
    ties = gears.with_flanks(placed, ties_of(placed, tape), flanks, tape)
    values = {column: tape.constant(value) for column, value in found.values.items()}
    return Exact(ties, rubs_of(placed, ties, tape), outcome.balance.wrenches, values, tape)


def _senses_are_sure(
    position: Position, exact: Exact, senses: Sequence[float], traced: Bounded, speed: Speed
) -> bool:
    """Whether no rate that gave a sense lies within its own bound of zero."""
    moving = position._replace(points=traced.outcome.points, twists=traced.outcome.motions.twists)
    by_motion = [rates_of(moving, exact.ties, exact.rubs, m) for m in range(position.mobility)]
    for k, sense in enumerate(senses):
        rate = sum(part * row[k] for part, row in zip(speed.particular, by_motion, strict=True))
        if sense and abs(rate) <= traced.of(rate):
            return False
    return True
