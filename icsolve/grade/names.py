"""The names of a case's quantities, as the name of a question and as students write them before an answer."""

from __future__ import annotations

import re
from collections.abc import Iterator

from icsolve.case import Case, is_named
from icsolve.case.expected import CentreIs, DistanceIs, LoadIs, PositionIs, ReactionIs, SpeedIs, Target
from icsolve.read.expect import target_of
from icsolve.read.names import Problems, parts
from icsolve.read.reading import Reading

_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789", "_{}^|\\ ")
_SPEED = re.compile(r"omega|ω|^n(?=\d)", re.IGNORECASE)
_ANGLE = re.compile(r"theta|phi|alpha|beta|[θφαβϑϕ]", re.IGNORECASE)
_DATUM = re.compile(r"(?:[A-Z]\d?'?){2,3}")
_CENTRE = re.compile(r"IC(?=\d)", re.IGNORECASE)
_POLE = re.compile(r"[PO](?=\d)")


def reading_of(case: Case) -> Reading:
    """What the reader of keys needs to know of a case."""
    reading = Reading(Problems(case.path), case.units)
    reading.kinds = dict.fromkeys((*case.directed, *(load.name for load in case.loads)), "force")
    reading.unknowns = list(case.unknowns)
    reading.given = set(case.points)
    reading.ropes = {rope.name for rope in case.ropes}
    reading.links = dict.fromkeys(case.links, (1, 1))
    return reading


def points_of(case: Case) -> set[str]:
    """The points that a case names."""
    named = set(case.points) | {p for carried in case.carries.values() for p in carried}
    return {name for name in named if is_named(name)}


def is_another(case: Case, target: Target, what: str, name: str) -> bool:
    """Whether a name is that of another quantity than the target, or one of its kind: ``F43x`` for ``F34x``,
    ``T15`` for ``T12``. A name of no quantity, such as ``x`` or ``answer``, is none.

    ``what`` is what is asked, as the question names it.
    """
    bare, own = name.translate(_LOWERED), what.translate(_LOWERED)
    if bare.casefold() == own.casefold():
        return False
    meant = list(_meant(case, target, bare))
    if meant:
        return not any(_alike(one, target) for one in meant)
    shape, asked = (re.sub(r"\d", "#", text.casefold()) for text in (bare, own))
    return shape == asked and "#" in shape


def _meant(case: Case, target: Target, bare: str) -> Iterator[Target]:
    """What a name says, by the first spelling that says anything; of a place or a datum as it is asked."""
    reading, points = reading_of(case), points_of(case)
    loads = [load for load in reading.kinds if load.translate(_LOWERED).casefold() == bare.casefold()]
    if loads:
        yield from map(LoadIs, loads[:1] if bare not in loads else [bare])
        return
    forms = [bare, _SPEED.sub("w", bare), _CENTRE.sub("I", bare), bare[:1].upper() + bare[1:]]
    forms += [_POLE.sub("I", bare)] if isinstance(target, CentreIs) and bare not in points else []
    forms += ["-".join(parts(bare))] if isinstance(target, DistanceIs) else []
    for form in dict.fromkeys(forms):
        found = target_of(reading, form, points)
        if not isinstance(found, str):
            yield found
            return
    if isinstance(target, PositionIs):
        datum = _ANGLE.sub("", bare)
        if _DATUM.fullmatch(datum):
            section, _, own = target.path.partition(".")
            names = (parts(datum), parts(own))
            same = names[0] == names[1] or (section == "lengths" and sorted(names[0]) == sorted(names[1]))
            yield target if same else PositionIs(f"{section}.{datum}")
    elif bare[:1] in ("v", "V"):
        for point in (point for point in points if bare[1:].startswith(point)):
            link = bare[1 + len(point) :]
            if link in ("", *case.links):
                own_link = target.link if isinstance(target, SpeedIs) else ""
                yield SpeedIs(point, link or own_link)


def _alike(one: Target, other: Target) -> bool:
    """Whether two names are of one quantity: the order of the links of a centre says nothing."""
    if isinstance(one, CentreIs) and isinstance(other, CentreIs):
        return set(one.pair) == set(other.pair)
    if isinstance(one, DistanceIs) and isinstance(other, DistanceIs):
        ends = [{frozenset([end] if isinstance(end, str) else end) for end in two} for two in (one, other)]
        return ends[0] == ends[1]
    if isinstance(one, ReactionIs) and isinstance(other, ReactionIs) and None in (one.at, other.at):
        return one._replace(at=None) == other._replace(at=None)
    return one == other
