"""A one-scene solve starts without numpy and shapely, and the library without anything."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from icsolve.manual import kinds, template
from icsolve.read import load

ROOT = Path(__file__).parent.parent


def imported(*arguments: str) -> set[str]:
    """The modules that a call of Python imports, by -X importtime."""
    ran = subprocess.run(
        [sys.executable, "-X", "importtime", *arguments], cwd=ROOT, capture_output=True, text=True, check=True
    )
    lines = [line for line in ran.stderr.splitlines() if line.startswith("import time:")]
    return {line.rpartition("|")[2].strip() for line in lines}


SCENES = [kind for kind in kinds() if not load(template(kind)).unknowns]
"""Kinds that ask for one scene: positions of equilibrium are looked for in many."""


@pytest.mark.parametrize("kind", SCENES)
@pytest.mark.parametrize("options", [(), ("--json", "--all-centres", "--rates")])
def test_one_scene_needs_neither_numpy_nor_shapely(
    tmp_path: Path, kind: str, options: tuple[str, ...]
) -> None:
    path = tmp_path / "one.yaml"
    path.write_text(template(kind))
    modules = imported("-m", "icsolve", "solve", *options, str(path))
    assert "icsolve.solve" in modules
    assert not {name for name in modules if name.partition(".")[0] in {"numpy", "shapely"}}


def test_importing_the_library_imports_no_room() -> None:
    modules = imported("-c", "import icsolve; icsolve.__version__")
    assert {name for name in modules if name.partition(".")[0] in {"icsolve", "yaml", "click"}} == {"icsolve"}


def test_solve_is_the_function_even_after_its_room_was_imported() -> None:
    check = "import icsolve.solve, icsolve; assert icsolve.solve.__name__ == 'solve'; icsolve.solve.__call__"
    assert "icsolve.solve" in imported("-c", check)
