"""`icsolve variants` and `export`: what a course hands out, a sheet a student or questions of a platform."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.commands import FORCE, Verb
from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain, refusing, watched
from icsolve.files import can_fork, check_ending, check_free, started, together, write_whole
from icsolve.tuples import TypeVar
from icsolve.wording import plural

if TYPE_CHECKING:
    from icsolve.grade.case_store import CaseStore
    from icsolve.grade.course import Person
    from icsolve.grade.variants.record import VariantTask
    from icsolve.grade.variants.varied import Varied

T = TypeVar("T")


@click.command("variants", cls=Verb)
@click.argument("cases", metavar="CASES")
@click.option("--roster", metavar="FILE", required=True, help="The students: a CSV with a column student_id.")
@click.option("-o", "--output", metavar="DIR", required=True, help="The folder to write into.")
@click.option("--course", metavar="FILE", help="Seed and tolerances [default: course.yaml beside the cases].")
@click.option("--seed", metavar="TEXT", help="Another seed gives other variants.")
@click.option("--figures/--no-figures", default=True, help="An SVG of each variant, and a sheet a student.")
@FORCE
@click.option("-q", "--quiet", is_flag=True, help="No report.")
def variants_command(
    cases: str,
    roster: str,
    output: str,
    course: str | None,
    seed: str | None,
    figures: bool,
    force: bool,
    quiet: bool,
) -> int:
    """Give each student of a roster numbers of their own, for every case with `variables`.

    \b
    icsolve variants cases/ --roster roster.csv -o sheets/
    icsolve grade answers.csv --cases cases/ --roster roster.csv -o results.csv

    A student's values follow from the case's name, the student's id and the seed alone; `grade`
    computes each student's key again. Exit status: 1 where a student has no variant that suits.
    """
    from icsolve.cli.grading import course_of
    from icsolve.grade.case_store import CaseStore
    from icsolve.grade.course import read_roster

    def work() -> int:
        case_store = CaseStore(existing(cases), course_of(course, cases, quiet, {"seed": seed}))
        case_store.check_course()
        people = read_roster(roster, lambda line, why: complain(f"{roster}:{line}: {why}"))
        with together():
            return _all(case_store, list(people.people.values()), output, figures, force, quiet)

    return refusing("variants", work)


def existing(cases: str) -> str:
    """The path, if there is something. Raises FileNotFoundError."""
    if not os.path.exists(cases):
        raise FileNotFoundError(2, "there is no such file or folder", cases)
    return cases


def _all(
    case_store: CaseStore, people: list[Person], output: str, figures: bool, force: bool, quiet: bool
) -> int:
    from icsolve.grade.tolerance import NoKeyError

    code, some = DONE, False
    for name in sorted(case_store.paths):
        varied = case_store.variation(name)
        if varied is not None:
            some = True
            code = max(code, _one(varied, people, os.path.join(output, name), figures, force, quiet))
        elif "$" in case_store.text(name):
            try:
                case_store.solved(name)
            except NoKeyError as error:
                complain(str(error))
                code = max(code, UNREADABLE)
    if not some and code == DONE:
        complain(
            "icsolve variants: no case has variables, as in `variables: {P: {range: [100, 500], step: 10}}`"
        )
        return UNREADABLE
    return code


def _one(varied: Varied, people: list[Person], folder: str, figures: bool, force: bool, quiet: bool) -> int:
    """One case: values and key of all students, then figures and sheets."""
    from icsolve.grade.tolerance import NoKeyError
    from icsolve.grade.variants.record import key_csv, tasks, values_csv, without_key

    paths = [os.path.join(folder, name) for name in ("values.csv", "key.csv")]
    for path in paths:
        check_free(path, force)
    start = time.perf_counter()
    found: list[VariantTask] = []
    code = DONE
    drawn = zip(people, tasks(varied, people), strict=True)
    for person, task in watched(drawn, len(people), "variants", quiet):
        if isinstance(task, NoKeyError):
            complain(f"{person.student_id}: {task}")
            code = NO_ANSWER
        else:
            found.append(task)
    for told in without_key(varied, found):
        complain(told)
        code = NO_ANSWER
    write_whole(paths[0], values_csv(varied, found), force)
    write_whole(paths[1], key_csv(varied, found), force)
    if not quiet:
        seconds = time.perf_counter() - start
        complain(f"{folder}: values and key of {plural(len(found), 'student')} in {seconds:.2f} s")
    if figures:
        _figures(varied, found, folder, force, quiet)
    return code


def _figures(varied: Varied, found: list[VariantTask], folder: str, force: bool, quiet: bool) -> None:
    """A figure for each variant, and a sheet for each student; by two processes where that pays."""
    start = time.perf_counter()
    by_label: dict[str, list[VariantTask]] = {}
    for task in found:
        by_label.setdefault(task.draw.label, []).append(task)
        check_free(_sheet_path(folder, task), force)
    for label in by_label:
        check_free(_figure_path(folder, label), force)
    groups = list(by_label.values())
    others = int(can_fork() and len(groups) >= _WORTH_TWO and (os.cpu_count() or 1) > 1)
    parts = [groups[n :: others + 1] for n in range(others + 1)]
    with started([(_draw, (varied, part, folder, force, True)) for part in parts[1:]]) as waiting:
        _draw(varied, parts[0], folder, force, quiet)
        waiting()
    if not quiet and groups:
        rate = len(groups) / (time.perf_counter() - start)
        made = f"{plural(len(groups), 'figure')} and {plural(len(found), 'sheet')}"
        complain(f"{folder}: {made}, {rate:.0f} figures a second")


_WORTH_TWO = 50
"""Figures from which another process pays."""


def _draw(varied: Varied, groups: list[list[VariantTask]], folder: str, force: bool, quiet: bool) -> None:
    """The figure of each group of students with the same variant, and their sheets."""
    from icsolve.grade.platforms.questions import figure
    from icsolve.grade.variants.record import sheet

    for tasks in watched(groups, len(groups), "figures", quiet):
        picture = figure(varied.read(tasks[0].draw.values))
        write_whole(_figure_path(folder, tasks[0].draw.label), picture, force)
        for task in tasks:
            write_whole(_sheet_path(folder, task), sheet(varied, task, picture), force)


def _figure_path(folder: str, label: str) -> str:
    return os.path.join(folder, "figures", f"{label}.svg")


def _sheet_path(folder: str, task: VariantTask) -> str:
    from icsolve.grade.variants.record import file_name

    return os.path.join(folder, "sheets", f"{file_name(task.person.student_id)}.html")


QUESTIONS = {
    "moodle-xml": (".xml",),
    "gift": (".gift", ".txt"),
    "qti": (".zip",),
    "prairielearn": (),
    "gradescope-zip": (".zip",),
}
"""The kinds that are exported, and what their files end in; without that a folder."""
_WHOSE = "each student has numbers of their own, by --roster or --variants"
COUNT = 10
"""Variants of a case, where no other number is asked for."""


@click.command("export", cls=Verb)
@click.argument("kind", type=click.Choice(tuple(QUESTIONS)))
@click.argument("cases", metavar="CASES")
@click.option("-o", "--output", metavar="FILE", required=True, help="The file; for prairielearn a folder.")
@click.option(
    "--course", metavar="FILE", help="Tolerances and marks [default: course.yaml beside the cases]."
)
@click.option("--roster", metavar="FILE", help="For gradescope-zip: by which students get their variants.")
@click.option("--seed", metavar="TEXT", help="Seed of the variants.")
@click.option("--variants", metavar="FILE", multiple=True, help="For gradescope-zip: values.csv, the record.")
@click.option("--count", type=click.IntRange(1, 1000), show_default=f"{COUNT}", help="Variants of a case.")
@click.option("--figures/--no-figures", default=None, help="The figure of each question, without its answer.")
@FORCE
def export_command(kind: str, cases: str, output: str, **options: Any) -> int:
    """Make quiz questions (with tolerances, units, and feedback on known mistakes) or an autograder of cases.

    \b
    icsolve export moodle-xml cases/ -o quiz.xml
    icsolve export qti cases/ -o quiz.zip
    icsolve export gradescope-zip cases/ -o autograder.zip
    """
    return refusing("export", lambda: _exported(kind, cases, output, options))


def _exported(kind: str, cases: str, output: str, options: dict[str, Any]) -> int:
    from icsolve.cli.grading import course_file, course_of
    from icsolve.grade.case_store import CaseStore
    from icsolve.grade.platforms.export import ExportOrder, export

    problems: list[str] = []
    for option in ("roster", "variants"):
        if options[option] and kind != "gradescope-zip":
            raise ValueError(f"--{option} is for gradescope-zip; the variants of {kind} are nobody's")
    course = course_of(options["course"], cases, False, {"seed": options["seed"]})
    case_store = CaseStore(existing(cases), course)
    case_store.check_course()
    if QUESTIONS[kind]:
        check_free(output, options["force"])
        check_ending(output, QUESTIONS[kind], kind)
    elif os.path.splitext(output)[1].lower() in {ending for some in QUESTIONS.values() for ending in some}:
        raise ValueError(f"{output} ends as a file, and what {kind} writes is a folder")
    own = options["course"] or course_file(cases)
    drawn = (options["force"], options["figures"] is not False, options["count"] or COUNT)
    order = ExportOrder(case_store, output, *drawn, own, options["roster"] or "")
    with together():
        made = export(kind, order._replace(records=tuple(options["variants"])), problems.append)
    for problem in problems:
        complain(problem)
    what = "case" if kind == "gradescope-zip" else "question"
    for option in ("count", "figures"):
        if options[option] and kind == "gradescope-zip":
            complain(f"--{option} is for questions, of which {kind} makes none: {_WHOSE}")
    complain(f"wrote {output}: {plural(made, what)}")
    return NO_ANSWER if problems else DONE
