"""What a question tells: all that its answer hangs on, in words."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import icsolve
from cams import sliding, table
from grade_shell import CASES
from icsolve.grade.platforms.given import given
from icsolve.sweep.numbers import numbers_of


def rows(name: str) -> dict[str, str]:
    (path,) = CASES.glob(f"**/{name}.yaml")
    return dict(given(icsolve.load(path)))


@pytest.mark.parametrize(
    ("case", "name", "value"),
    [
        ("epicyclic_train", "gears 3-1", "18 and 60 teeth, one of them internal"),
        ("belt_crossed", "belt 2-3", "crossed, on radii 60 and 150 mm"),
        ("13_18_slider_crank_friction_everywhere", "friction 2-3 at B", "mu = 0.15, pin radius 0.9 in"),
        ("13_18_slider_crank_friction_everywhere", "friction 4-1 at C", "mu = 0.15"),
        ("13_18_slider_crank_friction_everywhere", "link 2 turns", "counterclockwise"),
        ("flat_follower", "contact 2-3 at K", "normal at 90 deg"),
        ("given_centres", "centre 1-3", "at infinity at 90 deg"),
        ("given_centres", "centre 2-6", "(2, 3) m"),
        ("rolling/rolling_disk", "links 2 and 1", "roll without slip at K, radii 300 and 0 mm"),
        ("wedge", "block of link 3 at C", "slides in link 2 at 15 deg"),
        ("geneva", "pin of link 2 at B", "slides in link 3 along D-B"),
        ("13_23_spur_gears", "gears 2-3", "31 and 57 teeth, pressure angle 20 deg, diametral pitch 16 a in"),
    ],
)
def test_joints_and_motion_are_told(case: str, name: str, value: str) -> None:
    assert rows(case)[name] == value


@pytest.mark.parametrize(
    ("cam", "follower", "told"),
    [
        ("{circle: C, radius: 40}", "{flat: B, along: 0}", (
            "circle about C, radius 40 mm",
            "flat face through B, along 0 deg",
        )),
        (table([(0, 30), (90, 35), (180, 30), (270, 25)]), "{roller: B, radius: 10}", (
            "radii about A in mm, counterclockwise from A-C: 0 deg: 30, 90 deg: 35, 180 deg: 30, 270 deg: 25",
            "roller about B, radius 10 mm",
        )),
        ("{circle: C, radius: 40}", "{knife: B}", ("circle about C, radius 40 mm", "knife edge at B")),
    ],
)  # fmt: skip
def test_profiles_are_told(cam: str, follower: str, told: tuple[str, str]) -> None:
    found = dict(given(sliding(cam, follower)))
    assert (found["profile of link 2"], found["profile of link 3"]) == told


def test_an_unknown_spring_tells_its_free_length_and_ends() -> None:
    (told,) = [value for name, value in rows("balanced_arm").items() if "free length" in value]
    assert told.startswith("stiffness to be found, free length")


@pytest.mark.parametrize("path", sorted(CASES.rglob("*.yaml")), ids=lambda path: path.stem)
def test_every_number_of_a_plane_case_is_told(path: Path) -> None:
    """Each number that the file gives stands in some row, as written or in case units."""
    case = icsolve.load(path)
    if case.space is not None:
        pytest.skip("in space")
    said = " ".join(f"{name} {value}" for name, value in given(case))
    words = set(re.findall(r"[-+.\w]+", said))
    for place, number in numbers_of(case).items():
        if place == "gravity":
            continue
        forms = {number.digits, number.digits.lstrip("-+")}
        forms |= {f"{number.value:.10g}", f"{abs(number.value):.10g}"}
        assert forms & words, (place, number)
