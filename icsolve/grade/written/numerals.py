"""The characters of an answer made plain, and the number at its start: decimals, thousands, powers of ten.

A numeral with two readings (``1,234``; ``4 x 102``) is not guessed: it comes back with a flag.
"""

from __future__ import annotations

import html
import math
import re
import unicodedata

from icsolve.tuples import NamedTuple

AMBIGUOUS = "ambiguous-number"
UNREAD = "unread"

_RUN = re.compile(r"(?:\d+|[.,]\d+)(?:[.,'_]\d+|(?<=\d) \d{3}(?![\d.,]*\d*/)(?!\d))*[.,]?")
_EXPONENT = re.compile(r" ?[eE]{1,2} ?([-+]?\d+)(?!\d|[.,]\d)")
_TIMES_TEN = re.compile(r" ?[xX×*·]? ?10 ?(?:\^|\*\*) ?([-+]?\d+)(?!\d|[.,]\d)")
_LOST_SUPERSCRIPT = re.compile(r" ?[xX×*·] ?10 ?-? ?\d")
_MIXED = re.compile(r" (\d+) ?/ ?(\d+)(?![\d.,/])")
_OF = re.compile(r" ?/ ?(?=\d)")
_ROOT = re.compile(r"(?: ?[*·×x]? ?)(?:√ ?\(? ?|sqrt ?\( ?)(\d+(?:\.\d+)?) ?\)?", re.IGNORECASE)
_PI = re.compile(r"(?: ?[*·×x]? ?)pi(?![a-z])", re.IGNORECASE)
_MOST_DIGITS = 400


class WrittenNumber(NamedTuple):
    """A number as written: its value, where it ends in the text, the digits that carry it, and a flag.

    ``digits`` is the part that counts for significant figures. With a ``flag`` the value is not to be used.
    """

    value: float
    end: int
    digits: str
    flag: str = ""


def numeral(text: str, start: int = 0, decimal: str = "either") -> WrittenNumber | None:
    """The unsigned number that starts at ``start``; None where none starts there.

    ``decimal`` says what a comma or point before three digits is: ``point``, ``comma``, or ``either``
    (then ``1,234`` is flagged).
    """
    leading = _leading_factor(text, start)
    if leading is not None:
        return _over(text, leading, decimal)
    if text.startswith("10^", start) or text.startswith("10**", start):
        power = _TIMES_TEN.match(text, start)
        return _scaled("1", power) if power else None
    found = _simple(text, start, decimal)
    if found is None or found.flag:
        return found
    whole = _exponent(text, found) or _mixed(text, found)
    return whole or _over(text, _factor(text, found) or found, decimal)


def _leading_factor(text: str, start: int) -> WrittenNumber | None:
    """A root or pi that no numeral stands before: ``√2``, ``pi``."""
    if text[start : start + 1] not in "√spSP" or not text[start : start + 1]:
        return None
    return _factor(text, WrittenNumber(1.0, start, ""))


def _simple(text: str, start: int, decimal: str) -> WrittenNumber | None:
    """Digits with their decimal mark and groups."""
    found = _RUN.match(text, start)
    if found is None:
        return None
    run = found.group()
    end = found.end()
    if run[-1] in ".," and len(run) > 1:
        run, end = run[:-1], end - (run[-1] == ",")
    if len(run) > _MOST_DIGITS:
        return WrittenNumber(0.0, end, "", UNREAD)
    return _classified(run, end, decimal)


def _classified(run: str, end: int, decimal: str) -> WrittenNumber:
    """The value of a run of digits and marks: of a point and a comma the last is the decimal mark, and one
    alone may be either."""
    if run.isdigit() or (run.replace(".", "", 1).isdigit() and decimal != "comma"):
        return WrittenNumber(float(run), end, run)
    marks, spaces = set(run) & set(".,"), set(run) & set(" '_")
    mark, group = max(marks, key=run.rfind, default=""), ""
    if len(marks) == 2:
        group = "," if mark == "." else "."
    elif mark and (mark != ("," if decimal == "comma" else ".") or run.count(mark) > 1):
        if run.count(mark) == 1 and decimal == "either" and len(spaces) < 2 and _is_grouped(run, mark):
            return WrittenNumber(0.0, end, run, AMBIGUOUS)
        if run.count(mark) > 1 or _is_grouped(run, mark):
            mark, group = "", mark
    whole, _, part = run.partition(mark) if mark else (run, "", "")
    good = len(spaces) < 2 and (not group or _is_grouped(whole, group))
    whole = whole.replace(group, "")
    for space in spaces:
        *full, last = part.split(space)
        good = good and all(len(one) == 3 for one in full) and (not full or len(last) <= 3)
        good = good and (space not in whole or _is_grouped(whole, space))
        whole, part = whole.replace(space, ""), part.replace(space, "")
    if not good or not (whole + part).isdigit():
        return WrittenNumber(0.0, end, run, UNREAD)
    digits = f"{whole}{'.' if mark else ''}{part}"
    return WrittenNumber(float(digits), end, digits)


def _is_grouped(text: str, mark: str) -> bool:
    """Whether the marks stand where thousands are divided: ``1,234,567``."""
    first, *rest = text.split(mark)
    return 1 <= len(first) <= 3 and first[0] != "0" and all(len(group) == 3 for group in rest)


def _exponent(text: str, found: WrittenNumber) -> WrittenNumber | None:
    """The number times its power of ten, where one follows."""
    power = _EXPONENT.match(text, found.end) or _TIMES_TEN.match(text, found.end)
    if power is not None:
        return _scaled(found.digits, power)
    if _LOST_SUPERSCRIPT.match(text, found.end):
        return found._replace(flag=AMBIGUOUS)
    return None


def _scaled(digits: str, power: re.Match[str]) -> WrittenNumber:
    """Digits times the power of ten that was matched."""
    value = float(f"{digits}e{power.group(1)}") if len(power.group(1)) <= 5 else math.inf
    flag = UNREAD if math.isinf(value) else ""
    return WrittenNumber(value, power.end(), digits, flag)


def _mixed(text: str, found: WrittenNumber) -> WrittenNumber | None:
    """A whole number and a fraction: ``1 1/2``."""
    parts = _MIXED.match(text, found.end)
    if parts is None or not found.digits.isdigit():
        return None
    top, bottom = int(parts.group(1)), int(parts.group(2))
    if bottom == 0 or top >= bottom:
        return found._replace(flag=UNREAD)
    return WrittenNumber(found.value + top / bottom, parts.end(), "")


def _factor(text: str, found: WrittenNumber) -> WrittenNumber | None:
    """The number times a root or pi."""
    root = _ROOT.match(text, found.end)
    if root is not None:
        return WrittenNumber(found.value * math.sqrt(float(root.group(1))), root.end(), "")
    pi = _PI.match(text, found.end)
    return WrittenNumber(found.value * math.pi, pi.end(), "") if pi is not None else None


def _over(text: str, found: WrittenNumber, decimal: str) -> WrittenNumber:
    """The number over another one, where a ``/`` and digits follow."""
    slash = _OF.match(text, found.end)
    if slash is None:
        return found
    below = _simple(text, slash.end(), decimal)
    if below is None or text[below.end : below.end + 1] == "/":
        return found._replace(flag=UNREAD)
    if below.flag or below.value == 0.0:
        return found._replace(end=below.end, flag=below.flag or UNREAD)
    return WrittenNumber(found.value / below.value, below.end, "")


def figures(digits: str) -> tuple[int, int]:
    """Least and most significant figures that a numeral may have: ``100`` has 1 to 3; (0, 0) for none."""
    mantissa = re.split("[eE]", digits.strip().lstrip("+-"))[0]
    whole, point, part = mantissa.partition(".")
    counted = (whole + part).lstrip("0")
    if point or not counted:
        return len(counted), len(counted)
    return len(counted.rstrip("0")), len(counted)


_MINUS = "−‐‑‒–—―﹣－➖"
_SPACES = "\u00a0\u1680\u202f\u205f\u3000" + "".join(map(chr, range(0x2000, 0x200B)))
_UNSEEN = "\ufeff\u200b\u200c\u200d\u2060\u00ad\u200e\u200f\u061c\ufe0e\ufe0f\0"
_UNSEEN += "\u202a\u202b\u202c\u2066\u2067\u2068\u2069"
"""Marks that nobody sees; not the two that turn digits round."""
_AS_NOTHING = dict.fromkeys(map(ord, _UNSEEN))
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
    | dict.fromkeys(_UNSEEN, "")
    | {c: plain for many, plain in _SAME.items() for c in many}
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_HAT = re.compile("(?<![^\\W\\d_])(?:î|ĵ|[ijk]\u0302)")
_SUPERSCRIPT = re.compile("[⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_TAG = re.compile(r"</?[a-zA-Z][a-zA-Z0-9]*(?:\s[^<>]*)?/?>")
_RAISED_TAG = re.compile(r"<\s*sup\s*>\s*([-+−]?\d+)\s*<\s*/\s*sup\s*>")
_LATEX = (
    (
        re.compile(
            r"\\(?:hat|vec|boldsymbol|bm|mathbf|textbf)\s*\{?\s*\\?([ijk])(?:math)?(?![A-Za-z])\s*\}?"
        ),
        r" \1-hat ",
    ),
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
    if "<" in text or "&" in text:  # of rich text editors
        text = html.unescape(_TAG.sub(" ", _RAISED_TAG.sub(r"^\1", text)))
    if not text.isascii():
        text = unicodedata.normalize("NFC", text)
        text = _HAT.sub(lambda m: f" {unicodedata.normalize('NFD', m[0])[0]}-hat ", text)
        text = _SUPERSCRIPT.sub(lambda m: "^" + m.group().translate(_RAISED), text)
        text = "".join(map(_plain_character, text.translate(_TABLE)))
    if any(mark in text for mark in ("\\", "$", "^", "_{")):
        for pattern, replacement in _LATEX:
            text = pattern.sub(replacement, text)
    if ">" in text or "<" in text:
        for pattern, replacement in _ARROWS:
            text = pattern.sub(replacement, text)
    return " ".join(text.replace("\0", "").split())


def _plain_character(c: str) -> str:
    """Of another script the digit as an ASCII one; a full-width letter as an ordinary one."""
    digit = unicodedata.digit(c, None)
    if digit is not None and c.isdecimal():
        return str(digit)
    if "\uff01" <= c <= "\uff5e":
        return chr(ord(c) - 0xFEE0)
    return c


def without_unseen(text: str) -> str:
    """A name without the marks that nobody sees, which pages put between the letters that are copied, with
    each accent in its letter: some systems write it after."""
    return text if text.isascii() else unicodedata.normalize("NFC", text.translate(_AS_NOTHING))
