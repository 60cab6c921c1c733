"""How far the points are from the data: residuals, redundant data, teeth that do not fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import CONDITIONS
from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, number_of
from icsolve.assembly.refusals import Miss, clash, measure
from icsolve.assembly.steps import Given, leading_to
from icsolve.assembly.words import datum_words, joined
from icsolve.assembly.workspace import Workspace
from icsolve.case import Case, Coordinates, Number
from icsolve.case.joints import Mesh
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Floats, Scalar, turn_of
from icsolve.screws.joints import Points
from icsolve.structure.topology import Bond, Topology
from icsolve.wording.sentences import listed

if TYPE_CHECKING:
    from icsolve.assembly.steps import Step


TOO_CLOSE = 1e-12
"""Points nearer than this (normalised) have no direction to one another."""


Residual = tuple[float, bool]
"""A signed distance (normalised), and False where a ray points the other way."""
Scale = tuple[float, bool | None]
"""What the condition of a datum is divided by to be a distance, and whether its ray points ahead; None where
points that are one have no direction, with how far the others are."""


ROUNDING = 1e-10
"""Residual, over the figure's size, that is rounding in the sums and not in the data."""


def size_of(workspace: Workspace, points: Collection[str]) -> float:
    """The greater side of the box about the points, normalised."""
    at = [workspace.points[p] for p in points]
    if not at:
        return 0.0
    xs, ys = [p[0] for p in at], [p[1] for p in at]
    return float(max(max(xs) - min(xs), max(ys) - min(ys)))


def agrees(workspace: Workspace, data: Collection[Datum], size: float) -> bool:
    """Whether the points meet data exactly, but for rounding."""
    return all(ahead and abs(off) <= ROUNDING * size for off, ahead in (residual(workspace, d) for d in data))


def residual(workspace: Workspace, datum: Datum) -> Residual:
    """How far the points on a workspace are from a datum: a signed distance [frame], of an angle its error on
    the longer arm; and False where a ray points the other way, or has no direction.
    """
    if datum.kind == MEAN:
        offs = (CONDITIONS[MEAN](workspace, datum, part).value for part in (0, 1))
        return max(offs, key=abs) / float(len(datum.points) - 1), True
    size, ahead = DISTANCES.get(datum.kind, _as_it_is)(workspace, datum)
    if ahead is None:
        return size, False
    return float(CONDITIONS[datum.kind](workspace, datum, 0).value) / (size or 1.0), ahead


def _as_it_is(workspace: Workspace, datum: Datum) -> Scale:
    return 1.0, True


def _length(workspace: Workspace, datum: Datum) -> Scale:
    """(d^2 - l^2) / 2 is d - l times their mean."""
    return (math.dist(*(workspace.points[p] for p in datum.points)) + workspace.length(datum)) / 2.0, True


def ahead(workspace: Workspace, datum: Datum) -> Scalar:
    """How far a ray, or the far arm of a corner, goes the way of its angle: negative where it points against
    it [frame, of a corner frame squared]."""
    (ax, ay), *vertex, (bx, by) = (workspace.points[p] for p in datum.points)
    c, s = workspace.turn(datum)
    if not vertex:
        return c * (bx - ax) + s * (by - ay)
    ((vx, vy),) = vertex
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    return (c * px - s * py) * qx + (s * px + c * py) * qy


def _ray(workspace: Workspace, datum: Datum) -> Scale:
    apart = math.dist(*(workspace.points[p] for p in datum.points))
    return 1.0, bool(ahead(workspace, datum) > TOO_CLOSE or apart <= TOO_CLOSE)


def _corner(workspace: Workspace, datum: Datum) -> Scale:
    """The angle's error, on the longer arm."""
    a, vertex, b = (workspace.points[p] for p in datum.points)
    p, q = math.dist(a, vertex), math.dist(b, vertex)
    if min(p, q) <= TOO_CLOSE:
        return max(p, q), None
    return min(p, q), bool(ahead(workspace, datum) > 0.0)


def _line(workspace: Workspace, datum: Datum) -> Scale:
    size = math.dist(*(workspace.points[p] for p in datum.points[2:]))
    return size, True if size > TOO_CLOSE else None


DISTANCES: dict[str, Callable[[Workspace, Datum], Scale]] = {
    LENGTH: _length, RAY: _ray, CORNER: _corner, LINE: _line,
}  # fmt: skip


# --- data that the construction did not need: compared with the figure, and said so ---


OF_SIZE = 0.002
MOST_WORK = 50_000
"""Steps that the propagation of half units may run again; beyond, only the size decides."""


class Nudged(Floats):
    """Floats with one number moved by half a unit of its last decimal."""

    def __init__(self, path: str) -> None:
        self.path = path

    def _value(self, number: Number) -> float:
        return number.value + number.half if number.path == self.path else number.value

    def given(self, number: Number) -> float:
        """The number, moved if it is the one."""
        return self._value(number)

    def turn(self, number: Number) -> tuple[float, float]:
        """Cosine and sine, moved if it is the one."""
        return turn_of(self._value(number))


def compare(
    workspace: Workspace, steps: tuple[Step, ...], data: list[Datum], size: float
) -> tuple[Miss | None, dict[Datum, float]]:
    """The first datum that the points contradict, and how far off each of the others is."""
    offs: dict[Datum, float] = {}
    for datum in data:
        off, ahead = residual(workspace, datum)
        if not ahead:
            return clash(workspace, datum, off, ahead), offs
        offs[datum] = abs(off)
        if abs(off) <= ROUNDING * size:
            continue
        if abs(off) > OF_SIZE * size or abs(off) > _allowance(workspace, steps, datum, off, OF_SIZE * size):
            return clash(workspace, datum, off, ahead), offs
    return None, offs


def _allowance(
    workspace: Workspace, steps: tuple[Step, ...], datum: Datum, off: float, limit: float
) -> float:
    """Sum over the numbers involved of what half a unit of each does to the residual."""
    cone = leading_to(datum.points, steps)
    numbers = _numbers(workspace, cone, datum)
    if len(numbers) * len(cone) > MOST_WORK:
        return limit
    total = 0.0
    for number in numbers:
        moved = Workspace(workspace.case, workspace.frame, Nudged(number.path))
        try:
            for step in cone:
                step.place(moved)
            total += abs(residual(moved, datum)[0] - off)
        except ZeroDivisionError:
            return limit
    return total


def _numbers(workspace: Workspace, cone: tuple[Step, ...], datum: Datum) -> list[Number]:
    """The distinct numbers that a datum and its points come from."""
    case = workspace.case
    numbers: dict[str, Number] = {}
    for each in (datum, *(d for step in cone for d in step.data())):
        if each.kind not in (MEAN, LINE):
            number = number_of(case, each)
            numbers[number.path] = number
    for step in cone:
        for key in step.targets if isinstance(step, Given) else ():
            place = case.points[str(key)]
            if isinstance(place, Coordinates):
                numbers.update((n.path, n) for n in (place.x, place.y) if n is not None)
    return list(numbers.values())


def notes_of(
    workspace: Workspace, offs: Mapping[Datum, float], used: frozenset[Datum], given: bool, size: float
) -> tuple[str, ...]:
    """Which data set the points and which were only compared, where there were more than needed."""
    spare = {
        datum: off
        for datum, off in offs.items()
        if datum not in used and (off > ROUNDING * size or datum.kind not in (GUIDE, LINE))
    }
    if not spare:
        return ()
    setters = ["the coordinates"] if given else []
    for kinds, one, many in (((LENGTH,), "length", "lengths"), ((RAY, CORNER), "angle", "angles")):
        names = sorted(joined(*d.points) for d in used if d.kind in kinds)
        if names:
            setters.append(f"{one if len(names) == 1 else many} {', '.join(names)}")
    only = "; ".join(
        f"{_said(workspace, datum)} {_off(workspace, off, size)}" for datum, off in spare.items()
    )
    by = f"set by {listed(setters)}" if setters else "set by the other data"
    return (f"more data than the figure needs: the points are {by}; only compared: {only}",)


def _said(workspace: Workspace, datum: Datum) -> str:
    if datum.kind in (MEAN, LINE, GUIDE):
        return datum_words(datum)
    return f"{datum_words(datum)} = {number_of(workspace.case, datum).value:.6g}"


def _off(workspace: Workspace, off: float, size: float) -> str:
    return "(agrees)" if off <= ROUNDING * size else f"(off by {measure(workspace, off)})"


# --- whether teeth of a given pitch or module fit the pivots of their wheels ---


MISFIT = 2e-3
"""Pivots may miss the distance of the pitch radii by this fraction of it."""


def refuse_misfit(case: Case, top: Topology, points: Points, scale: float) -> None:
    """Refuse teeth whose pitch circles do not touch on their pivots, as far as these are among the points."""
    for bond in top.bonds:
        module = _module(bond)
        if module is None or not {*bond.pivots} <= points.keys():
            continue
        assert isinstance(bond.joint, Mesh)
        fit = abs(bond.joint.sizes[0].value + bond.joint.sizes[1].value) * module / 2.0
        apart = math.dist(*(points[p] for p in bond.pivots)) / scale
        if abs(apart - fit) > MISFIT * fit:
            raise SceneError(Status.INCONSISTENT, _misfit(case, bond, fit, apart))


def _module(bond: Bond) -> float | None:
    """Pitch diameter per tooth (case lengths), where the case gives it."""
    return bond.joint.pitch if isinstance(bond.joint, Mesh) and bond.pivots[0] else None


def _misfit(case: Case, bond: Bond, fit: float, apart: float) -> str:
    a, b = bond.links
    line, _ = case.marks.get(f"joints.{a}-{b}", (0, 0))
    where = f" (line {line})" if line else ""
    unit, (p, q) = case.units.length, bond.pivots
    return (
        f"the teeth of gears {a} and {b}{where} do not fit: their pitch circles touch where the pivots are "
        f"{fit:.6g} {unit} apart, and {p} and {q} are {apart:.6g} {unit} apart. Correct the teeth, the pitch "
        "or module, or the pivots."
    )
