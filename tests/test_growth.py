"""What grows with a mechanism, counted in steps: a chain of four-bars in series, ever longer."""

from __future__ import annotations

import pytest

import icsolve
from icsolve.kinematics.centres import Kennedy


def four_bars(count: int) -> str:
    """Four-bars in series, each driving the next by a pin of its follower; link 1 is the frame."""
    points = {"A": (0, 0), "Q0": (0.3, 1.1)}
    pins, crank, last = ["{pin: [1, 2], at: A}"], 2, "Q0"
    for n in range(1, count + 1):
        coupler, follower = 2 * n + 1, 2 * n + 2
        wobble = 0.05 * (n % 3)
        points |= {f"G{n}": (3 * n, wobble), f"P{n}": (3 * n + 0.4, 1.2 + wobble)}
        points[f"Q{n}"] = (3 * n - 0.3, 1.1)
        pins += [f"{{pin: [{crank}, {coupler}], at: {last}}}", f"{{pin: [{coupler}, {follower}], at: P{n}}}"]
        pins.append(f"{{pin: [{follower}, 1], at: G{n}}}")
        crank, last = follower, f"Q{n}"
    figure = "\n".join(f"  {name}: [{x}, {y}]" for name, (x, y) in points.items())
    joints = "\n".join(f"  - {pin}" for pin in pins)
    middle = 2 * (count // 2) + 2
    return (
        f"icsolve: 1\npoints:\n{figure}\njoints:\n{joints}\nloads:\n  T: {{torque: unknown, link: 2}}\n"
        f"  M: {{torque: 1, link: {middle}}}\n  N: {{torque: 1, link: {crank}}}\n"
    )


@pytest.mark.parametrize("count", [10, 20, 40, 80])
def test_three_centres_of_a_chain_settle_a_number_of_centres_that_grows_as_the_chain(
    count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    settled = 0
    spread = Kennedy._spread

    def counted(self: Kennedy, pair: tuple[int, int]) -> None:
        nonlocal settled
        settled += 1
        spread(self, pair)

    monkeypatch.setattr(Kennedy, "_spread", counted)
    answer = icsolve.solve(icsolve.load(four_bars(count)))
    assert len(answer.centres) == 6
    assert settled <= 14 * count


def test_a_centre_far_along_a_chain_is_found_by_lines() -> None:
    answer = icsolve.solve(icsolve.load(four_bars(3)))
    assert answer.centres["2", "8"].by == "construction"
