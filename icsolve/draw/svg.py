"""The style sheet of every picture, and marks as SVG text: two decimals, the same bytes every run, and no
text that could be read as markup.

The colours differ in lightness and in dash, on paper and in the dark. They are those of Okabe and Ito, which
all kinds of colour vision can tell apart.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from icsolve.draw.marks import (
    LOW,
    ArcMark,
    AreaMark,
    Box,
    Disc,
    Mark,
    MarkGroup,
    Stroke,
    TextMark,
    TextRun,
    kinds_of,
    text_box,
)
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped


class Ink(NamedTuple):
    """A colour on light paper and in the dark."""

    light: str
    dark: str


PAPER = Ink("#ffffff", "#14181d")
LINE = Ink("#1b1f24", "#e6e9ed")
MUTED = Ink("#57606a", "#9aa4af")
BODY = Ink("#e4e9ef", "#2c3640")
FRAME = Ink("#3d444d", "#aab4be")
KNOWN = Ink("#0b5cad", "#6cb6ff")
UNKNOWN = Ink("#b3261e", "#ff8a80")
CENTRE = Ink("#6f42c1", "#c9a6ff")
LIT = Ink("#e3d8f7", "#3a2f52")
MOTION = Ink("#00704e", "#4fd6a8")

RULES: tuple[tuple[str, Ink | None, Ink | None, str], ...] = (
    # class, stroke, fill, width and the rest
    ("paper", None, PAPER, ""),
    ("body", LINE, BODY, "stroke-width:1.3;stroke-linejoin:round"),
    ("wheel", LINE, BODY, "stroke-width:1.3;stroke-dasharray:9 2.5 1.5 2.5"),
    ("rim", LINE, None, "stroke-width:1.3;stroke-dasharray:9 2.5 1.5 2.5"),
    ("block", LINE, PAPER, "stroke-width:1.4;stroke-linejoin:round"),
    ("hole", LINE, PAPER, "stroke-width:1.1"),
    ("pin", LINE, PAPER, "stroke-width:1.5"),
    ("dot", None, LINE, ""),
    ("frame", FRAME, None, "stroke-width:1.7;stroke-linecap:round"),
    ("foot", FRAME, PAPER, "stroke-width:1.4;stroke-linejoin:round"),
    ("hatch", FRAME, None, "stroke-width:0.9"),
    ("rope", LINE, None, "stroke-width:1.6"),
    ("box", MUTED, None, "stroke-width:1.2;stroke-dasharray:5 4"),
    ("faint", MUTED, None, "stroke-width:0.8"),
    ("known", KNOWN, None, "stroke-width:2.2;stroke-linecap:round"),
    ("known-head", KNOWN, KNOWN, "stroke-width:0.6;stroke-linejoin:round"),
    ("unknown", UNKNOWN, None, "stroke-width:2.6;stroke-linecap:round"),
    ("unknown-head", UNKNOWN, UNKNOWN, "stroke-width:0.6;stroke-linejoin:round"),
    ("reaction", MOTION, None, "stroke-width:2;stroke-linecap:round"),
    ("reaction-head", MOTION, MOTION, "stroke-width:0.6;stroke-linejoin:round"),
    ("spring", KNOWN, None, "stroke-width:1.4;stroke-linejoin:round"),
    ("primary", None, CENTRE, ""),
    ("secondary", CENTRE, PAPER, "stroke-width:1.8"),
    ("construction", CENTRE, None, "stroke-width:1.1;stroke-dasharray:6 3.5"),
    ("edge-known", LINE, None, "stroke-width:1.6"),
    ("edge-found", CENTRE, None, "stroke-width:1.4;stroke-dasharray:6 3.5"),
    ("lit", None, LIT, ""),
    ("node", LINE, PAPER, "stroke-width:1.4"),
    ("far", CENTRE, None, "stroke-width:1.6;stroke-linecap:round"),
    ("far-head", CENTRE, CENTRE, "stroke-width:0.6;stroke-linejoin:round"),
    ("velocity", MOTION, None, "stroke-width:1.8;stroke-linecap:round;stroke-dasharray:7 2.5"),
    ("velocity-head", MOTION, MOTION, "stroke-width:0.6;stroke-linejoin:round"),
    ("leader", MUTED, None, "stroke-width:0.7"),
    ("plot", KNOWN, None, "stroke-width:1.8;stroke-linejoin:round"),
    ("plot-2", UNKNOWN, None, "stroke-width:1.8;stroke-linejoin:round;stroke-dasharray:8 3"),
    ("plot-3", MOTION, None, "stroke-width:1.8;stroke-linejoin:round;stroke-dasharray:2.5 2.5"),
    ("asymptote", UNKNOWN, None, "stroke-width:1;stroke-dasharray:3 4"),
    ("shade", None, MUTED, "fill-opacity:0.18"),
    ("grid", MUTED, None, "stroke-width:0.4;stroke-opacity:0.5"),
    ("badge", LINE, PAPER, "stroke-width:1"),
)  # fmt: skip

TEXTS: tuple[tuple[str, Ink, str], ...] = (
    ("t-point", LINE, "font-style:italic"),
    ("t-link", LINE, ""),
    ("t-known", KNOWN, "font-weight:600"),
    ("t-unknown", UNKNOWN, "font-weight:700"),
    ("t-reaction", MOTION, "font-weight:600"),
    ("t-centre", CENTRE, "font-weight:600"),
    ("t-velocity", MOTION, "font-weight:600"),
    ("t-title", LINE, "font-weight:700"),
    ("t-note", MUTED, ""),
    ("t-axis", LINE, ""),
    ("t-reason", UNKNOWN, "font-weight:600"),
)


_HALOED = frozenset({"t-point", "t-known", "t-unknown", "t-reaction", "t-centre", "t-velocity"})
_HALO = "stroke-width:2.4;stroke-opacity:0.85;stroke-linejoin:round"
"""Lines that a label crosses stop short of its letters. A browser paints such a stroke under the letters; in
a document by itself the letters stand a second time above it, for readers that know no `paint-order`."""


def sheet(used: frozenset[str], *, painted: bool = True) -> str:
    """The rules that a picture with these classes needs, light first, then what the dark changes."""
    light = [_FONT, *_rules(used, painted, dark=False)]
    dark = "".join(_rules(used, painted, dark=True))
    return "".join(light) + f"@media screen and (prefers-color-scheme:dark){{{dark}}}"


_FONT = ".ic text{font-family:'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif}"


def _rules(used: frozenset[str], painted: bool, *, dark: bool) -> list[str]:
    rules = []
    for name, stroke, fill, rest in RULES:
        if name in used:
            parts = [f"fill:{_hue(fill, dark)}", f"stroke:{_hue(stroke, dark)}"]
            rules.append(f".ic .{name}{{{';'.join([*parts, rest] if rest and not dark else parts)}}}")
    for name, ink, rest in TEXTS:
        if name in used:
            style = f"fill:{_hue(ink, dark)}" + (f";{rest}" if rest and not dark else "")
            if painted and name in _HALOED:
                style += f";stroke:{_hue(PAPER, dark)}" + ("" if dark else f";{_HALO};paint-order:stroke")
            rules.append(f".ic .{name}{{{style}}}")
    if not painted and used & _HALOED:
        rest = "" if dark else f";{_HALO}"
        rules.append(f".ic .halo{{fill:none;stroke:{_hue(PAPER, dark)}{rest}}}")
    return rules


def _hue(ink: Ink | None, dark: bool) -> str:
    if ink is None:
        return "none"
    return ink.dark if dark else ink.light


# --- marks as SVG text -----------------------------------------------------------------------------------


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
    corner, size = (number(left), number(top)), (number(right - left), number(bottom - top))
    box = " ".join((*corner, *size))
    used = kinds_of(marks) | {"paper"}
    return "\n".join(
        (
            # some programs leave out a space behind an index, unless they are told to keep it
            f'<svg xmlns="http://www.w3.org/2000/svg" xml:space="preserve" class="ic" viewBox="{box}"'
            f' width="{size[0]}" height="{size[1]}" role="img">',
            f"<title>{escaped(title)}</title>",
            f"<desc>{escaped(description)}</desc>",
            f"<style>{sheet(used, painted=False)}</style>",
            f'<rect class="paper" x="{corner[0]}" y="{corner[1]}" width="{size[0]}" height="{size[1]}"/>',
            *(element(mark, alone=True) for mark in marks),
            "</svg>\n",
        )
    )


def element(mark: Mark, *, alone: bool = False) -> str:
    """One mark; in a document ``alone`` a label's letters stand on a stroke of the paper's colour, and
    nothing moves."""
    match mark:
        case AreaMark():
            rings = " ".join(f"M{_chain(ring)}Z" for ring in mark.rings)
            return f'<path class="{mark.kind}" fill-rule="evenodd" d="{rings}"/>'
        case Stroke():
            return f'<path class="{mark.kind}" d="M{_chain(mark.points)}"/>'
        case Disc():
            x, y = map(number, mark.centre)
            return f'<circle class="{mark.kind}" cx="{x}" cy="{y}" r="{number(mark.radius)}"/>'
        case ArcMark():
            return _arc(mark)
        case TextMark():
            if alone and len(mark.runs) > 1:  # cairosvg centres each run of a text for itself
                mark = mark._replace(at=(text_box(mark)[0], mark.at[1]), anchor="start")
            under = _text(mark, " halo") + "\n" if alone and mark.kind in _HALOED else ""
            return under + _text(mark)
        case MarkGroup():
            return _group(mark, alone)


def _chain(points: Iterable[tuple[float, float]]) -> str:
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


def _arc(arc: ArcMark) -> str:
    r = number(arc.radius)
    large, turn = int(abs(arc.sweep) > 180.0), int(arc.sweep < 0.0)
    ends = (_chain((arc.at(0.0),)), _chain((arc.at(arc.sweep),)))
    return f'<path class="{arc.kind}" d="M{ends[0]} A{r},{r} 0 {large} {turn} {ends[1]}"/>'


def _text(text: TextMark, more: str = "") -> str:
    x, y = number(text.at[0]), number(text.at[1] + 0.35 * text.size)
    anchor = "" if text.anchor == "start" else f' text-anchor="{text.anchor}"'
    size = number(text.size)
    hidden = ' aria-hidden="true"' if more else ""
    place = f'x="{x}" y="{y}" font-size="{size}"{anchor}{hidden}'
    return f'<text class="{text.kind}{more}" {place}>{_runs(text)}</text>'


def _runs(text: TextMark) -> str:
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


def _group(group: MarkGroup, alone: bool) -> str:
    """A group; where there is nothing to say of it, its marks."""
    name = f' id="{escaped(identifier(group.name))}"' if group.name else ""
    kind = f' class="{group.kind}"' if group.kind else ""
    follows = () if alone else ((f"data-{key}", value) for key, value in group.follows)
    data = "".join(f' {key}="{escaped(value)}"' for key, value in (*group.data, *follows))
    title = f"<title>{escaped(group.title)}</title>" if group.title else ""
    body = "".join(f"\n{element(mark, alone=alone)}" for mark in group.marks)
    said = name or kind or data or title
    return f"<g{name}{kind}{data}>{title}{body}\n</g>" if said else body[1:]


def runs_of(text: str) -> tuple[TextRun, ...]:
    """``I_{24} = 3`` as runs: what stands in ``_{}`` is set low."""
    parts = re.split(r"_\{([^}]*)\}", text)
    return tuple(TextRun(part, bool(n % 2)) for n, part in enumerate(parts) if part)
