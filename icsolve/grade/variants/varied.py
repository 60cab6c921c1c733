"""A case with variables: every student's own numbers by hash, checked to make a fair task."""

from __future__ import annotations

import hashlib
import math
import re
from collections import OrderedDict
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from icsolve.answer import Answer
from icsolve.case import Case, Load, Mark, Number
from icsolve.case.expected import LoadIs, Variable
from icsolve.errors import CaseError, IcsolveError, SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import (
    AnyKey,
)
from icsolve.grade.mistakes import WrongAnswers
from icsolve.grade.solved import SolvedCase
from icsolve.grade.tolerance import NoKeyError, drawn_band, size_of
from icsolve.numbers.units import converted, parse_unit, split_quantity
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Node, Scalar, parse
from icsolve.read.document import Sequence as Items
from icsolve.read.names import Problems
from icsolve.read.variables import count, first_values, names_in, replaced, value_at
from icsolve.tuples import NamedTuple
from icsolve.wording.senses import unit_of

if TYPE_CHECKING:
    from icsolve.grade.variants.record import Handed, VariantRecord

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


def label(case: str, values: Mapping[str, str]) -> str:
    """A short name of a variant: eight hexadecimal digits that follow from its values."""
    text = "\x1f".join((case, *(f"{name}={value}" for name, value in values.items())))
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:8]


_KINDS = ("force", "torque", "weight", "mass", "spring")


class Magnitudes:
    """The numbers of loads in which variables stand; ``names`` are the variables that stand nowhere else."""

    def __init__(self, text: str, case: Case) -> None:
        root = parse(text, Problems(case.path))
        assert type(root) is Tree
        numbers = _load_numbers(root)
        self._texts = {name: node.text for name, node in numbers.items()}
        inside = {name for written in self._texts.values() for name in names_in(written)}
        self.names = frozenset(inside - _elsewhere(root, {node.mark for node in numbers.values()}))
        self._units = {load.name: unit_of(load, case) for load in case.loads if load.name in self._texts}
        self._dynamic = case.dynamic
        self._written = [(load.name, number_of(load)) for load in case.loads]

    def loads(self, values: Mapping[str, str]) -> dict[str, float]:
        """The numbers of the loads that depend on variables, in case units."""
        found = {}
        for name, written in self._texts.items():
            parts = split_quantity(replaced(written, values)[0])
            assert parts is not None
            numeral, unit = parts
            own = parse_unit(self._units[name])
            found[name] = converted(numeral, parse_unit(unit), own) if unit else float(numeral.digits)
        return found

    def factor(self, base: Mapping[str, str], values: Mapping[str, str]) -> float | None:
        """By what all loads are larger than with other values; None where they do not grow alike, as those of
        inertia do not."""
        if self._dynamic:
            return None
        old, new = self.loads(base), self.loads(values)
        ratios = set()
        for name, written in self._written:
            before = old.get(name, written)
            if before is None:
                continue
            after = new.get(name, before)
            if before == 0.0 or after == 0.0:
                return None
            ratios.add(after / before)
        return ratios.pop() if len(ratios) == 1 else None


def number_of(load: Load) -> float | None:
    """A load's own known number; 1 of a vector, which no variable scales."""
    value = getattr(load, "value", None)
    if isinstance(value, Number):
        return value.value
    return 1.0 if hasattr(load, "x") else None


def _load_numbers(root: Tree) -> dict[str, Scalar]:
    """The numbers of loads in which variables stand, as written."""
    section = root.items.get("loads")
    found = {}
    for name, node in section.items.items() if type(section) is Tree else ():
        for kind in _KINDS:
            value = node.items.get(kind) if type(node) is Tree else None
            if type(value) is Scalar and names_in(value.text):
                found[name] = value
    return found


def _elsewhere(root: Tree, within: set[Mark]) -> set[str]:
    """Variables that stand outside these places; titles and the like do not count."""
    free = ("title", "source", "reconstructed", "variables")
    found: set[str] = set()
    stack: list[Node] = [node for key, node in root.items.items() if key not in free]
    while stack:
        node = stack.pop()
        if type(node) is Scalar:
            found |= set() if node.mark in within else set(names_in(node.text))
        elif type(node) is Tree:
            stack.extend(node.items.values())
        elif type(node) is Items:
            stack.extend(node.items)
    return found


DRAWING = 1e-3
"""Part of the mechanism's size by which every point may be off."""
SWING = 0.1
"""Part of itself by which an answer may change for it; near a dead centre it changes more."""
APART = 0.02
"""Part of itself by which an answer and a wrong one differ at least."""


Mistake = tuple[str, str, str]
"""The unknown, the code, and where the mistake sits."""


class Seen(NamedTuple):
    """A variant looked at: whether it is far from dead centres, and the mistakes that it would not show."""

    far: bool
    swallowed: frozenset[Mistake]


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


def swallowed(answer: Answer) -> frozenset[Mistake]:
    """The mistakes that this variant would not show: their answers are as good as the right one."""
    found = set()
    wrongs = WrongAnswers(answer)
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
_KNOWN = 100_000
"""Students whose draw is kept, and variants of which it is known whether they suit."""
_UNFIT = Seen(False, frozenset())


class Draw(NamedTuple):
    """A student's variant: its label and its values."""

    label: str
    values: Texts


class Varied:
    """One case with variables; ``text`` is its file. With a ``record`` the numbers handed out count."""

    def __init__(self, name: str, text: str, path: str, course: Course) -> None:
        self.name = name
        self.text = text
        self.path = path
        self.course = course
        self.case = self.read({})
        self.magnitudes = Magnitudes(text, self.case)
        self.record: VariantRecord | None = None
        self._first = first_values(self.case.variables)
        self._solved: OrderedDict[tuple[str, ...], SolvedCase | None] = OrderedDict()
        self._tasks: OrderedDict[tuple[str, ...], SolvedCase] = OrderedDict()
        self._draws: OrderedDict[str, Draw] = OrderedDict()
        self._seen: OrderedDict[tuple[str, ...], Seen | None] = OrderedDict()
        self._inherent: frozenset[tuple[str, str, str]] | None = None

    def draw(self, student: str) -> Draw:
        """The student's values: the first draw that suits.

        Raises NoKeyError where none of many does.
        """
        found = self._draws.get(student)
        if found is None:
            found = self._drawn(student) if self.record is None else self._handed(student, self.record)
            _keep(self._draws, student, found, _KNOWN)
        return found

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
        """The case's title without any student's numbers."""
        root = parse(self.text, Problems(self.path))
        found = root.items.get("title") if type(root) is Tree else None
        text = found.text if type(found) is Scalar else ""
        return " ".join(re.sub(r"\(?[^\s(]*\$\w+[^\s)]*\)?", "", text).split())

    def is_drawn(self, student: str, values: Texts) -> bool:
        """Whether values are a draw of this student by the present seed, whatever the filter says of it."""
        return any(self._values(student, trial) == values for trial in range(TRIALS))

    def drawn_otherwise(self, handed: Mapping[str, Handed]) -> list[str]:
        """Of some students those who would now be given other numbers than were handed out."""
        fresh = Varied(self.name, self.text, self.path, self.course)
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

    def key(self, question: str, student: str) -> AnyKey:
        """The key of a student's own task.

        Raises NoKeyError.
        """
        draw = self.draw(student)
        return self.task(draw).key(question)

    def task(self, draw: Draw) -> SolvedCase:
        """A variant, solved.

        Raises NoKeyError.
        """
        values = tuple(draw.values.values())
        found = self._tasks.get(values)
        if found is None:
            found = self._task(draw.values)
            _keep(self._tasks, values, found, _KEPT)
        return found

    def figure(self, draw: Draw) -> tuple[str, ...]:
        """The values of a draw that its figure hangs on; draws of one figure are solved once."""
        return tuple(self._figure(draw.values).values())

    def read(self, values: Texts) -> Case:
        """The case with these values, its figure and all."""
        from icsolve.read import read_text

        return read_text(self.text, self.path, {f"variables.{name}": value for name, value in values.items()})

    # --- tasks ------------------------------------------------------------------------------------

    def _task(self, values: Texts) -> SolvedCase:
        """The case with values that suit, solved.

        Where they only make all loads larger alike, the solution of another task is scaled.
        """
        base = self._figure(values)
        factor = self.magnitudes.factor(base, values)
        grows = factor is not None and factor > 0.0
        found = self._exactly(base if grows else values)
        if found is None:
            raise NoKeyError(f"{self.name} can't be solved with {values}")
        return found.scaled(factor) if grows and factor is not None else found

    def _figure(self, values: Texts) -> Texts:
        """These values, and the first ones of variables that only scale loads."""
        return {n: self._first[n] if n in self.magnitudes.names else v for n, v in values.items()}

    def _exactly(self, values: Texts, full: bool = False) -> SolvedCase | None:
        """The case with these values; None where it has no answer."""
        key = tuple(values.values())
        if key not in self._solved:
            _keep(self._solved, key, self._made(values, full), _KEPT)
        return self._solved[key]

    def _made(self, values: Texts, full: bool) -> SolvedCase | None:
        try:
            return SolvedCase(self.read(values), self.course, full=full)
        except (CaseError, SceneError, IcsolveError, ArithmeticError):
            return None

    # --- drawing ----------------------------------------------------------------------------------

    def _drawn(self, student: str) -> Draw:
        for trial in range(TRIALS):
            values = self._values(student, trial)
            if self._suits(values):
                return Draw(label(self.name, values), values)
        asked = "assembles, no dead centre near, mistakes apart"
        raise NoKeyError(
            f"none of {TRIALS} variants of {self.name} suits ({asked}): narrow the ranges of its variables"
        )

    def _values(self, student: str, trial: int) -> Texts:
        return drawn(self.name, self.case.variables, student, self.course.seed, trial)

    def _suits(self, values: Texts) -> bool:
        """By its figure; where its loads do not grow alike, by all of it."""
        base = self._figure(values)
        seen = self._looked_at(base)
        if not (seen.far and seen.swallowed <= self._always_swallowed()):
            return False
        return self._scales(base, values) or self._looked_at(values).far

    def _scales(self, base: Texts, values: Texts) -> bool:
        factor = self.magnitudes.factor(base, values)
        return factor is not None and factor > 0.0

    def _looked_at(self, values: Texts) -> Seen:
        """A variant by what is known of it, or as a scene of its own."""
        key = tuple(values.values())
        seen = self._seen.get(key)
        if seen is None:
            solved = self._exactly(values, full=True)
            far = solved is not None and swing(solved.answer) <= self._limit
            seen = Seen(True, swallowed(solved.answer)) if solved is not None and far else _UNFIT
            _keep(self._seen, key, seen, _KNOWN)
        return seen

    def _always_swallowed(self) -> frozenset[tuple[str, str, str]]:
        """Mistakes that hardly any variant shows: they lie in the task, not in its numbers."""
        if self._inherent is None:
            seen = map(self._looked_at, self._references)
            sets = [one.swallowed for one in seen if one.far]
            found = frozenset().union(*sets)
            self._inherent = frozenset(m for m in found if 2 * sum(m in s for s in sets) > len(sets))
        return self._inherent

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


K = TypeVar("K")
V = TypeVar("V")


def _keep(store: OrderedDict[K, V], key: K, value: V, most: int) -> None:
    """Remember, and forget the oldest of too many."""
    if len(store) >= most:
        store.popitem(last=False)
    store[key] = value
