"""The benchmark section by section, each as Markdown that is handed on as soon as it is measured; and the
work-precision diagram: error across, time up, one curve a method; what fails is drawn too.

Above two panels for single scenes, a mark a family: the relative error, which a bad scene spoils for
every method, and the error over (kappa + 1) u, which tells what the method itself loses. Below a full turn.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterable, Iterator, Sequence
from io import StringIO
from itertools import cycle
from math import isfinite
from typing import TYPE_CHECKING, Any

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

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    Style = dict[str, Any]

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


# --- the work-precision diagram ------------------------------------------------------------------------


PALETTE = ("#d55e00", "#e69f00", "#a0761a", "#cc79a7", "#009e73", "#7f7f7f", "#b04a5a", "#6a8f2f")
"""Told apart by the colour-blind (after Okabe and Ito); our own are blue."""
BLUES = ("#0072d6", "#4db3f0")
SHAPES = "^sDv+_*s"
LONG = "chain"
"""Families of long mechanisms, whose time is that of their length: a curve of their own, dashed."""
LEAST = {"error": 2.0**-54, "per_unit": 2.0**-6}
"""Where an error that is less, or zero, is drawn."""
READING = (
    "Further left is more accurate, further down is faster.",
    "×  a family with scenes that the method does not solve, or gets wrong",
    "    by more than 10 %;  ○  one with scenes that are refused, with the cause.",
    "Dashed: long chains, of 12 and of 50 four-bars.",
    "κ: sensitivity of the scene itself; u = 2⁻⁵³. An error of about (κ + 1) u",
    "is the best that a method can promise. Truth: 60 digits.",
)


def picture(scenes: Sequence[Score], turns: Sequence[Score], absent: Sequence[str]) -> str:
    """The SVG: scores of methods on families of single scenes, of full turns, and what did not run."""
    import matplotlib as mpl

    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "icsolve", "font.size": 9}):
        text = StringIO()
        figure(scenes, turns, absent).savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()


def figure(scenes: Sequence[Score], turns: Sequence[Score], absent: Sequence[str]) -> Figure:
    """The same before it is written; a mark's id says what it stands for."""
    from matplotlib.figure import Figure

    sheet = Figure(figsize=(12, 10), layout="constrained")
    sheet.suptitle("Run time against error: one curve a method, one mark a family of scenes")
    rows: Any = sheet.subfigures(2)
    panels: Any = rows[0].subplots(1, 4, sharey=True, width_ratios=(4, 1, 4, 1))
    turn, words = rows[1].subplots(1, 2)
    styles = _styles(score.method for score in scenes if score.scenes)
    for (main, lost), (title, across, measure) in zip((panels[:2], panels[2:]), MEASURES, strict=True):
        _name(main, title, across, "median time of a scene, warm (µs)")
        lost.set(xticks=(), xlabel="no answer")
        for n, (method, style) in enumerate(styles.items()):
            own = [score for score in scenes if score.method == method and score.scenes]
            _curve(main, [s for s in own if LONG not in s.family], measure, style)
            _curve(main, [s for s in own if LONG in s.family], measure, {**style, "linestyle": "--"})
            _failures(lost, n, own, style)
    promised = panels[2].axvline(FORWARD, color=BLUES[0], linestyle=":")
    panels[2].legend([promised], [f"promised: at most {FORWARD:g}"], fontsize="small")
    _turns(turn, turns)
    _explain(words, panels[0].get_legend_handles_labels(), scenes, absent)
    return sheet


MEASURES = (
    ("One scene: error of the answer", "worst relative error of a family", "error"),
    ("One scene: what the method loses", "worst error / ((κ + 1) u) of a family", "per_unit"),
)


def _styles(methods: Iterable[str]) -> dict[str, Style]:
    """A style for every method; those of icsolve are blue and larger."""
    blues, others, shapes = cycle(BLUES), cycle(PALETTE), cycle(SHAPES)
    return {
        name: {"color": next(blues), "marker": "o", "markersize": 7, "linewidth": 2}
        if name.startswith("icsolve")
        else {"color": next(others), "marker": next(shapes), "markersize": 5, "linewidth": 1}
        for name in dict.fromkeys(methods)
    }


def _name(panel: Axes, title: str, across: str, up: str) -> None:
    panel.set(title=title, xlabel=across, ylabel=up, xscale="log", yscale="log")
    panel.grid(alpha=0.25)


def _curve(panel: Axes, scores: Iterable[Score], measure: str, style: Style) -> None:
    """A method's marks in the order of their errors."""
    found = sorted((getattr(s, measure), s.micros, s) for s in scores if isfinite(getattr(s, measure)))
    if not found:
        return
    across = [max(error, LEAST[measure]) for error, _, _ in found]
    (curve,) = panel.plot(across, [micros for _, micros, _ in found], alpha=0.8, **style)
    curve.set(label=found[0][2].method, gid="; ".join(_said(score, measure) for *_, score in found))


def _failures(panel: Axes, column: int, scores: Iterable[Score], style: Style) -> None:
    """A cross for a family with failures, a ring for one with refusals, in the method's own column."""
    for score in scores:
        for shape, count in (("x", score.failed), ("o", score.refused)):
            if count:
                ring = {"marker": shape, "markerfacecolor": "none", "color": style["color"]}
                panel.plot([column], [score.micros], gid=_said(score, "error"), **ring)


def _said(score: Score, measure: str) -> str:
    parts = [f"{score.method}, {score.family}: error {getattr(score, measure):.2g}, {score.micros:.3g} µs"]
    parts += [f"{score.failed} of {score.scenes} without an answer"] if score.failed else []
    parts += [f"{score.refused} of {score.scenes} refused"] if score.refused else []
    return "; ".join(parts)


def _turns(panel: Axes, scores: Sequence[Score]) -> None:
    """Full turns: a curve a method, on it a mark of its own for each mechanism."""
    _name(panel, "A full turn of 3600 positions", "worst relative error of the torque", "a position (µs)")
    for method, style in _styles(score.method for score in scores).items():
        disc = {**style, "marker": "o", "markersize": 9}
        _curve(panel, [score for score in scores if score.method == method], "error", disc)
    for family, shape in zip(dict.fromkeys(score.family for score in scores), "DPX", strict=False):
        own = [score for score in scores if score.family == family]
        across = [max(score.error, LEAST["error"]) for score in own]
        micros = [score.micros for score in own]
        panel.plot(across, micros, "k" + shape, markersize=4, markerfacecolor="w", label=family)
    if scores:
        panel.legend(fontsize="small")


def _explain(
    panel: Axes, named: tuple[list[Any], list[Any]], scenes: Sequence[Score], absent: Sequence[str]
) -> None:
    """The methods of the panels above, and how to read them."""
    panel.axis("off")
    curves = {label: curve for curve, label in zip(*named, strict=True)}  # dashed ones share the name
    panel.legend(curves.values(), curves, loc="upper left", ncols=2, title="One scene: the methods")
    count = max((score.scenes for score in scenes), default=0)
    lines = [f"{len({s.family for s in scenes})} families of up to {count} random scenes each.", *READING]
    lines += [f"Not in the full turn: {words}." for words in absent]
    for k, line in enumerate(reversed(lines)):
        panel.text(0.02, 0.02 + 0.06 * k, line, transform=panel.transAxes)
