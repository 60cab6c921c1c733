"""When an answer was given: the times that platforms write, as seconds that can be compared."""

from __future__ import annotations

import re
from datetime import UTC, datetime

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
    "%m/%d/%Y %H:%M:%S",
    "%m/%d/%Y %H:%M",
    "%m/%d/%Y %I:%M:%S %p",
    "%m/%d/%Y %I:%M %p",
    "%Y/%m/%d %H:%M:%S",
    "%Y/%m/%d %I:%M:%S %p",
)
_GERMAN = {
    "januar": "January",
    "februar": "February",
    "märz": "March",
    "mai": "May",
    "juni": "June",
    "juli": "July",
} | {
    "oktober": "October",
    "dezember": "December",
}
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

    Dates with slashes are month first, as in the exports that use them.
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
    for german, english in _GERMAN.items():
        plain = re.sub(rf"\b{german}\b", english, plain, flags=re.IGNORECASE)
    plain = " ".join(plain.split())
    for form in _FORMATS:
        try:
            return _seconds(datetime.strptime(plain, form))
        except ValueError:
            continue
    try:
        return _seconds(datetime.fromisoformat(text))
    except ValueError:
        return None


def attempt_number(text: str) -> int:
    """The number of an attempt: ``2``, ``attempt 2``; 0 where none is given."""
    found = re.search(r"\d{1,15}", text)
    return int(found.group()) if found else 0
