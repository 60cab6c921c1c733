"""Whatever number of a case has a path is set by it, varied by it and told by it: `--set` looks in the file
as it is written, `--vary` and `--sensitivity` in the case as it is read, and they know one number by the
same names."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

import icsolve
from icsolve.case import Case, Number
from icsolve.errors import CaseError
from icsolve.sweep.varied_numbers import find_number, numbers_of
from library import FILES, sample

BLACK_BOX = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0], E: [1, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {centre: [2, 7], at: [1.06, 0]}
  - {pin: [1, 7], at: B}
loads:
  P: {force: 10, link: 7, at: E, angle: 200}
  Q: {force: {like: P, times: 2}, link: 2, at: E, angle: 90}
  T: {torque: unknown, link: 2}
"""
TWICE = """\
icsolve: 1
points: {A: [0, 0], B: [1, 0], O: [4, 0], Q: [14, 0], G: [0.5, 0.5], P: [0, 4], F: [-1, 0]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.1}
  - {contact: [1, 2], at: A, normal: 0, mu: 0.2}
  - {contact: [1, 2], at: B, normal: 90}
  - {pin: [1, 3], at: O}
  - {pin: [1, 4], at: Q}
  - {belt: [3, 4], radii: [3, 5]}
  - {belt: [3, 4], radii: [1.5, 2.5]}
  - {rope: [A, P, F], on: [2, 1, 1], radii: {P: 0.3}, wraps: {P: cw}}
  - {rope: [A, P, F], on: [2, 1, 1], radii: {P: 0.2}, wraps: {P: cw}}
loads:
  W: {weight: 100, link: 2, at: G}
"""
"""Two joints of one pair at one point, two of one pair without a point, two ropes through the same points."""
MADE = {"a known centre and a load like another": BLACK_BOX, "two of one name": TWICE}


def spellings(path: str) -> Iterator[str]:
    """A path and others that may mean the same."""
    yield path
    section, _, rest = path.partition(".")
    if section in ("lengths", "angles"):
        points = rest.split("-") if "-" in rest else list(rest)
        yield from (f"{section}.{'-'.join(way)}" for way in (points, points[::-1]))
    if section == "joints":
        label, _, key = rest.partition(".")
        pair, _, point = label.partition("@")
        turned = "-".join(reversed(pair.split("-")))
        yield from (f"joints.{name}.{key}" for name in (pair, turned, point, f"{turned}@{point}") if name)
        yield f"joints.{rest.replace('.radii', '.radius')}"
        if key.count(".") == 1:  # of a rope by its point
            own, point = key.split(".")
            yield f"joints.{point}.{own}"


def other(number: Number) -> list[str]:
    """Another value, in all units that it may need."""
    whole = number.bound in ("teeth", "turns")
    value = 2.0 * number.value or 1.0 if whole else number.value * (1.0 + 1e-6) or 1e-6
    return [f"{value!r}{unit}" for unit in ("", " kg", " kg*m^2", " W")]


def changed(source: str | Path, case: Case, path: str, values: list[str]) -> set[str] | None:
    """The paths of the numbers that change where one is set; None where it is not."""
    before = {own: repr(number.value) for own, number in numbers_of(case).items()}
    for value in values:
        try:
            after = numbers_of(icsolve.load(source, {path: value}))
        except CaseError as refused:
            if "cannot set" in str(refused):
                return None
            continue
        return {own for own, number in after.items() if repr(number.value) != before.get(own)}
    return None


def varied(case: Case, path: str) -> str | None:
    try:
        return find_number(case, path).path
    except CaseError:
        return None


@pytest.mark.parametrize("name", [*MADE, *sample(FILES, 6, "paths")])
def test_a_number_is_set_by_the_names_by_which_it_is_varied(name: str) -> None:
    source = MADE.get(name) or FILES[name]
    case = icsolve.load(source)
    if case.space is not None:
        return
    for own, number in numbers_of(case).items():
        if math.isnan(number.value) or ("teeth" in own and name.endswith("cardan_gear.yaml")):
            continue
        for path in dict.fromkeys(spellings(own)):
            found, told = varied(case, path), changed(source, case, path, other(number))
            assert (told or set()) == ({found} if found else set()), (path, found, told)
