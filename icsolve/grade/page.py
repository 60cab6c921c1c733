"""The class summary as one HTML page: no script, no network."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from icsolve.grade.malrules import CODES
from icsolve.grade.run import Graded
from icsolve.grade.summary import ordered_verdicts
from icsolve.grade.tally import BINS, Counts

_STYLE = """
body{font-family:system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em}
body{color:#1b1f24;background:#fff}
table{border-collapse:collapse;margin:.5em 0}
td,th{padding:.2em .8em;text-align:left;border-bottom:1px solid #d0d7de}
td.n,th.n{text-align:right}svg{max-width:100%;height:auto}
.bar{fill:#5b7fa6}.far{fill:#9aa4af}
.mark{stroke:#b3261e;stroke-dasharray:3 2}.good{stroke:#2e7d32;stroke-width:2}
text{font-size:11px;fill:currentColor}h2{margin-top:2em}
@media (prefers-color-scheme:dark){
body{color:#e6e9ed;background:#14181d}td,th{border-color:#3d444d}}
"""
_WIDTH, _HEIGHT, _FOOT = 720.0, 160.0, 54.0
_MOST_MARKS = 8


def page(graded: Graded, title: str = "") -> str:
    """The whole page."""
    name = escape(title or "Class summary")
    body = "".join(_section(graded, item, counts) for item, counts in graded.counts.items())
    notes = "".join(f"<li>{escape(str(note))}</li>" for note in graded.notes)
    listed = f"<h2>Noted</h2><ul>{notes}</ul>" if notes else ""
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style></head><body>'
        f"<h1>{name}</h1><p>{graded.rows} answers from {graded.students} students</p>"
        f"{_table(graded)}{body}{listed}</body></html>\n"
    )


def _table(graded: Graded) -> str:
    """Marks by question."""
    heads = ("right", "wrong", "invalid", "review", "missing")
    top = "".join(f'<th class="n">{head}</th>' for head in heads)
    rows = "".join(_row(item, counts, heads) for item, counts in graded.counts.items())
    return f'<table><tr><th>question</th>{top}<th class="n">mean mark</th></tr>{rows}</table>'


def _row(item: str, counts: Counts, heads: tuple[str, ...]) -> str:
    cells = "".join(f'<td class="n">{counts.verdicts[head]}</td>' for head in heads)
    mean = f"{counts.score / counts.max_score:.0%}" if counts.max_score else ""
    return f'<tr><td><a href="#{_id(item)}">{escape(item)}</a></td>{cells}<td class="n">{mean}</td></tr>'


def _id(item: str) -> str:
    return "q-" + "".join(c if c.isalnum() else "-" for c in item)


def _section(graded: Graded, item: str, counts: Counts) -> str:
    said = ", ".join(f"{n} {verdict}" for verdict, n in ordered_verdicts(counts))
    rows = "".join(_mistake(code, n) for code, n in counts.mistakes.most_common())
    table = (
        f'<table><tr><th>mistake</th><th class="n">answers</th><th></th></tr>{rows}</table>' if rows else ""
    )
    unread = ", ".join(f"{n} {escape(code)}" for code, n in counts.unread.most_common())
    other = f"<p>Not judged: {unread}</p>" if unread else ""
    picture = _histogram(counts, graded.marks.get(item, ())) if counts.bins else ""
    return f'<h2 id="{_id(item)}">{escape(item)}</h2><p>{said}</p>{table}{other}{picture}'


def _mistake(code: str, n: int) -> str:
    told = CODES.get(code, "").format(at="")
    shown = f"<code>{escape(code)}</code>" if code else "no known cause"
    return f'<tr><td>{shown}</td><td class="n">{n}</td><td>{escape(told)}</td></tr>'


def _histogram(counts: Counts, marks: tuple[tuple[str, float], ...]) -> str:
    """Answers over the right one, from -2 to 2, what lies beyond at the ends; known wrong ones marked."""
    bins = [*range(-BINS - 1, 0), *range(1, BINS + 2)]
    most = max(counts.bins.values())
    width = _WIDTH / len(bins)
    bars = "".join(_bar(k, i * width, width, counts.bins.get(k, 0) / most) for i, k in enumerate(bins))
    lines = "".join(_marks(marks, width))
    size = f"0 0 {_WIDTH:.0f} {_HEIGHT + _FOOT:.0f}"
    right = f"{_x(1.0, width):.1f}"
    good = f'<line class="good" x1="{right}" x2="{right}" y1="0" y2="{_HEIGHT:.0f}"/>'
    head = f'<svg viewBox="{size}" role="img" aria-label="histogram of the answers">'
    return f"{head}{bars}{good}{lines}{_axis(width)}</svg>"


def _bar(k: int, x: float, width: float, share: float) -> str:
    if not share:
        return ""
    kind = "far" if abs(k) > BINS else "bar"
    height = share * (_HEIGHT - 14.0)
    at = f'x="{x + 1:.1f}" y="{_HEIGHT - height:.1f}"'
    return f'<rect class="{kind}" {at} width="{width - 2:.1f}" height="{height:.1f}"/>'


def _x(ratio: float, width: float) -> float:
    """Where a ratio stands: one bin for what lies beyond at each end."""
    return (BINS + 1) * width + max(-2.05, min(2.05, ratio)) / 2.0 * BINS * width


def _marks(marks: tuple[tuple[str, float], ...], width: float) -> Iterator[str]:
    """The named wrong answers, their codes in steps below the axis so that they can be read."""
    for n, (code, ratio) in enumerate(marks[:_MOST_MARKS]):
        x = _x(ratio, width)
        y = _HEIGHT + 26.0 + 9.0 * (n % 3)
        anchor = "end" if x > 0.85 * _WIDTH else "start"
        yield f'<line class="mark" x1="{x:.1f}" x2="{x:.1f}" y1="0" y2="{y:.1f}"/>'
        yield f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(code)}</text>'


def _axis(width: float) -> str:
    ticks = "".join(
        f'<text x="{_x(r, width):.1f}" y="{_HEIGHT + 13:.1f}" text-anchor="middle">{r:g}</text>'
        for r in (-2.0, -1.0, 0.0, 1.0, 2.0)
    )
    return (
        f'<line x1="0" x2="{_WIDTH:.0f}" y1="{_HEIGHT:.0f}" y2="{_HEIGHT:.0f}" stroke="currentColor"/>{ticks}'
    )
