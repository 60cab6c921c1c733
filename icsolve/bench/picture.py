"""The work-precision diagram: error across, time up, one curve a method; what fails is drawn too.

Above two panels for single scenes, a mark a family: the relative error, which a bad scene spoils for
every method, and the error over (kappa + 1) u, which tells what the method itself loses. Below a full turn.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import StringIO
from itertools import cycle
from math import isfinite
from typing import TYPE_CHECKING, Any

from icsolve.bench.accuracy import FORWARD, Score

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    Style = dict[str, Any]

PALETTE = ("#d55e00", "#e69f00", "#a0761a", "#cc79a7", "#009e73", "#7f7f7f", "#b04a5a", "#6a8f2f")
"""Told apart by the colour-blind (after Okabe and Ito); our own are blue."""
OWN = ("#0072d6", "#4db3f0")
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
    promised = panels[2].axvline(FORWARD, color=OWN[0], linestyle=":")
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
    blues, others, shapes = cycle(OWN), cycle(PALETTE), cycle(SHAPES)
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
