"""Answers of two numbers: a place (or a direction in which it lies at infinity), the two components of a
vector, and a range of values."""

from __future__ import annotations

import re

from icsolve.grade.written.answer import NO_NUMBER, TWO_VALUES, flagged, holds_digits, tail, words_of
from icsolve.grade.written.numerals import AMBIGUOUS, UNREAD, WrittenNumber, numeral
from icsolve.grade.written.words import UnitWord, WrittenDirection, unit_word
from icsolve.tuples import NamedTuple

_SIGNED = r"(?<![\w{before}])[-+]? ?(?:\d+(?:{mark}\d*)?|{mark}\d+)(?:[eE][-+]?\d+)?(?: ?/ ?\d+)?(?![\d/])"
_POINT, _EITHER = (
    re.compile(_SIGNED.format(mark=mark, before=before)) for mark, before in ((r"\.", "."), ("[.,]", ".,"))
)
_PLACE_WORDS = re.compile(
    r"\b(?:the|instant|instantaneous|cent(?:re|er)|pole|point|ic|is|are|at|in|located|lies|coordinates|of|about"
    r"|approximately|(?:approx|ca)\b\.?|x)(?!\w)|\b(?:[A-Z]|IC)_?\d+(?:-\d+)?\b|\( ?x ?, ?y ?\)|[=:~\[({]",
    re.IGNORECASE,
)
_BETWEEN = (
    r" ?(?P<unit>[A-Za-z]{{0,12}}?(?:/[A-Za-z]{{1,9}})?) ?[\])}}]? ?"
    r"(?:(?:{separators}) ?(?:and )?(?:y ?[:=~] ?)?|y ?[:=~] ?| )[\[({{]?"
)
_AFTER_POINT, _AFTER_EITHER = (
    re.compile(_BETWEEN.format(separators=separators), re.IGNORECASE)
    for separators in (r",+|;|\||and|&|und|et|y|e", r";|\||and|&|und|et|y|e")
)
_END = re.compile(
    r" ?(?P<own>[A-Za-z]{0,12}(?:/[A-Za-z]{1,9})?) ?[\])}]? ?(?P<after>[A-Za-z]{0,12}(?:/[A-Za-z]{1,9})?)\.?"
)
_FAR = re.compile(
    r"(?:is )?(?:at |to )?(?:inf|infinity|infinite|∞|oo|unendlich)(?:ly far)?(?![a-z])\.?[ ,]*(.*)$",
    re.IGNORECASE,
)
_TOWARD = re.compile(
    r"(?:in direction|in the direction|direction|towards?|at|along|:|=)? ?([-+]? ?\d+(?:\.\d*)?|[-+]? ?\.\d+)"
    r" ?(?:deg|degrees|°)?$",
    re.IGNORECASE,
)


class WrittenPlace(NamedTuple):
    """``x`` and ``y`` in ``unit`` (None: none given), or ``toward`` in degrees for a place at infinity.

    ``toward`` is NaN where it is at infinity in no direction that is said. ``flag`` as for other answers.
    """

    x: float = 0.0
    y: float = 0.0
    unit: UnitWord | None = None
    toward: float | None = None
    flag: str = ""
    doubtful: bool = False
    """Whether commas before three digits are taken for decimal marks, which may divide thousands, or two
    numbers for components that may be two answers, or one with a comma."""


def read_place(text: str) -> WrittenPlace:
    """The reading of an answer that should be a place."""
    words, flag = words_of(text)
    if flag:
        return WrittenPlace(flag=flag)
    words = words.rstrip(" .")
    far = _FAR.search(words)
    if far is not None and not _PLACE_WORDS.sub("", words[: far.start()]).strip():
        rest, toward = far.group(1), _TOWARD.match(far.group(1))
        if toward is None:
            return WrittenPlace(flag=UNREAD) if rest else WrittenPlace(toward=float("nan"))
        return WrittenPlace(toward=float(toward.group(1).replace(" ", "")))
    place = _near(words)
    if place is not None or not holds_digits(words):
        return place or WrittenPlace(flag=NO_NUMBER)
    count = len(re.findall(r"(?<![A-Za-z_\d])\d+(?:[.,]\d+)*", words))
    return WrittenPlace(flag=AMBIGUOUS if "," in words else TWO_VALUES if count > 2 else UNREAD)


def _near(words: str) -> WrittenPlace | None:
    """Two numbers between which a comma, a semicolon, a word or a space stands; None where it is not so."""
    for number, between, decimal in ((_POINT, _AFTER_POINT, "point"), (_EITHER, _AFTER_EITHER, "comma")):
        found = list(number.finditer(words))
        if len(found) != 2 or _PLACE_WORDS.sub("", words[: found[0].start()]).strip():
            continue
        glue = between.fullmatch(words, found[0].end(), found[1].start())
        end = _END.fullmatch(words, found[1].end())
        x, y = (_value(match.group(), decimal) for match in found)
        if glue is None or end is None or x is None or y is None:
            continue
        if x.flag or y.flag:
            return WrittenPlace(flag=AMBIGUOUS)
        names = set(filter(None, (glue.group("unit"), end.group("own") or end.group("after"))))
        unit = unit_word(min(names)) if names else None
        if len(names) > 1 or (names and unit is None):
            return WrittenPlace(flag=UNREAD)
        return WrittenPlace(x.value, y.value, unit, doubtful=any("," in match.group() for match in found))
    return None


def _value(text: str, decimal: str) -> WrittenNumber | None:
    """A number with its sign."""
    found = numeral(text.lstrip("-+ "), 0, decimal)
    return found._replace(value=-found.value) if found is not None and text.startswith("-") else found


# --- components of vectors --------------------------------------------------------------------------

_AXES = re.compile(
    r"(?<![^\W\d_])(?P<of>[^\W\d_][\w'-]{0,12}?)?[ _]?\(?(?P<axis>[xy])\)? ?[=:] ?(?=[-+]? ?[\d.,])",
    re.IGNORECASE,
)
"""The names of two components: ``Fx = 3 N, Fy = 4 N``."""
_COMPONENT = (
    r"(?P<{0}>{1} ?[\d.,]+(?:[eE][-+]?\d+)?) ?(?P<{0}_unit>[A-Za-z/]*?) ?[*]? ?{0}(?:-hat)?(?![A-Za-z])"
)
_SUM = re.compile(
    _COMPONENT.format("i", "[-+]?") + " ?(?P<i_after>[A-Za-z/]*) ?" + _COMPONENT.format("j", "[-+]")
)
"""A sum of multiples of unit vectors: ``3i + 4j N``."""
_PAIR = re.compile(r"[(\[][^()\[\]]+(?:, |;)[^()\[\]]+[)\]]")
_ANY_VECTOR = ("", "F", "R", "v", "V")


def without_axes(text: str, *names: str) -> str:
    """An answer less what names its two components, where each has the name of one of these vectors: as
    ``(3 N, 4 N)`` for ``Fx = 3 N, Fy = 4 N``. Other answers are as they were."""
    axes = list(_AXES.finditer(text))
    named = [one["of"] or "" for one in axes]
    if sorted(one["axis"].lower() for one in axes) != ["x", "y"] or not {*named} <= {*names}:
        return text
    one, two = axes
    first = text[one.end() : two.start()].strip().removesuffix("and").rstrip(" ,;&")
    parts = [first, text[two.end() :]]
    x, y = parts if one["axis"] in "xX" else parts[::-1]
    return f"{text[: one.start()]} ({x}; {y})"


def read_components(text: str) -> WrittenPlace:
    """The two components of an answer to a question that is a vector, as those of a place: ``(3, 4) N``,
    ``3i + 4j N``, ``Fx = 3 N, Fy = 4 N``."""
    words, flag = words_of(text)
    if flag:
        return WrittenPlace(flag=flag)
    named = without_axes(words, *_ANY_VECTOR)
    named = _SUM.sub(
        lambda m: f"{m['i']} {m['i_unit'] or m['i_after']}; {m['j']} {m['j_unit'] or m['i_after']}", named, 1
    )
    found = _near(named.strip(" .")) or WrittenPlace(flag=UNREAD)
    sure = named != words or _PAIR.search(words) is not None
    return found if sure else found._replace(doubtful=True)


# --- ranges -----------------------------------------------------------------------------------------

_NAME = r"(?:\|?[A-Za-z][\w']{0,7}\|?)"
_BARE = r"(?:\|?[A-Za-z][a-z]?_?\d{0,3}'?\|?)"
"""A name with nothing between it and a number, which another word is not: ``P 113 to 287``, ``below 113``."""
_START = re.compile(
    rf"(?:(?:any )?(?:value|values|force|torque) )?"
    rf"(?:(?:{_NAME} ?(?:=|:|in|is|∈|can be|must be)|{_BARE}) ?)??"
    r"(?:(?:anything |any value )?(?:from|between|von|zwischen|entre|de|da|dal|tra|fra|desde))? ?"
    r"(?:about|approx\.?|approximately|ca\.?|~)? ?[\[({]? ?",
    re.IGNORECASE,
)
_LIMITED = re.compile(
    rf"(?:{_NAME} ?(?=[<>=])|{_NAME} (?=is |must |at |no ))?(?:is |must be )?"
    r"(?P<low>>=?|=>|at least|min\.?|minimum|(?:no|not) (?:less|smaller|lower) than|mindestens|above|over"
    r"|(?:greater|more|larger|bigger|higher) than(?: or equal to)?|exceeding)? ?"
    r"(?P<high><=?|=<|at most|max\.?|maximum|(?:no|not) (?:more|greater|larger|higher) than|höchstens|below"
    r"|under|(?:less|smaller|lower) than(?: or equal to)?|up to)? ?",
    re.IGNORECASE,
)
_SIZE = re.compile(r"\|[^|]+\| ?[<>]")
_MORE = re.compile(
    r",? ?(?:or|and) (?:(?P<low>more|above|greater|larger|higher)|less|below|smaller|lower)", re.IGNORECASE
)
_SEPARATOR = re.compile(
    rf"(?P<unit>.*?) ?(?P<by>up to|to|bis|till|until|through|and|und|à|a|al|et|y|e|-+|\.\.+|,|;"
    rf"|<=? ?{_NAME} ?<=?|>=? ?{_NAME} ?>=?)"
    r" ?(?:about|approx\.?|approximately|ca\.?|~)? ?(?P<sign>[-+]?) ?",
    re.IGNORECASE,
)
_LABELLED = re.compile(
    r"[,;]? ?(?:and )?(?<!\w)(?:[A-Z][a-z\d]{0,3}?_?)?\(?(min|max)(?:imum)?\)?\.? ?(?:=|:|is)? ?(?=[-+.\d])",
    re.IGNORECASE,
)
"""The names of two ends: ``Pmin = 113 N, Pmax = 287 N``."""
_NUMBER = re.compile(r"(?<!\w)(?:\d|[.,]\d)")


_ENDLESS = r"(?:∞|inf(?:inity|inite)?|oo|unendlich)(?![a-z])"
_FROM_ENDLESS = re.compile(
    rf"^(?:{_NAME} ?(?:=|:|in|is|∈) ?)?(?:from |between )?[\[(\]]? ?- ?{_ENDLESS} ?"
    rf"(?:to|bis|and|und|,|;|<=? ?{_NAME} ?<=?) ?",
    re.IGNORECASE,
)
_TO_ENDLESS = re.compile(
    rf" ?(?:up to|to|bis|and|und|,|;) ?\+? ?{_ENDLESS} ?[\])\[]? ?(?P<unit>[A-Za-z/*]*)$", re.IGNORECASE
)
"""An open end that is written out: ``(-inf, 113] N``, ``387 N to infinity``."""


class WrittenRange(NamedTuple):
    """From ``low`` to ``high`` (None: an open end) in ``unit``, in the order in which they are written; one
    value has both the same."""

    low: float | None = None
    high: float | None = None
    unit: UnitWord | None = None
    direction: WrittenDirection | None = None
    flag: str = ""


def read_range(text: str, decimal: str = "either") -> WrittenRange:
    """The reading of an answer that should be a range: ``113 N to 287 N``, ``P >= 387 N``."""
    words, flag = words_of(text)
    if flag:
        return WrittenRange(flag=flag)
    words = re.sub(r" ?\.{2,} ?", " to ", words).strip()
    words = _TO_ENDLESS.sub(r" \g<unit> or more", _FROM_ENDLESS.sub("at most ", words, 1), 1)
    if len(set(_LABELLED.findall(words))) == 2:
        words = _LABELLED.sub(" to ", words).removeprefix(" to ")
    found = _numbers(words, decimal)
    if not found:
        return WrittenRange(flag=UNREAD if holds_digits(words) else NO_NUMBER)
    if any(number.flag for _, number in found):
        return WrittenRange(flag=AMBIGUOUS)
    if len(found) == 1 and re.search(r"\d ?/ ?\d", words):
        return WrittenRange(flag=AMBIGUOUS)
    if len(found) == 1:
        return _one(words, *found[0])
    return _two(words, found) if len(found) == 2 else WrittenRange(flag=TWO_VALUES)


def _numbers(words: str, decimal: str) -> list[tuple[int, WrittenNumber]]:
    """The numbers of a text without their signs, each with where it starts."""
    found: list[tuple[int, WrittenNumber]] = []
    at = _NUMBER.search(words)
    while at is not None:
        number = numeral(words, at.start(), decimal)
        if number is None or number.end <= at.start():
            break
        found.append((at.start(), number))
        at = _NUMBER.search(words, number.end)
    return found


def _end_of(text: str) -> WrittenRange:
    """The unit and direction that follow the last number."""
    read = tail(re.sub(r"^ ?[\])}]+", "", text).strip(), flagged("")._replace(flag=""))
    signed = read.direction is not None and read.direction.signed
    return WrittenRange(None, None, read.unit, read.direction, UNREAD if signed else read.flag)


def _two(words: str, found: list[tuple[int, WrittenNumber]]) -> WrittenRange:
    (start, first), (second_start, second) = found
    sign, before = _sign(words[:start])
    between = _SEPARATOR.fullmatch(words[first.end : second_start].strip())
    end = _end_of(words[second.end :])
    if between is None or end.flag or not _START.fullmatch(before):
        return WrittenRange(flag=end.flag or UNREAD)
    unit_text = between.group("unit").strip("[]() ")
    unit = unit_word(unit_text) if unit_text else end.unit
    if unit_text and (unit is None or (end.unit is not None and end.unit.unit.dims != unit.unit.dims)):
        return WrittenRange(flag=UNREAD)
    if unit_text and end.unit is not None and unit is not None and end.unit.unit != unit.unit:
        return WrittenRange(flag=UNREAD)
    values = [sign * first.value, (-1.0 if between.group("sign") == "-" else 1.0) * second.value]
    return end._replace(low=values[0], high=values[1], unit=unit)


def _one(words: str, start: int, number: WrittenNumber) -> WrittenRange:
    """One value, or a range with one open end."""
    after = words[number.end :]
    more = _MORE.search(after)
    end = _end_of(after[: more.start()] if more else after)
    sign, before = _sign(words[:start])
    limit = _LIMITED.fullmatch(before)
    if _SIZE.match(before):  # a size has both ends: |P| <= 3
        both = limit is not None and limit.group("high") and not sign < 0.0 and not end.direction and not more
        return end._replace(low=-number.value, high=number.value) if both else WrittenRange(flag=UNREAD)
    if end.flag or (limit is None and not _START.fullmatch(before)):
        return WrittenRange(flag=end.flag or UNREAD)
    value = sign * number.value
    low = bool((limit and limit.group("low")) or (more and more.group("low")))
    high = bool((limit and limit.group("high")) or (more and not more.group("low")))
    return end._replace(low=value if low or not high else None, high=value if high or not low else None)


def _sign(before: str) -> tuple[float, str]:
    """+1 or -1, and what stands before it."""
    stripped = before.rstrip()
    if stripped.endswith(("-", "+")):
        return (-1.0 if stripped[-1] == "-" else 1.0), stripped[:-1].strip()
    return 1.0, before.strip()
