"""The command `icsolve` and its verbs; each verb is a click command in a room that is imported on use."""

from __future__ import annotations

import os
from importlib import import_module

import click

from icsolve import __version__
from icsolve.cli.options import Verb, showing

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
