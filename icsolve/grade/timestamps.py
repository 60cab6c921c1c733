"""When an answer was given: the times that platforms write, as seconds that can be compared."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from typing import IO

_ZONE = re.compile(r" ?(?:UTC|GMT|Z)?(?:(?<=[TC ])([-+])(\d{1,2}):?(\d\d)?|(?<=[TCZ]))$")
"""``UTC``, ``GMT+1``, ``-0800``."""
_FORMATS = (
    "%d %B %Y %I:%M %p",
    "%d %B %Y %I:%M:%S %p",
    "%d %B %Y %H:%M",
    "%d %b %Y %H:%M:%S",
    "%B %d, %Y %I:%M %p",
    "%b %d, %Y %I:%M %p",
    "%d.%m.%Y %H:%M:%S",
    "%d.%m.%Y %H:%M",
    "%Y/%m/%d %H:%M:%S",
    "%Y/%m/%d %H:%M",
    "%Y/%m/%d %I:%M:%S %p",
    "%Y/%m/%d %I:%M %p",
    "%Y/%m/%d",
)
_MONTHS = {
    word: english
    for english, words in {
        "January": "januar janvier enero gennaio janeiro januari",
        "February": "februar février fevrier febrero febbraio fevereiro februari",
        "March": "märz mars marzo março maart",
        "April": "avril abril aprile",
        "May": "mai mayo maggio maio mei",
        "June": "juni juin junio giugno junho",
        "July": "juli juillet julio luglio julho",
        "August": "août aout agosto augustus",
        "September": "septembre septiembre settembre setembro",
        "October": "oktober octobre octubre ottobre outubro",
        "November": "novembre noviembre novembro",
        "December": "dezember décembre decembre diciembre dicembre dezembro",
    }.items()
    for word in words.split()
}
_FOREIGN = re.compile(rf"\b({'|'.join(_MONTHS)})\b", re.IGNORECASE)
_SLASHED = re.compile(r"(?<!\d)(\d{1,2})([/-])(\d{1,2})\2(\d{4}|\d{2})(?![\d/-])")
_SLASHED_BYTES = re.compile(rb"(?<![\d/-])(\d{1,2})([/-])(\d{1,2})\2(?:\d{4}|\d{2})(?![\d/-])")
_NAMED = {"CET": 1, "MEZ": 1, "CEST": 2, "MESZ": 2, "BST": 1, "EST": -5, "EDT": -4} | {
    "CST": -6,
    "CDT": -5,
    "MST": -7,
    "MDT": -6,
    "PST": -8,
    "PDT": -7,
}
"""Zones that exports name, in hours; those of North America where a name has two meanings."""
NEVER = -1.0
"""For a time that is not given."""


def timestamp(text: str) -> float | None:
    """Seconds since 1970, a time without a zone taken for UTC; NEVER for '', None for what can't be read.

    A date with slashes that could be read both ways is taken month first; `readings` has both.
    """
    text = " ".join(text.split())
    if not text:
        return NEVER
    try:
        return _seconds(datetime.fromisoformat(text))
    except ValueError:
        return _with_zone(text)


def _with_zone(text: str) -> float | None:
    """A time that ends with its zone, or with none."""
    before, _, name = text.rpartition(" ")
    if name in _NAMED:
        text = f"{before} GMT{_NAMED[name]:+d}"
    zone = _ZONE.search(text)
    found = _otherwise(text[: zone.start()] if zone is not None else text)
    if zone is None or zone.group(1) is None or found is None:
        return found
    sign, hours, minutes = zone.groups()
    return found - float(f"{sign}1") * (3600.0 * int(hours) + 60.0 * int(minutes or 0))


def _seconds(time: datetime) -> float:
    return (time if time.tzinfo is not None else time.replace(tzinfo=UTC)).timestamp()


def _otherwise(text: str) -> float | None:
    plain = re.sub(r"(?<=\d)(?:st|nd|rd|th)\b|, (?=\d+:)|^[A-Za-z]+, ", " ", text).replace(". ", " ")
    plain = _FOREIGN.sub(lambda found: _MONTHS[found.group().lower()], re.sub(r"\b(?:de|del)\b", " ", plain))
    plain = re.sub(r"^[^\W\d]+\.?,? (?=\d{1,2}\.? +[^\W\d])", "", " ".join(plain.split()))
    plain = re.sub(r"(?<=\d), (?=\d+:)", " ", year_first(plain, "month"))
    for form in _FORMATS:
        try:
            return _seconds(datetime.strptime(plain, form))
        except ValueError:
            continue
    try:
        return _seconds(datetime.fromisoformat(text))
    except ValueError:
        return None


def year_first(text: str, order: str) -> str:
    """A time whose date of slashes has its year first; by ``order`` (``day``, ``month``) where both could
    be.
    """

    def turned(found: re.Match[str]) -> str:
        first, _, second, year = found.groups()
        by_day = int(first) > 12 or (order == "day" and int(second) <= 12)
        day, month = (first, second) if by_day else (second, first)
        return f"{year if len(year) == 4 else '20' + year}/{month}/{day}"

    return _SLASHED.sub(turned, text, count=1)


def readings(text: str) -> tuple[float | None, float | None]:
    """A time with its date read month first, and day first."""
    if _SLASHED.search(text) is None:
        found = timestamp(text)
        return found, found
    return timestamp(year_first(text, "month")), timestamp(year_first(text, "day"))


def order_of(file: IO[bytes]) -> str:
    """How dates with slashes are ordered in a file, by those that can be read in one way only: ``day``,
    ``month``, or '' where none, or both, are to be seen."""
    seen = set()
    rest = b""
    while block := file.read(1 << 20):
        for found in _SLASHED_BYTES.finditer(rest + block):
            first, second = int(found.group(1)), int(found.group(3))
            if first > 12 >= second > 0:
                seen.add("day")
            elif second > 12 >= first > 0:
                seen.add("month")
        rest = block[-16:]
    return seen.pop() if len(seen) == 1 else ""


def attempt_number(text: str) -> int:
    """The number of an attempt: ``2``, ``attempt 2``; 0 where none is given."""
    found = re.search(r"\d{1,15}", text)
    return int(found.group()) if found else 0
