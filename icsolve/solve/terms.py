"""The sum of power as it is printed: one term a load, and the ratio of the unknown to the known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from icsolve.answer import Term
from icsolve.assembly import Frame
from icsolve.case import Case
from icsolve.kinematics.speeds import Speed
from icsolve.solve.bounds import Value
from icsolve.statics.power import Balance, Wrench, known_value
from icsolve.wording.senses import unit_of
from icsolve.wording.sentences import link_words


def load_values(balance: Balance, unknowns: Mapping[str, Value]) -> dict[str, float]:
    """The number of every load, known or found, in its own unit."""
    values = {}
    for w in balance.wrenches:
        known = known_value(w)
        if known is None:
            known = unknowns[w.root].value if w.root in unknowns else 0.0
        values[w.load.name] = float(w.ratio) * known + 0.0
    return values


def power_terms(
    case: Case, frame: Frame, balance: Balance, values: dict[str, float], speed: Speed
) -> Iterable[Term]:
    """One term a load, for the motion that is printed."""
    motions = range(len(balance.factors))
    for n, w in enumerate(balance.wrenches):
        row = [float(balance.factors[m][n]) for m in motions]
        size = max(balance.sizes[m][n] for m in motions)
        factor = speed.particular_of(row, size) * (w.measure / frame.scale)
        value, name = values[w.load.name], w.load.name
        unknown = known_value(w) is None
        unit = unit_of(w.load, case)
        yield Term(name, w.load.link, value, unit, factor, value * factor, unknown, _where(case, w))


def _where(case: Case, w: Wrench) -> str:
    at = getattr(w.load, "at", "@")
    where = f"{w.load.name} on {link_words(w.load.link)}" + ("" if at.startswith("@") else f" at {at}")
    return where if w.against == case.ground else f"{where} against link {w.against}"


def advantage(balance: Balance, values: dict[str, float], unknowns: Mapping[str, Value]) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    found = [w.load.name for w in balance.wrenches if w.root in unknowns]
    known = [w.load.name for w in balance.wrenches if w.root not in unknowns]
    if len(found) != 1 or len(known) != 1 or values[known[0]] == 0.0:
        return None
    return values[found[0]] / values[known[0]]
