"""The parts of an answer, each made when somebody looks into it; the sum of power as it is printed."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer, Centre, Deferred, Found, Later, Term
from icsolve.case import Case, Number, Pair, link_order
from icsolve.errors import SceneError, refuse_overflow
from icsolve.kinematics import speeds
from icsolve.kinematics.centres import CentreFinder
from icsolve.kinematics.speeds import Speed
from icsolve.numbers import Scalar, largest_of, zero_of
from icsolve.numbers.balls import PRECISIONS, BelowZero, MoreDigits, MovedBalls
from icsolve.numbers.units import numbers_in
from icsolve.scene.program import (
    EvaluatedScene,
    Evaluation,
    Program,
    Want,
    evaluate,
    evaluate_bounded,
    plain,
    points_shown,
    slopes,
    unknown_values,
)
from icsolve.screws import Triple, velocity
from icsolve.statics import load_wrenches, power
from icsolve.statics.load_wrenches import Wrench
from icsolve.statics.power import Bounded, Outcome, Value, known_value, load_value
from icsolve.tuples import LateModule, NamedTuple, cached_property, replace
from icsolve.wording import (
    at_words,
    direction_words,
    less_than_none,
    link_words,
    links_named,
    listed,
    plural,
    sense_of,
    unit_of,
)

if TYPE_CHECKING:
    from icsolve.scene import sensitivity
    from icsolve.statics import free_bodies
    from icsolve.wording import sentences
else:
    sensitivity, free_bodies = map(LateModule, ("icsolve.scene.sensitivity", "icsolve.statics.free_bodies"))
    sentences = LateModule("icsolve.wording.sentences")


class Power(NamedTuple):
    """A load's number times its factor is its power; ``size`` is what that is summed from."""

    wrench: Wrench
    value: Scalar
    factor: Scalar
    size: float


def _powers(found: Evaluation, values: Mapping[str, Scalar], speed: Speed) -> Iterable[Power]:
    """The power of each load in the motion that is printed [force units times case length, a second]."""
    frame, balance = found.program.figure.frame, found.outcome.balance
    a, motions = found.arithmetic, range(len(balance.factors))
    for n, w in enumerate(balance.wrenches):
        row = [balance.factors[m][n] for m in motions]
        per = w.measure / frame.scale
        size = max(balance.sizes[m][n] for m in motions)
        value = load_value(w, values, a)
        factor = speed.particular_of(row, size) * per
        yield Power(w, value, factor, abs(value) * size * per / abs(speed.divisor))


def power_terms(found: Evaluation, values: Mapping[str, Scalar], speed: Speed) -> Iterable[Term]:
    """One term a load, for the motion that is printed."""
    case, a = found.program.case, found.arithmetic
    for w, value, factor, size in _powers(found, values, speed):
        unknown = known_value(w) is None
        power, _ = a.rounded(value * factor, size)
        refuse_overflow(f"the power of {w.load.name}", power)
        numbers = a.rounded(value)[0], unit_of(w.load, case), a.rounded(factor)[0], power
        yield Term(w.load.name, w.load.link, *numbers, unknown, _where(case, w))


def _where(case: Case, w: Wrench) -> str:
    where = f"{w.load.name} on {link_words(w.load.link)}{at_words(getattr(w.load, 'at', None))}"
    return where if w.against == case.ground else f"{where} against link {w.against}"


Components = tuple[float, float]
Velocities = dict[tuple[str, str], Components | str]


class AnswerBuilder:
    """What was found of a scene, and what an answer shows of it."""

    def __init__(self, scene: EvaluatedScene) -> None:
        self.scene = scene
        self.first = scene.ask(lambda found: found)
        self.program, self.case = self.first.program, self.first.program.case
        self.figure = self.program.figure
        self.given: dict[str, Value] | None = None
        """the unknown loads, where something else than power gave them"""

    @cached_property
    def outcome(self) -> Outcome:
        """In floats."""
        return plain(self.first.outcome)

    @cached_property
    def traced(self) -> Bounded | None:
        """On a tape."""
        return evaluate_bounded(self.program) if self.scene.certain else None

    @cached_property
    def speed(self) -> speeds.Speed:
        """Which motion is meant, and how fast, in floats."""
        return speeds.speed_of(self.outcome.place, self.outcome.motions.twists)

    @cached_property
    def unknowns(self) -> dict[str, Value]:
        """The unknown loads by name, and those that are like them."""
        if self.given is None:
            return self.scene.ask(unknown_values)
        found = {}
        for w in self.outcome.balance.wrenches:
            if w.root in self.given:
                value, error, why = self.given[w.root]
                error = None if error is None else abs(w.ratio) * error
                found[w.load.name] = Value(w.ratio * value + 0.0, error, why)
        return found

    def _values(self, found: Evaluation) -> Mapping[str, Scalar]:
        """The same in an arithmetic, by the load that has the number."""
        if self.given is None:
            return found.outcome.solution.values
        return {root: value.value for root, value in self.given.items()}

    def with_values(self, values: Mapping[str, Value]) -> AnswerBuilder:
        """The same with the unknown loads at given values; what has been found of the scene is shared."""
        other = object.__new__(AnswerBuilder)
        vars(other).update(vars(self), given=dict(values))
        return other

    def answer(self) -> Answer:
        """The answer as frozen values; a given motion that can't be is refused."""
        balance, motions = self.first.outcome.balance, self.first.outcome.motions
        rates, errors = self.scene.ask(_rates) if self.program.want.rates else (None, {})
        if self.case.motion and rates is None:
            self.scene.ask(speed_of)
        answers = _directed(self.case, _found(self.case, balance, self.unknowns))
        return Answer(
            case=self.case,
            answers=answers,
            centres=Deferred(self.plain_centres),
            rates=rates,
            velocities=None if rates is None else Deferred(lambda: self._point_velocities[0]),
            points=Deferred(lambda: self._shown_points[0]),
            terms=Later(lambda: self.scene.ask(self._terms)),
            advantage=self.scene.ask(self._advantage),
            mobility=motions.mobility,
            notes=Later(lambda: (*self.figure.notes, *motions.notes, *self._notes(answers))),
            skipped=Later(lambda: _skipped(self.program, self.first.outcome)),
            steps=Later(lambda: _steps(self.program)),
            sensitivities=Deferred(lambda: self.slopes),
            errors={"points": Deferred(lambda: self._shown_points[1])}
            | ({} if rates is None else self._motion_errors(errors)),
            scene=self,
        )

    def moving(self) -> Answer:
        """The motion alone: all centres, rates, velocities and points.

        Where the given motion can't be, those of the motion that a case without one has.
        """
        try:
            rates, _ = self.scene.ask(_rates)
        except SceneError:
            if not self.case.motion:
                raise
            bare = self.program._replace(case=replace(self.case, motion=()))
            return AnswerBuilder(EvaluatedScene(bare, self.scene.certain, self.scene.explained)).moving()
        return Answer(
            case=self.case,
            centres=Deferred(self.plain_centres),
            rates=rates,
            velocities=Deferred(lambda: self._point_velocities[0]),
            points=Deferred(lambda: self._shown_points[0]),
            mobility=self.first.outcome.motions.mobility,
            scene=self,
        )

    @cached_property
    def _shown_points(self) -> tuple[dict[str, Components], dict[str, Components]]:
        """Points, and bounds of their errors."""
        return self.scene.ask(points_shown)

    @cached_property
    def _point_velocities(self) -> tuple[Velocities, dict[tuple[str, str], Components]]:
        """Point velocities, and bounds of their errors."""
        return self.scene.ask(_velocities)

    def _motion_errors(self, rates: Mapping[str, float]) -> dict[str, Mapping[Any, Any]]:
        return {"rates": rates, "velocities": Deferred(lambda: self._point_velocities[1])}

    def plain_centres(self) -> dict[Pair, Centre]:
        """The centres that are asked for."""
        return self.scene.ask(_centres)

    def apart(self, *ends: Pair | str) -> float:
        """How far two centres or points are from one another [case length], rounded once."""

        def asked(found: Evaluation) -> float:
            a, (_, _, scale), points = (
                found.arithmetic,
                found.program.figure.frame,
                found.outcome.place.points,
            )
            (px, py), (qx, qy) = (points[e] if isinstance(e, str) else _finder(found).placed(e) for e in ends)
            x, y = px - qx, py - qy
            size = largest_of((1.0, px, py, qx, qy))
            if all(a.vanishes(part, size) for part in (x, y)):
                return 0.0
            return a.rounded(a.sqrt(x * x + y * y) / scale)[0]

        return self.scene.ask(asked)

    @cached_property
    def twists(self) -> dict[str, Triple]:
        """The motion of every link as ``omega * (x, y, 1)`` in case units, where it is determined."""
        return self.scene.ask(_twists)

    def _notes(self, answers: Mapping[str, Found]) -> list[str]:
        notes = [sentences.EXPLAINED] if self.scene.explained else []
        notes += self.scene.ask(_notes)
        if self.given is None and not power.has_friction(self.case):
            with suppress(SceneError):  # where no digits tell that a link stands still
                notes += self.scene.ask(_at_rest)
        notes += self._known_alone()
        notes += [sentences.below_none(load) for load in less_than_none(self.case.loads, answers)]
        if answers and self.scene.certain and self.given is None and self.case.profiles is None:
            change = self._change()
            told = sensitivity.unsettled(self.case, answers, change)
            if told and change != self._moved:  # where a derivative of the tape is large it may be wrong
                told = sensitivity.unsettled(self.case, answers, _by_half_units(self.slopes))
            notes += told
        return notes

    def _known_alone(self) -> Iterable[str]:
        """What is to be said of loads that are all known, on links that can move."""
        loads, mobility = self.case.loads, self.outcome.motions.mobility
        if loads and mobility and not (power.has_friction(self.case) or any(map(power.is_unknown, loads))):
            left = [] if self.in_equilibrium else [one.within for one in self.left_over]
            turning = _turning_alone(self.outcome) if all(left) else []
            yield sentences.nothing_asked(mobility, left, turning)

    @cached_property
    def slopes(self) -> dict[str, dict[str, float]]:
        """Derivative of every unknown load by every number of the case: by the tape, and where that does not
        tell them, so near a singular position or beside much larger ones, by differences of many digits."""
        by_load: dict[str, dict[str, float]] = {load: {} for load in self.unknowns}
        numbers = sensitivity.numbers_of(self.case)
        doubtful = set(numbers)
        with suppress(SceneError, ZeroDivisionError):
            by_all = slopes(self.traced or evaluate_bounded(self.program))
            found = {load: {p: s for p, s in by.items() if p in numbers} for load, by in by_all.items()}
            told = found and all(any(by.values()) for by in found.values())  # nothing of an answer that is 0
            if not self.scene.certain:
                return self._with_sizes(found)
            nothing = _near_nothing(found, numbers)
            if told and self._tape_tells(DERIVED) and self._add_up(found, nothing):
                by_load, doubtful = found, nothing
        for number in (numbers[path] for path in numbers if path in doubtful):
            step = Decimal(repr(1e-40 * (abs(number.value) or 1.0)))
            with suppress(*OPEN, KeyError):
                more, less = (self._with({number.path: way}, PRECISIONS[-1]) for way in (step, -step))
                for load, slope in by_load.items():
                    change = float(more[load] - less[load]) / (2.0 * float(step))
                    tiny = NOTHING * abs(float(more[load])) / abs(float(step))
                    slope[number.path] = change if abs(change) > tiny else 0.0
        return self._with_sizes(by_load)

    def _with_sizes(self, by_load: dict[str, dict[str, float]]) -> dict[str, dict[str, float]]:
        """With those of the size of each force of unknown direction, beside those of its components."""
        for name in self.case.directed:
            both = [f"{name}.{axis}" for axis in "xy"]
            if size := math.hypot(*(self.unknowns[one].value for one in both)):
                parts = [(self.unknowns[one].value / size, by_load[one]) for one in both]
                paths = {p: None for _, slope in parts for p in slope if p not in self.case.axes}
                by_load[name] = {p: sum(share * slope.get(p, 0.0) for share, slope in parts) for p in paths}
        return by_load

    def _add_up(self, by_load: Mapping[str, Mapping[str, float]], nothing: Collection[str]) -> bool:
        """Whether the loads of many digits change by what the derivatives add up to where all numbers are
        moved at once, each so far that its share is as large as the others: an answer that is right does not
        tell that its derivatives are, beside a limit that it does not feel."""
        numbers = sensitivity.numbers_of(self.case)
        for load, by_path in by_load.items():
            slopes = {path: slope for path, slope in by_path.items() if slope and path not in nothing}
            sizes = [abs(slope) * (abs(numbers[path].value) or 1.0) for path, slope in slopes.items()]
            least = min(sizes, default=0.0)
            shares = [1e-40 * least * (1.0 + math.sqrt(n) % 1.0) for n in range(2, 2 + len(slopes))]
            steps = {p: Decimal(repr(share / slopes[p])) for p, share in zip(slopes, shares, strict=True)}
            back = {path: -step for path, step in steps.items()}
            with suppress(*OPEN, KeyError):  # what moves by exact data alone does not move so
                more, less = (self._with(way, PRECISIONS[-1])[load] for way in (steps, back))
                total = 2.0 * sum(shares)
                if not abs(float(more - less) - total) <= DERIVED * total:
                    return False
        return True

    def _with(self, steps: Mapping[str, Decimal], digits: int) -> dict[str, Scalar]:
        """The unknown loads, and those that are like them, with numbers moved by steps."""
        outcome = evaluate(self.program, MovedBalls(steps, digits))[1]
        values = outcome.solution.values
        return {w.load.name: w.ratio * values[w.root] for w in outcome.balance.wrenches if w.root in values}

    def _change(self) -> Callable[[Number], Mapping[str, float]]:
        """By how much half a unit of a number moves each answer: by the derivatives of the tape, and so near
        a singular position that a tape says nothing, by what the number so moved gives."""
        with suppress(SceneError, ZeroDivisionError):
            if self.traced and self._tape_tells(ROUGH):
                return _by_half_units(self._with_sizes(slopes(self.traced)))
        return self._moved

    def _tape_tells(self, share: float) -> bool:
        """Whether the answers of the tape are right to such a share of them."""
        assert self.traced is not None
        found, true = self.traced.outcome.solution.values, self.first.outcome.solution.values
        if found.keys() != true.keys():
            return False
        pairs = [(float(found[root]), float(true[root])) for root in true]
        return all(abs(near - exact) <= share * abs(exact) for near, exact in pairs)

    def _moved(self, number: Number) -> dict[str, float]:
        reach: dict[str, float] = {}
        for sign in (1, -1):
            with suppress(*OPEN, KeyError):
                half = Decimal(repr(sign * number.half))  # 5e-26 as it is written
                values = self._with({number.path: half}, PRECISIONS[1])
                for load, value in self.first.outcome.solution.values.items():
                    change, own = (x if float(x) > 0.0 else -x for x in (values[load] - value, value))
                    size = float(own)  # doubles may not tell a change from the value itself
                    far = max(float(change), math.nextafter(size, math.inf))
                    near = min(float(change), size)
                    reach[load] = max(reach.get(load, 0.0), far if change > own else near)
        return reach

    def reach_of_figure(self, motion: int) -> float:
        """How much half a unit of the last decimals of the figure may change what the powers of the known
        loads add up to in a motion, to first order [as `power_of`]: whole numbers are exact, and it counts
        as far as where data of the figure repeat one another."""
        from icsolve.assembly.refusals import OF_SIZE

        balance = self.outcome.balance
        both = zip(balance.wrenches, balance.sizes[motion], strict=True)
        most = sum(abs(power.power_of(w, size)) for w, size in both)
        with suppress(SceneError, ZeroDivisionError):
            outcome, tape = self.traced or evaluate_bounded(self.program)
            own = {n.path for w in outcome.balance.wrenches for n in numbers_in(w.number)}
            by_path = tape.back(power.known_power(outcome.balance, motion, tape)).by_path
            numbers = sensitivity.numbers_of(self.case)
            given = [numbers[path] for path in by_path.keys() & numbers.keys() - own]
            reach = sum(abs(by_path[n.path]) * n.half for n in given if "." in n.digits)
            return min(reach / power.force_scale(balance), OF_SIZE * most)
        return 0.0

    @cached_property
    def left_over(self) -> tuple[free_bodies.LeftOver, ...]:
        """What the known loads leave where they do not balance."""
        return self.scene.ask(
            lambda found: tuple(
                free_bodies.left_over(found.outcome.balance, found.arithmetic, self.reach_of_figure)
            )
        )

    @property
    def in_equilibrium(self) -> bool:
        """Whether the powers of the loads add up to zero in every motion."""
        return self.first.outcome.solution.verdict == "balanced"

    def sum_of_powers(self) -> float:
        """What the powers of all loads add up to in the motion that is printed [force times case length]."""

        def summed(found: Evaluation) -> float:
            powers = list(_powers(found, self._values(found), speed_of(found)))
            total: Scalar = 0.0
            for one in powers:
                total = total + one.value * one.factor
            return found.arithmetic.rounded(total, sum(one.size for one in powers))[0]

        return self.scene.ask(summed)

    def _advantage(self, found: Evaluation) -> float | None:
        return power.advantage(found.outcome.balance.wrenches, self._values(found), found.arithmetic)

    def _terms(self, found: Evaluation) -> tuple[Term, ...]:
        return tuple(power_terms(found, self._values(found), speed_of(found)))


DERIVED, ROUGH = 1e-9, 0.01
"""How far off the answers of a tape may be whose derivatives are told; of which a note gives two figures."""
ROUNDED = 1e-12
"""Of the strongest influence on an answer: what is less may be rounding."""


def _by_half_units(by_load: Mapping[str, Mapping[str, float]]) -> Callable[[Number], Mapping[str, float]]:
    """By how much half a unit of a number moves each answer, by its derivatives."""
    return lambda n: {load: abs(slopes.get(n.path, 0.0)) * n.half for load, slopes in by_load.items()}


def _near_nothing(found: Mapping[str, Mapping[str, float]], numbers: Mapping[str, Number]) -> set[str]:
    """The numbers whose influence on a load is next to nothing beside the strongest."""
    doubtful = set()
    for slopes_of_load in found.values():
        parts = {
            path: abs(slope) * (abs(numbers[path].value) or 1.0) for path, slope in slopes_of_load.items()
        }
        strongest = max(parts.values(), default=0.0)
        doubtful |= {path for path, part in parts.items() if 0.0 < part <= ROUNDED * strongest}
    return doubtful


def scene_of(answer: Answer) -> AnswerBuilder | None:
    """The solved scene of an answer; None of one in space, and of one that another process found."""
    return answer.scene if isinstance(answer.scene, AnswerBuilder) else None


def speed_of(found: Evaluation) -> speeds.Speed:
    """Which motion is meant, and how fast."""
    return speeds.speed_of(found.outcome.place, found.outcome.motions.twists)


def _rates(found: Evaluation) -> tuple[dict[str, float | str], dict[str, float]]:
    """Link rates, and bounds of their errors."""
    place, twists = found.outcome.place, found.outcome.motions.twists
    speed, a = speed_of(found), found.arithmetic
    rates: dict[str, float | str] = {}
    errors: dict[str, float] = {}
    for link, rate in speeds.link_rates(place.case, twists, speed).items():
        if isinstance(rate, str):
            rates[link] = rate
        else:
            rates[link], error = a.rounded(rate)
            errors |= {link: error} if error < math.inf else {}
    return rates, errors


def _velocities(found: Evaluation) -> tuple[Velocities, dict[tuple[str, str], Components]]:
    """Point velocities, and bounds of their errors."""
    place, twists, a = found.outcome.place, found.outcome.motions.twists, found.arithmetic
    velocities: Velocities = {}
    errors: dict[tuple[str, str], Components] = {}
    for key, both in speeds.point_velocities(place, twists, speed_of(found)).items():
        if isinstance(both, str):
            velocities[key] = both
        else:
            (x, off_x), (y, off_y) = map(a.rounded, both)
            velocities[key], errors[key] = (x, y), (off_x, off_y)
    return velocities, errors


def _centres(found: Evaluation) -> dict[Pair, Centre]:
    """The centres that are asked for: all, or those of the loaded links. With one freedom they are the
    same at every speed, 0 among them."""
    program, motions = found.program, found.outcome.motions
    case, twists = program.case, motions.twists
    pairs = [pair for pair in wanted_pairs(case, program.want) if {*pair} <= twists.keys()]
    return _finder(found).find(pairs, motions.slack)


def _finder(found: Evaluation) -> CentreFinder:
    motions = found.outcome.motions
    twists = motions.twists
    if found.program.case.motion and motions.mobility > 1:
        speed = speed_of(found)
        twists = {link: speeds.meant(twists, speed, link) for link in twists}
    return CentreFinder(found.outcome.place, twists, found.arithmetic)


OPEN = (SceneError, ZeroDivisionError, BelowZero, MoreDigits)
"""What a scene raises that has no answer with a number moved, or none that its digits settle."""
NOTHING = 1e-60
"""A change by less than this fraction of the value is what a difference of second order leaves."""


def _twists(found: Evaluation) -> dict[str, Triple]:
    """The motions that are meant, each number rounded once: a rest is a rest, however slow others are."""
    motions, frame, a = found.outcome.motions.twists, found.program.figure.frame, found.arithmetic
    speed = speed_of(found)
    fastest = largest_of([value for ts in motions.values() for t in ts for value in t])
    shown: dict[str, Triple] = {}
    for link in motions:
        first, *rest = speeds.meant(motions, speed, link)
        if all(a.vanishes(value, fastest) for t in rest for value in t):
            x, y, w = (zero_of(v) if a.vanishes(v, fastest) else v for v in first)
            own = frame.twist_shown((x, y, w), speed.divisor)
            (u, _), (v, _), (rate, _) = (a.rounded(value, fastest) for value in own)
            shown[link] = (u, v, rate)
    return shown


def _found(case: Case, balance: power.Balance, unknowns: Mapping[str, Value]) -> dict[str, Found]:
    """The unknown loads and those that are like them, in order."""
    found = {}
    for w in balance.wrenches:
        if w.load.name in unknowns:
            value, error, why = unknowns[w.load.name]
            found[w.load.name] = Found(value, unit_of(w.load, case), sense_with(w, value), error, why)
    return found


def sense_with(w: Wrench, value: float) -> str:
    """The sense of a load with a value; '' for zero."""
    degrees = math.degrees(math.atan2(-w.unit[0], w.unit[1]))
    return sense_of(w.load, value, float(w.gain), degrees)


def _directed(case: Case, found: dict[str, Found]) -> dict[str, Found]:
    """The answers with one for the two components of each force of unknown direction.

    A size is at most as far off as its components are together.
    """
    if not case.directed:
        return found
    for name in case.directed:
        x, y = (found.pop(f"{name}.{axis}") for axis in "xy")
        size = math.hypot(x.value, y.value)
        sense = f"at {direction_words(math.degrees(math.atan2(y.value, x.value)))}" if size else ""
        error = None if x.error is None or y.error is None else math.hypot(x.error, y.error) + 2e-16 * size
        found[name] = Found(size, x.unit, sense, error, x.why or y.why, components=(x.value, y.value))
    order = [load.name.removesuffix(".x") for load in case.loads]
    return {name: found[name] for name in order if name in found}


def wanted_pairs(case: Case, want: Want) -> list[Pair]:
    """Pairs of links whose centres are asked for, in order."""
    links = list(case.links)
    against = {frozenset((load.link, load_wrenches.reacting(case, load))) for load in case.loads}
    if not (want.centres or want.examine):
        loaded = {load.link for load in case.loads} | {case.ground}
        told = loaded.union(*against)
        links = [link for link in links if link in told]
    links.sort(key=lambda link: link_order(case, link))
    pairs = [(a, b) for n, a in enumerate(links) for b in links[n + 1 :]]
    if want.centres or want.examine:
        return pairs
    return [pair for pair in pairs if {*pair} <= loaded or frozenset(pair) in against]


def _notes(found: Evaluation) -> list[str]:
    """Sentences about the mechanism that a reader of the answer should know."""
    program, (_, motions, _, solution) = found.program, found.outcome
    notes = [*program.case.noticed]
    if motions.redundant and not motions.notes:
        notes += _redundancy(found)
    if solution.idle and solution.values:
        count = plural(len(solution.idle), "passive freedom")
        ends = sentences.free_ends(program.top, program.case)
        notes.append(f"{count} in which no load does work{': ' if ends else ''}{ends}.")
    return notes


def _at_rest(found: Evaluation) -> list[str]:
    """Where every unknown load is none, the known loads whose links stand still."""
    (place, motions, balance, solution), a = found.outcome, found.arithmetic
    if not solution.values or any(float(value) for value in solution.values.values()):
        return []
    fastest = largest_of([x for ts in motions.twists.values() for t in ts for x in t])
    on: dict[str, list[str]] = {}
    for w in balance.wrenches:
        works = w.number and w.load.link != place.case.ground and power.has_number(w.load)
        if works and all(a.vanishes(x, fastest) for t in motions.twists[w.load.link] for x in t):
            on.setdefault(w.load.link, []).append(w.load.name)
    return [sentences.known_at_rest(loads, link) for link, loads in on.items()]


def _turning_alone(outcome: Outcome) -> list[str]:
    """The links each of which can turn by itself about a point, where nothing else can move; else none."""
    twists = outcome.motions.twists
    fastest = largest_of([x for ts in twists.values() for t in ts for x in t])
    still, found = 1e-12 * fastest, []
    for link in (links[0] for links in outcome.place.top.members):
        u, v, turn = max(twists[link], key=lambda t: abs(t[2]))
        if any(abs(x) > still for t in twists[link] for x in t):
            apart = (x * turn - w * y for *at, w in twists[link] for x, y in zip(at, (u, v), strict=True))
            if abs(turn) <= still or any(abs(off) > still * fastest for off in apart):
                return []
            found.append(link)
    return found if len(found) == outcome.motions.mobility else []


def _redundancy(found: Evaluation) -> Iterable[str]:
    """What becomes of a motion that redundant constraints allow in this position."""
    from icsolve.kinematics.accelerations import goes_on
    from icsolve.statics.self_stress import self_stress

    place, motions, wedges = found.outcome.place, found.outcome.motions, found.program.top.wedges
    onward, stress = None, self_stress(place)
    if motions.mobility == 1 and stress.moving:
        onward = goes_on(place, {link: one for link, (one,) in motions.twists.items()})
    if stress.ways + wedges:
        lost = (stress.moving, motions.mobility) if stress.moving else None
        told = found.program.want.bodies, wedges, lost, stress.links
        yield sentences.redundant(stress.ways, onward, *told)
    if onward is False and place.case.loads and not any(map(power.is_unknown, place.case.loads)):
        yield from _turned_rollers(found)


def _turned_rollers(found: Evaluation) -> Iterable[str]:
    """What is said of rollers on the frame whose pins move, of links that yield for an instant under known
    loads: a support whose line was given square to what was meant."""
    place, motions = found.outcome.place, found.outcome.motions
    fastest = largest_of([x for ts in motions.twists.values() for t in ts for x in t])
    for joint in place.case.joints:
        along = joint.guide.angle if joint.guide is not None and joint.freedom == 2 else None
        if along is not None and joint.at is not None and joint.links[1] == place.case.ground:
            (twist,) = motions.twists[joint.links[0]]
            if not all(
                found.arithmetic.vanishes(v, fastest) for v in velocity(twist, place.points[joint.at])
            ):
                yield sentences.turned_roller(joint.at, along.value)


def _skipped(program: Program, outcome: Outcome) -> tuple[str, ...]:
    """What was not examined because the answer does not need it."""
    left = [link for link in program.case.links if link not in outcome.motions.twists]
    names = (links_named(left),) if left else ()
    return (*names, *program.figure.skipped)


def _steps(program: Program) -> tuple[str, ...]:
    """The steps of the plan that ran."""
    from icsolve.assembly.refusals import step_words

    figure = tuple(map(step_words, program.figure.steps))
    if program.plan is None:
        return (*figure, "motions: loop equations of the whole scene")
    top = program.top
    entry = top.bonds[program.plan.entry]
    names = [f"motions: virtual input {entry.links[0]}-{entry.links[1]}"]
    for group in program.plan.groups:
        links = listed(top.members[body][0] for body in group.bodies)
        names.append(f"motions: link {links}" if len(group.bodies) == 1 else f"motions: links {links}")
    return (*figure, *names)
