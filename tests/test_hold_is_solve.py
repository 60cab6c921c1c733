"""`sweep --find hold`: where a mechanism begins or ceases to hold still is where `solve` says so."""

from __future__ import annotations

import pytest

import icsolve
from icsolve.sweep.numbers import with_numbers

LEVER = """icsolve: 1
points: {A: [0, 0], B: [2, 0], C: [-1, 0]}
joints: [{pin: [1, 2], at: A}]
loads: {P: {force: 1, link: 2, at: B, angle: 90}, Q: {force: unknown, link: 2, at: C, angle: 90}}
"""


@pytest.mark.parametrize("load", [1e-290, 1e-305])
def test_loads_as_small_as_doubles_go_balance(load: float) -> None:
    """Twice the arm takes half the load, exactly."""
    case = with_numbers(icsolve.load(LEVER), {"loads.P": load})
    assert icsolve.solve(case).answers["Q"].value == 2.0 * load


@pytest.mark.parametrize("load", [3e-308, 2.0**-1030, 5e-324])
def test_loads_that_have_lost_their_digits_are_refused(load: float) -> None:
    """A search that closes in on zero meets them: a refusal, not an overflow."""
    with pytest.raises(icsolve.SceneError, match="close"):
        icsolve.solve(with_numbers(icsolve.load(LEVER), {"loads.P": load}))
