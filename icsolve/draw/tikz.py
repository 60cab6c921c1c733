"""Marks as TikZ: a picture for LaTeX with one style a kind at its top, its labels in the document's font."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping

from icsolve.draw.marks import ArcMark, AreaMark, Disc, Mark, MarkGroup, Stroke, TextMark, TextRun, kinds_of
from icsolve.draw.svg import RULES, TEXTS, Ink

UNIT = 0.75
"""Points a picture unit, as on a screen."""
SIZES = ((16.0, r"\large"), (13.5, r"\normalsize"), (11.9, r"\small"), (0.0, r"\footnotesize"))
"""Font sizes from so many picture units on."""
_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{c: f"\\{c}" for c in "&%$#_{}"},
    "−": "$-$",
    "×": r"$\times$",
    "·": r"$\cdot$",
    "∞": r"$\infty$",
    "°": r"\textdegree{}",
    "²": r"\textsuperscript{2}",
    "′": r"$'$",
    "″": r"$''$",
}
_RAISED = {c: str(n) for n, c in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")} | {"⁻": "-"}
_MATH = dict(
    zip(
        "≤≥≠≈≡∠⊥∥√∂∑∆→←↑↓↔⇒ϕϑςαβγδεζηθικλμνξοπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩ",
        "leq geq neq approx equiv angle perp parallel surd partial sum Delta rightarrow leftarrow uparrow "
        "downarrow leftrightarrow Rightarrow phi vartheta varsigma alpha beta gamma delta varepsilon zeta "
        "eta theta iota kappa lambda mu nu xi mathrm{o} pi rho sigma tau upsilon varphi chi psi omega "
        "Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega".split(),
        strict=True,
    )
)
_ROMAN = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΧ", "ABEZHIKMNOPTX", strict=True))
"""Greek capitals that LaTeX has as Roman ones only."""
_SET_UP = frozenset(map(chr, range(0xA1, 0x180))) - {*"ĦħĸĿŀŉŦŧſ"} | {*"ȘșȚț‐‑‒–—―‘’‚“”„†‡•…‰‹›€№™"}
"""What LaTeX sets up for its fonts (T1, with ``textcomp``); it stops at other characters."""


def escaped(text: str) -> str:
    """A text that stays text in LaTeX, whatever it says; what its fonts lack is a question mark."""
    text = re.sub(f"[{''.join(_RAISED)}]+", lambda m: f"\0{''.join(_RAISED[c] for c in m[0])}\1", text)
    text = "".join(c if c in "\0\1" else _character(c) for c in unicodedata.normalize("NFC", text))
    return text.replace("\0", r"\textsuperscript{").replace("\1", "}")


def escaped_in_math(formula: str) -> str:
    """A formula whose names may have letters that the fonts of formulas lack."""
    return re.sub(r"[^ -~\n]+", lambda m: f"\\textnormal{{{escaped(m[0])}}}", formula)


def _character(c: str) -> str:
    """A character; where LaTeX has it without its accents alone, so."""
    if c in _SPECIAL or c <= "~" or c in _SET_UP or not c.isprintable():
        return _SPECIAL.get(c, c if c.isprintable() else " ")
    if c in _ROMAN:
        return _ROMAN[c]
    if c in _MATH:
        return f"\\ensuremath{{\\{_MATH[c]}}}"
    plain = [d for d in unicodedata.normalize("NFKD", c) if d != c and not unicodedata.combining(d)]
    return "".join(map(_character, plain)) or "?"


def standalone(marks: Iterable[Mark], title: str) -> str:
    """A document of the picture alone, which another may take in with ``standalone``."""
    marks = tuple(marks)
    return (
        f"% {re.sub(r'[^ -~]', ' ', title)}\n\\documentclass[tikz,border=4pt]{{standalone}}\n"
        f"{PREAMBLE}{styles(kinds_of(marks))}\\begin{{document}}\n{picture(marks)}\\end{{document}}\n"
    )


PREAMBLE = "\\usepackage[utf8]{inputenc}\n\\usepackage[T1]{fontenc}\n\\usepackage{textcomp}\n"


def styles(used: frozenset[str]) -> str:
    """One style a kind, and the colours that they name."""
    colours: dict[str, str] = {}
    lines = []
    for name, stroke, fill, rest in RULES:
        if name in used:
            parts = [f"draw={_colour(stroke, colours)}", f"fill={_colour(fill, colours)}", *_line(rest)]
            lines.append(f"\\tikzset{{ic {name}/.style={{{','.join(parts)}}}}}\n")
    for name, ink, rest in TEXTS:
        if name in used:
            face = r"\itshape" if "italic" in rest else r"\bfseries" if "weight" in rest else ""
            font = f",font={face}" if face else ""
            lines.append(
                f"\\tikzset{{ic {name}/.style={{text={_colour(ink, colours)},inner sep=0pt{font}}}}}\n"
            )
    defined = (f"\\definecolor{{{name}}}{{HTML}}{{{code}}}\n" for name, code in colours.items())
    return "".join((*defined, *lines))


def _colour(ink: Ink | None, colours: dict[str, str]) -> str:
    if ink is None:
        return "none"
    code = ink.light.lstrip("#").upper()
    name = f"ic{code}"
    colours[name] = code
    return name


def _line(rest: str) -> list[str]:
    """Width, dashes, caps and opacity of a style sheet's rule."""
    found: Mapping[str, str] = dict(part.split(":") for part in rest.split(";") if part)
    parts = []
    if width := found.get("stroke-width"):
        parts.append(f"line width={float(width) * UNIT:.4g}pt")
    if dashes := found.get("stroke-dasharray"):
        lengths = [f"{float(d) * UNIT:.4g}pt" for d in dashes.split()]
        pairs = (f"{'off' if n % 2 else 'on'} {length}" for n, length in enumerate(lengths))
        parts.append(f"dash pattern={' '.join(pairs)}")
    if found.get("stroke-linejoin") == "round":
        parts.append("line join=round")
    if found.get("stroke-linecap") == "round":
        parts.append("line cap=round")
    parts += [f"{kind} opacity={found[key]}" for kind, key in _OPACITIES if key in found]
    return parts


_OPACITIES = (("fill", "fill-opacity"), ("draw", "stroke-opacity"))


def picture(marks: Iterable[Mark]) -> str:
    """The picture by itself, for a document that has its `styles`."""
    body = "".join(f"  {line}\n" for mark in marks for line in _lines(mark))
    return f"\\begin{{tikzpicture}}[x={UNIT}pt,y=-{UNIT}pt]\n{body}\\end{{tikzpicture}}\n"


def _lines(mark: Mark) -> Iterable[str]:
    match mark:
        case MarkGroup():
            if mark.title:
                yield f"% {re.sub(r'[^ -~]', ' ', mark.title)}"
            for one in mark.marks:
                yield from _lines(one)
        case AreaMark():
            rings = " ".join(f"{_chain(ring)} -- cycle" for ring in mark.rings)
            yield f"\\path[ic {mark.kind},even odd rule] {rings};"
        case Stroke():
            yield f"\\path[ic {mark.kind}] {_chain(mark.points)};"
        case Disc():
            yield f"\\path[ic {mark.kind}] {_at(mark.centre)} circle[radius={mark.radius * UNIT:.2f}pt];"
        case ArcMark():
            ends = f"start angle={mark.start:.2f},delta angle={mark.sweep:.2f}"
            yield f"\\path[ic {mark.kind}] {_at(mark.at(0.0))} arc[{ends},radius={mark.radius * UNIT:.2f}pt];"
        case TextMark():
            yield _text(mark)


def _chain(points: Iterable[tuple[float, float]]) -> str:
    return " -- ".join(map(_at, points))


def _at(p: tuple[float, float]) -> str:
    return f"({p[0] + 0.0:.2f},{p[1] + 0.0:.2f})"


def _text(text: TextMark) -> str:
    anchor = {"start": "west", "middle": "center", "end": "east"}[text.anchor]
    size = next(command for least, command in SIZES if text.size >= least)
    return f"\\node[ic {text.kind},anchor={anchor}] at {_at(text.at)} {{{size} {runs(text.runs)}}};"


def runs(parts: Iterable[TextRun]) -> str:
    """A text with its subscripts."""
    return "".join(
        rf"\textsubscript{{{escaped(run.text)}}}" if run.low else escaped(run.text) for run in parts
    )
