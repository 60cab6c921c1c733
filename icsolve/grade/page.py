"""The class summary as one HTML page: no script, no network."""

from __future__ import annotations

from html import escape

from icsolve.grade.chart import histogram
from icsolve.grade.malrules import CODES
from icsolve.grade.run import Graded
from icsolve.grade.summary import by_count, ordered_verdicts
from icsolve.grade.tally import Counts

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
