"""`icsolve grade`."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from shutil import copyfileobj
from typing import IO, TYPE_CHECKING, Any

import click

from icsolve.cli.commands import FORCE, Verb
from icsolve.cli.run import DONE, NO_ANSWER, complain, progress, refusing
from icsolve.files import (
    check_free,
    files_of,
    filling,
    folder_of,
    note,
    scratch,
    together,
    whole_file,
    write_whole,
)

if TYPE_CHECKING:
    from icsolve.grade.course import Course
    from icsolve.grade.run import Graded, Job

COURSE = "course.yaml"
"""The course that is taken where none is named and the folder of cases has it."""


@click.command("grade", cls=Verb)
@click.argument("submissions", metavar="SUBMISSIONS...", nargs=-1, required=True)
@click.option("--cases", metavar="DIR", required=True, help="The folder of cases.")
@click.option("-o", "--output", metavar="FILE", help="Results as CSV; - for standard output.")
@click.option("--jsonl", metavar="FILE", help="Results as JSON Lines, with every cause that fits.")
@click.option("--html", metavar="FILE", help="The class summary as one HTML page.")
@click.option("--students", metavar="DIR", help="A page for each student, without right answers.")
@click.option(
    "--write",
    "writes",
    metavar="KIND=FILE",
    multiple=True,
    help="For a platform: canvas, brightspace, blackboard, moodle, gradescope, prairielearn,"
    " prairielearn-csv, junit. Repeatable.",
)
@click.option("--total", metavar="COLUMN", help="All questions together, in one column of the gradebook.")
@click.option("--overrides", metavar="FILE", multiple=True, help="Marks given by hand.")
@click.option("--against", metavar="OLD.csv", help="Earlier results: says whose marks change, and why.")
@click.option("--changes", metavar="FILE", help="With --against: every mark that changes, as CSV.")
@click.option("--review", metavar="FILE", help="What waits for a person; filled, it is a file of overrides.")
@click.option("--template", metavar="FILE", help="The platform's own grade file, to be filled.")
@click.option("--roster", metavar="FILE", help="Who the students are; those without an answer are listed.")
@click.option("--course", metavar="FILE", help="Tolerances, marks, strictness [default: DIR/course.yaml].")
@click.option("--attempt", type=click.Choice(["last", "first", "best"]), help="Which attempt counts [last].")
@click.option("--decimal", type=click.Choice(["either", "point", "comma"]), help="What 1,234 means [either].")
@click.option("--dates", type=click.Choice(["day", "month"]), help="What comes first in 05/12/2025.")
@click.option("--seed", metavar="TEXT", help="Seed of the variants.")
@click.option(
    "--variants", metavar="FILE", multiple=True, help="values.csv: the numbers handed out count. Repeatable."
)
@click.option(
    "--map", "mapping", metavar="A=B", multiple=True, help='A column: student_id="Email Address", "Q3=press".'
)
@click.option("--student", metavar="ID", help="All answers are this student's; a table needs no ids then.")
@click.option("--metadata", metavar="FILE", help="Gradescope's submission_metadata.json says who it is.")
@click.option("--jobs", type=click.IntRange(1, 64), hidden=True, expose_value=False)
@FORCE
@click.option("-q", "--quiet", is_flag=True, help="No summary.")
def grade_command(**options: Any) -> int:
    """Grade a table of answers (CSV of any learning platform) against a folder of cases.

    \b
    icsolve grade answers.csv --cases cases/ -o results.csv
    icsolve grade quiz.csv --cases cases/ --map "Q1=press" --roster roster.csv --html summary.html

    Exit status: 0 all answers judged, 1 some could not be and are listed, 2 a file can't be used.
    """
    from icsolve.grade.run import spare_collector

    spare_collector()
    return refusing("grade", lambda: _graded(_job(options), options))


def _job(options: dict[str, Any]) -> Job:
    from icsolve.grade.run import Job

    if not os.path.exists(options["cases"]):
        raise FileNotFoundError(2, "there is no such folder", options["cases"])
    _check_kinds(options)
    _note_inputs(options)
    outputs = [options[name] for name in ("output", "jsonl", "html", "changes", "review")]
    for path in (*outputs, *_pairs(options["writes"]).values()):
        if path not in (None, "-"):  # not there already, nor one of the inputs
            check_free(path, options["force"])
    if options["changes"] and not options["against"]:
        raise ValueError("--changes needs --against OLD.csv, the results to compare with")
    for option, what in (("total", "the gradebook that has the column"), ("template", "what is filled in")):
        if options[option] and not options["writes"]:
            raise ValueError(f"--{option} needs --write KIND=FILE, {what}")
    if options["against"] and not os.path.isfile(options["against"]):
        raise FileNotFoundError(2, "there is no such file", options["against"])
    course = _course(options)
    seeds = (course.seed, "0")
    if options["seed"] is not None:
        course = course._replace(seed=options["seed"])
    student, group = options["student"] or "", tuple[str, ...]()
    if options["metadata"]:
        from icsolve.grade.tables.platforms import students_of

        group = students_of(options["metadata"])
        student = student or group[0]
    submissions = tuple(options["submissions"])
    roster, variants = options["roster"] or "", tuple(options["variants"])
    overrides = tuple(options["overrides"])
    extra = (variants, seeds, overrides, options["dates"] or "", group)
    return Job(submissions, options["cases"], course, roster, student, *extra)


def _note_inputs(options: dict[str, Any]) -> None:
    """Remember all that will be read before anything is written."""
    from icsolve.grade.importing import expand

    named = (options[name] for name in ("roster", "course", "metadata", "cases", "against"))
    several = (path for name in ("overrides", "variants") for path in options[name])
    submissions = (path for path, _ in expand(options["submissions"]))
    cases = files_of(options["cases"], (".yaml", ".yml"))
    for path in (*filter(None, named), *several, *submissions, *cases):
        note(path)


def _check_kinds(options: dict[str, Any]) -> None:
    """Raises ValueError for a kind of output that there is not, FileNotFoundError for a template."""
    if options["writes"]:
        from icsolve.grade.platforms.write import check_kind

        for kind in _pairs(options["writes"]):
            check_kind(kind)
    if options["template"] and not os.path.exists(options["template"]):
        raise FileNotFoundError(2, "No such file or directory", options["template"])


def _course(options: dict[str, Any]) -> Course:
    """The course file, with what the command line says over it."""
    said = {key: options[key] for key in ("attempt", "decimal")}
    course = course_of(options["course"], options["cases"], options["quiet"], said)
    return course._replace(columns=(*course.columns, *_pairs(options["mapping"]).items()))


def course_of(path: str | None, cases: str, quiet: bool, said: Mapping[str, str | None]) -> Course:
    """The course of a file, by default the one beside the cases; what is ``said`` goes over it.

    Raises CaseError where it can't be read.
    """
    from icsolve.grade.course import Course, read_course

    beside = course_file(cases)
    course = Course()
    if path or beside:
        course = read_course(path or beside)
        if not path and not quiet:
            complain(f"using {beside}")
    fields: dict[str, Any] = {key: value for key, value in said.items() if value is not None}
    return course._replace(**fields)


def course_file(cases: str) -> str:
    """The course beside the cases; '' for none."""
    beside = os.path.join(cases if os.path.isdir(cases) else os.path.dirname(cases), COURSE)
    return beside if os.path.isfile(beside) else ""


def _pairs(texts: tuple[str, ...]) -> dict[str, str]:
    """``A=B`` texts; the last ``=`` divides where the first would leave one side empty."""
    pairs = {}
    for text in texts:
        left, equals, right = text.partition("=")
        if not (left.strip() and equals and right.strip()):
            raise ValueError(f"{text!r} is not of the form NAME=VALUE")
        pairs[left.strip()] = right.strip()
    return pairs


def _graded(job: Job, options: dict[str, Any]) -> int:
    from icsolve.grade.run import grade

    changed = ""
    with ExitStack() as stack:
        quiet, force = options["quiet"], options["force"]
        stack.enter_context(together())
        csv, results = stack.enter_context(_results(options, force))
        jsonl = None
        if options["jsonl"]:
            stack.enter_context(folder_of(options["jsonl"]))
            jsonl = stack.enter_context(whole_file(options["jsonl"], force))
        with progress(quiet) as told:
            graded = grade(job, csv, jsonl, told)
        for note in graded.notes:
            complain(str(note))
        if csv is not None:
            csv.flush()
            changed = _regraded(results, options)
            _further(graded, results, options)
            if options["html"] or options["students"]:
                _pages(graded, job.course.title, results, options)
    if not quiet:
        from icsolve.grade.summary import summary

        click.echo("\n\n".join(filter(None, (summary(graded), changed))), err=options["output"] == "-")
    return NO_ANSWER if graded.serious else DONE


@contextmanager
def _results(options: dict[str, Any], force: bool) -> Iterator[tuple[IO[str] | None, str]]:
    """Where the results go, and the file in which other outputs find them."""
    output = options["output"]
    again = any(options[name] for name in ("writes", "against", "review", "html", "students"))
    with ExitStack() as stack:
        target: IO[str] | None = sys.stdout if output == "-" else None
        if output not in (None, "-"):
            stack.enter_context(folder_of(output))
            target = stack.enter_context(whole_file(output, force))
        if not again:
            yield target, ""
            return
        path = os.path.join(stack.enter_context(scratch()), "results.csv")
        with filling(path), open(path, "w", encoding="utf-8", newline="") as file:
            yield file, path
        if target is not None:
            with open(path, encoding="utf-8", newline="") as file:
                copyfileobj(file, target)


def _further(graded: Graded, results: str, options: dict[str, Any]) -> None:
    """The files for platforms, made from the results."""
    if not options["writes"]:
        return
    from icsolve.grade.platforms.write import PlatformFile, write

    template, total = options["template"] or "", options["total"] or ""
    for kind, path in _pairs(options["writes"]).items():
        file = PlatformFile(results, path, graded.people, template, options["force"], total)
        told = write(kind, file)
        if told and not options["quiet"]:
            complain(told)


def _regraded(results: str, options: dict[str, Any]) -> str:
    """The queue for a person, and the changes against earlier results: in a file, and as text."""
    from icsolve.grade.results import changes_csv, changes_text, compared, review_queue

    if options["review"]:
        write_whole(options["review"], review_queue(results), options["force"])
    if not options["against"]:
        return ""
    changes = list(compared(options["against"], results))
    if options["changes"]:
        write_whole(options["changes"], changes_csv(changes), options["force"])
    return changes_text(changes, options["against"])


def _pages(graded: Graded, title: str, results: str, options: dict[str, Any]) -> None:
    """The page for the teacher, and one for each student."""
    from icsolve.grade.results import by_student
    from icsolve.grade.summary import page, statistics, student_page
    from icsolve.grade.variants.record import file_name

    if options["html"]:
        found = statistics(results, graded.people)
        write_whole(options["html"], page(graded, title, found), options["force"])
    if options["students"]:
        for student, rows in by_student(results):
            if student:
                path = os.path.join(options["students"], f"{file_name(student)}.html")
                write_whole(path, student_page(student, rows, title), options["force"])
