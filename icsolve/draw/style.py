"""The style sheet of every picture: colours that differ in lightness and in dash, on paper and in the dark.

The colours are those of Okabe and Ito, which all kinds of colour vision can tell apart.
"""

from __future__ import annotations

from typing import NamedTuple


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

_RULES: tuple[tuple[str, Ink | None, Ink | None, str], ...] = (
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

_TEXTS: tuple[tuple[str, Ink, str], ...] = (
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
_HALO = ";stroke-width:2.4;stroke-opacity:0.85;stroke-linejoin:round;paint-order:stroke"
"""Lines that a label crosses stop short of its letters."""


def sheet(used: frozenset[str]) -> str:
    """The rules that a picture with these classes needs, light first, then what the dark changes."""
    light = [_FONT, *_rules(used, dark=False)]
    dark = "".join(_rules(used, dark=True))
    return "".join(light) + f"@media screen and (prefers-color-scheme:dark){{{dark}}}"


_FONT = ".ic text{font-family:'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif}"


def _rules(used: frozenset[str], *, dark: bool) -> list[str]:
    rules = []
    for name, stroke, fill, rest in _RULES:
        if name in used:
            parts = [f"fill:{_hue(fill, dark)}", f"stroke:{_hue(stroke, dark)}"]
            rules.append(f".ic .{name}{{{';'.join([*parts, rest] if rest and not dark else parts)}}}")
    for name, ink, rest in _TEXTS:
        if name in used:
            style = f"fill:{_hue(ink, dark)}" + (f";{rest}" if rest and not dark else "")
            halo = f";stroke:{_hue(PAPER, dark)}" if name in _HALOED else ""
            rules.append(f".ic .{name}{{{style}{halo}{_HALO if halo and not dark else ''}}}")
    return rules


def _hue(ink: Ink | None, dark: bool) -> str:
    if ink is None:
        return "none"
    return ink.dark if dark else ink.light
