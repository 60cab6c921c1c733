"""Malformed, hostile and merely odd files: each gives its place and a sentence that says what to mend."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
import yaml

from corpus import FOUR_BAR, GEARS, SLIDER_CRANK, SLOT_AND_WORDS
from icsolve.errors import CaseError, NotACase
from icsolve.read import claims, document, load, read_text

LOADS = FOUR_BAR[FOUR_BAR.index("  P:") : FOUR_BAR.index("expect:")]


def wrong(text: str) -> CaseError:
    """The refusal of a text."""
    with pytest.raises(CaseError) as caught:
        load(text)
    return caught.value


def changed(old: str, new: str, text: str = FOUR_BAR) -> str:
    """A valid case with one thing changed."""
    assert text.count(old) >= 1, old
    return text.replace(old, new, 1)


# One change of the four-bar each: what is put in place of what, line and column, and what is said.
CHANGES = {
    # YAML that is not what it seems
    "tab": ("  A: [0", "\tA: [0", 7, 1, "a tab stands here"),
    "colon in a flow mapping": ("{AB: 60, C", "{AB:60, C", 10, 11, "'AB:60': write a space after the colon"),
    "colon in one line": ("  A: [0, 0]", "  A:[0, 0]", 7, 4, "write a space after the colon"),
    "colon in every line": (
        "A: [0, 0]\n  D: [4, 0]",
        "A:[0, 0]\n  D:[4, 0]",
        7,
        3,
        "a space after each colon",
    ),
    "colon of the version": ("icsolve: 1 ", "icsolve:1 ", 1, 8, "write a space after the colon"),
    "key twice": (
        "  D: [4",
        "  A: [1, 1]\n  D: [4",
        8,
        3,
        "'A' is given twice, the first time in line 7, column 3",
    ),
    "section twice": (
        "near: ",
        "points: {}\nnear: ",
        11,
        1,
        "'points' is given twice, the first time in line 6",
    ),
    "anchor": ("[0, 0]", "&a [0, 0]", 7, 6, "a case has no anchors"),
    "alias": ("[4, 0]", "*a", 8, 6, "a case has no aliases"),
    "tag": ("[4, 0]", "!!seq [4, 0]", 8, 6, "the tag '!!seq'"),
    "value that starts with @": ("at: A}", "at: @A}", 14, 23, "a value cannot start with '@'"),
    "value that starts with %": ("at: A}", "at: %A}", 14, 23, "a value cannot start with '%'"),
    "open bracket": ("at: A}", "at: A", 15, 5, "a bracket (opened in line 14, column 5) is not closed"),
    "open quotation": (
        'stands"',
        "stands",
        25,
        1,
        "a quotation mark (opened in line 3, column 9) is not closed",
    ),
    "indentation": ("  - {pin: [2, 3]", " - {pin: [2, 3]", 15, 2, "indented otherwise"),
    "list as a key": ("{AB: 60,", "{[A, B]: 60,", 10, 11, "stands where a key should"),
    "two documents": ("expect:", "---\nicsolve: 1\nexpect:", 23, 1, "a second document starts here"),
    "control character": ("press", "pre\x07ss", 2, 20, "U+0007 has no place in a text"),
    "half a surrogate": ("press", "pre\ud800ss", 2, 20, "U+D800 has no place in a text"),
    "surrogate by escape": ("Four-bar press", '"\\ud800"', 2, 11, "invalid Unicode character escape"),
    "colours by escape": ("Four-bar press", '"\\e[31m"', 2, 8, "title has a control character"),
    # sections and keys
    "section that does not exist": ("lengths:", "lenghts:", 9, 1, "did you mean 'lengths'?"),
    "later version": ("icsolve: 1", "icsolve: 2", 1, 10, "version '2' of the format is not known"),
    "profile of nothing": ("near: ", "profile: 1\nnear: ", 11, 10, "'profile' should be a mapping"),
    "section of the wrong form": ("{C: [3.5, 2.4]}", "C", 11, 10, "'near' should be a mapping"),
    "unit of the wrong kind": ("{length: in", "{length: lbf", 4, 17, "'lbf' is a force, not a length"),
    "unknown unit of the case": ("{length: in", "{length: inchs", 4, 17, "did you mean 'inches'?"),
    "unit that a case has not": ("force: lbf}", "mass: kg}", 4, 21, "units has no key 'mass'"),
    # numbers
    "not a number": ("AB: 1,", "AB: .nan,", 9, 15, "'.nan' is not a number"),
    "infinity": ("AB: 1,", "AB: -.inf,", 9, 15, "'-.inf' is not a number"),
    "five thousand digits": ("AB: 1,", f"AB: {'1' * 5000},", 9, 15, "too long"),
    "giant exponent": ("AB: 1,", "AB: 1e999999999,", 9, 15, "too long"),
    "too large": ("AB: 1,", "AB: 1e306,", 9, 15, "too large"),
    "too large once converted": ("AB: 1,", "AB: 1e400 km,", 9, 15, "too large"),
    "too small": ("AB: 1,", "AB: 1e-400,", 9, 15, "too small"),
    "length in kilograms": ("AB: 1,", "AB: 3 kg,", 9, 15, "'kg' is a mass, but a length is wanted"),
    "force in kilograms": ("force: 100", "force: 9 kg", 20, 16, "write 'mass' in place of the force"),
    "unknown unit": ("AB: 1,", "AB: 3 inchs,", 9, 15, "did you mean 'inches'?"),
    "decimal comma": ("BC: 3.5", 'BC: "3,5"', 9, 22, "write a decimal point"),
    "digits grouped": ("BC: 3.5", "BC: 1_000", 9, 22, "without separators"),
    "sexagesimal": ("BC: 3.5", "BC: 3:4", 9, 22, "':4' is not a unit"),
    "no value": ("BC: 3.5", "BC: ", 9, 22, "there is no value"),
    "list for a number": ("BC: 3.5", "BC: [1]", 9, 22, "not a list or mapping"),
    "unknown where it cannot be": ("BC: 3.5", "BC: unknown", 9, 22, "'unknown' cannot stand here"),
    "negative length": ("AB: 1,", "AB: −1 mm,", 9, 15, "the length AB should not be negative"),
    # names
    "point that nothing gives": ("at: E", "at: F", 20, 34, "point F is named here, but nothing gives it"),
    "name with a hyphen": ("  D: [4", "  D-1: [4", 8, 3, "'D-1' is not a name"),
    "typographic prime": ("  D: [4", "  D′: [4", 8, 3, "straight apostrophe"),
    "superscript in a name": ("  D: [4", "  D²: [4", 8, 3, "'D²' is not a name"),
    "three coordinates": ("[0, 0]", "[0, 0, 0]", 7, 6, "two coordinates"),
    "both coordinates unknown": ("[0, 0]", "[unknown, unknown]", 7, 6, "both coordinates of A are unknown"),
    "centroid of itself": ("[4, 0]", "{centroid: [D, A]}", 8, 18, "not of itself: take D out"),
    "centroid of a point twice": ("[4, 0]", "{centroid: [A, A]}", 8, 21, "counts once: take A out"),
    "centroid of one": ("[4, 0]", "{centroid: [A]}", 8, 17, "two or more other points"),
    "length of three points": ("{AB: 1", "{ABC: 1", 9, 11, "'ABC' should name two points"),
    "point to itself": ("{AB: 1", "{AA: 1", 9, 11, "names the same point twice"),
    "length both ways": ("{AB: 1", "{AB: 1, B-A: 1", 9, 18, "'B-A' is given twice, the first time as 'AB'"),
    "link of the frame's name": ("title:", "ground: 9\ntitle:", 2, 9, "no joint has a link '9'"),
    # joints
    "joint of one link": ("pin: [1, 2]", "pin: [1]", 14, 11, "a pin joins two links; only 1 is named"),
    "joint of a link with itself": ("pin: [1, 2]", "pin: [1, 1]", 14, 11, "1 is named twice"),
    "weld of three": ("pin: [1, 2]", "weld: [1, 2, 3]", 14, 12, "a weld joins two links; 3 are named"),
    "unknown kind": ("{pin: [1", "{pni: [1", 14, 6, "there is no joint kind 'pni'; did you mean 'pin'?"),
    "no kind": ("{pin: [1, 2], at: A}", "{at: A}", 14, 5, "this joint has no kind"),
    "two kinds": ("{pin: [1, 2]", "{pin: [1, 2], weld: [1, 2]", 14, 19, "a joint is of one kind"),
    "joint that is a text": ("{pin: [1, 2], at: A}", "pin 1 2", 14, 5, "a joint should be a mapping"),
    "spatial joint": ("{pin: [1", "{ball: [1", 14, 6, "a 'ball' is a joint in space, and the points"),
    "profile of a joint": ("at: A}", "at: A, profile: x}", 14, 26, "the pin of 1 and 2 has no key 'profile'"),
    "pin without a point": (", at: A}", "}", 14, 5, "needs 'at'"),
    "pin at coordinates": ("at: A}", "at: [0, 0]}", 14, 23, "coordinates stand in 'points'"),
    "slide without a direction": ("pin: [1", "slide: [1", 14, 5, "needs 'along'"),
    "slide along one point": ("pin: [1, 2]", "slide: [1, 2], along: [A]", 14, 28, "two different points"),
    "contact without a normal": ("pin: [1", "contact: [1", 14, 5, "common normal in degrees from 1 into 2"),
    "friction without a radius": ("at: A}", "at: A, mu: 0.2}", 14, 26, "needs 'radius'"),
    "weld with friction": ("{pin: [1, 2], at: A}", "{weld: [1, 2], at: A, mu: 1}", 14, 27, "that of a pin"),
    "negative friction": ("at: A}", "at: A, mu: -1, radius: 1}", 14, 30, "should not be negative"),
    "radius of nothing": ("at: A}", "at: A, mu: 1, radius: 0}", 14, 41, "should be greater than zero"),
    # loads
    "load on no link": ("link: 4", "link: 7", 20, 27, "no joint has a link '7'"),
    "load of no kind": ("force: 100", "forse: 100", 20, 9, "did you mean 'force'?"),
    "power without its unit": (LOADS, "  W: {power: 3, speed: 5, link: 4}\n", 20, 14, "W, kW or hp"),
    "power without a speed": (LOADS, "  W: {power: 3 hp, link: 4}\n", 20, 6, "needs 'speed'"),
    "power at rest": (LOADS, "  W: {power: 3 hp, speed: 0, link: 4}\n", 20, 20, "an endless torque"),
    "power to find": (LOADS, "  W: {power: unknown, speed: 1, link: 4}\n", 20, 14, "`torque: unknown`"),
    "power of no unit of it": (LOADS, "  W: {power: 3 N, speed: 1, link: 4}\n", 20, 14, "but a power is"),
    "two directions": ("angle: 180", "angle: 180, toward: A", 20, 49, "'angle' and 'toward'; give one"),
    "no direction": (", angle: 180", "", 20, 8, "load P needs its direction"),
    "direction of nothing": ("angle: 180", "slope: [0, 0]", 20, 37, "has no direction"),
    "toward itself": ("angle: 180", "toward: E", 20, 37, "cannot point toward it"),
    "components and a direction": ("force: 100", "force: [1, 2]", 20, 40, "given by components"),
    "against itself": ("angle: 180", "angle: 180, against: 4", 20, 49, "against itself"),
    "like nothing": ("force: 100", "force: {like: Q}", 20, 23, "there is no load 'Q'"),
    "like itself": ("force: 100", "force: {like: P}", 20, 23, "leads back to P"),
    "like another kind": ("force: 100", "force: {like: T12}", 20, 23, "cannot be like T12, a torque"),
    "torque at a point": ("link: 2}", "link: 2, at: A}", 21, 35, "a torque, which has no 'at'"),
    "sense in other words": ("link: 2}", "link: 2, turns: clockwise}", 21, 42, "should be ccw or cw"),
    "mass in pounds of force": (LOADS, "  W: {mass: 2 lb, link: 4, at: E}\n", 20, 13, "write 'lbm'"),
    "mass without a unit": (LOADS, "  W: {mass: 2, link: 4, at: E}\n", 20, 13, "a mass carries its unit"),
    "spring without its length": (LOADS, "  S: {spring: 2, link: 4, at: E, to: A}\n", 20, 6, "needs 'free'"),
    "loads as a list": (LOADS, "  - {force: 1, link: 4, at: E}\n", 20, 3, "'loads' should be a mapping"),
    # motion and expect
    "motion of nothing": ("loads:", "motion: {link: 2}\nloads:", 19, 9, "needs 'speed', 'turns: ccw'"),
    "speed of the wrong kind": (
        "loads:",
        "motion: {link: 2, speed: 3 m/s}\nloads:",
        19,
        26,
        "'m/s' is a speed, but",
    ),
    "point without a direction": (
        "loads:",
        "motion: {link: 4, point: E, speed: 1}\nloads:",
        19,
        9,
        "'angle'",
    ),
    "published link that is not there": ("w4/w2", "w4/w7", 24, 3, "'w4/w7' names nothing in this case"),
    "published load that is not there": ("w4/w2", "T13", 24, 3, "did you mean 'T12'?"),
    "width of the wrong kind": ("within: 1%", "within: wide", 24, 32, "does not start with a number"),
    "negative width": ("within: 1%", "within: -1%", 24, 32, "should not be negative"),
    "place of a ratio": (
        "{value: 0.49, within: 1%}",
        "{toward: 90}",
        24,
        11,
        "only a centre can lie 'toward'",
    ),
    "sense of a ratio": ("{value: 0.49, within: 1%}", "0.49 ccw", 24, 10, "a number without a sense"),
    "erratum without words": ("within: 1%", "erratum: ", 24, 24, "should say what is wrong"),
}


@pytest.mark.parametrize("what", CHANGES)
def test_one_thing_wrong_is_one_message_with_its_place(what: str) -> None:
    old, new, line, column, says = CHANGES[what]
    error = wrong(changed(old, new))
    assert says in str(error)
    assert (error.path, error.line, error.column) == ("<text>", line, column), str(error)
    assert str(error).startswith(f"<text>:{line}:{column}: ")
    assert len(error.problems) == 1, str(error)


def test_the_frame_must_be_in_a_joint() -> None:
    text = FOUR_BAR.replace("[1, 2]", "[5, 2]").replace("[4, 1]", "[4, 5]")
    assert "no joint has link 1, the frame" in str(wrong(text))
    assert load(text.replace("joints:", "ground: 5\njoints:")).ground == "5"


TEETH = {
    "[0, 57]": "whole numbers other than 0",
    "[31.5, 57]": "whole numbers other than 0",
    "[-31, -57]": "only one gear",
    "[31, -31]": "an internal gear has more teeth",
    "[31]": "the two numbers of teeth",
    "31": "the two numbers of teeth",
}


@pytest.mark.parametrize("teeth", TEETH)
def test_teeth_are_whole_numbers_and_one_gear_at_most_is_internal(teeth: str) -> None:
    assert TEETH[teeth] in str(wrong(changed("[31, 57]", teeth, GEARS)))


GEAR_CHANGES = {
    "carrier: 2, pressure": ("carrier: 3, pressure", "is a third link"),
    "angle: 20": ("angle: 90", "less than 90"),
    "pitch: 16": ("pitch: 16, module: 2 mm", "give one of them"),
    "module: 2 mm": ("module: 2 kg", "'kg' is a mass, but a length is wanted"),
    "radii: [3, 5]": ("radii: [3, -5]", "greater than zero"),
    "crossed: true": ("crossed: perhaps", "should be yes or no"),
    "radii: [1.5, 0]": ("radii: [0, -1]", "greater than zero"),
    "teeth: [31, 57], ": ("teeth: [31, 57], helix angle: 9, ", "whether it is the 'normal pressure angle'"),
    "pressure angle: 20": ("normal pressure angle: 20", "needs 'helix angle'"),
    "[31, -92], ": ("[31, -92], helix angle: 95, transverse pressure angle: 20, ", "less than 90 degrees"),
}


@pytest.mark.parametrize("old", GEAR_CHANGES)
def test_gears_belts_and_rolls(old: str) -> None:
    new, says = GEAR_CHANGES[old]
    assert says in str(wrong(changed(old, new, GEARS)))


AMBIGUOUS = """\
icsolve: 1
points: {A: [0, 0], B: [1, 0], C: [1, 1], AB: [2, 2], O2: [0, 1]}
lengths: {%s: 1}
angles: {%s: 30}
joints: [{pin: [1, 2], at: A}]
"""


def test_a_key_with_two_readings_says_so() -> None:
    error = wrong(AMBIGUOUS % ("BC", "ABC"))
    assert str(error) == "<text>:4:10: 'ABC' can be read as A-B-C or as AB-C; write it with hyphens"
    assert load(AMBIGUOUS % ("BC", "A-B-C")).angles[0].at == "B"  # type: ignore[union-attr]
    assert load(AMBIGUOUS % ("BC", "AB-C")).angles[0].a == "AB"


def test_a_key_of_longer_names_wants_hyphens() -> None:
    assert "write hyphens: O2-A" in str(wrong(AMBIGUOUS % ("O2A", "AC")))
    assert "write hyphens: O2-A" in str(wrong(AMBIGUOUS % ("AB-C", "O2A")))


def test_a_pair_of_links_with_two_readings_says_so() -> None:
    pins = ", ".join(f"{{pin: [1, {link}], at: A}}" for link in (4, 11, 14))
    text = f"icsolve: 1\npoints: {{A: [0, 0]}}\njoints: [{pins}]\nexpect: {{%s: [0, 0]}}\n"
    assert "can be read in 2 ways" in str(wrong(text % "I114"))
    assert load(text % "I1-14").expect[0].key == "I1-14"


# --- files and streams ---------------------------------------------------------------------------

FILES = {
    "empty": (b"", 1, "there is nothing in it"),
    "only a comment": (b"# later\n", 1, "there is nothing in it"),
    "a binary": (b"\x7fELF\x02\x01\0\0", 1, "a binary file"),
    "another encoding": (b"icsolve: 1\ntitle: caf\xe9\n", 2, "the byte 0xE9 is not UTF-8"),
    "a text": (b"To whom it may concern", 1, "this is not an icsolve case"),
    "a list": (b"- a\n- b\n", 1, "this is not an icsolve case"),
    "another program's": (b"services: {web: {image: nginx}}\n", 1, "it has no 'icsolve: 1' at its top"),
    "too large": (b"#" * 4_000_001, 1, "larger than 4 MB"),
}


@pytest.mark.parametrize("what", FILES)
def test_files_that_hold_no_case(what: str, tmp_path: Path) -> None:
    data, line, says = FILES[what]
    path = tmp_path / "odd.yaml"
    path.write_bytes(data)
    with pytest.raises(CaseError) as caught:
        load(path)
    assert says in str(caught.value)
    assert (caught.value.path, caught.value.line) == (str(path), line)


def test_a_link_that_leads_nowhere_says_where(tmp_path: Path) -> None:
    """It is there itself, so its own name is not proposed."""
    (tmp_path / "press.yaml").symlink_to("gone.yaml")
    (tmp_path / "ring.yaml").symlink_to("ring.yaml")
    assert str(wrong(f"{tmp_path}/press.yaml")).endswith(
        "press.yaml:1:1: this link leads to 'gone.yaml', which is not there"
    )
    assert "cannot be read" in str(wrong(f"{tmp_path}/ring.yaml"))


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("/nowhere/x.yaml", "no such file"),
        ("/tmp", "a folder"),
        ("", "no such file"),
        ("a\0b", "cannot be read"),
    ],
)
def test_paths_that_lead_to_no_file(path: str, says: str) -> None:
    assert says in str(wrong(path))
    assert str(wrong(path)).isprintable()


def test_a_stream_s_stray_byte_is_named() -> None:
    text = b"icsolve: 1\ntitle: caf\xe9\n".decode("utf-8", "surrogateescape")
    with pytest.raises(CaseError, match="<stdin>:2:11: the byte 0xE9 is not UTF-8"):
        read_text(text, "<stdin>")


def test_yaml_without_icsolve_is_told_from_a_case_that_is_wrong() -> None:
    for text in ("a: 1\n", "- 1\n", "\n", "a: [\n", "points: {A: 3}\n"):
        assert isinstance(wrong(text), NotACase), text
    for text in ("icsolve: 1\n", "icsolve: 1\na: [\n", "icsolve: 7\n", "{icsolve: 1, a: [}\n"):
        assert not isinstance(wrong(text), NotACase), text
    assert claims('"icsolve": 1')
    assert not claims("name: x")


# --- all problems in one run ---------------------------------------------------------------------


def test_every_section_s_problems_are_told_in_one_run_in_the_order_of_the_file() -> None:
    text = """\
icsolve: 1
units: {length: parsec}
points:
  A: [0]
  D: [4, x]
lengths: {AB: 1 N, BC: 3.5, CD: 2.5}
angles: {ABCD: 3}
near: {C: 1}
joints:
  - {pin: [1, 2], at: A, mu: 0.1}
  - {pni: [2, 3], at: B}
  - {pin: [3], at: C}
  - {pin: [3, 4, 1], at: D}
loads:
  P: {force: 1, link: 5, at: D}
  T: {torque: unknwon, link: 2}
motion: {link: 2}
expect:
  w9: 3
  T: 1 up
titel: x
"""
    error = wrong(text)
    assert [problem.line for problem in error.problems] == [
        2,
        4,
        5,
        6,
        7,
        8,
        10,
        11,
        12,
        15,
        15,
        16,
        17,
        19,
        20,
        21,
    ]


def test_a_joint_that_cannot_be_read_brings_no_second_message() -> None:
    """Its links and points are known to the loads all the same."""
    error = wrong(changed("{pin: [3, 4], at: C}", "{pinn: [3, 4], at: C}").replace("[4, 1]", "[9, 1]"))
    assert [problem.line for problem in error.problems] == [16]


def test_joints_that_cannot_be_read_bring_no_message_about_links() -> None:
    text = FOUR_BAR[: FOUR_BAR.index("joints:")] + "joints: none\n" + FOUR_BAR[FOUR_BAR.index("loads:") :]
    assert len(wrong(text).problems) == 1


@pytest.mark.parametrize("section", ["points", "lengths", "angles", "loads"])
def test_a_section_that_cannot_be_read_brings_no_message_about_its_names(section: str) -> None:
    lines = FOUR_BAR.replace("w4/w2: {value: 0.49, within: 1%}", "T12: 3").replace(
        "lengths: {", "lengths:\n  {"
    )
    head, _, tail = lines.replace("angles:  {", "angles:\n  {").partition(f"\n{section}:")
    rest = tail.lstrip("\n")
    while rest.startswith(" "):
        rest = rest.partition("\n")[2]
    assert [problem.line for problem in wrong(f"{head}\n{section}: 5\n{rest}").problems] == [
        head.count("\n") + 2
    ]


def test_a_thousand_problems_are_cut_at_a_hundred() -> None:
    text = "icsolve: 1\n" + "".join(f"x{i}: 1\n" for i in range(1000))
    assert len(wrong(text).problems) == 101
    assert "perhaps more" in str(wrong(text))


def test_messages_are_one_printable_line_each() -> None:
    for name in ("a\\nb", "\\e[31m", "\\u202e", "x" * 5000):
        error = wrong(f'icsolve: 1\n"{name}": 1\njoints: [{{pin: ["{name}", 2], at: A}}]\n')
        for problem in error.problems:
            assert str(problem).isprintable()
            assert len(str(problem)) < 1000


# --- bounded time and memory ---------------------------------------------------------------------

N = 40_000
HOSTILE = {
    "brackets": "icsolve: 1\npoints: " + "[" * N,
    "braces": "icsolve: 1\npoints: " + "{a: " * N,
    "dashes": "icsolve: 1\npoints:\n  " + "- " * N,
    "question marks": "icsolve: 1\n" + "? " * N,
    "closing brackets": "icsolve: 1\npoints: " + "]" * N,
    "quotation marks": "icsolve: 1\npoints: " + '"' * N,
    "one line": "icsolve: 1\ntitle: " + "x" * 3_000_000,
    "many values": "icsolve: 1\npoints: [" + "0, " * N * 4 + "]",
    "many points": "icsolve: 1\npoints: {" + ", ".join(f"P{i}: [0, 0]" for i in range(20_000)) + "}",
    "long keys": "icsolve: 1\nlengths: {"
    + ", ".join("A" * (i % 119 + 1) + str(i) + ": 1" for i in range(9000))
    + "}",
    "keys of known names": "icsolve: 1\npoints: {"
    + ", ".join("A" * i + ": [0, 0]" for i in range(1, 119))
    + "}\nangles: {"
    + ", ".join("A" * i + ": 0" for i in range(1, 119))
    + "}",
    "joints": "icsolve: 1\njoints:\n" + "".join(f"- {{pin: [{i}, {i + 1}], at: A}}\n" for i in range(9000)),
    "like in a ring": "icsolve: 1\njoints: [{pin: [1, 2], at: A}]\nloads: {"
    + ", ".join(f"L{i}: {{torque: {{like: L{(i + 1) % 9000}}}, link: 2}}" for i in range(9000))
    + "}",
    "like in a row": "icsolve: 1\njoints: [{pin: [1, 2], at: A}]\nloads: {"
    + ", ".join(f"L{i}: {{torque: {{like: L{i + 1}}}, link: 2}}" for i in range(9000))
    + "}",
    "anchors": "icsolve: 1\n" + "".join(f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]\n" for i in range(1, 10)),
    "comments": "# " + "x" * 1_000_000 + "\nicsolve: 1\n" + "#\n" * 100_000,
}


@pytest.mark.parametrize("what", HOSTILE)
def test_hostile_files_end_soon_and_in_little_memory(what: str) -> None:
    """The slowest takes about a second and 40 MB; a square walk takes minutes, an alias bomb gigabytes."""
    with room(150 << 20):
        assert wrong(HOSTILE[what]).line >= 1


@contextmanager
def room(size: int) -> Iterator[None]:
    """So many bytes more than the process has now, and MemoryError beyond, where the system can tell."""
    usual = resource.getrlimit(resource.RLIMIT_AS)
    with suppress(OSError):
        taken = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (taken + size, usual[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, usual)


@pytest.mark.parametrize("what", ["brackets", "braces", "dashes", "question marks"])
def test_the_parser_without_libyaml_ends_soon_too(what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document, "LOADER", yaml.SafeLoader)
    assert wrong(HOSTILE[what]).line >= 1


def test_slot_and_slider_changes() -> None:
    assert "no joint has a link 'cranck'; did you mean 'crank'?" in str(
        wrong(changed("link: crank, at: G", "link: cranck, at: G", SLOT_AND_WORDS))
    )
    assert "both ends of load S" in str(wrong(changed("to: [2, 2]", "to: A", SLOT_AND_WORDS)))
    assert "'kN*m' is a torque, but an angular speed" in str(
        wrong(changed("300 rpm", "300 kN*m", SLIDER_CRANK))
    )
    assert "gravity is given by its size" in str(wrong(changed("32.174 ft", "-32.174 ft", SLOT_AND_WORDS)))
    assert "cannot be like Q, which is given by components" in str(
        wrong(changed("{like: V}", "{like: Q}", SLOT_AND_WORDS))
    )
