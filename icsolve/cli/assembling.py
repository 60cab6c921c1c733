"""`icsolve ways`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.options import CASES, DIGITS, JSON, SET, Verb
from icsolve.cli.run import DONE, for_each, on_stderr
from icsolve.cli.solving import print_json

if TYPE_CHECKING:
    from icsolve.assembly.modes import Place, Ways
    from icsolve.case import Case
    from icsolve.errors import SceneError


@click.command("ways", cls=Verb)
@CASES
@JSON
@SET
@DIGITS
def ways_command(cases: tuple[str, ...], as_json: bool, settings: dict[str, str], digits: int) -> int:
    """List every way in which the figure assembles, and the `near` that picks each; loads are not needed.

    \b
    icsolve ways press.yaml
    icsolve ways press.yaml --json

    Exit status: 0 there is a way, 1 there is none, 2 a file can't be read; of several the largest.
    """

    def work(case: Case, path: str) -> int:
        from icsolve.assembly.modes import ways_of

        found = ways_of(case)
        if as_json:
            print_json(_entry(case, found))
        else:
            click.echo(_text(case, found, digits))
        return DONE

    return for_each(cases, work, _refuse_json if as_json else on_stderr, settings)


def _entry(case: Case, found: Ways) -> dict[str, Any]:
    return {
        "schema": "icsolve/ways/1",
        "case": case.name,
        "status": "ok",
        "ways": [
            {
                "points": {p: list(at) for p, at in way.points.items()},
                "near": {p: list(at) for p, at in way.near.items()},
            }
            for way in found.ways
        ],
        "complete": found.complete,
        "notes": list(found.notes),
    }


def _refuse_json(case: Case, path: str, error: SceneError) -> None:
    print_json(
        {
            "schema": "icsolve/ways/1",
            "case": case.name,
            "status": error.status,
            "message": error.message,
            "ways": [],
        }
    )


def _text(case: Case, found: Ways, digits: int) -> str:
    count = len(found.ways)
    what = "one way" if count == 1 else f"{count} ways"
    lines = [f"{case.title or case.name}: {what} of assembling{', all there are' if found.complete else ''}"]
    for number, way in enumerate(found.ways, 1):
        near = ", ".join(f"{p}: [{at[0]:.12g}, {at[1]:.12g}]" for p, at in way.near.items())
        lines.append("")
        lines.append(f"{number}  near: {{{near}}}" if near else f"{number}  (no near needed)")
        width = max(map(len, way.points))
        lines += [f"   {p:<{width}}  {_pair(at, digits)}" for p, at in way.points.items()]
    return "\n".join([*lines, *(f"\nnote: {note}" for note in found.notes)])


def _pair(at: Place, digits: int) -> str:
    return f"({at[0]:.{digits}g}, {at[1]:.{digits}g})"
