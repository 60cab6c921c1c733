"""What a question tells: all that its answer hangs on, in words."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import icsolve
from cams import sliding, table
from grade_shell import CASES
from icsolve.case import Coordinates
from icsolve.explain.document import AsText, Document
from icsolve.explain.given import asked_section, given_section
from icsolve.explain.worked import Worked
from icsolve.grade.one import Task
from icsolve.numbers.units import Number, numbers_in
from icsolve.report.derivation.known import Known
from icsolve.sweep.varied_numbers import numbers_of
from icsolve.wording.statement import Statement
from sizes import sampled


def rows(name: str) -> dict[str, str]:
    (path,) = CASES.glob(f"**/{name}.yaml")
    return dict(Statement(icsolve.load(path)).rows())


@pytest.mark.parametrize(
    ("case", "name", "value"),
    [
        ("epicyclic_train", "links 3 and 1 are gears", "18 and 60 teeth, one of them internal"),
        ("belt_crossed", "a belt runs over links 2 and 3", "crossed, on radii 60 and 150 mm"),
        (
            "13_18_slider_crank_friction_everywhere",
            "a pin joins links 2 and 3 at B",
            "mu = 0.15, pin radius 0.9 in",
        ),
        (
            "13_18_slider_crank_friction_everywhere",
            "link 4 slides on link 1 at C",
            "along 0 deg, through A, mu = 0.15",
        ),
        ("13_18_slider_crank_friction_everywhere", "Link 2 turns", "counterclockwise"),
        ("flat_follower", "links 2 and 3 touch at K", "common normal at 90 deg"),
        ("given_centres", "the centre of links 1 and 3 is known", "at infinity at 90 deg"),
        ("given_centres", "the centre of links 2 and 6 is known", "at (2, 3) m"),
        ("rolling/rolling_disk", "links 2 and 1 roll on each other without slip at K", "radii 300 and 0 mm"),
        ("wedge", "link 3 slides on link 2 at C", "along 15 deg"),
        ("geneva", "a pin of link 2 runs in a slot of link 3 at B", "along DB"),
        (
            "13_23_spur_gears",
            "links 2 and 3 are gears",
            "31 and 57 teeth, pressure angle 20 deg, diametral pitch 16 a in",
        ),
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
    found = dict(Statement(sliding(cam, follower)).rows())
    assert (found["profile of link 2"], found["profile of link 3"]) == told


def test_an_unknown_spring_tells_its_free_length_and_ends() -> None:
    (told,) = [value for name, value in rows("balanced_arm").items() if "free length" in value]
    assert told.startswith("spring of a stiffness to be found, on link")


HELICAL = """\
icsolve: 1
units: {length: mm, force: N}
gravity: 1.62 m/s^2
points: {A: [0, 0], B: [60, 0], G: [80, 10]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, 40], helix angle: 25, bearing span: 55, normal pressure angle: 21, SIZE}
loads:
  M: {mass: 3 kg, link: 3, at: G}
  T: {torque: unknown, link: 2}
"""
IN_SPACE = """\
icsolve: 1
units: {length: mm, force: N}
gravity: {size: 3.7 m/s^2, along: [0, -3, 4]}
points: {A: [0, 0, 11], B: [0, 0, 12], C: [0, 61, 13], D: [0, 62, 14], E: [70, 15, 16], F: [71, 17, 18]}
joints:
  - {thrust: [1, 2], at: A, axis: z}
  - {radial: [1, 2], at: B, axis: [A, B]}
  - {thrust: [1, 3], at: C, axis: z}
  - {radial: [1, 3], at: D, axis: z}
loads:
  R: {force: [-41, 502, 7], link: 2, at: E}
  S: {spring: 2.5 N/mm, free: 640 mm, link: 2, at: E, to: F, against: 3}
  U: {spring: 3.5 N/mm, free: 650 mm, link: 2, at: E, to: [33, 34, 35]}
  M: {mass: 9 kg, link: 2, at: [44, 45, 46]}
  V: {torque: [21, 22, 23], link: 3, against: 2}
  Q: {torque: unknown, link: 3, along: z}
  L: {torque: {like: Q, times: 0.53}, link: 2, along: z}
  K: {torque: unknown, link: 2, along: z, against: 3}
"""
HOB = """\
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0, -50], B: [0, 0, 51], C: [0, 0, 0], D: [90, 0, 0]}
joints:
  - {thrust: [1, 2], at: A, axis: z}
  - {radial: [1, 2], at: B, axis: z}
  - {gears: [2, 1], teeth: 23, at: C, toward: x, axis: z, SIZE}
loads:
  T: {torque: 7, link: 2, along: z}
"""
SECTION = "normal pressure angle: 21, helix angle: 26, hand: left, normal module: 2.75"
MADE = {
    "normal module": HELICAL.replace("SIZE", "normal module: 1.8126155740733"),
    "transverse pitch": HELICAL.replace("SIZE", "transverse diametral pitch: 0.5"),
    "space": IN_SPACE,
    "hob": HOB.replace("SIZE", SECTION),
    "hob of inches": HOB.replace("SIZE", "pressure angle: 24, diametral pitch: 0.125"),
}


def asked_of(case: icsolve.Case, *, digits: int = 8) -> tuple[Worked, str]:
    """What the worked solution and a sheet tell before they ask, and that."""
    places = {
        n: (p.x.value, p.y.value)
        for n, p in case.points.items()
        if isinstance(p, Coordinates) and p.x and p.y
    }
    work = Worked(Known(case, None, None, None, places, {}, 0.0), digits, 0.0)
    return work, AsText().whole(Document("", (), (given_section(work), asked_section(work))))


def missing(case: icsolve.Case, work: Worked, said: str) -> set[Number]:
    """The numbers of a case that no words of it are, as written or in case units."""
    numbers = [number for path, number in numbers_of(case).items() if path != "gravity"]
    if case.space is not None:  # a direction by components is told by those of its unit vector
        given = numbers_in(case.space)
        numbers += [number for number in given if number.path and ".along." not in number.path]
    if any(getattr(load, "mass", False) for load in (*case.loads, *(case.space or case).loads)):
        numbers.append(case.gravity)
    words = set(re.findall(r"[-+.\w]+", said))
    gone = set()
    for number in numbers:
        forms = {number.digits, number.digits.lstrip("-+"), work.number(number.value).digits}
        forms |= {f"{number.value:.10g}", f"{abs(number.value):.10g}"}
        gone |= set() if forms & words else {number}
    return gone


@sampled(3)
@pytest.mark.parametrize("path", sorted(CASES.rglob("*.yaml")), ids=lambda path: path.stem)
def test_every_number_of_a_case_is_told(path: Path) -> None:
    """Each number that the file gives stands in some row, as written or in case units, under a question and
    in the worked solution, there to its digits."""
    case = icsolve.load(path)
    work, solution = asked_of(case)
    assert not missing(case, work, solution)
    if case.space is None:
        assert not missing(case, work, " ".join(f"{name} {value}" for name, value in Statement(case).rows()))


@pytest.mark.parametrize("name", MADE)
def test_every_number_that_an_answer_hangs_on_is_told(name: str) -> None:
    """Of helical teeth and of gravity, in the plane and in space; there also of springs and of loads at no
    named point, which links and loads they go with, and which sections numbers of teeth belong to."""
    case = icsolve.load(MADE[name])
    work, solution = asked_of(case)
    assert not missing(case, work, solution)
    told = " ".join(solution.split())
    if case.space is None:
        assert not missing(case, work, " ".join(f"{name} {value}" for name, value in Statement(case).rows()))
        assert (
            "normal pressure angle 21 deg" in told and f"{MADE[name].split(', ')[-1].split(':')[0]} " in told
        )
    if name == "space":
        for words in ("E against link 3", "to F, free", "0.53 times as large as Q"):
            assert words in told
    if name == "hob":
        for words in ("23 teeth on link 2", "normal module 2.75 mm", "left-handed", "its mate toward x"):
            assert words in told


@pytest.mark.parametrize(
    ("speed", "told"),
    [
        ("290 rpm", "at 290 rpm, counterclockwise"),
        ("-290 rpm", "at 290 rpm, clockwise"),
        ("30 rad/s", "at 30 rad/s, "),
    ],
)
def test_a_speed_is_told_in_the_unit_in_which_it_is_given(speed: str, told: str) -> None:
    text = (CASES / "dynamics" / "slider_crank_piston.yaml").read_text()
    case = icsolve.load(re.sub(r"speed: [^,}\n]+", f"speed: {speed}", text))
    assert told in " ".join(value for _, value in Statement(case).rows())


HELD = """\
icsolve: 1
points: {O: [0, 0], P: [1.8, -0.3]}
lengths: {OQ: 2.6}
angles: {OQ: 25}
joints:
  - {pin: [1, body], at: O}
  - {pin: [body, 3], at: Q}
loads:
  W: {weight: 100, link: body, at: Q}
  P: {force: unknown, link: body, at: Q, %s}
  K: {torque: unknown, link: 3}

"""


@pytest.mark.parametrize(
    ("what", "heading", "asked"),
    [
        ("P", "away: P", "Find P in N (positive away from P)."),
        ("P", "toward: P", "Find P in N (positive toward P)."),
        ("P", "angle: 30", "Find P in N (positive at 30 deg from +x)."),
        ("F1-body", "away: P", "Find the size of F1-body in N."),
        ("v Q on body", "away: P", "Find the size of v Q on body in m/s."),
    ],
)
def test_a_question_tells_no_direction_that_is_to_be_found(
    what: str, heading: str, asked: str, tmp_path: Path
) -> None:
    """That of a line through two points, of a reaction, or of a velocity is half of the task."""
    (tmp_path / "held.yaml").write_text(HELD % heading)
    assert Task(tmp_path / "held.yaml").asked(what) == asked
