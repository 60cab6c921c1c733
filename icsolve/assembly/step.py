"""Every kind of step of a construction.

Each puts points on a board (``place``), and tells its ``targets``, what it ``needs``, its ``data`` and its
``name``, a sentence.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

from icsolve.assembly.board import Key
from icsolve.assembly.given import Given
from icsolve.assembly.heading import Apart
from icsolve.assembly.loci import headings_of
from icsolve.assembly.shapes import Base, Transfer, Turned
from icsolve.assembly.steps import Mean, Meet, Polar

if TYPE_CHECKING:
    from icsolve.assembly.group import Group

Step = Union[Given, Mean, Polar, Meet, Base, Transfer, Turned, "Group"]
CLOSED_FORMS = (Given, Mean, Polar, Base, Transfer, Turned)
"""Steps that have one way only."""


def aims(step: Step) -> list[tuple[Key, Key]]:
    """The pairs of points whose direction a step goes by."""
    if isinstance(step, Transfer):
        return [step.pose, step.shape[:2]]
    pairs = [step.shape[:2]] if isinstance(step, Turned) else []
    headings = [step.heading] if isinstance(step, Polar | Turned) else []
    for locus in (step.first, step.second) if isinstance(step, Meet) else ():
        headings += headings_of(locus)
    return pairs + [(h.root.a, h.root.b) for h in headings if isinstance(h.root, Apart)]
