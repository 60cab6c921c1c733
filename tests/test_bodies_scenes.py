"""Reactions scene by scene: structures, redundant joints, welds, names, contacts that part, black boxes."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import icsolve
import mechanisms
from equilibrium import push
from icsolve.answer import Answer
from icsolve.answer.bodies import Reaction
from icsolve.errors import SceneError
from icsolve.report import answer_text
from icsolve.solve import attempt
from sizes import FULL


def solved(text: str, **options: Any) -> Answer:
    return icsolve.solve(icsolve.load("icsolve: 1\n" + text), reactions=True, **options)


def force(answer: Answer, name: str) -> Reaction:
    assert answer.reactions is not None
    return answer.reactions[name]


def parts(answer: Answer, name: str) -> tuple[float | None, float | None, float | None]:
    found = force(answer, name)
    return found.x, found.y, found.moment


def exactly(number: float) -> Any:
    return pytest.approx(number, rel=1e-12, abs=1e-12)


def near(*numbers: float) -> tuple[Any, ...]:
    return tuple(map(exactly, numbers))


# --- structures ------------------------------------------------------------------------------------

BRACKET = """
points: {A: [0, 0], B: [3, 0], C: [0, 3]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [1, 3], at: C}
loads:
  W: {weight: 10, link: 2, at: B}
"""


def test_structure_is_statics_alone() -> None:
    """A wall bracket: the strut pushes, the tie pulls with W sqrt 2."""
    answer = solved(BRACKET)
    assert (answer.status, answer.mobility, answer.answers) == ("ok", 0, {})
    assert parts(answer, "F12") == near(10, 0, 0)
    assert parts(answer, "F23") == near(10, -10, 0)
    assert force(answer, "F13").magnitude == exactly(10 * 2**0.5)
    assert "structure" in answer.notes[-1]


def test_a_structure_whose_loads_are_known_is_solved_without_being_asked_for_reactions() -> None:
    asked = solved(BRACKET).to_dict()
    assert icsolve.solve(icsolve.load("icsolve: 1\n" + BRACKET)).to_dict() == asked
    assert {"F12", "F13", "F23"} == asked["reactions"].keys()


TRUSS = """
icsolve: 1
points: {A: [0, 0], B: [4, 0], C: [2, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: A}
  - {pin: [2, 4], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [1, 2], at: B, along: 0}
loads: {P: {force: 100, link: 3, at: C, angle: -90}}
"""


@pytest.mark.parametrize("joint", re.findall("  - .*\n", TRUSS))
def test_a_joint_left_out_of_a_truss_is_said_whether_its_loads_balance_or_not(joint: str) -> None:
    """Without its pin at A the truss slides, and its loads do no work; the others let it fall."""
    answer = icsolve.solve(icsolve.load(TRUSS.replace(joint, "")))
    assert answer.mobility and "a joint is missing" in answer.notes[-1]
    assert ("do not balance" in answer.notes[-1]) is ("[1, 2], at: A" not in joint)


TURNED = """icsolve: 1
points: {{A: {a}, B: {b}, C: {c}}}
links: {{1: [A, B]}}
joints:
  - {{slide: [2, 1], at: A, along: {along}}}
  - {{pin: [2, 3], at: A}}
  - {{pin: [2, 4], at: B}}
  - {{pin: [3, 4], at: C}}
loads: {{P: {{{load}, link: 3, at: C}}}}
"""


def turned_truss(degrees: float, slip: float, kind: str) -> str:
    """A truss that may slide along its lower chord, and a load across that, as a program writes them, each
    number the double next to it, none of one decimal: the whole turned by an angle, the load by ``slip``
    more."""
    with mp.workdps(40):
        turned = mpf(degrees) - 90 + mpf(slip)
        along, across = (mp.expjpi(angle / 180) for angle in (mpf(degrees), turned))
        places = [mp.mpc(mp.e, mp.euler) + mp.mpc(*at) * along for at in ((0, 0), (4, 0), (2, 2))]
        a, b, c, components = ([float(p.real), float(p.imag)] for p in (*places, across))
    load = {
        "components": f"force: {components}",
        "slope": f"force: 100, slope: {components}",
        "angle": f"force: 100, angle: {float(turned)!r}",
    }[kind]
    return TURNED.format(a=a, b=b, c=c, along="[A, B]", load=load)


@pytest.mark.parametrize("kind", ["components", "slope", "angle"])
def test_loads_that_a_program_wrote_balance_to_their_last_digits(kind: str) -> None:
    """What a turned truss is left with is 1e-16 of its load, which the last digits of its numbers explain:
    every command tells its reactions, and says so. A millionth of a degree more is no matter of digits."""
    dice = Random(kind)
    for _ in range(30 if FULL else 8):
        degrees = dice.uniform(0.0, 180.0)
        case = icsolve.load(turned_truss(degrees, 0.0, kind))
        answer, shown = icsolve.solve(case, reactions=True), attempt(case, reactions=True).answer
        assert shown is not None and shown.reactions is not None and answer.reactions is not None
        for key, one in answer.reactions.items():
            assert shown.reactions[key].magnitude == pytest.approx(one.magnitude, rel=1e-12)
        for told in (answer, shown, icsolve.solve(case)):
            assert not any("do not balance" in note for note in told.notes)
            assert any("half a unit" in note for note in told.notes) or answer.notes == told.notes
        off = icsolve.load(turned_truss(degrees, 1e-6, kind))
        assert any("do not balance" in note for note in icsolve.solve(off).notes)
        with pytest.raises(SceneError) as refused:
            icsolve.solve(off, reactions=True)
        assert refused.value.status == "unbalanced"


def test_what_loads_leave_is_a_force_along_the_motion_of_the_first_link() -> None:
    """A wedge of 30 degrees under a block: on the block it is cot 30 times what is left on the wedge."""
    guides = ["  - {slide: [2, 1], at: A, along: 0}", "  - {slot: [3, 1], at: B, along: 90}"]
    tangent = 3**-0.5
    for order, left in ((guides, 4 + 10 * tangent), (guides[::-1], 10 + 4 / tangent)):
        joints = "\n".join([*order, "  - {slide: [3, 2], at: B, along: 30}"])
        with pytest.raises(SceneError, match=f"leave {left:.6g} N at ") as refused:
            solved(f"""
points: {{A: [0, 0], B: [1, 0.5]}}
joints:
{joints}
loads: {{W: {{force: 10, link: 3, at: B, angle: -90}}, P: {{force: 4, link: 2, at: A, angle: 0}}}}
""")
        assert refused.value.status == "unbalanced"


def test_an_unknown_load_on_a_structure_and_one_that_nearly_moves_are_refused() -> None:
    unknown = BRACKET.replace("weight: 10", "weight: unknown")
    nearly = BRACKET.replace("C: [0, 3]", "C: [0, 0.000000001]")
    for text, status, said in ((unknown, "structure", "Nothing moves"), (nearly, "near-singular", "moving")):
        with pytest.raises(icsolve.SceneError, match=said) as caught:
            icsolve.solve(icsolve.load("icsolve: 1\n" + text))
        assert caught.value.status == status


WELDED = """
points: {A: [0, 0], C: [2, 4], D: [3, 3]}
joints: [{pin: [1, 2], at: A}, {weld: [2, 3], at: C}, %s]
loads: {T: {torque: unknown, link: 2}, P: {force: 5, link: 3, at: C, angle: 0}}
"""


@pytest.mark.parametrize(
    "joint",
    [
        "{gears: [2, 3], teeth: [41, 41]}",
        "{gears: [2, 3], teeth: [41, 41], pressure angle: 20}",
        "{belt: [2, 3], radii: [1, 2]}",
        "{pin: [2, 3], at: D}",
        "{slide: [2, 3], at: D, along: 0}",
        "{slot: [2, 3], at: D, along: 0}",
        "{contact: [2, 3], at: D, normal: 0}",
        "{roll: [2, 3], at: D}",
        "{centre: [2, 3], at: [1, 1]}",
        "{centre: [2, 3], toward: 30}",
        "{weld: [2, 3], at: D}",
    ],
)
def test_a_joint_of_links_that_are_fixed_to_each_other_carries_what_the_fit_makes_of_it(joint: str) -> None:
    answer = solved(WELDED % joint)
    assert answer.answers["T"].value == exactly(20)
    assert parts(answer, "F12") == near(-5, 0, 0)
    assert answer.reactions is not None
    inner = [r for r in answer.reactions.values() if {r.by, r.on} == {"2", "3"}]
    assert len(inner) == 2
    assert all(None in (r.x, r.y, r.moment) and r.why for r in inner)
    assert "redundant" in answer.notes[-1] or "fit" in answer.notes[-1] or "given centre" in answer.notes[-1]
    json.dumps(answer.to_dict(), allow_nan=False)


@pytest.mark.parametrize("third", ["at", "toward"])
@pytest.mark.parametrize("seed", range(6))
def test_free_bodies_agree_with_power_where_given_centres_miss_each_other_by_their_last_digits(
    third: str, seed: int
) -> None:
    """What a joint passes goes by the centre that the motion has."""
    rng = Random(seed)
    start, line = mechanisms.spot(rng), mechanisms.heading(rng)
    a, b, c = (mechanisms.polar(start, s, line) for s in (0.0, rng.uniform(1, 3), rng.uniform(4, 6)))
    if third == "at":
        last = f"at: [{c[0]:.4f}, {c[1]:.4f}]"
    else:
        last = f"toward: {line + 0.004:.3f}"
    answer = solved(f"""
joints:
  - {{centre: [1, 2], at: [{a[0]:.4f}, {a[1]:.4f}]}}
  - {{centre: [2, 3], at: [{b[0]:.4f}, {b[1]:.4f}]}}
  - {{centre: [1, 3], {last}}}
loads:
  U: {{torque: unknown, link: 2}}
  K: {{force: 10, link: 3, at: [{start[0] + 1:.3f}, {start[1]:.3f}], angle: {rng.uniform(0, 360):.2f}}}
""")
    assert any("agree with each other to" in note for note in answer.notes)
    (one,) = answer.witnesses
    assert one.bodies == pytest.approx(one.power, rel=1e-10)


def test_nothing_determines_an_unknown_load_of_a_structure() -> None:
    with pytest.raises(icsolve.SceneError, match="Any value of the unknown load is carried") as caught:
        solved(BRACKET.replace("weight: 10", "weight: unknown"))
    assert caught.value.status == "structure"


def test_a_frame_with_a_pulled_rope() -> None:
    """Hibbeler's way: two members on two supports, four equations for each pin, solved here by hand."""
    answer = solved("""
points: {A: [0, 0], B: [2, 3], C: [4, 0], D: [1, 1.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [1, 3], at: C}
loads:
  P: {force: [6, 0], link: 2, at: D}
""")
    # about A of both: 4 Cy = -6 1.5 ... ; about B of member 3: its force lies along CB
    assert parts(answer, "F13") == near(-1.5, 2.25, 0)
    assert parts(answer, "F12") == near(-4.5, -2.25, 0)


def test_redundant_joints_leave_open_only_what_they_share() -> None:
    answer = solved("""
points: {A: [0, 0], B: [3, 0], C: [1, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 2], at: B}
loads:
  W: {weight: 9, link: 2, at: C}
""")
    assert parts(answer, "F1-2@A") == (None, exactly(6), exactly(0))
    assert parts(answer, "F1-2@B") == (None, exactly(3), exactly(0))
    assert "F1-2@A and F1-2@B along x." in answer.notes[-1]
    shown = answer.to_dict()["reactions"]["F1-2@A"]
    assert (shown["x"], shown["magnitude"]) == (None, None)
    assert "equilibrium alone" in shown["undetermined"]
    json.dumps(answer.to_dict(), allow_nan=False)


def test_wedge_has_unique_forces_and_open_couples() -> None:
    answer = solved("""
points: {A: [0, 0], C: [2, 1], B: [2, 3]}
joints:
  - {slide: [2, 1], at: A, along: 0}
  - {slide: [3, 2], at: C, along: 165}
  - {slide: [3, 1], at: B, along: 90}
loads:
  W: {force: 100, link: 3, at: B, angle: 270}
  P: {force: unknown, link: 2, at: A, angle: 0}
""")
    assert force(answer, "F12").y == exactly(100)
    assert [force(answer, n).moment for n in ("F12", "F23", "F13")] == [None] * 3
    assert "the couples of F12, F23 and F13" in answer.notes[-1]


# --- welds, several links on a pin, names ----------------------------------------------------------


@pytest.mark.parametrize(("given", "taken"), [("5.015", True), ("5.035", False)])
def test_half_a_unit_of_a_load_counts_as_often_as_the_load_does(given: str, taken: bool) -> None:
    """P to two decimals, and Q four times P: 0.025 in all, and 0.0005 of R."""
    text = """
points: {A: [0, 0], B: [1, 0]}
joints: [{pin: [1, 2], at: A}]
loads:
  P: {force: 1.00, link: 2, at: B, angle: 90}
  Q: {force: {like: P, times: 4}, link: 2, at: B, angle: 90}
  R: {force: %s, link: 2, at: B, angle: -90}
"""
    if taken:
        assert any("within half a unit of the last decimals" in note for note in solved(text % given).notes)
        return
    with pytest.raises(SceneError, match="the known loads do not balance"):
        solved(text % given)


GROOVE = """
points: {{O: [0, 0], A: [{a}], B: [{b}], G: [{g}, 0]}}
joints:
  - {{contact: [1, 2], at: A, normal: {left}}}
  - {{contact: [1, 2], at: B, normal: {right}}}
loads: {{W: {{weight: 40, link: 2, at: G}}}}
"""


def test_decimals_of_a_figure_count_as_those_of_its_loads_where_known_loads_balance() -> None:
    """A smooth ball in a groove, the places where it touches written to three decimals: its weight leaves
    what these were rounded by, which notes say with one voice; the reactions are those of the exact figure.
    Beside the middle by a hundredth of the radius it does not balance."""
    dice = Random(7)
    for _ in range(20):
        radius, left, right = dice.uniform(1.0, 3.0), dice.randint(10, 80), dice.randint(100, 170)
        a, b = (
            ", ".join(f"{-radius * part(math.radians(normal)):.3f}" for part in (math.cos, math.sin))
            for normal in (left, right)
        )
        text = GROOVE.format(a=a, b=b, g=0, left=left, right=right)
        answer = solved(text)
        whole = 40.0 / math.sin(math.radians(right - left))
        for name, other in (("F1-2@A", right), ("F1-2@B", left)):
            pushed = whole * abs(math.cos(math.radians(other)))
            assert force(answer, name).magnitude == pytest.approx(pushed, rel=3e-3, abs=3e-3 * whole)
        for one in (answer, icsolve.solve(icsolve.load(f"icsolve: 1{text}"))):
            assert any("half a unit of the last decimals" in note for note in one.notes)
            assert not any("do not balance" in note or "joint is missing" in note for note in one.notes)
            assert "not in equilibrium" not in answer_text(one)
        beside = GROOVE.format(a=a, b=b, g=f"{0.01 * radius:.3f}", left=left, right=right)
        off = icsolve.load(f"icsolve: 1{beside}")
        assert any("do not balance" in note for note in icsolve.solve(off).notes)
        with pytest.raises(SceneError, match="the known loads do not balance"):
            icsolve.solve(off, reactions=True)


def test_a_wheel_that_idles_is_not_for_want_of_a_joint() -> None:
    """A frame whose pulley a rope without friction does not turn: only that it turns by itself is said."""
    answer = solved(IDLING)
    assert parts(answer, "F12") == near(0.0, 20.0, 80.0)
    (note,) = (note for note in answer.notes if "no load is `unknown`" in note)
    assert "Link 3 can turn by itself." in note and "joint" not in note


IDLING = """
points: {A: [0, 0], C: [4, 0], W: [4.5, -3], E: [3.5, -3]}
joints:
  - {weld: [1, 2], at: A}
  - {pin: [2, 3], at: C}
  - {rope: [E, C, W], on: [1, 3], radii: {C: 0.5}, wraps: {C: cw}}
loads:
  W: {weight: 10, at: W}
"""


def test_weld_carries_a_couple_about_the_point_that_is_said() -> None:
    text = """
points: {A: [0, 0], B: [2, 0], C: [5, 0]}
joints:
  - {weld: [1, 2], at: A}
  - {weld: [2, 3]%s}
loads:
  W: {weight: 10, link: 3, at: C}
  M: {torque: 7, link: 3}
"""
    answer = solved(text % ", at: B")
    assert parts(answer, "F12") == near(0, 10, 50 - 7)
    assert parts(answer, "F23") == near(0, 10, 30 - 7)
    somewhere = solved(text % "")
    found = force(somewhere, "F23")
    assert found.where in {"A", "C"}
    assert found.moment == exactly((5 - found.at[0]) * 10 - 7)


def test_pin_of_several_links_is_carried_by_the_first_named() -> None:
    answer = solved("""
points: {A: [0, 0], B: [4, 0], C: [2, 3], E: [2, 5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {pin: [2, 3, 4], at: C}
  - {slot: [4, 1], at: E, along: 90}
loads:
  W: {weight: 12, link: 4, at: C}
""")
    assert set(answer.reactions or ()) == {"F12", "F13", "F23", "F24", "F14"}
    assert parts(answer, "F24") == near(0, 12, 0)
    assert parts(answer, "F23") == near(4, -6, 0)
    assert parts(answer, "F13") == near(-4, 6, 0)


def test_names_of_forces_take_either_order() -> None:
    answer = solved(BRACKET)
    assert force(answer, "F32") == force(answer, "F23").reversed()
    assert force(answer, "F3-2") == force(answer, "F32")
    with pytest.raises(KeyError):
        force(answer, "F45")
    words = (
        BRACKET.replace("[1, 2]", "[1, strut]").replace("[2, 3]", "[14, strut]").replace("[1, 3]", "[1, 14]")
    )
    assert set(solved(words.replace("link: 2", "link: strut")).reactions or ()) == {
        "F1-strut",
        "F14-strut",
        "F1-14",
    }


# --- mechanisms ------------------------------------------------------------------------------------

WATT = """
points:
  {A: [0, 0], B: [0.5, 1.5], C: [3, 2.5], D: [4, 0], E: [3.5, 3.5], F: [6, 3], G: [6.5, 0],
   S: [2, 2], T: [5, 4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [1, 4], at: D}
  - {pin: [4, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [1, 6], at: G}
loads:
  W2: {weight: 3, link: 2, at: B}
  W3: {weight: 8, link: 3, at: S}
  W4: {weight: 6, link: 4, at: E}
  W5: {weight: 5, link: 5, at: T}
  W6: {weight: 4, link: 6, at: F}
  T: {torque: unknown, link: 2}
"""
STEPHENSON = WATT.replace("{pin: [4, 5], at: E}", "{pin: [3, 5], at: E}").replace(
    "link: 4, at: E", "link: 4, at: C"
)


@pytest.mark.parametrize("text", [WATT, STEPHENSON], ids=["Watt", "Stephenson"])
def test_six_bars_under_gravity_against_a_dense_system(text: str) -> None:
    """Fifteen equations written out joint by joint, solved by numpy; every reaction to 1e-9."""
    case = icsolve.load("icsolve: 1\n" + text)
    at = {name: (p.x.value, p.y.value) for name, p in case.points.items()}  # type: ignore[union-attr]
    pins = [(int(j.links[0]), int(j.links[1]), at[j.at]) for j in case.joints]  # type: ignore[union-attr,arg-type]
    a, b = np.zeros((15, 15)), np.zeros(15)
    for k, (i, j, p) in enumerate(pins):
        for side, direction in enumerate(((1.0, 0.0), (0.0, 1.0))):
            for link, sign in ((i, -1.0), (j, 1.0)):
                if link != 1:
                    a[3 * link - 6 : 3 * link - 3, 2 * k + side] += sign * np.array(push(p, direction))
    a[2, 14] = 1.0
    for load in case.loads[:-1]:
        row = 3 * int(load.link) - 6
        b[row : row + 3] -= np.array(push(at[load.at], (0.0, -load.value.value)))  # type: ignore[union-attr]
    x = np.linalg.solve(a, b)
    answer = icsolve.solve(case, reactions=True)
    assert answer.answers["T"].value == pytest.approx(x[14], rel=1e-9)
    for k, (i, j, _) in enumerate(pins):
        found = force(answer, f"F{i}{j}")
        assert (found.x, found.y) == (
            pytest.approx(x[2 * k], rel=1e-9),
            pytest.approx(x[2 * k + 1], rel=1e-9),
        )


def test_known_loads_that_balance_have_reactions() -> None:
    text = """
points: {O: [0, 0], A: [-2, 0], B: [3, 0]}
joints:
  - {pin: [1, 2], at: O}
loads:
  W: {weight: 30, link: 2, at: A}
  V: {weight: %s, link: 2, at: B}
"""
    assert parts(solved(text % 20), "F12") == near(0, 50, 0)
    with pytest.raises(icsolve.SceneError, match="W and V leave 3 N\\*m cw on link 2") as caught:
        solved(text % 21)
    assert caught.value.status == "unbalanced"
    assert parts(solved(text.replace("30", "30.0") % "20.0"), "F12") == near(0, 50, 0)


def test_what_the_decimals_of_known_loads_leave_open_is_said() -> None:
    text = """
points: {O: [0, 0], A: [-2, 0], B: [4, 0]}
joints:
  - {pin: [1, 2], at: O}
loads:
  W: {weight: 21, link: 2, at: A}
  V: {weight: %s, link: 2, at: B}
"""
    answer = solved(text % 10)  # half a unit of both may make 3 N*m
    assert parts(answer, "F12") == near(0, 31, 0)
    said = "W and V leave 2 N*m ccw on link 2, which is within half a unit"
    assert any(said in note for note in answer.notes)
    assert not any("leave" in note for note in solved(text % 10.5).notes)


def test_what_known_loads_leave_on_a_block_is_a_force_along_its_guide() -> None:
    text = """
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 30}
loads:
  W: {weight: 100, link: 2, at: A}
"""
    with pytest.raises(icsolve.SceneError, match="W leaves 50 N at 210 deg on link 2"):
        solved(text)


def test_a_structure_with_an_unknown_load_is_refused_as_one_and_says_what_carries_it() -> None:
    text = """
points: {A: [0, 0], B: [2, 0]}
joints:
  - {pin: [2, 1], at: A}
  - {pin: [2, 1], at: B}
loads:
  P: {force: unknown, link: 2, at: B, angle: 90}
"""
    with pytest.raises(
        icsolve.SceneError, match=r"^the links form a structure: .* Any value of the unknown load"
    ):
        solved(text)


def test_loads_balance_to_the_digits_in_which_they_are_given() -> None:
    """T = 29.672 in print for 29.67219 (problem 13.8)."""
    text = """
points: {A: [0, 0], B: [-.30782, .84572], C: [2.2, 2.60424], D: [2.9444, 0], E: [3.4489, .87382]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [1, 4], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 0}
  T12: {torque: %s, link: 2}
"""
    known, found = solved(text % 29.672), solved(text % "unknown")
    for name in ("F12", "F23", "F34", "F14"):
        assert parts(known, name)[0] == pytest.approx(parts(found, name)[0], rel=1e-4)
    with pytest.raises(icsolve.SceneError):
        solved(text % 30.2)


CAM = """
points: {A: [0, 0], K: [1, 2], C: [5, 2.5], H: [3, 2.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: C}
  - {contact: [2, 3], at: K, normal: 80}
loads:
  F: {force: 10, link: 3, at: H, angle: %s}
  T: {torque: unknown, link: 2}
"""


def test_contact_that_would_have_to_pull_is_said_to_be_lost() -> None:
    pressed, pulled = solved(CAM % 270), solved(CAM % 90)
    assert dict(force(pressed, "F23").parts)["normal"] > 0.0
    assert not any("lost" in note for note in pressed.notes)
    assert any("contact of links 2 and 3 at K is lost" in note for note in pulled.notes)
    assert any("K is lost" in note for note in icsolve.solve(icsolve.load("icsolve: 1\n" + CAM % 90)).notes)


def test_pressure_angle_of_a_cam() -> None:
    """The normal at 80 degrees; K on the follower moves square to CK, at 90 + atan(0.5 / 4) degrees."""
    angle = dict(force(solved(CAM % 270), "F23").parts)["pressure angle"]
    assert angle == exactly(10 + float(np.degrees(np.arctan(0.125))))
    assert solved(CAM % 270).to_dict()["reactions"]["F23"]["pressure_angle"] == angle


def test_belt_leaves_its_pull_open() -> None:
    answer = solved("""
points: {A: [0, 0], B: [10, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {belt: [2, 3], radii: [2, 2]}
loads:
  T2: {torque: 10, link: 2}
  T3: {torque: unknown, link: 3}
""")
    assert "slack strand" in force(answer, "F23").why
    assert answer.answers["T3"].value == exactly(-10)
    assert any("initial tension" in note for note in answer.notes)


def test_net_pull_of_a_belt_between_pivots_on_any_line() -> None:
    """What the strands pull apart from each other is the torque over the radius: 10 / 2, and 15 / 3."""
    answer = solved("""
points: {A: [1, 2], B: [7, 10]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {belt: [2, 3], radii: [2, 3], crossed: yes}
loads:
  T2: {torque: 10, link: 2}
  T3: {torque: unknown, link: 3}
""")
    assert answer.answers["T3"].value == exactly(15)
    assert dict(force(answer, "F23").parts)["net pull"] == exactly(5)
    assert answer.to_dict()["reactions"]["F23"]["net_pull"] == exactly(5)


def test_forces_far_from_the_origin_and_in_a_long_chain_lose_nothing() -> None:
    """Fifty four-bars in series: the last bearing as in one by itself, with the torque that reaches it."""
    loops = 50
    points, joints = ["A0: [0, 0]"], ["{pin: [1, 2], at: A0}"]
    for k in range(loops):
        x, crank, rod, rocker = 10 * k, 2 * k + 2, 2 * k + 3, 2 * k + 4
        points += [f"B{k}: [{x}, 2]", f"C{k}: [{x + 9}, 2.5]", f"A{k + 1}: [{x + 10}, 0]"]
        joints += [f"{{pin: [{crank}, {rod}], at: B{k}}}", f"{{pin: [{rod}, {rocker}], at: C{k}}}"]
        joints += [f"{{pin: [1, {rocker}], at: A{k + 1}}}"]
    head = f"points: {{{', '.join(points)}}}\njoints:\n" + "".join(f"  - {j}\n" for j in joints)
    loads = f"T: {{torque: 5, link: {2 * loops + 2}}}\n  Q: {{torque: unknown, link: 2}}"
    answer = solved(f"{head}loads:\n  {loads}\n")
    (w,) = answer.witnesses
    assert abs(w.difference) <= w.bound <= 1e-9 * abs(w.power)
    last = force(answer, f"F1-{2 * loops + 2}")
    rod = np.array([9.0, 0.5]) / np.hypot(9, 0.5)
    arm = np.array([-1.0, 2.5])
    size = 5 / (arm[0] * rod[1] - arm[1] * rod[0])
    assert (last.x, last.y) == (
        pytest.approx(size * rod[0], rel=1e-9),
        pytest.approx(size * rod[1], rel=1e-9),
    )


# --- only when asked -------------------------------------------------------------------------------


def test_a_plain_solve_does_none_of_this_work(tmp_path: Any) -> None:
    path = tmp_path / "watt.yaml"
    path.write_text("icsolve: 1\n" + WATT)
    check = (
        "import sys; here = {name for name in sys.modules if name.startswith('icsolve.statics.')}; "
        "assert here <= {'icsolve.statics.power', 'icsolve.statics.load_wrenches'}"
    )
    code = f"import icsolve; a = icsolve.solve(icsolve.load({str(path)!r})); a.to_dict(); {check}"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_reactions_need_no_numpy(tmp_path: Any) -> None:
    path = tmp_path / "watt.yaml"
    path.write_text("icsolve: 1\n" + WATT)
    code = f"import sys, icsolve; icsolve.solve(icsolve.load({str(path)!r}), reactions=True).to_dict(); "
    subprocess.run([sys.executable, "-c", code + "assert 'numpy' not in sys.modules"], check=True)


def test_what_balances_but_for_a_billionth_of_the_largest_is_told_by_that_of_a_multiple_too() -> None:
    """A million times W both ways, W against C: 5e-4 is left, 5e-10 of the largest; 5e-2 is 5e-8 of it."""

    def one(left: str) -> str:
        return f"""
points: {{O: [0, 0]}}
joints:
  - {{pin: [1, 2], at: O}}
loads:
  W: {{torque: 1.000000000000000, link: 2}}
  L: {{torque: {{like: W, times: 1000000}}, link: 2}}
  M: {{torque: {{like: W, times: -1000000}}, link: 2}}
  C: {{torque: -1.{left}0000000, link: 2}}
"""

    notes = solved(one("0005")).notes
    assert any("within a fraction of 5e-10" in note for note in notes), notes
    with pytest.raises(SceneError) as caught:
        solved(one("0500"))
    assert caught.value.status == "unbalanced"


def test_inertia_forces_have_no_last_decimals_that_would_excuse_what_is_left() -> None:
    """A flywheel of 2 kg m^2 that gains 3 rad/s^2 takes 6 N m: 5.9 N m leave 0.1."""
    text = """
points: {O: [0, 0]}
links: {2: {inertia: 2 kg*m^2}}
joints:
  - {pin: [1, 2], at: O}
motion: {link: 2, speed: 1, acceleration: 3}
dynamic: yes
loads: {T: {torque: 5.900000, link: 2}}
"""
    with pytest.raises(SceneError, match=r"leave 0.1 N\*m cw on link 2") as caught:
        solved(text)
    assert caught.value.status == "unbalanced"
    assert solved(text.replace("5.9", "6.0")).reactions is not None


@pytest.mark.parametrize("arm", ["2.1", "2.100000000000000"])
def test_loads_that_balance_to_a_billionth_are_told_so_however_few_decimals_the_figure_has(arm: str) -> None:
    """What is left is told as small, before what the decimals of the figure might explain."""
    (note,) = icsolve.solve(
        icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: [{arm}, 0.4], C: [-1.3, 0.2]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  P: {{force: 1.300000000000000, link: 2, at: B, angle: 90}}
  Q: {{force: 2.100000001050000, link: 2, at: C, angle: 90}}
""")
    ).notes
    assert "but for a fraction of 5e-10 of what they do" in note
