"""The case library: every published value agrees or is an erratum, and every kind of the format has its case.

Tolerance: half a unit of the last digit that a case gives, as `icsolve check` takes it; cases with a
closed form give ten digits and more.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import pytest

from icsolve import Answer, Case, load
from icsolve.case import (
    Belt,
    Contact,
    Force,
    ForceVector,
    Gears,
    KnownCentre,
    Pin,
    Roll,
    Slide,
    Slot,
    Spring,
    Torque,
    TorsionSpring,
    Weight,
    Weld,
)
from icsolve.case.expected import LoadIs, ReactionIs
from icsolve.report.check import AGREES, DISAGREES, ERRATUM, compare, wanted
from icsolve.solve import solve
from sizes import sampled

LIBRARY = Path(__file__).parent.parent / "cases"
FILES = sorted(LIBRARY.rglob("*.yaml"))
CASES = {path.relative_to(LIBRARY).as_posix(): path for path in FILES}
PUBLISHED = ("ch13/", "books/")
"""Cases with the digits that a book prints."""
CLOSED_FORMS = {
    name: path for name, path in CASES.items() if not name.startswith((*PUBLISHED, "equilibrium/"))
}
"""Those of positions of equilibrium are held by potentials written apart (test_equilibrium.py)."""

MECHANISMS = """
    black_box/given_centres cams/flat_follower cams/roller_follower gears/belt_open gears/epicyclic_train
    gears/gear_pair gears/internal_gear linkages/double_butterfly linkages/five_bar linkages/parallelogram
    linkages/single_flier linkages/stephenson_six_bar linkages/three_links_on_one_pin linkages/watt_six_bar
    linkages/welded_link rolling/rack_and_pinion rolling/rolling_disk sliders/elliptic_trammel
    sliders/inverted_slider_crank sliders/oldham_coupling sliders/quick_return sliders/scotch_yoke
    sliders/slider_crank_in_line sliders/slider_crank_offset sliders/whitworth springs/knee_with_spring
    tools/bolt_cutter tools/scissor_lift tools/toggle_clamp
""".split()


@cache
def read(name: str) -> Case:
    return load(CASES[name])


@cache
def examined(name: str) -> Answer:
    """All that is published of a case, solved for at once."""
    return solve(read(name), examine=True, **wanted(read(name)))


@pytest.fixture(params=CASES)
def name(request: pytest.FixtureRequest) -> str:
    """Each case of the library."""
    return str(request.param)


@pytest.fixture
def case(name: str) -> Case:
    return read(name)


def test_published_values_agree_or_are_errata(name: str) -> None:
    rows = compare(examined(name))
    assert rows
    assert [row for row in rows if row.verdict not in (AGREES, ERRATUM)] == []


def test_every_case_says_what_it_is_and_where_it_comes_from(case: Case) -> None:
    assert case.title and case.source
    loaded = any(isinstance(expected.target, LoadIs | ReactionIs) for expected in case.expect)
    if case.unknowns:  # where it rests is asked
        assert {expected.key for expected in case.expect} >= {one.path for one in case.unknowns}
        return
    assert loaded if case.loads else case.expect  # without loads a case asks for speeds


def test_every_erratum_gives_its_reason(case: Case) -> None:
    reasons = [expected.erratum for expected in case.expect if expected.erratum is not None]
    assert all(len(reason.split()) > 3 for reason in reasons)


@pytest.mark.parametrize("name", CLOSED_FORMS)
def test_closed_forms_are_sharp(name: str) -> None:
    """A closed form binds to 1e-8 of itself: a value of fewer digits would hide an error."""
    for expected in load(CLOSED_FORMS[name]).expect:
        for number in expected.value:
            scale = abs(number.value) or 1.0
            assert expected.within is None
            assert number.half <= 1e-8 * scale, expected.key


@pytest.mark.parametrize("name", CLOSED_FORMS)
def test_a_wrong_value_of_the_same_digits_would_be_noticed(name: str) -> None:
    """The answer turned about by one part in a million disagrees with every expected load."""
    answer = solve(load(CLOSED_FORMS[name]), rates=True, all_centres=True)
    for found in answer.answers:
        value = answer.answers[found]
        answer.answers[found] = value._replace(value=value.value * (1 + 1e-6))
    moved = [row for row in compare(answer) if row.key in answer.answers]
    assert moved
    assert {row.verdict for row in moved} == {DISAGREES}


def test_the_mechanisms_that_a_student_meets_are_there() -> None:
    assert [name for name in MECHANISMS if f"{name}.yaml" not in CASES] == []


def test_every_kind_of_joint_and_load_has_a_case() -> None:
    cases = [load(path) for path in FILES]
    joints = {type(joint) for case in cases for joint in case.joints}
    loads = {type(entry) for case in cases for entry in case.loads}
    assert joints == {Pin, Slide, Slot, Roll, Gears, Belt, Contact, KnownCentre, Weld}
    assert loads == {Force, ForceVector, Torque, Weight, Spring, TorsionSpring}


@sampled(3)
def test_errors_are_bounded_far_below_the_digits(name: str) -> None:
    """Every answer carries a bound of its rounding error, a billionth of it at most; with friction too."""
    for unknown, found in examined(name).answers.items():
        assert found.error is not None, unknown
        assert math.isfinite(found.error)
        assert found.error <= 1e-9 * abs(found.value), unknown
