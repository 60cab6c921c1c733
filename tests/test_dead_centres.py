"""Links that stand still: which centres on one line hold them, in words."""

from __future__ import annotations

from itertools import permutations

import pytest

import icsolve
from icsolve.errors import SceneError, Status
from sizes import sampled


def refused(text: str) -> str:
    with pytest.raises(SceneError) as caught:
        icsolve.solve(icsolve.load("icsolve: 1\n" + text))
    assert caught.value.status == Status.DEAD_CENTRE
    return caught.value.message


@pytest.mark.parametrize("names", [*permutations("234")])
@pytest.mark.parametrize("turned", [False, True])
def test_two_bars_in_line_are_a_dead_centre_of_the_third(names: tuple[str, ...], turned: bool) -> None:
    """With crank and rod in line the rocker rests, with rod and rocker in line the crank does."""
    crank, rod, rocker = names
    pairs = [("1", crank), (crank, rod), (rod, rocker), (rocker, "1")]
    joints = [
        f"{{pin: [{', '.join(pair[::-1] if turned else pair)}], at: {at}}}"
        for pair, at in zip(pairs, "ABCD", strict=True)
    ]
    for places, still, other, line in (
        ("A: [0, 0], B: [1, 1], C: [3, 3], D: [5, 0]", rocker, crank, "ABC"),
        ("A: [0, 0], B: [1, 2], C: [3, 1], D: [5, 0]", crank, rocker, "BCD"),
    ):
        for order in (joints, joints[::-1]):
            said = refused(
                f"points: {{{places}}}\njoints: [{', '.join(order)}]\n"
                f"loads: {{U: {{torque: unknown, link: {still}}}, K: {{torque: 5, link: {other}}}}}\n"
            )
            names_of = " and ".join([", ".join(line[:2]), line[2]])
            back = " and ".join([", ".join(line[:0:-1]), line[0]])
            assert any(
                f"link {still} stands still in this position ({one} lie on one line)" in said
                for one in (names_of, back)
            )


def test_a_bar_of_the_second_loop_rests_too() -> None:
    """The rocker of one four-bar drives another: D, E and F in line."""
    said = refused("""
points: {A: [0, 0], B: [1, 2], C: [4, 3], D: [5, 0], E: [6, 1], F: [8, 3], G: [10, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [4, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 1], at: G}
loads: {U: {torque: unknown, link: 6}, K: {torque: 5, link: 2}}
""")
    assert "link 6 stands still in this position (D, E and F lie on one line)" in said


@pytest.mark.parametrize(
    ("at", "along", "still", "other", "line"),
    [
        ("2, 2", "135", "3", "2", " (the normal to the slot at B passes through A)"),
        ("2, 2", "45", "2", "3", " (the normal to the slot at B passes through D)"),
    ],
)
def test_a_slot_square_to_the_pivot_s_line_holds_a_link(
    at: str, along: str, still: str, other: str, line: str
) -> None:
    said = refused(f"""
points: {{A: [0, 0], B: [{at}], D: [4, 0]}}
joints: [{{pin: [1, 2], at: A}}, {{slot: [2, 3], at: B, along: {along}}}, {{pin: [3, 1], at: D}}]
loads: {{U: {{torque: unknown, link: {still}}}, K: {{torque: 5, link: {other}}}}}
""")
    assert f"link {still} stands still in this position{line}" in said


@pytest.mark.parametrize(
    ("pin", "unknown", "known", "said"),
    [
        ("1, 0", "{force: unknown, link: 4, at: C, angle: 0}", "{torque: 5, link: 2}",
         "link 4 stands still in this position (A, B and C lie on one line)"),
        ("4, 2", "{torque: unknown, link: 2}", "{force: 5, link: 4, at: C, angle: 0}",
         "link 2 stands still in this position,"),
    ],
)  # fmt: skip
def test_a_slider_crank_at_its_dead_centres(pin: str, unknown: str, known: str, said: str) -> None:
    """A guide has no name: where its normal runs along the rod nothing is said of a line."""
    text = f"points: {{A: [0, 0], B: [{pin}], C: [4, 0]}}\njoints: [{{pin: [1, 2], at: A}}, "
    text += "{pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {slide: [4, 1], at: C, along: 0}]\n"
    assert said in refused(text + f"loads: {{U: {unknown}, K: {known}}}\n")


@pytest.mark.parametrize("on", ["3", "4"])
def test_a_load_of_nothing_by_components_says_what_one_by_its_size_says(on: str) -> None:
    """The slider of a crank in line with its rod."""
    text = """icsolve: 1
points: {{A: [0, 0], B: [1, 0], C: [4, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0}}
loads: {{U: {{torque: unknown, link: 4}}, K: {{force: {load}, link: {on}, at: C}}}}
"""
    said = []
    for load in ("[0, 0]", "0, angle: 30"):
        with pytest.raises(SceneError) as caught:
            icsolve.solve(icsolve.load(text.format(load=load, on=on)))
        said.append(str(caught.value))
    assert said[0] == said[1] and "(A, B and C lie on one line)" in said[0]


FOLDED = [
    "{torque: %s, link: 2}",
    "{torque: %s, link: 3}",
    "{torque: %s, link: 4, against: 2}",
    "{force: %s, link: 3, at: C, angle: 90}",
    "{force: %s, link: 3, at: G, angle: 90}",
    "{force: %s, link: 3, at: C, angle: 0}",
    "{force: %s, link: 2, at: H, angle: 30}",
    "{force: %s, link: 2, at: B, angle: 0}",
]


@sampled(3)
@pytest.mark.parametrize("unknown", FOLDED)
@pytest.mark.parametrize("known", FOLDED)
def test_a_parallelogram_has_one_verdict_folded_either_way(unknown: str, known: str) -> None:
    """Whichever two of its motions are found, and of whatever lengths it is."""
    verdicts = set()
    for angle, side in ((0, 1), (180, -1)):
        for crank, base in ((1.5, 1.2), (2, 4)):
            text = f"""icsolve: 1
points: {{A: [0, 0], D: [{base}, 0], G: {{centroid: [B, C]}}, H: {{centroid: [A, B]}}}}
lengths: {{AB: {crank}, BC: {base}, CD: {crank}}}
angles: {{AB: {angle}}}
near: {{C: [{base + side * crank}, 0]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{U: {unknown % "unknown"}, K: {known % 5}}}
"""
            try:
                icsolve.solve(icsolve.load(text))
                verdicts.add("ok")
            except SceneError as refusal:
                verdicts.add(str(refusal.status))
    assert len(verdicts) == 1, verdicts
