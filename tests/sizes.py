"""How large the laws run: seeded samples in every run, and in full by hand with ``ICSOLVE_FULL=1``."""

from __future__ import annotations

import os
from collections.abc import Sequence
from itertools import product
from typing import Any

FULL = os.environ.get("ICSOLVE_FULL") == "1"
MORE = 20 if FULL else 1
"""So many times as many random scenes."""


def crossed(*kinds: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Each of one kind with each of the others in a full run; else so many that every one of each occurs."""
    if FULL:
        return list(product(*kinds))
    return [tuple(of[n % len(of)] for of in kinds) for n in range(max(map(len, kinds)))]


def few(full: int) -> int:
    """So many trials of one law, each of which asserts the same, in a full run; else a third of them."""
    return full if FULL else -(-full // 3)
