"""Data of the figure that are to find: `unknown` in place of an angle, a length or a coordinate."""

from __future__ import annotations

import math

import pytest

import icsolve
from icsolve.errors import CaseError
from icsolve.report.check import compare

ARM = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 2, AG: 1}
angles: {AB: ANGLE, BAG: 0}
joints:
  - {pin: [1, 2], at: A}
loads:
  W: {weight: 30, link: 2, at: G}
  P: {force: 20, link: 2, at: B, angle: 90}
"""
SLIDER = """\
icsolve: 1
points: {A: [0, 0], C: [X, 0]}
lengths: {AB: 1, BC: LENGTH}
angles: {AB: 40}
near: {C: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 20, link: 4, at: C, angle: 180}
"""


def arm(angle: str) -> str:
    return ARM.replace("ANGLE", angle)


def slider(length: str = "3", x: str = "unknown") -> str:
    return SLIDER.replace("LENGTH", length).replace("X", x)


@pytest.mark.parametrize(
    ("written", "range_", "start", "stands_for"),
    [
        ("unknown", None, None, math.nan),
        ("{unknown: [0, 90]}", (0.0, 90.0), None, 45.0),
        ("{unknown: [0, 1 rad], from: 30}", (0.0, 57.29577951308232), 30.0, 30.0),
        ("{unknown: [-20, 340], from: 390}", (-20.0, 340.0), 390.0, 390.0),
    ],
)
def test_an_unknown_angle_has_its_range_and_where_the_figure_is_written(
    written: str, range_: tuple[float, float] | None, start: float | None, stands_for: float
) -> None:
    case = icsolve.load(arm(written))
    (unknown,) = case.unknowns
    assert unknown.path == "angles.AB"
    assert unknown.mark == (4, 14)
    ends = (unknown.low and unknown.low.value, unknown.high and unknown.high.value)
    assert ends == (range_ or (None, None))
    assert (unknown.start and unknown.start.value) == start
    datum = case.angles[0].value
    assert (datum.path, datum.digits) == ("angles.AB", "unknown")
    assert datum.value == stands_for or (math.isnan(stands_for) and math.isnan(datum.value))


def test_lengths_and_coordinates_may_be_to_find() -> None:
    case = icsolve.load(slider("{unknown: [0.2, 3.5]}"))
    assert [unknown.path for unknown in case.unknowns] == ["lengths.BC"]
    case = icsolve.load(slider(x="{unknown: [0, 2]}"))
    assert [unknown.path for unknown in case.unknowns] == ["points.C.x"]
    assert getattr(case.points["C"], "x", 0) is None
    assert icsolve.load(slider()).unknowns == ()  # the figure finds it, as it always did


def test_set_gives_the_unknown_a_number_and_the_case_is_an_ordinary_one() -> None:
    text = arm("{unknown: [0, 90]}").replace("P: {force: 20", "P: {force: unknown")
    case = icsolve.load(text, settings={"angles.AB": 30.0})
    assert case.unknowns == ()
    assert icsolve.solve(case).answers["P"].value == pytest.approx(15.0)


REFUSED = {
    "an unknown load beside it": (
        arm("unknown").replace("force: 20", "force: unknown"),
        "load P is to find too, and a position is asked only where every load is known",
    ),
    "one end": (arm("{unknown: 90}"), "a range of two numbers, {unknown: [0, 90]}"),
    "ends the wrong way round": (arm("{unknown: [90, 0]}"), "from the lower to the higher number"),
    "a negative length": (slider("{unknown: [-1, 1]}"), "a length should not be negative"),
    "more turns than are searched": (arm("{unknown: [-3600, 1e6]}"), "over 2,788 turns, and at most 20"),
    "from without unknown": (arm("{from: 30}"), "needs 'unknown': the range in which it is to find"),
    "another key": (arm("{unknown: [0, 90], to: 3}"), "has no key 'to'"),
    "a unit of another kind": (arm("{unknown: [0, 90 mm]}"), "'mm' is a length, but an angle is wanted"),
}


@pytest.mark.parametrize("slip", REFUSED)
def test_a_slip_of_an_unknown_datum_is_refused(slip: str) -> None:
    text, said = REFUSED[slip]
    with pytest.raises(CaseError) as refused:
        icsolve.load(text)
    assert len(refused.value.problems) == 1
    assert said in refused.value.problems[0].message


SLOPE = """\
icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 20, mu: 0.5}
loads:
  W: {weight: 100, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 20}
expect:
"""


def verdicts(text: str) -> list[str]:
    """What the comparison with the published values says, one word a value."""
    case = icsolve.load(text)
    return [row.verdict for row in compare(icsolve.solve(case))]


@pytest.mark.parametrize(
    ("range_", "verdict"),
    [
        ("[-12.8, 81.2]", "agrees"),
        ("[-13, 81]", "agrees"),
        ("[-12.8, 82]", "disagrees"),
        ("[null, 81.2]", "disagrees"),
        ("[-12.7, 81.3], within: 1%", "agrees"),
    ],
)
def test_a_published_range_in_which_friction_holds_is_compared_at_both_ends(
    range_: str, verdict: str
) -> None:
    """W (sin 20 -+ mu cos 20) on a slope of 20 degrees."""
    assert verdicts(f"{SLOPE}  P: {{holds: {range_}}}\n") == [verdict]


@pytest.mark.parametrize(
    ("published", "verdict"),
    [
        ("angles.AB: 90", "agrees"),
        ("angles.AB: 270.0", "agrees"),
        ("angles.AB: -90", "agrees"),
        ("angles.A-B: {value: 90, stability: unstable}", "agrees"),
        ("angles.AB: {value: 270, stability: unstable}", "disagrees"),
        ("angles.AB: 45", "disagrees"),
    ],
)
def test_a_published_position_agrees_with_any_of_its_kind(published: str, verdict: str) -> None:
    """A bar that its weight pulls down rests hanging, and upright."""
    text = arm("unknown").replace("  P: {force: 20, link: 2, at: B, angle: 90}\n", "")
    assert verdicts(f"{text}expect:\n  {published}\n") == [verdict]


PUBLISHED = {
    "a range of a centre": ("I12: {holds: [1, 2]}", "only a load holds over a range"),
    "one end": ("P: {holds: [1]}", "the two ends of the range, as in [113, 287]"),
    "the wrong way round": ("P: {holds: [2, 1]}", "from the lower to the higher end"),
    "no end at all": ("P: {holds: [null, null]}", "the two ends of the range"),
    "a stable load": ("P: {value: 3, stability: stable}", "not a position, which alone can be stable"),
    "an angle that is given": ("angles.AB: 3", "no datum of the figure that is to find"),
}


@pytest.mark.parametrize("slip", PUBLISHED)
def test_a_slip_of_a_published_value_is_told(slip: str) -> None:
    published, said = PUBLISHED[slip]
    with pytest.raises(CaseError) as refused:
        icsolve.load(f"{SLOPE}  {published}\n")
    assert said in str(refused.value)
