"""The work-precision diagram: error across, time up, one curve a method; what fails is drawn too.

Above two panels for single scenes, a mark a family: the relative error, which a bad scene spoils for
every method, and the error over (kappa + 1) u, which tells what the method itself loses. Below a full turn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from icsolve.bench.accuracy import Score
from icsolve.bench.axes import Names, Panel, around, frame, line, spread, strip_for_failures, text
from icsolve.bench.laws import FORWARD
from icsolve.bench.marks import GREY, STYLE, Style, mark, styled

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


def _curve(
    panel: Panel, measure: Measure, scores: Iterable[Score], style: Style, dashed: str = ""
) -> str:
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
