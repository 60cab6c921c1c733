"""The pictures of a page as inline SVG: figure, circle diagram, plots, the track of the slider."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from icsolve.construction import Known, Step
from icsolve.draw.captions import description
from icsolve.draw.circle import circle_marks
from icsolve.draw.marks import Box, Mark, bounds, leaves
from icsolve.draw.svg import element, escaped, number
from icsolve.page.figure import Figure
from icsolve.page.plots import Plot

ALWAYS = frozenset(("paper", "primary", "secondary", "construction", "far", "t-centre", "plot"))
"""Classes of what the script draws."""


def svg(marks: Iterable[Mark], box: Box, name: str, title: str, more: str = "") -> str:
    """Marks as an SVG element of the page."""
    left, top, right, bottom = box
    view = " ".join(map(number, (left, top, right - left, bottom - top)))
    body = "\n".join(element(mark) for mark in marks)
    return (
        f'<svg class="ic" id="{name}" viewBox="{view}" role="img" aria-label="{escaped(title)}">'
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
    return svg(figure.marks, figure.window, "figure", description(known), clip)


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
    return svg(marks, box, "circle-figure", title), marks


def plot_svg(plot: Plot, n: int) -> str:
    """A plot with its cursor."""
    names = ", ".join(curve.name for curve in plot.curves)
    dots = "".join('<circle class="cursor-dot" r="4"/>' for _ in plot.curves)
    text = svg(plot.marks, plot.view, f"plot-{n}", f"{plot.heading}: {names} over the range of the input")
    return text.removesuffix("</svg>") + f'<path class="cursor" d=""/>{dots}</svg>'


def track_svg(motion: dict[str, Any]) -> str:
    """The range of the input under the slider: where it can be, dead centres, where the links do not meet."""
    low, high = motion["low"], motion["high"]
    first, last = motion["first"], motion["first"] + motion["step"] * (motion["rows"] - 1)

    def x(degrees: float) -> str:
        return number(1000.0 * (degrees - low) / (high - low))

    parts = [_bar("gap", x(low), x(first)), _bar("bar", x(first), x(last)), _bar("gap", x(last), x(high))]
    parts += [f'<path class="dead" d="M{x(d)},0 V16"/>' for d in motion["dead"]]
    hatch = (
        '<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse"'
        ' patternTransform="rotate(45)">'
        '<path class="hatch" d="M0,0 V6"/></pattern></defs>'
    )
    return (
        '<svg class="track" viewBox="0 0 1000 16" preserveAspectRatio="none" aria-hidden="true">'
        f"{hatch}{''.join(parts)}</svg>"
    )


def _bar(kind: str, start: str, end: str) -> str:
    width = float(end) - float(start)
    if width <= 0.5:
        return ""
    return f'<rect class="{kind}" x="{start}" y="3" width="{number(width)}" height="10"/>'


def kinds_of(marks: Iterable[Mark]) -> frozenset[str]:
    """The classes that marks need rules for."""
    return frozenset(name for mark in leaves(marks) for name in mark.kind.split())
