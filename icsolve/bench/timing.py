"""Times: the CPU time of many interleaved batches, so that ratios hold on a busy machine.

CPU time counts every core, so that nothing looks faster for using two.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

Call = Callable[[], object]
TURN = 20
"""Batches before another call has its turn."""
LONG = 5e-3
"""Seconds of a call that is alone a turn."""


def least(calls: Sequence[Call], seconds: float, batch: float = 1e-4) -> list[float]:
    """Seconds a call of each, that a tenth of its batches keep; about so many CPU seconds in all.

    The calls take turns of several batches each, of which the first warms the caches again. The very
    least would be that of a moment in which the processor ran faster.
    """
    rough = [_rough(call) for call in calls]
    sizes = [max(1, int(batch / took)) for took in rough]
    turns = [1 if took > LONG else TURN for took in rough]
    found: list[list[float]] = [[] for _ in calls]
    end = time.process_time() + seconds
    while True:
        for k, call in enumerate(calls):
            for _ in range(turns[k]):
                found[k].append(once(call, sizes[k]) / sizes[k])
        if time.process_time() > end:
            return [sorted(times)[len(times) // 10] for times in found]


def once(call: Call, times: int = 1) -> float:
    """CPU seconds of so many calls."""
    start = time.process_time()
    for _ in range(times):
        call()
    return time.process_time() - start


def _rough(call: Call) -> float:
    """About how long a call takes, warm."""
    call()
    return max(once(call), 1e-7)
