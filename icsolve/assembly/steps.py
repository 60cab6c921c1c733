"""The steps of a construction: given points, a centroid, a length along a direction, two loci, rigid shapes.

Each puts points on a workspace (``place``), its ``targets``, and is made of others and of data: its fields.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import FigureEquation, InLine, Unknown
from icsolve.assembly.loci import (
    Intersection,
    LineLocus,
    Locus,
    PlacedLine,
    PlacedLocus,
    directions_of,
    gaps_of,
    intersection,
    is_ray,
    is_round,
)
from icsolve.assembly.workspace import (
    Apart,
    Datum,
    Frame,
    Key,
    LineDirection,
    Span,
    Workspace,
    data_in,
    data_of,
    keys_in,
)
from icsolve.case import Case
from icsolve.numbers import FLOATS, Arithmetic, Scalar, magnitude
from icsolve.screws import Point
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.numbers import linear
else:
    linear = LateModule("icsolve.numbers.linear")


class Given(NamedTuple):
    """Points whose coordinates the case gives."""

    targets: tuple[Key, ...]

    def place(self, workspace: Workspace) -> None:
        """Put the points."""
        for key in self.targets:
            workspace.points[key] = workspace.coordinates(key if isinstance(key, str) else key[1])


# --- the steps that place one point from others: a centroid, a length along a direction, two loci ---


class Mean(NamedTuple):
    """A centroid, or the one point that a known centroid leaves open.

    ``target`` = (``whole`` * centroid - the sum of ``others``) / ``parts`` where the centroid is
    known; the mean of ``others`` where it is not.
    """

    target: Key
    datum: Datum
    others: tuple[Key, ...]
    centroid: Key | None = None
    parts: int = 1

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    def place(self, workspace: Workspace) -> None:
        """Put the point."""
        points = workspace.points
        x, y = 0.0, 0.0
        for key in self.others:
            px, py = points[key]
            x, y = x + px, y + py
        if self.centroid is None:
            n = float(len(self.others))
            workspace.points[self.target] = (x / n, y / n)
        else:
            n, k = float(len(self.others) + self.parts), float(self.parts)
            gx, gy = points[self.centroid]
            workspace.points[self.target] = ((n * gx - x) / k, (n * gy - y) / k)


class Polar(NamedTuple):
    """A point at a known distance in a known direction."""

    target: Key
    base: Key
    span: Span
    direction: LineDirection

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    def place(self, workspace: Workspace) -> None:
        """Put the point."""
        x, y = workspace.points[self.base]
        length = workspace.length(self.span)
        c, s = workspace.unit(self.direction)
        workspace.points[self.target] = (x + length * c, y + length * s)


class Meet(NamedTuple):
    """A point where two loci meet; a line is the first of them if there is one.

    ``sign`` +1 or -1 takes the first or the second of two places; 0 the one place (two lines, or a
    circle that touches). ``apart`` is the datum, if there is one, by which the centres of two circles lie
    apart: the triangle then moves as a whole, and is as flat everywhere as in one position.
    """

    target: Key
    first: Locus
    second: Locus
    sign: int = 1
    apart: Span | None = None

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def touches(self) -> bool:
        """Whether it is the one place where a circle only touches: beside it there are two."""
        return self.sign == 0 and is_round(self.second)

    @property
    def stays_flat(self) -> bool:
        """Whether it touches wherever its circles are."""
        return self.touches and self.apart is not None

    def loci(self, workspace: Workspace) -> tuple[PlacedLocus, PlacedLocus]:
        """Both loci where their points are."""
        return self.first.placed(workspace), self.second.placed(workspace)

    def crossing(self, workspace: Workspace) -> Intersection:
        """Where the loci meet."""
        apart = None if self.apart is None else workspace.length(self.apart)
        return intersection(*self.loci(workspace), apart)

    def gaps(self, workspace: Workspace, *loci: PlacedLocus) -> tuple[Scalar, ...]:
        """By how much the loci meet, as `gaps_of` has it; these are given where they are placed already."""
        one, two = loci or self.loci(workspace)
        apart = None if self.apart is None else workspace.length(self.apart)
        return gaps_of(one, two, workspace.arithmetic, apart)

    def ahead(self, workspace: Workspace) -> list[float]:
        """How far ahead on each ray among the loci the point lies."""
        x, y = workspace.points[self.target]
        out = []
        for locus in (self.first, self.second):
            if is_ray(locus):
                line = locus.placed(workspace)
                assert isinstance(line, PlacedLine)
                (px, py), (vx, vy) = line
                out.append((x - px) * vx + (y - py) * vy)
        return out

    def place(self, workspace: Workspace) -> None:
        """Put the point that ``sign`` takes."""
        found = self.crossing(workspace)
        if found.factors is None or self.sign == 0:
            workspace.points[self.target] = found.middle
        else:
            root = workspace.arithmetic.sqrt(found.factors[0][0] * found.factors[1][0])
            workspace.points[self.target] = found.at(root if self.sign > 0 else -root)

    def margins(self, workspace: Workspace) -> tuple[Scalar, ...]:
        """What must not be negative for it to assemble [frame]: gaps of circles, distances along rays."""
        gaps = self.gaps(workspace)[:3] if is_round(self.second) and not self.stays_flat else ()
        return (*gaps, *self.ahead(workspace))


# --- shapes that move as a whole: how one begins on a cluster of its own, and how it carries its points ---


class Base(NamedTuple):
    """The first two points of a link's own cluster: one at its origin, the other along its x."""

    a: Key
    b: Key
    span: Span

    @property
    def targets(self) -> tuple[Key, ...]:
        """Both points."""
        return (self.a, self.b)

    def place(self, workspace: Workspace) -> None:
        """Put both points."""
        workspace.points[self.a] = (0.0, 0.0)
        workspace.points[self.b] = (workspace.length(self.span), 0.0)


class Turned(NamedTuple):
    """A point of a shape that one point in place and a known direction in it hold, perhaps toward another.

    ``direction`` is the direction of the shape's pair ``shape[:2]``; ``shape[2:]`` are the point in place
    and the one to place, on the shape's own cluster.
    """

    target: Key
    base: Key
    direction: LineDirection
    shape: tuple[Key, Key, Key, Key]

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    def place(self, workspace: Workspace) -> None:
        """Put the point: the shape turned until its pair lies in the known direction."""
        (px, py), (ux, uy) = workspace.points[self.base], workspace.unit(self.direction)
        (ax, ay), (bx, by), (qx, qy), (tx, ty) = (workspace.points[key] for key in self.shape)
        ex, ey, dx, dy = bx - ax, by - ay, tx - qx, ty - qy
        norm = workspace.arithmetic.sqrt(ex * ex + ey * ey)
        c, s = (ux * ex + uy * ey) / norm, (uy * ex - ux * ey) / norm
        workspace.points[self.target] = (px + c * dx - s * dy, py + s * dx + c * dy)


# --- points that only all their data together determine ---


class NewtonStep(NamedTuple):
    """A step of Newton's method.

    Attributes
    ----------
    move : (n,), what is to be subtracted from the coordinates; 0 of those that the equations leave open
    flatness : the smallest pivot over the largest; 0.0 where the equations are dependent
    """

    move: list[Scalar]
    flatness: float


def newton_step(values: Sequence[Scalar], rows: Sequence[linear.Row]) -> NewtonStep:
    """The step of Newton's method for n equations with these values, and derivatives by column."""
    n = len(rows)
    found = linear.eliminate([{**row, n: 0.0 - f} for row, f in zip(rows, values, strict=True)], n)
    sizes = [magnitude(pivot) for pivot in found.pivots]
    flatness = 0.0 if found.free else min(sizes) / max(sizes)
    return NewtonStep([found.of(k).get(n, 0.0) for k in range(n)], flatness)


class PointGroup(NamedTuple):
    """Points placed by Newton's method, as many equations as coordinates.

    ``start`` has the places (x, y) of the targets [frame] in the solution that was settled on. ``place``
    takes a step from there, or from where the workspace says, which carries the derivatives by all data; as
    many as the arithmetic has ``rounds`` where that has more digits.
    """

    targets: tuple[str, ...]
    equations: tuple[FigureEquation | InLine, ...]
    start: tuple[tuple[float, float], ...] = ()

    def place(self, workspace: Workspace) -> None:
        """Put the points, and improve them; in balls the one solution there is enclosed."""
        if getattr(workspace.arithmetic, "certain", False):
            self._enclose(workspace)
            return
        for target, at in zip(self.targets, self.start, strict=True):
            workspace.points[target] = workspace.starts.get(target, at)
        for _ in range(getattr(workspace.arithmetic, "rounds", 1)):
            move = newton_step(*self.system(workspace)).move
            x = (part for target in self.targets for part in workspace.points[target])
            self.put(workspace, [a - b for a, b in zip(x, move, strict=True)])

    def _enclose(self, workspace: Workspace) -> None:
        """Balls that hold the one solution near the start. Raises BelowZero where all digits show none."""
        from icsolve.numbers.balls import Balls, BelowZero, MoreDigits
        from icsolve.numbers.krawczyk import enclosed_root, turns_away

        assert isinstance(workspace.arithmetic, Balls)

        def system(x: Sequence[Scalar]) -> tuple[list[Scalar], list[linear.Row]]:
            self.put(workspace, x)
            return self.system(workspace)

        start = [float(part) for at in self.start for part in at]
        try:
            found = enclosed_root(system, start, workspace.arithmetic)
        except MoreDigits:
            if workspace.arithmetic.highest and turns_away(system, start, workspace.arithmetic):
                raise BelowZero from None
            raise
        self.put(workspace, found)

    def put(self, workspace: Workspace, x: Sequence[Scalar]) -> None:
        """Put the points at coordinates, (n,), those of a point together."""
        for k, target in enumerate(self.targets):
            workspace.points[target] = (x[2 * k], x[2 * k + 1])

    def system(self, workspace: Workspace) -> tuple[list[Scalar], list[linear.Row]]:
        """Values of the equations where the points are, and derivatives by the place of a coordinate."""
        place = {unknown: k for k, unknown in enumerate(self.unknowns())}
        rows = [equation.row(workspace) for equation in self.equations]
        return [row.value for row in rows], [
            {place[u]: v for u, v in row.by.items() if u in place} for row in rows
        ]

    def unknowns(self) -> list[Unknown]:
        """The coordinates that it solves for."""
        return [(target, part) for target in self.targets for part in (0, 1)]


# --- every kind of step of a construction ---


Step = Given | Mean | Polar | Meet | Base | Turned | PointGroup
CLOSED_FORMS = (Given, Mean, Polar, Base, Turned)
"""Steps that have one way only."""


def needs(step: Step) -> tuple[Key, ...]:
    """The points that a step comes from; of a group those that its data bind to it."""
    alone = isinstance(step, (Meet, *CLOSED_FORMS))
    keys = keys_in(step) if alone else dict.fromkeys(p for datum in data_in(step) for p in datum.points)
    return tuple(key for key in keys if key not in step.targets)


def aims(step: Step) -> list[tuple[Key, Key]]:
    """The pairs of points whose direction a step goes by."""
    pairs = [step.shape[:2]] if isinstance(step, Turned) else []
    directions = [step.direction] if isinstance(step, (Polar, Turned)) else []
    for locus in (step.first, step.second) if isinstance(step, Meet) else ():
        directions += directions_of(locus)
    return pairs + [(h.root.a, h.root.b) for h in directions if isinstance(h.root, Apart)]


def sensed(step: Step) -> set[tuple[Datum, frozenset[str]]]:
    """The data by which a step turns from one point to another and not the opposite way, with both points."""
    if isinstance(step, Polar):
        pairs = [(step.direction, (step.base, step.target))]
    elif isinstance(step, Turned):
        pairs = [(step.direction, step.shape[:2])]
    else:
        loci = (step.first, step.second) if isinstance(step, Meet) else ()
        rays = [locus for locus in loci if isinstance(locus, LineLocus) and locus.ray]
        pairs = [(ray.direction, (ray.through, step.targets[0])) for ray in rays]
    names = [(way, frozenset(key if isinstance(key, str) else key[1] for key in ends)) for way, ends in pairs]
    return {(datum, ends) for way, ends in names for datum in data_in(way)}


# --- which steps lead to which points ---


def leading_to(goal: Collection[Key], steps: Sequence[Step]) -> tuple[Step, ...]:
    """Only the steps that lead to some points."""
    needed: set[Key] = set(goal)
    kept: list[Step] = []
    for step in reversed(steps):
        targets = tuple(key for key in step.targets if key in needed)
        if targets:
            needed.update(needs(step))
            kept.append(Given(targets) if isinstance(step, Given) else step)
    return tuple(reversed(kept))


def points_of(steps: Sequence[Step]) -> tuple[str, ...]:
    """The points that steps place on the ground."""
    return tuple(key for step in steps for key in step.targets if isinstance(key, str))


class Figure(NamedTuple):
    """The points of one position, and the construction that found them.

    Attributes
    ----------
    frame : scale and origin, to bring points back to case lengths (`case_point`)
    points : by name, (x, y) [frame of size 1]
    steps : ran in this order, with the branches that they settled on
    notes : sentences for the reader
    skipped : points that nothing asked for
    """

    frame: Frame
    points: dict[str, Point]
    steps: tuple[Step, ...]
    notes: tuple[str, ...] = ()
    skipped: tuple[str, ...] = ()


def spare_data(figure: Figure, case: Case) -> list[Datum]:
    """The data of a figure's points that its construction does not need: they are compared with it."""
    used = {datum for step in figure.steps for datum in data_in(step)}
    return [d for d in data_of(case) if d not in used and figure.points.keys() >= {*d.points}]


class Miss(NamedTuple):
    """A way in which the figure does not assemble.

    ``amount`` is how far off (normalised); ``loci`` the pair that turned out to be one locus;
    ``vague`` where an earlier miss says more.
    """

    status: str
    message: str
    amount: float = math.inf
    loci: frozenset[object] | None = None
    vague: bool = False


class Placement(NamedTuple):
    """Points of the same construction in another arithmetic.

    Attributes
    ----------
    points : by name [frame of size 1]
    steps, workspace : the construction, and where it ran
    """

    points: dict[str, Point]
    steps: tuple[Step, ...]
    workspace: Workspace

    @property
    def margins(self) -> dict[Key, tuple[Scalar, ...]]:
        """For each point where two loci meet its `Meet.margins`: callers with arrays test them."""
        return {step.target: step.margins(self.workspace) for step in self.steps if isinstance(step, Meet)}


def place(figure: Figure, case: Case, arithmetic: Arithmetic = FLOATS) -> Placement:
    """Run a figure's construction again, on the numbers of a case of the same shape.

    The same steps with the same branches, without a test on any value: what does not assemble has a negative
    margin, and places that mean nothing.

    Parameters
    ----------
    figure : as of `icsolve.assembly.solve_figure`
    case : of the same shape, perhaps with other numbers
    arithmetic : in which the points come
    """
    workspace = Workspace(case, figure.frame, arithmetic)
    for step in figure.steps:
        step.place(workspace)
    points = {p: at for p, at in workspace.points.items() if isinstance(p, str)}
    return Placement(points, figure.steps, workspace)
