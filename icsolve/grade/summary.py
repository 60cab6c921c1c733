"""The class summary: as text for a terminal, as one HTML page without script; what a student may see."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from operator import add

from icsolve.grade.course import Person
from icsolve.grade.judge import VERDICTS
from icsolve.grade.marking import BINS, Counts
from icsolve.grade.mistakes.lookup import CODES
from icsolve.grade.results import ResultRow, by_student, marks_of
from icsolve.grade.run import Graded
from icsolve.tuples import NamedTuple

_MANY = 3
"""Answers from which it is told that most could not be read."""
_SHOWN = 6
"""Mistakes of one question that are shown."""


def summary(graded: Graded) -> str:
    """The summary of a class, for a terminal."""
    lines = [_received(graded)]
    lines += [told for item, counts in graded.counts.items() if (told := mostly_unread(item, counts))]
    for item, counts in graded.counts.items():
        lines += ["", *_question(item, counts)]
    lines += [f"no answer to {item}: {_owing(graded, item)}" for item in graded.owing]
    return "\n".join(lines)


def _received(graded: Graded) -> str:
    """How many answers came in, and from how many of the students."""
    some = f"{graded.students - graded.silent} of " if graded.silent else ""
    return f"{_count(graded.rows, 'answer')} from {some}{_count(graded.students, 'student')}"


def mostly_unread(item: str, counts: Counts) -> str:
    """That most answers to a question could not be judged, with the commonest; '' where it is not so."""
    given = sum(counts.verdicts.values()) - counts.verdicts["missing"]
    waiting = counts.verdicts["invalid"] + counts.verdicts["review"]
    if waiting < _MANY or 2 * waiting <= given:
        return ""
    said = ", ".join(f"'{text}' ({n} times)" for text, n in counts.texts.most_common(3))
    return f"{item}: {waiting} of {given} answers could not be read or judged: {said}. Is the column right?"


def _count(number: int, what: str) -> str:
    return f"{number:,} {what}{'' if number == 1 else 's'}".replace(",", " ")


def _question(item: str, counts: Counts) -> Iterator[str]:
    verdicts = ", ".join(f"{n} {verdict}" for verdict, n in ordered_verdicts(counts))
    mark = f"mean {counts.score / counts.max_score:.0%}" if counts.max_score else ""
    yield f"{item}: {verdicts}" + (f"; {mark}" if mark else "")
    wrong = counts.verdicts["wrong"]
    named = [(code, n) for code, n in by_count(counts.mistakes) if code]
    for code, n in named[:_SHOWN]:
        yield f"  {n} of {_count(wrong, 'wrong answer')}: {code}"
    if len(named) > _SHOWN:
        yield f"  {sum(n for _, n in named[_SHOWN:])} of {_count(wrong, 'wrong answer')}: other causes"
    if counts.mistakes[""]:
        yield f"  {counts.mistakes['']} of {_count(wrong, 'wrong answer')}: no known cause"
    common = _unexplained(counts, 3)
    if common:
        yield f"  the commonest of them: {common}"
    if counts.unread:
        yield "  not judged: " + ", ".join(f"{n} {code}" for code, n in counts.unread.most_common(_SHOWN))
    yield from blocks(counts)


def _unexplained(counts: Counts, most: int) -> str:
    """The commonest wrong values whose cause is not known: many alike have one."""
    common = [(value, n) for value, n in counts.unexplained.most_common(most) if n > 1]
    return ", ".join(f"{value} ({n} times)" for value, n in common)


def by_count(mistakes: Counter[str]) -> list[tuple[str, int]]:
    """Mistakes by how often they were made; those of no known cause last."""
    return sorted(mistakes.items(), key=lambda item: (not item[0], -item[1], item[0]))


def ordered_verdicts(counts: Counts) -> list[tuple[str, int]]:
    """The verdicts that occur, in the order right, wrong, invalid, review, missing."""
    return [(verdict, counts.verdicts[verdict]) for verdict in VERDICTS if counts.verdicts[verdict]]


def blocks(counts: Counts) -> Iterator[str]:
    """One line of blocks: answers over the right one from -2 to 2, the right one marked below."""
    if not counts.bins:
        return
    bars = "▁▂▃▄▅▆▇█"
    most = max(counts.bins.values())
    cells = [counts.bins.get(k, 0) for k in range(-BINS - 1, BINS + 2)]
    drawn = "".join(" " if not n else bars[max(0, -(-n * len(bars) // most) - 1)] for n in cells)
    place = BINS + 1 + BINS // 2
    yield f"  |{drawn}|"
    yield "   " + " " * place + "^ right; left and right of it -2 to 2 times, and beyond"


def _owing(graded: Graded, item: str) -> str:
    """Who gave no answer to a question; '' where all did."""
    students = graded.owing.get(item, ())
    count = graded.counts[item].verdicts["missing"] if item in graded.counts else 0
    more = count - len(students)
    return ", ".join(students) + (f" and {more} more" if students and more > 0 else "")


_LEAST = 10
"""Students from whom it is told how telling a question is."""


class Total(NamedTuple):
    """One student's marks of all that was judged, and how many answers wait for a person."""

    student: str
    section: str
    score: float
    most: float
    waiting: int


class Statistics(NamedTuple):
    """Of a class: how telling its questions are, by name, its students in order, and the mean share of each
    section."""

    discriminations: dict[str, float | None]
    """the correlation of the share of a question's points with the share of all other points; None where
    students are too few or all alike"""
    totals: list[Total]
    sections: dict[str, tuple[int, float]]


def _correlation(n: float, x: float, y: float, xx: float, yy: float, xy: float) -> float | None:
    """What follows from the sums over students of 1, x, y, their squares and their product."""
    spread = (n * xx - x**2) * (n * yy - y**2)
    known = n >= _LEAST and spread > 1e-9 * n**4
    return (n * xy - x * y) / math.sqrt(spread) if known else None


def statistics(results: str, people: Mapping[str, Person]) -> Statistics:
    """The statistics of a file of results, read once."""
    sums: dict[str, list[float]] = {}
    totals: list[Total] = []
    for student, rows in by_student(results):
        if not student or not rows:
            continue
        score, most, _, waiting = marks_of(rows)
        section = people[student].section if student in people else ""
        totals.append(Total(student, section, score, most, waiting))
        for row in rows:
            if row.score is not None and row.max_score and most != row.max_score:
                x, y = row.score / row.max_score, (score - row.score) / (most - row.max_score)
                before = sums.get(row.case, [0.0] * 6)
                sums[row.case] = [*map(add, before, (1.0, x, y, x * x, y * y, x * y))]
    return Statistics({name: _correlation(*own) for name, own in sums.items()}, totals, _sections(totals))


def _sections(totals: Sequence[Total]) -> dict[str, tuple[int, float]]:
    """How many students each section has, and the mean of their shares."""
    shares: dict[str, list[float]] = {}
    for total in totals:
        if total.section and total.most:
            shares.setdefault(total.section, []).append(total.score / total.most)
    return {name: (len(found), sum(found) / len(found)) for name, found in sorted(shares.items())}


_WIDTH, _HEIGHT, _HEAD, _FOOT = 720.0, 160.0, 16.0, 20.0
_ROW = 13.0
_LETTER = 6.4
"""Width of a letter of a label, at most."""
_MOST_MARKS = 12
_BINS = [*range(-BINS - 1, BINS + 2)]
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
    about = counts.bins.get(BINS // 2, 0)
    near = f"{about} within 5 % of the right one"
    return f"Histogram of {_count(total, 'answer')}: {near}, {beyond} beyond twice its size"


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
    """Where a ratio stands: in the middle of its bin; one bin for what lies beyond at each end."""
    return (BINS + 1.5) * _STEP + max(-2.1, min(2.1, ratio)) / 2.0 * BINS * _STEP


def _labels(marks: Marks) -> tuple[str, int]:
    """The named wrong answers, each label in the first row below the axis that has room; how many rows."""
    ends: list[float] = []
    parts: list[str] = []
    for code, ratio in sorted(marks[:_MOST_MARKS], key=lambda mark: mark[1]):
        x, width = _x(ratio), _LETTER * len(code)
        start = min(max(x - width / 2.0, 0.0), _WIDTH - width)
        row = next((n for n, end in enumerate(ends) if end < start), len(ends))
        ends[row : row + 1] = [start + width + _LETTER]
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
body{font-family:system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;line-height:1.4}
body{color:#1b1f24;background:#fff}a{color:#0b57d0}
.wide{overflow-x:auto;margin:.5em 0}
table{border-collapse:collapse}
td,th{padding:.2em .8em;text-align:left;border-bottom:1px solid #d0d7de;vertical-align:top}
td.n,th.n{text-align:right;white-space:nowrap}th{white-space:nowrap}tbody th{font-weight:normal}
svg{width:100%;min-width:40em;height:auto;margin-top:.5em}
.bar{fill:#5b7fa6}.far{fill:#6b7580}
.mark{stroke:#b3261e;stroke-dasharray:3 2}.good{stroke:#2e7d32;stroke-width:2}.axis{stroke:currentColor}
text{font-size:11px;fill:currentColor}h2{margin-top:2em;overflow-wrap:anywhere}
code,.text{overflow-wrap:anywhere;white-space:pre-wrap}.warn{border-left:4px solid #b3261e;padding-left:.6em}
@media (max-width:30em){body{margin:1em auto;padding:0 .6em}td,th{padding:.2em .4em}}
@media (prefers-color-scheme:dark){
body{color:#e6e9ed;background:#14181d}a{color:#8ab4f8}td,th{border-color:#3d444d}
.bar{fill:#7fa3cc}.far{fill:#8d97a3}.mark{stroke:#f2b8b5}.good{stroke:#81c995}}
@media print{h2{break-after:avoid}svg,table{break-inside:avoid}}
"""
_TEXTS = 10
"""Texts of a question that are shown: the commonest."""


def page(graded: Graded, title: str = "", found: Statistics | None = None) -> str:
    """The whole page; ``found`` adds what the results tell of students and questions."""
    name = title or "Class summary"
    sections = enumerate(graded.counts.items())
    body = "".join(_section(graded, n, item, counts) for n, (item, counts) in sections)
    notes = "".join(f"<li>{escape(str(note))}</li>" for note in graded.notes)
    listed = f"<h2>Noted</h2><ul>{notes}</ul>" if notes else ""
    unread = [told for item, counts in graded.counts.items() if (told := mostly_unread(item, counts))]
    warned = "".join(f'<p class="warn">{escape(told)}</p>' for told in unread)
    people = _people(found) if found is not None else ""
    return _document(
        name,
        f"<p>{_received(graded)}</p>{warned}{_overview(graded, found)}{_queue(graded)}{body}{people}{listed}",
    )


def _document(title: str, body: str) -> str:
    name = escape(title)
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
        f'<meta name="viewport" content="width=device-width, initial-scale=1"><style>{_STYLE}</style></head>'
        f"<body><main><h1>{name}</h1>{body}</main></body></html>\n"
    )


def _table(name: str, heads: Sequence[str], rows: Iterable[Sequence[str]], numbers: range) -> str:
    """A table that can be scrolled with the keyboard; its cells are HTML, those of ``numbers``
    right-aligned.
    """

    def kind(column: int) -> str:
        return ' class="n"' if column in numbers else ""

    top = "".join(f'<th scope="col"{kind(i)}>{head}</th>' for i, head in enumerate(heads))
    body = "".join(
        f'<tr><th scope="row">{first}</th>'
        + "".join(f"<td{kind(i)}>{cell}</td>" for i, cell in enumerate(rest, 1))
        + "</tr>"
        for first, *rest in rows
    )
    return (
        f'<div class="wide" role="region" aria-label="{escape(name)}" tabindex="0"><table>'
        f"<thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _share(value: float | None) -> str:
    return f"{value:.0%}" if value is not None else ""


def _overview(graded: Graded, found: Statistics | None) -> str:
    """Marks by question, and of all; how telling each question is."""
    told = found.discriminations if found is not None else {}
    rows = []
    for n, (item, counts) in enumerate(graded.counts.items()):
        one = told.get(item)
        extra = [f"{one:.2f}" if one is not None else ""] if found is not None else []
        rows.append([f'<a href="#q{n}">{escape(item)}</a>', *_cells([counts]), *extra])
    if len(graded.counts) > 1:
        rows.append(["all questions", *_cells(list(graded.counts.values())), *([""] if found else [])])
    heads = ["question", *VERDICTS, "mean mark", *(["discrimination"] if found is not None else [])]
    return _table("Marks by question", heads, rows, range(1, len(heads)))


def _cells(counts: list[Counts]) -> list[str]:
    cells = [str(sum(c.verdicts[head] for c in counts)) for head in VERDICTS]
    score, most = sum(c.score for c in counts), sum(c.max_score for c in counts)
    return [*cells, _share(score / most if most else None)]


def _queue(graded: Graded) -> str:
    """What waits for a person, the commonest first."""
    waiting = [(n, item, text) for item, counts in graded.counts.items() for text, n in counts.texts.items()]
    if not waiting:
        return ""
    shown = sorted(waiting, key=lambda one: (-one[0], one[1:]))
    rows = [[escape(item), _text(text), str(n)] for n, item, text in shown[: 2 * _TEXTS]]
    more = len(shown) - len(rows)
    rest = f"<p>And {more} other texts; <code>--review FILE</code> has all of them.</p>" if more > 0 else ""
    table = _table("Answers that wait for a person", ("question", "answer", "students"), rows, range(2, 3))
    return f"<h2>Waiting for a person</h2>{table}{rest}"


def _text(text: str) -> str:
    return f'<span class="text">{escape(text)}</span>' if text else "(nothing)"


def _section(graded: Graded, n: int, item: str, counts: Counts) -> str:
    said = ", ".join(f"{number} {verdict}" for verdict, number in ordered_verdicts(counts))
    accepted = f"<p>Accepted: {escape(graded.accepted[item])}.</p>" if item in graded.accepted else ""
    wrong = counts.verdicts["wrong"]
    rows = [_mistake(code, number, wrong) for code, number in by_count(counts.mistakes)]
    heads = ("mistake", "answers", "of the wrong", "meaning")
    table = _table(f"Mistakes in {item}", heads, rows, range(1, 3)) if rows else ""
    picture = ""
    if counts.bins:
        drawn = histogram(counts, graded.marks.get(item, ()))
        about = f'role="region" aria-label="Histogram of {escape(item)}" tabindex="0"'
        picture = f'<div class="wide" {about}>{drawn}</div>'
    common, students = _unexplained(counts, _TEXTS), _owing(graded, item)
    strange = f"<p>The commonest wrong answers of no known cause: {escape(common)}</p>" if common else ""
    owing = f"<p>No answer: {escape(students)}</p>" if students else ""
    head = f'<h2 id="q{n}">{escape(item)}</h2><p>{said}</p>'
    return f"{head}{accepted}{table}{strange}{picture}{owing}"


def _mistake(code: str, number: int, wrong: int) -> list[str]:
    told = CODES.get(code, "").format(at="")
    shown = f"<code>{escape(code)}</code>" if code else "no known cause"
    return [shown, str(number), f"{number / wrong:.0%}" if wrong else "", escape(told)]


def _people(found: Statistics) -> str:
    """Sections, and the totals of all students."""
    parts = ""
    if found.sections:
        rows = [[escape(name), str(n), _share(mean)] for name, (n, mean) in found.sections.items()]
        parts += "<h2>Sections</h2>" + _table("Sections", ("section", "students", "mean"), rows, range(1, 3))
    if found.totals:
        rows = [
            [escape(t.student), escape(t.section), f"{t.score:.10g}", f"{t.most:.10g}", str(t.waiting or "")]
            for t in found.totals
        ]
        heads = ("student", "section", "marks", "of", "waiting")
        parts += "<h2>Students</h2>" + _table("Totals of students", heads, rows, range(2, 5))
    return parts


# --- for a student ----------------------------------------------------------------------------------

_ACCEPTED = re.compile(r"^Right: .* is accepted\.")


def student_page(student: str, rows: Sequence[ResultRow], title: str) -> str:
    """What one student may see: the own answers, marks and feedback, and no right answers."""
    cells = [
        [
            escape(row.case),
            _text(row.raw_answer),
            row.verdict,
            f"{row.score:.10g} of {row.max_score:.10g}" if row.score is not None else "waiting",
            escape(_ACCEPTED.sub("Right.", row.feedback)),
        ]
        for row in rows
    ]
    score, most, _, waiting = marks_of(rows)
    rest = f" {waiting} not judged yet." if waiting else ""
    heads = ("question", "your answer", "verdict", "marks", "feedback")
    body = f"<p>{escape(student)}: {score:.10g} of {most:.10g} marks.{rest}</p>"
    return _document(title or "Marks", body + _table("Your answers", heads, cells, range(3, 4)))
