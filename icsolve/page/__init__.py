"""A case as one HTML file: its figure through the whole range of its input, the construction of its centres a
step at a time, the equation of power with live numbers, and the answer as a curve. Nothing is loaded."""

from __future__ import annotations

from icsolve.case import Case
from icsolve.draw.marks import kinds_of
from icsolve.draw.svg import sheet
from icsolve.explain.solution import solution
from icsolve.page.document import PageParts, equation_of, html_of
from icsolve.page.live import live_of
from icsolve.page.model import model_of
from icsolve.page.motion import motion_of, why_still
from icsolve.page.pictures import (
    ALWAYS,
    circle_svg,
    figure_of,
    figure_svg,
    plot_data,
    plot_svg,
    plots_of,
    still_svg,
)
from icsolve.report.derivation.known import Known, known_of
from icsolve.report.derivation.ratios import needed_steps

DIGITS = 6
"""Significant digits of the worked solution."""


def page_html(case: Case | Known) -> str:
    """The page of a case, the same bytes every time; one without an answer, or that cannot move, says why.

    What is `Known` of the case may be given in its place, best with reactions: the worked solution in the
    page then has its check by free bodies.
    """
    known = case if isinstance(case, Known) else known_of(case, reactions=True)
    return html_of(_in_space(known) if known.case.space is not None else _in_plane(known))


def _in_space(known: Known) -> PageParts:
    picture, marks = still_svg(known)
    model = {"window": [0, 0, 1, 1], "steps": 0, "centres": [], "loads": {}, "anchors": {}, "answers": []}
    rules = sheet(kinds_of(marks))
    return PageParts(
        known, (), picture, "", (), None, solution(known, DIGITS), why_still(known), model, rules
    )


def _in_plane(known: Known) -> PageParts:
    from icsolve.page.motion import forces_data

    steps = needed_steps(known) if known.whole is not None else ()
    motion = motion_of(known, [step.centre.pair for step in steps])
    figure = figure_of(known, steps, motion)
    plots = [] if motion is None else plots_of(known, motion)
    equation = equation_of(known, motion)
    live = live_of(known)
    model = model_of(known, steps, figure, motion, live)
    model["forces"] = {} if live is not None else forces_data(figure.scene, motion)
    model["terms"] = None if equation is None else equation.data
    model["root"] = None if equation is None else {"sign": equation.sign, "gain": equation.gain}
    model["plots"] = [plot_data(plot) for plot in plots]
    circle, chords = circle_svg(known, steps) if steps else ("", ())
    used = kinds_of((*figure.marks, *chords, *(mark for plot in plots for mark in plot.marks)))
    still = why_still(known) if motion is None and known.answer is not None else ""
    drawn = tuple((plot.heading, plot_svg(plot, n)) for n, plot in enumerate(plots))
    return PageParts(
        known,
        steps,
        figure_svg(known, figure),
        circle,
        drawn,
        equation,
        solution(known, DIGITS),
        still,
        model,
        sheet(used | ALWAYS),
        live,
    )


__all__ = ["page_html"]
