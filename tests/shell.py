"""The command line in this process: what a call leaves behind, and never a traceback."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from icsolve.cli import main


def exit_status(*words: str | Path) -> int:
    """The exit status of `icsolve WORDS`; what it prints is left to ``capsys``."""
    with pytest.raises(SystemExit) as left:
        main([str(word) for word in words])
    assert isinstance(left.value.code, int)
    return left.value.code


class Ran(NamedTuple):
    """What a call left behind."""

    code: int
    out: str
    err: str

    def objects(self) -> list[dict[str, Any]]:
        """Its standard output as JSON Lines."""
        return [json.loads(line) for line in self.out.splitlines()]

    def rows(self) -> list[dict[str, str]]:
        """Its standard output as a table."""
        return list(csv.DictReader(io.StringIO(self.out)))

    def row(self, student: str, case: str = "lever") -> dict[str, str]:
        """One student's line of a table of grades."""
        (found,) = [row for row in self.rows() if (row["student_id"], row["case"]) == (student, case)]
        return found


class Shell:
    """Calls with what they print."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self.capsys = capsys

    def __call__(self, *words: str | Path) -> Ran:
        code = exit_status(*words)
        captured = self.capsys.readouterr()
        assert "Traceback" not in captured.err
        return Ran(code, captured.out, captured.err)
