"""`icsolve sweep`."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.options import DIGITS, SET
from icsolve.cli.output import OUTPUT, one_source, write_output
from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain, for_each, on_stderr
from icsolve.cli.spans import MOST_ROWS, SweepSpan
from icsolve.tuples import NamedTuple, replace

if TYPE_CHECKING:
    from icsolve.case import Case
    from icsolve.cli.spans import Values
    from icsolve.errors import SceneError
    from icsolve.sweep import Sweep

Ranges = tuple[tuple[str, "Values"], ...]
WRITTEN = (".csv", ".jsonl", ".npz")
MORE = ("error", "points", "centres", "rates", "velocities", "accelerations")


class SweepOptions(NamedTuple):
    """What `icsolve sweep` was asked for."""

    case: str
    vary: Ranges
    drive: Ranges
    output: str | None
    plot: str | None
    find: str | None
    as_json: bool
    digits: int
    want: tuple[str, ...]
    dynamic: bool

    @property
    def suffix(self) -> str:
        """The ending of the table's file."""
        return Path(self.output).suffix.lower() if self.output not in (None, "-") else ".csv"


@click.command("sweep")
@click.argument("case", metavar="CASE")
@click.option(
    "--vary", type=SweepSpan(), multiple=True, help="A number and its values; several are a product."
)
@click.option(
    "--drive", type=SweepSpan(), metavar="LINK=SPAN", multiple=True, help="A link, degrees: 2=0:360:1."
)
@OUTPUT
@click.option("--error", is_flag=True, help="Bounds on the rounding errors of all numbers too.")
@click.option("--points", is_flag=True, help="The places of the points too.")
@click.option("--centres", is_flag=True, help="All instant centres too, homogeneous.")
@click.option("--rates", is_flag=True, help="The angular velocities of the links too.")
@click.option("--velocities", is_flag=True, help="The velocities of the points too.")
@click.option("--accelerations", is_flag=True, help="With --dynamic: those of the links and points too.")
@click.option("--dynamic", is_flag=True, help="With the inertia forces of the motion.")
@click.option("--plot", metavar="SVG", help="The answers over the range, as a picture, into this file.")
@click.option("--find", metavar="WHAT", help="Instead of rows, where: dead, max, or NAME=VALUE (T12=0).")
@click.option("--json", "as_json", is_flag=True, help="With --find: one JSON object.")
@SET
@DIGITS
def sweep_command(case: str, settings: dict[str, str], **options: Any) -> int:
    """Solve a case over a range: the mechanism moves from the position as written.

    \b
    icsolve sweep press.yaml --vary angles.AB=0:360:1 -o turn.csv
    icsolve sweep press.yaml --drive 2=0:360:1 --vary loads.P=50:150:50 -o turn.npz
    icsolve sweep press.yaml --vary angles.AB=0:360:1 --plot turn.svg
    icsolve sweep press.yaml --vary angles.AB=0:360:1 --find T12=0

    The ending of FILE says the form: .csv, .jsonl, .npz. A row without an answer has its status.
    --find says where the mechanism locks (dead), where an answer peaks (max), or where it takes a
    value, to the last digit. Exit status: 1 where no row has an answer.
    """
    want = ("answers", "status", *(word for word in MORE if options.pop(word)))
    asked = SweepOptions(case, want=want, **options)
    wrong = _wrong(asked)
    if wrong is not None:
        complain(f"icsolve sweep: {wrong}")
        return UNREADABLE
    if not one_source("sweep", case):
        return UNREADABLE
    work = _find if asked.find is not None else _table
    refuse = _refuse_json if asked.as_json else on_stderr
    return for_each([case], lambda read, path: _readable(work, read, path, asked), refuse, settings=settings)


def _wrong(asked: SweepOptions) -> str | None:
    """What is wrong with the options together."""
    ranges = (*asked.vary, *asked.drive)
    if not ranges:
        return "nothing is varied: give --vary angles.AB=0:360:1 or --drive 2=0:360:1"
    twice = next((name for name, _ in ranges if [n for n, _ in ranges].count(name) > 1), None)
    if twice is not None:
        return f"{twice} is given twice"
    rows = math.prod(len(values) for _, values in ranges)
    if rows > MOST_ROWS:
        return f"the ranges have {rows} rows together; at most {MOST_ROWS} fit"
    if asked.find is not None:
        return "--find looks between rows and makes no table: leave --plot out" if asked.plot else None
    if asked.as_json:
        return "--json is for --find; for rows as JSON Lines write -o FILE.jsonl"
    if asked.suffix not in WRITTEN:
        return f"{asked.output} should end in .csv, .jsonl or .npz"
    return _unplottable(asked.plot, len(ranges)) if asked.plot is not None else None


def _unplottable(path: str, ranges: int) -> str | None:
    """Why no picture can be made of so many ranges, or under such a name."""
    if path != "-" and Path(path).suffix.lower() != ".svg":
        return f"{path} should end in .svg, which is what --plot writes"
    if ranges != 1:
        return "--plot draws the answers over one range: give one --vary or --drive"
    return None


def _readable(
    work: Callable[[Case, str, SweepOptions], int], read: Case, path: str, asked: SweepOptions
) -> int:
    """The work; what is asked that makes no sense for this case is said."""
    from icsolve.sweep.request import RequestError

    read = replace(read, dynamic=read.dynamic or asked.dynamic)
    try:
        return work(read, path, asked)
    except RequestError as error:
        complain(f"{path}: {error}")
        return UNREADABLE


def _table(read: Case, path: str, asked: SweepOptions) -> int:
    """All rows, as a table or a picture."""
    from icsolve.cli.progress import Progress
    from icsolve.sweep import sweep
    from icsolve.sweep.table import FORMATS

    varied, driven = _columns(asked)
    if read.unknowns:
        from icsolve.cli.resting import positions_table
        from icsolve.sweep.request import RequestError

        if driven or asked.plot is not None:
            what, path = "--drive" if driven else "--plot", read.unknowns[0].path
            raise RequestError(f"{path} is unknown, and {what} is for a case in which it is given")
        content, some = positions_table(read, varied, asked.suffix)
        return _written([content], asked.output, asked) or (DONE if some else NO_ANSWER)
    with Progress(math.prod(len(values) for _, values in (*asked.vary, *asked.drive))) as progress:
        found = sweep(read, varied, asked.want, drive=driven, progress=progress.told)
    for note in found.notes:
        complain(f"{path}: {note}")
    code = _pictured(found, asked) if asked.plot is not None else DONE
    if asked.plot is None or asked.output is not None:
        code = max(code, _written(FORMATS[asked.suffix](found), asked.output, asked))
    return code or (DONE if (found.status == "ok").any() else NO_ANSWER)


def _pictured(found: Sweep, asked: SweepOptions) -> int:
    from icsolve.draw.plot import sweep_svg

    return _written(sweep_svg(found), asked.plot, asked)


def _written(content: str | Iterable[bytes], path: str | None, asked: SweepOptions) -> int:
    """Write a table or a picture; that a file was there is said."""
    there = path is not None and os.path.isfile(path)
    code = write_output("sweep", content, path, [asked.case])
    if there and code == DONE:
        complain(f"icsolve sweep: {path} was there and is replaced")
    return code


def _find(read: Case, path: str, asked: SweepOptions) -> int:
    """Positions that are looked for."""
    from icsolve.cli.resting import WORDS, equilibrium_text
    from icsolve.cli.seeking import as_json, as_text, query_of
    from icsolve.sweep.find_on_record import find
    from icsolve.sweep.request import along_of, columns_of

    varied, driven = _columns(asked)
    columns = columns_of(read, varied, driven)
    own = along_of(columns)
    along = columns.names[own]
    if asked.find in WORDS:
        values = columns.arrays[own]
        text = equilibrium_text(read, asked.find, own, values, asked.as_json, asked.digits)
        return _written(text, asked.output, asked)

    query = query_of(read, asked.find or "")
    spots = find(read, varied, query, drive=driven)
    if asked.as_json:
        text = as_json(read, along, query, spots)
    else:
        text = as_text(read, along, query, spots, asked.digits)
        for note in spots.notes:
            complain(f"{path}: {note}")
    return _written(text, asked.output, asked)


def _refuse_json(case: Case, path: str, error: SceneError) -> None:
    from icsolve.cli.seeking import refusal

    click.echo(refusal(case, error), nl=False)


def _columns(asked: SweepOptions) -> tuple[Mapping[str, Values], Mapping[str, Values]]:
    """The product of all ranges, the last the fastest: what is varied, and which links are turned."""
    import numpy as np

    ranges = (*asked.vary, *asked.drive)
    axes = np.meshgrid(*(values for _, values in ranges), indexing="ij")
    columns = [axis.ravel() for axis in axes]
    count = len(asked.vary)
    varied = {path: column for (path, _), column in zip(asked.vary, columns[:count], strict=True)}
    return varied, {link: column for (link, _), column in zip(asked.drive, columns[count:], strict=True)}
