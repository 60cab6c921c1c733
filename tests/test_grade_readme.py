"""The README's section on grading: its sessions are run, its tables are complete."""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path
from typing import Any

import pytest
import yaml

from icsolve.cli.varying import QUESTIONS
from icsolve.grade.course import _COURSE, _POLICY, read_course
from icsolve.grade.judge import VERDICTS
from icsolve.grade.mistakes.lookup import CODES
from icsolve.grade.platforms.write import KINDS as OUTPUTS
from icsolve.grade.results import HEADER
from icsolve.grade.written.answer import Reader
from shell import exit_status
from texts import PAGES, files

SECTION = PAGES["grading"]
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", SECTION, re.DOTALL | re.MULTILINE)
COURSE, VARIANTS = (text for kind, text in BLOCKS if kind == "yml")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files that the section speaks of; the case of the README's start, with variables in ``cases``."""
    monkeypatch.chdir(tmp_path)
    press = files()["press.yaml"]
    (tmp_path / "press.yaml").write_text(press, encoding="utf-8")
    varied: dict[str, Any] = yaml.safe_load(press)
    for key, value in yaml.safe_load(VARIANTS).items():
        varied[key] = {**varied.get(key, {}), **value}
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "press.yaml").write_text(yaml.safe_dump(varied), encoding="utf-8")
    (tmp_path / "roster.csv").write_text("student_id\n0017\n0018\n")
    (answers,) = (text for kind, text in BLOCKS if kind == "csv")
    (tmp_path / "answers.csv").write_text(answers, encoding="utf-8")
    marks = 'student_id,case,score,comment\n0019,press,0.5,"two readings, one right"\n'
    (tmp_path / "marks.csv").write_text(marks, encoding="utf-8")
    return tmp_path


def test_every_session_prints_what_the_section_shows(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A second grading writes over nothing, so the results of the first are put aside."""
    for text in (text for kind, text in BLOCKS if kind == "shell"):
        for command, output in re.findall(r"^\$ icsolve (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
            (folder / "results.csv").unlink(missing_ok=True)
            exit_status(*shlex.split(command))
            shown = capsys.readouterr()
            flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE if "..." in output else 0
            said = "\n".join(line for line in (shown.err + shown.out).splitlines() if "roster" not in line)
            good = doctest.OutputChecker().check_output(output, said + "\n" if said else "", flags)
            assert good, (command, shown)
    assert {path.name for path in (folder / "sheets" / "press").iterdir()} == {"values.csv", "key.csv"}


def test_the_columns_of_the_results_are_those_of_the_section() -> None:
    assert HEADER in SECTION.replace("\n", "")


def test_the_course_of_the_section_is_read_and_has_every_key(tmp_path: Path) -> None:
    path = tmp_path / "course.yaml"
    path.write_text(COURSE, encoding="utf-8")
    assert tuple(read_course(path).own) == ("press", "press:w4/w2")
    keys = {line.partition(":")[0] for line in COURSE.splitlines()}
    assert keys == {*_COURSE, *_POLICY, "cases", "map"}


def test_the_answers_of_the_section_have_one_reading() -> None:
    told = " ".join(SECTION.split()).partition("**Answers**")[2].partition("What has two readings")[0]
    texts = re.findall(r"`([^`]+)`", told)
    assert len(texts) > 10
    assert [text for text in texts if Reader().read(text).flag] == []


def test_every_verdict_code_and_kind_stands_in_the_section() -> None:
    words = set(re.findall(r"`([a-z-]+)`", SECTION)) | set(re.findall(r"[a-z-]+", " ".join(
        re.findall(r"`icsolve export ([^`]+)`", SECTION)
    )))  # fmt: skip
    assert {*VERDICTS, *CODES, *OUTPUTS, *QUESTIONS} - words == set()
