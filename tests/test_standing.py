"""Loads that are all known on mechanisms of several freedoms, and on redundant contacts: friction holds them
where some friction within its limits balances them, and contacts push."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import pytest

import icsolve
import rough_scenes as rs
import standing
from icsolve.solve.stability import holding_values, is_still
from icsolve.sweep.varied_numbers import find_number, with_numbers
from rough_scenes import Rough
from shell import Shell
from sizes import FULL, few, sampled

NEAR = 0.01
"""Scenes that hold with coefficients so much larger and not with such smaller ones are not compared."""


@sampled(3)
@pytest.mark.parametrize("kind", standing.KINDS)
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_known_loads_hold_where_the_joints_can_balance_them(kind: Callable[[Random], str], part: int) -> None:
    """Crates, bricks in a wall, blocks joined by bars, of one to five freedoms: none is left open, and all
    hold or slip as the cone of what their joints can do has their loads in it (to 1e-9 of them) or not."""
    dice, seen = Random(f"{kind.__name__} {part}"), set()
    for _ in range(few(12)):
        text = kind(dice)
        case = icsolve.load(text)
        more, less = standing.off(case, 1.0 + NEAR) <= 1e-9, standing.off(case, 1.0 - NEAR) <= 1e-9
        if more == less:
            told = more if "mu:" in text else None  # where nothing rubs power alone says it
            assert icsolve.solve(case).holds_still is told, text
            seen.add(more)
    assert seen == {True, False}


FREE = "However much friction there is, the loads move what rubs nowhere"
LETS_GO = "However much friction there is, a contact would have to pull"


@sampled(2)
@pytest.mark.parametrize("kind", [standing.crates, standing.bricks])
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_friction_is_not_blamed_for_what_tips_or_lifts_off(kind: Callable[[Random], str], part: int) -> None:
    """Where friction without limits does not hold the loads either, contacts would have to pull whatever
    rubs, or nothing that rubs is in the way, and that is said, of reactions too; where it does (to 1e-9 of
    the loads), it is not."""
    dice, seen = Random(f"lets go {kind.__name__} {part}"), set()
    for _ in range(few(24)):
        case = icsolve.load(kind(dice))
        answer = icsolve.solve(case)
        if "mu" not in str(case.joints) or answer.holds_still is not False:
            continue
        said = LETS_GO if standing.off(case, math.inf) > 1e-9 else ""
        said = FREE if standing.off_all(case) > 1e-9 else said
        with pytest.raises(icsolve.SceneError, match="friction is not enough") as refused:
            icsolve.solve(case, reactions=True)
        for text in (" ".join(answer.notes), str(refused.value)):
            assert [one for one in (LETS_GO, FREE) if one in text] == [said] * bool(said), case
        seen.add(said)
    assert {LETS_GO, ""} <= seen


PENDULUM = """
icsolve: 1
points: {A: [0, 0], B: [1, 0], G: [0.5, 0.5], O: [5, 0], E: [6, 0]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.5}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.5}
  - {pin: [1, 3], at: O PIN}
loads:
  W: {weight: 100, link: 2, at: G}
  P: {force: 20, link: 3, at: E, angle: -90}
"""


@pytest.mark.parametrize(("pin", "told"), [("", True), (", radius: 0.1, mu: 0.2", False)])
def test_contacts_are_not_blamed_for_what_rubs_nowhere(pin: str, told: bool) -> None:
    """Beside a crate that stands fast a lever hangs on a smooth pin, and on a rough one."""
    text = PENDULUM.replace(" PIN", pin)
    (note,) = icsolve.solve(icsolve.load(text)).notes
    assert LETS_GO not in note and (FREE in note) is told
    text = text.replace("loads:", "loads:\n  U: {force: unknown, link: 2, at: G, angle: 0}")
    with pytest.raises(icsolve.SceneError, match="no value of U holds") as refused:
        icsolve.solve(icsolve.load(text))
    assert LETS_GO not in str(refused.value) and (FREE in str(refused.value)) is told


@sampled(3)
@pytest.mark.parametrize("kind", standing.KINDS)
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_where_friction_holds_joints_carry_what_equilibrium_says(
    kind: Callable[[Random], str], part: int
) -> None:
    """Each force is that of the links' equilibrium with the friction as one more force of its joint (to 1e-9,
    in floats); what that leaves open is open, and where the loads slip there is none."""
    dice, told, open_ = Random(f"carried {kind.__name__} {part}"), 0, 0
    for _ in range(few(12)):
        text = kind(dice)
        case = icsolve.load(text)
        if not icsolve.solve(case).holds_still:
            with pytest.raises(icsolve.SceneError, match="friction is not enough"):
                icsolve.solve(case, reactions=True)
            continue
        answer, forces = icsolve.solve(case, reactions=True), standing.carried(case)
        assert answer.reactions is not None
        largest = max([abs(f) for both in forces for f in both if f is not None], default=1.0)
        for reaction, joint, (x, y) in zip(answer.reactions.values(), case.joints, forces, strict=True):
            sign = 1.0 if joint.links[0] == reaction.by else -1.0
            for own, other in ((reaction.x, x), (reaction.y, y)):
                told, open_ = told + (other is not None), open_ + (other is None)
                if other is None:
                    assert own is None, text
                else:
                    assert own == pytest.approx(sign * other, abs=1e-9 * largest), text
    assert told and open_


@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_bars_hang_askew_as_far_as_their_pins_rub(part: int) -> None:
    """On a block that rubs too: of two to four freedoms, whether each joint rubs within its limit follows
    from what hangs on it. Scenes within a millionth of the limit are not compared."""
    dice, seen = Random(f"hung {part}"), list[bool]()
    for _ in range(15):
        text, spare = standing.hung(dice)
        if abs(spare) > 1e-6:
            assert icsolve.solve(icsolve.load(text)).holds_still is (spare > 0.0), (text, spare)
            seen.append(spare > 0.0)
    assert part or {True, False} == set(seen)


ALIKE = [
    [rs.block, rs.wedge, rs.capstan, rs.ladder, rs.crate, rs.table, rs.crank],
    *([rs.ratchet, rs.brake], [rs.screw], [rs.band]),
]
"""Kinds whose scenes are in the same units."""


@sampled(2)
@pytest.mark.parametrize("kinds", ALIKE, ids=lambda kinds: kinds[0].__name__)
@pytest.mark.parametrize("part", range(10 if FULL else 1))
def test_two_scenes_side_by_side_hold_where_both_do(
    kinds: list[Callable[[Random], Rough]], part: int
) -> None:
    """Blocks, ladders, ropes that slip, screws, brakes, cranks on rough pins: of two freedoms together, they
    hold if each does by the range of its load. Loads are in and beside these ranges."""
    dice = Random(f"two {kinds[0].__name__} {part}")
    for _ in range(few(10)):
        texts, each = [], []
        for rough in (dice.choice(kinds)(dice) for _ in range(2)):
            low, high = -100.0, 100.0
            with suppress(icsolve.SceneError):  # no value holds
                ends = icsolve.solve(rough.case("unknown")).answers["F"].holds or (0.0, 0.0)
                low, high = (
                    end if math.isfinite(end) else side * 100.0
                    for end, side in zip(ends, (-1, 1), strict=True)
                )
            load = f"{low + dice.choice((0.2, 0.5, 0.9, 1.3)) * (high - low):.4f}"
            each.append(icsolve.solve(rough.case(load)).holds_still)
            texts.append(rough.text.replace("LOAD", load))
        answer = icsolve.solve(icsolve.load(standing.side_by_side(texts)))
        assert None not in each
        assert answer.holds_still is all(each), texts


@sampled(2)
@pytest.mark.parametrize("kinds", ALIKE, ids=lambda kinds: kinds[0].__name__)
@pytest.mark.parametrize("part", range(10 if FULL else 1))
def test_beside_a_scene_that_holds_a_load_has_the_range_that_it_has_alone(
    kinds: list[Callable[[Random], Rough]], part: int
) -> None:
    """All that friction can hold, to 1e-9; none where the other scene slips."""
    dice, compared = Random(f"beside {kinds[0].__name__} {part}"), 0
    for _ in range(few(12)):
        one, other = (dice.choice(kinds)(dice) for _ in range(2))
        load = f"{dice.uniform(-100, 100):.4f}"
        held = icsolve.solve(other.case(load)).holds_still
        with refused() as alone:
            own = icsolve.solve(one.case("unknown")).friction
        texts = [one.text.replace("LOAD", "unknown"), other.text.replace("LOAD", load)]
        with refused() as both:
            found = icsolve.solve(icsolve.load(standing.side_by_side(texts))).friction
        if alone or held is False:
            assert both == ["no-value"], texts
        elif held:
            assert own is not None and found is not None and own.possible and found.possible
            ranges = [sorted((a.possible, *a.again)) for a in (own, found)]
            for low_high, beside in zip(*ranges, strict=True):
                assert beside == pytest.approx(low_high, rel=1e-9, abs=1e-9), texts
            compared += 1
    assert FULL or compared > 0


@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_a_five_bar_stands_where_its_rough_pins_can_hold_it(part: int) -> None:
    """What its joints carry hangs on the frictions themselves: two of the four are open, and the forces of
    the pins turn with them. Scenes within 2e-3 of the largest load are not compared, for the grid."""
    dice, seen = Random(f"five-bar {part}"), list[bool]()
    for _ in range(few(14)):
        text = standing.five_bar(dice)
        case = icsolve.load(text)
        spare = standing.most_spare(case)
        if abs(spare) > 2e-3:
            assert icsolve.solve(case).holds_still is (spare > 0.0), (text, spare)
            seen.append(spare > 0.0)
    assert len(seen) > few(10)


@pytest.mark.parametrize("kind", [standing.crates, standing.bricks])
@pytest.mark.parametrize("seed", range(12 if FULL else 1))
def test_where_a_load_on_several_freedoms_begins_or_ceases_to_hold(
    kind: Callable[[Random], str], seed: int
) -> None:
    """Of the last load's number: a thousandth of the span to both sides of each value that is found it holds
    on the one side and not on the other, as the cone of what the joints can do says; and in between nothing
    changes."""
    dice = Random(f"{kind.__name__} held {seed}")
    case = icsolve.load(kind(dice))
    path = find_number(case, f"loads.{case.loads[-1].name}").path

    def held(value: float) -> bool:
        return standing.off(with_numbers(case, {path: value})) <= 1e-9

    low, high = 0.0, 300.0
    found = holding_values(case, path, low, high)
    near = 1e-3 * (high - low)
    for one in found:
        assert held(one.value - near) is (one.before == "holds")
        assert held(one.value + near) is (one.after == "holds")
    ends = [low, *(one.value for one in found), high]
    middles = [0.5 * (a + b) for a, b in pairwise(ends)]
    told = [one.before == "holds" for one in found] + [one.after == "holds" for one in found[-1:]]
    assert [held(value) for value in middles] == (told or [held(0.5 * (low + high))])


PUSHED = {standing.crates: (2, "G0"), standing.bricks: (2, "G0"), standing.joined: (2, "A")}
PUSHED[standing.five_bar] = (3, "B")
FAR = [side * value for value in (0.0, 0.1, 3.0, 17.0, 70.0, 500.0) for side in (1.0, -1.0)]


@sampled(2)
@pytest.mark.parametrize("kind", PUSHED)
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_one_load_on_several_freedoms_has_a_range(kind: Callable[[Random], str], part: int) -> None:
    """A ten-thousandth of the size within and beyond each end, and far off where there is none, it holds or
    slips as the cone of what the joints can do says; of rough pins a grid finds in the middle that it holds,
    to 1e-5 of the largest load, and three hundredths beyond that it does not. Where no value holds, none of
    many does."""
    dice, compared = Random(f"{kind.__name__} one of several {part}"), 0
    pins = kind is standing.five_bar
    for _ in range(few(6 if pins else 12)):
        link, at = PUSHED[kind]
        text = f"{kind(dice)}  F: {{force: LOAD, link: {link}, at: {at}, angle: {dice.randint(0, 359)}}}\n"

        def held(value: float, text: str = text) -> bool:
            case = icsolve.load(text.replace("LOAD", repr(value)))
            return standing.most_spare(case) > -1e-5 if pins else standing.off(case) <= 1e-9

        with refused() as refusals:
            answer = icsolve.solve(icsolve.load(text.replace("LOAD", "unknown")))
        if refusals:
            assert refusals in (["no-value"], ["unsupported"]), text
            assert refusals == ["unsupported"] or not any(map(held, FAR)), text
            continue
        if answer.friction is None:  # nothing rubs
            continue
        assert answer.friction.possible is not None
        ranges = [answer.friction.possible, *answer.friction.again]
        size = max([100.0 if pins else 1.0, *(abs(e) for one in ranges for e in one if math.isfinite(e))])
        room = (0.03 if pins else 1e-4) * size
        for low, high in ranges if answer.mobility > 1 else ():
            inside = [0.5 * (low + high)] if pins else [low + room, high - room]
            inside = inside if math.inf > high - low > 4.0 * room else []
            for value, holds in [*((v, True) for v in inside), (low - room, False), (high + room, False)]:
                far = math.copysign(30.0 * size, value) if math.isinf(value) else value
                holds = holds or math.isinf(value) or any(a < value < b for a, b in ranges)  # noqa: PLW2901
                assert held(far) is holds, (text, value, ranges)
                compared += 1
    assert compared > 0


@sampled(2)
@pytest.mark.parametrize("kind", [standing.five_bar, standing.joined])
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_a_search_asks_of_one_value_what_a_whole_range_says(kind: Callable[[Random], str], part: int) -> None:
    """Of a coefficient of friction, with loads within and beyond what is held; open is not held."""
    dice = Random(f"{kind.__name__} asked {part}")
    for _ in range(few(8)):
        link, at = PUSHED[kind]
        push = f"force: {dice.choice((5, 30, 90))}, link: {link}, at: {at}, angle: {dice.randint(0, 359)}"
        case = icsolve.load(f"{kind(dice)}  F: {{{push}}}\n")
        path = find_number(case, "joints.A.mu").path
        for mu in (0.05, dice.uniform(0.1, 0.6), 0.95):
            holds = icsolve.solve(with_numbers(case, {path: mu})).holds_still is True
            assert is_still(case, path, mu) is holds, (case.loads, mu)


@sampled(3)
@pytest.mark.parametrize("kind", [standing.five_bar, standing.joined, standing.crates])
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_a_load_on_several_freedoms_ceases_to_hold_where_its_range_ends(
    kind: Callable[[Random], str], part: int
) -> None:
    """Along its own number, to 1e-9 of the larger end: it is asked as the unknown, however many freedoms."""
    dice = Random(f"{kind.__name__} ends {part}")
    for _ in range(few(5)):
        link, at = PUSHED[kind]
        push = f"  F: {{force: LOAD, link: {link}, at: {at}, angle: {dice.randint(0, 359)}}}\n"
        text = f"{kind(dice)}{push}"
        ends = list[float]()
        with refused():
            friction = icsolve.solve(icsolve.load(text.replace("LOAD", "unknown"))).friction
            if friction is not None and friction.possible is not None:
                ends = [end for one in (friction.possible, *friction.again) for end in one]
        case = icsolve.load(text.replace("LOAD", "1"))
        found = [one.value for one in holding_values(case, "loads.F", -500.0, 600.0)]
        within = sorted(end for end in ends if -500.0 < end < 600.0)
        assert icsolve.solve(case).mobility == 1 or found == pytest.approx(within, rel=1e-9), text


def test_a_second_range_of_a_load_is_found_however_narrow_it_is() -> None:
    """Along its own number it is known, and need not be met by the values that are tried."""
    text = """icsolve: 1
points: {A: [0, 0], B: [-0.27, 1.02], C: [1.97, 2.32], D: [3.92, 0.95], E: [3.5, 0.02]}
joints:
  - {pin: [1, 2], at: A, mu: 0.13, radius: 3.88}
  - {pin: [2, 3], at: B, mu: 0.62, radius: 2.80}
  - {pin: [3, 4], at: C, mu: 0.74, radius: 0.07}
  - {pin: [4, 5], at: D, mu: 0.75, radius: 0.24}
  - {pin: [5, 1], at: E}
loads:
  L0: {force: [20.2, 28.9], link: 2, at: B}
  L1: {force: [-11.0, -24.2], link: 3, at: C}
  L2: {force: [0.2, 16.9], link: 4, at: C}
  L3: {force: [-20.6, -25.6], link: 5, at: D}
  F: {force: LOAD, link: 3, at: B, angle: 32}
"""
    friction = icsolve.solve(icsolve.load(text.replace("LOAD", "unknown"))).friction
    assert len(friction.again) == 1
    found = holding_values(icsolve.load(text.replace("LOAD", "30")), "loads.F", -500.0, 600.0)
    ends = [end for one in (friction.possible, *friction.again) for end in one]
    assert [one.value for one in found] == pytest.approx(ends, rel=1e-9)


@pytest.mark.parametrize("seed", range(40 if FULL else 2))
def test_what_nothing_presses_has_no_friction(seed: int) -> None:
    """Light wheels on a light arm, all pins rough, under torques alone: a tooth force would turn the outer
    wheel, farther out than its pin rubs, so nothing presses the pins, and no torque is held."""
    dice = Random(f"light {seed}")
    rough = (f"mu: {dice.uniform(0.1, 0.6):.2f}, radius: {dice.uniform(0.05, 0.3):.2f}" for _ in "OOQ")
    one, two, three = rough
    text = f"""icsolve: 1
points: {{O: [0, 0], Q: [{dice.uniform(-4, 4):.2f}, {dice.uniform(2, 4):.2f}]}}
joints:
  - {{pin: [1, 2], at: O, {one}}}
  - {{pin: [1, 4], at: O, {two}}}
  - {{pin: [4, 3], at: Q, {three}}}
  - {{gears: [2, 3], teeth: [{dice.randint(20, 40)}, {dice.randint(20, 40)}], pressure angle: 20, carrier: 4}}
loads:
  T: {{torque: {dice.choice((-1, 1)) * dice.uniform(1, 40):.2f}, link: 2, against: 4}}
  U: {{torque: {dice.uniform(-100, 100):.2f}, link: {dice.choice("24")}}}
"""
    assert icsolve.solve(icsolve.load(text)).holds_still is False


@contextmanager
def refused() -> Iterator[list[str]]:
    """The status of what is refused within."""
    found = list[str]()
    try:
        yield found
    except icsolve.SceneError as refusal:
        found.append(refusal.status)


@pytest.mark.parametrize("seed", range(60 if FULL else 3))
def test_several_unknown_loads_are_found_in_a_motion_and_one_by_one(seed: int) -> None:
    """A crate on a crate, both pushed: at rest one push hangs on the other, and the refusal names two ways
    on. In a motion of both the pushes follow from the weights, to 1e-12; a thousandth less holds, as one
    known and one unknown and as both known, and a thousandth more does not."""
    dice = Random(f"both {seed}")
    low, high, one, two = (dice.uniform(*ends) for ends in ((0.1, 0.5), (0.1, 0.5), (50, 200), (50, 200)))
    below, above = dice.choice((-1, 1)), dice.choice((-1, 1))
    upper = above * high * two
    lower = below * low * (one + two) - upper
    text = f"""icsolve: 1
points: {{A: [0, 0], B: [2, 0], C: [0.1, 0.1], D: [1.9, 0.1], G: [1, 0], H: [1, 0.1]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {low!r}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {low!r}}}
  - {{contact: [2, 3], at: C, normal: 90, mu: {high!r}}}
  - {{contact: [2, 3], at: D, normal: 90, mu: {high!r}}}
loads:
  V: {{weight: {one!r}, link: 2, at: G}}
  W: {{weight: {two!r}, link: 3, at: H}}
  P: {{force: LOWER, link: 2, at: G, angle: 0}}
  Q: {{force: UPPER, link: 3, at: H, angle: 0}}
"""
    motion = f"""motion:
  - {{point: A, link: 2, speed: 1, angle: {0 if below > 0 else 180}}}
  - {{point: C, link: 3, speed: {abs(below + 2 * above)}, angle: {0 if above > 0 else 180}}}
"""

    def case(lower: str, upper: str) -> icsolve.Case:
        return icsolve.load(text.replace("LOWER", lower).replace("UPPER", upper))

    both = case("unknown", "unknown")
    with pytest.raises(icsolve.SceneError, match=r"P and Q.*Give `motion`.*Or leave one load") as refusal:
        icsolve.solve(both)
    assert refusal.value.status == "mobility"
    moving = icsolve.load(text.replace("LOWER", "unknown").replace("UPPER", "unknown") + motion)
    found = {name: load.value for name, load in icsolve.solve(moving).answers.items()}
    assert found == pytest.approx({"P": lower, "Q": upper}, rel=1e-12)
    for grown, holds in ((0.999, True), (1.001, False)):
        given = repr(grown * lower), repr(grown * upper)
        assert icsolve.solve(case(*given)).holds_still is holds
        least, most = math.inf, -math.inf
        with refused() as refusals:
            least, most = icsolve.solve(case(given[0], "unknown")).answers["Q"].holds
        assert (least <= grown * upper <= most) is holds
        assert refusals in ([], ["no-value"])


STACK = """icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [0.1, 0.5], D: [0.9, 0.5], G: [0.5, 0.25], H: [0.5, 0.75], K: [0.2, 0.6]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.5}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.5}
  - {contact: [2, 3], at: C, normal: 90, mu: 0.25}
  - {contact: [2, 3], at: D, normal: 90, mu: 0.25}
loads:
  W: {weight: 100, link: 2, at: G}
  V: {weight: 80, link: 3, at: H}
  P: {force: PUSH, link: 3, at: K, angle: 0}
"""


@pytest.mark.parametrize(
    ("push", "holds"),
    [(20, True), (math.nextafter(20, 0), True), (math.nextafter(20, 40), False), (-20, True)],
)
def test_a_crate_on_a_crate_slides_at_the_last_digit(push: float, holds: bool) -> None:
    """A quarter of 80 holds, the next double does not."""
    answer = icsolve.solve(icsolve.load(STACK.replace("PUSH", repr(push))))
    assert answer.mobility == 2
    assert answer.to_dict()["holds_still"] is holds
    said = "friction is enough" if holds else "friction is not enough"
    assert any(said in note for note in answer.notes)


@pytest.mark.parametrize(("angle", "holds"), [(0, (-20.0, 20.0)), (270, (-80.0, math.inf))])
def test_a_push_on_two_crates_locks_them_and_a_weight_on_them_does_not(
    angle: int, holds: tuple[float, float]
) -> None:
    """No power drives them where a push does work, up to a quarter of 80: they lock themselves. What only
    presses the upper one does none, whatever it is, until it lifts it off."""
    text = STACK.replace("K: [0.2, 0.6]", "K: [0.5, 0.6]").replace("PUSH", "unknown")
    found = icsolve.solve(icsolve.load(text.replace("angle: 0", f"angle: {angle}"))).answers["P"]
    assert found.holds == pytest.approx(holds, rel=1e-15)
    assert found.self_locking is (angle == 0)


@pytest.mark.parametrize("seed", range(few(60, 6)))
def test_of_two_crates_that_are_pushed_one_or_both_slide_or_tip(seed: int) -> None:
    """The upper at its friction or about an edge of what it stands on, or both at that of the lower or about
    an edge of the floor, whichever comes first to each side; where it is an edge, a contact parts, and the
    load at which it does is told."""
    rng = Random(seed)
    wide, left, right = rng.uniform(1.0, 2.0), rng.uniform(0.0, 0.4), rng.uniform(0.6, 1.0)
    tall, above = rng.uniform(0.3, 2.0), rng.uniform(0.05, 2.0)
    mu, rough = rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.6)
    lower, upper = rng.uniform(20.0, 90.0), rng.uniform(20.0, 90.0)
    g, h = rng.uniform(0.2, 0.8), rng.uniform(0.45, 0.55)
    answer = icsolve.solve(
        icsolve.load(f"""icsolve: 1
points:
  {{A: [0, 0], B: [{wide}, 0], C: [{left}, {tall}], D: [{right}, {tall}],
   G: [{g}, 0.1], H: [{h}, {tall}], K: [{h}, {tall + above}]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {rough}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {rough}}}
  - {{contact: [2, 3], at: C, normal: 90, mu: {mu}}}
  - {{contact: [2, 3], at: D, normal: 90, mu: {mu}}}
loads:
  W: {{weight: {lower}, link: 2, at: G}}
  V: {{weight: {upper}, link: 3, at: H}}
  P: {{force: unknown, link: 3, at: K, angle: 0}}
""")
    )
    slides = min(mu * upper, rough * (lower + upper))
    to_right = upper * (right - h) / above, (lower * (wide - g) + upper * (wide - h)) / (tall + above)
    to_left = upper * (h - left) / above, (lower * g + upper * h) / (tall + above)
    ends = -min(slides, *to_left), min(slides, *to_right)
    assert answer.answers["P"].holds == pytest.approx(ends, rel=1e-9)
    assert answer.answers["P"].error <= 1e-12 * slides
    tips = [f"{end:.6g}" for end in ends if abs(end) < slides]
    told = [note for note in answer.notes if "would have to pull" in note]
    assert bool(told) is bool(tips)
    assert all(note.startswith(f"by P = {' and '.join(tips)} a contact") for note in told)


def test_the_push_that_a_stack_holds_is_found_to_the_last_digit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "stack.yaml"
    case.write_text(STACK.replace("PUSH", "5"))
    (found,) = Shell(capsys)("sweep", case, "--vary", "loads.P=0:60:5", "--find", "hold", "--json").objects()
    (one,) = found["found"]
    assert (one["from"], one["to"]) == ("holds", "slips")
    assert abs(one["at"]["loads.P"] - 20.0) <= one["error"]["loads.P"] <= 1e-14


BETWEEN = """icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [0.5, -0.5]}
joints:
  - {contact: [1, 2], at: A, normal: 0, mu: 0.3}
  - {contact: [1, 2], at: B, normal: 180, mu: 0.3}
FLOOR
loads:
  W: {weight: 10, link: 2, at: [0.5, 0]}
"""


def test_a_block_between_two_walls_holds_as_hard_as_its_fit_presses_it() -> None:
    """Nothing else does: whether it holds is open, and the reason is told. On a floor it holds without."""
    answer = icsolve.solve(icsolve.load(BETWEEN.replace("FLOOR\n", "")))
    assert answer.holds_still is None
    (said,) = [note for note in answer.notes if "open" in note and "friction" in note]
    assert "redundant and share the load by their fit" in said
    floor = "  - {contact: [1, 2], at: C, normal: 90}"
    assert icsolve.solve(icsolve.load(BETWEEN.replace("FLOOR", floor))).holds_still is True


LEGS = """icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [2, 0], G: [REACH, 0.5], K: [0, 0.3]}
joints:
  - {contact: [1, 2], at: A, normal: 90MU}
  - {contact: [1, 2], at: B, normal: 90MU}
  - {contact: [1, 2], at: C, normal: 90MU}
loads:
  W: {weight: 100, link: 2, at: G}
  P: {force: 10, link: 2, at: K, angle: 0}
"""


@pytest.mark.parametrize(("reach", "holds"), [(0.3, True), (1.9, True), (2.2, False), (-0.2, False)])
def test_a_crate_on_three_legs_tips_where_its_weight_is_beyond_them(reach: float, holds: bool) -> None:
    """How the legs share the load is open; that none pulls is not. The push moves the limits by 10 x 0.3 over
    100 only."""
    text = LEGS.replace("MU", ", mu: 0.4").replace("REACH", str(reach))
    answer = icsolve.solve(icsolve.load(text))
    assert answer.holds_still is holds
    assert any("share the load" in note for note in answer.notes) is holds


@pytest.mark.parametrize("seed", range(60 if FULL else 3))
def test_a_push_on_three_rough_legs_has_a_range(seed: int) -> None:
    """Each leg of its own coefficient: however they share the weight, all that some way holds, as the cone of
    what the legs can do says a thousandth of the range within each end and beyond it. A note says so."""
    dice = Random(f"three legs {seed}")
    text = LEGS.replace("10,", "PUSH,").replace("REACH", f"{dice.uniform(0.2, 1.8):.2f}")
    for _ in "ABC":
        text = text.replace("MU", f", mu: {dice.uniform(0.05, 0.9):.2f}", 1)
    answer = icsolve.solve(icsolve.load(text.replace("PUSH", "unknown")))
    low, high = answer.answers["P"].holds
    assert any("share the load" in note for note in answer.notes)
    room = 1e-3 * (high - low)
    for value, held in ((low + room, True), (high - room, True), (low - room, False), (high + room, False)):
        given = icsolve.load(text.replace("PUSH", repr(value)))
        assert (standing.off(given) <= 1e-9) is held
        assert icsolve.solve(given).holds_still is held


def table(dice: Random, joints: str, load: str) -> tuple[str, float, float]:
    """A table on three to five smooth legs, in any order, and from where to where they reach."""
    legs = [round(dice.uniform(-2.0, 2.0), 2) for _ in range(dice.randint(3, 5))]
    points = "".join(f", L{n}: [{x}, 0]" for n, x in enumerate(legs))
    contacts = "".join(f"  - {{contact: [1, 2], at: L{n}, normal: 90}}\n" for n in range(len(legs)))
    text = (
        f"icsolve: 1\npoints: {{G: [WEIGHT, 0.5], O: [0, 0], Q: [5, 0]{points}}}\n"
        f"joints:\n{contacts}{joints}loads:\n  W: {{weight: 100, link: 2, at: G}}\n{load}"
    )
    return text, min(legs), max(legs)


SLED = """  - {slot: [2, 3], at: O, along: 90}
  - {slide: [3, 1], at: Q, along: 0, mu: 0.2}
"""
PULL = """  V: {weight: 50, link: 3, at: Q}
  F: {force: PULLED, link: 3, at: Q, angle: 0}
"""


@sampled(2)
@pytest.mark.parametrize("seed", range(40 if FULL else 2))
def test_a_table_that_a_sled_holds_tips_at_no_value_of_the_pull(seed: int) -> None:
    """The sled rubs by its own weight: it holds 0.2 x 50 either way where the legs can carry the table, and
    no value holds where one would have to pull, however they share the load. The legs' ends are found to
    1e-12, as forces below 1e-13 of the largest count as none."""
    dice = Random(f"sled {seed}")
    text, low, high = table(dice, SLED, PULL)
    for at in (low - 0.05, low + 0.02, 0.5 * (low + high), high - 0.02, high + 0.05):
        case = icsolve.load(text.replace("WEIGHT", f"{at:.6f}").replace("PULLED", "unknown"))
        if low < at < high:
            assert icsolve.solve(case).answers["F"].holds == (-10.0, 10.0)
        else:
            with pytest.raises(icsolve.SceneError, match="no value of F holds: a contact is lost") as refusal:
                icsolve.solve(case)
            assert refusal.value.status == "no-value"
        for pull, holds in ((9.0, low < at < high), (11.0, False)):
            given = icsolve.load(text.replace("WEIGHT", f"{at:.6f}").replace("PULLED", str(pull)))
            assert icsolve.solve(given).holds_still is holds
    case = icsolve.load(text.replace("WEIGHT", "0").replace("PULLED", "3"))
    found = holding_values(case, "points.G.x", -3.0, 3.0)
    assert [one.value for one in found] == pytest.approx([low, high], abs=1e-12)


@sampled(2, "pinned")
@pytest.mark.parametrize("seed", range(40 if FULL else 2))
@pytest.mark.parametrize("pinned", [False, True], ids=["mechanism", "structure"])
def test_smooth_legs_hold_a_table_as_far_as_they_reach(pinned: bool, seed: int) -> None:
    """Also where nothing rubs, and where a pin beyond them on the left leaves nothing to move: then it lifts
    off its legs from the pin on. To 1e-12."""
    text, low, high = table(Random(f"legs {seed}"), "  - {pin: [1, 2], at: P}\n" if pinned else "", "")
    text = text.replace("points: {", "points: {P: [-2.5, 0], ")
    found = holding_values(icsolve.load(text.replace("WEIGHT", "0")), "points.G.x", -3.0, 3.0)
    assert [one.value for one in found] == pytest.approx([-2.5] if pinned else [low, high], abs=1e-12)
    assert [one.after for one in found] == ["holds", "slips"][: len(found)]


@pytest.mark.parametrize("count", [3, 6, 10, 14])
@pytest.mark.parametrize(("reach", "lost"), [(1.0, False), (0.5, False), (1.01, True), (-0.01, True)])
def test_of_however_many_legs_one_is_lost_where_the_weight_is_beyond_them(
    count: int, reach: float, lost: bool
) -> None:
    """Fourteen legs leave twelve forces open; at the last of them all is on that one."""
    points = "".join(f", L{n}: [{n / (count - 1)!r}, 0]" for n in range(count))
    legs = "".join(f"  - {{contact: [1, 2], at: L{n}, normal: 90}}\n" for n in range(count))
    case = icsolve.load(
        f"icsolve: 1\npoints: {{G: [{reach}, 1]{points}}}\njoints:\n{legs}"
        "loads: {W: {weight: 9, link: 2, at: G}}\n"
    )
    notes = icsolve.solve(case, reactions=True).notes
    assert any("the normal force of one would have to pull" in note for note in notes) is lost


@sampled(2)
@pytest.mark.parametrize("kind", [standing.rod, standing.barred])
@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_a_range_of_rubbing_guides_has_no_gap_in_it_and_is_told_whole(
    kind: Callable[[Random], str], part: int
) -> None:
    """Where much friction locks a load both ways it holds over several ranges, and guides press in either
    sense: all values of that which is told hold, up to 1e-6 of its ends, and 1e-6 beyond the last that may
    hold none does, but in another range that is told. The cone of what the joints can do says so, to 1e-9 of
    the loads within and to 1e-12 beyond: some of its sides are all but along the load."""
    dice = Random(f"{kind.__name__} range {part}")
    for _ in range(25):
        text = kind(dice)
        last = text.rindex("force: 1,")
        try:
            answer = icsolve.solve(icsolve.load(text[:last] + "force: unknown," + text[last + 9 :]))
        except icsolve.SceneError:  # it does no work, and nothing drives or holds
            continue
        (found,) = answer.answers.values()
        again = [end for one in answer.friction.again for end in one]
        ends = [*found.holds, *answer.friction.possible, *again]
        size = max([1.0, *(abs(end) for end in ends if math.isfinite(end))])
        marks = sorted({-100.0 * size, 100.0 * size, *(end for end in ends if math.isfinite(end))})
        inside = [0.5 * (a + b) for a, b in pairwise(marks) if b - a > 1e-5 * size]
        beside = [end + side * 1e-6 * size for end in marks for side in (-1.0, 1.0)]
        low, high = found.holds
        least, most = answer.friction.possible
        room = 1e-7 * size
        for value in (*inside, *beside):
            case = icsolve.load(text[:last] + f"force: {value!r}," + text[last + 9 :])
            if low + room < value < high - room or least + room < value < most - room:
                assert standing.off(case) <= 1e-9, (text, value, answer.answers)
            elif not least - room <= value <= most + room and standing.off(case) <= 1e-12:
                inside = [low - room <= value <= high + room for low, high in answer.friction.again]
                assert any(inside), (text, value, answer.answers)


@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_known_loads_in_another_range_hold_too(part: int) -> None:
    """A rod in two slots that much friction holds over several ranges of its one load that has a number: in
    the middle of each, and 1e-3 within and beyond their ends, what is given holds or slips as the cone of
    what the joints can do says. Beside their ends it may hang on how friction was left: as of a torque more,
    which none is then."""
    dice, again = Random(f"again {part}"), 0
    for _ in range(few(60)):
        text = re.sub("  L1: .*\n", "", standing.rod(dice))  # a torque
        last = text.rindex("force: 1,")

        def case(load: str, text: str = text, last: int = last) -> icsolve.Case:
            return icsolve.load(f"{text[:last]}force: {load},{text[last + 9 :]}")

        answer = icsolve.solve(case("unknown"))
        if not answer.friction.again:
            continue
        (found,) = answer.answers.values()
        ranges = (found.holds, *answer.friction.again)
        ends = sorted({end for one in ranges for end in one if math.isfinite(end)})
        size = max(map(abs, ends))
        least, most = answer.friction.possible
        values = [end + side * 1e-3 * size for end in (ends[0], *ends, ends[-1]) for side in (-1.0, 1.0)]
        for value in (*values, *(0.5 * (a + b) for a, b in pairwise(ends))):
            if found.holds[0] <= value <= found.holds[1] or not least <= value <= most:
                given = case(repr(value))
                told, holds = icsolve.solve(given).holds_still, standing.off(given) <= 1e-9
                assert told is holds or (told is None and holds), (text, value)
                with suppress(icsolve.SceneError):  # where a torque does no work
                    turned = case(repr(value), f"{text}  M: {{torque: unknown, link: 2}}\n")
                    assert told is held_by_none_more(turned, "M"), (text, value)
                again += told is True
    assert again > 0


def held_by_none_more(case: icsolve.Case, load: str) -> bool | None:
    """Whether it holds with an unknown load of 0, by the ranges that are told of that; None where it may."""
    answer = icsolve.solve(case)
    sure = answer.friction.again if answer.friction.grown is None else answer.friction.grown
    if any(low <= 0.0 <= high for low, high in (answer.answers[load].holds, *sure)):
        return True
    maybe = any(low <= 0.0 <= high for low, high in (answer.friction.possible, *answer.friction.again))
    return None if maybe else False


SLOTTED = """icsolve: 1
points: {{A: [0, 0], B: [{b}], G: [{g}]}}
joints:
  - {{slot: [2, 1], at: A, along: {along[0]}, mu: {mu[0]}}}
  - {{slot: [2, 1], at: B, along: {along[1]}, mu: {mu[1]}}}
loads:
  K: {{force: [{known}], link: 2, at: G}}{more}
  L: {{force: {load}, link: 2, at: {at}, angle: {angle}}}
"""


@pytest.mark.parametrize("turned", [0, 180])
@pytest.mark.parametrize(
    "rod",
    [
        {"b": "1.04, 1.35", "g": "1.32, 1.21", "along": (50, 115), "mu": (0.15, 0.55),
         "known": "-4.18, -6.19", "more": "", "at": "B", "angle": 205},
        {"b": "1.22, 0.62", "g": "0.28, 0.4", "along": (46, 124), "mu": (0.16, 0.52),
         "known": "-5.63, -14.66", "more": "\n  M: {torque: -1.02, link: 2}", "at": "B", "angle": 214},
        {"b": "1.05, 0.87", "g": "1.47, 0.85", "along": (51, 97), "mu": (0.75, 0.32),
         "known": "-3.96, -7.36", "more": "", "at": "G", "angle": 357},
        {"b": "1.78, 0.61", "g": "0.9, 0.82", "along": (41, 49), "mu": (0.3, 0.56),
         "known": "8.66, 19.18", "more": "", "at": "G", "angle": 165},
    ],
)  # fmt: skip
def test_a_load_on_a_rod_in_two_slots_holds_unknown_as_it_does_known(
    rod: dict[str, Any], turned: int
) -> None:
    """One that does no work holds what friction left the other way round holds too, and that is told; ranges
    that meet in a singular load are one. Between all ends and beside them: in the ranges it holds, up to
    where it may it is open, beyond it slips, as the cone of what the joints can do says."""
    rod = {**rod, "angle": rod["angle"] + turned}
    answer = icsolve.solve(icsolve.load(SLOTTED.format(load="unknown", **rod)))
    holds = (answer.answers["L"].holds, *answer.friction.grown)
    possible = (answer.friction.possible, *answer.friction.again)
    assert len(holds) == 2
    ends = sorted({end for one in (*holds, *possible) for end in one if math.isfinite(end)})
    size = max(map(abs, ends))
    beside = [end + side * 1e-5 * size for end in ends for side in (-1.0, 1.0)]
    for value in (-9.0 * size, *beside, *(0.5 * (a + b) for a, b in pairwise(ends)), 9.0 * size):
        case = icsolve.load(SLOTTED.format(load=repr(value), **rod))
        sure, maybe = (any(low <= value <= high for low, high in of) for of in (holds, possible))
        assert maybe is (standing.off(case) <= 1e-12), value
        assert icsolve.solve(case).holds_still is (sure or (None if maybe else False)), value


@sampled(2)
@pytest.mark.parametrize("angle", [90, -90])
def test_a_load_that_does_no_work_may_lift_what_it_presses(angle: int) -> None:
    """A crate of 100, drawn up or pressed down: it holds as long as it is not lifted, not at any value."""
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: [1, 0], G: [0.5, 0.4]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: 0.3}}
  - {{contact: [1, 2], at: B, normal: 90, mu: 0.5}}
loads:
  W: {{weight: 100, link: 2, at: G}}
  F: {{force: unknown, link: 2, at: G, angle: {angle}}}
""")
    found = icsolve.solve(case).answers["F"]
    assert found.holds == pytest.approx((-math.inf, 100.0) if angle > 0 else (-100.0, math.inf), rel=1e-15)
    assert not found.self_locking
