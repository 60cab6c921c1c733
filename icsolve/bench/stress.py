"""The stress catalogue: scenes that break solvers, each with the verdict that a correct one gives."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from icsolve.answer import Answer, Centre
from icsolve.case import Pair
from icsolve.errors import CaseError, SceneError
from icsolve.tuples import NamedTuple

UNREADABLE = "unreadable"
"""The word for a case that the reader refuses."""


class TrueValue(NamedTuple):
    """An unknown load: its value, how near it must come (a fraction), the largest bound that will do."""

    value: float
    within: float = 1e-12
    error: float = math.inf


class StressQuestion(NamedTuple):
    """A verdict: one of the ``status`` words, values and centres, and what the sentences must say.

    ``centres`` are ``(x, y)``, a direction in degrees, or the word of a centre without a place.
    ``says`` are parts of the refusal's message, or of the notes that the answer carries.
    """

    status: tuple[str, ...] = ("ok",)
    values: Mapping[str, TrueValue] = {}
    centres: Mapping[Pair, tuple[float, float] | float | str] = {}
    rates: Mapping[str, float] = {}
    says: tuple[str, ...] = ()
    by: str = ""
    """the way in which at least one centre must have been found"""

    def __str__(self) -> str:
        parts = [" or ".join(self.status)]
        parts += [f"{name} = {asked.value:.6g}" for name, asked in self.values.items()]
        parts += [f"centre {i}-{j} {place}" for (i, j), place in self.centres.items()]
        parts += [f"w{link} = {rate:.6g}" for link, rate in self.rates.items()]
        parts += [f'"{words}"' for words in self.says]
        return ", ".join(parts + ([f"a centre by {self.by}"] if self.by else []))


class TurnedScene(NamedTuple):
    """A sweep: one number from ``first`` by whole ``step`` over ``rows`` rows; ``status`` where it is
    not ok, by the value of that number."""

    path: str
    first: int
    step: int
    rows: int
    status: Mapping[int, str]


class Stress(NamedTuple):
    """One scene of the catalogue: its number (letters where one has several), what it is, and the verdict.

    With ``turned`` the verdict is that of every row of a sweep.
    """

    number: str
    title: str
    case: str | Callable[[], str]
    asked: StressQuestion
    turned: TurnedScene | None = None


class Judged(NamedTuple):
    """What became of a scene: ``faults`` are empty where the verdict is the one asked."""

    got: str
    faults: tuple[str, ...]
    seconds: float


def refused(*status: str, says: Iterable[str] = ()) -> StressQuestion:
    """A refusal with one of these words, whose message has these parts."""
    return StressQuestion(status, says=tuple(says))


def answered(values: Mapping[str, TrueValue | float], **more: Any) -> StressQuestion:
    """An answer with these values (and centres, rates, notes)."""
    given = {name: v if isinstance(v, TrueValue) else TrueValue(v) for name, v in values.items()}
    return StressQuestion(("ok",), given)._replace(**more)


def judge(stress: Stress) -> Judged:
    """Solve a scene from its text, and compare the verdict with the one asked."""
    text = stress.case if isinstance(stress.case, str) else stress.case()
    start = time.perf_counter()
    try:
        got, faults = (
            _swept(text, stress.turned, stress.asked) if stress.turned else _solved(text, stress.asked)
        )
    except CaseError as error:
        got, faults = _of_refusal(UNREADABLE, str(error), stress.asked)
    except SceneError as error:
        got, faults = _of_refusal(error.status, error.message, stress.asked)
    return Judged(got, tuple(faults), time.perf_counter() - start)


def _solved(text: str, asked: StressQuestion) -> tuple[str, list[str]]:
    from icsolve.read import load
    from icsolve.solve import solve

    answer = solve(load(text), all_centres=bool(asked.by or asked.centres), rates=bool(asked.rates))
    return _of_answer(answer, asked)


def _swept(text: str, turned: TurnedScene, asked: StressQuestion) -> tuple[str, list[str]]:
    """Every row has the status asked, and where it is ok the values asked."""
    from icsolve.read import load
    from icsolve.sweep import sweep

    at = [turned.first + turned.step * k for k in range(turned.rows)]
    made = sweep(load(text), {turned.path: [float(x) for x in at]})
    status = [str(word) for word in made.status]
    meant = [turned.status.get(x, "ok") for x in at]
    faults = [f"row {x}: {got}" for x, got, word in zip(at, status, meant, strict=True) if got != word]
    for name, value in asked.values.items():
        for x, word, got in zip(at, status, made.answers[name], strict=True):
            if word == "ok" and not abs(got - value.value) <= value.within * abs(value.value):
                faults.append(f"row {x}: {name} = {got!r}")
            if word != "ok" and math.isfinite(got):
                faults.append(f"row {x}: {word}, and {name} = {got!r}")
    counts = Counter(status)
    return ", ".join(f"{count} rows {word}" for word, count in counts.items()), faults


def _of_refusal(status: str, message: str, asked: StressQuestion) -> tuple[str, list[str]]:
    faults = [] if status in asked.status else [f"refused as {status}"]
    return f"{status}: {message}", faults + _unsaid(message, asked)


def _unsaid(text: str, asked: StressQuestion) -> list[str]:
    return [f"does not say {words!r}" for words in asked.says if words not in text]


def _of_answer(answer: Answer, asked: StressQuestion) -> tuple[str, list[str]]:
    faults = [] if "ok" in asked.status else ["answered"]
    for name, value in asked.values.items():
        faults += _value_faults(answer, name, value)
    for pair, place in asked.centres.items():
        centre = answer.centres[pair]
        if not _is_there(centre, place):
            faults.append(f"centre {pair[0]}-{pair[1]} is {centre.kind} {centre.place}")
    for link, rate in asked.rates.items():
        found = (answer.rates or {}).get(link)
        if not (isinstance(found, float) and math.isclose(found, rate, rel_tol=1e-9, abs_tol=1e-13)):
            faults.append(f"w{link} = {found}")
    if asked.by and not any(centre.by == asked.by for centre in answer.centres.values()):
        faults.append(f"no centre by {asked.by}")
    return _told(answer), faults + _unsaid(" ".join(answer.notes), asked)


def _value_faults(answer: Answer, name: str, asked: TrueValue) -> list[str]:
    """What is wrong with a value: it, its bound, or that the bound does not hold."""
    value, error = answer.answers[name].value, answer.answers[name].error
    off = abs(value - asked.value)
    faults = [] if off <= asked.within * abs(asked.value) else [f"{name} = {value!r}"]
    if error is None or not error <= asked.error:
        faults.append(f"bound of {name} {error}")
    elif off > error + math.ulp(asked.value):
        faults.append(f"{name} is {off:.2g} off, beyond its bound {error:.2g}")
    return faults


def _is_there(centre: Centre, place: tuple[float, float] | float | str) -> bool:
    if isinstance(place, str):
        return centre.kind == place
    if isinstance(place, float):
        turned = abs(centre.place[0] - place) if centre.kind == "toward" else math.inf
        return min(turned, abs(180.0 - turned)) <= 1e-9
    return centre.kind == "at" and math.dist(centre.place, place) <= 1e-9 * max(1.0, *map(abs, place))


def _told(answer: Answer) -> str:
    parts = [answer.status]
    for name, found in answer.answers.items():
        bound = f" +- {found.error:.1g}" if found.error is not None else ""
        parts.append(f"{name} = {found.value:.6g}{bound}")
    return ", ".join(parts) + (": " + " ".join(answer.notes) if answer.notes else "")
