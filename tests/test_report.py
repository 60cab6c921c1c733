"""`solve --report`: Grashof's law, transmission angles and limit positions.

Closed forms: a crank-rocker's transmission angle is least and greatest with the crank in line with the
base; a triple-rocker stops where coupler and output lie in line; an offset slider-crank turns back at
sqrt((l +- r)^2 - e^2). The ranges are also held against brute force: the loop assembled all round.
"""

from __future__ import annotations

import math
import re

import pytest

import icsolve
from icsolve.answer import Answer
from icsolve.case import Guide, Pin, Slide, Weld
from icsolve.report import answer_text
from icsolve.report.mechanism import (
    Crank,
    Report,
    Side,
    limits_in_slider_crank,
    limits_of,
    report,
    transmission_of,
)
from made import at, four_bar_answer, four_bar_case, number


def of_lengths(base: float, driver: float, coupler: float, output: float, angle: float = 60.0) -> Report:
    """The report of a four-bar A B C D whose base lies along +x."""
    b = (driver * math.cos(math.radians(angle)), driver * math.sin(math.radians(angle)))
    diagonal = math.dist(b, (base, 0.0))
    along = (coupler**2 - output**2 + diagonal**2) / (2.0 * diagonal)
    height = math.sqrt(coupler**2 - along**2)
    ux, uy = (base - b[0]) / diagonal, -b[1] / diagonal
    c = (b[0] + along * ux - height * uy, b[1] + along * uy + height * ux)
    return report(four_bar_answer(points={"A": (0.0, 0.0), "B": b, "C": c, "D": (base, 0.0)}))


@pytest.mark.parametrize(
    ("lengths", "kind"),
    [
        ((4.0, 1.0, 3.5, 2.5), "Grashof crank-rocker: link 2 turns fully, link 4 rocks"),
        ((4.0, 2.5, 3.5, 1.0), "Grashof crank-rocker: link 4 turns fully, link 2 rocks"),
        ((1.0, 3.0, 3.5, 2.5), "Grashof double-crank (drag link): links 2 and 4 turn fully"),
        ((4.0, 3.0, 1.5, 3.5), "Grashof double-rocker: links 2 and 4 rock, link 3 turns fully"),
        ((4.0, 2.0, 2.0, 2.5), "triple-rocker, not Grashof: no link turns fully"),
        ((3.0, 2.0, 3.0, 2.0), "change point (shortest + longest = the other two)"),
    ],
)
def test_grashof_kinds(lengths: tuple[float, float, float, float], kind: str) -> None:
    (loop,) = of_lengths(*lengths).loops
    assert loop.kind == kind
    assert loop.lengths == pytest.approx(lengths)


CLOSE = """\
icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: {crank}, BC: 3.5, CD: 2.5}}
angles: {{AB: 40}}
near: {{C: [3, 2.4]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{M: {{torque: 5, link: 4}}, T: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize(
    ("crank", "kind"),
    [
        ("2", "change point"),
        ("1.999999999999999999999999", "Grashof crank-rocker: link 2 turns fully"),
        ("2.000000000000000000000001", "triple-rocker, not Grashof"),
    ],
)
def test_a_kind_is_that_of_the_decimals_as_written(crank: str, kind: str) -> None:
    """Shortest and longest link together are 2 + 4, the other two 3.5 + 2.5."""
    (loop,) = report(icsolve.solve(icsolve.load(CLOSE.format(crank=crank)), examine=True)).loops
    assert loop.kind.startswith(kind)
    assert bool(loop.inputs[0].limits) == kind.startswith("triple")


SLIDER = """\
icsolve: 1
points: {{A: [0, 0], C: [unknown, 1]}}
lengths: {{AB: 2, BC: {rod}}}
angles: {{AB: 20}}
near: {{C: [5, 1]}}
joints:
  [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{slide: [4, 1], at: C, along: 0}}]
loads: {{P: {{force: 5, link: 4, at: C, angle: 180}}, T: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize(
    ("rod", "turns"), [("3.0000000000000001", True), ("3", True), ("2.9999999999999999", False)]
)
def test_whether_a_crank_turns_is_decided_by_the_decimals(rod: str, turns: bool) -> None:
    """It does where the rod is no shorter than crank and offset together: 2 + 1."""
    (loop,) = report(icsolve.solve(icsolve.load(SLIDER.format(rod=rod)), examine=True)).loops
    assert (loop.kind == "link 2 turns fully") == turns == (loop.stroke is not None)
    assert bool(loop.inputs[0].limits) != turns


def test_transmission_angle_of_a_crank_rocker_is_extreme_with_the_crank_in_line_with_the_base() -> None:
    (loop,) = of_lengths(4.0, 1.0, 3.5, 2.5).loops
    angle = loop.inputs[0].transmission
    # cos mu = (b^2 + c^2 - f^2) / 2bc with the diagonal f of 3, 5 and, at 60 degrees, sqrt(13)
    assert loop.inputs[0].at == "C"
    assert angle.least == pytest.approx(math.degrees(math.acos((18.5 - 9.0) / 17.5)))
    assert angle.greatest == pytest.approx(math.degrees(math.acos((18.5 - 25.0) / 17.5)))
    assert angle.now == pytest.approx(math.degrees(math.acos((18.5 - 13.0) / 17.5)))


def test_a_crank_turns_fully_and_its_rocker_stops_where_crank_and_coupler_lie_in_line() -> None:
    (loop,) = of_lengths(4.0, 1.0, 3.5, 2.5).loops
    crank, rocker = loop.inputs
    assert crank.limits == ()
    stretched = 180.0 - math.degrees(math.acos((4.0**2 + 2.5**2 - 4.5**2) / (2 * 4.0 * 2.5)))
    folded = 180.0 - math.degrees(math.acos((4.0**2 + 2.5**2 - 2.5**2) / (2 * 4.0 * 2.5)))
    assert rocker.limits == pytest.approx((stretched, folded))


def _assembles(side: Side, turned: float) -> bool:
    square = side.driver**2 + side.base**2 - 2.0 * side.driver * side.base * math.cos(math.radians(turned))
    return abs(side.coupler - side.output) <= math.sqrt(square) <= side.coupler + side.output


SIDES = [
    Side(*lengths, turned)
    for lengths in [(2.0, 2.5, 2.0, 4.0), (4.0, 1.5, 3.5, 3.0), (3.0, 6.5, 3.0, 4.0), (1.0, 3.5, 2.5, 4.0)]
    for turned in (35.0, -35.0, 150.0, 60.0, -60.0)
]


@pytest.mark.parametrize("side", [side for side in SIDES if _assembles(side, side.turned)])
def test_the_input_range_is_where_the_loop_assembles(side: Side) -> None:
    turned, limits = side.turned, limits_of(side)
    reach = [turned]
    for step in (0.25, -0.25):
        angle = turned
        while abs(angle - turned) < 360.0 and _assembles(side, angle + step):
            angle += step
        reach.append(angle)
    if not limits:
        assert reach[1] - turned >= 360.0
        return
    low, high = limits
    assert (reach[2] - low) % 360.0 == pytest.approx(0.125, abs=0.1251)
    assert (high - reach[1]) % 360.0 == pytest.approx(0.125, abs=0.1251)


def test_transmission_range_of_a_limited_input_reaches_the_straight_line() -> None:
    side = Side(2.0, 2.5, 2.0, 4.0, 60.0)
    assert transmission_of(side).greatest == pytest.approx(180.0)


def slider_crank(radius: float, rod: float, offset: float, angle: float = 50.0, guide: float = 0.0) -> Report:
    """The report of a slider-crank with its guide at an angle; the slider on the far side."""
    turned = math.radians(angle)
    along = radius * math.cos(turned) + math.sqrt(rod**2 - (offset - radius * math.sin(turned)) ** 2)
    ux, uy = math.cos(math.radians(guide)), math.sin(math.radians(guide))
    places = {
        "A": (0.0, 0.0),
        "B": (radius * math.cos(turned), radius * math.sin(turned)),
        "C": (along, offset),
    }
    points = {name: (x * ux - y * uy, x * uy + y * ux) for name, (x, y) in places.items()}
    joints = (
        Pin(("1", "2"), "A"),
        Pin(("2", "3"), "B"),
        Pin(("3", "4"), "C"),
        Slide(("4", "1"), "C", Guide(number(str(guide)), None, None)),
    )
    return report(four_bar_answer(four_bar_case(joints=joints), points=points))


@pytest.mark.parametrize("guide", [0.0, 130.0])
def test_an_offset_slider_crank_turns_back_at_the_known_distances(guide: float) -> None:
    (loop,) = slider_crank(1.0, 3.0, 0.5, guide=guide).loops
    assert loop.name == "offset slider-crank"
    assert loop.kind == "link 2 turns fully"
    assert loop.stroke is not None
    ends = [math.hypot(*place) for place in loop.stroke]
    assert ends == pytest.approx([2.0, 4.0])
    assert loop.inputs[0].transmission.least == pytest.approx(math.degrees(math.acos(1.5 / 3.0)))
    assert loop.inputs[0].transmission.greatest == pytest.approx(90.0)


def test_a_crank_longer_than_its_rod_stops_with_the_rod_square_to_the_guide() -> None:
    (loop,) = slider_crank(3.0, 1.5, 0.0, angle=20.0).loops
    assert loop.name == "in-line slider-crank"
    assert loop.inputs[0].limits == pytest.approx((330.0, 30.0))
    assert loop.stroke is None


@pytest.mark.parametrize(
    ("offset", "turned", "limits"),
    [(1.0, 20.0, (-30.0, 150.0 + 60.0)), (-1.0, -20.0, (150.0, 390.0)), (0.0, 170.0, (150.0, 210.0))],
)
def test_offset_cranks_that_do_not_turn_fully(
    offset: float, turned: float, limits: tuple[float, float]
) -> None:
    # r = 2 and l = 2 (l = 1 in line): sin(turned) reaches (e - l)/r or (e + l)/r
    crank = Crank(2.0, 2.0 if offset else 1.0, offset, turned)
    assert limits_in_slider_crank(crank) == pytest.approx(limits)


def test_welded_links_count_as_one_body() -> None:
    joints = (
        Pin(("1", "2"), "A"),
        Pin(("2", "3"), "B"),
        Pin(("5", "4"), "C"),
        Pin(("4", "1"), "D"),
        Weld(("3", "5")),
    )
    answer = four_bar_answer(four_bar_case(joints=joints, links=("1", "2", "3", "5", "4")))
    assert len(report(answer).loops) == 1


def test_a_three_link_pin_makes_no_four_bar_through_one_point() -> None:
    joints = (Pin(("1", "2", "3", "4"), "A"), Pin(("2", "3"), "B"), Pin(("3", "4"), "C"))
    assert report(four_bar_answer(four_bar_case(joints=joints))).loops == ()


def test_a_mechanism_of_other_loops_has_mobility_and_no_grashof_kind() -> None:
    case = four_bar_case(joints=(Pin(("1", "2"), "A"),), points={"A": at("0", "0")})
    text = report(Answer(case, mobility=1, points={"A": (0.0, 0.0)})).text()
    assert "mobility 1" in text
    assert "no four-bar and no slider-crank" in text


def test_a_four_bar_whose_position_is_to_find_is_not_said_to_be_none() -> None:
    text = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: unknown}
near: {C: [3, 4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {W: {weight: 5, link: 3, at: C}}
"""
    told = report(icsolve.solve(icsolve.load(text), examine=True)).text()
    assert told.endswith("are told of one position: --set angles.AB=...")
    given = icsolve.load(text, settings={"angles.AB": 30})
    assert "Grashof crank-rocker" in report(icsolve.solve(given, examine=True)).text()


def test_text_and_object_say_the_same() -> None:
    made = of_lengths(4.0, 1.0, 3.5, 2.5)
    text = made.text()
    assert "four-bar of links 1 2 3 4 (A B C D; 4, 1, 3.5, 2.5 in)" in text
    assert "link 2 as input: transmission angle at C" in text
    (loop,) = made.to_dict()["loops"]
    assert loop["inputs"][0]["transmission"]["now"] == made.loops[0].inputs[0].transmission.now


def test_a_rate_and_a_velocity_that_are_open_are_told_alike() -> None:
    """As in the JSON: undetermined, and why."""
    case = icsolve.load(
        "icsolve: 1\npoints: {A: [0, 0], B: [1, 0], C: [2, 0]}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]\nlinks: {3: [C]}\n"
        "loads: {P: {force: unknown, link: 2, at: B, angle: 90}, T: {torque: unknown, link: 3}}\n"
    )
    told = answer_text(icsolve.solve(case, rates=True))
    assert "  w3  undetermined: the speed of link 3" in told
    assert re.search(r"  C on 3 +undetermined: the velocity of C on link 3", told)
