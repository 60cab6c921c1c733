"""Reactions at the joints, against a dense equilibrium of all links that knows nothing of the solver.

Tolerance 1e-9 of the largest force in the mechanism, as the format promises. `ICSOLVE_FULL=1` draws twenty
times as many mechanisms.
"""

from __future__ import annotations

from collections.abc import Iterable
from random import Random
from typing import Any

import numpy as np
import pytest

import equilibrium
import icsolve
import mechanisms
import transcribe
from growth import random_mechanism
from icsolve import case as c
from icsolve.answer import Answer
from loading import drawn
from reference import frame_of, points_of
from sizes import FULL, MORE, sampled
from transcribe import Scene

LAW = 1e-9
Three = tuple[float | None, float | None, float | None]


def solved(scene: Scene) -> Answer:
    """The solver's answer with reactions."""
    return icsolve.solve(icsolve.load(transcribe.text(scene)), reactions=True)


def told(scene: Scene) -> str:
    return "\n" + transcribe.text(scene)


# --- the dense equilibrium -------------------------------------------------------------------------


class Dense:
    """Least-squares solution of the equilibrium of all links, and what it leaves open."""

    def __init__(self, case: c.Case, places: dict[str, Any]) -> None:
        self.case, self.frame = case, frame_of(case, places)
        self.places = places
        a, b, _ = equilibrium.equations(case, places)
        self.x = np.linalg.lstsq(a, b, rcond=1e-11)[0]
        assert np.allclose(a @ self.x, b, atol=1e-9 * max(np.abs(b).max(), np.abs(self.x).max()))
        _, s, vt = np.linalg.svd(a)
        self.idle = vt[int(np.sum(s > 1e-11 * s[0])) :]

    def force(self, by: str, on: str, at: tuple[float, float], kind: str, nth: int) -> Three:
        """Force and couple about a point of the nth joint of two links; None where it is left open."""
        column, units = self.columns(by, on, kind, nth)
        px, py = self.frame.place(at, float)
        found: list[float | None] = []
        for part in range(3):
            row = np.zeros(len(self.x))
            for k, (x, y, m) in enumerate(units):
                row[column + k] = (x, y, (m - px * y + py * x) * self.frame.size)[part]
            size = np.abs(row).max(initial=1e-6)  # the couple of a force about its own point is rounding
            open_ = np.abs(self.idle @ row).max(initial=0.0) > 1e-8 * size
            found.append(None if open_ else float(row @ self.x))
        return found[0], found[1], found[2]

    def columns(self, by: str, on: str, kind: str, nth: int) -> tuple[int, list[Any]]:
        column = 0
        for joint in self.case.joints:
            wrenches = equilibrium.transmitted(self.case, joint, self.places, self.frame)
            same = type(joint).__name__.lower() == {"centre": "knowncentre"}.get(kind, kind)
            mine = [(n, w) for n, (i, j, w) in enumerate(wrenches) if same and {i, j} == {by, on}]
            if mine:
                if nth == 0:
                    sign = 1.0 if wrenches[mine[0][0]][0] == by else -1.0
                    return column + mine[0][0], [tuple(sign * v for v in w) for _, w in mine]
                nth -= 1
            column += len(wrenches)
        raise KeyError((by, on, kind))


def check_reactions(scene: Scene, answer: Answer) -> None:
    """Every reaction that is determined is the dense one; one left open is open there too."""
    case = transcribe.case(scene)
    dense = Dense(case, points_of(case))
    assert answer.reactions is not None
    seen: dict[Any, int] = {}
    size, arm = float(np.abs(dense.x).max()), dense.frame.size
    for r in answer.reactions.values():
        key = (frozenset((r.by, r.on)), r.kind)
        theirs = dense.force(r.by, r.on, r.at, r.kind, seen.get(key, 0))
        seen[key] = seen.get(key, 0) + 1
        for mine, their, scale in zip((r.x, r.y, r.moment), theirs, (size, size, size * arm), strict=True):
            if mine is not None:
                assert their is not None, f"{r}" + told(scene)
                assert mine == pytest.approx(their, rel=LAW, abs=LAW * scale), f"{r}" + told(scene)
            elif not any(isinstance(j, c.Gears | c.Belt) for j in case.joints):
                assert their is None, f"{r}" + told(scene)


def check_witnesses(answer: Answer, scene: Scene) -> None:
    """Power and free bodies agree within their bound, which is rounding, and to 1e-9 of the largest term."""
    largest = max(abs(term.power) for term in answer.terms)
    for w in answer.witnesses:
        term = next(term for term in answer.terms if term.load == w.load)
        assert abs(w.difference) <= w.bound, f"{w}" + told(scene)
        assert abs(w.difference * term.factor) <= LAW * largest, f"{w}" + told(scene)
        assert w.bound * abs(term.factor) <= LAW * largest, f"{w}" + told(scene)


def random_scenes(first: int, number: int) -> Iterable[Scene]:
    return (random_mechanism(Random(seed)) for seed in range(first, first + number * MORE))


@sampled(2)
@pytest.mark.parametrize("generator", mechanisms.ALL, ids=lambda g: g.__name__)
def test_reactions_of_every_kind_are_those_of_a_dense_equilibrium(generator: mechanisms.Generator) -> None:
    for seed in range(MORE):
        scene = drawn(seed, generator)
        answer = solved(scene)
        check_reactions(scene, answer)
        check_witnesses(answer, scene)


def test_random_mechanisms_of_all_joint_kinds() -> None:
    for scene in random_scenes(7000, 150 if FULL else 20):
        answer = solved(scene)
        check_reactions(scene, answer)
        check_witnesses(answer, scene)


@pytest.mark.parametrize("push", [0, 90, 180, 270])
def test_a_reaction_along_an_axis_has_its_directions_within_a_turn(push: int) -> None:
    """A block that is pressed to its guide: the guide pushes back, and is pushed along."""
    found = icsolve.solve(
        icsolve.load(
            f"icsolve: 1\npoints: {{A: [0, 0]}}\njoints: [{{slide: [2, 1], at: A, along: {push + 90}}}]\n"
            f"loads: {{P: {{force: 10, link: 2, at: A, angle: {push}}}, "
            f"U: {{force: unknown, link: 2, at: A, angle: {push + 90}}}}}\n"
        ),
        reactions=True,
    )
    assert found.reactions is not None
    force = found.reactions["F12"]
    assert (force.magnitude, force.direction, force.opposite) == (10.0, (push + 180) % 360, push)
