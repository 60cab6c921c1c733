"""Start-up: the CPU time of the whole process, cold, against what its imports cost."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from typing import NamedTuple

from icsolve.bench.closed import FOUR_BAR_CASE


class Start(NamedTuple):
    """A process and the least CPU seconds that it took."""

    name: str
    seconds: float


BARE = ("python -c pass", ["-c", "pass"])
IMPORTS = ("python -c 'import click, yaml'", ["-c", "import click, yaml"])
COMMAND = "icsolve solve four-bar.yaml"


def starts(rounds: int = 7) -> list[Start]:
    """Bare Python, the two packages that the command needs, and the command on one case, in turn."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "four-bar.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(FOUR_BAR_CASE)
        command = (COMMAND, ["-m", "icsolve", "solve", path])
        runs = (BARE, IMPORTS, command)
        best = dict.fromkeys((name for name, _ in runs), float("inf"))
        for _, arguments in runs:
            _cpu([sys.executable, *arguments])
        for _ in range(rounds):
            for name, arguments in runs:
                best[name] = min(best[name], _cpu([sys.executable, *arguments]))
    return [Start(name, seconds) for name, seconds in best.items()]


def _cpu(command: list[str]) -> float:
    """User and system seconds of a child process; its wall time where the system does not tell them.

    Modules are compiled once, as they are when a package is installed.
    """
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
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
