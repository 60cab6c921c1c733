"""How the house stands: a case flows through its rooms in one direction, and nothing leads back.

Imports are read with `ast`, those inside functions too; what only the type checker reads does not count.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "icsolve"
ROOMS = (
    "errors units files forked numbers case wording answer structure screws assembly kinematics statics cams "
    "read scene sweep solve check report derivation draw explain page notebook grade manual bench cli"
).split()
"""In the order in which they may lean on one another: each only on those before it."""


def modules() -> dict[str, Path]:
    """Every module of the package by its dotted name."""
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        parts = (PACKAGE.name, *file.relative_to(PACKAGE).with_suffix("").parts)
        found[".".join(parts).removesuffix(".__init__")] = file
    return found


def imported(tree: ast.Module, known: dict[str, Path]) -> Iterator[str]:
    """The package's modules that a module imports, wherever in it."""
    hidden = {
        id(node)
        for block in ast.walk(tree)
        if isinstance(block, ast.If) and "TYPE_CHECKING" in ast.unparse(block.test)
        for node in ast.walk(block)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and id(node) not in hidden:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                yield whole if whole in known else node.module


def room_of(module: str) -> str:
    """The room in which a module stands; '' for the package itself."""
    return module.split(".")[1] if "." in module else ""


def arrows() -> set[tuple[str, str]]:
    """Every pair of rooms of which the first imports from the second."""
    known = modules()
    pairs = set()
    for name, file in known.items():
        for other in imported(ast.parse(file.read_text()), known):
            if other.startswith("icsolve.") and room_of(other) != room_of(name):
                pairs.add((room_of(name), room_of(other)))
    return pairs


def test_rooms_lean_one_way() -> None:
    place = {room: n for n, room in enumerate(ROOMS)}
    assert not {(a, b) for a, b in arrows() if a and a != "__main__" and place[a] < place[b]}


def test_every_room_has_its_place_in_the_order() -> None:
    rooms = {room_of(name) for name in modules()} - {"", "__main__"}
    assert rooms == set(ROOMS)


def test_no_module_comes_back_to_itself() -> None:
    """Within a room, too: of modules of which each imports only ordered ones, all can be ordered."""
    known = modules()
    leans = {name: set(imported(ast.parse(file.read_text()), known)) - {name} for name, file in known.items()}
    left = {name: others & known.keys() for name, others in leans.items()}
    while ordered := {name for name, others in left.items() if not others & left.keys()}:
        left = {name: others for name, others in left.items() if name not in ordered}
    assert not left, f"a circle of imports: {sorted(left)}"


@pytest.mark.parametrize("room", ["case", "answer"])
def test_values_know_nothing_of_how_they_are_shown(room: str) -> None:
    assert not {b for a, b in arrows() if a == room} & {"draw", "explain", "page", "report"}
