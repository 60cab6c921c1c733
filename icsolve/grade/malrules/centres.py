"""Wrong answers of the method itself: a ratio upside down, a distance from another centre of the link."""

from __future__ import annotations

import math
from collections.abc import Iterator

from icsolve.answer import Answer
from icsolve.case import Case, Load, Torque
from icsolve.grade.malrules.changed import Place, heading_of, known_loads, place_of, same_kind
from icsolve.grade.malrules.messages import Wrong
from icsolve.names import pair_name

Shares = dict[str, float]
"""The part of an unknown that each known load asks for; they add up to it."""


def shares(answer: Answer, unknown: str) -> Shares:
    """What each known load contributes to the unknown, by the sum of power: ``-L * factor / own factor``."""
    own = next((term for term in answer.terms if term.load == unknown), None)
    if own is None or own.factor == 0.0 or sum(term.unknown for term in answer.terms) != 1:
        return {}
    return {term.load: -term.power / own.factor for term in answer.terms if not term.unknown}


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
                yield Wrong("wrong-ic", value + parts[load.name] * (factor - 1.0), where)
            for factor, where in _ratios(answer, load, own):
                yield Wrong("wrong-ic", value + parts[load.name] * (factor - 1.0), where)
    for factor, where in _arms(answer, own):
        yield Wrong("wrong-ic", value / factor, where)


def _upside_down(answer: Answer, load: Load, own: Load, value: float, part: float) -> Iterator[Wrong]:
    """The ratio of the two links' rates, and that of the two factors, the wrong way round."""
    rates = answer.rates or {}
    first, second = rates.get(load.link), rates.get(own.link)
    where = f"links {own.link} and {load.link}"
    if isinstance(first, float) and isinstance(second, float) and first and second and load.link != own.link:
        yield Wrong("inverse-ratio", value + part * ((second / first) ** 2 - 1.0), where)
    factors = {term.load: term.factor for term in answer.terms}
    ratio = factors.get(load.name, 0.0) / factors[own.name]
    if same_kind(load, own) and ratio:
        yield Wrong("inverse-ratio", value + part * (ratio**-2 - 1.0), f"{own.name} and {load.name}")


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
