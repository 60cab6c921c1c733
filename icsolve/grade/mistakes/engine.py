"""All likely wrong answers of a case, computed once by the solver, ready to be looked up."""

from __future__ import annotations

import math
from collections.abc import Iterator

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, DistanceIs, Load, RateIs, RatioIs, SpeedIs, Target, Torque
from icsolve.case.names import pair_name
from icsolve.check import value_of
from icsolve.errors import IcsolveError, SceneError
from icsolve.grade.mistakes.changed import (
    Place,
    Resolve,
    heading_of,
    in_radians,
    known_loads,
    other_modes,
    place_of,
    same_kind,
    scaled,
    turned,
    with_load,
    with_motion_reversed,
    with_other_meshes,
    without_friction,
)
from icsolve.grade.mistakes.codes import FACTORS, Wrong, plain_wrongs
from icsolve.grade.mistakes.steps import changed_angles, one_arm, one_component, ratio_steps, without_stages

_NOTHING = 1e-9
"""A component below this part of the other is rounding."""


def load_wrongs(answer: Answer, resolve: Resolve) -> Iterator[tuple[str, Wrong]]:
    """Wrong answers by unknown, for every load that is given and for the unknown's own direction."""
    right = {name: found.value for name, found in answer.answers.items()}
    loads = list(known_loads(answer.case))
    for load in loads:
        alone = len(loads) == 1
        base = dict.fromkeys(right, 0.0) if alone else resolve(with_load(answer.case, scaled(load, 0.0)))
        yield from _missed(load, len(loads), base)
        if len(loads) > 1:
            yield from _named("load-sense", resolve(with_load(answer.case, scaled(load, -1.0))), load.name)
        if len(right) > 1:
            yield from _load_over_part(load, answer.case, right, base)
        quarter = turned(load, answer)
        if quarter is not None:
            yield from _component(load, right, base, resolve(with_load(answer.case, quarter)))
    yield from _own_direction(answer, right, resolve)


def _missed(load: Load, count: int, base: dict[str, float]) -> Iterator[tuple[str, Wrong]]:
    """Without the load; of a single one nothing would be left."""
    if count > 1:
        yield from _named("missed-load", base, load.name)


def _load_over_part(
    load: Load, case: Case, right: dict[str, float], base: dict[str, float]
) -> Iterator[tuple[str, Wrong]]:
    """The ratio of a load to what it asks of an unknown of its kind, the wrong way round.

    Of a single unknown `icsolve.grade.mistakes.engine` makes these, by its links' rates too.
    """
    number = getattr(getattr(load, "value", None), "value", 0.0)
    for own in case.loads:
        part = right.get(own.name, 0.0) - base.get(own.name, 0.0)
        if number and part and same_kind(load, own):
            wrong = right[own.name] + part * ((number / part) ** 2 - 1.0)
            yield own.name, Wrong("inverse-ratio", wrong, f"{own.name} and {load.name}")


def _named(code: str, values: dict[str, float], where: str) -> Iterator[tuple[str, Wrong]]:
    for name, value in values.items():
        yield name, Wrong(code, value, where, where)


def _component(
    load: Load, right: dict[str, float], base: dict[str, float], quarter: dict[str, float]
) -> Iterator[tuple[str, Wrong]]:
    """The load's share with its whole velocity, and with the component square to it.

    The answer is ``base + share * cos``: with the load a quarter turn on it is ``base - share * sin``, so
    that the share of the whole velocity is the hypotenuse of the two.
    """
    for name, value in right.items():
        if name not in base or name not in quarter:
            continue
        along, across = value - base[name], quarter[name] - base[name]
        if abs(across) <= _NOTHING * abs(along):
            continue  # along its velocity: nothing to leave out, and sine for cosine leaves the load out
        yield (
            name,
            Wrong(
                "no-cos", base[name] + math.copysign(math.hypot(along, across), along), load.name, load.name
            ),
        )
        yield name, Wrong("sin-cos", base[name] + math.copysign(across, along), load.name, load.name)
        yield name, Wrong("sin-cos", base[name] - math.copysign(across, along), load.name, load.name)


def _own_direction(answer: Answer, right: dict[str, float], resolve: Resolve) -> Iterator[tuple[str, Wrong]]:
    """The same for an unknown force: its velocity stands below the line."""
    if len(right) != 1:
        return
    ((name, value),) = right.items()
    unknown = next(load for load in answer.case.loads if load.name == name)
    quarter = turned(unknown, answer)
    across = resolve(with_load(answer.case, quarter)).get(name) if quarter is not None else None
    if not across or not value:
        return
    yield name, Wrong("no-cos", math.copysign(1.0 / math.hypot(1.0 / value, 1.0 / across), value), name)
    yield name, Wrong("sin-cos", math.copysign(across, value), name)


Shares = dict[str, float]
"""The part of an unknown that each known load asks for; they add up to it."""


def shares(answer: Answer, unknown: str) -> Shares:
    """What each known load contributes to the unknown, by the sum of power: ``-L * factor / own factor``."""
    try:
        own = next((term for term in answer.terms if term.load == unknown), None)
    except SceneError:  # the motions of the links leave the powers open
        return {}
    if own is None or own.factor == 0.0 or sum(term.unknown for term in answer.terms) != 1:
        return {}
    return {term.load: -term.power / own.factor for term in answer.terms if not term.unknown}


def parts_of(answer: Answer, unknown: str) -> Shares:
    """What each known load contributes to one of several unknowns: the answer less that without the load."""
    right = answer.answers[unknown].value
    found = {}
    for load in known_loads(answer.case):
        without = resolve(with_load(answer.case, scaled(load, 0.0))).get(unknown)
        if without is None:
            return {}
        found[load.name] = right - without
    return found if abs(sum(found.values()) - right) <= 1e-6 * abs(right) else {}


def centre_wrongs(answer: Answer, unknown: str) -> Iterator[Wrong]:
    """Wrong answers for a scene with one unknown; ``answer`` has its centres and rates."""
    parts = shares(answer, unknown)
    if not parts:
        return
    case = answer.case
    value = answer.answers[unknown].value
    own = next(load for load in case.loads if load.name == unknown)
    for load in known_loads(case):
        if parts.get(load.name):
            yield from _upside_down(answer, load, own, value, parts[load.name])
            for factor, where in _arms(answer, load):
                yield Wrong("wrong-ic", value + parts[load.name] * (factor - 1.0), where, load.name)
            for factor, where in _ratios(answer, load, own):
                yield Wrong("wrong-ic", value + parts[load.name] * (factor - 1.0), where, load.name)
    for factor, where in _arms(answer, own):
        yield Wrong("wrong-ic", value / factor, where)


def step_wrongs(answer: Answer, unknown: str) -> Iterator[Wrong]:
    """Wrong answers of a single step for a scene with one unknown: ratios, stages, components, arms."""
    parts, case = shares(answer, unknown), answer.case
    if not parts:
        return
    value = answer.answers[unknown].value
    own = next(load for load in case.loads if load.name == unknown)
    factors = {term.load: term.factor for term in answer.terms}
    mine = centres_of(answer, own.link)
    for load in known_loads(case):
        part = parts.get(load.name)
        if not part:
            continue
        its = centres_of(answer, load.link)
        for code, factor, where in ratio_steps(answer, load, own, (factors[load.name], factors[own.name])):
            yield Wrong(code, value + part * (factor - 1.0), where, load.name)
        for factor in one_component(answer, load, its.get(_reacting(case, load))):
            yield Wrong("one-component", value + part * (factor - 1.0), load.name, load.name)
        if load.link != own.link:
            for factor in one_arm(its.get(own.link), mine.get(case.ground), its.get(case.ground)):
                where = f"links {own.link} and {load.link}"
                yield Wrong("one-arm", value + part * (factor - 1.0), where, load.name)
    for factor in one_component(answer, own, mine.get(_reacting(case, own))):
        yield Wrong("one-component", value / factor, own.name)


def _upside_down(answer: Answer, load: Load, own: Load, value: float, part: float) -> Iterator[Wrong]:
    """The ratio of the two links' rates, and that of the two factors, the wrong way round."""
    rates = answer.rates or {}
    first, second = rates.get(load.link), rates.get(own.link)
    where = f"links {own.link} and {load.link}"
    if isinstance(first, float) and isinstance(second, float) and first and second and load.link != own.link:
        yield Wrong("inverse-ratio", value + part * ((second / first) ** 2 - 1.0), where, load.name)
    factors = {term.load: term.factor for term in answer.terms}
    ratio = factors.get(load.name, 0.0) / factors[own.name]
    if same_kind(load, own) and ratio:
        both = f"{own.name} and {load.name}"
        yield Wrong("inverse-ratio", value + part * (ratio**-2 - 1.0), both, load.name)


def _arms(answer: Answer, load: Load) -> Iterator[tuple[float, str]]:
    """By what the power of a force changes where its distance is taken from another centre of its link."""
    at, heading = place_of(getattr(load, "at", ""), answer), heading_of(load, answer)
    frame_centre = centres_of(answer, load.link).get(_reacting(answer.case, load))
    if isinstance(load, Torque) or at is None or heading is None or frame_centre is None:
        return
    right = _arm(at, heading, frame_centre)
    if abs(right) < 1e-9 * (1.0 + math.dist(at, frame_centre)):
        return
    for other, centre in centres_of(answer, load.link).items():
        factor = _arm(at, heading, centre) / right
        if other != _reacting(answer.case, load) and factor:
            yield factor, f"I{pair_name(answer.case, (load.link, other))}"


def _ratios(answer: Answer, load: Load, own: Load) -> Iterator[tuple[float, str]]:
    """By what the ratio of two links' rates changes where another centre stands for their common one.

    Of a link that only slides, with its own centre at infinity, the ratio is the distance of the common
    centre from the other one's.
    """
    case = answer.case
    mine, its = centres_of(answer, own.link), centres_of(answer, load.link)
    common, first, second = its.get(own.link), mine.get(case.ground), its.get(case.ground)
    if common is None or load.link == own.link or (first is None and second is None):
        return
    right = _quotient(common, first, second)
    for centres, link in ((its, load.link), (mine, own.link)):
        for other, centre in centres.items():
            wrong = _quotient(centre, first, second)
            if right and wrong and {other, link} != {load.link, own.link} and other != case.ground:
                yield wrong / right, f"I{pair_name(case, (link, other))}"


def _quotient(centre: Place, first: Place | None, second: Place | None) -> float | None:
    """Distance from the first over that from the second; one at infinity counts for nothing."""
    below = math.dist(centre, second) if second is not None else 1.0
    above = math.dist(centre, first) if first is not None else 1.0
    return above / below if below else None


def centres_of(answer: Answer, link: str) -> dict[str, Place]:
    """The places of a link's centres, by the other link; those at infinity have none."""
    found = {}
    for pair, centre in answer.centres.items():
        if link in pair and centre.kind == "at":
            found[pair[1] if pair[0] == link else pair[0]] = (centre.place[0], centre.place[1])
    return found


def _reacting(case: Case, load: Load) -> str:
    return getattr(load, "against", None) or case.ground


def _arm(at: Place, heading: float, centre: Place) -> float:
    """Moment of a unit force about a centre."""
    angle = math.radians(heading)
    return (at[0] - centre[0]) * math.sin(angle) - (at[1] - centre[1]) * math.cos(angle)


def resolve(case: Case | None) -> dict[str, float]:
    """The answers of a changed case; none where it can't be solved, which is no one's mistake then."""
    from icsolve.solve import solve

    if case is None:
        return {}
    try:
        answers = solve(case, bound=False).answers
        return {name: found.value for name, found in answers.items() if found.holds is None}
    except (IcsolveError, ArithmeticError):
        return {}


def wrong_answers(answer: Answer) -> dict[str, list[Wrong]]:
    """The wrong answers of every unknown; ``answer`` has been solved with all centres and rates."""
    found: dict[str, list[Wrong]] = {name: list(plain_wrongs(a.value)) for name, a in answer.answers.items()}
    for name, wrong in (*load_wrongs(answer, resolve), *_resolved(answer)):
        if name in found:
            found[name].append(wrong)
    if len(found) == 1:
        (name,) = found
        found[name].extend(centre_wrongs(answer, name))
        found[name].extend(step_wrongs(answer, name))
    for code, changed, where in changed_angles(answer.case):
        for name, value in resolve(changed).items():
            found[name].append(Wrong(code, value, where))
    for changed, where in without_stages(answer.case):
        for name, value in resolve(changed).items():
            found[name].append(Wrong("missed-stage", value, where))
    for name, wrong in _exchanged(answer):
        found[name].append(wrong)
    return found


def _exchanged(answer: Answer) -> Iterator[tuple[str, Wrong]]:
    """Of several unknowns the value of another one, if both have the same unit."""
    for name, one in answer.answers.items():
        for other, two in answer.answers.items():
            if other != name and one.unit == two.unit:
                yield name, Wrong("other-unknown", two.value, other)


def changed_cases(answer: Answer) -> Iterator[tuple[str, Case]]:
    """Cases that a student may have solved instead, each with the code of the mistake."""
    case = answer.case
    for figure, loads in ((True, True), (False, True), (True, False)):
        changed = in_radians(case, figure, loads)
        if changed is not None:
            yield "deg-rad", changed
    for changed in with_other_meshes(case):
        yield "mesh-sense", changed
    for changed in other_modes(case, answer):
        yield "other-mode", changed
    for code, other in (
        ("no-friction", without_friction(case)),
        ("friction-sense", with_motion_reversed(case)),
    ):
        if other is not None:
            yield code, other


def _resolved(answer: Answer) -> Iterator[tuple[str, Wrong]]:
    for code, changed in changed_cases(answer):
        for name, value in resolve(changed).items():
            yield name, Wrong(code, value)


PlaceWrong = tuple[float, float, Wrong]


def solved_for(case: Case, target: Target | None = None, bound: bool = False) -> Answer:
    """The case solved with all that a target and the wrong answers need.

    Raises SceneError where it has no answer.
    """
    from icsolve.case import ArmIs, FrictionRadiusIs, ReactionIs
    from icsolve.solve import solve

    bodies = isinstance(target, ReactionIs | ArmIs | FrictionRadiusIs)
    return solve(case, all_centres=True, rates=True, bound=bound, reactions=bodies)


def target_wrongs(answer: Answer, target: Target) -> list[Wrong]:
    """Wrong values of a target that is one number."""
    try:
        (value,) = value_of(answer, target)
    except LookupError:
        return []
    found = list(plain_wrongs(value, rate=isinstance(target, RateIs | SpeedIs)))
    if isinstance(target, RatioIs) and value:
        where = f"w{target.over}/w{target.under}"
        found += [Wrong("inverse-ratio", 1.0 / value, where), Wrong("inverse-ratio", -1.0 / value, where)]
        found += [Wrong("ratio-one", 1.0, where), Wrong("ratio-one", -1.0, where)]
        found += _stages(answer, target)
    if isinstance(target, DistanceIs):
        found += _other_distances(answer, target)
    for code, changed in changed_cases(answer):
        found += [Wrong(code, other[0]) for other in _values(changed, target)]
    for code, changed, at in changed_angles(answer.case):
        found += [Wrong(code, other[0], at) for other in _values(changed, target)]
    return found


def _stages(answer: Answer, target: RatioIs) -> list[Wrong]:
    """The ratio without one of its stages: w4/w2 is (w4/w3) (w3/w2)."""
    rates = answer.rates or {}
    above, below = rates.get(target.over), rates.get(target.under)
    found: list[Wrong] = []
    for link, rate in rates.items():
        if link in (target.over, target.under, answer.case.ground) or not isinstance(rate, float) or not rate:
            continue
        if isinstance(above, float) and isinstance(below, float) and below:
            found += [Wrong("missed-stage", v, f"link {link}") for v in (above / rate, rate / below)]
    return found


def _values(case: Case, target: Target) -> Iterator[tuple[float, ...]]:
    """The target's value in a changed case, where it has one."""
    try:
        yield value_of(solved_for(case, target), target)
    except (IcsolveError, ArithmeticError, LookupError):
        return


def _other_distances(answer: Answer, target: DistanceIs) -> Iterator[Wrong]:
    """Distances from the other centres of the links of either end."""
    for end, other in ((target.a, target.b), (target.b, target.a)):
        if isinstance(end, str):
            continue
        far = _place_of_end(answer, other)
        for pair, place in _places(answer):
            if set(pair) & set(end) and set(pair) != set(end) and far is not None:
                yield Wrong("wrong-ic", math.dist(place, far), f"I{pair_name(answer.case, pair)}")


def _place_of_end(answer: Answer, end: tuple[str, str] | str) -> tuple[float, ...] | None:
    if isinstance(end, str):
        return answer.points.get(end)
    return next((place for pair, place in _places(answer) if set(pair) == set(end)), None)


def _places(answer: Answer) -> Iterator[tuple[tuple[str, str], tuple[float, float]]]:
    for pair, centre in answer.centres.items():
        if centre.kind == "at":
            yield pair, (centre.place[0], centre.place[1])


def place_wrongs(answer: Answer, target: CentreIs) -> list[PlaceWrong]:
    """Wrong places of a centre: another centre, coordinates exchanged or of the wrong sign, other units."""
    right = _place_of_end(answer, target.pair)
    if right is None:
        return []
    x, y = right[0], right[1]
    found: list[PlaceWrong] = [(a, b, Wrong("sign", 0.0)) for a, b in ((-x, y), (x, -y), (-x, -y))]
    found.append((y, x, Wrong("swapped", 0.0)))
    for factor in (*FACTORS.values(), *(1.0 / f for f in FACTORS.values())):
        found.append((x * factor, y * factor, Wrong("unit-factor", 0.0)))
    found += [(x * 10.0**k, y * 10.0**k, Wrong("power-of-ten", 0.0)) for k in (-3, -2, -1, 1, 2, 3)]
    for pair, place in _places(answer):
        if set(pair) != set(target.pair):
            found.append((*place, Wrong("wrong-ic", 0.0, f"I{pair_name(answer.case, pair)}")))
    for code, changed in changed_cases(answer):
        found += [(v[0], v[1], Wrong(code, 0.0)) for v in _values(changed, target)]
    return found
