"""All likely wrong answers of a case: every changed case is solved once, whatever is asked of it; the wrong
steps of a scene with one unknown follow from its centres and rates.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from icsolve.answer import Answer
from icsolve.case import Case, Load, Torque, is_angle, pair_name
from icsolve.case.expected import (
    CentreIs,
    DistanceIs,
    LoadIs,
    OfBodies,
    PositionIs,
    RateIs,
    RatioIs,
    SpeedIs,
    Target,
)
from icsolve.errors import IcsolveError, SceneError, Status
from icsolve.grade.mistakes.changed import (
    Changed,
    Place,
    changed_figures,
    changed_loads,
    heading_of,
    known_loads,
    moves_otherwise,
    place_of,
    same_kind,
    turned_loads,
)
from icsolve.grade.mistakes.lookup import FACTORS, Wrong, plain_wrongs
from icsolve.report.check import value_of
from icsolve.statics.load_wrenches import reacting
from icsolve.tuples import NamedTuple, cached_property, replace

_NOTHING = 1e-9
"""A component below this part of the other is rounding."""
PlaceWrong = tuple[float, float, Wrong]
"""A wrong place and its cause."""
Solution = tuple[Changed, Answer]
Known = Mapping[str, Sequence[Answer | None]]
"""Changed cases solved before, by their kind and in their order."""


def solved_for(case: Case, target: Target | None = None, final: tuple[str, ...] = ()) -> Answer:
    """The case solved with all that a target and the wrong answers need; of loads the bare answer, where
    centres and rates can't be had for a reason that is not ``final``.

    Raises SceneError where it has no answer.
    """
    from icsolve.solve import solve

    bodies = isinstance(target, OfBodies)
    try:
        return solve(case, all_centres=True, rates=True, bound=False, reactions=bodies)
    except SceneError as error:
        if (target is not None and not isinstance(target, LoadIs)) or error.status in final:
            raise
        return solve(case, bound=False)


class WrongAnswers:
    """The wrong answers of a case, ``answer`` solved with all centres and rates; ``bodies`` with reactions,
    where those are asked for.

    Each changed case is solved when it is first needed, and once; those whose loads alone are others are no
    wrong reading of a centre or a ratio.
    """

    def __init__(self, answer: Answer, target: Target | None = None, known: Known | None = None) -> None:
        """``known``: the changed cases that were solved before."""
        self.answer = answer
        self._target = target
        self._known = known or {}

    @cached_property
    def _figures(self) -> list[Solution]:
        return self._solved("figures", changed_figures(self.answer.case, self._pose))

    @cached_property
    def _loads(self) -> list[Solution]:
        return self._solved("loads", changed_loads(self.answer.case, self._pose.points))

    @cached_property
    def _quarters(self) -> dict[str, Answer]:
        """The answers with a load a quarter turn on, by the load."""
        turned = turned_loads(self.answer)
        found = self._solved("quarters", (Changed("", case, name) for name, case in turned.items()))
        return {changed.where: answer for changed, answer in found}

    @property
    def _pose(self) -> Answer:
        """The answer itself, or of several positions the first."""
        return self.answer.positions[0].answer if self.answer.positions else self.answer

    def _solved(self, kind: str, some: Iterable[Changed]) -> list[Solution]:
        changes = list(some)
        answers = self._known.get(kind) or [_tried(self._begun(one.case), self._target) for one in changes]
        found = zip(changes, answers, strict=True)
        return [(changed, answer) for changed, answer in found if answer is not None]

    def _begun(self, changed: Case) -> Case:
        """A changed case that starts from the right figure: that is nearer than the `near` of the file."""
        case, points = self.answer.case, self._pose.points
        if changed.near is not case.near:
            return changed
        return replace(changed, near={name: points.get(name, at) for name, at in case.near.items()})

    def of(self, target: Target, value: float | None = None) -> list[Wrong]:
        """The wrong values of a target that is one number, ``value``."""
        if value is None:
            value = next(iter(_values(self.answer, target)), None)
        if value is None:
            return []
        if isinstance(target, PositionIs) and is_angle(target.path):
            return [*_other_angles(value), *self._of_changed(target)]
        found = list(plain_wrongs(value, rate=isinstance(target, RateIs | SpeedIs)))
        if isinstance(target, LoadIs):
            found += self.of_loads(target.load)
        elif isinstance(target, RatioIs):
            found += _wrong_ratios(self.answer, target, value)
        elif isinstance(target, DistanceIs):
            found += _other_distances(self.answer, target)
        return found + list(self._of_changed(target))

    def _of_changed(self, target: Target) -> Iterator[Wrong]:
        case = self.answer.case
        moves = isinstance(target, RatioIs | RateIs | SpeedIs | CentreIs | DistanceIs)
        loads = [] if moves or isinstance(target, LoadIs) else self._loads
        for changed, answer in (*self._figures, *loads):
            if not moves or moves_otherwise(changed.case, case):
                code, _, where, load = changed
                load = "" if isinstance(target, PositionIs) else load  # no shares add up to a position
                yield from (Wrong(code, value, where, load) for value in _values(answer, target))

    def of_loads(self, unknown: str) -> Iterator[Wrong]:
        """Those of an unknown load that do not misread the figure: by loads, components, ratios, centres."""
        answer = self.answer
        for (code, _, where, load), changed in self._loads:
            value = _load_of(changed, unknown)
            if value is not None:
                yield Wrong(code, value, where, load)
        right = answer.answers[unknown].value
        known = list(known_loads(answer.case))
        without = {changed.load: other for changed, other in self._loads if changed.code == "missed-load"}
        for own in known:
            base = 0.0 if len(known) == 1 else _load_of(without.get(own.name), unknown)
            if base is not None:
                if len(answer.answers) > 1:
                    yield from _load_over_part(own, answer.case, unknown, right, base)
                yield from self._components(own, unknown, right, base)
        if len(answer.answers) == 1:
            yield from self._own_direction(unknown, right)
            yield from step_wrongs(answer, unknown)
        for other, found in answer.answers.items():
            if other != unknown and found.unit == answer.answers[unknown].unit:
                yield Wrong("other-unknown", found.value, other)

    def _components(self, load: Load, unknown: str, right: float, base: float) -> Iterator[Wrong]:
        """The load's share with its whole velocity, and with the component square to it.

        The answer is ``base + share * cos``: with the load a quarter turn on it is ``base - share * sin``, so
        that the share of the whole velocity is the hypotenuse of the two.
        """
        quarter = _load_of(self._quarters.get(load.name), unknown)
        if quarter is None:
            return
        along, across = right - base, quarter - base
        if abs(across) <= _NOTHING * abs(along):
            return  # along its velocity: nothing to leave out, and sine for cosine leaves the load out
        whole = math.copysign(math.hypot(along, across), along)
        yield Wrong("no-cos", base + whole, load.name, load.name)
        yield Wrong("sin-cos", base + math.copysign(across, along), load.name, load.name)
        yield Wrong("sin-cos", base - math.copysign(across, along), load.name, load.name)

    def _own_direction(self, unknown: str, value: float) -> Iterator[Wrong]:
        """The same for an unknown force: its velocity stands below the line."""
        across = _load_of(self._quarters.get(unknown), unknown)
        if across and value:
            whole = 1.0 / math.hypot(1.0 / value, 1.0 / across)
            yield Wrong("no-cos", math.copysign(whole, value), unknown)
            yield Wrong("sin-cos", math.copysign(across, value), unknown)

    def shares(self, unknown: str) -> Shares:
        """What each known load contributes to an unknown: of several, the answer less that without it."""
        found = shares(self.answer, unknown)
        if found:
            return found
        right = self.answer.answers[unknown].value
        known = list(known_loads(self.answer.case))
        if len(known) == 1:
            return {known[0].name: right}
        for changed, other in self._loads:
            without = _load_of(other, unknown) if changed.code == "missed-load" else None
            if without is not None:
                found[changed.load] = right - without
        whole = len(found) == len(known) and abs(sum(found.values()) - right) <= 1e-6 * abs(right)
        return found if whole else {}

    def places(self, target: CentreIs) -> list[PlaceWrong]:
        """Wrong places of a centre: another one, coordinates exchanged or of the wrong sign, other units."""
        right = _place_of_end(self.answer, target.pair)
        if right is None:
            return []
        x, y = right
        found: list[PlaceWrong] = [(a, b, Wrong("sign", 0.0)) for a, b in ((-x, y), (x, -y), (-x, -y))]
        found.append((y, x, Wrong("swapped", 0.0)))
        for factor in (*FACTORS.values(), *(1.0 / f for f in FACTORS.values())):
            found.append((x * factor, y * factor, Wrong("unit-factor", 0.0)))
        found += [(x * 10.0**k, y * 10.0**k, Wrong("power-of-ten", 0.0)) for k in (-3, -2, -1, 1, 2, 3)]
        for pair, place in finite_centres(self.answer):
            if set(pair) != set(target.pair):
                found.append((*place, Wrong("wrong-ic", 0.0, f"I{pair_name(self.answer.case, pair)}")))
        for changed, answer in self._figures:
            place_there = _place_of_end(answer, target.pair)
            if place_there is not None:
                found.append((*place_there, Wrong(changed.code, 0.0, changed.where)))
        return found


def _tried(case: Case, target: Target | None = None) -> Answer | None:
    """A changed case solved; None where it can't be, which is no one's mistake then."""
    try:
        return solved_for(case, target, (Status.CANNOT_ASSEMBLE, Status.AMBIGUOUS))
    except (IcsolveError, ArithmeticError):
        return None


def _values(answer: Answer, target: Target) -> Iterator[float]:
    """The target's values: those of all positions for a datum of the figure; none where it has none."""
    if isinstance(target, PositionIs):
        for position in answer.positions or ():
            held = position.at.get(target.path)
            yield from () if held is None else (held,) if isinstance(held, float) else held
        return
    try:
        yield value_of(answer, target)[0]
    except (IcsolveError, ArithmeticError, LookupError):
        return


def _load_of(answer: Answer | None, unknown: str) -> float | None:
    """An unknown load in a changed case."""
    found = answer.answers.get(unknown) if answer is not None else None
    return found.value if found is not None and found.holds is None else None


def _load_over_part(load: Load, case: Case, unknown: str, right: float, base: float) -> Iterator[Wrong]:
    """The ratio of a load to what it asks of an unknown of its kind, the wrong way round.

    Of a single unknown `step_wrongs` makes these, by its links' rates too.
    """
    own = next((one for one in case.loads if one.name == unknown), None)
    number, part = getattr(getattr(load, "value", None), "value", 0.0), right - base
    if number and part and own is not None and same_kind(load, own):
        wrong = right + part * ((number / part) ** 2 - 1.0)
        yield Wrong("inverse-ratio", wrong, f"{unknown} and {load.name}")


def _other_angles(value: float) -> Iterator[Wrong]:
    """The angle the other way round, from the other axis, from the other end of the line, in radians."""
    yield from (Wrong(code, wrong) for code, wrong in (("sign", -value), ("half", value / 2.0)))
    yield from (Wrong("unit-factor", wrong) for wrong in (math.degrees(value), math.radians(value)))
    yield Wrong("double", 2.0 * value)
    yield Wrong("sin-cos", 90.0 - value)
    yield Wrong("angle-sense", 180.0 - value)


def _wrong_ratios(answer: Answer, target: RatioIs, value: float) -> Iterator[Wrong]:
    """Upside down, taken as 1, or without one of its stages: w4/w2 is (w4/w3) (w3/w2)."""
    where = f"w{target.over}/w{target.under}"
    for sign in (1.0, -1.0):
        yield Wrong("inverse-ratio", sign / value if value else math.nan, where)
        yield Wrong("ratio-one", sign, where)
    rates = answer.rates or {}
    above, below = rates.get(target.over), rates.get(target.under)
    for link, rate in rates.items():
        if link in (target.over, target.under, answer.case.ground) or not isinstance(rate, float) or not rate:
            continue
        if isinstance(above, float) and isinstance(below, float) and below:
            yield Wrong("missed-stage", above / rate, f"link {link}")
            yield Wrong("missed-stage", rate / below, f"link {link}")


def _other_distances(answer: Answer, target: DistanceIs) -> Iterator[Wrong]:
    """Distances from the other centres of the links of either end."""
    for end, other in ((target.a, target.b), (target.b, target.a)):
        far = _place_of_end(answer, other)
        if isinstance(end, str) or far is None:
            continue
        for pair, place in finite_centres(answer):
            if set(pair) & set(end) and set(pair) != set(end):
                yield Wrong("wrong-ic", math.dist(place, far), f"I{pair_name(answer.case, pair)}")


def _place_of_end(answer: Answer, end: tuple[str, str] | str) -> Place | None:
    if isinstance(end, str):
        return answer.points.get(end)
    return next((place for pair, place in finite_centres(answer) if set(pair) == set(end)), None)


_SAME = 1e-9
"""Rates and arms that differ less are the same."""
Shares = dict[str, float]
"""The part of an unknown that each known load asks for; they add up to it."""


class WrongStep(NamedTuple):
    """A wrong step: its code, by what it changes the share of a load, and where it sits."""

    code: str
    factor: float
    where: str


def shares(answer: Answer, unknown: str) -> Shares:
    """What each known load contributes to the unknown, by the sum of power: ``-L * factor / own factor``."""
    try:
        own = next((term for term in answer.terms if term.load == unknown), None)
    except SceneError:  # the motions of the links leave the powers open
        return {}
    if own is None or own.factor == 0.0 or sum(term.unknown for term in answer.terms) != 1:
        return {}
    return {term.load: -term.power / own.factor for term in answer.terms if not term.unknown}


def step_wrongs(answer: Answer, unknown: str) -> Iterator[Wrong]:
    """Wrong answers for a scene with one unknown; ``answer`` has its centres and rates."""
    parts, case = shares(answer, unknown), answer.case
    if not parts:
        return
    value = answer.answers[unknown].value
    own = next(load for load in case.loads if load.name == unknown)
    for load in known_loads(case):
        part = parts.get(load.name)
        if part:
            for code, factor, where in (*_of_ratio(answer, load, own), *_of_force(answer, load)):
                yield Wrong(code, value + part * (factor - 1.0), where, load.name)
    for code, factor, where in _of_force(answer, own):  # its velocity stands below the line
        yield Wrong(code, value / factor, where)


def _of_ratio(answer: Answer, load: Load, own: Load) -> Iterator[WrongStep]:
    """The ratio of the two links' rates, or of the two loads' factors, upside down, taken as 1, without one
    of its stages, or by another centre or one distance alone.

    w4/w2 is (w4/w3) (w3/w2): without one of the two, the other stands for all of it.
    """
    factors = {term.load: term.factor for term in answer.terms}
    ratio = factors.get(load.name, 0.0) / factors[own.name]
    if same_kind(load, own) and ratio:
        both = f"{own.name} and {load.name}"
        yield WrongStep("inverse-ratio", 1.0 / ratio / ratio, both)
        yield WrongStep("ratio-one", 1.0 / ratio, both)
        yield WrongStep("ratio-one", -1.0 / ratio, both)
    if load.link == own.link:
        return
    where = f"links {own.link} and {load.link}"
    yield from _of_rates(answer, load.link, own.link, where)
    ground = answer.case.ground
    mine, its = centres_of(answer, own.link), centres_of(answer, load.link)
    common, first, second = its.get(own.link), mine.get(ground), its.get(ground)
    if common is None:
        return
    above, below = (math.dist(common, c) if c is not None else 0.0 for c in (first, second))
    if above and below:
        yield WrongStep("one-arm", below, where)
        yield WrongStep("one-arm", 1.0 / above, where)
    right = quotient(common, first, second)
    for centres, link in ((its, load.link), (mine, own.link)) if first or second else ():
        for other, centre in centres.items():
            wrong = quotient(centre, first, second)
            if right and wrong and {other, link} != {load.link, own.link} and other != ground:
                yield WrongStep("wrong-ic", wrong / right, f"I{pair_name(answer.case, (link, other))}")


def _of_rates(answer: Answer, link: str, own: str, where: str) -> Iterator[WrongStep]:
    """The ratio of the rates of two links taken otherwise."""
    rates = answer.rates or {}
    first, second = rates.get(link), rates.get(own)
    if not isinstance(first, float) or not isinstance(second, float) or not first or not second:
        return
    yield WrongStep("inverse-ratio", (second / first) ** 2, where)
    yield WrongStep("ratio-one", second / first, where)
    yield WrongStep("ratio-one", -second / first, where)
    for name, rate in rates.items():
        if name in (link, own, answer.case.ground) or not isinstance(rate, float) or not rate:
            continue
        for stage in (rate / first, second / rate):
            if min(abs(abs(stage) - 1.0), abs(stage - second / first)) > _SAME:
                yield WrongStep("missed-stage", stage, f"link {name}")
                yield WrongStep("missed-stage", -stage, f"link {name}")


def quotient(centre: Place, first: Place | None, second: Place | None) -> float | None:
    """Distance from the first over that from the second; one at infinity counts for nothing: of a link that
    only slides, the ratio is the distance of the common centre from the other one's."""
    below = math.dist(centre, second) if second is not None else 1.0
    above = math.dist(centre, first) if first is not None else 1.0
    return above / below if below else None


def _of_force(answer: Answer, load: Load) -> Iterator[WrongStep]:
    """The moment of a force about another centre of its link, or by one of its components alone."""
    at, heading = place_of(getattr(load, "at", ""), answer), heading_of(load, answer)
    against, centres = reacting(answer.case, load), centres_of(answer, load.link)
    frame_centre = centres.get(against)
    if isinstance(load, Torque) or at is None or heading is None or frame_centre is None:
        return
    by_x, by_y = _moments(at, heading, frame_centre)
    right, size = by_x + by_y, abs(by_x) + abs(by_y)
    if abs(right) >= _SAME * (1.0 + math.dist(at, frame_centre)):
        for other, centre in centres.items():
            wrong = sum(_moments(at, heading, centre))
            if other != against and wrong:
                yield WrongStep("wrong-ic", wrong / right, f"I{pair_name(answer.case, (load.link, other))}")
    if min(abs(by_x), abs(by_y), abs(right)) > 1e-6 * size:
        yield WrongStep("one-component", by_x / right, load.name)
        yield WrongStep("one-component", by_y / right, load.name)


def _moments(at: Place, heading: float, centre: Place) -> tuple[float, float]:
    """Moments of the two components of a unit force about a centre."""
    angle = math.radians(heading)
    return -(at[1] - centre[1]) * math.cos(angle), (at[0] - centre[0]) * math.sin(angle)


def centres_of(answer: Answer, link: str) -> dict[str, Place]:
    """The places of a link's centres, by the other link; those at infinity have none."""
    found = {}
    for pair, place in finite_centres(answer):
        if link in pair:
            found[pair[1] if pair[0] == link else pair[0]] = place
    return found


def finite_centres(answer: Answer) -> Iterator[tuple[tuple[str, str], Place]]:
    """The centres that have a place."""
    for pair, centre in answer.centres.items():
        if centre.kind == "at":
            yield pair, (centre.place[0], centre.place[1])
