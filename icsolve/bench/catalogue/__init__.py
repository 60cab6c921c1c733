"""The stress catalogue by its numbers."""

from __future__ import annotations

from icsolve.bench.catalogue import joints, linkages
from icsolve.bench.stress import Stress


def _place(stress: Stress) -> tuple[int, str]:
    """Sorting key: the number, then its letter."""
    digits = stress.number.rstrip("abcdefgh")
    return int(digits), stress.number[len(digits) :]


_ROOMS = (linkages, joints)
CATALOGUE: tuple[Stress, ...] = tuple(
    sorted((entry for room in _ROOMS for entry in room.ENTRIES), key=_place)
)
"""Every scene, in the order of its number."""
