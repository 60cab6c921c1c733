"""The sums of power with the losses of friction counted, apart from the equilibrium of the links."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.answer import Term
from icsolve.answer.bodies import Friction
from icsolve.case import Case
from icsolve.numbers.linear import solve_square
from icsolve.statics.agreement import independent
from icsolve.statics.equilibrium import Statics
from icsolve.statics.power import Balance, Wrench, known_value
from icsolve.statics.rubs import rates_of
from icsolve.statics.ties import Position


def unknowns_by_power(
    position: Position, balance: Balance, statics: Statics, friction: Sequence[float]
) -> dict[str, float]:
    """The unknown loads (case units) that leave no power in any motion, with this friction (scaled)."""
    rows = []
    for m, factors in enumerate(balance.factors):
        powers = [_power(w, float(f)) for w, f in zip(balance.wrenches, factors, strict=True)]
        row = [
            sum(p for w, p in zip(balance.wrenches, powers, strict=True) if w.root == root)
            for root in statics.roots
        ]
        known = sum(p for w, p in zip(balance.wrenches, powers, strict=True) if w.root not in statics.roots)
        rates = rates_of(position, statics.ties, statics.rubs, m)
        lost = sum(f * rate for f, rate in zip(friction, rates, strict=True)) / statics.scale
        rows.append([*row, -known - lost])
    chosen = independent(rows, len(statics.roots))
    values = solve_square([row[:-1] for row in chosen], [row[-1] for row in chosen])
    return dict(zip(statics.roots, values or [float("nan")] * len(statics.roots), strict=True))


def _power(w: Wrench, factor: float) -> float:
    """Power of a load (of one unit of it, if unknown) in a motion."""
    value = known_value(w)
    return (1.0 if value is None else value) * float(w.ratio) * factor * w.measure


def efficiency(terms: Sequence[Term]) -> float | None:
    """Power that comes out of the loads' sum of power, over what goes in; None where nothing goes in."""
    into = sum(term.power for term in terms if term.power > 0.0)
    out = -sum(term.power for term in terms if term.power < 0.0)
    return out / into if into else None


def friction_terms(friction: Friction, case: Case) -> Iterable[Term]:
    """One term of the sum of power for each rub."""
    for rub in friction.rubbing:
        unit = case.units.torque if rub.kind == "pin" else case.units.force
        name = f"friction {rub.joint}" + (f" at {rub.where}" if rub.where else "")
        words = f"{name} in the {rub.kind}"
        link = rub.joint
        factor = -rub.loss / rub.value if rub.value else 0.0
        yield Term(name, link, rub.value, unit, factor, 0.0 - rub.loss, False, words)
