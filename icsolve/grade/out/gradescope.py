"""Gradescope: ``results.json`` of an autograder, and the zip that makes one."""

from __future__ import annotations

import io
import json
import os
import zipfile
from collections.abc import Iterable, Mapping
from typing import Any

from icsolve import __version__
from icsolve.grade.out.rows import Row

_SETUP = f"""\
#!/usr/bin/env bash
set -e
apt-get update -y && apt-get install -y python3 python3-pip
cd /autograder/source
wheel=$(ls ./*.whl 2>/dev/null | head -n 1 || true)
python3 -m pip install --break-system-packages "${{wheel:-icsolve=={__version__}}}" \\
  || python3 -m pip install "${{wheel:-icsolve=={__version__}}}"
"""
_RUN = """\
#!/usr/bin/env bash
# A student hands in answers.txt (a line a case: `press: 29.67 lbf*in ccw`) or answers.csv (case,answer).
base=${AUTOGRADER:-/autograder}
mkdir -p "$base/results"
cd "$base/source" || exit 1
python3 -m icsolve grade "$base/submission" --cases cases --metadata "$base/submission_metadata.json" \\
  --write gradescope="$base/results/results.json" --force --quiet
[ -s "$base/results/results.json" ] || printf '%s' \\
  '{"score": 0, "output": "No file with answers was found: hand in answers.txt or answers.csv."}' \\
  > "$base/results/results.json"
"""
_STATUS = {"right": "passed"}


def results(rows: Iterable[Row], title: str = "") -> dict[str, Any]:
    """The object of ``results.json`` for one student's rows."""
    rows = list(rows)
    return {
        "score": sum(row.score for row in rows),
        "output": title or f"{sum(row.verdict == 'right' for row in rows)} of {len(rows)} answers are right.",
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(row, number) for number, row in enumerate(rows, 1)],
        "extra_data": {"schema": "icsolve/grade/1"},
    }


def _test(row: Row, number: int) -> dict[str, Any]:
    answer = f"Your answer: {row.raw_answer}\n" if row.raw_answer else ""
    return {
        "score": row.score,
        "max_score": row.max_score,
        "status": _STATUS.get(row.verdict, "failed"),
        "name": row.case,
        "name_format": "text",
        "number": str(number),
        "output": f"{answer}{row.feedback}",
        "output_format": "text",
        "tags": [tag for tag in (row.verdict, *row.code.split()) if tag],
        "visibility": "visible",
        "extra_data": {"verdict": row.verdict, "code": row.code, "variant": row.variant},
    }


def dumped(entry: Mapping[str, Any]) -> str:
    """JSON text for a file."""
    return json.dumps(entry, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def autograder_zip(cases: Mapping[str, str], course: str | None = None, wheel: str | None = None) -> bytes:
    """The zip to upload: ``setup.sh`` and ``run_autograder`` at its root, the cases beside them.

    ``cases`` are texts by file name; the same input gives the same bytes.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        _add(archive, "setup.sh", _SETUP.encode(), executable=True)
        _add(archive, "run_autograder", _RUN.encode(), executable=True)
        for name, text in sorted(cases.items()):
            _add(archive, f"cases/{name}", text.encode("utf-8"))
        if course is not None:
            _add(archive, "cases/course.yaml", course.encode("utf-8"))
        if wheel is not None:
            with open(wheel, "rb") as file:
                _add(archive, os.path.basename(wheel), file.read())
    return buffer.getvalue()


def _add(archive: zipfile.ZipFile, name: str, data: bytes, executable: bool = False) -> None:
    entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
    entry.external_attr = (0o100755 if executable else 0o100644) << 16
    entry.create_system = 3
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, data)
