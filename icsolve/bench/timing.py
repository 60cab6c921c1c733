"""Times: the least of many interleaved batches, so that ratios hold on a busy machine."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

Call = Callable[[], object]


def least(calls: Sequence[Call], seconds: float, batch: float = 2e-3) -> list[float]:
    """Seconds a call of each, the least over batches in turn; about so many seconds in all."""
    sizes = [max(1, int(batch / _once(call))) for call in calls]
    best = [float("inf")] * len(calls)
    end = time.perf_counter() + seconds
    while True:
        for k, call in enumerate(calls):
            start = time.perf_counter()
            for _ in range(sizes[k]):
                call()
            best[k] = min(best[k], (time.perf_counter() - start) / sizes[k])
        if time.perf_counter() > end:
            return best


def _once(call: Call) -> float:
    """About how long a call takes, warm."""
    call()
    start = time.perf_counter()
    call()
    return max(time.perf_counter() - start, 1e-7)
