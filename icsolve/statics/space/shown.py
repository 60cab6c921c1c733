"""An answer in space: senses, terms of the power equation, JSON, and lines of text."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer, Term
from icsolve.answer.space import Parts, Reaction
from icsolve.case import Case, Spring, Toward, Weight
from icsolve.case.space import Along, Force, Line, Load, Torque, TorqueVector, Vector
from icsolve.statics.shown import witness_table
from icsolve.statics.space.loading import Wrenched
from icsolve.statics.space.motions import Twist, power_of
from icsolve.statics.space.vectors import unit
from icsolve.statics.space.words import direction_words

if TYPE_CHECKING:
    from icsolve.answer.space import Spatial

Format = Callable[[float], str]
Table = Callable[..., list[str]]


def unit_of(load: Load, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    match load:
        case Torque() | TorqueVector():
            return case.units.torque
        case Weight(mass=True):
            return "kg"
        case Spring():
            return f"{case.units.force}/{case.units.length}"
    return case.units.force


def sense_of(w: Wrenched, value: float) -> str:
    """Sense of an unknown load: ``along -z``, ``about x``, ``toward A``, ``pull``; '' for zero."""
    if value == 0.0:
        return ""
    forth = value > 0.0
    match w.load:
        case Spring():
            return "pull" if forth == (w.gain > 0.0) else "push"
        case Weight():
            return "down" if forth else "up"
        case Torque(heading=Along() | Vector() | Line() as heading):
            return f"about {_heading_words(heading, forth)}"
        case Force(heading=Along() | Vector() | Line() as heading):
            return f"along {_heading_words(heading, forth)}"
        case Force(heading=Toward() as toward):
            drawn = forth != toward.away
            if w.load.against is not None:
                return "pull" if drawn else "push"
            return f"{'toward' if drawn else 'away from'} {toward.point}"
    return ""


def _heading_words(heading: Along | Vector | Line, forth: bool) -> str:
    """``-z``; ``A to B``; the components of the unit vector."""
    match heading:
        case Along(word):
            return word if forth else word[1:] if word[0] == "-" else f"-{word}"
        case Line(a, b):
            return f"{a} to {b}" if forth else f"{b} to {a}"
        case Vector(x, y, z):
            sign = 1.0 if forth else -1.0
            return direction_words(unit((sign * x.value, sign * y.value, sign * z.value)))


def terms_of(
    case: Case, loads: Sequence[Wrenched], motions: Sequence[Mapping[str, Twist]], values: Mapping[str, float]
) -> tuple[Term, ...]:
    """The sum of power, for the motion in which the one unknown load moves at 1 (length or rad a second)."""
    unknown = [w for w in loads if w.known is None]
    if len({w.root for w in unknown}) != 1:
        return ()
    powers = [[power_of(w, motion).value for w in loads] for motion in motions]
    ones = [sum(p for p, w in zip(row, loads, strict=True) if w.known is None) for row in powers]
    most = max(range(len(ones)), key=lambda m: abs(ones[m]))
    turns = isinstance(next(w for w in unknown if w.load.name == w.root).load, Torque)
    whole = ones[most] * (case.units.torque_per_force_length if turns else 1.0)
    terms = []
    for w, power in zip(loads, powers[most], strict=True):
        factor = power / w.ratio / whole if w.ratio else 0.0
        name, value = w.load.name, values[w.load.name]
        words = f"{name} on link {w.load.link}" + _at(w.load)
        unit_name, is_asked = unit_of(w.load, case), w.known is None
        terms.append(Term(name, w.load.link, value, unit_name, factor, value * factor, is_asked, words))
    return tuple(terms)


def _at(load: Load) -> str:
    at = getattr(load, "at", "@")
    return "" if at.startswith("@") else f" at {at}"


def advantage_of(loads: Sequence[Wrenched], values: Mapping[str, float]) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    found = [w.load.name for w in loads if w.known is None]
    known = [w.load.name for w in loads if w.known is not None]
    if len(found) != 1 or len(known) != 1 or values[known[0]] == 0.0:
        return None
    return values[found[0]] / values[known[0]]


def space_dict(spatial: Spatial) -> dict[str, Any]:
    """``reactions`` and ``free_bodies`` of the JSON object."""
    shown: dict[str, Any] = {"reactions": {name: _reaction(r) for name, r in spatial.reactions.items()}}
    if spatial.witnesses:
        shown["free_bodies"] = {w.load: dict(list(w._asdict().items())[1:]) for w in spatial.witnesses}
    return shown


def _reaction(reaction: Reaction) -> dict[str, Any]:
    x, y, z = reaction.force
    entry: dict[str, Any] = {
        "x": x,
        "y": y,
        "z": z,
        "at": list(reaction.at),
        "moment": list(reaction.couple),
        "magnitude": reaction.magnitude,
        "joint": reaction.kind,
        **dict(reaction.parts),
    }
    return {**entry, "undetermined": reaction.why} if reaction.why else entry


def space_lines(answer: Answer, spatial: Spatial, show: Format, table: Table) -> list[str]:
    """A line for each joint: components, size, couple and shares; then the witness."""
    units = answer.case.units
    rows = [(name, _triple(r.force, show), _rest(r, show)) for name, r in spatial.reactions.items()]
    couples = f"; couples in {units.torque}" if any(map(_has_couple, spatial.reactions.values())) else ""
    title = f"Reactions, {units.force}{couples}: the force of the first link on the second, along x, y, z"
    columns = (list(column) for column in zip(*rows, strict=True))
    lines = [title, *table(*columns)]
    return [*lines, "", *witness_table(spatial.witnesses, show)] if spatial.witnesses else lines


def _triple(parts: Parts, show: Format) -> str:
    return f"({', '.join('?' if part is None else show(part) for part in parts)})"


def _has_couple(reaction: Reaction) -> bool:
    return any(part is None or part != 0.0 for part in reaction.couple)


def _rest(reaction: Reaction, show: Format) -> str:
    size = "" if reaction.magnitude is None else f"= {show(reaction.magnitude)}; "
    couple = f", couple {_triple(reaction.couple, show)}" if _has_couple(reaction) else ""
    parts = "".join(f", {name} {'?' if p is None else show(p)}" for name, p in reaction.parts)
    return f"{size}{reaction.kind} at {reaction.where}{couple}{parts}"
