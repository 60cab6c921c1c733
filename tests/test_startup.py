"""A one-scene solve starts without numpy and shapely, and the library without anything."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import os
import pickle
import subprocess
import sys
import typing
from functools import cached_property
from itertools import product
from pathlib import Path
from random import Random
from typing import Generic, TypeVar

import pytest

import rough_scenes
from icsolve.bench.full_turn import FOUR_BAR_CASE
from icsolve.bench.promises import MOVING
from icsolve.manual import kinds, template
from icsolve.read import load
from icsolve.tuples import NamedTuple, dataclass, field, replace
from sizes import sampled

ROOT = Path(__file__).parent.parent


WATCHED = """
import os, runpy, sys
os._exit = sys.exit  # a command ends so, at once
how, what, *sys.argv[1:] = sys.argv[1:]
try:
    runpy.run_module(what, run_name="__main__") if how == "-m" else exec(what)
finally:
    print("imported", *sys.modules, file=sys.stderr)
"""


def imported(how: str, what: str, *arguments: str, worst: int = 0) -> set[str]:
    """The modules that a call of Python has at its end; its exit status is this at most."""
    call = [sys.executable, "-c", WATCHED, how, what, *arguments]
    ran = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=False)
    told, *modules = (ran.stderr.splitlines() or [""])[-1].split()
    assert told == "imported" and 0 <= ran.returncode <= worst, ran.stderr
    return set(modules)


SCENES = [kind for kind in kinds() if not load(template(kind)).unknowns]
"""Kinds that ask for one scene: positions of equilibrium are looked for in many."""
OPTIONS: list[tuple[str, ...]] = [(), ("--json", "--all-centres", "--rates")]


@pytest.mark.parametrize("options", OPTIONS)
def test_scenes_of_no_kind_need_numpy_or_shapely(tmp_path: Path, options: tuple[str, ...]) -> None:
    """One process for all kinds: what any of them imports is imported in it."""
    paths = [tmp_path / f"{kind}.yaml" for kind in SCENES]
    for kind, path in zip(SCENES, paths, strict=True):
        path.write_text(template(kind))
    modules = imported("-m", "icsolve", "solve", *options, *map(str, paths))
    assert "icsolve.solve" in modules
    assert not {name for name in modules if name.partition(".")[0] in {"numpy", "shapely"}}


def test_friction_of_contacts_and_guides_needs_no_numpy(tmp_path: Path) -> None:
    """All loads at which a wedge or a crate is about to move follow from linear equations."""
    paths = []
    for kind, seed in product(rough_scenes.KINDS, range(3)):
        paths.append(tmp_path / f"{kind.__name__}{seed}.yaml")
        text = kind(Random(f"start {kind.__name__} {seed}")).text.replace("LOAD", "unknown")
        paths[-1].write_text("icsolve: 1\n" + text)
    modules = imported("-m", "icsolve", "solve", *map(str, paths), worst=1)  # some hold at no load
    assert "icsolve.statics.friction.solutions" in modules
    assert not {name for name in modules if name.partition(".")[0] == "numpy"}


LATE = {
    f"icsolve.{room}" for room in ("screws.ropes", "screws.space", "assembly.refusals", "assembly.newton")
}


@pytest.mark.parametrize(
    ("text", "late"),
    [
        (FOUR_BAR_CASE, {*LATE, "icsolve.numbers.linear", "icsolve.statics.equilibrium"}),
        (MOVING, {*LATE, "icsolve.numbers.tape", "icsolve.statics.friction.solutions"}),
    ],
)
def test_a_linkage_imports_no_room_of_what_it_does_not_have(
    tmp_path: Path, text: str, late: set[str]
) -> None:
    """Ropes, space, groups for Newton's method, refusals, more solutions than the one that is proven."""
    path = tmp_path / "one.yaml"
    path.write_text(text)
    modules = imported("-m", "icsolve", "solve", str(path))
    assert "icsolve.statics.power" in modules and not modules & late


CAMS = ["tangent_cam", "square_cam", "oscillating_flat_follower", "offset_roller_follower"]


@sampled(2)
@pytest.mark.parametrize("name", CAMS)
def test_one_scene_of_a_cam_needs_neither(name: str) -> None:
    """Arcs, corners, a disk, a table of radii: contacts are found by closed forms and plain loops."""
    modules = imported("-m", "icsolve", "solve", f"cases/cams/{name}.yaml")
    assert "icsolve.cams.solving" in modules
    assert not {name for name in modules if name.partition(".")[0] in {"numpy", "shapely", "fractions"}}
    assert "icsolve.statics.friction.solutions" not in modules


@pytest.mark.parametrize(("told", "threads"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_a_command_has_one_thread_for_linear_algebra_unless_told_otherwise(
    told: dict[str, str], threads: str
) -> None:
    code = (
        "import os, icsolve.cli as c; c.main = lambda: print(os.environ['OPENBLAS_NUM_THREADS']); c.entry()"
    )
    usual = {k: v for k, v in os.environ.items() if k != "OPENBLAS_NUM_THREADS"}
    ran = subprocess.run([sys.executable, "-c", code], env=usual | told, capture_output=True, check=True)
    assert ran.stdout.split() == [threads.encode()]


def test_importing_the_library_imports_no_room() -> None:
    modules = imported("-c", "import icsolve; icsolve.__version__")
    assert {name for name in modules if name.partition(".")[0] in {"icsolve", "yaml", "click"}} == {"icsolve"}


def test_solve_is_the_function_even_after_its_room_was_imported() -> None:
    check = "import icsolve.solve, icsolve; assert icsolve.solve.__name__ == 'solve'; icsolve.solve.__call__"
    assert "icsolve.solve" in imported("-c", check)


T = TypeVar("T")


class Swift(NamedTuple, Generic[T]):
    """A named tuple as all of the package are made."""

    one: T
    two: int = 2
    three: tuple[int, ...] = ()

    @property
    def both(self) -> tuple[T, int]:
        """What a method sees."""
        return self.one, self.two


class Plain(typing.NamedTuple, Generic[T]):
    """The same by the library."""

    one: T
    two: int = 2
    three: tuple[int, ...] = ()


class Derived(Swift[float]):
    """A class over one, as the kinds of joint are."""


def test_a_named_tuple_that_is_made_swiftly_is_as_the_library_makes_it() -> None:
    swift, plain = Swift("a", three=(1,)), Plain("a", three=(1,))
    assert swift == plain == ("a", 2, (1,)) and hash(swift) == hash(plain)
    assert repr(swift) == repr(plain).replace("Plain", "Swift") and swift.both == ("a", 2)
    assert swift._replace(two=5) == plain._replace(two=5) and swift._asdict() == plain._asdict()
    assert (Swift._fields, Swift._field_defaults) == (Plain._fields, Plain._field_defaults)
    assert type(pickle.loads(pickle.dumps(Derived(1.0)))) is Derived and Derived(1.0)._replace(two=3).two == 3
    assert list(inspect.signature(Swift).parameters) == list(inspect.signature(Plain).parameters)
    match swift:
        case Swift(one, _, (three,)):
            assert (one, three) == ("a", 1)
    for bad in (
        lambda c: c(),
        lambda c: c(1, 2, (), 4),
        lambda c: c(1, four=4),
        lambda c: c(1)._replace(x=1),
    ):
        for kind in (Swift, Plain):
            with pytest.raises((TypeError, ValueError)):
                bad(kind)
    with pytest.raises(AttributeError):
        swift.four = 4  # type: ignore[attr-defined]
    with pytest.raises(TypeError):
        type("Odd", (NamedTuple,), {"__annotations__": {"a": "int", "b": "int"}, "a": 1})


@dataclass(frozen=True, eq=False, repr=False)
class Frozen:
    """A frozen class as cases and answers are."""

    one: int
    two: dict[str, int] = field(default_factory=dict)
    three: float = 3.0

    @cached_property
    def four(self) -> float:
        """Kept when it is first asked."""
        return self.one + self.three


def test_a_frozen_class_that_is_made_swiftly_is_one_of_the_library_too() -> None:
    first, second = Frozen(1), Frozen(one=1, three=5.0)
    assert (first.two, first.four, second.four) == ({}, 4.0, 6.0) and first.two is not second.two
    for change in (replace, dataclasses.replace):
        other = change(first, three=7.0)
        assert type(other) is Frozen and (other.four, first.four) == (8.0, 4.0) and other.two is first.two
        with pytest.raises(TypeError):
            change(first, five=1)
    assert [each.name for each in dataclasses.fields(first)] == ["one", "two", "three"]
    told = inspect.signature(Frozen).parameters
    assert [each.default for each in told.values()] == [inspect.Parameter.empty, {}, 3.0]
    assert pickle.loads(pickle.dumps(second)).four == copy.copy(second).four == 6.0
    for bad in (Frozen, lambda: Frozen(1, 2, 3, 4), lambda: Frozen(1, one=1), lambda: Frozen(1, x=1)):
        with pytest.raises(TypeError):
            bad()
    with pytest.raises(AttributeError):
        first.one = 2  # type: ignore[misc]
    with pytest.raises(AttributeError):
        del first.two
