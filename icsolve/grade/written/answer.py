"""An answer as a student wrote it, to a number, a unit and a direction.

What has two readings, or words that are not understood, is flagged: a person looks at what holds a number.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

from icsolve.grade.written.numerals import AMBIGUOUS as AMBIGUOUS_NUMBER
from icsolve.grade.written.numerals import UNREAD, WrittenNumber, numeral, plain
from icsolve.grade.written.words import (
    AMBIGUOUS_DIRECTION,
    AMBIGUOUS_UNIT,
    UnitWord,
    WrittenDirection,
    direction,
    unit_word,
)
from icsolve.numbers.units import DIMENSIONS
from icsolve.tuples import NamedTuple

MISSING = "missing"
NO_NUMBER = "no-number"
TOO_LONG = "too-long"
TWO_VALUES = "two-values"
SIZE, MINUS = "size", "minus"
LONGEST = 200
"""Characters of an answer; more is no number with a unit and a direction."""
_MOST = 4096
"""Texts that are remembered with their reading."""


class WrittenAnswer(NamedTuple):
    """What an answer says.

    ``number`` is signed, in ``unit`` (None: none was given); ``digits`` carries its significant figures;
    ``direction`` is None where no words give one. ``flag`` is '' where all of the text was read in
    one way; ``note`` is ``unit-case`` where capitals were overlooked; ``unsigned`` says that a number without
    a sign need not be positive: a size alone (``SIZE``), or beside a minus in brackets (``MINUS``).
    """

    number: float
    unit: UnitWord | None
    direction: WrittenDirection | None
    digits: str = ""
    flag: str = ""
    note: str = ""
    unsigned: str = ""


_made: Callable[[tuple[Any, ...]], WrittenAnswer] = partial(tuple.__new__, WrittenAnswer)
"""Half the time of the class itself, where there are millions."""


def flagged(flag: str) -> WrittenAnswer:
    """An answer that is not to be judged."""
    return WrittenAnswer(0.0, None, None, "", flag)


_NOTHING = {"", "-", "--", "---", ".", "n/a", "na", "none", "null", "nil"} | {
    "no answer",
    "not answered",
    "no response",
    "keine antwort",
    "sans réponse",
    "sin respuesta",
}
_ABOUT = (
    r"approximately|approximated?|approx\.?|about|around|roughly|nearly|circa|ca\.?|c\.|environ|env\.|ungefähr|etwa"
    r"|rund|unos|aproximadamente|aprox\.?|gerundet|rounded(?: off)?|rounded value"
)
_LIMIT = (
    r"at least|at most|minimum(?: of)?|maximum(?: of)?|min\.?|max\.?|no less than|or more|or less|mindestens"
    r"|höchstens"
)
_LEAD = re.compile(
    rf"(?:{_ABOUT}|{_LIMIT}|(?:my |the )?(?:final )?(?:answer|ans\.?|result|value|magnitude|solution|ratio)"
    r"|antwort|ergebnis|réponse|respuesta|risposta|it is|it's|i get|i got|we get|we got|is|equals|so|thus"
    r"|hence|therefore|[~=:])(?![\w])\s*|[~=:]+\s*",
    re.IGNORECASE,
)
_INTRODUCE = re.compile(
    rf"(?:{_ABOUT}|{_LIMIT}|the|an?|force|torque|moment|couple|load|answer|value|required|unknown|result|magnitude"
    r"|size|is|of|i|get|got|and|with|equal|equals|to|ratio)(?!\w)[ ,]*",
    re.IGNORECASE,
)
_ASIDE = re.compile(
    rf"[(\[]?(?<![\w.])(?:{_ABOUT}|{_LIMIT}|dimensionless|unitless|no units?|without units?|sans unités?"
    r"|sin unidades?|senza unità|ohne einheit|einheitenlos|ratio|d\.h\.|that is|i\.e\.)(?!\w)[)\]]?,?"
    r"|[(\[] ?[-1] ?[)\]]|\([A-Z]_?\d+\)"
    r"|[(\[]?(?:to )?\d+ ?(?:s\.?f|sig(?:nificant|\.)? ?(?:fig(?:ure|\.)?s?|digits)|d\.?p|decimal places)\b"
    r"\.?[)\]]?",
    re.IGNORECASE,
)
"""Words that say nothing about the value, and a unit in brackets that is none."""
_BRACKETED_MINUS = re.compile(r"\( ?-(?:ve)? ?\)")
"""Alone the unit of a ratio; beside a unit or a direction, or of what has a unit, perhaps the sign."""
_MINUS_APART = re.compile(rf"{_BRACKETED_MINUS.pattern}|- ?[.;]?$|(?<=\w)- ?[=:]|- [ijk]-hat")
"""A minus that stands by itself: in brackets, at the end, behind a name, before a unit vector."""
_MINUS_SAID = re.compile(
    r"(?<!\w)(?:(?:minus|neg(?:ative?|ativo|atief)?\.?|négatif|moins|menos|meno) ?[:=]|min\.? (?=[\d.,]))",
    re.IGNORECASE,
)
"""A word for it that may be a name, or a limit: ``minus: 12``; Dutch ``min 12``."""
_SIZE = re.compile(r"\|[^|]+\||(?<!\w)(?:magnitude|size|absolute value|modulus|abs)(?!\w)", re.IGNORECASE)
"""What says that a number is a size, whatever its sense: ``|T12| = 41``, ``magnitude 41``."""
_VECTOR_FIRST = re.compile(r"(?<!\w)([ij]|[ijk]-hat) (.+)")
_BODY = (
    r"link|crank|bar|member|body|input|output|frame|rod|coupler|rocker"
    r"|slider|block|piston|gear|wheel|arm|lever|pin"
)
_WHERE = re.compile(
    rf",? ?\b(?i:(?:acting|applied|exerted) )?(?i:on|at|about|around) (?i:the |link |point |pin )*"
    rf"(?:(?i:{_BODY})(?: [A-Z]?\d{{0,2}}[A-Z]?)?|(?<=[Ll]ink )\d{{1,2}}|[A-Z]\d?'?)(?![\w'.,°]|[.,]\w)",
)
"""Where it acts, which the question says itself: ``on link 2``, ``about A``."""
_PLACE = re.compile(
    rf"\b(?:on|at|about|around) (?:the )?"
    rf"(?:(?:{_BODY}|point|pivot) (?P<name>[^\W_][\w']*)|(?P<alone>[^\W\d_][\w']*))",
    re.IGNORECASE,
)
_DASH = re.compile(r"(?:(?<=[\w\])]) ?|^)[-:;,]+ (?=[A-Za-z(])(?! *[xy]\b)| -$|^-$")
"""A dash or a colon between a unit and a direction; before x and y it may be a sign."""
_ASIDE_OF_NAME = r"(?: ?(?:\([\w' ·*/+-]*\)|\[[\w' ·*/+-]*\]))?"
"""Behind a name: its unit or its sense, ``T12 (N m) = 3``, or what says nothing, ``P (max) = 3``."""
_NAME = re.compile(
    rf"\s*\|?(?P<name>[^\W\d_][\w'\-/ω{{}}^.]*)(?P<aside>{_ASIDE_OF_NAME})\|?\s*(?:[<>]=|=>|=<|=|:|~)[=~]?\s*(?=[^=])"
)
_SIGNS = re.compile(
    r"(?:(?P<less>minus|negative|moins|menos|meno|neg\.)|(?P<more>plus|positive|pos\.))$", re.IGNORECASE
)
_LETTERS = ("T", "C")
"""Tension and compression; only tonnes and coulombs would end so."""
_SEXAGESIMAL = re.compile(r"(\d+(?:\.\d+)?) ?° ?(\d+(?:\.\d+)?) ?'(?: ?(\d+(?:\.\d+)?) ?\")?$")
_NUMBER = re.compile(r"(?<!\w)(?:\d|[.,]\d|√|sqrt ?\(|pi(?![a-z]))", re.IGNORECASE)
_LABEL = re.compile(r"(?<!\w)[A-Za-z]{1,2}_?\d{1,3}'?(?![\w.,]*\d)")
"""The name of a load, a centre or a point: the digits in it are no number."""


class Reader:
    """Reads answers; remembers what followed the numbers, which repeats from student to student.

    ``decimal`` says what a comma before three digits is: ``point`` (a group of thousands), ``comma``
    (a decimal mark) or ``either`` (flagged).
    """

    def __init__(self, decimal: str = "either") -> None:
        self.decimal = decimal
        self._rests: dict[str, WrittenAnswer] = {}

    def read(self, text: str, unit: str = "", way: str = "") -> WrittenAnswer:
        """The reading of an answer's text, with its unit and direction where they have columns of their own;
        what one column says against another is flagged."""
        if unit or way:
            return _with_columns(self.read(text), unit, way)
        if self.decimal == "comma":
            return self.slowly(text)
        digits = text.partition(" ")[0]
        after = self._rests.get(text[len(digits) :])
        if after is None or not digits[-1:].isdigit() or "_" in digits or len(text) > LONGEST:
            quick = _QUICK.match(text)
            if quick is None:
                return self.slowly(text)
            digits, rest = quick.groups()
            after = self._rests.get(rest) or self._remember(rest)
        _, word, said, _, flag, note, unsigned = after
        try:
            number = float(digits)
        except ValueError:
            return self.slowly(text)
        if flag or (number < 0.0 and said is not None) or number - number != 0.0:
            return self.slowly(text)
        return _made((number, word, said, digits, "", note, unsigned))

    def _remember(self, rest: str) -> WrittenAnswer:
        if len(self._rests) >= _MOST:
            self._rests.clear()
        words = plain(rest)
        found = tail(words, WrittenAnswer(0.0, None, None))
        found = _with_minus(found._replace(direction=_toward(found.direction)), words)
        self._rests[rest] = found
        return found

    def slowly(self, text: str) -> WrittenAnswer:
        """As ``read``, of any text."""
        words, flag = words_of(text)
        return flagged(flag) if flag else _answer(words, self.decimal)


_QUICK = re.compile(
    r"([-+]?\d{1,30}(?:\.\d{1,30})?(?:[eE][-+]?\d\d?)?)"
    r"((?: ?[A-Za-z°][A-Za-z °·*/.-]*)?)\Z",
    re.ASCII,
)
"""Plain answers, which are most: digits, then words without digits."""


def words_of(text: str) -> tuple[str, str]:
    """The text in plain characters, and a flag where that is nothing, or too much to be read."""
    words = plain(text[: LONGEST * 20])
    if words.strip("\"'").strip().lower() in _NOTHING:
        return words, MISSING
    if len(words) > LONGEST or len(text) > LONGEST * 20:
        return words, TOO_LONG if holds_digits(words) else NO_NUMBER
    return words, ""


def _answer(text: str, decimal: str) -> WrittenAnswer:
    whole = text
    if _MINUS_SAID.search(whole) and holds_digits(whole):
        return flagged(AMBIGUOUS_DIRECTION)
    text, asides = unwrapped(text)
    read = _behind_name(text, decimal)
    if read.number >= 0.0 and read.direction is None and not read.flag:
        first = _NUMBER.search(whole)
        said_size = first is not None and _SIZE.search(whole, 0, first.start())
        read = read._replace(unsigned=SIZE if said_size else "")
    read = _with_minus(read, whole)
    for aside in filter(None, asides):
        if aside == "t":  # T(t) = ...: a function of time
            continue
        is_unit = unit_word(aside) is not None
        read = _with_columns(read, aside if is_unit else "", "" if is_unit or not direction(aside) else aside)
    return read


def _with_minus(read: WrittenAnswer, text: str) -> WrittenAnswer:
    """With a minus that stands by itself, as far as the number has none."""
    apart = read.number >= 0.0 and not read.flag and _MINUS_APART.search(text)
    return read._replace(unsigned=MINUS) if apart else read


def _behind_name(text: str, decimal: str) -> WrittenAnswer:
    """What stands behind all that only introduces it."""
    first = _NUMBER.search(text)
    if first is None:
        return flagged(UNREAD if holds_digits(text) else NO_NUMBER)
    start = first.start()
    before = text[:start]
    if _is_accounting(text):
        return flagged(AMBIGUOUS_NUMBER)
    if before.rstrip().endswith("±"):
        return flagged(TWO_VALUES)
    sign, before = _sign(before)
    angle = _SEXAGESIMAL.fullmatch(text[start:])
    found = numeral(text, start, decimal)
    if angle:
        degrees, minutes, seconds = (float(part or 0) for part in angle.groups())
        found = WrittenNumber(degrees + minutes / 60.0 + seconds / 3600.0, len(text) - start, "")
    if found is None:
        return flagged(UNREAD)
    if found.flag:
        return flagged(found.flag)
    rest = text[found.end :]
    if rest[:1] == "-" and not rest[1:].strip(" .;"):
        return flagged(AMBIGUOUS_DIRECTION)  # books and spreadsheets put the sign behind too: ``412.7-``
    if before.rstrip().endswith(("[", "{")):
        rest = re.sub(r"^ ?[\])}]", "", rest)  # the bracket closes around the number: ``[-64.5] N``
    read = tail(rest.strip(), WrittenAnswer(0.0, None, None))
    if angle:
        read = tail("deg", read)
    return _joined(read, _leading(before), found, sign)


def holds_digits(text: str) -> bool:
    """Whether digits stand in a text that are not those of a name, as in T12."""
    return any(c.isdigit() for c in _LABEL.sub("", text))


def unwrapped(text: str) -> tuple[str, list[str]]:
    """Without what only introduces: ``T12 = ...``, ``approx.``, brackets around all of it, quotes, a stop;
    and what stood in brackets behind names, ``T12 (N m) = ...``."""
    before, asides = "", []
    while text != before:
        before = text
        text = _unquoted(text)
        inside = text[1:-1]
        bracketed = text[:1] in tuple("([{") and text[-1:] in tuple(")]}") and not set(inside) & set("()[]{}")
        if bracketed and not _is_accounting(text):
            text = inside.strip()
        name = _NAME.match(text)
        if name is not None and _is_name(name.group()):
            asides += [name.group("aside").strip(" ()[]"), _without_unit(name.group("name"))[1]]
            text = text[name.end() :]
        lead = _LEAD.match(text)
        if lead is not None and 0 < lead.end() < len(text):
            text = text[lead.end() :]
        text = re.sub(r"^(?:[<>]=|=[<>]) ?(?=[\d.+-])", "", text)
    return text, asides


_CALLED = rf"\|?(?P<name>[^\W\d_][\w'\-/{{}}^.]*?)(?:_?(?:min|max))?{_ASIDE_OF_NAME}\|? ?"
_NAMED = re.compile(
    rf"(?<![\w.*·/^])(?<!\d )(?<!\d){_CALLED}(?=[<>=~:∈])"
    rf"|^{_CALLED.replace('name', 'first')}(?=\(|(?:is|at|in|lies|must|can)\b)",
    re.IGNORECASE,
)


may_name = re.compile(r"\W*+(?:[^\W\d_]|\d[^<>&≤≥]*+[<>&≤≥])").match
"""Whether a text begins with a letter, or has a number before a sign of order: few do, and are looked at."""


def names_in(text: str) -> list[str]:
    """The names to which an answer gives what it says: ``T12`` of ``T12 = 41 N*m``, ``P >= 3`` has ``P``."""
    found = _NAMED.finditer(plain(text[: LONGEST * 20]))
    return [_without_unit(one.group("name") or one.group("first"))[0] for one in found]


def places_in(text: str) -> list[str]:
    """The links and points at which an answer says that what it gives acts: ``4`` of ``41 N*m on link 4``."""
    found = _PLACE.finditer(plain(text[: LONGEST * 20]))
    return [one.group("name") or one.group("alone") for one in found]


def _without_unit(name: str) -> tuple[str, str]:
    """A name, and the unit by which it is divided: ``M/Nm = 3``."""
    whole, _, unit = name.partition("/")
    return (whole, unit) if unit and unit_word(unit) is not None else (name, "")


def _unquoted(text: str) -> str:
    if len(text) > 1 and text[:1] in "\"'" and text[-1:] == text[:1]:
        return text[1:-1].strip()
    if text[:1] == "'" and text.count("'") == 1:
        return text[1:].lstrip()  # by which a spreadsheet keeps a text
    return text


def _is_name(text: str) -> bool:
    """Whether what stands before a ``=`` or a colon names the answer: ``down: 5 N`` gives its direction, and
    so does ``T: 5 N``, but ``T = 5`` does not."""
    said = text.strip(" :~=<>")
    return (text.rstrip().endswith("=") and len(said) == 1) or direction(said) is None


def _is_accounting(text: str) -> bool:
    """``(412.7)``: bare brackets mean a negative number to a spreadsheet."""
    return bool(re.match(r"\( ?[\d.,' ]+\)", text))


def _sign(before: str) -> tuple[str, str]:
    """The sign right before the number, as a mark or a word, and what stands before that."""
    stripped = before.rstrip(" [")
    if stripped.endswith(("-", "+")):
        return stripped[-1], stripped[:-1].rstrip()
    word = _SIGNS.search(stripped)
    if word is not None:
        return ("-" if word.group("less") else "+"), stripped[: word.start()].rstrip()
    return "", before.rstrip()


def _leading(before: str) -> WrittenDirection | str | None:
    """The direction that stands before the number; a flag where the words are not understood."""
    words = before.strip(" ,;:=~([{")
    if not words or not _INTRODUCE.sub("", words).strip(" ,"):
        return None
    found = direction(words)
    if found is None:
        found = direction(re.sub(rf"[ ,:]*\b(?:{_ABOUT}|{_LIMIT}|torque|moment|force|of|is)$", "", words))
    return found if found is not None else UNREAD


# --- what follows the number ------------------------------------------------------------------------


def tail(text: str, read: WrittenAnswer) -> WrittenAnswer:
    """What follows the number: a unit, a direction, both in this order, or nothing."""
    text = re.sub(r"[.!]+$", "", text).strip(" ,;") if text not in ('"', "'") else text
    text = text if "(" in text else text.strip(") ")
    if not text:
        return read
    if _BRACKETED_MINUS.search(text) and _BRACKETED_MINUS.sub("", text).strip(" ,;"):
        return flagged(AMBIGUOUS_DIRECTION)
    text = _VECTOR_FIRST.sub(r"\2 \1", re.sub(r"(?<=\w) (?:min|max)\.?$", "", text))
    inside = text.strip("[](){} ")
    whole = _unit(inside) or _unit(text)
    if whole is not None and not inside.endswith(_LETTERS):
        doubted = whole.note == AMBIGUOUS_UNIT
        return flagged(AMBIGUOUS_UNIT) if doubted else read._replace(unit=whole, note=whole.note)
    bare = _WHERE.sub(" ", _ASIDE.sub(" ", text))
    bare = _DASH.sub(" ", bare)
    bare = " ".join(bare.split()).strip(" ,;")
    if bare != text:
        return tail(bare, read)
    return _parted(text, read)


def _parted(text: str, read: WrittenAnswer) -> WrittenAnswer:
    """A unit and a direction: the longest unit after which a direction stands."""
    words = _pieces(text)
    fitting: list[WrittenAnswer] = []
    for cut in range(len(words), -1, -1):
        unit_text, rest = " ".join(words[:cut]).strip("[](){},; "), words[cut:]
        unit = _unit(unit_text)
        if unit_text and (unit is None or _INCHES_OF_QUOTIENT.search(unit_text)):
            continue
        way = direction(" ".join(rest)) if rest else None
        if way is not None or not rest:
            fitting.append(read._replace(unit=unit, direction=way, note=unit.note if unit else ""))
    if not fitting:
        return flagged(TWO_VALUES if re.search(r"(?<![A-Za-z^\d.,])\d", text) else UNREAD)
    agreeing = next(filter(_agrees, fitting), None) if len(fitting) > 1 else fitting[0]
    way = fitting[-1].direction
    if agreeing is None and way and way.kind != "axial" and _INCHES_OR_IN.match(text):
        return flagged(AMBIGUOUS_UNIT)
    return _checked(agreeing or fitting[-1])


_PREPOSITION = re.compile(r"in (?!lb|pound|kip|oz|#)", re.IGNORECASE)
"""Not an inch, which stands in torques with pounds."""


_INCHES_OR_IN = re.compile(r"[\[(]?in\b(?!.*\b(?:the|an?|directions?|dir|sense|way)\b)", re.IGNORECASE)
"""Right after the number, ``in cw`` may be inches; with a noun, ``in cw direction``, it is a preposition."""


_INCHES_OF_QUOTIENT = re.compile(r"/.* in\Z", re.IGNORECASE)
"""No unit: ``N/m in`` is followed by words that say which way."""


def _unit(text: str) -> UnitWord | None:
    """A unit, which ``in`` may stand before: ``in N``."""
    return (unit_word(text[3:].strip("[]() ")) if _PREPOSITION.match(text) else None) or unit_word(text)


def _agrees(read: WrittenAnswer) -> bool:
    """Whether a unit goes with its direction: ``lbf in cw`` is a torque, ``N in tension`` a force."""
    if read.unit is None or read.direction is None:
        return False
    wanted = "torque" if read.direction.kind == "turn" else "force"
    return read.unit.unit.dims[:3] == DIMENSIONS[wanted][:3]


def _pieces(text: str) -> list[str]:
    """Words, with signs and brackets that touch them set apart from the unit before."""
    spaced = re.sub(
        r"(?<=[A-Za-z°%])(?=[(\[{@])|(?<=;)(?=\S)|(?<=,)(?=\D)|(?<=\D,)(?=\d)|(?<=[)\]}])(?=\S)|(?=@)",
        " ",
        text,
    )
    return spaced.split()


def _checked(read: WrittenAnswer) -> WrittenAnswer:
    """Flags of its parts."""
    way, unit = read.direction, read.unit
    if way is not None and way.flag:
        return flagged(way.flag)
    if way is not None and way.measured and unit is not None and unit.unit.dims == DIMENSIONS["angle"]:
        return flagged(TWO_VALUES)
    return flagged(AMBIGUOUS_UNIT) if read.note == AMBIGUOUS_UNIT else read


def _joined(
    read: WrittenAnswer, leading: WrittenDirection | str | None, found: WrittenNumber, sign: str
) -> WrittenAnswer:
    """Number, sign, and the directions before and after it as one reading."""
    if read.flag or isinstance(leading, str):
        return read if read.flag else flagged(UNREAD)
    way = read.direction or leading
    if read.direction is not None and leading is not None and read.direction != leading:
        return flagged(AMBIGUOUS_DIRECTION)
    if way is not None and (way.flag or (sign == "-" and found.value != 0.0 and not way.signed)):
        return flagged(AMBIGUOUS_DIRECTION)
    reverse = sign == "-" and way is not None and way.signed
    number = -found.value if sign == "-" and not reverse else found.value
    return read._replace(number=number, direction=_toward(way, reverse), digits=found.digits)


def _toward(way: WrittenDirection | None, reverse: bool = False) -> WrittenDirection | None:
    """The direction itself, or its opposite, where words say which way is positive."""
    if way is None or not way.signed:
        return way
    way = way._replace(signed=False)
    return way.opposite if reverse else way


# --- columns of their own ---------------------------------------------------------------------------

_unit_of_column = lru_cache(_MOST)(unit_word)
_direction_of_column = lru_cache(_MOST)(direction)
"""Columns repeat themselves from student to student."""
_NO_UNIT = {"", "-", "1", "none", "n/a", "na", "dimensionless", "[-]"}


def _with_columns(written: WrittenAnswer, unit: str, way: str) -> WrittenAnswer:
    """A reading with the unit and the direction of columns of their own; flagged where one of them is none,
    is ambiguous, or says otherwise than the answer itself."""
    words, ways = _alone(unit), _alone(way)
    if words and not written.flag:
        word = _unit_of_column(words)
        if word is None:
            return flagged(UNREAD)
        if word.note == AMBIGUOUS_UNIT or (written.unit is not None and written.unit.unit != word.unit):
            return flagged(AMBIGUOUS_UNIT)
        written = written._replace(unit=word, note=written.note or word.note)
    if ways and not written.flag:
        said = _direction_of_column(ways)
        signed = said is not None and said.signed
        reverse, said = signed and written.number < 0.0, _toward(said, signed and written.number < 0.0)
        if said is None or said.flag or (written.number < 0.0 and not reverse):
            return flagged(AMBIGUOUS_DIRECTION)
        if written.direction not in (None, said):
            return flagged(AMBIGUOUS_DIRECTION)
        written = written._replace(direction=said, number=abs(written.number) if reverse else written.number)
    return written


@lru_cache(_MOST)
def _alone(text: str) -> str:
    """What a column of its own says, in plain characters; '' where it says nothing."""
    words = plain(text)
    return "" if words.lower() in _NO_UNIT else words
