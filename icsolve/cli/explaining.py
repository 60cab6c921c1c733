"""`icsolve explain`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from icsolve.cli.options import DIGITS, SET
from icsolve.cli.output import OUTPUT, one_source, write_output
from icsolve.cli.run import NO_ANSWER, UNREADABLE, for_each, on_stderr

if TYPE_CHECKING:
    from icsolve.case import Case


@click.command("explain")
@click.argument("case", metavar="CASE")
@OUTPUT
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "md", "html"]),
    help="text, md (Markdown with LaTeX formulas) or html; by the ending of -o, else text.",
)
@click.option("--bodies", is_flag=True, help="The equations of equilibrium of every link, and the reactions.")
@SET
@DIGITS
def explain_command(
    case: str, output: str | None, form: str | None, bodies: bool, settings: dict[str, str], digits: int
) -> int:
    """Print the worked solution of a case, in the textbook's order and words.

    \b
    icsolve explain press.yaml
    icsolve explain press.yaml -o press.html
    icsolve explain press.yaml --format md --bodies --digits 4

    A case without an answer is explained as far as it goes, with the reason; exit status 1.
    """
    return explain_case(case, output, form or _form_of(output), bodies, digits, settings)


def _form_of(output: str | None) -> str:
    """The format that a file's name asks for."""
    ending = (output or "").lower().rpartition(".")[2]
    return {"html": "html", "htm": "html", "md": "md", "markdown": "md"}.get(ending, "text")


def explain_case(
    argument: str, output: str | None, form: str, bodies: bool, digits: int, settings: Mapping[str, str]
) -> int:
    """Explain one case; returns the exit status."""
    if not one_source("explain", argument):
        return UNREADABLE

    def work(case: Case, path: str) -> int:
        from icsolve.derivation import known_of
        from icsolve.explain import explain

        known = known_of(case, reactions=True)
        text = explain(case, form, digits, bodies=bodies, known=known)
        code = write_output("explain", text.encode("utf-8", "backslashreplace"), output, [argument])
        if known.refusal is not None:
            on_stderr(case, path, known.refusal)
            return max(code, NO_ANSWER)
        return code

    return for_each([argument], work, settings=settings)
