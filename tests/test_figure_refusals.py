"""Every refusal of a figure: its status, where it is, how much is missing, and what would mend it."""

from __future__ import annotations

import pytest

import icsolve
from icsolve.assembly import solve_figure
from icsolve.errors import SceneError, Status
from test_figure import FOUR_BAR, LOOP, PINS, SLIDER, butterfly, case, solved


def refused(text: str, wanted: list[str] | None = None) -> tuple[str, str]:
    with pytest.raises(SceneError) as caught:
        solve_figure(case(text), wanted)
    return caught.value.status, caught.value.message


def assert_refused(text: str, status: str, *parts: str, wanted: list[str] | None = None) -> None:
    found, message = refused(text, wanted)
    assert found == status, message
    for part in parts:
        assert part in message, message


SPAN = "points: {{A: [0, 0], C: [{c}, 0]}}\nlengths: {{AB: {ab}, BC: {bc}}}\n" + PINS.replace(
    "{", "{{"
).replace("}", "}}")


def test_too_short_by_the_gap() -> None:
    assert_refused(
        SPAN.format(ab=1, bc=2, c=3.3),
        Status.CANNOT_ASSEMBLE,
        "AB = 1 and BC = 2 cannot meet at B: A and C are 3.3 apart, 0.3 too far (closest gap 0.3 m)",
    )


def test_too_long_by_the_gap() -> None:
    assert_refused(
        SPAN.format(ab=1, bc=5, c=3.3),
        Status.CANNOT_ASSEMBLE,
        "AB = 1 and BC = 5 cannot meet at B: A and C are 3.3 apart, 0.7 too close (closest gap 0.7 m)",
    )


def test_the_gap_is_in_the_units_of_the_case() -> None:
    text = "units: {length: in}\n" + SPAN.format(ab=1, bc=2, c=3.3)
    assert_refused(text, Status.CANNOT_ASSEMBLE, "closest gap 0.3 in")


def test_a_slider_out_of_reach() -> None:
    text = SLIDER.replace("BC: 3", "BC: 0.5") + PINS + "  - {slide: [4, 1], at: C, along: 0, through: A}\n"
    assert_refused(text, Status.CANNOT_ASSEMBLE, "at C", "BC", "closest gap 0.366025 m")


def test_a_ray_that_is_met_only_behind_its_start() -> None:
    text = "points: {A: [0, 0], C: [4, 1]}\nangles: {AB: 180, CB: 270}\n" + PINS
    assert_refused(text, Status.CANNOT_ASSEMBLE, "at B", "wrong side", "4 m behind")


def test_a_ray_that_meets_a_circle_only_behind_its_start() -> None:
    text = "points: {A: [0, 0], C: [-3, 0]}\nangles: {AB: 0}\nlengths: {CB: 1}\n" + PINS
    assert_refused(text, Status.CANNOT_ASSEMBLE, "at B", "circle about C", "wrong side", "2 m behind")


def test_parallel_guides_never_meet() -> None:
    text = "points: {A: [0, 0], C: [0, 1]}\nangles: {AB: 30, CB: 30}\n" + PINS
    assert_refused(text, Status.CANNOT_ASSEMBLE, "at B", "parallel", "0.866025 m apart")


def test_guides_on_one_line_leave_the_point_free() -> None:
    joints = (
        PINS
        + "  - {slide: [4, 1], at: B, along: 0, through: A}\n"
        + "  - {slot: [3, 1], at: B, along: 0, through: C}\n"
    )
    text = "points: {A: [0, 0], C: [4, 0]}\n" + joints
    assert_refused(text, Status.UNDERDETERMINED, "B may lie anywhere on a line", "coincide")


def test_equal_circles_about_one_point_fit_at_any_angle() -> None:
    assert_refused(
        SPAN.format(ab=1, bc=1, c=0), Status.UNDERDETERMINED, "B may lie anywhere", "any angle fits"
    )


def test_unequal_circles_about_one_point() -> None:
    assert_refused(SPAN.format(ab=1, bc=2, c=0), Status.CANNOT_ASSEMBLE, "A and C coincide", "(gap 1 m)")


def test_two_ways_are_listed_with_a_line_to_add() -> None:
    assert_refused(
        FOUR_BAR + LOOP,
        Status.AMBIGUOUS,
        "C: (3.61106, 2.46956) or (2.50433, -2.00324)",
        "near: {C: [3.61106, 2.46956]}",
    )


def test_ways_are_listed_dyad_by_dyad() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, CE: 3, EG: 4").replace("D: [4, 0]", "D: [4, 0], G: [8, 0]")
    joints = LOOP + "  - {pin: [3, 5], at: C}\n  - {pin: [5, 6], at: E}\n  - {pin: [6, 1], at: G}\n"
    status, message = refused(text + joints)
    assert status == Status.AMBIGUOUS
    first, second, _ = message.split("; ")
    assert first.endswith("C: (3.61106, 2.46956) or (2.50433, -2.00324)")
    assert second.startswith("E: (6.36819, 3.65201) or ")
    assert second.count(" or ") == 3


def test_a_place_that_two_ways_share_is_listed_once_wherever_it_lies() -> None:
    """Two dyads on one base, each with two places, far from the first pin against the figure's size."""
    text = (
        "points: {A: [0, 0], D: [0.9, 0.9], E: [0.9, 0]}\nlengths: {DB: 0.5, EB: 0.8, DC: 0.45, EC: 0.85}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [3, 4], at: B}, {pin: [4, 1], at: D}, {pin: [3, 1], at: E}, "
        "{pin: [5, 6], at: C}, {pin: [5, 1], at: D}, {pin: [6, 1], at: E}]\nlinks: {2: [A]}\n"
    )
    status, message = refused(text)
    assert status == Status.AMBIGUOUS
    assert message.split("; ")[0].count(" or ") == message.split("; ")[1].count(" or ") == 1


def test_a_later_near_chooses_an_earlier_dyad() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, CE: 3, EG: 4").replace("D: [4, 0]", "D: [4, 0], G: [8, 0]")
    joints = LOOP + "  - {pin: [3, 5], at: C}\n  - {pin: [5, 6], at: E}\n  - {pin: [6, 1], at: G}\n"
    _, at = solved(text + "near: {E: [6, 3.5]}\n" + joints)
    assert at["C"][1] > 0.0


def test_near_in_the_middle_is_refused() -> None:
    """On the line of centres; and off it by less than a hundredth of the distance."""
    for y in ("0", "0.001"):
        text = SPAN.format(ab=2, bc=2, c=3) + f"near: {{B: [1.5, {y}]}}\n"
        assert_refused(text, Status.AMBIGUOUS, "B: (1.5, 1.32288) or (1.5, -1.32288)", "near: for B")


def test_a_group_needs_near_for_one_of_its_points() -> None:
    assert_refused(
        butterfly(""), Status.AMBIGUOUS, "can only be found together", "no order of construction", "near: {"
    )


def test_a_group_that_has_no_solution_tells_the_datum_that_is_farthest_off() -> None:
    text = butterfly("near: {F: [2, 2.6]}\n").replace("FJ: ", "FJ: 1")
    assert_refused(
        text, Status.CANNOT_ASSEMBLE, "no position found", "points G, I, H, J and F", "misses length"
    )


def test_a_group_with_two_solutions_about_as_near() -> None:
    """Three rods hold a platform on three pins, all symmetric about the line of C: D is on either side."""
    text = (
        "points: {A: [-2, 0], B: [2, 0], C: [0, 4]}\nlengths: {AD: 2, BE: 2, CF: 2, DE: 2, EF: 2, FD: 2}\n"
        "near: {F: [0, 2.5]}\njoints:\n"
        + "".join(f"  - {{pin: [{i}, {j}], at: {p}}}\n" for i, j, p in
                  ((1, 2, "A"), (1, 3, "B"), (1, 4, "C"), (2, 5, "D"), (3, 5, "E"), (4, 5, "F")))
    )  # fmt: skip
    status, message = refused(text)
    assert status == Status.AMBIGUOUS
    assert " or (" in message


def test_one_datum_too_few() -> None:
    text = FOUR_BAR.replace(", CD: 2.5", "") + PINS
    assert_refused(text, Status.UNDERDETERMINED, "point C: one more length, angle or coordinate is needed")


def test_a_direction_that_is_found_late_places_what_it_guides() -> None:
    """Corners carry the direction of the guide CE on from AB, once B is in place: P has its two lines."""
    text = (
        "points: {A: [0, 0], D: [5, 0], Q: [1, 1.5], F: [1, -1]}\nlengths: {AB: 3, DB: 4}\n"
        "angles: {ABC: 70, BCE: 100}\nnear: {B: [1.8, 2.4]}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: D}, {pin: [2, 3], at: B}, "
        "{slide: [5, 2], at: P, along: [C, E], through: Q}, {slide: [5, 1], at: P, along: 20, through: F}]\n"
    )
    status, message = refused(text)
    assert (status, message) == (
        Status.UNDERDETERMINED,
        "points C and E: one more length, angle or coordinate is needed",
    )


def test_a_figure_that_may_turn() -> None:
    text = "points: {A: [0, 0]}\nlengths: {AB: 1, BC: 3, CA: 3}\n" + PINS
    assert_refused(text, Status.UNDERDETERMINED, "points B and C", "nothing fixes how it is turned about A")


def test_a_figure_that_may_be_anywhere() -> None:
    text = "lengths: {AB: 1, BC: 3, CA: 3}\n" + PINS
    assert_refused(
        text, Status.UNDERDETERMINED, "nothing fixes where the figure of A, B and C lies", "direction"
    )
    turned = text.replace("joints:", "angles: {AB: 0}\njoints:")
    assert_refused(turned, Status.UNDERDETERMINED, "nothing fixes where", "coordinates of one of its points")
    assert "direction" not in refused(turned)[1]


def test_all_that_is_free_is_listed() -> None:
    text = (
        "points: {A: [0, 0], D: [4, 0]}\nlengths: {AB: 1, CD: 2, DE: 1}\nangles: {CDE: 20}\n"
        + LOOP
        + "links: {4: [E]}\n"
    )
    assert_refused(text, Status.UNDERDETERMINED, "point B: one more", "points C and E: one more")


def test_free_points_that_nothing_needs_are_no_matter() -> None:
    text = FOUR_BAR.replace(", CD: 2.5", "") + PINS
    _, at = solved(text, ["B"])
    assert set(at) == {"A", "B"}


def test_a_braced_square_that_floats_is_not_taken_for_determined() -> None:
    """Six bars between four points hold their shape twice over; two more cannot hold its place."""
    diagonal = 2**0.5
    text = (
        "points: {E: [0, 0], F: [4, 0]}\n"
        f"lengths: {{AB: 1, BC: 1, CD: 1, DA: 1, AC: {diagonal}, BD: {diagonal}, "
        f"EA: {diagonal}, FB: {5**0.5}}}\nnear: {{A: [1, 1], B: [2, 1], C: [2, 2], D: [1, 2]}}\n"
        + LOOP + "links: {4: [E, F]}\n"
    )  # fmt: skip
    assert_refused(text, Status.UNDERDETERMINED, "points A, B, C and D: one more")


COORDINATES = "points: {A: [0, 0], B: [0.5, 0.866], C: [3.611, 2.47], D: [4, 0]}\n"


def test_a_length_that_the_coordinates_contradict() -> None:
    text = COORDINATES + "lengths: {BC: 3.62}\n" + LOOP
    assert_refused(text, Status.INCONSISTENT, "BC is given as 3.62, the coordinates make it 3.50016")


@pytest.mark.parametrize(("datum", "said"), [
    ("angles: {AB: 61.5}", "angle AB is given as 61.5, the coordinates make it 59.9993"),
    ("angles: {AB: 240}", "angle AB is given as 240, the coordinates make it 59.9993"),
    ("angles: {BAD: 60}", "angle BAD is given as 60, the coordinates make it 300.001"),
    ("angles: {BAD: -50}", "angle BAD is given as -50, the coordinates make it -59.9993"),
    ("angles: {BAD: -310}", "angle BAD is given as -310, the coordinates make it -59.9993"),
    ("angles: {BA: -130}", "angle BA is given as -130, the coordinates make it -120.001"),
])  # fmt: skip
def test_an_angle_that_the_coordinates_contradict(datum: str, said: str) -> None:
    assert_refused(COORDINATES + datum + "\n" + LOOP, Status.INCONSISTENT, said)


@pytest.mark.parametrize(("datum", "made"), [("BAC: 30", "36.8699"), ("BAC: -320", "36.8699"),
    ("CAB: -40", "-36.8699"), ("CAB: 320", "323.13"),
    ("CAB: 0", "323.13"), ("CAB: 0.5", "323.13")])  # fmt: skip
def test_an_angle_over_the_negative_axis_is_told_within_a_turn(datum: str, made: str) -> None:
    text = f"points: {{A: [1, 2], B: [-2, 3], C: [-2, 1], D: [5, 2]}}\nangles: {{{datum}}}\n" + LOOP
    name, given = datum.split(": ")
    said = f"angle {name} is given as {given}, the coordinates make it {made}"
    assert_refused(text, Status.INCONSISTENT, said)


def test_a_guide_that_misses_its_point() -> None:
    joints = LOOP + "  - {slide: [4, 1], at: C, along: 30, through: A}\n"
    assert_refused(
        COORDINATES + joints, Status.INCONSISTENT, "C is ", "off its guide, the line through A along 30 deg"
    )
    joints = LOOP + "  - {slide: [4, 1], at: C, along: [A, D]}\n"
    assert_refused(
        COORDINATES + joints, Status.INCONSISTENT, "C is 2.47 m off its guide, the line through A along AD"
    )


def test_data_that_contradict_the_construction() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, BD: 3.7") + "near: {C: [3.5, 2.4]}\n" + LOOP
    assert_refused(text, Status.INCONSISTENT, "angle AB is given as 60, the other data make it 65.5594")


def test_spare_data_that_agree_are_named_with_those_that_set_the_points() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, BD: 3.606") + "near: {C: [3.5, 2.4]}\n" + LOOP
    figure, _ = solved(text)
    (note,) = figure.notes
    assert "set by the coordinates and lengths AB, BC, BD, CD" in note
    assert "only compared: angle AB = 60 (off by 0.000467013 m)" in note


def test_coordinates_outrank_lengths_and_lengths_angles() -> None:
    figure, at = solved(COORDINATES + "lengths: {AB: 1, BC: 3.5}\nangles: {AB: 60}\n" + LOOP)
    assert at["B"] == (0.5, 0.866)
    assert "set by the coordinates; only compared: length AB = 1" in figure.notes[0]


def test_a_spare_datum_is_held_to_its_own_decimals() -> None:
    """0.0004 off: half units of 2.500 and of the coordinates allow it; those of 2.50000 do not 0.003."""
    solved(COORDINATES + "lengths: {CD: 2.500}\n" + LOOP)
    precise = COORDINATES.replace("3.611, 2.47", "3.61110, 2.47300").replace("[4, 0]", "[4.00000, 0.00000]")
    assert_refused(precise + "lengths: {CD: 2.50000}\n" + LOOP, Status.INCONSISTENT, "CD is given as 2.5, ")


def test_a_spare_datum_is_held_to_the_size_of_the_figure() -> None:
    """Half a unit of 3 is 0.5; 0.2 % of a figure of size 3 is 0.006."""
    text = "points: {A: [0, 0], B: [3.005, 0], C: [1, 1]}\nlengths: {AB: 3}\n" + PINS
    solved(text)
    assert_refused(
        text.replace("3.005", "3.01"), Status.INCONSISTENT, "AB is given as 3, the coordinates make it 3.01"
    )


def test_spare_data_choose_between_two_ways() -> None:
    """The corner is only compared, yet it leaves one of the two ways."""
    text = FOUR_BAR.replace("AB: 60}", "AB: 60, DCB: -71.7}") + LOOP
    _, at = solved(text)
    assert at["C"][1] > 0.0


def test_coordinates_that_cannot_draw_the_figure() -> None:
    text = (
        "points: {A: [1e17, 0], D: [100000000000000001, 5]}\nlengths: {AB: 1, BC: 3}\nangles: {AB: 60}\n"
        + PINS
    )
    assert_refused(text, Status.NEAR_SINGULAR, "cannot resolve the figure", "near 1e+17", "16 apart")
    text = "points: {A: [1e15, 0], D: [1e15, 0.5]}\nlengths: {AB: 0.1, BC: 0.3}\nangles: {AB: 60}\n" + PINS
    assert_refused(text, Status.NEAR_SINGULAR, "cannot resolve the figure", "0.125 apart", "size is 0.5")


@pytest.mark.parametrize("unit", ["1", "1e-18"])
def test_lengths_alone_lie_nowhere_however_small(unit: str) -> None:
    text = f"lengths: {{AB: {unit}, BC: {unit}, CA: {unit}}}\n" + PINS
    assert_refused(text, Status.UNDERDETERMINED, "nothing fixes where the figure of A, B and C lies")


def test_two_points_that_become_one() -> None:
    text = "points: {A: [1e15, 0], B: [1000000000000000.01, 0], C: [1e15, 900]}\n" + PINS
    assert_refused(text, Status.NEAR_SINGULAR, "A and B are different numbers")


def test_one_point_by_two_names_is_allowed() -> None:
    _, at = solved("points: {A: [1, 2], B: [1.0, 2.00], C: [4, 4]}\n" + PINS)
    assert at["A"] == at["B"]


@pytest.mark.parametrize("pin", ["A", "E"])
def test_a_direction_between_points_that_coincide(pin: str) -> None:
    """Where the frame has its origin, and apart from it."""
    text = "points: {A: [1, 1], B: [1, 1], E: [0, 0]}\nlengths: {BC: 2}\nangles: {ABC: 30}\n" + PINS
    text = text.replace("at: A", f"at: {pin}", 1)
    assert_refused(text, Status.CANNOT_ASSEMBLE, "C has no place", "from B to A, and these coincide")


def test_a_guide_between_points_that_coincide() -> None:
    text = "points: {A: [0, 0], C: [2, 1], D: [2, 1], P: [3, 1]}\njoints: [{pin: [1, 2], at: A}, "
    text += "{slide: [3, 2], at: P, along: [C, D]}]\n"
    assert_refused(text, Status.INCONSISTENT, "the guide of P has no direction: CD are one point")


def test_too_many_open_branches() -> None:
    names = [f"P{k}" for k in range(40)]
    lengths = ", ".join(f"{a}-{b}: 1.1" for a, b in zip(names[2:], names[1:], strict=False))
    lengths += ", " + ", ".join(f"{a}-{b}: 1.7" for a, b in zip(names[2:], names, strict=False))
    text = (
        f"points: {{P0: [0, 0], P1: [1, 0]}}\nlengths: {{{lengths}}}\n"
        f"links: {{2: [{', '.join(names)}]}}\njoints:\n  - {{pin: [1, 2], at: P0}}\n"
    )
    assert_refused(text, Status.AMBIGUOUS, "too many open branches", "near:", "P39")


@pytest.mark.parametrize(
    ("angles", "lengths"),
    [
        ("{AB: 20, BAG: 0}", "{AG: 4}"),  # G by the direction of AB, which the corner then tells again
        ("{AB: 20, CAB: 15, BAC: -15}", "{AC: 2}"),
    ],
)
def test_a_direction_told_twice_does_not_place_a_point(angles: str, lengths: str) -> None:
    text = f"points: {{A: [0, 0]}}\nlengths: {lengths}\nangles: {angles}\njoints: [{{pin: [1, 2], at: A}}]\n"
    for near in ("", "near: {B: [3, 1]}\n"):
        lacks = "B: one more length, angle or coordinate"
        assert_refused(near + text, Status.UNDERDETERMINED, lacks, wanted=["A", "B"])


def test_no_points_are_called_in_line_that_are_not() -> None:
    """A plate on three legs of length 1 whose lines meet in (4, 4): that is singular, and no loop is flat."""
    text = """icsolve: 1
points: {A: [0, 0], D: [7, 0], E: [4, -0.9]}
lengths: {AB: 1, BP: 1, DQ: 1, ER: 1, PQ: 4.8, PR: 2.5, QR: 2.5}
angles: {AB: 0}
near: {P: [1.6, 0.8], Q: [6.4, 0.8], R: [4, 0.1]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: P}
  - {pin: [1, 5], at: D}
  - {pin: [5, 4], at: Q}
  - {pin: [1, 6], at: E}
  - {pin: [6, 4], at: R}
loads: {W: {force: 10, link: 4, at: P, angle: -70}, T: {torque: unknown, link: 2}}
"""
    with pytest.raises(SceneError) as refused:
        icsolve.solve(icsolve.load(text))
    assert refused.value.status == Status.NEAR_SINGULAR
    assert "one line" not in refused.value.message


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("off", [7.0, 0.0])
def test_a_point_next_to_nothing_beside_the_figure_is_refused_wherever_the_figure_lies(
    axis: int, off: float
) -> None:
    """Seen from the first pin, of which one coordinate is not zero."""
    places = {"A": [0.0, 0.0], "B": [1e-150, 0.0], "C": [3.0, 2.0], "D": [4.0, 1.0]}
    turned = ((p, [x, y + off][:: 1 - 2 * axis]) for p, (x, y) in places.items())
    text = f"points: {{{', '.join(f'{p}: {at}' for p, at in turned)}}}\n" + LOOP
    assert_refused(text, Status.NEAR_SINGULAR, "point B, with 1e-150, cannot be told from nothing")


@pytest.mark.parametrize(
    ("second", "carrier", "mends"),
    [
        ("{pin: [1, 2], at: C}", "", "let one pin join each of them to their carrier"),
        ("{pin: [1, 2], at: C}", ", carrier: 1", "let one pin join each of them to their carrier"),
        ("{pin: [4, 2], at: C}\n  - {pin: [4, 3], at: D}", "", "give `carrier:` the link"),
    ],
)
def test_wheels_with_several_pairs_of_pins_are_told_what_would_mend_them(
    second: str, carrier: str, mends: str
) -> None:
    """Two pins between a wheel and its carrier are no choice of a carrier, whether that is given or not."""
    text = f"""icsolve: 1
points: {{A: [0, 0], B: [3, 0], C: [1, 1], D: [2, 1]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {second}
  - {{gears: [2, 3], teeth: [20, 40]{carrier}}}
loads: {{T: {{torque: unknown, link: 2}}, Q: {{torque: 5, link: 3}}}}
"""
    with pytest.raises(SceneError) as refusal:
        icsolve.solve(icsolve.load(text))
    assert refusal.value.status == Status.AMBIGUOUS
    assert mends in refusal.value.message
