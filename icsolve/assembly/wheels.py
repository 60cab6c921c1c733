"""Whether teeth of a given pitch or module, radii that roll, and belts fit the pivots of their wheels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from itertools import combinations

from icsolve.case import Case, Number
from icsolve.case.joints import Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Arithmetic, Scalar
from icsolve.screws.joints import Points, circle_margin, held_centres, line_margins, rolling_centres
from icsolve.structure import Bond, topology
from icsolve.tuples import NamedTuple

MISFIT = 2e-3
"""Pivots may miss the distance of the pitch radii by this fraction of it."""

UNLIKE = 1.1
"""Sizes of a wheel in two meshes are two from this ratio on: wheels with a tooth more or less keep within."""

SAME_SIZE = 1.02
"""They are one up to this ratio."""

MOST_FORGOTTEN, FEW = 3, 12
"""So many signs at most are taken as forgotten, of so many meshes; of more than these one."""


def _pitched(case: Case, points: Points, a: Arithmetic = FLOATS) -> Iterator[tuple[Bond, Mesh, Scalar]]:
    """The meshes of a given pitch whose pivots are among the points, and their module in the plane of the
    wheels."""
    for bond in topology(case).bonds:
        joint = bond.joint
        if isinstance(joint, Mesh) and {*bond.pivots} <= points.keys():
            if joint.module is not None:
                module = a.given(joint.module)
            elif joint.diametral_pitch is not None:
                module = 1.0 / a.given(joint.diametral_pitch)
            else:
                continue
            if (helix := joint.helix) is not None and helix.normal_pitch:
                module = module / a.turn(helix.angle)[0]
            yield bond, joint, module


def refuse_misfit(case: Case, points: Points, scale: float) -> None:
    """Refuse teeth whose pitch circles do not touch on their pivots, and radii of wheels on pins that do not
    touch where they are said to roll, as far as these are among the points."""
    for bond, joint, module in _pitched(case, points):
        (a, b), apart = bond.links, math.dist(*(points[p] for p in bond.pivots)) / scale
        line, _ = case.marks.get(f"joints.{a}-{b}", (0, 0))
        what = f"gears {a} and {b}" + (f" (line {line})" if line else "")
        ends = (*bond.pivots, "pivots")
        refuse_unfit(what, joint.sizes, float(module), apart, ends, f" {case.units.length}")
    for rolls, pairs in _held(case, points):
        if all(float(min(_rolling(rolls, pair, points, scale, FLOATS), default=0.0)) < 0.0 for pair in pairs):
            _refuse_radii(case, rolls, pairs[0], points, scale)


def _held(case: Case, points: Points) -> Iterator[tuple[Rolling, list[tuple[str | None, str | None]]]]:
    """The rolling joints with radii whose wheels one link carries, and by which pins."""
    for joint in case.rollings:
        placed = held_centres(joint, case) if joint.at in points else []
        if pairs := [pair for pair in placed if all(p is None or p in points for p in pair)]:
            yield joint, pairs


def _rolling(
    joint: Rolling, pair: tuple[str | None, str | None], points: Points, scale: float, a: Arithmetic
) -> Iterator[Scalar]:
    """Numbers of which none is negative where the radii fit these centres; a straight link has none."""
    contact, radii = points[joint.at], [a.given(radius) * scale for radius in joint.radii or ()]
    wheels = [(points[p], r) for p, r in zip(pair, radii, strict=True) if p and not _is_zero(r)]
    for centre, radius in wheels:
        yield circle_margin(centre, contact, radius)
    if len(wheels) == 2:
        (p, r), (q, s) = wheels
        yield from line_margins((p, q), contact, (r, s))


def _is_zero(radius: Scalar) -> bool:
    """Whether a radius is zero in every row."""
    return isinstance(radius, float) and radius == 0.0


def _refuse_radii(
    case: Case, joint: Rolling, pair: tuple[str | None, str | None], points: Points, scale: float
) -> None:
    unit, sides = case.units.length, []
    for link, p, radius in zip(joint.links, pair, joint.radii or (), strict=True):
        if p is not None and radius.value:
            apart = math.dist(points[p], points[joint.at]) / scale
            sides.append(f"link {link} rolls on {radius.value:.6g} {unit}, {apart:.6g} {unit} from {p}")
    told = " and ".join(sides)
    if len(sides) == 2:
        told += ", and the contact has to lie between the centres (beyond them where a radius is negative)"
    mend = "Correct the radii or the points."
    raise SceneError(
        Status.INCONSISTENT,
        f"the radii of links {' and '.join(joint.links)} do not fit the figure: at {joint.at} {told}. {mend}",
    )


def noticed_of_wheels(case: Case, points: Points, scale: float) -> Iterator[str]:
    """What is said of wheels that fit badly and are solved all the same."""
    yield from misfitting_belts(case, points, scale)
    yield from unmoved_rollings(case, points, scale)
    yield from wheels_of_two_sizes(case, points, scale)


def unmoved_rollings(case: Case, points: Points, scale: float) -> Iterator[str]:
    """What is said of radii that do not tell how a contact rolls on."""
    for joint in case.rollings:
        if joint.at in points:
            try:
                rolling_centres(joint, case, points, scale)
            except LookupError as why:
                yield why_not_rolled(joint, why)


def why_not_rolled(joint: Rolling, why: LookupError) -> str:
    """The sentence."""
    what = f"the rolling of links {' and '.join(joint.links)} at {joint.at}"
    return f"{what} cannot be moved: {why.args[0]}."


def misfitting_belts(case: Case, points: Points, scale: float) -> Iterator[str]:
    """What is said of belts that no line of their strands touches both pulleys of, as far as their pivots are
    among the points. Their ratio is that of the radii all the same."""
    for bond in topology(case).bonds:
        belt = bond.joint
        if not (isinstance(belt, Mesh) and belt.pulls and bond.pivots and {*bond.pivots} <= points.keys()):
            continue
        (a, b), (p, q), unit = belt.links, bond.pivots, case.units.length
        apart, (first, second) = math.dist(points[p], points[q]) / scale, (r.value for r in belt.sizes)
        least, kind = (abs(first - second), "open") if belt.turns_alike else (first + second, "crossed")
        if apart < least:
            yield (
                f"no {kind} belt runs over pulleys {a} and {b}: {p} and {q} are {apart:.6g} {unit} apart, "
                f"and radii of {first:.6g} and {second:.6g} {unit} need more than {least:.6g} {unit}. "
                "Correct the radii or the pivots."
            )


def wheels_of_two_sizes(case: Case, points: Points, scale: float) -> Iterator[str]:
    """What is said of a wheel that has one size in one mesh and another in the next, and one in both if the
    teeth of a mesh were on the other side: a sign that was forgotten. The ratios are those of the teeth all
    the same, for a link may have two wheels of as many teeth."""
    meshes = [
        _Placed(bond.joint, bond.pivots, math.dist(*(points[p] for p in bond.pivots)) / scale)
        for bond in topology(case).bonds
        if isinstance(bond.joint, Mesh) and not bond.joint.pulls and {*bond.pivots} <= points.keys()
    ]
    own: dict[tuple[str, str, float], list[_Placed]] = {}
    for mesh in meshes:
        for link in mesh.mesh.links:
            own.setdefault((link, *mesh.wheel(link)), []).append(mesh)
    wheels = [(*two, wheel[0]) for wheel, all_of in own.items() for two in combinations(all_of, 2)]
    odd = [wheel for wheel in wheels if _is_unlike(*wheel, ())]
    turnable = [mesh for mesh in meshes if any(mesh in wheel for wheel in odd)]
    most = MOST_FORGOTTEN if len(turnable) <= FEW else 1
    best = min(
        (some for count in range(most + 1) for some in combinations(turnable, count)),
        key=lambda turned: sum(_is_unlike(*wheel, turned) for wheel in wheels),
    )
    for placed in best:
        one, other, link = next(wheel for wheel in odd if placed in wheel)
        (a, b), unit, teeth = placed.mesh.links, case.units.length, abs(one.wheel(link)[1])
        sizes = [f"{each.size(link):.6g} {unit} where it meets {each.mate(link)}" for each in (one, other)]
        apart = placed.mesh.turns_alike
        sides = f"gears {a} and {b} are external" if apart else f"one of gears {a} and {b} is internal"
        yield (
            f"the wheel of {teeth:g} teeth on link {link} has a pitch radius of {sizes[0]} and of {sizes[1]}"
            f"; it is one wheel if {sides}: write teeth: {_turned(placed.mesh)}."
        )


class _Placed(NamedTuple):
    """A mesh, its pivots and how far apart they are [case length]."""

    mesh: Mesh
    pivots: tuple[str, ...]
    apart: float

    def wheel(self, link: str) -> tuple[str, float]:
        """Where the wheel of a link turns, and how many teeth it has."""
        own = self.mesh.links.index(link)
        return self.pivots[own], abs(self.mesh.sizes[own].value)

    def mate(self, link: str) -> str:
        """The link of the other wheel."""
        return self.mesh.links[1 - self.mesh.links.index(link)]

    def size(self, link: str, turned: bool = False) -> float:
        """Pitch radius of the wheel of a link; with ``turned``, if the mesh were on the other side."""
        first, second = (abs(n.value) for n in self.mesh.sizes)
        both = abs(first - second) if self.mesh.turns_alike != turned else first + second
        return self.wheel(link)[1] * self.apart / both if both else math.inf


def _is_unlike(one: _Placed, other: _Placed, link: str, turned: tuple[_Placed, ...]) -> bool:
    """Whether a wheel has two sizes in its meshes, some of which are turned to the other side."""
    sizes = [mesh.size(link, mesh in turned) for mesh in (one, other)]
    return max(sizes) > min(sizes) * (SAME_SIZE if one in turned or other in turned else UNLIKE)


def _turned(mesh: Mesh) -> str:
    """The teeth of a mesh as they are written if it is on the other side: those of the larger are inside."""
    texts = [n.digits.lstrip("-") for n in mesh.sizes]
    larger = int(abs(mesh.sizes[1].value) > abs(mesh.sizes[0].value))
    if not mesh.turns_alike:
        texts[larger] = f"-{texts[larger]}"
    return f"[{', '.join(texts)}]"


def wheel_margins(
    case: Case, points: Points, scale: float, a: Arithmetic, rolled: bool = False
) -> Iterator[Scalar]:
    """In any arithmetic, numbers of which none is negative but where `refuse_misfit` may refuse: with r the
    distance of the pivots over that of the pitch circles, (2 m (1 - m))^2 - (r^2 - 1)^2 of the misfit m.

    With ``rolled`` also where other points than here may be the centres about which links roll.
    """
    for rolls in case.rollings if rolled else ():
        with suppress(LookupError):
            centres = rolling_centres(rolls, case, points, scale)
            yield from _rolling(rolls, centres, points, scale, a)
    for rolls, pairs in _held(case, points):
        margins = [list(_rolling(rolls, pair, points, scale, a)) for pair in pairs]
        yield from max(margins, key=lambda some: float(min(map(float, some), default=0.0)))
    for bond, joint, module in _pitched(case, points, a):
        (ax, ay), (bx, by) = (points[p] for p in bond.pivots)
        first, second = map(a.given, joint.sizes)
        fit = (first + second) * (0.5 * scale) * module
        off = ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)) / (fit * fit) - 1.0
        yield (2.0 * MISFIT * (1.0 - MISFIT)) ** 2 - off * off


def refuse_unfit(
    what: str,
    teeth: Iterable[Number],
    module: float,
    apart: float,
    ends: tuple[str, str, str],
    unit: str = "",
) -> None:
    """Refuse two wheels whose pitch circles do not touch at this distance of their centres; ``ends`` are
    these, and the word for them."""
    fit, (p, q, centres) = abs(sum(n.value for n in teeth)) * module / 2.0, ends
    if abs(apart - fit) > MISFIT * fit:
        raise SceneError(
            Status.INCONSISTENT,
            f"the teeth of {what} do not fit: their pitch circles touch where the {centres} are {fit:.6g}"
            f"{unit} apart, and {p} and {q} are {apart:.6g}{unit} apart. Correct the teeth, the pitch or "
            f"module, or the {centres}.",
        )
