"""A course, from ``course.yaml``: marks, tolerances, how strict about units and directions; and its students,
from a roster.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from icsolve.case.expected import Tolerance
from icsolve.errors import CaseError
from icsolve.grade.mistakes.lookup import CODES
from icsolve.grade.tables.columns import HeaderError, identifier, read_table
from icsolve.grade.tables.text import Report
from icsolve.grade.tolerance import DEFAULT
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Node, Scalar, checked, is_null, parse, text_of
from icsolve.read.expect import tolerance_of
from icsolve.read.names import Problems, Stop, shown, suggestion
from icsolve.tuples import NamedTuple

ATTEMPTS = ("last", "first", "best")
DECIMALS = ("either", "point", "comma")
UNITS = ("assumed", "required", "ignored")
DIRECTIONS = ("signed", "required", "ignored")
Fields = dict[str, Any]
NONE: Mapping[str, Any] = {}


class Credit(NamedTuple):
    """Shares of the mark for a right number, unit and direction; they add up to 1."""

    number: float
    unit: float
    direction: float


class Policy(NamedTuple):
    """How one question is judged.

    ``unit``: an answer without one is taken in the question's unit (``assumed``), is wrong in its unit
    (``required``), or units are not looked at (``ignored``). ``direction``: a sign will do
    (``signed``), words must stand there (``required``), or neither counts (``ignored``). ``credit`` is None
    where only a wholly right answer earns marks. ``mistakes`` has the share earned by a wrong answer
    whose cause is known. ``figures`` is the least number of written significant figures.
    """

    points: float = 1.0
    tolerance: Tolerance = DEFAULT
    unit: str = "assumed"
    strict_case: bool = False
    direction: str = "signed"
    within: float = 45.0
    credit: Credit | None = None
    mistakes: Mapping[str, float] = NONE
    figures: int = 0


class Course(NamedTuple):
    """A course: the policy for all questions, what single questions have of their own (each student owes an
    answer to each of these), and the rest."""

    title: str = ""
    policy: Policy = Policy()
    own: Mapping[str, Fields] = NONE
    attempt: str = "last"
    decimal: str = "either"
    seed: str = "0"
    columns: tuple[tuple[str, str], ...] = ()
    reveal: bool = False
    """Whether the accepted range is told with a wrong answer too."""
    places: Mapping[str, str] = NONE
    """where each question is named: ``course.yaml:7:9``"""

    def policy_of(self, question: str, tolerance: Tolerance | None = None) -> Policy:
        """The policy of ``case`` or ``case:what``; ``tolerance`` is that of the case file."""
        fields: Fields = {} if tolerance is None else {"tolerance": tolerance}
        for name in (question.partition(":")[0], question):
            fields |= self.own.get(name, {})
        return self.policy._replace(**fields)


Readers = dict[str, tuple[str, Callable[[Node], Any]]]
"""Keys, each with its field and how its value is read."""


def read_course(path: str | os.PathLike[str]) -> Course:
    """The course of a file.

    Raises
    ------
    CaseError
        With all that is wrong.
    """
    problems = Problems(os.fspath(path))
    course = Course()
    try:
        root = parse(checked(text_of(path, problems), problems), problems)
        if type(root) is Tree:
            course = _course(root, problems)
        elif root is not None:
            problems.refuse(root.mark, "a course is a mapping, as in {tolerance: 1%, unit: required}")
    except Stop:
        pass
    if problems.found:
        raise CaseError(problems.found)
    return course


def _course(root: Tree, problems: Problems) -> Course:
    fields = _fields(root, _COURSE | _POLICY, "a course", problems, ("cases", "map"))
    policy = Policy(**{name: fields.pop(name) for name in Policy._fields if name in fields})
    cases = _tree(root, "cases", "{press: {points: 5}, bolt-cutter: {}}", problems)
    own: dict[str, Fields] = {}
    for question, node in cases.items.items():
        own[question] = {}
        if type(node) is Tree:
            own[question] = _fields(node, _POLICY, f"the case {question}", problems)
        elif not is_null(node):
            problems.refuse(node.mark, f"{shown(question)} should have a mapping, as in {{points: 5}}")
    places = {name: f"{problems.path}:{line}:{column}" for name, (line, column) in cases.keys.items()}
    columns = []
    mapped = _tree(root, "map", "{student_id: Email Address, Q3: bolt-cutter}", problems)
    for key, node in mapped.items.items():
        if type(node) is Scalar and node.text:
            columns.append((key, node.text))
        else:
            problems.refuse(node.mark, f"'{key}' should name one column or one case")
    return Course(**fields, policy=policy, own=own, columns=tuple(columns), places=places)


def _fields(
    node: Tree, readers: Readers, what: str, problems: Problems, others: tuple[str, ...] = ()
) -> Fields:
    """The fields whose keys stand there; a reader's ValueError is noted at its value, and so is a key that
    is neither a reader's nor one of the ``others``."""
    known, found = (*readers, *others), {}
    for key in node.items:
        if key not in known:
            problems.refuse(node.keys[key], f"{what} has no key {shown(key)}{suggestion(key, known)}")
    for key, (field, read) in readers.items():
        value = node.items.get(key)
        if value is None or is_null(value):
            continue
        try:
            found[field] = read(value)
        except ValueError as error:
            problems.refuse(value.mark, f"'{key}': {error}")
    return found


def _tree(root: Tree, key: str, form: str, problems: Problems) -> Tree:
    """The mapping under a key; an empty one where nothing, or something else, stands there."""
    node = root.items.get(key)
    if type(node) is Tree:
        return node
    if node is not None and not is_null(node):
        problems.refuse(node.mark, f"'{key}' should be a mapping, as in {form}")
    return Tree({}, {}, (1, 1))


def _text(node: Node) -> str:
    if type(node) is not Scalar:
        raise ValueError("one text should stand here")
    return node.text.strip()


def _one_of(*words: str) -> Callable[[Node], str]:
    def read(node: Node) -> str:
        text = _text(node)
        if text not in words:
            raise ValueError(f"{shown(text)} should be {', '.join(words[:-1])} or {words[-1]}")
        return text

    return read


def _number(node: Node) -> float:
    text = _text(node)
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{shown(text)} is not a number") from None
    if not 0.0 <= value < 1e9:
        raise ValueError(f"{shown(text)} should be a number from 0 up")
    return value


def share(text: str) -> float:
    """``50%`` or ``0.5``, from 0 to 1.

    Raises ValueError with a sentence.
    """
    try:
        value = float(text[:-1]) / 100.0 if text.endswith("%") else float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1.0:
        raise ValueError(f"{shown(text)} should be a share of the mark, such as 50%")
    return value


def _credit(node: Node) -> Credit | None:
    if type(node) is Scalar and node.text in ("none", "all or nothing"):
        return None
    if type(node) is not Tree or set(node.items) - set(Credit._fields):
        raise ValueError("the shares are given as {number: 60%, unit: 20%, direction: 20%}")
    shares = Credit(
        *(share(_text(node.items[part])) if part in node.items else 0.0 for part in Credit._fields)
    )
    if abs(sum(shares) - 1.0) > 1e-9:
        raise ValueError(f"the shares add up to {100.0 * sum(shares):.6g} %, not to 100 %")
    return shares


def _mistakes(node: Node) -> dict[str, float]:
    if type(node) is not Tree:
        raise ValueError("the credit for known mistakes is given as {sign: 50%, carried: 100%}")
    for code in node.items:
        if code not in CODES:
            raise ValueError(f"there is no mistake {shown(code)}{suggestion(code, CODES)}")
    return {code: share(_text(value)) for code, value in node.items.items()}


def _figures(node: Node) -> int:
    text = _text(node).removeprefix("at_least ").removeprefix("at least ").strip()
    if not (text.isascii() and text.isdigit() and int(text) <= 15):
        raise ValueError(f"{shown(text)} should be a number of figures, as in 'at_least 3'")
    return int(text)


def _yes(node: Node) -> bool:
    return _one_of("yes", "no", "true", "false")(node) in ("yes", "true")


def _angle(node: Node) -> float:
    value = _number(node)
    if not 0.0 < value < 85.0:
        raise ValueError("a direction in words lies within more than 0 and less than 85 degrees")
    return value


_COURSE: Readers = {
    "course": ("title", _text),
    "attempt": ("attempt", _one_of(*ATTEMPTS)),
    "decimal": ("decimal", _one_of(*DECIMALS)),
    "seed": ("seed", _text),
    "reveal": ("reveal", _yes),
}
_POLICY: Readers = {
    "points": ("points", _number),
    "tolerance": ("tolerance", tolerance_of),
    "unit": ("unit", _one_of(*UNITS)),
    "unit_case": ("strict_case", lambda node: _one_of("accept", "refuse")(node) == "refuse"),
    "direction": ("direction", _one_of(*DIRECTIONS)),
    "within": ("within", _angle),
    "credit": ("credit", _credit),
    "malrules": ("mistakes", _mistakes),
    "written_figures": ("figures", _figures),
}


class Person(NamedTuple):
    """One student of a roster; ``others`` are the other ids under which a platform may know them."""

    student_id: str
    email: str = ""
    first_name: str = ""
    last_name: str = ""
    section: str = ""
    others: tuple[str, ...] = ()


class Roster:
    """The students by id, by email and by their other ids."""

    def __init__(self, people: Iterable[Person]) -> None:
        self.people: dict[str, Person] = {}
        self._ids: dict[str, list[str]] = {}
        for person in people:
            self.people.setdefault(person.student_id, person)
        for person in self.people.values():
            for other in (person.student_id, person.email, *person.others):
                if other:
                    students = self._ids.setdefault(other.casefold(), [])
                    if person.student_id not in students:
                        students.append(person.student_id)

    def match(self, ids: tuple[str, ...]) -> str | None:
        """The student of the first id that the roster has; ids are text, ``007`` is not ``7``.

        Raises ValueError, with a sentence, for an email or another id that several students share.
        """
        shared: list[str] = []
        for name in ids:
            if name in self.people:
                return name
            found = self._ids.get(name.casefold(), ())
            if len(found) == 1:
                return found[0]
            if found:
                shared.append(f"{name!r} is that of {' and '.join(found[:4])} on the roster")
        if shared:
            raise ValueError(f"{shared[0]}: whose answer is it? Give them different ones, or a student_id")
        return None

    def hint(self, ids: tuple[str, ...]) -> str:
        """Who may be meant where zeros in front were lost, for a message."""
        for name in ids:
            near = [student for student in self.people if student.lstrip("0") == name.lstrip("0")]
            if near and name.lstrip("0"):
                return f"; the roster has {near[0]!r}: did a spreadsheet change the zeros in front?"
        return ""


def student_named(text: str, roster: Roster | None) -> str:
    """The student of an id in a cell: by the roster, else the id as it is written.

    Raises ValueError for an id that several students share.
    """
    name = identifier(text)
    return (roster.match((name,)) if roster is not None else None) or name


def read_roster(path: str | os.PathLike[str], report: Report) -> Roster:
    """The roster of a CSV file: canonical, or a platform's own (Gradescope, Canvas, Moodle).

    Raises HeaderError, with the file's name and a sentence, where it can't be used; OSError.
    """
    try:
        return _read(path, report)
    except (HeaderError, ValueError) as error:
        raise HeaderError(f"{os.fspath(path)}: {error}") from None


def _read(path: str | os.PathLike[str], report: Report) -> Roster:
    columns, rows = read_table(path, report)
    at = columns.places("student_id", "sid", "sis user id", "id_number", "id", "email")
    if columns.names[0] == "student" and len(at) > 1:
        at.remove(0)  # in a gradebook the first column has names
    if not at:
        raise HeaderError(f"no column of the roster has a student's id; its columns are {columns.listed()}")
    rest = [columns.field(name) for name in ("email", "first_name", "last_name", "section")]
    people: dict[str, Person] = {}
    for line, cells, trouble in rows:
        if trouble:
            report(line, trouble)
        ids = [identifier(cells[i]) for i in at if i < len(cells) and cells[i].strip()]
        about = ["" if i is None or i >= len(cells) else cells[i].strip() for i in rest]
        if not ids:
            report(line, "this row of the roster has no student's id and is passed over")
        elif ids[0] in people:
            report(line, f"the student {ids[0]!r} is in the roster twice; the first row counts")
        elif not ids[0].startswith(("Student, Test", "    Points")):
            people[ids[0]] = Person._make((ids[0], *about, tuple(ids[1:])))
    return Roster(people.values())
