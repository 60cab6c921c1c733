"""The histogram of a question's answers as SVG: over the right one, with the known wrong ones marked."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from icsolve.grade.tally import BINS, Counts

_WIDTH, _HEIGHT, _HEAD, _FOOT = 720.0, 160.0, 16.0, 20.0
_ROW = 13.0
_LETTER = 6.4
"""Width of a letter of a label, at most."""
_MOST_MARKS = 12
_BINS = [*range(-BINS - 1, 0), *range(1, BINS + 2)]
_STEP = _WIDTH / len(_BINS)

Marks = tuple[tuple[str, float], ...]
"""Codes with their wrong answers over the right one."""


def histogram(counts: Counts, marks: Marks) -> str:
    """Answers over the right one, from -2 to 2, what lies beyond at the ends."""
    most = max(counts.bins.values())
    bars = "".join(_bar(k, i * _STEP, counts.bins.get(k, 0), most) for i, k in enumerate(_BINS))
    labels, rows = _labels(marks)
    right = f"{_x(1.0):.1f}"
    foot = _HEAD + _HEIGHT
    good = f'<line class="good" x1="{right}" x2="{right}" y1="{_HEAD - 4:.0f}" y2="{foot:.0f}"/>'
    told = f'<text x="{right}" y="{_HEAD - 6:.0f}" text-anchor="middle">right</text>'
    height = foot + _FOOT + _ROW * rows + 18.0
    said = "Answers as multiples of the right one; the grey bars at the ends hold what lies beyond."
    end = f'<text x="0" y="{height - 4:.0f}">{said}</text>'
    head = f'<svg viewBox="0 0 {_WIDTH:.0f} {height:.0f}" role="img" aria-label="{_in_words(counts)}">'
    return f"{head}{bars}{good}{told}{labels}{_axis()}{end}</svg>"


def _in_words(counts: Counts) -> str:
    total = sum(counts.bins.values())
    beyond = counts.bins.get(BINS + 1, 0) + counts.bins.get(-BINS - 1, 0)
    about = sum(n for k, n in counts.bins.items() if k in (BINS // 2, BINS // 2 + 1))
    near = f"{about} within 10 % of the right one"
    return f"Histogram of {total} answers: {near}, {beyond} beyond twice its size"


def _bar(k: int, x: float, count: int, most: int) -> str:
    if not count:
        return ""
    kind = "far" if abs(k) > BINS else "bar"
    height = count / most * (_HEIGHT - 14.0)
    top = _HEAD + _HEIGHT - height
    at = f'x="{x + 1:.1f}" y="{top:.1f}" width="{_STEP - 2:.1f}" height="{height:.1f}"'
    number = f'<text x="{x + _STEP / 2:.1f}" y="{top - 3:.1f}" text-anchor="middle">{count}</text>'
    return f'<rect class="{kind}" {at}/>{number}'


def _x(ratio: float) -> float:
    """Where a ratio stands: one bin for what lies beyond at each end."""
    return (BINS + 1) * _STEP + max(-2.05, min(2.05, ratio)) / 2.0 * BINS * _STEP


def _labels(marks: Marks) -> tuple[str, int]:
    """The named wrong answers, each label in the first row below the axis that has room; how many rows."""
    ends: list[float] = []
    parts: list[str] = []
    for code, ratio in sorted(marks[:_MOST_MARKS], key=lambda mark: mark[1]):
        x, width = _x(ratio), _LETTER * len(code)
        start = min(max(x - width / 2.0, 0.0), _WIDTH - width)
        row = next((n for n, end in enumerate(ends) if end < start), len(ends))
        ends[row:row + 1] = [start + width + _LETTER]
        parts += _label(code, x, start + width / 2.0, _HEAD + _HEIGHT + _FOOT + _ROW * (row + 1))
    return "".join(parts), len(ends)


def _label(code: str, x: float, middle: float, y: float) -> Iterator[str]:
    yield f'<line class="mark" x1="{x:.1f}" x2="{x:.1f}" y1="{_HEAD:.0f}" y2="{y - 11:.1f}"/>'
    yield f'<text x="{middle:.1f}" y="{y:.1f}" text-anchor="middle">{escape(code)}</text>'


def _axis() -> str:
    y = _HEAD + _HEIGHT
    ticks = "".join(
        f'<text x="{_x(r):.1f}" y="{y + 13:.1f}" text-anchor="middle">{r:g}</text>'
        for r in (-2.0, -1.0, 0.0, 1.0, 2.0)
    )
    return f'<line class="axis" x1="0" x2="{_WIDTH:.0f}" y1="{y:.0f}" y2="{y:.0f}"/>{ticks}'
