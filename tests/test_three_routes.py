"""On every case: Kennedy's construction, the loop equations alone, and the joints' null space agree.

The null space is written apart (tests/reference.py), on the points that the figure found. Cases whose
given centres agree only to their five decimals are left to tests/test_ch13.py. Cams by their profiles are
taken with the contacts where the profiles put them.
"""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest

import icsolve
import reference
import witness
from icsolve.cams.solving import placed
from icsolve.case import Case, KnownCentre
from icsolve.scene.program import Want, evaluate, prepare

FILES = sorted((Path(__file__).parent.parent / "cases").rglob("*.yaml"))
AGREE = 1e-9
"""Of the figure's size, or of the answer: what a figure from five decimals leaves of sixteen digits."""


def planar(path: Path) -> Case | None:
    case = placed(icsolve.load(path))
    rubs = any(getattr(joint, "friction", None) is not None for joint in case.joints)
    given = any(isinstance(joint, KnownCentre) for joint in case.joints)
    apart = case.unknowns or case.ropes or case.screws or case.dynamic  # these have laws of their own
    return None if rubs or given or apart or not case.joints else case


CASES = {path.stem: case for path in FILES if (case := planar(path)) is not None}


def found_points(case: Case) -> dict[str, tuple[float, float]]:
    """All points of the figure, those of loads by coordinates among them."""
    program = prepare(case, Want(True, True, True))
    frame = program.figure.frame
    return {
        p: (x / frame.scale + frame.ox, y / frame.scale + frame.oy)
        for p, (x, y) in program.figure.points.items()
    }


@pytest.mark.parametrize("name", CASES)
def test_every_centre_of_the_case(name: str) -> None:
    case = CASES[name]
    answer = icsolve.solve(case, all_centres=True, examine=True)
    found = reference.motions(case, found_points(case))
    if case.motion and len(found.basis) > 1:
        return  # the reference takes all motions, the answer the ones that are given
    centres = {frozenset(pair): centre for pair, centre in answer.centres.items()}
    for pair in combinations(case.links, 2):
        theirs, mine = witness.centre(found, *pair), centres[frozenset(pair)]
        if isinstance(theirs, str):
            assert mine.kind == theirs, pair
            continue
        place = mine.place if mine.kind == "at" else mine.place[0]
        shown = witness.homogeneous(found.frame, {mine.kind: place})
        assert witness.sine(theirs, shown) < AGREE, (pair, mine)


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case.loads])
def test_the_loads_by_the_plan_by_the_loop_equations_and_by_the_null_space(name: str) -> None:
    case = CASES[name]
    program = prepare(case, Want(True, True, True))
    _, by_plan = evaluate(program)
    _, by_loops = evaluate(program._replace(plan=None))
    null_space = witness.answers(reference.motions(case, found_points(case)))
    for load, value in by_plan.solution.values.items():
        assert by_loops.solution.values[load] == pytest.approx(value, rel=AGREE)
        assert null_space[load] == pytest.approx(value, rel=AGREE)
