"""What a class was handed out: every student's values, the key, a figure of each variant and a sheet; and the
record of it, ``values.csv``, read again.

What was handed out counts, whatever became of the case since: what has changed is told, and so are answers to
numbers that are not the student's own, a neighbour's or those of another seed.
"""

from __future__ import annotations

import os
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator
from html import escape

from icsolve.files import is_plain
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Person, Roster, student_named
from icsolve.grade.keys import AnyKey, NumberKey, numbers_of
from icsolve.grade.platforms.questions import asked
from icsolve.grade.results import csv_text, safe
from icsolve.grade.solved import SolvedCase, questions_of
from icsolve.grade.tables.columns import TableColumns, read_whole_table, without_apostrophe
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.varied import Draw, VariantRecord, Varied
from icsolve.grade.written.numerals import figures
from icsolve.tuples import NamedTuple
from icsolve.wording import direction_words, plural
from icsolve.wording.statement import Statement

VALUES, KEYS = "values.csv", "key.csv"
_SAME = 1e-9
"""Relative difference of two keys that is none: the file has twelve digits."""
_ASKED = 40
"""Students by whom it is told whether the numbers were drawn with this seed, and would be drawn again."""


def read_records(paths: Iterable[str], store: CaseStore, roster: Roster | None) -> dict[str, VariantRecord]:
    """The records of files, and of the ``values.csv`` in folders, by case.

    Raises ValueError, with the file's name and a sentence, where one can't be used; OSError.
    """
    found: dict[str, VariantRecord] = {}
    for path in _files(paths):
        try:
            name, record = _read(path, store, roster)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None
        if name in found:
            raise ValueError(f"{found[name].path} and {path} are both the numbers of {name}")
        found[name] = record
    return found


def _files(paths: Iterable[str]) -> Iterator[str]:
    for path in paths:
        if not os.path.isdir(path):
            yield path
            continue
        own = [os.path.join(here, VALUES) for here, _, names in sorted(os.walk(path)) if VALUES in names]
        if not own:
            raise ValueError(f"there is no {VALUES} in {path}")
        yield from filter(is_plain, own)


def _read(path: str, store: CaseStore, roster: Roster | None) -> tuple[str, VariantRecord]:
    columns, rows = read_whole_table(path)
    at = columns.field("student_id")
    if at is None:
        raise ValueError(f"it has no column student_id; its columns are {columns.listed()}")
    label = columns.names.index("variant") if "variant" in columns.names else None
    name = _case_of(path, columns, store)
    varied = store.variation(name)
    if varied is None:
        store.solved(name)  # says why, where it can't be read or is in space
        raise ValueError(f"the case {name} has no variables, so these numbers can't be put into it")
    places: dict[str, int] = {}
    for variable in varied.case.variables:
        if variable.name not in columns.header:
            raise ValueError(f"it has no column for the variable {variable.name} of {name}")
        places[variable.name] = columns.header.index(variable.name)
    handed: dict[str, Draw] = {}
    for cells in rows:
        student = student_named(cells[at], roster)
        values = {variable: without_apostrophe(cells[i]) for variable, i in places.items()}
        if student in handed and handed[student].values != values:
            raise ValueError(f"the student {student} stands in it twice, with other numbers")
        varied.check(values, student)
        handed[student] = Draw(without_apostrophe(cells[label]) if label is not None else "", values)
    return name, VariantRecord(path, handed, _keys(os.path.join(os.path.dirname(path), KEYS), roster))


def _case_of(path: str, columns: TableColumns, store: CaseStore) -> str:
    """The case of a record: that of its folder's name, else the only one with these variables."""
    folder = os.path.basename(os.path.dirname(os.path.abspath(path)))
    if folder in store.paths:
        return folder
    fitting = []
    for name in sorted(store.paths):
        varied = store.variation(name)
        if varied is not None and all(v.name in columns.header for v in varied.case.variables):
            fitting.append(name)
    if len(fitting) == 1:
        return fitting[0]
    if not fitting:
        why = f"none is named {folder}, and none has their variables"
        raise ValueError(f"these are the numbers of no case of --cases: {why}")
    said = " and ".join(fitting)
    raise ValueError(f"{said} could have these numbers; put the file into a folder with the name of its case")


def _keys(path: str, roster: Roster | None) -> dict[tuple[str, str], list[tuple[float, str, str]]]:
    """The keys of that time, where they stand beside the values."""
    found: dict[tuple[str, str], list[tuple[float, str, str]]] = {}
    if not os.path.isfile(path):
        return found
    columns, rows = read_whole_table(path)
    if not columns.has("student_id", "case", "value", "unit"):
        raise ValueError(f"{KEYS} beside it is no key of `icsolve variants`")
    student, case, value, unit = (columns.names.index(n) for n in ("student_id", "case", "value", "unit"))
    way = columns.names.index("sense") if columns.has("sense") else None
    for cells in rows:
        try:
            number = float(without_apostrophe(cells[value]))
        except ValueError:
            raise ValueError(f"{KEYS} beside it has a value that is no number: {cells[value]!r}") from None
        key = (number, cells[unit], without_apostrophe(cells[way]) if way is not None else "")
        found.setdefault((cells[case], student_named(cells[student], roster)), []).append(key)
    return found


# --- what has changed since -------------------------------------------------------------------------


def changes(varied: Varied, record: VariantRecord) -> Iterator[str]:
    """What is otherwise than when the numbers were handed out: the seed, the filter, the keys."""
    varied.ready(record.handed)
    seed = varied.course.seed
    asked = sorted(record.handed)[:_ASKED]
    drawn = [one for one in asked if record.handed[one].values in varied.draws(one)]
    if 2 * len(drawn) <= len(asked):
        yield (
            f"these numbers were not drawn with the seed {seed!r} from the variables that {varied.name} has "
            "now; they count as they were handed out"
        )
    else:
        other = varied.drawn_otherwise({student: record.handed[student] for student in asked})
        if other:
            yield (
                f"{varied.name} has changed: of {len(asked)} students who were looked at {len(other)} "
                f"would now be "
                f"given other numbers ({_some(other)}); those that were handed out count"
            )
    yield from _changed_keys(varied, record)


def _changed_keys(varied: Varied, record: VariantRecord) -> Iterator[str]:
    """The keys that are others now, by question."""
    moved: dict[str, list[str]] = {}
    counts: dict[str, int] = {}
    for (question, student), before in record.keys.items():
        if student not in record.handed:
            continue
        counts[question] = counts.get(question, 0) + 1
        try:
            key = varied.solved(student).key(question)
            now = [
                (one.value, one.unit_name, sense(varied, varied.draw(student), one))
                for one in numbers_of(key)
            ]
        except NoKeyError:
            now = []
        if len(now) != len(before) or not all(map(_is_same, before, now)):
            told = [
                " and ".join(f"{v:.6g} {unit} {way}".rstrip() for v, unit, way in one)
                for one in (before, now)
            ]
            moved.setdefault(question, []).append(f"{student}: {told[0]}, now {told[1] or 'none'}")
    for question, told in moved.items():
        yield (
            f"the key of {question} has changed for {len(told)} of {counts[question]} students since the "
            f"numbers were handed out ({_some(told)}); the one of now counts"
        )


def _is_same(before: tuple[float, str, str], now: tuple[float, str, str]) -> bool:
    """Whether a right number is as it was; a sense is in the file of late only."""
    number = abs(now[0] - before[0]) <= _SAME * max(abs(now[0]), abs(before[0]))
    return number and (not before[2] or before[2] == now[2])


def _some(texts: list[str]) -> str:
    return "; ".join(texts[:3]) + ("; ..." if len(texts) > 3 else "")


_FIGURES = 3
"""Written figures from which an answer can be told from a neighbour's."""
_CHANCE = 0.05
"""Part of the range of a class's answers that they may cover, so that hitting one is no accident."""
_FEW = 500
"""Figures that are solved to know the answers of others; more would take too long."""
_ANSWERS = 3
"""Answers by which a wrong seed is told."""


class GivenValue(NamedTuple):
    """A value that a student gave to a question with variables, and whether it was right."""

    student: str
    question: str
    value: float
    right: bool


class Neighbours:
    """The right answers of a whole class to a question with variables."""

    def __init__(self, case_store: CaseStore, students: Iterable[str]) -> None:
        self._store = case_store
        self._students = tuple(students)
        self._known: dict[str, tuple[list[float], list[str]]] = {}

    def variant(self, question: str, value: float, digits: str) -> str:
        """The label of the only variant whose right answer is ``value`` to the figures that were written; ''
        where there is none, or hitting one would be no wonder."""
        if figures(digits)[1] < _FIGURES:
            return ""
        if question not in self._known:
            self._known[question] = self._answers(question)
        values, labels = self._known[question]
        mantissa = digits.lower().partition("e")[0]
        unit = 0.5 * 10.0 ** -len(mantissa.partition(".")[2])
        reach = 1.02 * unit / abs(float(mantissa)) * abs(value)
        if not values or 2.0 * reach * len(values) > _CHANCE * (values[-1] - values[0]):
            return ""
        first, last = bisect_left(values, value - reach), bisect_right(values, value + reach)
        found = set(labels[first:last])
        return found.pop() if len(found) == 1 else ""

    def _answers(self, question: str) -> tuple[list[float], list[str]]:
        """The right answers in order, each with its label; none where they would all have to be solved."""
        varied = self._store.variation(question.partition(":")[0])
        found: dict[str, float] = {}
        figures: set[tuple[str, ...]] = set()
        if varied is None:
            return [], []
        for student in (*self._students, *varied.by_owner):
            try:
                draw = varied.draw(student)
                figure = varied.figure(draw)
                if draw.label in found or (figure not in figures and len(figures) >= _FEW):
                    continue
                figures.add(figure)
                key = varied.solved(student).key(question)
            except NoKeyError:
                continue
            if isinstance(key, NumberKey):
                found[draw.label] = key.value
        ordered = sorted((value, label) for label, value in found.items())
        return [value for value, _ in ordered], [label for _, label in ordered]


def other_seed(varied: Varied, given: list[GivenValue], seeds: Iterable[str]) -> str | None:
    """The seed by which most answers are right, where by the present one most are wrong; None for none."""
    for seed in seeds if _most_are_wrong(given) else ():
        if seed == varied.course.seed:
            continue
        other = Varied(varied.name, varied.text, varied.path, varied.course._replace(seed=seed))
        if _most_are_right(given, other.solved):
            return seed
    return None


def to_first_values(varied: Varied, given: list[GivenValue]) -> bool:
    """Whether most answers are right for the numbers with which the case is shown, where for those of each
    student most are wrong."""
    first = Draw("", varied.first)
    return _most_are_wrong(given) and _most_are_right(given, lambda _: varied.task(first))


def _most_are_wrong(given: list[GivenValue]) -> bool:
    return len(given) >= _ANSWERS and 2 * sum(one.right for one in given) < len(given)


def _most_are_right(given: list[GivenValue], solved: Callable[[str], SolvedCase]) -> bool:
    return 2 * sum(_is_right(one, solved) for one in given) > len(given)


def _is_right(one: GivenValue, solved: Callable[[str], SolvedCase]) -> bool:
    try:
        key = solved(one.student).key(one.question)
    except NoKeyError:
        return False
    return isinstance(key, NumberKey) and abs(one.value - key.value) <= key.half


class VariantTask(NamedTuple):
    """One student's variant."""

    person: Person
    draw: Draw


def tasks(varied: Varied, people: Iterable[Person]) -> Iterator[VariantTask | NoKeyError]:
    """Every student's variant; the error of one for whom none suits."""
    found = list(people)
    varied.ready(person.student_id for person in found)
    for person in found:
        try:
            yield VariantTask(person, varied.draw(person.student_id))
        except NoKeyError as error:
            yield error


def values_csv(varied: Varied, found: Iterable[VariantTask]) -> str:
    """``student_id,email,variant`` and a column for each variable: for a mail merge."""
    names = [variable.name for variable in varied.case.variables]
    rows = (
        [
            safe(person.student_id),
            safe(person.email),
            draw.label,
            *(safe(draw.values[name]) for name in names),
        ]
        for person, draw in found
    )
    return csv_text(["student_id", "email", "variant", *names], rows)


def key_csv(varied: Varied, found: Iterable[VariantTask]) -> str:
    """The right answers: ``student_id,variant,case,value,unit,sense,from,to``."""
    rows = []
    for person, draw in found:
        for question, right in _asked(varied, person.student_id)[0].items():
            for key in numbers_of(right):
                size = key.value if key.kind == "position" else abs(key.value)
                low, high = size - key.half if size < 0.0 else max(size - key.half, 0.0), size + key.half
                cells = (draw.label, question, f"{key.value:.12g}", key.unit_name, sense(varied, draw, key))
                rows.append([safe(person.student_id), *cells, f"{low:.10g}", f"{high:.10g}"])
    return csv_text(["student_id", "variant", "case", "value", "unit", "sense", "from", "to"], rows)


def _asked(varied: Varied, student: str) -> tuple[dict[str, AnyKey], dict[str, str]]:
    """What a student is asked, each question with its right answer; and why others have none."""
    solved = varied.solved(student)
    found, none = dict[str, AnyKey](), dict[str, str]()
    for question in questions_of(varied.case, varied.name, varied.course):
        try:
            found[question] = solved.key(question)
        except NoKeyError as error:
            none[question] = str(error)
    return found, none


def without_key(varied: Varied, found: Iterable[VariantTask]) -> Iterator[str]:
    """What the course asks of students for whom it has no right answer; their key and sheet are without."""
    whose: dict[tuple[str, str], list[str]] = {}
    for person, _ in found:
        for left_out in _asked(varied, person.student_id)[1].items():
            whose.setdefault(left_out, []).append(person.student_id)
    for (question, why), students in whose.items():
        yield f"{question} is left out for {plural(len(students), 'student')} ({_some(students)}): {why}"


def sense(varied: Varied, draw: Draw, key: NumberKey) -> str:
    """The answer's sense in words."""
    if key.expected.turn:
        return "ccw" if key.value * key.expected.turn > 0.0 else "cw"
    if key.expected.heading is not None and not key.expected.axial:
        degrees = key.expected.heading + (0.0 if key.value > 0.0 else 180.0)
        return f"at {direction_words(degrees)}"
    solved = varied.task(draw)
    name = getattr(solved.target(key.question), "load", "")
    found = solved.answer.answers.get(name)
    return found.sense if found is not None else ""


def sheet(varied: Varied, task: VariantTask, picture: str) -> str:
    """One student's page: name, figure, values, and what is asked."""
    case = varied.read(task.draw.values)
    solved = varied.solved(task.person.student_id)
    who = " ".join(part for part in (task.person.first_name, task.person.last_name) if part)
    rows = "".join(f"<tr><td>{escape(n)}</td><td>{escape(v)}</td></tr>" for n, v in Statement(case).rows())
    lines = "".join(
        f"<p>{escape(asked(key, solved.target(question)))}</p>"
        for question, key in _asked(varied, task.person.student_id)[0].items()
    )
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(varied.name)}</title>'
        "<style>body{font-family:sans-serif;max-width:50em;margin:2em auto}svg{max-width:100%;height:auto}"
        "td{padding:.1em 1em .1em 0}</style>"
        f"<h1>{escape(case.title or varied.name)}</h1>"
        f"<p>{escape(who or task.person.student_id)}, variant {task.draw.label}</p>"
        f"{picture}<table>{rows}</table>{lines}</html>\n"
    )


def file_name(student: str) -> str:
    """A student's id as the name of a file."""
    plain = "".join(c if c.isalnum() or c in "-_.@" else "_" for c in student)[:100].strip(".")
    if plain == student:
        return plain
    import hashlib

    return f"{plain or 'student'}-{hashlib.sha256(student.encode()).hexdigest()[:6]}"
