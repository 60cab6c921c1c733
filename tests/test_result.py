"""The JSON object of the format, and the same answer as text."""

from __future__ import annotations

import json

import pytest

import icsolve
from icsolve.answer import Centre, Deferred, Found, Term
from icsolve.answer.as_json import pair_name, refusal_dict, to_dict
from icsolve.case import Coordinates, Motion, Torque, Units
from icsolve.errors import SceneError, Status
from icsolve.report import answer_text
from icsolve.scene.parts import _directed
from icsolve.tuples import replace
from made import four_bar_answer, four_bar_case, number


def test_the_object_has_the_keys_of_the_format() -> None:
    shown = four_bar_answer(rates={"2": 1.0}, velocities={("E", "4"): (0.1, -0.2)}).to_dict()
    assert shown["schema"] == "icsolve/solve/1"
    assert (shown["case"], shown["status"]) == ("13_08", "ok")
    assert shown["answers"]["T12"] == {
        "value": 29.67219,
        "unit": "lbf*in",
        "sense": "ccw",
        "error": 2.1e-14,
    }
    assert shown["centres"]["2-4"]["at"] == [-1.5139, 0.0]
    assert shown["centres"]["2-4"]["lines"] == [["2-3", "3-4"], ["1-2", "1-4"]]
    assert shown["rates"] == {"2": 1.0}
    assert shown["velocities"] == {"E on 4": [0.1, -0.2]}
    assert shown["points"]["C"] == [2.2, 2.60424]
    assert shown["errors"] == {"centres": {"2-4": 3e-16}}


def test_rates_and_velocities_are_there_only_where_asked() -> None:
    assert not {"rates", "velocities"} & set(to_dict(four_bar_answer()))


BARS = """icsolve: 1
points: {A: [0, 0], B: [1, 2], C: [4, 3], D: [6, 0], P: [-5.3, 0.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}%s]
loads: {M: {torque: 5, link: 4}, T: {torque: unknown, link: 2%s}}
"""


def test_the_centre_of_a_load_against_a_link_is_among_those_shown() -> None:
    """Of the links that bear loads and the frame, and of a load's link with the link that it reacts on."""
    found = icsolve.solve(icsolve.load(BARS % ("", ", against: 3")))
    assert {*found.centres} == {("1", "2"), ("1", "4"), ("2", "4"), ("2", "3")}


def test_a_given_centre_off_its_place_is_told_with_its_distance() -> None:
    """Line BC meets the line of the fixed pivots at (-5, 0), 0.5 from the given one, by 3-4-5."""
    with pytest.raises(SceneError, match=r"centre 2-4 lies 0\.5 m from where the other centres and joints"):
        icsolve.solve(icsolve.load(BARS % (", {centre: [2, 4], at: P}", "")))


def test_negative_zeros_become_zeros() -> None:
    answer = four_bar_answer(
        answers={"T12": Found(-0.0, "lbf*in", "")}, rates={"3": -0.0}, velocities={("C", "4"): (-0.0, -0.0)}
    )
    assert "-0.0" not in json.dumps(to_dict(answer))
    text = answer_text(answer)
    assert "T12 = 0 lbf*in" in text
    assert "C on 4  (0, 0)" in text
    assert "w3  0" in text


def test_centres_that_have_no_place_say_what_they_are() -> None:
    centres = {
        ("1", "5"): Centre(("1", "5"), "toward", (90.0,), "construction"),
        ("3", "6"): Centre(("3", "6"), "undefined", why="3 and 6 move as one"),
        ("2", "6"): Centre(("2", "6"), "undetermined", why="6 spins freely"),
    }
    shown = to_dict(four_bar_answer(centres=centres, rates={"6": "6 spins freely"}))
    assert shown["centres"]["1-5"] == {"toward": 90.0, "by": "construction"}
    assert shown["centres"]["3-6"] == {"undefined": "3 and 6 move as one"}
    assert shown["centres"]["2-6"] == {"undetermined": "6 spins freely"}
    assert shown["rates"]["6"] == {"undetermined": "6 spins freely"}


def test_an_answer_without_a_proven_bound_says_why() -> None:
    found = Found(1.0, "N", "at 0 deg", None, "no bound is proven yet")
    entry = to_dict(four_bar_answer(answers={"P": found}))["answers"]["P"]
    assert (entry["error"], entry["why"]) == (None, "no bound is proven yet")


def test_pairs_are_named_numbers_ascending_then_words_in_order_of_first_mention() -> None:
    case = four_bar_case(links=("rod", "1", "crank", "10", "2"))
    assert pair_name(case, ("10", "2")) == "2-10"
    assert pair_name(case, ("crank", "rod")) == "rod-crank"
    assert pair_name(case, ("crank", "10")) == "10-crank"


def test_hidden_points_stay_hidden() -> None:
    answer = four_bar_answer(points={"@P": (1.0, 2.0)}, velocities={("@P", "4"): (1.0, 2.0)})
    shown = to_dict(answer)
    assert shown["points"] == shown["velocities"] == {}


def test_a_reconstruction_is_labelled_wherever_it_is_shown() -> None:
    answer = four_bar_answer(four_bar_case(reconstructed="the figure is lost"))
    assert to_dict(answer)["reconstructed"] == "the figure is lost"
    assert "RECONSTRUCTED: the figure is lost" in answer_text(answer)


def test_a_refusal_has_status_and_message() -> None:
    assert refusal_dict("press", SceneError("dead-centre", "2 can't drive.")) == {
        "schema": "icsolve/solve/1",
        "case": "press",
        "status": "dead-centre",
        "message": "2 can't drive.",
    }


def test_text_gives_the_unknown_with_unit_and_sense_in_words() -> None:
    text = answer_text(four_bar_answer())
    assert "T12 = 29.6722 lbf*in, counterclockwise" in text
    assert "T12/P = 0.296722 lbf*in per lbf" in text
    assert "T12 = 29.67 lbf*in" in answer_text(four_bar_answer(), digits=4)


@pytest.mark.parametrize(
    ("error", "shown"), [(2e-14, "29.6722"), (2e-4, "29.672"), (0.02, "29.7"), (3.0, "30"), (None, "29.6722")]
)
def test_text_shows_no_digit_that_the_error_bound_leaves_open(error: float | None, shown: str) -> None:
    answer = four_bar_answer(answers={"T12": Found(29.67219, "lbf*in", "ccw", error)})
    assert f"T12 = {shown} lbf*in" in answer_text(answer)


def test_text_gives_the_size_with_the_sense_and_explains_a_minus_sign() -> None:
    answer = four_bar_answer(answers={"T12": Found(-26.8815, "lbf*in", "cw")})
    clockwise = answer_text(answer)
    assert "T12 = 26.8815 lbf*in, clockwise   (T12 = -26.8815, positive counterclockwise)" in clockwise
    turned = four_bar_case(loads=(Torque("T12", "2", None, turns="cw"),))
    counter = answer_text(four_bar_answer(turned, answers={"T12": Found(-26.8815, "lbf*in", "ccw")}))
    assert "T12 = 26.8815 lbf*in, counterclockwise   (T12 = -26.8815, positive clockwise)" in counter


def test_text_shows_how_each_centre_was_found() -> None:
    text = answer_text(four_bar_answer())
    assert "I2-4  (-1.5139, 0)  where line I2-3 I3-4 meets line I1-2 I1-4" in text
    assert "I1-2  (0, 0)        a joint" in text


def words(text: str) -> list[str]:
    """Lines without their columns' widths."""
    return [" ".join(line.split()) for line in text.splitlines()]


def test_text_has_one_line_for_each_term_of_power() -> None:
    lines = words(answer_text(four_bar_answer()))
    assert "Power in lbf*in/s: the terms add up to zero" in lines
    assert "P 100 lbf x -0.296722 in/s = -29.6722 on link 4 at E" in lines
    assert "T12 29.6722 lbf*in x 1 rad/s = 29.6722 on link 2" in lines


BALANCE = """\
icsolve: 1
points: {{A: [0, 0], B: [-1, 0], C: [2, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  P: {{force: 2, link: 2, at: B, angle: -90}}
  Q: {{force: {force}, link: 2, at: C, angle: -90}}
"""


@pytest.mark.parametrize(
    ("force", "said"),
    [
        ("1", "zero, the loads are in equilibrium"),
        ("6", "-10, the loads are not in equilibrium"),
        ("1.26", "-0.52, the loads are not in equilibrium"),  # 0.5 of P and twice 0.005 of Q are 0.51
        ("1.25", "-0.5, which is within half a unit of the last decimals"),
        ("1.00000000000001", "-2e-14, which is within half a unit of the last decimals"),
        ("0.99999999999999999999999", "2e-23, which is within half a unit of the last decimals"),
    ],
)
def test_known_loads_alone_are_said_to_balance_only_where_they_do(force: str, said: str) -> None:
    """A lever of arms 1 and 2; the decimals as they are written."""
    case = icsolve.load(BALANCE.format(force=force))
    assert f"Power in N*m/s: the terms add up to {said}" in words(answer_text(icsolve.solve(case)))


def test_power_is_shown_in_the_unit_of_torque() -> None:
    case = four_bar_case(units=Units("mm", "N", "N*m", 0.001))
    terms = (
        Term("W", "3", 2.0, "kg", -98.1, -196.2, False, "W on link 3 at C"),
        Term("F", "4", 250.0, "N", 30.0, 7500.0, False, "F on link 4 at E"),
        Term("T", "2", -7.3038, "N*m", 1000.0, -7303.8, True, "T on link 2"),
    )
    lines = words(answer_text(four_bar_answer(case, terms=terms, advantage=None)))
    assert "W 2 kg x -0.0981 per kg = -0.1962 on link 3 at C" in lines
    assert "F 250 N x 30 mm/s = 7.5 on link 4 at E" in lines
    assert "T -7.3038 N*m x 1 rad/s = -7.3038 on link 2" in lines


def test_equal_kinds_have_a_mechanical_advantage() -> None:
    terms = (
        Term("P", "2", 100.0, "N", 40.0, 4000.0, False, "P on link 2 at H"),
        Term("Q", "3", 4000.0, "N", -1.0, -4000.0, True, "Q on link 3 at J"),
    )
    answer = four_bar_answer(answers={"Q": Found(4000.0, "N", "push")}, terms=terms, advantage=40.0)
    assert "Q/P = 40 (mechanical advantage, where Q is the output)" in answer_text(answer)


def test_text_of_rates_says_whether_they_are_scaled() -> None:
    answer = four_bar_answer(rates={"2": 1.0, "4": -0.34}, velocities={("E", "4"): (0.1, -0.2)})
    assert "Angular velocities, scaled" in answer_text(answer)
    assert "  w4  0.34 cw" in answer_text(answer)
    timed = four_bar_case(motion=(Motion("2", number("12")),))
    assert "Angular velocities, rad/s" in answer_text(four_bar_answer(timed, rates={"2": 12.0}))


def test_text_shows_the_points_that_the_figure_determines() -> None:
    case = four_bar_case()
    points = {name: data for name, data in case.points.items() if name not in "CE"}
    half_known = {**points, "E": Coordinates(None, number("0.87382"))}
    text = answer_text(four_bar_answer(four_bar_case(points=half_known)))
    assert "Points found, in\n  C  (2.2, 2.60424)\n  E  (3.4489, 0.87382)" in text
    assert "Points found" not in answer_text(four_bar_answer())


def test_notes_and_what_was_not_examined_are_shown() -> None:
    answer = four_bar_answer(notes=("CD set C; BC fits within 0.01 in.",), skipped=("point H",))
    assert "Notes\n  CD set C; BC fits within 0.01 in." in answer_text(answer)
    assert "Not examined\n  point H" in answer_text(answer)


FOUR_BAR = """icsolve: 1
points: {{A: [0, 0], B: {b}, C: {c}, D: [3, 0]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads:
  K: {{torque: {known}, link: 2}}
  U: {{{unknown}}}
"""
STRETCHED, IN_LINE, PARALLELOGRAM = ("[1, 1]", "[3, 3]"), ("[2, 1.5]", "[5, 0]"), ("[1, 2]", "[4, 2]")


@pytest.mark.parametrize(
    ("places", "unknown", "said"),
    [
        (STRETCHED, "torque: unknown, link: 4", "link 4 stands still in this position"),
        (IN_LINE, "torque: unknown, link: 2, against: 3", "link 2 and link 3 move as one in this position"),
        (PARALLELOGRAM, "torque: unknown, link: 3", "link 3 does not turn in this position"),
        (PARALLELOGRAM, "torque: unknown, link: 2, against: 4", "link 2 does not turn against link 4 in"),
        (PARALLELOGRAM, "force: unknown, link: 3, at: C, slope: [1, 2]", "its line is square to the motion"),
        (
            PARALLELOGRAM,
            "force: unknown, link: 3, against: 2, at: C, angle: 0",
            "where it acts, its line is square to the motion of link 3 against link 2",
        ),
    ],
)
def test_a_load_that_does_no_work_is_told_why(places: tuple[str, str], unknown: str, said: str) -> None:
    """Crank and rod in line: the rocker stands still. C on the line AD: crank and rod turn as one about A. A
    parallelogram: the rod only slides, the rocker turns with the crank."""
    for known, status in ((7, "no value of U balances"), (0, "any value of U balances")):
        text = FOUR_BAR.format(b=places[0], c=places[1], known=known, unknown=unknown)
        with pytest.raises(SceneError) as refusal:
            icsolve.solve(icsolve.load(text))
        assert refusal.value.message.startswith(f"{status}: ")
        assert said in refusal.value.message
        rests = places is not PARALLELOGRAM and known
        assert (refusal.value.status == Status.DEAD_CENTRE) == bool(rests)
        turned = "Give it another direction, put it on another link" in refusal.value.message
        assert turned == bool(known and "its line is square to the motion" in said)


def test_the_steps_that_ran_are_those_that_the_answer_needs() -> None:
    """A dyad behind the loads is skipped, figure and motion; three equal cranks need all equations."""
    four_bar = (
        "icsolve: 1\npoints: {A: [0, 0], D: [4, 0], H: [6, 3], K: [8, 0]}\n"
        "lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}\nangles: {AB: 60, CDE: 0}\nnear: {C: [3.5, 2.4]}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}, "
        "{pin: [4, 5], at: E}, {pin: [5, 6], at: H}, {pin: [6, 1], at: K}]\n"
        "loads: {P: {force: 100, link: 4, at: C, angle: 180}, T12: {torque: unknown, link: 2}}\n"
    )
    answer = icsolve.solve(icsolve.load(four_bar))
    assert list(answer.steps) == [
        "A, D: by coordinates",
        "B: from A by AB along angle AB",
        "C: where the circle about B of radius BC meets the circle about D of radius CD (left)",
        "motions: virtual input 1-2",
        "motions: links 4 and 3",
    ]
    assert answer.skipped == ("links 5 and 6", "H", "K", "E")
    cranks = (
        "icsolve: 1\npoints: {A: [0, 0], B: [0, 1], C: [2, 1], D: [2, 0], E: [1, 0], F: [1, 1]}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}, "
        "{pin: [1, 5], at: E}, {pin: [5, 3], at: F}]\n"
        "loads: {K: {torque: 2, link: 2}, U: {torque: unknown, link: 4}}\n"
    )
    assert icsolve.solve(icsolve.load(cranks)).steps[-1] == "motions: loop equations of the whole scene"


@pytest.mark.parametrize("unproven", ["x", "y", "xy", ""])
def test_a_force_of_unknown_direction_is_as_sure_as_its_components(unproven: str) -> None:
    """Its size is at most as far off as both are; where no bound of one is proven none of it is, for that
    reason."""
    case = four_bar_case()
    sure = {axis: (None, "so") if axis in unproven else (1e-9, "") for axis in "xy"}
    parts = {f"P.{axis}": Found(v, "N", "", *sure[axis]) for axis, v in (("x", 3.0), ("y", 4.0))}
    loads = tuple(load._replace(name=f"P.{axis}") for axis, load in zip("xy", case.loads * 2, strict=False))
    found = _directed(replace(case, directed=("P",), loads=loads), parts)["P"]
    assert (found.value, found.components) == (5.0, (3.0, 4.0))
    assert found.why == ("so" if unproven else "")
    assert found.error is None if unproven else 1.4e-9 < found.error < 1.5e-9


def test_a_fault_in_what_is_put_off_is_no_key_that_is_missing() -> None:
    """A mapping that fails to be made is not told as one that lacks what is asked for."""

    def fails() -> dict[str, float]:
        return {"T": {"2": 1.0}["5"]}

    for ask in (lambda put_off: "T" in put_off, lambda put_off: put_off.get("T"), dict):
        with pytest.raises(RuntimeError, match="5"):
            ask(Deferred(fails))
