"""What a key of ``expect`` names: a load, a centre, a distance, a rate, a speed, a reaction, an arm."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import (
    ArmIs,
    CentreIs,
    DistanceIs,
    FrictionRadiusIs,
    LoadIs,
    Pair,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
)
from icsolve.read.names import LONGEST_KEY, is_name, pairs
from icsolve.read.problems import shown, suggestion
from icsolve.read.reading import Reading

SHARES = (
    *("normal", "friction", "tangential", "separating", "transverse", "axial", "radial", "thrust"),
    *("couple", "bearing"),
)
"""Shares of a reaction that a key can name before it: ``thrust F12@A``."""


def target_of(reading: Reading, key: str, points: set[str]) -> Target | str:
    """The target of a key, or what is wrong with the key. A load's name wins over other readings."""
    if key in reading.kinds:
        return LoadIs(key)
    if len(key) > LONGEST_KEY:
        return "this key is too long"
    found = list(dict.fromkeys(_readings(reading, key, points))) or _between_points(key, points)
    if reading.axes == "xyz":
        found = [target for target in found if _is_of_space(target)]
    if len(found) == 1:
        return found[0]
    if found:
        return f"{shown(key)} can be read in {len(found)} ways; write the links with hyphens, as in I3-14"
    return _unknown(reading, key)


def _is_of_space(target: Target) -> bool:
    """Whether a case in space has such a value."""
    between = isinstance(target, DistanceIs) and isinstance(target.a, str) and isinstance(target.b, str)
    return between or isinstance(target, ReactionIs | ArmIs)


def _unknown(reading: Reading, key: str) -> str:
    likely = suggestion(key, reading.kinds)
    forms = "a load, I24, I12-I26, I24-A, w4/w2, w2, 'v C on 8', F34, M34, 'h F32 A' or 'rf B'"
    if reading.axes == "xyz":
        forms = "a load, A-B, F34, F34z, F1-2@B, M34, M34x, 'thrust F12@B' or 'h F32 A'"
    return f"{shown(key)} names nothing in this case" + (likely or f"; a key can be {forms}")


def _readings(reading: Reading, key: str, points: set[str]) -> Iterator[Target]:
    words = key.split()
    if len(words) > 1:
        yield from _in_words(reading, words, points)
        return
    yield from _rates(reading, key)
    yield from _centres(reading, key)
    yield from _distances(reading, key, points)
    yield from _reactions(reading, key, points)


def _in_words(reading: Reading, words: list[str], points: set[str]) -> Iterator[Target]:
    """``v C on 8``, ``h F32 A``, ``rf B``."""
    if len(words) == 4 and words[0] == "v" and words[2] == "on":
        if words[1] in points and reading.knows_link(words[3]):
            yield SpeedIs(words[1], words[3])
    elif len(words) == 3 and words[0] == "h" and words[1].startswith("F") and words[2] in points:
        for by, on in pairs(words[1][1:], reading.knows_link):
            yield ArmIs(by, on, words[2])
    elif len(words) == 2 and words[0] == "rf" and words[1] in points:
        yield FrictionRadiusIs(words[1])
    elif words[-1].startswith("F"):
        yield from _shares(reading, words, points)


def _shares(reading: Reading, words: list[str], points: set[str]) -> Iterator[ReactionIs]:
    """``thrust F12@A``, ``couple 3 F23``: of a pair of gears, that of gear 3."""
    share = " ".join(words[:-1])
    if words[0] in SHARES and (len(words) == 2 or (len(words) == 3 and reading.knows_link(words[1]))):
        for whole in _reactions(reading, words[-1], points):
            if whole.part == "":
                yield whole._replace(part=share)


def _rates(reading: Reading, key: str) -> Iterator[Target]:
    over, slash, under = key.partition("/")
    if over[:1] == "w" and is_name(over[1:] or "-") and reading.knows_link(over[1:]):
        if not slash:
            yield RateIs(over[1:])
        elif under[:1] == "w" and reading.knows_link(under[1:]):
            yield RatioIs(over[1:], under[1:])


def _centres(reading: Reading, key: str) -> Iterator[CentreIs]:
    """``I24``, ``I2-4``, and the bare pair."""
    if key.startswith("I"):
        yield from (CentreIs(pair) for pair in _different(pairs(key[1:], reading.knows_link)))
    yield from (CentreIs(pair) for pair in _different(pairs(key, reading.knows_link)))


def _different(found: list[Pair]) -> list[Pair]:
    return [pair for pair in found if pair[0] != pair[1]]


def _distances(reading: Reading, key: str, points: set[str]) -> Iterator[Target]:
    """Cut at each hyphen: a centre or a point on both sides, a centre on one at least."""
    for at in [i for i, character in enumerate(key) if character == "-"]:
        for a in _ends(reading, key[:at], points):
            for b in _ends(reading, key[at + 1 :], points):
                if a != b and not (isinstance(a, str) and isinstance(b, str)):
                    yield DistanceIs(a, b)


def _between_points(key: str, points: set[str]) -> list[Target]:
    """``A-B`` where it means nothing else."""
    a, _, b = key.partition("-")
    return [DistanceIs(a, b)] if a in points and b in points and a != b else []


def _ends(reading: Reading, text: str, points: set[str]) -> list[Pair | str]:
    found: list[Pair | str] = [text] if text in points else []
    if text.startswith("I"):
        found += _different(pairs(text[1:], reading.knows_link))
    return found


def _reactions(reading: Reading, key: str, points: set[str]) -> Iterator[ReactionIs]:
    """``F34``, ``F34x``, ``F3-14``, ``F3-4@B``, ``M34``; a part stands after the links or the place."""
    if key[:1] not in ("F", "M"):
        return
    links, mark, place = key[1:].partition("@")
    for text, part in _parts(reading, key[0], links):
        if not mark:
            yield from _reaction(reading, text, part, None)
        elif place in points:
            yield from _reaction(reading, text, part, place)
        elif part in ("", "moment") and place[:-1] in points:
            component = _component(reading, key[0], place[-1:])
            yield from _reaction(reading, text, component, place[:-1]) if component else ()


def _parts(reading: Reading, letter: str, links: str) -> list[tuple[str, str]]:
    """Where the links end and a component's letter may stand."""
    whole = (links, "" if letter == "F" else "moment")
    part = _component(reading, letter, links[-1:])
    return [whole, (links[:-1], part)] if part else [whole]


def _component(reading: Reading, letter: str, axis: str) -> str:
    """The part that a letter at the end names: ``x`` of a force, ``moment x`` of a couple; '' for none."""
    if not axis or axis not in (reading.axes if letter == "F" else reading.couples):
        return ""
    return axis if letter == "F" else f"moment {axis}"


def _reaction(reading: Reading, text: str, part: str, at: str | None) -> Iterator[ReactionIs]:
    for by, on in _different(pairs(text, reading.knows_link)):
        yield ReactionIs(by, on, part, at)
