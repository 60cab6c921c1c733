"""The command `icsolve` and its verbs, each a click command in a room that is imported on use; arguments and
options that several share."""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from typing import Any

import click

from icsolve import __version__


def showing(show: Callable[[click.Context], str], names: list[str], text: str) -> click.Option:
    """An option that shows something and ends. Its text is plain: to look for a translation, as click's own
    ones do, costs as much as to read a case."""

    def shown(context: click.Context, _option: click.Parameter, asked: bool) -> None:
        if asked and not context.resilient_parsing:
            click.echo(show(context))
            context.exit()

    return click.Option(names, is_flag=True, expose_value=False, is_eager=True, callback=shown, help=text)


class Verb(click.Command):
    """A command with such an option for its help."""

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self.helping = showing(click.Context.get_help, ["-h", "--help"], "Show this message and exit.")

    def get_help_option(self, ctx: click.Context) -> click.Option:
        """The option itself."""
        return self.helping


CASE = click.argument("case", metavar="CASE")
CASES = click.argument("cases", metavar="CASE...", nargs=-1, required=True)
SET = click.option(
    "--set",
    "settings",
    metavar="PATH=VALUE",
    multiple=True,
    callback=lambda _context, _option, pairs: parse_settings(pairs),
    help="Change a number of the case before it is solved, e.g. --set angles.AB=30. Repeatable.",
)
JSON = click.option("--json", "as_json", is_flag=True, help="One JSON object a file, one a line.")
DIGITS = click.option(
    "--digits", type=click.IntRange(1, 17), default=6, show_default=True, help="Significant digits in text."
)
JOBS = click.option(
    "--jobs",
    type=click.IntRange(1, 256),
    help="Processes [default: one; for 64 files or more as many as there are cores].",
)

FORCE = click.option("--force", is_flag=True, help="Write over files that are there.")


def parse_settings(pairs: tuple[str, ...]) -> dict[str, str]:
    """``PATH=VALUE`` words by path."""
    settings: dict[str, str] = {}
    for pair in pairs:
        path, equals, value = pair.partition("=")
        if not (path.strip() and equals and value.strip()):
            raise click.BadParameter(f"{pair!r} is not PATH=VALUE, e.g. angles.AB=30")
        if settings.setdefault(path.strip(), value.strip()) != value.strip():
            raise click.BadParameter(
                f"{path.strip()} is set twice, to {settings[path.strip()]} and {value.strip()}"
            )
    return settings


VERBS = {
    "solve": "solving",
    "check": "checking",
    "validate": "checking",
    "ways": "checking",
    "new": "starting",
    "schema": "starting",
    "manual": "starting",
    "grade": "grading",
    "variants": "varying",
    "export": "varying",
    "explain": "picturing",
    "draw": "picturing",
    "gallery": "picturing",
    "page": "picturing",
    "sheet": "picturing",
    "sweep": "sweeping",
    "bench": "benching",
}
"""Each verb, and the room beside this one that has its click command (``solve_command``)."""


class Verbs(Verb, click.Group):
    """`icsolve case.yaml` means `icsolve solve case.yaml`."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The verbs in the order of the help."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a verb, from its room."""
        if cmd_name not in VERBS:
            return None
        command: click.Command = getattr(
            import_module(f"icsolve.cli.{VERBS[cmd_name]}"), f"{cmd_name}_command"
        )
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click does; of a word that is no command it is said what is meant."""
        word = args[0]
        if word not in VERBS and not ctx.resilient_parsing:
            files = [f"{word}{ending}" for ending in (".yaml", ".yml") if os.path.exists(f"{word}{ending}")]
            if files:
                ctx.fail(f"there is no command '{word}'; to solve the file write `icsolve {files[0]}`")
            from icsolve.manual import nearest

            hint = nearest(word, list(VERBS))
            ctx.fail(f"there is no command or file '{word}'; {hint}`icsolve -h` lists the commands")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The verbs with the whole first sentence of each."""
        commands = [(name, self.get_command(ctx, name)) for name in VERBS]
        with formatter.section("Commands"):
            formatter.write_dl([(name, c.get_short_help_str(limit=200)) for name, c in commands if c])

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Put in `solve` where the first word is an option of it or looks like a file."""
        first = args[0] if args else ""
        own = {*VERBS, "-h", "--help", "--version"}
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


VERSION = showing(lambda _: f"icsolve {__version__}", ["--version"], "Show the version and exit.")
icsolve.params.append(VERSION)
