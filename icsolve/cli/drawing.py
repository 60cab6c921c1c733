"""`icsolve draw`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.options import SET
from icsolve.cli.output import OUTPUT, one_source, write_output
from icsolve.cli.run import NO_ANSWER, UNREADABLE, for_each, on_stderr

if TYPE_CHECKING:
    from icsolve.case import Case


@click.command("draw")
@click.argument("case", metavar="CASE")
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
    """Draw a case as SVG: the mechanism, its loads with the answer, its instant centres.

    \b
    icsolve draw press.yaml -o press.svg
    icsolve draw press.yaml --centres all --circle -o centres.svg
    icsolve draw press.yaml --step 1 -o step1.svg

    A case without an answer is drawn as far as it is known, with the reason below; exit status 1.
    """
    return draw_case(case, output, asked, settings)


def draw_case(
    argument: str, output: str | None, asked: Mapping[str, Any], settings: Mapping[str, str]
) -> int:
    """Draw one case; returns the exit status."""
    if not one_source("draw", argument):
        return UNREADABLE

    def work(case: Case, path: str) -> int:
        from icsolve.derivation import known_of
        from icsolve.draw import Drawing, draw

        drawing = Drawing(**asked)
        known = known_of(case, reactions=drawing.bodies)
        code = write_output("draw", draw(case, drawing, known), output, [argument])
        if known.refusal is not None:
            on_stderr(case, path, known.refusal)
            return max(code, NO_ANSWER)
        return code

    return for_each([argument], work, settings=settings)
