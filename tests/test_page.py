"""Pages: what they are made of, that their numbers are those of `solve`, and what no text in a case can do.

`test_page_browser.py` drives them in a real browser.
"""

from __future__ import annotations

import base64
import hashlib
import json
import math
import os
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.case import Pin
from icsolve.draw.bodies import pushes_on
from icsolve.numbers import FLOATS
from icsolve.page import page_html
from icsolve.page.document import equation_of
from icsolve.page.fields import text_data
from icsolve.page.live import live_of
from icsolve.page.motion import forces_data, motion_of
from icsolve.page.pictures import figure_of
from icsolve.report.derivation.known import acting_loads, known_of
from icsolve.scene.refusals import rubs
from icsolve.screws.ropes import offsets_of, rope_length
from icsolve.sweep.varied_numbers import numbers_of
from library import FILES, LIBRARY, PAGED, known, motion, page_of
from shell import exit_status
from sizes import FULL, sampled
from test_profile_sweep import CAMS

ROOT = Path(__file__).parent.parent
LARGEST = 300_000
STILL = {
    "black_box/given_centres.yaml": "A given centre holds in the position as written only",
    "cams/flat_follower.yaml": "cannot be moved: its profile is not known",
    "ch13/13_22_robot_arm.yaml": "This case is in space",
    "gears/differential_train.yaml": "more freedoms than numbers that move it",
}
SLIDER = "ch13/13_07_slider_crank.yaml"
VOID = {"meta", "input", "br"}


class Reader(HTMLParser):
    """The tags of a page: whether they nest, its ids, its attributes, what its scripts and texts say."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.attributes: list[tuple[str, str]] = []
        self.scripts: list[str] = []
        self.texts: list[str] = []
        self.tags: Counter[str] = Counter()
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] += 1
        if tag not in VOID:
            self.open.append(tag)
        self.note(attrs)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] += 1
        self.note(attrs)

    def note(self, attrs: list[tuple[str, str | None]]) -> None:
        self.attributes += [(name, value or "") for name, value in attrs]
        self.ids += [value or "" for name, value in attrs if name == "id"]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open[-1:] == ["script"]:
            self.scripts.append(data)
        elif self.open[-1:] != ["style"]:
            self.texts.append(data)


def model_of(page: str) -> dict[str, Any]:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    model: dict[str, Any] = json.loads(found[1])
    return model


def column(packed: dict[str, Any]) -> np.ndarray:
    """A column as the script reads it."""
    if "v" in packed:
        return np.array([math.nan if v is None else v for v in packed["v"]], float)
    values = np.cumsum(np.cumsum(packed["d"])) / packed["s"]
    values[packed.get("n", [])] = math.nan
    return values


@pytest.mark.parametrize("name", PAGED)
def test_every_case_pages(name: str) -> None:
    """Tags nest, ids stand once, nothing is loaded from anywhere, and it is small."""
    page = page_of(name)
    reader = Reader(page)
    assert len(page.encode()) < LARGEST
    assert reader.open == []
    assert [i for i, count in Counter(reader.ids).items() if count > 1] == []
    assert not {"link", "img", "iframe", "object", "embed", "base", "form"} & set(reader.tags)
    loading = {"src", "href", "style"}
    assert not {key for key, _ in reader.attributes if key in loading or key.startswith("on")}
    assert "http" not in re.sub(r'"http://www\.w3\.org/2000/svg"', "", "".join(reader.scripts[1:]))
    assert "NaN" not in reader.scripts[0] and "Infinity" not in reader.scripts[0]


@pytest.mark.parametrize("name", sorted({*PAGED, *STILL}))
def test_every_case_moves_or_says_why_not(name: str) -> None:
    page = page_of(name)
    moves = "motion" in model_of(page)
    reason = re.search(r'<p class="hint still">(.*?)</p>', page)
    assert moves == (reason is None)
    if name in STILL:
        assert reason is not None and STILL[name] in reason[1]


@pytest.mark.parametrize("name", [name for name in PAGED if icsolve.load(FILES[name]).reconstructed])
def test_what_is_reconstructed_is_said(name: str) -> None:
    assert icsolve.load(FILES[name]).reconstructed in "".join(Reader(page_of(name)).texts)


@sampled(3)
@pytest.mark.parametrize(
    "name", ["linkages/four_bar.yaml", "ch13/13_07_slider_crank.yaml", "tools/bolt_cutter.yaml"]
)
def test_the_numbers_are_those_of_solve(name: str) -> None:
    """Each position as a case of its own, solved alone: twelve digits, as many as the page holds (the sweep
    and the single scene may round differently in the last few of sixteen)."""
    model, moved = model_of(page_of(name)), motion(name)
    for answer in model["answers"]:
        values = column(answer["values"])
        assert len(values) == model["motion"]["rows"]
        for row in np.linspace(moved.first, moved.last, 9).astype(int).tolist():
            if moved.status[row] == "ok":
                alone = icsolve.solve(moved.found.case_of(row)).answers[answer["name"]]
                assert values[row - moved.first] == pytest.approx(alone.value, rel=1e-10)


SPRUNG = """
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [60, 30], C: [30, 15], D: [-100, 0], E: [200, 40]}
joints:
  - {slide: [2, 1], at: A, along: 0}
  - {slide: [3, 1], at: B, along: 90}
  - {slide: [2, 3], at: C, along: 30}
loads:
  W: {weight: 100, link: 3, at: B}
  S: {spring: 2 N/mm, free: 60 mm, link: 2, at: A, to: D}
  R: {force: 40, link: 3, at: B, toward: E}
  P: {force: unknown, link: 2, at: A, angle: 0}
"""


def test_where_everything_slides_a_link_is_moved() -> None:
    """Closed form by virtual work: the wedge goes s, the block ``rise`` times s, the spring is 100 + s
    long. To 1e-9, a little more than rounding."""
    known = known_of(icsolve.load(SPRUNG))
    found = motion_of(known, ())
    assert found is not None
    rise = -known.twists["3"][0] / known.twists["2"][1]
    assert abs(rise) == pytest.approx(math.tan(math.radians(30.0)))
    for row in range(0, len(found.degrees), 10):
        s = found.degrees[row]
        x, y = 60.0, 30.0 + rise * s
        assert found.found.points["A"][row] == pytest.approx([s, 0.0])
        assert found.found.points["B"][row] == pytest.approx([x, y])
        if s == -100.0:  # the spring has no length, and no direction
            assert found.status[row] != "ok"
            continue
        up = 40.0 * (40.0 - y) / math.hypot(200.0 - x, 40.0 - y) - 100.0
        spring = -2.0 * (100.0 + s - 60.0)
        assert found.found.answers["P"][row] == pytest.approx(-spring - rise * up, rel=1e-9)
    model = model_of(page_html(known))["motion"]
    assert (model["verb"], model["unit"], model["senses"]) == ("moved", " mm", ["at 0°", "at 180°"])


def test_a_way_in_any_unit_has_positions() -> None:
    """The same wedge a millionth as large: the slider's numbers are not rounded away."""
    small = re.sub(r"([A-E]): \[(-?\d+), (\d+)\]", r"\1: [\2e-6, \3e-6]", SPRUNG)
    small = small.replace("free: 60 mm", "free: 6e-5 mm")
    model = model_of(page_html(icsolve.load(small)))["motion"]
    assert model["step"] > 0.0
    assert model["first"] + model["step"] * (model["rows"] - 1) == pytest.approx(model["high"])


def test_a_slide_on_a_link_that_turns_has_no_straight_way() -> None:
    """The trammel and the Oldham coupling turn, in degrees."""
    for name in ("sliders/elliptic_trammel.yaml", "sliders/oldham_coupling.yaml"):
        assert model_of(page_of(name))["motion"]["verb"] == "turned"


def test_the_position_as_written_is_in_every_motion() -> None:
    """Row zero has the answer of the case, and every place where the case has it."""
    for name in PAGED:
        model, case = model_of(page_of(name)), icsolve.load(FILES[name])
        if "motion" not in model:
            continue
        own, zero = icsolve.solve(case).answers, model["motion"]["zero"]
        assert model["motion"]["first"] + zero * model["motion"]["step"] == pytest.approx(0.0, abs=1e-6)
        for answer in model["answers"]:
            value = column(answer["values"])[zero]
            if answer["name"] in own and own[answer["name"]].holds is None:
                assert value == pytest.approx(own[answer["name"]].value, rel=1e-8), name


@sampled(2)
@pytest.mark.parametrize(
    "name", ["linkages/peaucellier.yaml", "tools/scissor_lift.yaml", "gears/epicyclic_train.yaml"]
)
def test_links_keep_their_shape(name: str) -> None:
    """A link's pose carries its points to where the sweep has them: within a third of a picture unit."""
    case = icsolve.load(FILES[name])
    model = model_of(page_of(name))
    places = {p: (column(o["x"]), column(o["y"])) for p, o in model["motion"]["points"].items()}
    zero = model["motion"]["zero"]
    for link, pose in model["motion"]["links"].items():
        turn = np.radians(column(pose["a"]))
        for point in case.carries[link]:
            if point in places and point != "@":
                x, y = places[point]
                dx, dy = x[zero] - pose["from"][0], y[zero] - pose["from"][1]
                across = column(pose["x"]) + np.cos(turn) * dx + np.sin(turn) * dy
                down = column(pose["y"]) - np.sin(turn) * dx + np.cos(turn) * dy
                assert np.abs(across - x).max() < 0.33 and np.abs(down - y).max() < 0.33


def test_the_terms_add_up_to_zero_in_every_position() -> None:
    """The equation of power: known loads times their ratios of speeds, and the unknown (virtual work)."""
    for name in ("ch13/13_02_four_bar_free_bodies.yaml", "springs/balanced_arm.yaml", SLIDER):
        model = model_of(page_of(name))
        root = model["root"]
        unknown = column(model["answers"][0]["values"]) * column(root["gain"]) * root["sign"]
        terms = [t["sign"] * column(t["ratio"]) * column(t["size"]) for t in model["terms"]]
        size = np.maximum.reduce([np.abs(unknown), *(np.abs(t) for t in terms)])
        known = np.isfinite(unknown)
        assert known.sum() > 300
        assert (np.abs(sum(terms) + unknown)[known] <= 1e-8 * size[known]).all()


EXERTED = {
    "W: {mass: 3 kg, link: 4, at: C}": ("W g", "N"),
    "P: {force: 10, link: 4, at: C, angle: 180}": ("P", "N"),
    "s: {spring: 0.2 N/mm, link: 4, at: C, to: A, free: 20}": ("s s s", "N"),
    "k: {spring: 20 N*m/rad, corner: BCD, free: 90, link: 4, against: 3}": ("k s k", "N·m"),
    "k: {spring: 20 N*m/rad, corner: DC, free: 90, link: 4}": ("k s k", "N·m"),
    "p: {pressure: 2 MPa, bore: 20, link: 4, at: C, angle: 180}": ("p A p", "N"),
    "q: {distributed: 2 N/mm, link: 4, from: D, to: C, angle: 180}": ("q L q", "N"),
    "T: {torque: 2, link: 4}": ("T", "N·m"),
}
"""What a load of each kind exerts, as the worked solution writes it, and its unit."""


@sampled(2, "load", "asked")
@pytest.mark.parametrize("load", EXERTED)
@pytest.mark.parametrize("asked", [False, True], ids=["known", "asked"])
def test_the_equation_of_a_page_has_what_each_load_exerts_in_its_own_unit(load: str, asked: bool) -> None:
    """Name, factor and unit of a load, known or asked for: those of the worked solution below it."""
    symbols, unit = EXERTED[load]
    number = re.search(r"(mass|force|spring|pressure|distributed|torque): [^,]+", load)
    assert number is not None
    one = load.replace(number[0], f"{number[1]}: unknown") if asked else load
    known = known_of(icsolve.load(
        "icsolve: 1\nunits: {length: mm, force: N, torque: N*m}\npoints: {A: [0, 0], D: [100, 0]}\n"
        "lengths: {AB: 25, BC: 87.5, CD: 62.5}\nangles: {AB: 60}\nnear: {C: [87, 60]}\njoints:\n"
        "  - {pin: [1, 2], at: A}\n  - {pin: [2, 3], at: B}\n  - {pin: [3, 4], at: C}\n"
        f"  - {{pin: [4, 1], at: D}}\nloads:\n  {one}\n"
        f"  M: {{torque: {5 if asked else 'unknown'}, link: 2}}\n"
    ))  # fmt: skip
    equation = equation_of(known, motion_of(known, []))
    assert equation is not None
    told, its = equation.root if asked else (equation.rows[0][0], equation.rows[0][3])
    assert re.sub(r"\s+", " ", re.sub("<[^>]+>", " ", told)).strip() == symbols
    assert its.replace("*", "·") == unit
    (acting,) = (one for one in acting_loads(known) if one.load.name == load.partition(":")[0])
    shown = column(equation.data[0]["size"])[motion_of(known, []).zero] if not asked else None
    whole = math.hypot(*acting.force) if acting.at else acting.couple * 1e-3
    assert shown is None or shown == pytest.approx(whole)


def test_a_range_that_ends_is_shown_to_end() -> None:
    """The four-bar of 4 + 3 < 2.5 + 5 rocks: the rows that do not assemble are not in the page."""
    model = model_of(page_of("linkages/four_bar.yaml"))["motion"]
    last = model["first"] + model["step"] * (model["rows"] - 1)
    assert not model["turns"]
    assert model["low"] < model["first"] and last < model["high"]
    assert 'class="gap"' in page_of("linkages/four_bar.yaml")


def test_dead_centres_stand_on_the_track() -> None:
    """A scotch yoke's torque at full stroke holds no force: two dead centres, a half turn apart."""
    dead = model_of(page_of("sliders/scotch_yoke.yaml"))["motion"]["dead"]
    assert len(dead) == 2 and dead[1] - dead[0] == pytest.approx(180.0)
    assert page_of("sliders/scotch_yoke.yaml").count('<line class="dead"') == 2


def test_a_small_range_has_small_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """The single flier turns by less than 20 degrees: more rows than degrees."""
    if not FULL:  # what takes longest, and says nothing of the steps
        monkeypatch.setattr("icsolve.page.motion._dead", lambda *_: [])
    model = model_of(page_html(known_of(icsolve.load(FILES["linkages/single_flier.yaml"]))))["motion"]
    assert model["step"] < 1.0 and model["rows"] > 60


def test_friction_moves_too() -> None:
    name = "ch13/13_16_slider_crank_with_friction.yaml"
    assert rubs(icsolve.load(FILES[name]))
    model = model_of(page_of(name))
    assert model["motion"]["turns"] and model["motion"]["rows"] == 73
    assert model["terms"] is None


@sampled(2)
@pytest.mark.parametrize("name", ["dynamics/slider_crank_piston.yaml", "dynamics/hoist_starting.yaml"])
def test_inertia_forces_are_those_of_each_position(name: str) -> None:
    """Answers and inertia forces of rows are those of the rows solved as cases of their own."""
    model, found = model_of(page_of(name)), motion(name)
    for row in range(3, len(found.found), 20):
        solved = icsolve.solve(found.found.case_of(row))
        for answer in model["answers"]:
            assert column(answer["values"])[row] == pytest.approx(solved.answers[answer["name"]].value)
        for load in solved.case.loads:
            if load.name.startswith("inertia "):
                size = math.hypot(load.x.value, load.y.value) if hasattr(load, "x") else load.value.value
                assert column(model["loads"][load.name]["values"])[row] == pytest.approx(size, abs=1e-9)


def test_a_driver_that_all_but_stands_still_is_one_in_the_page_too() -> None:
    """Its slot is 1e-13 degrees off the line of its slide: what doubles take for a dead centre is none."""
    known = known_of(
        icsolve.load("""icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 0.2}
angles: {AB: 30}
links: {3: {mass: 5 kg, centre: C}}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [2, 3], at: B, along: 1e-13, through: C}
  - {slide: [3, 1], at: C, along: 0}
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 10}
dynamic: yes
""")
    )
    assert known.refusal is None
    assert live_of(known) is not None and page_html(known)


@pytest.mark.parametrize("name", ["tackle_four_parts", "windlass", "counterweight_door"])
def test_a_rope_keeps_its_length_as_it_moves(name: str) -> None:
    """Its parts and what lies on pulleys, less what a drum has let go: r times the angle that it turned."""
    found = motion(f"ropes/{name}.yaml")
    (rope,) = icsolve.load(FILES[f"ropes/{name}.yaml"]).ropes
    drum = found.poses.get(rope.links[0])
    offset = float(offsets_of(rope, 1.0, FLOATS)[0])
    lengths = []
    for row in range(found.first, found.last + 1, 7):
        points = {p: tuple(found.found.points[p][row]) for p in rope.points}
        turned = 0.0 if drum is None else math.radians(drum.angle[row])
        lengths.append(rope_length(rope, points, 1.0, FLOATS) - offset * turned)
    assert lengths == pytest.approx([lengths[0]] * len(lengths))
    ends = found.found.points[rope.points[-1]][found.first : found.last + 1]
    assert np.ptp(ends, axis=0).max() > 0.1


HOSTILE = """\
icsolve: 1
title: '</script><script>document.title="broken"</script> & "quotes" <b>ü</b> \u2019 漢字'
source: "<img src=x onerror=alert(1)> --> ]]>"
reconstructed: '</style><script>alert(2)</script>'
points: {A: [0, 0], B: [1, 2], C: [4, 3], D: [5, 0], É: [2, 2]}
joints:
  - {pin: [1, constructor], at: A}
  - {pin: [constructor, 3], at: B}
  - {pin: [3, __proto__x], at: C}
  - {pin: [__proto__x, 1], at: D}
loads:
  toString: {force: 100, link: __proto__x, at: C, angle: 200}
  T12: {torque: unknown, link: constructor}
"""


@cache
def hostile() -> str:
    text = HOSTILE.replace("__proto__x", "hasOwnProperty")
    return page_html(icsolve.load(text))


def test_no_text_of_a_case_can_break_the_page() -> None:
    reader = Reader(hostile())
    assert reader.open == []
    assert reader.tags["script"] == 2 and reader.tags["style"] == 1
    assert reader.tags["img"] == reader.tags["b"] == 0
    assert json.loads(reader.scripts[0])["motion"]["driver"] == "constructor"
    assert "".join(reader.texts).count('</script><script>document.title="broken"</script>') >= 1


def test_the_policy_lets_only_this_script_and_these_styles_run() -> None:
    page = hostile()
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)
    assert policy is not None
    rules = policy[1].replace("&#39;", "'").split("; ")
    assert rules[0] == "default-src 'none'"
    for tag, rule in (("script", "script-src"), ("style", "style-src")):
        body = re.findall(f"<{tag}>(.*?)</{tag}>", page, re.DOTALL)
        assert len(body) == 1
        digest = base64.b64encode(hashlib.sha256(body[0].encode()).digest()).decode()
        assert f"{rule} 'sha256-{digest}'" in rules


UNSOLVED = """\
icsolve: 1
title: nothing turns it
points: {A: [0, 0], B: [1, 2]}
joints: [{pin: [1, 2], at: A}]
loads:
  P: {force: 10, link: 2, at: B, angle: 0}
"""


def test_a_case_without_an_answer_pages_with_the_reason() -> None:
    text = UNSOLVED + "  Q: {force: unknown, link: 2, at: A, angle: 90}\n"
    page = page_html(icsolve.load(text))
    assert "<strong>No answer (no-value):</strong>" in page
    assert 'id="link-2"' in page and 'id="turn"' not in page


def test_a_case_without_an_unknown_shows_the_ratios_of_its_rates() -> None:
    text = FILES["linkages/four_bar.yaml"].read_text(encoding="utf-8")
    page = page_html(icsolve.load(text.partition("loads:")[0]))
    assert "Ratios of angular velocities" in page and "motion" in model_of(page)


def test_ten_links() -> None:
    """A crank-rocker and three dyads on end: the page moves, finds eighteen centres or more, and is small."""
    page = page_html(icsolve.load(ten_links()))
    model = model_of(page)
    assert len(model["motion"]["links"]) == 9
    assert model["steps"] >= 4
    assert len(page.encode()) < LARGEST


def ten_links() -> str:
    """Links 2 to 10: a crank-rocker whose rocker drives another by a rod, and so on."""
    points = "A: [0, 0], B: [0.6, 1], C: [4, 3], D: [5, 0], "
    joints = "[1, 2], at: A|[2, 3], at: B|[3, 4], at: C|[4, 1], at: D"
    for n in range(3):
        left, x = 2 * n + 4, 5.0 * n + 5.0
        e, f, g = (f"{letter}{n}" for letter in "EFG")
        points += f"{e}: [{x - 0.5}, 2], {f}: [{x + 3.8}, 3], {g}: [{x + 5}, 0], "
        joints += f"|[{left}, {left + 1}], at: {e}|[{left + 1}, {left + 2}], at: {f}|[{left + 2}, 1], at: {g}"
    listed = "\n".join(f"  - {{pin: {joint}}}" for joint in joints.split("|"))
    return (
        f"icsolve: 1\ntitle: Ten links in a chain\npoints: {{{points.rstrip(', ')}}}\njoints:\n{listed}\n"
        "loads:\n  T12: {torque: unknown, link: 2}\n  P: {force: 100, link: 10, at: F2, angle: 180}\n"
    )


def test_the_same_bytes_on_every_run(tmp_path: Path) -> None:
    """Whatever order sets and dictionaries of another process have."""
    name, out = "linkages/geared_five_bar.yaml", tmp_path / "page.html"
    command = [sys.executable, "-m", "icsolve", "page", str(FILES[name]), "-o", str(out)]
    subprocess.run(command, cwd=ROOT, env={**os.environ, "PYTHONHASHSEED": "1"}, check=True)
    assert out.read_text(encoding="utf-8") == page_of(name)


def test_the_command_writes_a_page(tmp_path: Path) -> None:
    out = tmp_path / "press.html"
    assert exit_status("page", str(FILES["linkages/four_bar.yaml"]), "-o", str(out)) == 0
    assert out.read_text(encoding="utf-8") == page_of("linkages/four_bar.yaml")


def test_the_case_itself_is_never_written_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tmp_path / "case.yaml"
    case.write_bytes(FILES["linkages/four_bar.yaml"].read_bytes())
    link = tmp_path / "other.html"
    link.symlink_to(case)
    for out in (case, link):
        assert exit_status("page", str(case), "-o", str(out)) == 2
        assert "is one of the files read here" in capsys.readouterr().err
    assert case.read_bytes() == FILES["linkages/four_bar.yaml"].read_bytes()


def test_a_path_that_cannot_be_written_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for out in (tmp_path / "missing" / "a.html", tmp_path):
        assert exit_status("page", str(FILES["linkages/four_bar.yaml"]), "-o", str(out)) == 2
        assert "can't be written" in capsys.readouterr().err


def test_a_folder_is_no_page(capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_status("page", str(LIBRARY / "linkages")) == 2
    assert "name one case" in capsys.readouterr().err


def test_a_case_without_an_answer_has_exit_status_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, out = tmp_path / "case.yaml", tmp_path / "page.html"
    case.write_text(UNSOLVED + "  Q: {force: unknown, link: 2, at: A, angle: 90}\n", encoding="utf-8")
    assert exit_status("page", str(case), "-o", str(out)) == 1
    assert "no-value" in capsys.readouterr().err
    assert "No answer (no-value)" in out.read_text(encoding="utf-8")


def luminance(colour: str) -> float:
    """Relative luminance (WCAG 2.2, definition of relative luminance)."""
    digits = colour.lstrip("#")
    digits = "".join(2 * d for d in digits) if len(digits) == 3 else digits
    parts = [int(digits[k : k + 2], 16) / 255.0 for k in (0, 2, 4)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a: str, b: str) -> float:
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_text_has_the_contrast_of_wcag_aa(theme: int) -> None:
    """4.5 for text (1.4.3), 3 for what a control or a mark is seen by (1.4.11)."""
    style = (ROOT / "icsolve" / "page" / "page.css").read_text(encoding="utf-8")
    blocks = re.findall(r":root\{([^}]*)\}", style)
    colours = dict(re.findall(r"--(\w+):(#\w+)", blocks[theme]))
    for ink in ("ink", "muted", "known", "unknown", "centre"):
        assert contrast(colours[ink], colours["paper"]) >= 4.5, ink
    for ink in ("ink", "muted"):
        assert contrast(colours[ink], colours["panel"]) >= 4.5, ink
    assert contrast(colours["ink"], colours["lit"]) >= 4.5
    assert contrast(colours["muted"], colours["paper"]) >= 3.0
    assert contrast(colours["focus"], colours["paper"]) >= 3.0


def test_a_cam_turns_its_follower(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lobes by a spline under an offset roller: a whole turn, though no contact point is presolved."""
    monkeypatch.setattr("icsolve.page.motion.forces_data", lambda *_: {})  # of each position
    model = model_of(page_html(CAMS["roller on lobes"]))
    assert model["motion"]["turns"] and model["motion"]["step"] == 2.0
    assert set(model["motion"]["links"]) == {"2", "3"}


def test_a_jump_of_friction_is_no_dead_centre() -> None:
    """Where the slider turns round the force jumps with the friction; it does not run off to infinity."""
    model = model_of(page_of("ch13/13_19_slider_crank_friction_at_pins.yaml"))
    assert not [degrees for degrees in model["motion"]["dead"] if 80.0 < degrees < 95.0]


@sampled(2)
@pytest.mark.parametrize(
    "name", ["13_18_slider_crank_friction_everywhere", "13_19_slider_crank_friction_at_pins"]
)
def test_friction_circles_have_their_radius_and_go_with_their_pins(name: str) -> None:
    """r sin phi, tan phi = mu, to the hundredth of a picture unit that is written."""
    case, html = known(f"ch13/{name}.yaml").case, page_of(f"ch13/{name}.yaml")
    scale = float(re.findall(r'"scale":([^,]+),', html)[0])
    rubbing = [j for j in case.joints if isinstance(j, Pin) and j.friction and j.friction.radius]
    circles = dict(
        re.findall(r'<g id="joint-pin[^>]* data-at="(\w+)">\s*<circle class="box"[^>]* r="([^"]+)"', html)
    )
    assert circles.keys() == {pin.at for pin in rubbing} != set()
    for pin in rubbing:
        assert pin.friction is not None and pin.friction.radius is not None
        wanted = pin.friction.radius.value * math.sin(math.atan(pin.friction.mu.value)) * scale
        assert float(circles[str(pin.at)]) == pytest.approx(wanted, abs=0.006)


@sampled(2)
@pytest.mark.parametrize(
    "name", ["ch13/13_18_slider_crank_friction_everywhere", "dynamics/slider_crank_piston"]
)
def test_free_bodies_of_pages_solved_beforehand_are_in_equilibrium(name: str) -> None:
    """Forces and moments of what acts on every link add up to nothing in each position, to the six digits
    that are written: with friction, and with the inertia forces of the motion."""
    case, moving = known(f"{name}.yaml"), motion(f"{name}.yaml")
    scene = figure_of(case, (), moving).scene
    units, solved = case.case.units, 0
    for body in forces_data(scene, moving)["links"].values():
        columns = [
            [np.array(p[part]["v"], dtype=float) for part in ("x", "y", "u", "v", "couple")]
            for p in body["pushes"]
        ]
        for row in range(moving.last + 1 - moving.first):
            force, moment, most = np.zeros(2), 0.0, 0.0
            for x, y, u, v, couple in ([column[row] for column in one] for one in columns):
                if math.isfinite(u):
                    force += u, v
                    moment += (x * v + y * u) / scene.view.scale + couple / units.torque_per_force_length
                    most = max(most, math.hypot(u, v))
                    solved += 1
            assert np.abs(force).max(initial=0.0) <= 1e-5 * most
            assert abs(moment) <= 1e-5 * most * case.size
    assert solved > 100


def test_forces_in_rubbing_pins_touch_their_friction_circles() -> None:
    """In free bodies the force lies r sin phi from the pin's centre, square to the way there, without couple
    (Waldron and Kinzel, section 13.5): all pins rub and slip here."""
    case = known("ch13/13_18_slider_crank_friction_everywhere.yaml")
    scene = figure_of(case, (), None).scene
    circles = {
        pin.at: pin.friction.radius.value * math.sin(math.atan(pin.friction.mu.value)) * scene.view.scale
        for pin in case.case.joints
        if isinstance(pin, Pin) and pin.friction and pin.friction.radius
    }
    seen = set()
    for link in case.case.links[1:]:
        for push in pushes_on(scene, link):
            if push.circle is not None:
                pin = next(name for name, at in scene.at.items() if math.dist(at, push.circle) < 1e-9)
                arm = np.subtract(push.at, push.circle)
                assert math.hypot(*arm) == pytest.approx(circles[pin], rel=1e-6)
                assert abs(arm @ push.force) <= 1e-9 * math.hypot(*push.force)
                assert push.couple == 0.0
                seen.add(pin)
    assert seen == circles.keys() != set()


@sampled(2)
@pytest.mark.parametrize("name", ["ch13/13_18_slider_crank_friction_everywhere", "cams/square_cam"])
def test_velocities_of_pages_solved_beforehand_are_those_of_the_turn(name: str) -> None:
    """Every point goes as the twists of its links say, by the positions before and after: to a hundredth."""
    case, moving = known(f"{name}.yaml"), motion(f"{name}.yaml")
    links = forces_data(figure_of(case, (), moving).scene, moving)["links"]
    most = seen = 0
    for body in links.values():
        x, y, turn = (np.array(part["v"], dtype=float) for part in body["twist"])
        for point in set(body["names"]) & moving.found.points.keys():
            p = moving.found.points[point][moving.first : moving.last + 1]
            v = np.column_stack((y - turn * p[:, 1], turn * p[:, 0] - x))[1:-1]
            way = p[2:] - p[:-2]
            slip = np.abs(v[:, 0] * way[:, 1] - v[:, 1] * way[:, 0])
            sizes = np.hypot(*v.T) * np.hypot(*way.T)
            fast = sizes > 0.05 * np.nanmax(sizes) if np.nanmax(sizes) > 1e-9 else sizes > 1.0
            most, seen = max(most, np.max(slip[fast] / sizes[fast], initial=0.0)), seen + int(fast.sum())
    assert seen > 50
    assert most < 0.01


TONGS = """\
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [0, unknown]}
lengths: {AC: 100, CD: 100, CE: 100, BC: 100, DF: 100, EF: 100}
angles: {AC: 28, ACD: 180, BCE: 180}
near: {B: [0, 94], F: [265, 47]}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [3, 1], at: B, along: 90}
  - {pin: [2, 3], at: C}
  - {pin: [2, 5], at: D}
  - {pin: [3, 4], at: E}
  - {pin: [4, 5], at: F}
loads: {P: {force: 120, link: 3, at: B, angle: 270}, Q: {force: unknown, link: 5, at: F, angle: 180}}
"""
"""Lazy tongs of one pair of bars and two halves."""


@pytest.mark.parametrize(
    ("tongs", "across"), [(TONGS, 300.0), *([(FILES["tools/lazy_tongs.yaml"], 500.0)] if FULL else [])]
)
def test_a_page_passes_a_change_point_without_a_jump(
    tongs: str | Path, across: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Lazy tongs fold flat exactly in one position, where two pins of the next pair coincide: no point goes
    farther from one degree to the next than three degrees of the longest way across [mm] would take it."""
    if not FULL:
        monkeypatch.setattr("icsolve.page.motion._dead", lambda *_: [])
    moving = motion_of(known_of(icsolve.load(tongs)), [])
    assert moving is not None and "change-point" in moving.status
    for place in moving.found.points.values():
        steps = np.hypot(*np.diff(place[moving.first : moving.last + 1], axis=0).T)
        assert steps.max() < math.radians(3.0) * across


def test_each_number_that_a_file_gives_has_its_place_in_the_text_that_is_copied() -> None:
    for name, path in FILES.items():
        case = icsolve.load(path)
        numbers = numbers_of(case)
        data = text_data(case, [*numbers])
        assert data is not None
        for number, place in zip(numbers.values(), data["at"], strict=True):
            if place is None:
                assert number.path == "gravity" or number.digits == "unknown", (name, number.path)
            else:
                assert data["text"][slice(*place)].startswith(number.digits), (name, number.path)


@pytest.mark.parametrize("name", ["slider_crank_piston", "atwood_machine", "unbalanced_rotor"])
def test_the_fields_and_the_text_of_a_dynamic_case_are_those_of_its_file(name: str) -> None:
    """Inertia forces follow from its masses and its motion: no field sets them, and no text has them."""
    case = icsolve.load(FILES[f"dynamics/{name}.yaml"])
    page = page_html(case)
    paths = set(re.findall(r'id="number-([^"]+)"', page))
    assert paths and paths <= numbers_of(case).keys()
    assert not any(path.startswith("inertia") for path in paths)
    assert '"text":"icsolve: 1' in page
