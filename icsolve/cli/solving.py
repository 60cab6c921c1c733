"""`icsolve solve`."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
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
    options = Options(**asked)
    if options.as_json:
        from icsolve.answer.as_json import SCHEMA

        return for_each(cases, _as_json(options), in_json(SCHEMA), settings, show=_print, jobs=jobs)
    several = len(cases) > 1 or not (cases[0] == "-" or os.path.isfile(cases[0]))
    return for_each(cases, _as_text(options), settings=settings, show=_printer(several), jobs=jobs)


def _solved(case: Case, options: Options) -> tuple[Answer, Report | None]:
    """The answer, and the report where it is asked for, which needs every point of the figure."""
    from icsolve.solve import solve

    case = replace(case, dynamic=case.dynamic or options.dynamic)
    asked = {"all_centres": options.all_centres, "rates": options.rates, "reactions": options.reactions}
    answer, told = solve(case, **asked), None
    if options.stability is not None:
        from icsolve.solve.stability import with_stability

        answer = with_stability(case, answer, options.stability)
    if options.report:
        from icsolve.report.mechanism import report
        from icsolve.scene import examined

        told = report(examined(case, solve))
    return answer, told


def _print(text: str) -> int:
    click.echo(text)
    return DONE


def _as_json(options: Options) -> Work[str]:
    def work(case: Case, path: str) -> str:
        answer, report = _solved(case, options)
        entry = answer.to_dict()
        if report is not None:
            entry["report"] = report.to_dict()
        if options.sensitivity or options.tolerance:
            from icsolve.scene.sensitivity import entries

            entry |= entries(answer, options.sensitivity, options.tolerance)
        return json_text(entry)

    return work


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
        from icsolve.report import answer_text

        answer, report = _solved(case, options)
        sections = [answer_text(answer, options.digits)]
        if report is not None:
            sections.append(report.text(options.digits))
        if options.sensitivity or options.tolerance:
            from icsolve.scene.sensitivity import text

            sections.append(text(answer, options.sensitivity, options.tolerance, options.digits))
        return path, "\n\n".join(sections)

    return work
