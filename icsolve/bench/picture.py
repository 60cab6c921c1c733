"""The work-precision diagram: error on x, time on y, one curve a method, failures drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from html import escape
from statistics import median
from typing import NamedTuple

from icsolve.bench.accuracy import Score
from icsolve.bench.laws import FORWARD

COLOURS = (
    "#0072b2", "#004c80", "#d55e00", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#666666", "#a6761d",
    "#7b3294", "#c2a5cf", "#111111", "#b2182b",
)  # fmt: skip
WIDTH, HEIGHT, LEFT, TOP, GAP = 430.0, 360.0, 60.0, 50.0, 90.0
TIMES = (-2.0, 6.0)
"""log10 of the microseconds at the bottom and at the top."""


class Axis(NamedTuple):
    """A panel's x: what of a score it shows, its name, log10 of its ends, and a limit to be drawn."""

    of: Callable[[Score], float]
    name: str
    low: float
    high: float
    limit: float | None = None


PANELS = (
    Axis(lambda score: score.error, "worst relative error of a family", -17.0, 1.0),
    Axis(lambda score: score.per_unit, "worst error over (kappa + 1) u", -3.0, 15.0, FORWARD),
)


def picture(scores: Iterable[Score]) -> str:
    """The diagram as SVG; a family on which a method fails stands in the column at the right."""
    by_method: dict[str, list[Score]] = {}
    for score in scores:
        by_method.setdefault(score.method, []).append(score)
    width = 2 * (LEFT + WIDTH + GAP)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {TOP + HEIGHT + 150:g}" '
        'font-family="sans-serif" font-size="12">',
        '<rect width="100%" height="100%" fill="white"/>',
        _text(LEFT, 24, "Run time of a scene against error: one mark a family, one curve a method", size=15),
    ]
    for n, axis in enumerate(PANELS):
        parts += _panel(LEFT + n * (LEFT + WIDTH + GAP), axis, by_method)
    parts += _legend(by_method)
    return "\n".join([*parts, "</svg>\n"])


def _panel(left: float, axis: Axis, by_method: dict[str, list[Score]]) -> list[str]:
    bottom = TOP + HEIGHT
    size = f'width="{WIDTH + 60:g}" height="{HEIGHT:g}"'
    parts = [f'<rect x="{left:g}" y="{TOP:g}" {size} fill="none" stroke="#999"/>']
    for power in range(int(axis.low), int(axis.high), 2):
        x = left + _share(axis, 10.0**power) * WIDTH
        parts.append(f'<path d="M{x:.1f} {TOP:g}V{bottom:g}" stroke="#eee"/>')
        parts.append(_text(x, bottom + 16, f"1e{power}", "middle"))
    for power in range(int(TIMES[0]), int(TIMES[1]) + 1):
        y = _height(10.0**power)
        parts.append(f'<path d="M{left:g} {y:.1f}h{WIDTH + 60:g}" stroke="#eee"/>')
        parts.append(_text(left - 6, y + 4, _duration(power), "end"))
    parts.append(f'<path d="M{left + WIDTH:g} {TOP:g}v{HEIGHT:g}" stroke="#999" stroke-dasharray="4 3"/>')
    parts.append(_text(left + WIDTH + 30, bottom + 16, "no answer", "middle"))
    if axis.limit is not None:
        x = left + _share(axis, axis.limit) * WIDTH
        parts.append(f'<path d="M{x:.1f} {TOP:g}v{HEIGHT:g}" stroke="#0072b2" stroke-dasharray="2 3"/>')
        parts.append(_text(x + 4, TOP + 14, f"the law: {axis.limit:g}"))
    parts.append(_text(left + WIDTH / 2, bottom + 36, axis.name, "middle"))
    for colour, scores in zip(COLOURS, by_method.values(), strict=False):
        parts += _curve(left, axis, scores, colour)
    return parts


def _curve(left: float, axis: Axis, scores: Sequence[Score], colour: str) -> list[str]:
    """Families by their error, and those with failures beyond the dashed line."""
    solved = sorted((s for s in scores if axis.of(s) >= 0.0 and s.micros > 0.0), key=axis.of)
    places = [(left + _share(axis, axis.of(s)) * WIDTH, _height(s.micros), s) for s in solved]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y, _ in places)
    parts = [f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-opacity="0.3"/>']
    for x, y, score in places:
        r = 4 if score.method.startswith("icsolve") else 2.5
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" fill="{colour}">{_title(score)}</circle>')
    usual = median([s.micros for s in scores if s.micros > 0.0] or [10.0 ** TIMES[0]])
    for n, score in enumerate(s for s in scores if s.failed):
        x, y = left + WIDTH + 8 + 11 * (n % 5), _height(usual) - 10 * (n // 5)
        parts.append(
            f'<path d="M{x - 3:.1f} {y - 3:.1f}l6 6m0 -6l-6 6" stroke="{colour}" stroke-width="1.6">'
            f"{_title(score)}</path>"
        )
    return parts


def _title(score: Score) -> str:
    failed = f", {score.failed} of {score.scenes} without an answer" if score.failed else ""
    words = f"{score.method}, {score.family}: error {score.error:.1e}, {score.micros:.3g} us{failed}"
    return f"<title>{escape(words)}</title>"


def _legend(methods: Iterable[str]) -> list[str]:
    parts = []
    for n, (colour, method) in enumerate(zip(COLOURS, methods, strict=False)):
        x, y = LEFT + 220.0 * (n % 5), TOP + HEIGHT + 64.0 + 22.0 * (n // 5)
        parts.append(f'<circle cx="{x:g}" cy="{y - 4:g}" r="5" fill="{colour}"/>')
        parts.append(_text(x + 12, y, method))
    parts.append(
        _text(LEFT, TOP + HEIGHT + 124, "A cross: a family with scenes that the method does not solve.")
    )
    return parts


def _share(axis: Axis, value: float) -> float:
    """Where a value stands along an axis, from 0 to 1."""
    power = math.log10(max(value, 1e-300))
    return (min(max(power, axis.low), axis.high) - axis.low) / (axis.high - axis.low)


def _height(micros: float) -> float:
    low, high = TIMES
    return TOP + HEIGHT * (1.0 - (min(max(math.log10(micros), low), high) - low) / (high - low))


def _duration(power: int) -> str:
    return f"{10 ** (power % 3)} {('ns', 'us', 'ms', 's')[power // 3 + 1]}"


def _text(x: float, y: float, words: str, anchor: str = "start", size: int = 12) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}">{escape(words)}</text>'
