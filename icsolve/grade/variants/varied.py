"""A case with variables: every student's own numbers by hash, checked to make a fair task."""

from __future__ import annotations

import hashlib
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress

from icsolve.answer import Answer
from icsolve.case import Case
from icsolve.case.expected import LoadIs, Variable
from icsolve.errors import CaseError, IcsolveError, SceneError
from icsolve.grade.course import Course
from icsolve.grade.mistakes.engine import Known, WrongAnswers
from icsolve.grade.solved import SolvedCase
from icsolve.grade.tolerance import NoKeyError, drawn_band, size_of
from icsolve.grade.variants.at_once import VariedNumbers, solved_at_once, together
from icsolve.read import read_text
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Scalar, parse
from icsolve.read.names import Problems
from icsolve.read.variables import FormulaError, count, exact, first_values, named, value_at, values_told
from icsolve.sweep.varied_numbers import numbers_of
from icsolve.tuples import NamedTuple, TypeVar, cached_property

TRIALS = 60
"""Draws of one student, until one suits."""


def drawn(case: str, variables: tuple[Variable, ...], student: str, seed: str, trial: int) -> dict[str, str]:
    """The values of one draw: each variable's index is a hash of all that it depends on, modulo its count."""
    values = {}
    for variable in variables:
        text = "\x1f".join((case, student, seed, str(trial), variable.name))
        digest = hashlib.sha256(text.encode("utf-8", "surrogatepass")).digest()
        values[variable.name] = value_at(variable, int.from_bytes(digest, "big") % count(variable))
    return values


def owner_of(label: str) -> str:
    """Who has the numbers that an answer itself says, where a student's id is asked for; no id begins so."""
    return f"\x1f{label}"


def label(case: str, values: Mapping[str, str]) -> str:
    """A short name of a variant: eight hexadecimal digits that follow from its values."""
    text = "\x1f".join((case, *(f"{name}={value}" for name, value in values.items())))
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:8]


_DIGITS = 17
DRAWING = 1e-3
"""Part of the mechanism's size by which every point may be off."""
SWING = 0.1
"""Part of itself by which an answer may change for it; near a dead centre it changes more."""
APART = 0.02
"""Part of itself by which an answer and a wrong one differ at least."""


Mistake = tuple[str, str, str]
"""The unknown, the code, and where the mistake sits."""


def _is_plain(text: str) -> bool:
    """Whether a value is a bare number of no more digits than a case may have."""
    with suppress(FormulaError):
        return len(text) <= _DIGITS and exact(text) is not None
    return False


class Seen(NamedTuple):
    """A variant looked at: whether it is far from dead centres, the mistakes that it would not show, and
    whether it has an answer at all."""

    far: bool
    swallowed: frozenset[Mistake]
    solved: bool = True


def swing(answer: Answer) -> float:
    """The largest part of itself by which an answer changes where every point of the figure is off by a
    thousandth of its size; infinite at a dead centre, and where an answer is zero."""
    width, largest = DRAWING * size_of(answer), 0.0
    for name, found in answer.answers.items():
        if found.holds is None:
            try:
                change = drawn_band(LoadIs(name), answer, width)
            except (NoKeyError, IcsolveError):
                return math.inf
            largest = max(largest, change / abs(found.value) if found.value else math.inf)
    return largest


def swallowed(answer: Answer, known: Known | None = None) -> frozenset[Mistake]:
    """The mistakes that this variant would not show: their answers are as good as the right one."""
    found = set()
    wrongs = WrongAnswers(answer, known=known)
    for name, one in answer.answers.items():
        if one.holds is not None:
            continue
        for wrong in wrongs.of_loads(name):
            if wrong.code in _SHOWN and abs(wrong.value - one.value) <= APART * abs(one.value):
                found.add((name, wrong.code, wrong.where))
    return frozenset(found)


_SHOWN = frozenset({"missed-load", "load-sense", "inverse-ratio", "no-cos", "sin-cos", "wrong-ic"})
"""Mistakes that a variant should show; those of signs, powers of ten and units are always apart."""


Texts = dict[str, str]
_STEADY = 1.0
"""Part of itself by which an answer may swing for the task to be one at all."""
_REFERENCES = 8
"""Draws by which it is told how near to a dead centre the task is, and which mistakes no variant shows."""
_KEPT = 1000
"""Figures that are kept solved."""
_KNOWN_ROWS = 5000
"""Rows that are kept."""
_TOGETHER = 1000
"""Students for whom it is drawn together."""
_WORTH = 8
"""Variants from which a record pays."""
_KNOWN = 100_000
"""Students whose draw is kept, and variants of which it is known whether they suit."""
_NEAR = Seen(False, frozenset())
_UNSOLVED = Seen(False, frozenset(), False)


class Draw(NamedTuple):
    """A student's variant, as drawn or as it was handed out: its label and its values."""

    label: str
    values: Texts


class VariantRecord(NamedTuple):
    """The numbers of one case by student, and the keys of that time by question and student: of each right
    number its value, its unit and its sense."""

    path: str
    handed: dict[str, Draw]
    keys: dict[tuple[str, str], list[tuple[float, str, str]]]


K = TypeVar("K")
V = TypeVar("V")


class Latest(dict[K, V]):
    """What is remembered; the oldest of too many is forgotten."""

    def __init__(self, most: int) -> None:
        self._most = most

    def __setitem__(self, key: K, value: V) -> None:
        if len(self) >= self._most:
            del self[next(iter(self))]
        super().__setitem__(key, value)


class Varied:
    """One case with variables; ``text`` is its file. With a ``record`` the numbers handed out count."""

    def __init__(self, name: str, text: str, path: str, course: Course) -> None:
        self.name = name
        self.text = text
        self.path = path
        self.course = course
        self.case = self.read({})
        self.numbers = VariedNumbers(text, self.case)
        self.record: VariantRecord | None = None
        self.by_owner: dict[str, Draw] = {}
        """the numbers that answers themselves say"""
        self.first = first_values(self.case.variables)
        self._readable = {(one.name, choice) for one in self.case.variables for choice in one.choices}
        self._solved: Latest[tuple[str, ...], SolvedCase | None] = Latest(_KEPT)
        self._tasks: Latest[tuple[str, ...], SolvedCase] = Latest(_KEPT)
        self._draws: Latest[str, Draw] = Latest(_KNOWN)
        self._seen: Latest[tuple[str, ...], Seen] = Latest(_KNOWN)
        self._rows: Latest[tuple[str, ...], Answer] = Latest(_KNOWN_ROWS)

    def draw(self, student: str) -> Draw:
        """The student's values: the first draw that suits.

        Raises NoKeyError where none of many does.
        """
        if student in self.by_owner:
            return self.by_owner[student]
        if self.record is not None:
            return self._handed(student, self.record)
        if student not in self._draws:
            self._draw((student,))
        if student not in self._draws:
            why = f"none of {TRIALS} variants of {self.name} suits ({self._why_none(student)})"
            raise NoKeyError(f"{why}: narrow the ranges of its variables")
        return self._draws[student]

    def check(self, values: Texts, whose: str) -> None:
        """Raises ValueError where the case can't be read with one of the values that were handed out."""
        for name, text in values.items():
            if _is_plain(text) or (name, text) in self._readable:
                continue
            try:
                self.read({name: text})
                self._readable.add((name, text))
            except CaseError:
                said = f"the number {name} of {whose} is {text[:40]!r}, with which {self.name} can't be read"
                raise ValueError(f"{said}: write what was handed out") from None

    def told(self, values: Texts) -> str:
        """Take numbers that an answer itself says; their label."""
        own = label(self.name, values)
        self.by_owner[owner_of(own)] = Draw(own, values)
        return own

    def ready(self, students: Iterable[str]) -> None:
        """Draw for many students, and solve their tasks, together."""
        every = list(students)
        for start in range(0, len(every), _TOGETHER):
            some = every[start : start + _TOGETHER]
            if self.record is None:
                self._draw(some)
                drawn = [self._draws[student].values for student in some if student in self._draws]
            else:
                drawn = [self.record.handed[s].values for s in some if s in self.record.handed]
            if not start:
                drawn += [draw.values for draw in self.by_owner.values()]
            cases = self._new_cases(map(self._base, drawn))
            for key, answer in zip(cases, together(list(cases.values())), strict=True):
                if answer is not None:
                    self._rows[key] = answer

    def _handed(self, student: str, record: VariantRecord) -> Draw:
        """What was handed out to a student."""
        handed = record.handed.get(student)
        if handed is None:
            raise NoKeyError(
                f"no numbers of {self.name} were handed out to {student} ({record.path})",
                "no numbers were handed out to this student",
            )
        return Draw(handed.label or label(self.name, handed.values), handed.values)

    @cached_property
    def title(self) -> str:
        """The case's title without any student's numbers: with the names of the variables."""
        root = parse(self.text, Problems(self.path))
        found = root.items.get("title") if type(root) is Tree else None
        return " ".join(named(found.text).split()) if type(found) is Scalar else ""

    def draws(self, student: str) -> Iterator[Texts]:
        """All draws of a student by the present seed, whatever the filter says of them."""
        return (self._values(student, trial) for trial in range(TRIALS))

    def drawn_otherwise(self, handed: Mapping[str, Draw]) -> list[str]:
        """Of some students those who would now be given other numbers than were handed out."""
        fresh = Varied(self.name, self.text, self.path, self.course)
        fresh.ready(handed)
        found = []
        for student, given in handed.items():
            try:
                same = fresh.draw(student).values == given.values
            except NoKeyError:
                same = False
            if not same:
                found.append(student)
        return found

    def solved(self, student: str) -> SolvedCase:
        """The student's own task, solved.

        Raises NoKeyError.
        """
        return self.task(self.draw(student))

    def task(self, draw: Draw) -> SolvedCase:
        """A variant, solved.

        Raises NoKeyError.
        """
        values = tuple(draw.values.values())
        if values not in self._tasks:
            self._tasks[values] = self._task(draw.values)
        return self._tasks[values]

    def figure(self, draw: Draw) -> tuple[str, ...]:
        """The values of a draw that its figure hangs on; draws of one figure are solved once."""
        return tuple(self._figure(draw.values).values())

    def read(self, values: Texts) -> Case:
        """The case with these values, its figure and all."""
        return read_text(self.text, self.path, {f"variables.{name}": value for name, value in values.items()})

    # --- tasks ------------------------------------------------------------------------------------

    def _task(self, values: Texts) -> SolvedCase:
        """The case with values that suit, solved.

        Where they only make all loads larger alike, the solution of another task is scaled.
        """
        base = self._base(values)
        found = self._exactly(base)
        if found is None:
            raise NoKeyError(f"{self.name} can't be solved with {values_told(values)}")
        return found if base is values else found.scaled(self.numbers.factor(base, values) or 1.0)

    def _base(self, values: Texts) -> Texts:
        """The values of the task whose answers are scaled for these: themselves, where loads grow unalike."""
        base = self._figure(values)
        return base if self._scales(base, values) else values

    def _figure(self, values: Texts) -> Texts:
        """These values, and the first ones of variables that only scale loads."""
        return {n: self.first[n] if n in self.numbers.of_loads else v for n, v in values.items()}

    def _exactly(self, values: Texts, full: bool = False) -> SolvedCase | None:
        """The case with these values; None where it has no answer."""
        key = tuple(values.values())
        if key not in self._solved:
            self._solved[key] = self._made(values, full)
        return self._solved[key]

    def _made(self, values: Texts, full: bool) -> SolvedCase | None:
        row = self._rows.get(tuple(values.values())) if not full else None
        if row is not None:
            return SolvedCase(row.case, self.course, plain=row)
        try:
            return SolvedCase(self.read(values), self.course, full=full)
        except (CaseError, SceneError, IcsolveError, ArithmeticError):
            return None

    # --- drawing ----------------------------------------------------------------------------------

    def _draw(self, students: Iterable[str]) -> None:
        """Keep the first draw that suits, of each student for whom one of many does."""
        left = [student for student in students if student not in self._draws]
        for trial in range(TRIALS):
            draws = {student: self._values(student, trial) for student in left}
            self._look_at(draws.values())
            for student, values in draws.items():
                if self._suits(values):
                    self._draws[student] = Draw(label(self.name, values), values)
            left = [student for student in left if student not in self._draws]
            if not left:
                return

    def _look_at(self, draws: Iterable[Texts]) -> None:
        """Look at many variants together; those in doubt are left for scenes of their own."""
        cases = self._new_cases(v for values in draws for v in (self._figure(values), self._base(values)))
        for key, solved in zip(cases, solved_at_once(list(cases.values())), strict=True):
            if solved is not None:
                self._seen[key] = self._judged(*solved)
                self._rows[key] = solved[0]

    def _new_cases(self, some: Iterable[Texts]) -> dict[tuple[str, ...], Case]:
        """The cases that are not known, by their values, where they are enough for a record."""
        new = {key: v for v in some if (key := tuple(v.values())) not in self._seen and key not in self._rows}
        if len(new) < _WORTH or not self._is_quick:
            return {}
        cases = {}
        for key, values in new.items():
            with suppress(ValueError, ArithmeticError, CaseError):
                cases[key] = self.numbers.case_of(values)
        return cases

    @cached_property
    def _is_quick(self) -> bool:
        """Whether the numbers of a variant are told without reading its case: tried on one."""
        values = drawn(self.name, self.case.variables, "", "", 1)
        if not self.numbers.whole:
            return False
        try:
            cases = (self.numbers.case_of(values), self.read(values))
        except CaseError:
            return False
        one, other = ({path: n.value for path, n in numbers_of(case).items()} for case in cases)
        return one == other

    def _values(self, student: str, trial: int) -> Texts:
        return drawn(self.name, self.case.variables, student, self.course.seed, trial)

    def _suits(self, values: Texts) -> bool:
        """By its figure; where its loads do not grow alike, by all of it."""
        base = self._figure(values)
        seen = self._looked_at(base)
        if not (seen.far and seen.swallowed <= self._always_swallowed):
            return False
        return self._scales(base, values) or self._looked_at(values).far

    def _why_none(self, student: str) -> str:
        """How many of a student's draws do not suit, by what is wrong with them."""
        found: Counter[str] = Counter()
        for values in self.draws(student):
            base = self._figure(values)
            seen = [self._looked_at(base)] + ([] if self._scales(base, values) else [self._looked_at(values)])
            if not all(one.solved for one in seen):
                found["{} do not assemble or have no answer"] += 1
            elif not all(one.far for one in seen):
                found["{} are near a dead centre"] += 1
            else:
                found["{} do not show a mistake that others show"] += 1
        return ", ".join(why.format(n) for why, n in found.most_common())

    def _scales(self, base: Texts, values: Texts) -> bool:
        factor = self.numbers.factor(base, values)
        return factor is not None and factor > 0.0

    def _looked_at(self, values: Texts) -> Seen:
        """A variant by what is known of it, or as a scene of its own."""
        key = tuple(values.values())
        if key not in self._seen:
            solved = self._exactly(values, full=True)
            self._seen[key] = self._judged(solved.answer) if solved is not None else _UNSOLVED
        return self._seen[key]

    def _judged(self, answer: Answer, known: Known | None = None) -> Seen:
        return Seen(True, swallowed(answer, known)) if swing(answer) <= self._limit else _NEAR

    @cached_property
    def _always_swallowed(self) -> frozenset[Mistake]:
        """Mistakes that hardly any variant shows: they lie in the task, not in its numbers."""
        seen = map(self._looked_at, self._references)
        sets = [one.swallowed for one in seen if one.far]
        found = frozenset().union(*sets)
        return frozenset(m for m in found if 2 * sum(m in s for s in sets) > len(sets))

    @cached_property
    def _limit(self) -> float:
        """How much an answer may swing: where even the steadiest of a few variants swings more, as a toggle
        does, that lies in the task, and it stands for all."""
        steadiest = math.inf
        for figure in self._references:
            solved = self._exactly(figure, full=True)
            steadiest = min(steadiest, swing(solved.answer) if solved is not None else math.inf)
            if steadiest <= SWING:
                return SWING
        return 1.5 * steadiest if steadiest <= _STEADY else SWING

    @cached_property
    def _references(self) -> list[Texts]:
        """A few variants, by which it is told what lies in the task and not in its numbers."""
        draws = (drawn(self.name, self.case.variables, "", "", trial) for trial in range(_REFERENCES))
        return list(map(self._figure, draws))
