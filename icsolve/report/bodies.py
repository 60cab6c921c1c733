"""What is told of free bodies, in the plane and in space, as lines of text."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from icsolve.answer import Answer
from icsolve.answer.bodies import FrictionFound, Reaction, Rubbing, Witness
from icsolve.case import Units

if TYPE_CHECKING:
    from icsolve.answer.space import Parts, Spatial, SpatialReaction

Format = Callable[[float], str]
Table = Callable[..., list[str]]


def bodies_lines(answer: Answer, show: Format, table: Table) -> list[str]:
    """Reactions, friction, and the unknown loads by free bodies."""
    if answer.spatial is not None:
        return space_lines(answer, answer.spatial, show, table)
    blocks = [reaction_lines(answer, show, table), tension_lines(answer, show, table)]
    if answer.friction is not None:
        blocks.append(friction_lines(answer.friction, answer.case.units, show, table))
    blocks.append(witness_table(answer.witnesses, show))
    return "\n\n".join("\n".join(lines) for lines in blocks if lines).splitlines()


def reaction_lines(answer: Answer, show: Format, table: Table) -> list[str]:
    """A line for each joint: components, size and direction, couple."""
    if not answer.reactions:
        return []
    couples = any(reaction.moment for reaction in answer.reactions.values())
    rows = [(name, *_columns(reaction, show)) for name, reaction in answer.reactions.items()]
    return [_title(answer.case.units, couples), *table(*(list(column) for column in zip(*rows, strict=True)))]


def _title(units: Units, couples: bool) -> str:
    unit = f"{units.force}; couples in {units.torque}" if couples else units.force
    return f"Reactions, {unit}: the force of the first link on the second"


def space_lines(answer: Answer, spatial: Spatial, show: Format, table: Table) -> list[str]:
    """A line for each joint in space: components, size, couple and shares; then the witness."""
    couples = any(map(_has_couple, spatial.reactions.values()))
    rows = [(name, _triple(r.force, show), _shares(r, show)) for name, r in spatial.reactions.items()]
    title = f"{_title(answer.case.units, couples)}, along x, y, z"
    lines = [title, *table(*(list(column) for column in zip(*rows, strict=True)))]
    return [*lines, "", *witness_table(spatial.witnesses, show)] if spatial.witnesses else lines


def _triple(parts: Parts, show: Format) -> str:
    return f"({', '.join(_number(part, show) for part in parts)})"


def _has_couple(reaction: SpatialReaction) -> bool:
    return any(part is None or part != 0.0 for part in reaction.couple)


def _shares(reaction: SpatialReaction, show: Format) -> str:
    size = "" if reaction.magnitude is None else f"= {show(reaction.magnitude)}; "
    couple = f", couple {_triple(reaction.couple, show)}" if _has_couple(reaction) else ""
    parts = "".join(f", {name} {_number(part, show)}" for name, part in reaction.parts)
    return f"{size}{reaction.kind} at {reaction.where}{couple}{parts}"


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


def witness_table(witnesses: Sequence[Witness], show: Format) -> list[str]:
    """A line for each unknown load, in the plane and in space."""
    lines = [
        f"  {w.load} = {show(w.bodies)}, by power {show(w.power)}: {_difference_in_words(w.difference)}, "
        f"{_rounding(w.bound)}"
        for w in witnesses
    ]
    return ["By the equilibrium of the links alone", *lines] if lines else []


def _difference_in_words(difference: float) -> str:
    return f"{abs(difference):.1e} apart" if difference else "no difference"


def _rounding(bound: float) -> str:
    return f"rounding may make {bound:.1e}" if math.isfinite(bound) else "with no bound on the rounding"
