"""Curves over a range as a picture: gaps where there is no value, dead centres as asymptotes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from icsolve.draw.curves import Curve, Frame, asymptotes, limits, pieces
from icsolve.draw.marks import Area, Group, Mark, Point, Run, Stroke, Text, bounds, text_width
from icsolve.draw.svg import document
from icsolve.draw.words import figure_number, name_runs, unit_word, wrapped

__all__ = ["Curve", "Frame", "Shade", "asymptotes", "plot_marks", "plot_svg"]

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


class Entry(NamedTuple):
    """A line of the legend: a sample (of a line, or of a shade) and what it is."""

    kind: str
    runs: tuple[Run, ...]


def plot_svg(
    x: Sequence[float], curves: Sequence[Curve], x_name: str, title: str, shades: Sequence[Shade] = ()
) -> str:
    """Curves over ``x`` (at least one value) as an SVG document; curves of one unit share their axis."""
    marks: list[Mark] = [
        Text((0.0, 21.0 * n), (Run(line),), "t-title", 16.0, "start")
        for n, line in enumerate(wrapped(title, 16.0, WIDTH))
    ]
    top = bounds(marks)[3] + 18.0
    for unit in dict.fromkeys(curve.unit for curve in curves):
        some = [curve for curve in curves if curve.unit == unit]
        _, drawn = plot_marks(x, some, x_name, (0.0, top), (WIDTH, HEIGHT), shades)
        marks += drawn
        top = bounds(marks)[3] + 24.0
    left, upper, right, lower = bounds(marks)
    view = (left - 14.0, upper - 14.0, right + 14.0, lower + 14.0)
    names = ", ".join(curve.name for curve in curves)
    return document(marks, view, title or names, f"{names} over {x_name}.")


def plot_marks(
    x: Sequence[float],
    curves: Sequence[Curve],
    x_name: str,
    corner: Point,
    size: Point,
    shades: Sequence[Shade] = (),
) -> tuple[Frame, list[Mark]]:
    """Axes, curves, asymptotes and a legend, in a box below and right of a corner (the legend may make it
    higher)."""
    low, high = limits(curves, x)
    ticks = _ticks(low, high)
    texts = [figure_number(tick, 6) for tick in ticks]
    gutter = max(text_width(text, 11.0) for text in texts) + 12.0
    dead = sorted({place for curve in curves for place in asymptotes(x, curve.values, curve.dead)})
    left = corner[0] + gutter
    legend = list(_legend(_entries(curves, dead, shades), (left, corner[1] + 4.0), size[0] - gutter))
    top = bounds(legend)[3] + 10.0
    span = (x[0], x[-1]) if x[-1] > x[0] else (x[0] - 1.0, x[0] + 1.0)
    frame = Frame(left, top, corner[0] + size[0], top + size[1] - 60.0, span, (low, high))
    marks = [*_shaded(frame, shades), *_across(frame, ticks, texts), *_along(frame, x_name), *legend]
    marks += [_asymptote(frame, place) for place in dead]
    for kind, curve in zip(_kinds(), curves, strict=False):
        lines = tuple(Stroke(piece, kind) for piece in pieces(frame, x, curve))
        marks.append(Group(f"curve-{curve.name}", "", lines, curve.name))
    return frame, marks


def _kinds() -> Iterator[str]:
    while True:
        yield from KINDS


def _ticks(low: float, high: float) -> list[float]:
    """Round values between two limits."""
    raw = (high - low) / TICKS
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(m * power for m in (1.0, 2.0, 2.5, 5.0, 10.0) if m * power >= raw * 0.999)
    first = math.ceil(low / step)
    return [k * step for k in range(first, math.floor(high / step) + 1)]


def _across(frame: Frame, ticks: Sequence[float], texts: Sequence[str]) -> Iterable[Mark]:
    for tick, text in zip(ticks, texts, strict=True):
        y = frame.at(frame.x[0], tick)[1]
        yield Stroke(((frame.left, y), (frame.right, y)), "faint" if tick == 0.0 else "grid")
        yield Text((frame.left - 6.0, y), (Run(text),), "t-axis", 11.0, "end")


def _along(frame: Frame, x_name: str) -> Iterable[Mark]:
    first, last = frame.x
    ticks = _degrees(first, last) or _ticks(first, last)
    for tick in ticks:
        p = frame.at(tick, frame.y[0])
        yield Stroke((p, (p[0], p[1] + 5.0)), "frame")
        yield Text((p[0], p[1] + 14.0), (Run(figure_number(tick, 6)),), "t-axis", 11.0)
    corner = (frame.left, frame.bottom)
    yield Stroke(((frame.left, frame.top), corner, (frame.right, frame.bottom)), "frame")
    for n, line in enumerate(wrapped(x_name, 12.0, frame.right - frame.left)):
        at = ((frame.left + frame.right) / 2.0, frame.bottom + 33.0 + 16.0 * n)
        yield Text(at, (Run(line),), "t-axis", 12.0)


def _degrees(first: float, last: float) -> list[float]:
    """Ticks at 30, 60 or 90 where the range looks like one of degrees."""
    if not 170.0 <= last - first <= 1000.0:
        return []
    step = next((s for s in (30.0, 60.0, 90.0) if (last - first) / s <= 8.01), 180.0)
    return [k * step for k in range(math.ceil(first / step), math.floor(last / step) + 1)]


def _entries(curves: Sequence[Curve], dead: Sequence[float], shades: Sequence[Shade]) -> Iterable[Entry]:
    """What the legend says."""
    for kind, curve in zip(_kinds(), curves, strict=False):
        unit = f", {unit_word(curve.unit)}" if curve.unit else ""
        yield Entry(kind, (*name_runs(curve.name), Run(unit)) if unit else name_runs(curve.name))
    if dead:
        places = ", ".join(figure_number(place) for place in dead)
        words = f"dead centre at {places}" if len(dead) <= NAMED else f"{len(dead)} dead centres"
        yield Entry("asymptote", (Run(words),))
    for words in dict.fromkeys(shade.words for shade in shades):
        yield Entry("shade", (Run(words),))


def _legend(entries: Iterable[Entry], at: Point, width: float) -> Iterable[Mark]:
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
        yield Text((x + 32.0, y), entry.runs, "t-axis", 12.0, "start")
        x += wide + 20.0


def _box(box: tuple[float, float, float, float]) -> Area:
    left, top, right, bottom = box
    return Area((((left, top), (right, top), (right, bottom), (left, bottom)),), "shade")


def _shaded(frame: Frame, shades: Iterable[Shade]) -> Iterable[Mark]:
    """The parts without values, a line's width at least."""
    for shade in shades:
        left, right = frame.at(shade.first, 0.0)[0], frame.at(shade.last, 0.0)[0]
        box = _box((left, frame.top, max(right, left + 1.0), frame.bottom))
        part = f"{figure_number(shade.first)} to {figure_number(shade.last)}"
        yield Group("", "", (box,), f"{shade.words}: {part}")


def _asymptote(frame: Frame, place: float) -> Mark:
    at = frame.at(place, 0.0)[0]
    line = Stroke(((at, frame.top), (at, frame.bottom)), "asymptote")
    return Group("", "", (line,), f"dead centre at {figure_number(place)}")
