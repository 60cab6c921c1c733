"""`icsolve sweep`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.options import SET
from icsolve.cli.output import OUTPUT, one_source, write_output
from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain, for_each

if TYPE_CHECKING:
    from icsolve.case import Case
    from icsolve.turn import Sweep

MOST_ROWS = 20_000_000
"""More rows than this are refused: their arrays would not fit a common machine."""


class Span(click.ParamType):  # type: ignore[type-arg]
    """``PATH=FROM:TO:STEP``, or ``PATH=VALUE,VALUE,...``."""

    name = "PATH=FROM:TO:STEP"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, list[float]]:
        """The path and its values."""
        path, equals, span = str(value).partition("=")
        try:
            values = _values(span)
        except ValueError:
            values = None
        if not (path.strip() and equals) or values is None:
            self.fail(f"{value!r} is not PATH=FROM:TO:STEP, e.g. angles.AB=0:360:1", param, ctx)
        if not values:
            message = f"{value!r} is an empty range: the step should lead from the first to the last"
            self.fail(message, param, ctx)
        return path.strip(), values


def _values(span: str) -> list[float] | None:
    """The values of a span; an empty list where the step leads nowhere, None where it is no span."""
    if ":" not in span:
        return [float(word) for word in span.split(",")]
    numbers = [float(word) for word in span.split(":")]
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        return None
    first, last, step = numbers
    if step == 0.0 or (last - first) / step < 0.0:
        return []
    count = math.floor((last - first) / step + 1e-9) + 1
    if count > MOST_ROWS:
        raise click.BadParameter(f"{span} has {count} values; at most {MOST_ROWS} rows fit")
    return [first + k * step for k in range(count)]


@click.command("sweep")
@click.argument("case", metavar="CASE")
@click.option("--vary", type=Span(), multiple=True, help="A number and its values; several are a product.")
@click.option("--drive", type=Span(), multiple=True, help="A link, and degrees to turn it: 2=0:360:1.")
@OUTPUT
@click.option("--error", is_flag=True, help="Bounds on the rounding errors of the answers too.")
@click.option("--points", is_flag=True, help="The places of the points too.")
@click.option("--centres", is_flag=True, help="All instant centres too, homogeneous.")
@click.option("--rates", is_flag=True, help="The angular velocities of the links too.")
@click.option("--plot", metavar="SVG", help="The answers over the range, as a picture, into this file.")
@SET
def sweep_command(
    case: str,
    vary: tuple[tuple[str, list[float]], ...],
    drive: tuple[tuple[str, list[float]], ...],
    output: str | None,
    plot: str | None,
    settings: dict[str, str],
    **more: bool,
) -> int:
    """Solve a case over a range: the mechanism moves from the position as written.

    \b
    icsolve sweep press.yaml --vary angles.AB=0:360:1 -o turn.csv
    icsolve sweep press.yaml --drive 2=0:360:1 --vary loads.P=50:150:50 -o turn.npz
    icsolve sweep press.yaml --vary angles.AB=0:360:1 --plot turn.svg

    The ending of FILE says the form: .csv, .jsonl, .npz. A row without an answer has its status.
    Exit status: 1 where no row has an answer.
    """
    suffix = Path(output).suffix.lower() if output not in (None, "-") else ".csv"
    if suffix not in (".csv", ".jsonl", ".npz"):
        complain(f"icsolve sweep: {output} should end in .csv, .jsonl or .npz")
        return UNREADABLE
    if not vary and not drive:
        complain("icsolve sweep: nothing is varied: give --vary angles.AB=0:360:1 or --drive 2=0:360:1")
        return UNREADABLE
    if not one_source("sweep", case):
        return UNREADABLE
    if plot is not None and not _plottable(plot, len(vary) + len(drive)):
        return UNREADABLE
    want = ("answers", "status", *(word for word, asked in more.items() if asked))

    def work(read: Case, path: str) -> int:
        from icsolve.turn.sheet_out import FORMATS

        found = _swept(read, vary, drive, want)
        for note in found.notes:
            complain(f"{path}: {note}")
        code = DONE
        if plot is not None:
            from icsolve.draw.swept import sweep_svg

            code = write_output("sweep", sweep_svg(found), plot, [case])
        if plot is None or output is not None:
            code = max(code, write_output("sweep", FORMATS[suffix](found), output, [case]))
        return code or (DONE if (found.status == "ok").any() else NO_ANSWER)

    return for_each([case], work, settings=settings)


def _plottable(path: str, ranges: int) -> bool:
    """Whether a picture can be made of so many ranges, under such a name; says what is wrong."""
    if path != "-" and Path(path).suffix.lower() != ".svg":
        complain(f"icsolve sweep: {path} should end in .svg, which is what --plot writes")
        return False
    if ranges != 1:
        complain("icsolve sweep: --plot draws the answers over one range: give one --vary or --drive")
        return False
    return True


def _swept(
    case: Case,
    vary: tuple[tuple[str, list[float]], ...],
    drive: tuple[tuple[str, list[float]], ...],
    want: tuple[str, ...],
) -> Sweep:
    """The product of all ranges, the last the fastest."""
    import numpy as np

    from icsolve.turn import sweep

    rows = math.prod(len(values) for _, values in (*vary, *drive))
    if rows > MOST_ROWS:
        raise click.BadParameter(f"the ranges have {rows} rows together; at most {MOST_ROWS} fit")
    axes = np.meshgrid(*(values for _, values in (*vary, *drive)), indexing="ij")
    columns = [axis.ravel() for axis in axes]
    varied = {path: column for (path, _), column in zip(vary, columns, strict=False)}
    driven = {link: column for (link, _), column in zip(drive, columns[len(vary) :], strict=True)}
    return sweep(case, varied, want, drive=driven)
