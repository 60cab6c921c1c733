"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click


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
