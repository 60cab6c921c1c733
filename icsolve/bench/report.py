"""The benchmark section by section, each as Markdown that is handed on as soon as it is measured."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from icsolve.bench.accuracy import Score, scenes, scored
from icsolve.bench.closed import FOUR_BAR, FOUR_BAR_CASE
from icsolve.bench.families import FAMILIES
from icsolve.bench.laws import FORWARD, PESSIMISM, Law, bounds, forward
from icsolve.bench.timing import least

if TYPE_CHECKING:
    from icsolve.bench.sweeps import Timed


class Effort(NamedTuple):
    """How much is measured: scenes a family, scenes a law, seconds a timing, processes."""

    scenes: int
    forward: int
    bounds: int
    seconds: float
    jobs: int


USUAL = Effort(40, 200, 200, 2.0, 1)
FULL = Effort(400, 10_000, 20_000, 6.0, os.cpu_count() or 1)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def machine() -> str:
    """The machine, in a line."""
    import numpy

    system = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    return f"Machine: {_processor()}{system}; Python {platform.python_version()}, numpy {numpy.__version__}."


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = (line.partition(":")[2].strip() for line in file if line.startswith("model name"))
            return next(names, "") + ", "
    except OSError:
        return f"{platform.processor()}, " if platform.processor() else ""


def one_scene(effort: Effort) -> str:
    """One scene in process: `solve` of a loaded four-bar against the bare float kernel."""
    from icsolve.bench.kernels import componentwise, written_out
    from icsolve.read import load
    from icsolve.solve import solve

    a, b, c, d, torque = FOUR_BAR
    numbers = (d, a, b, c, 60.0, torque)
    case = load(FOUR_BAR_CASE)
    calls: dict[str, Callable[[], object]] = {
        "bare float kernel, componentwise": lambda: componentwise(*numbers),
        "the same written out by hand": lambda: written_out(*numbers),
        "solve, without bound": lambda: solve(case, bound=False),
        "solve, with bound": lambda: solve(case),
        "load, then solve with bound": lambda: solve(load(FOUR_BAR_CASE)),
    }
    times = least(list(calls.values()), effort.seconds)
    rows = [[name, f"{1e6 * t:.1f}", f"{t / times[0]:.1f}"] for name, t in zip(calls, times, strict=True)]
    return table(("one four-bar scene", "us", "x kernel"), rows)


def accuracy(effort: Effort, keep: list[Score]) -> Iterator[str]:
    """Every method on every family; the scores are kept for the picture."""
    from icsolve.bench.methods import METHODS

    yield table(("family", *(method.name for method in METHODS)), ())
    for family in FAMILIES:
        known = list(scenes(family, max(3, effort.scenes // family.weight)))
        scores = [scored(method, family, known) for method in METHODS]
        keep += scores
        yield "| " + " | ".join([family.name, *map(_score, scores)]) + " |"


def _score(score: Score) -> str:
    """Worst error over (kappa + 1) u, and how many scenes have no answer."""
    parts = [f"{score.per_unit:.2g}"] if score.per_unit >= 0.0 else []
    parts += [f"{score.failed}/{score.scenes} fail"] if score.failed else []
    parts += [f"{score.refused} refused"] if score.refused else []
    return ", ".join(parts) or "-"


def method_times(scores: Sequence[Score]) -> str:
    """Median time of each method on mechanisms of more and more links."""
    families = ("four-bar", "from lengths", "Stephenson", "double butterfly", "chain of 50")
    by_key = {(score.method, score.family): score.micros for score in scores}
    methods = dict.fromkeys(score.method for score in scores if score.family in families[1:])
    rows = [[m, *(_micros(by_key.get((m, family))) for family in families)] for m in methods]
    return table(("median us a scene", *families), rows)


def _micros(micros: float | None) -> str:
    return f"{micros:.3g}" if micros is not None and micros > 0.0 else "-"


def laws(effort: Effort) -> Iterator[str]:
    """The forward error and the error bound, family by family."""
    yield _laws(f"forward error / (kappa + 1) u, at most {FORWARD:g}", forward(effort.forward, effort.jobs))
    yield _laws(
        f"error bound / error; median at most {PESSIMISM:g}, never broken", bounds(effort.bounds, effort.jobs)
    )


def _laws(name: str, found: Sequence[Law]) -> str:
    rows = [
        [law.family, str(law.scenes), str(law.broken), f"{law.median:.2g}", f"{law.worst:.2g}"]
        for law in found
    ]
    total = ["all", str(sum(law.scenes for law in found)), str(sum(law.broken for law in found)), "", ""]
    return table((name, "scenes", "broken", "median", "worst"), [*rows, total])


def full_turn(effort: Effort, keep: list[Score]) -> str:
    """Sweeps against hand-written numpy and C, at 3600 and a million positions."""
    from icsolve.bench.sweeps import BOUNDED, BY_HAND, IN_C, MILLION, SWEPT, TURN, full_turns, memory

    def row(name: str, by: dict[str, Timed]) -> list[str]:
        times = [f"{1e3 * by[m].seconds:.3g}" if m in by else "-" for m in (BY_HAND, IN_C, SWEPT, BOUNDED)]
        pairs = ((SWEPT, BY_HAND), (SWEPT, IN_C), (BOUNDED, SWEPT))
        ratios = [f"{by[a].seconds / by[b].seconds:.1f}" if b in by else "-" for a, b in pairs]
        return [name, str(by[SWEPT].positions), *times, *ratios, f"{by[SWEPT].error:.1e}"]

    rows = []
    for positions in (TURN, MILLION):
        for name, by in full_turns(positions, 3.0 * effort.seconds).items():
            rows.append(row(name, by))
            keep += [_as_score(timed) for timed in by.values() if positions == TURN]
    used = memory()
    said = "" if used is None else f"\n\nA million positions of the four-bar take a process of {used:.0f} MB."
    head = ("ms", "positions", BY_HAND, IN_C, "sweep", "sweep with bounds")
    ratios = ("sweep / numpy", "sweep / C", "bounds / sweep", "worst error")
    return table((*head, *ratios), rows) + said


def _as_score(t: Timed) -> Score:
    """A full turn as one family of scenes."""
    return Score(t.method, t.mechanism, t.error, t.per_unit, 1e6 * t.seconds / t.positions, 0, 0, t.positions)


def peers(effort: Effort) -> str:
    """The same full turn by other programs."""
    from icsolve.bench.peers import PEERS, POSITIONS, ran
    from icsolve.bench.sweeps import SWEPT, full_turns

    own = next(iter(full_turns(POSITIONS, effort.seconds).values()))[SWEPT]
    rows = [["icsolve", "torque", f"{1e3 * own.seconds:.3g}", "1", f"{own.error:.1e}"]]
    for peer in PEERS:
        found = ran(peer)
        if found.why:
            rows.append([found.name, found.gives, "-", "-", found.why])
        else:
            times = f"{found.seconds / own.seconds:.0f}"
            rows.append([found.name, found.gives, f"{1e3 * found.seconds:.3g}", times, f"{found.error:.1e}"])
    return table((f"four-bar, {POSITIONS} positions", "gives", "ms", "x icsolve", "worst error"), rows)


def start_up(effort: Effort) -> str:
    """Whole processes, cold, in CPU time."""
    from icsolve.bench.startup import IMPORTS, starts

    found = starts(max(5, int(3 * effort.seconds)))
    base = next(start.seconds for start in found if start.name == IMPORTS[0])
    rows = [[s.name, f"{1e3 * s.seconds:.0f}", f"{s.seconds / base:.2f}"] for s in found]
    return table(("whole process", "CPU ms", "x imports"), rows)


def stress() -> tuple[str, int]:
    """The stress catalogue as a table, and how many verdicts are not the ones asked."""
    from icsolve.bench.catalogue import CATALOGUE
    from icsolve.bench.stress import judge

    rows, wrong = [], 0
    for entry in CATALOGUE:
        judged = judge(entry)
        wrong += bool(judged.faults)
        verdict = judged.got if not judged.faults else f"WRONG ({'; '.join(judged.faults)}): {judged.got}"
        cells = [entry.number, entry.title, str(entry.asked), verdict, f"{1e3 * judged.seconds:.1f}"]
        rows.append([cell.replace("|", "/").replace("\n", " ") for cell in cells])
    return table(("number", "case", "verdict asked", "verdict got", "ms"), rows), wrong


def run(full: bool, say: Callable[[str], None]) -> list[Score]:
    """The whole benchmark; every piece of Markdown goes to ``say``. Returns the scores for the picture."""
    effort = FULL if full else USUAL
    scores: list[Score] = []
    say(f"# icsolve bench\n\n{machine()}\n")
    say(f"## One scene, in process\n\n{one_scene(effort)}\n")
    say(f"## A full turn\n\n{full_turn(effort, scores)}\n")
    say(f"## Other programs\n\n{peers(effort)}\n")
    say(f"## Start-up\n\n{start_up(effort)}\n")
    say("## Error over (kappa + 1) u, the worst of a family\n")
    for line in accuracy(effort, scores):
        say(line)
    say(f"\n## Time\n\n{method_times(scores)}\n")
    say("## Laws against sixty digits\n")
    for text in laws(effort):
        say(f"{text}\n")
    sys.stdout.flush()
    return scores
