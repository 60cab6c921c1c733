"""Friction in the worked solution: the rule at each joint that rubs, and its loads in the sum of power."""

from __future__ import annotations

import math
from collections.abc import Iterable

from icsolve.answer.bodies import Rubbing
from icsolve.case import Joint
from icsolve.case.joints import Friction
from icsolve.explain.document import Block, Items, Section, formula, words
from icsolve.explain.formula import Name, Trig, product
from icsolve.explain.worked import Worked
from icsolve.report.derivation.known import Known
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import listed

FRICTION = "friction "
"""How terms of the sum of power begin that are those of friction."""


class Rubbed(NamedTuple):
    """Friction at a joint as a load of the sum of power: its number, its rate or speed of rubbing while the
    reference moves at 1, and their product in the unit of the equation."""

    name: Name
    words: str
    value: float
    unit: str
    rate: float
    power: float


def rubbed(known: Known, reference: str) -> list[Rubbed]:
    """The friction at all joints that rub, while ``reference`` moves at 1."""
    answer, units = known.answer, known.case.units
    if answer is None:
        return []
    x, y, w = known.twists[reference]
    turns = known.turns(reference)
    speed = w if turns else math.hypot(x, y)
    if not speed:  # what the motion is told by stands still as written
        return []
    found = []
    for term in answer.terms:
        if not term.load.startswith(FRICTION):
            continue
        torque = term.unit == units.torque
        rate = term.factor * (units.torque_per_force_length if torque else 1.0) / speed
        power = term.value * term.factor / speed * (units.torque_per_force_length if turns else 1.0)
        low = term.load.removeprefix(FRICTION).rsplit(" at ", 1)[0]
        name = Name("L", low.removeprefix("F").removeprefix("T "))
        what = term.words.removesuffix(" in the rope").replace("friction T ", "friction of the rope ")
        said = f"{what[:1].upper()}{what[1:]}"
        found.append(Rubbed(name, said, term.value, term.unit, rate, power))
    return found


def friction_section(work: Worked) -> Iterable[Section]:
    """The rule at each joint that rubs: friction circles of pins, friction angles of guides; then what they
    come to in this position."""
    rules = [block for joint in work.case.joints for block in _rule(work, joint)]
    if not rules:
        return
    blocks: list[Block] = [words(RULE), *rules]
    friction = None if work.answer is None else work.answer.friction
    if friction is not None and friction.rubbing:
        blocks += [words("With the equations of equilibrium of all links (below) these give:")]
        blocks += [Items(tuple((_rubs(work, one),) for one in friction.rubbing))]
    yield Section("Friction", tuple(blocks))


RULE = (
    "Where a joint rubs, its force leans against the motion by the angle phi, with tan phi = mu. In a pin of "
    "radius r it is then tangent to the friction circle, of radius r sin phi about the pin; on a guide, in a "
    "slot or at a contact it makes phi with the normal."
)


def _rule(work: Worked, joint: Joint) -> Iterable[Block]:
    """The angle of friction at a joint, and the friction circle of a pin."""
    friction: Friction | None = getattr(joint, "friction", None)
    if friction is None or not friction.mu.value:
        return
    at = getattr(joint, "at", "")
    mu = work.number(friction.mu.value)
    phi = math.degrees(math.atan(friction.mu.value))
    links = listed(joint.links)
    yield words(
        f"Links {links} at {at}: tan ", Name("phi"), " = ", mu, ", ", Name("phi"), f" = {phi:.6g} deg."
    )
    if joint.pivot and friction.radius is not None:
        radius = friction.radius.value
        circle = work.distance(radius * math.sin(math.radians(phi)))
        numbers = product(work.number(radius), Trig("sin", work.number(phi)))
        yield formula(product(Name("r", at), Trig("sin", Name("phi"))), numbers, circle)


def _rubs(work: Worked, one: Rubbing) -> str:
    """What friction does at one place."""
    units = work.units
    unit = units.torque if one.kind == "pin" else units.force
    what = "moment about the pin" if one.kind == "pin" else "friction along the guide"
    size = work.show(abs(one.value))
    force = work.answer.reactions.get(one.joint) if work.answer and work.answer.reactions else None
    of = "" if force is None or force.magnitude is None else f" = {work.show(force.magnitude)} {units.force}"
    arm = ""
    if one.radius is not None:
        arm = f", tangent to the circle of radius {work.show(one.radius)} {units.length}"
    return f"{one.joint}{of} at {one.where}{arm}: {what} {size} {unit}"
