"""An example of a PrairieLearn question: the files of its folder, which ask icsolve for values and marks."""

from __future__ import annotations

import json
import uuid
from html import escape
from typing import NamedTuple

from icsolve.grade.out.questions import Question

_SERVER = '''\
"""A question of icsolve: values by student, and marks with the cause of a mistake."""

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


def parse(data):
    marks = task(data).grade(QUESTION, data["submitted_answers"].get("answer", ""))
    if marks["verdict"] in ("invalid", "missing"):
        data["format_errors"]["answer"] = marks["feedback"]


def grade(data):
    marks = task(data).grade(QUESTION, data["submitted_answers"].get("answer", ""))
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


class Made(NamedTuple):
    """What a question is made from: the name and the text of its case, what load is asked for ('': the only
    unknown), the text of the course ('' for none), and whether each student has a figure of their own."""

    name: str
    case: str
    what: str
    course: str
    varied: bool


def element(question: Question, made: Made) -> dict[str, str]:
    """The files of the question's folder, by name."""
    about = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"icsolve:{question.name}")),
        "title": question.title or question.name,
        "topic": "Instant centres",
        "tags": ["icsolve"],
        "type": "v3",
    }
    figure = ""
    if question.picture:
        kind = ' type="dynamic"' if made.varied else ""
        figure = f'\n  <pl-figure file-name="figure.svg"{kind}></pl-figure>'
    files = {
        "info.json": json.dumps(about, indent=2, ensure_ascii=False) + "\n",
        "question.html": _HTML.format(title=escape(question.title or question.name), figure=figure),
        "server.py": _SERVER.format(file=f"{made.name}.yaml", question=made.what),
        f"{made.name}.yaml": made.case,
    }
    if made.course:
        files["course.yaml"] = made.course
    if question.picture and not made.varied:
        files["clientFilesQuestion/figure.svg"] = question.picture
    return files
