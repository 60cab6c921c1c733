"""Wrong answers of a single step, by the centres and rates of an answer: a ratio, an arm, a component."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import Load, Torque
from icsolve.case.names import pair_name
from icsolve.errors import SceneError
from icsolve.grade.mistakes.changed import Place, heading_of, known_loads, place_of, same_kind
from icsolve.grade.mistakes.codes import Wrong
from icsolve.statics.power import reacting

_SAME = 1e-9
"""Rates and arms that differ less are the same."""
Shares = dict[str, float]
"""The part of an unknown that each known load asks for; they add up to it."""


class Step(NamedTuple):
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


def _of_ratio(answer: Answer, load: Load, own: Load) -> Iterator[Step]:
    """The ratio of the two links' rates, or of the two loads' factors, upside down, taken as 1, without one
    of its stages, or by another centre or one distance alone.

    w4/w2 is (w4/w3) (w3/w2): without one of the two, the other stands for all of it.
    """
    factors = {term.load: term.factor for term in answer.terms}
    ratio = factors.get(load.name, 0.0) / factors[own.name]
    if same_kind(load, own) and ratio:
        both = f"{own.name} and {load.name}"
        yield Step("inverse-ratio", ratio**-2, both)
        yield Step("ratio-one", 1.0 / ratio, both)
        yield Step("ratio-one", -1.0 / ratio, both)
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
        yield Step("one-arm", below, where)
        yield Step("one-arm", 1.0 / above, where)
    right = _quotient(common, first, second)
    for centres, link in ((its, load.link), (mine, own.link)) if first or second else ():
        for other, centre in centres.items():
            wrong = _quotient(centre, first, second)
            if right and wrong and {other, link} != {load.link, own.link} and other != ground:
                yield Step("wrong-ic", wrong / right, f"I{pair_name(answer.case, (link, other))}")


def _of_rates(answer: Answer, link: str, own: str, where: str) -> Iterator[Step]:
    """The ratio of the rates of two links taken otherwise."""
    rates = answer.rates or {}
    first, second = rates.get(link), rates.get(own)
    if not isinstance(first, float) or not isinstance(second, float) or not first or not second:
        return
    yield Step("inverse-ratio", (second / first) ** 2, where)
    yield Step("ratio-one", second / first, where)
    yield Step("ratio-one", -second / first, where)
    for name, rate in rates.items():
        if name in (link, own, answer.case.ground) or not isinstance(rate, float) or not rate:
            continue
        for stage in (rate / first, second / rate):
            if min(abs(abs(stage) - 1.0), abs(stage - second / first)) > _SAME:
                yield Step("missed-stage", stage, f"link {name}")
                yield Step("missed-stage", -stage, f"link {name}")


def _quotient(centre: Place, first: Place | None, second: Place | None) -> float | None:
    """Distance from the first over that from the second; one at infinity counts for nothing: of a link that
    only slides, the ratio is the distance of the common centre from the other one's."""
    below = math.dist(centre, second) if second is not None else 1.0
    above = math.dist(centre, first) if first is not None else 1.0
    return above / below if below else None


def _of_force(answer: Answer, load: Load) -> Iterator[Step]:
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
                yield Step("wrong-ic", wrong / right, f"I{pair_name(answer.case, (load.link, other))}")
    if min(abs(by_x), abs(by_y), abs(right)) > 1e-6 * size:
        yield Step("one-component", by_x / right, load.name)
        yield Step("one-component", by_y / right, load.name)


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
