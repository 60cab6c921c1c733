"""The order in which a student finds centres: those by inspection, then each by the lines of earlier ones."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from icsolve.answer import Centre
from icsolve.case import Pair
from icsolve.construction.known import Known


class Step(NamedTuple):
    """One centre as it is found; ``number`` is 0 for those by inspection, else 1, 2, ... in order."""

    number: int
    centre: Centre


def steps_of(known: Known, wanted: Iterable[Pair]) -> tuple[Step, ...]:
    """The steps to the wanted centres, and to those that their lines go through, and no others."""
    needed: dict[Pair, Centre] = {}
    for pair in wanted:
        _need(known, pair, needed)
    first = [c for c in needed.values() if not c.lines and c.by != "loop equations"]
    later = [c for c in needed.values() if c.lines or c.by == "loop equations"]
    numbered = (Step(number, centre) for number, centre in enumerate(later, 1))
    return (*(Step(0, centre) for centre in sorted(first, key=lambda c: _order(known, c.pair))), *numbered)


def _need(known: Known, wanted: Pair, needed: dict[Pair, Centre]) -> None:
    """Put a centre after all those that its lines go through (a loop, so that long chains are fine)."""
    stack = [wanted]
    opened: set[Pair] = set()
    while stack:
        pair = stack[-1]
        centre = known.centre(*pair)
        if pair in needed or centre is None or centre.kind not in ("at", "toward"):
            stack.pop()
            continue
        before = [end for line in centre.lines if len(line) == 2 for end in line if end not in needed]
        before = [end for end in before if end not in opened and _is_placed(known.centre(*end))]
        if before:
            opened.add(pair)
            stack.extend(reversed(before))
            continue
        needed[pair] = centre
        stack.pop()


def _is_placed(centre: Centre | None) -> bool:
    return centre is not None and centre.kind in ("at", "toward")


def _order(known: Known, pair: Pair) -> tuple[tuple[int, int], ...]:
    from icsolve.case.names import link_order

    return tuple(link_order(known.case, link) for link in pair)
