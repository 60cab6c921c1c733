"""`icsolve sweep`."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli.commands import CASE, DIGITS, SET, Verb
from icsolve.cli.run import (
    DONE,
    NO_ANSWER,
    OUTPUT,
    UNREADABLE,
    Refuse,
    complain,
    for_each,
    in_json,
    on_stderr,
    one_source,
    progress,
    write_output,
)
from icsolve.errors import SceneError, Status
from icsolve.tuples import NamedTuple, replace

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from icsolve.case import Case

    Values = npt.NDArray[np.float64]

MOST_ROWS = 20_000_000
"""More rows than this are refused: their arrays would not fit a common machine."""
EXACT = 2**53
"""Whole numbers below this are exact as doubles."""
LONGEST = 60
"""Decimals of more places are no range of a mechanism."""


class SweepSpan(click.ParamType):  # type: ignore[type-arg]
    """A path or a link, and its values."""

    def __init__(self, what: str, example: str) -> None:
        self.name = f"{what}=FROM:TO:STEP"
        self.example = f"{example}=0:360:1"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, Values]:
        """The path and its values."""
        path, equals, span = str(value).partition("=")
        numbers, slip = _numbers(span) if path.strip() and equals else ([], "")
        if slip or not numbers:
            why = f": {slip};" if slip else ","
            self.fail(f"{value!r} is not {self.name}{why} e.g. {self.example}", param, ctx)
        if ":" not in span:
            return path.strip(), _array([float(number) for number in numbers])
        first, last, step = numbers
        if step == 0 or (last - first) / step < 0:
            turned = f"; write {path.strip()}={_reversed(span)}" if step else ""
            message = f"{value!r} is an empty range: the step should lead from the first to the last{turned}"
            self.fail(message, param, ctx)
        count = int((last - first) // step) + 1
        if count > MOST_ROWS:
            self.fail(f"{value!r} has {count} values; at most {MOST_ROWS} rows fit", param, ctx)
        return path.strip(), progression(first, step, count)


def _reversed(span: str) -> str:
    """A range with its step the other way."""
    first, last, step = (word.strip() for word in span.split(":"))
    return f"{first}:{last}:{step[1:] if step[0] in '+-' else '-' + step}"


def _numbers(span: str) -> tuple[list[Fraction], str]:
    """The numbers of a span, exact; with what is wrong where it is none."""
    words = [word.strip() for word in span.split(":" if ":" in span else ",")]
    numbers = []
    for word in words:
        try:
            number = Decimal(word)
        except InvalidOperation:
            return [], f"{word!r} is no bare number" if word else "a number is missing"
        if not number.is_finite() or abs(number.adjusted()) >= LONGEST:
            return [], f"{word!r} is no number of a mechanism"
        numbers.append(Fraction(number))
    if ":" in span and len(numbers) != 3:
        return [], f"a range has three numbers, and here are {len(numbers)}"
    return numbers, ""


def _array(values: list[float]) -> Values:
    import numpy as np

    return np.array(values, dtype=np.float64)


def progression(first: Fraction, step: Fraction, count: int) -> Values:
    """``first + k step`` as written in decimals, each rounded once: 0.3, and not 0.1 + 0.1 + 0.1."""
    import numpy as np

    under = math.lcm(first.denominator, step.denominator)
    start, by = int(first * under), int(step * under)
    if max(abs(start), abs(start + by * count), under) >= EXACT:
        return _array([float(first + k * step) for k in range(count)])
    whole = start + by * np.arange(count, dtype=np.int64)
    return np.asarray(whole / float(under), dtype=np.float64)


Ranges = tuple[tuple[str, "Values"], ...]
WRITTEN = (".csv", ".jsonl", ".npz")
MORE = ("error", "points", "centres", "rates", "velocities", "accelerations", "reactions")


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
        return os.path.splitext(self.output)[1].lower() if self.output not in (None, "-") else ".csv"


@click.command("sweep", cls=Verb)
@CASE
@click.option(
    "--vary",
    type=SweepSpan("PATH", "angles.AB"),
    multiple=True,
    help="A number and its values; several are a product.",
)
@click.option(
    "--drive",
    type=SweepSpan("LINK", "2"),
    metavar="LINK=SPAN",
    multiple=True,
    help="A link, degrees: 2=0:360:1.",
)
@OUTPUT
@click.option("--error", is_flag=True, help="Bounds on the rounding errors of all numbers too.")
@click.option("--points", is_flag=True, help="The places of the points too.")
@click.option("--centres", is_flag=True, help="All instant centres too, homogeneous.")
@click.option("--rates", is_flag=True, help="The angular velocities of the links too.")
@click.option("--velocities", is_flag=True, help="The velocities of the points too.")
@click.option("--accelerations", is_flag=True, help="With --dynamic: those of the links and points too.")
@click.option("--reactions", is_flag=True, help="The forces in the joints too; each row is a scene then.")
@click.option("--dynamic", is_flag=True, help="With the inertia forces of the motion.")
@click.option("--plot", metavar="SVG", help="The answers over the range, as a picture, into this file.")
@click.option(
    "--find",
    metavar="WHAT",
    help="Instead of rows, where: dead, max, rest, neutral, hold, or NAME=VALUE (T12=0).",
)
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
    value, to the last digit. Exit status: 1 where no row has an answer (`ok` or `holds`).
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
    refuse: Refuse = on_stderr
    if asked.as_json:
        from icsolve.cli.finding import SCHEMA

        refuse = in_json(SCHEMA)
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
        idle = ["plot"] * bool(asked.plot) + [name for name in MORE[1:] if name in asked.want]
        shown = " and ".join(f"--{name}" for name in idle)
        return f"--find looks between rows and makes no table: leave {shown} out" if idle else None
    if asked.as_json:
        return "--json is for --find; for rows as JSON Lines write -o FILE.jsonl"
    if asked.suffix not in WRITTEN:
        return f"{asked.output} should end in .csv, .jsonl or .npz"
    return _unplottable(asked.plot, len(ranges)) if asked.plot is not None else None


def _unplottable(path: str, ranges: int) -> str | None:
    """Why no picture can be made of so many ranges, or under such a name."""
    if path != "-" and os.path.splitext(path)[1].lower() != ".svg":
        return f"{path} should end in .svg, which is what --plot writes"
    if ranges != 1:
        return "--plot draws the answers over one range: give one --vary or --drive"
    return None


def _readable(
    work: Callable[[Case, str, SweepOptions], int], read: Case, path: str, asked: SweepOptions
) -> int:
    """The work; what is asked that makes no sense for this case is said."""
    from icsolve.sweep.request import RequestError

    try:
        dynamic = read.dynamic or asked.dynamic
        return work(_with_varied(replace(read, dynamic=dynamic), asked), path, asked)
    except RequestError as error:
        complain(f"{path}: {error}")
        return UNREADABLE


def _with_varied(case: Case, asked: SweepOptions) -> Case:
    """The case with numbers for unknown data of its figure that are varied: as written, else the first."""
    from icsolve.sweep.varied_numbers import find_number

    varied = {n if n.startswith("points.") else find_number(case, n).path: at for n, at in asked.vary}
    for unknown in case.unknowns:
        if unknown.path in varied:
            from icsolve.case.expected import PositionIs
            from icsolve.solve.load_function import given_at

            first = unknown.start.value if unknown.start is not None else float(varied[unknown.path][0])
            expect = tuple(one for one in case.expect if not isinstance(one.target, PositionIs))
            left = tuple(one for one in case.unknowns if one is not unknown)
            case = replace(given_at(case, unknown.path, first), unknowns=left, expect=expect)
    return case


def _table(read: Case, path: str, asked: SweepOptions) -> int:
    """All rows, as a table or a picture."""
    from icsolve.sweep import sweep
    from icsolve.sweep.table import FORMATS

    varied, driven = _columns(asked)
    if read.unknowns:
        from icsolve.sweep.request import RequestError

        there = {"drive": bool(driven), "plot": asked.plot is not None, **dict.fromkeys(asked.want, True)}
        what = next((name for name in ("drive", "plot", *MORE) if there.get(name)), "")
        if what:
            path = read.unknowns[0].path
            raise RequestError(f"{path} is unknown, and --{what} is for a case in which it is given")
        content, some = _positions_table(read, varied, asked.suffix)
        return _written([content], asked.output) or (DONE if some else NO_ANSWER)
    total, done = math.prod(len(values) for _, values in (*asked.vary, *asked.drive)), 0
    with progress() as told:

        def counted(rows: int) -> None:
            nonlocal done
            done += rows
            told("rows", done / total)

        found = sweep(read, varied, asked.want, drive=driven, progress=counted)
    for note in (*found.notes, *_nothing_asked(read, asked)):
        complain(f"{path}: {note}")
    code = DONE
    if asked.plot is not None:
        from icsolve.draw.plot import sweep_svg

        code = _written(sweep_svg(found), asked.plot)
    if asked.plot is None or asked.output is not None:
        code = max(code, _written(FORMATS[asked.suffix](found), asked.output))
    answered = (found.status == "ok") | (found.status == "holds")
    return code or (DONE if answered.any() else NO_ANSWER)


def _nothing_asked(case: Case, asked: SweepOptions) -> Iterable[str]:
    """The note on rows of which nothing is asked but their status."""
    from icsolve.statics.power import has_friction, is_unknown

    if not any(name in asked.want for name in MORE[1:]) and not any(map(is_unknown, case.loads)):
        friction = "; --find hold tells where friction holds the loads" if has_friction(case) else ""
        yield f"no load is `unknown`: rows tell their status alone, --points and others more{friction}."


def _written(content: str | Iterable[bytes], path: str | None) -> int:
    """Write a table or a picture; that a file was there is said."""
    there = path is not None and os.path.isfile(path)
    code = write_output("sweep", content, path)
    if there and code == DONE:
        complain(f"icsolve sweep: {path} was there and is replaced")
    return code


def _find(read: Case, path: str, asked: SweepOptions) -> int:
    """Positions that are looked for."""
    from icsolve.cli.finding import as_json, as_text, finding

    found = finding(read, asked.find or "", *_columns(asked))
    text = as_json(read, found) if asked.as_json else as_text(read, found, asked.digits)
    for note in () if asked.as_json else found.notes:
        complain(f"{path}: {note}")
    return _written(text, asked.output)


def _columns(asked: SweepOptions) -> tuple[Mapping[str, Values], Mapping[str, Values]]:
    """The product of all ranges, the last the fastest: what is varied, and which links are turned."""
    import numpy as np

    ranges = (*asked.vary, *asked.drive)
    axes = np.meshgrid(*(values for _, values in ranges), indexing="ij")
    columns = [axis.ravel() for axis in axes]
    count = len(asked.vary)
    varied = {path: column for (path, _), column in zip(asked.vary, columns[:count], strict=True)}
    return varied, {link: column for (link, _), column in zip(asked.drive, columns[count:], strict=True)}


def _positions_table(case: Case, columns: Mapping[str, Values], suffix: str) -> tuple[bytes, bool]:
    """A row a position of a case with an unknown datum, for every value of what is varied; whether any has
    one.

    Raises RequestError for a form that has no rows of words.
    """
    from icsolve.sweep.request import RequestError

    if suffix not in (".csv", ".jsonl"):
        raise RequestError(f"positions are written as .csv or .jsonl, not {suffix}")
    rows = list(_positions(case, columns))
    if suffix == ".jsonl":
        text = "".join(json.dumps({k: v for k, v in row.items() if v is not None}) + "\n" for row in rows)
    else:
        out = io.StringIO()
        header = list(dict.fromkeys(key for row in rows for key in row))
        table = csv.DictWriter(out, header, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
        text = out.getvalue()
    return text.encode(), any(row["status"] == Status.OK for row in rows)


def _positions(case: Case, columns: Mapping[str, Values]) -> Iterator[dict[str, Any]]:
    from icsolve.solve import solve
    from icsolve.sweep.varied_numbers import find_number, with_numbers

    own = {find_number(case, path).path: path for path in columns}
    for numbers in zip(*(columns[path].tolist() for path in own.values()), strict=True):
        varied = dict(zip(own.values(), numbers, strict=True))
        try:
            found = solve(with_numbers(case, dict(zip(own, numbers, strict=True)))).positions or ()
        except SceneError as refusal:
            yield {**varied, "status": refusal.status}
            continue
        for one in found:
            at: dict[str, Any] = {}
            for path, value in one.at.items():
                if isinstance(value, tuple):
                    at |= {f"{path} from": value[0], f"{path} to": value[1]}
                else:
                    at[path] = value
            stiffness = one.stiffness.value if one.stiffness is not None else None
            yield {**varied, "status": Status.OK, **at, "stability": one.stability, "stiffness": stiffness}
