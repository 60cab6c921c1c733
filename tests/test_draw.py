"""Drawings: what they show of a case, where their labels stand, and what no text in a case can do to them.

Labels are measured by the widths that the drawing itself reckons with, which are wider than the usual
fonts need; `test_page.py` measures them again in a browser.
"""

from __future__ import annotations

import cmath
import math
import os
import re
import subprocess
import sys
from functools import cache
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any

import pytest
import shapely
import shapely.affinity

import icsolve
import loading
import mechanisms
import transcribe
from growth import random_mechanism
from icsolve.case import Case
from icsolve.draw import Drawing, draw
from icsolve.draw.figure import scene_of
from icsolve.draw.links import body_of
from icsolve.draw.scene import geneva_of
from icsolve.draw.space import flat, space_marks
from icsolve.draw.words import figure_number
from icsolve.errors import SceneError
from icsolve.explain import explain
from icsolve.report import answer_text
from icsolve.report.derivation.known import Known, known_of
from icsolve.report.derivation.ratios import needed_steps
from library import FILES, LIBRARY, sample
from pictures import SVG, Picture, coordinates, on_arrows, outside, overlaps, parsed, shapes
from sizes import FULL, few, sampled

ROOT = Path(__file__).parent.parent
FOUR = "ch13/13_08_four_bar.yaml"
OPTIONS: dict[str, dict[str, Any]] = {
    "plain": {},
    "all centres and circle": {"centres": "all", "circle": True},
    "velocities": {"velocities": True, "centres": "none"},
    "free bodies": {"bodies": True, "centres": "none"},
    "first step": {"step": 1, "circle": True},
}
GOLDEN = {
    "four_bar": ("ch13/13_08_four_bar.yaml", {}),
    "drag_link": ("ch13/13_01_drag_link.yaml", {"circle": True}),
    "toggle_bodies": ("ch13/13_03_toggle_free_bodies.yaml", {"bodies": True, "centres": "none"}),
    "epicyclic": ("gears/epicyclic_train.yaml", {}),
    "scotch_yoke": ("sliders/scotch_yoke.yaml", {"velocities": True}),
    "roller_follower": ("cams/roller_follower.yaml", {"step": 1}),
}


def drawn(case: Case, **options: Any) -> Picture:
    return parsed(draw(case, Drawing(**options)))


@cache
def told(name: str, bodies: bool) -> Known:
    return known_of(icsolve.load(FILES[name]), reactions=bodies)


@cache
def shown(name: str, options: str) -> Picture:
    """The figure of a case of the library."""
    known = told(name, OPTIONS[options].get("bodies", False))
    return parsed(draw(known.case, Drawing(**OPTIONS[options]), known))


def check(picture: Picture) -> None:
    """No label on another or on a joint, nothing outside the view, every id once."""
    assert overlaps(picture) == []
    assert outside(picture) == []
    assert len(set(picture.ids)) == len(picture.ids)


@sampled(3, "options")
@pytest.mark.parametrize(
    ("name", "options"), [(name, options) for options in OPTIONS for name in sample(FILES, 12, options)]
)
def test_every_case_draws_and_every_label_can_be_read(name: str, options: str) -> None:
    check(shown(name, options))


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 10, "labels on arrows"))
def test_no_label_stands_on_an_arrow(name: str) -> None:
    for options in ("plain", "velocities", "free bodies"):
        assert on_arrows(shown(name, options)) == []


@pytest.mark.parametrize("block", range(20 if FULL else 1))
def test_labels_of_random_mechanisms_can_be_read(block: int) -> None:
    """Twenty-five mechanisms a block, of all kinds, every third with all centres and velocities."""
    for seed in range(25 * block, 25 * block + few(25, 5)):
        kind = mechanisms.ALL[seed % len(mechanisms.ALL)]
        scene = loading.drawn(seed % 40, kind) if seed % 2 else random_mechanism(Random(seed))
        case = icsolve.load(transcribe.text(scene))
        more = {"centres": "all", "velocities": True} if seed % 3 == 0 else {}
        check(drawn(case, **more))


@pytest.mark.parametrize("name", GOLDEN)
def test_golden_files(name: str) -> None:
    """The same bytes as last time; after a wanted change run with ICSOLVE_GOLDEN=write and look at them."""
    file, options = GOLDEN[name]
    path = Path(__file__).parent / "golden" / f"{name}.svg"
    svg = draw(icsolve.load(LIBRARY / file), Drawing(**options))
    if os.environ.get("ICSOLVE_GOLDEN") == "write":
        path.write_text(svg, encoding="utf-8", newline="\n")
    assert svg == path.read_text(encoding="utf-8")


def test_the_same_bytes_every_run() -> None:
    path = FILES["linkages/watt_six_bar.yaml"]
    first, second = (draw(icsolve.load(path), Drawing("all", circle=True)) for _ in "ab")
    assert first == second


def test_a_drawing_is_plain_svg() -> None:
    svg = draw(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]))
    picture = parsed(svg)
    assert {"viewBox", "role"} <= set(picture.root.attrib)
    assert "Four-bar" in svg.partition("<title>")[2].partition("</title>")[0]
    assert "29.67" in svg.partition("<desc>")[2].partition("</desc>")[0]
    assert {"centre-2-4", "link-2", "load-T12", "line-2-4-1", "point-E"} <= set(picture.ids)
    assert "prefers-color-scheme:dark" in svg
    assert "url(" not in svg and "href" not in svg
    values = [value for e in picture.root.iter() for value in e.attrib.values()]
    decimals = re.findall(r"\.(\d+)", " ".join(values))
    assert decimals and max(map(len, decimals)) <= 2


def test_colours_hold_on_paper_and_in_the_dark() -> None:
    """WCAG AA: text at 4.5 to 1 or more, strokes at 3 to 1 or more, on both papers."""
    from icsolve.draw import svg

    for name, ink, _ in svg.TEXTS:
        assert min(contrast(ink.light, svg.PAPER.light), contrast(ink.dark, svg.PAPER.dark)) >= 4.5, name
    for name, stroke, _, _ in svg.RULES:
        if stroke is not None and name != "grid":
            assert contrast(stroke.light, svg.PAPER.light) >= 3.0, name
            assert contrast(stroke.dark, svg.PAPER.dark) >= 3.0, name


def contrast(a: str, b: str) -> float:
    """Contrast of two colours by WCAG 2."""
    bright, dim = sorted((luminance(a), luminance(b)), reverse=True)
    return (bright + 0.05) / (dim + 0.05)


def luminance(colour: str) -> float:
    parts = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


# --- the construction --------------------------------------------------------------------------------


def test_the_answer_stands_on_the_unknown() -> None:
    picture = drawn(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]))
    assert "T12 = 29.67 lbf·in ccw" in picture.texts("t-unknown")
    assert "P = 100 lbf" in picture.texts("t-known")


def test_steps_add_the_lines_in_order() -> None:
    """13.6: I24, then I46, then I26; each step adds its two lines and nothing else."""
    case = icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"])
    lines = [[i for i in drawn(case, step=k).ids if i.startswith("line-")] for k in range(4)]
    assert lines[0] == []
    assert lines[1] == ["line-2-4-1", "line-2-4-2"]
    assert lines[2][:2] == lines[1] and lines[2][2:] == ["line-4-6-1", "line-4-6-2"]
    assert lines[3] == [i for i in drawn(case).ids if i.startswith("line-")]


def test_a_step_says_which_lines_meet() -> None:
    said = drawn(icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"]), step=1).texts("t-axis")
    assert said == ["Step 1: I2-4 is where the line I2-3 I3-4 meets the line I1-2 I1-4."]


def test_centres_none_needed_all() -> None:
    case = icsolve.load(FILES["linkages/watt_six_bar.yaml"])
    counts = [
        sum(i.startswith("centre-") for i in drawn(case, centres=which).ids)
        for which in ("none", "needed", "all")
    ]
    assert counts[0] == 0
    assert counts[1] == len(needed_steps(known_of(case)))
    assert counts[2] == 15


def test_primary_centres_are_filled_and_secondary_hollow() -> None:
    picture = drawn(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]))
    groups = {g.get("id", ""): g for g in picture.root.iter()}
    kinds = {name: g[1].attrib["class"] for name, g in groups.items() if name.startswith("centre-")}
    assert kinds["centre-2-3"] == "primary"
    assert kinds["centre-2-4"] == "secondary"


def test_far_centres_are_arrows_with_their_distance_and_infinite_ones_directions() -> None:
    texts = drawn(icsolve.load(FILES["ch13/13_14_slider_drives_crank.yaml"])).texts("t-centre")
    assert "I46, 9.69 in away" in texts
    assert "I12 ∞" in texts


def test_the_circle_numbers_chords_in_the_order_of_finding() -> None:
    case = icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"])
    picture = drawn(case, circle=True)
    chords = {
        g.attrib["id"].removeprefix("chord-"): int(g.attrib["data-step"])
        for g in picture.root.iter()
        if g.get("id", "").startswith("chord-")
    }
    assert {pair: n for pair, n in chords.items() if n} == {"2-4": 1, "4-6": 2, "2-6": 3}
    primary = sorted(pair for pair, n in chords.items() if not n)
    assert primary == ["1-2", "1-4", "1-6", "2-3", "3-4", "4-5", "5-6"]
    assert {"1", "2", "3"} <= set(picture.texts("t-centre"))


def test_velocities_are_square_to_their_radii() -> None:
    """Four-bar: the arrow at B is square to AB, that at C to DC; both by their ends in the picture."""
    picture = drawn(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]), velocities=True)
    places = {"A": (0, 0), "B": (-0.30782, 0.84572), "C": (2.2, 2.60424), "D": (2.9444, 0)}
    for point, pivot, link in (("B", "A", "2"), ("C", "D", "3")):
        group = next(g for g in picture.root.iter() if g.get("id") == f"velocity-{point}-{link}")
        stroke = next(e for e in group if e.get("class") == "velocity")
        (x1, y1), (x2, y2) = (map(float, p.split(",")) for p in stroke.attrib["d"].removeprefix("M").split())
        radius = (places[point][0] - places[pivot][0], places[point][1] - places[pivot][1])
        v = (x2 - x1, y1 - y2)
        size = (v[0] ** 2 + v[1] ** 2) ** 0.5 * (radius[0] ** 2 + radius[1] ** 2) ** 0.5
        assert abs(v[0] * radius[0] + v[1] * radius[1]) < 1e-3 * size


def test_a_load_and_a_velocity_along_one_line_lie_apart() -> None:
    """Scotch yoke: C goes against F on F's own line."""
    picture = drawn(icsolve.load(FILES["sliders/scotch_yoke.yaml"]), velocities=True)
    loads = [line for line in shapes(picture, "unknown") if line.length > 20.0]
    speeds = [line for line in shapes(picture, "velocity") if line.length > 10.0]
    assert loads and speeds
    assert not [1 for load in loads for speed in speeds if load.buffer(1.0).intersects(speed)]


def test_a_space_behind_an_index_is_kept_whatever_program_draws_it() -> None:
    """``T12 = 4``: white space at the ends of a part of a text counts, and no text has lines of its own."""
    picture = draw(icsolve.load(FILES["linkages/four_bar.yaml"]))
    assert 'xml:space="preserve"' in picture.partition(">")[0]
    assert re.search("</tspan><tspan[^>]*> = ", picture)
    assert not any("\n" in text for text in re.findall(r"<text.*?</text>", picture, re.DOTALL))


def test_free_bodies_show_every_reaction_on_both_links() -> None:
    """13.2: F34 = 216.7 N on link 4 is F43 on link 3."""
    picture = drawn(icsolve.load(FILES["ch13/13_02_four_bar_free_bodies.yaml"]), bodies=True)
    texts = picture.texts("t-reaction")
    assert sorted(text.split(" = ")[0] for text in texts) == ["F12", "F14", "F23", "F32", "F34", "F43"]
    assert "F34 = 216.7 N" in texts and "F43 = 216.7 N" in texts


@sampled(4)
@pytest.mark.parametrize("name", [name for name in FILES if name.startswith("equilibrium/")])
def test_free_bodies_of_a_position_of_rest_are_those_of_the_position_that_is_drawn(name: str) -> None:
    """Drawing and worked solution have the forces that the answer has there: the first stable position."""
    known = known_of(icsolve.load(FILES[name]), reactions=True)
    rests = icsolve.solve(icsolve.load(FILES[name]), reactions=True).positions or ()
    first = next((one for one in rests if one.stability == "stable"), rests[0])
    assert first.answer.reactions
    texts = parsed(draw(known.case, Drawing(bodies=True), known)).texts("t-reaction")
    told = explain(known.case, "text", bodies=True, known=known)
    for own, reaction in first.answer.reactions.items():
        if reaction.magnitude is not None:  # else open
            assert f"{own} = {figure_number(reaction.magnitude)} N" in texts
        assert f"\n  {own} " in told.partition("The force of the first link on the second")[2]


@sampled(3)
@pytest.mark.parametrize("small", [0.02, 0.1, 0.3, 0.9])
def test_forces_of_free_bodies_are_to_one_scale_or_said_to_be_longer(small: float) -> None:
    """The arrows on a beam under two weights, the lighter on the left: as long as what is written beside
    them, where the picture does not say that small ones are longer."""
    picture = drawn(icsolve.load(BEAM.format(weight=100.0 * small)), bodies=True, centres="none")
    told = {one.attrib["id"]: one.findtext(f"{SVG}title") or "" for one in picture.root.iter(f"{SVG}g")}
    lengths = []
    for name in ("body-load-P-on-2", "body-load-Q-on-2"):
        group = next(one for one in picture.root.iter(f"{SVG}g") if one.get("id") == name)
        line, head = (list(coordinates(one)) for one in group.iter(f"{SVG}path"))
        lengths.append(math.dist(line[0], head[0]) / float(told[name].split()[2]))
    says = any("but for small ones" in text for text in picture.texts("t-note"))
    assert says is (lengths[0] > 1.01 * lengths[1]) is (small < 1 / 6)


BEAM = """icsolve: 1
points: {{A: [0, 0], B: [4, 0], C: [1, 0], D: [3, 0]}}
joints: [{{pin: [1, 2], at: A}}, {{slot: [2, 1], at: B, along: 0}}]
loads:
  P: {{force: {weight}, link: 2, at: C, angle: 270}}
  Q: {{force: 100, link: 2, at: D, angle: 270}}
"""


def test_where_friction_leaves_the_free_bodies_open_the_picture_says_so() -> None:
    """Problem 13.16 without its motion: the torque holds over a range, and the reactions are open."""
    text = FILES["ch13/13_16_slider_crank_with_friction.yaml"].read_text().replace("motion:", "# motion:")
    assert "Free bodies: none, since the answer leaves the reactions open." in drawn(
        icsolve.load(text.partition("expect:")[0]), bodies=True
    ).texts("t-note")


# --- bad input ---------------------------------------------------------------------------------------

FOUR_BAR = """
icsolve: 1
title: {title}
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: {crank}, BC: 3.5, CD: 2.5, DE: 1.5}}
angles: {{AB: 60, CDE: 0}}
near: {{C: [3.5, 2.4]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  P: {{force: 100, link: 4, at: E, angle: 180}}
  T12: {{torque: unknown, link: 2}}
"""


def test_what_does_not_assemble_is_drawn_as_far_as_it_is_known() -> None:
    picture = drawn(icsolve.load(FOUR_BAR.format(title="too long a crank", crank=20)))
    check(picture)
    assert "link-2" in picture.ids and "point-D" in picture.ids
    assert "point-C" not in picture.ids
    assert "cannot meet at C" in " ".join(picture.texts("t-reason"))
    assert "T12 = ?" in picture.texts("t-unknown")


DEAD_CENTRE = """
icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: unknown, link: 4, at: C, angle: 180}
  T12: {torque: 5, link: 2}
"""


def test_a_dead_centre_is_drawn_with_its_centres_and_the_reason() -> None:
    picture = drawn(icsolve.load(DEAD_CENTRE))
    check(picture)
    assert {"centre-1-2", "link-3", "load-P"} <= set(picture.ids)
    assert "dead centre" in " ".join(picture.texts("t-reason"))


HOSTILE = [
    '"</text></svg><script>alert(1)</script>"',
    '\'" onload="alert(1)" x="\'',
    '"]]> --> <!-- & &amp; &#x3c;"',
    '"Ünïcödé 漢字 מבחן 😀 ∑ _{low} ^{high} $x$"',
    f'"{"word " * 200}"',
    f'"{"x" * 900}"',
]


@pytest.mark.parametrize("title", HOSTILE)
def test_text_stays_text(title: str) -> None:
    case = icsolve.load(FOUR_BAR.format(title=title, crank=1))
    svg = draw(case, Drawing(circle=True))
    picture = parsed(svg)
    check(picture)
    assert {e.tag.rpartition("}")[2] for e in picture.root.iter()} <= {
        "svg", "title", "desc", "style", "rect", "g", "path", "circle", "text", "tspan",
    }  # fmt: skip
    assert not [a for e in picture.root.iter() for a in e.attrib if a.startswith("on")]
    shown = "".join("".join(picture.texts("t-title")).split())
    assert shown == "".join(case.title.split())


def test_names_with_primes_and_letters_of_any_script() -> None:
    text = FOUR_BAR.format(title="names", crank=1).replace("CDE", "C-D-Ω'").replace("at: E", "at: Ω'")
    text = text.replace(" DE:", " D-Ω':")
    picture = drawn(icsolve.load(text))
    check(picture)
    assert "point-Ω-prime" in picture.ids
    assert "Ω'" in picture.texts("t-point")


@pytest.mark.parametrize("scale", [1e-280, 1e-6, 1e6, 1e280])
def test_figures_of_any_size_draw_alike(scale: float) -> None:
    picture = drawn(icsolve.load(FOUR_BAR.format(title="size", crank=1)))
    scaled = FOUR_BAR.format(title="size", crank=1 * scale)
    for number in ("3.5, CD", "2.5, DE", "1.5}", "4, 0", "3.5, 2.4"):
        scaled = scaled.replace(number, re.sub(r"\d[\d.]*", lambda n: repr(float(n[0]) * scale), number))
    other = drawn(icsolve.load(scaled))
    check(other)
    assert other.root.attrib["viewBox"] == picture.root.attrib["viewBox"]


def test_a_drawing_imports_what_it_needs_and_no_more() -> None:
    """Start-up is a measured feature: masked arrays and the rooms of cams cost more than a drawing."""
    script = (
        f"import sys, icsolve; from icsolve.draw import draw; draw(icsolve.load({str(FILES[FOUR])!r}))\n"
        "rooms = ('numpy.ma', 'icsolve.cams.shapes', 'icsolve.draw.bodies')\n"
        "print([room for room in rooms if room in sys.modules])"
    )
    ran = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


@pytest.mark.parametrize("slots", range(3, 13))
def test_a_geneva_wheel_is_told_by_its_crank(slots: int) -> None:
    """So many slots where the crank enters one square to it, each 360 deg / n from the next; a slotted lever
    where it does not, or where its pin has left the slot."""
    arm, inside = 100.0 * math.sin(math.pi / slots), 80.0 - 180.0 / slots
    for length, angle, wanted in ((arm, inside, slots), (0.99 * arm, inside, 0), (arm, 180.0 - inside, 0)):
        case = icsolve.load(
            LIBRARY / "sliders/geneva.yaml", {"lengths.AB": repr(length), "angles.AB": repr(angle)}
        )
        known = known_of(case)
        found = geneva_of(known.case, known.points, "3")
        assert (found.slots if found is not None else 0) == wanted
        if found is not None:
            outline = body_of(scene_of(known), "3").shape
            assert outline is not None and len(outline.interiors) == 0
            turned = shapely.affinity.rotate(
                outline, 360.0 / slots, origin=scene_of(known).view.at(found.centre)
            )
            assert shapely.area(shapely.symmetric_difference(turned, outline)) < 0.02 * outline.area


@pytest.mark.parametrize(
    "on",
    [
        "joints: [{roll: [1, 2], at: C, radii: [0.5, 0.2]}]",
        "joints: [{roll: [1, 2], at: C, radii: [-0.5, 0.2]}]",
        "profile: {1: {circle: O, radius: 0.5}, 2: {roller: Q, radius: 0.2}}\n"
        "joints: [{contact: [1, 2]}, {slide: [2, 1], at: Q, along: 160}]",
    ],
)
def test_the_round_ground_that_something_runs_on_is_there(on: str) -> None:
    """A disk on a hill or in a hollow, a roller on a fixed cam: 0.5 to 0.2, hatched."""
    q = 0.3 if "-0.5" in on else 0.7
    svg = draw(
        icsolve.load(
            "icsolve: 1\npoints: {O: [0, 0]}\nlengths: {OC: 0.5, "
            f"OQ: {q}}}\nangles: {{OC: 70, OQ: 70}}\nlinks: {{1: [O]}}\n{on}\n"
            "loads: {W: {weight: 50, link: 2, at: Q}}\n"
        )
    )
    frame = svg.partition('<g id="link-1">')[2].partition("</g>")[0]
    ground = max(map(float, re.findall(r'<circle [^>]* r="([^"]*)"', frame)))
    disk = max(map(float, re.findall(r'<circle class="body" [^>]* r="([^"]*)"', svg)))
    assert ground / disk == pytest.approx(2.5, rel=0.1)  # to the line beside it
    assert 'class="hatch"' in frame


@pytest.mark.parametrize(("links", "told"), [(2, "The centres by inspection."), (4, "The one step.")])
def test_a_figure_with_more_steps_than_there_are_says_how_many_there_are(links: int, told: str) -> None:
    """All centres of a lever are by inspection, a four-bar with one load asked for has one to construct."""
    pins = range(1, links + 1 if links > 2 else links)
    joints = "".join(f"  - {{pin: [{n}, {n % links + 1}], at: {'ABCD'[n - 1]}}}\n" for n in pins)
    case = icsolve.load(
        "icsolve: 1\npoints: {A: [0, 0], B: [0, 1], C: [2, 2], D: [3, 0]}\njoints:\n"
        f"{joints}loads:\n"
        f"  P: {{force: 5, link: {links}, at: {'BBBC'[links - 1]}, angle: 0}}\n"
        "  T: {torque: unknown, link: 2}\n"
    )
    assert f">{told}</text>" in draw(case, Drawing(step=9))


@pytest.mark.parametrize("number", [math.inf, math.nan, 1.7976931348623157e308])
def test_a_number_that_no_figure_can_show_is_refused_and_no_fault(number: float) -> None:
    """The last is a double: its four digits are none."""
    with pytest.raises(SceneError, match="larger than the largest double"):
        figure_number(number)
    assert figure_number(-1.7e308) == "−1.7×10³⁰⁸"


@pytest.mark.parametrize("order", ["1, 2", "2, 1"])
@pytest.mark.parametrize("load", ["G", "A", "B"])
def test_what_stands_on_the_frame_is_drawn_to_where_it_stands(order: str, load: str) -> None:
    """A straight ladder on the floor and at a wall, whichever of its points bear loads, and whichever way its
    contacts are written: the bar lies on the line of its ends."""
    turned = 0 if order == "1, 2" else 180
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], G: {{centroid: [A, B]}}}}
lengths: {{AB: 5}}
angles: {{AB: 60}}
joints:
  - {{contact: [{order}], at: A, normal: {90 + turned}, mu: 0.3}}
  - {{contact: [{order}], at: B, normal: {180 + turned}, mu: 0.2}}
loads:
  W: {{weight: 200, link: 2, at: G}}
  H: {{force: unknown, link: 2, at: {load}, angle: 0}}
""")
    scene = scene_of(known_of(case))
    shape = body_of(scene, "2").shape
    assert shape is not None
    line = shapely.LineString([scene.at["A"], scene.at["B"]])
    assert line.within(shape.buffer(1e-6))
    assert shape.within(line.buffer(12.0))


def test_the_point_toward_which_a_load_acts_is_drawn() -> None:
    case = icsolve.load("""icsolve: 1
points: {A: [0, 0], F: [-3, 0], D: [5, 1]}
lengths: {AB: 2}
angles: {AB: 50}
joints: [{pin: [1, 2], at: A}]
loads:
  P: {force: unknown, link: 2, at: B, toward: F}
  Q: {force: 5, link: 2, at: B, away: D}
""")
    for options in ({}, {"bodies": True}):
        texts = drawn(case, **options).texts("t-point")
        assert {"F", "D"} <= {*texts}
    door = icsolve.load("""icsolve: 1
points: {A: [0, 0.2, 0], B: [0, 1, 0], G: [0.5, 0.6, 0], C: [1, 0, 0], D: [0, 0, 1.2]}
joints: [{radial: [1, 2], at: A, axis: y}, {thrust: [1, 2], at: B, axis: y}]
loads:
  W: {mass: 30 kg, link: 2, at: G}
  T: {force: unknown, link: 2, at: C, toward: D}
""")
    assert {"A", "C", "D"} <= {*drawn(door).texts("t-point")}


def test_the_opposite_of_a_force_between_two_links_bears_its_name() -> None:
    case = icsolve.load("""icsolve: 1
points: {A: [0, 0], D: [4, 0], P: {centroid: [B, C]}, Q: {centroid: [A, B]}}
lengths: {AB: 2, BC: 4, CD: 3}
angles: {AB: 60}
near: {C: [5, 2.5]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  M: {torque: 5, link: 4}
  F: {force: unknown, link: 3, at: P, against: 2, toward: Q}
""")
    texts = drawn(case).texts("t-unknown")
    assert any(text.startswith("F = ") for text in texts) and "F" in texts


WEDGED = """icsolve: 1
points: {{C: [0, 0]}}
joints: [{{slide: [2, 1], at: C, along: 0, mu: 0.5}}]
loads:
  P: {{force: unknown, link: 2, at: C, angle: {angle}}}
  Q: {{force: {push}, link: 2, at: C, angle: 0}}
"""


@pytest.mark.parametrize("push", [5, -5])
@pytest.mark.parametrize("angle", [280, 100, 260, 80, 0])
def test_a_range_says_on_which_side_it_has_no_end(angle: int, push: int) -> None:
    """Of a push within the angle of friction, which holds beyond a value; along the guide it holds at one."""
    case = icsolve.load(WEDGED.format(angle=angle, push=push))
    low, high = icsolve.solve(case).answers["P"].holds or (math.nan, math.nan)
    end = figure_number(high if low == -math.inf else low)
    told = f"only at {end} N" if angle == 0 else f"up to {end} N" if low == -math.inf else f"from {end} N up"
    assert f"P: {told}" in drawn(case).texts("t-unknown")


def test_a_reaction_that_is_open_says_so_and_no_number() -> None:
    """A beam on three supports: upright one force is open, and along the beam only the first acts."""
    case = icsolve.load("""icsolve: 1
points: {A: [0, 0], B: [4, 0], C: [8, 0], P: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [2, 1], at: B, along: 0}
  - {slot: [2, 1], at: C, along: 0}
loads:
  P: {force: [3, -4], link: 2, at: P}
""")
    texts = drawn(case, bodies=True).texts("t-reaction")
    assert not any("= 0" in text for text in texts), texts
    assert sum(text.endswith("= ?") for text in texts) == len(texts)
    assert any("= 3 N, " in text for text in texts)


@sampled(3)
@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("told", ["pawl", "ratchet", "title"])
def test_a_ratchet_is_a_toothed_wheel_and_a_finger(seed: int, told: str) -> None:
    """Its pawl is no disc, wherever its pin lies, on the line of the force too: the teeth are alike round the
    wheel, the face at the contact is square to the normal, and the finger reaches it beside the wheel."""
    draw_, turn = Random(seed), 2.0 * math.pi * seed / 12
    r, side, off = draw_.uniform(20, 90), draw_.choice([-1, 1]), draw_.choice([0.0, draw_.uniform(-8, 8)])
    at = complex(r * math.cos(turn), r * math.sin(turn))
    push = side * 1j * at / abs(at) * cmath.exp(1j * math.radians(draw_.uniform(-12, 12)))
    pin = at + draw_.uniform(0.6, 1.5) * r * push * cmath.exp(1j * math.radians(off))
    wheel, pawl = {"pawl": ("2", "pawl"), "ratchet": ("Ratchet_wheel", "3"), "title": ("2", "3")}[told]
    (a, b), out = draw_.choice([((wheel, pawl), push), ((pawl, wheel), -push)])
    known = known_of(
        icsolve.load(
            f"icsolve: 1\ntitle: {'Winch with a ratchet' if told == 'title' else 'Winch'}\n"
            f"points: {{O: [0, 0], P: [{at.real}, {at.imag}], D: [{pin.real}, {pin.imag}]}}\n"
            f"joints: [{{pin: [1, {wheel}], at: O}}, {{pin: [1, {pawl}], at: D}}, "
            f"{{contact: [{a}, {b}], at: P, normal: {math.degrees(cmath.phase(out))}}}]\n"
            f"loads: {{M: {{torque: 50, link: {wheel}}}, S: {{torque: unknown, link: {pawl}}}}}\n"
        )
    )
    scene = scene_of(known)
    bodies = [body_of(scene, link) for link in (wheel, pawl)]
    assert not any(body.wheels for body in bodies)
    teeth, finger = (body.shape for body in bodies)
    assert teeth is not None and finger is not None
    turned = shapely.affinity.rotate(teeth, 360.0 / 16, origin=scene.at["O"])
    assert shapely.symmetric_difference(turned, teeth).area < 0.01 * teeth.area
    x, y = scene.at["P"]
    for along, inside in ((3.0, False), (-3.0, True)):
        spot = shapely.Point(x + along * push.real, y - along * push.imag)
        assert bool(shapely.contains(teeth, spot)) == inside
    for along in (-2.0, 2.0):  # along the face, whose line the push crosses at a right angle
        spot = shapely.Point(x + along * push.imag, y + along * push.real)
        assert shapely.distance(teeth.boundary, spot) < 0.05
    assert shapely.distance(finger, shapely.Point(x, y)) < 0.05
    assert shapely.contains(finger, shapely.Point(scene.at["D"]))
    length = math.dist(scene.at["D"], (x, y))
    assert finger.area < 14.0 * length + 300.0


def test_a_drum_under_a_brake_shoe_stays_round() -> None:
    """Its pin lies on the normal as that of a pawl may."""
    scene = scene_of(known_of(icsolve.load(FILES["tools/short_shoe_brake.yaml"])))
    assert not scene.round.ratchets and body_of(scene, "2").wheels


@pytest.mark.parametrize("seed", range(4))
def test_a_force_of_unknown_direction_is_one_arrow_once_it_is_found(seed: int) -> None:
    """A pantograph of random arms: the arrow is along the force, as the sentence has it, and no component
    stands beside it; where the force is asked for both stand."""
    dice = Random(seed)
    (ax, ay), (bx, by), times = (dice.uniform(1, 2), 2), (dice.uniform(1, 2), -2), dice.choice([2, 3])
    case = icsolve.load(
        f"icsolve: 1\npoints: {{O: [0, 0], A: [{ax}, {ay}], B: [{times * ax}, {times * ay}], "
        f"C: [{times * ax + bx}, {times * ay + by}], D: [{ax + bx}, {ay + by}], "
        f"E: [{times * (ax + bx)}, {times * (ay + by)}]}}\n"
        "joints: [{pin: [1, 2], at: O}, {pin: [2, 3], at: B}, {pin: [2, 4], at: A}, {pin: [3, 5], at: C},\n"
        "  {pin: [4, 5], at: D}]\n"
        f"loads: {{P: {{force: [{dice.uniform(3, 9)}, {dice.choice([0, 4])}], link: 4, at: D}},\n"
        "  Q: {force: [unknown, unknown], link: 3, at: E}}\n"
    )
    known = known_of(case)
    marks = draw(case)
    size = icsolve.solve(case).answers["Q"].value
    assert f"Q = {figure_number(size, 4)} N" in marks
    assert "Q.x" not in marks and "Q.y" not in marks
    asked = draw(case, known=known.as_asked)
    assert asked.count("Q.") >= 2


def test_centres_in_one_place_are_told_so() -> None:
    """Sun, ring and arm of a differential about one axle: any line goes through."""
    case = icsolve.load(
        """icsolve: 1
points: {O: [0, 0], P: [3, 0]}
joints: [{pin: [1, sun], at: O}, {pin: [1, ring], at: O}, {pin: [1, arm], at: O}, {pin: [arm, p1], at: P},
  {gears: [sun, p1], teeth: [20, 20], carrier: arm}, {gears: [p1, ring], teeth: [20, -60], carrier: arm}]
loads: {T: {torque: 100, link: arm}, L: {torque: unknown, link: sun}, R: {torque: unknown, link: ring}}
"""
    )
    assert "in the place of I1-sun and I1-ring" in answer_text(icsolve.solve(case))
    assert "I1-ring and I1-sun lie in one place" in " ".join(explain(case).split())
    assert "Isun-ring is in the place of I1-ring and I1-sun." in draw(case, Drawing(step=1))


def test_units_of_a_figure_have_dots_and_raised_numbers() -> None:
    """In the sentence of a range that friction holds, and of a pressure."""
    jack = icsolve.load(
        "icsolve: 1\nunits: {length: m, force: kN}\npoints: {B: [0, 0]}\n"
        "joints: [{screw: [1, 2], at: B, along: 90, lead: 0.006, radius: 0.015, mu: 0.12}]\n"
        "loads: {W: {weight: 20, link: 2, at: B}, T: {torque: unknown, screw: 1-2}}\n"
    )
    piston = icsolve.load(
        "icsolve: 1\nunits: {length: m, force: kN}\npoints: {B: [0, 0]}\n"
        "joints: [{slide: [2, 1], at: B, along: 0}]\n"
        "loads: {W: {force: 20, link: 2, at: B, angle: 180},\n"
        "  p: {pressure: unknown, area: 0.01, link: 2, at: B, angle: 0}}\n"
    )
    for case, unit in ((jack, "kN·m"), (piston, "kN/m²")):
        svg = draw(case)
        assert unit in svg
        assert not re.search(r"kN\*m|m\^2", svg)


@pytest.mark.parametrize("seed", range(4))
def test_a_handle_reaches_the_point_at_which_it_takes_the_opposite(seed: int) -> None:
    """Shears squeezed between two points, of which only one is told to be of its link."""
    dice = Random(seed)
    x, y = dice.uniform(5, 18), dice.uniform(1, 4)
    known = known_of(
        icsolve.load(
            f"icsolve: 1\npoints: {{A: [0, 0], H: [{x}, {y}], J: [{x}, {-y}], K: [-1, 0.1], L: [-1, -0.1]}}\n"
            "ground: base\njoints: [{pin: [base, 1], at: A}, {pin: [1, 2], at: A}]\n"
            "loads: {P: {force: 50, link: 2, at: H, against: 1, toward: J},\n"
            "  Q: {force: unknown, link: 2, at: L, against: 1, away: K}}\n"
        )
    )
    scene = scene_of(known)
    for link, names in (("1", "AJK"), ("2", "AHL")):
        shape = body_of(scene, link).shape
        assert shape is not None
        assert all(shapely.contains(shape, shapely.Point(scene.at[name])) for name in names), link


@pytest.mark.parametrize("bodies", [False, True])
def test_no_inertia_is_drawn_of_what_does_not_accelerate(bodies: bool) -> None:
    """A crank whose mass is at its pivot, at a steady speed, has none; a piston beside it has."""
    text = """\
icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 1, BC: 3}
angles: {AB: 50}
near: {C: [3, 0]}
links: {2: {mass: 2 kg, centre: A, inertia: 1 kg*m^2}, 4: {mass: 3 kg, centre: C}}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 5%s}
dynamic: yes
"""
    labels = [label.text for label in drawn(icsolve.load(text % ""), bodies=bodies).labels]
    assert any(label.startswith("Fi4 = ") for label in labels)
    assert not any(label.startswith(("Fi2", "Ti2")) for label in labels)
    faster = drawn(icsolve.load(text % ", acceleration: 2"), bodies=bodies)
    assert any(label.text.startswith("Ti2 = ") for label in faster.labels)


def arrows_of(picture: Picture, name: str) -> list[tuple[complex, complex]]:
    """The arrows of a group, from tail to tip, in the picture turned upright."""
    group = next(e for e in picture.root.iter() if e.attrib.get("id") == name)
    found = []
    paths = [
        e.attrib["d"] for e in group.iter() if e.tag.endswith("path") and "head" not in e.attrib["class"]
    ]
    for path in paths:
        numbers = [float(number) for number in re.findall(r"-?[\d.]+", path)]
        points = [complex(x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        if len(points) == 2:
            found.append((points[0], points[1]))
    return found


@sampled(3)
@pytest.mark.parametrize("seed", range(12))
def test_arrows_of_a_line_load_point_as_it_acts_everywhere(seed: int) -> None:
    """One that is another at its end: of a negative number along the other way, whichever end has it, and of
    one whose resultant vanishes too; none has the sense of a couple."""
    random = Random(f"line load {seed}")
    first, last = random.choice([(-5, 0), (0, -5), (-3, -7), (4, -4), (-6, 2), (6, -2), (3, 8)])
    angle, turn = random.uniform(20.0, 160.0), random.uniform(0.0, 360.0)
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: 3}}
angles: {{AB: {turn}}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  q: {{distributed: [{first}, {last}], link: 2, from: A, to: B, angle: {turn + angle}}}
  T: {{torque: unknown, link: 2}}
""")
    picture = drawn(case)
    (words,) = (text for text in picture.texts("t-known") if text.startswith("q"))
    assert "cw" not in words and "deg" not in words
    way, bar = (cmath.rect(1.0, math.radians(a)) for a in (turn + angle, turn))
    arrows = arrows_of(picture, "load-q")
    at = [(tip / bar).real for _, tip in arrows]
    low, high = min(at), max(at)
    seen = set()
    for (tail, tip), place in zip(arrows, at, strict=True):
        size = first + (last - first) * (place - low) / (high - low)
        if abs(size) > 1.5 and abs(((tip - tail) / way).imag) < 0.01 * abs(tip - tail):
            assert ((tip - tail) / way).real * size > 0.0
            seen.add(size > 0.0)
    assert seen == {number > 0 for number in (first, last) if number}


@sampled(2)
@pytest.mark.parametrize("seed", range(6))
def test_a_couple_between_two_links_is_drawn_on_both(seed: int) -> None:
    """As its free bodies have it: one arc the one way, the other the other way, with its name."""
    random = Random(f"couple between {seed}")
    size = random.choice([5, -5])
    link, other = random.sample("234", 2)
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 2, BC: 4, CD: 3}}
angles: {{AB: {random.uniform(40, 100)}}}
near: {{C: [5, 2.5]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads:
  M: {{torque: {size}, link: {link}, against: {other}}}
  T: {{torque: unknown, link: 2}}
""")
    picture = drawn(case)
    group = next(e for e in picture.root.iter() if e.attrib.get("id") == "load-M")
    arcs = [
        e.attrib["d"] for e in group.iter() if " A" in e.attrib.get("d", "") or "A" in e.attrib.get("d", "")
    ]
    sweeps = {re.findall(r"A ?[\d.]+[ ,]+[\d.]+[ ,]+[\d.]+[ ,]+[01][ ,]+([01])", d)[0] for d in arcs}
    assert len(arcs) == 2 and sweeps == {"0", "1"}
    assert "M" in picture.texts("t-known")


@sampled(2)
@pytest.mark.parametrize("seed", range(6))
def test_a_couple_in_a_free_body_is_told_by_its_moment(seed: int) -> None:
    """A torsion spring by its stiffness times its turn, a line load without a resultant by its couple."""
    random = Random(f"couples {seed}")
    free, number = random.uniform(20.0, 80.0), random.uniform(1.0, 9.0)
    case = icsolve.load(f"""icsolve: 1
units: {{length: mm, force: N, torque: N*m}}
points: {{A: [0, 0], B: [300, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  k: {{spring: 50, corner: AB, free: {free}, link: 2}}
  q: {{distributed: [{number}, {-number}], link: 2, from: A, to: B, angle: -90}}
  T: {{torque: unknown, link: 2}}
""")
    texts = drawn(case, bodies=True).texts("t-known")
    assert f"k = {figure_number(50.0 * math.radians(free))} N·m" in texts
    assert f"q = {figure_number(number * 300.0**2 / 6.0 / 1000.0)} N·m" in texts


@sampled(2)
@pytest.mark.parametrize("seed", range(8))
def test_a_load_in_space_is_drawn_as_it_acts(seed: int) -> None:
    """A spring shorter than free pushes; in a free body it and a mass are told by their force."""
    random = Random(f"loads of space {seed}")
    at, to = ([random.randint(-5, 5), random.randint(1, 5), random.randint(-5, 5)] for _ in range(2))
    to[0] += 6  # apart, and not along the line of sight
    free, stiffness = random.uniform(0.1, 2.0) * math.dist(at, to), random.uniform(1.0, 9.0)
    case = icsolve.load(f"""icsolve: 1
gravity: {{along: x}}
points: {{A: [0, 0, 0], B: {at}, C: {to}}}
joints: [{{weld: [1, 2], at: A}}]
loads:
  k: {{spring: {stiffness}, free: {free}, link: 2, at: B, to: C}}
  m: {{mass: {stiffness} kg, link: 2, at: B}}
  p: {{force: -3, link: 2, at: C, along: x}}
""")
    way = [b - a for a, b in zip(at, to, strict=True)]
    stretch = math.dist(at, to) - free
    picture, bodies = drawn(case), drawn(case, bodies=True)
    ways = {"k": [stretch * part for part in way], "m": [1.0, 0.0, 0.0], "p": [-1.0, 0.0, 0.0]}
    for name, toward in ways.items():
        ((tail, tip),) = arrows_of(picture, f"load-{name}")
        seen = complex(*flat((toward[0], toward[1], toward[2])))
        assert abs((tip - tail) / abs(tip - tail) - seen / abs(seen)) < 1e-2
    words = bodies.texts("t-known")
    assert f"k = {figure_number(stiffness * abs(stretch))} N" in words
    assert f"m = {figure_number(stiffness * 9.81)} N" in words


@sampled(2)
@pytest.mark.parametrize("seed", range(8))
def test_a_load_between_two_links_in_space_is_drawn_on_both(seed: int) -> None:
    """Each the other way; that of a spring, and of a force toward a point, at the point that it is toward.
    No two arrows fuse, of one line or axis neither."""
    random = Random(f"between links of space {seed}")
    (x, y, z), (u, v, w) = ([random.randint(a, 5) for a in (-5, 1, -5)] for _ in "BC")
    ends = ((x, y, z), (u + 9, v, w))  # apart, and not along the line of sight
    (a, b), number = map(list, ends), random.choice([3, -3])
    on, other = random.choice([(2, 3), (3, 2)])
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0, 0], D: [9, 0, 0], B: {a}, C: {b}}}
joints: [{{weld: [1, 2], at: A}}, {{weld: [1, 3], at: D}}]
loads:
  k: {{spring: 5, free: {random.uniform(1, 20)}, link: {on}, at: B, against: {other}, to: C}}
  p: {{force: {number}, link: {on}, at: B, toward: C, against: {other}}}
  q: {{force: {number}, link: {on}, at: B, along: z, against: {other}}}
  t: {{torque: {number}, link: {on}, along: z, against: {other}}}
  f: {{force: {number}, link: {on}, at: B, along: z}}
  g: {{torque: {number}, link: {on}, along: z}}
""")
    known = known_of(case, reactions=True)
    sketch, _ = space_marks(known)
    at, to, *welds = (complex(x, -y) for x, y in (sketch.at(p) for p in (*ends, (0, 0, 0), (9, 0, 0))))
    feet = dict(zip((2, 3), welds, strict=True))
    picture, bodies = (parsed(draw(case, Drawing(bodies=also), known)) for also in (False, True))
    for name, place in {"k": to, "p": to, "q": at, "t": None}.items():
        own, opposite = arrows_of(picture, f"load-{name}")
        ways = [(tip - tail) / abs(tip - tail) for tail, tip in (own, opposite)]
        assert abs(sum(ways)) < 1e-2, name
        if place is not None:
            assert min(abs(end - at) for end in own) < 16.0
            assert min(abs(end - place) for end in opposite) < 16.0, name
            (load,) = arrows_of(bodies, f"body-load-{name}-on-{other}")
            held = arrows_of(bodies, f"reaction-F1{other}-on-{other}")[0]
            apart = (end - foot - (place - feet[other]) for end in load for foot in held)
            assert min(map(abs, apart)) < 32.0, name
        assert picture.texts("t-known").count(name) == 1
    assert len(arrows_of(picture, "load-f")) == 1
    names = {group for group in bodies.ids if re.match("(load|body-load|reaction)-", group)}
    lines = [
        shapely.LineString([(z.real, z.imag) for z in a]) for name in names for a in arrows_of(bodies, name)
    ]
    assert all(a.intersection(b.buffer(1.0)).length < 8.0 for a, b in combinations(lines, 2))


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_what_is_open_of_a_reaction_in_space_is_told_apart_from_what_is_not(axis: str) -> None:
    """Two thrust bearings share the thrust as they fit, and not what is across."""
    kinds = (f"{{thrust: [1, 2], at: A, axis: {axis}}}", f"{{thrust: [1, 2], at: B, axis: {axis}}}")
    place = {"x": "[2, 0, 0]", "y": "[0, 2, 0]", "z": "[0, 0, 2]"}[axis]
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0, 0], B: {place}, C: [1, 1, 0.5]}}
joints: [{", ".join(kinds)}]
loads:
  P: {{force: [30, -20, -100], link: 2, at: C}}
  M: {{torque: unknown, link: 2, along: {axis}}}
""")
    texts = drawn(case, bodies=True).texts("t-reaction")
    spatial = icsolve.solve(case, reactions=True).spatial
    assert spatial is not None
    for joint, reaction in zip("AB", spatial.reactions.values(), strict=True):
        assert reaction.force.count(None) == 1
        told = ", ".join("?" if part is None else figure_number(part) for part in reaction.force)
        assert f"F12@{joint} = ({told}) N" in texts


BRAKE = """
icsolve: 1
points: {O: [0, 0], A: [-200, HIGH], S: [0, 150], H: [300, 170]}
joints:
  - {pin: [1, 2], at: O}
  - {pin: [1, 3], at: A}
  - {contact: [2, 3], at: S, normal: 90, mu: 0.35}
motion: {link: 2, turns: ccw}
loads:
  F: {force: 400, link: 3, at: H, angle: -90}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize("high", range(100, 150, 5))
def test_a_lever_that_all_but_lies_along_its_shoe_has_no_slit(high: int) -> None:
    """No hole of a link is so narrow that the lines about it are one blot."""
    shape = body_of(scene_of(known_of(icsolve.load(BRAKE.replace("HIGH", str(high))))), "3").shape
    assert shape is not None and shape.geom_type == "Polygon"
    assert not any(shapely.Polygon(ring).buffer(-1.0).is_empty for ring in shape.interiors)
