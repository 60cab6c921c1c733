"""An answer as the JSON object of the format, ``icsolve/solve/1``: keys may be added, none goes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from icsolve.case import Case, is_named, pair_name, spot_name
from icsolve.errors import SceneError

if TYPE_CHECKING:
    from icsolve.answer import Answer, Centre, Found, Term
    from icsolve.answer.bodies import (
        FrictionFound,
        Reaction,
        Rubbing,
        Spatial,
        SpatialReaction,
        Tension,
        Witness,
    )

SCHEMA = "icsolve/solve/1"


def to_dict(answer: Answer) -> dict[str, Any]:
    """The object that ``icsolve solve --json`` prints for a case.

    Values are in case units, rates in rad/s, velocities in length units a second, angles in
    degrees. ``rates`` and ``velocities`` are there where they were asked for. Negative zeros
    become zeros, so that equal answers print equal bytes.
    """
    case = answer.case
    return {
        "schema": SCHEMA,
        "case": case.name,
        "status": answer.status,
        **_header(case),
        "answers": {name: _found(found) for name, found in answer.answers.items()},
        "centres": {pair_name(case, pair): _centre(case, c) for pair, c in answer.centres.items()},
        **_motion(answer),
        **_contacts(answer),
        **_bodies(answer),
        **_equilibrium(answer),
        "points": {name: _numbers(place) for name, place in _places(answer).items()},
        "errors": _errors(answer),
        "advantage": None if answer.advantage is None else _plain(answer.advantage),
        "mobility": answer.mobility,
        **({} if answer.holds_still is None else {"holds_still": answer.holds_still}),
        "terms": [_term(term) for term in answer.terms],
        "notes": list(answer.notes),
        "skipped": list(answer.skipped),
    }


def refusal_dict(name: str, error: SceneError, schema: str = SCHEMA) -> dict[str, Any]:
    """The object of a case that was read but has no answer."""
    return {"schema": schema, "case": name, "status": error.status, "message": error.message, **error.more}


def _plain(value: float) -> float:
    """The number itself; a negative zero becomes zero."""
    return value + 0.0


def _numbers(values: tuple[float, ...]) -> list[float]:
    return [_plain(value) for value in values]


def _header(case: Case) -> dict[str, str]:
    """Title, and the warning that a reconstruction carries wherever it is shown."""
    shown = {"title": case.title, "reconstructed": case.reconstructed}
    return {key: text for key, text in shown.items() if text}


def _found(found: Found) -> dict[str, Any]:
    if found.holds is not None:
        ends = [_plain(end) if math.isfinite(end) else None for end in found.holds]
        held: dict[str, Any] = {"value": None, "holds": ends, "self_locking": found.self_locking}
        return {**held, "unit": found.unit, "sense": "", **_bound(found)}
    entry: dict[str, Any] = {"value": _plain(found.value), "unit": found.unit, "sense": found.sense}
    if found.components is not None:
        entry |= {"direction": found.direction, **dict(zip("xy", _numbers(found.components), strict=True))}
    return {**entry, **_bound(found)}


def _bound(found: Found) -> dict[str, Any]:
    """The bound of the error, or why there is none; one beyond all numbers is none."""
    if found.error is None:
        return {"error": None, "why": found.why}
    if not math.isfinite(found.error):
        return {"error": None, "why": "the bound of the rounding error is beyond all numbers"}
    return {"error": found.error}


def _finite(errors: Any) -> Any:
    """Errors by name, each None where it is beyond all numbers."""
    if isinstance(errors, Mapping):
        return {name: _finite(error) for name, error in errors.items()}
    if isinstance(errors, tuple):
        return [*map(_finite, errors)]
    return errors if not isinstance(errors, float) or math.isfinite(errors) else None


def _centre(case: Case, centre: Centre) -> dict[str, Any]:
    entry: dict[str, Any] = {centre.kind: _place(centre)}
    if centre.by:
        entry["by"] = centre.by
    if centre.lines:
        entry["lines"] = [[pair_name(case, pair) for pair in line] for line in centre.lines]
    return entry


def _place(centre: Centre) -> list[float] | float | str:
    if centre.kind == "at":
        return _numbers(centre.place)
    if centre.kind == "toward":
        return _plain(centre.place[0])
    return centre.why


def _motion(answer: Answer) -> dict[str, Any]:
    shown: dict[str, Any] = {}
    if answer.rates is not None:
        shown["rates"] = {link: _rate(rate) for link, rate in answer.rates.items()}
    if answer.velocities is not None:
        shown["velocities"] = {
            spot_name(spot): _velocity(velocity)
            for spot, velocity in answer.velocities.items()
            if is_named(spot[0])
        }
    if answer.angular_accelerations is not None:
        rates = answer.angular_accelerations.items()
        shown["angular_accelerations"] = {link: _rate(rate) for link, rate in rates}
    if answer.accelerations is not None:
        points = answer.accelerations.items()
        shown["accelerations"] = {spot_name(spot): _velocity(one) for spot, one in points}
    return shown


def _contacts(answer: Answer) -> dict[str, Any]:
    """The contacts that profiles gave, by their links."""
    if not answer.touching:
        return {}
    shown = {"-".join(one.links): one._asdict() for one in answer.touching}
    return {"contacts": {name: {k: v for k, v in one.items() if k != "links"} for name, one in shown.items()}}


def _places(answer: Answer) -> Mapping[str, tuple[float, ...]]:
    """The points to show; of a case in space they have three coordinates."""
    return answer.shown_points if answer.spatial is None else answer.spatial.points


def _bodies(answer: Answer) -> dict[str, Any]:
    """Reactions and friction, where there are some."""
    if answer.spatial is not None:
        return _space_dict(answer.spatial)
    if answer.reactions is None and answer.friction is None:
        return {}

    return _bodies_dict(answer)


def _equilibrium(answer: Answer) -> dict[str, Any]:
    """Positions of equilibrium, or the stability of the position as written."""
    if answer.positions is None and answer.stability is None:
        return {}
    from icsolve.answer.equilibrium import position_dict, stability_dict

    if answer.positions is not None:
        return {"positions": [position_dict(position) for position in answer.positions]}
    assert answer.stability is not None
    return stability_dict(answer.stability, answer.stiffness, answer.why_no_stiffness)


def _rate(rate: float | str) -> float | dict[str, str]:
    return {"undetermined": rate} if isinstance(rate, str) else _plain(rate)


def _velocity(velocity: tuple[float, float] | str) -> list[float] | dict[str, str]:
    return {"undetermined": velocity} if isinstance(velocity, str) else _numbers(velocity)


def _errors(answer: Answer) -> dict[str, Any]:
    case = answer.case
    known = {pair_name(case, pair): c.error for pair, c in answer.centres.items() if c.error is not None}
    named = {
        kind: {
            spot_name(key): error
            for key, error in by.items()
            if is_named(key if isinstance(key, str) else key[0])
        }
        for kind, by in {**answer.errors, "centres": known}.items()
    }
    return {kind: _finite(by) for kind, by in named.items() if by}


def _term(term: Term) -> dict[str, Any]:
    numbers = {"value": term.value, "factor": term.factor, "power": term.power}
    return {**term._asdict(), **{key: _plain(number) for key, number in numbers.items()}}


def _bodies_dict(answer: Answer) -> dict[str, Any]:
    """``reactions`` and ``free_bodies`` where they were asked for, ``friction`` where there is some."""
    shown: dict[str, Any] = {}
    if answer.reactions is not None:
        shown["reactions"] = {name: _reaction(reaction) for name, reaction in answer.reactions.items()}
        shown["reactions"] |= {tension.name: _tension(tension) for tension in answer.tensions}
    if answer.witnesses:
        shown["free_bodies"] = {w.load: _witness_dict(w) for w in answer.witnesses}
    if answer.friction is not None:
        shown["efficiency"] = answer.friction.efficiency
        shown["friction"] = _friction(answer.friction)
    return shown


def _witness_dict(w: Witness) -> dict[str, float | None]:
    """An unknown load both ways; the bound of their difference is null where nothing bounds it."""
    bound = w.bound if math.isfinite(w.bound) else None
    return {"power": w.power, "bodies": w.bodies, "difference": w.difference, "bound": bound}


def _reaction(reaction: Reaction) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "x": reaction.x,
        "y": reaction.y,
        "at": [reaction.at[0] + 0.0, reaction.at[1] + 0.0],
        "moment": reaction.moment,
        "magnitude": reaction.magnitude,
        "direction": reaction.direction,
        "joint": reaction.kind,
        **{name.replace(" ", "_"): value for name, value in reaction.parts},
    }
    if reaction.errors:
        entry["errors"] = dict(reaction.errors)
    if None in (reaction.x, reaction.y, reaction.moment):
        entry["undetermined"] = reaction.why
    return entry


def _tension(tension: Tension) -> dict[str, Any]:
    entry: dict[str, Any] = {"tension": tension.tension}
    if tension.error is not None:
        entry["error"] = tension.error
    if tension.parts:
        entry["tensions"] = list(tension.parts)
    return entry if tension.tension is not None else {**entry, "undetermined": tension.why}


def _friction(friction: FrictionFound) -> dict[str, Any]:
    if friction.possible is not None:
        possible, *again = (
            [end if math.isfinite(end) else None for end in one]
            for one in (friction.possible, *friction.again)
        )
        found = {"possible": possible, "how": friction.unique}
        return {**found, "again": again} if again else found
    return {
        "losses": friction.losses,
        "residual": friction.residual,
        "error": friction.error,
        "unique": friction.unique,
        "joints": [_rubbing(rubbing) for rubbing in friction.rubbing],
    }


def _rubbing(rubbing: Rubbing) -> dict[str, Any]:
    return {key: value for key, value in rubbing._asdict().items() if value is not None}


def _space_dict(spatial: Spatial) -> dict[str, Any]:
    """``reactions`` and ``free_bodies`` of the JSON object."""
    shown: dict[str, Any] = {
        "reactions": {name: _reaction_in_space(r) for name, r in spatial.reactions.items()}
    }
    if spatial.witnesses:
        shown["free_bodies"] = {w.load: _witness_dict(w) for w in spatial.witnesses}
    return shown


def _reaction_in_space(reaction: SpatialReaction) -> dict[str, Any]:
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
    if reaction.errors is not None:
        force, couple = reaction.errors
        entry["errors"] = {**dict(zip("xyz", force, strict=True)), "moment": list(couple)}
    return {**entry, "undetermined": reaction.why} if reaction.why else entry
