"""What is said of each kind of joint: a table with a branch for every kind, as the type checker sees to."""

from __future__ import annotations

from typing import assert_never

from icsolve.case import Belt, Contact, Gears, Joint, KnownCentre, Pin, Roll, Slide, Slot, Weld
from icsolve.case.joints import Guided, Sliding, Thread
from icsolve.wording.sentences import listed


def joint_words(joint: Joint, length: str) -> str:
    """A joint in words; ``length`` is the unit of lengths."""
    links = listed(joint.links)
    where = f" at {joint.at}" if joint.at and not joint.at.startswith("@") else ""
    match joint:
        case Pin():
            return f"a pin joins links {links}{where}"
        case Slide(thread=Thread() as thread):
            on, by = joint.links
            sizes = thread_words(thread, length)
            return f"a screw moves link {on} on link {by}{where}{_along(joint)} ({sizes})"
        case Slide():
            return f"link {joint.links[0]} slides on link {joint.links[1]}{where}{_along(joint)}"
        case Slot():
            pin, slot = joint.links
            return f"a pin of link {pin} runs in a slot of link {slot}{where}{_along(joint)}"
        case Roll():
            return f"links {links} roll on each other without slip{where}"
        case Gears():
            teeth = " and ".join(n.digits.lstrip("-") for n in joint.teeth)
            kind = ", internal" if any(n.value < 0 for n in joint.teeth) else ""
            return f"links {links} are gears with {teeth} teeth{kind}"
        case Belt():
            return f"a {'crossed ' if joint.crossed else ''}belt runs over links {links}"
        case Contact():
            if joint.at.startswith("@"):
                normal = f"{joint.normal.value:.6g}"
                return f"the profiles of links {links} touch, with the common normal at {normal} deg"
            return f"links {links} touch{where}, with the common normal at {joint.normal.value:.6g} deg"
        case KnownCentre():
            return f"the centre of links {links} is known"
        case Weld():
            return f"links {links} are welded together{where}"
        case _:
            assert_never(joint)


def thread_words(thread: Thread, length: str) -> str:
    """``lead 5 mm, mean radius 10 mm, mu = 0.1``."""
    parts = [f"lead {thread.lead.value:.6g} {length}"]
    parts += [f"mean radius {thread.radius.value:.6g} {length}"] if thread.radius else []
    return ", ".join([*parts, *([f"mu = {thread.mu.value:.6g}"] if thread.mu else [])])


def _along(joint: Guided) -> str:
    guide = joint.guide
    if guide.angle is not None:
        return f", along {guide.angle.value:.6g} deg"
    assert guide.ends is not None
    a, b = guide.ends
    return f", along {a}{b}" if len(a) == len(b) == 1 else f", along {a}-{b}"


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


def normal_words(joint: Sliding) -> str:
    """The line on which the centre of two surfaces lies."""
    return "normal to the slot" if isinstance(joint, Guided) else "common normal"


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
        "the position as written. Vary a load, or put joints in its place that describe the profile."
    )


def why_no_acceleration(joint: Joint) -> str:
    """The refusal of accelerations at a joint that is known in one position only."""
    name, why = "contact", "nothing says how its profiles curve"
    if joint.stands_in:
        name, why = "centre", "it stands for joints that the case does not show. Give those"
    return f"the {name} of links {listed(joint.links)} has no acceleration: {why}."
