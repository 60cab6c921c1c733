"""Colours and shapes of the methods in the work-precision diagram, for light and dark pages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import cycle
from typing import NamedTuple
from xml.sax.saxutils import escape


class Style(NamedTuple):
    """How a method is drawn; our own are larger."""

    colour: str
    shape: str
    size: float
    width: float


PALETTE = ("#d55e00", "#e69f00", "#a0761a", "#cc79a7", "#009e73", "#7f7f7f", "#b04a5a", "#6a8f2f")
"""Told apart by the colour-blind, and seen on white and on black (after Okabe and Ito)."""
GREY = ("#838c96",)
"""Where each curve bears its name."""
OWN = ("#0072d6", "#4db3f0")
SHAPES = ("triangle", "square", "diamond", "nabla", "plus", "bar", "star", "square")

STYLE = """\
<style>
.paper { fill: #ffffff } text { fill: #24292f } .title { font-size: 18px; font-weight: bold }
.head { font-size: 15px; font-weight: bold } .note { fill: #57606a }
.box { fill: none; stroke: #8c959f } .grid { stroke: #8c959f; stroke-opacity: 0.22 }
.edge { stroke: #8c959f; stroke-dasharray: 4 3 } .limit { stroke: #0072d6; stroke-dasharray: 2 3 }
.tie { fill: none; stroke-opacity: 0.5 }
@media (prefers-color-scheme: dark) {
  .paper { fill: #0d1117 } text { fill: #e6edf3 } .note { fill: #9da7b3 }
}
</style>"""


def styled(methods: Iterable[str], palette: Sequence[str] = PALETTE) -> dict[str, Style]:
    """A style for every method; those of icsolve are blue and larger."""
    result: dict[str, Style] = {}
    blues, others, shapes = cycle(OWN), cycle(palette), cycle(SHAPES)
    for method in methods:
        own = method.startswith("icsolve")
        ours = Style(next(blues), "disc", 5.0, 2.2) if own else None
        result[method] = ours or Style(next(others), next(shapes), 4.0, 1.2)
    return result


def mark(style: Style, x: float, y: float, said: str) -> str:
    """A mark whose words a pointer on it shows."""
    return f'<g transform="translate({x:.1f} {y:.1f})">{_shape(style)}<title>{escape(said)}</title></g>'


def _shape(style: Style) -> str:
    r = style.size
    filled, drawn = f'fill="{style.colour}"', f'fill="none" stroke="{style.colour}" stroke-width="2"'
    paths = {
        "triangle": (f"M0 {-1.2 * r:g}L{1.1 * r:g} {0.8 * r:g}H{-1.1 * r:g}Z", filled),
        "nabla": (f"M0 {1.2 * r:g}L{1.1 * r:g} {-0.8 * r:g}H{-1.1 * r:g}Z", filled),
        "square": (f"M{-0.9 * r:g} {-0.9 * r:g}H{0.9 * r:g}V{0.9 * r:g}H{-0.9 * r:g}Z", filled),
        "diamond": (f"M0 {-1.3 * r:g}L{1.3 * r:g} 0L0 {1.3 * r:g}L{-1.3 * r:g} 0Z", filled),
        "plus": (f"M{-r:g} 0H{r:g}M0 {-r:g}V{r:g}", drawn),
        "bar": (f"M{-r:g} 0H{r:g}", drawn.replace('"2"', '"4"')),
        "star": (f"M{-r:g} 0H{r:g}M{-0.5 * r:g} {-0.9 * r:g}L{0.5 * r:g} {0.9 * r:g}"
                 f"M{0.5 * r:g} {-0.9 * r:g}L{-0.5 * r:g} {0.9 * r:g}", drawn),
        "cross": (f"M{-r:g} {-r:g}L{r:g} {r:g}M{r:g} {-r:g}L{-r:g} {r:g}", drawn),
    }  # fmt: skip
    if style.shape in paths:
        d, how = paths[style.shape]
        return f'<path d="{d}" {how}/>'
    return f'<circle r="{r:g}" {drawn if style.shape == "ring" else filled}/>'
