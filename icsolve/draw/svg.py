"""Marks as SVG text: two decimals, the same bytes every run, and no text that could be read as markup."""

from __future__ import annotations

import re
from collections.abc import Iterable

from icsolve.draw.marks import LOW, Arc, Area, Box, Disc, Group, Mark, Run, Stroke, Text, leaves
from icsolve.draw.style import sheet

_ENTITIES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;"}
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML has no way to write."""


def escaped(text: str) -> str:
    """A text that stays text, in content and in attributes, whatever it says."""
    return "".join(_ENTITIES.get(c, c) for c in _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text))


def number(value: float) -> str:
    """A coordinate with two decimals at most."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def identifier(text: str) -> str:
    """A name as (part of) an id: a prime is spelt out, anything else that CSS would trip over is a code."""
    text = text.replace("'", "-prime")
    return "".join(c if c.isalnum() or c in "-_" else f"-x{ord(c):x}" for c in text)


def document(marks: Iterable[Mark], view: Box, title: str, description: str) -> str:
    """A whole SVG document with a paper behind the marks."""
    marks = tuple(marks)
    left, top, right, bottom = view
    size = (number(right - left), number(bottom - top))
    box = " ".join((number(left), number(top), *size))
    used = frozenset(_kinds(marks)) | {"paper"}
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="ic" viewBox="{box}" width="{size[0]}"'
            f' height="{size[1]}" role="img">',
            f"<title>{escaped(title)}</title>",
            f"<desc>{escaped(description)}</desc>",
            f"<style>{sheet(used)}</style>",
            _paper(number(left), number(top), *size),
            *(element(mark) for mark in marks),
            "</svg>\n",
        )
    )


def _paper(x: str, y: str, width: str, height: str) -> str:
    return f'<rect class="paper" x="{x}" y="{y}" width="{width}" height="{height}"/>'


def _kinds(marks: Iterable[Mark]) -> Iterable[str]:
    return (name for mark in leaves(marks) for name in mark.kind.split())


def element(mark: Mark) -> str:
    """One mark."""
    match mark:
        case Area():
            rings = " ".join(f"M{_chain(ring)}Z" for ring in mark.rings)
            return f'<path class="{mark.kind}" fill-rule="evenodd" d="{rings}"/>'
        case Stroke():
            return f'<path class="{mark.kind}" d="M{_chain(mark.points)}"/>'
        case Disc():
            x, y = map(number, mark.centre)
            return f'<circle class="{mark.kind}" cx="{x}" cy="{y}" r="{number(mark.radius)}"/>'
        case Arc():
            return _arc(mark)
        case Text():
            return _text(mark)
        case Group():
            return _group(mark)


def _chain(points: Iterable[tuple[float, float]]) -> str:
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


def _arc(arc: Arc) -> str:
    r = number(arc.radius)
    large, turn = int(abs(arc.sweep) > 180.0), int(arc.sweep < 0.0)
    ends = (_chain((arc.at(0.0),)), _chain((arc.at(arc.sweep),)))
    return f'<path class="{arc.kind}" d="M{ends[0]} A{r},{r} 0 {large} {turn} {ends[1]}"/>'


def _text(text: Text) -> str:
    x, y = number(text.at[0]), number(text.at[1] + 0.35 * text.size)
    anchor = "" if text.anchor == "start" else f' text-anchor="{text.anchor}"'
    size = number(text.size)
    return f'<text class="{text.kind}" x="{x}" y="{y}" font-size="{size}"{anchor}>{_runs(text)}</text>'


def _runs(text: Text) -> str:
    parts = []
    lowered = False
    drop, small = number(0.25 * text.size), number(LOW * text.size)
    for run in text.runs:
        shift = f' dy="{drop if run.low else "-" + drop}"' if run.low != lowered else ""
        size = f' font-size="{small}"' if run.low else ""
        body = escaped(run.text)
        parts.append(f"<tspan{shift}{size}>{body}</tspan>" if shift or size else body)
        lowered = run.low
    return "".join(parts)


def _group(group: Group) -> str:
    name = f' id="{escaped(identifier(group.name))}"' if group.name else ""
    kind = f' class="{group.kind}"' if group.kind else ""
    data = "".join(f' {key}="{escaped(value)}"' for key, value in group.data)
    title = f"<title>{escaped(group.title)}</title>" if group.title else ""
    body = "".join(f"\n{element(mark)}" for mark in group.marks)
    return f"<g{name}{kind}{data}>{title}{body}\n</g>"


def runs_of(text: str) -> tuple[Run, ...]:
    """``I_{24} = 3`` as runs: what stands in ``_{}`` is set low."""
    parts = re.split(r"_\{([^}]*)\}", text)
    return tuple(Run(part, bool(n % 2)) for n, part in enumerate(parts) if part)
