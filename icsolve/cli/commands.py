"""The commands of icsolve: thin, each hands its work to a room and prints what comes back."""

from __future__ import annotations

import os
from collections.abc import Callable

import click

from icsolve import __version__

CASES = click.argument("cases", metavar="CASE...", nargs=-1, required=True)
SET = click.option(
    "--set",
    "settings",
    metavar="PATH=VALUE",
    multiple=True,
    help="Change a number of the case before it is solved, e.g. --set angles.AB=30. Repeatable.",
)
JSON = click.option("--json", "as_json", is_flag=True, help="One JSON object a file, one a line.")
DIGITS = click.option(
    "--digits", type=click.IntRange(1, 17), default=6, show_default=True, help="Significant digits in text."
)

Command = Callable[..., int]


class Verbs(click.Group):
    """`icsolve case.yaml` means `icsolve solve case.yaml`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Put in `solve` where the first word is an option of it or looks like a file."""
        first = args[0] if args else ""
        own = {*self.commands, "-h", "--help", "--version"}
        if first not in own and (
            first.startswith("-") or set("./\\*?[") & set(first) or os.path.exists(first)
        ):
            args = ["solve", *args]
        return super().parse_args(ctx, args)


@click.group(
    cls=Verbs,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, message="%(prog)s %(version)s")
@click.pass_context
def icsolve(ctx: click.Context) -> int:
    """Find the force or torque that holds a planar mechanism in equilibrium, from a YAML case.

    \b
    icsolve press.yaml                   the unknown, its unit and its sense
    icsolve new four-bar -o press.yaml   a commented case to start from
    """
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
    return 0


@icsolve.command()
@CASES
@JSON
@click.option("--all-centres", is_flag=True, help="All n(n-1)/2 instant centres, not only those needed.")
@click.option("--rates", is_flag=True, help="Angular velocities of the links and velocities of the points.")
@click.option("--reactions", is_flag=True, help="The force of each link on each other at every joint.")
@click.option("--report", is_flag=True, help="Mobility, Grashof kind, transmission angles, limit positions.")
@SET
@DIGITS
def solve(
    cases: tuple[str, ...],
    as_json: bool,
    all_centres: bool,
    rates: bool,
    reactions: bool,
    report: bool,
    settings: tuple[str, ...],
    digits: int,
) -> int:
    """Solve cases: files, folders, globs, or - for standard input.

    \b
    icsolve solve press.yaml
    icsolve solve cases/ --json > answers.jsonl
    icsolve solve press.yaml --set angles.AB=30 --all-centres

    Exit status: 0 solved, 1 a case has no answer, 2 a file can't be read; of several the largest.
    """
    from icsolve.cli.solving import Options, solve_cases

    options = Options(as_json, all_centres, rates, reactions, report, digits)
    return solve_cases(cases, options, _settings(settings))


@icsolve.command()
@CASES
@JSON
@SET
def check(cases: tuple[str, ...], as_json: bool, settings: tuple[str, ...]) -> int:
    """Solve cases and compare with the values under `expect`, a line a value.

    \b
    icsolve check cases/

    Exit status: 1 where a value disagrees or a case has no answer; an erratum must not agree.
    """
    from icsolve.cli.checking import check_cases

    return check_cases(cases, as_json, _settings(settings))


@icsolve.command()
@CASES
@SET
def validate(cases: tuple[str, ...], settings: tuple[str, ...]) -> int:
    """Read cases and examine everything in them, also what the answer does not need."""
    from icsolve.cli.checking import validate_cases

    return validate_cases(cases, _settings(settings))


@icsolve.command()
@click.argument("kind", required=False)
@click.option("-o", "--output", metavar="FILE", help="Write here instead of standard output.")
def new(kind: str | None, output: str | None) -> int:
    """Print a commented case of a KIND of mechanism; without KIND, list the kinds.

    \b
    icsolve new
    icsolve new slider-crank -o pump.yaml
    """
    from icsolve.cli.starting import list_kinds, write_template

    return list_kinds() if kind is None else write_template(kind, output)


@icsolve.command()
def schema() -> int:
    """Print the JSON Schema (draft-07) of a case, for editors."""
    import json

    from icsolve.schema import schema as case_schema

    click.echo(json.dumps(case_schema(), indent=2))
    return 0


def _settings(pairs: tuple[str, ...]) -> dict[str, str]:
    """``PATH=VALUE`` words by path."""
    settings: dict[str, str] = {}
    for pair in pairs:
        path, equals, value = pair.partition("=")
        if not (path.strip() and equals and value.strip()):
            raise click.BadParameter(f"{pair!r} is not PATH=VALUE, e.g. angles.AB=30", param_hint="--set")
        settings[path.strip()] = value.strip()
    return settings
