"""Mutants of the core: does a test die when an operator, a comparison or a constant is changed?

    python tests/mutants.py [count] [seed] [first] [map]

Draws so many mutants from a seed over the rooms of `ROOMS`; a function's stay the same while others change.
The tests are run once to see which functions each of them calls (kept in the file ``map`` where it is named);
then, on a copy with the mutant, those that call the mutated function, quick and special ones first, until
one fails. Prints a line for each, and at the end how many died. `EQUIVALENT` has those that change no
answer, with the reason; they do not count. Not a test itself.
"""

from __future__ import annotations

import ast
import json
import os
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random
from types import FrameType
from typing import Any, NamedTuple

import click  # noqa: F401 - what a fork need not import again
import mpmath  # noqa: F401
import numpy as np  # noqa: F401
import pytest
import shapely  # noqa: F401
import yaml  # noqa: F401

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("numbers", "screws", "assembly", "kinematics", "statics", "scene")
BUDGET = 60.0
"""Seconds of CPU that the tests of one mutant take in all: of those that call its function the nearest."""
HUNG = 5
"""What takes so many times as long as it should hangs, and is dead."""
APART = (
    "accessible as_people_write bad_input bench check draw explain files fuzz gallery grade growth house "
    "notebook one_voice page picture plot readme reading report schema slips startup"
).split()
"""Tests of other rooms: names begin so."""
SWAPS: dict[type, list[type]] = {
    ast.Add: [ast.Sub],
    ast.Sub: [ast.Add],
    ast.Mult: [ast.Div],
    ast.Div: [ast.Mult],
    ast.Lt: [ast.LtE, ast.Gt],
    ast.LtE: [ast.Lt, ast.Gt],
    ast.Gt: [ast.GtE, ast.Lt],
    ast.GtE: [ast.Gt, ast.Lt],
    ast.Eq: [ast.NotEq],
    ast.NotEq: [ast.Eq],
    ast.And: [ast.Or],
    ast.Or: [ast.And],
    ast.Is: [ast.IsNot],
    ast.IsNot: [ast.Is],
    ast.In: [ast.NotIn],
    ast.NotIn: [ast.In],
}
EQUIVALENT: dict[str, str] = {
    "icsolve/assembly/driven/mechanism.py _as_guided #1: abs(float(dot(guide, contact))) > OFF_RADIUS -> "
    "abs(float(dot(guide, contact))) >= OFF_RADIUS": "no contact misses by just that",
    "icsolve/statics/power.py _solved_many #18: not whole.basis or not roots -> "
    "not whole.basis and (not roots)": (
        "known loads that no unknown could hold are told before, and without unknowns the loop makes nothing"
    ),
    "icsolve/numbers/tape.py Taped.__truediv__ #18: 0.0 -> 1.0": "of an operand that is not there",
    "icsolve/numbers/quadratics.py _Exclusion._refined #0: 6 -> 7": "six steps of Newton find all digits",
    "icsolve/statics/reaction_basis.py thread #6: rise * rise -> rise / rise": "a unit's length cancels out",
    "icsolve/statics/equilibrium.py Equilibrium.open_sizes #0: 1.0 -> 2.0": "rounding is far below",
    "icsolve/kinematics/centres.py CentreFinder._centre #15: 1000.0 -> 1500.0": "far from both",
    "icsolve/assembly/loci.py Axis.placed #1: 0.0 -> 1.0": "another point of the same line",
    "icsolve/assembly/walk.py places_of #4: 1.0 -> 2.0": "the size beside which a double is zero to 1e-40",
    "icsolve/statics/reaction_basis.py _as_it_moves #1: size <= 1e-09 -> size < 1e-09": "none is so slow",
    "icsolve/statics/reaction_basis.py _as_it_moves #3: 1e-09 * size -> 1e-09 / size": "none lies between",
    "icsolve/assembly/clusters.py Cluster.begin #0: 0 -> 1": "less than a length costs, either way",
    "icsolve/numbers/krawczyk.py _refined #4: len(rows) <= FEW -> len(rows) > FEW": "only the time",
    "icsolve/numbers/roots.py zero_between #8: abs(middle) <= least -> abs(middle) < least": "one ulp more",
    "icsolve/assembly/newton.py _NewtonSearch.__init__ #2: 1.0 -> 2.0": "how far to look where none is told",
    "icsolve/assembly/exclusion.py _bounds #16: bounds[0] - SLACK -> bounds[0] + SLACK": "each box that is "
    "tried is wider by more",
    "icsolve/assembly/conditions.py parts_of #3: 0 -> 1": "only a centroid's condition has parts",
    "icsolve/assembly/walk.py Walk._advance #0: 1 -> 2": "how many steps are tried",
    "icsolve/statics/reaction_basis.py _on_pivots #9: 1.0 -> 2.0": "a unit's size cancels out",
    "icsolve/statics/friction/enclosure.py _weights #0: 1.0 -> 2.0": "of a force of nothing",
    "icsolve/statics/load_wrenches.py acting #2: 2.0 * math.pi / case.units.torque_per_force_length -> 2.0 * "
    "math.pi * case.units.torque_per_force_length": "a size beside which a zero of 120 digits is one",
    "icsolve/kinematics/centres.py CentreFinder._placed #10: 180.0 -> 270.0": "of the size of a half turn",
    "icsolve/numbers/adjoint.py still_noise #2: 1 -> 2": "one step more, of no node",
    "icsolve/statics/space/reaction_basis.py _helix #1: 1.0 -> 2.0": "only a helix is divided by",
    "icsolve/statics/witness.py compared #0: False -> True": "a plain number is rounded whatever the size",
    "icsolve/numbers/krawczyk.py _refined #1: 2 -> 3": "one more inverse saves a step",
    "icsolve/numbers/quadratics.py _Exclusion._by_inverse #9: 0.0 -> 1.0": "of boxes that are not looked at",
    "icsolve/assembly/conditions.py module #1: 1e-06 -> 1.000001": "more is looked at in more digits",
    "icsolve/numbers/krawczyk.py _enclosed #8: 4.0 * balls.unit * (1.0 + max((abs(float(x)) for x in "
    "middle))) -> 4.0 * balls.unit / (1.0 + max((abs(float(x)) for x in middle)))": "how wide one begins",
    "icsolve/statics/load_wrenches.py _unit_wrench #6: -pi -> pi": "no unit of torque has a power of it",
    "icsolve/statics/equilibrium.py _equations #7: row.get(action.column, 0.0) + value -> row.get("
    "action.column, 0.0) - value": "all equations with the other sign",
    "icsolve/kinematics/accelerations.py _rates #12: 1.0 -> 2.0": "the size beside which a factor is zero",
    "icsolve/scene/program.py _arithmetics #13: 1 -> 2": "the second of two is the last",
    "icsolve/numbers/source.py straight_line #27: uses[k] > 1 -> uses[k] < 1": "only the length of the text",
    "icsolve/statics/power.py solve_balance #3: 1 -> 2": "one equation by the elimination of many",
    "icsolve/scene/parts.py AnswerBuilder.slopes #11: -1 -> 1": "the last of two",
    "icsolve/assembly/driven/poses.py Moved.degrees #1: 1.0 -> 2.0": "a size is no part of an angle",
    "icsolve/assembly/walk.py Walk._close #3: d <= TOO_CLOSE -> d < TOO_CLOSE": "the two are equal nowhere",
    "icsolve/numbers/__init__.py module #9: 64 -> 96.0": "bounds decide",
    "icsolve/kinematics/centres.py ordered #0: i < j -> i > j": "one order of a pair or the other",
    "icsolve/assembly/driven/mechanism.py _base #0: not spots[line.body] -> spots[line.body]": "one at 0, 0",
    "icsolve/numbers/intervals.py _turning #13: 2.0 -> 3.0": "beyond -1, where the cosine ends",
    "icsolve/numbers/balls.py widest #1: 0.0 -> 1.0": "balls are among the values",
    "icsolve/scene/program.py _arithmetics #25: dear > MOST -> dear >= MOST": "as many digits either way",
    "icsolve/numbers/__init__.py Floats.rounded #1: value + 0.0 -> value - 0.0": "the sign of a zero",
    "icsolve/statics/friction/pushing.py ReducedLimits.toward #7: ROUNDED * self.sizes[k] -> ROUNDED / "
    "self.sizes[k]": "what presses with nothing is far below, all else far above",
    "icsolve/statics/friction/in_motion.py is_beyond #0: 0.0 -> 1.0": "known loads have the size 1 there",
    "icsolve/statics/friction/lifting.py module #4: 1.0 -> 2.0": "the size of a load of zero",
    "icsolve/statics/friction/lifting.py jammed #9: 1.0 -> 2.0": "the size of a load of zero",
    "icsolve/statics/friction/equations.py contracted #5: -1e-12 * scale_at(equations, found) -> -1e-12 / "
    "scale_at(equations, found)": "further rounds lead to the same",
    "icsolve/assembly/newton.py _least_residual #5: 1000000.0 -> 1500000.0": "where damping is given up",
    "icsolve/statics/friction/pushing.py value_where #11: 0.0 -> 1.0": "the size beside which a ball is zero",
    "icsolve/statics/friction/standing.py _part #15: depth - ROUNDED -> depth + ROUNDED": "one more cut",
    "icsolve/statics/friction/held_ranges.py _Search.by_load #5: 0 -> 1": "all near go through the end",
    "icsolve/statics/friction/static_range.py End.carrying #3: 1.0 -> 2.0": "of an end that no equilibrium "
    "tells: the same is solved again",
}
"""Mutants, as they are listed, that change no answer, with the reason."""


class Mutant(NamedTuple):
    """A change of the ``place``-th node that can be changed in a function (``""``: of the module itself) of a
    file."""

    file: str
    function: str
    place: int
    line: int
    what: str
    text: str

    @property
    def name(self) -> str:
        """As it is listed, wherever the line stands."""
        return f"{self.file} {self.function or 'module'} #{self.place}: {self.what}"


class _Change(ast.NodeTransformer):
    """Counts the places of each function that can be changed, and changes the one that is asked for."""

    def __init__(self, at: tuple[str, int] = ("", -1), rng: Random | None = None) -> None:
        self.at, self.rng, self.line, self.what = at, rng or Random(0), 0, ""
        self.scope, self.counts = "", dict[str, int]()

    def _here(self) -> bool:
        k = self.counts[self.scope] = self.counts.get(self.scope, -1) + 1
        return self.at == (self.scope, k)

    def _became(self, node: ast.AST, was: str, now: ast.AST) -> ast.AST:
        self.line, self.what = node.lineno, f"{was} -> {ast.unparse(now)}"  # type: ignore[attr-defined]
        return now

    def _other(self, op: ast.AST) -> Any:
        return self.rng.choice(SWAPS[type(op)])()

    def visit_BinOp(self, node: Any) -> ast.AST:
        self.generic_visit(node)
        if type(node.op) in SWAPS and not _is_text(node) and self._here():
            was, node.op = ast.unparse(node), self._other(node.op)
            return self._became(node, was, node)
        return node

    visit_AugAssign = visit_BinOp  # noqa: N815
    visit_BoolOp = visit_BinOp  # noqa: N815

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        for k, op in enumerate(node.ops):
            if self._here():
                was, node.ops[k] = ast.unparse(node), self._other(op)
                return self._became(node, was, node)
        return node

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.op, ast.USub | ast.Not) and self._here():
            return self._became(node, ast.unparse(node), node.operand)
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if type(node.value) not in (int, float, bool) or not self._here():
            return node
        value = node.value
        new = not value if type(value) is bool else value + 1 if abs(value) < 10 else value * 1.5
        return self._became(node, repr(value), ast.copy_location(ast.Constant(new), node))

    def visit_keyword(self, node: ast.keyword) -> ast.AST:
        return node if node.arg == "strict" else self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        if node.name in ("__repr__", "__str__"):
            return node
        return self._inside(node, f"{self.scope}{node.name}", ".<locals>.")

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        return self._inside(node, f"{self.scope}{node.name}", ".")

    def _inside(self, node: Any, name: str, joined: str) -> ast.AST:
        """A function or a class; annotations and defaults of types are left alone."""
        outer = self.scope
        for k, part in enumerate(node.body):
            inner = isinstance(part, ast.FunctionDef | ast.ClassDef)
            self.scope = f"{name}{joined}" if inner else name
            node.body[k] = self.visit(part)
        self.scope = outer
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        if node.value is not None:
            node.value = self.visit(node.value)
        return node


def _is_text(node: ast.AST) -> bool:
    """Whether a sum joins words, tuples or types."""
    parts = (getattr(node, side, None) for side in ("left", "right", "value"))
    kinds = ast.JoinedStr | ast.Tuple | ast.List
    return any(isinstance(p, kinds) or isinstance(getattr(p, "value", None), str) for p in parts)


def drawn(count: int, seed: int) -> list[Mutant]:
    """The mutants of a seed, by a hash of the place: what changes elsewhere moves none."""
    trees = {}
    places = []
    for file in (f for room in ROOMS for f in (ROOT / "icsolve" / room).rglob("*.py")):
        name, text = str(file.relative_to(ROOT)), file.read_text(encoding="utf-8")
        counted = _Change()
        counted.visit(ast.parse(text))
        trees[name] = text
        for scope, last in counted.counts.items():
            places += [(name, scope, k) for k in range(last + 1)]
    found = []
    for name, scope, k in sorted(places, key=lambda place: Random(f"{seed} {place}").random())[:count]:
        change = _Change((scope, k), Random(f"{seed} {name} {scope} {k}"))
        tree = change.visit(ast.parse(trees[name]))
        text = ast.unparse(ast.fix_missing_locations(tree))
        function = scope.removesuffix(".<locals>.")
        found.append(Mutant(name, function, k, change.line, change.what, text))
    return found


class Calls:
    """Writes what each test that passes calls of the core, ``file function``, and its seconds of CPU."""

    def __init__(self, copy: Path, out: Path) -> None:
        self.rooms = {str(copy / "icsolve" / room) + os.sep: room for room in ROOMS}
        self.copy, self.out, self.passed = copy, out, True
        self.tests: dict[str, tuple[float, list[str]]] = {}

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Around a test with its fixtures."""
        seen: set[Any] = set()

        def called(frame: FrameType, _event: str, _arg: object) -> None:
            seen.add(frame.f_code)

        self.passed, start = True, time.process_time()
        sys.settrace(called)
        yield
        sys.settrace(None)
        spent = time.process_time() - start
        if self.passed:
            own = [c for c in seen if c.co_filename.startswith(tuple(self.rooms))]
            names = {f"{Path(c.co_filename).relative_to(self.copy)} {c.co_qualname}" for c in own}
            self.tests[item.nodeid] = spent, sorted(names)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Tests that are skipped or fail judge no mutant."""
        self.passed = self.passed and report.passed

    def pytest_sessionfinish(self) -> None:
        """All is written at once."""
        self.out.write_text(json.dumps(self.tests))


class Collected:
    """Keeps the names of the tests that there are."""

    def __init__(self, out: Path) -> None:
        self.out = out

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Write them."""
        self.out.write_text(json.dumps([item.nodeid for item in session.items]))


def calls_of(copy: Path, kept: Path) -> dict[str, tuple[float, list[str]]]:
    """Seconds and called functions of the tests, by name; made in a run of them all where not ``kept``. Of a
    kept map the tests that are there still: a name that leads to none would end a run as a failure does."""
    if not kept.exists():
        files = sorted(f.name for f in (copy / "tests").glob("test_*.py"))
        near = [f"tests/{name}" for name in files if not name.startswith(tuple(f"test_{a}" for a in APART))]
        _in_fork(copy, ["-q", "--tb=no", *near], Calls(copy, kept))
    there = copy / "there.json"
    _in_fork(copy, ["--collect-only", "-qq", "tests"], Collected(there))
    names = set(json.loads(there.read_text()))
    return {name: call for name, call in json.loads(kept.read_text()).items() if name in names}


def tests_of(mutant: Mutant, calls: dict[str, tuple[float, list[str]]]) -> list[str]:
    """The tests that call the mutated function (of the module itself, of its classes and of a class without
    functions: any there), quick and special ones first, as many as the budget has time for."""
    own = f"{mutant.file} {mutant.function}"
    inside = not mutant.function or mutant.function.split(".")[-1][:1].lstrip("_").isupper()
    near = []
    for wanted in (own, f"{mutant.file} "):
        for test, (spent, names) in calls.items() if not near else ():
            if own in names or (inside and any(name.startswith(wanted) for name in names)):
                near.append((spent * len(names), spent, test))
    taken, total = [], 0.0
    for _, spent, test in sorted(near):
        total += spent
        if taken and total > BUDGET:
            break
        taken.append(test)
    return taken


def killer(mutant: Mutant, copy: Path, calls: dict[str, tuple[float, list[str]]]) -> str:
    """What kills a mutant; '' where nothing does."""
    file = copy / mutant.file
    whole, times = file.read_text(encoding="utf-8"), file.stat()
    file.write_text(mutant.text, encoding="utf-8")
    tests = tests_of(mutant, calls)
    try:
        for step in (tests[:20], tests[20:]):
            said = _run(copy, step, HUNG * (2 + sum(calls[test][0] for test in step))) if step else ""
            if said:
                return said
        return ""
    finally:
        file.write_text(whole, encoding="utf-8")
        os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))


def _enter(copy: Path, mutated: bool) -> None:
    """Into the copy, in a fork of this process, which has all packages but the project's."""
    os.chdir(copy)
    sys.path.insert(0, str(copy))
    os.environ["PYTHONPATH"] = str(copy)
    if mutated:  # compiled files are those of the tree as it is
        sys.dont_write_bytecode = True
        os.environ["PYTHONDONTWRITEBYTECODE"] = "1"


def _in_fork(copy: Path, arguments: list[str], plugin: object) -> None:
    """The tests as they are, in a process of their own."""
    if not os.fork():
        _enter(copy, mutated=False)
        os._exit(pytest.main(["-p", "no:cacheprovider", *arguments], [plugin]))
    os.wait()


def _run(copy: Path, tests: list[str], limit: float) -> str:
    """The first test that fails in so many seconds of CPU; '' where none does."""
    out = copy / "said.txt"
    child = os.fork()
    if not child:
        resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 5))
        os.dup2(os.open(out, os.O_CREAT | os.O_TRUNC | os.O_WRONLY), 1)
        _enter(copy, mutated=True)
        os._exit(pytest.main(["-x", "-q", "--tb=no", "-p", "no:cacheprovider", *tests]))
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        return "time" if os.WTERMSIG(status) == signal.SIGXCPU else f"signal {os.WTERMSIG(status)}"
    failed = [line for line in out.read_text().splitlines() if line.startswith(("FAILED", "ERROR"))]
    return (failed or [f"exit {os.WEXITSTATUS(status)}"])[0] if status else ""


def say(line: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main(count: int = 200, seed: int = 2026, first: int = 0, kept: str = "") -> int:
    """Run mutants from the ``first`` on; the exit status is 0 where 95 % of the effective ones die."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        skipped = shutil.ignore_patterns(".git", ".venv", "__pycache__", ".*_cache")
        shutil.copytree(ROOT, copy, ignore=skipped)
        calls = calls_of(copy, Path(kept or Path(folder) / "calls.json").absolute())
        alive, dead, same = [], 0, 0
        for n, mutant in enumerate(drawn(count, seed)[first:], start=first):
            if mutant.name in EQUIVALENT:
                same += 1
                say(f"{n:3d} same     {mutant.name}: {EQUIVALENT[mutant.name]}")
                continue
            by = killer(mutant, copy, calls)
            dead += bool(by)
            alive += [] if by else [mutant]
            say(f"{n:3d} {'dead' if by else 'SURVIVES'}  {mutant.name} (line {mutant.line})  {by[:90]}")
    say(f"{dead} dead, {len(alive)} alive, {same} equivalent")
    return 0 if dead >= 0.95 * (dead + len(alive)) else 1


if __name__ == "__main__":
    sys.exit(main(*(int(a) if a.isdigit() else a for a in sys.argv[1:])))  # type: ignore[arg-type]
