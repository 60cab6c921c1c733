"""The benchmark section by section, each as Markdown that is handed on as soon as it is measured."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterator, Sequence

from icsolve.bench.accuracy import (
    FORWARD,
    FORWARD_FAMILIES,
    PESSIMISM,
    Law,
    Score,
    bits_kept,
    bound_over_error,
    every_end,
    every_number,
    every_row,
    forward_error,
    held,
    scenes,
    scored,
)
from icsolve.bench.families import BOUNDED, EXACT, FAMILIES, RUBBING
from icsolve.bench.full_turn import compiler_version
from icsolve.bench.gates import FULL, USUAL, Effort, Gate, Kept, gate_table, nothing, table, table_row
from icsolve.bench.rivals import METHODS, OWN

ENOUGH = 10
"""Scenes for a median."""


def machine() -> str:
    """The machine, in a line."""
    import numpy

    system = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    compiler = compiler_version() or "no C compiler"
    python = f"Python {platform.python_version()}, numpy {numpy.__version__}, {compiler}"
    return f"Machine: {_processor()}{system}; {python}. One core is used, but for the laws."


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = (line.partition(":")[2].strip() for line in file if line.startswith("model name"))
            return next(names, "") + ", "
    except OSError:
        return f"{platform.processor()}, " if platform.processor() else ""


def accuracy(effort: Effort, kept: Kept) -> Iterator[str]:
    """Every method on every family, line by line; the last line has the worst of all."""
    yield table(("family", *(method.name for method in METHODS)), ())
    for family in FAMILIES:
        known = list(scenes(family, max(3, effort.scenes // family.weight)))
        scores = [scored(method, family, known) for method in METHODS]
        kept.scenes.extend(scores)
        yield table_row([family.name, *map(_score, scores)])
    by_method = [[score for score in kept.scenes if score.method == m.name] for m in METHODS]
    yield table_row(["worst of all", *map(_worst, by_method)])
    own = [score for score in kept.scenes if score.method in OWN and score.scenes > score.refused]
    worst = max(score.per_unit for score in own)
    kept.gates.append(Gate("forward error over (kappa + 1) u, worst of every family", worst, FORWARD))
    wrong = sum(score.failed for score in own if score.method == OWN[-1])
    kept.gates.append(Gate("answers with a bound that are off by more than a tenth", wrong, 0))


def _score(score: Score) -> str:
    """Worst error over (kappa + 1) u, and how many scenes have no answer."""
    parts = [f"{score.per_unit:.2g}"] if score.per_unit >= 0.0 else []
    parts += [f"{score.failed}/{score.scenes} fail"] if score.failed else []
    parts += [f"{score.refused} refused"] if score.refused else []
    return ", ".join(parts) or "-"


def _worst(scores: Sequence[Score]) -> str:
    """The same over all families, counted in families."""
    failing = sum(score.failed > 0 for score in scores)
    worst = max((score.per_unit for score in scores if score.per_unit >= 0.0), default=0.0)
    return f"{worst:.2g}" + (f", {failing} families with failures" if failing else "")


def method_times(scores: Sequence[Score]) -> str:
    """Median time of each method on mechanisms of more and more links."""
    families = ("four-bar", "from lengths", "Stephenson", "double butterfly", "chain of 50")
    by_key = {(score.method, score.family): score for score in scores}
    methods = dict.fromkeys(score.method for score in scores)
    rows = [[m, *(_micros(by_key.get((m, family))) for family in families)] for m in methods]
    return table(("median us a scene", *families), rows)


def _micros(score: Score | None) -> str:
    lost = score is None or score.scenes == score.failed + score.refused
    return "-" if score is None or lost else f"{score.micros:.3g}"


def laws(effort: Effort, kept: Kept) -> Iterator[str]:
    """The forward error, the error bound and powers of two, family by family."""
    found = held(forward_error, FORWARD_FAMILIES, effort.forward, effort.jobs)
    worst, count = max(law.worst for law in found), _scenes(found)
    what = f"forward error over (kappa + 1) u, worst of {count} random six-bars and all joints"
    kept.gates.append(Gate(what, worst, FORWARD))
    yield _laws(f"forward error / (kappa + 1) u, at most {FORWARD:g}", found)
    found = held(bound_over_error, BOUNDED, effort.bounds, effort.jobs)
    broken, count = _broken(found), _scenes(found)
    enough = min(ENOUGH, max(law.scenes for law in found))
    middle = max(law.median for law in found if law.scenes >= enough)
    kept.gates.append(Gate(f"bounds that are less than the error, of {count}", broken, 0))
    kept.gates.append(Gate("bound over error, worst median of a family", middle, PESSIMISM))
    yield _laws(f"error bound / error; median at most {PESSIMISM:g}, never broken", found)
    for name, law, families, share in (
        ("numbers", every_number, EXACT, 1),
        ("rows of sweeps", every_row, EXACT, 10),
        ("ends with friction", every_end, RUBBING, 1),
    ):
        found = held(law, families, effort.digits // share, effort.jobs)
        broken, count = _broken(found), _scenes(found)
        kept.gates.append(Gate(f"{name} that are not the exact ones, in {count} scenes", broken, 0))
        rows = [[law.family, str(law.scenes), str(law.broken), f"{law.median:g}"] for law in found]
        yield table((f"{name} against 140 digits", "scenes", "broken", "median a scene"), rows)
    found = held(bits_kept, BOUNDED, effort.bits, effort.jobs)
    broken, count = _broken(found), _scenes(found)
    kept.gates.append(Gate(f"answers changed by a scale of a power of two, of {count}", broken, 0))
    rows = [[law.family, str(law.scenes), str(law.broken)] for law in found]
    yield table(("lengths and loads times powers of two", "scenes", "a bit changed"), rows)


def _laws(name: str, found: Sequence[Law]) -> str:
    rows = [
        [law.family, str(law.scenes), str(law.broken), f"{law.median:.2g}", f"{law.worst:.2g}"]
        for law in found
    ]
    total = ["all", str(_scenes(found)), str(_broken(found)), "", ""]
    return table((name, "scenes", "broken", "median", "worst"), [*rows, total])


def _scenes(found: Sequence[Law]) -> int:
    return sum(law.scenes for law in found)


def _broken(found: Sequence[Law]) -> int:
    return sum(law.broken for law in found)


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


def run(full: bool, say: Callable[[str], None]) -> Kept:
    """The whole benchmark; every piece of Markdown goes to ``say``. Returns what the picture draws."""
    from icsolve.bench.grading import drawing, grading
    from icsolve.bench.promises import promises
    from icsolve.bench.speed import full_turn, one_scene, other_programs

    effort, kept = FULL if full else USUAL, nothing()
    say(f"# icsolve bench\n\n{machine()}\n")
    say(f"## One scene, in process\n\n{one_scene(effort, kept)}\n")
    say(f"## A full turn\n\n{full_turn(effort, kept)}\n")
    say(f"## Other programs\n\n{other_programs(effort, kept)}\n")
    say("## Rows, families, growth, tables and starts\n")
    for text in promises(effort, kept):
        say(f"{text}\n")
    say(f"## Grading\n\n{grading(effort, kept)}\n")
    say(f"## Drawing\n\n{drawing(effort, kept)}\n")
    say("## Error over (kappa + 1) u, the worst of a family\n")
    for line in accuracy(effort, kept):
        say(line)
    say(f"\n## Time\n\n{method_times(kept.scenes)}\n")
    say("## Laws against sixty digits\n")
    for text in laws(effort, kept):
        say(f"{text}\n")
    say(f"## Figures and their limits\n\n{gate_table(kept.gates)}\n")
    return kept
