"""The drawing that is asked for: which steps and panels, what stands above and below them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from icsolve.case import Case
from icsolve.construction import Known, Step, all_steps, known_of, needed_steps
from icsolve.draw.captions import captioned, description
from icsolve.draw.figure import figure_marks, scene_of
from icsolve.draw.marks import Mark, bounds
from icsolve.draw.scene import Scene
from icsolve.draw.svg import document

PAD = 14.0


class Drawing(NamedTuple):
    """What to draw beside the mechanism and its loads.

    ``centres`` is ``needed``, ``all`` or ``none``; ``step`` cuts the construction after so many
    centres found; ``circle`` adds the Kennedy circle, ``velocities`` the velocities of the points,
    ``bodies`` the free-body diagrams of all links. Without ``captions`` title and answer are left to the
    page around it.
    """

    centres: str = "needed"
    step: int | None = None
    circle: bool = False
    velocities: bool = False
    bodies: bool = False
    captions: bool = True


PLAIN = Drawing()


def draw(case: Case, drawing: Drawing = PLAIN, known: Known | None = None) -> str:
    """The drawing of a case as an SVG document, the same bytes every time.

    A case that has no answer is drawn as far as it is known, with the reason below.
    """
    known = known or known_of(case, reactions=drawing.bodies)
    marks, steps = _in_space(known, drawing) if case.space is not None else _in_plane(known, drawing)
    if drawing.captions or not marks:
        marks = captioned(known, marks, steps, drawing.step)
    left, top, right, bottom = bounds(marks)
    view = (left - PAD, top - PAD, right + PAD, bottom + PAD)
    return document(marks, view, known.title, description(known))


def _in_space(known: Known, drawing: Drawing) -> tuple[list[Mark], tuple[Step, ...]]:
    """The figure of a case in space, which has no centres."""
    from icsolve.draw.space import space_marks

    sketch, marks = space_marks(known)
    if drawing.bodies:
        from icsolve.draw.space_bodies import space_panels

        left, _, right, bottom = bounds(marks)
        marks += space_panels(known, sketch, left, bottom + 30.0, max(right - left, 760.0))
    return marks, ()


def _in_plane(known: Known, drawing: Drawing) -> tuple[list[Mark], tuple[Step, ...]]:
    """Figure, circle and free bodies of a case in the plane."""
    steps = steps_shown(known, drawing)
    scene = scene_of(known, steps)
    marks = figure_marks(scene, steps, velocities=drawing.velocities)
    marks += _beside(scene, steps, drawing, marks)
    marks += _under(scene, drawing, marks)
    return marks, steps


def steps_shown(known: Known, drawing: Drawing) -> tuple[Step, ...]:
    """The centres to draw, in order."""
    if drawing.centres == "none" or known.whole is None or known.case.space is not None:
        return ()
    steps = all_steps(known) if drawing.centres == "all" else needed_steps(known)
    return tuple(s for s in steps if drawing.step is None or s.number <= drawing.step)


def _beside(scene: Scene, steps: Sequence[Step], drawing: Drawing, marks: Sequence[Mark]) -> list[Mark]:
    """The circle diagram, at the right of the figure."""
    if not drawing.circle or not steps:
        return []
    from icsolve.draw.circle import circle_marks

    _, top, right, _ = bounds(marks)
    return circle_marks(scene.known, steps, (right + 34.0, top), drawing.step)


def _under(scene: Scene, drawing: Drawing, marks: Sequence[Mark]) -> list[Mark]:
    """The scale of the velocities, and the free bodies, below the figure."""
    found: list[Mark] = []
    left, _, right, bottom = bounds(marks)
    if drawing.velocities:
        from icsolve.draw.velocities import legend

        scale = legend(scene, (left + 6.0, bottom + 20.0))
        found += [scale] if scale is not None else []
        bottom = max(bottom, bounds(found)[3]) if found else bottom
    if drawing.bodies:
        from icsolve.draw.bodies import body_panels

        found += body_panels(scene, left, bottom + 30.0, max(right - left, 760.0))
    return found
