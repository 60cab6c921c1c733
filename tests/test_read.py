"""Reading: what a file says comes out as the values of a case, in case units, with its place in the file."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
import yaml

from corpus import ALL, AWKWARD_NAMES, CAM_AND_BLACK_BOX, FOUR_BAR, GEARS, SLIDER_CRANK, SLOT_AND_WORDS
from icsolve.case import (
    Case,
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Force,
    ForceVector,
    Gears,
    KnownCentre,
    Like,
    Pin,
    Slide,
    Slope,
    Slot,
    Spring,
    Torque,
    Toward,
    Weight,
)
from icsolve.case.expected import (
    ArmIs,
    CentreIs,
    DistanceIs,
    FrictionRadiusIs,
    LoadIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
)
from icsolve.errors import CaseError
from icsolve.read import document, load, read_file, read_text
from icsolve.solve import solve


@pytest.fixture(scope="module")
def slider() -> Case:
    return load(SLIDER_CRANK)


@pytest.fixture(scope="module")
def slot() -> Case:
    return load(SLOT_AND_WORDS)


@pytest.fixture(scope="module")
def gears() -> Case:
    return load(GEARS)


def expected(case: Case, key: str) -> object:
    """What a published value is of."""
    return next(one.target for one in case.expect if one.key == key)


def test_the_four_bar_of_the_format() -> None:
    case = load(FOUR_BAR)
    assert (case.title, case.source) == ("Four-bar press", "where the problem stands")
    assert (case.units.length, case.units.force, case.units.torque) == ("in", "lbf", "lbf*in")
    assert (case.ground, case.links) == ("1", ("1", "2", "3", "4"))
    assert [(length.a, length.b, length.value.value) for length in case.lengths] == [
        ("A", "B", 1.0),
        ("B", "C", 3.5),
        ("C", "D", 2.5),
        ("D", "E", 1.5),
    ]
    direction, corner = case.angles
    assert isinstance(direction, Direction)
    assert isinstance(corner, Corner)
    assert (direction.a, direction.b, direction.value.value) == ("A", "B", 60.0)
    assert (corner.a, corner.at, corner.b, corner.value.value) == ("C", "D", "E", 0.0)
    assert case.near == {"C": (3.5, 2.4)}
    assert case.joints[0] == Pin(("1", "2"), "A")
    assert case.carries == {"1": ("A", "D"), "2": ("A", "B"), "3": ("B", "C"), "4": ("C", "D", "E")}
    force, torque = case.loads
    assert isinstance(force, Force)
    assert (force.link, force.at, force.value.value, force.heading.value) == ("4", "E", 100.0, 180.0)
    assert torque == Torque("T12", "2", None)


def test_a_number_keeps_its_numeral_its_half_unit_and_its_path() -> None:
    number = load(FOUR_BAR).lengths[1].value
    assert number == (3.5, 0.05, "lengths.BC", "3.5", 1.0, None, "not negative", "length")


def test_places_are_lines_and_columns_from_one() -> None:
    marks = load(FOUR_BAR).marks
    assert marks["lengths.BC"] == (9, 22)
    assert marks["points.D.x"] == (8, 7)
    assert marks["joints[1]"] == marks["joints.B"] == (15, 5)
    assert marks["loads.P.angle"] == (20, 44)
    assert marks["expect.w4/w2"] == (24, 18)


def test_units_other_than_the_case_s_are_converted_with_one_rounding(slider: Case) -> None:
    assert [length.value.value for length in slider.lengths] == [30.0, 90.0]
    assert slider.near["C"] == (100.0, 0.0)
    assert slider.angles[0].value.value == 68.75493541569878  # 1.2 * 180 / pi to 20 digits, rounded
    metres = load("icsolve: 1\npoints: {A: [30 mm, 0]}\njoints: [{pin: [1, 2], at: A}]\n")
    point = metres.points["A"]
    assert isinstance(point, Coordinates)
    assert point.x is not None
    assert point.x.value == 0.03
    assert (point.x.half, point.x.factor) == (0.0005, 0.001)


def test_a_torque_unit_of_its_own(slider: Case) -> None:
    """1 N*mm is 0.001 N*m, and a bare torque stands in the unit that ``units`` gives."""
    assert slider.units.torque == "N*m"
    assert slider.units.torque_per_force_length == 0.001
    case = load(SLIDER_CRANK.replace("torque: unknown", "torque: 50"))
    assert case.loads[1].value.value == 50.0  # type: ignore[union-attr]


def test_a_torque_of_other_words_in_case_units() -> None:
    case = load(FOUR_BAR.replace("torque: unknown", "torque: 5 ft-lb").replace("w4/w2", "T12"))
    assert case.loads[1].value.value == 60.0  # type: ignore[union-attr]


def test_a_torque_as_power_over_speed() -> None:
    """1 hp is 33000 ft*lbf/min, and a revolution 2 pi."""
    case = load(FOUR_BAR.replace("torque: unknown", "torque: 2 hp/rpm").replace("w4/w2", "T12"))
    found = case.loads[1].value.value  # type: ignore[union-attr]
    assert found == pytest.approx(2 * 33000 * 12 / (2 * math.pi), rel=1e-15)


def test_a_torsion_spring_s_stiffness_is_no_torque() -> None:
    with pytest.raises(CaseError, match=r"'N\*m/rad' is no unit of a torque"):
        load(FOUR_BAR.replace("torque: unknown", "torque: 2 N*m/rad"))


def test_a_power_in_place_of_a_torque_is_told_its_form() -> None:
    with pytest.raises(CaseError, match="write 'power' and 'speed' in place of 'torque'"):
        load(FOUR_BAR.replace("torque: unknown", "torque: 2 kW"))


@pytest.mark.parametrize(
    ("length", "metres"), [("ft", 0.3048), ("in", 0.0254), ("mm", 1e-3), ("km", 1e3), ("m", 1.0)]
)
@pytest.mark.parametrize(("third", "along"), [("", ""), (", 0", ", along: y")])
def test_a_bare_gravity_is_in_the_lengths_of_the_case(
    length: str, metres: float, third: str, along: str
) -> None:
    """3 kg on an arm of 2: T = 3 kg x g x 2 [N times the length]; with a unit it says the same (1e-14:
    conversions round)."""
    joint = "{hinge: [1, 2], at: A, axis: y}" if third else "{pin: [1, 2], at: A}"
    text = f"""icsolve: 1
units: {{length: {length}}}
gravity: GRAVITY
points: {{A: [0, 0{third}], G: [2, 0{third}]}}
joints: [{joint}]
loads: {{T: {{torque: unknown, link: 2{along}}}, W: {{mass: 3 kg, link: 2, at: G}}}}
"""
    answers = []
    for size in ("32.2", f"32.2 {length}/s^2"):
        answer = solve(load(text.replace("GRAVITY", size)))
        answers.append(abs(answer.answers["T"].value))
        told = any("if m/s^2 is meant, write 32.2 m/s^2" in note for note in answer.notes)
        assert told == (size == "32.2" and length != "m")
    assert answers == pytest.approx([6.0 * 32.2 * metres] * 2, rel=1e-14)


def test_what_may_be_a_slip_is_told_of_a_structure_too() -> None:
    """Radians for degrees, on a beam that stands still."""
    beam = """icsolve: 1
points: {A: [0, 0], B: [4, 0], C: [2, 0]}
joints:
  - {pin: [1, beam], at: A}
  - {slot: [beam, 1], at: B, along: 0}
loads: {P: {force: 10, link: beam, at: C, angle: -1.5708}}
"""
    assert (
        "loads.P.angle is -1.5708 degrees; if radians are meant, write -1.5708 rad."
        in solve(load(beam)).notes
    )


def test_force_and_length_of_the_case_per_newton_and_metre() -> None:
    units = load(FOUR_BAR).units
    assert units.force_per_newton == float(Fraction(10**13, 44482216152605))
    assert units.length_per_metre == float(Fraction(10000, 254))


def test_one_coordinate_unknown(slider: Case) -> None:
    point = slider.points["C"]
    assert isinstance(point, Coordinates)
    assert point.x is None
    assert point.y is not None


def test_friction_is_kept(slider: Case) -> None:
    pin, slide = slider.joints[0], slider.joints[3]
    assert isinstance(pin, Pin)
    assert isinstance(slide, Slide)
    assert pin.friction is not None
    assert slide.friction is not None
    assert pin.friction.mu.value == 0.2
    assert pin.friction.radius == (4.0, 0.5, "joints.A.radius", "4", 1.0, None, "positive", "length")
    assert slide.friction.length is not None
    assert slide.friction.mu.path == "joints.4-1@C.mu"  # two joints stand at C


def test_a_slope_and_a_speed(slider: Case) -> None:
    force = slider.loads[0]
    assert isinstance(force, Force)
    assert isinstance(force.heading, Slope)
    assert (force.heading.run.value, force.heading.rise.value) == (-3.0, 4.0)
    (motion,) = slider.motion
    assert motion.speed is not None
    assert (motion.speed.value, motion.turns) == (31.41592653589793, "cw")  # 300 rpm is 10 pi rad/s


def test_a_carried_point_by_each_way(slot: Case) -> None:
    """Pins on all links, a slot's pin on its first and its guide on its second, loads, and ``links:``."""
    assert slot.carries["frame"] == ("O2", "O4")
    assert slot.carries["crank"] == ("O2", "A", "G", "@M")
    assert slot.carries["rocker"] == ("O4", "C", "@S'")


def test_loads_of_each_kind(slot: Case) -> None:
    weight, mass, spring, vector, torque, like, unknown, away = slot.loads
    assert isinstance(weight, Weight) and not weight.mass
    assert isinstance(mass, Weight) and mass.mass and mass.at == "@M"
    assert isinstance(spring, Spring) and (spring.against, spring.to) == ("rocker", "@S'")
    assert isinstance(vector, ForceVector)
    assert (vector.x.value, vector.y.value, vector.against, vector.turns_with) == (
        3.0,
        -4000.0,
        "crank",
        "rocker",
    )
    assert (vector.x.path, vector.y.path) == ("loads.Q.x", "loads.Q.y")
    assert isinstance(torque, Torque)
    assert torque.value.value == pytest.approx(6.779089741657002, rel=1e-15)  # type: ignore[union-attr]
    assert isinstance(like, Torque) and isinstance(like.value, Like)
    assert like.value.times is not None and like.value.times.value == -1.0
    assert isinstance(unknown, Force) and unknown.heading == Toward("A") and unknown.value is None
    assert isinstance(away, Force) and away.heading == Toward("O4", away=True)


def test_a_load_given_by_coordinates_has_a_hidden_point(slot: Case) -> None:
    point = slot.points["@M"]
    assert isinstance(point, Coordinates)
    assert point.x is not None
    assert (point.x.value, point.x.path) == (0.1, "loads.M.at.x")


def test_a_centroid_a_slot_by_two_points_and_gravity(slot: Case) -> None:
    assert slot.points["G"] == Centroid(("O2", "A"))
    joint = slot.joints[2]
    assert isinstance(joint, Slot)
    assert (joint.guide.ends, joint.guide.through, joint.guide.angle) == (("O4", "C"), "C", None)
    assert slot.gravity.value == 32.174 * 3048 / 10000
    assert slot.reconstructed == "the figure is lost"


MIDDLE = """
icsolve: 1
points: {A: [0, 0], D: [4, 0], M: {centroid: [A, C]}}
lengths: {AB: 1, AM: 2, DM: 2.5}
angles: {AB: 60}
near: {M: [2, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
"""


def test_a_point_that_a_placed_centroid_gives() -> None:
    """C is twice M less A: a centroid that lengths place says where the last of its points is."""
    points = solve(load(MIDDLE)).points
    assert points["C"] == pytest.approx((2 * points["M"][0], 2 * points["M"][1]))
    assert math.dist((0, 0), points["M"]) == pytest.approx(2.0)


def test_a_point_of_a_centroid_that_nothing_places_is_told_its_remedy() -> None:
    with pytest.raises(CaseError, match="M is the centroid of A and C: give C, or M by lengths"):
        load(MIDDLE.replace("AM: 2, DM: 2.5", "BD: 3").replace("near: {M: [2, 2]}", ""))


def test_gears_and_belts(gears: Case) -> None:
    mesh, internal, belt = gears.joints[3:6]
    assert isinstance(mesh, Gears)
    assert isinstance(internal, Gears)
    assert (mesh.teeth[0].value, mesh.teeth[1].value, mesh.carrier) == (31.0, 57.0, "2")
    assert internal.teeth[1].value == -92.0
    assert internal.module is not None
    assert internal.module.value == 0.002
    assert mesh.pressure_angle is not None
    assert mesh.diametral_pitch is not None
    assert belt.crossed is True  # type: ignore[union-attr]
    assert [motion.link for motion in gears.motion] == ["2", "3"]


def test_given_centres_at_points_at_coordinates_and_at_infinity() -> None:
    case = load(CAM_AND_BLACK_BOX)
    _, by_place, at_infinity, at_point, again = case.joints
    assert isinstance(by_place, KnownCentre) and by_place.at == "@2-7" and "@2-7" in case.points
    assert isinstance(at_infinity, KnownCentre) and at_infinity.at is None and at_infinity.toward is not None
    assert isinstance(at_point, KnownCentre) and at_point.at == "L"
    assert isinstance(again, KnownCentre) and again.at == "@1-2"
    assert case.carries == {"2": (), "3": (), "7": (), "1": ()}


def test_names_are_raw_text() -> None:
    """YAML 1.1 would read ``on`` and ``NO`` as truth values, ``12`` and ``1E3`` as numbers."""
    case = load(AWKWARD_NAMES)
    assert list(case.points) == ["NO", "B'", "A", "12", "1E3", "O2"]
    assert case.links == ("1", "on", "3'", "y")
    assert [load.name for load in case.loads] == ["ON", "null"]
    assert [(length.a, length.b) for length in case.lengths] == [
        ("A", "B'"),
        ("A'", "B'"),
        ("O2", "A"),
        ("NO", "12"),
    ]


@pytest.mark.parametrize("word", ["null", "NULL", "true", "No", "off", "1e3", "0x10", "007", "y", "inf"])
def test_a_word_that_yaml_types_names_points_links_and_loads_wherever_they_stand(word: str) -> None:
    text = f"""icsolve: 1
points: {{{word}: [0, 0], B: [2, 1]}}
joints: [{{pin: [f, {word}], at: {word}}}]
ground: f
links: {{{word}: [B, {word}]}}
loads:
  {word}: {{force: 3, link: {word}, at: B, away: {word}}}
  G: {{force: {{like: {word}}}, link: {word}, at: B, toward: {word}, against: f}}
  T: {{torque: unknown, link: {word}}}
motion: {{point: B, link: {word}, speed: 1, angle: 116.6}}
expect: {{{word}: 3, "w{word}": 0.447, "v B on {word}": 1}}
"""
    case = load(text)
    assert (case.links, [one.name for one in case.loads]) == (("f", word), [word, "G", "T"])
    assert [one.target for one in case.expect] == [LoadIs(word), RateIs(word), SpeedIs("B", word)]
    assert solve(case, rates=True).answers["T"].value == 0.0


WHERE_KEYS_STAND = {
    "a case": ("icsolve: 1", "icsolve: 1\nqqq: 3"),
    "a joint": ("{pin: [1, 2],", "{qqq: 3, pin: [1, 2],"),
    "a load": ("{torque: unknown,", "{qqq: 3, torque: unknown,"),
    "units": ("units: {", "units: {qqq: 3, "),
    "motion": ("icsolve: 1", "icsolve: 1\nmotion: {link: 2, turns: cw, qqq: 3}"),
    "an expected value": ("icsolve: 1", "icsolve: 1\nexpect: {P: {value: 3, qqq: 3}}"),
    "a link's mass": ("icsolve: 1", "icsolve: 1\nlinks: {2: {mass: 2 kg, centre: B, qqq: 3}}"),
}


@pytest.mark.parametrize("where", WHERE_KEYS_STAND)
def test_an_unknown_key_is_told_what_may_stand_there(where: str) -> None:
    plain = "\n".join(line for line in FOUR_BAR.splitlines() if not line.startswith(("expect", "  w4/w2")))
    old, new = WHERE_KEYS_STAND[where]
    assert old in plain
    with pytest.raises(CaseError, match=r"has no key 'qqq'; (its keys are \w|other quantities)"):
        load(plain.replace(old, new, 1))


@pytest.mark.parametrize("empty", ["", "~"])
def test_where_nothing_stands_there_is_no_name(empty: str) -> None:
    with pytest.raises(CaseError, match="has no value"):
        load(FOUR_BAR.replace("at: A}", f"at: {empty}}}", 1))


NUMERALS = {"1e3": 1000.0, "-.5": -0.5, "010": 10.0, "+5.": 5.0, "'7'": 7.0, "1.0E+2": 100.0, "−3": -3.0}
NUMERALS |= {"0x1F": 31.0, "0o17": 15.0, "0x0": 0.0}


@pytest.mark.parametrize("text", NUMERALS)
def test_numbers_follow_yaml_1_2(text: str) -> None:
    case = load(FOUR_BAR.replace("AB: 60", f"AB: {text}"))
    assert case.angles[0].value.value == NUMERALS[text]


KEYS = {
    "T12": LoadIs("T12"),
    "I24": CentreIs(("2", "4")),
    "I13": CentreIs(("1", "3")),
    "I24-A": DistanceIs(("2", "4"), "A"),
    "I12-I23": DistanceIs(("1", "2"), ("2", "3")),
    "w3": RateIs("3"),
    "v C on 4": SpeedIs("C", "4"),
    "F34": ReactionIs("3", "4"),
    "F34x": ReactionIs("3", "4", "x"),
    "F3-4@C": ReactionIs("3", "4", "", "C"),
    "M14": ReactionIs("1", "4", "moment"),
    "h F32 A": ArmIs("3", "2", "A"),
    "rf A": FrictionRadiusIs("A"),
    "P": LoadIs("P"),
}


@pytest.mark.parametrize("key", KEYS)
def test_what_a_published_value_is_of(slider: Case, key: str) -> None:
    assert expected(slider, key) == KEYS[key]


def test_links_of_words_in_published_values(slot: Case) -> None:
    assert expected(slot, "crank-rocker") == CentreIs(("crank", "rocker"))
    assert expected(slot, "wrocker/wcrank") == RatioIs("rocker", "crank")
    assert expected(slot, "Fcrank-rocker") == ReactionIs("crank", "rocker")


def test_hyphens_in_published_centres_and_distances() -> None:
    keys = "expect: {I2-4: [0, 0], 2-4: [0, 0], I1-2-I2-3: 1, A-I2-4: 2, A-D: 4}"
    targets = [one.target for one in load(FOUR_BAR.replace("expect:", keys).rpartition("  w4")[0]).expect]
    assert targets == [
        CentreIs(("2", "4")),
        CentreIs(("2", "4")),
        DistanceIs(("1", "2"), ("2", "3")),
        DistanceIs("A", ("2", "4")),
        DistanceIs("A", "D"),
    ]


def test_a_load_s_name_wins() -> None:
    case = load(
        FOUR_BAR.replace("T12:", "F34:").replace("w4/w2: {value: 0.49, within: 1%}", "F34: 3\n  F3-4: 5")
    )
    assert [one.target for one in case.expect] == [LoadIs("F34"), ReactionIs("3", "4")]


def test_widths_senses_and_errata(slider: Case) -> None:
    by_key = {one.key: one for one in slider.expect}
    assert (by_key["T12"].value[0].value, by_key["T12"].sense) == (29.67, "cw")
    assert (by_key["v C on 4"].sense, by_key["w3"].sense) == ("at 30 deg", "cw")
    assert (by_key["I12-I23"].within, by_key["I12-I23"].relative) == (0.5, False)
    assert (by_key["rf A"].within, by_key["rf A"].relative) == (0.002, True)
    assert by_key["P"].erratum == "kN taken for N"
    assert by_key["I13"].toward is not None
    assert [number.value for number in by_key["I24"].value] == [-15.5, 2.25]


def test_a_published_sense_is_one_word() -> None:
    for words, sense in {"cw": "cw", "clockwise": "cw", "Counterclockwise": "ccw"}.items():
        case = load(FOUR_BAR.replace("w4/w2: {value: 0.49, within: 1%}", f"T12: 3 lbf*ft {words}"))
        assert (case.expect[0].sense, case.expect[0].value[0].value) == (sense, 36.0)
    for words, sense in {"to the right": "right", "towards A": "toward A", "tension": "pull"}.items():
        case = load(FOUR_BAR.replace("w4/w2: {value: 0.49, within: 1%}", f"P: 3 {words}"))
        assert case.expect[0].sense == sense


# --- files, texts, settings ------------------------------------------------------------------------


def test_a_case_is_named_by_its_file(tmp_path: Path) -> None:
    for file in ("press.yaml", "press.icsolve.yaml"):
        (tmp_path / file).write_text(FOUR_BAR, encoding="utf-8")
        case = load(tmp_path / file)
        assert (case.name, case.path) == ("press", os.fspath(tmp_path / file))
        assert load(str(tmp_path / file)) is not case
    assert (load(FOUR_BAR).name, load(FOUR_BAR).path) == ("case", "<text>")
    assert read_text(FOUR_BAR, "<stdin>").path == "<stdin>"


@pytest.mark.parametrize("how", ["bom", "crlf", "cr", "utf-16"])
def test_encodings_and_line_ends_of_other_systems(tmp_path: Path, how: str) -> None:
    data = {
        "bom": b"\xef\xbb\xbf" + FOUR_BAR.encode(),
        "crlf": FOUR_BAR.replace("\n", "\r\n").encode(),
        "cr": FOUR_BAR.replace("\n", "\r").encode(),
        "utf-16": FOUR_BAR.encode("utf-16"),
    }
    (tmp_path / "press.yaml").write_bytes(data[how])
    case = read_file(tmp_path / "press.yaml")
    assert case.marks == load(FOUR_BAR).marks
    assert case.joints == load(FOUR_BAR).joints


@pytest.mark.parametrize("name", ALL)
def test_the_parser_without_libyaml_reads_the_same(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    swift = load(ALL[name])
    monkeypatch.setattr(document, "LOADER", yaml.SafeLoader)
    plain = load(ALL[name])
    assert {key: getattr(plain, key) for key in Case.__dataclass_fields__} == {
        key: getattr(swift, key) for key in Case.__dataclass_fields__
    }


def test_settings_replace_numbers_before_reading() -> None:
    settings = {
        "angles.AB": "1 rev",
        "lengths.BA": "50.8 mm",
        "points.D.x": 5,
        "loads.P": "1 kip",
        "loads.P.angle": -90.0,
        "near.C.y": "3",
        "gravity": "9.8 m/s^2",
    }
    case = load(FOUR_BAR, settings)
    point = case.points["D"]
    assert isinstance(point, Coordinates)
    assert point.x is not None
    assert (case.angles[0].value.value, case.lengths[0].value.value, point.x.value) == (360.0, 2.0, 5.0)
    assert (case.loads[0].value.value, case.loads[0].heading.value) == (1000.0, -90.0)  # type: ignore[union-attr]
    assert (case.near["C"], case.gravity.value) == ((3.5, 3.0), 9.8)
    assert case.lengths[0].value.path == "lengths.AB"


@pytest.mark.parametrize("digits", [309, 400, 5000])
def test_a_whole_number_beyond_doubles_is_no_setting(digits: int) -> None:
    with pytest.raises(CaseError, match=r"cannot set 'angles\.AB': the number is larger"):
        load(FOUR_BAR, {"angles.AB": -(10**digits)})


def test_settings_of_joints_motion_and_components() -> None:
    case = load(SLIDER_CRANK, {"joints.A.mu": "0.3", "joints.4-1@C.along": 5, "motion.speed": "2 rad/s"})
    assert case.joints[0].friction.mu.value == 0.3  # type: ignore[union-attr]
    assert case.joints[3].guide.angle.value == 5.0  # type: ignore[union-attr]
    assert case.motion[0].speed is not None
    assert case.motion[0].speed.value == 2.0
    vector = load(SLOT_AND_WORDS, {"loads.Q.x": "7", "loads.M.at.y": "1"}).loads[3]
    assert isinstance(vector, ForceVector)
    assert vector.x.value == 7.0


UNSETTABLE = {
    "angles.BA": "the case gives the angle AB, which is not BA",
    "angles.XY": "the case has no XY under 'angles'",
    "lengths.AX": "the case has no AX",
    "points.Q.x": "the case has no Q",
    "points.A": "points.A.x or points.A.y",
    "points.A.z": "points.A.x",
    "near.C": "near.C.x or near.C.y",
    "joints.X.mu": "no joint stands at X",
    "joints.A": "joints.B.mu",
    "joints.A.at.x": "joints.B.mu",
    "motion.speed": "the case has no 'motion'",
    "title": "a path is like",
    "loads": "a path is like",
    "loads.Q": "the case has no Q",
    "loads.P.force": "a path is like",
    "nonsense": "a path is like",
    "": "a path is like",
    "joints.D.teeth": "no key 'teeth'",
    "loads.P.away": "give one of them",
}


@pytest.mark.parametrize("path", UNSETTABLE)
def test_a_setting_that_the_case_has_no_place_for_is_refused(path: str) -> None:
    with pytest.raises(CaseError) as caught:
        load(FOUR_BAR, {path: "A"})
    assert UNSETTABLE[path] in str(caught.value)


def test_a_setting_of_a_joint_where_two_stand_names_both() -> None:
    without = SLIDER_CRANK.replace(", mu: 0.1, length: 20", "")
    with pytest.raises(CaseError, match=r"joints\.3-4@C\.mu or joints\.4-1@C\.mu"):
        load(without, {"joints.C.mu": "0.1"})
    assert load(SLIDER_CRANK, {"joints.C.mu": "0.3"}).joints[3].friction.mu.value == 0.3  # type: ignore[union-attr]


def test_a_setting_of_a_joint_that_alone_takes_it_needs_no_links() -> None:
    """A pin and a slide stand at C; only the slide has ``along``, and only it has ``length``."""
    case = load(SLIDER_CRANK, {"joints.C.along": "7", "joints.1-4.length": "9"})
    slide = case.joints[3]
    assert isinstance(slide, Slide)
    assert slide.guide.angle is not None
    assert slide.friction is not None
    assert slide.friction.length is not None
    assert (slide.guide.angle.value, slide.friction.length.value) == (7.0, 9.0)


def test_a_setting_of_the_wrong_dimension_is_refused() -> None:
    with pytest.raises(CaseError, match="'kg' is a mass, but an angle is wanted"):
        load(FOUR_BAR, {"angles.AB": "30 kg"})


def test_reading_a_valid_case_loads_nothing_that_is_slow_to_start() -> None:
    """Start-up time is a feature: these are for messages, exact checks and sweeps only."""
    code = (
        "import sys; from icsolve.read import load; load(sys.argv[1]); "
        "print(sorted({'difflib', 'fractions', 'decimal', 'numpy', 'shapely', 'json'} & set(sys.modules)))"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, SLIDER_CRANK], capture_output=True, text=True, check=True
    )
    assert run.stdout == "[]\n"


def test_a_solve_loads_nothing_of_what_its_case_does_not_ask() -> None:
    """Without published values, as text and as JSON: a start does not pay for these, nor for stability."""
    code = (
        "import sys; from icsolve.read import load; from icsolve.solve import solve; "
        "from icsolve.report import answer_text; "
        "from icsolve.answer.as_json import to_dict; "
        "answer = solve(load(sys.argv[1])); answer_text(answer), to_dict(answer); "
        "ends = ('.expected', '.expect', 'answer.equilibrium'); "
        "print([name for name in sys.modules if name.endswith(ends)])"
    )
    unpublished = FOUR_BAR.partition("expect:")[0]
    command = [sys.executable, "-c", code, unpublished]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert run.stdout == "[]\n"


def test_an_accent_after_its_letter_is_the_same_name() -> None:
    """As some editors and file systems write it (Unicode's form D); one name may be written both ways."""
    text = (
        "icsolve: 1\npoints: {\N{LATIN SMALL LETTER E WITH ACUTE}: [0, 0], B: [3, 1]}\n"
        "joints: [{pin: [1, 2], at: e\N{COMBINING ACUTE ACCENT}}]\n"
        "loads: {P: {force: 2, link: 2, at: B, angle: 90}, T: {torque: unknown, link: 2}}\n"
    )
    case = load(text)
    assert [*case.points] == ["\N{LATIN SMALL LETTER E WITH ACUTE}", "B"]
    assert solve(case).answers["T"].value == -6.0
