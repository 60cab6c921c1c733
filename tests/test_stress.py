"""The stress catalogue: scenes that break solvers, each with the verdict that a correct one gives."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from random import Random

import pytest

import icsolve
from icsolve.bench.catalogue import CATALOGUE
from icsolve.bench.families import chain
from icsolve.bench.stress import Stress, TrueValue, answered, judge, refused
from icsolve.case import Coordinates, Pin
from sizes import FULL

LOOPS = 1000
"""Of the chain of four-bars of the catalogue so many, in exact fractions."""


def shorter(stress: Stress) -> Stress:
    """The chain with fewer loops, and its closed form: along each rod its two pins go equally fast."""
    case = icsolve.load(chain(LOOPS)(Random(1)))
    at = {}
    for name, point in case.points.items():
        assert isinstance(point, Coordinates) and point.x is not None and point.y is not None
        at[name] = (Fraction(point.x.digits), Fraction(point.y.digits))
    pins = [at[joint.at] for joint in case.joints if isinstance(joint, Pin)]
    ratios = []
    for a, b, c, d in zip(pins[::3], pins[1::3], pins[2::3], pins[3::3], strict=False):
        rod = (c[0] - b[0], c[1] - b[1])
        first, second = (rod[1] * (q[0] - p[0]) - rod[0] * (q[1] - p[1]) for p, q in ((a, b), (d, c)))
        ratios.append(first / second)
    (known,) = (load.value.value for load in case.loads if load.name != "U")
    true = -Fraction(known) * prod(ratios)
    return stress._replace(
        title=f"chain of {LOOPS} four-bars",
        case=lambda: chain(LOOPS)(Random(1)),
        asked=answered({"U": TrueValue(float(true), 1e-15, 1e-11)}),
    )


@pytest.mark.parametrize("stress", CATALOGUE, ids=lambda stress: f"{stress.number} {stress.title}")
def test_the_verdict_is_the_one_asked(stress: Stress) -> None:
    judged = judge(shorter(stress) if stress.number == "34" and not FULL else stress)
    assert not judged.faults, judged.got


def test_every_number_of_the_catalogue_is_there() -> None:
    numbers = {int(stress.number.rstrip("abcdefgh")) for stress in CATALOGUE}
    assert set(range(1, 35)) <= numbers


def test_a_wrong_verdict_is_a_fault() -> None:
    """The judge itself: another value, a refusal that was not asked, words that are not there."""
    generic, dead = (next(s for s in CATALOGUE if s.number == number) for number in ("1", "5"))
    assert judge(generic._replace(asked=answered({"M1": -0.5385}))).faults
    assert judge(generic._replace(asked=refused("dead-centre"))).faults
    assert judge(generic._replace(asked=answered({"M1": -7 / 13}, says=("parallel",)))).faults
    assert judge(dead._replace(asked=answered({"M1": 0.0}))).faults
    assert judge(dead._replace(asked=refused("dead-centre", says=["C and D"]))).faults
