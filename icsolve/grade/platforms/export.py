"""Cases as questions of a platform: Moodle XML, GIFT, Canvas QTI, PrairieLearn, a Gradescope zip."""

from __future__ import annotations

import json
import os
import shlex
import uuid
from collections.abc import Callable, Iterator
from html import escape

from icsolve.case import Case
from icsolve.files import reading_text, write_whole
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course, read_roster
from icsolve.grade.keys import ChoiceKey, PlaceKey, RangeKey, numbers_of
from icsolve.grade.platforms.questions import (
    SMALLEST,
    Question,
    asked,
    figure,
    gift,
    moodle_xml,
    qti_zip,
    zipped,
)
from icsolve.grade.solved import SolvedCase, folder_of, questions_of
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.record import KEYS, VALUES, read_records
from icsolve.grade.variants.varied import Draw, Varied
from icsolve.tuples import NamedTuple
from icsolve.wording.statement import Statement

_SERVER = '''\
"""A question of icsolve: values by student, and marks with the cause of a mistake.

It needs icsolve {version} where PrairieLearn finds the Python modules of a course, in serverFilesCourse. In
the folder that icsolve was installed from, with the version of Python that PrairieLearn runs:

    python -m pip install --target COURSE/serverFilesCourse . {pins}
"""

from pathlib import Path

from icsolve.grade.course import read_course
from icsolve.grade.one import Task

CASE = Path(__file__).parent / {file!r}
COURSE = Path(__file__).parent / "course.yaml"
QUESTION = {question!r}


def task(data):
    course = read_course(COURSE) if COURSE.exists() else None
    return Task(CASE, str(data["variant_seed"]), course)


def generate(data):
    own = task(data)
    data["params"].update(own.values)
    data["params"]["given"] = [{{"name": name, "value": value}} for name, value in own.given]
    data["params"]["asked"] = own.asked(QUESTION)
    data["correct_answers"]["answer"] = own.right(QUESTION)


def file(data):
    if data["filename"] == "figure.svg":
        return task(data).figure()


def marked(data):
    return task(data).grade(QUESTION, data["submitted_answers"].get("answer") or "")


def parse(data):
    marks = marked(data)
    if marks["verdict"] in ("invalid", "missing", "review"):
        data["format_errors"]["answer"] = marks["feedback"]


def grade(data):
    marks = marked(data)
    data["partial_scores"]["answer"] = {{"score": marks["score"], "weight": 1, "feedback": marks["feedback"]}}
    data["score"] = marks["score"]
'''
_HTML = """\
<pl-question-panel>
  <p>{title}</p>{figure}
  <table>{{{{#params.given}}}}<tr><td>{{{{name}}}}</td><td>{{{{value}}}}</td></tr>{{{{/params.given}}}}</table>
  <p>{{{{params.asked}}}}</p>
</pl-question-panel>
<pl-string-input answers-name="answer" label="Answer" placeholder="number, unit, direction">
</pl-string-input>
<pl-submission-panel>
  <p>{{{{partial_scores.answer.feedback}}}}</p>
</pl-submission-panel>
"""


def element(question: Question, text: str, course: str, varied: bool) -> dict[str, str]:
    """The files of a question's folder, by name.

    Parameters
    ----------
    question : the question, of the only unknown of its case or of one of them
    text, course : the text of its case, and of the course ('' for none)
    varied : whether each student has a figure of their own
    """
    name, _, what = question.key.question.partition(":")
    title, figure, (own, *pins) = question.title or question.key.question, "", pinned()
    about = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"icsolve:{question.name}")),
        "title": title,
        "topic": "Instant centres",
        "tags": ["icsolve"],
        "type": "v3",
    }
    title = escape(title)
    if question.picture:
        kind = ' type="dynamic"' if varied else ""
        figure = f'\n  <pl-figure file-name="figure.svg"{kind} alt="{title}"></pl-figure>'
    files = {
        "info.json": json.dumps(about, indent=2, ensure_ascii=False) + "\n",
        "question.html": _HTML.format(title=title, figure=figure),
        "server.py": _SERVER.format(version=own, pins=" ".join(pins), file=f"{name}.yaml", question=what),
        f"{name}.yaml": text,
    }
    if course:
        files["course.yaml"] = course
    if question.picture and not varied:
        files["clientFilesQuestion/figure.svg"] = question.picture
    return files


Complain = Callable[[str], None]


class ExportOrder(NamedTuple):
    """What to write: the cases, where, with figures or not, how many variants of a case with variables; the
    files of the course and of the roster, for what goes on grading by itself."""

    case_store: CaseStore
    path: str
    force: bool
    figures: bool
    variants: int
    course: str = ""
    roster: str = ""
    smallest: float = 0.0
    """the least answer that the platform can hold"""
    records: tuple[str, ...] = ()
    """files of the numbers that were handed out"""
    words: bool = False
    """whether the platform hands answers on as they are written, ranges and directions among them"""


def questions(order: ExportOrder, complain: Complain) -> Iterator[Question]:
    """A question for every unknown load of every case, and for what else the course asks of it, with each of
    its variants; what can't be one is told."""

    def told(name: str, error: NoKeyError) -> None:
        complain(f"{order.case_store.paths.get(name, name)}: {error}")

    for name in sorted(order.case_store.paths):
        try:
            asks = _asked_for(order, name)
            for one in _variants(order, name) if asks else ():
                picture = figure(one.case) if order.figures else ""
                for own, what in list(asks.items()):
                    try:
                        yield _question(order, one, own, what, picture)
                    except NoKeyError as error:
                        told(name, error)
                        del asks[own]
        except NoKeyError as error:
            told(name, error)


class _Variant(NamedTuple):
    """A case with one choice of its numbers, how a platform lists it, and its title without them."""

    label: str
    solved: SolvedCase
    case: Case
    title: str


def _variants(order: ExportOrder, name: str) -> Iterator[_Variant]:
    varied = order.case_store.variation(name)
    if varied is None:
        solved = order.case_store.solved(name)
        yield _Variant(name, solved, solved.case, solved.case.title)
        return
    for n, draw in enumerate(_different(varied, order.variants), 1):
        yield _Variant(f"{name} v{n}", varied.task(draw), varied.read(draw.values), varied.title)


def _asked_for(order: ExportOrder, name: str) -> dict[str, str]:
    """What is asked of a case, by the names of the questions. Raises NoKeyError where that is nothing."""
    store = order.case_store
    varied = store.variation(name)
    case = store.solved(name).case if varied is None else varied.case
    found = questions_of(case, name, store.course)
    if not found:
        kind = "a case in space" if case.space is not None else NOTHING
        raise NoKeyError(f"{kind}, so no question")
    return found


NOTHING = "no unknown load, and nothing that the course asks of it by name"


_TRIED = 20
"""Draws for each variant that is wanted, until there are enough different ones."""


def _different(varied: Varied, most: int) -> list[Draw]:
    """So many variants of a case, no two alike; fewer where it has no more."""
    found: dict[str, Draw] = {}
    for n in range(1, _TRIED * most + 1):
        draw = varied.draw(str(n))
        found.setdefault(draw.label, draw)
        if len(found) == most:
            break
    return list(found.values())


def _question(order: ExportOrder, one: _Variant, own: str, what: str, picture: str) -> Question:
    """The question ``own`` of a variant. Raises NoKeyError where the platform cannot ask it."""
    key = one.solved.key(own)
    if isinstance(key, PlaceKey):
        raise NoKeyError(f"{what} is a place, for which no such question can ask")
    first, *others = numbers_of(key)
    choices = key.keys if isinstance(key, ChoiceKey) else (key,)
    if not order.words and any(isinstance(each, RangeKey) for each in choices):
        raise NoKeyError(f"{what} holds over a range, for which no such question can ask")
    if not order.words and first.expected.asked:
        raise NoKeyError(f"{what} asks for a direction too, for which no such question can ask")
    least = min(abs(each.value) for each in (first, *others))
    if 0.0 < least < order.smallest:
        raise NoKeyError(f"{what} is {least:.3g} {key.unit_name}, and Canvas keeps four decimals")
    text, given = asked(key, one.solved.target(own)), tuple(Statement(one.case).rows())
    _, colon, rest = own.partition(":")
    label = f"{one.label}{colon}{rest}"
    return Question(label, given, text, first, key.accepted, picture, one.title, tuple(others))


def export(kind: str, order: ExportOrder, complain: Complain) -> int:
    """Write all cases as ``kind``; how many questions there are.

    Raises KeptError or OSError.
    """
    if order.records:
        roster = read_roster(order.roster, lambda line, why: None) if order.roster else None
        order.case_store.keep_to(read_records(order.records, order.case_store, roster))
    if kind == "gradescope-zip":
        return _zip(order)
    if kind == "prairielearn":
        return _elements(order._replace(variants=1, words=True), complain)
    smallest = SMALLEST if kind == "qti" else 0.0
    order = order._replace(figures=order.figures and kind != "gift", smallest=smallest)
    found = list(questions(order, complain))
    title = order.case_store.course.title or "icsolve"
    if kind == "qti":
        write_whole(order.path, qti_zip(found, title), order.force)
    else:
        make = moodle_xml if kind == "moodle-xml" else gift
        write_whole(order.path, make(found, title), order.force)
    return len(found)


def _elements(order: ExportOrder, complain: Complain) -> int:
    """A folder a question."""
    found = list(questions(order, complain))
    course = _text(order.course) if order.course else ""
    for question in found:
        case = question.key.question.partition(":")[0]
        folder = os.path.join(order.path, folder_of(question.key.question))
        varied = order.case_store.variation(case) is not None
        for name, text in element(question, order.case_store.text(case), course, varied).items():
            write_whole(os.path.join(folder, name), text, order.force)
    return len(found)


def _zip(order: ExportOrder) -> int:
    """The zip to upload: ``setup.sh`` and ``run_autograder`` at its root, beside them all cases with the
    course, the roster, the numbers that were handed out, and icsolve itself. The same input gives the same
    bytes."""
    store = order.case_store
    cases = {f"cases/{os.path.basename(at)}": store.text(name) for name, at in store.paths.items()}
    given = (("cases/course.yaml", order.course), ("roster.csv", order.roster))
    files = {name: text for name, path in given if path and (text := _text(path))}
    records = {}
    for name, record in store.records.items():
        for path in (record.path, os.path.join(os.path.dirname(record.path), KEYS)):
            if os.path.isfile(path):
                own = os.path.basename(path) if path != record.path else VALUES
                records[f"variants/{name}/{own}"] = _text(path)
    seed = store.course.seed
    options = f" \\\n  --seed {shlex.quote(seed)}" if seed != Course().seed else ""
    options += " \\\n  --roster roster.csv" if "roster.csv" in files else ""
    options += " \\\n  --variants variants" if records else ""
    pins = " ".join(f'"{pin}"' for pin in pinned()[1:])
    programs = {"setup.sh": _SETUP.format(pins=pins), "run_autograder": _RUN.format(options=options)}
    texts = programs | dict(sorted(cases.items())) | files | dict(sorted(records.items()))
    parts = [*((name, text.encode("utf-8")) for name, text in texts.items()), *_package()]
    write_whole(order.path, zipped(parts, programs), order.force)
    return len(cases)


def _text(path: str) -> str:
    with reading_text(path, encoding="utf-8-sig") as file:
        return file.read()


_SETUP = """\
#!/usr/bin/env bash
# Gradescope runs this once, when the image is built. icsolve itself is in this zip.
set -e
export DEBIAN_FRONTEND=noninteractive
base=${{AUTOGRADER:-/autograder}}
apt-get update -y
for version in 3.13 3.12 3.11; do
  if apt-get install -y "python$version" "python$version-venv"; then break; fi
done
"python$version" -m venv "$base/venv"
"$base/venv/bin/python" -m pip install {pins}
"""
_RUN = """\
#!/usr/bin/env bash
# A student hands in answers.txt (a line a case: `press: 29.67 lbf*in ccw`) or answers.csv (case,answer).
base=${{AUTOGRADER:-/autograder}}
mkdir -p "$base/results"
cd "$base/source" || exit 1
python="$base/venv/bin/python"
[ -x "$python" ] || python=python3
"$python" -m icsolve grade "$base/submission" --cases cases --metadata "$base/submission_metadata.json" \\
  --write gradescope="$base/results/results.json" --force --quiet{options}
[ -s "$base/results/results.json" ] || printf '%s' \\
  '{{"score": 0, "output": "Nothing could be graded: hand in answers.txt or answers.csv."}}' \\
  > "$base/results/results.json"
"""


def pinned() -> list[str]:
    """The version of icsolve, and what it runs on, in the versions with which this export was made."""
    from importlib.metadata import PackageNotFoundError, version

    import icsolve

    found = [icsolve.__version__]
    for name in ("numpy", "shapely", "click", "pyyaml"):
        try:
            found.append(f"{name}=={version(name)}")
        except PackageNotFoundError:
            found.append(name)
    return found


def _package() -> Iterator[tuple[str, bytes]]:
    """The files of icsolve itself, so that a zip goes on grading by the rules it was made with."""
    import icsolve

    root = os.path.dirname(os.path.abspath(icsolve.__file__))
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "__pycache__")))
        for name in sorted(names):
            if name.endswith((".py", ".js", ".css", ".typed", ".html", ".json", ".yaml")):
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    yield "icsolve/" + os.path.relpath(path, root).replace(os.sep, "/"), file.read()
