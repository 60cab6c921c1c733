"""Cases as people write them: awkward, but what they mean is plain."""

from __future__ import annotations

import pytest

import icsolve

FOUR_BAR = """
icsolve: 1
units: {length: in, force: lbf}
points: {A: [0, 0], B: [1, 2], C: [5, 3], D: [6, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: C, angle: 190}
  T12: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(("known", "status"), [("100", "no-value"), ("0", "any-value")])
def test_an_unknown_on_the_frame_balances_nothing(known: str, status: str) -> None:
    text = FOUR_BAR.replace("torque: unknown, link: 2", "torque: unknown, link: 1")
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(text.replace("force: 100", f"force: {known}")))
    assert refused.value.status == status and "never moves" in refused.value.message


def test_centres_of_one_freedom_stand_where_the_speed_is_zero() -> None:
    still = icsolve.solve(icsolve.load(FOUR_BAR + "motion: {link: 2, speed: 0}"), all_centres=True)
    moving = icsolve.solve(icsolve.load(FOUR_BAR), all_centres=True)
    assert still.to_dict()["centres"] == moving.to_dict()["centres"]
    assert still.answers == moving.answers
