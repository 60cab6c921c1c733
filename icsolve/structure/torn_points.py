"""Points at which a link has a load, a mass or a given speed, and which a motion takes elsewhere: a pin of
another link in a slot of it, a block on its guide, a contact that rolls on. What stands there goes on with
its own link, from where the figure is written."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import Case, Load, TorsionSpring
from icsolve.structure import Topology
from icsolve.tuples import NamedTuple


class TornPoint(NamedTuple):
    """A point, the link on which something stands there, the link that takes the point along (empty: none,
    as a rolling contact, which goes on along both), and the load that stands there (None: a mass, a given
    speed)."""

    point: str
    link: str
    owner: str
    load: str | None = None


def owners_of_points(case: Case) -> dict[str, str]:
    """The link that takes each point along: of a pin any, of a block or a pin in a slot its own; empty where
    that is left out of the case."""
    found: dict[str, list[str]] = {}
    for joint in sorted(case.joints, key=lambda joint: joint.pivot is None):
        at = getattr(joint, "at", None)
        if at is not None:
            found.setdefault(at, []).extend(joint.links if joint.pivot else joint.links[:1])
    for link, names in case.carries.items():
        for name in names:
            found.setdefault(name, [link])
    owners = {name: case.ground if case.ground in links else links[0] for name, links in found.items()}
    return {**owners, **case.taken_along}


class CarriedPoints:
    """Which points go with which link in a motion."""

    def __init__(self, case: Case, top: Topology) -> None:
        self.owners, self.body_of = owners_of_points(case), top.body_of
        self.rolled = {joint.at for joint in case.joints if joint.at is not None and not joint.carried}
        self.pinned: dict[str, set[int]] = {}
        for joint in case.joints:
            if joint.pivot is not None:
                bodies = {top.body_of[link] for link in joint.links}
                self.pinned.setdefault(joint.pivot, set()).update(bodies)

    def go_with(self, link: str, point: str) -> bool:
        """Whether a point that stands on a link goes on with it, and not with another or along both."""
        if point in self.rolled:
            return False
        owner = self.owners.get(point, link)
        if not owner:
            return False
        bodies = {self.body_of[link], self.body_of[owner]}
        return len(bodies) == 1 or bodies <= self.pinned.get(point, set())


def torn_points(case: Case, top: Topology) -> Iterator[TornPoint]:
    """All of them, in the order of masses, given speeds and loads."""
    carried = CarriedPoints(case, top)
    held = [TornPoint(mass.centre, link, "") for link, mass in case.inertia.items() if mass.centre]
    held += [TornPoint(given.point, given.link, "") for given in case.motion if given.point]
    held += [TornPoint(p, link, "", load.name) for load in case.loads for p, link in _stands_at(case, load)]
    for each in held:
        if each.link in top.body_of and not carried.go_with(each.link, each.point):
            owner = "" if each.point in carried.rolled else carried.owners[each.point]
            yield each._replace(owner=owner)


def _stands_at(case: Case, load: Load) -> Iterator[tuple[str, str]]:
    """The points of a load, each with the link on which it stands."""
    against = getattr(load, "against", None) or case.ground
    if isinstance(load, TorsionSpring):
        *arm, at, end = load.corner
        yield from ((at, load.link), (end, load.link))
        yield from ((p, against) for p in (*arm, at) if arm)
        return
    over = getattr(load, "over", None)
    for p in (getattr(load, "at", None), getattr(over, "a", None), getattr(over, "b", None)):
        if p is not None:
            yield p, load.link
    to = getattr(load, "to", None)
    if to is not None:
        yield to, against
