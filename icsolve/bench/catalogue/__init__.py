"""The stress catalogue by its numbers."""

from __future__ import annotations

from icsolve.bench.catalogue import figures, large, pinned, sliding, wheels
from icsolve.bench.stress import Stress


def _place(stress: Stress) -> tuple[int, str]:
    """Sorting key: the number, then its letter."""
    digits = stress.number.rstrip("abcdefgh")
    return int(digits), stress.number[len(digits) :]


CATALOGUE: tuple[Stress, ...] = tuple(
    sorted((*pinned.ENTRIES, *sliding.ENTRIES, *wheels.ENTRIES, *figures.ENTRIES, *large.ENTRIES), key=_place)
)
"""Every scene, in the order of its number."""
