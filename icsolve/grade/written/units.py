"""The unit that a student wrote, in the spellings that people use.

Names of the case format come first; then full words and abbreviations in other capitals, with the note
``unit-case`` where capitals would matter to a strict reader; then units that no case uses (joules,
pascals) but that an answer may have by mistake.
"""

from __future__ import annotations

import re

from icsolve.numbers.units import (
    DIMENSIONS,
    LISTED,
    UNITS,
    Dimension,
    Unit,
    UnitError,
    canonical,
    factor,
    parse_unit,
    times,
)
from icsolve.tuples import NamedTuple

CASE = "unit-case"
AMBIGUOUS = "ambiguous-unit"
ENERGY = "energy"

_STRESS: Dimension = (-1, 1, -2, 0)
_EXTRA = {
    "J": parse_unit("N*m"),
    "kJ": parse_unit("kN*m"),
    "daN": Unit(10, 1, 0, DIMENSIONS["force"]),
    "dyn": Unit(1, 10**5, 0, DIMENSIONS["force"]),
    "tf": parse_unit("kgf")._replace(num=980665 * 1000),
    "kp": parse_unit("kgf"),
    "dm": Unit(1, 10, 0, DIMENSIONS["length"]),
    "µm": Unit(1, 10**6, 0, DIMENSIONS["length"]),
    "%": Unit(1, 100, 0, DIMENSIONS["number"]),
    "Pa": Unit(1, 1, 0, _STRESS),
    "kPa": Unit(1000, 1, 0, _STRESS),
    "MPa": Unit(10**6, 1, 0, _STRESS),
    "psi": times(times(parse_unit("lbf"), parse_unit("in"), -1), parse_unit("in"), -1),
}
_ENERGIES = frozenset({"J", "kJ"})
"""Units of energy, which is no torque though it is force times length."""
_AMBIGUOUS = {"mn", "mN", "Mn", "mNm", "mN*m", "mnm", "mN-m", "mN·m", "oz.", "ton", "tons", "k"}
"""Names that mean one unit to some and another to others: millinewtons or meganewtons."""

_SPOKEN = (
    (re.compile(r"#"), "lb"),
    (re.compile(r"\b(?:pounds?|lbs?)[- ](?:of )?force\b", re.IGNORECASE), "lbf"),
    (re.compile(r"\bkilo[ -]newtons?\b", re.IGNORECASE), "kN"),
    (re.compile(r"\bnewtons?\b", re.IGNORECASE), "N"),
    (re.compile(r"\b(?:m[eè]tres?|meters?|metri|metros?)\b", re.IGNORECASE), "m"),
    (re.compile(r"\bjoules?\b", re.IGNORECASE), "J"),
    (re.compile(r"\bkilojoules?\b", re.IGNORECASE), "kJ"),
    (re.compile(r"\bnewtonmeters?\b", re.IGNORECASE), "N*m"),
    (re.compile(r"\bfeet\b", re.IGNORECASE), "ft"),
    (re.compile(r"\bpound-?mass\b", re.IGNORECASE), "lbm"),
    (re.compile(r"\b(kg|lb|lbs)[- ]?f\b", re.IGNORECASE), r"\1f"),
    (re.compile(r"\binches\b", re.IGNORECASE), "in"),
    (re.compile(r"\br\.?p\.?m\b\.?", re.IGNORECASE), "rpm"),
    (re.compile(r"\brads\b", re.IGNORECASE), "rad"),
    (re.compile(r"\bdegs\b", re.IGNORECASE), "deg"),
)
_DOTTED = re.compile(r"(?<=[A-Za-z])\.(?=$|[ )/*·×-])")
_WORD = re.compile(r"[A-Za-zµ°]+")
_LONGEST = 60
_BY_FOLD: dict[str, list[str]] = {}
for _name in UNITS:
    _BY_FOLD.setdefault(_name.lower(), []).append(_name)
_GLUED = {
    a + b: f"{a}*{b}"
    for first, second in (("N kN MN", "m cm mm"), ("lb lbf lbs kip", "in ft"), ("in ft", "lb lbf lbs kip"))
    for a in first.split()
    for b in second.split()
}
"""Torques in one word."""


_ANY_CAPITALS = frozenset("in ft yd lb lbs lbf kip rpm rad deg rev hp".split())
"""Names without a prefix that capitals could change."""


class UnitWord(NamedTuple):
    """A unit as read: ``name`` is its plain spelling; ``note`` is ``unit-case``, ``ambiguous-unit``,
    ``energy`` (for a torque a wrong unit) or ''."""

    unit: Unit
    name: str
    note: str = ""


def unit_word(text: str) -> UnitWord | None:
    """The unit of a text in plain characters; None where it is none."""
    text = text.strip()
    if not text or len(text) > _LONGEST:
        return None
    if text in _AMBIGUOUS:
        return UnitWord(parse_unit("N"), text, AMBIGUOUS)
    return _exact(text) or _spoken(text) or _other_case(text)


def _exact(text: str) -> UnitWord | None:
    if text in _EXTRA:
        return UnitWord(_EXTRA[text], text, ENERGY if text in _ENERGIES else "")
    if text in ('"', "'"):
        return UnitWord(UNITS["in" if text == '"' else "ft"], "in" if text == '"' else "ft")
    unit = _parsed(text)
    return UnitWord(unit, _shown(_DOTTED.sub("", text))) if unit is not None else None


def _parsed(text: str) -> Unit | None:
    try:
        return parse_unit(text)
    except UnitError:
        return None


def _shown(text: str) -> str:
    """A product with ``*`` between its words, each by its listed name, however it was written."""
    joined = re.sub(r"(?<=[A-Za-z\d]) ?[·×.*-] ?(?=[A-Za-z])|(?<=[A-Za-z\d]) (?=[A-Za-z])", "*", text.strip())
    joined = re.sub(r"\*per\*| ?/ ?", "/", joined)
    return _WORD.sub(lambda found: _listed(found.group()), joined)


def _listed(name: str) -> str:
    """``ft`` for ``foot``, ``N*m`` for ``Nm``; what is listed stays."""
    if name not in UNITS and name.lower() in UNITS:
        name = name.lower()
    if name in LISTED or name not in UNITS:
        return name
    return _GLUED.get(name) or canonical(name)


def _spoken(text: str) -> UnitWord | None:
    """After abbreviations and spoken forms are made plain."""
    plain = _DOTTED.sub("", text)
    for pattern, replacement in _SPOKEN:
        plain = pattern.sub(replacement, plain)
    plain = plain.replace("×", "*").strip(" ,;")
    return _exact(plain) if plain != text and plain else None


def _other_case(text: str) -> UnitWord | None:
    """As some spelling of its words in other capitals."""
    note = ""

    def known(match: re.Match[str]) -> str:
        nonlocal note
        name, changed = _folded(match.group())
        note = note or changed
        return name

    plain = _WORD.sub(known, _DOTTED.sub("", text))
    found = _spoken(plain) or _exact(plain) if plain != text else None
    return found._replace(note=found.note or note) if found is not None else None


def _folded(word: str) -> tuple[str, str]:
    """A word's nearest name in other capitals, and the note that this earns."""
    if word in UNITS:
        return word, ""
    if word in _AMBIGUOUS:
        return word, AMBIGUOUS
    names = _BY_FOLD.get(word.lower())
    if not names:
        return word, ""
    return names[0], "" if len(names[0]) > 3 or names[0] in _ANY_CAPITALS else CASE


def factors_between(unit: Unit, target: Unit) -> float | None:
    """How many ``target`` make one ``unit``; None where they measure different things.

    A number without dimension and an angle agree (radians), as in rad/s and 1/s.
    """
    if unit.dims[:3] != target.dims[:3]:
        return None
    return factor(unit._replace(dims=target.dims), target)
