"""Cases with one thing done wrong about a rope, a screw or a mass, as values."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import Case, Motion, Number, Rope, Slide
from icsolve.numbers.arithmetic import FLOATS
from icsolve.screws.ropes import rope_parts, wrap_angle

TURN = 2.0 * math.pi
RPM = 30.0 / math.pi


class Misread(NamedTuple):
    """The code of a mistake, the case in which it was made, and where it sits."""

    code: str
    case: Case
    where: str


def misread(case: Case, answer: Answer) -> Iterator[Misread]:
    """The case with its ropes, screws and inertia forces misread; ``answer`` has its points."""
    for n, rope in enumerate(case.ropes):
        for code, other in _ropes(rope, answer):
            ropes = (*case.ropes[:n], other, *case.ropes[n + 1 :])
            yield Misread(code, replace(case, ropes=ropes), f"rope {rope.name}")
    for n, joint in enumerate(case.joints):
        for other_slide in _screws(joint) if isinstance(joint, Slide) and joint.thread is not None else ():
            joints = (*case.joints[:n], other_slide, *case.joints[n + 1 :])
            yield Misread("lead", replace(case, joints=joints), "")
    if case.dynamic:
        own = tuple(load for load in case.loads if not load.name.startswith("inertia "))
        yield from _masses(replace(case, loads=own))


def _ropes(rope: Rope, answer: Answer) -> Iterator[tuple[str, Rope]]:
    """A rope with parts not counted, round another side of a pulley, or with a wrong angle of wrap."""
    last = len(rope.points) - 1
    for k in range(1, last - 1):
        if rope.points[k] == rope.points[k + 2] or rope.points[k - 1] == rope.points[k + 1]:
            yield "rope-parts", _without(rope, (k, k + 1))
    if not rope.is_free and last > 1:
        yield from (("rope-parts", _without(rope, (k,))) for k in range(1, last))
    for k, mu in enumerate(rope.mu):
        if mu is None or not all(p in answer.points for p in rope.points):
            continue
        beta = wrap_angle(rope, k, rope_parts(rope, answer.points, 1.0, FLOATS))
        others = (TURN - beta, math.pi - beta, 1.0, math.degrees(beta))  # the other side, its supplement
        codes = ("wrap", "wrap", "wrap", "deg-rad")
        for code, angle in zip(codes, others, strict=True):
            if angle > 0.0 and mu.value * angle < 700.0:
                yield code, _with_mu(rope, k, _written(mu, mu.value * angle / beta))


def _without(rope: Rope, places: tuple[int, ...]) -> Rope:
    """The rope past some of its pulleys."""
    kept = [k for k in range(len(rope.points)) if k not in places]
    return rope._replace(
        points=tuple(rope.points[k] for k in kept),
        links=tuple(rope.links[k] for k in kept if k < len(rope.links)),
        radii=tuple(rope.radii[k] for k in kept),
        wraps=tuple(rope.wraps[k] for k in kept),
        mu=tuple(rope.mu[k] for k in kept),
    )


def _with_mu(rope: Rope, k: int, mu: Number) -> Rope:
    return rope._replace(mu=(*rope.mu[:k], mu, *rope.mu[k + 1 :]))


def _screws(slide: Slide) -> Iterator[Slide]:
    """A screw whose lead is taken for its way a radian, or that a radius alone measures."""
    assert slide.thread is not None
    lead = slide.thread.lead
    for factor in (TURN, 0.5, 2.0):
        yield slide._replace(thread=slide.thread._replace(lead=_written(lead, lead.value * factor)))


def _masses(case: Case) -> Iterator[Misread]:
    """Inertia forces left out, of one link or all; revolutions for radians; an acceleration left out."""
    yield Misread("no-inertia", replace(case, dynamic=False), "")
    for link, own in case.inertia.items():
        others = {name: inertia for name, inertia in case.inertia.items() if name != link}
        if others:
            yield Misread("no-inertia", replace(case, inertia=others), f"link {link}")
        if own.mass is not None and own.moment is not None:
            point = case.inertia | {link: own._replace(moment=None)}
            yield Misread("no-inertia", replace(case, inertia=point), f"the couple of link {link}")
    for factor in (RPM, 1.0 / RPM):
        yield Misread("rpm", replace(case, motion=tuple(_faster(given, factor) for given in case.motion)), "")
    if any(given.acceleration is not None for given in case.motion):
        steady = tuple(given._replace(acceleration=None) for given in case.motion)
        yield Misread("no-acceleration", replace(case, motion=steady), "")
        turned = tuple(_slowing(given) for given in case.motion)
        yield Misread("no-acceleration", replace(case, motion=turned), "")


def _faster(given: Motion, factor: float) -> Motion:
    return given._replace(speed=_written(given.speed, given.speed.value * factor)) if given.speed else given


def _slowing(given: Motion) -> Motion:
    more = given.acceleration
    return given._replace(acceleration=_written(more, -more.value)) if more is not None else given


def _written(number: Number, value: float) -> Number:
    return Number(value, 0.0, number.path, repr(value))
