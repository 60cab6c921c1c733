"""Slips that newcomers make: each is told in the words of their own file, with what would mend it.

The first table changes one thing of a press and says where the refusal stands and what is in it; the second
holds files that are read and whose scene, answer or notes tell.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import icsolve
from icsolve.errors import CaseError, SceneError
from icsolve.manual import template
from icsolve.numbers.units import parse_unit
from icsolve.sweep.varied_numbers import find_number
from shell import exit_status

PRESS = """\
icsolve: 1
title: Four-bar press
units: {length: in, force: lbf}
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}
"""


DOOR = """\
icsolve: 1
points: {O: [0, 0], E: [-1, 0.8], C: {centroid: [A, B]}}
lengths: {OC: 1, CA: 0.9, EA: 0.8}
angles: {OC: 60}
near: {A: [-0.2, 1.1]}
joints:
  - {pin: [1, 2], at: O}
  - {pin: [2, 3], at: C}
  - {pin: [3, 4], at: A}
  - {pin: [4, 1], at: E}
loads:
  W: {weight: 700, link: 3, at: C}
  S: {spring: 5000, free: 0.25, link: 2, at: O, to: B}
  P: {force: unknown, link: 3, at: B, angle: 90}
"""


def test_the_end_of_a_bar_whose_middle_is_given_belongs_to_the_bar() -> None:
    """An overhead door on two arms: a spring to its lower edge is no spring to the frame."""
    with pytest.raises(CaseError, match=r"to link 1 at B, which is a point of link 3: write 'against: 3'"):
        icsolve.load(DOOR)
    icsolve.solve(icsolve.load(DOOR.replace("to: B", "to: B, against: 3")))


UNKNOWN = {
    "at: A}": "at: A, mu: ?0.2?, radius: 0.1}",
    "angle: 180": "angle: ?180?",
    "{force: 100": "{pressure: 20, bore: ?2?",
    "{torque: unknown, link: 2}": "{spring: 20, free: ?2?, link: 2, at: B, to: D}",
    "{pin: [4, 1], at: D}": "{contact: [1, 4], at: D, normal: ?90?}",
    "{pin: [3, 4], at: C}": "{slide: [3, 4], at: C, along: ?20?}",
    "loads:": "  - {roll: [4, 5], at: E, radii: [?0.5?, 0]}\n  - {slide: [5, 1], at: F, along: 0}\nloads:",
}


@pytest.mark.parametrize(("old", "new"), UNKNOWN.items())
def test_what_cannot_be_unknown_is_asked_by_a_sweep_that_takes_it(old: str, new: str) -> None:
    """The path that the refusal names is one that a sweep varies, in the units of the case."""
    before, number, after = new.split("?")
    text = PRESS.replace("D: [4, 0]}", "D: [4, 0], F: [5, 1.5]}")
    with pytest.raises(CaseError, match="'unknown' cannot stand here") as refused:
        icsolve.load(text.replace(old, f"{before}unknown{after}"))
    found = re.search(r"--vary (\S+)=FROM:TO:STEP", str(refused.value))
    assert found, refused.value
    case = icsolve.load(text.replace(old, f"{before}{number}{after}"))
    assert find_number(case, found[1]).value == float(number)


def changed(*changes: tuple[str, str]) -> str:
    """The press with some words changed."""
    text = PRESS
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


# What is written in place of what; line and column of the refusal; what it says.
REFUSED = {
    # YAML
    "colon in a title": ("Four-bar press", "Press: four-bar", 2, 8, 'in quotes, title: "Press: four-bar"'),
    "curly quotation marks": ("Four-bar press", "“Press: 1”", 2, 8, "write straight ones"),
    "a colon of another keyboard": (
        "lengths: {",
        "lengths： {",
        5,
        8,
        "the wide '：' is a letter to YAML; write ':'",
    ),
    "a colon before a list": ("joints:\n", "joints：\n", 8, 7, "write ':'"),
    "tab": ("  T12", "\tT12", 15, 1, "indented with spaces only"),
    "decimal comma": ("BC: 3.5", "BC: 3,5", 5, 22, "write a decimal point, 3.5"),
    "decimal comma and unit": ("BC: 3.5", "BC: 3,5 in", 5, 22, "write a decimal point, 3.5 in"),
    "decimal commas of a place": ("[3.5, 2.4]", "[3,5, 2,4]", 7, 11, "with decimal points, [3.5, 2.4]"),
    "a decimal comma in one coordinate": ("[4, 0]", "[4,5, 0]", 4, 24, "with a decimal point, [4.5, 0]"),
    "a decimal comma beside the unknown": (
        "[4, 0]",
        "[unknown, 0,5]",
        4,
        24,
        "with a decimal point, [unknown, 0.5]",
    ),
    "a decimal comma and a semicolon": ("[4, 0]", "[4,5; 0]", 4, 24, "a comma between, [4.5, 0]"),
    "a decimal comma in near": ("[3.5, 2.4]", "[3,5, 2]", 7, 11, "with a decimal point, [3.5, 2]"),
    "three numbers": ("[4, 0]", "[4, 5, 0]", 4, 24, "two coordinates, as in [3, 0.5]"),
    "round brackets": ("[4, 0]", "(4, 0)", 4, 24, "write square brackets, [4, 0]"),
    "no space after a colon": ("AB: 60", "AB:60", 6, 10, "write a space after the colon"),
    "nothing after a colon": ("force: 100,", "force:,", 14, 12, "no value between the colon and the comma"),
    "no comma between names": ("[1, 2]", "[1 2]", 9, 12, "with a comma between, 1, 2"),
    "open bracket": ("[1, 2]", "[1, 2", 9, 23, "not closed"),
    "a lost dash": ("  - {pin: [2, 3]", "  {pin: [2, 3]", 10, 3, "starts with a dash"),
    "a comment of another language": (
        "CDE: 0}",
        "CDE: 0} // deg",
        6,
        26,
        "a comment starts with '#', not with '//'",
    ),
    "a range without braces": (
        "AB: 60,",
        "AB: unknown: [0, 90],",
        6,
        14,
        "stands in braces, AB: {unknown: [0, 90]}",
    ),
    "an equals sign in brackets": ("AB: 1,", "AB = 1,", 5, 11, "write a colon in place of '=', AB: 1"),
    "nothing before a comma": ("[4, 0]", "[, 0]", 4, 25, "a value is missing before this comma"),
    "a no-break space": ("AB: 60", "AB:\xa060", 6, 10, "a space after the colon, an ordinary one"),
    "a quotient": ("AB: 1,", "AB: 1/2,", 5, 15, "write the quotient as one decimal number"),
    "a point and no digit": ("AB: 1,", "AB: .,", 5, 15, "'.' does not start with a number"),
    "a mass at a point of another link": (
        "loads:",
        "links: {3: {mass: 2 kg, centre: E}}\nloads:",
        13,
        33,
        "on link 3 at E, which is a point of link 4: name a point of link 3, or 'points: [E]' if link 3",
    ),
    "an equals sign in a load": (
        "force: 100",
        "force = 100",
        14,
        7,
        "write a colon in place of '=', force: 100",
    ),
    "an equals sign without spaces": (
        "{force: 100",
        "{force=100",
        14,
        7,
        "write a colon in place of '=', force: 100",
    ),
    "an equals sign in a joint": (
        "{pin: [1, 2], at: A}",
        "{pin: [1, 2], at=A}",
        9,
        19,
        "in place of '=', at: A",
    ),
    "a full-width colon": ("force: 100", "force：100", 14, 7, "write a colon in place of '：', force: 100"),
    "full-width digits": ("force: 100", "force: １００", 14, 14, "write 100"),
    "full-width minus and digits": ("angle: 180", "angle: －９０.5", 14, 42, "write -90.5"),
    "a line indented with no-break spaces": ("  T12", "\xa0\xa0T12", 15, 1, "starts with a no-break space"),
    "a no-break space behind a key": (
        "force: 100",
        "force\xa0: 100",
        14,
        7,
        "write 'force' without the no-break space",
    ),
    "radii at the top": ("loads:", "radii: {A: 1}\nloads:", 13, 1, "it stands in a joint: roll, belt, rope"),
    "wraps at the top": ("loads:", "wraps: {A: cw}\nloads:", 13, 1, "it stands in a joint: rope"),
    "a load at the top": ("loads:", "torque: unknown\nloads:", 13, 1, "it stands in a load: torque"),
    "teeth at the top": ("loads:", "teeth: [20, 30]\nloads:", 13, 1, "it stands in a joint: gears"),
    "a link of no joint": (
        "link: 2}",
        "link: 7}",
        15,
        32,
        "no joint has a link '7'; the links are 1, 2, 3 and 4",
    ),
    "a truth for a link": ("link: 2}", "link: on}", 15, 32, "the links are 1, 2, 3 and 4"),
    "joules of a torque": ("unknown", "25 J", 15, 17, "did you mean 'N*m'?"),
    "joules of a unit of a torque": ("force: lbf}", "force: lbf, torque: kJ}", 3, 41, "did you mean 'kN*m'?"),
    "like another load": ("force: 100", "force: like T12", 14, 14, "write {like: T12}"),
    "an empty load": ("torque: unknown", "torque: ~", 15, 17, "write 'unknown' for what is to find"),
    "a line load at a point": (
        "force: 100, link: 4, at: E",
        "distributed: 3 lbf/in, from: C, to: D, link: 4, at: E",
        14,
        55,
        "load P is a distributed load, which has no 'at'",
    ),
    "a spring with a direction": (
        "force: 100, link: 4",
        "spring: 3 lbf/in, free: 1, to: A, link: 4",
        14,
        57,
        "load P is a spring, which has no 'angle'",
    ),
    "a rope of one point": (
        "  - {pin: [2, 3]",
        "  - {rope: [A], on: [1, 2, 3]}\n  - {pin: [2, 3]",
        10,
        12,
        "needs two points or more",
    ),
    "a rope of too few links": (
        "  - {pin: [2, 3]",
        "  - {rope: [A, B, C], on: [1]}\n  - {pin: [2, 3]",
        10,
        27,
        "names 1 link: give one",
    ),
    "a decimal comma of a tolerance": (
        "loads:",
        "tolerance: 1,5%\nloads:",
        13,
        12,
        "write a decimal point, 1.5%",
    ),
    "a decimal comma of a width": (
        "loads:",
        "tolerance: 0,5 lbf\nloads:",
        13,
        12,
        "a decimal point, 0.5 lbf",
    ),
    "a tolerance in no unit": (
        "loads:",
        "tolerance: 0.5 furlong\nloads:",
        13,
        12,
        "there is no unit 'furlong'",
    ),
    "figures by another word": (
        "loads:",
        "tolerance: 3 sig\nloads:",
        13,
        12,
        "not a tolerance: write 1%, 3 sf",
    ),
    "half a figure": ("loads:", "tolerance: 3.5 sf\nloads:", 13, 12, "not a tolerance: write 1%, 3 sf"),
    "a sense by a letter off": ("loads:", "expect: {T12: 33.8 cww}\nloads:", 13, 15, "did you mean 'cw'?"),
    "a sense misspelt": ("loads:", "expect: {T12: 34 clockwize}\nloads:", 13, 15, "mean 'clockwise'?"),
    "a sense cut short": ("loads:", "expect: {T12: 34 lbf*in cc}\nloads:", 13, 15, "did you mean 'ccw'?"),
    "a tolerance in a unit of other capitals": (
        "loads:",
        "tolerance: 0.5 n\nloads:",
        13,
        12,
        "did you mean 'N'?",
    ),
    "a width of a mapping in no unit": (
        "loads:",
        "tolerance: {absolute: 2 feets}\nloads:",
        13,
        12,
        "there is no unit 'feets'",
    ),
    "published: omega": (
        "loads:",
        "expect: {omega4/omega2: 0.2}\nloads:",
        13,
        10,
        "did you mean 'w4/w2'?",
    ),
    "published: a Greek omega": (
        "loads:",
        "expect: {ω4: 0.2}\nloads:",
        13,
        10,
        "did you mean 'w4'?",
    ),
    "published: revolutions of links": (
        "loads:",
        "expect: {n4/n2: 0.2}\nloads:",
        13,
        10,
        "did you mean 'w4/w2'?",
    ),
    "published: a space in a centre": (
        "loads:",
        "expect: {I 24: [1, 2]}\nloads:",
        13,
        10,
        "did you mean 'I24'?",
    ),
    "published: an underscore in a centre": (
        "loads:",
        "expect: {I_24: [1, 2]}\nloads:",
        13,
        10,
        "did you mean 'I24'?",
    ),
    "published: a velocity without its link": (
        "loads:",
        "expect: {v E: 3}\nloads:",
        13,
        10,
        "write 'v E on' and its link",
    ),
    "published: a velocity in one word": (
        "loads:",
        "expect: {vE: 3}\nloads:",
        13,
        10,
        "write 'v E on' and its link",
    ),
    "published: a small letter of a reaction": (
        "loads:",
        "expect: {f34: 3}\nloads:",
        13,
        10,
        "did you mean 'F34'?",
    ),
    "an unseen character in a link": (
        "link: 4,",
        "link: 4\u200b,",
        14,
        26,
        "U+200B, which nobody sees, stands here",
    ),
    "an unseen character in a key": ("force: 100", "\u2060force: 100", 14, 7, "U+2060, which nobody sees"),
    "an unseen character in a number": ("BC: 3.5", "BC: 3.\u00ad5", 5, 24, "U+00AD, which nobody sees"),
    "an unseen character in a section": ("lengths:", "lengths\u200e:", 5, 8, "U+200E, which nobody sees"),
    "an unseen character in a list": ("[3, 4]", "[3, \u200c4]", 11, 15, "U+200C, which nobody sees"),
    "a Cyrillic point": ("at: E", "at: Е", 14, 32, "type 'E' anew, in Latin letters"),
    "a Greek point": ("pin: [1, 2], at: A", "pin: [1, 2], at: Α", 9, 23, "type 'A' anew, in Latin letters"),
    "a Cyrillic key": ("at: E", "аt: E", 14, 28, "type 'at' anew, in Latin letters"),
    "a Cyrillic section": ("points", "рoints", 4, 1, "type 'points' anew, in Latin letters"),
    "Arabic digits": ("force: 100", "force: ١٠٠", 14, 14, "write 100"),
    "feet and inches": ("BC: 3.5", "BC: 1'2\"", 5, 22, "feet and inches as one number with one unit"),
    # the unknown
    "question mark in brackets": ("[4, 0]", "[?, 0]", 4, 25, "write 'unknown' for what is to find"),
    "question mark in quotes": ("unknown", '"?"', 15, 17, "write 'unknown' for what is to find"),
    "question mark": ("unknown", "?", 15, 17, "write 'unknown' for what is to find"),
    "question mark for a length": ("BC: 3.5", 'BC: "?"', 5, 22, "'unknown' for what is to find"),
    "question mark for an angle": ("AB: 60", "AB: '?'", 6, 14, "'unknown' for what is to find"),
    "a letter for an angle": ("AB: 60", "AB: theta", 6, 14, "'unknown' for what is to find"),
    "question mark for a direction": ("angle: 180", "angle: '?'", 14, 42, "'force: [unknown, unknown]'"),
    "find": ("unknown", "find", 15, 17, "write 'unknown' for what is to find"),
    "capital": ("unknown", "Unknown", 15, 17, "did you mean 'unknown'?"),
    "unknown in brackets": ("unknown", "[unknown]", 15, 17, "without brackets, torque: unknown"),
    "a pen's slip": ("unknown", "unkown", 15, 17, "did you mean 'unknown'?"),
    # other words
    "inertia": ("loads:", "inertia: {3: {mass: 2 kg, centre: B}}\nloads:", 13, 1, "did you mean 'links'?"),
    "two frames": (
        "joints:",
        "ground: 1, 4\njoints:",
        8,
        9,
        "with a comma between, 1, 4, these are two names",
    ),
    "the word centroid": ("at: E", "at: centroid", 14, 32, "'G: {centroid: [A, B]}' under 'points'"),
    "moment": ("torque:", "moment:", 15, 9, "did you mean 'torque'?"),
    "the letter M": ("torque:", "M:", 15, 9, "did you mean 'torque'?"),
    "a name of two words": ("P: {", "Piston force: {", 14, 3, "has no spaces: write Piston_force"),
    "a link of two words": (
        "pin: [3, 4]",
        "pin: [3, rocker arm]",
        11,
        15,
        "write rocker_arm; where rocker and arm are two names, a comma between",
    ),
    "direction": ("angle:", "direction:", 14, 35, "load P has no key 'direction'; did you mean 'angle'?"),
    "body": ("link: 4", "body: 4", 14, 19, "did you mean 'link'?"),
    "links of a load": ("link: 4", "links: 4", 14, 19, "did you mean 'link'?"),
    "point": ("at: E", "point: E", 14, 28, "did you mean 'at'?"),
    "revolute": ("pin: [1, 2]", "revolute: [1, 2]", 9, 6, "did you mean 'pin'?"),
    "hinge": ("pin: [1, 2]", "hinge: [1, 2]", 9, 6, "take a joint of the plane, a pin"),
    "prismatic": ("pin: [1, 2]", "prismatic: [1, 2]", 9, 6, "did you mean 'slide'?"),
    "a chain": ("pin: [1, 2]", "chain: [1, 2]", 9, 6, "did you mean 'belt'?"),
    "radii of gears": (
        "{pin: [2, 3], at: B}",
        "{gears: [2, 3], radii: [20, 30]}",
        10,
        21,
        "did you mean 'teeth'?",
    ),
    "a published value with its room": (
        "loads:",
        "expect: {T12: 33.8 ± 0.1}\nloads:",
        13,
        15,
        "under `expect` its room stands beside it",
    ),
    "an atmosphere": ("{force: 100", "{pressure: 8 atm, bore: 2", 14, 17, "1 atm is 1.01325 bar"),
    "type of a joint": (
        "{pin: [1, 2]",
        "{type: revolute, links: [1, 2]",
        9,
        6,
        "named by its kind; write {pin: [1, 2], at: A}",
    ),
    "links of a joint": (
        "{pin: [1, 2], at: A}",
        "{pin: A, links: [1, 2]}",
        9,
        5,
        "write {pin: [1, 2], at: A}",
    ),
    "forces": ("loads:", "forces:", 13, 1, "did you mean 'loads'?"),
    "frame as a section": ("title:", "frame: 1\ntitle:", 2, 1, "did you mean 'ground'?"),
    "acceleration cut short": (
        "loads:",
        "motion: {link: 2, speed: 1, accel: 2}\nloads:",
        13,
        29,
        "did you mean 'acceleration'?",
    ),
    "a centre as Americans write it": (
        "loads:",
        "links: {2: {mass: 1 kg, center: B}}\nloads:",
        13,
        25,
        "did you mean 'centre'?",
    ),
    "clockwise": ("link: 2}", "link: 2, turns: clockwise}", 15, 42, "did you mean 'cw'?"),
    # directions
    "up": ("angle: 180", "angle: up", 14, 42, "write 90 for 'up'"),
    "toward the left": ("angle: 180", "toward: left", 14, 43, "write 'angle: 180'"),
    "angle and toward": ("angle: 180", "angle: 180, toward: A", 14, 47, "give one of them"),
    # points and links
    "small letter": ("at: E", "at: e", 14, 32, "did you mean 'E'?"),
    "a link for a point": ("at: E", "at: 4", 14, 32, "4 is a link, and a point of it is wanted here"),
    "a middle": ("at: E", "at: M", 14, 32, "the middle of two points is 'M: {centroid: [A, B]}'"),
    "a point without data": ("at: E", "at: F", 14, 32, "no coordinates, length, angle or guide"),
    "a link that no joint has": ("link: 4", "link: 5", 14, 25, "no joint has a link '5'"),
    "a load on the coupler": ("link: 4, at: E", "link: 3, at: E", 14, 25, "E, which is a point of link 4"),
    "a load on the frame": ("link: 4, at: E", "link: 1, at: E", 14, 25, "write 'link: 4'"),
    "a spring to a moving point": (
        "  T12",
        "  S: {spring: 5, free: 1, link: 2, at: B, to: E}\n  T12",
        15,
        47,
        "fixed to link 1 at E, which is a point of link 4: write 'against: 4'",
    ),
    "the speed of a point of another link": (
        "loads:",
        "motion: {point: E, link: 3, speed: 1, angle: 90}\nloads:",
        13,
        26,
        "E, which is a point of link 4",
    ),
    # quantities
    "kilograms of force": ("force: 100", "force: 100 kg", 14, 14, "write 'mass' in place of the force"),
    "a mass without a unit": (
        "force: 100, link: 4, at: E, angle: 180",
        "mass: 100, link: 4, at: E",
        14,
        13,
        "a mass carries its unit",
    ),
    "a torque in feet": (
        "torque: unknown",
        "torque: 5 ft",
        15,
        17,
        "'ft' is a length, but a torque is wanted",
    ),
    "value and unit": (
        "force: 100",
        "force: {value: 100, unit: lbf}",
        14,
        14,
        "without braces, 'force: 100 lbf'",
    ),
    "braces": ("force: 100", "force: {100}", 14, 14, "without braces, 'force: 100'"),
    "a negative length": ("AB: 1,", "AB: -1,", 5, 15, "the length AB should not be negative"),
    "imperial": ("{length: in, force: lbf}", "imperial", 3, 8, "as in {length: in, force: lbf}"),
    "a percentage": ("at: A}", "at: A, mu: 20%, radius: 1}", 9, 30, "write the number itself, 0.2 for 20 %"),
    "a sense beside a number": ("torque: unknown", "torque: 50 cw", 15, 17, "'turns: cw'"),
    "angles in radians": ("force: lbf}", "force: lbf, angle: rad}", 3, 33, "carry their unit, as in 1.2 rad"),
    "a share of pi": ("AB: 60", "AB: pi/3", 6, 14, "an angle is in degrees, 60"),
    "letters for digits": ("DE: 1.5", "DE: l.O", 5, 40, "write digits, 1.0"),
    "thousands with a comma": (
        "force: 100",
        "force: 1,000",
        14,
        14,
        "or for thousands no comma, 1000",
    ),
    "thousands as in Germany": (
        "DE: 1.5",
        "DE: 1.500,5",
        5,
        40,
        "point and no other, 1500.5",
    ),
    "thousands and a point": ("force: 100", "force: 1,000.5", 14, 14, "write no comma, 1000.5"),
    "a mass for a weight": (
        "force: 100, link: 4, at: E, angle: 180",
        "weight: 100 kg, link: 4, at: E",
        14,
        15,
        "write 'mass' in place of the force",
    ),
    "a spring's force": (
        "force: 100, link: 4, at: E, angle: 180",
        "spring: 10 N, free: 1, to: A, link: 4, at: E",
        14,
        15,
        "such as 'lbf/in'",
    ),
    # more YAML
    "a list of angles": ("{AB: 60, CDE: 0}", "[60, 0]", 6, 9, "as in {AB: 60}; take the dashes or brackets"),
    "a load in a list": (
        "{force: 100, link: 4, at: E, angle: 180}",
        "[{force: 100}]",
        14,
        6,
        "list away",
    ),
    "a comment of C": ("title:", "// my press\ntitle:", 2, 1, "a comment starts with '#', not with '//'"),
    "an equals sign": ("title: ", "title = ", 2, 1, "in place of '=', title: Four-bar press"),
    "a comma at the end": ("angle: 180}", "angle: 180},", 14, 46, "take this comma away"),
    "a semicolon": ("[0, 0]", "[0; 0]", 4, 13, "with a comma between, [0, 0]"),
    "only a space": ("[4, 0]", "[4 0]", 4, 24, "with a comma between, [4, 0]"),
    "coordinates without brackets": ("[4, 0]", "4, 0", 4, 24, "stand in square brackets, [4, 0]"),
    "revolutions by minutes alone": (
        "title:",
        "motion: {link: 2, speed: 1450 1/min}\ntitle:",
        2,
        26,
        "write 'rpm', 'rev/min' or 'rev/s' for revolutions",
    ),
    "revolutions in German": ("title:", "motion: {link: 2, speed: 9 U/min}\ntitle:", 2, 26, "mean 'rev'?"),
    "coordinates without brackets or space": ("[4, 0]", "4,0", 4, 24, "square brackets, [4, 0]"),
    "a pair of decimals without brackets": (
        "[3.5, 2.4]",
        "3.5,2.4",
        7,
        11,
        "; write square brackets, [3.5, 2.4]",
    ),
    "a pair without brackets that may be thousands": ("[4, 0]", "4,000", 4, 24, "square brackets, [4, 000]"),
    "the links of a pin without brackets": ("[1, 2]", "1,2", 9, 11, "are two, square brackets, [1, 2]"),
    "coordinates by name": ("[4, 0]", "{x: 4, y: 0}", 4, 24, "by its two numbers alone, D: [4, 0]"),
    "a key twice": ("CD: 2.5", "AB: 2.5", 5, 27, "'AB' is given twice, the first time in line 5, column 11"),
    "no version": ("icsolve: 1\n", "", 1, 1, "it has no 'icsolve: 1' at its top"),
    "a capital section": ("points:", "Points:", 4, 1, "did you mean 'points'?"),
    # more points and links
    "a letter of another alphabet": (
        "{AB: 1",
        "{\u0410B: 1",
        5,
        11,
        "of two alphabets that look alike",
    ),
    "a direction by a point": ("angle: 180", "angle: A", 14, 42, "is 'toward: A' in place of 'angle'"),
    "a link by a zero before": ("link: 4", "link: 04", 14, 25, "did you mean '4'?"),
    "a pin at coordinates": ("at: A}", "at: [0, 0]}", 9, 23, "coordinates stand in 'points'"),
    "a pin without a place": (", at: A}", "}", 9, 5, "'at': the point about which its links turn"),
    "a pin of one link": ("[1, 2]", "[1]", 9, 11, "a pin joins two links; only 1 is named"),
    "a pin of a link and itself": (
        "[1, 2]",
        "[2, 2]",
        9,
        11,
        "joins different links; 2 is named twice",
    ),
    "a pin of a pair in one word": ("[1, 2]", "1-2", 9, 11, "should be a list, as in {pin: [1, 2]}"),
    "a load without a link": ("link: 4, ", "", 14, 6, "needs 'link': the link that it acts on"),
    "a load without a direction": (
        ", angle: 180",
        "",
        14,
        6,
        "its direction: angle, toward, away or slope",
    ),
    "components and an angle": (
        "force: 100",
        "force: [100, 0]",
        14,
        40,
        "by components, so it takes no",
    ),
    "near of no point": ("near: {C", "near: {X", 7, 8, "point X is named here, but nothing gives it"),
    "a link by its two points for a point": (
        "link: 4, at: E",
        "link: 4, at: CD",
        14,
        32,
        "CD reads as two points",
    ),
    "a letter struck twice": ("link: 4, at: E", "link: 4, at: EE", 14, 32, "did you mean 'E'?"),
    "a corner of one arm": (
        "{force: 100, link: 4, at: E, angle: 180}",
        "{spring: 20, corner: DCD, free: 90, link: 4, against: 3}",
        14,
        27,
        "'D-C-D' names one arm twice, and has no angle",
    ),
    "a torsion spring without its corner": (
        "{force: 100, link: 4, at: E, angle: 180}",
        "{spring: 20 lbf*in/rad, free: 90, link: 4, at: E, to: A}",
        14,
        15,
        "a torsion spring has its angle, 'corner', in place of 'at' and 'to'",
    ),
    "friction without a radius": ("at: A}", "at: A, mu: 0.2}", 9, 26, "needs 'radius', the pin's own"),
    "a load by a letter off": ("title:", "expect: {T21: 33}\ntitle:", 2, 10, "did you mean 'T12'?"),
    "degrees and minutes": ("AB: 60", "AB: 60°30'", 6, 14, "write minutes as decimals of the degree"),
    "a range of an angle": ("AB: 60", "AB: 0-360", 6, 14, "one value is wanted here; a range"),
    "twice another length": ("BC: 3.5", "BC: 2*AB", 5, 22, "write the number that it comes to"),
    "a root": ("BC: 3.5", "BC: sqrt(2)", 5, 22, "write the number that it comes to"),
    "the stroke of an inch": ("BC: 3.5", 'BC: 3.5"', 5, 22, "write 'in' for \""),
    "the strokes of a foot": ("BC: 3.5", "BC: 3.5'", 5, 22, "write 'ft' for '"),
    "the load's own letter": ("torque: unknown", "torque: T", 15, 17, "or 'unknown' for what is to find"),
    "a link by its points": ("link: 4", "link: CD", 14, 25, "it names two points, and links are called"),
    "a support": ("{pin: [4, 1]", "{support: [4, 1]", 12, 6, "did you mean 'pin'?"),
    "a guide by one point": (
        "{pin: [4, 1], at: D}",
        "{slide: [4, 1], at: D, along: A}",
        12,
        35,
        "two points of the guide stand in brackets, as in [B, A]",
    ),
    "a mass alone": ("loads:", "links: {2: 5 kg}\nloads:", 13, 12, "{2: {mass: 5 kg, centre: G}}"),
    "degree word and bracket": ("AB: 60", "AB: 60 (given)", 6, 14, "there is no unit 'given'"),
    "near without coordinates": ("{C: [3.5, 2.4]}", "{C: up}", 7, 11, "two coordinates, as in [3.5, 2.4]"),
    "near of no name": ("{C: [3.5, 2.4]}", "[3.5, 2.4]", 7, 7, "as in {C: [3.5, 2.4]}; take the dashes"),
    "three coordinates": ("D: [4, 0]", "D: [4, 0, 0]", 4, 24, "two coordinates, as in [3, 0.5]"),
    "an angle of one point": ("AB: 60", "A: 60", 6, 10, "should name two or three points"),
    "a length backwards again": ("CD: 2.5", "CB: 3.5", 5, 27, "the first time as 'BC' in line 5, column 18"),
    "a mass as a unit of force": ("force: lbf}", "force: kg}", 3, 28, "'kg' is a mass, not a force"),
    "a unit of mass": (
        "force: lbf}",
        "force: lbf, mass: kg}",
        3,
        33,
        "carry their unit, as in 1.2 rad or 3 kg",
    ),
    "unknown misspelt": ("torque: unknown", "torque: unkown", 15, 17, "did you mean 'unknown'?"),
    "nothing for unknown": ("torque: unknown", "torque: null", 15, 17, "but there is no value"),
    "solve for unknown": ("torque: unknown", "torque: solve", 15, 17, "torque: unknown"),
    "a stiffness for a torque": ("torque: unknown", "torque: 5 N/m", 15, 17, "such as 'lbf*in'"),
    "a sense in capitals": ("link: 2}", "link: 2, turns: CW}", 15, 42, "did you mean 'cw'?"),
    "a direction by an axis": ("angle: 180", "angle: -x", 14, 42, "write 180 for '-x'"),
    "toward coordinates": ("angle: 180", "toward: [0, 0]", 14, 43, "coordinates stand in 'points'"),
    "toward a link": ("angle: 180", "toward: 2", 14, 43, "2 is a link, and a point of it is wanted here"),
    "a slope by a quotient": ("angle: 180", "slope: 0.5", 14, 42, "by run and rise, as in [-3, 4]"),
    "a load on two links": ("link: 4", "link: [3, 4]", 14, 25, "should be one name"),
    "a link with a decimal": ("link: 4", "link: 4.0", 14, 25, "is not a name"),
    "a pin at two points": ("at: C}", "at: [C, E]}", 11, 23, "should be a point's name"),
    "a kind in other words": ("{pin: [4, 1], at: D}", "{fixed: D}", 12, 6, "did you mean 'weld'?"),
    "a roller": ("{pin: [4, 1]", "{roller: [4, 1]", 12, 6, "did you mean 'slot'?"),
    "a cable": ("torque: unknown", "cable: unknown", 15, 9, "did you mean 'force'?"),
    "a slide of no direction": (
        "{pin: [4, 1]",
        "{slide: [4, 1]",
        12,
        5,
        "needs 'along': a direction in degrees",
    ),
    "a slide along an axis": (
        "at: D}",
        "at: D}\n  - {slide: [4, 1], at: D, along: x}",
        13,
        35,
        "write 0 for 'x'",
    ),
    "a load in words": (
        "{force: 100, link: 4, at: E, angle: 180}",
        "100 lbf at E",
        14,
        6,
        "as in {force: 100, link: 4, at: E, angle: 180}",
    ),
    "a weight's direction": (
        "force: 100, link: 4, at: E, angle: 180",
        "weight: 100, link: 4, at: E, angle: 270",
        14,
        36,
        "is a weight, which has no 'angle'; it takes link, at. Weights pull as gravity does: along another "
        "line write 'force' in place of 'weight'",
    ),
    "a mass's direction": (
        "force: 100, link: 4, at: E, angle: 180",
        "mass: 10 kg, link: 4, at: E, toward: A",
        14,
        36,
        "along another line write 'force' in place of 'mass', the mass times g",
    ),
    "a mass of other books": (
        "loads:",
        "links: {2: {mass: 0.02 blob, centre: B}}\nloads:",
        13,
        19,
        "there is no unit 'blob'; did you mean 'lbf*s^2/in'?",
    ),
    "a guide as a pair": (
        "{pin: [4, 1], at: D}",
        "{slide: [4, 1], at: D, along: A-B'}",
        12,
        35,
        "two points of the guide stand in brackets, as in [A, B']",
    ),
    "a spring of no length": (
        "force: 100, link: 4, at: E, angle: 180",
        "spring: 10, link: 4, at: E, to: A",
        14,
        6,
        "needs 'free': its length without load",
    ),
    "a torque at a point": (
        "torque: unknown,",
        "torque: unknown, at: A,",
        15,
        26,
        "is a torque, which has no 'at'; it takes link, turns",
    ),
    "omega": ("loads:", "motion: {link: 2, omega: 10}\nloads:", 13, 19, "did you mean 'speed'?"),
    "a motion of a link alone": ("loads:", "motion: 2\nloads:", 13, 9, "as in {link: 2, speed: 12 rad/s}"),
    "gravity as a vector": ("loads:", "gravity: [0, -9.81]\nloads:", 13, 10, "not a list or mapping"),
    "friction with a comma": ("at: A}", "at: A, mu: 0,2, radius: 1}", 9, 30, "write a decimal point, 0.2"),
    "friction by its word": ("at: A}", "at: A, friction: 0.2, radius: 1}", 9, 26, "did you mean 'mu'?"),
    "an expected value as a line": ("loads:", "expect: T12 = 33.8\nloads:", 13, 9, "as in {T12: 29.67 ccw}"),
    "links in a list": ("loads:", "links: [2, 3]\nloads:", 13, 8, "as in {3: [G, H]} or {3: {mass:"),
    "another version": ("icsolve: 1", "icsolve: 2", 1, 10, "this program reads 'icsolve: 1'"),
    "a title twice": ("units:", "title: x\nunits:", 3, 1, "given twice, the first time in line 2, column 1"),
    "a sign of YAML in a title": ("Four-bar press", "@home", 2, 8, "put the text in quotes"),
    "a name of two loads": ("  P: {", "  T12: {", 15, 3, "given twice, the first time in line 14, column 3"),
    # brackets, dashes, quotation marks, spaces
    "points in brackets": ("at: E", "at: [C, D]", 14, 32, "should be a point, or two coordinates [x, y]"),
    "a place without brackets": ("at: E", "at: 3.5, 2.4", 14, 32, "in square brackets, [3.5, 2.4]"),
    "loads that are not indented": (
        "loads:\n  P: {force: 100, link: 4, at: E, angle: 180}\n  T12",
        "loads:\nP: {force: 100, link: 4, at: E, angle: 180}\nT12",
        14,
        1,
        "indent 'P' by two more spaces: it belongs under 'loads'",
    ),
    "keys that are not indented": (
        "P: {force: 100, link: 4, at: E, angle: 180}",
        "P:\n  force: 100\n  link: 4\n  at: E\n  angle: 180",
        15,
        3,
        "indent 'force' by two more spaces: it belongs under 'P'",
    ),
    "all indented": ("title:", "  title:", 2, 3, "this line is indented otherwise"),
    "points as equations": ("{A: [0, 0], D: [4, 0]}", "\n  A = [0, 0]\n  D = [4, 0]", 5, 3, "A: [0, 0]"),
    "points as functions": ("{A: [0, 0], D: [4, 0]}", "\n  A(0, 0)\n  D(4, 0)", 5, 3, "name, A: [0, 0]"),
    "a unit behind a bracket": ("[4, 0]", "[4, 0] in", 4, 31, "a unit goes with each number"),
    "a semicolon and commas": ("[4, 0]", "[4,0; 0,0]", 4, 24, "[4.0, 0.0]"),
    "no space before a bracket": ("D: [", "D:[", 4, 22, "write a space after the colon"),
    "a capital": ("icsolve: 1", "Icsolve: 1", 1, 1, "did you mean 'icsolve'?"),
    "out of a web page": ("icsolve: 1", "```yaml\nicsolve: 1", 1, 1, "take the lines with ``` away"),
    "an apostrophe in a text": ("Four-bar press", "'Watt's press'", 2, 14, 'put it between " and "'),
    "a number in brackets": ("Four-bar", "[3.4]", 2, 14, "starts with a bracket stands in quotes"),
    "a dash in a title": ("Four-bar", "- Four-bar", 2, 8, "put the text in quotes"),
    "a title of two lines": ("press", "press\nof mine", 3, 1, "this line has no colon"),
    "a joint in round brackets": ("{pin: [1, 2], at: A}", "(pin: [1, 2], at: A)", 9, 17, "write braces"),
    "coordinates in braces": ("[4, 0]", "{4, 0}", 4, 24, "write square brackets, D: [4, 0]"),
    "links without brackets": ("pin: [1, 2]", "pin: 1, 2", 9, 11, "in square brackets, [1, 2]"),
    "a link by its word": ("[1, 2]", "[1, link 2]", 9, 15, "write the name alone, 2"),
    "no space after a dash": ("- {pin: [1", "-{pin: [1", 9, 3, "write a space after the dash"),
    "a joint below another section": (
        "loads:",
        "ground: 1\n  - {weld: [1, 5]}\nloads:",
        14,
        3,
        "this item of a list stands under 'ground', which has a value: put it with its list",
    ),
    "round brackets about three": (
        "{pin: [2, 3], at: B}",
        "{pin: (2, 3, 5), at: B}",
        10,
        11,
        "write square brackets, [2, 3, 5]",
    ),
    "a semicolon between links": ("[2, 3]", "[2; 3]", 10, 12, "with commas between, 2, 3"),
    "joints indented under links": ("joints:", "links:\n  4: [E]\n  joints:", 10, 3, "'links' ends above it"),
    "the first line indented": ("icsolve: 1", "  icsolve: 1", 1, 1, "take the spaces before it away"),
    "the last dash lost": ("  - {pin: [4, 1]", "  {pin: [4, 1]", 12, 3, "starts with a dash"),
    "no colon, and one in the comment": (
        "title: Four-bar press",
        "title Press # in: a book",
        2,
        1,
        "no colon",
    ),
    "no colon in an entry": ("at: E", "at E", 14, 28, "write a colon after 'at', at: E"),
    "no value behind a key of two words": (
        "loads:",
        "expect: {v C:, w4/w2: 0.34}\nloads:",
        13,
        13,
        "no value between the colon and the comma",
    ),
    "no colon before a number": ("AB: 1", "AB 1", 5, 11, "write a colon after 'AB', AB: 1"),
    "a heading twice": ("joints:", "joints:\njoints:", 9, 1, "given twice, the first time in line 8"),
    "a section indented": (
        "points: {A: [0, 0], D: [4, 0]}\nlengths",
        "points:\n  A: [0, 0]\n  D: [4, 0]\n  lengths",
        7,
        3,
        "take the spaces before 'lengths' away: 'points' ends above it",
    ),
    "stars for dashes": ("- {pin: [1", "* {pin: [1", 9, 3, "starts with a dash, not with '*'"),
    "a star for the unknown": ("unknown", "*", 15, 17, "a value cannot start with '*'"),
    "a bracket too many": ("CDE: 0}", "CDE: 0}}", 6, 25, "this bracket closes none"),
    "no braces": ("{pin: [1, 2], at: A}", "pin: [1, 2], at: A", 9, 16, "stands in braces"),
    "no colon": ("lengths: {", "lengths {", 5, 9, "before this bracket, lengths: {"),
    "no colon and no bracket": ("joints:", "joints", 8, 1, "this line has no colon"),
    "semicolons": ("AB: 1,", "AB: 1;", 5, 16, "write a comma between entries"),
    "an arrow": ("AB: 1", "AB => 1", 5, 11, "in place of '=', AB: 1"),
    "a no-break space at the start": ("  P: {", "\xa0\xa0P: {", 14, 1, "starts with a no-break space"),
    # numbers and units, again
    "a unit of the unknown": ("unknown", "unknown lbf*in", 15, 17, "write 'unknown' alone"),
    "a letter for degrees": ("AB: 60", "AB: 60d", 6, 14, "did you mean 'deg'?"),
    "quotation marks of print": (
        "force: 100",
        "force: “2 kN”",
        14,
        14,
        "write 2 kN without these quotation marks",
    ),
    "a point for a normal": (
        "{pin: [4, 1], at: D}",
        "{contact: [4, 1], at: D, normal: O}",
        12,
        38,
        "the normal is a direction in degrees",
    ),
    "a dash for a minus": ("force: 100", "force: \u2013100", 14, 14, "write -100"),
    "a power of ten": ("force: 100", "force: 1x10^2", 14, 14, "with an e, 1e3 for 1*10^3"),
    "letters for zeros": ("force: 100", "force: 1OO", 14, 14, "not the letters O, l and I"),
    "a letter for a one": ("force: 100", "force: 1l0 N", 14, 14, "not the letters O, l and I"),
    "letters for zeros before a unit": ("BC: 3.5", "BC: 3OO mm", 5, 22, "not the letters O, l and I"),
    "a space in a number": ("force: 100", "force: 1 000", 14, 14, "without separators"),
    "a value": ("force: 100", "value: 100", 14, 7, "as in {force: 100} or {torque: 5}"),
    "components by name": ("force: 100", "Fx: 100", 14, 7, "{force: [30, -40]}"),
    "a letter for a kind": ("torque: unknown", "T: unknown", 15, 9, "did you mean 'torque'?"),
    "a link by a word in one": ("link: 4", "link: link4", 14, 25, "did you mean '4'?"),
    "a Greek letter": ("at: A}", "at: A, \u03bc: 0.2, radius: 1}", 9, 26, "did you mean 'mu'?"),
    "a sense in other words": ("link: 2}", "link: 2, turns: anti-clockwise}", 15, 42, "mean 'ccw'?"),
    "an unknown direction": ("angle: 180", "angle: unknown", 14, 42, "'force: [unknown, unknown]'"),
    "a sum": ("AB: 60", "AB: 90 + 30", 6, 14, "write the number that it comes to"),
    "two units": ("BC: 3.5", "BC: 3 ft 2 in", 5, 22, "with one number and one unit"),
    "a mixed fraction": ("BC: 3.5", "BC: 3-1/2 in", 5, 22, "write the fraction as decimals"),
    "about so much": ("BC: 3.5", "BC: ~3.5", 5, 22, "write 3.5"),
    "a variable that is not there": ("BC: 3.5", "BC: $L", 5, 22, "a number under 'variables'"),
    "a unit in brackets": ("DE: 1.5", "DE: 1.5 [in]", 5, 44, "behind its number without brackets"),
    "a unit with the name": ("AB: 1", "AB (in): 1", 5, 11, "write the name alone, AB"),
    "no colon in the first line": ("icsolve: 1", "icsolve 1", 1, 8, "after the key, icsolve: 1"),
    "like alone": ("force: 100,", "like: T12,", 14, 7, "in place of its number, as in {force: {like: P}}"),
    "gravity downward": ("title:", "gravity: -9.81\ntitle:", 2, 10, "given by its size"),
}


def test_a_text_in_round_brackets_takes_no_heading_below_it_in() -> None:
    case = icsolve.load(changed(("title: Four-bar press", "title: (draft\nsource:")))
    assert (case.title, case.source) == ("(draft", "")


@pytest.mark.parametrize("slip", REFUSED)
def test_a_slip_is_refused_where_it_stands_with_what_would_mend_it(slip: str) -> None:
    old, new, line, column, said = REFUSED[slip]
    with pytest.raises(CaseError) as refused:
        icsolve.load(changed((old, new)))
    assert len(refused.value.problems) == 1, "one slip, one message"
    problem = refused.value.problems[0]
    assert (problem.line, problem.column) == (line, column)
    assert said in problem.message


NUMBERED = (("[1, 2]", "[0, 1]"), ("[2, 3]", "[1, 2]"), ("[3, 4]", "[2, 3]"), ("[4, 1]", "[3, 0]"))
BY_ONE = (*NUMBERED, ("link: 4", "link: 3"), ("link: 2}", "link: 1}"))
"""The links from 0 on."""


@pytest.mark.parametrize("name", ["0", "frame", "Ground", "base", "fixed"])
def test_a_frame_by_its_name_alone_is_asked_for(name: str) -> None:
    text = changed(*((old, new.replace("0", name)) for old, new in BY_ONE))
    with pytest.raises(CaseError, match=f"write 'ground: {name}', or 'ground: 1'"):
        icsolve.load(text)
    case = icsolve.load(f"{text}ground: {name}\n")
    assert icsolve.solve(case).answers["T12"].value == pytest.approx(-33.7582, rel=1e-5)
    assert icsolve.load(f"{text}ground: 1\n").ground == "1"


def test_a_frame_by_its_name_without_a_link_1_is_named() -> None:
    with pytest.raises(CaseError, match="write 'ground: frame'"):
        icsolve.load(changed(("[1, 2]", "[frame, 2]"), ("[4, 1]", "[4, frame]")))


def test_a_link_that_is_welded_to_the_frame_may_bear_its_name() -> None:
    text = changed(("at: D}", "at: D}\n  - {weld: [1, base]}"))
    assert icsolve.solve(icsolve.load(text)).answers["T12"].sense == "cw"


def test_what_the_link_is_said_to_carry_is_believed() -> None:
    case = icsolve.load(
        changed(("link: 4, at: E", "link: 3, at: E"), ("joints:", "links: {3: [E]}\njoints:"))
    )
    assert icsolve.solve(case).answers["T12"].value == pytest.approx(-74.9533, rel=1e-5)


def test_the_free_end_of_an_arm_belongs_to_the_arm() -> None:
    """An angle to the link before it poses an arm, and fixes its end to that link no more than to itself."""
    arm = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 1}
angles: {AB: 30, ABC: 150}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  P: {weight: 10, link: 3, at: C}
  T2: {torque: unknown, link: 2}
  T3: {torque: unknown, link: 3, against: 2}
"""
    assert not icsolve.load(arm).noticed


# What poses a bar that is pinned to the frame at A, beside its length AB: points, lengths, angles, links,
# joints.
POSED_ARMS = {
    "an angle": ("", "", "AB: 30, ", "", ""),
    "a length from a point of the frame": (", S: [1, 2]", ", SB: 1.5", "", "links: {1: [S]}", ""),
    "a length from another pivot": (", S: [1, 2]", ", SB: 1.5", "", "", ", {pin: [1, 3], at: S}"),
    "a length from a block on a guide": (
        ", S: [1, 2]",
        ", SB: 1.5",
        "",
        "",
        ", {slide: [3, 1], at: S, along: 0}",
    ),
}


@pytest.mark.parametrize(("point", "place"), [("B", 1.0), ("G", 0.5), ("H", 0.25), ("K", 1.25)])
@pytest.mark.parametrize("posed", POSED_ARMS)
def test_what_is_fixed_to_the_end_of_an_arm_belongs_to_the_arm(posed: str, point: str, place: float) -> None:
    """As the end itself does: the middle of the arm, the middle of its half, and a point beyond its end."""
    points, lengths, angles, links, joints = POSED_ARMS[posed]
    arm = f"""\
icsolve: 1
points: {{A: [0, 0]{points}, G: {{centroid: [A, B]}}, H: {{centroid: [A, G]}}}}
lengths: {{AB: 1.2{lengths}, BK: 0.3}}
angles: {{{angles}ABK: 180}}
near: {{B: [1.1, 0.5]}}
{links}
joints: [{{pin: [1, 2], at: A}}{joints}]
loads:
  W: {{mass: 10 kg, link: 2, at: {point}}}
  T: {{torque: unknown, link: 2}}
"""
    case = icsolve.load(arm)
    assert not case.noticed
    answer = icsolve.solve(case)
    assert answer.answers["T"].value == pytest.approx(98.1 * place * answer.points["B"][0])


TIED = {
    "a length and a corner at the joint of both": ("", "BE: 1.5", "CBE: 20", ""),
    "the corner the other way round": ("", "BE: 1.5", "EBC: 20", ""),
    "two lengths": ("", "BE: 1.5, CE: 3", "", "E: [2, 3]"),
    "a length and the corner at its other end": ("", "CE: 1.5", "CBE: 20", "E: [2, 1]"),
    "a point in line with both joints": ("", "BE: 1.5", "CBE: 0", ""),
    "the midpoint": ("E: {centroid: [B, C]}", "", "", ""),
    "by way of another point": ("", "BE: 1.5, CF: 1, FE: 1", "CBE: 20, BCF: 20", "F: [2, 2]"),
}


@pytest.mark.parametrize("by", TIED)
def test_a_point_that_the_data_tie_to_one_link_is_loaded_on_that_link(by: str) -> None:
    """On the coupler, at whose ends cranks are pinned that have two points of their own: to a crank a length
    alone from their common joint ties nothing."""
    points, lengths, angles, near = (f", {part}" if part else "" for part in TIED[by])
    text = PRESS.replace("D: [4, 0]", f"D: [4, 0]{points}").replace(", DE: 1.5", lengths)
    text = text.replace(", CDE: 0", angles).replace("[3.5, 2.4]", f"[3.5, 2.4]{near}")
    assert icsolve.solve(icsolve.load(text.replace("link: 4, at: E", "link: 3, at: E"))).answers
    for link in (1, 2, 4):
        said = rf"14:25: load P acts on link {link} at E, which is a point of link 3: write 'link: 3'"
        with pytest.raises(CaseError, match=said):
            icsolve.load(text.replace("link: 4, at: E", f"link: {link}, at: E"))


@pytest.mark.parametrize("angle", ["DAE: 100", "AE: 100", "BAE: 40"])
def test_an_arm_of_a_crank_is_posed_by_its_angle_to_the_frame(angle: str) -> None:
    text = PRESS.replace(", DE: 1.5", ", AE: 1.5").replace("CDE: 0", angle)
    assert not icsolve.load(text.replace("link: 4, at: E", "link: 2, at: E")).noticed


# What is changed; the status ('' for an answer) and what message or notes say.
SCENES = {
    "points for links": (
        [("pin: [2, 3], at: B", "pin: [A, B], at: B")],
        "loose-link",
        "a joint names the links that it joins, and its point after `at`",
    ),
    "the pin at D left out": (
        [("  - {pin: [4, 1], at: D}\n", "")],
        "mobility",
        "one joint is missing: link 4 has a free end (its only joint is at C)",
    ),
    "the pin at C left out": (
        [("  - {pin: [3, 4], at: C}\n", "")],
        "mobility",
        "one joint is missing: links 3 and 4 have a free end",
    ),
    "the pin at A left out": (
        [("  - {pin: [1, 2], at: A}\n", "")],
        "mobility",
        "link 2 has a free end (its only joint is at B)",
    ),
    "a torque on a link of one joint": (
        [("at: D}", "at: D}\n  - {pin: [3, 5], at: C}"), ("link: 2}", "link: 5}")],
        "mobility",
        "link 5 has a free end (its only joint is at C)",
    ),
    "a link of one joint": (
        [("at: D}", "at: D}\n  - {pin: [3, 5], at: C}")],
        "",
        "link 5 has a free end (its only joint is at C)",
    ),
    "a joint's point of other links": (
        [("link: 4, at: E", "link: 4, at: B")],
        "",
        "at B, a joint of link 2 and link 3; if one of these is meant, write 'link: 2' or 'link: 3'",
    ),
    "a torsion spring on a link beside its corner": (
        [("  T12", "  S: {spring: 20 lbf*in/rad, corner: ABC, free: 90, link: 4, against: 2}\n  T12")],
        "",
        "load S acts on link 4 at B, a joint of link 2 and link 3",
    ),
    "a torsion spring against a link beside its corner": (
        [("  T12", "  S: {spring: 20 lbf*in/rad, corner: ABC, free: 90, link: 3}\n  T12")],
        "",
        "fixed to link 1 at B, a joint of link 2 and link 3; if one of these is meant, write 'against: 2'",
    ),
    "a mass at a joint of other links": (
        [("loads:", "links: {3: {mass: 2 kg, centre: A}}\nloads:")],
        "",
        "a mass is given on link 3 at A, a joint of link 1 and link 2; if a point of link 3 is meant",
    ),
    "a known torque on the frame": (
        [("  T12", "  M: {torque: 5, link: 1}\n  T12")],
        "",
        "load M acts on link 1, the frame, which never moves: it does no work",
    ),
    "friction in percent": (
        [("at: A}", "at: A, mu: 10, radius: 0.1}")],
        "",
        "joints.A.mu is 10: few surfaces that rub have more than 1; if percent are meant, write 0.1",
    ),
    "a crank that is pinned on by its pivot": (
        [("{pin: [2, 3], at: B}", "{pin: [2, 3], at: A}")],
        "",
        "link 4 stands still in this position: P does no work on it",
    ),
    "a pin given twice": (
        [("at: A}", "at: A}\n  - {pin: [2, 1], at: A}")],
        "",
        "the pin of 1 and 2 at A is given more than once",
    ),
    "a length of nothing": ([("AB: 1,", "AB: 0,")], "", "the length AB is 0: A and B are one place"),
    "a place far off": ([("[3.5, 2.4]", "[350, 240]")], "", "from where the data put it"),
    "the corner's letters exchanged": ([("CDE: 0", "DCE: 0")], "ambiguous", "add near: {E: ["),
    "radians": ([("angle: 180", "angle: 3.1416")], "", "if radians are meant, write 3.1416 rad"),
    "all angles in radians": (
        [("AB: 60, CDE: 0}", "AB: 1.05, CDE: 0.01}")],
        "",
        "if radians are meant, write each with its unit",
    ),
    "what was noticed, behind a full stop": (
        [("AB: 1,", "ab: 1,")],
        "underdetermined",
        "coordinate is needed. Noticed: nothing but lengths.ab",
    ),
    "the unknown torque on the frame": ([("link: 2}", "link: 1}")], "no-value", "Put it on a moving link"),
    "a length left out": ([("CD: 2.5, ", "")], "underdetermined", "one more length, angle or coordinate"),
    "near of another point": (
        [
            ("DE: 1.5}", "DE: 1.5, BG: 3, CG: 3}"),
            ("  P: ", "  Q: {force: 1, link: 3, at: G, angle: 0}\n  P: "),
        ],
        "ambiguous",
        "add near: {G: [0.939149, 3.83371]} for the one that is meant, beside what stands under near",
    ),
    "near left out": ([("near: {C: [3.5, 2.4]}\n", "")], "ambiguous", "add near: {C: [3.61106, 2.46956]}"),
    "a length of ten times": ([("BC: 3.5", "BC: 35")], "cannot-assemble", "BC = 35 and CD = 2.5 cannot meet"),
    "a letter in an angle": (
        [("CDE: 0", "CDF: 0")],
        "underdetermined",
        "nothing but angles.CDF names point F",
    ),
    "a letter in a length": (
        [("AB: 1,", "AF: 1,")],
        "underdetermined",
        "Noticed: nothing but lengths.AF names point F",
    ),
    "a length in small letters": ([("AB: 1", "ab: 1")], "underdetermined", "did you mean A-B?"),
    "a point in small letters": (
        [("D: [4, 0]", "d: [4, 0]")],
        "underdetermined",
        "a point d, which is another",
    ),
    "a load on the frame by its number": ([("title:", "ground: 4\ntitle:")], "", "link 4, the frame"),
    "two unknowns": ([("force: 100", "force: unknown")], "mobility", "Give one of them a number"),
}


@pytest.mark.parametrize("slip", SCENES)
def test_a_slip_of_the_scene_is_told(slip: str) -> None:
    changes, status, said = SCENES[slip]
    case = icsolve.load(changed(*changes))
    if status:
        with pytest.raises(SceneError) as refused:
            icsolve.solve(case)
        assert refused.value.status == status
        assert said in refused.value.message
    else:
        assert said in " ".join(icsolve.solve(case).notes)


@pytest.mark.parametrize(
    "joint",
    [
        "{slot: [5, 4], at: E, along: [C, D]}",
        "{slot: [5, 4], at: E, along: [D, E]}",
        "{slot: [5, 4], at: E, along: 30, through: D}",
        "{slot: [5, 1], at: E, along: [D, A]}",
        "{slot: [5, 1], at: E, along: [F, E], through: F}",
    ],
)
def test_a_guide_by_points_of_its_own_links_is_no_slip(joint: str) -> None:
    case = icsolve.load(changed(("D: [4, 0]}", "D: [4, 0], F: [9, 9]}"), ("loads:", f"  - {joint}\nloads:")))
    assert not [said for said in case.noticed if "guide" in said], case.noticed


@pytest.mark.parametrize(
    ("joint", "pair", "point", "whose"),
    [
        ("{slot: [5, 3], at: E, along: [A, B]}", "5 and 3", "A", "link 1 and link 2"),
        ("{slide: [5, 4], at: E, along: [C, E], through: A}", "5 and 4", "A", "link 1 and link 2"),
        ("{slide: [5, 1], at: E, along: 30, through: B}", "5 and 1", "B", "link 2 and link 3"),
        ("{slot: [2, 5], at: E, along: [D, C]}", "2 and 5", "D", "link 4 and link 1"),
    ],
)
def test_a_guide_by_a_point_of_other_links_is_noticed(joint: str, pair: str, point: str, whose: str) -> None:
    """It may be meant, as a line in this position; or the guide's link is another one."""
    case = icsolve.load(changed(("loads:", f"  - {joint}\nloads:")))
    said = f"the guide of links {pair} at E is given by {point}, a joint of {whose}; if it is"
    assert any(one.startswith(said) for one in case.noticed), case.noticed


KINDS = {
    "line-load": [
        ("distributed:", "line load:", "did you mean 'distributed'?"),
        ("from:", "start:", "mean 'from'?"),
    ],
    "tackle": [("mass:", "m:", "did you mean 'mass'?")],
    "engine": [
        ("inertia:", "I:", "did you mean 'inertia'?"),
        ("speed: 3000 rpm", "rpm: 3000", "mean 'speed'?"),
    ],
    "slider-crank": [("[unknown, 0]", "[x, 0]", "or 'unknown' for what is to find")],
    "spring": [("free:", "rest length:", "did you mean 'free'?"), ("to:", "end:", "did you mean 'to'?")],
}


@pytest.mark.parametrize("kind", KINDS)
def test_words_of_other_books_are_known_in_every_kind(kind: str) -> None:
    for old, new, said in KINDS[kind]:
        with pytest.raises(CaseError) as refused:
            icsolve.load(template(kind).replace(old, new, 1))
        told = [problem.message for problem in refused.value.problems]
        assert len(told) == 1 and said in told[0], told


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("1%", "1 percent"),
        ("1.5%", "1.5 per cent"),
        ("3 sf", "3 SF"),
        ("3 sf", "3 Sig Figs"),
        ("2 N*m", "2 Nm"),
    ],
)
def test_a_tolerance_is_read_as_people_write_it(one: str, other: str) -> None:
    """In another spelling it has the same sizes."""
    said = [
        icsolve.load(changed(("loads:", f"tolerance: {text}\nloads:"))).tolerance for text in (one, other)
    ]
    assert said[0] is not None and said[1] is not None
    assert said[0]._replace(unit="") == said[1]._replace(unit="")
    assert parse_unit(said[0].unit or "m") == parse_unit(said[1].unit or "m")


@pytest.mark.parametrize("share", ["2%", "2 %", "2 percent", "2 per cent", "2percent"])
def test_a_share_is_read_as_people_write_it(share: str) -> None:
    """Of a value and of a tolerance alike, and the schema takes it."""
    expect = ("loads:", f"expect: {{T12: {{value: 34, within: {share}}}}}\nloads:")
    assert icsolve.load(changed(expect)).expect[0][-5:-2] == (0.02, True, None)
    both = changed(("loads:", f"tolerance: {{relative: {share}}}\nloads:"))
    assert (
        icsolve.load(both).tolerance == icsolve.load(changed(("loads:", "tolerance: 2%\nloads:"))).tolerance
    )


def told_of(text: str) -> list[str]:
    """What is refused in a file, in its order."""
    with pytest.raises(CaseError) as refused:
        icsolve.load(text)
    return [problem.message for problem in refused.value.problems]


SPEEDS = [
    ("E", "3", "'v E on 3' asks for a speed on link 3 at E, which is a point of link 4: write 'v E on 4'"),
    ("E", "1", "'v E on 1' asks for a speed on link 1 at E, which is a point of link 4: write 'v E on 4'"),
]


@pytest.mark.parametrize(("point", "link", "said"), SPEEDS)
def test_a_published_speed_on_a_link_without_its_point_is_told(point: str, link: str, said: str) -> None:
    """As a load there is: by dimensions of another link it is refused, at a joint of others noted."""
    asked = ("loads:", f"expect: {{v {point} on {link}: 3}}\nloads:")
    assert told_of(changed(asked)) == [f"{said}, or 'links: {{{link}: [{point}]}}' if link {link} has it too"]
    assert icsolve.load(changed(asked, ("loads:", f"links: {{{link}: [{point}]}}\nloads:"))).expect
    elsewhere = icsolve.load(changed(("loads:", "expect: {v B on 4: 1, v E on 4: 1}\nloads:")))
    assert [note.partition(";")[0] for note in elsewhere.noticed] == [
        "'v B on 4' asks for a speed on link 4 at B, a joint of link 2 and link 3"
    ]


@pytest.mark.parametrize("slip", ["froce", "load", "Force"])
def test_what_is_wrong_behind_a_wrong_kind_is_told_in_the_same_run(slip: str) -> None:
    told = told_of(changed(("{force: 100, link: 4", f"{{{slip}: 1OO, lnk: 4")))
    assert len(told) == 3 and told[0].endswith("did you mean 'force'?"), told
    assert told[1:] == [
        "'1OO': write digits, 0 and 1, not the letters O, l and I",
        "load P has no key 'lnk'; did you mean 'link'?",
    ]


ROPE = """\
icsolve: 1
points: {A: [0, 0], D: [1, 0], P: [1, 1], B: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {rope: [D, P, B], on: [2, 1]}
loads:
  P1: {force: unknown, at: B}
  W: {force: 5, link: 2, at: D, angle: -90}
expect: {T D-P-B: 5}
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("on: [2, 1]", "on: [2]", "'on' names 1 link"),
        ("on: [2, 1]", "on: 2", "'on' of the rope D-P-B should be a list"),
        ("on: [2, 1]", "on: [2, 1+]", "'1+' is not a name"),
        (", on: [2, 1]", "", "needs 'on'"),
        ("P1: {force: unknown", "P1: {froce: unknown", "did you mean 'force'?"),
        ("P1: {force: unknown", "P1: {foo: 1", "load P1 has none of force"),
        ("P1: {force: unknown", "P1: {force: 1OO", "not the letters O, l and I"),
    ],
)
def test_of_a_rope_and_the_load_at_its_free_end_each_slip_is_told_alone(
    old: str, new: str, said: str
) -> None:
    icsolve.load(ROPE)
    told = told_of(ROPE.replace(old, new))
    assert len(told) == 1 and said in told[0], told


WOUND = """\
icsolve: 1
points: {O: [0, 0], A: [-3, 0.2], B: [2, -2]}
joints:
  - {pin: [1, drum], at: O}
  - {rope: [A, O, B], on: [1, drum], radii: {O: 0.2}, wraps: {O: cw}, mu: {O: 0.3}, turns: {O: 2}}
motion: {link: drum, turns: ccw}
loads: {F: {force: 20, at: B}, T: {torque: unknown, link: drum}}
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("rope: [A, O, B]", "rope: [A, B]", ["does not run through 'O'"]),
        ("radii: {O", "radi: {O", ["no key 'radi'; did you mean 'radii'?"]),
        ("radii: {O: 0.2}", "radius: 0.2", ["did you mean 'radii'?", "should be a mapping, as in {P: 0.1}"]),
        ("wraps: {O: cw}", "wraps: {o: cw}", ["does not run through 'o'; did you mean 'O'?"]),
        ("wraps: {O: cw}, ", "", ["give its sense, {O: ccw} or cw"]),
        ("mu: {O: 0.3}", "mu: 0.3", ["'mu' of the rope A-O-B should be a mapping"]),
    ],
)
def test_a_slip_at_a_pulley_is_told_once(old: str, new: str, said: list[str]) -> None:
    """And not by what would follow from it: a size without a sense, a load that has lost its rope."""
    icsolve.load(WOUND)
    told = told_of(WOUND.replace(old, new))
    assert len(told) == len(said), told
    assert all(part in text for part, text in zip(said, told, strict=True)), told


def test_a_torque_beside_the_screw_that_it_should_turn_is_told() -> None:
    """All links are locked then, and there is nothing to count."""
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(
            icsolve.load(
                "icsolve: 1\npoints: {B: [0, 0]}\n"
                "joints: [{screw: [1, 2], at: B, along: 90, lead: 0.006, radius: 0.015, mu: 0.12}]\n"
                "loads: {W: {weight: 20, link: 2, at: B}, T: {torque: unknown, link: 2}}\n"
            )
        )
    assert "no link moves" in refused.value.message and "0 links" not in refused.value.message
    assert "{torque: unknown, screw: 1-2} would" in refused.value.message


@pytest.mark.parametrize("word", ["diameter", "dia", "Diameter"])
def test_a_diameter_in_place_of_a_radius_is_half_of_it(word: str) -> None:
    pin = ("at: A}", f"at: A, mu: 0.1, {word}: 0.2}}")
    assert told_of(changed(pin)) == [f"the pin of 1 and 2 has no key '{word}'; write 'radius', half of it"]


def test_teeth_are_counted_without_a_word() -> None:
    with pytest.raises(CaseError, match="a bare number is wanted here, without 'teeth'"):
        icsolve.load(template("gears").replace("[31, 57]", "[31 teeth, 57]"))


def test_a_roller_of_a_bar_that_is_written_as_a_slide_is_told() -> None:
    """The foot of a scissor's arm runs along the floor, and the arm turns: a slide would hold it."""
    lift = template("scissor-lift").replace(
        "{slot: [3, 1], at: B, along: 0}", "{slide: [3, 1], at: B, along: 0}"
    )
    with pytest.raises(
        SceneError, match=r"The slide at B keeps links 3 and 1 from turning .* it is a `slot`"
    ) as one:
        icsolve.solve(icsolve.load(lift))
    assert one.value.status == "structure"


@pytest.mark.parametrize("words", [["press"], ["solve", "press"], ["draw", "pres.yaml"]])
def test_a_file_without_its_ending_is_named(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "press.yaml").write_text(PRESS)
    assert exit_status(*words) == 2
    assert "press.yaml" in capsys.readouterr().err
    assert exit_status("solve", "boat.yaml") == 2  # which has but its ending from that
    assert "did you mean" not in capsys.readouterr().err


COMMANDS = {
    "solve press.yaml --set angle.AB=30": "did you mean 'angles.AB'?",
    "solve press.yaml --set AB=30": "did you mean 'lengths.AB' or 'angles.AB'?",
    "solve press.yaml --set loads.P.force=20": "did you mean 'loads.P'?",
    "sweep press.yaml --vary CDE=0:90:10": "did you mean 'angles.CDE'?",
    "sweep press.yaml --drive crank=0:90:10": "the links are 1, 2, 3 and 4",
    "sweep press.yaml --vary angles.AB=0:90:30 --find T=3": "the loads are P and T12",
    "draw press.yaml -o nowhere/out.svg": "nowhere/out.svg can't be written: there is no folder nowhere",
    "sheet press.yaml -o sheet.pdf": "should end in .tex, which",
}


@pytest.mark.parametrize("line", COMMANDS)
def test_a_slip_on_the_command_line_is_told_with_what_is_there(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "press.yaml").write_text(PRESS)
    assert exit_status(*line.split()) == 2
    assert COMMANDS[line] in capsys.readouterr().err


def test_a_file_that_is_no_case_is_told_so() -> None:
    for text in ("ics: 2}\n", "Icsolve: 1\n", "a: 1\n"):
        with pytest.raises(CaseError, match="not an icsolve case"):
            icsolve.load(text)


def test_there_are_four_times_fifty() -> None:
    assert len(REFUSED) + len(SCENES) >= 200


ARM = """\
icsolve: 1
points: {A: [0, 0], B: [1, 1], O: [3, 0], C: [4, 1.5], E: [1.5, 0.75], F: [2, 0.5]}
links: {3: [C, E], 2: [F]}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [2, 3], at: B, along: [O, E]}
  - {pin: [3, 1], at: O}
loads:
  P: {force: 100, link: 3, at: C, angle: 180}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(
    ("along", "point"), [("[A, B]", "A"), ("[B, F]", "F"), ("[F, A]", "F"), ("-45, through: A", "A")]
)
def test_a_slot_along_points_of_its_own_pins_link_is_told(along: str, point: str) -> None:
    """Its line holds in this position, and would go with the pin; where one is a point of the slotted link,
    or in degrees, nothing is said."""
    for right in ("[O, E]", "[B, O]", "[E, B]", "-26.565051177", "[A, O]", "[B, E], through: A"):
        assert not icsolve.load(ARM.replace("[O, E]", right)).noticed
    (told,) = icsolve.load(ARM.replace("[O, E]", along)).noticed
    assert f"the slot of link 3 at B is given by {point}, a point of link 2, whose pin runs in it" in told
    assert "write 'slot: [3, 2]'" in told
    too = ARM.replace("[O, E]", along).replace("3: [C, E]", "3: [C, E, A, F]")
    assert icsolve.load(too).joints
    slide = ARM.replace("slot", "slide").replace("[O, E]", along)
    assert icsolve.load(slide).joints  # a block keeps its direction on its guide


PISTON = """\
icsolve: 1
points: {A: [0, 0], Q: [0, 20]}
lengths: {AB: 50, BC: 160}
angles: {AB: 40}
near: {C: [195, 20]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 2000, link: 4, at: C, angle: 180}
  T12: {torque: unknown, link: 2}
"""
"""Its guide has a direction alone."""


def test_a_guide_without_a_line_is_told_what_gives_it_one() -> None:
    """Its line is where its point is, so it places nothing: that a length is needed says so to nobody."""
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(PISTON))
    assert refused.value.status == "underdetermined"
    assert "give 'through', a point of that line, or a coordinate of C" in refused.value.message
    for mended in (("along: 0}", "along: 0, through: Q}"), ("Q: [0, 20]", "C: [unknown, 20]")):
        assert icsolve.solve(icsolve.load(PISTON.replace(*mended))).status == "ok"
