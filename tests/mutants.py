"""Mutants of the core: does a test die when an operator, a comparison or a constant is changed?

    python tests/mutants.py [count] [seed] [first]

Draws so many mutants from a seed over the rooms of `ROOMS`, each in a copy of the project, and runs the
quick tests that are nearest to its room first, with -x and a time limit. Prints a line for each, and at the
end how many died. `EQUIVALENT` has those that change no answer, with the reason; they do not count. Not a
test itself: 200 mutants take some hours of one core.
"""

from __future__ import annotations

import ast
import os
import resource
import shutil
import signal
import sys
import tempfile
from pathlib import Path
from random import Random
from typing import NamedTuple

import click  # noqa: F401 - what a fork need not import again
import numpy as np  # noqa: F401
import pytest
import shapely  # noqa: F401
import yaml  # noqa: F401

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("numbers", "screws", "assembly", "kinematics", "statics", "scene")
LIMIT = 60
"""Seconds of CPU a step of the tests may take, three times what the slowest does: what hangs is dead."""
FIRST = {
    "numbers": "balls krawczyk digits bounds reaction_digits",
    "screws": "screws digits reaction_digits ropes",
    "assembly": "figure figure_refusals ways krawczyk digits figure_random",
    "kinematics": "digits three_routes second_order reference",
    "statics": "reaction_digits bodies bodies_gears bodies_scenes friction friction_bounds ropes",
    "scene": "digits reaction_digits sensitivity bodies_scenes",
    "space": "space space_random space_digits",
}
"""The tests that know most of a room."""
THEN = (
    "result bodies_scenes more_loads figures_measured friction ropes three_routes space sensitivity",
    "sweep_numbers sweep_find sweep_friction profile reference stress cases dynamics near null_space",
)
"""Those that follow, for all."""
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
EQUIVALENT: dict[str, str] = {}
"""``file:line kind`` of mutants that change no answer, with the reason."""


class Mutant(NamedTuple):
    """A change of one node of a file."""

    file: str
    line: int
    what: str
    text: str

    @property
    def name(self) -> str:
        """As it is listed."""
        return f"{self.file}:{self.line} {self.what}"


class _Change(ast.NodeTransformer):
    """Counts the places that can be changed, and changes the one that is asked for."""

    def __init__(self, at: int, rng: Random) -> None:
        self.at, self.rng, self.count, self.line, self.what = at, rng, -1, 0, ""

    def _here(self) -> bool:
        self.count += 1
        return self.count == self.at

    def _swapped(self, node: ast.AST, op: ast.AST) -> ast.AST:
        new = self.rng.choice(SWAPS[type(op)])()
        self.line, self.what = node.lineno, f"{type(op).__name__} -> {type(new).__name__}"  # type: ignore[attr-defined]
        return new

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        if type(node.op) in SWAPS and not _is_text(node) and self._here():
            node.op = self._swapped(node, node.op)  # type: ignore[assignment]
        return node

    visit_AugAssign = visit_BinOp  # type: ignore[assignment]  # noqa: N815
    visit_BoolOp = visit_BinOp  # type: ignore[assignment]  # noqa: N815

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        for k, op in enumerate(node.ops):
            if self._here():
                node.ops[k] = self._swapped(node, op)  # type: ignore[call-overload]
        return node

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.op, ast.USub | ast.Not) and self._here():
            self.line, self.what = node.lineno, f"{type(node.op).__name__} -> nothing"
            return node.operand
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if type(node.value) in (int, float) and self._here():
            new = node.value + 1 if abs(node.value) < 10 else node.value * 1.5
            self.line, self.what = node.lineno, f"{node.value} -> {new}"
            return ast.copy_location(ast.Constant(new), node)
        if type(node.value) is bool and self._here():
            self.line, self.what = node.lineno, f"{node.value} -> {not node.value}"
            return ast.copy_location(ast.Constant(not node.value), node)
        return node

    def visit_keyword(self, node: ast.keyword) -> ast.AST:
        return node if node.arg == "strict" else self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        if node.name in ("__repr__", "__str__"):
            return node
        for part in node.body:  # annotations and defaults of types are left alone
            self.visit(part)
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
    """The mutants of a seed: rooms weighed by what can be changed in them."""
    rng = Random(seed)
    files = sorted(f for room in ROOMS for f in (ROOT / "icsolve" / room).rglob("*.py"))
    trees = {file: file.read_text(encoding="utf-8") for file in files}
    places = []
    for file, text in trees.items():
        counted = _Change(-1, rng)
        counted.visit(ast.parse(text))
        places += [(file, k) for k in range(counted.count + 1)]
    found = []
    for file, k in rng.sample(places, count):
        change = _Change(k, rng)
        tree = change.visit(ast.parse(trees[file]))
        text = ast.unparse(ast.fix_missing_locations(tree))
        found.append(Mutant(str(file.relative_to(ROOT)), change.line, change.what, text))
    return found


def steps_of(room: str) -> list[list[str]]:
    """The tests that are run on a mutant in a room, nearest first."""
    taken: set[str] = set()
    steps = []
    for names in (FIRST[room], *THEN):
        step = [name for name in names.split() if name not in taken]
        taken |= {*step}
        steps.append([f"tests/test_{name}.py" for name in step])
    return steps


def killer(mutant: Mutant, copy: Path) -> str:
    """What kills a mutant; '' where nothing does."""
    file = copy / mutant.file
    whole, times = file.read_text(encoding="utf-8"), file.stat()
    file.write_text(mutant.text, encoding="utf-8")
    try:
        room = mutant.file.split("/")[1]
        for tests in steps_of("space" if "/space/" in mutant.file else room):
            said = _run(copy, tests)
            if said:
                return said
        return ""
    finally:
        file.write_text(whole, encoding="utf-8")
        os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))


def _run(copy: Path, tests: list[str], mutated: bool = True) -> str:
    """The first test that fails in a fork of this process, which has all packages but the project's."""
    out = copy / "said.txt"
    child = os.fork()
    if not child:
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))
        os.dup2(os.open(out, os.O_CREAT | os.O_TRUNC | os.O_WRONLY), 1)
        os.chdir(copy)
        sys.path.insert(0, str(copy))
        os.environ["PYTHONPATH"] = str(copy)
        if mutated:  # compiled files are those of the tree as it is
            sys.dont_write_bytecode = True
            os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
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


def main(count: int = 200, seed: int = 2026, first: int = 0) -> int:
    """Run mutants from the ``first`` on; the exit status is 0 where 95 % of the effective ones die, 2 where
    the tests do not pass as they are."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        skipped = shutil.ignore_patterns(".git", ".venv", "__pycache__", ".*_cache")
        shutil.copytree(ROOT, copy, ignore=skipped)
        for tests in dict.fromkeys(tuple(step) for room in FIRST for step in steps_of(room)):
            broken = _run(copy, list(tests), mutated=False)
            if broken:
                say(f"without a mutant: {broken}")
                return 2
        alive, dead, same = [], 0, 0
        for n, mutant in enumerate(drawn(count, seed)[first:], start=first):
            if mutant.name in EQUIVALENT:
                same += 1
                say(f"{n:3d} same     {mutant.name}: {EQUIVALENT[mutant.name]}")
                continue
            by = killer(mutant, copy)
            dead += bool(by)
            alive += [] if by else [mutant]
            say(f"{n:3d} {'dead' if by else 'SURVIVES'}  {mutant.name}  {by[:90]}")
    say(f"{dead} dead, {len(alive)} alive, {same} equivalent")
    return 0 if dead >= 0.95 * (dead + len(alive)) else 1


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
