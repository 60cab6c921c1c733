"""``tolerance``: how far a student's answer may lie from the right one."""

from __future__ import annotations

import re

from icsolve.case import Tolerance
from icsolve.read.document import Mapping, Node, Scalar
from icsolve.read.problems import shown
from icsolve.read.reading import Reading
from icsolve.units import DIMENSIONS, UnitError, parse_unit

_PERCENT = re.compile(r"(\d+(?:\.\d+)?|\.\d+) ?%$")
_COUNT = re.compile(r"(\d{1,2}) ?(?:sf|s\.f\.|sig figs?|figures?|significant figures?)$")
_WIDTH = re.compile(r"(\d+(?:\.\d+)?(?:[eE][-+]?\d+)?|\.\d+) ?([^\d\s%].*)?$")
_FORM = "write 1%, 3 sf, a width such as 0.5 N, or {drawing: 0.02 in}"


def read_tolerance(reading: Reading, node: Node) -> Tolerance | None:
    """The tolerance of a case; None, with the reason noted, where it is none."""
    try:
        return tolerance_of(node)
    except ValueError as error:
        reading.refuse(node.mark, f"'tolerance': {error}")
        return None


def tolerance_of(node: Node) -> Tolerance:
    """``1%``, ``3 sf``, ``0.5 N``, or a mapping with ``relative``, ``absolute``, ``figures``, ``drawing``.

    Raises ValueError, with a sentence.
    """
    if type(node) is Scalar:
        return parse_tolerance(node.text)
    if type(node) is not Mapping or not node.items:
        raise ValueError(_FORM)
    found = Tolerance()
    for key, value in node.items.items():
        if type(value) is not Scalar:
            raise ValueError(f"'{key}' should be one quantity")
        found = _with_part(found, key, value.text.strip())
    return found


def _with_part(found: Tolerance, key: str, text: str) -> Tolerance:
    """With one key of the mapping."""
    if key == "relative" and text.endswith("%"):
        return found._replace(relative=parse_tolerance(text).relative)
    if key == "absolute" and not text.endswith("%"):
        width = parse_tolerance(text)
        return found._replace(absolute=width.absolute, unit=width.unit)
    if key == "figures":
        return found._replace(figures=parse_tolerance(f"{text} sf").figures)
    if key == "drawing":
        _length(text)
        return found._replace(drawing=text)
    raise ValueError(f"{shown(key)} with {shown(text)} is not understood; {_FORM}")


def _length(text: str) -> None:
    width = _WIDTH.match(text)
    unit = width.group(2) if width else None
    try:
        if width and (unit is None or parse_unit(unit).dims == DIMENSIONS["length"]):
            return
    except UnitError:
        pass
    raise ValueError(f"{shown(text)} is not a length, such as 0.02 in")


def parse_tolerance(text: str) -> Tolerance:
    """``1%``, ``3 sf``, ``0.5``, ``0.5 N``.

    Raises ValueError, with a sentence, where the text is none of these.
    """
    text = " ".join(text.split())
    percent, count, width = _PERCENT.match(text), _COUNT.match(text), _WIDTH.match(text)
    if percent:
        return _limited(Tolerance(relative=float(percent.group(1)) / 100.0))
    if count:
        return _limited(Tolerance(figures=int(count.group(1))))
    if width:
        return _limited(Tolerance(absolute=float(width.group(1)), unit=width.group(2) or ""))
    raise ValueError(f"{shown(text)} is not a tolerance: {_FORM}")


def _limited(tolerance: Tolerance) -> Tolerance:
    if tolerance.relative >= 1.0:
        raise ValueError("a tolerance of 100 % or more would accept anything")
    if not tolerance.relative and not tolerance.absolute and not 1 <= tolerance.figures <= 15:
        raise ValueError("a tolerance is more than zero, or 1 to 15 significant figures")
    return tolerance
