"""An answer keeps its solution: what explains, draws or moves a case lays out what is there.

Calls are counted as they happen, whatever they are called through.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from random import Random
from types import CodeType, FrameType
from typing import Any

import pytest

import icsolve
from icsolve.assembly import solve_figure
from icsolve.assembly.newton import _searched
from icsolve.bench.families import BUTTERFLY, by_sides, linkage
from icsolve.case import Case
from icsolve.draw import Drawing, draw
from icsolve.explain import explain
from icsolve.page import page_html
from icsolve.read.document import parse
from icsolve.scene.program import evaluate
from icsolve.structure import topology
from icsolve.sweep.program import setting_of
from sizes import sampled

CASES = Path(__file__).parent.parent / "cases"
SHOWN = {
    "text": lambda case: explain(case, "text"),
    "html": lambda case: explain(case, "html", bodies=True),
    "figure": draw,
    "panels": lambda case: draw(case, Drawing("all", circle=True, velocities=True, bodies=True)),
}
MECHANISMS = (
    "ch13/13_01_drag_link.yaml",
    "ch13/13_06_six_bar_slider.yaml",
    "ch13/13_16_slider_crank_with_friction.yaml",
    "ch13/13_23_spur_gears.yaml",
    "springs/knee_with_spring.yaml",
)


def code_of(function: Any) -> CodeType:
    """The code that runs when a function is not answered from a memory of earlier calls."""
    code: CodeType = getattr(function, "__wrapped__", function).__code__
    return code


WORK = {code_of(f): f.__name__ for f in (topology, solve_figure, evaluate)}


def kind_of_numbers(arithmetic: object) -> str:
    """In which numbers something is worked out: floats, decimals of so many digits, a tape."""
    return "" if arithmetic is None else f" {type(arithmetic).__name__}{getattr(arithmetic, 'digits', '')}"


def counted(case: Case, work: Callable[[Case], object]) -> Counter[str]:
    """How often topology, figure and motions of a case are worked out."""
    found: Counter[str] = Counter()

    def watch(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code in WORK and frame.f_locals.get("case", case) is case:
            found[WORK[frame.f_code] + kind_of_numbers(frame.f_locals.get("arithmetic"))] += 1

    sys.setprofile(watch)
    try:
        work(case)
    finally:
        sys.setprofile(None)
    return found


@sampled(3, "name", "shown")
@pytest.mark.parametrize("shown", SHOWN)
@pytest.mark.parametrize("name", MECHANISMS)
def test_one_topology_one_figure_one_solve(name: str, shown: str) -> None:
    case = icsolve.load(CASES / name)
    found = counted(case, SHOWN[shown])
    assert found["topology"] == found["solve_figure"] == 1
    assert found["evaluate Floats"] <= 1
    assert set(found.values()) == {1}  # in each kind of numbers once


@sampled(2)
@pytest.mark.parametrize("name", MECHANISMS[:2])
def test_a_page_adds_the_setting_of_its_sweep(name: str) -> None:
    """The sweep knows where all points are, and not only those that the answer needs."""
    case = icsolve.load(CASES / name)
    found = counted(case, page_html)
    assert (found["topology"], found["solve_figure"]) == (1, 2)
    assert all(count == 1 for work, count in found.items() if work.startswith("evaluate"))


@sampled(3)
@pytest.mark.parametrize("name", ["four_bar", "stephenson_six_bar", "geared_five_bar"])
def test_a_page_without_friction_sets_no_sweep_up_twice_and_reads_its_text_twice(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its curve and its dead centres are of one mechanism, whatever case tells of it; and its text is read as
    a case and for the places of its numbers, however many these are."""
    case = icsolve.load(CASES / "linkages" / f"{name}.yaml")
    found: Counter[object] = Counter()

    def counted(room: str, work: Callable[..., Any]) -> None:
        def call(first: object, *rest: object, **named: object) -> object:
            found[work.__name__, *(rest if work is setting_of else [first])] += 1
            return work(first, *rest, **named)

        monkeypatch.setattr(import_module(room), work.__name__, call)

    counted("icsolve.sweep.starting_position", setting_of)
    for room in ("icsolve.read", "icsolve.page.fields"):
        counted(room, parse)
    page_html(case)
    driven = [count for (what, *_), count in found.items() if what == "setting_of"]
    texts = [count for (what, *_), count in found.items() if what == "parse"]
    assert set(driven) == {1}
    assert texts == [2]


def test_a_figure_is_searched_for_once_whatever_its_loads_are() -> None:
    """Points that only all their data place: with another load, or read again, they are the same."""
    text = by_sides(linkage(BUTTERFLY), (1, 4))(Random(3))
    _searched.cache_clear()
    answers = [icsolve.solve(icsolve.load(text, {"loads.K": size})) for size in (3.0, 5.0, 5.0)]
    assert _searched.cache_info().misses == 1
    assert len({tuple(one.value for one in answer.answers.values()) for answer in answers}) == 2


def test_what_is_not_asked_of_a_row_with_inertia_forces_is_not_worked_out() -> None:
    """A slider moves along its guide alone, and that its speed across is 0 no few digits tell: of a row whose
    answer is asked neither speeds nor accelerations are. Its inertia force across is 0, too, which is told
    once, by the most digits, after the fewest."""
    case = icsolve.load(
        """icsolve: 1
dynamic: yes
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 75, BC: 250}
angles: {AB: 50}
near: {C: [300, 0]}
links: {3: {points: [G], mass: 1.6 kg, centre: G, inertia: 0.012 kg*m^2}, 4: {mass: 1.2 kg, centre: C}}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {slide: [4, 1], at: C, along: 0}]
motion: {link: 2, speed: 2000 rpm}
loads: {P: {force: 3000, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}
""".replace("points: {A", "points: {G: {centroid: [B, C]}, A")
    )
    done = counted(case, lambda one: icsolve.solve(one).answers["T"])
    assert sum(count for what, count in done.items() if what.startswith("evaluate")) == 3
