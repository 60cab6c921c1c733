"""An example of a PrairieLearn question: the files of its folder, which ask icsolve for values and marks."""

from __future__ import annotations

import json
import uuid
from html import escape

from icsolve.grade.out.questions import Question

_SERVER = '''\
"""A question of icsolve: values by student, and marks with the cause of a mistake."""

from pathlib import Path

from icsolve.grade.one import Task

CASE = Path(__file__).parent / "case.yaml"
QUESTION = {question!r}


def generate(data):
    task = Task(CASE, str(data["variant_seed"]))
    data["params"].update(task.values)
    data["params"]["given"] = [{{"name": name, "value": value}} for name, value in task.given]
    data["params"]["asked"] = task.asked(QUESTION)
    data["correct_answers"]["answer"] = task.right(QUESTION)


def parse(data):
    task = Task(CASE, str(data["variant_seed"]))
    marks = task.grade(QUESTION, data["submitted_answers"].get("answer", ""))
    if marks["verdict"] in ("invalid", "missing"):
        data["format_errors"]["answer"] = marks["feedback"]


def grade(data):
    task = Task(CASE, str(data["variant_seed"]))
    marks = task.grade(QUESTION, data["submitted_answers"].get("answer", ""))
    data["partial_scores"]["answer"] = {{"score": marks["score"], "weight": 1, "feedback": marks["feedback"]}}
    data["score"] = marks["score"]
'''
_HTML = """\
<pl-question-panel>
  <p>{title}</p>
  <pl-figure file-name="figure.svg"></pl-figure>
  <table>{{{{#params.given}}}}<tr><td>{{{{name}}}}</td><td>{{{{value}}}}</td></tr>{{{{/params.given}}}}</table>
  <p>{{{{params.asked}}}}</p>
</pl-question-panel>
<pl-string-input answers-name="answer" label="Answer" placeholder="number, unit, direction">
</pl-string-input>
<pl-submission-panel>
  <p>{{{{partial_scores.answer.feedback}}}}</p>
</pl-submission-panel>
"""


def element(question: Question, case: str, what: str) -> dict[str, str]:
    """The files of the question's folder, by name.

    ``case`` is the text of the case, ``what`` the load that is asked for ('': the only unknown).
    """
    about = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"icsolve:{question.name}")),
        "title": question.title or question.name,
        "topic": "Instant centres",
        "tags": ["icsolve"],
        "type": "v3",
    }
    files = {
        "info.json": json.dumps(about, indent=2, ensure_ascii=False) + "\n",
        "question.html": _HTML.format(title=escape(question.title or question.name)),
        "server.py": _SERVER.format(question=what),
        "case.yaml": case,
    }
    if question.picture:
        files["clientFilesQuestion/figure.svg"] = question.picture
    return files
