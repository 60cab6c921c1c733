"""The work-precision diagram: error across, time up, one curve a method; what fails is drawn too.

Above two panels for single scenes, a mark a family: the relative error, which a bad scene spoils for
every method, and the error over (kappa + 1) u, which tells what the method itself loses. Below a full turn.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle
from xml.sax.saxutils import escape

from icsolve.bench.accuracy import FORWARD, Score
from icsolve.tuples import NamedTuple

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
STRIP = 104.0
"""Width at the right of a panel where scenes without an answer are drawn."""


class Log(NamedTuple):
    """A range of powers of ten; what lies outside is drawn at its edge."""

    low: int
    high: int

    def share(self, value: float) -> float:
        """Where a value lies, from 0 to 1."""
        power = math.log10(value) if value > 0.0 else self.low
        return min(max((power - self.low) / (self.high - self.low), 0.0), 1.0)


def around(values: Iterable[float]) -> Log:
    """The powers of ten that enclose values; nan and zero do not count."""
    powers = [math.log10(value) for value in values if 0.0 < value < math.inf]
    low, high = math.floor(min(powers, default=0.0)), math.ceil(max(powers, default=1.0))
    return Log(low, max(high, low + 1))


class Panel(NamedTuple):
    """A rectangle with its two axes; with ``strip`` its right end is for scenes without an answer."""

    x: float
    y: float
    width: float
    height: float
    across: Log
    up: Log
    strip: float = STRIP

    def place(self, error: float, micros: float) -> tuple[float, float]:
        """Where a mark of this error and time goes."""
        return self.x + self.across.share(error) * (self.width - self.strip), self.level(micros)

    def level(self, micros: float) -> float:
        """How high a time is."""
        return self.y + (1.0 - self.up.share(micros)) * self.height


class Names(NamedTuple):
    """Words about a panel: its title, those of its axes, and every how many powers of ten has a label."""

    title: str
    across: str
    up: str
    every: int


def frame(panel: Panel, names: Names) -> Iterator[str]:
    """Border, grid, tick labels, title and the names of the axes."""
    x, y, w, h = panel.x, panel.y, panel.width, panel.height
    yield text(x, y - 14, names.title, kind="head")
    yield f'<rect class="box" x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}"/>'
    for power in range(panel.across.low, panel.across.high + 1):
        if power % names.every == 0:
            at = panel.place(10.0**power, 1.0)[0]
            yield line(at, y, at, y + h, "grid")
            yield text(at, y + h + 18, exponent(power), "middle")
    for power in range(panel.up.low, panel.up.high + 1):
        at = panel.level(10.0**power)
        yield line(x, at, x + w - panel.strip, at, "grid")
        yield text(x - 7, at + 4, duration(power), "end")
    yield text(x + (w - panel.strip) / 2.0, y + h + 40, names.across, "middle")
    upward = f"translate({x - 60:g} {y + h / 2.0:g}) rotate(-90)"
    yield f'<g transform="{upward}">{text(0, 0, names.up, "middle")}</g>'


def strip_for_failures(panel: Panel) -> Iterator[str]:
    """The right end of a panel, where scenes without an answer are drawn."""
    edge, bottom = panel.x + panel.width - panel.strip, panel.y + panel.height
    yield line(edge, panel.y, edge, bottom, "edge")
    yield text(edge + panel.strip / 2.0, bottom + 18, "no answer", "middle")


def exponent(power: int) -> str:
    """A power of ten."""
    return "1" if power == 0 else "10" + str(power).translate(SUPERSCRIPT)


def duration(power: int) -> str:
    """A power of ten of microseconds, in the unit that suits it."""
    units = ("ns", "µs", "ms", "s")
    return f"{10 ** (power % 3)} {units[power // 3 + 1]}"


def text(x: float, y: float, words: str, anchor: str = "start", kind: str = "") -> str:
    """Words at a place."""
    named = f' class="{kind}"' if kind else ""
    return f'<text{named} x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(words)}</text>'


def line(x1: float, y1: float, x2: float, y2: float, kind: str) -> str:
    """A straight line."""
    return f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>'


def spread(heights: list[float], apart: float, low: float, high: float) -> list[float]:
    """Heights moved as little as need be to be some distance apart and between two limits.

    They come in rising order and stay in it.
    """
    result: list[float] = []
    for height in heights:
        result.append(max(height, result[-1] + apart if result else low))
    over = high
    for k in reversed(range(len(result))):
        result[k] = min(result[k], over)
        over = result[k] - apart
    return result


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


WIDTH, HEIGHT = 1080.0, 985.0
LEFT, RIGHT = 92.0, 622.0
ABOVE, BELOW = 96.0, 568.0
SIZE = (434.0, 330.0)
LARGE = "chain"
"""Families of long mechanisms, whose time is that of their length: a curve of their own, dashed."""
TITLE = "Run time against error: one curve a method, one mark a family of scenes"
SCENE, POSITION = "median time of a scene, warm", "time of one position"


class Measure(NamedTuple):
    """What is drawn across: its words, and whether it is the error over (kappa + 1) u."""

    names: Names
    per_unit: bool

    def of(self, score: Score) -> float:
        """The worst error of a family."""
        return score.per_unit if self.per_unit else score.error


RELATIVE = Measure(
    Names("One scene: error of the answer", "worst relative error of a family", SCENE, 4), False
)
LOSS = Measure(
    Names("One scene: what the method loses", "worst error / ((κ + 1) u) of a family", SCENE, 4), True
)
TURN = Measure(
    Names("A full turn of 3600 positions", "worst relative error of the torque", POSITION, 1), False
)


def picture(scenes: Sequence[Score], turns: Sequence[Score], absent: Sequence[str]) -> str:
    """The SVG: scores of methods on families of single scenes, of full turns, and what did not run."""
    styles = styled(dict.fromkeys(score.method for score in scenes if score.scenes))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" '
        'font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="13">',
        STYLE,
        f'<rect class="paper" width="{WIDTH:g}" height="{HEIGHT:g}"/>',
        text(24, 36, TITLE, kind="title"),
        *_scenes(LEFT, RELATIVE, scenes, styles),
        *_scenes(RIGHT, LOSS, scenes, styles),
        *_turns(turns),
        *_legend(styles, scenes, absent),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


# --- single scenes ---------------------------------------------------------------------------------


def _scenes(x: float, measure: Measure, scores: Sequence[Score], styles: dict[str, Style]) -> Iterator[str]:
    panel = Panel(x, ABOVE, *SIZE, around(measure.of(s) for s in scores), around(s.micros for s in scores))
    yield from frame(panel, measure.names)
    yield from strip_for_failures(panel)
    if measure.per_unit:
        at = panel.place(FORWARD, 1.0)[0]
        yield line(at, ABOVE, at, ABOVE + SIZE[1], "limit")
        yield text(at + 6, ABOVE + 18, f"promised: at most {FORWARD:g}", kind="note")
    for n, (method, style) in reversed(list(enumerate(styles.items()))):
        own = sorted(
            (s for s in scores if s.method == method and s.scenes), key=lambda s: (measure.of(s), s.micros)
        )
        found = [s for s in own if measure.of(s) >= 0.0]
        long = [s for s in found if LARGE in s.family]
        yield _curve(panel, measure, [s for s in found if s not in long], style)
        yield _curve(panel, measure, long, style, ' stroke-dasharray="3 3"')
        for score in found:
            yield mark(style, *panel.place(measure.of(score), score.micros), _said(score, measure))
        yield from _lost(panel, (n + 0.5) / len(styles), own, style, measure)


def _curve(panel: Panel, measure: Measure, scores: Iterable[Score], style: Style, dashed: str = "") -> str:
    points = " ".join("{:.1f},{:.1f}".format(*panel.place(measure.of(s), s.micros)) for s in scores)
    return (
        f'<polyline points="{points}" fill="none" stroke="{style.colour}" stroke-width="{style.width:g}" '
        f'stroke-opacity="0.5"{dashed}/>'
    )


def _lost(
    panel: Panel, share: float, scores: Iterable[Score], style: Style, measure: Measure
) -> Iterator[str]:
    """A cross for a family with failures, a ring for one with refusals, in the method's own column."""
    x = panel.x + panel.width - panel.strip * (1.0 - share)
    for score in scores:
        y = panel.level(score.micros)
        if score.failed:
            yield mark(style._replace(shape="cross"), x, y, _said(score, measure))
        if score.refused:
            yield mark(style._replace(shape="ring"), x, y, _said(score, measure))


def _said(score: Score, measure: Measure) -> str:
    parts = [f"{score.method}, {score.family}: error {measure.of(score):.2g}, {score.micros:.3g} µs"]
    parts += [f"{score.failed} of {score.scenes} without an answer"] if score.failed else []
    parts += [f"{score.refused} of {score.scenes} refused"] if score.refused else []
    return "; ".join(parts)


# --- a full turn -----------------------------------------------------------------------------------

End = tuple[str, float, float]
"""A method and the last mark of its curve."""
LABELS = 178.0
"""Width of the names at the right of the lower panel."""
KINDS = ("disc", "square", "triangle")


def _turns(scores: Sequence[Score]) -> Iterator[str]:
    """Marks by mechanism, each curve with its name."""
    if not scores:
        return
    across, up = around(s.error for s in scores), around(s.micros for s in scores)
    panel = Panel(LEFT, BELOW, *SIZE, across, up, LABELS)
    yield from frame(panel, TURN.names)
    styles = styled(dict.fromkeys(s.method for s in scores), GREY)
    shapes = dict(zip(dict.fromkeys(s.family for s in scores), KINDS, strict=False))
    ends: list[End] = []
    for method, style in styles.items():
        own = sorted((s for s in scores if s.method == method), key=lambda s: (s.micros, s.error))
        yield _curve(panel, TURN, own, style)
        for score in own:
            shaped = style._replace(shape=shapes.get(score.family, "disc"))
            yield mark(shaped, *panel.place(score.error, score.micros), _said(score, TURN))
        ends.append((method, *max(panel.place(s.error, s.micros) for s in own)))
    yield from _labels(panel, ends, styles)
    for k, (family, shape) in enumerate(shapes.items()):
        x, y = LEFT + 140.0 * k, BELOW + SIZE[1] + 66.0
        yield mark(Style(GREY[0], shape, 4.5, 1.0), x + 6, y - 4, family)
        yield text(x + 18, y, family)


def _labels(panel: Panel, ends: Iterable[End], styles: dict[str, Style]) -> Iterator[str]:
    """The name of each curve in a column at the right, tied to its last mark."""
    by_height = sorted(ends, key=lambda end: end[2])
    heights = spread([y for _, _, y in by_height], 17.0, panel.y + 12, panel.y + panel.height - 8)
    column = panel.x + panel.width - panel.strip + 18
    for (method, x, y), height in zip(by_height, heights, strict=True):
        colour = styles[method].colour
        yield f'<path d="M{x + 7:.1f} {y:.1f}L{column - 5:.1f} {height:.1f}" stroke="{colour}" class="tie"/>'
        yield text(column, height + 4, method)


# --- what the marks mean ---------------------------------------------------------------------------

READING = (
    "Further left is more accurate, further down is faster.",
    "×  a family with scenes that the method does not solve, or gets",
    "\u2003 wrong by more than 10 %, in the method's own column",
    "○  a family with scenes that are refused, with the cause",
    "Dashed: long chains, of 12 and of 50 four-bars.",
    "κ: sensitivity of the scene itself; u = 2⁻⁵³. An error of about",
    "(κ + 1) u is the best that a method can promise. Truth: 60 digits.",
)


def _legend(styles: dict[str, Style], scenes: Sequence[Score], absent: Sequence[str]) -> Iterator[str]:
    yield text(RIGHT, BELOW - 14, "One scene: the methods", kind="head")
    y = BELOW + 14
    for n, (method, style) in enumerate(styles.items()):
        x, y = RIGHT + 8 + 220.0 * (n % 2), BELOW + 14 + 24.0 * (n // 2)
        yield mark(style, x, y - 4, method)
        yield text(x + 16, y, method)
    families = len({score.family for score in scenes})
    count = max((s.scenes for s in scenes), default=0)
    lines = [f"{families} families of up to {count} random scenes each.", *READING]
    lines += [f"Not in the full turn: {words}." for words in absent]
    for k, words in enumerate(lines):
        yield text(RIGHT, y + 38 + 21.0 * k, words, kind="note")
