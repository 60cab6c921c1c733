"""The class summary as one HTML page, with a histogram a question: no script, no network."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from icsolve.grade.mistakes import CODES
from icsolve.grade.run import Graded
from icsolve.grade.summary import by_count, ordered_verdicts
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


_STYLE = """
body{font-family:system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em}
body{color:#1b1f24;background:#fff}a{color:#0b57d0}
table{border-collapse:collapse;margin:.5em 0;display:block;overflow-x:auto}
td,th{padding:.2em .8em;text-align:left;border-bottom:1px solid #d0d7de}
td.n,th.n{text-align:right}td:first-child,td.n,th{white-space:nowrap}svg{max-width:100%;height:auto;margin-top:.5em}
.bar{fill:#5b7fa6}.far{fill:#6b7580}
.mark{stroke:#b3261e;stroke-dasharray:3 2}.good{stroke:#2e7d32;stroke-width:2}.axis{stroke:currentColor}
text{font-size:11px;fill:currentColor}h2{margin-top:2em;overflow-wrap:anywhere}
@media (prefers-color-scheme:dark){
body{color:#e6e9ed;background:#14181d}a{color:#8ab4f8}td,th{border-color:#3d444d}
.bar{fill:#7fa3cc}.far{fill:#8d97a3}.mark{stroke:#f2b8b5}.good{stroke:#81c995}}
@media print{h2{break-after:avoid}svg,table{break-inside:avoid}}
"""
_HEADS = ("right", "wrong", "invalid", "review", "missing")


def page(graded: Graded, title: str = "") -> str:
    """The whole page."""
    name = escape(title or "Class summary")
    sections = enumerate(graded.counts.items())
    body = "".join(_section(graded, n, item, counts) for n, (item, counts) in sections)
    notes = "".join(f"<li>{escape(str(note))}</li>" for note in graded.notes)
    listed = f"<h2>Noted</h2><ul>{notes}</ul>" if notes else ""
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style></head><body>'
        f"<h1>{name}</h1><p>{graded.rows} answers from {graded.students} students</p>"
        f"{_table(graded)}{body}{listed}</body></html>\n"
    )


def _table(graded: Graded) -> str:
    """Marks by question, and of all."""
    top = "".join(f'<th class="n">{head}</th>' for head in _HEADS)
    rows = "".join(
        _row(f'<a href="#q{n}">{escape(item)}</a>', [counts])
        for n, (item, counts) in enumerate(graded.counts.items())
    )
    whole = _row("all questions", list(graded.counts.values())) if len(graded.counts) > 1 else ""
    return f'<table><tr><th>question</th>{top}<th class="n">mean mark</th></tr>{rows}{whole}</table>'


def _row(name: str, counts: list[Counts]) -> str:
    cells = "".join(f'<td class="n">{sum(c.verdicts[head] for c in counts)}</td>' for head in _HEADS)
    score, most = sum(c.score for c in counts), sum(c.max_score for c in counts)
    return f'<tr><td>{name}</td>{cells}<td class="n">{f"{score / most:.0%}" if most else ""}</td></tr>'


def _section(graded: Graded, n: int, item: str, counts: Counts) -> str:
    said = ", ".join(f"{number} {verdict}" for verdict, number in ordered_verdicts(counts))
    accepted = f"<p>Accepted: {escape(graded.accepted[item])}.</p>" if item in graded.accepted else ""
    wrong = counts.verdicts["wrong"]
    rows = "".join(_mistake(code, number, wrong) for code, number in by_count(counts.mistakes))
    heads = '<tr><th>mistake</th><th class="n">answers</th><th class="n">of the wrong</th><th></th></tr>'
    table = f"<table>{heads}{rows}</table>" if rows else ""
    unread = ", ".join(f"{number} {escape(code)}" for code, number in counts.unread.most_common())
    other = f"<p>Not judged: {unread}</p>" if unread else ""
    picture = histogram(counts, graded.marks.get(item, ())) if counts.bins else ""
    return (
        f'<h2 id="q{n}">{escape(item)}</h2><p>{said}</p>{accepted}{table}{other}{picture}'
        f"{_owing(graded.owing.get(item, ()), counts)}"
    )


def _owing(students: tuple[str, ...], counts: Counts) -> str:
    """Who gave no answer."""
    if not students:
        return ""
    more = counts.verdicts["missing"] - len(students)
    rest = f" and {more} more" if more > 0 else ""
    return f"<p>No answer: {escape(', '.join(students))}{rest}</p>"


def _mistake(code: str, number: int, wrong: int) -> str:
    told = CODES.get(code, "").format(at="")
    shown = f"<code>{escape(code)}</code>" if code else "no known cause"
    share = f"{number / wrong:.0%}" if wrong else ""
    cells = f'<td class="n">{number}</td><td class="n">{share}</td><td>{escape(told)}</td>'
    return f"<tr><td>{shown}</td>{cells}</tr>"
