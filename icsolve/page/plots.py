"""The plots of a page: the answer and the mechanical advantage over the range, each with a cursor."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from icsolve.construction import Known
from icsolve.draw.curves import Curve, Frame, asymptotes
from icsolve.draw.marks import Mark, bounds
from icsolve.draw.plot import plot_marks
from icsolve.errors import Status
from icsolve.page.columns import FINE, compact
from icsolve.page.motion import Motion
from icsolve.page.poses import Array
from icsolve.solve.refusals import rubs
from icsolve.wording.senses import unit_of

SIZE = (440.0, 250.0)
DEAD = (Status.DEAD_CENTRE, Status.NO_VALUE)
MOST = 3
"""So many curves are told apart in one plot."""


class Plot(NamedTuple):
    """A plot's marks with their view, its heading, and what the cursor needs: frame and values."""

    heading: str
    marks: tuple[Mark, ...]
    view: tuple[float, float, float, float]
    frame: Frame
    curves: tuple[Curve, ...]


def plots_of(known: Known, motion: Motion) -> list[Plot]:
    """The answer and the mechanical advantage; without an unknown load the ratios of the rates."""
    x = motion.degrees[motion.first : motion.last + 1].tolist()
    dead = dead_rows(motion)
    found = [
        ("The answer" if len(some) == 1 else "The answers", some) for some in _answers(known, motion, dead)
    ]
    advantage = _advantage(known, motion, dead)
    found += [("Mechanical advantage", advantage)] if advantage else []
    rates = [] if motion.found.answers else _rates(known, motion)
    found += [("Ratios of angular velocities", rates)] if rates else []
    axis = f"link {motion.driver} {motion.by.verb} from the position as written, {motion.by.unit_name}"
    return [_plot(heading, x, curves, axis) for heading, curves in found]


def dead_rows(motion: Motion) -> list[float]:
    """The degrees of the rows that are dead centres."""
    rows = range(motion.first, motion.last + 1)
    status = motion.status
    return [float(motion.degrees[row]) for row in rows if status[row] in DEAD]


def dead_centres(motion: Motion) -> list[float]:
    """The degrees of all dead centres, those between rows too (a jump of friction is none)."""
    x = motion.degrees[motion.first : motion.last + 1].tolist()
    places = set(dead_rows(motion))
    if rubs(motion.found.case):
        return sorted(places)
    for name in motion.found.answers:
        places |= set(asymptotes(x, _rows(motion, motion.found.answers[name]), sorted(places)))
    return sorted(places)


def _rows(motion: Motion, column: Array) -> list[float]:
    return [float(v) for v in column[motion.first : motion.last + 1]]


def _answers(known: Known, motion: Motion, dead: Sequence[float]) -> list[list[Curve]]:
    """The curves of the unknown loads, those of one unit together."""
    units = {load.name: unit_of(load, known.case) for load in known.case.loads}
    curves = []
    for name, column in motion.found.answers.items():
        if name in motion.found.holds:
            low, high = motion.found.holds[name].T
            curves.append(Curve(f"{name}, least", _rows(motion, low), units[name]))
            curves.append(Curve(f"{name}, most", _rows(motion, high), units[name]))
        else:
            curves.append(Curve(name, _rows(motion, column), units[name], tuple(dead)))
    kinds = dict.fromkeys(curve.unit for curve in curves)
    return [[c for c in curves if c.unit == unit][:MOST] for unit in kinds]


def _advantage(known: Known, motion: Motion, dead: Sequence[float]) -> list[Curve]:
    """The unknown load over each known one: what a unit of it asks."""
    if len(motion.found.answers) != 1:
        return []
    (name,) = motion.found.answers
    units = {load.name: unit_of(load, known.case) for load in known.case.loads}
    curves = []
    for other, share in motion.shares.items():
        unit = "" if units[name] == units[other] else f"{units[name]} per {units[other]}"
        curves.append(Curve(f"{name}/{other}", _rows(motion, -share), unit, tuple(dead)))
    same = [curve for curve in curves if curve.unit == curves[0].unit]
    return same[:MOST]


def _rates(known: Known, motion: Motion) -> list[Curve]:
    rates = motion.found.rates
    with np.errstate(all="ignore"):
        return [
            Curve(f"w{link}/w{motion.driver}", _rows(motion, rates[link] / rates[motion.driver]), "")
            for link in known.case.links
            if link in rates and link not in (known.case.ground, motion.driver) and np.any(rates[link])
        ][:MOST]


def _plot(heading: str, x: Sequence[float], curves: Sequence[Curve], axis: str) -> Plot:
    frame, marks = plot_marks(x, curves, axis, (0.0, 0.0), SIZE)
    left, top, right, bottom = bounds(marks)
    view = (left - 8.0, top - 8.0, right + 8.0, bottom + 8.0)
    return Plot(heading, tuple(marks), view, frame, tuple(curves))


def plot_data(plot: Plot) -> dict[str, Any]:
    """What the script of the page needs to place a cursor."""
    frame = plot.frame
    return {
        "box": [round(v, 2) for v in (frame.left, frame.top, frame.right, frame.bottom)],
        "x": list(frame.x),
        "dots": [{"x": {"v": []}, "y": _heights(frame, curve)} for curve in plot.curves],
    }


def _heights(frame: Frame, curve: Curve) -> dict[str, Any]:
    """Where the cursor's dot is on a curve, picture units; beyond the frame it is not shown."""
    low, high = frame.y
    values = np.array(curve.values, float)
    up = (values - low) / (high - low)
    height = np.where((up >= 0.0) & (up <= 1.0), frame.bottom - up * (frame.bottom - frame.top), np.nan)
    return compact(height, FINE["px"])
