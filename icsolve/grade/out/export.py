"""Cases as questions of a platform: Moodle XML, GIFT, a PrairieLearn question, a Gradescope autograder."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import NamedTuple

from icsolve.case import Case
from icsolve.grade.course import Course
from icsolve.grade.files import write_whole
from icsolve.grade.keys import Key, NoKeyError
from icsolve.grade.out.element import Made, element
from icsolve.grade.out.given import given
from icsolve.grade.out.gradescope import Source, autograder_zip
from icsolve.grade.out.questions import Question, gift, moodle_xml
from icsolve.grade.out.wording import asked, figure
from icsolve.grade.questions import unknowns
from icsolve.grade.shelf import Shelf
from icsolve.grade.solved import Solved

Complain = Callable[[str], None]


class Order(NamedTuple):
    """What to write: the cases, where, with figures or not, how many variants of a case with variables; the
    files of the course and of the roster, for what goes on grading by itself."""

    shelf: Shelf
    path: str
    force: bool
    figures: bool
    variants: int
    course: str = ""
    roster: str = ""


def questions(order: Order, complain: Complain) -> Iterator[Question]:
    """A question for every unknown load of every case; what can't be one is told."""
    for name in sorted(order.shelf.paths):
        try:
            varied = order.shelf.variation(name)
            if varied is None:
                solved = order.shelf.solved(name)
                yield from _of_case(solved, solved.case, name, order.figures)
                continue
            varied.foresee(str(n) for n in range(1, order.variants + 1))
            for n in range(1, order.variants + 1):
                case = varied.read(varied.draw(str(n)).values)
                yield from _of_case(varied.solved(str(n)), case, f"{name} v{n}", order.figures)
        except NoKeyError as error:
            complain(f"{order.shelf.paths.get(name, name)}: {error}")


def _of_case(solved: Solved, case: Case, name: str, figures: bool) -> Iterator[Question]:
    names = unknowns(case)
    if not names:
        raise NoKeyError("no unknown load, so no question")
    picture = figure(case) if figures else ""
    for what in names:
        own = case.name if len(names) == 1 else f"{case.name}:{what}"
        key = solved.key(own)
        assert isinstance(key, Key)
        text = asked(key, solved.target(own))
        shown = name if len(names) == 1 else f"{name}:{what}"
        yield Question(shown, tuple(given(case)), text, key, picture, case.title)


def export(kind: str, order: Order, complain: Complain) -> int:
    """Write all cases as ``kind``; how many questions there are.

    Raises ExistsError or OSError.
    """
    if kind == "gradescope-zip":
        return _zip(order)
    if kind == "prairielearn":
        return _elements(order._replace(variants=1), complain)
    found = list(questions(order._replace(figures=order.figures and kind == "moodle-xml"), complain))
    make = moodle_xml if kind == "moodle-xml" else gift
    write_whole(order.path, make(found, order.shelf.course.title or "icsolve"), order.force)
    return len(found)


def _elements(order: Order, complain: Complain) -> int:
    """A folder a question."""
    found = list(questions(order, complain))
    course = _text(order.course) if order.course else ""
    for question in found:
        case, _, what = question.key.question.partition(":")
        folder = os.path.join(order.path, question.key.question.replace(":", "-"))
        varied = order.shelf.variation(case) is not None
        made = Made(case, order.shelf.text(case), what, course, varied)
        for name, text in element(question, made).items():
            write_whole(os.path.join(folder, name), text, order.force)
    return len(found)


def _zip(order: Order) -> int:
    """All cases with the course, the roster and icsolve itself."""
    shelf = order.shelf
    cases = {os.path.basename(at): shelf.text(name) for name, at in shelf.paths.items()}
    course, roster = (_text(path) if path else "" for path in (order.course, order.roster))
    seed = shelf.course.seed if shelf.course.seed != Course().seed else ""
    write_whole(order.path, autograder_zip(Source(cases, course, roster, seed)), order.force)
    return len(cases)


def _text(path: str) -> str:
    with open(path, encoding="utf-8-sig") as file:
        return file.read()


KINDS = ("moodle-xml", "gift", "prairielearn", "gradescope-zip")
