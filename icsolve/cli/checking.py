"""`icsolve check`, `icsolve validate` and `icsolve ways`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from icsolve.assembly import LEFT_OUT
from icsolve.cli.commands import CASES, DIGITS, JOBS, JSON, SET, Verb
from icsolve.cli.run import DONE, NO_ANSWER, complain, for_each, in_json, json_text, on_stderr, print_json
from icsolve.report.check import (
    AGREES,
    DISAGREES,
    ERRATUM,
    HEADER,
    NOT_EXAMINED,
    Row,
    compare,
    row_without_answer,
    table_row,
    wanted,
)
from icsolve.wording import plural

if TYPE_CHECKING:
    from icsolve.assembly.ways import Place, Ways
    from icsolve.case import Case
    from icsolve.errors import SceneError


@click.command("check", cls=Verb)
@CASES
@JSON
@click.option("--table", "as_table", is_flag=True, help="A Markdown table, a row a case.")
@SET
@JOBS
def check_command(
    cases: tuple[str, ...], as_json: bool, as_table: bool, settings: dict[str, str], jobs: int | None
) -> int:
    """Solve cases and compare with the values under `expect`, a line a value.

    \b
    icsolve check cases/

    Exit status: 1 where a value disagrees or a case has no answer; an erratum must not agree.
    """
    shown: Shown = _json if as_json else _table_row if as_table else _lines
    tally: Counter[str] = Counter()
    if as_table and not as_json:
        click.echo(HEADER)

    def work(case: Case, path: str) -> tuple[str, list[str], list[str]]:
        rows, left_out = _rows(case)
        aside = [f"{path}: {note}" for note in left_out] if shown is _table_row else []
        return shown(case, path, rows, left_out), [row.verdict for row in rows], aside

    def show(found: tuple[str, list[str], list[str]]) -> int:
        text, verdicts, aside = found
        tally.update((CASE_SEEN, *verdicts))
        click.echo(text)
        for line in aside:
            complain(line)
        return NO_ANSWER if DISAGREES in verdicts else DONE

    tell = in_json(CHECK, values=[]) if as_json else on_stderr

    def refuse(case: Case, path: str, error: SceneError) -> None:
        tally.update((CASE_SEEN, UNANSWERED))
        if shown is _table_row:
            click.echo(row_without_answer(case, error.status))
        tell(case, path, error)

    code = for_each(cases, work, refuse, settings, show=show, jobs=jobs)
    if tally:  # nothing is summed up of files that can't be read
        complain(_summary(tally))
    return code


@click.command("validate", cls=Verb)
@CASES
@SET
def validate_command(cases: tuple[str, ...], settings: dict[str, str]) -> int:
    """Read cases and examine everything in them, also what the answer does not need."""
    return for_each(cases, _validate, settings=settings)


CHECK = "icsolve/check/1"
CASE_SEEN, UNANSWERED = "case", "without an answer"
"""What is counted beside verdicts."""
Shown = Callable[["Case", str, list[Row], list[str]], str]


def _rows(case: Case) -> tuple[list[Row], list[str]]:
    """The values beside what is published, and notes on what none of them needs and can't be placed.

    Raises SceneError also where a published value is of what can't be placed.
    """
    from icsolve.scene import examined
    from icsolve.solve import solve

    answer = examined(case, solve, **wanted(case))
    rows, left_out = compare(answer), [note for note in answer.notes if note.startswith(LEFT_OUT)]
    if left_out and not all(row.found for row in rows):
        rows = compare(solve(case, **wanted(case), examine=True))
    return rows, left_out


def _json(case: Case, path: str, rows: list[Row], left_out: list[str]) -> str:
    told: dict[str, Any] = {"values": [row._asdict() for row in rows]}
    if left_out:
        told["notes"] = left_out
    return json_text({"schema": CHECK, "case": case.name, "status": "ok", **told})


def _table_row(case: Case, path: str, rows: list[Row], left_out: list[str]) -> str:
    return table_row(case, rows)


def _lines(case: Case, path: str, rows: list[Row], left_out: list[str]) -> str:
    lines = [f"{path}: {_line(row)}" for row in rows] or [f"{path}: solved; no published value to compare"]
    return "\n".join((*lines, *(f"{path}: {note}" for note in left_out)))


def _line(row: Row) -> str:
    verdict = {ERRATUM: "is an erratum"}.get(row.verdict, row.verdict)
    found = f", found {row.found}" if row.found else ""
    why = f" ({row.text})" if row.text else ""
    return f"{row.key} {verdict}: published {row.published}{found}{why}"


def _summary(tally: Counter[str]) -> str:
    words = {AGREES: "agree", DISAGREES: "disagree", ERRATUM: "errata"}
    verdicts = (*words, NOT_EXAMINED, UNANSWERED)
    counts = [f"{tally[verdict]} {words.get(verdict, verdict)}" for verdict in verdicts if tally[verdict]]
    return f"{plural(tally[CASE_SEEN], 'case')}: {', '.join(counts) or 'no values'}"


def _validate(case: Case, path: str) -> int:
    from icsolve.solve import solve

    answer = solve(case, examine=True)
    mobility = "" if answer.mobility is None else f", mobility {answer.mobility}"
    joints = len(case.joints if case.space is None else case.space.joints)
    joints += len(case.touches)
    count = f"{plural(len(case.links), 'link')}, {plural(joints, 'joint')}"
    click.echo(f"{path}: valid: {count}{mobility}")
    for sentence in (*answer.notes, *answer.skipped):
        click.echo(f"  {sentence}")
    return DONE


# --- ways to assemble -----------------------------------------------------------------------------------


@click.command("ways", cls=Verb)
@CASES
@JSON
@SET
@DIGITS
def ways_command(cases: tuple[str, ...], as_json: bool, settings: dict[str, str], digits: int) -> int:
    """List every way in which the figure assembles, and the `near` that picks each; loads are not needed.

    \b
    icsolve ways press.yaml
    icsolve ways press.yaml --json

    Exit status: 0 there is a way, 1 there is none, 2 a file can't be read; of several the largest.
    """

    def work(case: Case, path: str) -> int:
        from icsolve.assembly.ways import ways_of

        found = ways_of(case)
        if as_json:
            print_json(_entry(case, found))
        else:
            click.echo(_text(case, found, digits))
        return DONE

    return for_each(cases, work, in_json(WAYS, ways=[]) if as_json else on_stderr, settings)


WAYS = "icsolve/ways/1"


def _entry(case: Case, found: Ways) -> dict[str, Any]:
    return {
        "schema": WAYS,
        "case": case.name,
        "status": "ok",
        "ways": [
            {
                "points": {p: list(at) for p, at in way.points.items()},
                "near": {p: list(at) for p, at in way.near.items()},
            }
            for way in found.ways
        ],
        "complete": found.complete,
        "notes": list(found.notes),
    }


def _text(case: Case, found: Ways, digits: int) -> str:
    count = len(found.ways)
    what = "one way" if count == 1 else f"{count} ways"
    lines = [f"{case.title or case.name}: {what} of assembling{', all there are' if found.complete else ''}"]
    for number, way in enumerate(found.ways, 1):
        near = ", ".join(f"{p}: [{at[0]:.12g}, {at[1]:.12g}]" for p, at in way.near.items())
        lines.append("")
        lines.append(f"{number}  near: {{{near}}}" if near else f"{number}  (no near needed)")
        width = max(map(len, way.points), default=0)
        lines += [f"   {p:<{width}}  {_pair(at, digits)}" for p, at in way.points.items()]
    return "\n".join([*lines, *(f"\nnote: {note}" for note in found.notes)])


def _pair(at: Place, digits: int) -> str:
    return f"({at[0]:.{digits}g}, {at[1]:.{digits}g})"
