"""Names of points, links, loads and centres: raw text, and the keys that join two or three of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from itertools import pairwise

Names = tuple[str, ...]


def is_name(text: str) -> bool:
    """A letter or digit, then letters, digits, ``_`` and ``'``."""
    return (
        text.replace("_", "a").replace("'", "a").isalnum()
        and text[0] not in "_'"
        and (text.isascii() or all(c.isalpha() or c in "0123456789_'" for c in text))
    )


def why_no_name(text: str) -> str:
    """What a name is, for a text that is none."""
    if len(text.split()) > 1:
        return f"with a comma between, {', '.join(text.split())}, these are two names"
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
