"""The sum of power as it is printed: one term a load, and the ratio of the unknown to the known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from icsolve.answer import Term
from icsolve.case import Case, ForceVector, Number
from icsolve.kinematics.speeds import Speed
from icsolve.numbers.arithmetic import Arithmetic, Scalar
from icsolve.scene.bounds import Evaluation
from icsolve.statics.power import Wrench, known_value, vector_size
from icsolve.wording.senses import unit_of
from icsolve.wording.sentences import link_words


def load_value(w: Wrench, values: Mapping[str, Scalar], a: Arithmetic) -> Scalar:
    """The number of a load, known or found (``values``, by the load that has it), in its own unit."""
    if w.root in values:
        return w.ratio * values[w.root]
    if isinstance(w.source, ForceVector):
        return w.ratio * vector_size(w.source)
    return w.ratio * (a.given(w.source.value) if isinstance(w.source.value, Number) else 0.0)


def power_terms(found: Evaluation, values: Mapping[str, Scalar], speed: Speed) -> Iterable[Term]:
    """One term a load, for the motion that is printed."""
    case, frame, balance = found.program.case, found.program.figure.frame, found.outcome.balance
    a, motions = found.arithmetic, range(len(balance.factors))
    for n, w in enumerate(balance.wrenches):
        row = [balance.factors[m][n] for m in motions]
        per = w.measure / frame.scale
        size = max(balance.sizes[m][n] for m in motions)
        factor = speed.particular_of(row, size) * per
        value = load_value(w, values, a)
        unknown = known_value(w) is None
        power, _ = a.rounded(value * factor, abs(value) * size * per / abs(speed.divisor))
        numbers = a.rounded(value)[0], unit_of(w.load, case), a.rounded(factor)[0], power
        yield Term(w.load.name, w.load.link, *numbers, unknown, _where(case, w))


def _where(case: Case, w: Wrench) -> str:
    at = getattr(w.load, "at", "@")
    where = f"{w.load.name} on {link_words(w.load.link)}" + ("" if at.startswith("@") else f" at {at}")
    return where if w.against == case.ground else f"{where} against link {w.against}"


def advantage(found: Evaluation, values: Mapping[str, Scalar]) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    wrenches = found.outcome.balance.wrenches
    ours = [w for w in wrenches if w.root in values]
    known = [w for w in wrenches if w.root not in values]
    if len(ours) != 1 or len(known) != 1:
        return None
    a = found.arithmetic
    above, below = (load_value(w, values, a) for w in (*ours, *known))
    return None if below == 0.0 else a.rounded(above / below)[0]
