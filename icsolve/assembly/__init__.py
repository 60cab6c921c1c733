"""The figure: lengths, angles, guides and coordinates of a case become points in one position.

`solve_figure` constructs the points that are wanted and settles the branches; `place` runs the same
construction again with another arithmetic (arrays, numbers on a tape, more digits).
"""

from __future__ import annotations

from icsolve.assembly.figure import placed_figure, solve_figure
from icsolve.assembly.steps import Figure, Placement, place
from icsolve.assembly.workspace import Frame, Key, Point, case_point

__all__ = [
    "Figure",
    "Frame",
    "Key",
    "Placement",
    "Point",
    "case_point",
    "place",
    "placed_figure",
    "solve_figure",
]
