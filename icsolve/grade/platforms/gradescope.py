"""The zip that makes an autograder of Gradescope."""

from __future__ import annotations

import io
import os
import shlex
import zipfile
from collections.abc import Iterator, Mapping
from typing import NamedTuple

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
    """icsolve and what it runs on, in the versions with which this export was made."""
    from importlib.metadata import PackageNotFoundError, version

    import icsolve

    found = [f"icsolve=={icsolve.__version__}"]
    for name in ("numpy", "shapely", "click", "pyyaml"):
        try:
            found.append(f"{name}=={version(name)}")
        except PackageNotFoundError:
            found.append(name)
    return found


class AutograderSource(NamedTuple):
    """What goes into an autograder: the texts of cases by file name, of the course and of the roster ('' for
    none), and the seed of the variants."""

    cases: Mapping[str, str]
    course: str = ""
    roster: str = ""
    seed: str = ""
    records: Mapping[str, str] = {}
    """the numbers that were handed out, by file"""


def autograder_zip(source: AutograderSource) -> bytes:
    """The zip to upload: ``setup.sh`` and ``run_autograder`` at its root, the cases and icsolve beside them.

    The same input gives the same bytes.
    """
    options = f" \\\n  --seed {shlex.quote(source.seed)}" if source.seed else ""
    options += " \\\n  --roster roster.csv" if source.roster else ""
    options += " \\\n  --variants variants" if source.records else ""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        pins = " ".join(f'"{pin}"' for pin in pinned()[1:])
        _add(archive, "setup.sh", _SETUP.format(pins=pins).encode(), executable=True)
        _add(archive, "run_autograder", _RUN.format(options=options).encode(), executable=True)
        for name, text in sorted(source.cases.items()):
            _add(archive, f"cases/{name}", text.encode("utf-8"))
        for name, text in (("cases/course.yaml", source.course), ("roster.csv", source.roster)):
            if text:
                _add(archive, name, text.encode("utf-8"))
        for name, text in sorted(source.records.items()):
            _add(archive, f"variants/{name}", text.encode("utf-8"))
        for name, data in _package():
            _add(archive, name, data)
    return buffer.getvalue()


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


def _add(archive: zipfile.ZipFile, name: str, data: bytes, executable: bool = False) -> None:
    entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
    entry.external_attr = (0o100755 if executable else 0o100644) << 16
    entry.create_system = 3
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, data)
