"""Every command on cases, warnings as errors: `python .ci/every.py CASES`; status 1 where one fails.

For interpreters and versions of packages beside those with which the tests are run. Every tenth case is
taken; with ICSOLVE_FULL=1 all of them are.
"""

import contextlib
import io
import os
import sys
import tempfile
import warnings
from pathlib import Path

from icsolve.cli import main
from icsolve.manual import kinds

EACH = (
    "solve {} --all-centres --rates --reactions --report",
    "solve {} --json --sensitivity --tolerance 0.01",
    "check {}",
    "validate {}",
    "draw {} -o out.svg",
    "explain {} --bodies -o out.html",
    "page {} -o out.html",
    "sweep {} --drive 2=0:6:3 -o out.csv",
    "export moodle-xml {} -o out.xml --force",
    "export gradescope-zip {} -o out.zip --force",
    "grade answers.csv --cases {} -o out.csv --force",
)
ONCE = (
    "check {}",
    "gallery chosen -o gallery",
    "new",
    "schema",
    "variants varied.yaml --roster roster.csv -o sheets",
    "grade answers.csv --cases {} --roster roster.csv -o results.csv --html class.html --write canvas=c.csv",
    "export gift {} -o quiz.gift",
    "export prairielearn {} -o questions --no-figures",
)


def failed(line: str) -> str:
    """What went wrong with a command; '' where it ended as commands do."""
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", "backslashreplace") for _ in range(2))
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            main(line.split())
    except SystemExit as left:
        err.flush()
        said = err.buffer.getvalue().decode()  # type: ignore[attr-defined]
        refused = left.code == 2 and line.startswith(("sweep", "export", "grade"))
        return "" if left.code in (0, 1) or refused else f"{line}: {left.code}: {said[-2000:]}"
    return f"{line}: no status"


def run(cases: Path) -> int:
    """Run everything in a folder of its own; how many commands failed."""
    paths = sorted(cases.rglob("*.yaml"))
    if os.environ.get("ICSOLVE_FULL") != "1":
        paths = paths[3::10]
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path("answers.csv").write_text("student_id,case,answer\n" + "".join(f"1,{p.stem},3\n" for p in paths))
        Path("roster.csv").write_text("student_id\n1\n2\n")
        Path("chosen").mkdir()
        for path in paths[::5]:
            Path("chosen", path.name).write_text(path.read_text(encoding="utf-8"), encoding="utf-8")
        lines = [f"new {kind} -o new-{kind}.yaml" for kind in kinds()]
        lines += [line.format(path) for path in paths for line in EACH]
        lines += [line.format("chosen") for line in ONCE]
        text = "variables: {P: {range: [100, 300], step: 10}}\nlengths:"
        faults = []
        for line in lines:
            if line.startswith("variants"):
                four_bar = Path("new-four-bar.yaml").read_text(encoding="utf-8")
                varied = four_bar.replace("force: 100,", "force: $P,").replace("lengths:", text, 1)
                Path("varied.yaml").write_text(varied, encoding="utf-8")
            said = failed(line)
            if said:
                faults.append(said)
                sys.stdout.write(f"{said}\n")
    versions = f"Python {sys.version.split()[0]}"
    sys.stdout.write(f"{versions}: {len(lines)} commands on {len(paths)} cases, {len(faults)} failed\n")
    return len(faults)


if __name__ == "__main__":
    os.environ["ICSOLVE_DEBUG"] = "1"
    warnings.simplefilter("error")
    sys.exit(min(run(Path(sys.argv[1]).absolute()), 1))
