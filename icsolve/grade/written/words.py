"""The words about a number that a student wrote: its direction (a turn, a heading, toward a point, pull or
push) and its unit, in the spellings that people use.

Names of units in the case format come first; then full words and abbreviations in other capitals, with the
note ``unit-case`` where capitals would matter to a strict reader; then units that no case uses (joules,
pascals) but that an answer may have by mistake.
"""

from __future__ import annotations

import math
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

AMBIGUOUS_DIRECTION = "ambiguous-direction"


class WrittenDirection(NamedTuple):
    """A direction in words.

    ``kind`` is ``turn`` (``value`` +1 ccw, -1 cw), ``line`` (``value`` in degrees ccw from +x),
    ``axial`` (+1 pull, -1 push), ``toward`` or ``away`` (of the point ``name``), ``sign`` (+1, -1);
    with a ``flag`` the words have two readings.
    """

    kind: str
    value: float
    words: str
    name: str = ""
    flag: str = ""
    measured: bool = False
    """Whether it is an angle in degrees, and not words."""
    signed: bool = False
    """Whether it says which way is positive, so that the number's sign goes with it."""

    @property
    def opposite(self) -> WrittenDirection:
        """The other way, of a turn, a line, a pull or a push."""
        if self.kind == "line":
            return _line(self.value + 180.0)
        return {CCW: CW, CW: CCW, PULL: PUSH}.get(self, PULL)


def _line(degrees: float) -> WrittenDirection:
    degrees = round(degrees, 9) % 360.0
    named = {0.0: "right", 90.0: "up", 180.0: "left", 270.0: "down"}.get(degrees)
    return WrittenDirection("line", degrees, named or f"at {degrees:.10g} deg")


def at_angle(degrees: float) -> WrittenDirection:
    """The direction at an angle ccw from +x [degrees]."""
    return _line(degrees)._replace(measured=True)


CCW = WrittenDirection("turn", 1.0, "ccw")
CW = WrittenDirection("turn", -1.0, "cw")
PULL = WrittenDirection("axial", 1.0, "pull")
PUSH = WrittenDirection("axial", -1.0, "push")
DOUBTFUL = WrittenDirection("line", 0.0, "", "", AMBIGUOUS_DIRECTION)

_PHRASES = """\
ccw | ccw, acw, c.c.w, counterclockwise, counter clockwise, counterclock wise, counter clock wise
ccw | anticlockwise, anti clockwise, anticlock wise, contraclockwise
ccw | linksdrehend, linksherum, links herum
ccw | gegen uhrzeigersinn, entgegen uhrzeigersinn, gegenuhrzeigersinn, guzs, gegen uzs
ccw | antihoraire, anti horaire, trigonométrique, trigonometrique, trigo
ccw | inverse aiguilles montre, contraire aiguilles montre, inverse horaire, inverse aiguilles d'une montre
ccw | contraire aiguilles d'une montre
ccw | antihorario, anti horario, contrario agujas reloj, contrario manecillas reloj, contra agujas reloj
ccw | contra manecillas reloj, levógiro, antiorario, anti orario
cw | cw, c.w, clockwise, clock wise, rechtsdrehend, rechtsherum, rechts herum, uhrzeigersinn, uzs
cw | horaire, aiguilles montre, aiguilles d'une montre, horario, agujas reloj, manecillas reloj, dextrógiro
cw | orario, rechtsom, klok mee, horário
ccw | linksom, tegen klok, anti horário
pull | pull, pulls, pulling, tension, tensile, zug, zugkraft, traction, tracción, traccion, trazione, tirant
pull | trek, tração
push | push, pushes, pushing, compression, compressive, druck, druckkraft, compresión, compresion
push | compressione, druk, compressão
right | right, rightward, rightwards, horizontally right, horizontal right, rechts, droite, derecha, destra
right | +x, positive x, plus x, direita
up | up, upward, upwards, vertically up, vertically upward, vertically upwards, vertical up, vertical upward
up | oben, aufwärts, haut, arriba, alto, l'alto, omhoog, boven, cima, +y, positive y, plus y, opwaarts
left | left, leftward, leftwards, horizontally left, horizontal left, links, gauche, izquierda, sinistra
left | -x, negative x, minus x, esquerda
down | down, downward, downwards, vertically down, vertically downward, vertically downwards, vertical down
down | vertical downward, unten, abwärts, bas, abajo, basso, -y, negative y, minus y, omlaag, beneden, baixo
down | neerwaarts, vertical downwards, downward vertically, downwards vertically
up | vertical upwards, upward vertically, upwards vertically
right | right side
left | left side
"""
_NAMED = {"ccw": CCW, "cw": CW, "pull": PULL, "push": PUSH} | {
    name: _line(degrees) for name, degrees in (("right", 0.0), ("up", 90.0), ("left", 180.0), ("down", 270.0))
}
_WORDS: dict[str, WrittenDirection] = {
    phrase: _NAMED[name.strip()]
    for name, _, phrases in (line.partition("|") for line in _PHRASES.splitlines())
    for phrase in phrases.strip().split(", ")
}
"""What is left of a phrase without its filling words, in the languages of the platforms' tables."""

_SIDES = {"right": (1, 0), "left": (-1, 0), "up": (0, 1), "down": (0, -1)}
_FILLER = re.compile(
    r"(?<![\w'])(?:in|the|to|a|an|is|are|it|its|acts?|acting|applied|directed|pointing|points|directions?|dir|sense"
    r"|going|towards?|rotation|rotates?|rotating|turns?|turning|moment|torque|force|axis|member|being|of|on|and|with"
    r"|along|which|i\.?e|that|gerichtet"
    r"|der|die|das|dem|den|im|mit|nach|und|drehsinn|richtung|dans|le|la|les|des?|du|vers|à|au|sens|en|el|los"
    r"|las|al|del|(?:no )?sentido|hacia|dirección|direccion|il|lo|verso|senso|direzione|si|naar|met|para)"
    r"(?![\w'])\.?"
)
_VECTORS = {"i": _line(0.0), "j": _line(90.0), "k": CCW}
_LETTERS = {"T": PULL, "C": PUSH, "cw": CW, "ccw": CCW} | {
    f"{letter}{hat}": way._replace(signed=True) for letter, way in _VECTORS.items() for hat in ("", "-hat")
}
_NUMBER = r"([-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+))"
_UNIT = r" ?(deg|degs|degrees?|°|rad|radians?|grad)?"
_LEAD = r"(?:(?:at|@|angle|angle of|at angle|at an angle of|unter|bei|à|theta ?=|direction|dir)[ :=]*)"
_ANGLE = re.compile(rf"({_LEAD}?) ?{_NUMBER}{_UNIT}(?: (.+))?$")
_AXES = {
    "x": 0.0, "+x": 0.0, "positive x": 0.0, "-x": 180.0, "negative x": 180.0,
    "y": 90.0, "+y": 90.0, "positive y": 90.0, "-y": 270.0, "negative y": 270.0,
}  # fmt: skip
_ABOVE = re.compile(
    r"(above|below|ccw|cw|from|counterclockwise|anticlockwise|clockwise|left of|right of)"
    r"(?: (?:from|of))? (.+)$"
)
_DOUBTFUL_AXIS = re.compile(
    r"(?:above|below|to|from|with|off|left of|right of|against|over|under)"
    r" (?:horizontal|vertical|x|y|horizontally|vertically)"
)
_TO = (
    r"towards?|to|(?:in )?(?:the )?direction (?:of|to|towards?)|in direction|(?:in )?richtung(?: von| nach)?"
    r"|nach|zu|vers|en direction d[eu']|hacia|en dirección (?:a|de)|verso|in direzione"
)
_FROM = r"away from|away|weg von|à l'opposé d[eu']|alejándose de|via da"
_TOWARD = re.compile(
    rf"(?:(?:and |is |it is )?(?:directed|acting|acts|pointing|points|going|pulling|along [A-Z]{{2}}) )?"
    rf"({_FROM}|{_TO}|from \S+ (?:to|towards?)) (?:the )?(?:point )?([^\W\d_][\w']{{0,7}})$",
    re.IGNORECASE,
)


_STOPS = re.compile(r"[()\[\]{};:!]|(?<!\d),|,(?!\d)|\.(?=$|\s)")
"""No comma between digits, which is a decimal mark."""


def direction(text: str) -> WrittenDirection | None:
    """The direction that a text in plain characters says; None where it says none, or more than that."""
    bare = " ".join(_STOPS.sub(" ", text).split())
    if not bare:
        return None
    if bare in _LETTERS:
        return _LETTERS[bare]
    lower = bare.lower()
    return _WORDS.get(lower) or _toward(bare) or _angle(lower) or _spelled(lower) or _convention(lower)


_PLUS = r"(?:\+|\+ve|positive|pos\.?|plus)"
_CONVENTION = re.compile(
    rf"(?:(?:with|take|taking|taken|where|assuming) )?"
    rf"(?:{_PLUS} ?(?:is |= ?)?(?P<after>.+)|(?P<before>.+?) ?(?:is |as |taken as |= ?)?{_PLUS})$"
)


def _convention(lower: str) -> WrittenDirection | None:
    """Which way is positive: ``ccw positive``, ``taking right as +``."""
    found = _CONVENTION.match(lower)
    words = found and (found["after"] or found["before"]).strip()
    way = words and (_WORDS.get(words) or _spelled(words))
    return way._replace(signed=True) if way and not way.flag else None


def _toward(text: str) -> WrittenDirection | None:
    found = _TOWARD.match(text)
    if found is None:
        return None
    word, name = found.groups()
    if name.lower() in _WORDS and not (len(name) == 1 and name.isupper()):
        return None
    if name.lower() in ("the", "positive", "negative", "uhrzeigersinn") or _FILLER.fullmatch(name):
        return None
    kind = "away" if re.fullmatch(_FROM, word, re.IGNORECASE) else "toward"
    return WrittenDirection(kind, 0.0, f"{kind} {name}" if kind == "toward" else f"away from {name}", name)


_AXIS = re.compile(r"(?<!tive )(?<!plus )(?<!minus )(?<![-+])(?<![-+] )\b([xy]) (?:axis )?direction")
"""``in x direction``, not after a sign of its own."""


def _spelled(lower: str) -> WrittenDirection | None:
    """With words around that say nothing, ``in the clockwise sense``; two sides, ``up and left``."""
    hyphenless = re.sub(r"(?<=[a-z])-(?=[a-z])", " ", lower)
    hyphenless = _AXIS.sub(r"+\1", hyphenless)
    words = " ".join(_FILLER.sub(" ", hyphenless).split())
    if words in _WORDS:
        return _WORDS[words]
    joined = re.sub(r"([-+]) ([xy])", r"\1\2", words)
    return _WORDS.get(joined) or _corner(words) or _turn_after_words(words)


def _turn_after_words(words: str) -> WrittenDirection | None:
    """The same direction said twice: ``clockwise cw``; opposite words (``left right``) have two readings."""
    parts = [part for word in words.split() if (part := _WORDS.get(word)) is not None]
    if len(parts) < 2 or len(parts) < len(words.split()):
        return None
    alike = len({part.kind for part in parts}) == 1
    return parts[0] if len(set(parts)) == 1 else DOUBTFUL if alike else None


def _corner(words: str) -> WrittenDirection | None:
    """``down left`` and the like, half way between two sides."""
    parts = [_WORDS.get(part) for part in words.split()]
    sides = [_SIDES[part.words] for part in parts if part is not None and part.words in _SIDES]
    if len(sides) != 2 or len(parts) != 2:
        return None
    x, y = (sum(side[i] for side in sides) for i in (0, 1))
    return _line(math.degrees(math.atan2(y, x))) if x and y else None


def _angle(lower: str) -> WrittenDirection | None:
    """``at 30 deg``, ``30° above -x``, ``at 30 deg cw from +y``."""
    match = _ANGLE.match(lower)
    if match is None:
        return None
    lead, number, unit, rest = match.groups()
    if not (lead or unit):
        return None
    degrees = float(number.replace(",", "."))
    if unit and unit.startswith("rad"):
        degrees = math.degrees(degrees)
    found = _from_axis(degrees, rest) if rest else _line(degrees)
    return found._replace(measured=True) if found is not None else None


def _from_axis(degrees: float, rest: str) -> WrittenDirection | None:
    """An angle reckoned from an axis; from one with two ends it is doubtful."""
    rest = " ".join(re.sub(r"\b(?:the|axis|direction|measured)\b|-axis\b", " ", rest).split())
    if _DOUBTFUL_AXIS.fullmatch(rest):
        return DOUBTFUL
    found = _ABOVE.match(rest)
    if found is None:  # ``30 deg ccw``: from +x
        turn = _WORDS.get(rest)
        return _line(turn.value * degrees) if turn is not None and turn.kind == "turn" else None
    way, axis = found.groups()
    base = _AXES.get(axis)
    if base is None:  # ``horizontal to the right``
        side = re.sub(r"\b(?:horizontal|vertical|horizontally|vertically|to)\b", " ", axis)
        named = _WORDS.get(" ".join(side.split()))
        base = named.value if named is not None and named.kind == "line" else None
    if base is None:
        return None
    if way == "from" and axis not in ("+x", "positive x") and degrees % 180.0:
        return DOUBTFUL  # to either side of it
    return _line(base + _sign(way, base) * degrees)


def _sign(way: str, base: float) -> float:
    """Which way an angle ``way`` an axis at ``base`` goes, +1 ccw."""
    if way in ("cw", "clockwise"):
        return -1.0
    if way in ("above", "below"):
        return (1.0 if way == "above" else -1.0) * (-1.0 if base == 180.0 else 1.0)
    if way in ("left of", "right of"):
        return (1.0 if way == "left of" else -1.0) * (-1.0 if base == 270.0 else 1.0)
    return 1.0


CASE = "unit-case"
AMBIGUOUS_UNIT = "ambiguous-unit"
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
    "ksi": times(times(parse_unit("kip"), parse_unit("in"), -1), parse_unit("in"), -1),
}
_ENERGIES = frozenset({"J", "kJ"})
"""Units of energy, which is no torque though it is force times length."""
_AMBIGUOUS = {"mn", "mN", "Mn", "mNm", "mN*m", "mnm", "mN-m", "mN·m", "oz.", "ton", "tons", "k"} | {
    "1/min",
    "/min",
    "min^-1",
}
"""Names that mean one unit to some and another to others: millinewtons or meganewtons, radians or turns."""

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
    (re.compile(r"\b(kg|lb)_([fm])\b"), r"\1\2"),
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


_SYMBOL = re.compile(r"[A-Zwω]_?\d")
"""The speed of link 2 or a torque on it, and no power of a watt or a tonne."""


class UnitWord(NamedTuple):
    """A unit as read: ``name`` is its plain spelling; ``note`` is ``unit-case``, ``ambiguous-unit``,
    ``energy`` (for a torque a wrong unit) or ''."""

    unit: Unit
    name: str
    note: str = ""


def unit_word(text: str) -> UnitWord | None:
    """The unit of a text in plain characters; None where it is none."""
    text = text.strip()
    if not text or len(text) > _LONGEST or _SYMBOL.match(text):
        return None
    if text in _AMBIGUOUS:
        return UnitWord(parse_unit("N"), text, AMBIGUOUS_UNIT)
    return _exact(text) or _spoken(text) or _other_case(text)


def _exact(text: str) -> UnitWord | None:
    if text in _EXTRA:
        return UnitWord(_EXTRA[text], text, ENERGY if text in _ENERGIES else "")
    if text in ('"', "'"):
        return UnitWord(UNITS["in" if text == '"' else "ft"], "in" if text == '"' else "ft")
    try:
        return UnitWord(parse_unit(text), _shown(_DOTTED.sub("", text)))
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
        return word, AMBIGUOUS_UNIT
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
