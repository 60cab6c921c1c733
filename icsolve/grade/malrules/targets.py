"""Likely wrong values of intermediate answers: rates, ratios, distances, speeds, places of centres."""

from __future__ import annotations

import math
from collections.abc import Iterator

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, DistanceIs, RateIs, RatioIs, Target
from icsolve.check import value_of
from icsolve.errors import IcsolveError
from icsolve.grade.malrules.gather import changed_cases
from icsolve.grade.malrules.messages import Wrong
from icsolve.grade.malrules.plain import FACTORS, plain_wrongs
from icsolve.names import pair_name

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
    found = list(plain_wrongs(value, rate=isinstance(target, RateIs)))
    if isinstance(target, RatioIs) and value:
        where = f"w{target.over}/w{target.under}"
        found += [Wrong("inverse-ratio", 1.0 / value, where), Wrong("inverse-ratio", -1.0 / value, where)]
    if isinstance(target, DistanceIs):
        found += _other_distances(answer, target)
    for code, changed in changed_cases(answer):
        found += [Wrong(code, other[0]) for other in _values(changed, target)]
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
