"""`icsolve solve`."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.commands import CASES, DIGITS, JOBS, JSON, SET, Verb
from icsolve.cli.run import DONE, Work, for_each, in_json, json_text
from icsolve.tuples import NamedTuple, replace

if TYPE_CHECKING:
    from icsolve.answer import Answer
    from icsolve.case import Case
    from icsolve.report.mechanism import Report


class LengthOption(click.FloatRange):
    """A finite number above zero: neither nan nor inf is the width of a pencil line."""

    def __init__(self) -> None:
        super().__init__(min=0.0, min_open=True)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number."""
        number = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{value!r} is not a finite number.", param, ctx)
        return number


class Options(NamedTuple):
    """What `icsolve solve` was asked for beside the unknowns."""

    as_json: bool
    all_centres: bool
    rates: bool
    reactions: bool
    dynamic: bool
    report: bool
    sensitivity: bool
    stability: str | None
    tolerance: float | None
    digits: int


@click.command("solve", cls=Verb)
@CASES
@JSON
@click.option("--all-centres", is_flag=True, help="All n(n-1)/2 instant centres, not only those needed.")
@click.option("--rates", is_flag=True, help="Angular velocities of the links and velocities of the points.")
@click.option("--reactions", is_flag=True, help="The force of each link on each other at every joint.")
@click.option("--dynamic", is_flag=True, help="With the inertia forces of the motion; accelerations too.")
@click.option("--report", is_flag=True, help="Mobility, Grashof kind, transmission angles, limit positions.")
@click.option(
    "--stability", metavar="PATH", help="Whether it is stable as written, by a datum (angles.AB) or a link."
)
@click.option("--sensitivity", is_flag=True, help="How the answer depends on every number of the case.")
@click.option(
    "--tolerance",
    type=LengthOption(),
    help="The band of the answer where each point of the drawing may be off by this, in case units.",
)
@SET
@DIGITS
@JOBS
def solve_command(cases: tuple[str, ...], settings: dict[str, str], jobs: int | None, **asked: Any) -> int:
    """Solve cases: files, folders, globs, or - for standard input.

    \b
    icsolve solve press.yaml
    icsolve solve cases/ --json > answers.jsonl
    icsolve solve press.yaml --set angles.AB=30 --all-centres

    Exit status: 0 solved, 1 a case has no answer, 2 a file can't be read; of several the largest.
    """
    return solve_cases(cases, Options(**asked), settings, jobs)


def solve_cases(
    cases: tuple[str, ...], options: Options, settings: Mapping[str, str], jobs: int | None
) -> int:
    """Solve and print every case; returns the exit status."""
    if options.as_json:
        from icsolve.answer.as_json import SCHEMA

        work, refuse = _as_json(options), in_json(SCHEMA)
        return for_each(cases, work, refuse, settings, show=_print, jobs=jobs)
    return for_each(cases, _as_text(options), settings=settings, show=_printer(_several(cases)), jobs=jobs)


def _solve(case: Case, options: Options) -> Answer:
    from icsolve.solve import solve

    asked = {"all_centres": options.all_centres, "rates": options.rates, "reactions": options.reactions}
    case = _posed(case, options)
    answer = solve(case, **asked)
    if options.stability is None:
        return answer
    from icsolve.solve.stability import with_stability

    return with_stability(case, answer, options.stability)


def _posed(case: Case, options: Options) -> Case:
    return replace(case, dynamic=case.dynamic or options.dynamic)


def _report(case: Case, options: Options) -> Report:
    """The report; it needs every point of the figure, where the answer needs only its own."""
    from icsolve.report.mechanism import report
    from icsolve.solve import solve

    return report(solve(_posed(case, options), examine=True))


def _print(text: str) -> int:
    click.echo(text)
    return DONE


def _as_json(options: Options) -> Work[str]:
    def work(case: Case, path: str) -> str:
        answer = _solve(case, options)
        entry = answer.to_dict()
        if options.report:
            entry["report"] = _report(case, options).to_dict()
        if options.sensitivity or options.tolerance:
            from icsolve.scene.sensitivity import entries

            entry |= entries(answer, options.sensitivity, options.tolerance)
        return json_text(entry)

    return work


def _several(cases: tuple[str, ...]) -> bool:
    """Whether the arguments may mean more than one file."""
    return len(cases) > 1 or not (cases[0] == "-" or os.path.isfile(cases[0]))


def _printer(several: bool) -> Callable[[tuple[str, str]], int]:
    """Prints answers one below the other, of several files under their paths."""
    shown = 0

    def show(found: tuple[str, str]) -> int:
        nonlocal shown
        path, text = found
        click.echo(("\n" if shown else "") + (f"=== {path}\n" if several else "") + text)
        shown += 1
        return DONE

    return show


def _as_text(options: Options) -> Work[tuple[str, str]]:
    def work(case: Case, path: str) -> tuple[str, str]:
        from icsolve.report.text import answer_text

        answer = _solve(case, options)
        sections = [answer_text(answer, options.digits)]
        if options.report:
            sections.append(_report(case, options).text(options.digits))
        if options.sensitivity or options.tolerance:
            from icsolve.scene.sensitivity import text

            sections.append(text(answer, options.sensitivity, options.tolerance, options.digits))
        return path, "\n\n".join(sections)

    return work
