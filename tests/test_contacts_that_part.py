"""A body that lies on two contacts: the loads that hold it lie between corners of linear inequalities.

Each contact pushes with a force N that is not less than zero and rubs with at most mu N, so the four numbers
and the load P, which balance a weight, make a polygon. Here its corners are worked out one by one, in fifty
digits, from the moments and forces on the body alone.
"""

from __future__ import annotations

import math
from itertools import combinations
from random import Random

import pytest
from mpmath import cos, matrix, mp, mpf, pi, sin

import icsolve
import standing
from icsolve.explain import explain
from icsolve.solve.stability import holding_values, is_still
from icsolve.sweep.varied_numbers import with_numbers
from sizes import FULL, few
from test_standing import NEAR

DIGITS = 50


def resting(dice: Random) -> str:
    """A body on two contacts that face upwards, more or less, pushed at a third point."""
    at = {name: (round(dice.uniform(*x), 2), round(dice.uniform(*y), 2)) for name, x, y in PLACES}
    points = ", ".join(f"{name}: [{x}, {y}]" for name, (x, y) in at.items())
    tilts = [dice.choice([90, round(dice.uniform(50, 130), 1)]) for _ in range(2)]
    rough = [round(dice.uniform(0.05, 0.9), 2) for _ in range(2)]
    contacts = [
        f"  - {{contact: [1, 2], at: {name}, normal: {tilt}, mu: {mu}}}\n"
        for name, tilt, mu in zip("AB", tilts, rough, strict=True)
    ]
    toward = dice.choice([0, round(dice.uniform(-80, 80), 1), round(dice.uniform(100, 260), 1)])
    return (
        f"icsolve: 1\npoints: {{{points}}}\njoints:\n{''.join(contacts)}loads:\n"
        f"  W: {{weight: {dice.randint(50, 400)}, link: 2, at: G}}\n"
        f"  P: {{force: unknown, link: 2, at: H, angle: {toward}}}\n"
    )


PLACES = (
    ("A", (0, 0), (0, 0)),
    ("B", (0.6, 2), (-0.3, 0.3)),
    ("G", (0.2, 1.5), (0.2, 1)),
    ("H", (-0.5, 2.5), (0.3, 3)),
)
TINY = mpf(10) ** -40
"""Of numbers about 1 in fifty digits this is rounding."""


def corners(text: str) -> list[mpf]:
    """The loads P at which one and another of the four inequalities |f| <= mu N are equations, and the others
    hold: the set of loads that hold is the stretch between the least and the most of them."""
    case = icsolve.load(text)
    with mp.workdps(DIGITS):
        at = {name: [mpf(repr(x.value)) for x in case.points[name]] for name in "ABGH"}
        weight = mpf(repr(case.loads[0].value.value))
        toward = mpf(repr(case.loads[1].heading.value)) * pi / 180

        def wrench(name: str, x: mpf, y: mpf) -> list[mpf]:
            px, py = at[name]
            return [x, y, px * y - py * x]

        columns, ahead = [], []
        for n, joint in enumerate(case.joints):
            turn, mu = mpf(repr(joint.normal.value)) * pi / 180, mpf(repr(joint.friction.mu.value))
            columns += [
                wrench("AB"[n], cos(turn), sin(turn)),
                wrench("AB"[n], -sin(turn), cos(turn)),
            ]
            ahead += [(2 * n, mu, side) for side in (1, -1)]
        columns.append(wrench("H", cos(toward), sin(toward)))
        right = [-a for a in wrench("G", mpf(0), -weight)]

        found = []
        for two in combinations(ahead, 2):
            rows = [[column[k] for column in columns] for k in range(3)]
            rows += [[mpf(0)] * 5 for _ in two]
            for row, (n, mu, side) in zip(rows[3:], two, strict=True):
                row[n], row[n + 1] = mu, mpf(side)
            try:
                x = mp.lu_solve(matrix(rows), matrix([*right, 0, 0]))
            except ZeroDivisionError:
                continue
            least = -TINY * max(abs(a) for a in x)
            if all(mu * x[n] + side * x[n + 1] >= least for n, mu, side in ahead):
                found.append(x[4])
    return found


def held(text: str) -> tuple[float, float] | None:
    """What `solve` says; None where it says that no value holds."""
    try:
        return icsolve.solve(icsolve.load(text)).answers["P"].holds
    except icsolve.SceneError as refusal:
        if refusal.status != "no-value":
            raise
        return None


def parts(text: str) -> bool:
    return any("would have to pull" in note for note in icsolve.solve(icsolve.load(text)).notes)


@pytest.mark.parametrize("part", range(40 if FULL else 1))
def test_the_ends_of_the_range_are_corners_to_the_last_digit(part: int) -> None:
    """Finite ends within one unit in the last place, also where a contact parts there; the error told covers
    what is left, and is at most two such units."""
    dice, parted = Random(f"corners {part}"), 0
    for _ in range(few(25)):
        text = resting(dice)
        true, found = corners(text), held(text)
        if found is None:
            assert not true or max(true) - min(true) < 1e-9, text
            continue
        error, parted = icsolve.solve(icsolve.load(text)).answers["P"].error, parted + parts(text)
        for end, of in zip(found, (min, max), strict=True):
            if math.isfinite(end):
                off = abs(mpf(end) - of(true))
                off = off if off > TINY else mpf(0)
                assert error is not None and off <= math.ulp(end), (text, end, of(true))
                assert off <= error <= 2.0 * max(map(math.ulp, filter(math.isfinite, found))), text
    assert parted > few(3)


@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_where_it_begins_to_hold_lies_within_the_error_told(part: int) -> None:
    """Of the weight under a given push, whether the body slides there or a contact parts: the push at the
    corner goes with the weight, so the true weight is known in all digits."""
    dice, seen = Random(f"begins {part}"), 0
    for _ in range(few(12)):
        text = resting(dice)
        found = held(text)
        ends = [end for end in found or () if math.isfinite(end) and abs(end) > 1.0]
        if not ends:
            continue
        push, true = round(dice.choice(ends) * dice.uniform(0.5, 1.5), 3), corners(text)
        case = icsolve.load(text.replace("force: unknown", f"force: {push}"))
        weight = mpf(repr(case.loads[0].value.value))
        with mp.workdps(DIGITS):
            wanted = [mpf(repr(push)) / p * weight for p in (min(true), max(true)) if p * push > 0]
        low, high = 0.2 * float(weight), 3.0 * float(weight)
        for one in holding_values(case, "loads.W", low, high):
            seen += 1
            assert min(abs(mpf(one.value) - w) for w in wanted) <= one.error, (text, push, one)
            assert one.error <= 1e-12 * one.value
    assert seen > few(5)


def test_a_load_that_parts_a_contact_is_the_same_however_it_is_scaled() -> None:
    """A crate tips at W b / 2h, whatever its weight, to the last digit."""
    case = icsolve.load("""icsolve: 1
points: {A: [0, 0], B: [1.1, 0], G: [0.5, 0.8], H: [0, 1.3]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.9}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.9}
loads: {W: {weight: 300, link: 2, at: G}, P: {force: unknown, link: 2, at: H, angle: 0}}
""")
    for weight in (1.0, 300.0, 0.7, 1e9):
        found = icsolve.solve(with_numbers(case, {"loads.W": weight})).answers["P"]
        assert found.holds is not None
        low, high = (mpf(repr(weight)) * mpf(arm) / mpf("1.3") for arm in ("-0.5", "0.6"))
        assert abs(found.holds[0] - low) <= math.ulp(found.holds[0])
        assert abs(found.holds[1] - high) <= math.ulp(found.holds[1])


@pytest.mark.parametrize("part", range(10 if FULL else 1))
def test_a_structure_that_lifts_off_holds_where_friction_keeps_the_rest(part: int) -> None:
    """Where no contact would have to pull without friction, statics alone says what each carries. Else it
    holds where friction within its limits balances the loads, and carries what equilibrium says then (to
    1e-9); or it parts. So it does for `--find hold`."""
    dice, seen = Random(f"cornered {part}"), set()
    for _ in range(few(36)):
        text = standing.cornered(dice)
        case = icsolve.load(text)
        smooth, more, less = (standing.off(case, grown) <= 1e-9 for grown in (0.0, 1.0 + NEAR, 1.0 - NEAR))
        if more != less:
            continue
        answer = icsolve.solve(case)
        told = None if smooth else more
        assert answer.holds_still is told, text
        assert any("The links part there" in note for note in answer.notes) is (told is False), text
        assert is_still(case, "loads.L0", case.loads[0].value.value) is more
        seen.add(told)
        if not told:
            continue
        assert answer.reactions is not None
        forces = standing.carried(case)
        largest = max([abs(f) for both in forces for f in both if f is not None], default=1.0)
        for reaction, joint, both in zip(answer.reactions.values(), case.joints, forces, strict=True):
            sign = 1.0 if joint.links[0] == reaction.by else -1.0
            for own, other in zip((reaction.x, reaction.y), both, strict=True):
                right = None if other is None else pytest.approx(sign * other, abs=1e-9 * largest)
                assert own == right, text
    assert seen == {None, True, False}


ROPED = """icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [1, 0.5], D: [3, 0.5], G: [0.5, 0.4]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.3}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.3}
  - {rope: [C, D], on: [2, 1]}
loads:
  W: {weight: 100, link: 2, at: G}
  P: {force: 10, link: 2, at: C, angle: 0}
"""


@pytest.mark.parametrize(
    ("pull", "holds"), [(-500, None), (-1, None), (10, True), (29.9, True), (30.1, False)]
)
def test_a_crate_whose_rope_goes_slack_stands_by_its_friction(pull: float, holds: bool | None) -> None:
    """Up to 0.3 of its weight."""
    text = ROPED.replace("force: 10", f"force: {pull}")
    if holds is False:
        with pytest.raises(icsolve.SceneError, match="goes slack") as refusal:
            icsolve.solve(icsolve.load(text))
        assert refusal.value.status == "slack"
    else:
        assert icsolve.solve(icsolve.load(text)).holds_still is holds


@pytest.mark.parametrize("unknown", ["P", "W"])
def test_no_value_is_promised_to_a_structure_that_can_part(unknown: str) -> None:
    """Contacts only push: not any value of an unknown load is carried."""
    text = ROPED.replace(
        *(("force: 10", "force: unknown") if unknown == "P" else ("weight: 100", "weight: unknown"))
    )
    with pytest.raises(icsolve.SceneError, match=r"contacts only push .* `--find hold` along it"):
        icsolve.solve(icsolve.load(text), reactions=True)


TWICE = """icsolve: 1
points: {A: [0, 3], B: [0, 1], C: [1, 3], D: [1, 1], E: [2, 3], F: [2, 1], G: [1, 0.5]}
joints:
  - {slide: [2, 1], at: B, along: 90}
  - {rope: [A, B], on: [1, 2]}
  - {rope: [C, D], on: [1, 2]}
  - {rope: [E, F], on: [1, 2]}
loads:
  W: {weight: 90, link: 2, at: G}
"""


@pytest.mark.parametrize("text", [ROPED, TWICE], ids=["by friction", "by redundant ropes"])
def test_no_equation_is_promised_for_a_tension_that_equilibrium_leaves_open(text: str) -> None:
    answer = icsolve.solve(icsolve.load(text), reactions=True)
    assert answer.tensions
    assert all(pull.tension is None for pull in answer.tensions)
    told = explain(answer.case)
    assert "does not determine the tension of" in told
    assert "give the tension of" not in told
