"""The characters of an answer made plain: one minus, one space, ordinary digits, ``^`` for superscripts."""

from __future__ import annotations

import re
import unicodedata

_MINUS = "−‐‑‒–—―﹣－➖"
_SPACES = "\u00a0\u1680\u202f\u205f\u3000" + "".join(map(chr, range(0x2000, 0x200B)))
_GONE = "\ufeff\u200b\u200c\u200d\u2060\u00ad\u200e\u200f\u061c\ufe0e\ufe0f\0"
_GONE += "\u202a\u202b\u202c\u2066\u2067\u2068\u2069"
"""Marks that nobody sees; not the two that turn digits round."""
_SAME = {
    "×✕✖⨯": "×",
    "⋅∙•‧・": "·",
    "º˚": "°",
    "′’‘ʼ´`": "'",
    "″“”„": '"',
    "≈≃≅∼": "~",
    "：": ":",
    "＝": "=",
    "，": ",",
    "．": ".",
    "；": ";",
    "（": "(",
    "）": ")",
    "／⁄∕÷": "/",
    "＋﹢": "+",
    "＊∗": "*",
    "％": "%",
    "٫": ".",
    "٬": "'",
    "↺⟲": " ccw ",
    "↻⟳": " cw ",
    "→⇒➔➡⟶": " right ",
    "←⇐⬅⟵": " left ",
    "↑⇑⬆": " up ",
    "↓⇓⬇": " down ",
    "↗⬈": " at 45 deg ",
    "↖⬉": " at 135 deg ",
    "↙⬋": " at 225 deg ",
    "↘⬊": " at 315 deg ",
    "∠∡": " at ",
    "½": " 1/2",
    "⅓": " 1/3",
    "⅔": " 2/3",
    "¼": " 1/4",
    "¾": " 3/4",
    "⅕": " 1/5",
    "⅛": " 1/8",
    "⅜": " 3/8",
    "⅝": " 5/8",
    "⅞": " 7/8",
    "π": "pi",
}
_TABLE = str.maketrans(
    dict.fromkeys(_MINUS, "-")
    | dict.fromkeys(_SPACES, " ")
    | dict.fromkeys(_GONE, "")
    | {c: plain for many, plain in _SAME.items() for c in many}
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_SUPERSCRIPT = re.compile("[⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_LATEX = (
    (re.compile(r"\\(?:times|cdot)\b"), "×"),
    (re.compile(r"\\(?:mathrm|text|,|;|!|left|right)\b|\\[,;! ]"), " "),
    (re.compile(r"\\circ\b"), "°"),
    (re.compile(r"\^\s*\{\s*°?\s*\}|\^\s*°"), "°"),
    (re.compile(r"\^\s*[{(]\s*([-+]?\d+)\s*[})]"), r"^\1"),
    (re.compile(r"\$"), " "),
    (re.compile(r"<\s*sup\s*>\s*([-+]?\d+)\s*<\s*/\s*sup\s*>"), r"^\1"),
    (re.compile(r"\s*-+>\s*"), " right "),
    (re.compile(r"\s*<-+\s*"), " left "),
)


def plain(text: str) -> str:
    """``text`` in plain characters, one space where there were several."""
    if not text.isascii():
        text = _SUPERSCRIPT.sub(lambda m: "^" + m.group().translate(_RAISED), text)
        text = _digits(text.translate(_TABLE))
    if any(mark in text for mark in ("\\", "$", "^{", "^(", "<", "->")):
        for pattern, replacement in _LATEX:
            text = pattern.sub(replacement, text)
    return " ".join(text.replace("\0", "").split())


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
