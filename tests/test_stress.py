"""The stress catalogue: scenes that break solvers, each with the verdict that a correct one gives."""

from __future__ import annotations

import pytest

from icsolve.bench.catalogue import CATALOGUE
from icsolve.bench.stress import Stress, answered, judge, refused


@pytest.mark.parametrize("stress", CATALOGUE, ids=lambda stress: f"{stress.number} {stress.title}")
def test_the_verdict_is_the_one_asked(stress: Stress) -> None:
    judged = judge(stress)
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
