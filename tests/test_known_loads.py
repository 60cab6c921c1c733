"""Loads that are all known: whether friction holds them, and whether contacts and ropes carry them, is told
as of the same scene with one load unknown.

Values are a thousandth of the range (of the load) away from its ends, so that no rounding decides.
"""

from __future__ import annotations

import math
import re
from random import Random

import mpmath
import pytest

import icsolve
import rubbing
import transcribe
from growth import random_mechanism
from icsolve.solve.stability import holding_values
from sizes import FULL, crossed, sampled

LADDER = """icsolve: 1
points: {A: [0, 0], G: {centroid: [A, B]}}
lengths: {AB: 5}
angles: {AB: 60}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.3}
  - {contact: [1, 2], at: B, normal: 180, mu: 0.2}
loads:
  W: {weight: 200, link: 2, at: G}
  U: {force: unknown, link: 2, at: A, angle: 0}
"""
SCREW = """icsolve: 1
units: {length: mm, force: kN, torque: N*m}
points: {A: [0, 0]}
joints:
  - {screw: [1, 2], at: A, along: 90, lead: 8 mm, radius: 18 mm, mu: 0.15}
loads:
  U: {torque: unknown, screw: 1-2}
  W: {weight: 25 kN, link: 2, at: A}
"""
CRATE = """icsolve: 1
points: {A: [0, 0], B: [0.6, 0], G: [0.3, 0.6], H: [0, 1.1]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.4}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.4}
loads:
  W: {weight: 500, link: 2, at: G}
  U: {force: unknown, link: 2, at: H, angle: 0}
"""
SLOPE = """icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 35, mu: 0.4}
loads:
  U: {force: unknown, link: 2, at: A, angle: 0}
  W: {weight: 100, link: 2, at: A}
"""
PRESSED = """icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 90, mu: 0.4}
loads:
  W: {weight: 100, link: 2, at: A}
  U: {force: unknown, link: 2, at: A, angle: 0}
"""
BY_NAME = {"ladder": LADDER, "crate": CRATE, "slope": SLOPE, "screw": SCREW, "pressed": PRESSED}


def known(text: str, value: float) -> icsolve.Case:
    """The case with a number in place of its unknown."""
    return icsolve.load(text.replace("unknown", repr(value)))


def holds_as_its_range_says(text: str) -> int:
    """How many values inside and outside of the range of the unknown load were compared; in between, up to
    where friction may hold as it was left, it is open."""
    solved = icsolve.solve(icsolve.load(text))
    found = solved.answers["U"]
    assert found.holds is not None and solved.friction is not None and solved.friction.possible is not None
    low, high = found.holds
    least, most = solved.friction.possible
    finite = [end for end in (low, high, least, most) if math.isfinite(end)]
    size = max([1.0, *(abs(end) for end in finite)])
    inside = (max(low, -2.0 * size), min(high, 2.0 * size))
    room = 1e-3 * (inside[1] - inside[0])
    if not finite or room <= 1e-12 * size:
        return 0
    checks: list[tuple[float, bool | None]] = [(end, True) for end in (inside[0] + room, inside[1] - room)]
    checks += [(sum(inside) / 2, True)]
    for end, last, side in ((low, least, -1.0), (high, most, 1.0)):
        if abs(last - end) > 4.0 * room and math.isfinite(end):
            checks += [(end + side * room, None)]
        if math.isfinite(last):
            checks += [(last + side * room, False), (last + side * size, False)]
    for value, holds in checks:
        if any(one[0] <= value <= one[1] for one in solved.friction.again):
            continue
        answer = icsolve.solve(known(text, value))
        assert answer.holds_still is holds, f"{value}\n{text}"
        assert answer.to_dict().get("holds_still") is holds
        said = " ".join(answer.notes)
        assert ("friction is enough:" in said) is (holds is True), said
        assert ("friction is not enough:" in said) is (holds is False), said
        assert ("left the other way round" in said) is (holds is None), said
        assert "do not balance" not in said
    return len(checks)


@sampled(2)
@pytest.mark.parametrize("name", BY_NAME)
def test_known_loads_hold_where_the_range_of_one_of_them_says(name: str) -> None:
    """The ladder, the crate, the slope and the jack of the textbooks; a block pressed to a wall, whose load
    does no work."""
    assert holds_as_its_range_says(BY_NAME[name]) >= 4


def test_known_loads_of_random_mechanisms_hold_where_the_range_of_one_of_them_says() -> None:
    compared = 0
    for seed in range(4700, 4700 + (240 if FULL else 2)):
        rng = Random(seed)
        text = transcribe.text(rubbing.roughened(rng, random_mechanism(rng), 3))
        if "U: {spring" in text or "U: {weight" in text or "U: {mass" in text:  # not negative
            continue
        try:
            answer = icsolve.solve(icsolve.load(text))
        except icsolve.SceneError:  # the joints leave a rubbing force open
            continue
        if answer.answers["U"].holds and not any("contact would have to pull" in n for n in answer.notes):
            compared += holds_as_its_range_says(text)
    assert compared >= (400 if FULL else 8)


def test_in_a_given_motion_known_loads_are_told_what_keeps_it_up() -> None:
    """A block of 100 pulled up a slope of 35 degrees with mu 0.4 needs tan(35 + atan 0.4) horizontally."""
    up = SLOPE + "motion: {point: A, link: 2, speed: 1, angle: 35}\n"
    value = icsolve.solve(icsolve.load(up)).answers["U"].value
    assert value == pytest.approx(100 * math.tan(math.radians(35) + math.atan(0.4)), rel=1e-12)
    for more in (-10.0, 10.0):
        answer = icsolve.solve(known(up, value + more))
        assert answer.holds_still is None
        assert any(
            f"this motion takes U = {value:.6g} N, and not {value + more:.6g}" in n for n in answer.notes
        )
        assert not any("do not balance" in note for note in answer.notes)


LEVER = """icsolve: 1
points: {{O: [0, 0], A: [2, 0], H: [1, 0]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{contact: [3, 2], at: A, normal: 90}}
  - {{slide: [1, 3], at: A, along: 90}}
loads:
  W: {{force: {}, link: 2, at: H, angle: 90}}
  U: {{force: {}, link: 3, at: A, angle: 90}}
"""


@pytest.mark.parametrize("pushes", [True, False])
@pytest.mark.parametrize("push", ["-50", "unknown"])
def test_a_contact_that_would_have_to_pull_is_told_whatever_is_asked(push: str, pushes: bool) -> None:
    """A lever on a rod that only touches it: held down by 100 at half its length it rests on 50."""
    held = "-100" if pushes else "100"
    given = push if push == "unknown" else ("50" if pushes else "-50")
    case = icsolve.load(LEVER.format(held, given))
    for reactions in (False, True):
        said = [note for note in icsolve.solve(case, reactions=reactions).notes if "is lost" in note]
        assert bool(said) is not pushes
        assert len(said) <= 1


def test_a_contact_is_looked_at_only_where_the_rest_of_the_scene_can_be_built() -> None:
    """A rod that the answer does not need, and that does not reach, is no reason to refuse the lever; and
    no reason not to look whether its contacts push."""
    far = LEVER.format("-100", "unknown").replace("H: [1, 0]", "H: [1, 0], Q: [9, 9], S: {on: [Q, 20]}")
    far = far.replace(
        "loads:", "  - {pin: [2, 7], at: H}\n  - {pin: [7, 8], at: R}\n  - {pin: [8, 1], at: Q}\nloads:"
    )
    far = far.replace(", S: {on: [Q, 20]}", "").replace("loads:", "lengths: {HR: 1, RQ: 1}\nloads:")
    answer = icsolve.solve(icsolve.load(far))
    assert answer.answers["U"].value == pytest.approx(50.0, rel=1e-15)
    assert any(note.startswith("left out: links 7 and 8, as nothing needs them") for note in answer.notes)
    pulled = icsolve.solve(icsolve.load(far.replace("-100", "100")))
    assert any("is lost" in note for note in pulled.notes)


@sampled(2)
@pytest.mark.parametrize(
    ("slope", "more"),
    crossed([7, 20, 30, 41, 63.5], ["", "  P: {force: 0, link: 2, at: C, angle: 12}\n"]),
)
def test_a_weight_alone_begins_to_hold_where_its_friction_does_within_the_error(
    slope: float, more: str
) -> None:
    """mu = tan of the slope, in forty digits; a weight alone holds there at any size, or at none."""
    text = f"""icsolve: 1
points: {{C: [0, 0], G: [0, 0.3]}}
joints:
  - {{slide: [2, 1], at: C, along: {slope}, mu: 0.2}}
loads:
  W: {{weight: 100, link: 2, at: G}}
{more}"""
    (found,) = holding_values(icsolve.load(text), "joints.C.mu", 0.0, 3.0)
    with mpmath.workdps(40):
        exact = mpmath.tan(mpmath.radians(mpmath.mpf(str(slope))))
        assert abs(mpmath.mpf(found.value) - exact) <= found.error <= 1e-13
    assert (found.before, found.after) == ("slips", "holds")


BEAM = """\
icsolve: 1
points: {A: [0, 0], B: [4, 0], G: [1, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [2, 1], at: B, along: %s}
loads:
  W: {weight: 100, link: 2, at: G}
"""


def test_a_roller_whose_line_was_given_square_to_it_is_told_with_the_line_that_holds() -> None:
    """The reaction of a roller is square to the line on which it rolls: what is told to write makes the beam
    stand, and no other note stays."""
    answer = icsolve.solve(icsolve.load(BEAM % 90))
    (told,) = [note for note in answer.notes if "roller" in note]
    along = re.search(r"`along: (\d+)`", told)
    assert along is not None
    held = icsolve.solve(icsolve.load(BEAM % along[1]), reactions=True)
    assert not any("roller" in note for note in held.notes)
    assert held.reactions is not None
    assert held.reactions["F1-2@B"].y == pytest.approx(25.0)
