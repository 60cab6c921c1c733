"""Every command tells one truth of a case: values, senses, ranges, ratios and dead centres.

What `solve` finds is what `--report`, `explain`, `draw`, `check` and `page` say, over the library and over
random cases: torques that are positive clockwise, motions at points, springs, loads between two links.
"""

from __future__ import annotations

import json
import math
import re
from functools import cache
from html import unescape
from pathlib import Path
from random import Random
from typing import Any
from zipfile import ZipFile

import numpy as np
import pytest

import icsolve
import library
import mechanisms
import transcribe
from icsolve.answer import Answer
from icsolve.case import Case, Torque
from icsolve.case.expected import RatioIs
from icsolve.draw import draw
from icsolve.draw.words import figure_number
from icsolve.errors import SceneError, Status
from icsolve.explain import explain
from icsolve.manual import template
from icsolve.page import page_html
from icsolve.report import answer_text
from icsolve.report.check import compare, value_of
from icsolve.report.derivation.known import Known, known_of
from icsolve.report.derivation.ratios import answer_ratios
from icsolve.statics.load_wrenches import reacting
from icsolve.sweep import find_by_scenes
from icsolve.sweep.find_on_record import Query, find
from icsolve.wording import direction_words, holding, spelt
from library import FILES, PAGED, page_of, sample
from loading import drawn
from shell import exit_status
from sizes import FULL, sampled

MAKERS = (
    mechanisms.four_bar,
    mechanisms.slider_crank,
    mechanisms.inverted_slider_crank,
    mechanisms.quick_return,
    mechanisms.watt,
    mechanisms.scotch_yoke,
    mechanisms.gear_pair,
    mechanisms.rack,
    mechanisms.cam,
)
RANDOM = [(maker, seed) for maker in MAKERS for seed in range(3)]


def random_case(maker: mechanisms.Generator, seed: int) -> Case:
    """A sound scene with loads of all kinds, every second one with a motion given at a point."""
    scene = drawn(seed, maker)
    if seed % 2:
        answer = icsolve.solve(icsolve.load(transcribe.text(scene)), rates=True)
        moving = {
            key: v
            for key, v in (answer.velocities or {}).items()
            if not isinstance(v, str) and math.hypot(*v) > 1e-6
        }
        point, link = Random(seed).choice(sorted(moving))
        x, y = moving[(point, link)]
        angle = round(math.degrees(math.atan2(y, x)), 6)
        scene = scene | {"motion": {"point": point, "link": link, "speed": 0.25, "angle": angle}}
    return icsolve.load(transcribe.text(scene))


FOUR_PINS = """
icsolve: 1
units: {length: m, force: N}
points: {A: [0, 0], B: [1, 1], C: [4, 2], D: [4, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
"""
OTHERS = {
    "torsion spring, pressure, load along a line": FOUR_PINS
    + """  S: {spring: 20 N*m/rad, corner: ABC, free: 90, link: 3, against: 2}
  Q: {pressure: 8 kPa, bore: 50 mm, link: 4, at: C, angle: 180}
  W: {distributed: 200 N/m, link: 3, from: B, to: C, angle: -90}
  T: {torque: unknown, link: 2}
""",
    "rope, structure": """
icsolve: 1
points: {A: [0, 0], B: [2, 0], P: [2, 3]}
links: {2: [B]}
joints: [{pin: [1, 2], at: A}, {rope: [B, P], on: [2, 1]}]
loads: {W: {weight: 100, link: 2, at: B}}
""",
    "one point": """
icsolve: 1
points: {A: [0, 0]}
joints: [{pin: [1, 2], at: A}]
loads: {M: {torque: 10, link: 2}, T: {torque: unknown, link: 2}}
""",
    "unknown direction": """
icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [2, 0.5]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  P: {force: 10, link: 3, at: C, angle: -90}
  T: {torque: 4, link: 2}
  F: {force: [unknown, unknown], link: 3, at: C}
""",
    "unknown direction beside friction": """
icsolve: 1
points: {A: [0, 0], B: [1, 0.4], C: [2, 0.1]}
joints: [{pin: [1, 2], at: A, mu: 0.1, radius: 0.02}, {pin: [2, 3], at: B}]
motion: [{link: 2, speed: 1}, {link: 3, speed: 2}]
loads:
  W: {weight: 10, link: 3, at: C}
  M: {torque: 4, link: 2, turns: cw}
  F: {force: [unknown, unknown], link: 3, at: C}
""",
    "range of a capstan": """
icsolve: 1
points: {A: [0, 0], B: [0.9, -0.6], C: [-0.7, -0.5]}
joints:
  - {rope: [C, A, B], on: [3, 1], radii: {A: 0.2}, wraps: {A: cw}, mu: {A: 0.25}, turns: {A: 1}}
  - {slide: [3, 1], at: C, along: 90}
loads: {W: {weight: 200, link: 3, at: C}, F: {force: unknown, at: B}}
""",
    "position of equilibrium": """
icsolve: 1
points: {A: [0, 0]}
lengths: {AG: 1}
angles: {AG: unknown}
links: {2: [G]}
joints: [{pin: [1, 2], at: A}]
loads: {W: {weight: 10, link: 2, at: G}, M: {torque: 5, link: 2}}
""",
}


TOLD = {
    **OTHERS,
    **{kind: template(kind) for kind in ("spring", "torsion-spring", "counterweight", "screw-jack")},
    "screw": """
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {B: [0, 100]}
joints: [{screw: [1, 2], at: B, along: 90, lead: 6 mm, radius: 11 mm, mu: 0.12}]
loads: {W: {weight: 4 kN, link: 2, at: B}, T: {torque: unknown, screw: 1-2}}
motion: {point: B, link: 2, speed: 1, angle: -90}
""",
    "pressure": """
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], E: [250, -100], B: [330, 230], D: [165, 115]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: E}
  - {slide: [4, 3], at: D, along: [E, D]}
  - {pin: [2, 4], at: D}
loads:
  W: {mass: 60 kg, link: 2, at: B}
  p: {pressure: unknown, bore: 40 mm, link: 4, at: D, away: E, against: 3}
""",
    "mass": """
icsolve: 1
points: {A: [0, 0], B: [-0.3, 0.1], C: [0.7, -0.05]}
joints: [{pin: [1, 2], at: A}]
loads: {M: {mass: 12 kg, link: 2, at: C}, m: {mass: unknown, link: 2, at: B}}
""",
    "mass that would have to lift": """
icsolve: 1
points: {A: [0, 0], B: [0.3, 0.1], C: [0.7, -0.05]}
joints: [{pin: [1, 2], at: A}]
loads: {M: {mass: 12 kg, link: 2, at: C}, m: {mass: unknown, link: 2, at: B}}
""",
    "spring that would have to push": """
icsolve: 1
points: {A: [0, 0], B: [0.3, 0], C: [0.3, -0.5]}
joints: [{pin: [1, 2], at: A}]
loads: {M: {mass: 12 kg, link: 2, at: B}, S: {spring: unknown, free: 0.2, link: 2, at: B, to: C}}
""",
    "space": """
icsolve: 1
points: {A: [0, 0, 0], B: [0, 0, 0.4], C: [0.3, 0.1, 0.2]}
joints: [{thrust: [1, 2], at: A, axis: z}, {radial: [1, 2], at: B, axis: z}]
loads: {F: {force: [10, 25, 5], link: 2, at: C}, T: {torque: unknown, link: 2, along: z}}
""",
}


@pytest.mark.parametrize("kind", TOLD)
def test_what_is_told_is_taken_as_an_expected_value_and_as_an_answer(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The size with its unit and the sense in words, as `solve` tells them; the other sense is not."""
    found = {name: one for name, one in icsolve.solve(icsolve.load(TOLD[kind])).answers.items() if one.sense}
    expect = "".join(f"  {name}: {abs(one.value)} {one.unit} {one.sense}\n" for name, one in found.items())
    path = tmp_path / "case.yaml"
    path.write_text(f"{TOLD[kind]}\nexpect:\n{expect}", encoding="utf-8")
    assert exit_status("check", str(path)) == 0, capsys.readouterr()
    table = tmp_path / "answers.csv"
    for name, one in found.items():
        words = (
            [one.sense]
            if one.unit in ("kg", "N/mm", "N*m/rad")
            else [one.sense, {"cw": "ccw", "ccw": "cw"}.get(one.sense)]
        )
        rows = "".join(
            f'{n},case:{name},"{abs(one.value)} {one.unit} {w}"\n' for n, w in enumerate(words) if w
        )
        table.write_text(f"student_id,case,answer\n{rows}", encoding="utf-8")
        graded = tmp_path / f"{name}.csv"
        code = exit_status("grade", str(table), "--cases", str(path), "-o", str(graded))
        assert code == (kind == "space")
        _, *marks = graded.read_text(encoding="utf-8").splitlines()
        expected = "not-graded" if kind == "space" else ",right,"
        assert expected in marks[0]
        assert all(",wrong," in mark for mark in marks[1:])


def turned_round(sense: str) -> str:
    """The words of the opposite direction."""
    lead, _, rest = sense.partition(" ")
    if lead == "at":
        return f"at {(float(rest.split()[0]) + 180.0) % 360.0} deg"
    if lead in ("along", "about"):
        axis = rest.partition(" to ")
        return f"{lead} {axis[2]} to {axis[0]}" if axis[1] else f"{lead} -{rest}".replace("--", "")
    ways = {"ccw": "cw", "pull": "push", "toward": "away from", "away": "toward"}
    other = {**ways, **{there: back for back, there in ways.items()}}[lead]
    return f"{other} {rest.removeprefix('from ')}".strip()


@pytest.mark.parametrize("kind", TOLD)
def test_the_opposite_of_what_is_told_disagrees(kind: str) -> None:
    """By words of the same sort."""
    found = {name: one for name, one in icsolve.solve(icsolve.load(TOLD[kind])).answers.items() if one.sense}
    for name, one in found.items():
        if one.unit in ("kg", "N/mm", "N*m/rad"):  # of a weight or a spring the stiffness is positive
            continue
        for sense, verdict in ((one.sense, "agrees"), (turned_round(one.sense), "disagrees")):
            text = f"{TOLD[kind]}\nexpect:\n  {name}: {abs(one.value)} {one.unit} {sense}\n"
            (row,) = compare(icsolve.solve(icsolve.load(text)))
            assert row.verdict == verdict, (sense, row)


@pytest.fixture(autouse=True)
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where each position is a scene of its own fewer are looked at, by the pages as by the others."""
    if not FULL:
        monkeypatch.setattr("icsolve.page.motion.COARSE", 45.0)
        monkeypatch.setattr(find_by_scenes, "PLACES", 20)


@cache
def solved(name: str, *, more: bool = False) -> Answer | None:
    """The answer of a case, with ``more`` its rates and all centres too; None where it has none."""
    try:
        return icsolve.solve(case_of(name), rates=more, all_centres=more)
    except SceneError:
        return None


@cache
def case_of(name: str) -> Case:
    """A case of the library or of another kind, or a random one by its maker's name and seed."""
    if name in OTHERS:
        return icsolve.load(OTHERS[name])
    maker, _, seed = name.partition("-")
    if seed.isdigit() and hasattr(mechanisms, maker):
        return random_case(getattr(mechanisms, maker), int(seed))
    return icsolve.load(FILES[name])


NAMES = [*FILES, *(f"{maker.__name__}-{seed}" for maker, seed in RANDOM)]
WITH_PAGE = [*sample([*PAGED, *OTHERS], 2, "voices"), *sample(NAMES[len(FILES) :], 8, "pages")]
TOLD_OF = [*sample(NAMES, 3, "statuses and values"), *OTHERS]


@cache
def known(name: str) -> Known:
    return library.known(name) if name in PAGED else known_of(case_of(name), reactions=True)


@cache
def explained(name: str) -> str:
    return explain(known(name).case, known=known(name))


@cache
def page(name: str) -> tuple[str, dict[str, Any]]:
    """The page of a case, and what its script reads."""
    text = page_of(name) if name in FILES else page_html(known(name))
    data = re.search(r'id="data">(.*?)</script>', text, re.DOTALL)
    assert data is not None
    return text, json.loads(data[1])


def column(packed: dict[str, Any], row: int) -> float | None:
    """A number of a column; a page that solves for itself is given that of the written position alone."""
    if "v" in packed:
        value: float | None = packed["v"][row if len(packed["v"]) > 1 else 0]
        return value
    return None if row in packed.get("n", []) else float(np.cumsum(np.cumsum(packed["d"]))[row] / packed["s"])


def plain(text: str) -> str:
    """A text for comparison: one kind of minus, dot and degree, no markup."""
    text = unescape(re.sub(r"<[^>]+>", "", text))
    return re.sub(r"\s+", " ", text.replace("−", "-").replace("·", "*").replace("°", " deg"))


@sampled(2)
@pytest.mark.parametrize("name", TOLD_OF)
def test_statuses(name: str) -> None:
    """A case has an answer in every command, or none with one status."""
    status = "ok"
    if solved(name) is None:
        with pytest.raises(SceneError) as refused:
            icsolve.solve(case_of(name))
        status = refused.value.status
    shown = known(name).refusal
    assert (shown.status if shown else "ok") == status
    assert (f"(Status: {status}.)" in explained(name)) == (status != "ok")


ROUNDING = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?e-(?:1[5-9]|[2-9]\d|\d{3})")
BOUNDS = ("rounding may make", "Rounding can have moved", "agree with each other to")


@sampled(2)
@pytest.mark.parametrize("name", TOLD_OF)
def test_no_rounding_is_told_as_a_number(name: str) -> None:
    """What is zero is 0 in the words of every command, save where a bound is what is told."""
    answer = solved(name, more=True)
    texts = [explained(name), *([answer_text(answer)] if answer else [])]
    lines = [line for text in texts for line in text.splitlines()]
    assert not [line for line in lines if ROUNDING.search(line) and not any(b in line for b in BOUNDS)]


@sampled(2)
@pytest.mark.parametrize("name", TOLD_OF)
def test_values_senses_and_ranges(name: str) -> None:
    """The value with its sense, or the range, in the words of one room."""
    answer = solved(name)
    if answer is None:
        return
    shown = known(name)
    told = {
        "report": (answer_text(answer), 6),
        "explain": (explained(name), 6),
        "draw": (draw(shown.case, known=shown), 4),
    }
    for load, found in answer.answers.items():
        assert shown.answer is not None
        again = shown.answer.answers[load]
        assert again.value == pytest.approx(found.value, rel=1e-9, nan_ok=True)
        for room, (text, digits) in told.items():

            def show(value: float, digits: int = digits, room: str = room) -> str:
                one = float(format(value, f".{digits}g")) + 0.0
                return figure_number(value) if room == "draw" else format(one, ".12g")

            if found.holds is not None:
                words = holding(found, show)
            else:
                words = spelt(found.sense, show if room == "draw" else None)
            assert plain(words) in plain(text), room


@sampled(2)
@pytest.mark.parametrize("name", WITH_PAGE)
def test_the_page_says_in_its_written_position_what_solve_says(name: str) -> None:
    answer = solved(name)
    if answer is None:
        return
    _, model = page(name)
    row = model["motion"]["zero"] if "motion" in model else 0
    for one in model["answers"]:
        if one.get("asked"):
            at, stability = column(one["values"], row), one["senses"][int(column(one["sense"], row) or 0)]
            places = [(place.at[one["name"]], place.stability) for place in answer.positions or ()]
            assert (pytest.approx(at, rel=1e-6, abs=1e-9), stability) in places
            assert stability == "stable" or "stable" not in [kind for _, kind in places]
            continue
        if known(name).structure:
            carried = (answer.reactions or {})[one["name"]]
            assert column(one["values"], 0) == pytest.approx(carried.magnitude, rel=1e-6)
            continue
        found = answer.answers[one["name"]]
        if found.holds is not None:
            held = one["holds"][row if len(one["holds"]) > row else 0]
            assert plain(held).removesuffix(", self-locking") in plain(holding(found, figure_number))
        elif (value := column(one["values"], row)) is not None:
            assert value == pytest.approx(found.value, rel=1e-6, abs=1e-9)
            sense = one["senses"][int(column(one["sense"], row if len(one["senses"]) > 1 else 0) or 0)]
            assert plain(sense) == plain(spelt(found.sense, figure_number))


@sampled(2)
@pytest.mark.parametrize("name", WITH_PAGE)
def test_ratios_of_speeds(name: str) -> None:
    """The ratios that a solution works with, and those in the page's table, are those of the rates."""
    case = case_of(name)
    answer = solved(name, more=True)
    ratios = answer_ratios(known(name))
    if answer is None or answer.rates is None or ratios is None or answer.mobility != 1:
        return
    rates = {link: rate for link, rate in answer.rates.items() if isinstance(rate, float)}
    reference = rates.get(ratios.reference, 0.0)
    for link, rate in ratios.rates.items():
        if reference and known(name).turns(link):
            assert rate == pytest.approx(rates[link] / reference, rel=1e-7)
            assert rate == pytest.approx(value_of(answer, RatioIs(link, ratios.reference))[0], rel=1e-7)
    _, model = page(name)
    roots = [load for load in case.loads if load.name in answer.answers]
    if case.dynamic or not model["terms"] or not isinstance(roots[0], Torque) or len(roots) > 1:
        return  # inertia forces are loads of the answer's case, which stands still in its page
    loads = {load.name: load for load in case.loads}
    own = rates[roots[0].link] - rates[reacting(case, roots[0])]
    for term in model["terms"]:
        load = loads[term["name"]]
        shown = column(term["ratio"], model["motion"]["zero"])
        if isinstance(load, Torque) and shown is not None:
            assert shown == pytest.approx((rates[load.link] - rates[reacting(case, load)]) / own, rel=1e-6)


@pytest.mark.parametrize("name", WITH_PAGE)
def test_dead_centres_of_the_page_are_those_that_are_found(name: str) -> None:
    text, model = page(name)
    if "motion" not in model or model["motion"]["verb"] != "turned":
        return
    motion = model["motion"]
    marks = [float(at) for at in re.findall(r'<line class="dead" data-at="([^"]+)"', text)]
    case = known(name).case
    low, high = motion["first"], motion["first"] + motion["step"] * (motion["rows"] - 1)
    rows = [low + motion["step"] * k for k in range(motion["rows"])]
    asked = {one["name"] for one in model["answers"]}
    unknown = next((load.name for load in case.loads if load.name.removesuffix(".x") in asked), "")
    if not unknown:
        assert not marks
        return
    try:
        found = find(case, None, Query("dead", unknown), drive={motion["driver"]: rows})
    except SceneError:
        return
    places = [spot.at for spot in found if spot.kind == "dead" and low <= spot.at <= high]
    assert len(marks) == len(places)
    assert all(math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-12) for a, b in zip(marks, places, strict=True))


UNUSED = """
icsolve: 1
units: {length: m, force: N}
points: {A: [0, 0], B: [1, 1], C: [4, 2], D: [4, 0], E: [5, unknown]}
links: {3: [E]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads: {P: {force: 100, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}
expect: {w4/w2: 0.3333}
"""
VERBS = {
    "solve": [],
    "solve --report": [],
    "explain": [],
    "draw": [],
    "page": [],
    "check": [],
    "sweep": ["--drive", "2=0:2:1"],
    "sweep --find": ["dead", "--drive", "2=0:2:1"],
}


@pytest.mark.parametrize("kind", ["contact", "slot"])
def test_normals_on_which_a_centre_lies_are_named_by_their_points(kind: str) -> None:
    """A ladder on two walls: the same two normals in the text, the worked solution and the page."""
    text = """
icsolve: 1
points: {A: [0, 0], B: [5, 12], M: [3, 7.2]}
joints:
  - {contact: [1, 2], at: A, normal: 90}
  - {contact: [1, 2], at: B, normal: 180}
loads:
  W: {weight: 180, link: 2, at: M}
  P: {force: unknown, link: 2, at: A, angle: 0}
"""
    if kind == "slot":
        text = text.replace("contact: [1, 2], at: A, normal: 90", "slot: [2, 1], at: A, along: 0")
        text = text.replace("contact: [1, 2], at: B, normal: 180", "slot: [2, 1], at: B, along: 90")
    case = icsolve.load(text)
    normal = {"contact": "common normal", "slot": "normal to the slot"}[kind]
    for told in (answer_text(icsolve.solve(case)), explain(case), unescape(page_html(case))):
        assert f"the {normal} at A" in told and f"the {normal} at B" in told


@pytest.mark.parametrize("verb", VERBS)
def test_an_undetermined_point_that_nothing_needs_stops_no_command(verb: str, tmp_path: Path) -> None:

    path = tmp_path / "case.yaml"
    path.write_text(UNUSED, encoding="utf-8")
    assert exit_status(*verb.split()[:1], str(path), *verb.split()[1:], *VERBS[verb]) == 0


@sampled(2)
@pytest.mark.parametrize("kind", OTHERS)
def test_every_kind_of_case_is_explained_drawn_and_paged(kind: str) -> None:
    """What has an answer has one in every command, and what rests is told where."""
    found = known(kind)
    answer = icsolve.solve(case_of(kind))
    assert found.refusal is None
    text = explain(found.case, "html", bodies=True, known=found)
    assert "<svg" in text and page(kind)
    for position in answer.positions or ():
        value = position.at["angles.AG"]
        assert isinstance(value, float) and f"angles.AG = {value:.6g} deg" in plain(text)


TOO_CLOSE = """
icsolve: 1
units: {length: mm, force: N}
points: {A: [1e-300, 0], B: [200, 0], C: [1e9, 360], D: [400, 80], M: {centroid: [B, C]}}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {P: {force: 20000.000000000000003, link: 3, at: M, angle: 270}, T: {torque: unknown, link: 2}}
expect: {I13: {toward: 0}}
"""
NONE = {
    Status.NEAR_SINGULAR: TOO_CLOSE,
    Status.MOBILITY: UNUSED.replace("  - {pin: [4, 1], at: D}\n", ""),
    Status.NO_VALUE: UNUSED.replace("T: {torque: unknown, link: 2}", "T: {torque: unknown, link: 1}"),
    Status.INCONSISTENT: UNUSED.replace("links:", "lengths: {AB: 7}\nlinks:"),
    Status.UNDERDETERMINED: UNUSED.replace("C: [4, 2]", "C: [4, unknown]"),
    Status.AMBIGUOUS: UNUSED.replace("C: [4, 2]", "C: [4, unknown]").replace(
        "links:", "lengths: {BC: 4}\nlinks:"
    ),
}
TELL = {
    **{verb: [] for verb in ("solve", "solve --json", "check", "explain", "ways")},
    **{
        f"{verb} -o": [f"out.{ending}"]
        for verb, ending in (("draw", "svg"), ("page", "html"), ("sheet", "tex"))
    },
    "gallery -o": ["shown"],
    "sweep --drive": ["2=0:2:1"],
    "sweep --find": ["dead", "--drive", "2=0:0.002:0.001"],
    "export gift -o": ["quiz.gift"],
}


@pytest.mark.parametrize("status", NONE)
def test_a_case_without_an_answer_has_none_in_every_command(
    status: Status, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It ends with 1 and says the status; a verb that does not ask for the answer may end with 0."""
    monkeypatch.chdir(tmp_path)
    Path("case.yaml").write_text(NONE[status], encoding="utf-8")
    for verb, more in TELL.items():
        name, *options = verb.split()
        kind, options = ([options[0]], options[1:]) if name == "export" else ([], options)
        code = exit_status(name, *kind, "case.yaml", *options, *more)
        told = capsys.readouterr()
        needs = name not in ("ways", "sweep", "export") or (status == Status.MOBILITY and name == "sweep")
        assert code == 1 if needs else code in (0, 1), (verb, told)
        assert code == 0 or status in told.err + told.out, verb


REBUILT = UNUSED.replace("units:", "reconstructed: the lengths are of another print\nunits:", 1)


@pytest.mark.parametrize(
    "kind", ["moodle-xml", "gift", "qti", "prairielearn", "gallery", "exercises", "sheet"]
)
def test_what_is_reconstructed_is_said_wherever_a_case_is_handed_on(kind: str, tmp_path: Path) -> None:
    """As text beside the figure (`solve`, `draw`, `explain` and `page` say it themselves)."""
    case, out = tmp_path / "case.yaml", tmp_path / "out"
    case.write_text(REBUILT, encoding="utf-8")
    verb = {"gallery": ("gallery",), "exercises": ("gallery", "--exercises"), "sheet": ("sheet",)}
    ending = {"sheet": ".tex", "moodle-xml": ".xml", "gift": ".gift", "qti": ".zip"}.get(kind, "")
    out = out.with_suffix(ending)
    assert exit_status(*verb.get(kind, ("export", kind)), str(case), "-o", str(out)) == 0
    files = [out] if out.is_file() else [path for path in out.rglob("*") if path.is_file()]
    texts = [path.read_bytes() for path in files if path.suffix != ".svg"]
    if kind == "qti":
        with ZipFile(out) as archive:
            texts = [archive.read(name) for name in archive.namelist() if name.endswith(".xml")]
    assert any(b"the lengths are of another print" in text for text in texts)


@pytest.mark.parametrize("degrees", [0.0, -1e-13, 1e-12, 359.9999999, 359.9996, 720.0, -0.0002])
def test_a_direction_that_rounds_to_a_whole_turn_is_zero(degrees: float) -> None:
    assert direction_words(degrees) == "0 deg"


@pytest.mark.parametrize(
    ("degrees", "words"), [(339.7781, "339.778 deg"), (-90.0, "270 deg"), (0.5, "0.5 deg")]
)
def test_a_direction_is_told_between_zero_and_a_whole_turn(degrees: float, words: str) -> None:
    assert direction_words(degrees) == words


def test_directions_are_put_into_words_in_one_place() -> None:
    """A number taken modulo a whole turn, and written with its unit, on its own can say 360 deg."""
    own = re.compile(r"% 360\.0\)?:\.6g\} deg")
    rooms = Path(icsolve.__file__).parent
    told = {
        file.relative_to(rooms).as_posix()
        for file in rooms.rglob("*.py")
        if own.search(file.read_text(encoding="utf-8"))
    }
    assert told == {"wording/__init__.py"}


BETWEEN = """icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 3.5, CD: 2.5}}
angles: {{AB: 60}}
near: {{C: [3.5, 2.4]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads:
  P: {{torque: 100, link: {0}, against: {1}}}
  T: {{torque: unknown, link: {1}, against: {0}}}
motion: {2}
"""
PAIRS_OF_LINKS = [(2, 3), (3, 4), (2, 4), (1, 2), (1, 4)]
"""Two links of a four-bar between which all loads act."""
GIVEN = ["{link: 3, speed: 5}", "{point: B, link: 3, speed: 2, angle: 150}", "{link: 4, speed: 5, turns: cw}"]


@pytest.mark.parametrize("motion", GIVEN)
@pytest.mark.parametrize("links", PAIRS_OF_LINKS)
def test_a_given_speed_is_one_by_the_frame_whatever_else_is_asked(
    links: tuple[int, int], motion: str
) -> None:
    """The powers of loads between two links, with the rates and without, by 100 times the difference of the
    rates (to rounding)."""
    case = icsolve.load(BETWEEN.format(*links, motion))
    plain, moving = (icsolve.solve(case, rates=rates) for rates in (False, True))
    assert moving.rates is not None
    rates = {link: moving.rates.get(str(link), 0.0) for link in links}
    right = 100.0 * (rates[links[0]] - rates[links[1]])
    assert [term.power for term in plain.terms] == pytest.approx([right, -right], rel=1e-12)
    assert plain.terms == moving.terms


@pytest.mark.parametrize("seed", range(4))
def test_links_are_told_in_their_order_whichever_way_the_joints_name_them(seed: int) -> None:
    """Numbers ascend, as in the names of centres: a figure is read link by link."""
    text = template("six-bar")
    joints = re.findall(r"(?m)^  - \{.*\n", text)
    Random(seed).shuffle(joints)
    rest = re.sub(r"(?m)^  - \{.*\n", "", text)
    case = icsolve.load(rest.replace("joints:\n", "joints:\n" + "".join(joints), 1))
    answer = icsolve.solve(case, rates=True, reactions=True)
    assert answer.rates is not None and answer.velocities is not None
    numbers = sorted(map(int, case.links))
    assert [int(link) for link in answer.rates] == numbers
    assert [*dict.fromkeys(int(link) for _, link in answer.velocities)] == numbers
    bodies = re.findall(r"Equilibrium of link (\d)", explain(case, bodies=True))
    assert [int(link) for link in bodies] == numbers[1:]
