"""Mutated cases and answers through every command: each ends in a result or a refusal, and soon.

`test_fuzz.py` takes a small sample; `python tests/fuzzing.py COUNT SEED [--apart]` any number, ``--apart``
with a process for each command.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from typing import NamedTuple

from corpus import ALL
from icsolve.cli import main
from icsolve.manual import kinds, template
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.names import Stop
from sizes import FULL
from trees import document, tree

ROOT = Path(__file__).parent.parent
FOUND = Path(__file__).parent / "data" / "found"
"""Inputs that once broke something."""
SECONDS = 10
SHARE = 1.0
"""Of the cases, the share that goes through the commands that take longest: the gallery and the exports."""
BYTES = 1 << 30
Dice = random.Random
TOKENS = [
    *r"[ ] { } , : ? - # & * ! | > ' % @ ` --- ... é ² ½ ٣ '' \ << = ~ null true NO on .inf -.nan".split(),
    *"1e999 1e-999 0x1F 0o7 1_000 12:30 2024-13-45 !!int !!bool &a *a unknown like centroid icsolve".split(),
    *"joints points O2-A A' -- @x 1/0 N*m ft-lb N^9 kg lbm ° 30% [[[]]] {x:1} [unknown] cw ccw".split(),
    *["", '"', '""', "\t", "\n", "\r", "\0", "\x1b", "\x85", "\u2028", "\ufeff", "\ud800"],
    *["{like: {like: P}}", "{: }", "$P", "$", "${P}/0", "1e99999999", "  ", "\n  ", "\n- ", ": ", "- - "],
    *["9" * 400, "x" * 2000, "A" * 130, "(" * 60, "-" * 90, "'" * 70],
]
NUMBERS = (
    "0 -0 1 -1 2 3 0.1 90 -90 180 360 45 1e-6 1e-9 1e-13 1e-160 1e-300 1e6 1e9 1e13 1e100 1e160 1e300".split()
)
ANSWERS = [
    *"33.76 -33.76 +3,376 1/3 1/0 1e9999 .5e-400 nan inf 90° 30% 5ft-lb 1e99999999 (3;4) - =".split(),
    *[
        "",
        " ",
        " " * 3000,
        "33.76 lbf*in cw",
        "3 x 10^2 N",
        "1,234.5",
        "(1, 2)",
        "412,7 N to the left",
        "9" * 500,
    ],
    *[
        "a" * 800,
        "- - -",
        "1 2 3",
        "\0",
        '"',
        "10 N at 30 deg above -x",
        "12^12^12",
        "((((((((1",
        "½ kN",
        "٣",
    ],
]
_NUMBER = re.compile(r"(?<![\w.$'])-?\d+(?:\.\d*)?(?:e-?\d+)?(?![\w.'])")


def bases() -> list[str]:
    """Texts of cases to begin with: of every kind, as written, and those that once broke something."""
    cases = sorted((ROOT / "cases").rglob("*.yaml"))
    found = sorted(FOUND.glob("*.yaml"))
    started = [template(kind) for kind in kinds()]
    return [*ALL.values(), *started, *(path.read_text() for path in (*cases, *found, *found))]


def by_characters(dice: Dice, text: str) -> str:
    """Characters lost, doubled, swapped; strange ones put in."""
    for _ in range(dice.randint(1, 4)):
        at, to = dice.randrange(len(text) + 1), dice.randrange(len(text) + 1)
        at, to = min(at, to), min(max(at, to), at + dice.choice((0, 1, 1, 5, 40)))
        middle = dice.choice(
            ("", text[at:to] * 2, dice.choice(TOKENS), text[at:to][::-1], chr(dice.randrange(0x250)))
        )
        text = text[:at] + middle + text[to:]
    return text


def by_lines(dice: Dice, text: str) -> str:
    """Lines lost, doubled, moved, indented."""
    lines = text.split("\n")
    for _ in range(dice.randint(1, 3)):
        at, to = dice.randrange(len(lines)), dice.randrange(len(lines))
        done = dice.randrange(5)
        if done == 0:
            del lines[at]
        elif done == 1:
            lines.insert(to, lines[at])
        elif done == 2:
            lines[at], lines[to] = lines[to], lines[at]
        elif done == 3:
            lines[at] = " " * dice.randint(1, 4) + lines[at]
        else:
            lines[at] = lines[at].strip()
        lines = lines or [""]
    return "\n".join(lines)


def by_nodes(dice: Dice, text: str) -> str:
    """Values of the tree exchanged, among them and with those of another case."""
    root = tree(text)
    other = nodes(tree(dice.choice([*ALL.values(), text, text])))
    for _ in range(dice.randint(1, 3)):
        node = dice.choice([one for one in nodes(root) if not isinstance(one, Scalar)])
        value = deepcopy(dice.choice([*other, Scalar(dice.choice(TOKENS), False, (1, 1))]))
        if isinstance(node, Mapping):
            key = dice.choice([*node.items, dice.choice(KEYS)])
            node.items[key] = value
            if dice.random() < 0.2:
                del node.items[key]
        elif isinstance(node, Sequence) and node.items:
            at = dice.randrange(len(node.items))
            if dice.random() < 0.3:
                del node.items[at]
            else:
                node.items[at] = value
    return document(root)


def by_numbers(dice: Dice, text: str) -> str:
    """Numbers exchanged for others, extreme, equal or nearly so."""
    for _ in range(dice.randint(1, 4)):
        found = list(_NUMBER.finditer(text, text.find("\n")))
        if not found:
            return text
        at, other = dice.choice(found), dice.choice(found).group()
        value = dice.choice(
            [dice.choice(NUMBERS), other, f"{other}0000000{dice.randint(1, 9)}" if "." in other else other]
        )
        text = text[: at.start()] + value + text[at.end() :]
    return text


def by_names(dice: Dice, text: str) -> str:
    """One word for another of the same case, everywhere or in one place."""
    words = sorted(set(re.findall(r"\b[A-Za-z][\w']{0,12}\b", text)))
    old, new = dice.choice(words), dice.choice(words)
    return re.sub(rf"\b{re.escape(old)}(?![\w'])", new, text, count=dice.choice((0, 1, 1)))


MUTATIONS = [by_characters, by_lines, by_nodes, by_nodes, by_numbers, by_numbers, by_numbers, by_names]


def nodes(node: Node) -> list[Node]:
    """A node and all in it."""
    if isinstance(node, Scalar):
        return [node]
    inner = node.items.values() if isinstance(node, Mapping) else node.items
    return [node, *[found for value in inner for found in nodes(value)]]


KEYS = sorted(
    {
        key
        for text in ALL.values()
        for node in nodes(tree(text))
        if isinstance(node, Mapping)
        for key in node.items
    }
)


def mutated(dice: Dice, texts: list[str]) -> str:
    """A case that nobody wrote."""
    text = dice.choice(texts)
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        try:
            text = dice.choice(MUTATIONS)(dice, text)
        except (ValueError, IndexError, AssertionError, Stop):
            continue  # no longer a tree
    return text + "\n"


def answers(dice: Dice, names: list[str]) -> str:
    """A table of answers, with what students and spreadsheets do to it."""
    sep = dice.choice(",,,;\t")
    rows = [sep.join(dice.choice([("student_id", "case", "answer"), ("student_id", *names[:3])]))]
    for _ in range(dice.randint(1, 6)):
        cells = [
            dice.choice(["1", "007", "é", ""]),
            dice.choice([*names, "case", "case:T12", "case:w4/w2", "case:I24"]),
        ]
        rows.append(
            sep.join([*cells, f'"{dice.choice(ANSWERS)}"' if dice.random() < 0.6 else dice.choice(ANSWERS)])
        )
    text = "\n".join(rows) + "\n"
    return by_characters(dice, text) if dice.random() < 0.3 else text


def commands(dice: Dice, text: str) -> list[list[str]]:
    """All verbs, with options drawn; `solve` without any comes first."""
    names = re.findall(r"\b([A-Z][\w']?[A-Z]?)\s*:", text) or ["AB"]
    path = dice.choice(paths(text))
    spans = ["0:360:30", "10:12:0.5", "0:1e-9:1e-9", "-180:180:90", "0,0,1e300", "1:100000:50000", "0:0:1"]
    vary = dice.choice([["--vary", f"{path}={dice.choice(spans)}"], ["--drive", f"2={dice.choice(spans)}"]])
    find = dice.choice(["dead", "max", "rest", "neutral", "hold", f"{dice.choice(names)}=1"])
    kind = dice.choice(
        [["moodle-xml"], ["gift"], ["qti"], ["prairielearn", "--no-figures"], ["gradescope-zip"]]
    )
    words = [path, dice.choice(names), *re.findall(r"[a-z]+", text)[:40]]
    shown = [
        ["draw", "case.yaml", *some(dice, DRAW)],
        ["explain", "case.yaml", *some(dice, EXPLAIN)],
        ["sheet", "case.yaml", *some(dice, [["--title", dice.choice(TOKENS[:40])], ["-o", "exam.tex"]])],
    ]
    every = [
        ["solve", "case.yaml"],
        ["solve", "case.yaml", *some(dice, SOLVE), *dice.choice([[], ["--stability", path]])],
        ["check", "case.yaml", *some(dice, [["--json"], ["--table"]])],
        ["validate", "case.yaml"],
        ["ways", "case.yaml", *some(dice, [["--json"]])],
        *([["page", "case.yaml"], *shown] if FULL else [dice.choice(shown)]),  # the gallery has them
        ["gallery", "case.yaml", "-o", "shown", "--force"],
        ["sweep", "case.yaml", *vary, *some(dice, SWEEP), *dice.choice([[], ["--find", find]])],
        ["sweep", "case.yaml", "--vary", f"{path}={dice.choice(spans)}", "--find", find, "--json"],
        ["variants", "case.yaml", "--roster", "roster.csv", "-o", "sheets", "--force", "--no-figures"],
        ["grade", "answers.csv", "--cases", "case.yaml", "--force", "-o", "graded.csv", *some(dice, GRADE)],
        ["grade", "answers.csv", "--cases", "case.yaml", "--force", *AGAIN, *some(dice, GRADE)],
        ["export", *kind, "case.yaml", "-o", f"quiz-{kind[0]}", "--force", "--count", "2"],
        dice.choice(
            [["new", dice.choice(words)], ["manual", dice.choice(words)], ["manual", dice.choice(TOPICS)]]
        ),
    ]
    return [one for one in every if one[0] not in ("gallery", "export") or dice.random() < SHARE]


SOLVE = [
    *(
        [option]
        for option in ("--all-centres", "--rates", "--reactions", "--report", "--sensitivity", "--json")
    ),
    *(["--dynamic"], ["--tolerance=0.01"]),
]
DRAW = [["--bodies"], ["--circle"], ["--velocities"], ["--centres=all"], ["--step=1"], ["-o", "case.tex"]]
EXPLAIN = [["--bodies"], ["--format", "html"], ["--format", "tex"], ["--format", "md"]]
SWEEP = [
    *([option] for option in ("--error", "--points", "--centres", "--rates", "--velocities", "--dynamic")),
    *(["--dynamic", "--accelerations"], ["--plot", "plot.svg"]),
]
GRADE = [
    *(
        ["--html", "class.html"],
        ["--jsonl", "graded.jsonl"],
        ["--review", "queue.csv"],
        ["--students", "pages"],
    ),
    *(["--write", "canvas=canvas.csv"], ["--roster", "roster.csv"], ["--overrides", "marks.csv"]),
    *(["--write", "prairielearn-csv=pl.csv"], ["--write", "junit=junit.xml"], ["--total", "Homework (1)"]),
]
AGAIN = ["--against", "graded.csv", "--changes", "changes.csv", "--overrides", "marks.csv", "-o", "again.csv"]
TOPICS = [*TOKENS, "format", "friction", "rope", "near", "statuses", "units", "12", "case.yaml"]
READERS = ("solve", "check", "validate", "ways", "draw", "explain", "page", "sheet")
"""Verbs that end with 2 only where a file is refused, and then say where in it."""


def some(dice: Dice, options: list[list[str]]) -> list[str]:
    """At most two of the options."""
    return [word for option in dice.sample(options, dice.randint(0, min(2, len(options)))) for word in option]


def paths(text: str) -> list[str]:
    """Paths of numbers of a case, and one that it has not."""
    try:
        sections = tree(text).items
    except (ValueError, AssertionError, Stop):
        return ["angles.AB"]
    found = ["angles.AB"]
    for section in ("angles", "lengths", "points", "loads", "links"):
        node = sections.get(section)
        for key, value in node.items.items() if isinstance(node, Mapping) else ():
            found += [f"{section}.{key}"] * (3 if section == "angles" else 1)
            inner = (
                list(value.items) if isinstance(value, Mapping) else ["x", "y"] if section == "points" else []
            )
            found += [f"{section}.{key}.{name}" for name in inner]
    return [*found, "joints.A.mu", "joints.0.mu"]


class Fault(NamedTuple):
    """A command that ended otherwise than it may."""

    command: str
    why: str
    trace: str
    case: str
    table: str


class TooLong(BaseException):
    """More than `SECONDS`; no code that guards against exceptions holds it up."""


@contextlib.contextmanager
def limited() -> Iterator[None]:
    """An alarm after `SECONDS` of work, however busy the machine is."""

    def ring(number: int, frame: object) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def run(command: list[str], apart: bool) -> tuple[int, str, str]:
    """Status, what stood on standard error, and the trace of a fault."""
    code, _, said, trace = printed(command, apart)
    return code, said, trace


def printed(command: list[str], apart: bool) -> tuple[int, str, str, str]:
    """Status, what stood on standard output and error, and the trace of a fault."""
    if apart:
        env = {**os.environ, "PYTHONPATH": str(ROOT), "ICSOLVE_DEBUG": "1"}
        words = [word.encode(errors="surrogatepass").replace(b"\0", b"") for word in command]  # as a shell
        call = [sys.executable, "-m", "icsolve", *words]
        ran = subprocess.run(call, env=env, capture_output=True, check=False, preexec_fn=_little)
        said = ran.stderr.decode(errors="replace")
        return ran.returncode, ran.stdout.decode(errors="replace"), said.partition("\nTraceback")[0], said
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", "backslashreplace") for _ in range(2))
    try:
        with limited(), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            main(command)
    except SystemExit as left:
        out.flush()
        err.flush()
        text, said = out.buffer.getvalue().decode(), err.buffer.getvalue().decode()
        return int(left.code or 0), text, said.partition("\nTraceback")[0], said
    except TooLong:
        return 124, "", "", traceback.format_exc()
    return 0, "", "", ""


def _little() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (BYTES * 3, BYTES * 3))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


def _work() -> float:
    """Seconds of the processor that this process, and those that it started and that ended, have taken."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def most_memory() -> int:
    """Bytes that this process, or the largest that it started, has held at most."""
    return 1024 * max(
        resource.getrusage(whose).ru_maxrss for whose in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )


def faults_of(
    dice: Dice, text: str, apart: bool = False, most: int = 0, done: Counter[str] | None = None
) -> list[Fault]:
    """What is wrong with the commands on one case in the working folder.

    All verbs share one reader: a case that the first refuses goes through two more; others through all, or
    ``most`` that are drawn.
    """
    Path("case.yaml").write_text(text, encoding="utf-8", errors="surrogatepass")
    names = re.findall(r"^  ([A-Z]\w*):", text, re.MULTILINE)
    table = answers(dice, names or ["case"])
    Path("answers.csv").write_text(table, encoding="utf-8", errors="surrogatepass")
    marks = f"student_id,case,score,comment\n1,case,{dice.choice(ANSWERS)},{dice.choice(TOKENS)}\n"
    Path("marks.csv").write_text(marks, encoding="utf-8", errors="surrogatepass")
    Path("roster.csv").write_text("student_id,name\n1,A\n007,B\n", encoding="utf-8")
    found = []
    first, *left = commands(dice, text)
    left = [first, *(dice.sample(left, most) if most else left)]
    held = most_memory()
    while left:
        command = left.pop(0)
        began = _work()
        code, out, said, trace = printed(command, apart)
        if done is not None:
            done["commands"] += 1
            done["milliseconds"] = max(done["milliseconds"], round(1000 * (_work() - began)))
        why = ""
        if code not in (0, 1, 2):
            why = f"status {code}: {said[-300:]}"
        elif code == 2 and command[0] in READERS and not re.search(r":\d+:\d+: |Usage: ", said):
            why = f"no line and column: {said[-300:]}"
        elif "--json" in command and code < 2 and not _is_json(out):
            why = f"no JSON: {out[:300]}"
        elif held < BYTES < most_memory():
            why = f"{most_memory()} bytes"
        if why:
            found.append(Fault(" ".join(command), why, trace, text, table))
        if command == ["solve", "case.yaml"]:
            left = dice.sample(left, min(2, len(left))) if code == 2 else left
    return found


def _is_json(text: str) -> bool:
    def strange(word: str) -> None:
        raise ValueError(word)

    try:
        for line in text.splitlines():
            json.loads(line, parse_constant=strange)
    except ValueError:
        return False
    return True


def campaign(count: int, seed: int, apart: bool = False, done: Counter[str] | None = None) -> Iterator[Fault]:
    """Faults of ``count`` mutated cases; ``done`` counts, and is told every 500 cases."""
    done = Counter() if done is None else done
    texts = bases()
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for n in range(count):
            dice = random.Random(f"{seed} {n}")
            found = faults_of(dice, mutated(dice, texts), apart, 2 if apart else 0, done)
            done.update(cases=1, faults=len(found))
            if done["cases"] % 500 == 0:
                sys.stdout.write(f"{counted(done)}\n")
                sys.stdout.flush()
            yield from found


def counted(done: Counter[str]) -> str:
    """How much a campaign has done, in words."""
    many = ", ".join(f"{done[what]} {what}" for what in ("cases", "commands", "faults"))
    return f"{many}, {done['milliseconds'] / 1000:g} s at most"


def _place(trace: str) -> str:
    """Where a fault happened, to tell faults apart."""
    lines = [
        line.strip() for line in trace.splitlines() if line.strip().startswith("File ") and "icsolve/" in line
    ]
    last = [line for line in trace.strip().splitlines() if line and not line.startswith(" ")][-1:]
    return " ".join([*(re.sub(r".*icsolve/", "", line) for line in lines[-2:]), *last])[:300]


def main_campaign(many: int, first: int, apart: bool) -> None:
    """Tell each fault of another kind as it comes, and keep its files in ``$FUZZ_OUT``."""
    seen: Counter[str] = Counter()
    done: Counter[str] = Counter()
    os.environ["ICSOLVE_DEBUG"] = "1"
    keep = Path(os.environ.get("FUZZ_OUT", "/tmp/fuzz"))
    keep.mkdir(exist_ok=True)
    for fault in campaign(many, first, apart, done):
        where = _place(fault.trace) or fault.why[:200]
        seen[where] += 1
        if seen[where] == 1:
            name = f"{first}-{len(seen)}"
            (keep / f"{name}.yaml").write_text(fault.case, errors="surrogatepass")
            (keep / f"{name}.csv").write_text(fault.table, errors="surrogatepass")
            (keep / f"{name}.txt").write_text(f"{fault.command}\n{fault.why}\n{fault.trace}")
            why = fault.why[:100].replace("\n", " ")
            sys.stdout.write(f"{name} {fault.command} | {why} | {where}\n")
            sys.stdout.flush()
    mega = most_memory() // 1_000_000
    sys.stdout.write(f"{counted(done)} of {len(seen)} kinds, {mega} MB at most\n")


if __name__ == "__main__":
    main_campaign(int(sys.argv[1]), int(sys.argv[2]), "--apart" in sys.argv)
