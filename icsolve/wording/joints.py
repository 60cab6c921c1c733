"""What is said of each kind of joint: a table with a branch for every kind, as the type checker sees to."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import assert_never

from icsolve.case import (
    Belt,
    Case,
    Contact,
    Gears,
    Joint,
    KnownCentre,
    Number,
    Pair,
    Pin,
    Roll,
    Slide,
    Slot,
    Weld,
    is_named,
)
from icsolve.case.joints import Thread
from icsolve.structure import welded
from icsolve.wording import at_words, listed


def joint_words(joint: Joint) -> str:
    """What a joint does."""
    links = listed(joint.links)
    where = at_words(joint.at)
    match joint:
        case Pin():
            return f"a pin joins links {links}{where}"
        case Slide(thread=Thread()):
            on, by = joint.links
            return f"a screw moves link {on} on link {by}{where}"
        case Slide():
            return f"link {joint.links[0]} slides on link {joint.links[1]}{where}"
        case Slot():
            pin, slot = joint.links
            return f"a pin of link {pin} runs in a slot of link {slot}{where}"
        case Roll():
            return f"links {links} roll on each other without slip{where}"
        case Gears():
            return f"links {links} are gears"
        case Belt():
            return f"a belt runs over links {links}"
        case Contact():
            touch = "touch" if where else "touch by their profiles"
            return f"links {links} {touch}{where}"
        case KnownCentre():
            return f"the centre of links {links} is known{where}"
        case Weld():
            return f"links {links} are welded together{where}"
        case _:
            assert_never(joint)


def joint_data(joint: Joint, length: str, show: Callable[[Number], str]) -> Iterator[str]:
    """The numbers of a joint; ``length`` is the unit of lengths."""
    guide, friction = joint.guide, joint.friction
    if guide is not None:
        a, b = guide.ends or ("", "")
        join = "" if len(a) == len(b) == 1 else "-"
        yield f"along {a}{join}{b}" if guide.angle is None else f"along {show(guide.angle)} deg"
        if guide.through and is_named(guide.through):
            yield f"through {guide.through}"
    yield from _sizes(joint, length, show)
    if friction is not None:
        yield f"mu = {show(friction.mu)}"
        for name, number in (("pin radius", friction.radius), ("block length", friction.length)):
            if number is not None:
                yield f"{name} {show(number)} {length}"


def _sizes(joint: Joint, length: str, show: Callable[[Number], str]) -> Iterator[str]:
    """What only joints of its kind have."""
    match joint:
        case Slide():
            yield from thread_data(joint.thread, length, show) if joint.thread is not None else ()
        case Roll():
            yield from [f"radii {' and '.join(map(show, joint.radii))} {length}"] if joint.radii else []
        case Belt():
            kind = "crossed" if joint.crossed else "open"
            yield f"{kind}, on radii {' and '.join(map(show, joint.radii))} {length}"
        case Gears():
            yield from _teeth(joint, length, show)
        case Contact():
            yield f"common normal at {show(joint.normal)} deg"
        case KnownCentre():
            yield from [f"at infinity at {show(joint.toward)} deg"] if joint.toward is not None else []
        case Pin() | Slot() | Weld():
            pass
        case _:
            assert_never(joint)


def _teeth(gears: Gears, length: str, show: Callable[[Number], str]) -> Iterator[str]:
    yield f"{' and '.join(show(number).lstrip('-') for number in gears.teeth)} teeth"
    if any(number.value < 0.0 for number in gears.teeth):
        yield "one of them internal"
    helix = gears.helix
    angle, *normal = (
        (None, False, False) if helix is None else (helix.angle, helix.normal, helix.normal_pitch)
    )
    form = (gears.pressure_angle, angle, gears.diametral_pitch, gears.module)
    yield from form_of_teeth(form, normal, length, show)
    if helix is not None and helix.span is not None:
        yield f"bearing span {show(helix.span)} {length}"


def form_of_teeth(
    form: Sequence[Number | None], normal: Sequence[bool], length: str, show: Callable[[Number], str]
) -> Iterator[str]:
    """Pressure angle, helix angle, diametral pitch and module of teeth, where they are given; of a helix with
    their section: whether that of the angle and that of the pitch or module is ``normal``."""
    pressure, helix, pitch, module = form
    angle, size = ("" if helix is None else "normal " if is_normal else "transverse " for is_normal in normal)
    if pressure is not None:
        yield f"{angle}pressure angle {show(pressure)} deg"
    if helix is not None:
        yield f"helix angle {show(helix)} deg"
    if pitch is not None:
        yield f"{size}diametral pitch {show(pitch)} a {length}"
    if module is not None:
        yield f"{size}module {show(module)} {length}"


def thread_data(thread: Thread, length: str, show: Callable[[Number], str]) -> Iterator[str]:
    """``lead 5 mm``, ``mean radius 10 mm``, ``mu = 0.1``."""
    yield f"lead {show(thread.lead)} {length}"
    if thread.radius is not None:
        yield f"mean radius {show(thread.radius)} {length}"
    if thread.mu is not None:
        yield f"mu = {show(thread.mu)}"


def centre_words(joint: Joint) -> str:
    """What of a joint shows the centre of its links."""
    match joint:
        case Pin():
            return f"the pin {joint.at}"
        case Slide():
            return f"square to the guide at {joint.at}"
        case Roll():
            return f"rolling contact at {joint.at}"
        case Gears():
            teeth = " : ".join(n.digits.lstrip("-") for n in joint.teeth)
            return f"the pitch point, which divides the line of the pivots as {teeth}"
        case Belt():
            radii = " : ".join(r.digits for r in joint.radii)
            return f"where the belt cuts the line of the pivots, divided as {radii}"
        case KnownCentre():
            return "given"
        case Slot() | Contact() | Weld():  # no one centre
            return "a joint"
        case _:
            assert_never(joint)


def normal_words(joint: Joint) -> str:
    """The line on which the centre of two surfaces lies."""
    return "normal to the slot" if joint.guide is not None else "common normal"


def joint_of_normal(case: Case, lines: Sequence[Sequence[Pair]], number: int) -> Joint | None:
    """The joint whose common normal is a line of a centre; of several between two bodies each has its own.

    Parameters
    ----------
    lines, number : the lines of the centre, and which of them it is
    """
    pair = set(lines[number][0])
    before = sum(len(line) == 1 and set(line[0]) == pair for line in lines[:number])
    bodies = [{*welded(case, link)} for link in pair]
    normals = (joint for joint in case.joints if joint.has_normal)
    found = [joint for joint in normals if not any(body.isdisjoint(joint.links) for body in bodies)]
    return found[before] if before < len(found) else None


def normal_name(joint: Joint | None) -> str:
    """The normal of a joint by its point, or its links."""
    if joint is None or joint.at is None:
        return "common normal of the joint"
    what = normal_words(joint)
    hidden = not is_named(joint.at)
    return f"{what} of links {' and '.join(joint.links)}" if hidden else f"{what} at {joint.at}"


def why_not_moved(joint: Joint) -> str:
    """The refusal to move a joint that is known in one position only."""
    names = " and ".join(joint.links)
    if joint.stands_in:
        return (
            f"the given centre of links {names} cannot be moved: it holds in the position as written only. "
            "Put the joints between the two links in its place."
        )
    return (
        f"the contact of links {names} at {joint.at} cannot be moved: its profile is not known beyond "
        "the position as written. Vary a load, or put joints in its place that describe the profile, as a "
        "slot where a point of one slides along a line of the other."
    )


def why_no_acceleration(joint: Joint) -> str:
    """The refusal of accelerations at a joint that is known in one position only."""
    name, why = "contact", "nothing says how its profiles curve"
    if joint.stands_in:
        name, why = "centre", "it stands for joints that the case does not show. Give those"
    return f"the {name} of links {listed(joint.links)} has no acceleration: {why}."
