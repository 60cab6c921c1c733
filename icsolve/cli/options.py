"""Arguments and options that several commands share."""

from __future__ import annotations

import click

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
        settings[path.strip()] = value.strip()
    return settings
