"""Logarithmic axes and panels of the work-precision diagram."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple
from xml.sax.saxutils import escape

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


