"""Variants taken together in one sweep: the answers, keys and verdicts of single scenes, row by row."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

import icsolve
from grade_shell import PRESS
from icsolve.errors import IcsolveError
from icsolve.grade.case_store import Solved
from icsolve.grade.course import Course
from icsolve.grade.judge import judge
from icsolve.grade.keys import Key
from icsolve.grade.roster import Person
from icsolve.grade.variants import Varied
from icsolve.grade.variants.family import Family, UnsuitedError, as_written
from icsolve.grade.variants.sheets import Task, key_csv, tasks
from icsolve.grade.variants.together import look
from icsolve.grade.variants.varied import looked_at
from icsolve.grade.written import Reader
from icsolve.sweep.numbers import with_numbers

CASES = sorted((Path(__file__).parent.parent / "cases").rglob("*.yaml"))
ROWS = 8
MANY = PRESS.replace(
    "a: {choices: [1, 1.25, 1.5]}", "a: {range: [0.5, 2], step: 0.01}\n  phi: {range: [20, 90], step: 0.1}"
).replace("AB: 60", "AB: $phi")


def families() -> list[tuple[Path, Family]]:
    """The cases of the library whose variants can be taken together."""
    found = []
    for path in CASES:
        try:
            case = icsolve.load(path)
            found.append((path, Family(case, Solved(case, Course(), bound=True).answer)))
        except (IcsolveError, UnsuitedError):
            continue
    return found


def test_other_numbers_in_every_case_of_the_library_swept_and_solved_one_by_one() -> None:
    """Every length, angle and load up to a quarter larger or smaller: the same answer to 1e-11, the same
    verdict on dead centres, and the same mistakes that would not show."""
    found, compared = families(), 0
    for path, family in found:
        rng = random.Random(path.stem)
        columns = {
            name: np.array([float(f"{value * rng.uniform(0.75, 1.25):.4g}") for _ in range(ROWS)])
            for name, value in family.numbers.items()
            if value and not name.startswith("points")
        }
        for row, seen in enumerate(look(family, columns, ROWS)):
            if seen is None:
                continue  # left to a scene of its own
            case = with_numbers(family.case, {name: float(a[row]) for name, a in columns.items()})
            answer = Solved(case, Course(), bound=True).answer
            alone = looked_at(answer)
            assert seen.value == pytest.approx(answer.answers[family.unknown].value, rel=1e-11), path
            assert (seen.far, seen.swallowed if alone.far else alone.swallowed) == alone[:2], path
            compared += 1
    assert len(found) > 30
    assert compared > 200


def test_numbers_of_the_case_are_all_inputs_of_its_family() -> None:
    case = icsolve.load(PRESS)
    family = Family(case, Solved(case, Course(), bound=True).answer)
    assert family.numbers.keys() == as_written(case).keys()


SLIDER = """\
icsolve: 1
variables:
  T: {range: [10, 50], step: 5}
  r: {range: [0.8, 1.2], step: 0.01}
  phi: {range: [30, 150], step: 1}
points: {A: [0, 0], C: [unknown, 0.5]}
lengths: {AB: $r, BC: 3}
angles: {AB: $phi}
near: {C: [3, 0.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  T12: {torque: $T, link: 2}
  P: {force: unknown, link: 4, at: C, angle: 180}
motion: {link: 2, turns: ccw}
"""
WITH_WEIGHT = MANY.replace("  T12:", "  W: {weight: 50, link: 3, at: C}\n  T12:")


TEXTS = pytest.mark.parametrize(
    "text", [MANY, WITH_WEIGHT, SLIDER], ids=["all loads alike", "with a weight", "slider"]
)


@TEXTS
def test_a_class_drawn_in_one_sweep_has_the_variants_and_keys_of_one_by_one(text: str) -> None:
    students = [f"{n:04d}" for n in range(60)]
    swept, alone = (Varied("press", text, "press.yaml", Course()) for _ in range(2))
    found = [task for task in tasks(swept, map(Person, students)) if isinstance(task, Task)]
    assert [task.draw for task in found] == [alone.draw(student) for student in students]
    assert not swept._tasks
    assert any(seen is not None and seen.value is not None for seen in swept._seen.values())
    one_by_one = [Task(Person(student), alone.draw(student)) for student in students]
    assert key_csv(swept, found) == key_csv(alone, one_by_one)
    assert alone._tasks


ALL_ALIKE = PRESS.replace("a: {choices: [1, 1.25, 1.5]}", "a: {range: [1, 1.5], step: 0.01}")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("force: $P, link: 4, at: E, angle: 180", "force: $P, link: 4, at: [3.6, 1], toward: B"),
        ("force: $P, link: 4, at: E, angle: 180", "force: $P, link: 4, at: C, angle: 180, against: 2"),
        ("force: $P, link: 4, at: E, angle: 180", "torque: $P, link: 4"),
        ("force: $P, link: 4, at: E, angle: 180", "force: $P, link: 4, at: E, slope: [-3, $a]"),
        ("force: $P, link: 4, at: E, angle: 180", "weight: $P, link: 3, at: C"),
        ("D: [4, 0]", "D: [3 + $a, 0]"),
        ("torque: unknown, link: 2", "force: unknown, link: 2, at: B, toward: D"),
        ("torque: unknown, link: 2", "torque: unknown, link: 2, turns: cw"),
    ],
)
def test_loads_and_numbers_of_every_kind_are_swept(old: str, new: str) -> None:
    text = ALL_ALIKE.replace(old, new)
    swept, alone = (Varied("press", text, "press.yaml", Course()) for _ in range(2))
    students = [str(n) for n in range(40)]
    swept.foresee(students)
    assert sum(swept.value(draw) is not None for draw in swept._draws.values()) > 8
    for student in students[:12]:
        assert swept.draw(student) == alone.draw(student)
        one, two = swept.key("press", student), alone.key("press", student)
        assert one.value == pytest.approx(two.value, rel=1e-11)  # type: ignore[union-attr]


def test_a_variable_in_something_else_than_a_number_is_taken_one_by_one() -> None:
    text = PRESS.replace("near: {C: [3.5, 2.4]}", "near: {C: [3.5, 2.4 + 0*$a]}")
    varied = Varied("press", text, "press.yaml", Course())
    varied.foresee(map(str, range(20)))
    assert varied._together is None
    assert varied.draw("3") == Varied("press", PRESS, "press.yaml", Course()).draw("3")


def test_loads_that_cancel_in_some_variants_are_not_given() -> None:
    """T12 balances 100 and Q at the same point, the other way: with Q = 100 nothing is left to find."""
    text = PRESS.replace("P: {range: [100, 500], step: 10}", "P: {choices: [100]}\n  Q: {choices: [50, 100]}")
    text = text.replace("  T12:", "  Q: {force: $Q, link: 4, at: E, angle: 0}\n  T12:")
    varied = Varied("press", text, "press.yaml", Course())
    drawn = {varied.draw(str(n)).values["Q"] for n in range(30)}
    assert drawn == {"50"}


@TEXTS
def test_a_swept_key_judges_every_answer_as_that_of_the_single_scene(text: str) -> None:
    """Number, unit, words of direction that ask where points are, and the causes of wrong answers."""
    varied = Varied("press", text, "press.yaml", Course())
    students = [str(n) for n in range(20)]
    varied.foresee(students)
    forms = ("{:.5g}", "{:.5g} N", "{:.5g} N*m", "{:.4g} toward A", "{:.4g} away from A", "{:.4g} left")
    factors = (1.0, -1.0, 2.0, 0.5, 1.02, 10.0, 1.37)
    for student in students:
        quick, slow = varied.key("press", student), varied.task(varied.draw(student)).key("press")
        assert isinstance(quick, Key)
        assert isinstance(slow, Key)
        for form in forms:
            for factor in factors:
                written = Reader().read(form.format(abs(slow.value) * factor))
                one, two = judge(quick, written), judge(slow, written)
                assert (one.verdict, one.code, one.parts) == (two.verdict, two.code, two.parts)
        assert (quick.unit_name, quick.accepted, quick.rule) == (slow.unit_name, slow.accepted, slow.rule)
