"""The solver asked about a scene of the generators, and its answers held to the reference."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import combinations
from random import Random
from typing import Any

import pytest

import icsolve
import mechanisms
import transcribe
import witness
from growth import random_mechanism
from icsolve.answer import Answer
from loading import drawn
from reference import MANY, Motions
from sizes import MORE
from transcribe import Scene

LAW = 1e-9
"""What the format promises of answers, rates and velocities."""
SINE = 1e-12
"""Of the angle between homogeneous centres, where no centre is ill-conditioned."""


def solved(scene: Scene, **options: Any) -> Answer:
    """The solver's answer to a scene."""
    return icsolve.solve(icsolve.load(transcribe.text(scene)), **options)


def whole(scene: Scene) -> Answer:
    """With all centres, rates and velocities."""
    return solved(scene, all_centres=True, rates=True)


def unknown(scene: Scene) -> float:
    """The value of the unknown `U`."""
    return solved(scene).answers["U"].value


def random_scenes(first: int, number: int) -> Iterable[Scene]:
    """Random mechanisms of any kinds of joints, by seed."""
    return (random_mechanism(Random(seed)) for seed in range(first, first + number * MORE))


def kinds(seed: int) -> Iterable[Scene]:
    """Each named kind, drawn once (in full runs, twenty times)."""
    return (drawn(s, g) for g in mechanisms.ALL for s in range(seed, seed + MORE))


def told(scene: Scene) -> str:
    """The scene, to see it where a law fails."""
    return "\n" + transcribe.text(scene)


def check_answers(scene: Scene, found: Motions) -> None:
    """Unknown loads as virtual power over the null space has them."""
    answers = solved(scene).answers
    for name, value in witness.answers(found).items():
        assert answers[name].value == pytest.approx(value, rel=LAW), name + told(scene)


def worst_sine(scene: Scene, found: Motions) -> float:
    """Of all centres of a scene, checked by kind; the largest angle from the reference's."""
    centres = {tuple(sorted(pair)): c for pair, c in solved(scene, all_centres=True).centres.items()}
    worst = 0.0
    for pair in combinations(found.case.links, 2):
        mine, theirs = witness.centre(found, *pair), centres[tuple(sorted(pair))]
        if isinstance(mine, str):
            assert theirs.kind == mine, f"{pair}: {theirs}" + told(scene)
            continue
        assert theirs.kind in ("at", "toward"), f"{pair}: {theirs}" + told(scene)
        place = theirs.place if theirs.kind == "at" else theirs.place[0]
        shown = witness.homogeneous(found.frame, {theirs.kind: place}, MANY)
        worst = max(worst, witness.sine(mine, shown))
    return worst


def check_rates(scene: Scene) -> None:
    """Angular velocities, and the velocity of every point on the links that carry it."""
    answer, speeds = solved(scene, rates=True), witness.speeds(transcribe.case(scene), digits=MANY)
    assert answer.rates is not None
    assert answer.velocities is not None
    rates = {link: speeds.rate(link) for link in answer.case.links}
    velocities = {key: speeds.velocity(*key) for key in answer.velocities}
    size = speeds.found.frame.size
    fastest = max(
        [
            *(abs(w) for w in rates.values() if w is not None),
            *(math.hypot(*v) / size for v in velocities.values() if v is not None),
        ]
    )
    for link, rate in rates.items():
        assert known(answer.rates[link]) == near(rate, fastest), link + told(scene)
    for key, v in velocities.items():
        assert known(answer.velocities[key]) == near(v, fastest * size), str(key) + told(scene)
    assert carried(scene) <= set(answer.velocities)


def near(value: Any, scale: float) -> Any:
    """Within the law of a value; of zero, within the law of the scene's scale; None is None."""
    return None if value is None else pytest.approx(value, rel=LAW, abs=LAW * scale)


def known(value: Any) -> Any:
    """A rate or velocity; None where it is undetermined."""
    return None if isinstance(value, str) else value


def carried(scene: Scene) -> set[tuple[str, str]]:
    """Points and the moving links that carry them by a pin, or as first of a slide or slot."""
    frame = str(scene.get("ground", 1))
    pairs = {
        (joint["at"], str(link))
        for joint in scene["joints"]
        if {"pin", "slide", "slot"} & set(joint)
        for link in (joint["pin"] if "pin" in joint else next(iter(joint.values()))[:1])
    }
    return {(at, link) for at, link in pairs if link != frame}
