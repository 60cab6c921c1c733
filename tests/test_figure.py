"""Figures with a position in closed form: each kind of datum and each kind of construction."""

from __future__ import annotations

import math

import pytest

from icsolve.assembly import Figure, case_point, solve_figure
from icsolve.assembly.refusals import step_words
from icsolve.case import Case
from icsolve.read import load

PINS = "joints:\n" + "".join(
    f"  - {{pin: [{k}, {k + 1}], at: {p}}}\n" for k, p in ((1, "A"), (2, "B"), (3, "C"))
)
LOOP = PINS + "  - {pin: [4, 1], at: D}\n"
FOUR_BAR = "points: {A: [0, 0], D: [4, 0]}\nlengths: {AB: 1, BC: 3.5, CD: 2.5}\nangles: {AB: 60}\n"


def case(text: str) -> Case:
    return load("icsolve: 1\n" + text)


def solved(text: str, wanted: list[str] | None = None) -> tuple[Figure, dict[str, tuple[float, float]]]:
    figure = solve_figure(case(text), wanted)
    return figure, {p: case_point(figure.frame, at) for p, at in figure.points.items()}


def assert_at(found: tuple[float, float], x: float, y: float) -> None:
    """To a few roundings of a figure of size 10 at most."""
    assert math.dist(found, (x, y)) < 1e-14, found


def test_four_bar_from_its_lengths_as_in_the_format_page() -> None:
    figure, at = solved(FOUR_BAR + "near: {C: [3.5, 2.4]}\n" + LOOP)
    assert_at(at["B"], 0.5, math.sqrt(3) / 2)
    assert math.dist(at["B"], at["C"]) == pytest.approx(3.5, rel=1e-15)
    assert math.dist(at["D"], at["C"]) == pytest.approx(2.5, rel=1e-15)
    assert at["C"][1] > 0.0
    assert [step_words(step).split(":")[0] for step in figure.steps] == ["A, D", "B", "C"]
    assert figure.skipped == ()
    assert figure.notes == ()


def test_near_takes_the_crossed_assembly() -> None:
    _, at = solved(FOUR_BAR + "near: {C: [3, -1]}\n" + LOOP)
    assert at["C"][1] < 0.0


def test_rhombus_of_sides_five_on_a_diagonal_of_six() -> None:
    """Two 3-4-5 triangles: B is 4 above the middle of the diagonal."""
    _, at = solved("points: {A: [0, 0], C: [6, 0]}\nlengths: {AB: 5, BC: 5}\nnear: {B: [3, 1]}\n" + PINS)
    assert_at(at["B"], 3.0, 4.0)


def test_ray_gives_length_and_side_without_near() -> None:
    """E on the prolongation of CD (CDE: 0 puts it back on the ray from D through C)."""
    _, at = solved(
        "points: {A: [0, 0], B: [0, 1], C: [0, 3]}\nlengths: {BE: 0.5}\nangles: {CBE: 0}\nlinks: {3: [E]}\n"
        + PINS
    )
    assert_at(at["E"], 0.0, 1.5)


@pytest.mark.parametrize("turn", [0, 360, -720])
def test_angles_are_any_real_number(turn: int) -> None:
    _, at = solved(
        f"points: {{A: [0, 0]}}\nlengths: {{AB: 2, BC: 1}}\nangles: {{AB: {30 + turn}, ABC: {turn + 90}}}\n"
        + PINS
    )
    assert_at(at["B"], math.sqrt(3), 1.0)
    # at B, from BA (210 deg) ccw by 90: 300 deg
    assert_at(at["C"], math.sqrt(3) + 0.5, 1.0 - math.sqrt(3) / 2)


def test_longer_names_and_pairs_in_the_other_order() -> None:
    _, at = solved(
        "points: {O2: [0, 0], O4: [6, 0]}\nlengths: {A-O2: 5, A-O4: 5}\nangles: {A-O2: 233.13010235415598}\n"
        "joints:\n  - {pin: [1, 2], at: O2}\n  - {pin: [2, 3], at: A}\n  - {pin: [3, 1], at: O4}\n"
    )
    assert_at(at["A"], 3.0, 4.0)


SLIDER = "points: {A: [0, 0]}\nlengths: {AB: 1, BC: 3}\nangles: {AB: 60}\nnear: {C: [3, 0]}\n"


def test_in_line_slider_crank() -> None:
    _, at = solved(SLIDER + PINS + "  - {slide: [4, 1], at: C, along: 0, through: A}\n")
    assert_at(at["C"], 0.5 + math.sqrt(9 - 0.75), 0.0)


@pytest.mark.parametrize("along", ["180", "[A, G]", "[G, A]"])
def test_guide_by_its_angle_modulo_180_or_by_two_of_its_points(along: str) -> None:
    text = SLIDER.replace("points: {A: [0, 0]", "points: {A: [0, 0], G: [7, 0]")
    _, at = solved(text + PINS + f"  - {{slide: [4, 1], at: C, along: {along}, through: A}}\n")
    assert_at(at["C"], 0.5 + math.sqrt(8.25), 0.0)


def test_offset_slider_crank_through_another_point_of_the_guide() -> None:
    text = SLIDER.replace("A: [0, 0]", "A: [0, 0], G: [-2, 0.5]")
    _, at = solved(text + PINS + "  - {slide: [4, 1], at: C, along: 0, through: G}\n")
    assert_at(at["C"], 0.5 + math.sqrt(9 - (math.sqrt(3) / 2 - 0.5) ** 2), 0.5)


def test_offset_slider_crank_with_an_unknown_coordinate() -> None:
    text = SLIDER.replace("A: [0, 0]", "A: [0, 0], C: [unknown, 0.5]")
    _, at = solved(text + PINS + "  - {slide: [4, 1], at: C, along: 0}\n")
    assert_at(at["C"], 0.5 + math.sqrt(9 - (math.sqrt(3) / 2 - 0.5) ** 2), 0.5)


def test_a_guide_and_a_coordinate_that_are_one_line_leave_the_length_to_decide() -> None:
    text = SLIDER.replace("A: [0, 0]", "A: [0, 0], C: [unknown, 0]")
    _, at = solved(text + PINS + "  - {slide: [4, 1], at: C, along: 0, through: A}\n")
    assert_at(at["C"], 0.5 + math.sqrt(8.25), 0.0)


def test_elliptic_trammel_from_length_and_direction() -> None:
    """Each end has one coordinate; their vector carries the locus of the one to the other."""
    figure, at = solved(
        "points: {A: [unknown, 0], B: [0, unknown]}\nlengths: {AB: 2}\nangles: {AB: 150}\njoints:\n"
        "  - {slide: [2, 1], at: A, along: 0}\n  - {slide: [3, 1], at: B, along: 90}\n"
        "  - {pin: [2, 4], at: A}\n  - {pin: [3, 4], at: B}\n"
    )
    assert_at(at["A"], math.sqrt(3), 0.0)
    assert_at(at["B"], 0.0, 1.0)
    assert figure.notes == ()


INVERTED = "points: {A: [0, 0], C: [0, -2]}\nlengths: {AB: 2, CD: 4}\nangles: {AB: 0}\n"
ROCKER = (
    "joints:\n  - {pin: [1, 2], at: A}\n  - {pin: [2, 3], at: B}\n"
    "  - {slide: [3, 4], at: B, along: [C, D]}\n  - {pin: [4, 1], at: C}\n"
)


@pytest.mark.parametrize("said", ["near: {D: [3, 3]}\n", "near: {D: [-3, -3]}\n"])
def test_inverted_slider_crank_whose_rocker_points_along_its_guide(said: str) -> None:
    _, at = solved(INVERTED + said + ROCKER + "links: {4: [D]}\n")
    s = math.copysign(math.sqrt(8), at["D"][0])
    assert (at["D"][0] > 0) == ("[3" in said)
    assert_at(at["D"], s, s - 2.0)


def test_inverted_slider_crank_by_the_angle_of_its_rocker() -> None:
    _, at = solved(INVERTED.replace("AB: 0}", "AB: 0, BCD: 0}") + ROCKER + "links: {4: [D]}\n")
    assert_at(at["D"], math.sqrt(8), math.sqrt(8) - 2.0)


def test_guide_of_a_moving_link_that_passes_its_pivot_at_a_distance() -> None:
    """The guide through E is parallel to CD, 2 from the pivot C; B is sqrt(8) from C: 45 degrees between."""
    text = INVERTED.replace("CD: 4}", "CD: 4, CE: 2}").replace("AB: 0}", "AB: 0, DCE: 90}")
    joints = ROCKER.replace("[C, D]}", "[C, D], through: E}")
    figure, at = solved(text + "near: {D: [4, -2]}\n" + joints)
    assert_at(at["D"], 4.0, -2.0)
    assert_at(at["E"], 0.0, 0.0)
    assert not any("Newton" in step_words(step) for step in figure.steps)


def test_rod_to_a_block_whose_pin_stands_off_the_guide() -> None:
    """F on the block is at a known vector from C on the guide: the guide's line is carried to F."""
    figure, at = solved(
        "points: {A: [0, 0]}\nlengths: {AF: 5, CF: 3}\nangles: {CF: 90}\nnear: {F: [4, 3]}\njoints:\n"
        "  - {pin: [1, 2], at: A}\n  - {pin: [2, 3], at: F}\n"
        "  - {slide: [3, 1], at: C, along: 0, through: A}\n"
    )
    assert_at(at["F"], 4.0, 3.0)
    assert_at(at["C"], 4.0, 0.0)
    assert figure.notes == ()


TRIANGLE = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (4.0, 3.0)}


@pytest.mark.parametrize("unknown", "ABC")
@pytest.mark.parametrize("corner", ["ABC: -90", "BCA: -53.13010235415598", "CAB: -36.86989764584402"])
def test_any_point_of_a_corner_may_be_the_unknown_one(unknown: str, corner: str) -> None:
    """The 3-4-5 triangle: a corner and one direction place the third point."""
    known = [p for p in "ABC" if p != unknown]
    far = next(p for p in known if p != corner[1])
    (ax, ay), (bx, by) = TRIANGLE[far], TRIANGLE[unknown]
    direction = math.degrees(math.atan2(by - ay, bx - ax))
    points = ", ".join(f"{p}: [{TRIANGLE[p][0]}, {TRIANGLE[p][1]}]" for p in known)
    _, at = solved(f"points: {{{points}}}\nangles: {{{corner}, {far}{unknown}: {direction}}}\n" + PINS)
    assert_at(at[unknown], *TRIANGLE[unknown])


def test_vertex_on_the_circle_of_its_inscribed_angle() -> None:
    """Thales: from the circle on AC as diameter, AC is seen under 90 degrees; y = 0.6 leaves two places."""
    text = "points: {A: [0, 0], C: [2, 0], B: [unknown, 0.6]}\nangles: {ABC: 90}\nnear: {B: [2, 1]}\n"
    _, at = solved(text + PINS)
    assert_at(at["B"], 1.8, 0.6)


def test_resection_of_a_point_from_three_known_ones() -> None:
    """Snellius and Pothenot: two angles between three sights. Here from a point of the lattice."""
    b, a, c, d = (1.0, 2.0), (0.0, 0.0), (4.0, 0.0), (5.0, 3.0)

    def sight(p: tuple[float, float], q: tuple[float, float]) -> float:
        return math.degrees(math.atan2(q[1] - b[1], q[0] - b[0]) - math.atan2(p[1] - b[1], p[0] - b[0]))

    _, at = solved(
        "points: {A: [0, 0], C: [4, 0], D: [5, 3]}\n"
        f"angles: {{ABC: {sight(a, c)!r}, CBD: {sight(c, d)!r}}}\nlinks: {{3: [D]}}\n" + PINS
    )
    assert math.dist(at["B"], b) < 1e-13


def test_directions_that_corners_carry_along_a_chain() -> None:
    """A regular hexagon from one side's direction, its length and the corners alone."""
    names = "ABCDEF"
    lengths = ", ".join(f"{names[k]}{names[(k + 1) % 6]}: 1" for k in range(5))
    corners = ", ".join(f"{names[k]}{names[k + 1]}{names[k + 2]}: -120" for k in range(4))
    _, at = solved(
        f"points: {{A: [0, 0]}}\nlengths: {{{lengths}}}\nangles: {{AB: 0, {corners}}}\n"
        "links: {2: [D, E, F]}\n" + PINS
    )
    assert_at(at["F"], -0.5, math.sqrt(3) / 2)


def test_law_of_cosines_where_a_rigid_link_stands_in_the_middle_of_a_chain() -> None:
    """BE and EC with their corner make BC; a right angle: legs 3 and 4 make 5."""
    figure, at = solved(
        "points: {A: [0, 0], D: [6, 0]}\nlengths: {BE: 3, EC: 4, AB: 1, CD: 5}\nangles: {AB: 180, BEC: 90}\n"
        "near: {C: [4, 4]}\n" + LOOP + "links: {3: [E]}\n"
    )
    assert math.dist(at["B"], at["C"]) == pytest.approx(5.0, rel=1e-15)
    assert math.dist(at["B"], at["E"]) == pytest.approx(3.0, rel=1e-15)
    cross = (at["B"][0] - at["E"][0]) * (at["C"][1] - at["E"][1]) - (at["B"][1] - at["E"][1]) * (
        at["C"][0] - at["E"][0]
    )
    assert cross == pytest.approx(12.0, rel=1e-14)
    assert figure.notes == ()


def test_a_straight_rigid_link_loses_no_digits_to_a_flat_triangle() -> None:
    """With BEC: 180 the circles about B and C touch at E; the shape carries E instead."""
    _, at = solved(
        "points: {A: [0, 0], D: [4, 0]}\nlengths: {AB: 1, BE: 1.5, EC: 2, CD: 2.5}\n"
        "angles: {AB: 60, BEC: 180}\n"
        "near: {C: [3.5, 2.4]}\n" + LOOP + "links: {3: [E]}\n"
    )
    (bx, by), (cx, cy) = at["B"], at["C"]
    assert math.dist(at["E"], (bx + 3 / 7 * (cx - bx), by + 3 / 7 * (cy - by))) < 1e-15


def test_centroid_of_a_triangle_and_midpoint() -> None:
    _, at = solved(
        "points: {A: [0, 0], B: [3, 0], C: [0, 6], G: {centroid: [A, B, C]}, M: {centroid: [A, B]}}\n"
        "links: {2: [G, M]}\n" + PINS
    )
    assert_at(at["G"], 1.0, 2.0)
    assert_at(at["M"], 1.5, 0.0)


def test_a_centroid_in_place_gives_the_point_that_it_leaves_open() -> None:
    _, at = solved(
        "points: {A: [0, 0], B: [3, 0], H: [1, 5], C: [unknown, 6], G: {centroid: [A, B, C]}}\n"
        "lengths: {HG: 3}\nangles: {HG: 270}\n"
        "links: {2: [G, H]}\n" + PINS
    )
    assert_at(at["G"], 1.0, 2.0)
    assert_at(at["C"], 0.0, 6.0)


def test_pose_by_the_third_point_of_a_shape() -> None:
    """Without any point of the crank given but C and a direction elsewhere on its link."""
    _, at = solved("points: {C: [1, 1]}\nlengths: {AB: 5, BC: 3, AC: 4}\nangles: {AB: 0, ACB: 90}\n" + PINS)
    assert math.dist(at["A"], at["B"]) == pytest.approx(5.0, rel=1e-15)
    assert at["A"][1] == pytest.approx(at["B"][1], abs=1e-14)
    assert at["C"][1] > at["A"][1] or at["C"][1] < at["A"][1]
    cross = (at["A"][0] - 1) * (at["B"][1] - 1) - (at["A"][1] - 1) * (at["B"][0] - 1)
    assert cross == pytest.approx(12.0, rel=1e-14)


def test_a_shape_is_placed_by_one_point_and_a_direction_elsewhere_in_it() -> None:
    """B is in place; the triangle BCE is known by two sides and a corner; only CE has a direction."""
    figure, at = solved(
        "points: {A: [0, 0], B: [1, 1]}\nlengths: {BC: 3, BE: 4}\nangles: {CBE: 90, CE: 180}\n"
        "links: {2: [B, C, E]}\n" + PINS
    )
    assert_at(at["C"], 1 + 9 / 5, 1 + 12 / 5)
    assert_at(at["E"], 1 - 16 / 5, 1 + 12 / 5)
    assert figure.notes == ()


def test_only_what_is_wanted_is_constructed() -> None:
    figure, at = solved(FOUR_BAR + "near: {C: [3, 2]}\n" + LOOP, ["B"])
    assert set(at) == {"A", "B"}
    assert figure.skipped == ("D", "C")


def test_points_that_nothing_asked_for_still_choose_the_branch() -> None:
    """The ray to E decides where C is, though E is not wanted."""
    text = FOUR_BAR.replace("CD: 2.5}", "CD: 2.5, CE: 1}").replace("AB: 60}", "AB: 60, CE: 90, DCE: -10}")
    c_up = math.degrees(math.atan2(-2.4695594179583695, 4 - 3.6110574834591604))
    text = text.replace("DCE: -10", f"DCE: {90 - c_up!r}")
    figure, at = solved(text + LOOP + "links: {3: [E]}\n", ["C"])
    assert at["C"][1] > 0
    assert "E" in figure.skipped


def test_coordinates_alone_need_no_construction() -> None:
    figure, at = solved("points: {A: [0, 0], B: [1, 2], C: [5, 3]}\n" + PINS)
    assert at == {"A": (0.0, 0.0), "B": (1.0, 2.0), "C": (5.0, 3.0)}
    assert len(figure.steps) == 1


def test_a_zero_is_positive() -> None:
    _, at = solved("points: {A: [0, 0]}\nlengths: {AB: 1, BC: 1}\nangles: {AB: 180, BC: 0}\n" + PINS)
    assert str(at["C"]) == "(0.0, 0.0)"
    assert str(at["B"]) == "(-1.0, 0.0)"


BUTTERFLY = {
    "A": (0.0, 0.0), "B": (1.6, -0.4), "C": (3.4, 0.3), "D": (-0.3, 1.1), "E": (0.9, 1.2),
    "F": (2.0, 2.6), "G": (1.5, 1.4), "H": (0.4, 2.4), "I": (3.1, 1.7), "J": (1.6, 3.7),
}  # fmt: skip
"""Pins 01, 04, 05, 16, 17, 23, 24, 26, 35, 37 of the double butterfly linkage."""


def butterfly(near: str) -> str:
    bars = ["AD", "AE", "BG", "CI", "DH", "EJ", "FG", "GH", "FH", "FI", "IJ", "FJ"]

    def length(bar: str) -> str:
        return f"{bar}: {math.dist(BUTTERFLY[bar[0]], BUTTERFLY[bar[1]])!r}"

    crank = math.degrees(math.atan2(1.1, -0.3))
    arms = math.degrees(math.atan2(1.2, 0.9)) - crank
    pins = {"A": "[0, 1]", "B": "[0, 4]", "C": "[0, 5]", "D": "[1, 6]", "E": "[1, 7]",
            "F": "[2, 3]", "G": "[2, 4]", "H": "[2, 6]", "I": "[3, 5]", "J": "[3, 7]"}  # fmt: skip
    return (
        "ground: 0\npoints: {A: [0, 0], B: [1.6, -0.4], C: [3.4, 0.3]}\n"
        f"lengths: {{{', '.join(map(length, bars))}}}\nangles: {{AD: {crank!r}, DAE: {arms!r}}}\n"
        f"{near}joints:\n" + "".join(f"  - {{pin: {links}, at: {p}}}\n" for p, links in pins.items())
    )


def test_double_butterfly_from_its_lengths() -> None:
    """Five pins and ten lengths that have no order of construction; near for one of them."""
    figure, at = solved(butterfly("near: {F: [2.05, 2.55]}\n"))
    assert max(math.dist(at[p], BUTTERFLY[p]) for p in BUTTERFLY) < 1e-13
    assert [len(step.targets) for step in figure.steps] == [3, 1, 1, 5]
