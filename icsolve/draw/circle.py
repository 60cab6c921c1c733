"""Kennedy's circle: the links on a circle, a chord for every centre that is known, dashed and numbered in the
order of finding. A centre can be found where its chord closes two triangles."""

from __future__ import annotations

import math
from collections.abc import Sequence

import shapely

from icsolve.case import Pair
from icsolve.case.names import link_order, pair_name
from icsolve.construction import Known, Step
from icsolve.draw.figure import with_labels
from icsolve.draw.marks import Area, Box, Disc, Group, Mark, Point, Run, Stroke, Text, text_width
from icsolve.draw.place import Label, Soft
from icsolve.draw.scene import Part, around

ALONG = (0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68, 0.26, 0.74, 0.2, 0.8)
"""Where on its chord a number may stand."""
SIZE = 11.5
"""Font size of the link names and of the order."""


def circle_marks(
    known: Known, steps: Sequence[Step], at: Point, lit: int | None = None, *, each: bool = False
) -> list[Mark]:
    """The diagram with its upper left corner at a point; ``lit`` is the step whose triangles are filled, with
    ``each`` they are there for every step, in groups."""
    steps = [*_inspected(known, steps), *steps]
    links = sorted(known.case.links, key=lambda link: link_order(known.case, link))
    reach = max(text_width(link, SIZE) / 2.0 + 5.0 for link in links)
    node = max(11.0, reach)
    radius = max(28.0 + 14.0 * len(links), node * 2.6 * len(links) / (2.0 * math.pi))
    centre = (at[0] + radius + node, at[1] + radius + node + 22.0)
    places = _places(links, centre, radius)
    chords = Part(tuple(mark for step in steps for mark in _chord(known, places, step)))
    now = [step for step in steps if step.number and (each or step.number == lit)]
    triangles = [mark for step in now for mark in _triangles(places, step)]
    if each:
        triangles = [_of_step(f"closed-{s.number}", s, _triangles(places, s)) for s in now]
    numbers = Part(
        soft=tuple(Soft(shapely.LineString([places[a], places[b]]), 0.5) for a, b in _pairs(steps)),
        solid=tuple(around(p, node) for p in places.values()),
        labels=tuple(_order(places, step) for step in steps if step.number),
    )
    title = Text((centre[0], at[1] + 6.0), (Run("Kennedy circle"),), "t-note", 12.0)
    window: Box = (at[0], at[1], at[0] + 2.0 * (radius + node), at[1] + 2.0 * (radius + node) + 22.0)
    nodes = [mark for link, p in places.items() for mark in _node(link, p, node)]
    marks = [title, *triangles, *with_labels(chords, window), *nodes, *with_labels(numbers, window)]
    return [Group("circle", "", tuple(marks), "Kennedy circle diagram")]


def _inspected(known: Known, steps: Sequence[Step]) -> list[Step]:
    """The centres by inspection that no step needs: the diagram starts from all of them."""
    centres = () if known.whole is None else known.whole.centres.values()
    needed = {step.centre.pair for step in steps}
    return [Step(0, c) for c in centres if c.by in ("inspection", "given") and c.pair not in needed]


def _places(links: Sequence[str], centre: Point, radius: float) -> dict[str, Point]:
    angles = (2.0 * math.pi * n / len(links) for n in range(len(links)))
    return {
        link: (centre[0] + radius * math.sin(a), centre[1] - radius * math.cos(a))
        for link, a in zip(links, angles, strict=True)
    }


def _pairs(steps: Sequence[Step]) -> list[Pair]:
    return [step.centre.pair for step in steps]


def _chord(known: Known, places: dict[str, Point], step: Step) -> list[Mark]:
    a, b = step.centre.pair
    kind = "edge-found" if step.number else "edge-known"
    name = pair_name(known.case, step.centre.pair)
    found = f", found as number {step.number}" if step.number else ", by inspection"
    data = (("data-step", str(step.number)),)
    return [Group(f"chord-{name}", "", (Stroke((places[a], places[b]), kind),), f"I{name}{found}", data)]


def _triangles(places: dict[str, Point], step: Step) -> list[Mark]:
    """The two triangles that a found chord closes."""
    marks: list[Mark] = []
    for line in step.centre.lines:
        corners = sorted({link for pair in (*line, step.centre.pair) for link in pair})
        if len(corners) == 3:
            marks.append(Area((tuple(places[link] for link in corners),), "lit"))
    return marks


def _of_step(name: str, step: Step, marks: Sequence[Mark]) -> Group:
    return Group(name, "", tuple(marks), "", (("data-step", str(step.number)),))


def _order(places: dict[str, Point], step: Step) -> Label:
    """The number of a found chord, near its middle."""
    a, b = (places[link] for link in step.centre.pair)
    anchors = tuple((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) for t in ALONG)
    return Label(f"order-{step.number}", (Run(str(step.number)),), "t-centre", SIZE, anchors, 1.0, True, True)


def _node(link: str, p: Point, reach: float) -> list[Mark]:
    return [Disc(p, reach, "node"), Text(p, (Run(link),), "t-link", SIZE)]
