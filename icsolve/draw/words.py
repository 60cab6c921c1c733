"""Names and numbers as a figure writes them."""

from __future__ import annotations

import math
import re

from icsolve.draw.marks import Run, text_width

DIGITS = 4


def figure_number(value: float, digits: int = DIGITS) -> str:
    """A number with so many significant digits, without an exponent where it can do without."""
    value = float(format(value, f".{digits}g")) + 0.0
    if value == 0.0:
        return "0"
    if 1e-4 <= abs(value) < 10.0 ** max(digits, 7):
        decimals = max(digits - 1 - math.floor(math.log10(abs(value))), 0)
        text = f"{value:.{decimals}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
    else:
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        text = f"{mantissa.rstrip('0').rstrip('.')}×10{str(int(exponent)).translate(_RAISED)}"
    return text.replace("-", "−")


_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def unit_word(unit: str) -> str:
    """``lbf*in`` with a dot between."""
    return unit.replace("*", "·")


def quantity(value: float, unit: str, digits: int = DIGITS) -> str:
    """A number with its unit."""
    return f"{figure_number(value, digits)} {unit_word(unit)}".rstrip()


def name_runs(name: str) -> tuple[Run, ...]:
    """``T12`` as a T with 12 set low, ``B'`` as it is."""
    found = re.fullmatch(r"([^\W\d_]+)_?(\d+)('*)", name)
    if found is None:
        return (Run(name),)
    letters, digits, primes = found.groups()
    return (Run(letters + primes), Run(digits, True))


def centre_runs(a: str, b: str) -> tuple[Run, ...]:
    """I with the pair of links set low: ``24``, or ``crank,rod``."""
    low = a + b if len(a) == len(b) == 1 else f"{a},{b}"
    return (Run("I"), Run(low, True))


def force_runs(name: str, by: str, on: str, where: str) -> tuple[Run, Run]:
    """F with the links low, and the joint's point where the pair has several joints."""
    low = centre_runs(by, on)[1].text
    return (Run("F"), Run(f"{low}@{where}" if "@" in name else low, True))


def wrapped(text: str, size: float, width: float) -> list[str]:
    """A text in lines of a width; a word that is longer than a line is cut."""
    lines: list[str] = []
    line = ""
    for whole in text.split():
        word = whole
        longer = f"{line} {word}" if line else word
        if text_width(longer, size) <= width:
            line = longer
            continue
        if line:
            lines.append(line)
        while text_width(word, size) > width:
            cut = _fitting(word, size, width)
            lines.append(word[:cut])
            word = word[cut:]
        line = word
    return [*lines, line] if line else lines


def _fitting(word: str, size: float, width: float) -> int:
    """How many characters of a word fill a line; one at least."""
    count = 1
    while count < len(word) and text_width(word[: count + 1], size) <= width:
        count += 1
    return count
