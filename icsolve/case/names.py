"""Names of links and of their centres: ``2-4``, ``crank-rocker``."""

from __future__ import annotations

from icsolve.case import Case, Pair


def link_order(case: Case, link: str) -> tuple[int, int]:
    """Sorting key of a link: numbers ascending, then words in order of first mention."""
    if link.isdecimal():
        return (0, int(link))
    return (1, case.links.index(link) if link in case.links else len(case.links))


def ordered_pair(case: Case, a: str, b: str) -> Pair:
    """Two links in the order in which their centre is named."""
    return (a, b) if link_order(case, a) <= link_order(case, b) else (b, a)


def pair_name(case: Case, pair: Pair) -> str:
    """Name of the centre of two links, whichever way they are given."""
    return "-".join(ordered_pair(case, *pair))
