"""Symbols of the field: ropes round pulleys, screws, springs, spread loads, as textbooks draw them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
import shapely

import icsolve
from icsolve.draw import Drawing, draw
from pictures import SVG, Picture, circle, coordinates, parsed

CAMS = Path(__file__).parent.parent / "cases" / "cams"
OVER_A_PULLEY = """
icsolve: 1
points: {{A: [0, 0], P: [3, 2], B: [{x}, -1]}}
joints:
  - {{slide: [2, 1], at: A, along: 0}}
  - {{rope: [A, P, B], on: [2, 1]{more}}}
loads:
  Q: {{force: 80, link: 2, at: A, angle: 180}}
  W: {{force: unknown, at: B}}
"""
ROUND_A_POST = """
icsolve: 1
points: {A: [0.5, -2], O: [0, 0], B: [-3, 0.5]}
joints:
  - {slide: [2, 1], at: A, along: 90}
  - {rope: [A, O, B], on: [2, 1], radii: {O: 0.5}, wraps: {O: ccw}, mu: {O: 0.25}}
loads:
  W: {weight: 100, link: 2, at: A}
  F: {force: unknown, at: B}
motion: {point: A, link: 2, speed: 1, angle: 90}
"""
JACK = """
icsolve: 1
units: {{length: mm, force: N, torque: N*m}}
points: {{B: [0, 100]}}
joints:
  - {{screw: [1, 2], at: B, along: 90, lead: 5, radius: 10}}
loads:
  W: {{force: 1000, link: 2, at: B, angle: {angle}}}
  T: {{torque: unknown, screw: 1-2}}
"""
SPREAD = """
icsolve: 1
points: {A: [0, 0], B: [1, 1], C: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  p: {pressure: 8 kPa, bore: 50 mm, link: 4, at: C, angle: 180}
  q: {distributed: [50, 200 N/m], link: 3, from: B, to: C, angle: -90}
  S: {spring: 20 N*m/rad, corner: AB, free: 60, link: 2}
  T: {torque: unknown, link: 2}
"""


def drawn(text: str, **options: Any) -> Picture:
    return parsed(draw(icsolve.load(text), Drawing(centres="none", **options)))


def strokes(picture: Picture, name: str, kind: str) -> list[list[tuple[float, float]]]:
    """The corners of the lines of a class in a group."""
    group = next(e for e in picture.root.iter() if e.get("id") == name)
    return [list(coordinates(e)) for e in group.iter(f"{SVG}path") if e.get("class") == kind]


def nearest(line: Sequence[tuple[float, float]], p: tuple[float, float]) -> float:
    return min(math.dist(q, p) for q in line)


@pytest.mark.parametrize("x", [3.5, 2.6])
@pytest.mark.parametrize("more", ["", ", radii: {P: 0.4}, wraps: {P: cw}"])
def test_a_rope_touches_its_pulley_and_has_its_tension(x: float, more: str) -> None:
    """The line never enters the pulley, and lies on its rim between the straight parts."""
    picture = drawn(OVER_A_PULLEY.format(x=x, more=more))
    (line,) = strokes(picture, "rope-A-P-B", "rope")
    pulley = next(e for e in picture.root.iter(f"{SVG}circle") if e.get("class") == "body")
    centre = (float(pulley.attrib["cx"]), float(pulley.attrib["cy"]))
    radius = float(pulley.attrib["r"])
    arc = line[1:-1]
    assert len(arc) > 6
    assert all(math.dist(p, centre) == pytest.approx(radius, abs=0.02) for p in arc)
    answer = icsolve.solve(icsolve.load(OVER_A_PULLEY.format(x=x, more=more)), reactions=True)
    assert f"T = {answer.tensions[0].tension:.4g} N" in picture.texts("t-reaction")


def test_a_rope_that_slips_has_a_tension_on_each_side() -> None:
    picture = drawn(ROUND_A_POST, bodies=True)
    grown = 100.0 * math.exp(0.25 * math.pi / 2.0)
    assert {"T1 = 100 N", f"T2 = {grown:.4g} N"} <= set(picture.texts("t-reaction"))


@pytest.mark.parametrize("angle", [90, 270])
def test_a_torque_on_a_screw_is_told_by_its_sense_along_the_axis(angle: int) -> None:
    text = JACK.format(angle=angle)
    found = icsolve.solve(icsolve.load(text)).answers["T"]
    picture = drawn(text)
    assert any(said.endswith(f"N·m {found.sense}") for said in picture.texts("t-unknown"))
    assert len(strokes(picture, "screw-2-1", "hatch")) > 8


def test_spread_loads_are_rows_of_arrows() -> None:
    picture = drawn(SPREAD)
    assert len(strokes(picture, "load-p", "known-head")) == 3
    heads = strokes(picture, "load-q", "known-head")
    assert len(heads) > 4
    assert "q = 50 to 200 N/m" in picture.texts("t-known")
    (spiral,) = strokes(picture, "load-S", "spring")
    assert len(spiral) > 40
    assert "S: k = 20 N·m/rad" in picture.texts("t-known")


def test_concentric_wheels_of_one_link_are_all_drawn() -> None:
    """A differential hoist about the origin: both drums, and the pulley."""
    text = """
icsolve: 1
units: {length: mm, force: N}
points: {O: [0, 0], N: [0, 0], P: [10, -900], K: [-200, 0]}
joints:
  - {pin: [1, 2], at: O}
  - {slide: [3, 1], at: P, along: 90}
  - {rope: [O, P, N], on: [2, 3, 2], radii: {O: 200, P: 190, N: 180}, wraps: {O: cw, P: cw, N: cw}}
loads:
  W: {weight: 1000, link: 3, at: P}
  F: {force: unknown, link: 2, at: K, angle: -90}
"""
    rounds = [circle(e) for e in drawn(text).root.iter(f"{SVG}circle") if e.get("class") == "body"]
    radii = sorted(math.sqrt(one.area / math.pi) for one in rounds)
    assert [r / radii[-1] for r in radii] == pytest.approx([0.9, 0.95, 1.0], abs=1e-3)


WEDGE = """
icsolve: 1
points: {A: [0, 0], B: [60, 80], C: [60, 40]}
joints:
  - {slide: [2, 1], at: A, along: 0}
  - {slide: [3, 2], at: C, along: 15}
  - {slide: [3, 1], at: B, along: 90}
loads:
  W: {weight: 800, link: 3, at: B}
  P: {force: unknown, link: 2, at: A, angle: 180}
"""


def test_wedges_lie_between_the_planes_of_their_guides() -> None:
    """The face between them is one line at 15 degrees, the wedge lies on the level of its guide."""
    picture = drawn(WEDGE)
    faces = []
    for link in "23":
        (corners,) = strokes(picture, f"link-{link}", "body")
        edges = zip(corners, [*corners[1:], corners[0]], strict=True)
        slopes = {round(math.degrees(math.atan2(a[1] - b[1], b[0] - a[0])) % 180.0, 1) for a, b in edges}
        assert 15.0 in slopes and slopes <= {0.0, 15.0, 90.0, 180.0}
        faces.append([y + math.tan(math.radians(15.0)) * x for x, y in corners])
        assert not strokes(picture, f"link-{link}", "block")
    assert min(faces[0]) == pytest.approx(max(faces[1]), abs=0.1)


def test_what_its_contacts_touch_square_and_as_far_is_round() -> None:
    """Two smooth cylinders in a box, by the places where they touch: about the points where their weights
    act. A crate on two edges, as far from its weight, is not."""
    cylinders = """
icsolve: 1
points: {A: [0.3, 0.3], B: [0.7, unknown]}
lengths: {AB: 0.6, AF: 0.3, AL: 0.3, AT: 0.3, BR: 0.3}
angles: {AF: -90, AL: 180, BAT: 0, BR: 0}
near: {B: [0.7, 0.75]}
joints:
  - {contact: [1, 2], at: F, normal: 90}
  - {contact: [1, 2], at: L, normal: 0}
  - {contact: [2, 3], at: T, normal: 48.19}
  - {contact: [1, 3], at: R, normal: 180}
loads:
  W1: {weight: 100, link: 2, at: A}
  W2: {weight: 100, link: 3, at: B}
"""
    crate = """
icsolve: 1
points: {A: [0, 0], B: [0.6, 0], G: [0.3, 0.4]}
joints:
  - {contact: [1, 2], at: A, normal: 90}
  - {contact: [1, 2], at: B, normal: 90}
loads: {W: {weight: 500, link: 2, at: G}}
"""
    both = [drawn(text).root.iter(f"{SVG}circle") for text in (cylinders, crate)]
    circles, none = ([circle(e) for e in some if e.get("class") == "body"] for some in both)
    assert len(circles) == 2 and not none
    (left, right), (a, b) = [one.centroid for one in circles], [one.area for one in circles]
    assert a == pytest.approx(b, rel=1e-3)
    assert left.distance(right) == pytest.approx(2.0 * math.sqrt(a / math.pi), rel=0.01)


@pytest.mark.parametrize("end", [80, -80, 5])
@pytest.mark.parametrize("links", ["[2, 3]", "[3, 2]"])
def test_what_slides_on_the_frame_is_no_wheel(links: str, end: int) -> None:
    """A rack whose rod is pinned to it, wherever: the pinion alone is round, by its pin."""
    text = f"""
icsolve: 1
points: {{O: [0, 25], C: [0, 0], R: [{end}, 0], N: [{2 * end}, 40]}}
lengths: {{RK: 100, NK: 60}}
near: {{K: [{2 * end - 25}, -15]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{slide: [3, 1], at: R, along: 0}}
  - {{roll: {links}, at: C}}
  - {{pin: [3, 4], at: R}}
  - {{pin: [4, 5], at: K}}
  - {{pin: [5, 1], at: N}}
loads:
  M: {{torque: 80, link: 5}}
  T: {{torque: unknown, link: 2}}
"""
    picture = drawn(text)
    assert len([e for e in picture.root.iter(f"{SVG}circle") if e.get("class") == "body"]) == 1


@pytest.mark.parametrize("name", ["roller_follower", "offset_roller_follower", "tangent_cam", "square_cam"])
def test_no_hatching_runs_through_a_cam(name: str) -> None:
    """Rails of followers keep off cams and rollers; the block stands on a stem beyond the roller."""
    picture = parsed(draw(icsolve.load(CAMS / f"{name}.yaml"), Drawing(centres="none")))
    circles = [e for e in picture.root.iter(f"{SVG}circle") if e.get("class") == "body"]
    solids = [shapely.Polygon(corners) for e in "234" for corners in _bodies(picture, e) if len(corners) > 20]
    rails = [line for line in strokes(picture, "link-1", "frame") if abs(line[0][0] - line[-1][0]) < 0.1]
    assert rails
    for line in map(shapely.LineString, rails):
        assert not any(line.intersects(circle(e)) for e in circles)
        assert not any(line.intersects(solid) for solid in solids if solid.area > 2e4)


def _bodies(picture: Picture, link: str) -> list[list[tuple[float, float]]]:
    ids = {e.get("id") for e in picture.root.iter()}
    return strokes(picture, f"link-{link}", "body") if f"link-{link}" in ids else []
