"""What a case says: frozen values, one representation of a mechanism from the file to the answer.

Every number is in case units (lengths, forces, and torques as force times length unless
``units.torque`` says otherwise; angles in degrees, angular speeds in rad/s, masses in kg,
times in s). Points are named; a position that a load or a centre gives by coordinates has a
hidden name that starts with ``@``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from icsolve.case.figure import (
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Guide,
    Length,
    Mark,
    Units,
    Unknown,
    bare_name,
    is_angle,
    is_link,
    is_named,
)
from icsolve.case.joints import (
    Belt,
    Contact,
    Friction,
    Gears,
    Guided,
    Helix,
    Joint,
    KnownCentre,
    Pair,
    Pin,
    Roll,
    Rolling,
    Slide,
    Slot,
    Thread,
    Weld,
)
from icsolve.case.loads import (
    AlongRope,
    Area,
    Force,
    ForceVector,
    Heading,
    Inertia,
    Like,
    Load,
    Magnitude,
    Motion,
    Rope,
    Screw,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.errors import refuse_other
from icsolve.numbers.units import Number
from icsolve.tuples import cached_property, dataclass, field

if TYPE_CHECKING:
    from icsolve.case.expected import Expected, Tolerance, Variable
    from icsolve.case.profiles import Profiles, Touch
    from icsolve.case.space import Space


__all__ = [
    "AlongRope",
    "Area",
    "Belt",
    "Case",
    "Centroid",
    "Contact",
    "Coordinates",
    "Corner",
    "Direction",
    "Force",
    "ForceVector",
    "Friction",
    "Gears",
    "Guide",
    "Heading",
    "Helix",
    "Inertia",
    "Joint",
    "KnownCentre",
    "Length",
    "Like",
    "Load",
    "Magnitude",
    "Mark",
    "Motion",
    "Number",
    "Pair",
    "Pin",
    "Roll",
    "Rope",
    "Screw",
    "Slide",
    "Slope",
    "Slot",
    "Spring",
    "Stretch",
    "Thread",
    "Torque",
    "TorsionSpring",
    "Toward",
    "Units",
    "Unknown",
    "Weight",
    "Weld",
    "bare_name",
    "is_angle",
    "is_link",
    "is_named",
    "refuse_no_case",
]


@dataclass(frozen=True, eq=False, repr=False)
class Case:
    """One mechanism in one position, as its file gives it.

    ``links`` are in the order of first mention in the joints, the frame among them; ``carries``
    has for each link the points that its joints, loads and ``links:`` put on it; ``marks`` the
    line and column of every path.
    """

    name: str = "case"
    path: str = "<text>"
    title: str = ""
    source: str = ""
    reconstructed: str = ""
    units: Units = Units()
    ground: str = "1"
    links: tuple[str, ...] = ()
    points: dict[str, Coordinates | Centroid] = field(default_factory=dict)
    lengths: tuple[Length, ...] = ()
    angles: tuple[Direction | Corner, ...] = ()
    unknowns: tuple[Unknown, ...] = ()
    """data of the figure that are to find; a coordinate only where it gives a range or a start"""
    near: dict[str, tuple[float, float]] = field(default_factory=dict)
    joints: tuple[Joint, ...] = ()
    loads: tuple[Load, ...] = ()
    directed: tuple[str, ...] = ()
    """forces of unknown direction by name: ``P`` stands among the loads as ``P.x`` and ``P.y``"""
    motion: tuple[Motion, ...] = ()
    expect: tuple[Expected, ...] = ()
    carries: dict[str, tuple[str, ...]] = field(default_factory=dict)
    gravity: Number = Number(9.81, 0.005, "gravity", "9.81", bound="not negative", dimension="acceleration")
    """m/s^2, along -y"""
    inertia: dict[str, Inertia] = field(default_factory=dict)
    """by link"""
    dynamic: bool = False
    """whether the inertia forces of the given motion are among the loads"""
    ropes: tuple[Rope, ...] = ()
    tolerance: Tolerance | None = None
    variables: tuple[Variable, ...] = ()
    profiles: Profiles | None = None
    """shapes of cams and followers, and the contacts that they place; these are not among the joints"""
    space: Space | None = None
    """figure, joints and loads where the points have three coordinates; those of the plane are then empty"""
    noticed: tuple[str, ...] = ()
    """sentences of the reader on what may be a slip, for the notes of an answer"""
    marks: dict[str, Mark] = field(default_factory=dict)
    taken_along: dict[str, str] = field(default_factory=dict)
    """of a part of a case, by point of a joint that it is without, the link that takes it along; empty where
    that is left out as well"""

    @cached_property
    def screws(self) -> tuple[Screw, ...]:
        """Those that a torque turns."""
        slides = (joint for joint in self.joints if isinstance(joint, Guided))
        return tuple(Screw(slide, slide.thread) for slide in slides if slide.thread is not None)

    @cached_property
    def left_out(self) -> frozenset[str]:
        """The points that only links carry which are left out of the case."""
        if self.ropes or self.carries.keys() <= {*self.links}:  # a rope carries its free end
            return frozenset()
        out, kept = set[str](), set[str]()
        for link, points in self.carries.items():
            (kept if link in self.links else out).update(points)
        return frozenset(out - kept)

    @cached_property
    def given_places(self) -> dict[str, tuple[float, float]]:
        """The places of the points of which the case gives both coordinates, [case length]."""
        given = [(name, at) for name, at in self.points.items() if isinstance(at, Coordinates)]
        return {name: (x.value, y.value) for name, (x, y) in given if x is not None and y is not None}

    @cached_property
    def axes(self) -> frozenset[str]:
        """The paths of the directions of components: no file has these numbers."""
        return frozenset(f"loads.{name}.{axis}.angle" for name in self.directed for axis in "xy")

    @property
    def touches(self) -> tuple[Touch, ...]:
        """The contacts that profiles place."""
        return self.profiles.touches if self.profiles is not None else ()

    @cached_property
    def rollings(self) -> tuple[Rolling, ...]:
        """The joints that roll on given radii."""
        rolling = (joint for joint in self.joints if isinstance(joint, Rolling))
        return tuple(joint for joint in rolling if joint.radii is not None)

    def pivots(self, *links: str) -> list[str]:
        """The points about which a link is pinned, or several to each other, in the order of the joints."""
        pins = (joint for joint in self.joints if {*links} <= {*joint.links})
        return [joint.pivot for joint in pins if joint.pivot is not None]

    def __repr__(self) -> str:
        """Its name and size; the fields of a whole case would fill a page."""
        counts = f"{len(self.links)} links, {len(self.joints)} joints, {len(self.loads)} loads"
        return f"<Case {self.name}: {counts}>"


# --- names of links and of their centres: ``2-4``, ``crank-rocker`` -------------------------------------


def refuse_no_case(given: object) -> None:
    """Refuse what is no case where one is to be solved."""
    if isinstance(given, Case):
        return
    path = given if isinstance(given, str) and "\n" not in given else getattr(given, "name", "press.yaml")
    refuse_other(given, Case, f"a case is wanted, as icsolve.load({str(path)!r}) gives it")


def link_order(case: Case, link: str) -> tuple[int, int]:
    """Sorting key of a link: numbers ascending, then words in order of first mention."""
    if link.isdecimal():
        return (0, int(link))
    return (1, case.links.index(link) if link in case.links else len(case.links))


def told_links(case: Case) -> list[str]:
    """The links in the order in which they are told; ``case.links`` are as the joints mention them."""
    return sorted(case.links, key=lambda link: link_order(case, link))


def ordered_pair(case: Case, a: str, b: str) -> Pair:
    """Two links in the order in which their centre is named."""
    return (a, b) if link_order(case, a) <= link_order(case, b) else (b, a)


def spot_name(spot: str | tuple[str, str]) -> str:
    """What moves, as the format names it: a link, or a point on a link."""
    return spot if isinstance(spot, str) else f"{spot[0]} on {spot[1]}"


def pair_name(case: Case, pair: Pair) -> str:
    """Name of the centre of two links, whichever way they are given."""
    return "-".join(ordered_pair(case, *pair))
