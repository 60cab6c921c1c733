"""How the house stands: a case flows through its rooms in one direction, and nothing leads back.

Imports are read with `ast`, those inside functions and those for the type checker alone too.
"""

from __future__ import annotations

import ast
import subprocess
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any, get_args

import pytest

from icsolve.case import Joint

PACKAGE = Path(__file__).parent.parent / "icsolve"
ROOMS = (
    "tuples errors files numbers case answer structure wording screws assembly kinematics statics cams "
    "read scene sweep solve report draw explain page grade manual bench cli"
).split()
"""In the order in which they may lean on one another: each only on those before it."""


@cache
def nodes(file: Path) -> dict[type, list[Any]]:
    """What a module imports, names, defines and tells apart, wherever in it: each file is read once."""
    kinds = (ast.ImportFrom, ast.Name, ast.ClassDef, ast.Match, ast.Call)
    found: dict[type, list[Any]] = {kind: [] for kind in kinds}
    for node in ast.walk(ast.parse(file.read_text())):
        found.get(type(node), []).append(node)
    found[ast.Call] = [c for c in found[ast.Call] if getattr(c.func, "id", "") == "isinstance"]
    found[ast.Name] = list({node.id: node for node in found[ast.Name]}.values())
    return found


@cache
def modules() -> dict[str, Path]:
    """Every module of the package by its dotted name."""
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        parts = (PACKAGE.name, *file.relative_to(PACKAGE).with_suffix("").parts)
        found[".".join(parts).removesuffix(".__init__")] = file
    return found


@cache
def imported(file: Path) -> frozenset[str]:
    """The package's modules that a module imports, wherever in it."""
    known = modules()
    found = set()
    for node in nodes(file)[ast.ImportFrom]:
        if node.module:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                found.add(whole if whole in known else node.module)
    return frozenset(found)


def room_of(module: str) -> str:
    """The room in which a module stands; '' for the package itself."""
    return module.split(".")[1] if "." in module else ""


def arrows() -> set[tuple[str, str]]:
    """Every pair of rooms of which the first imports from the second."""
    known = modules()
    pairs = set()
    for name, file in known.items():
        for other in imported(file):
            if other.startswith("icsolve.") and room_of(other) != room_of(name):
                pairs.add((room_of(name), room_of(other)))
    return pairs


def test_nothing_else_lies_beside_the_rooms() -> None:
    """What the project has at its top, dot-files aside: what a tool left behind there is not committed."""
    listed = ["git", "ls-tree", "--name-only", "HEAD"]
    run = subprocess.run(listed, check=False, cwd=PACKAGE.parent, capture_output=True, text=True)
    if run.returncode:
        pytest.skip("not a checkout")
    top = {name for name in run.stdout.split("\n") if name and not name.startswith(".")}
    assert top == {"pyproject.toml", "icsolve", "cases", "tests", "README.md", "LICENSE"}


def test_rooms_lean_one_way() -> None:
    place = {room: n for n, room in enumerate(ROOMS)}
    assert not {(a, b) for a, b in arrows() if a and a != "__main__" and place[a] < place[b]}


def test_every_room_has_its_place_in_the_order() -> None:
    rooms = {room_of(name) for name in modules()} - {"", "__main__"}
    assert rooms == set(ROOMS)


def test_no_module_comes_back_to_itself() -> None:
    """Within a room, too: of modules of which each imports only ordered ones, all can be ordered.

    An answer knows how it is written as JSON (``to_dict``), which knows the answer: that is one thought, and
    the text of it is read only when it is asked for.
    """
    known = modules()
    leans = {name: imported(file) - {name} for name, file in known.items()}
    leans["icsolve.answer"] -= {"icsolve.answer.as_json", "icsolve.answer.equilibrium"}
    left = {name: others & known.keys() for name, others in leans.items()}
    while ordered := {name for name, others in left.items() if not others & left.keys()}:
        left = {name: others for name, others in left.items() if name not in ordered}
    assert not left, f"a circle of imports: {sorted(left)}"


def test_no_class_has_its_name_from_another() -> None:
    """One word, one meaning."""
    names = Counter(node.name for file in modules().values() for node in nodes(file)[ast.ClassDef])
    assert not {name for name, count in names.items() if count > 1}


def test_named_tuples_are_those_that_start_fast() -> None:
    for name, file in modules().items():
        imports = nodes(file)[ast.ImportFrom]
        asked = {(node.module, alias.name) for node in imports for alias in node.names}
        slow = {("typing", "NamedTuple"), ("dataclasses", "dataclass"), ("dataclasses", "replace")}
        assert not slow & asked or name == "icsolve.tuples", name
        assert ("icsolve.tuples", "NamedTuple") not in asked or ("__future__", "annotations") in asked, name


KINDS = [kind.__name__ for kind in get_args(Joint)]


@cache
def named_in(file: Path) -> set[str]:
    """The kinds of joint that a module names."""
    return {node.id for node in nodes(file)[ast.Name]} & set(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_of_joint_is_told_in_few_places(kind: str) -> None:
    """Its class, what makes it of a file, what is said and drawn of it; all else asks it what it is.

    A screw's rotor and a rope's end turn in pins; contacts are also what profiles give, and a row of a sweep.
    """
    told = {name for name, file in modules().items() if kind in named_in(file)}
    told -= {"icsolve.case.joints", "icsolve.read.joints", "icsolve.wording.joints", "icsolve.draw.frame"}
    contacts = {"icsolve.cams.contact_search", "icsolve.sweep.recorded_scene", "icsolve.sweep.cam_motion"}
    assert told <= {
        "Contact": contacts,
        "Pin": {"icsolve.statics.reaction_basis", "icsolve.read.ropes"},
        "Slide": {"icsolve.statics.reaction_basis", "icsolve.grade.mistakes.changed"},
    }.get(kind, set())


@pytest.mark.parametrize(("family", "most"), [("Sliding", 4), ("Guided", 16), ("Rolling", 8), ("Mesh", 17)])
def test_a_family_of_joints_is_asked_for_in_few_modules(family: str, most: int) -> None:
    """As few as today, or fewer: what can be asked of every joint is a question that its class answers."""
    asked = {
        name
        for name, file in modules().items()
        for call in nodes(file)[ast.Call]
        if family in {node.id for node in ast.walk(call.args[1]) if isinstance(node, ast.Name)}
    }
    assert len(asked) <= most, sorted(asked)


def test_where_kinds_are_told_apart_the_type_checker_sees_to_it_that_all_are() -> None:
    for file in modules().values():
        for node in nodes(file)[ast.Match]:
            cases = [ast.unparse(one.pattern) for one in node.cases]
            kinds = {word for one in cases for word in KINDS if f"{word}(" in one}
            assert len(kinds) < 2 or "assert_never" in ast.unparse(node.cases[-1]), f"{file}: {kinds}"


@pytest.mark.parametrize("room", ["case", "answer"])
def test_values_know_nothing_of_how_they_are_shown(room: str) -> None:
    assert not {b for a, b in arrows() if a == room} & {"draw", "explain", "page", "report"}
