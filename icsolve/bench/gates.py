"""What the product promises in figures, each as measured beside its limit; how much is measured; tables.

Times are of calls in interleaved batches, so that ratios hold on a busy machine, and of whole processes. CPU
time counts every core, so that nothing looks faster for using two.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence

from icsolve.bench.accuracy import Score
from icsolve.tuples import NamedTuple


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(table_row(line) for line in lines)


def table_row(cells: Sequence[str]) -> str:
    """One row of it."""
    return "| " + " | ".join(cells) + " |"


class Gate(NamedTuple):
    """A figure and its limit, which it may not pass (with ``floor``: not fall short of)."""

    what: str
    found: float
    limit: float
    unit: str = ""
    floor: bool = False

    @property
    def held(self) -> bool:
        """Whether the figure keeps its limit; nan does not."""
        return self.found >= self.limit if self.floor else self.found <= self.limit


def ratio(what: str, found: float, limit: float, *, floor: bool = False) -> Gate:
    """How many times."""
    return Gate(what, found, limit, " x", floor)


def gate_table(gates: Iterable[Gate]) -> str:
    """Every figure with its limit, and whether it is kept."""
    return table(("figure", "measured", "asked", "kept"), map(_row, gates))


def _row(gate: Gate) -> list[str]:
    asked = f"{'at least' if gate.floor else 'at most'} {gate.limit:g}{gate.unit}"
    return [gate.what, f"{gate.found:.3g}{gate.unit}", asked, "yes" if gate.held else "NO"]


class Effort(NamedTuple):
    """Scenes a family of the tables, scenes a family of each law (of the digits, of the first), seconds a
    timing, processes."""

    scenes: int
    forward: int
    bounds: int
    bits: int
    digits: int
    seconds: float
    jobs: int

    @property
    def rounds(self) -> int:
        """Runs of what takes a tenth of a second or more."""
        return max(1, int(4 * self.seconds))


USUAL = Effort(80, 1_000, 500, 200, 400, 3.0, 1)
FULL = Effort(400, 10_000, 12_000, 2_000, 40_000, 6.0, os.cpu_count() or 1)


class Kept(NamedTuple):
    """What the tables leave: scores of single scenes, of full turns, peers that did not run, figures."""

    scenes: list[Score]
    turns: list[Score]
    absent: list[str]
    gates: list[Gate]


def nothing() -> Kept:
    """Before anything is measured."""
    return Kept([], [], [], [])


# --- times ------------------------------------------------------------------------------------------

Call = Callable[[], object]
TURN = 20
"""Batches before another call has its turn."""
BATCH = 1e-4
"""Seconds of a batch."""
LONG = 5e-3
"""Seconds of a call that is alone a turn."""


def least(calls: Sequence[Call], seconds: float) -> list[float]:
    """Seconds a call of each, that a tenth of its batches keep; about so many CPU seconds in all.

    The calls take turns of several batches each, of which the first warms the caches again. The very
    least would be that of a moment in which the processor ran faster.
    """
    for call in calls:
        call()  # warm
    rough = [max(once(call), 1e-7) for call in calls]
    sizes = [max(1, int(BATCH / took)) for took in rough]
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


def cpu_seconds(command: list[str]) -> float:
    """User and system seconds of a child process; its wall time where the system does not tell them.

    Modules are compiled once, as they are when a package is installed, and numpy has as many threads as it
    takes by itself.
    """
    own = ("PYTHONDONTWRITEBYTECODE", "_NUM_THREADS")
    environment = {k: v for k, v in os.environ.items() if not k.endswith(own)}
    try:
        from resource import RUSAGE_CHILDREN, getrusage
    except ImportError:
        start = time.perf_counter()
        subprocess.run(command, capture_output=True, check=True, env=environment)
        return time.perf_counter() - start
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run(command, capture_output=True, check=True, env=environment)
    after = getrusage(RUSAGE_CHILDREN)
    return (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)


def own_command() -> list[str]:
    """The command `icsolve` as it was installed beside this interpreter; where it was not, the module."""
    installed = os.path.join(os.path.dirname(sys.executable), "icsolve")
    return [installed] if os.path.exists(installed) else [sys.executable, "-m", "icsolve"]


def peak_memory(code: str) -> float | None:
    """Largest resident memory in MB of a Python process that runs some code; None where it is not told.

    Its own peak where /proc tells it: the other count starts from the size of the process that started it.
    """
    tail = (
        "import os, resource\n"
        "own = [line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM:')] "
        "if os.path.exists('/proc/self/status') else []\n"
        "print(*(own or [resource.getrusage(resource.RUSAGE_SELF).ru_maxrss]))"
    )
    ran = subprocess.run(
        [sys.executable, "-c", f"{code}\n{tail}"], capture_output=True, text=True, check=False
    )
    if ran.returncode:
        return None
    kilobytes = int(ran.stdout.split()[-1])
    return kilobytes / (1024.0**2 if sys.platform == "darwin" else 1024.0)
