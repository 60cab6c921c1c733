"""Every number of a scene against 140 digits, and the rows of a sweep against their scenes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from icsolve.answer import Answer
from icsolve.bench.accuracy import AsWritten
from icsolve.case import Case, Pair
from icsolve.errors import SceneError
from icsolve.kinematics import speeds
from icsolve.scene.program import Program, Want, evaluate, prepare
from icsolve.screws.plane import subtract
from icsolve.solve import solve
from icsolve.statics.power import Outcome
from icsolve.sweep import sweep
from icsolve.sweep.numbers import numbers_of, with_numbers
from icsolve.tuples import NamedTuple

DIGITS = 140
NOTHING = 1e-40
"""What is zero to within so much of its terms is zero."""


class Shown(NamedTuple):
    """A number of an answer beside the true one; ``size`` is that of its terms, ``error`` what the answer
    says of it (None: nothing)."""

    what: str
    value: float
    true: Any
    size: Any
    error: float | None = None

    @property
    def fault(self) -> str:
        """Why it is not the true one rounded once: within one unit in the last place, with an error of two
        at most that holds."""
        off = abs(self.true - self.value)
        rest, unit = NOTHING * (abs(self.size) + abs(self.true)), math.ulp(self.value)
        said = f"{self.what}: {self.value!r} is {float(off / unit):.3g} ulp off"
        if self.error is not None:
            if off > self.error + rest:
                return f"{said}, beyond its error {self.error:.3g}"
            if self.error > 2.0 * unit and not (self.value == 0.0 and self.error <= NOTHING * self.size):
                return f"{said}, with an error of {self.error:.3g}"
        return said if off > unit + rest else ""


def shown(case: Case) -> Iterator[Shown]:
    """Unknown loads, points, centres, rates and velocities of a scene.

    Raises SceneError where it has no answer.
    """
    arithmetic = AsWritten()
    with arithmetic.mp.workdps(DIGITS):
        answer = solve(case, all_centres=True, rates=True)
        program, exact = evaluate(prepare(case, Want(True, True)), arithmetic)
        for w in exact.balance.wrenches:
            if w.root in exact.solution.values:
                found, true = answer.answers[w.load.name], w.ratio * exact.solution.values[w.root]
                yield Shown(w.load.name, found.value, true, max(abs(true), 1e3), found.error)
        yield from _points(answer, program, exact, arithmetic.mp)
        if exact.motions.mobility == 1:
            yield from _centres(answer, program, exact, arithmetic.mp)
        yield from _rates(answer, program, exact, arithmetic)


def _points(answer: Answer, program: Program, exact: Outcome, mp: Any) -> Iterator[Shown]:
    ox, oy, scale = program.figure.frame
    for name, place in answer.points.items():
        for part, at, origin in zip(place, exact.points[name], (ox, oy), strict=True):
            yield Shown(name, part, mp.mpf(at) / scale + origin, 1 / scale + abs(origin))


def _centres(answer: Answer, program: Program, exact: Outcome, mp: Any) -> Iterator[Shown]:
    ox, oy, scale = program.figure.frame
    none = NOTHING * max(abs(x) for ts in exact.motions.twists.values() for t in ts for x in t)
    for pair, centre in answer.centres.items():
        x, y, w = subtract(*(exact.motions.twists[link][0] for link in reversed(pair)))
        if max(map(abs, (x, y, w))) <= none:
            continue
        if centre.kind == "at":
            worst = 2.0 * math.ulp(max(map(abs, centre.place)))
            if centre.error is None or centre.error > worst or abs(w) <= none:
                yield Shown(_named(pair), math.inf, 0, 0)
                continue
            for part, above, origin in zip(centre.place, (x, y), (ox, oy), strict=True):
                size = (abs(x) + abs(y)) / abs(w) / scale + abs(origin)
                yield Shown(_named(pair), part, mp.mpf(above) / w / scale + origin, size)
        elif centre.kind == "toward":
            true = mp.degrees(mp.atan2(y, x)) % 180
            if abs(w) > NOTHING * max(abs(x), abs(y)) + none or min(true, 180 - true) > NOTHING:
                yield Shown(_named(pair), centre.place[0], true, 180.0, centre.error)


def _named(pair: Pair) -> str:
    return f"I{pair[0]}-{pair[1]}"


def _rates(answer: Answer, program: Program, exact: Outcome, arithmetic: Any) -> Iterator[Shown]:
    case, frame, twists = program.case, program.figure.frame, exact.motions.twists
    speed = speeds.speed_of(exact.place, twists)
    rates, velocities = answer.rates or {}, answer.velocities or {}
    largest = max(speeds.fastest(twists) * sum(map(abs, speed.particular)) / abs(speed.divisor), 1.0)
    for link, rate in speeds.link_rates(case, twists, speed).items():
        if not isinstance(rate, str):
            yield Shown(f"w{link}", float(rates[link]), rate, largest, answer.errors["rates"][link])
    for key, both in speeds.point_velocities(exact.place, twists, speed).items():
        if not isinstance(both, str):
            for part, true in zip(velocities[key], both, strict=True):
                value = float(part)  # type: ignore[arg-type]
                yield Shown(f"v {key[0]} on {key[1]}", value, true, largest / frame.scale)


def every_number(case: Case) -> float:
    """How many numbers of a scene were held to their law; negative where one breaks it."""
    faults = [one.fault for one in shown(case)]
    return -1.0 if any(faults) else float(len(faults))


STEPS = (0.0, 1e-9, -1e-3)
"""By these fractions of itself a number is varied: its own first. One that poses the figure moves the
mechanism in a sweep and is read anew in a scene, so of it only its own value is the same in both."""


def every_row(case: Case) -> float:
    """How many rows of a sweep have status and value of their scenes; negative where one has not."""
    numbers = sorted(numbers_of(case))
    held = 0
    for path in numbers[:: max(len(numbers) // 3, 1)]:
        own = numbers_of(case)[path].value
        shapes = path.startswith(("lengths", "loads"))
        rows = [own + step * (abs(own) or 1.0) for step in STEPS[: None if shapes else 1]]
        try:
            found = sweep(case, {path: rows}, ("answers", "status", "error"))
        except SceneError:
            continue
        for n, row in enumerate(rows):
            scene = case if row == own else with_numbers(case, {path: row})
            answers, errors = (of.get("U", [math.nan] * len(rows)) for of in (found.answers, found.error))
            if not _same(found.status[n], answers[n], errors[n], scene):
                return -1.0
            held += 1
    return float(held)


def _same(status: str, value: float, error: float, scene: Case) -> bool:
    """Whether a row has what its scene has."""
    try:
        one = solve(scene).answers["U"]
    except SceneError as refusal:
        return status == refusal.status
    return status == "ok" and abs(value - one.value) <= error + (one.error or 0.0)
