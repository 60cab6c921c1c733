"""Reactions, their witness and friction as lines of text."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from icsolve.answer import Answer
from icsolve.answer.bodies import FrictionFound, Reaction, Rubbing, Witness
from icsolve.case import Units

Format = Callable[[float], str]
Table = Callable[..., list[str]]


def bodies_lines(answer: Answer, show: Format, table: Table) -> list[str]:
    """Reactions, friction, and the unknown loads by free bodies."""
    blocks = [reaction_lines(answer, show, table), tension_lines(answer, show, table)]
    if answer.friction is not None:
        blocks.append(friction_lines(answer.friction, answer.case.units, show, table))
    blocks.append(witness_lines(answer, show))
    return "\n\n".join("\n".join(lines) for lines in blocks if lines).splitlines()


def reaction_lines(answer: Answer, show: Format, table: Table) -> list[str]:
    """A line for each joint: components, size and direction, couple."""
    if not answer.reactions:
        return []
    units = answer.case.units
    rows = [(name, *_columns(reaction, show)) for name, reaction in answer.reactions.items()]
    couples = f"; couples in {units.torque}" if any(r.moment for r in answer.reactions.values()) else ""
    title = f"Reactions, {units.force}{couples}: the force of the first link on the second"
    return [title, *table(*(list(column) for column in zip(*rows, strict=True)))]


def tension_lines(answer: Answer, show: Format, table: Table) -> list[str]:
    """A line for each rope: its pull, or that of each of its parts."""
    if not answer.tensions:
        return []
    pulls = [tension.parts or (tension.tension,) for tension in answer.tensions]
    values = [", ".join(_number(pull, show) for pull in each) for each in pulls]
    lines = table([tension.name for tension in answer.tensions], values)
    return [f"Pulls of ropes, {answer.case.units.force}", *lines]


def _columns(reaction: Reaction, show: Format) -> tuple[str, str, str]:
    """The force by components, by size and direction, and what goes with it."""
    force = f"({_number(reaction.x, show)}, {_number(reaction.y, show)})"
    size = "" if reaction.magnitude is None else f"= {show(reaction.magnitude)}"
    if reaction.direction is not None:
        size += f" at {show(reaction.direction)} deg"
    return force, size, _rest(reaction, show)


def _rest(reaction: Reaction, show: Format) -> str:
    place = f"{reaction.kind} at {reaction.where}" if reaction.where else reaction.kind
    couple = "" if reaction.moment == 0.0 else f", couple {_number(reaction.moment, show)}"
    parts = "".join(f", {name} {show(value)}" for name, value in reaction.parts if value)
    return f"{place}{couple}{parts}"


def friction_lines(friction: FrictionFound, units: Units, show: Format, table: Table) -> list[str]:
    """A line for each rub, what friction takes, and the efficiency."""
    rows = [_rub(rub, units, show) for rub in friction.rubbing]
    lines = ["Friction", *table(*(list(column) for column in zip(*rows, strict=True)))] if rows else []
    if friction.efficiency is not None:
        lines.append(f"Efficiency {show(100.0 * friction.efficiency)} % (power out over power in)")
    return lines


def _rub(rub: Rubbing, units: Units, show: Format) -> tuple[str, str, str]:
    place = f"{rub.kind} {rub.joint[1:]}" + (f" at {rub.where}" if rub.where else "")
    unit = units.torque if rub.kind == "pin" else units.force
    circle = f", friction circle {show(rub.radius)} {units.length}" if rub.radius is not None else ""
    loss = show(rub.loss * units.torque_per_force_length)
    return place, f"{show(abs(rub.value))} {unit}", f"takes {loss} {units.torque}/s{circle}"


def _number(value: float | None, show: Format) -> str:
    return "?" if value is None else show(value)


def witness_lines(answer: Answer, show: Format) -> list[str]:
    """What free bodies make of the unknown loads, beside power."""
    return witness_table(answer.witnesses, show)


def witness_table(witnesses: Sequence[Witness], show: Format) -> list[str]:
    """A line for each unknown load, in the plane and in space."""
    lines = [
        f"  {w.load} = {show(w.bodies)}, by power {show(w.power)}: {_apart(w.difference)}, "
        f"{_rounding(w.bound)}"
        for w in witnesses
    ]
    return ["By the equilibrium of the links alone", *lines] if lines else []


def _apart(difference: float) -> str:
    return f"{abs(difference):.1e} apart" if difference else "no difference"


def _rounding(bound: float) -> str:
    return f"rounding may make {bound:.1e}" if math.isfinite(bound) else "with no bound on the rounding"
