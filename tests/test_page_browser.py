"""Pages in a real headless Chromium: the slider moves the crank, the number is that of `solve`, the steps add
the lines in the order of finding; no console error, and no request leaves the page.

Without a browser these tests are skipped and say why; with ICSOLVE_BROWSER=required that is a failure.
"""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import icsolve
from browser import Browser
from icsolve.draw import Drawing, draw
from icsolve.draw.loads import load_words
from icsolve.draw.marks import plain_text
from icsolve.draw.ropes import courses
from icsolve.draw.words import figure_number, unit_word
from icsolve.page import page_html
from icsolve.page.motion import PageMotion, motion_of
from icsolve.page.pictures import figure_of
from icsolve.report.derivation.known import acting_loads, known_of
from icsolve.report.derivation.ratios import needed_steps
from icsolve.wording import holding
from library import FILES, PAGED, known, motion, page_of, sample
from pictures import parsed
from sizes import sampled
from test_page import hostile, ten_links

DRIVEN = {
    "linkages/four_bar.yaml": (-90, 15, 50),
    "ch13/13_07_slider_crank.yaml": (-120, 37, 150),
    "linkages/peaucellier.yaml": (-90, -40, 12),
    "sliders/quick_return.yaml": (-170, -33, 101),
    "sliders/wedge.yaml": (-41, 8, 30),
}
"""Cases, and three positions of each in degrees from the position as written; of the wedge, in mm."""


@pytest.fixture
def opened(window: Browser, tmp_path: Path) -> Any:
    """Opens a page's text; at the end of the test nothing was complained of, and nothing else asked for."""
    asked: list[Path] = []

    def open_page(text: str, name: str = "page.html") -> Browser:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        asked.append(path)
        window.open(path)
        return window

    yield open_page
    assert window.logs() == []
    assert window.requests() == [path.as_uri() for path in asked[-1:]]


def turn(window: Browser, degrees: float) -> None:
    """Pull the slider, as a finger does: its value, then the event of it."""
    window.run(
        """const slider = document.getElementById('turn');
        slider.value = arguments[0];
        slider.dispatchEvent(new Event('input'))""",
        str(degrees),
    )


def drawn_at(window: Browser, point: str) -> tuple[float, float]:
    """Where a joint's circle is now, in picture units."""
    x, y = window.run(
        """const c = document.querySelector(`#mechanism [data-at="${arguments[0]}"] circle`);
        const g = c.closest('[data-at]');
        const p = new DOMPoint(c.cx.baseVal.value, c.cy.baseVal.value);
        const back = g.ownerSVGElement.getScreenCTM().inverse();
        const q = p.matrixTransform(c.getScreenCTM()).matrixTransform(back);
        return [q.x, q.y];""",
        point,
    )
    return x, y


TRANSFORM = "return document.getElementById(arguments[0]).getAttribute('transform')"


def crank_end(name: str, found: PageMotion) -> str:
    """A pin of the driven link that moves."""
    case = icsolve.load(FILES[name])
    return next(
        p
        for p in case.carries[found.driver]
        if p in found.found.points and np.nanstd(found.found.points[p], axis=0).max() > 0.0
    )


@sampled(2)
@pytest.mark.parametrize("name", DRIVEN)
def test_the_slider_moves_the_crank(name: str, opened: Any) -> None:
    """The crank's pin is where the sweep has it, to a tenth of a picture unit and rounding of the angle."""
    window, found = opened(page_of(name)), motion(name)
    known = known_of(icsolve.load(FILES[name]))
    view = figure_of(known, needed_steps(known), found).scene.view
    point = crank_end(name, found)
    seen = []
    for degrees in DRIVEN[name]:
        turn(window, degrees)
        row = int(abs(found.degrees - degrees).argmin())
        x, y = found.found.points[point][row]
        assert drawn_at(window, point) == pytest.approx(view.at((x, y)), abs=0.3)
        seen.append(window.run(TRANSFORM, f"link-{found.driver}"))
    assert len(set(seen)) == 3


BETWEEN_LINKS = """
icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.5, 2.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  w: {distributed: NUMBERS, link: 3, from: B, to: C, angle: -100}
  v: {distributed: NUMBERS, link: 2, from: A, to: B, angle: 150, turns_with: 2}
  K: {torque: 3, link: 4, against: 3}
  L: {torque: 2, link: 3, against: 2}
  R: {force: 5, link: 4, at: C, toward: A, against: 2}
  T: {torque: unknown, link: 2}
"""
RUBBING = "motion: {link: 2, turns: ccw}\n"
"""With friction all positions are solved beforehand, and points that rest have no place in any of them."""
ENDS_OF = """return [...document.querySelectorAll(arguments[0])].map((g) => {
  const back = g.ownerSVGElement.getScreenCTM().inverse();
  const path = g.querySelector('path, polyline, line');
  return [0, path.getTotalLength()].map((length) => {
    const p = path.getPointAtLength(length).matrixTransform(path.getScreenCTM()).matrixTransform(back);
    return [p.x, p.y];
  });
});"""


@pytest.mark.parametrize("numbers", ["[20, 60]", "[60, -60]"])
@pytest.mark.parametrize("rubs", [False, True])
def test_loads_keep_to_their_links(numbers: str, rubs: bool, opened: Any) -> None:
    """The arrows of a line load stand side by side along its line in every position, the line through their
    tails ends at them, and the couple that a link takes from another stays about its pin, a force on it at
    its point, also where that rests."""
    text = BETWEEN_LINKS.replace("NUMBERS", numbers)
    if rubs:
        text = text.replace("at: A}", "at: A, mu: 0.1, radius: 0.05}") + RUBBING
    window = opened(page_html(icsolve.load(text)))
    for degrees in (0, 70, -110):
        turn(window, degrees)
        for name, ends in (("w", "BC"), ("v", "AB")):
            a, b = (complex(*drawn_at(window, point)) for point in ends)
            arrows = [[complex(*p) for p in line] for line in window.run(ENDS_OF, f"#load-{name} [data-end]")]
            along = [((tip - a) / (b - a)).real for _, tip in arrows]  # they may be told from the other end
            if along[0] > along[-1]:
                a, b = b, a
            for n, (_, tip) in enumerate(arrows):
                assert abs(tip - (a + n / (len(arrows) - 1) * (b - a))) < 20.0, (degrees, name, n)
            ((first, last),) = window.run(ENDS_OF, f"#load-{name} [data-tails]")
            assert abs(complex(*first) - arrows[0][0]) < 1.0 and abs(complex(*last) - arrows[-1][0]) < 1.0
        for name, pin, radius in (("K", "B", 25), ("L", "A", 25)):
            (arc,) = window.run(ENDS_OF, f"#load-{name} [data-end]")
            assert {round(abs(complex(*p) - complex(*drawn_at(window, pin)))) for p in arc} == {radius}
        ((tip, tail),) = window.run(ENDS_OF, "#load-R [data-end]")
        a, c = (complex(*drawn_at(window, point)) for point in "AC")
        assert min(abs(complex(*p) - a) for p in (tip, tail)) < 9.0
        assert abs(((complex(*tip) - a) / (c - a)).imag) < 1e-2


HELD = """
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0], C: [unknown, 10]}
lengths: {AB: 40, BC: 110, BF: 60, CF: 70}
angles: {AB: 50}
near: {C: [130, 10], F: [75, 60]}
links: {3: [F]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: RADIUS}
  - {pin: [2, 3], at: B, mu: 0.2, radius: RADIUS}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.3}
loads:
  P: {force: 80, link: 3, at: F, angle: 250}
  U12: LOAD
"""
SHOWN_OF = """const label = document.querySelector('#labels [data-label="U12"] text').textContent;
return [document.getElementById('answer-U12').textContent, label,
        Boolean(document.querySelector('#load-U12 .ghost, #load-U12.ghost'))]"""


@pytest.mark.parametrize(
    "load",
    ["{torque: unknown, link: 2}", "{force: unknown, link: 4, at: C, angle: 180}"],
)
@pytest.mark.parametrize("radius", [1, 12, 30])
def test_what_holds_over_a_range_is_told_so_in_every_position(load: str, radius: int, opened: Any) -> None:
    """The words of `solve` with its six digits in the answer, those of a drawing of that position beside the
    load; its arrow is not pale, as where there is no value."""
    case = icsolve.load(HELD.replace("RADIUS", str(radius)).replace("LOAD", load))
    found = motion_of(known_of(case), [])
    window = opened(page_html(case))
    assert found is not None
    rows = [n for n, word in enumerate(found.status) if word == "holds"]
    for row in rows[:: len(rows) // 5]:
        turn(window, found.degrees[row])
        here = known_of(found.found.case_of(row))
        assert here.answer is not None
        value = here.answer.answers["U12"]
        answer, label, pale = window.run(SHOWN_OF)
        assert answer == f"U12 {holding(value._replace(unit=unit_word(value.unit)), six_digits)}"
        (acting,) = (a for a in acting_loads(here) if a.load.name == "U12")
        assert (label, pale) == (plain_text(load_words(acting)), False)


def six_digits(value: float) -> str:
    return figure_number(value, 6)


TURNED = """
icsolve: 1
points: {A: [0, 0], B: [1, 0.5]}
joints: [{pin: [1, 2], at: A}]
loads:
  M: {torque: NUMBER, link: 2}
  N: {torque: NUMBER, link: 2, turns: cw}
  F: {force: NUMBER, link: 2, at: B, angle: 30}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize("number", ["0", "5", "-5", "1e-7"])
def test_beside_a_load_stands_what_a_drawing_has_there(number: str, opened: Any) -> None:
    """Size, unit and sense, which none has that is zero."""
    case = icsolve.load(TURNED.replace("NUMBER", number))
    window = opened(page_html(case))
    said = window.run(
        "return [...document.querySelectorAll('#labels [data-label] text')].map(e=>e.textContent)"
    )
    assert {*said} == {plain_text(load_words(acting)) for acting in acting_loads(known_of(case))}


WHEELS = """
icsolve: 1
points: {{A: [0.1, 0.2], D: [3.1, 0.7]}}
joints:
  - {{pin: [1, 2], at: A{rough}}}
  - {{pin: [1, 3], at: D}}
  - {{gears: [2, 3], teeth: [20, 40], pressure angle: 20}}
loads: {{M: {{torque: 5, link: 3}}, T: {{torque: unknown, link: 2}}}}
motion: {{link: 2, speed: {speed}}}
"""


@pytest.mark.parametrize("speed", ["0.3", "4e6", "-7e-6"])
@pytest.mark.parametrize("rough", ["", ", mu: 0.1, radius: 0.05"])
def test_points_at_rest_have_no_velocity(rough: str, speed: str, opened: Any) -> None:
    """The pivots of wheels, which turn however fast or slowly: rounding is no motion."""
    window = opened(page_html(icsolve.load(WHEELS.format(rough=rough, speed=speed))))
    window.run("const e = document.getElementById('see-velocities'); e.click()")
    for degrees in (0, 35, -115):
        turn(window, degrees)
        assert window.text("#see-hint") == ""
        assert window.run("return document.querySelectorAll('#overlay .v-arrow').length") == 0


MOVED = """
icsolve: 1
points: {{A: {}, B: {}, C: {}, D: {}}}
joints:
  - {{pin: [1, 2], at: A, mu: 0.1, radius: 0.05}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads: {{M: {{torque: 5, link: 4}}, T: {{torque: unknown, link: 2}}}}
motion: {{link: 2, speed: 2}}
"""


def test_velocities_are_told_alike_wherever_the_origin_lies(opened: Any) -> None:
    """Twenty thousand lengths of a crank away, of a page that is solved beforehand."""
    seen = []
    for x, y in ((0, 0), (20000, -30000)):
        places = ([x + 0.5 * u, y + 0.5 * v] for u, v in ((0, 0), (1, 2), (6, 4), (8, 0)))
        window = opened(page_html(icsolve.load(MOVED.format(*places))))
        window.run("const e = document.getElementById('see-velocities'); e.click()")
        for degrees in (0, 25, -30):
            turn(window, degrees)
            seen.append(window.text("#see-hint"))
    assert seen[:3] == seen[3:] and all(told.count(" m/s") == 2 for told in seen)


def test_the_contact_of_a_cam_follows(opened: Any) -> None:
    """The dot is shown in other positions too, where the sweep has it, to a tenth of a picture unit."""
    name = "cams/offset_roller_follower.yaml"
    window, found = opened(page_of(name)), motion(name)
    known = known_of(icsolve.load(FILES[name]))
    view = figure_of(known, needed_steps(known), found).scene.view
    seen = set()
    for degrees in (-90, 40, 120):
        turn(window, degrees)
        row = int(abs(found.degrees - degrees).argmin())
        x, y = found.found.touching["2-4"][row]
        hidden, cx, cy = window.run(
            """const g = document.querySelector('#mechanism [data-at^="@"]');
            const box = g.getBBox();
            const p = new DOMPoint(box.x + box.width / 2, box.y + box.height / 2).matrixTransform(g.getCTM());
            const q = p.matrixTransform(g.ownerSVGElement.getCTM().inverse());
            return [g.classList.contains('hidden'), q.x, q.y]"""
        )
        assert not hidden
        assert (cx, cy) == pytest.approx(view.at((x, y)), abs=0.3)
        seen.add((cx, cy))
    assert len(seen) == 3


@pytest.mark.parametrize("name", ["crank_and_rope", "tackle_four_parts", "differential_hoist", "windlass"])
def test_a_rope_lies_round_its_circles(name: str, opened: Any) -> None:
    """In other positions its line is as long as a drawing of that position has it, and begins and ends there:
    within a picture unit (an arc is drawn by chords there)."""
    window, found = opened(page_of(f"ropes/{name}.yaml")), motion(f"ropes/{name}.yaml")
    scene = figure_of(known(f"ropes/{name}.yaml"), [], found).scene
    for row in (found.first + 3, found.zero + 4):
        turn(window, found.degrees[row])
        points = {p: tuple(column[row]) for p, column in found.found.points.items()}
        (course,) = courses(scene._replace(known=scene.known._replace(points=points)))
        length, *ends = window.run(
            """const path = document.querySelector('[data-rope] path');
            const all = path.getTotalLength();
            const at = (s) => { const p = path.getPointAtLength(s); return [p.x, p.y]; };
            return [all, at(0), at(all)]"""
        )
        assert length == pytest.approx(shapely.LineString(course.line).length, rel=2e-3, abs=0.5)
        assert ends == [pytest.approx(p, abs=0.3) for p in (course.line[0], course.line[-1])]


@pytest.mark.parametrize("name", DRIVEN)
def test_the_number_is_that_of_solve(name: str, opened: Any) -> None:
    """Six digits, unit and sense, of each position solved as a case of its own."""
    window, found = opened(page_of(name)), motion(name)
    for degrees in DRIVEN[name]:
        turn(window, degrees)
        row = int(abs(found.degrees - degrees).argmin())
        for unknown, value in icsolve.solve(found.found.case_of(row)).answers.items():
            shown = window.text(f"#answers [data-answer='{unknown}']")
            number = f"{figure_number(abs(value.value), 6)} {unit_word(value.unit)}"
            assert shown.startswith(f"{unknown} = {number}, ")
            word = {"ccw": "counterclockwise", "cw": "clockwise"}.get(value.sense)
            assert word is None or shown.endswith(f", {word}")
            assert figure_number(abs(value.value), 4) in window.text(f"#label-{unknown}")


def test_the_number_is_that_of_the_command(opened: Any, tmp_path: Path) -> None:
    """The crank of the slider-crank 40 degrees farther, written into the file."""
    name = "sliders/slider_crank_in_line.yaml"
    case = icsolve.load(FILES[name])
    angle = next(a for a in case.angles if a.value.path == "angles.AB")
    window = opened(page_of(name))
    turn(window, 40)
    changed = icsolve.load(
        FILES[name].read_text(encoding="utf-8").replace(angle.value.digits, str(angle.value.value + 40), 1)
    )
    (unknown, value), *_ = icsolve.solve(changed).answers.items()
    assert f" = {figure_number(abs(value.value), 6)} " in window.text(f"[data-answer='{unknown}']")


LINES = """return [...document.querySelectorAll('#centres path.construction')]
    .filter((e) => !e.classList.contains('hidden')).map((e) => e.id)"""
CHORDS = """return [...document.querySelectorAll('#circle [data-step]')]
    .filter((e) => e.id.startsWith('chord-') && !e.classList.contains('hidden')).map((e) => e.id)"""


MARKED = """return [...document.querySelectorAll('#centres circle')]
    .filter((e) => !e.closest('.hidden')).map((e) => [e.cx.baseVal.value, e.cy.baseVal.value])"""


def test_centres_are_marked_where_the_sweep_has_them(opened: Any) -> None:
    """Every centre in the window is marked within half a picture unit; those in one place share the mark."""
    name = "linkages/peaucellier.yaml"
    window, found = opened(page_of(name)), motion(name)
    known = known_of(icsolve.load(FILES[name]))
    figure = figure_of(known, needed_steps(known), found)
    turn(window, 12)
    row = int(abs(found.degrees - 12).argmin())
    wanted = set()
    for step in needed_steps(known):
        x, y, w = found.found.centres["-".join(step.centre.pair)][row]
        at = figure.scene.view.at((x / w, y / w)) if abs(w) > 1e-9 else (1e9, 1e9)
        left, top, right, bottom = figure.window
        if left <= at[0] <= right and top <= at[1] <= bottom:
            wanted.add(at)
    marks = window.run(MARKED)
    assert marks and all(min(math.dist(mark, at) for at in wanted) < 0.5 for mark in marks)
    assert all(min(math.dist(mark, at) for mark in marks) < 2.0 for at in wanted)


@pytest.mark.parametrize("name", [name for name in DRIVEN if name != "sliders/wedge.yaml"])
def test_the_steps_add_the_lines_in_the_order_of_finding(name: str, opened: Any) -> None:
    window = opened(page_of(name))
    known = known_of(icsolve.load(FILES[name]))
    steps = needed_steps(known)
    count = max(step.number for step in steps)
    window.click("#from-start")
    for n in range(count + 1):
        wanted = [
            f"line-{'-'.join(step.centre.pair)}-{k}"
            for step in steps
            if 0 < step.number <= n
            for k, line in enumerate(step.centre.lines, 1)
        ]
        assert sorted(window.run(LINES)) == sorted(wanted)
        chords = {f"chord-{'-'.join(step.centre.pair)}": step.number for step in steps}
        seen = set(window.run(CHORDS))
        assert all((name in seen) == (number <= n) for name, number in chords.items())
        assert window.text("ol.steps [aria-current]") == window.text("#said")
        window.click("#next")
    assert window.run("return document.getElementById('next').disabled")
    window.click("#back")
    assert window.text("#said").startswith(f"Step {count}" if count else "By inspection")


def test_the_keyboard_turns_the_input(opened: Any) -> None:
    window = opened(page_of("sliders/quick_return.yaml"))
    window.press("#turn", "right", "right", "right")
    assert window.text("#angle") == "3° counterclockwise"
    window.press("#turn", "left", "left", "left", "left")
    assert window.text("#angle") == "1° clockwise"
    window.press("#turn", "home")
    assert window.text("#angle") == "180° clockwise"
    window.press("#written", "enter")
    assert window.text("#angle") == "as written"


def test_the_slider_stops_where_the_links_no_longer_meet(opened: Any) -> None:
    window, found = opened(page_of("linkages/four_bar.yaml")), motion("linkages/four_bar.yaml")
    end = found.degrees[found.last]
    turn(window, end + 40)
    assert float(window.run("return document.getElementById('turn').value")) == end
    assert window.text("#hint") == f"The links do not meet beyond {figure_number(end)}°."
    turn(window, 0)
    assert window.text("#hint") == ""


def test_a_dead_centre_is_said(opened: Any) -> None:
    """The scotch yoke at full stroke: no number, the arrow pale, the sentence below the slider."""
    window = opened(page_of("sliders/scotch_yoke.yaml"))
    found = motion("sliders/scotch_yoke.yaml")
    dead = next(d for d, word in zip(found.degrees, found.status, strict=True) if word == "dead-centre")
    turn(window, dead)
    assert window.text("#hint").startswith("Dead centre")
    assert "no value" in window.text("#answers")
    assert window.run("return document.querySelectorAll('#loads .ghost').length") == 1


def test_play_and_pause(opened: Any) -> None:
    window = opened(page_of("sliders/quick_return.yaml"))
    angle = "return document.getElementById('angle').textContent"
    window.click("#play")
    seen = {window.run(angle) for _ in range(15) if time.sleep(0.05) is None}
    assert len(seen) > 3 and window.text("#play") == "Pause"
    window.click("#play")
    held = window.run(angle)
    time.sleep(0.3)
    assert window.run(angle) == held and window.text("#play") == "Play"


def test_reduced_motion_plays_in_still_positions(opened: Any) -> None:
    """A position a second instead of a movement."""
    window = opened(page_of("sliders/quick_return.yaml"))
    window.media(prefers_reduced_motion="reduce")
    angle = "return document.getElementById('angle').textContent"
    window.click("#play")
    seen = [window.run(angle) for _ in range(24) if time.sleep(0.05) is None]
    window.click("#play")
    assert 2 <= len(set(seen)) <= 3


def test_a_plot_is_a_slider_too(opened: Any) -> None:
    """A press in the middle of the answer's plot goes to the middle of the range."""
    window = opened(page_of("ch13/13_07_slider_crank.yaml"))
    turn(window, 90)
    window.run(
        """const svg = document.getElementById('plot-0');
        const path = svg.querySelector('.cursor').getAttribute('d');
        const all = svg.getScreenCTM();
        const y = Number(path.split(',')[1].split(' ')[0]) + 20;
        const box = JSON.parse(document.getElementById('data').textContent).plots[0].box;
        const p = new DOMPoint((box[0] + box[2]) / 2, y).matrixTransform(all);
        svg.dispatchEvent(new PointerEvent('pointerdown', {clientX: p.x, clientY: p.y, buttons: 1}))"""
    )
    assert window.text("#angle") == "as written"


def test_the_terms_follow(opened: Any) -> None:
    """The equation of power: size times ratio of speeds is the product, and the sum is zero."""
    window, found = opened(page_of("ch13/13_07_slider_crank.yaml")), motion("ch13/13_07_slider_crank.yaml")
    turn(window, 37)
    row = int(abs(found.degrees - 37).argmin())
    ratio, value = found.shares["P"][row], found.found.answers["T12"][row]
    assert window.text("#ratio-0") == figure_number(ratio, 6)
    assert window.text("#size-0") == "10"
    assert window.text("#product-0") == figure_number(10.0 * ratio, 6)
    assert window.text("#root-product") == figure_number(value, 6)


NARROW = """const wide = document.documentElement.scrollWidth;
const small = [...document.querySelectorAll('button, input')].map((e) => e.getBoundingClientRect().height);
const text = [...document.querySelectorAll("#labels > g:not(.hidden) > text")].map((e) => {
  const box = e.getBoundingClientRect(); return box.height; });
return [wide, Math.min(...small), Math.min(...text)]"""


@pytest.mark.parametrize(
    "name", ["linkages/four_bar.yaml", "linkages/peaucellier.yaml", "ch13/13_10_black_box.yaml"]
)
def test_a_telephone_shows_it(name: str, opened: Any) -> None:
    """390 picture points: nothing to scroll sideways, controls for a finger, letters that can be read."""
    window = opened(page_of(name))
    window.size(390, 800)
    wide, control, text = window.run(NARROW)
    assert wide <= 390
    assert control >= 40.0
    assert text >= 9.0


def test_no_text_of_a_case_runs(opened: Any) -> None:
    window = opened(hostile())
    assert window.run("return document.title").startswith('</script><script>document.title="broken"')
    assert window.text("h1").endswith("漢字")
    turn(window, 10)
    assert "counterclockwise" in window.text("#angle")


def test_the_page_may_not_reach_the_network(chromium: Browser, tmp_path: Path) -> None:
    """The policy in the page refuses what a script asks for, and says so on the console."""
    path = tmp_path / "page.html"
    path.write_text(page_of("linkages/four_bar.yaml"), encoding="utf-8")
    chromium.open(path)
    asked = "return fetch('http://127.0.0.1:9/').then(() => 'answered', () => 'refused')"
    assert chromium.run(asked) == "refused"
    assert any("Content Security Policy" in line for line in chromium.logs())
    assert [url for url in chromium.requests() if url.startswith("http")] == []


def test_ten_links_move(opened: Any) -> None:
    window = opened(page_html(icsolve.load(ten_links())))
    before = window.run(TRANSFORM, "link-10")
    turn(window, 25)
    assert window.run(TRANSFORM, "link-10") != before


OVERLAPS = """const slider = document.getElementById('turn');
const found = [];
const places = slider ? [0, 0.3, 0.7].map((s) => Number(slider.min) + s * (slider.max - slider.min)) : [0];
for (const place of [...places, 0]) {
  if (slider) { slider.value = place; slider.dispatchEvent(new Event('input')); }
  const boxes = [...document.querySelectorAll('#labels > g')]
    .filter((e) => !e.classList.contains('hidden'))
    .map((e) => [e.textContent, e.querySelector('.badge') || e.querySelector('text')])
    .map(([words, e]) => [words, e.getBoundingClientRect()]);
  boxes.forEach(([a, p], n) => boxes.slice(0, n).forEach(([b, q]) => {
    const x = Math.min(p.right, q.right) - Math.max(p.left, q.left);
    const y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (x > 3 && y > 4) found.push(`${place}: ${a} on ${b}`);
  }));
}
return found"""


STRUCK = """return [...document.querySelectorAll('#labels [data-label] text')].filter((e) => {
  const box = e.getBoundingClientRect();
  return [...document.querySelectorAll('#centres path.construction:not(.hidden)')].some((line) => {
    const m = line.getScreenCTM();
    const length = line.getTotalLength();
    return [...Array(400).keys()].some((k) => {
      const p = line.getPointAtLength((length * k) / 399).matrixTransform(m);
      return p.x > box.left + 4 && p.x < box.right - 4 && p.y > box.top + 4 && p.y < box.bottom - 4;
    });
  });
}).map((e) => e.textContent)"""


@sampled(3)
@pytest.mark.parametrize(
    "name", ["linkages/four_bar.yaml", "linkages/stephenson_six_bar.yaml", "ch13/13_08_four_bar.yaml"]
)
def test_no_line_strikes_out_the_words_of_a_load(name: str, opened: Any) -> None:
    """The lines that find the centres go beside what is written at the loads."""
    assert opened(page_of(name)).run(STRUCK) == []


@pytest.mark.parametrize("block", range(4))
def test_every_case_runs_and_its_labels_can_be_read(block: int, opened: Any) -> None:
    """No message of the console, one request each, and at four positions no label on another."""
    for name in sample(PAGED, 2, "labels in a browser")[block::4]:
        window = opened(page_of(name), f"{block}.html")
        assert window.run(OVERLAPS) == [], name
        assert window.logs() == [], name
        assert len(window.requests()) == 1, name
    opened(page_of("sliders/wedge.yaml"))


@pytest.mark.parametrize(
    "name", ["linkages/peaucellier.yaml", "tools/tipper_two_rams.yaml", "linkages/four_bar.yaml"]
)
def test_drawings_reckon_with_wider_letters_than_a_browser_sets(name: str, opened: Any) -> None:
    """The labels of `draw` keep apart by reckoned widths: a browser's letters are narrower, by and large."""
    svg = draw(icsolve.load(FILES[name]), Drawing(circle=True, velocities=True))
    window = opened(svg, "drawing.svg")
    measure = "return [...document.querySelectorAll('text:not(.halo)')].map((e) => e.getComputedTextLength())"
    lengths = window.run(measure)
    for length, label in zip(lengths, parsed(svg).labels, strict=True):
        left, _, right, _ = label.box.bounds
        assert length <= right - left, label.text
