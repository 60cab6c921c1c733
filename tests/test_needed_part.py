"""Links that hang on a mechanism and hold nothing of it change no answer, whatever becomes of them: a passive
dyad that does not reach, whose data are too few or contradict one another, or that is stretched. What `solve`
answers, all the other commands answer too (L. V. Assur's groups: one that adds no freedom takes none).
"""

from __future__ import annotations

import json
import math
from itertools import permutations
from pathlib import Path
from random import Random

import numpy as np
import pytest

import icsolve as library
from icsolve.errors import SceneError
from icsolve.scene import examined
from icsolve.scene.needed_part import needed_part
from icsolve.solve.stability import with_stability
from shell import Shell
from sizes import few, sampled


@pytest.fixture
def icsolve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shell:
    monkeypatch.chdir(tmp_path)
    return Shell(capsys)


MECHANISM = """icsolve: 1
units: {{length: mm}}
points: {{A: [0, 0], D: [40, 0], G: [{gx}, {gy}]}}
lengths: {{AB: {a}, BC: {b}, CD: {c}, DE: {e}, CE: {ce}{lengths}}}
angles: {{AB: 60{angles}}}
near: {{C: [35, 25], E: [55, 12]{near}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}{joints}
links: {{4: [E]}}
loads:
  P: {{force: 100, link: 4, at: E, angle: {angle}}}
  T: {{torque: unknown, link: 2}}
"""
DYAD = "\n  - {pin: [4, 5], at: E}\n  - {pin: [5, 6], at: F}\n  - {pin: [6, 1], at: G}"
SLIDER = (
    "\n  - {pin: [4, 5], at: E}\n  - {pin: [5, 6], at: F}\n  - {slide: [6, 1], at: F, along: 0, through: G}"
)
SECOND = "\n  - {pin: [5, 7], at: H}\n  - {pin: [7, 8], at: K}\n  - {pin: [8, 1], at: A}"
SPARE = {
    "too short": {"lengths": ", EF: 1, FG: 20", "near": ", F: [85, 17]", "joints": DYAD},
    "a length is missing": {"lengths": ", EF: 20", "near": ", F: [70, 5]", "joints": DYAD},
    "two places, and no near": {"lengths": ", EF: 70, FG: 70", "joints": DYAD},
    "contradictory": {
        "lengths": ", EF: 70, FG: 70",
        "angles": ", EFG: 150",
        "near": ", F: [70, 5]",
        "joints": DYAD,
    },
    "a slider out of reach": {"lengths": ", EF: 1", "near": ", F: [70, 5]", "joints": SLIDER},
    "on a dyad that reaches one that does not": {
        "lengths": ", EF: 70, FG: 70, EH: 10, FH: 75, HK: 1, AK: 1",
        "near": ", F: [80, 60], H: [60, 30], K: [20, 90]",
        "joints": DYAD + SECOND,
    },
    "on a dyad that does not reach another": {
        "lengths": ", EF: 1, FG: 1, EH: 10, FH: 10, HK: 80, AK: 80",
        "near": ", F: [80, 60], H: [60, 30], K: [20, 90]",
        "joints": DYAD + SECOND,
    },
}


def drawn(seed: int) -> dict[str, object]:
    """The numbers of a four-bar that assembles at all angles of its crank."""
    rng = Random(seed)
    number = rng.uniform
    numbers = {"a": number(8, 12), "b": number(33, 37), "c": number(24, 28), "e": number(14, 18)}
    numbers |= {"ce": number(22, 28), "angle": number(0, 360), "gx": number(80, 95), "gy": number(-5, 5)}
    return {name: round(value, 2) for name, value in numbers.items()}


def texts(seed: int, kind: str) -> tuple[str, str]:
    """A mechanism with spare links, and the same without them."""
    bare = dict.fromkeys(("lengths", "angles", "near", "joints"), "")
    return MECHANISM.format(**drawn(seed), **{**bare, **SPARE[kind]}), MECHANISM.format(**drawn(seed), **bare)


SEEDS = range(few(12))


@pytest.fixture(params=[(seed, kind) for kind in SPARE for seed in SEEDS], ids=lambda at: f"{at[1]} {at[0]}")
def pair(request: pytest.FixtureRequest) -> tuple[str, str]:
    return texts(*request.param)


def test_every_way_to_ask_gives_the_answer_of_the_mechanism_alone(pair: tuple[str, str]) -> None:
    """Equal to the last digit: the same steps lead to them."""
    case, alone = map(library.load, pair)
    told = library.solve(alone).answers["T"]
    for asked in ({}, {"rates": True}, {"all_centres": True}, {"reactions": True}):
        found = library.solve(case, **asked)
        assert found.answers["T"].value == told.value
        assert not asked or any(note.startswith("left out: link") for note in found.notes)
        for link, rate in (library.solve(alone, **asked).rates or {}).items():
            assert found.rates[link] == rate


def test_rows_are_those_of_the_mechanism_alone(pair: tuple[str, str]) -> None:
    case, alone = map(library.load, pair)
    turns = np.array([0.0, 37.0, 122.0, 245.0])
    for vary in ({"angles.AB": 60.0 + turns}, {"lengths.BC": 34.0 + turns / 200}, {"loads.P": turns}):
        found, told = library.sweep(case, vary), library.sweep(alone, vary)
        assert [*map(str, found.status)] == [*map(str, told.status)] == ["ok"] * 4
        assert np.allclose(found.answers["T"], told.answers["T"], rtol=1e-12, atol=0.0)
    found = library.sweep(case, drive={"2": turns}, want=("answers", "rates", "points"))
    told = library.sweep(alone, drive={"2": turns}, want=("answers", "rates", "points"))
    assert np.allclose(found.answers["T"], told.answers["T"], rtol=1e-12, atol=0.0)
    assert np.allclose(found.rates["4"], told.rates["4"], rtol=1e-12, atol=0.0)
    calls = [library.evaluator(of, ("angles.AB", "loads.P"))(60.0 + turns, 50.0) for of in (case, alone)]
    assert np.allclose(*(call.answers["T"] for call in calls), rtol=1e-12, atol=0.0)


@sampled(4)
def test_every_command_answers(icsolve: Shell, pair: tuple[str, str]) -> None:
    value = library.solve(library.load(pair[1])).answers["T"].value
    Path("m.yaml").write_text(pair[0] + f"expect: {{T: {value:.6g}}}\n")
    ran = icsolve("check", "--json", "m.yaml")
    (told,) = ran.objects()
    assert (ran.code, told["values"][0]["verdict"]) == (0, "agrees")
    assert icsolve("validate", "m.yaml").code == 1
    assert str(abs(value))[:4] in icsolve("explain", "m.yaml").out
    stabilities = []
    for text in pair:
        Path("s.yaml").write_text(text)
        (told,) = icsolve("solve", "s.yaml", "--stability", "2", "--json").objects()
        stabilities.append(told["stability"])
    assert stabilities[0] == stabilities[1]
    for command in (
        ("draw", "m.yaml", "-o", "m.svg"),
        ("page", "m.yaml", "-o", "m.html"),
        ("solve", "m.yaml", "--report"),
        ("export", "moodle-xml", "m.yaml", "-o", "m.xml"),
        ("sweep", "m.yaml", "--vary", "angles.AB=60:90:10", "--plot", "m-plot.svg"),
    ):
        assert icsolve(*command).code == 0, command
    model = json.loads(Path("m.html").read_text().split('id="data">')[1].split("</script>")[0])
    assert model["answers"]
    places = [
        icsolve("sweep", name, "--vary", "angles.AB=0:350:10", "--find", "T=0").out
        for name in ("m.yaml", "alone.yaml")
        if Path("alone.yaml").write_text(pair[1])
    ]
    assert places[0] == places[1] != ""


TRIAD = """
  - {pin: [4, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 7], at: H}
  - {pin: [7, 1], at: G}
  - {pin: [6, 8], at: K}
  - {pin: [8, 1], at: A}"""
REACHING = {
    "a dyad": {"lengths": ", EF: {ef}, FG: {fg}", "near": ", F: [75, 30]", "joints": DYAD},
    "a triad, by Newton's method": {
        "lengths": ", EF: 20, FH: 12, HK: 10, FK: 9, GH: 15, AK: 79",
        "near": ", F: [73, 12], H: [82, 10], K: [78, 3]",
        "joints": TRIAD,
    },
}


@sampled(2, "kind")
@pytest.mark.parametrize("kind", REACHING)
@pytest.mark.parametrize("seed", range(few(9)))
def test_rows_in_which_spare_links_do_not_reach_have_the_answer_of_their_scene(seed: int, kind: str) -> None:
    """They reach in the position as written, and not all round; the links that move have their rates."""
    bare = dict.fromkeys(("lengths", "angles", "near", "joints"), "")
    alone = library.load(MECHANISM.format(**drawn(seed), **bare))
    turns = np.arange(0.0, 360.0, 24.0)
    at = library.sweep(alone, drive={"2": turns}, want=("points",)).points
    apart = np.hypot(*(at["E"] - at["G"]).T)
    reach = (apart[0] + apart.max()) / 2.0 if apart[0] < apart.max() - 1.0 else apart[0] + 0.5
    reaching = {**REACHING[kind]}
    reaching["lengths"] = reaching["lengths"].format(ef=round(0.55 * reach, 3), fg=round(0.45 * reach, 3))
    case = library.load(MECHANISM.format(**drawn(seed), **{**bare, **reaching}))
    try:
        assert library.solve(case, examine=True).points.keys() >= {"F", "G"}
    except SceneError:
        pytest.skip("the triad does not reach in this one as written")
    for want in (("answers",), ("answers", "points.C"), ("answers", "rates", "points", "centres")):
        found, told = (
            library.sweep(case, drive={"2": turns}, want=want),
            library.sweep(alone, drive={"2": turns}, want=want),
        )
        assert {*found.status} == {*told.status} == {"ok"}
        for kind_of, arrays in told.kinds.items():
            for name, array in arrays.items():
                mine = found.kinds[kind_of][name]
                if kind_of == "centres":  # triples, of which the size says nothing
                    assert np.allclose(np.cross(mine, array), 0.0, atol=1e-9 * np.abs(array).max())
                else:
                    assert np.allclose(mine, array, rtol=1e-9, atol=1e-9), (want, name)
    reached = np.isfinite(found.points["F"][:, 0])
    assert reached.any()
    if reached.all():
        pytest.skip("the links reach all round in this one")
    assert np.array_equal(reached, np.isfinite(found.rates["5"]))
    assert any("left out: links 5" in note for note in found.notes)
    rows = np.flatnonzero(~reached)[:2]
    for row in rows.tolist():
        scene = library.solve(found.case_of(row), rates=True)
        assert math.isclose(scene.answers["T"].value, found.answers["T"][row], rel_tol=1e-12)


@sampled(2, "kind")
@pytest.mark.parametrize("kind", REACHING)
@pytest.mark.parametrize("seed", range(few(6)))
def test_a_link_with_which_a_load_turns_is_needed_in_a_motion(seed: int, kind: str) -> None:
    """Rows in which it reaches have the load in the direction that it has turned to, the others no answer."""
    bare = dict.fromkeys(("lengths", "angles", "near", "joints"), "")
    reaching = {**REACHING[kind]}
    reaching["lengths"] = reaching["lengths"].format(ef=26.0, fg=24.0)
    text = MECHANISM.format(**drawn(seed), **{**bare, **reaching})
    turning = text.replace("link: 4, at: E,", "link: 4, at: E, turns_with: 5,")
    turns = np.arange(0.0, 360.0, 24.0)
    try:
        library.solve(library.load(turning), examine=True)
    except SceneError:
        pytest.skip("the triad does not reach in this one as written")
    rows = library.sweep(library.load(turning), drive={"2": turns}, want=("answers", "points"))
    e, f = rows.points["E"], rows.points["F"]
    assert np.array_equal(rows.status == "ok", np.isfinite(f[:, 0]))
    assert rows.status[0] == "ok"
    way = np.degrees(np.arctan2(*(f - e).T[::-1]))
    for row in np.flatnonzero(rows.status == "ok").tolist():
        angle = drawn(seed)["angle"] + way[row] - way[0]
        scene = library.load(text, {"loads.P.angle": float(angle)})
        one = library.sweep(scene, drive={"2": turns[row : row + 1]}).answers["T"][0]
        assert math.isclose(one, rows.answers["T"][row], rel_tol=1e-9, abs_tol=1e-9)


def test_what_turns_with_a_link_without_a_place_is_refused_in_a_motion_alone() -> None:
    """As written it acts as it is written."""
    text, _ = texts(0, "too short")
    case = library.load(text.replace("link: 4, at: E,", "link: 4, at: E, turns_with: 5,"))
    assert library.solve(case).answers["T"].value == library.solve(library.load(text)).answers["T"].value
    with pytest.raises(SceneError, match="cannot meet at F"):
        library.sweep(case, drive={"2": [1.0, 2.0]})
    with pytest.raises(SceneError, match="cannot meet at F"):
        with_stability(case, library.solve(case), "2")


STEADY = {
    "torques": "P: {torque: 100, link: 4}",
    "a force through its pivot": "P: {force: 100, link: 4, at: D, angle: 30}",
    "a force that turns with it": "P: {force: 100, link: 4, at: E, angle: 30, turns_with: 4}",
}


@pytest.mark.parametrize("load", STEADY.values(), ids=STEADY)
@pytest.mark.parametrize("seed", range(few(4)))
def test_a_row_in_which_a_loaded_link_has_no_place_has_no_answer(seed: int, load: str) -> None:
    """Though the answer is the same wherever that is: the link that is turned has to reach it."""
    bare = dict.fromkeys(("lengths", "angles", "near", "joints"), "")
    text = MECHANISM.format(
        **{**drawn(seed), "a": 24.0}, **{**bare, "lengths": ", EF: 1", "near": ", F: [70, 5]"}
    )
    text = text.replace(text[text.index("  P: {") : text.index("  T: ")], f"  {load}\n")
    case = library.load(text.replace("unknown, link: 2", "unknown, link: 4"))
    turns = np.arange(0.0, 360.0, 24.0)
    turned = {"2": turns}
    placed = library.sweep(case, drive=turned, want=("answers", "points"))
    there = np.isfinite(placed.points["C"][:, 0])
    assert there[0] and not there.all()
    for want in (("answers", "status"), ("answers", "status", "error"), ("answers", "rates", "status")):
        rows = library.sweep(case, drive=turned, want=want)
        assert np.array_equal(rows.status == "ok", there)
        assert {*rows.status[~there]} == {"cannot-assemble"}
        assert np.array_equal(np.isfinite(rows.answers["T"]), there)


def test_a_position_of_rest_is_found_beside_spare_links() -> None:
    for kind in SPARE:
        both = [
            library.solve(
                library.load(text.replace("AB: 60", "AB: unknown").replace("torque: unknown", "torque: 0"))
            )
            for text in texts(0, kind)
        ]
        assert len(both[0].positions) == len(both[1].positions) > 0
        for one, other in zip(*(answer.positions for answer in both), strict=True):
            assert math.isclose(one.at["angles.AB"], other.at["angles.AB"], rel_tol=1e-12)


def test_what_is_asked_of_a_spare_link_is_refused() -> None:
    """A load on it, a motion of it, its drive: then it is needed."""
    text, _ = texts(0, "too short")
    on_it = text.replace("T: {torque", "M: {torque: 5, link: 6}\n  T: {torque")
    with pytest.raises(SceneError, match="cannot meet at F"):
        library.solve(library.load(on_it))
    with pytest.raises(SceneError, match="cannot meet at F"):
        library.sweep(library.load(text), drive={"6": [1.0, 2.0]})
    assert needed_part(library.load(on_it)) is None


def test_a_published_value_of_a_spare_link_has_no_answer(icsolve: Shell) -> None:
    text, _ = texts(0, "too short")
    Path("m.yaml").write_text(text + "expect: {w6/w2: 0.5}\n")
    ran = icsolve("check", "m.yaml")
    assert ran.code == 1
    assert "cannot meet at F" in ran.err


def test_rows_in_which_the_spare_links_assemble_have_them() -> None:
    """Where another figure in each row is asked for with its points, each is as `solve` finds it."""
    text, _ = texts(0, "too short")
    found = library.sweep(
        library.load(text), {"lengths.EF": [1.0, 40.0]}, want=("answers", "points", "rates")
    )
    assert [*map(str, found.status)] == ["ok", "ok"]
    assert np.isfinite(found.points["F"][:, 0]).tolist() == [False, True]
    assert found.answers["T"][0] == found.answers["T"][1]


def test_of_a_mechanism_without_a_load_to_find_nothing_is_left_out() -> None:
    """What is asked is how all of it moves."""
    for kind in ("too short", "contradictory"):
        text, _ = texts(0, kind)
        for loads in (
            "loads: {}",
            "loads: {T: {torque: unknown, link: 2}}",
            "loads: {T: {torque: 3, link: 2}}",
        ):
            case = library.load(text.split("loads:")[0] + loads)
            with pytest.raises(SceneError):
                library.solve(case)
            with pytest.raises(SceneError):
                library.sweep(case, drive={"2": [1.0, 2.0]}, want=("rates",))


@pytest.mark.parametrize("kind", SPARE)
def test_with_friction_too(kind: str) -> None:
    """Links without a place press nothing: with friction at two pins the range, at rest, and the value in
    motion are those of the mechanism alone."""
    found = []
    for text in texts(1, kind):
        rubs = text.replace("[2, 3], at: B}", "[2, 3], at: B, mu: 0.2, radius: 2}")
        rubs = rubs.replace("[4, 1], at: D}", "[4, 1], at: D, mu: 0.15, radius: 3}")
        at_rest, moving = (
            library.solve(library.load(rubs + m)) for m in ("", "motion: {link: 2, speed: 1}\n")
        )
        found.append((at_rest.answers["T"].holds, moving.answers["T"].value))
    assert found[0] == found[1]


def test_a_belt_that_no_answer_needs_is_left_in_where_pins_rub() -> None:
    """Its tension presses them, though it does no work."""
    bare = {"lengths": ", BM: 20, CM: 20", "angles": "", "near": ", M: [20, 30]"}
    text = MECHANISM.format(
        **drawn(0), **bare, joints="\n  - {pin: [3, 5], at: M}\n  - {belt: [5, 4], radii: [3, 3]}"
    )
    text = text.replace("links: {4: [E]}", "links: {4: [E], 3: [M]}")
    assert needed_part(library.load(text)) is not None
    assert (
        needed_part(library.load(text.replace("[2, 3], at: B}", "[2, 3], at: B, mu: 0.2, radius: 2}")))
        is None
    )


STRETCHED = """icsolve: 1
points: {A: [0, 0], B: [0, 2], C: [5, 3], D: [4, 0], E: [6, 1], F: [8, 1], G: [9, 1]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [4, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 1], at: G}
links: {4: [E]}
loads: {P: {force: 10, link: 4, at: E, angle: 200}, T: {torque: unknown, link: 2}}
"""


def test_a_point_without_a_place_is_told_where_all_is_looked_at() -> None:
    loose = MECHANISM.format(**drawn(0), lengths=", BX: 20", angles="", near="", joints="")
    case = library.load(loose.replace("links: {4: [E]}", "links: {4: [E], 3: [X]}"))
    assert not library.solve(case).notes
    (note,) = examined(case).notes
    assert note.startswith("left out, as nothing needs it: point X")


def test_a_stretched_dyad_is_told_where_all_is_looked_at(icsolve: Shell) -> None:
    """It does no work, and what the answer does not need is not looked at; but it holds what it hangs on."""
    case = library.load(STRETCHED)
    value = library.solve(case).answers["T"].value
    assert library.solve(case, rates=True).answers["T"].value == value
    assert any("stands still" in note for note in library.solve(case, rates=True).notes)
    for asked in ({"reactions": True}, {"examine": True}):
        with pytest.raises(SceneError, match="stands still"):
            library.solve(case, **asked)
    moving = (
        STRETCHED.replace("{4: [E]}", "{4: [E], 3: {mass: 2 kg, centre: C}}")
        + "motion: {link: 2, speed: 10}\n"
    )
    with pytest.raises(SceneError, match=r"stands still|structure"):
        library.solve(library.load(moving), dynamic=True)
    Path("m.yaml").write_text(STRETCHED)
    assert icsolve("validate", "m.yaml").code == 1


@pytest.mark.parametrize("links", [*permutations("345")])
def test_the_order_in_which_a_pin_names_its_links_decides_nothing(links: tuple[str, ...]) -> None:
    """One of the three is of a spare dyad; those that are left stay joined."""
    text, alone = texts(0, "too short")
    text = text.replace("  - {pin: [4, 5], at: E}\n", "").replace("EF: 1", "CF: 1")
    case = library.load(text.replace("{pin: [3, 4], at: C}", f"{{pin: [{', '.join(links)}], at: C}}"))
    part = needed_part(case)
    assert part is not None
    assert [{*joint.links} for joint in part.joints if joint.at == "C"] == [{"3", "4"}]
    assert library.solve(case).answers["T"].value == library.solve(library.load(alone)).answers["T"].value
    turns = [0.0, 50.0, 130.0]
    both = [library.sweep(one, drive={"2": turns}).answers["T"] for one in (case, library.load(alone))]
    assert np.allclose(*both, rtol=1e-12)


WELDED = """icsolve: 1
points: {{A: [0, 0], B: [0, 2], C: [5, 3], D: [4, 0], E: [7, 5]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [{0}], at: C}}
  - {{pin: [4, 1], at: D}}
  - {{weld: [4, 5], at: C}}
loads: {{P: {{force: 10, link: {1}, at: E, angle: 200}}, T: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize("loaded", "245")
def test_links_that_are_welded_are_pinned_once(loaded: str) -> None:
    """Two of the three links of a pin are one body: named after the third they were two redundant pins."""
    found = []
    for links in permutations("345"):
        answer = library.solve(library.load(WELDED.format(", ".join(links), loaded)))
        assert not answer.notes, links
        found.append(answer.answers["T"].value)
    assert len({*found}) == 1


@pytest.mark.parametrize("kind", SPARE)
def test_with_inertia_forces_too(kind: str) -> None:
    """A mass on the coupler counts, and the links that are left out have none."""
    found = []
    for text in texts(0, kind):
        moving = text.replace(
            "links: {4: [E]}", "links: {4: [E], 3: {mass: 2 kg, centre: C, inertia: 0.01 kg*m^2}}"
        )
        case = library.load(moving + "motion: {link: 2, speed: 10, acceleration: 4}\n")
        answer = library.solve(case, dynamic=True)
        rows = library.sweep(case, drive={"2": [0.0, 70.0]}, dynamic=True, want=("answers", "accelerations"))
        assert rows.answers["T"][0] == pytest.approx(answer.answers["T"].value, rel=1e-12)
        found.append((answer.answers["T"].value, answer.angular_accelerations["3"], rows.answers["T"][1]))
    assert found[0] == pytest.approx(found[1], rel=1e-12)
    assert found[0][0] != library.solve(library.load(texts(0, kind)[1])).answers["T"].value


@pytest.mark.parametrize("loaded", "23")
@pytest.mark.parametrize("pin", ["[4, 5]", "[5, 4]"])
def test_a_pin_of_spare_links_goes_on_with_its_own_link_whatever_stands_there(pin: str, loaded: str) -> None:
    """A load of another link stands at the pin of a dyad that does not reach in some of the rows: there the
    point is where the link takes it that carries the dyad, as in the same mechanism without it, and nowhere
    where that link is left out too."""
    four = "{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}"
    dyad = f"{{pin: {pin}, at: Q}}, {{pin: [5, 6], at: F}}, {{pin: [6, 1], at: G}}"
    head = "icsolve: 1\npoints: {A: [0, 0], B: [1, 2], C: [4, 3], D: [5, 0], Q: [6, 4]"
    loads = f"P: {{force: 10, link: {loaded}, at: Q, angle: 20}}, T: {{torque: unknown, link: 2}}"
    case = library.load(
        f"{head}, F: [7.5, 3.6], G: [8.5, 3]}}\njoints: [{four}, {dyad}]\nloads: {{{loads}}}\n"
    )
    turned = {"2": np.linspace(-25.0, 25.0, 21)}
    found = library.sweep(case, drive=turned, want=("answers", "status", "points"))
    assert [*map(str, found.status)] == ["ok"] * 21
    assert np.isfinite(found.answers["T"]).all()
    c, q, f = (found.points[name] @ (1.0, 1j) for name in "CQF")
    assert 5 < np.isnan(f).sum() < 15
    assert (np.isnan(c) == (np.isnan(f) if loaded == "2" else False)).all()
    lost = np.isnan(c)
    assert np.isnan(q[lost]).all()
    assert np.allclose(q[~lost], 5 + (1 + 4j) / (-1 + 3j) * (c[~lost] - 5), rtol=1e-13)
