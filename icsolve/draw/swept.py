"""A sweep as curves: the unknown loads over the one number that is varied."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from icsolve.draw.plot import Curve, Shade, plot_svg
from icsolve.draw.words import figure_number, unit_word
from icsolve.errors import Status
from icsolve.wording.senses import unit_of

if TYPE_CHECKING:
    from icsolve.sweep import Sweep

DEAD = (Status.DEAD_CENTRE, Status.NO_VALUE)


def sweep_svg(found: Sweep) -> str:
    """The answers of a sweep along one range as an SVG document.

    Raises ValueError where several numbers were varied, or none: there is no axis to draw them over.
    """
    if len(found.vary) != 1 or not len(found):
        raise ValueError("a sweep is drawn over one number that is varied")
    ((path, values),) = found.vary.items()
    order = values.argsort(kind="stable").tolist()
    x = [float(values[row]) for row in order]
    status = [str(found.status[row]) for row in order]
    curves = list(_curves(found, order, x, status)) or [Curve("no unknown load", [math.nan] * len(x), "")]
    driven = path in found.case.links
    axis = f"link {path}, degrees from the position as written" if driven else path
    return plot_svg(x, curves, axis, found.case.title or found.case.name, list(_shades(x, status)))


def sweep_markdown(found: Sweep) -> str:
    """The ranges of what was varied and of the answers, as a Markdown table."""
    units = {load.name: unit_of(load, found.case) for load in found.case.loads}
    columns = [*found.vary.items(), *found.answers.items()]
    lines = [f"{found.outcome}.", "", "| | least | most | unit |", "|---|---|---|---|"]
    for name, column in columns:
        some = [float(v) for v in column if math.isfinite(v)]
        ends = (figure_number(min(some), 6), figure_number(max(some), 6)) if some else ("", "")
        lines.append(f"| `{name}` | {ends[0]} | {ends[1]} | {unit_word(units.get(name, ''))} |")
    return "\n".join(lines) + "\n"


def _curves(found: Sweep, order: Sequence[int], x: Sequence[float], status: Sequence[str]) -> Iterator[Curve]:
    """A curve an unknown; where it holds over a range, its two ends."""
    dead = [a for a, word in zip(x, status, strict=True) if word in DEAD]
    units = {load.name: unit_of(load, found.case) for load in found.case.loads}
    for name, column in found.answers.items():
        values = [float(column[row]) for row in order]
        if any(map(math.isfinite, values)) or name not in found.holds:
            yield Curve(name, values, units[name], dead)
        for end, words in ((0, "least"), (1, "most")) if name in found.holds else ():
            ends = [float(found.holds[name][row][end]) for row in order]
            yield Curve(f"{name}, {words} that holds", ends, units[name])


def _shades(x: Sequence[float], status: Sequence[str]) -> Iterable[Shade]:
    """The stretches in which the links do not assemble."""
    for gone, some in groupby(range(len(x)), key=lambda n: status[n] == Status.CANNOT_ASSEMBLE):
        rows = list(some)
        if gone:
            yield Shade(x[rows[0]], x[rows[-1]], "the links do not meet")
