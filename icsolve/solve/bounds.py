"""Error bounds of answers, rates and centres, from the tape on which a scene was evaluated.

A bound is of first order. Where it is not small against its value, or a divisor nearly vanishes
within its own, the scene is evaluated again in fifty digits on the file's decimals, which confirms
the answer or refuses it as too close to singular.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from icsolve.answer import Centre
from icsolve.case import Motion, Pair
from icsolve.errors import SceneError, Status
from icsolve.kinematics.centres import direction_of, own_centre
from icsolve.kinematics.speeds import Speed
from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.tape import UNIT, Tape, Taped, decimal_noise
from icsolve.screws.plane import Triple, subtract, velocity
from icsolve.solve import refusals
from icsolve.solve.program import Outcome, Program, evaluate

SMALL = 1e-3
"""A first-order bound is trusted below this fraction of its value."""
HOPELESS = 0.1
"""Above this fraction the scene can't be told from the singular one beside it."""


class Bounded(NamedTuple):
    """A scene evaluated on a tape: its values carry their derivatives."""

    program: Program
    outcome: Outcome
    tape: Tape

    def of(self, value: Scalar) -> float:
        """Bound on the absolute error of a value on the tape."""
        return self.tape.bound(value)


class Value(NamedTuple):
    """An unknown load and the bound on its error; None with the reason where none is proven."""

    value: float
    error: float | None
    why: str = ""


def evaluate_bounded(program: Program) -> Bounded:
    """Evaluate a program on a tape."""
    tape = Tape()
    ran, outcome = evaluate(program, tape)
    return Bounded(ran, outcome, tape)


def bounded_values(scene: Bounded) -> dict[str, Value]:
    """The unknown loads with their bounds.

    Raises SceneError where fifty digits do not confirm what the bound leaves in doubt.
    """
    values = scene.outcome.solution.values
    refuse_overflow(values)
    doubt = max(scene.tape.doubts(SMALL), default=0.0)
    if doubt > HOPELESS and values:
        raise _too_close(scene, next(iter(values)), None)
    result = {}
    for name, value in values.items():
        bound = scene.of(value)
        inside = abs(value) <= bound
        if not inside and bound > SMALL * abs(value):
            doubt = max(doubt, bound / abs(value))
        result[name] = Value(0.0 if inside else float(value), bound)
    return confirmed(scene, result) if doubt > SMALL else result


def confirmed(scene: Bounded, first: dict[str, Value]) -> dict[str, Value]:
    """The unknown loads in fifty digits; the bound is that of converted numbers and of the last rounding.

    ``first`` has what the tape gave: its zeros stand. Raises SceneError where even the data leave the
    answer open.
    """
    from icsolve.numbers.decimals import Digits

    _, exact = evaluate(scene.program, Digits())
    result = {}
    for name, rough in scene.outcome.solution.values.items():
        if first[name].value == 0.0:
            result[name] = first[name]
            continue
        if name not in exact.solution.values:
            raise _too_close(scene, name, None)
        value = float(exact.solution.values[name])
        spread = _converted_noise(scene, rough)
        if spread > SMALL * abs(value):
            raise _too_close(scene, name, spread / abs(value) if value else None)
        result[name] = Value(value, UNIT * abs(value) + 2.0 * spread)
    return result


def _too_close(scene: Bounded, name: str, open_by: float | None) -> SceneError:
    return refusals.too_close(scene.program.top, scene.outcome.motions, name, open_by)


def _converted_noise(scene: Bounded, value: Scalar) -> float:
    """What the rounding of numbers with converted units leaves open."""
    by_path = scene.tape.back(value).by_path
    return sum(abs(by_path[path]) * noise for path, noise in scene.tape.converted.items() if path in by_path)


def slopes(scene: Bounded) -> dict[str, dict[str, float]]:
    """Derivative of every unknown load (and those like it) by every number of the case, by its path."""
    values = scene.outcome.solution.values
    by_root = {root: scene.tape.back(value).by_path for root, value in values.items()}
    return {
        w.load.name: {path: float(w.ratio) * slope for path, slope in by_root[w.root].items()}
        for w in scene.outcome.balance.wrenches
        if w.root in by_root
    }


def refuse_overflow(values: Mapping[str, Scalar]) -> None:
    """Refuse unknown loads beyond the range of doubles."""
    for name, value in values.items():
        if not abs(value) < math.inf:
            raise SceneError(
                Status.UNSUPPORTED,
                f"{name} is larger than the largest double in these units: give the case in other `units`.",
            )


def unbounded_values(outcome: Outcome) -> dict[str, Value]:
    """The unknown loads of a scene on floats."""
    values = outcome.solution.values
    refuse_overflow(values)
    return {name: Value(value, None, "no bound was asked for") for name, value in values.items()}


def plain(outcome: Outcome) -> Outcome:
    """The outcome in floats, as if no tape had run."""
    motions, balance = outcome.motions, outcome.balance
    twists = {link: tuple(map(floats, ts)) for link, ts in motions.twists.items()}
    wrenches = tuple(
        w._replace(unit=floats(w.unit), gain=float(w.gain), ratio=float(w.ratio)) for w in balance.wrenches
    )
    factors = tuple(tuple(map(float, row)) for row in balance.factors)
    return outcome._replace(
        motions=motions._replace(twists=twists),
        balance=balance._replace(wrenches=wrenches, factors=factors),
    )


def floats(t: Triple) -> Triple:
    """A triple off the tape."""
    return (float(t[0]), float(t[1]), float(t[2]))


def rate_errors(scene: Bounded, speed: Speed) -> dict[str, float]:
    """Bounds on the link rates where one motion is meant, rad/s."""
    twists = scene.outcome.motions.twists
    if len(speed.particular) != 1:
        return _combined_errors(scene, speed)
    if speed.reference is None:
        return {}
    divisor, target = _reference(scene, speed), abs(speed.particular[0])
    spare = 0.0
    if scene.program.case.motion:
        given = scene.program.case.motion[0].speed
        spare = 2.0 * UNIT + (decimal_noise(given) / abs(given.value) if given and given.value else 0.0)
    rates = {link: t[0][2] / divisor for link, t in twists.items() if t[0][2] != 0.0}
    return {link: (scene.of(rate) + spare * abs(rate)) * target for link, rate in rates.items()}


def _combined_errors(scene: Bounded, speed: Speed) -> dict[str, float]:
    """Bounds on the link rates of two motions together, and how far those that are shown lie from them."""
    weights = coefficients(scene, speed)
    if weights is None:
        return {}
    result = {}
    for link, motions in scene.outcome.motions.twists.items():
        rates = [t[2] for t in motions]
        rate = rates[0] * weights[0] + rates[1] * weights[1]
        shown = sum(c * float(each) for c, each in zip(speed.particular, rates, strict=True))
        if float(rate) != 0.0:
            result[link] = scene.of(rate) + abs(float(rate) - shown) + UNIT * abs(shown)
    return result


def coefficients(scene: Bounded, speed: Speed) -> tuple[Scalar, Scalar] | None:
    """How much of each of two motions there is, on the tape, where the rates of two links are given (by
    Cramer's rule); None where something else is."""
    given = scene.program.case.motion
    if speed.open or len(speed.particular) != 2 or len(given) != 2 or any(one.point for one in given):
        return None
    (a, b), (c, d) = ([t[2] for t in scene.outcome.motions.twists[one.link]] for one in given)
    p, q = (_target(scene, one) for one in given)
    divisor = a * d - b * c
    if float(divisor) == 0.0:
        return None
    return (p * d - q * b) / divisor, (q * a - p * c) / divisor


def _target(scene: Bounded, given: Motion) -> Scalar:
    """A given rate on the tape, with the rounding of its decimals."""
    sign = -1.0 if given.turns == "cw" else 1.0
    if given.speed is None:
        return sign
    value = sign * given.speed.value
    return Taped(scene.tape, (0, 0.0, 0, 0.0, decimal_noise(given.speed)), value, abs(value))


def _reference(scene: Bounded, speed: Speed) -> Scalar:
    """What the rates are scaled by, on the tape."""
    assert speed.reference is not None
    link, point = speed.reference
    twist = scene.outcome.motions.twists[link][0]
    if point is None:
        return twist[2]
    x, y = velocity(twist, scene.outcome.points[point])
    size = scene.tape.sqrt(x * x + y * y)
    return size if speed.divisor > 0 else -size


def bounded_centre(scene: Bounded, centre: Centre, weights: tuple[Scalar, Scalar] | None = None) -> Centre:
    """A centre with the bound on its place (case units) or direction (degrees), where one is proven.
    ``weights`` are the `coefficients` of two motions.

    It is the bound of the relative twist's centre, and how far the place that is shown (which lines
    may have given) lies from it. A centre whose weight vanishes within its bound lies at infinity.
    """
    relative = _relative(scene, centre.pair, weights) if centre.kind in ("at", "toward") else None
    if relative is None:
        return centre
    x, y, w = relative
    found = centre.by in ("construction", "loop equations")
    if centre.kind == "at" and found and abs(w) <= scene.of(w):
        centre = centre._replace(kind="toward", place=(direction_of(float(x), float(y)),))
    if centre.kind == "toward":
        small, large = (x, y) if abs(x) < abs(y) else (y, x)
        error = scene.of(small / large) * DEGREES + UNIT * 180.0 if large != 0.0 else None
        return centre._replace(error=error)
    if w == 0.0:
        return centre
    px, py, (ox, oy, scale) = x / w, y / w, scene.program.figure.frame
    apart = abs(float(px) / scale + ox - centre.place[0]) + abs(float(py) / scale + oy - centre.place[1])
    return centre._replace(error=apart + (scene.of(px) + scene.of(py)) / scale)


def _relative(scene: Bounded, pair: Pair, weights: tuple[Scalar, Scalar] | None) -> Triple | None:
    """The twist between two links on the tape; where they rest, or move in several ways, their joint."""
    i, j = (scene.outcome.motions.twists[link] for link in pair)
    if scene.outcome.motions.mobility == 1:
        relative = subtract(j[0], i[0])
        if any(float(part) != 0.0 for part in relative):
            return relative
    own = own_centre(scene.program.top, pair, scene.outcome.points, scene.tape)
    if own is not None or weights is None or len(i) != 2:
        return own
    (a, b), (p, q) = (subtract(j[m], i[m]) for m in (0, 1)), weights
    return (a[0] * p + b[0] * q, a[1] * p + b[1] * q, a[2] * p + b[2] * q)


DEGREES = 57.29577951308232
