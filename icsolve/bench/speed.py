"""Speed: one scene, fresh and again, a full turn against numpy and C, other programs; answers judged beside
the reading of them, grading by the whole command, variants, a figure."""

from __future__ import annotations

import csv
import ctypes
import math
import os
import random
import sys
import tempfile
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from icsolve.bench.accuracy import FORWARD, Score, Truth, truth
from icsolve.bench.full_turn import (
    FOUR_BAR,
    FOUR_BAR_CASE,
    MECHANISMS,
    PEERS,
    POSITIONS,
    TORQUE,
    Array,
    CrankTurning,
    compiled,
    componentwise,
    in_c,
    ran,
    written_out,
)
from icsolve.bench.gates import Effort, Gate, Kept, cpu_seconds, least, once, peak_memory, ratio, table
from icsolve.case import Case
from icsolve.files import scratch
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.judge import judge
from icsolve.grade.keys import NumberKey
from icsolve.grade.solved import unknowns
from icsolve.grade.written.answer import Reader
from icsolve.manual import kinds, template
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.bench.full_turn import Ran

TURN, MILLION = POSITIONS, 1_000_000
PATH = "angles.AB"
SWEPT, BOUNDED, BY_HAND, IN_C = "icsolve sweep", "icsolve sweep, bounds", "numpy by hand", "C -O3"
SAMPLE = 24
"""Positions of a turn at which the torque is known to sixty digits."""

Torque = Callable[[], Array]


class Timed(NamedTuple):
    """A method on so many positions of a mechanism: its seconds, and its worst error over a sample,
    relative and over (kappa + 1) u."""

    method: str
    mechanism: str
    positions: int
    seconds: float
    error: float
    per_unit: float

    @property
    def score(self) -> Score:
        """The full turn as one family of scenes."""
        micros = 1e6 * self.seconds / self.positions
        return Score(self.method, self.mechanism, self.error, self.per_unit, micros, 0, 0, self.positions)


def full_turns(positions: int, seconds: float) -> dict[str, dict[str, Timed]]:
    """Every mechanism at so many positions of its crank, by every method; C where it compiles."""
    with tempfile.TemporaryDirectory() as folder:
        library = compiled(folder)
        each = seconds / len(MECHANISMS)
        return {m.name: _timed(m, positions, each, library) for m in MECHANISMS}


def _timed(
    mechanism: CrankTurning, positions: int, seconds: float, library: ctypes.CDLL | None
) -> dict[str, Timed]:
    degrees: Array = np.linspace(60.0, 420.0, positions, endpoint=False)
    calls = _calls(mechanism, degrees, library)
    times = least(list(calls.values()), seconds)
    known = _known(mechanism, degrees)
    result = {}
    for (method, call), took in zip(calls.items(), times, strict=True):
        found = call()
        errors = [(true.error(float(found[k])), true) for k, true in known.items()]
        worst = max(true.per_unit(error) for error, true in errors)
        error = max(error for error, _ in errors)
        result[method] = Timed(method, mechanism.name, positions, took, error, worst)
    return result


def _calls(mechanism: CrankTurning, degrees: Array, library: ctypes.CDLL | None) -> dict[str, Torque]:
    case = load(mechanism.case)
    radians, out = np.asarray(np.radians(degrees), dtype=np.float64), np.empty(len(degrees))
    calls: dict[str, Torque] = {
        BY_HAND: lambda: mechanism.by_hand(radians),
        SWEPT: lambda: swept(case, degrees, ("answers",)),
        BOUNDED: lambda: swept(case, degrees, ("answers", "error")),
    }
    if library is not None:
        run = in_c(library, mechanism.function, mechanism.data, radians, out)

        def compiled_turn() -> Array:
            run()
            return out

        calls[IN_C] = compiled_turn
    return calls


def _known(mechanism: CrankTurning, degrees: Array) -> dict[int, Truth]:
    """The torque at some positions, on the doubles; but where `near` picks the other way to assemble."""
    known = {}
    for k in range(0, len(degrees), max(1, len(degrees) // SAMPLE)):
        angle = float(degrees[k])
        by_hand = mechanism.by_hand(np.radians(degrees[k : k + 1]))[0]
        true = truth(load(mechanism.case.replace("AB: 60", f"AB: {angle!r}")))
        if true.error(float(by_hand)) < 1e-6:
            known[k] = true
    return known


def swept(case: Case, degrees: Array, want: tuple[str, ...]) -> Array:
    """The crank's torque at every angle."""
    return sweep(case, {PATH: degrees}, want).answers["T2"]


def memory() -> float | None:
    """Largest resident memory in MB of a process that sweeps a million positions."""
    code = (
        "import numpy as np, icsolve\nfrom icsolve.sweep import sweep\n"
        f"case = icsolve.load({FOUR_BAR_CASE!r})\n"
        f"sweep(case, {{{PATH!r}: np.linspace(60.0, 420.0, {MILLION})}}, ('answers',))"
    )
    return peak_memory(code)


KERNEL, BY_PARTS = "bare float kernel, written out", "the same by the kernels that icsolve uses"
FRESH, FRESH_BOUND = "solve of a fresh case, without bound", "solve of a fresh case, with bound"
WARM, WARM_BOUND = "solve of one case again (warm), without bound", "the same (warm), with bound"
FRESH_CASES = 64
"""Cases that take turns as fresh ones: more than are remembered."""


def one_scene(effort: Effort, kept: Kept) -> str:
    """One scene in process: `solve` of a loaded four-bar against the bare float kernel.

    A case that is solved again is warm: its plan is remembered. Fresh ones take turns, each another case.
    """
    from itertools import cycle

    a, b, c, d, torque = FOUR_BAR
    numbers = (d, a, b, c, 60.0, torque)
    case = load(FOUR_BAR_CASE)
    angles = (60.0 + k / 8.0 for k in range(FRESH_CASES))
    fresh = cycle([load(FOUR_BAR_CASE.replace("AB: 60", f"AB: {angle}")) for angle in angles])
    calls: dict[str, Callable[[], object]] = {
        KERNEL: lambda: written_out(*numbers),
        BY_PARTS: lambda: componentwise(*numbers),
        WARM: lambda: solve(case, bound=False),
        WARM_BOUND: lambda: solve(case),
        FRESH: lambda: solve(next(fresh), bound=False),
        FRESH_BOUND: lambda: solve(next(fresh)),
        "load, then solve with bound": lambda: solve(load(FOUR_BAR_CASE)),
    }
    times = dict(zip(calls, least(list(calls.values()), effort.seconds), strict=True))
    base, parts = times[KERNEL], times[BY_PARTS]
    kept.gates.append(
        ratio("`solve` again of a loaded four-bar (warm) / kernel by parts", times[WARM] / parts, 12)
    )
    kept.gates.append(
        ratio("the same with every digit (warm) / kernel by parts", times[WARM_BOUND] / parts, 50)
    )
    rows = [[name, f"{t / base:.1f}", f"{t / parts:.1f}", f"{1e6 * t:.1f}"] for name, t in times.items()]
    return table(("one four-bar scene", "x kernel written out", "x kernel by parts", "us"), rows)


def full_turn(effort: Effort, kept: Kept) -> str:
    """Sweeps against hand-written numpy and C, at 3600 and a million positions."""

    def row(name: str, by: dict[str, Timed]) -> list[str]:
        times = [f"{1e3 * by[m].seconds:.3g}" if m in by else "-" for m in (BY_HAND, IN_C, SWEPT, BOUNDED)]
        pairs = ((SWEPT, BY_HAND), (SWEPT, IN_C), (BOUNDED, SWEPT))
        ratios = [f"{by[a].seconds / by[b].seconds:.1f}" if b in by else "-" for a, b in pairs]
        return [name, str(by[SWEPT].positions), *ratios, *times, f"{by[SWEPT].error:.1e}"]

    rows = []
    for positions in (TURN, MILLION):
        for name, by in full_turns(positions, 3.0 * effort.seconds).items():
            rows.append(row(name, by))
            kept.gates.extend(_turn_gates(name, by))
            kept.turns.extend(timed.score for timed in by.values() if positions == TURN)
    used = memory()
    said = "" if used is None else f"\n\nA million positions of the four-bar take a process of {used:.0f} MB."
    if used is not None:
        kept.gates.append(Gate("a million positions of the four-bar, whole process", used, 300, " MB"))
    ratios = ("sweep / numpy", "sweep / C", "bounds / sweep")
    times = (f"{BY_HAND}, ms", f"{IN_C}, ms", "sweep, ms", "with bounds, ms")
    return table(("full turn", "positions", *ratios, *times, "worst error of the sweep"), rows) + said


def _turn_gates(name: str, by: dict[str, Timed]) -> list[Gate]:
    swept = by[SWEPT]
    what, short = f"{name}, {swept.positions} positions", swept.positions == TURN
    gates = [ratio(f"{what}: sweep / numpy by hand", swept.seconds / by[BY_HAND].seconds, 3)] if short else []
    if IN_C in by:
        gates.append(ratio(f"{what}: sweep / C -O3", swept.seconds / by[IN_C].seconds, 5 if short else 3))
    gates.append(ratio(f"{what}: with bounds / without", by[BOUNDED].seconds / swept.seconds, 6))
    return [*gates, Gate(f"{what}: worst error over (kappa + 1) u", swept.per_unit, FORWARD)]


def other_programs(effort: Effort, kept: Kept) -> str:
    """The full turn of the four-bar by other programs, in the same run as `full_turn`."""
    own = next(score for score in kept.turns if score.method == SWEPT)
    seconds = 1e-6 * own.micros * POSITIONS
    found = [ran(peer, effort.rounds) for peer in PEERS]
    rows = [["icsolve", "torque", "1", f"{1e3 * seconds:.3g}", f"{own.error:.1e}"]]
    rows += [_peer_row(peer, seconds) for peer in found]
    for peer in found:
        if not peer.why:
            name = peer.name.partition(" ")[0] + (f" ({peer.gives})" if peer.gives != TORQUE else "")
            micros = 1e6 * peer.seconds / POSITIONS
            kept.turns.append(Score(name, "four-bar", peer.error, math.nan, micros, 0, 0, POSITIONS))
    kept.absent.extend(f"{peer.name}: {peer.why}" for peer in found if peer.why)
    forceful = [peer.seconds for peer in found if peer.gives == TORQUE and not peer.why]
    if forceful:
        times = min(forceful) / seconds
        kept.gates.append(ratio("fastest other program that gives a torque / sweep", times, 100, floor=True))
    return table((f"four-bar, {POSITIONS} positions", "gives", "x icsolve", "ms", "worst error"), rows)


def _peer_row(peer: Ran, own: float) -> list[str]:
    if peer.why:
        return [peer.name, peer.gives, "-", "-", peer.why]
    times = [f"{peer.seconds / own:.3g}", f"{1e3 * peer.seconds:.3g}"]
    return [peer.name, peer.gives, *times, f"{peer.error:.1e}"]


# --- grading and drawing -------------------------------------------------------------------------------


Asked = tuple[str, float, str]
"""A question, its answer and its unit."""
WRONG = (-1.0, 0.5, 2.0, 10.0, 0.001, 25.4, 1.02, 1.37, 0.62)
MANY = 5000
"""Answers from which the time of one more is told."""


def asked_of(folder: str, names: Sequence[str]) -> list[Asked]:
    """The questions of cases that have one number for an answer."""
    store = CaseStore(folder, Course())
    keys = [store.key(name) for name in names]
    return [(key.question, key.value, key.unit_name) for key in keys if isinstance(key, NumberKey)]


def write_class(path: str | os.PathLike[str], students: int, asked: Sequence[Asked], seed: int = 1) -> int:
    """A row a student and question; right answers differ in their fourth figure; how many rows."""
    rng = random.Random(seed)
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["student_id", "case", "answer", "attempt", "submitted_at"])
        for _ in range(students):
            student = f"{rng.randrange(10**8):08d}"
            for case, value, unit in asked:
                factor = rng.choice(WRONG) if rng.random() < 0.35 else 1.0
                answer = value * factor * (1.0 + rng.uniform(-0.004, 0.004))
                text = f"{answer:.5g} {unit}" if rng.random() < 0.9 else f"{answer:.4e}"
                day, hour, minute = rng.randrange(1, 29), rng.randrange(24), rng.randrange(60)
                time = f"2025-03-{day:02d}T{hour:02d}:{minute:02d}:00"
                rows.writerow([student, case, text, rng.randrange(1, 4), time])
    return students * len(asked)


def read_plainly(path: str) -> None:
    """What no program can do without: Python's csv reads the file and float its numbers."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        next(rows)
        for row in rows:
            float(row[2].partition(" ")[0])


def judging(path: str, folder: str) -> Callable[[], object]:
    """A call that judges every answer; no verdict is remembered. Keys and wrong answers are made before."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))[1:]
    store, reader = CaseStore(folder, Course()), Reader()
    keys = {name: key for name in {row[1] for row in rows} if isinstance(key := store.key(name), NumberKey)}
    for key in keys.values():
        key.wrongs.near(0.0)
    return lambda: [judge(keys[row[1]], reader.read(row[2])) for row in rows]


def grading(effort: Effort, kept: Kept) -> str:
    """A class that answers the questions of every template, and variants of one of them for each student."""
    with scratch() as folder:
        path, cases = os.path.join(folder, "class.csv"), os.path.join(folder, "cases")
        os.mkdir(cases)
        for kind in kinds():
            _put(os.path.join(cases, f"{kind}.yaml"), template(kind))
        names = [kind for kind in kinds() if unknowns(load(template(kind)))]
        asked, size = asked_of(cases, names), max(40, 10 * effort.scenes)
        answers, students = write_class(path, size, asked), 30 * effort.scenes
        paths, out = [path], os.path.join(folder, "results.csv")
        if answers > MANY:  # starting, and solving each case with every mistake, takes as long for any class
            paths.append(os.path.join(folder, "larger.csv"))
            write_class(paths[1], 3 * size, asked)
        varied = _variants(folder, students)
        judged = judging(path, cases)
        taken: list[list[float]] = []
        for _ in range(1 + effort.rounds // 3):  # all in turns: a busy machine slows them alike
            read = min(once(lambda: read_plainly(path)) for _ in range(5))
            graded = [_command("grade", one, "--cases", cases, "-o", out, "--force", "-q") for one in paths]
            taken.append([read, min(once(judged) for _ in range(3)), _command(*varied), *graded])
        plainly, alone, variants, *wholes = map(min, zip(*taken, strict=True))
        more = (wholes[-1] - wholes[0]) / 2.0
    kept.gates.append(ratio("judging answers / reading them by csv and float", alone / plainly, 5))
    if answers > MANY:
        kept.gates.append(ratio("a further answer by the command `grade` / the same", more / plainly, 25))
    kept.gates.append(
        Gate(f"values and keys of {students} variants, a thousand", 1e3 * variants / students, 0.7, " s")
    )
    timed = [
        ("csv and float", plainly),
        ("judging alone", alone),
        ("icsolve grade, whole process", wholes[0]),
    ]
    timed += [("icsolve grade, each further answer", more)] if answers > MANY else []
    rows = [[name, f"{seconds / plainly:.1f}", f"{1e6 * seconds / answers:.2f}"] for name, seconds in timed]
    return table((f"{answers} answers", "x csv", "us an answer"), rows)


def _variants(folder: str, students: int) -> list[str]:
    """The command that gives each student a four-bar of their own."""
    ranges = "variables: {a: {range: [1, 1.5], step: 0.01}, phi: {range: [40, 80], step: 0.1}}\n"
    text = template("four-bar").replace("AB: 1,", "AB: $a,").replace("AB: 60", "AB: $phi")
    case, roster = os.path.join(folder, "varied.yaml"), os.path.join(folder, "roster.csv")
    _put(case, text.replace("lengths:", f"{ranges}lengths:", 1))
    _put(roster, "student_id\n" + "".join(f"{n:05d}\n" for n in range(students)))
    out = os.path.join(folder, "sheets")
    return ["variants", case, "--roster", roster, "-o", out, "--no-figures", "-q", "--force"]


def _put(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _command(*arguments: str) -> float:
    return cpu_seconds([sys.executable, "-m", "icsolve", *arguments])


def drawing(effort: Effort, kept: Kept) -> str:
    """The figure of a six-bar with everything on it."""
    from icsolve.draw import Drawing, draw

    case = load(template("six-bar"))
    plain, full = (lambda: draw(case)), (lambda: draw(case, Drawing("all", circle=True, velocities=True)))
    draw(case)
    seconds = [min(once(call) for _ in range(effort.rounds)) for call in (plain, full)]
    kept.gates.append(Gate("a drawing with all centres, circle and velocities", seconds[1], 2.0, " s"))
    named = zip(("as it comes", "all centres, circle, velocities"), seconds, strict=True)
    return table(("a six-bar drawn", "ms"), [[name, f"{1e3 * took:.0f}"] for name, took in named])
