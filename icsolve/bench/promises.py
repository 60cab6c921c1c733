"""What was promised of speed, line by line: rows, families, growth, tables, folders and starts.

Each is measured beside its reference in one run, in CPU time of interleaved calls; of time and memory
that grow the exponent of a power law is fitted. A case is fresh where it was never solved before, warm where
it was.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from ctypes import CDLL
from functools import partial
from itertools import cycle
from random import Random

import numpy as np

from icsolve.bench.families import BUTTERFLY, Draw, FamilySheet, by_sides, chain, linkage, torques
from icsolve.bench.full_turn import FOUR_BAR, FOUR_BAR_CASE, Array, compiled, four_bar, in_c
from icsolve.bench.gates import (
    USUAL,
    Effort,
    Gate,
    Kept,
    cpu_seconds,
    least,
    once,
    own_command,
    peak_memory,
    ratio,
    table,
)
from icsolve.bench.speed import FRESH_CASES
from icsolve.case import Case, Number, Torque
from icsolve.files import scratch
from icsolve.manual import template
from icsolve.numbers import turn_of
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from icsolve.sweep.evaluator import evaluator
from icsolve.sweep.table import as_csv, as_jsonl, columns
from icsolve.tuples import NamedTuple

FEW_ROWS = 36
"""Of a sweep of which the set-up is measured."""
ROUNDS = 4
"""Fresh cases of each size, of which the quickest counts; sizes take turns, since processors change speed."""


class Growing(NamedTuple):
    """What grows: its name, what is called for a size, the sizes of a quick, a usual and a full run, and the
    largest exponent."""

    what: str
    made: Callable[[int], Callable[[], object]]
    quick: Sequence[int]
    usual: Sequence[int]
    full: Sequence[int]
    limit: float


LINKS = ((6, 12), (22, 42, 82, 162), (22, 82, 322, 1002))
STAGES = ((3, 6), (10, 20, 40, 80), (10, 40, 160, 500))
WHEELS = ((6, 12), (100, 200, 400), (100, 200, 400, 1000))
GROUPS = ((1, 2), (1, 3, 6, 12), (3, 12, 49))


def growth(kept: Kept, quick: bool, full: bool) -> str:
    """Fresh cases of more and more links."""
    series = (
        Growing("solve a chain of four-bars, links", lambda n: _solved(chain(n // 2 - 1)), *LINKS, 1.3),
        Growing("the same by lengths", lambda n: _solved(by_sides(chain(n // 2 - 1), (1, 2))), *LINKS, 1.3),
        Growing("scissors by lengths, stages of two links", lambda n: _solved(scissors(n)), *STAGES, 1.3),
        Growing("a gear train, wheels", lambda n: _solved(gears(n)), *WHEELS, 1.3),
        Growing("double butterflies in series", lambda n: _solved(butterflies(n)), *GROUPS, 1.5),
        Growing("set up a sweep of a chain, links", _set_up, *LINKS[:2], (22, 42, 82, 240), 1.5),
    )
    rows, fresh, turns = [], [], _fresh_sweeps()
    for one in series:
        sizes = one.quick if quick else one.full if full else one.usual
        found = [[once(one.made(n)) for n in sizes] for _ in range(2 if quick else ROUNDS)]
        times = [min(of_size) for of_size in zip(*found, strict=True)]
        power = exponent(sizes, times)
        kept.gates.append(Gate(f"{one.what}: exponent of growth", power, one.limit))
        shown = ", ".join(f"{n}: {1e3 * t:.3g}" for n, t in zip(sizes, times, strict=True))
        rows.append([one.what, shown, f"{power:.2f}"])
        fresh += least([turns], 0.02 if quick else 0.2)  # the quickest of times that lie apart
    links = LINKS[0][-1] if quick else LINKS[1][-2]
    case = load(chain(links // 2 - 1)(Random(1)))
    every = once(lambda: list(solve(case, all_centres=True).centres.items()))
    kept.gates.append(Gate(f"all centres of {links} links", every, 1, " s"))
    rows.append([f"all n(n-1)/2 centres of {links} links", f"{1e3 * every:.3g}", ""])
    kept.gates.append(Gate("set-up of a sweep of a four-bar, fresh", 1e3 * min(fresh), 1, " ms"))
    rows.append([f"{FEW_ROWS} rows of a fresh four-bar", f"{1e3 * min(fresh):.3g}", ""])
    return table(("growth, fresh", "ms", "exponent"), rows)


def exponent(sizes: Sequence[float], found: Sequence[float]) -> float:
    """That of a power law through what was found, by least squares of the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(found), 1)[0])


def _solved(draw: Draw) -> Callable[[], object]:
    case = load(draw(Random(1)))
    return lambda: solve(case).to_dict()


def gears(wheels: int) -> Draw:
    """Wheels in a row, each in mesh with the next."""

    def draw(rng: Random) -> str:
        sheet, at = FamilySheet(rng), 0.0
        teeth = [rng.randrange(15, 40) for _ in range(wheels)]
        for k, n in enumerate(teeth):
            at += (n + teeth[k - 1]) / 20.0 if k else 0.0
            sheet.pin(1, sheet.link(), (at, 0.0))
        for k in range(wheels - 1):
            sheet.joints.append(f"  - {{gears: [{k + 2}, {k + 3}], teeth: [{teeth[k]}, {teeth[k + 1]}]}}")
        return sheet.text(f"K: {{torque: 7.5, link: {wheels + 1}}}, U: {{torque: unknown, link: 2}}")

    return draw


def scissors(stages: int) -> Draw:
    """A lift of straight bars that cross at their middles, by the lengths of these: two links a stage."""

    def draw(rng: Random) -> str:
        turn = round(rng.uniform(30.0, 50.0), 2)
        width, height = 2.0 * math.cos(math.radians(turn)), 2.0 * math.sin(math.radians(turn))
        lengths, near, joints = [], {"R0": (width, 0.0)}, []
        for k in range(stages):
            one, two = 2 * k + 2, 2 * k + 3
            for foot, head in (("L", "R"), ("R", "L")):
                lengths += [f"{foot}{k}-C{k}: 1", f"C{k}-{head}{k + 1}: 1", f"{foot}{k}-{head}{k + 1}: 2"]
            near[f"C{k}"] = (width / 2.0, (k + 0.5) * height)
            near |= {f"L{k + 1}": (0.0, (k + 1) * height), f"R{k + 1}": (width, (k + 1) * height)}
            joints.append(f"  - {{pin: [{one}, {two}], at: C{k}}}\n")
            if k + 1 < stages:
                joints.append(f"  - {{pin: [{two}, {one + 2}], at: L{k + 1}}}\n")
                joints.append(f"  - {{pin: [{one}, {two + 2}], at: R{k + 1}}}\n")
        where = ", ".join(f"{p}: [{x:.4f}, {y:.4f}]" for p, (x, y) in near.items())
        return (
            f"icsolve: 1\npoints: {{L0: [0, 0]}}\nlengths: {{{', '.join(lengths)}}}\n"
            f"angles: {{L0-C0: {turn}}}\nnear: {{{where}}}\njoints:\n  - {{pin: [1, 2], at: L0}}\n"
            f"  - {{slot: [3, 1], at: R0, along: 0, through: L0}}\n{''.join(joints)}"
            f"loads: {{W: {{weight: 10, link: {2 * stages}, at: R{stages}}}, "
            "F: {force: unknown, link: 3, at: R0, angle: 180}}\n"
        )

    return draw


def butterflies(count: int) -> Draw:
    """Double butterflies on one frame, by coordinates: the fifth link of one is the crank of the next."""

    def draw(rng: Random) -> str:
        sheet, crank = FamilySheet(rng), 2
        sheet.links = 2
        sheet.pin(1, 2)
        for _ in range(count):
            own = {0: 1, 1: crank}
            own |= {k: sheet.link() for k in range(2, 8)}
            for edge in BUTTERFLY.split()[1:]:
                sheet.pin(own[int(edge[0])], own[int(edge[1])])
            crank = own[4]
        return sheet.text(torques(sheet.links, 2))

    return draw


def _set_up(links: int) -> Callable[[], object]:
    case = load(by_sides(chain(links // 2 - 1), (1, 2))(Random(1)))
    angle = case.angles[0].value
    return lambda: sweep(case, {angle.path: angle.value + np.linspace(-0.01, 0.01, 8)})


def _fresh_sweeps() -> Callable[[], object]:
    """Sweeps of four-bars that take turns: more of them than are remembered."""
    texts = (FOUR_BAR_CASE.replace("AB: 60", f"AB: {60.0 + k / 100.0}") for k in range(FRESH_CASES + 16))
    cases, turn = cycle([load(text) for text in texts]), np.linspace(60.0, 420.0, FEW_ROWS)
    return lambda: sweep(next(cases), {"angles.AB": turn})


# --- memory ---------------------------------------------------------------------------------------


def memory(kept: Kept, quick: bool) -> str:
    """The largest memory of `solve --json` above that of its start, beside what it prints: all centres."""
    sizes, rows, more, printed = (12, 22) if quick else (82, 122, 162), [], [], []
    with scratch() as folder:
        for links in (4, *sizes):
            path = os.path.join(folder, f"{links}.yaml")
            text = chain(links // 2 - 1)(Random(1))
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            printed.append(len(json.dumps(solve(load(text), all_centres=True).to_dict())))
            words = ["solve", "--json", "--all-centres", path]
            run = f"from icsolve.cli.commands import icsolve\nicsolve({words!r}, standalone_mode=False)"
            more.append(peak_memory(run))
    if None in more:
        return "The memory of a process is not told here."
    taken = [1024.0**2 * (one - (more[0] or 0.0)) for one in more[1:] if one is not None]
    for links, text_size, size in zip(sizes, printed[1:], taken, strict=True):
        rows.append([str(links), f"{text_size / 1e6:.3g}", f"{size / 1e6:.3g}", f"{size / text_size:.3g}"])
    power = exponent(printed[1:], [max(one, 1.0) for one in taken])
    kept.gates.append(Gate("memory of `solve --json` over what it prints: exponent of growth", power, 1.1))
    head = ("all centres of a chain as JSON, links", "MB printed", "MB taken", "a byte printed")
    return table(head, rows)


# --- table by table ------------------------------------------------------------------------------------


ROWS, POSITIONS = 20_000, 360
RUBBING = FOUR_BAR_CASE.replace("at: B}", "at: B, mu: 0.2, radius: 0.1}").replace(
    "at: C}", "at: C, mu: 0.2, radius: 0.1}"
)
MOVING = f"{RUBBING}motion: {{link: 2, turns: ccw}}\n"
CAM = """\
icsolve: 1
points: {A: [0, 0], B: [6, unknown]}
lengths: {AC: 20}
angles: {AC: 40}
near: {B: [6, 60]}
profile: {2: %s, 3: {roller: B, radius: 10}}
joints: [{pin: [1, 2], at: A}, {contact: [2, 3]}, {slide: [3, 1], at: B, along: 90}]
loads: {P: {force: 100, link: 3, at: B, angle: -90}, T12: {torque: unknown, link: 2}}
"""
DISK = CAM % "{circle: C, radius: 40}"
OWN_ROLLER = (
    DISK.replace("3: {roller", "4: {roller")
    .replace("{contact: [2, 3]}", "{contact: [2, 4]}")
    .replace("joints: [", "joints: [{pin: [3, 4], at: B}, ")
)
HEAVY = f"{DISK}links: {{3: {{mass: 2 kg, centre: B}}}}\nmotion: {{link: 2, speed: 10}}\ndynamic: yes\n"
ROPED = """\
icsolve: 1
points: {A: [0, 0], B: [0.7, 0.5], P: [0, 4], Q: [3, 4], C: [3, 1]}
joints:
  - {pin: [1, 2], at: A}
  - {slide: [3, 1], at: C, along: 90}
  - {rope: [B, P, Q, C], on: [2, 1, 1, 3], radii: {P: 0.3, Q: 0.3}, wraps: {P: cw, Q: cw}}
loads: {W: {weight: 100, link: 3, at: C}, T12: {torque: unknown, link: 2}}
"""
LOBES = ", ".join(f"{10 * k}: {40.0 + 8.0 * float(np.cos(np.radians(30.0 * k))):.6f}" for k in range(36))
LOBED = CAM % f"{{about: A, zero: [A, C], radii: {{{LOBES}}}}}"
SEED = 3
"""A double butterfly that moves by its first link over some degrees to both sides."""
NEWTON = "a group by Newton's method (double butterfly)"
IN_C = "the same group in C -O3, by Newton's method for each row"
THREE = 2
"""A seed of three double butterflies in series that move so by a degree."""


def promises(effort: Effort, kept: Kept) -> Iterator[str]:
    """Table by table."""
    quick, full = effort.seconds < USUAL.seconds / 2.0, effort.seconds > USUAL.seconds
    yield _rows(effort, kept, ROWS // 40 if quick else ROWS)
    yield _families(effort, kept, (10, 30) if quick else (10, 100, 1000, 10_000)[: 4 if full else 3])
    yield growth(kept, quick, full)
    yield memory(kept, quick)
    yield _tables(effort, kept, ROWS // 40 if quick else 5 * ROWS)
    yield _starts(effort, kept, 20 if quick else 2_000 if full else 400)


# --- rows -----------------------------------------------------------------------------------------


def _rows(effort: Effort, kept: Kept, rows: int) -> str:
    """Rows of one turn that are not those of a smooth dyad, warm."""
    turn: Array = np.linspace(-180.0, 180.0, rows, endpoint=False)
    butterfly = load(by_sides(linkage(BUTTERFLY), (1, 4))(Random(SEED)))
    angle = butterfly.angles[0].value
    near: Array = angle.value + np.linspace(-6.0, 6.0, 5 * rows)
    limits = {
        "with friction in a given motion": (MOVING, 5.0),
        "with friction, the range that holds": (RUBBING, 5.0),
        "a roller on an eccentric disk": (DISK, 20.0),
        "a roller on a table of radii": (LOBED, 20.0),
        "a roller that is a link of its own": (OWN_ROLLER, 20.0),
        "a heavy follower, with inertia forces": (HEAVY, 20.0),
        "a weight on a rope over two pulleys": (ROPED, 5.0),
    }
    groups = [load(butterflies(n)(Random(THREE))) for n in (1, 3)]
    degree: Array = np.linspace(-0.5, 0.5, rows)
    calls: dict[str, Callable[[], object]] = {
        name: partial(sweep, load(text), drive={"2": turn}) for name, (text, _) in limits.items()
    }
    calls[NEWTON] = lambda: sweep(butterfly, {angle.path: near})
    chained = load(by_sides(chain(10), (1, 2))(Random(1)))
    start = chained.angles[0].value
    few, many = (start.value + np.linspace(-0.01, 0.01, n) for n in (POSITIONS // 10, POSITIONS))
    calls |= {
        "a chain of 22 links, 36 rows": lambda: sweep(chained, {start.path: few}),
        "the same, 360 rows": lambda: sweep(chained, {start.path: many}),
    }
    one, three = (f"{n} by Newton's method, of coordinates" for n in ("one group", "three groups"))
    calls |= {one: lambda: sweep(groups[0], drive={"2": degree})}
    calls |= {three: lambda: sweep(groups[1], drive={"2": degree})}
    with scratch() as folder:
        library = compiled(folder)
        if library is not None:
            calls[IN_C] = newton_in_c(library, butterfly, near, np.empty(len(near)))
    parts = (list(limits), [name for name in calls if name not in limits])  # each as many as are remembered
    times: dict[str, float] = {}
    for names in parts:
        # of the longest calls some six turns
        times |= zip(names, least([calls[name] for name in names], 2.0 * effort.seconds), strict=True)
    short = [name for name in calls if "36" in name]
    counts = dict.fromkeys(calls, rows) | {NEWTON: len(near), IN_C: len(near)}
    counts |= dict(zip(short, (len(few), len(many)), strict=True))
    micros = {name: 1e6 * took / counts[name] for name, took in times.items()}
    took = [times[name] for name in short]
    for name, (_, limit) in limits.items():
        kept.gates.append(Gate(f"a row {name}", micros[name], limit, " us"))
    kept.gates.append(Gate(f"a row of {NEWTON}", micros[NEWTON], 4.0, " us"))
    if IN_C in times:
        kept.gates.append(ratio(f"a row of {NEWTON} / the same in C", times[NEWTON] / times[IN_C], 4))
    kept.gates.append(ratio("three groups by Newton's method / one", times[three] / times[one], 6))
    kept.gates.append(ratio("36 rows of a chain / 360 of them", took[0] / took[1], 1))
    shown = [[name, str(counts[name]), f"{micros[name]:.3g}"] for name in calls]
    return table(("rows of a sweep, warm", "rows", "us a row"), shown)


def newton_in_c(library: CDLL, case: Case, degrees: Array, out: Array) -> Callable[[], object]:
    """A call of Newton's method in C on a double butterfly by its lengths (`families.BUTTERFLY`): it writes
    the torque on the crank at each angle."""
    at, written = solve(case).points, case.angles[0].value.value
    given = {frozenset((side.a, side.b)): side.value.value for side in case.lengths}
    c, s = (float(part) for part in turn_of(written))
    x, y = at["P5"][0] - at["P1"][0], at["P5"][1] - at["P1"][1]
    ends = "P6-P7 P6-P8 P7-P8 P6-P9 P6-P10 P9-P10 P2-P7 P3-P9 P4-P8 P5-P10".split()
    data = [
        *(part for name in ("P1", "P2", "P3") for part in at[name]),
        *(given[frozenset(("P1", "P4"))], c * x + s * y, c * y - s * x),
        *(given[frozenset(pair.split("-"))] for pair in ends),
        *(part for n in range(6, 11) for part in at[f"P{n}"]),
        math.radians(written),
        next(
            load.value.value
            for load in case.loads
            if isinstance(load, Torque) and isinstance(load.value, Number)
        ),
    ]
    return in_c(library, "double_butterfly", data, np.radians(degrees), out)


# --- families -------------------------------------------------------------------------------------


def _families(effort: Effort, kept: Kept, sizes: tuple[int, ...]) -> str:
    """Four-bars with lengths, angle and load of their own in each row, against numpy by hand."""
    rng, shown = np.random.default_rng(SEED), []
    case = load(FOUR_BAR_CASE)
    for figures in sizes:
        sides = {
            f"lengths.{name}": np.repeat(rng.uniform(0.97 * size, 1.03 * size, figures), POSITIONS)
            for name, size in zip(("AB", "BC", "CD"), FOUR_BAR, strict=False)
        }
        angles = np.tile(np.linspace(60.0, 420.0, POSITIONS, endpoint=False), figures)
        loads = np.repeat(rng.uniform(5.0, 15.0, figures), POSITIONS)
        varied = {**sides, "angles.AB": angles, "loads.T4": loads}
        hand = (np.radians(angles), (*sides.values(), FOUR_BAR[3], loads))
        calls = (
            partial(four_bar, *hand),
            partial(evaluator(case, tuple(varied)), *varied.values()),
            partial(sweep, case, varied),
        )
        took = least(calls, effort.seconds / len(sizes))
        what = f"{figures} four-bars x {POSITIONS}"
        kept.gates.append(ratio(f"{what}: evaluator / numpy by hand", took[1] / took[0], 3))
        nanos = [f"{1e9 * one / len(angles):.3g}" for one in took]
        shown.append([what, *nanos, f"{took[1] / took[0]:.2f}", f"{took[2] / took[0]:.2f}"])
    single = evaluator(case, ("lengths.BC", "angles.AB"))
    (one,) = least([lambda: single(3.5, 61.0)], effort.seconds / 4.0)
    rods = np.full(POSITIONS, FOUR_BAR[1])
    apart = np.where(np.arange(POSITIONS) == 7, 0.1, rods)  # this one does not reach
    pair = [partial(sweep, case, {"lengths.BC": some}) for some in (rods, apart)]
    whole, torn = least(pair, effort.seconds / 4.0)
    kept.gates.append(ratio("360 rows of which one does not assemble / all do", torn / whole, 2))
    kept.gates.append(Gate("one row of a four-bar by the evaluator", 1e6 * one, 20, " us"))
    head = ("families, ns a row", "numpy by hand", "evaluator", "sweep", "evaluator / numpy", "sweep / numpy")
    return table(head, shown)


# --- tables, folders and starts -------------------------------------------------------------------


def _tables(effort: Effort, kept: Kept, rows: int) -> str:
    """The table of a sweep as text, against `csv.writer` on the same lists."""
    found = sweep(
        load(FOUR_BAR_CASE), {"angles.AB": np.linspace(60.0, 420.0, rows)}, ("answers", "status", "points")
    )

    def plainly() -> object:
        out = io.StringIO()
        numbers = (array.tolist() for array in columns(found).values())
        csv.writer(out, lineterminator="\n").writerows(zip(*numbers, found.status.tolist(), strict=True))
        return out.getvalue()

    calls = {
        "csv.writer": plainly,
        "CSV": lambda: list(as_csv(found)),
        "JSON Lines": lambda: list(as_jsonl(found)),
    }
    times = dict(zip(calls, least(list(calls.values()), effort.seconds), strict=True))
    base = times["csv.writer"]
    kept.gates.append(ratio("a table as CSV / csv.writer", times["CSV"] / base, 1))
    kept.gates.append(ratio("a table as JSON Lines / csv.writer", times["JSON Lines"] / base, 1.5))
    shown = [[name, f"{took / base:.2f}", f"{1e3 * took:.3g}"] for name, took in times.items()]
    return table((f"a table of {rows} rows", "x csv.writer", "ms"), shown)


PLAIN, NUMPY, SHAPELY = ("click, yaml", "click, yaml, numpy", "click, yaml, shapely")
COORDINATES = """\
icsolve: 1
points: {A: [0, 0], B: [0.5, 0.9], C: [3.1, 2.3], D: [4, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {T4: {torque: 10, link: 4}, T2: {torque: unknown, link: 2}}
"""
SPACE = template("shaft")
STARTS = (
    ("solve", COORDINATES, PLAIN, 1.25),
    ("solve", FOUR_BAR_CASE, PLAIN, 1.25),
    ("solve", MOVING, PLAIN, 1.35),
    ("solve", SPACE, PLAIN, 1.35),
    ("solve", DISK, PLAIN, 1.6),
    ("sweep", FOUR_BAR_CASE, NUMPY, 1.15),
    ("draw", FOUR_BAR_CASE, SHAPELY, 1.5),
    ("page", FOUR_BAR_CASE, SHAPELY, 1.5),
)
NAMED = {
    COORDINATES: "coordinates",
    FOUR_BAR_CASE: "four-bar",
    MOVING: "friction",
    SPACE: "space",
    DISK: "cam",
}


def _starts(effort: Effort, kept: Kept, files: int) -> str:
    """Whole processes, cold, against the import of what they need; a folder against its cases one by one."""
    rows = []
    with scratch() as folder:
        taken: dict[str, list[float]] = {}
        runs = {imports: [sys.executable, "-c", f"import {imports}"] for imports in (PLAIN, NUMPY, SHAPELY)}
        for verb, text, _, _ in STARTS:
            path = os.path.join(folder, f"{NAMED[text]}.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            more = ["--vary", "angles.AB=0:359:1"] if verb == "sweep" else []
            kind = {"sweep": "csv", "draw": "svg", "page": "html"}.get(verb)
            out = ["-o", os.path.join(folder, f"o.{kind}")] if kind else []
            runs[f"icsolve {verb} {NAMED[text]}.yaml"] = [*own_command(), verb, path, *more, *out]
        for _ in range(2 * effort.rounds + 1):
            for name, command in runs.items():
                taken.setdefault(name, []).append(cpu_seconds(command))
        usual = {name: sorted(times)[len(times) // 10] for name, times in taken.items()}
        for verb, text, imports, limit in STARTS:
            name = f"icsolve {verb} {NAMED[text]}.yaml"
            times = usual[name] / usual[imports]
            kept.gates.append(ratio(f"`{name}`, whole process / import {imports}", times, limit))
            rows.append([name, f"{times:.2f}", f"{1e3 * usual[name]:.0f}"])
        cases = os.path.join(folder, "cases")
        os.mkdir(cases)
        texts = [FOUR_BAR_CASE.replace("AB: 60", f"AB: {360.0 * k / files:.4f}") for k in range(files)]
        for k, text in enumerate(texts):
            with open(os.path.join(cases, f"{k}.yaml"), "w", encoding="utf-8") as file:
                file.write(text)
        alone = once(lambda: [solve(load(text)) for text in texts])
        whole = cpu_seconds([*own_command(), "check", cases]) - usual[PLAIN]
    kept.gates.append(ratio(f"`icsolve check` of {files} files / load and solve of each", whole / alone, 2))
    rows.append([f"icsolve check, {files} files", f"{whole / alone:.2f}", f"{1e3 * whole:.0f}"])
    return table(("whole process, cold", "x its imports", "CPU ms"), rows)
