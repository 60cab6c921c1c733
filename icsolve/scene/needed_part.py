"""The part of a mechanism that its answer needs: links that hang on it and hold nothing of it, as a passive
dyad, may be left out, and are where they cannot be placed or have no motion.

A group of links that adds no freedom takes none either: what moves beside it moves as if it were not there
(L. V. Assur, 1914). So the links that the plan of the answer leaves out are left out together.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from functools import lru_cache

from icsolve.assembly import LEFT_OUT
from icsolve.assembly.workspace import CORNER, LENGTH, RAY, datum_at
from icsolve.case import Case, Coordinates
from icsolve.errors import SceneError, Status
from icsolve.statics import load_wrenches
from icsolve.statics.power import has_friction, has_number, is_unknown
from icsolve.structure import Topology, topology
from icsolve.structure.plan import make_plan
from icsolve.structure.torn_points import CarriedPoints
from icsolve.tuples import TypeVar, replace
from icsolve.wording import links_named

Found = TypeVar("Found")

UNPLACED = (Status.CANNOT_ASSEMBLE, Status.UNDERDETERMINED, Status.INCONSISTENT, Status.AMBIGUOUS)
"""Why links have no place. What has one may be strained, and press what rubs, though it does no work."""


def needed_part(case: Case, beside: Collection[str] = ()) -> Case | None:
    """The case without the links that neither its answer needs nor ``beside`` names; None where it needs
    them all, or counting does not show that the others hold nothing of it.

    The data of the figure stay, as points are placed by those of other links too, and so do the points that
    links carry which are left out: they are on no other.
    """
    asks = case.unknowns or any(map(is_unknown, case.loads))
    if not asks or not any(map(has_number, case.loads)):  # what is asked is how all of it moves
        return None
    if case.space is not None or case.touches or case.ropes or case.screws:
        return None
    top = topology(replace(case, unknowns=()) if case.unknowns else case)
    beside = {*beside}.union(*(_posed_by(case, unknown.path) for unknown in case.unknowns))
    if beside:  # in a motion the links with which loads turn say how these act
        beside |= {turner for load in case.loads if (turner := getattr(load, "turns_with", None))}
    wanted = {*load_wrenches.moving_links(case), *beside, *(case.inertia if case.dynamic else ())}
    kept = _planned(top, {top.body_of[link] for link in wanted})
    if kept is None or len(kept) == len(top.members):
        return None
    links = tuple(link for link in case.links if top.body_of[link] in kept)
    part = replace(
        case,
        links=links,
        joints=tuple(left for joint in case.joints if (left := joint.among(links)) is not None),
        inertia={link: mass for link, mass in case.inertia.items() if link in links},
        taken_along=_taken_along(case, top, links),
    )
    guides = (joint.guide for joint in part.joints if joint.guide is not None)
    used = {p for guide in guides for p in (*(guide.ends or ()), guide.through)}
    used.update(p for load in case.loads for p in load_wrenches.points_of(load))
    strained = has_friction(case) and any(bond.pivots and bond.joint.pulls for bond in top.bonds)
    return None if part.left_out & used or strained else part


def _planned(top: Topology, wanted: set[int]) -> frozenset[int] | None:
    """The bodies that a plan of the wanted ones needs, and those that carry its gears."""
    while True:
        plan = make_plan(top, wanted)
        if plan is None or not plan.closed:
            return None
        carriers = {top.bonds[k].carrier for k in plan.bonds if top.bonds[k].pivots} - plan.bodies
        if not carriers:
            return plan.bodies
        wanted |= carriers


def _taken_along(case: Case, top: Topology, links: Collection[str]) -> dict[str, str]:
    """The links of a part that take the points of those joints along which it is without."""
    carried = CarriedPoints(case, top)
    points = {joint.at for joint in case.joints if joint.at is not None and not {*joint.links} <= {*links}}
    takers = (
        (p, [i for i in links if p in case.carries.get(i, ()) and carried.go_with(i, p)]) for p in points
    )
    return {p: own[0] if own else "" for p, own in takers}


def moving_part(
    case: Case, paths: Iterable[str], links: Collection[str], dynamic: bool = False
) -> Case | None:
    """As `needed_part`, with the links that are turned and those that varied data pose, and those of inertia
    where their forces count."""
    return _moving_part(case, tuple(paths), tuple(links), dynamic)


@lru_cache(maxsize=64)
def _moving_part(case: Case, paths: tuple[str, ...], links: tuple[str, ...], dynamic: bool) -> Case | None:
    """The same, once a case."""
    beside = {*links, *(case.inertia if dynamic else ())}
    if needed_part(case, beside) is None:
        return None
    return needed_part(case, beside.union(*(_posed_by(case, path) for path in paths)))


def _posed_by(case: Case, path: str) -> set[str]:
    """The links that a datum of the figure may pose: those that a coordinate, a direction or an angle places,
    and those at the ends of a length that is of no link; none of a number that only shapes a link."""
    datum = datum_at(case, path)
    if datum is None:  # a coordinate that is to be found has none yet
        open_ = [
            f"points.{name}" for name, at in case.points.items() if isinstance(at, Coordinates) and None in at
        ]
        ends = {path.split(".")[1]} if path.rpartition(".")[0] in open_ else set()
    else:
        ends = {*datum.points}
    held = {link: len(ends & {*points}) for link, points in case.carries.items()}
    if datum is not None and datum.kind in (LENGTH, CORNER) and len(ends) in held.values():
        return set()
    turns = datum is not None and datum.kind in (RAY, CORNER)
    return {link for link, count in held.items() if count > turns}


def without_spare_links(
    case: Case,
    refusal: SceneError,
    paths: Iterable[str] = (),
    links: Collection[str] = (),
    *,
    bodies: bool = False,
) -> tuple[Case, str]:
    """The part of a case that its answer needs (see `moving_part`), where the whole is refused, and the note
    on what was left out; where ``bodies`` are in question because it can't be placed. Raises the refusal
    where there is no such part."""
    if bodies and refusal.status not in UNPLACED:
        raise refusal
    try:
        part = moving_part(case, paths, links)
    except SceneError:
        raise refusal from None
    if part is None:
        raise refusal
    return part, f"{left_out_of(case, part)}: {refusal.message}"


def by_needed_part(
    case: Case,
    attempt: Callable[[Case], Found],
    paths: Iterable[str] = (),
    links: Collection[str] = (),
    *,
    bodies: bool = False,
) -> tuple[Found, str]:
    """What an attempt makes of a case, or where it is refused of the part that its answer needs, and then the
    note on what was left out; the parameters are those of `without_spare_links`. Raises the refusal of the
    whole where the part is refused too."""
    try:
        return attempt(case), ""
    except SceneError as refusal:
        part, left_out = without_spare_links(case, refusal, paths, links, bodies=bodies)
        try:
            return attempt(part), left_out
        except SceneError:
            raise refusal from None


def left_out_of(case: Case, part: Case) -> str:
    """The words on the links that a part of a case is without."""
    links = [link for link in case.links if link not in part.links]
    return f"{LEFT_OUT}: {links_named(links)}, as nothing needs {'it' if len(links) == 1 else 'them'}"
