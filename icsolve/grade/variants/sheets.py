"""What a class gets: every student's values, the key, a figure of each variant, and a sheet to hand out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape

from icsolve.grade.keys import AnyKey, NumberKey, numbers_of
from icsolve.grade.platforms.given import given
from icsolve.grade.platforms.questions import asked
from icsolve.grade.platforms.questions import figure as drawn
from icsolve.grade.results import csv_text, safe
from icsolve.grade.roster import Person
from icsolve.grade.solved import SolvedCase, unknowns
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.varied import Draw, Varied
from icsolve.tuples import NamedTuple


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
        for question in questions(varied):
            for key in numbers_of(varied.key(question, person.student_id)):
                size = key.value if key.kind == "position" else abs(key.value)
                low, high = size - key.half if size < 0.0 else max(size - key.half, 0.0), size + key.half
                cells = (draw.label, question, f"{key.value:.12g}", key.unit_name, sense(varied, draw, key))
                rows.append([safe(person.student_id), *cells, f"{low:.10g}", f"{high:.10g}"])
    return csv_text(["student_id", "variant", "case", "value", "unit", "sense", "from", "to"], rows)


def questions(varied: Varied) -> list[str]:
    """The questions of a case with variables: its unknown loads."""
    names = unknowns(varied.case)
    return [varied.name] if len(names) == 1 else [f"{varied.name}:{name}" for name in names]


def sense(varied: Varied, draw: Draw, key: NumberKey) -> str:
    """The answer's sense in words."""
    if key.expected.turn:
        return "ccw" if key.value * key.expected.turn > 0.0 else "cw"
    if key.expected.heading is not None and not key.expected.axial:
        degrees = key.expected.heading + (0.0 if key.value > 0.0 else 180.0)
        return f"at {round(degrees, 6) % 360.0:.6g} deg"
    solved = varied.task(draw)
    name = getattr(solved.target(key.question), "load", "")
    found = solved.answer.answers.get(name)
    return found.sense if found is not None else ""


def figure(varied: Varied, draw: Draw) -> str:
    """The variant drawn without its answer, as SVG."""
    return drawn(varied.read(draw.values))


def sheet(varied: Varied, task: VariantTask, picture: str) -> str:
    """One student's page: name, figure, values, and what is asked."""
    case = varied.read(task.draw.values)
    solved = varied.solved(task.person.student_id)
    who = " ".join(part for part in (task.person.first_name, task.person.last_name) if part)
    rows = "".join(f"<tr><td>{escape(n)}</td><td>{escape(v)}</td></tr>" for n, v in given(case))
    lines = "".join(
        f"<p>{escape(asked(key, solved.target(key.question)))}</p>" for key in _keys(varied, solved)
    )
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(varied.name)}</title>'
        "<style>body{font-family:sans-serif;max-width:50em;margin:2em auto}svg{max-width:100%;height:auto}"
        "td{padding:.1em 1em .1em 0}</style>"
        f"<h1>{escape(case.title or varied.name)}</h1>"
        f"<p>{escape(who or task.person.student_id)}, variant {task.draw.label}</p>"
        f"{picture}<table>{rows}</table>{lines}</html>\n"
    )


def _keys(varied: Varied, solved: SolvedCase) -> list[AnyKey]:
    return [solved.key(question) for question in questions(varied)]


def file_name(student: str) -> str:
    """A student's id as the name of a file."""
    plain = "".join(c if c.isalnum() or c in "-_.@" else "_" for c in student)[:100].strip(".")
    if plain == student:
        return plain
    import hashlib

    return f"{plain or 'student'}-{hashlib.sha256(student.encode()).hexdigest()[:6]}"
