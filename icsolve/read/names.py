"""Problems of a file, collected in one run; names of points, links, loads and centres, and near names."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator
from itertools import islice, pairwise

from icsolve.case import Mark
from icsolve.errors import Problem

_MOST_OPTIONS = 300
MOST = 100
"""After so many problems a file is not read further."""


class Stop(Exception):
    """Reading cannot go on; what is wrong is in the problems."""


class Problems:
    """Notes problems of one file; ``noted`` counts them, those told before too.

    ``cut`` are the places of values that a comma cuts: that is said, and nothing else about what is left.
    """

    def __init__(self, path: str) -> None:
        self.cut: set[Mark] = set()
        self.path = path
        self.found: list[Problem] = []
        self.noted = 0

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem; stops at the hundredth."""
        self.noted += 1
        problem = Problem(printable(self.path), mark[0], mark[1], printable(message))
        if problem not in self.found and mark not in self.cut:
            self.found.append(problem)
        if len(self.found) == MOST:
            self.found.append(problem._replace(message="and perhaps more: reading stopped here"))
            raise Stop

    def stop(self, mark: Mark, message: str) -> Stop:
        """Note a problem after which nothing can be read; to be raised."""
        self.refuse(mark, message)
        return Stop()


def printable(message: str) -> str:
    """A message on one line: what a file holds can neither break nor colour the terminal."""
    if message.isprintable() and len(message) < 1000:
        return message
    cut = message if len(message) < 1000 else message[:600] + " ... " + message[-200:]
    return "".join(c if c.isprintable() else " " if c in "\n\r\t" else repr(c)[1:-1] for c in cut)


def shown(text: str) -> str:
    """A value as a message quotes it: in quotes, cut where it is long."""
    return f"'{text}'" if len(text) <= 60 else f"'{text[:40]}...'"


def joint_names(links: Iterable[str], at: str | None) -> list[str]:
    """By what a joint can be called in a path: its point, its links in either order, both; last the one by
    which it is told where others stand there too."""
    pair = "-".join(links)
    turned = "-".join(reversed(pair.split("-")))
    return [at, turned, pair, f"{turned}@{at}", f"{pair}@{at}"] if at else [turned, pair]


_OTHER_WORDS = {
    "torque": "moment couple twist momentum drehmoment t M",
    "force": "load pull push thrust tension f kraft cable rope wire strut cylinder actuator",
    "weight": "gravity_force w",
    "angle": "direction dir orientation theta bearing heading degrees inclination",
    "link": "body member bar part element on acts_on links",
    "at": "point position location where node p applied_at",
    "against": "from between reaction other",
    "pin": "support bearing revolute hinge pivot joint r turning pinned rotational",
    "slide": "prismatic slider track rail sliding guide p translational piston",
    "slot": "pin_in_slot pinslot roller roller_support",
    "roll": "rolling wheel rack",
    "gears": "gear mesh",
    "belt": "chain chains pulley pulleys sprocket sprockets",
    "contact": "cam",
    "weld": "fixed rigid welded fix",
    "ground": "frame fixed base fixed_link earth",
    "loads": "forces load actions torques unknowns",
    "joints": "constraints connections pairs pins kinematic_pairs",
    "lengths": "dimensions distances length links_lengths sizes",
    "angles": "directions angle orientations",
    "points": "nodes coordinates positions joints_positions point",
    "near": "guess initial start approx",
    "expect": "answer answers expected results published",
    "links": "inertia inertias masses mass",
    "title": "name heading",
    "source": "reference book",
    "motion": "speed speeds velocity input",
    "along": "direction dir axis angle guide",
    "through": "on passing",
    "mu": "friction coefficient µ μ",
    "speed": "omega velocity rate w v rpm n",
    "turns": "sense rotation direction",
    "cw": "clockwise right negative",
    "ccw": "counterclockwise anticlockwise anti-clockwise counter-clockwise left positive",
    "free": "unstretched natural length rest free_length rest_length l0",
    "spring": "stiffness k",
    "centroid": "midpoint middle mean centre center",
    "length": "lengths distance",
    "acceleration": "accel acc alpha",
    "inertia": "moment_of_inertia moment j i",
    "mass": "m",
    "rope": "cable string cord wire line",
    "on": "links bodies over",
    "from": "start begin",
    "to": "end other_end",
    "distributed": "load_per_length line_load udl q",
    "centre": "center cg cog com centroid",
    "dynamic": "dynamics inertia_forces",
    "bore": "diameter dia piston",
    "teeth": "tooth numbers_of_teeth z ratio radii radius diameters diameter pitch_diameters pitch_radii",
    "module": "m modul",
    "wraps": "wrap sense",
    "radii": "radius diameters diameter dia",
    "radius": "radii r diameter dia",
    "lead": "pitch",
    "normal": "direction angle",
}
"""Words that people write for a key of the format, where they are no slip of the pen."""


_ALIKE = dict(zip("АВЕКМНОРСТХаеорсхΑΒΕΖΗΙΚΜΝΟΡΤΧ", "ABEKMHOPCTXaeopcxABEZHIKMNOPTX", strict=True))
_LATIN = str.maketrans(_ALIKE)
"""Cyrillic and Greek letters that look as Latin ones."""


def suggestion(name: str, options: Iterable[str]) -> str:
    """``; did you mean ...?`` for the nearest option, else nothing."""
    options = list(options)
    near = meant_by(name, options)
    if (latin := name.translate(_LATIN)) != name and latin in options:
        return f"; type '{latin}' anew, in Latin letters"
    if near in ("radius", "radii") and name.lower().startswith("dia"):
        return f"; write '{near}', half of it"
    return f"; did you mean '{near}'?" if near else ""


def meant_by(name: str, options: Iterable[str]) -> str:
    """The option that is meant by a name: in other letters, by another word, by a slip of the pen; or ''."""
    from difflib import get_close_matches

    known = list(islice(options, _MOST_OPTIONS))
    word = name.lower().strip()
    alone = re.sub(r"^(?:link|point|body|bar|gear)[ _]?(?=.)", "", word)
    lower = [option for option in known if option.lower() in (word, alone)]
    spellings = (name, word.replace(" ", "_"))  # M is a torque, and m a mass
    other = [o for spelt in spellings for o in known if spelt in _OTHER_WORDS.get(o, "").split()]
    latin = name.translate(_LATIN)
    near = (
        lower
        or other
        or ([latin] if latin != name and latin in known else [])
        or get_close_matches(name[:60], known, 1, 0.6)
    )
    return near[0] if near else ""


Names = tuple[str, ...]


def is_name(text: str) -> bool:
    """A letter or digit, then letters, digits, ``_`` and ``'``."""
    return (
        text.replace("_", "a").replace("'", "a").isalnum()
        and text[0] not in "_'"
        and (text.isascii() or all(c.isalpha() or c in "0123456789_'" for c in text))
    )


def why_no_name(text: str, is_key: bool = False) -> str:
    """What a name is, for a text that is none; before a colon (``is_key``) it cannot be two."""
    before, sign, after = (part.strip() for part in text.partition("="))
    if sign:
        return f"write a colon in place of '=', {before}: {after.lstrip('> ')}"
    if ";" in text:
        return f"with commas between, {', '.join(text.replace(';', ' ').split())}, these are names"
    words = text.replace(",", " ").split()
    if len(words) == 2 and words[0].lower() in ("link", "point", "joint", "body", "gear", "load"):
        return f"write the name alone, {words[1]}"
    if "(" in text:
        return f"write the name alone, {text.partition('(')[0].strip()}"
    if len(words) > 1 and "," not in text and any(len(word) > 1 and word[0].isalpha() for word in words):
        apart = (
            f"; where {' and '.join(words)} are two names, a comma between"
            if len(words) == 2 and not is_key
            else ""
        )
        return f"a name has no spaces: write {'_'.join(words)}{apart}"
    if len(words) > 1:
        return f"with a comma between, {', '.join(words)}, these are two names"
    if "’" in text or "′" in text:
        return "write the prime as a straight apostrophe (')"
    return "a name is a letter or digit followed by letters, digits, _ and '"


def atoms(key: str) -> Names:
    """``AB'C`` as the one-character names A, B', C, each with its primes."""
    found: list[str] = []
    for character in key:
        if character == "'" and found:
            found[-1] += character
        else:
            found.append(character)
    return tuple(found)


def parts(key: str) -> Names:
    """The names of which a key is made: ``O2-A``, or ``AB`` of one-character names."""
    return tuple(key.split("-")) if "-" in key else atoms(key)


def splits(key: str, parts: int, known: Callable[[str], bool]) -> Iterator[Names]:
    """Every way to cut a key without hyphens into so many known names."""
    if parts == 1:
        if is_name(key) and known(key):
            yield (key,)
        return
    for at in range(1, len(key) - parts + 2):
        if known(key[:at]) and is_name(key[:at]):
            for rest in splits(key[at:], parts - 1, known):
                yield (key[:at], *rest)


LONGEST_KEY = 120
"""Characters of a key of names; bounds the number of ways to cut it."""


def point_key(key: str, sizes: tuple[int, ...], known: Collection[str]) -> Names | str:
    """The two or three points that a key of ``lengths`` or ``angles`` names; or what is wrong with it.

    ``sizes`` are the numbers of points allowed: (2,) or (2, 3).
    """
    wanted = "two points" if sizes == (2,) else "two or three points"
    if not _ALIKE.keys().isdisjoint(key) and re.search("[A-Za-z]", key):
        return f"'{key}' has letters of two alphabets that look alike; type it anew"
    if len(key) > LONGEST_KEY:
        return f"a key names {wanted}; this one is too long"
    if "-" in key:
        names = tuple(part.strip() for part in key.split("-"))
        if len(names) in sizes and all(is_name(name) for name in names):
            return _distinct(names)
        return f"'{key}' should name {wanted}, as in AB or O2-A; {why_no_name(key)}"
    if not is_name(key):
        return f"'{key}' should name {wanted}, as in AB or O2-A; {why_no_name(key)}"
    return _unhyphened(key, sizes, known, wanted)


def _unhyphened(key: str, sizes: tuple[int, ...], known: Collection[str], wanted: str) -> Names | str:
    plain = atoms(key)
    cuts = [names for size in sizes for names in splits(key, size, known.__contains__)]
    other = [names for names in cuts if names != plain]
    if len(plain) in sizes:
        if not other:
            return _distinct(plain)
        if all(name in known for name in plain):
            ways = " or as ".join(map("-".join, [plain, *other]))
            return f"'{key}' can be read as {ways}; write it with hyphens"
    if other:
        ways = " or ".join(map("-".join, other))
        return f"'{key}': with names longer than one character write hyphens: {ways}"
    return f"'{key}' should name {wanted}: of one character each, as in AB, or with hyphens, as in O2-A"


def _distinct(names: Names) -> Names | str:
    """Neighbours in a key must differ; the two arms of an angle may be one and the same."""
    if any(a == b for a, b in pairwise(names)):
        return f"'{'-'.join(names)}' names the same point twice"
    return names


def pairs(key: str, known: Callable[[str], bool]) -> list[tuple[str, str]]:
    """Every pair of links that ``2-4``, ``crank-rocker`` or ``24`` can mean."""
    if len(key) > LONGEST_KEY:
        return []
    if "-" in key:
        first, _, second = key.partition("-")
        return [(first, second)] if known(first) and known(second) else []
    return [(a, b) for a, b in splits(key, 2, known)]
