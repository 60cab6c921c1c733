"""Curves over a range as a picture: gaps where there is no value, dead centres as asymptotes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import cycle, groupby
from typing import TYPE_CHECKING

from icsolve.draw.marks import AreaMark, Mark, MarkGroup, Point, Stroke, TextMark, TextRun, bounds, text_width
from icsolve.draw.svg import document
from icsolve.draw.words import figure_number, name_runs, unit_word, wrapped
from icsolve.errors import SceneError, Status
from icsolve.statics.power import is_unknown
from icsolve.tuples import NamedTuple
from icsolve.wording import unit_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from icsolve.case import Case
    from icsolve.sweep import Sweep

STEEP = 3.0
"""Where a curve runs off to infinity, the axis shows so many times the middle half of its values."""
WIDE_GAP = 2.5
"""Rows farther apart than so many mean steps have something unknown between them."""
EVEN = 0.4
"""Reciprocals that change so much less evenly than those at a pole belong to a jump."""
SAME = 1e-5
"""Values that differ by less, of their size, are one value: more digits than an axis shows."""


class PlottedCurve(NamedTuple):
    """Values over the range, not a number where there is none; ``unit`` stands at the axis, ``dead`` are
    its dead centres (None: they are judged by how the values grow)."""

    name: str
    values: Sequence[float]
    unit: str
    dead: Sequence[float] | None = None


class PlotFrame(NamedTuple):
    """Where a plot's axes are: picture units of its corners, and the values there."""

    left: float
    top: float
    right: float
    bottom: float
    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """A point of a curve; one beyond the frame lies on its edge."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = min(max((y - self.y[0]) / (self.y[1] - self.y[0]), 0.0), 1.0)
        return (self.left + across * (self.right - self.left), self.bottom - up * (self.bottom - self.top))


class PlotRow(NamedTuple):
    """A value of a curve."""

    x: float
    y: float


def rows_of(x: Sequence[float], values: Sequence[float]) -> list[PlotRow]:
    """The rows that have a value."""
    return [PlotRow(a, v) for a, v in zip(x, values, strict=True) if math.isfinite(v)]


def poles(x: Sequence[float], curve: PlottedCurve) -> list[float]:
    """Where a curve runs off to infinity."""
    return asymptotes(x, curve.values) if curve.dead is None else sorted(curve.dead)


def asymptotes(x: Sequence[float], values: Sequence[float], dead: Sequence[float] = ()) -> list[float]:
    """The dead centres of a curve of which nobody knows all: those known, and where it runs off to infinity
    and comes back.

    Between two neighbours of opposite sign lies a pole, and not a zero, where the curve grows toward it
    on both sides. Near a pole p values go as 1 / (x - p), which places it between the neighbours.
    """
    rows = rows_of(x, values)
    usual = sorted(abs(row.y) for row in rows)[len(rows) // 2] if rows else 0.0
    step = (x[-1] - x[0]) / max(len(x) - 1, 1)
    places = list(dead)
    for n in range(len(rows) - 1):
        a, b = rows[n], rows[n + 1]
        if b.x - a.x > WIDE_GAP * step or (a.y < 0.0) == (b.y < 0.0) or min(abs(a.y), abs(b.y)) <= usual:
            continue
        before, after = rows[n - 1] if n else None, rows[n + 2] if n + 2 < len(rows) else None
        known = any(a.x <= place <= b.x for place in dead)
        pace = abs(1.0 / a.y - 1.0 / b.y) / (b.x - a.x)
        if not known and _grows(a, before, usual, pace) and _grows(b, after, usual, pace):
            share = abs(b.y) / (abs(a.y) + abs(b.y))
            places.append(a.x + (b.x - a.x) * share)
    return sorted(dict.fromkeys(places))


def _grows(row: PlotRow, behind: PlotRow | None, usual: float, pace: float) -> bool:
    """Whether a curve grows from the row behind to this one as toward a pole; at an end: whether it is large.

    Toward a pole 1 / y goes down evenly, at ``pace``; at a jump (friction that turns round) it hardly does.
    """
    if behind is None:
        return abs(row.y) > 4.0 * usual
    if abs(row.y) <= abs(behind.y) or (row.y < 0.0) != (behind.y < 0.0):
        return False
    return abs(1.0 / behind.y - 1.0 / row.y) >= EVEN * pace * abs(row.x - behind.x)


def limits(curves: Sequence[PlottedCurve], x: Sequence[float]) -> tuple[float, float]:
    """The values that an axis shows: all; of curves that run off to infinity, what can be seen beside."""
    values = sorted(v for curve in curves for v in curve.values if math.isfinite(v))
    if not values:
        return (-1.0, 1.0)
    low, high = values[0], values[-1]
    broken = any(not math.isfinite(v) for curve in curves for v in curve.values)
    if broken or any(poles(x, curve) for curve in curves):
        first, last = values[len(values) // 4], values[-1 - len(values) // 4]
        room = STEEP * ((last - first) or abs(last) or 1.0)
        low, high = max(low, first - room), min(high, last + room)
    size = max(abs(low), abs(high))
    pad = 0.06 * (high - low) if high - low > SAME * size else 0.5 * size or 1.0
    return (low - pad, high + pad)


def pieces(frame: PlotFrame, x: Sequence[float], curve: PlottedCurve) -> Iterator[tuple[Point, ...]]:
    """The stretches of a curve between gaps and asymptotes, cut off at the frame."""
    breaks = poles(x, curve)
    for stretch in _stretches(x, curve.values, breaks):
        if len(stretch) == 1 and frame.y[0] <= stretch[0].y <= frame.y[1]:
            p = frame.at(*stretch[0])
            yield ((p[0] - 0.8, p[1]), (p[0] + 0.8, p[1]))
        yield from _inside(frame, stretch)


def _stretches(
    x: Sequence[float], values: Sequence[float], breaks: Sequence[float]
) -> Iterable[list[PlotRow]]:
    """Rows without a gap or an asymptote between them."""
    stretch: list[PlotRow] = []
    for a, v in zip(x, values, strict=True):
        broken = bool(stretch) and any(stretch[-1].x <= place <= a for place in breaks)
        if stretch and (broken or not math.isfinite(v)):
            yield stretch
            stretch = []
        if math.isfinite(v):
            stretch.append(PlotRow(a, v))
    if stretch:
        yield stretch


def _inside(frame: PlotFrame, stretch: Sequence[PlotRow]) -> Iterable[tuple[Point, ...]]:
    """The parts of a stretch between the frame's lower and upper edge."""
    chain: list[Point] = []
    for n in range(len(stretch) - 1):
        ends = _clipped(frame, stretch[n], stretch[n + 1])
        if ends is None:
            continue
        a, b = (frame.at(*end) for end in ends)
        if not chain or chain[-1] != a:
            if chain:
                yield tuple(chain)
            chain = [a]
        chain.append(b)
    if chain:
        yield tuple(chain)


def _clipped(frame: PlotFrame, a: PlotRow, b: PlotRow) -> tuple[PlotRow, PlotRow] | None:
    """What of the line between two rows is within the frame's values; None where nothing is."""
    low, high = frame.y
    if max(a.y, b.y) < low or min(a.y, b.y) > high:
        return None
    return _pulled(a, b, low, high), _pulled(b, a, low, high)


def _pulled(row: PlotRow, other: PlotRow, low: float, high: float) -> PlotRow:
    """A row, or where the line to the other one enters the limits."""
    if low <= row.y <= high:
        return row
    edge = low if row.y < low else high
    return PlotRow(row.x + (edge - row.y) / (other.y - row.y) * (other.x - row.x), edge)


# --- a plot as a picture ---------------------------------------------------------------------------------


KINDS = ("plot", "plot-2", "plot-3")
TICKS = 5
WIDTH, HEIGHT = 600.0, 260.0
NAMED = 4
"""So many dead centres are named, of more their number."""
LINE = 18.0
"""Height of a line of the legend."""


class Shade(NamedTuple):
    """A part of the range without values, and why in words."""

    first: float
    last: float
    words: str


class LegendEntry(NamedTuple):
    """A line of the legend: a sample (of a line, or of a shade) and what it is."""

    kind: str
    runs: tuple[TextRun, ...]


def plot_svg(
    x: Sequence[float], curves: Sequence[PlottedCurve], x_name: str, title: str, shades: Sequence[Shade] = ()
) -> str:
    """Curves over ``x`` (at least one value) as an SVG document; curves of one unit share their axis."""
    marks: list[Mark] = [
        TextMark((0.0, 21.0 * n), (TextRun(line),), "t-title", 16.0, "start")
        for n, line in enumerate(wrapped(title, 16.0, WIDTH))
    ]
    top = bounds(marks)[3] + 18.0
    for unit in dict.fromkeys(curve.unit for curve in curves):
        some = [curve for curve in curves if curve.unit == unit]
        _, drawn = plot_marks(x, some, x_name, (0.0, top), (WIDTH, HEIGHT), shades)
        marks += drawn
        top = bounds(marks)[3] + 24.0
    names = ", ".join(curve.name for curve in curves)
    return document(marks, bounds(marks, 14.0), title or names, f"{names} over {x_name}.")


def plot_marks(
    x: Sequence[float],
    curves: Sequence[PlottedCurve],
    x_name: str,
    corner: Point,
    size: Point,
    shades: Sequence[Shade] = (),
) -> tuple[PlotFrame, list[Mark]]:
    """Axes, curves, asymptotes and a legend, in a box below and right of a corner (the legend may make it
    higher)."""
    low, high = limits(curves, x)
    ticks = _ticks(low, high)
    texts = [figure_number(tick, 6) for tick in ticks]
    gutter = max(text_width(text, 11.0) for text in texts) + 12.0
    dead = sorted({place for curve in curves for place in poles(x, curve)})
    left = corner[0] + gutter
    legend = list(_legend(_entries(curves, dead, shades), (left, corner[1] + 4.0), size[0] - gutter))
    top = bounds(legend)[3] + 10.0
    span = (x[0], x[-1]) if x[-1] > x[0] else (x[0] - 1.0, x[0] + 1.0)
    frame = PlotFrame(left, top, corner[0] + size[0], top + size[1] - 60.0, span, (low, high))
    marks = [*_shaded(frame, shades), *_across(frame, ticks, texts), *_along(frame, x_name), *legend]
    marks += [_asymptote(frame, place) for place in dead]
    for kind, curve in zip(cycle(KINDS), curves, strict=False):
        lines = tuple(Stroke(piece, kind) for piece in pieces(frame, x, curve))
        marks.append(MarkGroup(f"curve-{curve.name}", "", lines, curve.name))
    return frame, marks


def _ticks(low: float, high: float) -> list[float]:
    """Round values between two limits."""
    raw = (high - low) / TICKS
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(m * power for m in (1.0, 2.0, 2.5, 5.0, 10.0) if m * power >= raw * 0.999)
    first = math.ceil(low / step)
    return [k * step for k in range(first, math.floor(high / step) + 1)]


def _across(frame: PlotFrame, ticks: Sequence[float], texts: Sequence[str]) -> Iterable[Mark]:
    for tick, text in zip(ticks, texts, strict=True):
        y = frame.at(frame.x[0], tick)[1]
        yield Stroke(((frame.left, y), (frame.right, y)), "faint" if tick == 0.0 else "grid")
        yield TextMark((frame.left - 6.0, y), (TextRun(text),), "t-axis", 11.0, "end")


def _along(frame: PlotFrame, x_name: str) -> Iterable[Mark]:
    first, last = frame.x
    ticks = _degrees(first, last) or _ticks(first, last)
    for tick in ticks:
        p = frame.at(tick, frame.y[0])
        yield Stroke((p, (p[0], p[1] + 5.0)), "frame")
        yield TextMark((p[0], p[1] + 14.0), (TextRun(figure_number(tick, 6)),), "t-axis", 11.0)
    corner = (frame.left, frame.bottom)
    yield Stroke(((frame.left, frame.top), corner, (frame.right, frame.bottom)), "frame")
    for n, line in enumerate(wrapped(x_name, 12.0, frame.right - frame.left)):
        at = ((frame.left + frame.right) / 2.0, frame.bottom + 33.0 + 16.0 * n)
        yield TextMark(at, (TextRun(line),), "t-axis", 12.0)


def _degrees(first: float, last: float) -> list[float]:
    """Ticks at 30, 60 or 90 where the range looks like one of degrees."""
    if not 170.0 <= last - first <= 1000.0:
        return []
    step = next((s for s in (30.0, 60.0, 90.0) if (last - first) / s <= 8.01), 180.0)
    return [k * step for k in range(math.ceil(first / step), math.floor(last / step) + 1)]


def _entries(
    curves: Sequence[PlottedCurve], dead: Sequence[float], shades: Sequence[Shade]
) -> Iterable[LegendEntry]:
    """What the legend says."""
    for kind, curve in zip(cycle(KINDS), curves, strict=False):
        unit = f", {unit_word(curve.unit)}" if curve.unit else ""
        yield LegendEntry(kind, (*name_runs(curve.name), TextRun(unit)) if unit else name_runs(curve.name))
    if dead:
        places = ", ".join(figure_number(place) for place in dead)
        words = f"dead centre at {places}" if len(dead) <= NAMED else f"{len(dead)} dead centres"
        yield LegendEntry("asymptote", (TextRun(words),))
    for words in dict.fromkeys(shade.words for shade in shades):
        yield LegendEntry("shade", (TextRun(words),))


def _legend(entries: Iterable[LegendEntry], at: Point, width: float) -> Iterable[Mark]:
    """Samples with their words in rows above the axes."""
    x, y = at
    for entry in entries:
        wide = 32.0 + sum(text_width(run.text, 12.0) for run in entry.runs)
        if x > at[0] and x + wide > at[0] + width:
            x, y = at[0], y + LINE
        if entry.kind == "shade":
            yield _box((x, y - 5.0, x + 26.0, y + 5.0))
        else:
            yield Stroke(((x, y), (x + 26.0, y)), entry.kind)
        yield TextMark((x + 32.0, y), entry.runs, "t-axis", 12.0, "start")
        x += wide + 20.0


def _box(box: tuple[float, float, float, float]) -> AreaMark:
    left, top, right, bottom = box
    return AreaMark((((left, top), (right, top), (right, bottom), (left, bottom)),), "shade")


def _shaded(frame: PlotFrame, shades: Iterable[Shade]) -> Iterable[Mark]:
    """The parts without values, a line's width at least."""
    for shade in shades:
        left, right = frame.at(shade.first, 0.0)[0], frame.at(shade.last, 0.0)[0]
        box = _box((left, frame.top, max(right, left + 1.0), frame.bottom))
        part = f"{figure_number(shade.first)} to {figure_number(shade.last)}"
        yield MarkGroup("", "", (box,), f"{shade.words}: {part}")


def _asymptote(frame: PlotFrame, place: float) -> Mark:
    at = frame.at(place, 0.0)[0]
    line = Stroke(((at, frame.top), (at, frame.bottom)), "asymptote")
    return MarkGroup("", "", (line,), f"dead centre at {figure_number(place)}")


# --- a sweep as curves -----------------------------------------------------------------------------------


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
    curves = list(_curves(found, order, x, status)) or [
        PlottedCurve("no unknown load", [math.nan] * len(x), "")
    ]
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


def _curves(
    found: Sweep, order: Sequence[int], x: Sequence[float], status: Sequence[str]
) -> Iterator[PlottedCurve]:
    """A curve an unknown; where it holds over a range, its two ends."""
    found_dead = dead_centres(found.case, found.vary)
    rows = [a for a, word in zip(x, status, strict=True) if word in DEAD]
    units = {load.name: unit_of(load, found.case) for load in found.case.loads}
    for name, column in found.answers.items():
        values = [float(column[row]) for row in order]
        if any(map(math.isfinite, values)) or name not in found.holds:
            dead = asymptotes(x, values, rows) if found_dead is None else sorted({*found_dead, *rows})
            yield PlottedCurve(name, values, units[name], dead)
        for end, words in ((0, "least"), (1, "most")) if name in found.holds else ():
            ends = [float(found.holds[name][row][end]) for row in order]
            yield PlottedCurve(f"{name}, {words} that holds", ends, units[name])


def dead_centres(case: Case, varied: Mapping[str, npt.ArrayLike]) -> list[float] | None:
    """The dead centres of the first unknown load over the range of one number (a path, or a link that is
    turned): those of ``sweep --find dead``; None where they can't be looked for."""
    from icsolve.sweep.find_on_record import Query, find
    from icsolve.sweep.request import RequestError

    driven = {name: values for name, values in varied.items() if name in case.links}
    paths = {name: values for name, values in varied.items() if name not in driven}
    unknown = next((load.name for load in case.loads if is_unknown(load)), None)
    if unknown is None:
        return []
    try:
        spots = find(case, paths, Query("dead", unknown), drive=driven)
    except (SceneError, RequestError, ArithmeticError):
        return None
    return [spot.at for spot in spots if spot.kind == "dead"]


def _shades(x: Sequence[float], status: Sequence[str]) -> Iterable[Shade]:
    """The stretches in which the links do not assemble."""
    for gone, some in groupby(range(len(x)), key=lambda n: status[n] == Status.CANNOT_ASSEMBLE):
        rows = list(some)
        if gone:
            yield Shade(x[rows[0]], x[rows[-1]], "the links do not meet")
