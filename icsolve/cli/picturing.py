"""`icsolve draw`, `explain`, `page`: one case laid out as a picture, a solution, a page; `icsolve sheet` and
`gallery`: several as exercises, or with an index of all."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli import BUG
from icsolve.cli.commands import CASE, CASES, DIGITS, FORCE, SET, Verb
from icsolve.cli.run import (
    DONE,
    NO_ANSWER,
    OUTPUT,
    STDIN,
    UNREADABLE,
    InputSource,
    complain,
    for_each,
    on_stderr,
    one_source,
    outcome,
    refusing,
    sources,
    watched,
    write_output,
)
from icsolve.files import KeptError, check_ending, together
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.case import Case
    from icsolve.page.gallery import Exhibit
    from icsolve.report.derivation.known import Known

DRAWN = {".svg": "svg", ".tex": "tex"}
PAGED = {".html": "html", ".htm": "html"}
EXPLAINED = {".txt": "text", ".md": "md", ".markdown": "md", **PAGED, ".tex": "tex"}
SHEETS = {".tex": "tex"}


@click.command("draw", cls=Verb)
@CASE
@OUTPUT
@click.option(
    "--centres",
    type=click.Choice(["needed", "all", "none"]),
    default="needed",
    show_default=True,
    help="Which instant centres, with the lines that find them.",
)
@click.option("--step", type=click.IntRange(0), metavar="K", help="The construction after K centres found.")
@click.option("--circle", is_flag=True, help="The Kennedy circle diagram beside the figure.")
@click.option("--velocities", is_flag=True, help="The velocities of the points.")
@click.option("--bodies", is_flag=True, help="The free-body diagrams of all links.")
@SET
def draw_command(case: str, output: str | None, settings: dict[str, str], **asked: Any) -> int:
    """Draw a case: the mechanism, its loads with the answer, its instant centres.

    \b
    icsolve draw press.yaml -o press.svg
    icsolve draw press.yaml --centres all --circle -o centres.svg
    icsolve draw press.yaml --step 1 -o step1.svg
    icsolve draw press.yaml -o press.tex

    The ending of the file says what is written: .svg, or .tex (TikZ for LaTeX). A case without an answer is
    drawn as far as it is known, with the reason below; exit status 1.
    """

    def made(known: Known, form: str) -> str:
        from icsolve.draw import Drawing, draw

        return draw(known.case, Drawing(**asked), known, form)

    return laid_out("draw", DRAWN, case, output, settings, made, reactions=asked["bodies"])


@click.command("explain", cls=Verb)
@CASE
@OUTPUT
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "md", "html", "tex"]),
    help="text, md (Markdown with LaTeX formulas), html or tex; by the ending of -o, else text.",
)
@click.option("--bodies", is_flag=True, help="The equations of equilibrium of every link, and the reactions.")
@SET
@DIGITS
def explain_command(
    case: str, output: str | None, form: str | None, bodies: bool, settings: dict[str, str], digits: int
) -> int:
    """Print the worked solution of a case, in the textbook's order and words.

    \b
    icsolve explain press.yaml
    icsolve explain press.yaml -o press.html
    icsolve explain press.yaml -o press.tex
    icsolve explain press.yaml --format md --bodies --digits 4

    A case without an answer is explained as far as it goes, with the reason; exit status 1.
    """

    def made(known: Known, form: str) -> bytes:
        from icsolve.explain import explain

        text = explain(known.case, form, digits, bodies=bodies, known=known)
        return text.encode("utf-8", "backslashreplace")

    return laid_out("explain", EXPLAINED, case, output, settings, made, form)


@click.command("page", cls=Verb)
@CASE
@OUTPUT
@SET
def page_command(case: str, output: str | None, settings: dict[str, str]) -> int:
    """Make a page of a case that moves: one HTML file that needs no network.

    \b
    icsolve page press.yaml -o press.html

    A slider turns the input through its whole range; buttons go through the construction a centre at a time;
    the power equation, the answer and its curve follow. Every number can be changed in the page, and points
    can be pulled. A case that cannot move is shown as it stands, with
    the reason; one without an answer too, with exit status 1.
    """

    def made(known: Known, _form: str) -> str:
        from icsolve.page import page_html

        return page_html(known)

    return laid_out("page", PAGED, case, output, settings, made)


@click.command("sheet", cls=Verb)
@CASES
@OUTPUT
@click.option("--variants", metavar="FILE", help="values.csv of `icsolve variants`: a sheet a student.")
@click.option("--student", metavar="ID", help="The sheet of this student alone.")
@click.option("--title", metavar="TEXT", default="Exercises", show_default=True, help="The heading.")
def sheet_command(
    cases: tuple[str, ...], output: str | None, variants: str | None, student: str | None, title: str
) -> int:
    """Write an exercise sheet for LaTeX: figures and questions, and the key behind them.

    \b
    icsolve sheet cases/linkages -o exam.tex
    icsolve sheet press.yaml --variants sheets/press/values.csv --student 1234 -o exam.tex

    A case without an answer is asked as it is, and the key says why; exit status 1.
    """
    if form_of("sheet", cases[0], output, SHEETS) is None:
        return UNREADABLE
    try:
        students = _students(variants, student)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) else error
        complain(f"icsolve sheet: {variants or '--student'}: {why or error}")
        return UNREADABLE
    from icsolve.explain.given import Exercise, exercise, sheet_tex

    sheets: list[tuple[str, list[Exercise]]] = []
    worst = DONE
    for who, values in students:
        found: list[Exercise] = []

        def work(case: Case, path: str, given: Values = values, to: list[Exercise] = found) -> int:
            from icsolve.read import load
            from icsolve.report.derivation.known import known_of

            own = {f"variables.{v.name}": given[v.name] for v in case.variables if v.name in given}
            known = known_of(load(path, own) if own else case)
            to.append(exercise(known))
            if known.refusal is not None:
                on_stderr(case, path, known.refusal)
            return DONE if known.refusal is None else NO_ANSWER

        worst = max(worst, for_each(cases, work))
        sheets.append((who, found))
    if not any(some for _, some in sheets):
        return max(worst, UNREADABLE)
    return max(worst, write_output("sheet", sheet_tex(title, sheets), output))


Values = Mapping[str, str]
"""A student's numbers by variable."""


def _students(variants: str | None, student: str | None) -> list[tuple[str, Values]]:
    """Students with their numbers by variable; one without a name where no numbers are given."""
    if variants is None:
        if student is not None:
            raise ValueError("it needs --variants, the numbers that students have")
        return [("", {})]
    from icsolve.grade.tables.columns import identifier, read_whole_table, without_apostrophe

    columns, rows = read_whole_table(variants)
    at = columns.field("student_id")
    if not rows or at is None:
        raise ValueError("it has no column student_id, or no student; `icsolve variants` writes values.csv")
    named = [(identifier(cells[at]), map(without_apostrophe, cells)) for cells in rows]
    chosen: list[tuple[str, Values]] = [
        (name, dict(zip(columns.header, own, strict=True))) for name, own in named
    ]
    if student is not None and not (chosen := [one for one in chosen if one[0] == student]):
        raise ValueError(f"there is no student {student}")
    return chosen


def form_of(verb: str, case: str, output: str | None, endings: Mapping[str, str]) -> str | None:
    """What a file's ending asks for; the first of the forms without one, None where it is not known (the case
    itself is refused when it comes to writing)."""
    ending = os.path.splitext(output or "")[1].lower()
    itself = output is not None and os.path.exists(output) and os.path.exists(case)
    try:
        if not (itself and os.path.samefile(output or "", case)):
            check_ending(output or "", endings, verb)
    except KeptError as error:
        complain(f"icsolve {verb}: {error}")
        return None
    return endings.get(ending, next(iter(endings.values())))


def laid_out(
    verb: str,
    endings: Mapping[str, str],
    argument: str,
    output: str | None,
    settings: Mapping[str, str],
    made: Callable[[Known, str], str | bytes],
    asked: str | None = None,
    *,
    reactions: bool = True,
) -> int:
    """Write what is made of one case that was solved as far as it goes, in the form that is ``asked`` or that
    the ending of the file means; returns the exit status."""
    form = asked or form_of(verb, argument, output, endings)
    if form is None or not one_source(verb, argument):
        return UNREADABLE

    def work(case: Case, path: str) -> int:
        from icsolve.report.derivation.known import known_of

        known = known_of(case, reactions=reactions)
        code = write_output(verb, made(known, form), output)
        if known.refusal is not None:
            on_stderr(case, path, known.refusal)
            return max(code, NO_ANSWER)
        return code

    return for_each([argument], work, settings=settings)


# --- galleries ------------------------------------------------------------------------------------------


INDEX = "index"


class Item(NamedTuple):
    """A file to show, and the name of its files in the gallery."""

    source: InputSource
    name: str


@click.command("gallery", cls=Verb)
@CASES
@click.option("-o", "--output", metavar="DIR", required=True, help="The folder to write into.")
@click.option("--exercises", is_flag=True, help="Cards and figures without answers, and no pages.")
@click.option("--title", metavar="TEXT", help="The heading of the index.")
@FORCE
def gallery_command(
    cases: tuple[str, ...], output: str, exercises: bool, title: str | None, force: bool
) -> int:
    """Write an index page with the figure, the answer and the page of every case.

    \b
    icsolve gallery cases/ -o gallery
    icsolve gallery press.yaml pump.yaml -o gallery --title "Week 3"

    Where a file of that name is there already nothing is written, unless --force allows it. A case without
    an answer is shown with the reason, a file that can't be read is listed; exit status as of `solve`.
    """
    items = list(_items(cases))
    if not items:
        complain(f"icsolve gallery: there is no case in {' '.join(cases)}")
        return UNREADABLE
    taken = [] if force else _taken(items, output)
    if taken:
        more = f" (and {len(taken) - 1} more)" if len(taken) > 1 else ""
        complain(f"icsolve gallery: {taken[0]}{more} is there already; --force writes over what is there")
        return UNREADABLE

    def write() -> int:
        with together():
            return _write(items, output, title or _title(cases), exercises)

    return refusing("gallery", write)


def _items(arguments: Iterable[str]) -> Iterator[Item]:
    """The files, each with a name of its own; names in a folder keep the folders below it."""
    used = {INDEX}
    for argument in arguments:
        for source in sources(argument):
            if source.folder is not None and not source.may_be_a_case():
                continue
            stem = _stem(source)
            name, n = stem, 2
            while name.casefold() in used:
                name, n = f"{stem}-{n}", n + 1
            used.add(name.casefold())
            yield Item(source, name)


def _title(arguments: Iterable[str]) -> str:
    """What the gallery is called: the folders or files that it was made of."""
    names = [os.path.basename(os.path.abspath(argument)) for argument in arguments]
    return f"Gallery of {', '.join(names)}" if len(names) <= 3 else "Gallery"


def _stem(source: InputSource) -> str:
    """What the files of a case are called: its own name, below the folder that was named."""
    if source.path == STDIN:
        return "stdin"
    path = os.path.relpath(source.path, source.folder) if source.folder else os.path.basename(source.path)
    return os.path.splitext(path)[0].replace(os.sep, "/")


def _taken(items: Iterable[Item], output: str) -> list[str]:
    """Files that are there already."""
    from icsolve.page.gallery import ENDINGS

    names = [f"{INDEX}.html", *(item.name + ending for item in items for ending in ENDINGS)]
    paths = [os.path.join(output, *name.split("/")) for name in names]
    return [path for path in paths if os.path.lexists(path)]


def _write(items: list[Item], output: str, title: str, exercises: bool) -> int:
    """Show each case and write its files, then the index; returns the exit status."""
    from icsolve.page.gallery import index_html

    exhibits: list[Exhibit] = []
    worst = DONE
    for item in watched(items, len(items), "gallery"):
        one, code = _shown(item, exercises)
        if one is None:
            continue
        for ending, text in one.files.items():
            _put(output, item.name + ending, text)
        worst = max(worst, code)
        exhibits.append(one._replace(files={}))
    _put(output, f"{INDEX}.html", index_html(exhibits, title))
    return worst


def _shown(item: Item, exercises: bool) -> tuple[Exhibit | None, int]:
    """A file as it is shown, and the exit status that it calls for; None for a file of a folder that is no
    case."""
    from icsolve.page.gallery import exhibit, unreadable

    path = item.source.path
    kind, what = outcome(item.source, lambda case, at: exhibit(case, item.name, at, exercise=exercises))
    if kind == "failed":
        raise what
    if kind == "passed":
        return None, DONE
    if kind == "said":
        told, code = what
        complain(told)
        shown = told if code != BUG else told.removeprefix(f"{path}: ").partition("\n")[0]
        return unreadable(item.name, path, shown), code
    if kind == "refused":
        _, _, error = what
        complain(f"{path}: {error.status}: {error.message}")
        return unreadable(item.name, path, error.message), NO_ANSWER
    if what.reason:
        complain(f"{path}: {what.status}: {what.reason}")
    return what, NO_ANSWER if what.reason else DONE


def _put(output: str, name: str, text: str) -> None:
    """Write a file of the gallery. Raises Exit where that can't be done, as is then said."""
    if write_output("gallery", text, os.path.join(output, *name.split("/")), folders=True) != DONE:
        raise click.exceptions.Exit(UNREADABLE)
