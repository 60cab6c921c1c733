"""The characters of an answer made plain: one minus, one space, ordinary digits, no HTML or LaTeX."""

from __future__ import annotations

import html
import re
import unicodedata

_MINUS = "−‐‑‒–—―﹣－➖"
_SPACES = "\u00a0\u1680\u202f\u205f\u3000" + "".join(map(chr, range(0x2000, 0x200B)))
_GONE = "\ufeff\u200b\u200c\u200d\u2060\u00ad\u200e\u200f\u061c\ufe0e\ufe0f\0"
_GONE += "\u202a\u202b\u202c\u2066\u2067\u2068\u2069"
"""Marks that nobody sees; not the two that turn digits round."""
_SAME = {
    "×✕✖⨯": "×", "⋅∙•‧・": "·", "º˚": "°", "′’‘ʼ´`": "'", "″“”„«»": '"', "≈≃≅∼≐": "~", "：": ":",
    "＝": "=", "，": ",", "．": ".", "；": ";", "（": "(", "）": ")", "／⁄∕÷": "/", "＋﹢": "+", "＊∗": "*",
    "％": "%", "٫": ".", "٬": "'", "≥⩾≧": ">=", "≤⩽≦": "<=", "…": "...", "＜": "<", "＞": ">",
    "↺⟲": " ccw ", "↻⟳": " cw ",
    "→⇒➔➡⟶": " right ", "←⇐⬅⟵": " left ", "↑⇑⬆": " up ", "↓⇓⬇": " down ",
    "↗⬈": " at 45 deg ", "↖⬉": " at 135 deg ", "↙⬋": " at 225 deg ", "↘⬊": " at 315 deg ", "∠∡": " at ",
    "½": " 1/2", "⅓": " 1/3", "⅔": " 2/3", "¼": " 1/4", "¾": " 3/4", "⅕": " 1/5",
    "⅛": " 1/8", "⅜": " 3/8", "⅝": " 5/8", "⅞": " 7/8", "π": "pi",
}  # fmt: skip
_TABLE = str.maketrans(
    dict.fromkeys(_MINUS, "-")
    | dict.fromkeys(_SPACES, " ")
    | dict.fromkeys(_GONE, "")
    | {c: plain for many, plain in _SAME.items() for c in many}
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_SUPERSCRIPT = re.compile("[⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_TAG = re.compile(r"</?[a-zA-Z][a-zA-Z0-9]*(?:\s[^<>]*)?/?>")
_RAISED_TAG = re.compile(r"<\s*sup\s*>\s*([-+−]?\d+)\s*<\s*/\s*sup\s*>")
_LATEX = (
    (re.compile(r"\\(?:boxed|fbox|mathbf|textbf|underline)\s*\{(.*)\}"), r"\1"),
    (re.compile(r"~(?=\\)"), " "),
    (re.compile(r"\\(?:SI|qty)\s*\{([^{}]*)\}\s*\{([^{}]*)\}"), r"\1 \2"),
    (re.compile(r"\\num\s*\{([^{}]*)\}"), r"\1"),
    (re.compile(r"\\[dt]?frac\s*\{\s*(\d+)\s*\}\s*\{\s*(\d+)\s*\}"), r"\1/\2"),
    (re.compile(r"(?<=\d)\\,(?=\d)"), ","),  # Canvas writes a comma of a blank so
    (re.compile(r"(?:mathrm|text|mathit|operatorname)\s*(?=\{)"), ""),
    (re.compile(r"\\times(?![A-Za-z])"), "×"),
    (re.compile(r"\\cdot(?![A-Za-z])"), "·"),
    (re.compile(r"\\(?:approx|simeq|sim)(?![A-Za-z])"), "~"),
    (re.compile(r"\\(?:geq?|geqslant)(?![A-Za-z])"), ">="),
    (re.compile(r"\\(?:leq?|leqslant)(?![A-Za-z])"), "<="),
    (re.compile(r"\\(?:to|rightarrow)(?![A-Za-z])"), " right "),
    (re.compile(r"\\(?:omega|Omega)(?![A-Za-z])"), "ω"),
    (re.compile(r"\^?\s*\{?\s*\\(?:circ|degree)(?![A-Za-z])\s*\}?"), "°"),
    (re.compile(r"\\(?:left|right|quad|displaystyle)(?![A-Za-z])|\\[,;:!() \[\]]"), " "),
    (re.compile(r"\^\s*[{(]\s*([-+]?\d+)\s*[})]"), r"^\1"),
    (re.compile(r"_\s*\{\s*([\w ,/']+)\s*\}"), r"_\1"),
    (re.compile(r"\^\s*\{\s*°?\s*\}|\^\s*°"), "°"),
    (re.compile(r"\\(?=\{)|\$"), " "),
    (re.compile(r"\{([^{}\d]*[A-Za-z][^{}]*)\}"), r"\1"),
)
"""What is left of a command that is not here keeps its backslash, and so is no number or word."""
_ARROWS = ((re.compile(r"(?<![<=])-+>"), " right "), (re.compile(r"<-+(?!\d)"), " left "))


def plain(text: str) -> str:
    """``text`` in plain characters, one space where there were several."""
    if "<" in text or "&" in text:
        text = _unmarked(text)
    if not text.isascii():
        text = _SUPERSCRIPT.sub(lambda m: "^" + m.group().translate(_RAISED), text)
        text = _digits(text.translate(_TABLE))
    if any(mark in text for mark in ("\\", "$", "^", "_{")):
        for pattern, replacement in _LATEX:
            text = pattern.sub(replacement, text)
    if ">" in text or "<" in text:
        for pattern, replacement in _ARROWS:
            text = pattern.sub(replacement, text)
    return " ".join(text.replace("\0", "").split())


def _unmarked(text: str) -> str:
    """Without the tags and entities of HTML, in which rich text editors hand in."""
    text = _RAISED_TAG.sub(r"^\1", text)
    return html.unescape(_TAG.sub(" ", text))


def _digits(text: str) -> str:
    """Digits of other scripts as ASCII ones; full-width letters as ordinary ones."""
    if text.isascii():
        return text
    return "".join(_plain_character(c) for c in text)


def _plain_character(c: str) -> str:
    digit = unicodedata.digit(c, None)
    if digit is not None and c.isdecimal():
        return str(digit)
    if "\uff01" <= c <= "\uff5e":
        return chr(ord(c) - 0xFEE0)
    return c
