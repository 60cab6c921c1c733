"""`icsolve page`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from icsolve.cli.options import SET
from icsolve.cli.output import OUTPUT, one_source, write_output
from icsolve.cli.run import NO_ANSWER, UNREADABLE, for_each, on_stderr

if TYPE_CHECKING:
    from icsolve.case import Case


@click.command("page")
@click.argument("case", metavar="CASE")
@OUTPUT
@SET
def page_command(case: str, output: str | None, settings: dict[str, str]) -> int:
    """Make a page of a case that moves: one HTML file that needs no network.

    \b
    icsolve page press.yaml -o press.html

    A slider turns the input through its whole range; buttons go through the construction a centre at a time;
    the power equation, the answer and its curve follow. A case that cannot move is shown as it stands, with
    the reason; one without an answer too, with exit status 1.
    """
    return page_case(case, output, settings)


def page_case(argument: str, output: str | None, settings: Mapping[str, str]) -> int:
    """Make the page of one case; returns the exit status."""
    if not one_source("page", argument):
        return UNREADABLE

    def work(case: Case, path: str) -> int:
        from icsolve.derivation import known_of
        from icsolve.page import page_html

        known = known_of(case, reactions=True)
        code = write_output("page", page_html(known), output, [argument])
        if known.refusal is not None:
            on_stderr(case, path, known.refusal)
            return max(code, NO_ANSWER)
        return code

    return for_each([argument], work, settings=settings)
