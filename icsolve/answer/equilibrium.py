"""Positions of equilibrium as frozen values: where a mechanism rests under loads that are all known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.answer import Answer

Held = float | tuple[float, float]
"""A value of a free datum, or with friction the range in which the mechanism holds still."""


class Stiffness(NamedTuple):
    """Minus the derivative of the generalised load by the free datum, and the bound of its error.

    Of two free data ``value`` and ``unit`` are matrices in their order.
    """

    value: Any
    unit: Any
    error: float | None


class EquilibriumPosition(NamedTuple):
    """One position: the free data by their paths, how surely, and what becomes of a small push.

    ``stability`` is ``stable``, ``unstable`` or ``neutral``; None with friction, which holds over a range.
    ``why`` says why there is no stiffness. ``answer`` is the scene in the position.
    """

    at: Mapping[str, Held]
    error: Mapping[str, Any]
    stability: str | None
    stiffness: Stiffness | None
    why: str
    answer: Answer


def position_dict(position: EquilibriumPosition) -> dict[str, Any]:
    """The object of a position under ``positions``; what was asked of the scene stands beside."""
    entry: dict[str, Any] = {
        "at": {path: _held(value) for path, value in position.at.items()},
        "error": {path: _held(value) for path, value in position.error.items()},
    }
    if position.stability is not None:
        entry |= stability_dict(position.stability, position.stiffness, position.why)
    scene = position.answer.to_dict()
    entry["points"] = scene["points"]
    asked = ("centres", "rates", "velocities", "reactions")
    return entry | {key: scene[key] for key in asked if key in scene and (key != "centres" or scene[key])}


def stability_dict(stability: str, stiffness: Stiffness | None, why: str) -> dict[str, Any]:
    """Stability and stiffness, which is null where ``why`` says so."""
    if stiffness is None:
        return {"stability": stability, "stiffness": None, "why": why}
    return {
        "stability": stability,
        "stiffness": {"value": stiffness.value, "unit": stiffness.unit, "error": stiffness.error},
    }


def _held(value: Any) -> Any:
    return {"from": value[0] + 0.0, "to": value[1] + 0.0} if isinstance(value, tuple) else value + 0.0
