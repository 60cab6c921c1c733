"""One case with its answer, and the keys of its questions; the names of its quantities, as the name of a
question and as students write them before an answer."""

from __future__ import annotations

import re
from collections.abc import Iterator
from copy import copy
from functools import lru_cache, partial

from icsolve.answer import Answer
from icsolve.case import Case, is_named
from icsolve.case.expected import (
    CentreIs,
    DistanceIs,
    LoadIs,
    OfBodies,
    PositionIs,
    RateIs,
    ReactionIs,
    SpeedIs,
    Target,
    TensionIs,
)
from icsolve.errors import SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import (
    AnyKey,
    NumberKey,
    RangeKey,
    place_key,
    position_key,
    range_key,
    scalar_key,
)
from icsolve.grade.mistakes.engine import WrongAnswers, solved_for
from icsolve.grade.tolerance import NoKeyError
from icsolve.read.expect import target_of
from icsolve.read.names import Problems, parts
from icsolve.read.reading import Reading
from icsolve.statics.power import is_unknown, loads_to_find
from icsolve.tuples import cached_property, replace


@lru_cache(maxsize=256)
def unknowns(case: Case) -> tuple[str, ...]:
    """What a student can be asked for: the unknown loads, those that are like another left out; where every
    load is known the data of the figure that are to find."""
    from icsolve.solve.equilibrium import free_coordinate

    whole = {f"{name}.{axis}": name for name in case.directed for axis in "xy"}
    loads = dict.fromkeys(whole.get(load.name, load.name) for load in case.loads if is_unknown(load))
    if loads or case.unknowns:
        return tuple(loads) or tuple(unknown.path for unknown in case.unknowns)
    free = free_coordinate(case)
    return (free.path,) if free is not None else ()


def final_questions(case: Case, name: str) -> dict[str, str]:
    """The questions for the unknowns of a case, by their one names, each with its unknown."""
    names = unknowns(case)
    return {name if len(names) == 1 else f"{name}:{unknown}": unknown for unknown in names}


def questions_of(case: Case, name: str, course: Course) -> dict[str, str]:
    """What each student is asked of a case, by the names of the questions: its unknowns, and what else the
    course asks by name."""
    more = (question.partition(":") for question in course.own)
    asked = {f"{of}:{what}": what for of, _, what in more if of == name and what}
    return final_questions(case, name) | asked


def folder_of(question: str) -> str:
    """The name of a question where it is a folder, as in PrairieLearn: ``press-w4-w2``."""
    return re.sub("[:/ ]", "-", question)


def asked_of(case: Case, what: str) -> Target:
    """The target of ``T12``, ``I24``, ``w4/w2``; of '' the only unknown.

    Raises NoKeyError, with a sentence, where it names nothing, or the case has not one unknown.
    """
    check_plane(case)
    if not what:
        names = unknowns(case)
        if not names:
            raise NoKeyError(
                f"the case {case.name} has no unknown load; say what is asked, as in {case.name}:w4/w2 or "
                f"{case.name}:F12"
            )
        if len(names) > 1:
            asked = " or ".join(f"{case.name}:{name}" for name in names)
            kind = "unknown data of the figure" if "." in names[0] else "unknown loads"
            raise NoKeyError(f"the case {case.name} has {len(names)} {kind}; write {asked}")
        (what,) = names
    target = target_of(reading_of(case), what, points_of(case))
    if isinstance(target, str):
        raise NoKeyError(f"{case.name}: {target}")
    if isinstance(target, LoadIs) and target.load not in {*unknowns(case), *loads_to_find(case)}:
        raise NoKeyError(f"{case.name}: {what} is given in the case, not asked")
    return target


def check_plane(case: Case) -> None:
    """Raises NoKeyError of a case in space: no answers to it are judged."""
    if case.space is not None:
        raise NoKeyError(f"the case {case.name} is in space, and answers are judged of plane cases")


def canonical(case: Case, name: str, what: str) -> str:
    """The one name of a question."""
    if what.partition(".")[0] in ("angles", "lengths", "points"):
        found = target_of(reading_of(case), what, points_of(case))
        what = found.path if isinstance(found, PositionIs) else what
    return name if not what or unknowns(case) == (what,) else f"{name}:{what}"


class SolvedCase:
    """One case with its answer, and the keys that were asked of it."""

    def __init__(self, case: Case, course: Course, full: bool = False, plain: Answer | None = None) -> None:
        """Solved plainly (``plain`` has that where it is known), or in ``full``. Raises SceneError."""
        self.case = case
        self.course = course
        self.scale = 1.0
        """by what the loads, and so the answers, are larger than in ``answer``"""
        self._answer = solved_for(case) if full else None
        self.plain = self._answer or plain or solved_plainly(case)
        """the answers alone: enough for the key of a load"""
        self._base: SolvedCase | None = None
        self._keys: dict[str, AnyKey] = {}
        self._with_bodies: WrongAnswers | None = None
        """those to what is asked of the forces in joints"""

    @property
    def answer(self) -> Answer:
        """The answers with all centres and rates; solved when it is first asked for."""
        origin = self._base or self
        if origin._answer is None:
            origin._answer = solved_for(self.case)
        return origin._answer

    def scaled(self, factor: float) -> SolvedCase:
        """The same with all loads ``factor`` times as large; it shares what was solved."""
        other = copy(self)
        other.scale, other._base, other._keys = factor, self, {}
        return other

    def key(self, question: str) -> AnyKey:
        """The key of ``case`` or ``case:what``.

        Raises NoKeyError.
        """
        if question not in self._keys:
            try:
                what = question.partition(":")[2] or "".join(unknowns(self.case)[:1])
                target = self.target(question)
                another = lru_cache(partial(is_another, self.case, target, what))
                elsewhere = lru_cache(partial(is_elsewhere, self.case, target))
                made = self._made(question)
                self._keys[question] = replace(made, another=another, elsewhere=elsewhere, name=what)
            except SceneError as error:
                raise NoKeyError(f"{question} has no answer ({error.status}): {error.message}") from None
        return self._keys[question]

    def target(self, question: str) -> Target:
        """What a question asks.

        Raises NoKeyError.
        """
        return asked_of(self.case, question.partition(":")[2])

    def _made(self, question: str) -> AnyKey:
        target = self.target(question)
        if self._base is not None:
            key = self._base.key(question)
            grows = isinstance(target, LoadIs | ReactionIs | TensionIs)  # ratios and places do not
            return key.scaled(self.scale) if grows and isinstance(key, NumberKey | RangeKey) else key
        policy = self.course.policy_of(question, self.case.tolerance)
        if isinstance(target, CentreIs):
            return place_key(question, target, self.answer, policy, self.wrongs.places(target))
        if isinstance(target, PositionIs):
            return position_key(question, target, self.plain, policy, lambda v: self.wrongs.of(target, v))
        if isinstance(target, LoadIs):
            ranged = range_key(question, target, self.plain, policy)
            return ranged or scalar_key(question, target, self.plain, policy, lambda: self.wrongs.of(target))
        if isinstance(target, OfBodies):
            if self._with_bodies is None:
                self._with_bodies = WrongAnswers(solved_for(self.case, target), target)
            bodies = self._with_bodies
            return scalar_key(question, target, bodies.answer, policy, lambda: bodies.of(target))
        own = self.answer if self.answer.rates is not None else solved_for(self.case, target)
        return scalar_key(question, target, own, policy, lambda: self.wrongs.of(target))

    @cached_property
    def wrongs(self) -> WrongAnswers:
        """The wrong answers to whatever is asked of the case."""
        return WrongAnswers(self.answer)


def solved_plainly(case: Case) -> Answer:
    """The answers alone. Raises SceneError."""
    from icsolve.solve import solve

    return solve(case, bound=False)


# --- questions and keys --------------------------------------------------------------------------------


_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789", "_{}^|\\ ")
_SPEED = re.compile(r"omega|ω|^n(?=\d)", re.IGNORECASE)
_ANGLE = re.compile(r"theta|phi|alpha|beta|[θφαβϑϕ]", re.IGNORECASE)
_DATUM = re.compile(r"(?:[A-Z]\d?'?){2,3}")
_CENTRE = re.compile(r"IC(?=\d)", re.IGNORECASE)
_POLE = re.compile(r"[PO](?=\d)")


def reading_of(case: Case) -> Reading:
    """What the reader of keys needs to know of a case."""
    reading = Reading(Problems(case.path), case.units)
    reading.kinds = dict.fromkeys((*case.directed, *(load.name for load in case.loads)), "force")
    reading.unknowns = list(case.unknowns)
    reading.given = set(case.points)
    reading.ropes = {rope.name for rope in case.ropes}
    reading.links = dict.fromkeys(case.links, (1, 1))
    return reading


def points_of(case: Case) -> set[str]:
    """The points that a case names."""
    named = set(case.points) | {p for carried in case.carries.values() for p in carried}
    return {name for name in named if is_named(name)}


def is_another(case: Case, target: Target, what: str, name: str) -> bool:
    """Whether a name is that of another quantity than the target, or one of its kind: ``F43x`` for ``F34x``,
    ``T15`` for ``T12``. A name of no quantity, such as ``x`` or ``answer``, is none.

    ``what`` is what is asked, as the question names it.
    """
    bare, own = name.translate(_LOWERED), what.translate(_LOWERED)
    if bare.casefold() == own.casefold():
        return False
    meant = list(_meant(case, target, bare))
    if meant:
        return not any(_alike(one, target) for one in meant)
    of = [part for part in bare.split("/") if part]
    if len(of) > 1 and any(
        part.casefold() == own.casefold() or any(_meant(case, target, part)) for part in of
    ):
        return True  # a quotient: T12/P, T12/2
    shape, asked = (re.sub(r"\d", "#", text.casefold()) for text in (bare, own))
    return shape == asked and "#" in shape


def is_elsewhere(case: Case, target: Target, name: str) -> bool:
    """Whether what is asked does not act at a link, or a point, of this name: what bears no such name says
    nothing."""
    own = _link_of(case, target)
    if not own:
        return False
    link = case.ground if name.casefold() in ("frame", "ground") and name not in case.links else name
    named = [one for one in case.links if one.casefold() == link.casefold()]
    if named:
        return own not in named
    return isinstance(target, LoadIs) and name in points_of(case) and name not in case.carries.get(own, ())


def _link_of(case: Case, target: Target) -> str:
    """The link on which what is asked acts; '' where it is on none."""
    if isinstance(target, LoadIs):
        return next((load.link for load in case.loads if load.name == target.load), "")
    if isinstance(target, ReactionIs):
        return target.on
    return target.link if isinstance(target, RateIs | SpeedIs) else ""


def _meant(case: Case, target: Target, bare: str) -> Iterator[Target]:
    """What a name says, by the first spelling that says anything; of a place or a datum as it is asked."""
    reading, points = reading_of(case), points_of(case)
    loads = [load for load in reading.kinds if load.translate(_LOWERED).casefold() == bare.casefold()]
    if loads:
        yield from map(LoadIs, loads[:1] if bare not in loads else [bare])
        return
    forms = [bare, _SPEED.sub("w", bare), _CENTRE.sub("I", bare), bare[:1].upper() + bare[1:]]
    forms += [_POLE.sub("I", bare)] if isinstance(target, CentreIs) and bare not in points else []
    forms += ["-".join(parts(bare))] if isinstance(target, DistanceIs) else []
    for form in dict.fromkeys(forms):
        found = target_of(reading, form, points)
        if not isinstance(found, str):
            yield found
            return
    if isinstance(target, PositionIs):
        datum = _ANGLE.sub("", bare)
        if _DATUM.fullmatch(datum):
            section, _, own = target.path.partition(".")
            names = (parts(datum), parts(own))
            same = names[0] == names[1] or (section == "lengths" and sorted(names[0]) == sorted(names[1]))
            yield target if same else PositionIs(f"{section}.{datum}")
    elif bare[:1] in ("v", "V"):
        for point in (point for point in points if bare[1:].startswith(point)):
            link = bare[1 + len(point) :]
            if link in ("", *case.links):
                own_link = target.link if isinstance(target, SpeedIs) else ""
                yield SpeedIs(point, link or own_link)


def _alike(one: Target, other: Target) -> bool:
    """Whether two names are of one quantity: the order of the links of a centre says nothing."""
    if isinstance(one, CentreIs) and isinstance(other, CentreIs):
        return set(one.pair) == set(other.pair)
    if isinstance(one, DistanceIs) and isinstance(other, DistanceIs):
        ends = [{frozenset([end] if isinstance(end, str) else end) for end in two} for two in (one, other)]
        return ends[0] == ends[1]
    if isinstance(one, ReactionIs) and isinstance(other, ReactionIs) and None in (one.at, other.at):
        return one._replace(at=None) == other._replace(at=None)
    return one == other
