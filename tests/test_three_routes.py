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
import mechanisms
import reference
import transcribe
import witness
from icsolve.cams.solving import placed
from icsolve.case import Case, KnownCentre
from icsolve.scene.program import Want, evaluate, prepare
from loading import drawn
from sizes import sampled

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


@sampled(3)
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


@sampled(3)
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


@pytest.mark.parametrize(
    "generator",
    [mechanisms.four_bar, mechanisms.slider_crank, mechanisms.inverted_slider_crank, mechanisms.trammel],
)
def test_in_a_loop_of_four_links_kennedy_joins_the_centres_of_the_joints(
    generator: mechanisms.Generator,
) -> None:
    """I13 on I12-I23 and I14-I34, I24 on I12-I14 and I23-I34: no line is left to the loop equations."""
    for seed in range(8):
        case = icsolve.load(transcribe.text(drawn(seed, generator)))
        answer = icsolve.solve(case, all_centres=True)
        joined = {frozenset(joint.links) for joint in case.joints}
        for pair, centre in answer.centres.items():
            if frozenset(pair) in joined:
                assert centre.by == "inspection"
                continue
            assert centre.by == "construction", centre
            others = set(case.links) - {*pair}
            lines = {frozenset(map(frozenset, line)) for line in centre.lines}
            assert lines == {frozenset(frozenset((end, k)) for end in pair) for k in others}


def test_a_centre_may_be_far_from_the_others_and_still_be_constructed() -> None:
    """The crank is nearly parallel to the guide's normal: I13 lies four thousand lengths off."""
    text = """
icsolve: 1
points: {A: [0, 0], B: [0.001, 1], C: [4, 1]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads: {T: {torque: unknown, link: 2}, P: {force: 5, link: 4, at: C, angle: 0}}
"""
    centre = icsolve.solve(icsolve.load(text), all_centres=True).centres["1", "3"]
    assert (centre.by, centre.kind) == ("construction", "at")
    assert centre.place == pytest.approx((4.0, 4000.0), rel=1e-12)
