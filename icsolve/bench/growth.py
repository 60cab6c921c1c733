"""How time and memory grow: fresh cases of more and more links, with the exponent of a power law."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Sequence
from itertools import cycle
from random import Random

import numpy as np

from icsolve.bench.families import BUTTERFLY, Draw, FamilySheet, by_sides, chain, torques
from icsolve.bench.full_turn import FOUR_BAR_CASE
from icsolve.bench.gates import Gate, Kept, least, once, peak_memory, table
from icsolve.bench.speed import FRESH_CASES
from icsolve.files import scratch
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from icsolve.tuples import NamedTuple

FEW_ROWS = 36
"""Of a sweep of which the set-up is measured."""


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
    rows = []
    for one in series:
        sizes = one.quick if quick else one.full if full else one.usual
        times = [min(once(one.made(n)) for _ in range(2)) for n in sizes]
        power = exponent(sizes, times)
        kept.gates.append(Gate(f"{one.what}: exponent of growth", power, one.limit))
        shown = ", ".join(f"{n}: {1e3 * t:.3g}" for n, t in zip(sizes, times, strict=True))
        rows.append([one.what, shown, f"{power:.2f}"])
    links = LINKS[0][-1] if quick else LINKS[1][-2]
    case = load(chain(links // 2 - 1)(Random(1)))
    every = once(lambda: list(solve(case, all_centres=True).centres.items()))
    kept.gates.append(Gate(f"all centres of {links} links", every, 1, " s"))
    rows.append([f"all n(n-1)/2 centres of {links} links", f"{1e3 * every:.3g}", ""])
    (fresh,) = least([_fresh_sweeps()], 0.2)
    kept.gates.append(Gate("set-up of a sweep of a four-bar, fresh", 1e3 * fresh, 1, " ms"))
    rows.append([f"{FEW_ROWS} rows of a fresh four-bar", f"{1e3 * fresh:.3g}", ""])
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
