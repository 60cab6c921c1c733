"""Worked solutions: every printed equation is taken back from the text and computed again.

A side of an equation that has numbers alone is evaluated, and all such sides of one equation must agree
to what the printed digits leave open: each number is moved by a unit of its last significant digit (or of
the figure's, for coordinates), and what that makes of the side is its tolerance.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterable
from itertools import pairwise
from pathlib import Path
from random import Random
from xml.etree import ElementTree

import pytest

import icsolve
import loading
import mechanisms
import transcribe
from growth import random_mechanism
from icsolve.answer import AboutToMove
from icsolve.case import Case, Motion, Number, is_link
from icsolve.draw import draw
from icsolve.draw.words import found_sentences
from icsolve.explain import explain
from icsolve.explain.document import ShownTable
from icsolve.explain.given import exercise
from icsolve.manual import template
from icsolve.numbers import turn_of
from icsolve.report.derivation.known import known_of
from icsolve.screws import velocity
from icsolve.tuples import replace
from library import FILES, sample
from rough_scenes import KINDS, Rough
from sizes import FULL, few, sampled
from test_draw import DEAD_CENTRE, FOUR_BAR, HOSTILE

ROOT = Path(__file__).parent.parent
DIGITS = 6
NUMERAL = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]\d+)?(?![\w.])")

# --- reading equations back ------------------------------------------------------------------------


def sin(degrees: float) -> float:
    return turn_of(degrees)[1]


def cos(degrees: float) -> float:
    return turn_of(degrees)[0]


FUNCTIONS = {
    "sin": sin,
    "cos": cos,
    "tan": lambda degrees: sin(degrees) / cos(degrees),
    "exp": math.exp,
    "sqrt": lambda x: math.sqrt(max(x, 0.0)),
    "pi": math.pi,
    "__builtins__": {},
}


def text_equations(text: str) -> list[list[str]]:
    """The sides of the equations of a text, in Python: those that have numbers alone."""
    lines = [line.strip() for line in text.splitlines() if line.startswith("    ") and " = " in line]
    return [[python_of_text(side) for side in line.split(" = ")] for line in lines]


def python_of_text(side: str) -> str:
    """``100 x sin(30 deg) / 2 lbf*in`` without its unit, in Python; '' where it has symbols."""
    side = re.sub(r"(?<=\d) [A-Za-z][A-Za-z*/^0-9-]*$", "", side)
    side = side.replace(" deg", "").replace(" x ", " * ").replace("^2", "**2")
    return side if only_numbers(side) else ""


def only_numbers(side: str) -> bool:
    bare = re.sub(r"sqrt|sin|cos|tan|exp|pi", "", NUMERAL.sub("", side))
    return not re.search(r"[A-Za-z|_]", bare)


def latex_equations(text: str) -> list[list[str]]:
    """The same of displayed LaTeX."""
    return [
        [python_of_latex(side) for side in one.split(" = ")]
        for one in re.findall(r"^\$\$ (.*) \$\$$", text, re.M)
    ]


def python_of_latex(side: str) -> str:
    """LaTeX in Python; '' where it has symbols."""
    side = re.sub(r"\\ \\mathrm\{.*?\}$", "", side)
    side = re.sub(r" \\cdot 10\^\{(-?\d+)\}", lambda m: f"e{int(m[1]):+03d}", side)
    side = side.replace(r"\left(", "(").replace(r"\right)", ")").replace(r"^\circ", "")
    while r"\frac" in side:
        side = opened(side, r"\frac", "(({0}) / ({1}))", 2)
    while r"\sqrt" in side:
        side = opened(side, r"\sqrt", "root({0})", 1)
    while "e^{" in side:
        side = opened(side, "e^", "exp({0})", 1)
    side = side.replace("^{2}", "**2").replace("root", "sqrt")
    side = re.sub(r"\\(sin|cos|tan) (-?[\d.]+)", r"\1(\2)", side)
    side = re.sub(r"\\(sin|cos|tan)\(", r"\1(", side).replace(r"\cdot", "*").replace(r"\pi", "pi")
    return side if only_numbers(side) and "\\" not in side else ""


def opened(text: str, command: str, form: str, count: int) -> str:
    """A LaTeX command with braces, written in Python."""
    start = text.index(command)
    at = start + len(command)
    groups = []
    for _ in range(count):
        depth, end = 0, at
        while True:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
            if depth == 0:
                break
        groups.append(text[at + 1 : end - 1])
        at = end
    return text[:start] + form.format(*groups) + text[at:]


def value(side: str) -> float:
    return float(eval(side, dict(FUNCTIONS)))


def tolerance(side: str, size: float) -> float:
    """What a unit in the last shown digit of each number makes of a side."""
    middle, total = value(side), 0.0
    for found in NUMERAL.finditer(side):
        if side[: found.start()].endswith("**"):
            continue
        x = float(found[0])
        unit = 10.0 ** (math.floor(math.log10(max(abs(x), 1e-300))) + 1 - DIGITS)
        unit = max(unit, 10.0 ** (math.floor(math.log10(size)) + 1 - DIGITS)) if x != round(x) else unit
        changed = f"{side[: found.start()]}({x!r} + {unit!r}){side[found.end() :]}"
        total += abs(value(changed) - middle)
    return total


def check(equations: Iterable[list[str]], size: float) -> int:
    """All numeric sides of each equation agree; returns how many equations had two or more."""
    checked = 0
    for sides in equations:
        numeric = [side for side in sides if side]
        for side in numeric[1:]:
            room = 1.01 * (tolerance(numeric[0], size) + tolerance(side, size))
            assert abs(value(side) - value(numeric[0])) <= room, f"{numeric[0]} is not {side}"
        checked += len(numeric) > 1
    return checked


# --- the laws ----------------------------------------------------------------------------------------


def explained(case: Case, **options: bool) -> dict[str, str]:
    known = known_of(case, reactions=True)
    return {form: explain(case, form, DIGITS, known=known, **options) for form in ("text", "md", "html")}


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 6, "equations"))
def test_every_printed_equation_recomputes(name: str) -> None:
    case = icsolve.load(FILES[name])
    said = explained(case, bodies=True)
    size = known_of(case).size or 1.0
    counts = {check(text_equations(said["text"]), size), check(latex_equations(said["md"]), size)}
    assert len(counts) == 1, "text and LaTeX have the same equations"
    assert counts.pop() >= 1 or not case.loads or case.unknowns or power_refused(case, said["text"])
    well_formed(said["html"])


def power_refused(case: Case, text: str) -> bool:
    """Whether the sum of power is refused by name, of friction with ropes and screws alone."""
    return bool(
        case.ropes or case.screws
    ) and "is not written out as power (status unsupported)." in " ".join(text.split())


def well_formed(html: str) -> None:
    """HTML that is XML too, so that nothing in it is left open."""
    body = html.partition("<body>")[2].partition("</body>")[0]
    ElementTree.fromstring(f"<body>{body}</body>")


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 6, "last equations"))
def test_the_last_equation_is_the_answer(name: str) -> None:
    """The unknown of the last solved line has the value that `solve` gives, to the digits shown."""
    case = icsolve.load(FILES[name])
    text = explain(case, digits=DIGITS)
    for load, found in icsolve.solve(case).answers.items():
        lines = re.findall(rf"^    {re.escape(load)} = .*$", text, re.M)
        if lines:
            last = re.search(r"= (-?[\d.e+-]+)[^=]*$", lines[-1])
            assert last and float(last[1]) == pytest.approx(found.value, rel=1e-5)
        assert f"{abs(found.value):.6g} {found.unit}" in text


@pytest.mark.parametrize("block", range(5 if FULL else 1))
def test_equations_of_random_mechanisms_recompute(block: int) -> None:
    for seed in range(20 * block, 20 * block + few(20)):
        kind = mechanisms.ALL[seed % len(mechanisms.ALL)]
        scene = loading.drawn(seed % 40, kind) if seed % 2 else random_mechanism(Random(seed))
        case = icsolve.load(transcribe.text(scene))
        assert check(text_equations(explain(case, digits=DIGITS)), known_of(case).size or 1.0) >= 1


def terms_of(node: ast.expr) -> list[ast.expr]:
    """The terms of a sum, without their signs."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
        return terms_of(node.left) + terms_of(node.right)
    return terms_of(node.operand) if isinstance(node, ast.UnaryOp) else [node]


def disagreeing(text: str) -> list[tuple[str, str]]:
    """Sides of numbers that do not come to the last side, as a calculator has them: to four digits, one more
    than engineers quote; where it is 0, to four digits of the largest term."""
    wrong = []
    for sides in text_equations(text):
        *numeric, last = [side for side in sides if side] or [""]
        for side in numeric:
            parts = [ast.unparse(term) for term in terms_of(ast.parse(side, mode="eval").body)]
            scale = abs(value(last)) or max(abs(value(part)) for part in parts)
            if abs(value(side) - value(last)) > 1e-4 * scale:
                wrong.append((side, last))
    return wrong


@pytest.mark.parametrize("block", range(10 if FULL else 1))
def test_equations_recompute_to_four_digits_where_loads_are_nearly_along_an_axis(block: int) -> None:
    """Directions 1e-9 to 0.1 degree off the axes, whose smaller component is by all digits of the angle."""
    for seed in range(15 * block, 15 * block + 15):
        draw, kind = Random(f"axes {seed}"), mechanisms.ALL[seed % len(mechanisms.ALL)]
        scene = loading.drawn(seed % 40, kind) if seed % 2 else random_mechanism(Random(seed))
        for load in scene["loads"].values():
            if "angle" in load:
                load["angle"] = 90 * draw.randrange(4) + draw.choice([-1, 1]) * 10 ** draw.uniform(-9, -1)
        assert not disagreeing(explain(icsolve.load(transcribe.text(scene)), digits=DIGITS, bodies=True))


BESIDE = """icsolve: 1
points: {{A: [{x}, {y}], {more}}}
lengths: {{AB: {r}, BC: {l}{length}}}
angles: {{AB: {angle}}}
near: {{C: [{near}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{{joint}}}]
loads:
  P: {{force: 100, link: 4, at: C, angle: {p}}}
  Q: {{force: {q}, link: 3, at: B, angle: 90}}
  M: {{torque: -0.8, link: 3}}
  T: {{torque: unknown, link: {link}}}
"""


@pytest.mark.parametrize("block", range(10 if FULL else 1))
def test_equations_recompute_to_four_digits_beside_singular_positions(block: int) -> None:
    """Slider-cranks at their dead centres, four-bars whose coupler and rocker are all but in line: reactions
    without an arm are up to 1e11 times the loads, which still have their moments in the sums. Nearer than
    1e-10 degree the doubles of the points have not four digits of an arm."""
    for seed in range(30 * block, 30 * block + 30):
        draw = Random(f"beside {seed}")
        gap, r = draw.choice([-1, 1]) * 10 ** draw.uniform(-10, 0), draw.choice([1, 0.35, 2.2])
        x, y = draw.choice([0, 1, -3.25, 120.7]), draw.choice([0, 2, -0.75])
        numbers = {"x": x, "y": y, "r": r, "l": 2.5 * r, "angle": repr(draw.choice([0, 180]) + gap)}
        numbers |= {"p": draw.choice([0, 90, 179.9999, 33.3]), "q": draw.choice([0.01, 10, 1000])}
        if seed % 2:
            how = {"more": f"K: [{x}, {y}]", "length": ""}
            how |= {"joint": "slide: [4, 1], at: C, along: 0, through: K"}
            numbers |= how | {"near": f"{x + 3 * r}, {y}", "link": 2}
        else:
            d = x + draw.choice([3.5, 4]) * r
            how = {"more": f"D: [{d}, {y}]", "length": f", CD: {2 * r}", "joint": "pin: [4, 1], at: D"}
            numbers |= how | {"near": f"{d}, {y + 2 * r}", "link": draw.choice([2, 4])}
        text = BESIDE.format(**numbers)
        assert not disagreeing(explain(icsolve.load(text), digits=DIGITS, bodies=True)), text


def moment_sums(text: str) -> list[list[str]]:
    """The equations under ``Moments about``."""
    lines = text.splitlines()
    below = [two for one, two in pairwise(lines) if one.startswith("Moments about ") and " = " in two]
    return [[python_of_text(side) for side in line.strip().split(" = ")] for line in below]


@pytest.mark.parametrize("near", ["1.23456e-3", "1.23456e-6"])
def test_points_that_nearly_fall_together_are_told_apart_by_six_digits(near: str) -> None:
    """The arm of a force about its pin, in a figure of 5 m: in its own formula, and among moments that add up
    to zero to six digits of each number."""
    case = icsolve.load(f"""icsolve: 1
points: {{A: [1, 2], B: [{1 + float(near)}, 2], C: [5, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  T: {{torque: unknown, link: 2}}
  P: {{force: 7000, link: 2, at: B, angle: 90}}
""")
    said = explain(case, digits=DIGITS, bodies=True)
    (line,) = (line for line in said.splitlines() if line.startswith("    h_P = "))
    sides = [python_of_text(side) for side in line.strip().split(" = ")]
    assert value(sides[1]) == pytest.approx(float(near), rel=1e-5)
    (moments,) = moment_sums(said)
    assert check([moments], 1e-300) == 1


AT_REST = sorted(name for name in FILES if name.startswith("equilibrium/"))


@sampled(2)
@pytest.mark.parametrize("name", sample(AT_REST, 4, "virtual work"))
def test_positions_are_told_by_virtual_work(name: str) -> None:
    """Every position has its sum of virtual work, which recomputes, and the derivative of the answer."""
    case = icsolve.load(FILES[name])
    known = known_of(case, reactions=True)
    assert known.answer and known.answer.positions
    said = {form: explain(case, form, DIGITS, known=known) for form in ("text", "md", "html", "tex")}
    check(text_equations(said["text"]), known.size or 1.0)
    check(latex_equations(said["md"]), known.size or 1.0)
    well_formed(said["html"])
    sums = re.findall(r"^    Q = .*0$", said["text"], re.M)
    slopes = re.findall(r"^    dQ / dq = (\S+)", said["text"], re.M)
    assert len(sums) == len(slopes) == len(known.answer.positions)
    for slope, position in zip(slopes, known.answer.positions, strict=True):
        assert position.stiffness and float(slope) == pytest.approx(-position.stiffness.value, rel=1e-5)


TWO_BARS = """
icsolve: 1
points: {A: [0, 0]}
angles: {AB: {unknown: [0, 360]}, BC: {unknown: [0, 360]}}
lengths: {AB: 0.4, BC: 0.3}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  W: {weight: 30, link: 2, at: B}
  V: {weight: 20, link: 3, at: C}
  P: {force: 10, link: 3, at: C, angle: 0}
  M: {torque: 2, link: 3}
  T: {spring: 4, corner: ABC, free: 150, link: 3, against: 2}
"""
ON_A_STROKE = """
icsolve: 1
units: {length: ft, force: lbf, torque: lbf*in}
points: {A: [0, 0]}
lengths: {AB: 2, AC: {unknown: [0.5, 4.5]}, BC: 3}
angles: {AC: 0}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C},
  {slide: [4, 1], at: C, along: 0, through: A}]
loads:
  W: {weight: 30, link: 2, at: B}
  P: {force: 20, link: 4, at: C, angle: 180}
  M: {torque: 100, link: 2}
  T: {spring: 40 lbf*in/rad, corner: ABC, free: 90, link: 3, against: 2}
"""


ON_A_GUIDE = """
icsolve: 1
units: {length: ft, force: lbf, torque: lbf*in}
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 1, BC: 1.5}
angles: {AB: {unknown: [0, 180]}}
near: {C: [2.3, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {slide: [4, 1], at: C, along: 0}]
loads: {T: {torque: 100, link: 2}, P: {force: 10, link: 4, at: C, angle: 0}}
"""


@sampled(2)
@pytest.mark.parametrize("text", [TWO_BARS, ON_A_STROKE, ON_A_GUIDE])
def test_virtual_work_of_two_unknowns_and_of_a_stroke(text: str) -> None:
    """One sum and one row of derivatives for each unknown, in every way in which the figure assembles."""
    case = icsolve.load(text)
    known = known_of(case, reactions=True)
    assert known.answer and known.answer.positions
    said = explain(case, digits=DIGITS, known=known)
    check(text_equations(said), known.size or 1.0)
    count = len(known.answer.positions[0].at)
    if "lengths.AC" in known.answer.positions[0].at:  # in the unit of the stiffness: forces, not torques
        assert re.search(r"k_P = cos\(180 deg\)", said)
    assert len(re.findall(r"^    Q\d? = .*0$", said, re.M)) == count * len(known.answer.positions)
    assert len(re.findall(r"^    dQ\d? / dq\d? = ", said, re.M)) == count**2 * len(known.answer.positions)


ROPE = """
icsolve: 1
points: {{A: [0, 0], G: [1, 0], C: [2, 0], P: [0, 3], B: [-1, {low}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{rope: [C, P, B], on: [2, 1], radii: {{P: 0.2}}, wraps: {{P: ccw}}{mu}}}
loads:
  W: {{weight: {load}, link: 2, at: G}}
  F: {{force: unknown, at: B}}
{motion}
"""
SCREW = """
icsolve: 1
units: {{length: mm, force: N, torque: N*m}}
points: {{B: [0, 100]}}
joints:
  - {{screw: [1, 2], at: B, along: 90, lead: {lead}, radius: 10, mu: {mu}}}
loads:
  W: {{force: {load}, link: 2, at: B, angle: 270}}
  T: {{torque: unknown, screw: 1-2}}
motion: {{point: B, link: 2, speed: 1, angle: {angle}}}
"""


@sampled(3)
@pytest.mark.parametrize("seed", range(6))
def test_ropes_and_screws_are_written_out(seed: int) -> None:
    """Random numbers: every equation recomputes, Euler's and the thread's formulas give the answer."""
    draw = Random(seed)
    load = f"{draw.uniform(10, 500):.3f}"
    mu = f", mu: {{P: {draw.uniform(0.05, 0.5):.3f}}}" if seed % 2 else ""
    motion = f"motion: {{link: 2, turns: {draw.choice(['cw', 'ccw'])}}}"
    rope = icsolve.load(ROPE.format(low=draw.uniform(-1, 2), load=load, mu=mu, motion=motion))
    numbers = {"lead": f"{draw.uniform(1, 20):.2f}", "mu": f"{draw.uniform(0.02, 0.3):.3f}"}
    screw = icsolve.load(SCREW.format(load=load, angle=draw.choice([90, 270]), **numbers))
    for case, formulas in ((rope, ["T = F"] if not mu else ["T1 x h_", "exp("]), (screw, ["tan(phi"])):
        text = explain(case, digits=DIGITS)
        size = known_of(case).size or 1.0
        assert check(text_equations(text), size) == check(latex_equations(explain(case, "md")), size) > 3
        (found,) = icsolve.solve(case).answers.values()
        assert all(part in text for part in formulas) and f"{abs(found.value):.6g} {found.unit}" in text
        assert "unsupported" not in text and "@" not in text


JACK = """
icsolve: 1
units: {{length: mm, force: N, torque: N*m}}
points: {{A: [0, 0], B: [unknown, 0]}}
lengths: {{AL: {leg}, BL: {other}}}
angles: {{AL: {angle}}}
near: {{B: [-200, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: L}}
  - {{pin: [3, 4], at: B}}
  - {{screw: [1, 4], at: B, along: 0, lead: {lead}, radius: 8{mu}}}
loads:
  W: {{force: 900, link: 3, at: L, angle: -90}}
  T: {{torque: unknown, screw: 1-4}}
"""
LEVER = """
icsolve: 1
points: {{A: [0, 0], B: [2, 0], G: [{place}, 0], P: [2, 3], H: [0.5, 3], D: [-1, {low}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{rope: [B, P, H, D], on: [2, 1, 1]}}
loads:
  W: {{weight: 400, link: 2, at: G}}
  F: {{force: unknown, at: D}}
"""


@sampled(3)
@pytest.mark.parametrize("seed", range(9))
def test_no_name_of_the_machinery_and_no_idle_step_is_told(seed: int) -> None:
    """Of legs that a screw draws together and of levers on ropes: a screw is called one, nothing is divided
    by 1, and no side of an equation repeats the one before."""
    draw = Random(f"idle {seed}")
    leg, mu = draw.randint(110, 150), draw.choice(["", f", mu: {draw.uniform(0.05, 0.3):.2f}"])
    numbers = {"angle": draw.randint(125, 160), "lead": draw.randint(2, 9)}
    jack = JACK.format(leg=leg, other=leg + draw.randint(0, 9), mu=mu, **numbers)
    lever = LEVER.format(place=f"{draw.uniform(0.3, 1.9):.2f}", low=f"{draw.uniform(-1, 2):.2f}")
    for case in (icsolve.load(jack), icsolve.load(lever)):
        text = explain(case)
        assert "@" not in text and " / 1 " not in text
        for line in text.splitlines():
            sides = [re.sub(r" [A-Za-z*/^0-9]+$", "", side.strip()) for side in line.split(" = ")[1:]]
            assert all(one != after for one, after in pairwise(sides)), line


ROLLED = """
icsolve: 1
points: {{O: [0, {radius}], P: [0, 0], B: [{far}, {level}]}}
joints:
  - {{roll: [1, 2], at: P, radii: [0, {radius}]}}
  - {{rope: [O, B], on: [2], radii: {{O: {hub}}}, wraps: {{O: {turns}}}}}
loads:
  M: {{torque: {far}, link: 2}}
  F: {{force: unknown, at: B}}
"""


@sampled(3)
@pytest.mark.parametrize("seed", range(12))
def test_a_direction_along_an_axis_but_for_rounding_is_told_as_that_of_the_axis(seed: int) -> None:
    """Of a level rope off a hub: neither as 1.6e-15 degrees nor as 360."""
    draw = Random(f"level {seed}")
    radius, hub, right = draw.randint(40, 90), draw.randint(10, 30), draw.choice([True, False])
    level, turns = (radius + hub, "cw" if right else "ccw") if draw.random() < 0.5 else (
        radius - hub, "ccw" if right else "cw"
    )  # fmt: skip
    numbers = {"radius": radius / 100, "hub": hub / 100, "level": level / 100}
    text = explain(icsolve.load(ROLLED.format(far=2 if right else -2, turns=turns, **numbers)))
    told = {angle for line in text.splitlines() for angle in re.findall(r"(?:sin|cos)\((\S+)", line)}
    assert told <= {"0", "180"} and told


@sampled(2)
@pytest.mark.parametrize("seed", range(6))
def test_a_line_load_without_a_resultant_is_told_by_its_couple(seed: int) -> None:
    """Whatever its line and direction, and whether torques have a unit of their own."""
    draw = Random(f"no resultant {seed}")
    torque, at = draw.choice([", torque: N*m", ""]), f"{draw.uniform(0, 360):.1f}"
    number, angle = draw.choice([3, -7]), f"{draw.uniform(0, 360):.1f}"
    case = icsolve.load(f"""
icsolve: 1
units: {{length: mm, force: N{torque}}}
points: {{A: [0, 0], C: [100, 0]}}
lengths: {{AB: 300}}
angles: {{AB: {at}}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  w: {{distributed: [{number}, {-number}], link: 2, from: A, to: B, angle: {angle}}}
  W: {{weight: 1000, link: 2, at: C}}
  T: {{torque: unknown, link: 2}}
""")
    text = explain(case, digits=DIGITS)
    assert "L_w = 300^2 / 6 x sin(" in text
    assert check(text_equations(text), known_of(case).size or 1.0) > 3


def test_inertia_forces_have_their_terms() -> None:
    """A crank of 2 kg m^2 that is started at 3 rad/s^2, with a mass of 4 kg on its end."""
    case = icsolve.load("""
icsolve: 1
points: {A: [0, 0], B: [0.5, 0]}
links: {2: {points: [A, B], mass: 4 kg, centre: B, inertia: 2 kg*m^2}}
joints:
  - {pin: [1, 2], at: A}
loads:
  T: {torque: unknown, link: 2}
motion: {link: 2, speed: 1, acceleration: 3}
dynamic: yes
""")
    text = explain(case, digits=DIGITS)
    assert "T_i2 = -J2 x alpha2 = -2 x 3 = -6 N*m" in text
    assert "F_i2y = -m2 x a_By = -4 x 1.5 = -6 N" in text
    assert "    T x w2 + F_i2 x h_Fi2 x w2 + T_i2 x w2 = 0" in text
    assert "= 9 N*m" in text


ROLLER = """
icsolve: 1
points: {A: [0, 0], K: [1, 4], B: [1, 6]}
joints:
  - {pin: [1, 2], at: A}
  - {contact: [2, 4], at: K, normal: 90}
  - {pin: [3, 4], at: B}
  - {slide: [3, 1], at: B, along: 90}
loads:
  S: {spring: 50, link: 3, at: B, to: D, free: 4}
  T: {torque: unknown, link: 2}
"""


def test_a_roller_follower_goes_by_lines_of_centres_and_a_spring_by_its_force() -> None:
    """I23 lies where the line I12 I13, here y = 0, meets the common normal; a spring of 3, stretched by 1."""
    case = icsolve.load(ROLLER.replace("A: [0, 0]", "A: [0, 0], D: [1, 9]"))
    text = " ".join(explain(case, digits=DIGITS).split())
    assert "I23 = (1, 0): on the line I12 I13 (links 1, 2, 3), and on the common normal at K" in text
    assert "on which I24 and I34 lie (roller 4 turns freely)" in text and "loop equations" not in text
    assert "F_S = S x s_S = 50 x (-1) = -50 N" in text and "T = " in text
    assert "The mechanical" not in text and "For one unit of the known load: T / F_S" in text


def test_the_area_of_a_pressure_and_the_length_of_a_tapered_load_are_worked_out() -> None:
    """pi (80^2 - 30^2)/4 mm^2 is 0.00431969 m^2, on which 1 MPa makes 4319.69 N; a load that falls from
    500 to 200 N/m along 4 m has 0.7 of 500 N/m times 4 m."""
    text = """icsolve: 1
units: {length: m, force: N}
points: {A: [0, 0], B: [4, 0], C: [4, 3]}
joints: [{pin: [1, 2], at: A}]
loads:
  q: {distributed: [500, 200], from: A, to: B, link: 2, angle: -90}
  p: {pressure: unknown, bore: 0.08, rod: 0.03, link: 2, at: B, toward: C}
"""
    said = explain(icsolve.load(text))
    assert "A_p = pi x (0.08^2 - 0.03^2) / 4 = 0.00431969 m^2\n" in said
    assert "1 MPa is 1000000 N/m^2, so that\n    A_p = 0.00431969 x 1000000 = 4319.69 N/MPa" in said
    assert "L_q = (500 + 200) / (2 x 500) x 4 = 2.8 m" in said


def test_two_slots_between_two_links_have_each_its_own_normal() -> None:
    """x + y tan 20 = 1 and x + y tan 70 = 2 tan 70, in words and in the figure."""
    text = """icsolve: 1
points: {B: [1, 0], C: [0, 2], D: [3, 1]}
joints: [{slot: [1, 2], at: B, along: 20}, {slot: [1, 2], at: C, along: 70}]
loads:
  P: {force: 10, link: 2, at: D, angle: -90}
  Q: {force: unknown, link: 2, at: B, angle: 20}
"""
    case = icsolve.load(text)
    assert "on the normal to the slot at B, and on the normal to the slot at C" in explain(case)
    lines = re.findall(r'data-step="1".*?d="([^"]*)"', draw(case), re.DOTALL)
    assert len(lines) == len(set(lines)) == 2


def test_a_wrong_number_would_be_noticed() -> None:
    text = explain(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]))
    assert check(text_equations(text), 3.0) >= 4
    with pytest.raises(AssertionError, match="is not"):
        check(text_equations(text.replace("0.339569", "0.339596")), 3.0)


# --- the order and the words ---------------------------------------------------------------------------


def headings(text: str) -> list[str]:
    return re.findall(r"^(.+)\n-+$", text, re.M)


def test_the_order_is_the_textbooks() -> None:
    """Problem 13.6 of Waldron, Kinzel and Agrawal."""
    text = explain(icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"]))
    assert headings(text) == [
        "Given", "Asked", "Centres by inspection", "Centres by construction", "Ratios of the speeds", "Power",
        "Answer", "Left out", "Check by free bodies", "Remarks",
    ]  # fmt: skip
    order = [
        text.index(part)
        for part in ("1. I24 =", "2. I46 =", "3. I26 =", "v6 / w2 = |I12 I26|", "P16 = 2.70421 lbf")
    ]
    assert order == sorted(order)
    assert "on the line I12 I16 (links 1, 2, 6), and on the line I24 I46 (links 2, 4, 6)" in " ".join(
        text.split()
    )


def test_what_was_left_out_is_said_with_the_reason() -> None:
    """13.6: 15 centres, of which ten are needed."""
    text = " ".join(explain(icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"])).split())
    assert "The centres I13, I15, I25, I35, I36: the loaded links are related without them." in text
    assert "The forces in the joints: they do no work, and the equation of power is without them." in text
    with_bodies = explain(icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"]), bodies=True)
    assert "The forces in the joints: they" not in with_bodies


def test_the_bound_of_rounding_is_the_answers() -> None:
    case = icsolve.load(FILES["ch13/13_06_six_bar_slider.yaml"])
    bound = icsolve.solve(case, reactions=True).answers["P16"].error
    assert f"Rounding can have moved P16 by {bound:.1e} lbf at most." in explain(case)


def test_a_given_motion_has_its_unit_and_sense() -> None:
    """The shaper's crank turns at 40 rpm."""
    text = explain(icsolve.load(FILES["sliders/quick_return.yaml"]))
    assert "Link 2 turns at 4.18879 rad/s, counterclockwise." in text
    text = explain(icsolve.load(FILES["ch13/13_10_black_box.yaml"]))
    assert "Point B of link 2 moves at 100 in/s, at 215 deg." in text


PROFILED = [name for name, path in FILES.items() if "{contact: [2, 3]}" in path.read_text()]


@pytest.mark.parametrize("name", PROFILED)
@pytest.mark.parametrize("turns", ["cw", "ccw"])
def test_a_rough_contact_without_a_name_is_told_without_a_place(name: str, turns: str) -> None:
    """Whose point the profiles give: no place stood after ``at``, and a hidden point's name for it."""
    text = FILES[name].read_text().partition("expect:")[0].replace("[2, 3]}", "[2, 3], mu: 0.05}")
    told = explain(icsolve.load(f"{text}motion: {{link: 2, turns: {turns}}}\n"), bodies=True)
    assert ": tan phi = 0.05" in told and ": friction along the tangent" in told
    assert not re.search(r"(?<![\w'])@| at\s*[:,.]", told), re.findall(r".*(?<![\w'])@.*| at\s*[:,.]", told)


BLOCKED = """\
icsolve: 1
points: {A: [0, 0], C: [unknown, 0.2]}
lengths: {AB: 0.5, BC: 1.6}
angles: {AB: 40}
near: {C: [1.9, 0.2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.2, length: 0.3}
loads:
  P: {force: 300, link: 4, at: C, angle: 180}
  M: {torque: 60, link: 4}
  T12: {torque: unknown, link: 2}
motion: {link: 2, turns: cw}
"""
POSTS = """\
icsolve: 1
points: {A: [0, 0], P: [0, 3], Q: [2, 3], B: [2, 0]}
joints:
  - {slide: [2, 1], at: A, along: 90}
  - {rope: [A, P, Q, B], on: [2, 1, 1], radii: {P: 0.1, Q: 0.1}, wraps: {P: cw, Q: cw}, mu: {P: 0.2, Q: 0.3}}
loads:
  W: {weight: 100, link: 2, at: A}
  F: {force: unknown, at: B}
motion: {point: A, link: 2, speed: 1, angle: 90}
"""


@pytest.mark.parametrize("text", [BLOCKED, POSTS], ids=["block on its two ends", "rope round two posts"])
def test_friction_at_two_places_of_a_joint_has_two_names(text: str) -> None:
    """One symbol is one number: the ends of a block, and the posts of a rope, rub each by itself."""
    told = explain(icsolve.load(text))
    named = re.findall(r"^ {4}(L\S*) = ", told, re.MULTILINE)
    assert len(named) == 2 and len(set(named)) == 2, named
    equation = next(line for line in told.splitlines() if " = 0" in line and named[0] in line)
    assert all(f" {name} " in equation for name in named)


def test_forces_of_two_joints_between_one_pair_of_links_are_told_apart() -> None:
    text = explain(icsolve.load(FILES["ch13/13_21_door_linkage.yaml"]))
    assert "F12@A1,x + F12@A2,x = " in text


def test_the_sense_of_an_answer_is_told_in_words() -> None:
    text = " ".join(explain(icsolve.load(FILES["ch13/13_07_slider_crank.yaml"])).split())
    assert "T12 = 26.8815 lbf*in, clockwise; the minus in the equation says" in text


def test_coaxial_gears_go_by_a_link_between() -> None:
    """Sun and arm turn about one axle, where their three centres coincide: the planet links them."""
    text = explain(icsolve.load(FILES["gears/epicyclic_train.yaml"]))
    assert "w3 / w4 = -|I14 I34| / |I13 I34| = -42 / 18" in text
    assert "w2 / w3 = -|I13 I23| / |I12 I23| = -36 / 24" in text


def test_two_freedoms_have_two_equations() -> None:
    text = explain(icsolve.load(FILES["linkages/five_bar.yaml"]))
    assert "Motion 1: link 2 turns at 1 rad/s" in text and "Motion 2: link 5 turns at 1 rad/s" in text


def test_free_bodies_have_three_equations_a_link() -> None:
    """13.2: F34 (58.16, 208.8) N."""
    text = explain(icsolve.load(FILES["ch13/13_02_four_bar_free_bodies.yaml"]), bodies=True)
    for link in "234":
        part = text.partition(f"Equilibrium of link {link}\n")[2].partition("\n\n")[0]
        assert [head in part for head in ("Forces along x:", "Forces along y:", "Moments about")] == [
            True
        ] * 3
    assert re.search(r"F34 +pin at B +58\.1\d+ +208\.\d+", text)


def test_markdown_has_latex() -> None:
    text = explain(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]), "md")
    assert (
        r"$$ \frac{\omega_{4}}{\omega_{2}} = \frac{\overline{I_{12}\,I_{24}}}{\overline{I_{14}\,I_{24}}}"
        in text
    )


def test_the_bars_of_a_truss_are_held_and_do_not_move() -> None:
    text = explain(icsolve.load(template("truss")))
    assert "links AD, AB, BD, BC, BE, CE and DE are held." in text
    assert " move." not in text


def test_a_load_that_is_called_w_is_no_angular_velocity() -> None:
    """R. C. Hibbeler calls a load per length w; what a link turns at is omega."""
    text = BEAM.replace("F: {force: 10,", "w2: {force: 10,")
    markdown = explain(icsolve.load(text), "md")
    assert "- $w_{2}$: " in markdown
    assert r"w_{2}\,h_{\mathrm{w2}}\,\omega_{2}" in markdown


@pytest.mark.parametrize(
    ("joint", "more", "question"),
    [
        ("", "", "What is the load that holds the mechanism in equilibrium in this position?"),
        (", mu: 0.2, radius: 1", "", "Over what range of the load does the mechanism hold still in this"),
        (", mu: 0.2, radius: 1", "motion: {link: 2, turns: cw}", "What is the load that keeps the motion up"),
    ],
)
def test_the_question_is_the_one_that_is_answered(joint: str, more: str, question: str) -> None:
    """Also on an exercise sheet: friction at rest leaves a range."""
    case = icsolve.load(BEAM.replace("at: A}", f"at: A{joint}}}") + more)
    assert question in explain(case)
    assert question in explain(case, "tex")


BEAM = """icsolve: 1
points: {A: [0, 0], B: [2, 0], C: [1, 0]}
joints: [{pin: [1, 2], at: A}]
loads:
  F: {force: 10, link: 2, at: B, angle: -90}
  Q: {force: unknown, link: 2, at: C, angle: 90}
"""


def test_html_has_mathml_and_the_figure_and_loads_nothing() -> None:
    html = explain(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]), "html")
    assert "<msub><mi>\N{GREEK SMALL LETTER OMEGA}</mi><mtext>4</mtext></msub>" in html
    assert '<g id="centre-2-4">' in html
    assert not re.search(r"(src|href)=|url\(|@import|<script", html)


@pytest.mark.parametrize("digits", [3, 10])
def test_digits_are_those_asked_for(digits: int) -> None:
    text = explain(icsolve.load(FILES["ch13/13_08_four_bar.yaml"]), digits=digits)
    answer = icsolve.solve(icsolve.load(FILES["ch13/13_08_four_bar.yaml"])).answers["T12"].value
    assert f"T12 = {answer:.{digits}g} lbf*in, counterclockwise" in text


# --- bad input ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", [FOUR_BAR.format(title="too long", crank=20), DEAD_CENTRE])
def test_a_case_without_an_answer_is_explained_as_far_as_it_goes(text: str) -> None:
    case = icsolve.load(text)
    said = explained(case)
    assert headings(said["text"])[0] == "Given" and headings(said["text"])[-1] == "No answer"
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(case)
    assert " ".join(refused.value.message.split())[1:] in " ".join(said["text"].split())
    well_formed(said["html"])


def test_speeds_are_explained_where_the_known_loads_do_not_balance() -> None:
    text = FOUR_BAR.format(title="no unknown", crank=1).replace("unknown", "5")
    said = explained(icsolve.load(text))
    assert headings(said["text"])[-2:] == ["Speeds", "Remarks"] and "w4" in said["text"]


@pytest.mark.parametrize("title", HOSTILE)
def test_text_stays_text(title: str) -> None:
    case = icsolve.load(
        FOUR_BAR.format(title=title, crank=1) + f"\nsource: {title}\nreconstructed: {title}\n"
    )
    said = explained(case)
    well_formed(said["html"])
    assert "<script" not in said["html"]
    words: Callable[[str], str] = lambda text: "".join(text.split())  # noqa: E731
    lead = said["md"].partition("\n\n## ")[0]
    assert not re.search(r"(?<!\\)[<>$`|]", lead)
    assert words(case.title) in words(re.sub(r"\\(.)", r"\1", lead))


@pytest.mark.parametrize(
    "name",
    [
        "dynamics/hoist_starting",
        "dynamics/slider_crank_piston",
        "tools/bolt_cutter",
        "ropes/band_brake",
        "ch13/13_18_slider_crank_friction_everywhere",
    ],
)
def test_the_sum_is_solved_without_double_signs(name: str) -> None:
    """What goes to the other side of the equation of power has one sign; so has each arm of a moment."""
    text = explain(icsolve.load(ROOT / f"cases/{name}.yaml"), bodies=True)
    solved = re.findall(r"^(?:So|Moments about \w+:)\n(.+)", text, re.MULTILINE)
    assert len(solved) > 1
    assert not any(re.search(r"- ?\(-|= \(\d", line) for line in solved), solved
    assert "needs 1, which are" not in text and not re.search(r"The centres \w+:", text)


def test_speeds_without_a_given_one_say_what_they_are_for() -> None:
    """In place of rows for the frame, which stands still."""
    text = explain(icsolve.load(ROOT / "cases/equilibrium/piston_under_pressure.yaml"))
    assert "No speed is given; these are the speeds while w2 = 1." in text
    assert not re.search(r"^ +(w1|\w on 1) ", text, re.MULTILINE)


@sampled(3)
@pytest.mark.parametrize("name", [name for name in FILES if name.startswith("equilibrium/")])
def test_an_exercise_does_not_stand_in_the_position_that_it_asks_for(name: str) -> None:
    """Neither its figure nor its table tells a point that moves; the key has every position."""
    known = known_of(icsolve.load(FILES[name]))
    asked, positions = known.as_asked, known.answer.positions if known.answer is not None else ()
    assert asked.answer is None and positions
    moving = [p for p in known.points if math.dist(known.points[p], asked.points[p]) > 1e-6 * known.size]
    assert moving
    told = exercise(known)
    table = next(block for block in told.blocks if isinstance(block, ShownTable))
    assert {row[0][0] for row in table.rows}.isdisjoint(moving)
    assert len(positions) == str(told.key[0]).count("; ") + 1


@pytest.mark.parametrize(
    "load", ["{torque: 20, link: 2}", "{spring: 20 N*m/rad, corner: OC, free: 90, link: 2}"]
)
def test_what_gives_the_tension_of_a_rope_comes_to_the_tension(load: str) -> None:
    """A torque or a torsion spring on a drum: the numbers of each formula are what stands behind them."""
    case = icsolve.load(
        "icsolve: 1\nunits: {length: m, force: N, torque: N*m}\n"
        "points: {O: [0, 0], C: [1, 0], B: [0.1, -0.8]}\njoints:\n"
        "  - {pin: [1, 2], at: O}\n  - {slide: [3, 1], at: B, along: 90}\n"
        "  - {rope: [O, B], on: [2, 3], radii: {O: 0.1}, wraps: {O: cw}}\n"
        f"loads:\n  S: {load}\n  F: {{force: unknown, link: 3, at: B, angle: -90}}\n"
    )
    told = explain(case).split("The rope\n", 1)[1].split("Answer\n", 1)[0]
    sides = [line.split(" = ")[1:] for line in told.splitlines() if line.startswith("    T = ")]
    values = {float(eval(side.removesuffix(" N").replace(" x ", "*"), {})) for one in sides for side in one}
    assert values and max(values) == pytest.approx(min(values), rel=1e-5)


BAND = """icsolve: 1
points: {O: [0, 0], D: [-8, -12], B: [8, -12], E: [-28, -12]}
joints:
  - {pin: [1, drum], at: O}
  - {pin: [1, lever], at: D}
  - {rope: [D, O, B], on: [ENDS], radii: {O: 8}, wraps: {O: cw}, mu: {O: 0.3}}
motion: {link: drum, turns: TURNS}
loads:
  T: {torque: 3000, link: drum, turns: TURNS}
  F: {force: unknown, link: lever, at: E, angle: 90}
"""
HOIST = """icsolve: 1
points: {O: [0, 0], A: [-1, -6], B: [4, 1]}
joints:
  - {slide: [a, 1], at: A, along: 90}
  - {rope: [A, O, B], on: [a, 1], radii: {O: 1}, wraps: {O: cw}, mu: {O: 0.25}}
motion: {point: A, link: a, speed: 1, angle: TURNS}
loads:
  W: {force: UNKNOWN, link: a, at: A, angle: -90}
  F: {force: 100, at: B}
"""
SLIPPING = {
    "the lever at the slack end": (BAND, ("ENDS", "1, drum, lever"), ("TURNS", "cw")),
    "the lever at the tight end": (BAND, ("ENDS", "1, drum, lever"), ("TURNS", "ccw")),
    "both ends on the lever": (BAND, ("ENDS", "lever, drum, lever"), ("TURNS", "cw")),
    "a load found from the pull": (HOIST, ("UNKNOWN", "unknown"), ("TURNS", "90")),
    "let down": (HOIST, ("UNKNOWN", "unknown"), ("TURNS", "-90")),
}


@pytest.mark.parametrize("case", SLIPPING)
def test_the_pulls_of_a_rope_that_slips_are_worked_out_before_they_are_used(case: str) -> None:
    text, *changes = SLIPPING[case]
    for old, new in changes:
        text = text.replace(old, new)
    found = icsolve.load(text)
    (tensions,) = icsolve.solve(found, reactions=True).tensions
    lines = explain(found).split("The rope\n--------\n", 1)[1].split("\nAnswer\n", 1)[0].splitlines()
    for n, pull in enumerate(tensions.parts, 1):
        first = next(
            line for line in lines if re.search(rf"(?<![\d.]){re.escape(f'{pull:.6g}')}(?![\d.])", line)
        )
        assert first.strip().startswith(f"T{n} = "), (first, lines)


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 3, "no dust"))
def test_no_number_is_shown_that_is_nothing_beside_its_neighbours(name: str) -> None:
    """What rounding leaves of 0 is 0; the bound of rounding itself is told as what it is."""
    for line in explain(icsolve.load(FILES[name]), bodies=True).splitlines():
        sizes = [abs(float(one)) for one in re.findall(r"\d+\.?\d*(?:e[-+]?\d+)?", line)]
        if "Rounding can have moved" not in line:
            assert not [size for size in sizes if 0.0 < size < 1e-12 * max(*sizes, 1e-12)], line


ALONG = """icsolve: 1
points: {{A: [0, 0], D: [4.1, {down}]}}
lengths: {{AB: {crank}, BC: 3.5, CD: 2.5, DE: 1.5}}
angles: {{AB: {turned}, CDE: 0}}
near: {{C: [3.5, 2.4]}}
joints:
  - {{pin: [1, 2], at: A{rough}}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C{rough}}}
  - {{pin: [4, 1], at: D}}
loads:
  K: {load}
  P: {{force: 100, link: 4, at: E, angle: 180}}
  T12: {{torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("rough", ["", ", mu: 0.1, radius: 0.1"])
@pytest.mark.parametrize(
    "load",
    [
        "{spring: 15, free: 2.35, link: 2, at: B, against: 4, to: C}",
        "{force: 30, link: 2, at: B, toward: C, against: 4}",
    ],
)
def test_what_acts_along_a_bar_does_no_work_to_the_last_digit(load: str, rough: str) -> None:
    """Between the pins of a coupler: what it does on both links is nothing, and is told in six digits."""
    draw = Random(f"{load} {rough}")
    for _ in range(few(12, 4)):
        down, turned = (round(draw.uniform(low, high), 2) for low, high in ((-0.5, 0.5), (20, 110)))
        crank = round(draw.uniform(0.8, 1.2), 3)
        told = explain(
            icsolve.load(ALONG.format(load=load, rough=rough, down=down, turned=turned, crank=crank))
        )
        (power, *_) = (line for line in told.splitlines() if re.match(r" +(F_)?K x \(h_K,2 -", line))
        assert power.endswith(" = 0 N*m") and not re.search(r"\d[\d.]{11,}", power), power
        assert not re.search(r"T12 = \S*-?0 [-+]", told)


def test_arms_that_stand_still_leave_no_dust_in_the_rate_of_a_spring() -> None:
    """While one of two unknown angles grows the outer arm keeps its direction, and its rate is 0."""
    told = explain(
        icsolve.load("""icsolve: 1
points: {A: [0, 0], S: [0, 0.1]}
lengths: {AB: 0.4, BC: 0.35, AK: 0.08}
angles: {AB: {unknown: [-90, 180]}, BC: {unknown: [-180, 90]}, BAK: 0}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
loads:
  W: {weight: 3, link: 3, at: C}
  S1: {spring: 400 N/m, free: 0, link: 2, at: K, to: S}
  S2: {spring: 15 N*m/rad, corner: ABC, free: 120, link: 3, against: 2}
""")
    )
    assert "k_S2,1 = 0 - 1 = -1" in told


def test_a_torque_does_no_work_on_a_link_that_slides() -> None:
    """A couple on the block of a slider-crank, a load and that of its own inertia."""
    told = explain(
        icsolve.load("""icsolve: 1
dynamic: yes
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 2, BC: 6}
angles: {AB: 60}
near: {C: [7, 0]}
links: {4: {mass: 2 kg, centre: C, inertia: 3 kg*m^2}}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {slide: [4, 1], at: C, along: 0}]
loads: {M: {torque: 20, link: 4}, T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 3}
""")
    )
    assert "Link 4 does not turn: M does no work on it." in told
    assert "Link 4 does not turn: T_i4 does no work on it." in told
    assert "M x v4" not in told and "T_i4 x v4" not in told


@pytest.mark.parametrize("folder", ["cams", "dynamics", "equilibrium"])
def test_no_numeral_is_longer_than_its_file_has_it(folder: str) -> None:
    """Contacts and positions are found in more digits than a double has: they are told in those of all."""
    for path in sorted((ROOT / "cases" / folder).glob("*.yaml"))[:: 1 if FULL else 3]:
        text, told = path.read_text(), explain(icsolve.load(path))
        assert not [one for one in re.findall(r"\d[\d.]{14,}", told) if one not in text], path


@pytest.mark.parametrize("pivots", [("[5, 0]", "[10.625, 0]"), ("[5, 0]", "[5, 5.625]")])
def test_wheels_in_series_are_told_mesh_by_mesh_wherever_their_pivots_lie(pivots: tuple[str, str]) -> None:
    """20 : 60 and 60 : 30: on one line no two lines of centres meet; each ratio is that of a pitch point."""
    told = explain(
        icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: {pivots[0]}, C: {pivots[1]}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {{pin: [1, 4], at: C}}
  - {{gears: [2, 3], teeth: [20, 60]}}
  - {{gears: [3, 4], teeth: [60, 30]}}
loads:
  M: {{torque: 12, link: 2}}
  U: {{torque: unknown, link: 4}}
""")
    )
    assert "loop equations" not in told
    assert "U = -18 N*m" in told


@pytest.mark.parametrize("form", ["md", "html", "tex"])
def test_units_have_one_spelling_in_headings_and_below_them(form: str) -> None:
    """A range of torques has its ends in the headings of what is about to begin there."""
    told = explain(
        icsolve.load("""icsolve: 1
points: {A: [0, 0], B: [0.3, 0]}
joints: [{pin: [1, 2], at: A, mu: 0.2, radius: 0.05}]
loads: {W: {weight: 100, link: 2, at: B}, T: {torque: unknown, link: 2}}
"""),
        form,
        bodies=True,
    )
    assert "N*m" not in told.replace(r"\*", "*")
    assert len(re.findall(r"where T.*N(?:·|\$\\cdot\$)m", told)) > 3


@sampled(3)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(12 if FULL else 1))
def test_an_end_of_a_range_that_holds_is_the_motion_that_begins_there(
    kind: Callable[[Random], Rough], seed: int
) -> None:
    """Where friction holds an unknown load over a range each finite end, but one at which a contact parts, is
    the answer of the motion that begins there, and is worked out so: its equations recompute, and the last is
    the end. The motion itself is given, link by link, to `solve`; both are rounded once."""
    case = kind(Random(f"ends {kind.__name__} {seed}")).case("unknown")
    try:
        answer = icsolve.solve(case)
    except icsolve.SceneError as refusal:
        if refusal.status not in ("no-value", "slack"):
            raise
        return
    held = answer.answers["F"].holds
    assert held is not None
    said = explain(case, digits=DIGITS, bodies=True)
    check(text_equations(said), known_of(case).size or 1.0)
    parted = any("would have to pull" in note for note in answer.notes)
    ends = [one.answer.answers["F"].value for one in answer.about_to_move]
    assert parted or ends == sorted(filter(math.isfinite, held))
    assert {*ends} <= {*held}
    for one in answer.about_to_move:
        value = one.answer.answers["F"].value
        moved = icsolve.solve(replace(case, motion=begun(answer, one)))
        assert f"where F = {value:.6g}" in said
        assert re.search(rf"^    F = .*{re.escape(f'{value:.6g}')} ", said, re.M) or not value
        if moved.answers["F"].value != pytest.approx(value, rel=1e-15):  # a pawl has several
            assert any(f"at other values of F too: {value:.6g}" in note for note in moved.notes)
            continue
        assert one.answer.friction is not None
        assert moved.friction is not None
        assert [r.value for r in one.answer.friction.rubbing] == pytest.approx(
            [r.value for r in moved.friction.rubbing], rel=1e-9, abs=1e-9 * abs(value)
        )


def begun(answer: icsolve.Answer, end: AboutToMove) -> tuple[Motion, ...]:
    """The motion that begins at an end, by the first link that turns, or else by a point that moves."""
    known = known_of(answer.case)
    moving = {link: twist for link, twist in known.twists.items() if is_link(link) and not known.rests(link)}
    for link, twist in moving.items():
        if twist[2]:
            return (Motion(link, turns="ccw" if twist[2] * end.way > 0.0 else "cw"),)
    link, twist = next(iter(moving.items()))
    x, y = velocity(twist, (0.0, 0.0, 1.0))
    angle = math.degrees(math.atan2(y * end.way, x * end.way))
    speed, toward = (Number(v, 0.0, "motion", repr(v)) for v in (1.0, round(angle, 9)))
    return (Motion(link, speed, point=answer.case.carries[link][0], angle=toward),)


def test_no_name_of_the_program_stands_in_a_solution() -> None:
    """The end of a rope that stands still is told as such, and a component beside the name of its link."""
    told = explain(
        icsolve.load("""icsolve: 1
points: {O: [0, 0], A: [-3, 0.2], B: [2, -2]}
joints:
  - {pin: [1, drum], at: O}
  - {rope: [A, O, B], on: [1, drum], radii: {O: 0.2}, wraps: {O: cw}, mu: {O: 0.3}}
motion: {link: drum, turns: ccw}
loads: {F: {force: 20, at: B}, T: {torque: unknown, link: drum}}
"""),
        bodies=True,
    )
    assert "@" not in told
    assert "The end of the rope A-O-B stands still: F does no work on it." in told
    assert "F1-drum,x + T1x + T2x = " in told


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 6, "own names"))
def test_no_name_of_the_program_stands_in_the_solution_of_a_case(name: str) -> None:
    """Hidden points and links begin with a sign that no name of a file has; `F12@A` is a reaction's."""
    told = explain(icsolve.load(FILES[name]), bodies=True)
    assert not re.search(r"(?<![\w'])@", told), re.findall(r".*(?<![\w'])@.*", told)


@pytest.mark.parametrize("seed", range(4))
def test_a_force_of_unknown_direction_is_made_of_its_components(seed: int) -> None:
    """The end of an arm of two links: both components, then the size, each by numbers that recompute."""
    draw = Random(seed)
    x, y, a, b = (round(draw.uniform(1, 4), 3) for _ in range(4))
    case = icsolve.load(
        f"icsolve: 1\npoints: {{A: [0, 0], B: [{x}, {y}], C: [{x + a}, {y - b}]}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]\n"
        f"loads: {{M: {{torque: {x}, link: 2}}, W: {{weight: {10 * b}, link: 3, at: B}},\n"
        "  Q: {force: [unknown, unknown], link: 3, at: C}}\n"
    )
    told = explain(case, digits=DIGITS)
    found = icsolve.solve(case).answers["Q"]
    assert found.components is not None
    for axis, value in zip("xy", found.components, strict=True):
        assert f"    Q.{axis} = {value:.6g} N\n" in told
    assert re.search(rf"^    Q = sqrt\(Q.x\^2 \+ Q.y\^2\) = sqrt\(.*\) = {found.value:.6g} N$", told, re.M)
    assert not disagreeing(told)


@pytest.mark.parametrize("turns", ["ccw", "cw"])
@pytest.mark.parametrize("known", ["ccw", "cw"])
def test_no_equation_says_a_number_twice(turns: str, known: str) -> None:
    """One torque against another, each positive either way: `T = -50 = -50` stood there."""
    text = explain(
        icsolve.load(
            "icsolve: 1\npoints: {A: [0, 0]}\njoints: [{pin: [1, 2], at: A}]\nloads:\n"
            f"  M: {{torque: 50, link: 2, turns: {known}}}\n"
            f"  T: {{torque: unknown, link: 2, turns: {turns}}}\n"
        )
    )
    sign = "-" if turns == known else ""
    assert f"    T = {sign}50 N*m\n" in text


@pytest.mark.parametrize("friction", ["", ", mu: 0.1"])
def test_what_a_worked_solution_begins_it_says_to_the_end(friction: str) -> None:
    """A wheel at a steady speed has no inertia force, and no formula behind a colon; the work of friction is
    in the equation, that of the other forces in the joints is none."""
    text = f"""icsolve: 1
points: {{A: [0, 0], C: [unknown, 0]}}
lengths: {{AB: 1, BC: 3}}
angles: {{AB: 50}}
near: {{C: [3, 0]}}
links: {{2: {{mass: 2 kg, centre: A}}, 4: {{mass: 3 kg, centre: C}}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0{friction}}}
loads: {{T: {{torque: unknown, link: 2}}}}
motion: {{link: 2, speed: 5}}
dynamic: yes
"""
    told = explain(icsolve.load(text))
    assert "moves A with a_A = (0, 0) m/s^2, so its inertia force is zero.\n" in told
    assert not re.search(r"m/s\^2:\n(?!    )", told)
    idle = "do no work but by friction" if friction else "do no work"
    assert f"The forces in the joints: they {idle}, and the equation of power is" in told


CRATE = """
icsolve: 1
title: crate
points: {A: [0, 0], B: [0.8, 0], G: [0.4, 0.6], H: [0, HIGH]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.3}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.3}
loads:
  W: {weight: 400, link: 2, at: G}
  P: {force: PUSH, link: 2, at: H, angle: 0}
"""


@pytest.mark.parametrize(("high", "push"), [(1.0, 100), (1.0, 130), (1.8, 100), (1.0, -120)])
def test_of_known_loads_it_is_asked_and_answered_whether_friction_holds_them(high: float, push: int) -> None:
    """A crate slides from 0.3 of its weight on, and tips where the push is more than 160 over its height; in
    the worked solution, the figure's caption, the card of a gallery, and the key of a sheet."""
    case = icsolve.load(CRATE.replace("HIGH", str(high)).replace("PUSH", str(push)))
    holds = abs(push) <= min(120, 160 / high)
    said = "Friction holds it still" if holds else "Friction does not hold it still"
    known = known_of(case)
    assert found_sentences(known) == [said]
    text, asked = explain(case), "Does friction hold the mechanism still under these loads?"
    assert asked in text and f"Answer\n------\n{said}." in text
    one = exercise(known)
    assert one.key == (f"{said}.",) and any(asked in str(block) for block in one.blocks)
    assert not any(said in str(block) for block in (*one.blocks, *one.figure))
