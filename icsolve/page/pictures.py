"""The pictures of a page as inline SVG: figure, circle diagram, plots, the track of the slider."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from icsolve.construction import Known, Step
from icsolve.draw.captions import description
from icsolve.draw.circle import circle_marks
from icsolve.draw.marks import Box, Mark, bounds, leaves
from icsolve.draw.svg import element, escaped, number
from icsolve.draw.words import figure_number
from icsolve.page.figure import Figure
from icsolve.page.plots import Plot

ALWAYS = frozenset(("paper", "primary", "secondary", "construction", "far", "t-centre", "plot"))
"""Classes of what the script draws."""
LARGE = 1.3
"""Pictures are shown at most so many times as large as they were measured."""


def svg(marks: Iterable[Mark], box: Box, name: str, title: str, more: str = "", largest: float = 1.0) -> str:
    """Marks as an SVG element of the page, at most so many times their size."""
    left, top, right, bottom = box
    view = " ".join(map(number, (left, top, right - left, bottom - top)))
    body = "\n".join(element(mark) for mark in marks)
    width, height = number(largest * (right - left)), number(largest * (bottom - top))
    return (
        f'<svg class="ic" id="{name}" viewBox="{view}" width="{width}" height="{height}" role="img"'
        f' aria-label="{escaped(title)}">'
        f"{more}\n{body}\n</svg>"
    )


def figure_svg(known: Known, figure: Figure) -> str:
    """The figure; what the script draws is clipped to its window."""
    left, top, right, bottom = figure.window
    width, height = number(right - left), number(bottom - top)
    clip = (
        f'<defs><clipPath id="window"><rect x="{number(left)}" y="{number(top)}" width="{width}"'
        f' height="{height}"/></clipPath></defs>'
    )
    return svg(figure.marks, figure.window, "figure", description(known), clip, LARGE)


def still_svg(known: Known) -> tuple[str, tuple[Mark, ...]]:
    """The figure of a case in space."""
    from icsolve.draw.space import space_marks

    _, marks = space_marks(known)
    left, top, right, bottom = bounds(marks)
    box = (left - 10.0, top - 10.0, right + 10.0, bottom + 10.0)
    return svg(marks, box, "figure", description(known)), tuple(marks)


def circle_svg(known: Known, steps: Sequence[Step]) -> tuple[str, tuple[Mark, ...]]:
    """The Kennedy circle diagram, with the triangles of every step."""
    marks = tuple(circle_marks(known, steps, (0.0, 0.0), each=True))
    left, top, right, bottom = bounds(marks)
    box = (left - 4.0, top - 4.0, right + 4.0, bottom + 4.0)
    title = "Kennedy circle diagram: the links, and a chord for every centre that is known"
    return svg(marks, box, "circle-figure", title, largest=1.1), marks


def plot_svg(plot: Plot, n: int) -> str:
    """A plot with its cursor."""
    names = ", ".join(curve.name for curve in plot.curves)
    dots = "".join('<circle class="cursor-dot" r="4"/>' for _ in plot.curves)
    title = f"{plot.heading}: {names} over the range of the input"
    text = svg(plot.marks, plot.view, f"plot-{n}", title, largest=LARGE)
    return text.removesuffix("</svg>") + f'<path class="cursor" d=""/>{dots}</svg>'


def track_svg(motion: dict[str, Any]) -> str:
    """The range of the input under the slider: where it can be, dead centres, where the links do not meet."""
    low, high = motion["low"], motion["high"]
    first, last = motion["first"], motion["first"] + motion["step"] * (motion["rows"] - 1)

    def share(degrees: float) -> str:
        return number(100.0 * (degrees - low) / (high - low)) + "%"

    def bar(kind: str, start: float, end: float) -> str:
        width = number(100.0 * (end - start) / (high - low))
        return f'<rect class="{kind}" x="{share(start)}" y="2" width="{width}%" height="10"/>'

    gaps = [bar("gap", a, b) for a, b in ((low, first), (last, high)) if b - a > 1e-9]
    dead = [f'<line class="dead" x1="{share(d)}" x2="{share(d)}" y1="0" y2="14"/>' for d in motion["dead"]]
    ticks = []
    for degrees in _ticks(low, high) if motion["verb"] == "turned" else _quarters(low, high):
        x = share(degrees)
        anchor = "start" if degrees == low else "end" if degrees == high else "middle"
        ticks.append(f'<line class="tick" x1="{x}" x2="{x}" y1="12" y2="17"/>')
        told = escaped(figure_number(degrees) + motion["unit"])
        ticks.append(f'<text x="{x}" y="28" text-anchor="{anchor}">{told}</text>')
    hatch = (
        '<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse"'
        ' patternTransform="rotate(45)"><path class="hatch" d="M0,0 V6"/></pattern></defs>'
    )
    parts = "".join((hatch, bar("bar", first, last), *gaps, *dead, *ticks))
    return f'<svg class="track" width="100%" height="32" aria-hidden="true">{parts}</svg>'


def _ticks(low: float, high: float) -> list[float]:
    """Four to nine round numbers of degrees."""
    step = next(
        s
        for s in (90.0, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5)
        if (high - low) / s >= 3.99 or s == 0.5
    )
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def _quarters(low: float, high: float) -> list[float]:
    """A way in four equal parts."""
    return [low, low + 0.25 * (high - low), 0.5 * (low + high), high - 0.25 * (high - low), high]


def kinds_of(marks: Iterable[Mark]) -> frozenset[str]:
    """The classes that marks need rules for."""
    return frozenset(name for mark in leaves(marks) for name in mark.kind.split())
