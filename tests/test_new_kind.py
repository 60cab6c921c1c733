"""A kind of joint that only says which centres span its freedoms: positions, forces and motion follow.

A bar of a kind of its own, between points of two links, against the link with two pins that it stands for.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from pathlib import Path

import numpy as np
import pytest

import icsolve
from icsolve.case import Case, Guide, Joint, Pin, Slot
from icsolve.case.joints import (
    CentreAt,
    CentreSquareTo,
    CentreToward,
    Friction,
    Guided,
    JointCentre,
    JointKind,
    Pair,
)
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple

CASES = Path(__file__).parent.parent / "cases"
FOUR_BAR = """\
icsolve: 1
points: {A: [0, 0], C: [3.6, 2.5], D: [4, 0]}
lengths: {AB: 1, DE: 1.5}
angles: {AB: 60, CDE: 0}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}
"""


class _Ends(NamedTuple):
    links: Pair
    at: str
    to: str


class Bar(_Ends, JointKind):
    """It keeps the distance of ``at`` on its first link from ``to`` on its second."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        return CentreAt(self.at, self.links[0]), CentreAt(self.to, self.links[1])

    @property
    def points(self) -> tuple[str, ...]:
        return self.at, self.to

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        return (self.links[0], self.at), (self.links[1], self.to)


def barred() -> Case:
    """The four-bar with a bar for its coupler."""
    case = icsolve.load(FOUR_BAR)
    first, _, _, last = case.joints
    carries = {link: points for link, points in case.carries.items() if link != "3"}
    joints = (first, Bar(("2", "4"), "B", "C"), last)
    return replace(case, links=("1", "2", "4"), joints=joints, carries=carries)  # type: ignore[arg-type]


def test_the_force_rates_and_centre_are_those_of_the_link_for_which_it_stands() -> None:
    pinned, bar = icsolve.solve(icsolve.load(FOUR_BAR)), icsolve.solve(barred())
    assert bar.mobility == pinned.mobility == 1
    assert np.isclose(bar.answers["T12"].value, pinned.answers["T12"].value, rtol=1e-14, atol=0.0)
    assert np.allclose(bar.centres["2", "4"].place, pinned.centres["2", "4"].place, rtol=1e-13)


def test_it_moves_as_that_link_does() -> None:
    angles = np.linspace(0.0, 360.0, 73)
    want = ("answers", "status", "points")
    pinned = icsolve.sweep(icsolve.load(FOUR_BAR), vary={"angles.AB": angles}, want=want)
    bar = icsolve.sweep(barred(), vary={"angles.AB": angles}, want=want)
    assert np.all(bar.status == "ok")
    # rounding of two elimination orders: some hundred ulps of the largest force
    assert np.allclose(bar.answers["T12"], pinned.answers["T12"], rtol=0.0, atol=1e-11)
    assert np.allclose(bar.points["C"], pinned.points["C"], rtol=0.0, atol=1e-13)


class _Pair(NamedTuple):
    links: Pair


class Parallel(_Pair, JointKind):
    """Two links that keep the angle between them, as those of a drafting machine."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        directions = (Number(degrees, 0.0, "", f"{degrees:g}") for degrees in (0.0, 90.0))
        return tuple(CentreToward(degrees, self.links[0]) for degrees in directions)


ON_TWO_SLIDES = """\
icsolve: 1
points: {A: [0, 0], B: [2, 1], C: [4, 3], E: [6, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slot: [4, 1], at: E, along: 0}
  - {slide: [9, 2], at: A, along: 30}
  - {slide: [4, 9], at: C, along: 75}
loads:
  P: {force: 10, link: 4, at: E, angle: 0}
  T12: {torque: unknown, link: 2}
motion: {link: 2, speed: 3 rad/s}
links: {4: {mass: 2 kg, centre: C}}
"""


def test_two_links_kept_parallel_are_those_on_two_slides() -> None:
    """Without the link between the slides: force, accelerations, and motion."""
    slid = icsolve.load(ON_TWO_SLIDES)
    joints = (*slid.joints[:4], Parallel(("4", "2")))
    carries = {link: points for link, points in slid.carries.items() if link != "9"}
    kept = replace(slid, links=("1", "2", "3", "4"), joints=joints, carries=carries)  # type: ignore[arg-type]
    for dynamic in (False, True):
        ours, theirs = (icsolve.solve(case, dynamic=dynamic) for case in (kept, slid))
        assert ours.answers["T12"].value == pytest.approx(theirs.answers["T12"].value, rel=1e-14)
    angles, want = np.arange(0.0, 50.0, 10.0), ("answers", "status")
    ours, theirs = (icsolve.sweep(case, drive={"2": angles}, want=want) for case in (kept, slid))
    assert set(ours.status) == {"ok"}
    assert np.allclose(ours.answers["T12"], theirs.answers["T12"], rtol=1e-12, atol=0.0)


class _At(NamedTuple):
    links: tuple[str, ...]
    at: str
    friction: Friction | None = None


class Hinge(_At, JointKind):
    """A pin of another name."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        return (CentreAt(self.at, self.links[0]),)

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        return tuple((link, self.at) for link in self.links)


class _On(NamedTuple):
    links: Pair
    at: str
    guide: Guide
    friction: Friction | None = None


class Groove(_On, Guided):
    """A slot of another name."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        return CentreAt(self.at, self.links[0]), CentreSquareTo(self.guide, self.links[1])


def renamed(joint: Joint) -> JointKind:
    """The joint as one of a kind that the package does not know."""
    return Hinge(*joint) if isinstance(joint, Pin) else Groove(*joint) if isinstance(joint, Slot) else joint


@pytest.mark.parametrize(
    "name", ["ch13/13_12_five_links", "gears/epicyclic_train", "rolling/rack_and_pinion", "sliders/geneva"]
)
def test_a_pin_and_a_slot_are_known_by_what_they_answer_alone(name: str) -> None:
    case = icsolve.load(CASES / f"{name}.yaml")
    twin = replace(case, joints=tuple(map(renamed, case.joints)))  # type: ignore[arg-type]
    ours, theirs = (icsolve.solve(one, all_centres=True, rates=True, reactions=True) for one in (case, twin))
    assert {load: found.value for load, found in ours.answers.items()} == {
        load: found.value for load, found in theirs.answers.items()
    }
    assert ours.rates == theirs.rates
    assert [r._replace(kind="") for r in ours.reactions.values()] == [
        r._replace(kind="") for r in theirs.reactions.values()
    ]
