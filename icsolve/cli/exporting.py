"""`icsolve export`: cases as questions of a learning platform."""

from __future__ import annotations

from typing import Any

import click

from icsolve.cli.options import Verb
from icsolve.cli.run import DONE, NO_ANSWER, complain, refusing


@click.command("export", cls=Verb)
@click.argument("kind", type=click.Choice(["moodle-xml", "gift", "qti", "prairielearn", "gradescope-zip"]))
@click.argument("cases", metavar="CASES")
@click.option("-o", "--output", metavar="FILE", required=True, help="The file; for prairielearn a folder.")
@click.option(
    "--course", metavar="FILE", help="Tolerances and marks [default: course.yaml beside the cases]."
)
@click.option("--roster", metavar="FILE", help="For gradescope-zip: by which students get their variants.")
@click.option("--seed", metavar="TEXT", help="Seed of the variants.")
@click.option("--variants", metavar="FILE", multiple=True, help="For gradescope-zip: values.csv, the record.")
@click.option(
    "--count", type=click.IntRange(1, 1000), default=10, show_default=True, help="Variants of a case."
)
@click.option("--figures/--no-figures", default=True, help="The figure of each question, without its answer.")
@click.option("--force", is_flag=True, help="Write over files that are there.")
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
    from icsolve.cli.varying import existing
    from icsolve.files import check_free
    from icsolve.grade.case_store import CaseStore
    from icsolve.grade.platforms.export import ExportOrder, export

    problems: list[str] = []
    course = course_of(options["course"], cases, False, {"seed": options["seed"]})
    case_store = CaseStore(existing(cases), course)
    case_store.check_course()
    if kind != "prairielearn":
        check_free(output, options["force"])
    own = options["course"] or course_file(cases)
    drawn = (options["force"], options["figures"], options["count"])
    order = ExportOrder(case_store, output, *drawn, own, options["roster"] or "")
    made = export(kind, order._replace(records=tuple(options["variants"])), problems.append)
    for problem in problems:
        complain(problem)
    what = "case" if kind == "gradescope-zip" else "question"
    complain(f"wrote {output}: {made} {what}{'' if made == 1 else 's'}")
    return NO_ANSWER if problems else DONE
